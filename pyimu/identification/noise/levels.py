"""A bias that is another one after each of many instants, and stays until the next: after each
reversal, each handling, each calibration of its own at rest.

Its spectrum is that of a Gauss-Markov process whose correlation time is the mean time between two
instants, so that no spectrum tells the two apart; the likelihood of the samples does, by recursion
over the time since the last jump (Fearnhead and Liu 2007; Adams and MacKay 2007).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numba import njit
from scipy.optimize import minimize

from pyimu.identification.noise.exact import DIFFUSE
from pyimu.identification.noise.exact import filtered as exact_filtered
from pyimu.identification.noise.rows import Rows
from pyimu.identification.noise.telegraph import DWELLS, FEWEST, SHORT

KEPT = 24
"""Instants of the last jump that are kept in mind after each row, the likeliest."""

UNLIKELY = 1e-5
"""One that is so many times less likely than the likeliest is dropped before that."""

NUMBERS = 1
"""Numbers that levels have beside the size of each axis's: how often they change."""

MARKOV = 1
"""Numbers that each axis of a Gauss-Markov process has beside its size: its correlation time."""


@njit(cache=True)
def _likelihood(r, steps, white, walk, spread, rate):
    """Log-likelihood [nat, constant left out] of residuals (n, m) beside levels of variance
    ``spread`` (m,) about zero, all axes' drawn anew ``rate`` times a second, which walk by ``walk``
    (m,) a second between; ``white`` (n, m) is the variance of a row.
    """
    n, m = r.shape
    weight, mean, variance = np.zeros(KEPT + 1), np.zeros((m, KEPT + 1)), np.zeros((m, KEPT + 1))
    square, product = np.zeros(KEPT + 1), np.zeros(KEPT + 1)
    weight[0], count, total = 1.0, 1, 0.0
    variance[:, 0] = spread
    for k in range(n):
        if k > 0:
            jump = -np.expm1(-rate * steps[k])
            for i in range(count):
                weight[i] *= 1.0 - jump
            weight[count] = jump
            for a in range(m):
                for i in range(count):
                    variance[a, i] += walk[a] * steps[k]
                mean[a, count], variance[a, count] = 0.0, spread[a]
            count += 1
        for i in range(count):
            square[i], product[i] = 0.0, 1.0
        for a in range(m):
            value, known = r[k, a], white[k, a]
            for i in range(count):
                f, v = variance[a, i] + known, value - mean[a, i]
                sure = 1.0 / f
                gain = variance[a, i] * sure
                product[i] *= f
                square[i] += v * v * sure
                mean[a, i] += gain * v
                variance[a, i] = gain * known
        least = square[:count].min()
        summed = 0.0
        for i in range(count):
            weight[i] *= np.exp(0.5 * (least - square[i])) / np.sqrt(product[i])
            summed += weight[i]
        total += np.log(summed) - 0.5 * least
        count = _kept(weight, mean, variance, count)
    return total


@njit(cache=True)
def _kept(weight, mean, variance, count):
    """The number of hypotheses that stay, moved to the front, their weights adding up to one."""
    least, left, i = UNLIKELY * weight[:count].max(), 0.0, 0
    while i < count:
        if weight[i] > least:
            left += weight[i]
            i += 1
        else:
            count -= 1
            _move(weight, mean, variance, count, i)
    if count > KEPT:
        i = np.argmin(weight[:count])
        left -= weight[i]
        count -= 1
        _move(weight, mean, variance, count, i)
    for i in range(count):
        weight[i] /= left
    return count


@njit(cache=True)
def _move(weight, mean, variance, one, other):
    """Put a hypothesis in the place of another one."""
    weight[other] = weight[one]
    for a in range(len(mean)):  # In loops, as in ``pyimu.numerics.positive``.
        mean[a, other], variance[a, other] = mean[a, one], variance[a, one]


def levels_likelihood(axes: Sequence[Rows], white: np.ndarray, walk: np.ndarray) -> float:
    """The largest log-likelihood [nat, constant left out] of levels that change on all axes of one
    log at the same instants, given their first rows.

    ``white`` (n, m) is the variance of a sample and ``walk`` (m,) what the bias walks in a second.
    """
    r = np.column_stack([one.r for one in axes])
    r = r - r.mean(axis=0)
    spread = _spread(axes, white)
    if not np.all(spread):
        return -np.inf
    m, steps = len(axes), axes[0].steps
    seconds = float(steps.sum())

    def lost(p: np.ndarray) -> float:
        size, rate = spread * np.exp(np.clip(p[:m], -8.0, 8.0)), np.exp(np.clip(p[m], -12.0, 3.0))
        # What all levels tell of their mean, over which the bias, of any size, is integrated.
        told = (1.0 + rate * seconds) / size
        return 0.5 * float(np.log(told).sum()) - _likelihood(r, steps, white, walk, size, rate)

    starts = [np.concatenate([np.zeros(m), [-np.log(d)]]) for d in DWELLS]
    first = min(starts, key=lost)
    simplex = first + np.vstack([np.zeros(m + 1), 0.5 * np.eye(m + 1)])
    options = {"initial_simplex": simplex, "xatol": 3e-2, "fatol": 0.05, "maxfev": 60 * (m + 1)}
    found = minimize(lost, first, method="Nelder-Mead", options=options)
    jumps = np.exp(np.clip(found.x[m], -12.0, 3.0)) * seconds
    return -float(found.fun) if jumps > FEWEST else -np.inf


