r"""Warm-up: a bias that decays after power-on, y = b + A exp(-t / tau).

It is told from a random walk by generalised least squares: averages over intervals are regressed on
a constant and the exponential, in white noise and a random walk that are found with them
(``regression``), for time constants from a hundredth to a third of the record. The most significant
one is taken, its p-value multiplied by their number, and then refined.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize_scalar

from pyimu.characterization.temperature.averages import Averages
from pyimu.characterization.temperature.regression import Regression, regress

INTERVALS = 200
"""Intervals over which the record is averaged."""

CONSTANTS = np.geomspace(0.01, 0.33, 12)
"""Time constants that are tried, as shares of the record."""

CHANCE = 1e-3
"""Probability of finding a warm-up where there is none."""

LEAST_SHARE = 0.05
"""Share of the variance of the averages below which a warm-up is not worth mentioning."""


@dataclass(frozen=True)
class WarmUp:
    """A warm-up: ``amplitude`` A with its standard error ``std``, and time constant ``tau`` [s].

    The amplitude is in the samples' unit. For drawing there are the averages ``means`` (m,) at
    ``time`` (m,) s from the start and the bias ``fitted`` (m,).
    """

    amplitude: float
    std: float
    tau: float
    p_value: float
    time: np.ndarray
    means: np.ndarray
    fitted: np.ndarray

    def effect(self, time: np.ndarray) -> np.ndarray:
        """What the warm-up adds to the bias (n,) at times (n,) s from the start."""
        return self.amplitude * np.exp(-np.asarray(time, dtype=float) / self.tau)


@dataclass(frozen=True)
class _Exponentials:
    """Regressions on a constant and an exponential; times are shares of the record."""

    averages: Averages
    time: np.ndarray

    def fit(self, constant: float) -> Regression:
        """The regression with one time constant."""
        columns = np.column_stack([np.exp(-self.time / constant), np.ones(len(self.time))])
        return regress(self.averages, self.averages.values[:, 0], columns)

    def height(self, constant: float) -> float:
        """Amplitude of the exponential in standard errors."""
        fit = self.fit(constant)
        return float(abs(fit.mean[0]) / np.sqrt(fit.covariance[0, 0]))

    def refined(self, best: int) -> float:
        """The time constant of the greatest height about ``CONSTANTS[best]``."""
        ends = np.log(CONSTANTS[[max(best - 1, 0), min(best + 1, len(CONSTANTS) - 1)]])
        found = minimize_scalar(
            lambda v: -self.height(np.exp(v)),
            bounds=ends,
            method="bounded",
            options={"xatol": 0.01},
        )
        return float(np.exp(found.x))


def find_warm_up(column: np.ndarray, h: float) -> WarmUp | None:
    """The warm-up in samples (n,) without gap every ``h`` s, or None where there is none.

    There is none, either, in a record shorter than two samples an interval.
    """
    length = len(column) // INTERVALS
    if length < 2:
        return None
    means = column[: INTERVALS * length].reshape(INTERVALS, length).mean(axis=1)
    span = INTERVALS * length * h
    time, count = (np.arange(INTERVALS) + 0.5) / INTERVALS, np.full(INTERVALS, length)
    averages = Averages(time * span, np.zeros(INTERVALS), means[:, None], count, h)
    model = _Exponentials(averages, time)
    best = int(np.argmax([model.height(constant) for constant in CONSTANTS]))
    above = model.fit(CONSTANTS[best]).tail(0, 0.0)
    p_value = min(2 * min(above, max(1 - above, 0.0)) * len(CONSTANTS), 1.0)
    if p_value > CHANCE:
        return None
    constant = model.refined(best)
    fit = model.fit(constant)
    (amplitude, bias), std = fit.mean, float(np.sqrt(fit.covariance[0, 0]))
    fitted = bias + amplitude * np.exp(-time / constant)
    if np.var(fitted) < LEAST_SHARE * np.var(means):
        return None
    return WarmUp(
        float(amplitude), std, float(constant * span), float(p_value), time * span, means, fitted
    )
