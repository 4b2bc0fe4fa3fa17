"""The noise of a sensor at rest, by which a rest and what pushes a body are told."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

LEAST_ROWS = 5
"""Samples of a window at least: two of a slow log are alike by chance in the middle of a drive."""


@dataclass(frozen=True)
class Noise:
    """Standard deviations (3,) of a sample at rest, ``rate`` in rad/s and ``force`` in m/s^2;
    ``walk`` (3,) rad/s/sqrt(s) by which the gyro's bias walks; ``bias`` (3,) rad/s at the start.
    ``shown`` says that a part or a rest tells them: what a motion shows is no measure of rest.
    """

    rate: np.ndarray
    force: np.ndarray
    walk: np.ndarray
    bias: np.ndarray
    shown: bool = True

    def of_mean(self, rows: int, period: float) -> np.ndarray:
        """Variance (3,) of a mean rate over so many ``rows`` beside the bias at either end."""
        return self.rate**2 / rows + self.walk**2 * rows * period / 3

    def longest_mean(self, period: float) -> int:
        """Over how many rows a mean tells the bias at their end best: more only wander."""
        best = np.sqrt(3 / period) * self.rate / np.fmax(self.walk, 1e-12)
        return max(LEAST_ROWS, round(float(np.min(best))))
