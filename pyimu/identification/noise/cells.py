"""Variances that are sums of known shapes: their likelihood, and the sizes that make it largest.

A cell holds ``count`` independent normal values of one variance, and ``squares``, the sum of their
squares. Its expected variance is ``base`` plus a sum of ``columns`` times unknown sizes. A spectrum
in bands of frequency is such a table, and so are squared innovations in classes of the motion.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numba import njit

from pyimu.numerics.positive import cholesky, solve

ROUNDS = 40
"""Of Fisher's scoring, at most; six are usual."""


@njit(cache=True)
def _likelihood(count, squares, variance):
    total = 0.0
    for j in range(len(count)):
        total -= 0.5 * (count[j] * np.log(variance[j]) + squares[j] / variance[j])
    return total


@njit(cache=True)
def _variance(base, columns, sizes):
    out = base.copy()
    for p in range(len(sizes)):
        if sizes[p] != 0.0:
            for j in range(len(out)):
                out[j] += sizes[p] * columns[p, j]
    return out


@njit(cache=True)
def _moved(sizes, change, step, least):
    """Sizes a step on, none below its least."""
    out = sizes.copy()
    for a in range(len(sizes)):
        out[a] = max(sizes[a] + step * change[a], least[a])
    return out


@njit(cache=True)
def scored(count, squares, base, columns, least, sizes):
    """Sizes (p,), none below its ``least``, of columns (p, c) at the maximum likelihood.

    Fisher's scoring from ``sizes``, a size at its bound left there while the score points beyond.
    Gives the sizes and the log-likelihood.
    """
    p = len(sizes)
    sizes = sizes.copy()
    variance = _variance(base, columns, sizes)
    best = _likelihood(count, squares, variance)
    if p == 0:
        return sizes, best
    for _ in range(ROUNDS):
        score, gram = np.zeros(p), np.zeros((p, p))
        for j in range(len(count)):
            off = 0.5 * (squares[j] / variance[j] - count[j]) / variance[j]
            weight = 0.5 * count[j] / variance[j] ** 2
            for a in range(p):
                score[a] += off * columns[a, j]
                for b in range(a + 1):
                    gram[a, b] += weight * columns[a, j] * columns[b, j]
        for a in range(p):
            for b in range(a):
                gram[b, a] = gram[a, b]
        for a in range(p):
            if sizes[a] <= least[a] and score[a] <= 0.0:
                score[a] = 0.0
                gram[a, :] = 0.0
                gram[:, a] = 0.0
                gram[a, a] = 1.0
            gram[a, a] *= 1.0 + 1e-10
        change = score.copy()
        solve(cholesky(gram), change)
        if np.sum(change * score) < 1e-6:
            break
        step, moved = 1.0, False
        for _ in range(12):
            tried = _moved(sizes, change, step, least)
            variance = _variance(base, columns, tried)
            found = _likelihood(count, squares, variance) if np.all(variance > 0.0) else -np.inf
            if found > best:
                sizes, best, moved = tried, found, True
                break
            step *= 0.4
        if not moved:
            break
    return sizes, best


@njit(cache=True)
def gains(count, squares, base, known, known_least, tried, tried_least):
    """Log-likelihoods (b, k) that each of k columns ``tried`` gains beside columns ``known`` (p, c)
    in each of b draws of ``squares`` (b, c).
    """
    p, k, cells = len(known), len(tried), len(count)
    out = np.zeros((len(squares), k))
    columns, least = np.zeros((p + 1, cells)), np.zeros(p + 1)
    for a in range(p):  # In loops, as in ``pyimu.numerics.positive``.
        least[a] = known_least[a]
        for j in range(cells):
            columns[a, j] = known[a, j]
    for d in range(len(squares)):
        start, null = np.zeros(p + 1), 0.0
        for c in range(-1, k):
            for j in range(cells):
                columns[p, j] = tried[c, j] if c >= 0 else 0.0
            least[p] = tried_least[c] if c >= 0 else 0.0
            sizes, found = scored(count, squares[d], base, columns, least, start)
            if c < 0:
                start, null = sizes, found
            else:
                out[d, c] = max(0.0, found - null)
    return out


@dataclass(frozen=True)
class Cells:
    """Cells of one axis: ``count`` (c,), ``squares`` (c,), variance ``base`` (c,) of what is held,
    and what is free beside it: columns ``free`` (p, c) whose sizes are at least ``least`` (p,).
    """

    count: np.ndarray
    squares: np.ndarray
    base: np.ndarray
    free: np.ndarray
    least: np.ndarray

    def fit(self) -> tuple[np.ndarray, float]:
        """Sizes (p,) of what is free, and the log-likelihood [nat]."""
        unit = self._units(self.free)
        start = np.zeros(len(self.free))
        sizes, found = scored(
            self.count,
            self.squares,
            self.base,
            self.free / unit[:, None],
            self.least * unit,
            start,
        )
        return sizes / unit, found

    def gains(self, tried: np.ndarray, least: np.ndarray, squares: np.ndarray) -> np.ndarray:
        """Log-likelihoods (b, k) gained by columns ``tried`` (k, c), for ``squares`` (b, c)."""
        free, new = self._units(self.free), self._units(tried)
        return gains(
            self.count,
            squares,
            self.base,
            self.free / free[:, None],
            self.least * free,
            tried / new[:, None],
            least * new,
        )

    def _units(self, columns: np.ndarray) -> np.ndarray:
        """What makes columns (p, c) as large as the base somewhere, so that sizes are near one."""
        return np.maximum(np.max(columns / self.base, axis=1, initial=0.0), 1e-300)

    def with_free(self, columns: np.ndarray, least: np.ndarray) -> Cells:
        return replace(
            self,
            free=np.concatenate([self.free, columns]),
            least=np.concatenate([self.least, least]),
        )

    def without(self, place: int) -> Cells:
        keep = np.arange(len(self.free)) != place
        return replace(self, free=self.free[keep], least=self.least[keep])

    def covariance(self, sizes: np.ndarray) -> np.ndarray:
        """Covariance (p, p) of the sizes by Fisher's information."""
        variance = self.base + sizes @ self.free
        unit = self._units(self.free)
        slopes = self.free / unit[:, None] / variance
        information = 0.5 * (slopes * self.count) @ slopes.T
        return np.linalg.pinv(information, rcond=1e-12) / np.outer(unit, unit)

    def drawn(self, sizes: np.ndarray, draws: int, rng: np.random.Generator) -> np.ndarray:
        """Squares (draws, c) of logs like this one, of this noise."""
        variance = self.base + sizes @ self.free
        return variance * rng.chisquare(self.count, (draws, len(self.count)))
