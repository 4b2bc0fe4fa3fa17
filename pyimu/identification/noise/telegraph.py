"""Random telegraph (popcorn) noise: a bias that jumps between two levels at random instants.

Its spectrum is that of a Gauss-Markov process (Machlup 1954), so that no spectrum tells the two
apart; the likelihood of the samples does: that of a hidden Markov chain of two states, on one axis
or on several that jump together.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numba import njit
from scipy.optimize import minimize

from pyimu.identification.fit.local_level import SAME
from pyimu.identification.noise.rows import Rows

SHORT = 0.5
"""s; means from which levels are guessed."""

FINE = 0.1
"""s; means in which jumps are looked for: levels that last less are as good as white noise."""

DWELLS = (2.0, 8.0, 32.0)
"""s; how long a level lasts where the search begins."""

FEWEST = 4.0
"""Jumps that a telegraph must have more of: so many instants a ``bias_step`` has, and of so few
nothing says that more will come."""

RATES = 2
"""Numbers that a telegraph has beside its steps: how often it jumps up, and down."""


@njit(cache=True)
def _filtered(steps, white, walk):
    """Of a bias that walks by ``walk`` (m,) a second, seen in rows of variance ``white`` (n, m):
    one over the variance of each innovation and the gain, (n, m), what the rows tell of the bias,
    one over its variance, (m,), and half the sum of the logarithms of the variances.
    """
    n, m = white.shape
    sure, gain = np.empty((n, m)), np.empty((n, m))
    told, logs = np.zeros(m), 0.0
    for a in range(m):
        variance, constant = 0.0, 1.0
        for k in range(n):
            variance += walk[a] * steps[k]
            f = variance + white[k, a]
            sure[k, a], gain[k, a] = 1.0 / f, variance / f
            variance *= white[k, a] / f
            told[a] += constant**2 / f
            constant *= 1.0 - gain[k, a]
            logs += 0.5 * np.log(f)
    return sure, gain, told, logs


@njit(cache=True)
def _likelihood(r, steps, sure, gain, low, gap, up, down):
    """Log-likelihood [nat, constant and variances left out] of residuals (n, m) beside a bias that
    goes between ``low`` and ``low + gap`` (m,), ``up`` and ``down`` being jumps a second.

    ``below`` and ``above`` are the weights of the two states, whose sum is the likelihood so far.
    The bias walks, with innovations of one over variance ``sure`` (n, m) and ``gain`` (n, m). What
    is known of it in either state is one normal each, of one variance: after each row the two that
    lead to a state are put together in their mean (Kim 1994).
    """
    n, m = r.shape
    both, total = up + down, 0.0
    below, above = down / both, up / both
    mean, step, rise, fall = np.zeros((2, m)), -1.0, 0.0, 0.0
    for a in range(m):
        mean[:, a] = low[a]
    for k in range(n):
        if abs(steps[k] - step) > SAME * step:
            step = steps[k]
            moved = -np.expm1(-both * step) / both
            rise, fall = up * moved, down * moved
        # Half the squares of the innovations from either state, first, to either state.
        stays, rises, falls, keeps = 0.0, 0.0, 0.0, 0.0
        for a in range(m):
            half = 0.5 * sure[k, a]
            from_low, from_high = r[k, a] - mean[0, a], r[k, a] - mean[1, a]
            stays += half * from_low**2
            rises += half * (from_low - gap[a]) ** 2
            falls += half * from_high**2
            keeps += half * (from_high - gap[a]) ** 2
        best = min(min(stays, rises), min(falls, keeps))
        total -= best
        stays = below * (1.0 - rise) * np.exp(best - stays)
        rises = below * rise * np.exp(best - rises)
        falls = above * fall * np.exp(best - falls)
        keeps = above * (1.0 - fall) * np.exp(best - keeps)
        below, above = max(stays + falls, 1e-300), max(rises + keeps, 1e-300)
        fallen, kept = falls / below, keeps / above
        for a in range(m):
            apart = mean[1, a] - mean[0, a]
            first, second = mean[0, a] + fallen * apart, mean[0, a] + kept * apart
            mean[0, a] = first + gain[k, a] * (r[k, a] - first)
            mean[1, a] = second + gain[k, a] * (r[k, a] - gap[a] - second)
        # A logarithm of many numbers at once, while their product is one still.
        mixed = below + above
        if mixed < 1e-8:
            total += np.log(mixed)
            below, above = below / mixed, above / mixed
    return total + np.log(below + above)


def telegraph_likelihood(axes: Sequence[Rows], white: np.ndarray, walk: np.ndarray) -> float:
    """The largest log-likelihood [nat, constant left out] of a telegraph of which the axes of one
    log show the same jumps, each with a step of its own, given their first rows.

    ``white`` (n, m) is the variance of a sample and ``walk`` (m,) what the bias walks in a second.
    """
    r = np.column_stack([one.r for one in axes])
    r = r - r.mean(axis=0)
    gap = _gaps(axes, white)
    if not np.any(gap):
        return -np.inf
    m, size, steps = len(axes), np.abs(gap).max(), axes[0].steps
    sure, gain, told, logs = _filtered(steps, white, walk)
    # The bias is as unknown as that of other noises, whose first row shows it.
    known = logs + 0.5 * float(np.log(told).sum())

    def lost(p: np.ndarray) -> float:
        up, down = np.exp(np.clip(p[2 * m :], -12.0, 6.0))
        low, step = size * p[:m], size * p[m : 2 * m]
        return known - _likelihood(r, steps, sure, gain, low, step, up, down)

    def start(dwell: float) -> np.ndarray:
        return np.concatenate([-0.5 * gap / size, gap / size, np.full(2, -np.log(dwell))])

    first = min((start(d) for d in DWELLS), key=lost)
    simplex = first + np.vstack([np.zeros(len(first)), np.diag([0.2] * 2 * m + [0.7, 0.7])])
    options = {"initial_simplex": simplex, "xatol": 1e-2, "fatol": 0.05, "maxfev": 150 * len(first)}
    found = minimize(lost, first, method="Nelder-Mead", options=options)
    up, down = np.exp(np.clip(found.x[2 * m :], -12.0, 6.0))
    jumps = 2 * up * down / (up + down) * float(steps.sum())
    return -float(found.fun) if jumps > FEWEST else -np.inf


def _gaps(axes: Sequence[Rows], white: np.ndarray) -> np.ndarray:
    """The steps (m,) of a telegraph that is as long up as down and explains what short means vary
    together beyond white noise; zero where they do not.
    """
    length = max(1, round(SHORT / axes[0].h))
    short = np.column_stack([one.means(SHORT).r for one in axes])
    scale = np.sqrt(white.mean(axis=0) / length)
    values, vectors = np.linalg.eigh(np.atleast_2d(np.cov((short / scale).T)))
    return 2.0 * np.sqrt(max(values[-1] - 1.0, 0.0)) * scale * vectors[:, -1]
