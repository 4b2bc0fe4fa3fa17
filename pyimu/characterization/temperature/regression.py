r"""Regression on averages whose noise is white noise N and a random walk K, both found with it.

The average of a walk over an interval is not the walk: with d the interval's duration and P the
variance of what is known of the walk at its start, the average has the variance P + K^2 d / 3, the
walk at the end P + K^2 d, and their covariance is P + K^2 d / 2. (If a random walk observed in
white noise were taken as the model of averages, their steps would be anticorrelated; where the walk
dominates, they have the correlation +1/4: Working, Econometrica 28 (1960), 916-918.) A Kalman
filter of one state makes all columns white.

The share of the walk in the noise is known only as well as the record tells, and not well where
temperature and walk look alike: if the likeliest share is taken for true, five in a hundred records
without an effect become fifteen (test_thermal.py). So everything is averaged over the share. The
weight is the residual likelihood (Patterson and Thompson, Biometrika 58 (1971), 545-554; it does
not count the noise that the regressors follow as less noise) times a prior density of ``share``
that is flat in K / N where that is small, and in N / K where that is small.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from scipy.optimize import brentq
from scipy.special import expit, stdtr, stdtrit

from pyimu.characterization.estimate import Estimate
from pyimu.characterization.temperature.averages import Averages

CHANCE = 1e-3
"""An effect is warranted where noise without it would look so with at most this probability."""

SHARES = 40
"""Number of shares at which the likelihood is computed."""

ALL_WALK = 7.0
"""Largest log odds of the share: white noise is a thousandth of the variance of an average. At the
smallest the walk is lost in the noise of the whole record."""

ROUNDING = 1e-13
"""Share of a sum of squares that cannot be told from zero."""


@njit(cache=True)
def _fill_gram(columns, duration, gap, r, k2, gram):
    """Fill ``gram`` (c, c) with the products of the whitened ``columns`` (m, c).

    Returns the sum of the logarithms of the variances. ``r`` (m,) are the variances of the white
    noise of the averages, ``k2`` is K^2 of the walk.
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
    """Regressions at several ``shares`` (g,) of the walk in the noise, with their ``weights`` (g,).

    Each has ``coefficients`` (g, p), ``inverses`` (g, p, p) of the normal matrices, and
    ``squares`` (g,), the sums of squares of the whitened residuals, with ``freedom`` m - p.
    ``typical`` [s] is the duration of an average in which the noise has variance one.
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
        """The likeliest share."""
        return float(self.shares[np.argmax(self.weights)])

    @property
    def N(self) -> float:
        """White noise [unit sqrt(s)]: the root of its two-sided density."""
        return float(
            np.sqrt(self.weights @ (self.squares * (1 - self.shares)) / self.freedom * self.typical)
        )

    @property
    def K(self) -> float:
        """Random walk [unit/sqrt(s)]."""
        return float(
            np.sqrt(self.weights @ (self.squares * self.shares) / self.freedom * 3 / self.typical)
        )

    @property
    def mean(self) -> np.ndarray:
        """Coefficients (p,), averaged over the shares."""
        return self.weights @ self.coefficients

    @property
    def covariance(self) -> np.ndarray:
        """Covariance (p, p) of the mean, within the shares and between them."""
        apart = self.coefficients - self.mean
        within = np.einsum("g,gij->ij", self.weights * self.squares / self.freedom, self.inverses)
        return within + np.einsum("g,gi,gj->ij", self.weights, apart, apart)

    def tail(self, j: int, value: float) -> float:
        """Probability that coefficient ``j`` is more than ``value``."""
        return float(
            self.weights @ stdtr(self.freedom, (self.coefficients[:, j] - value) / self._stds(j))
        )

    def interval(self, j: int, level: float) -> tuple[float, float]:
        """Limits between which coefficient ``j`` lies with probability ``level``.

        It lies above them as often as below.
        """
        side = (1 - level) / 2
        reach = -stdtrit(self.freedom, side) * 1.001 * self._stds(j)
        ends = (
            float(np.min(self.coefficients[:, j] - reach)),
            float(np.max(self.coefficients[:, j] + reach)),
        )

        def limit(p: float) -> float:
            return brentq(lambda v: self.tail(j, v) - p, *ends, xtol=1e-6 * (ends[1] - ends[0]))

        return limit(1 - side), limit(side)

    def estimates(self, scale: np.ndarray, level: float) -> list[Estimate]:
        """The first coefficients, as many as ``scale`` (k,), multiplied by it."""
        means, stds = self.mean, np.sqrt(np.diag(self.covariance))
        return [
            Estimate(
                float(means[j] * s),
                float(stds[j] * s),
                *(float(s * end) for end in self.interval(j, level)),
            )
            for j, s in enumerate(scale)
        ]

    def _stds(self, j: int) -> np.ndarray:
        return np.sqrt(self.squares / self.freedom * self.inverses[:, j, j])


def regress(
    averages: Averages,
    values: np.ndarray,
    regressors: np.ndarray,
    weights: np.ndarray | None = None,
) -> Regression:
    """Generalised least squares of ``values`` (m,) on ``regressors`` (m, p).

    One column of the regressors is a constant one. ``weights`` are those of the shares that another
    regression on the same averages found; None finds them here.
    """
    typical, (m, p) = float(np.median(averages.duration)), regressors.shape
    shares = expit(np.linspace(-2 * np.log(m) - 2, ALL_WALK, SHARES))
    # Without the bulk of the bias, with which the products would lose their digits.
    level = np.median(values)
    columns = np.column_stack([regressors, values - level])
    constant = np.all(regressors == 1, axis=0)
    duration, gap = averages.duration, averages.gap
    grams, logs = np.empty((SHARES, p + 1, p + 1)), np.empty(SHARES)
    for g, share in enumerate(shares):
        logs[g] = _fill_gram(
            columns, duration, gap, (1 - share) * typical / duration, share * 3 / typical, grams[g]
        )
    freedom, normal, right = m - p, grams[:, :p, :p], grams[:, :p, p]
    inverses = np.linalg.inv(normal)
    fitted = np.einsum("gij,gj->gi", inverses, right)
    # The residual of an exact record is rounding, and must not be zero.
    squares = np.maximum(
        grams[:, p, p] - np.einsum("gi,gi->g", fitted, right), ROUNDING * grams[:, p, p]
    )
    costs = logs + np.linalg.slogdet(normal)[1] + freedom * np.log(squares / freedom)
    coefficients = fitted + level * constant
    if weights is None:
        weights = np.exp((costs.min() - costs) / 2) * np.sqrt(shares * (1 - shares))
        weights /= weights.sum()
    return Regression(shares, weights, coefficients, inverses, squares, freedom, typical)
