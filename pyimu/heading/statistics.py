"""Mean, standard deviation and RMS of signed heading errors over runs, with 95 % intervals.

A mean of 0.60 beside a standard deviation of 1.30, as Hong and Park 2008 have them, cannot be of
absolute values: the errors are signed.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from pyimu.numerics.laws import chi2, norm, t

LEVEL = 0.95
"""Probability of the intervals."""

Interval = tuple[float, float]

NONE = (np.nan, np.nan)


@dataclass(frozen=True)
class Statistics:
    """Of ``count`` errors in rad, each figure with its interval; NaN where there are too few."""

    count: int
    mean: float
    mean_interval: Interval
    std: float
    std_interval: Interval
    rms: float
    rms_interval: Interval

    @classmethod
    def of(cls, errors: np.ndarray) -> Statistics:
        """Of errors (n,): the mean's interval by Student's t, that of the standard deviation by
        chi-squared; that of the RMS from the variance of the mean square of normal errors,
        (2 sigma^4 + 4 mu^2 sigma^2)/n.
        """
        n, mean = len(errors), float(np.mean(errors)) if len(errors) else np.nan
        rms = float(np.sqrt(np.mean(np.square(errors)))) if n else np.nan
        if n < 2:
            return cls(n, mean, NONE, np.nan, NONE, rms, NONE)
        std, tail = float(np.std(errors, ddof=1)), (1 - LEVEL) / 2
        off = float(t.isf(tail, n - 1)) * std / np.sqrt(n)
        ends = [float(std * np.sqrt((n - 1) / chi2.isf(q, n - 1))) for q in (tail, 1 - tail)]
        width = norm.isf(tail) * np.sqrt((2 * std**4 + 4 * mean**2 * std**2) / n)
        square = [float(np.sqrt(max(rms**2 + w, 0.0))) for w in (-width, width)]
        return cls(
            n,
            mean,
            (mean - off, mean + off),
            std,
            (ends[0], ends[1]),
            rms,
            (square[0], square[1]),
        )

    def as_dict(self) -> dict[str, Any]:
        """As in report.json, in rad."""
        return {"unit": "rad"} | vars(self)


def paired(one: np.ndarray, other: np.ndarray) -> Statistics:
    """Of the differences ``one`` - ``other`` of the errors of the same runs, (n,) each."""
    return Statistics.of(np.asarray(one) - np.asarray(other))


def nees_bounds(runs: int) -> Interval:
    """The 95 % bounds of the mean over runs of squared errors over their claimed variance."""
    tail = (1 - LEVEL) / 2
    return float(chi2.isf(1 - tail, runs) / runs), float(chi2.isf(tail, runs) / runs)
