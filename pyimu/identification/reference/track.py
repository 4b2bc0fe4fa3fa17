"""A level that is measured again and again: one number, or one that wanders."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from scipy.optimize import minimize, minimize_scalar

WANDERS = 6.0
"""Gain in log-likelihood [nat] of a level that wanders over one that does not, from which on it is
taken to: by chance it is as much in 3 of 10,000 logs (half of chi-square on one degree)."""

LEAST = 8
"""Measurements below which no wandering is looked for."""


@dataclass(frozen=True)
class Level:
    """The level (k,) at ``time`` (k,) s, one entry where it does not wander; ``std`` its standard
    error.
    """

    time: np.ndarray
    value: np.ndarray
    std: float


def level_of(time: np.ndarray, values: np.ndarray, std: np.ndarray) -> Level:
    """The level behind measurements (k,) with standard errors ``std`` (k,) known up to a factor.

    White errors and a random walk of the level, both by maximum likelihood (local-level model,
    Durbin and Koopman 2012, chapter 2).
    """
    unit = float(np.median(std))
    values, scaled = values / unit, std / unit

    def constant(log_r: float) -> float:
        return -_smoothed(time, values, scaled, 0.0, np.exp(log_r))[0]

    def wandering(z: np.ndarray) -> float:
        return -_smoothed(time, values, scaled, *np.exp(np.clip(z, -40, 40)))[0]

    still = minimize_scalar(constant, bounds=(-6.0, 15.0), method="bounded")
    q, r = 0.0, float(np.exp(still.x))
    if len(time) >= LEAST:
        starts = [[np.log(r) - 3.0, np.log(r) - 1.0], [np.log(r) - 1.0, 0.0]]
        walks = [minimize(wandering, s, method="Nelder-Mead") for s in starts]
        best = min(walks, key=lambda w: w.fun)
        if still.fun - best.fun > WANDERS:
            q, r = np.exp(np.clip(best.x, -40, 40)).tolist()
    _, level, variance = _smoothed(time, values, scaled, q, r)
    error = unit * float(np.sqrt(np.mean(variance)))
    if q == 0.0:
        return Level(time[:1], unit * level[:1], error)
    return Level(time, unit * level, error)


@njit(cache=True)
def _smoothed(time, values, std, q, r):
    """Log-likelihood given the first value, level (k,) and its variance (k,), by a Kalman smoother;
    ``q`` is the walk's variance in a second, ``r`` the factor on std^2.
    """
    n = len(values)
    level, variance = np.empty(n), np.empty(n)
    before, spread = np.empty(n), np.empty(n)
    m, p, likelihood = values[0], 1e12 * r * std[0] ** 2, 0.0
    for k in range(n):
        p += q * (time[k] - time[k - 1]) if k else 0.0
        before[k], spread[k] = m, p
        s = p + r * std[k] ** 2
        if k:
            likelihood -= 0.5 * ((values[k] - m) ** 2 / s + np.log(s))
        m, p = m + p / s * (values[k] - m), p * r * std[k] ** 2 / s
        level[k], variance[k] = m, p
    for k in range(n - 2, -1, -1):
        back = variance[k] / spread[k + 1]
        level[k] += back * (level[k + 1] - before[k + 1])
        variance[k] += back**2 * (variance[k + 1] - spread[k + 1])
    return likelihood, level, variance