def markov_likelihood(axes: Sequence[Rows], white: np.ndarray, walk: np.ndarray) -> float:
    """The largest log-likelihood [nat, constant left out] of a Gauss-Markov process on each axis,
    of a size and a correlation time of its own, given the first rows: what of the same spectrum
    does not jump.
    """
    total = 0.0
    for a, (one, spread) in enumerate(zip(axes, _spread(axes, white), strict=True)):
        total += _markov_of_axis(one, np.ascontiguousarray(white[:, a]), float(walk[a]), spread)
    return total


def gain_likelihood(axes: Sequence[Rows], white: np.ndarray, walk: np.ndarray) -> float:
    """That of a gain in place of a bias: each axis's input times a Gauss-Markov process; none where
    an axis has no input.
    """
    total = 0.0
    for a, (one, spread) in enumerate(zip(axes, _spread(axes, white), strict=True)):
        size = float(np.mean(one.x**2))
        if not size > 0.0:
            return -np.inf
        known = np.ascontiguousarray(white[:, a]), float(walk[a]), spread / size
        total += _markov_of_axis(one, *known, one.x)
    return total


def _markov_of_axis(
    one: Rows, white: np.ndarray, walk: float, spread: float, gains: np.ndarray | None = None
) -> float:
    """That of one axis; the process is seen times ``gains`` (n,), where there are any."""
    r, diffuse = one.r - one.r[0], DIFFUSE * (float(white.mean()) + float(np.var(one.r)))

    def lost(p: np.ndarray) -> float:
        variance = spread * np.exp(np.clip(p[0], -8.0, 8.0))
        time = np.exp(np.clip(p[1], -3.0, 12.0))
        if gains is not None:
            return -_seen_times(r, gains, one.steps, white, walk, variance, time, diffuse)
        known = white, walk, np.array([variance]), np.array([time]), diffuse
        return -float(exact_filtered(r, one.steps, *known)[1:].sum())

    first = min(([0.0, np.log(d)] for d in DWELLS), key=lost)
    options = {"xatol": 3e-2, "fatol": 0.05, "maxfev": 120}
    simplex = first + np.vstack([np.zeros(2), 0.5 * np.eye(2)])
    found = minimize(
        lost, first, method="Nelder-Mead", options=options | {"initial_simplex": simplex}
    )
    return -float(found.fun)


@njit(cache=True)
def _seen_times(r, gains, steps, white, walk, variance, time, diffuse):
    """Log-likelihood [nat, constant left out] of residuals (n,) given the first: a bias, of any
    size at first, that walks by ``walk`` a second, and ``gains`` (n,) times a Gauss-Markov process.
    """
    bias, process, total, kept, last = 0.0, 0.0, 0.0, 1.0, -1.0
    b, c, p = diffuse, 0.0, variance
    for k in range(len(r)):
        if k > 0:
            if steps[k] != last:
                last = steps[k]
                kept = np.exp(-last / time)
            process *= kept
            b += walk * last
            c *= kept
            p = kept * kept * p + variance * (1.0 - kept * kept)
        x = gains[k]
        of_bias, of_process = b + c * x, c + p * x
        f = of_bias + of_process * x + white[k]
        v = r[k] - bias - x * process
        if k > 0:
            total -= 0.5 * (np.log(f) + v * v / f)
        bias += of_bias / f * v
        process += of_process / f * v
        b -= of_bias * of_bias / f
        c -= of_bias * of_process / f
        p -= of_process * of_process / f
    return total


def _spread(axes: Sequence[Rows], white: np.ndarray) -> np.ndarray:
    """Variance (m,) of short means beyond white noise's; zero where there is none."""
    length = max(1, round(SHORT / axes[0].h))
    short = np.column_stack([one.means(SHORT).r for one in axes])
    return np.maximum(short.var(axis=0) - white.mean(axis=0) / length, 0.0)
