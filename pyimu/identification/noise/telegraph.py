"""Random telegraph (popcorn) noise: a bias that jumps between two levels at random instants.

Its spectrum is that of a Gauss-Markov process (Machlup 1954), so that no spectrum tells the two
apart; the likelihood of the samples does.
"""

from __future__ import annotations

import numpy as np
from numba import njit
from scipy.optimize import minimize

from pyimu.identification.noise.rows import Rows

SHORT = 0.5
"""s; means over which levels are looked for at first."""

FINE = 0.1
"""s; means in which jumps are looked for: levels that last less are as good as white noise."""

NUMBERS = 2
"""How many numbers a telegraph has more than a Gauss-Markov process: four with its two levels, of
which one is the bias."""


@njit(cache=True)
def _likelihood(r, steps, white, low, high, up, down):
    """Log-likelihood of residuals beside two levels; ``up`` and ``down`` are jumps a second."""
    share, total, both = up / (up + down), 0.0, up + down
    for k in range(len(r)):
        if k > 0:
            settled = up / both
            share = settled + (share - settled) * np.exp(-both * steps[k])
        a = -0.5 * (r[k] - low) ** 2 / white[k]
        b = -0.5 * (r[k] - high) ** 2 / white[k]
        top = max(a, b)
        lower, upper = (1.0 - share) * np.exp(a - top), share * np.exp(b - top)
        mixed = lower + upper
        total += top + np.log(mixed) - 0.5 * np.log(white[k])
        share = upper / mixed
    return total


def telegraph_likelihood(rows: Rows, white: np.ndarray) -> float:
    """The largest log-likelihood [nat, constant left out] of a telegraph beside white noise of
    variance ``white`` (n,) a sample.
    """
    low, high, rate = _guess(rows)
    if not high > low:
        return -np.inf
    gap = high - low

    def lost(p: np.ndarray) -> float:
        rates = np.exp(np.clip(p[2:], -12.0, 6.0))
        ends = low + gap * p[0], high + gap * p[1]
        return -_likelihood(rows.r, rows.steps, white, *ends, *rates)

    start = np.array([0.0, 0.0, np.log(rate), np.log(rate)])
    simplex = start + np.vstack([np.zeros(4), np.diag([0.1, 0.1, 0.7, 0.7])])
    options = {"initial_simplex": simplex, "xatol": 1e-3, "fatol": 0.05, "maxfev": 160}
    return -float(minimize(lost, start, method="Nelder-Mead", options=options).fun)


def _guess(rows: Rows) -> tuple[float, float, float]:
    """Two levels and the jumps a second between them, from short means in two groups."""
    length = max(1, round(SHORT / rows.h))
    whole = len(rows.r) // length * length
    means = rows.r[:whole].reshape(-1, length).mean(axis=1)
    low, high = np.quantile(means, [0.1, 0.9])
    for _ in range(20):
        above = means > 0.5 * (low + high)
        if above.all() or not above.any():
            return low, low, 1.0
        low, high = float(means[~above].mean()), float(means[above].mean())
    jumps = max(1, int(np.sum(above[1:] != above[:-1])))
    return low, high, 2 * jumps / (len(means) * length * rows.h)
