r"""Regression on block means whose noise is white noise N and a random walk K, both found with it.

The mean of a walk over a block is not the walk: with d the block's duration and P the variance of
what is known of the walk at its start, the mean has the variance P + K^2 d / 3, the walk at the end
P + K^2 d, and their covariance is P + K^2 d / 2. (A random walk observed in white noise, taken for
the model of means, would have them anticorrelated in steps; where the walk rules, the steps of
means have the correlation +1/4: Working, Econometrica 28 (1960), 916-918.)  A Kalman filter of one
state makes all columns white.

The share of the walk in the noise is not known better than the record tells, and where temperature
and walk look alike that is not well: with the likeliest share taken for true, five in a hundred
records without an effect become fifteen (tests/test_thermal.py). So everything is averaged over
the share, by the residual likelihood (Patterson and Thompson, Biometrika 58 (1971), 545-554; it
does not take the noise that the regressors follow for less noise), times the density of ``share``
that is flat in K / N where that is small, and in N / K where that is.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from scipy.optimize import brentq
from scipy.special import expit
from scipy.stats import t as t_law

from pyimu.characterization.temperature.averages import Blocks

SHARES = 40
"""Places at which the likelihood of the share is taken."""

ALL_WALK = 7.0
"""Log odds at which white noise is a thousandth of the variance of a block; the least are those of
a walk lost in the whole record's noise."""

ROUNDING = 1e-13
"""Of a sum of squares, the share that cannot be told from nothing."""


@njit(cache=True)
def _fill_gram(columns, duration, gap, r, k2, gram):
    """Products (c, c) of the whitened ``columns`` (m, c), into ``gram``; returns the sum of the
    logarithms of the variances.
    """
    m, c = columns.shape
    level, white, p, total = np.zeros(c), np.empty(c), 0.0, 0.0
    gram[:] = 0.0
    for i in range(m):
        p += k2 * gap[i]
        f = p + k2 * duration[i] / 3 + r[i]
        gain = (p + k2 * duration[i] / 2) / f
        p = p + k2 * duration[i] - gain * gain * f
        scale = 1 / np.sqrt(f)
        total += np.log(f)
        for j in range(c):
            v = columns[i, j] - level[j]
            level[j] += gain * v
            white[j] = v * scale
        for j in range(c):
            for k in range(j + 1):
                gram[j, k] += white[j] * white[k]
    for j in range(c):
        for k in range(j):
            gram[k, j] = gram[j, k]
    return total


@dataclass(frozen=True)
class Regression:
    """Regressions at ``shares`` (g,) of the walk in the noise, which have ``weights`` (g,).

    ``coefficients`` (g, p), ``inverses`` (g, p, p) of the normal matrices, ``squares`` (g,) of what
    is left, whitened, with ``freedom`` m - p; ``typical`` s is the duration of a block in which the
    noise has variance one.
    """

    shares: np.ndarray
    weights: np.ndarray
    coefficients: np.ndarray
    inverses: np.ndarray
    squares: np.ndarray
    freedom: int
    typical: float

    @property
    def share(self) -> float:
        """The likeliest."""
        return float(self.shares[np.argmax(self.weights)])

    @property
    def N(self) -> float:
        """White noise, unit sqrt(s): the root of its two-sided density."""
        return float(
            np.sqrt(self.weights @ (self.squares * (1 - self.shares)) / self.freedom * self.typical)
        )

    @property
    def K(self) -> float:
        """Random walk, unit/sqrt(s)."""
        return float(
            np.sqrt(self.weights @ (self.squares * self.shares) / self.freedom * 3 / self.typical)
        )

    @property
    def mean(self) -> np.ndarray:
        """Coefficients (p,)."""
        return self.weights @ self.coefficients

    @property
    def covariance(self) -> np.ndarray:
        """Of the mean, (p, p): within the shares and between them."""
        apart = self.coefficients - self.mean
        within = np.einsum("g,gij->ij", self.weights * self.squares / self.freedom, self.inverses)
        return within + np.einsum("g,gi,gj->ij", self.weights, apart, apart)

    def tail(self, j: int, value: float) -> float:
        """Probability that coefficient ``j`` is more than ``value``."""
        return float(
            self.weights @ t_law.sf((value - self.coefficients[:, j]) / self._stds(j), self.freedom)
        )

    def interval(self, j: int, level: float) -> tuple[float, float]:
        """Limits between which coefficient ``j`` lies with probability ``level``, as often above as
        below.
        """
        reach, side = (
            t_law.isf((1 - level) / 2, self.freedom) * 1.001 * self._stds(j),
            (1 - level) / 2,
        )
        ends = (
            float(np.min(self.coefficients[:, j] - reach)),
            float(np.max(self.coefficients[:, j] + reach)),
        )

        def limit(p: float) -> float:
            return brentq(lambda v: self.tail(j, v) - p, *ends, xtol=1e-6 * (ends[1] - ends[0]))

        return limit(1 - side), limit(side)

    def _stds(self, j: int) -> np.ndarray:
        return np.sqrt(self.squares / self.freedom * self.inverses[:, j, j])


def regress(
    blocks: Blocks, values: np.ndarray, regressors: np.ndarray, weights: np.ndarray | None = None
) -> Regression:
    """Generalised least squares of ``values`` (m,) on ``regressors`` (m, p), one of them ones.

    ``weights`` are those of the shares that another regression on the same blocks found; None finds
    them here.
    """
    typical, (m, p) = float(np.median(blocks.duration)), regressors.shape
    shares = expit(np.linspace(-2 * np.log(m) - 2, ALL_WALK, SHARES))
    # Without the bulk of the bias, which would cost the products their digits.
    level = np.median(values)
    columns, constant = (
        np.column_stack([regressors, values - level]),
        np.all(regressors == 1, axis=0),
    )
    duration, gap = blocks.duration, blocks.gap
    grams, logs = np.empty((SHARES, p + 1, p + 1)), np.empty(SHARES)
    for g, share in enumerate(shares):
        logs[g] = _fill_gram(
            columns, duration, gap, (1 - share) * typical / duration, share * 3 / typical, grams[g]
        )
    freedom, normal, right = m - p, grams[:, :p, :p], grams[:, :p, p]
    inverses = np.linalg.inv(normal)
    fitted = np.einsum("gij,gj->gi", inverses, right)
    # What an exact record leaves is rounding, and never nothing.
    squares = np.maximum(
        grams[:, p, p] - np.einsum("gi,gi->g", fitted, right), ROUNDING * grams[:, p, p]
    )
    costs = logs + np.linalg.slogdet(normal)[1] + freedom * np.log(squares / freedom)
    coefficients = fitted + level * constant
    if weights is None:
        weights = np.exp((costs.min() - costs) / 2) * np.sqrt(shares * (1 - shares))
        weights /= weights.sum()
    return Regression(shares, weights, coefficients, inverses, squares, freedom, typical)
