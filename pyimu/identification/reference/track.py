"""A level that is measured again and again: one number, a straight line, or one that wanders."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numba import njit
from scipy.optimize import minimize, minimize_scalar
from scipy.stats import chi2, f

WANDERS = 6.0
"""Gain in log-likelihood [nat] of a level that wanders over one that does not, from which on it is
taken to: by chance it is as much in 3 of 10,000 logs (half of chi-square on one degree)."""

LEAST = 8
"""Measurements below which no wandering is looked for."""

LEAST_LINE = 4
"""Measurements below which no slope is looked for: two are left to tell the scatter by."""


@dataclass(frozen=True)
class Level:
    """The level (k,) at ``time`` (k,) s, with ``std`` as its standard error.

    It has one entry where it stands still, and two where it is a straight line.
    """

    time: np.ndarray
    value: np.ndarray
    std: float

    def between(self, first: float, last: float) -> Level:
        """The level from ``first`` to ``last`` s, which a straight line reaches to."""
        if len(self.time) != 2:
            return self
        ends = np.array([first, last])
        slope = np.diff(self.value) / np.diff(self.time)
        return replace(self, time=ends, value=self.value[0] + slope * (ends - self.time[0]))


def level_of(time: np.ndarray, values: np.ndarray, std: np.ndarray) -> Level:
    """The level behind measurements (k,) with standard errors ``std`` (k,) known up to a factor.

    A slope is one that chance would make once in as many logs as ``WANDERS`` allows (F test of
    weighted least squares); what is left of it may wander: white errors and a random walk of the
    level, both by maximum likelihood (local-level model, Durbin and Koopman 2012, chapter 2).
    """
    unit = float(np.median(std))
    values, scaled = values / unit, std / unit
    slope = _slope(time, values, scaled)
    line = slope * (time - time[0])
    q, r = _walk(time, values - line, scaled)
    if q > 0.0:
        q, r = _walk(time, values, scaled)
        line = np.zeros_like(time) if q > 0.0 else line
    _, level, variance = _smoothed(time, values - line, scaled, q, r)
    error = unit * float(np.sqrt(np.mean(variance)))
    if q > 0.0:
        return Level(time, unit * level, error)
    if slope == 0.0:
        return Level(time[:1], unit * level[:1], error)
    return Level(time[[0, -1]], unit * (level + line)[[0, -1]], error)


def _slope(time: np.ndarray, values: np.ndarray, std: np.ndarray) -> float:
    """The slope of a line through measurements, zero where it may be chance."""
    if len(time) < LEAST_LINE:
        return 0.0
    weighted = np.column_stack([np.ones(len(time)), time - time[0]]) / std[:, None]
    still = np.linalg.lstsq(weighted[:, :1], values / std)
    line = np.linalg.lstsq(weighted, values / std)
    left = float(np.sum((values / std - weighted @ line[0]) ** 2))
    gained = float(np.sum((values / std - weighted[:, :1] @ still[0]) ** 2)) - left
    free = len(time) - 2
    chance = f.sf(gained / max(left / free, 1e-300), 1, free)
    return float(line[0][1]) if chance < 0.5 * chi2.sf(2 * WANDERS, 1) else 0.0


def _walk(time: np.ndarray, values: np.ndarray, std: np.ndarray) -> tuple[float, float]:
    """Variance in a second of the level's walk, zero where it stands still, and the factor on
    ``std`` squared.
    """

    def constant(log_r: float) -> float:
        return -_smoothed(time, values, std, 0.0, np.exp(log_r))[0]

    def wandering(z: np.ndarray) -> float:
        return -_smoothed(time, values, std, *np.exp(np.clip(z, -40, 40)))[0]

    still = minimize_scalar(constant, bounds=(-6.0, 15.0), method="bounded")
    r = float(np.exp(still.x))
    if len(time) >= LEAST:
        starts = [[np.log(r) - 3.0, np.log(r) - 1.0], [np.log(r) - 1.0, 0.0]]
        walks = [minimize(wandering, s, method="Nelder-Mead") for s in starts]
        best = min(walks, key=lambda w: w.fun)
        if still.fun - best.fun > WANDERS:
            q, r = np.exp(np.clip(best.x, -40, 40)).tolist()
            return q, r
    return 0.0, r


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
