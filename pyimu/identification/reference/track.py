"""A level that is measured again and again.

One number, or one that drifts steadily, steps, or wanders.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numba import njit
from scipy.optimize import minimize, minimize_scalar

from pyimu.identification.fit.clock import Slip
from pyimu.identification.reference.steps import (
    Line,
    constant_likelihood,
    cost,
    ramp,
    stepped,
)
from pyimu.numerics.laws import chi2, f

WANDERS = 6.0
"""Gain in log-likelihood [nat] of a level that wanders over one that does not, from which on it is
taken to: by chance it is as much in 3 of 10,000 logs (half of chi-square on one degree)."""

EDGE = 1e-6
"""s before and after a step at which its two levels are put."""

LEAST = 8
"""Measurements below which no wandering is looked for."""

LEAST_LINE = 4
"""Measurements below which no slope is looked for: two are left to tell the scatter by."""


@dataclass(frozen=True)
class Level:
    """The level (k,) at ``time`` (k,) s, one entry where it stands still.

    ``std`` its standard error.

    ``slope``, in a second and with its standard error, is that of a level which drifts steadily but
    for its ``steps``; None where it stands still or wanders.
    """

    time: np.ndarray
    value: np.ndarray
    std: float
    slope: tuple[float, float] | None = None
    steps: tuple[Slip, ...] = ()


def level_of(time: np.ndarray, values: np.ndarray, std: np.ndarray, least: float = 0.0) -> Level:
    """The level behind measurements (k,) with standard errors ``std`` (k,) known up to a factor.

    White errors about one number, a steady drift, such a drift with steps of one size, or a random
    walk (local-level model, Durbin and Koopman 2012, chapter 2): one that is ``WANDERS`` better
    than all that are simpler. Steps of less than ``least`` are none.
    """
    unit = float(np.median(std))
    values, scaled = values / unit, std / unit
    r, q, gain = _walk(time, values, scaled)
    if len(time) >= LEAST:
        still = constant_likelihood(values, scaled)
        drift, steps = ramp(time, values, scaled), stepped(time, values, scaled)
        steady = drift.likelihood - still
        if steps and steps.likelihood - still - cost(steps) > max(gain, steady, 0.0) + WANDERS:
            level = _along(steps, time, values, unit)
            if all(abs(s.size) >= least for s in level.steps):
                return level
            # What follows such steps is no walk; what a line does not is more than these.
            gain = gain if gain > steady + WANDERS else 0.0
        if steady > max(gain, WANDERS):
            return _along(drift, time, values, unit)
    elif len(time) >= LEAST_LINE:
        drift = ramp(time, values, scaled)
        if _is_slope(drift.likelihood - constant_likelihood(values, scaled), len(time)):
            return _along(drift, time, values, unit)
    q = q if gain > WANDERS else 0.0
    _, level, variance = _smoothed(time, values, scaled, q, r[q > 0.0])
    error = unit * float(np.sqrt(np.mean(variance)))
    if q == 0.0:
        return Level(time[:1], unit * level[:1], error)
    return Level(time, unit * level, error)


def _is_slope(gain: float, count: int) -> bool:
    """Whether a slope that gains so much [nat] is no chance, by the F test that so few need."""
    ratio = float(np.expm1(2.0 * gain / count)) * (count - 2)
    return bool(f.sf(ratio, 1, count - 2) < 0.5 * chi2.sf(2 * WANDERS, 1))


def _walk(
    time: np.ndarray, values: np.ndarray, std: np.ndarray
) -> tuple[tuple[float, float], float, float]:
    """Factors on std^2 without and with a walk, the walk's variance in a second, and its gain."""

    def constant(log_r: float) -> float:
        return -_smoothed(time, values, std, 0.0, np.exp(log_r))[0]

    def wandering(z: np.ndarray) -> float:
        return -_smoothed(time, values, std, *np.exp(np.clip(z, -40, 40)))[0]

    still = minimize_scalar(constant, bounds=(-6.0, 15.0), method="bounded")
    r = float(np.exp(still.x))
    if len(time) < LEAST:
        return (r, r), 0.0, 0.0
    starts = [[np.log(r) - 3.0, np.log(r) - 1.0], [np.log(r) - 1.0, 0.0]]
    best = min((minimize(wandering, s, method="Nelder-Mead") for s in starts), key=lambda w: w.fun)
    q, moving = np.exp(np.clip(best.x, -40, 40)).tolist()
    return (r, moving), q, float(still.fun - best.fun)


def _along(line: Line, time: np.ndarray, values: np.ndarray, unit: float) -> Level:
    """The level along a line: as measured there, and on both sides of each step."""
    steps = line.steps(time, values)
    first = int(line.number[0])
    signs = np.sign([s.size for s in steps]) * np.sign(line.coefficients[2])
    numbers = first + np.concatenate([[0], np.cumsum(signs)])
    whole = ~line.inside
    edges = np.repeat([s.time for s in steps], 2)
    nodes = np.concatenate([time[whole], edges + np.tile([-EDGE, EDGE], len(steps))])
    number = np.concatenate(
        [line.number[whole], np.column_stack([numbers[:-1], numbers[1:]]).ravel()]
    )
    order = np.argsort(nodes, kind="stable")
    level = line.at(nodes[order], number[order])
    return Level(
        nodes[order],
        unit * level,
        unit * line.std(time),
        tuple(unit * v for v in line.slope),
        tuple(replace(s, size=unit * s.size) for s in steps),
    )


@njit(cache=True)
def _smoothed(time, values, std, q, r):
    """Log-likelihood given the first value, level (k,) and its variance (k,), by a Kalman smoother.

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
