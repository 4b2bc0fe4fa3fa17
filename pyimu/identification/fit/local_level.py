"""The likeliest white noise and random walk of a residual: the local-level model (Harvey 1989,
"Forecasting, structural time series models and the Kalman filter", section 4.2), its white part and
a constant concentrated out of the likelihood.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np
from numba import njit
from scipy.optimize import minimize_scalar

SAME = 1e-9
"""Share by which steps may differ and be taken for one: stamps are rounded."""

ROUNDING = 1e-15
"""Share by which a gain changes from row to row once it has settled."""

LOGGED = 8
"""Variances that are multiplied before a logarithm is taken: a product of so many, each between
1e-38 and 1e38, is a number still."""

LOWEST, HIGHEST, APART = 0.01, 8.0, 1.0
"""Ratios that are tried of a walk's variance in a step to the white one: from one that all rows
hardly show, this over the square of their number, to the exponential of 8, and how far apart the
logarithms of two are."""

THIN = 0.1
"""Share of the rows over which a walk grows as large as the white noise that are put together in
one mean: what it does within adds 0.003 of the mean's variance."""

FALLEN = 30.0
"""nat below the best at which larger walks are not tried."""

EXACT = 0.002
"""Of the logarithm of the ratio: a million rows tell it to 0.004 at best."""

WORTH = 0.01
"""nat that a walk must gain to be one."""

FEWEST = 50
"""Means of a log at least."""

Rows = tuple[np.ndarray, np.ndarray]
"""Values (m,) and the steps [s] to each, none before the first."""

Part = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Means (m,) of rows, the steps to each, and the sum of squares within each."""


@njit(cache=True)
def _concentrated(values, steps, k2):
    """Of innovations of a residual (m,), white noise of variance 1 and a walk of ``k2`` a second:
    the sum of the logarithms of their variances, and that of squares less what a constant takes.
    """
    known, total, product = 0.0, 0.0, 1.0
    step, settled, f, sure = -1.0, False, 1.0, 1.0
    level, constant, power, mixed, of_constant = 0.0, 0.0, 0.0, 0.0, 0.0
    for k in range(len(steps)):
        if abs(steps[k] - step) > SAME * step:
            step, settled = steps[k], False
        if not settled:
            grown = known + k2 * step
            f = grown + 1.0
            sure = 1.0 / f
            settled = abs(grown * sure - known) <= ROUNDING * known
            known = grown * sure
        product *= f
        if k % LOGGED == LOGGED - 1:
            total += np.log(product)
            product = 1.0
        v, one = values[k] - level, 1.0 - constant
        level, constant = level + known * v, constant + known * one
        power, mixed = power + v * v * sure, mixed + v * one * sure
        of_constant += one**2 * sure
    return total + np.log(product), power - mixed**2 / of_constant


def likeliest(parts: Sequence[Rows], least: float) -> tuple[float, float]:
    """White variance of a row, at ``least`` so much, and walk a second, of residuals that share
    them: the likeliest of all walks, none where none is likelier by a hundredth of a nat.
    """
    count = sum(len(v) for v, _ in parts)
    step = _typical([d[1:] for _, d in parts])
    seen = _Seen(parts, least)
    whole = seen.in_means(1)
    tried = seen.tried(float(np.log(LOWEST / count**2)), step)
    best = max(tried, key=lambda x: tried[x])
    near = seen.in_means(many_rows(best + APART))
    found = minimize_scalar(
        lambda x: near.lost(np.exp(x) / step)[0],
        bounds=(best - APART, best + APART),
        method="bounded",
        options={"xatol": EXACT},
    )
    (none, r), (lost, beside) = whole.none, whole.lost(np.exp(found.x) / step)
    # A random walk that does not pay for itself is left out: the likelihood is flat towards zero.
    if none <= lost + WORTH:
        return r, 0.0
    return beside, beside * float(np.exp(found.x)) / step


def _typical(steps: Sequence[np.ndarray]) -> float:
    """The median step; of those that are one any, since it takes as long as the fit to sort them
    out.
    """
    least, most = min(d.min() for d in steps), max(d.max() for d in steps)
    return float(least if most - least <= SAME * most else np.median(np.concatenate(steps)))


def many_rows(log_ratio: float) -> int:
    """Rows that may be put together in one mean beside a walk whose variance in a step has a ratio
    to the white one of this logarithm, a power of two.
    """
    return 1 << max(0, int(np.log2(THIN) - 0.5 * log_ratio / np.log(2.0)))


class _Seen:
    """Residuals in means of as many rows as are asked for."""

    def __init__(self, parts: Sequence[Rows], least: float) -> None:
        self.parts, self.least = parts, least
        self.most = max(1, min(len(v) for v, _ in parts) // FEWEST)
        self.made: dict[int, _Means] = {}

    def in_means(self, many: int) -> _Means:
        many = min(many, self.most)
        if many not in self.made:
            self.made[many] = self._means(many)
        return self.made[many]

    def _means(self, many: int) -> _Means:
        """Those of even numbers are means of the means of half as many."""
        if many == 1:
            return _Means([(v, d, np.zeros(len(v))) for v, d in self.parts], 1, self.least)
        of = self.in_means(1 if many % 2 else many // 2)
        each = [_put_together(*part, many // of.many) for part in of.parts]
        return _Means(each, many, self.least)

    def tried(self, first: float, step: float) -> dict[float, float]:
        """By the logarithm of their ratio what walks gain [nat] over none."""
        gains: dict[float, float] = {}
        for x in np.arange(first, HIGHEST, APART):
            means = self.in_means(many_rows(x))
            gains[x] = means.none[0] - means.lost(np.exp(x) / step)[0]
            best = max(gains, key=lambda x: gains[x])
            if gains[x] < gains[best] - FALLEN and x > best + 2 * APART:
                break
        return gains


class _Means:
    """Residuals in means of ``many`` rows each; what is left at an end is left out.

    ``parts`` are the means (m,) of each residual, as large as makes their white variance that of a
    row, the steps to each, and the sum of squares within each.
    """

    def __init__(self, parts: Sequence[Part], many: int, least: float) -> None:
        self.parts, self.many, self.least = parts, many, least
        self.within = sum(float(inner.sum()) for _, _, inner in parts)
        self.count = many * sum(len(v) for v, _, _ in parts)

    @cached_property
    def none(self) -> tuple[float, float]:
        """``lost`` beside no walk."""
        return self.lost(0.0)

    def lost(self, k2: float) -> tuple[float, float]:
        """Negative log-likelihood [nat] beside a walk of ``k2`` a second in units of the white
        variance of a row, and that variance.
        """
        each = [_concentrated(v, d, self.many * k2) for v, d, _ in self.parts]
        logs, powers = zip(*each, strict=True)
        white = max((sum(powers) + self.within) / self.count, self.least)
        return 0.5 * sum(logs) + 0.5 * self.count * float(np.log(white)), white


@njit(cache=True)
def _put_together(values, steps, inner, many):
    """A part of ``_Means`` in means of ``many`` of its means each."""
    count = len(values) // many
    means, apart, within = np.empty(count), np.empty(count), np.empty(count)
    time, before = 0.0, 0.0
    for k in range(count):
        total, middle, left = 0.0, 0.0, 0.0
        for j in range(k * many, (k + 1) * many):
            time += steps[j]
            total, middle = total + values[j], middle + time
        total, middle = total / many, middle / many
        for j in range(k * many, (k + 1) * many):
            left += inner[j] + (values[j] - total) ** 2
        means[k], apart[k] = np.sqrt(many) * total, middle - before if k else 0.0
        within[k], before = left, middle
    return means, apart, within
