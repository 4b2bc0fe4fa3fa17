r"""The distribution of the overlapping Allan variance of Gaussian noise of known density.

The estimator is the mean of the squares of d_j = (mean of rates j + m to j + 2m - 1, less that of j
to j + m - 1) / sqrt(2), which is a stationary series with autocovariance

    R(l) = int_{-1/2h}^{1/2h} S(f) 2 sin^4(pi f m h) / (m sin(pi f h))^2 cos(2 pi f l h) df

whatever the noise, provided that S f^2 is finite at zero: a random walk and a stationary flicker
are covered, a rate ramp is no noise. The mean of the estimate is R(0) and, over M = n - 2m + 1
terms, its variance 2 / M^2 sum_l (M - |l|) R(l)^2 (Isserlis' theorem). It is a weighted sum of
squared normals, the weights being the eigenvalues of R's M x M Toeplitz matrix over M.

Where the equivalent degrees of freedom 2 E^2 / Var are many, its quantiles are taken as those of
the shifted and scaled chi-square with the same first three cumulants (Hall, Buckley and Eagleson;
Buckley and Eagleson, Austral. J. Statist. 30A (1988), 150-159). Where they are few, they come from
the saddlepoint approximation on the eigenvalues (Lugannani and Rice, Adv. Appl. Probab. 12 (1980),
475-490; Kuonen, Biometrika 86 (1999), 929-935). The eigenvalues are those of d at a hundred places,
spread about the mean to the exact variance. The tail probability of a limit is then right to a
sixth of itself (test_allan.py compares it with the exact law). The usual chi-square of those
degrees of freedom lacks the skewness: at one in ten thousand its upper limit is passed two to three
times as often, its lower one hardly ever.

Noise that is not Gaussian but has lighter tails, such as rounding, varies less: its limits hold
with more than the probability asked for.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.fft import dct
from scipy.linalg import eigvalsh, toeplitz
from scipy.optimize import brentq

from pyimu.numerics.laws import chi2, norm
from pyimu.shaping import allan_deviation

Density = Callable[[np.ndarray], np.ndarray]

PLACES = 128
"""Places of d that stand for all, as many as linear algebra handles on one processor without delay.
They are the middles of equal shares of the record where that is a few clusters long, else they are
``SPLIT`` to a cluster."""

SPLIT = 16
"""Places in a cluster, where the record is many clusters long."""

MANY = 100
"""Equivalent degrees of freedom from which three cumulants are enough."""

GRID = 4
"""Frequencies up to Nyquist, per sample of the record."""


@dataclass(frozen=True)
class AllanLaw:
    """The distribution of the overlapping Allan variance of one cluster size.

    ``mean`` and ``variance`` are exact. ``matrix`` is the covariance of d at fewer places, whose
    sum of squares has the shape (not the size) of the distribution of the estimate.
    """

    mean: float
    variance: float
    matrix: np.ndarray

    @property
    def edf(self) -> float:
        """Equivalent degrees of freedom."""
        return 2 * self.mean**2 / self.variance

    def quantile(self, lower: float, upper: float) -> tuple[float, float]:
        """The limits below and above which the estimate falls with these probabilities.

        ``lower`` and ``upper`` are at most 1/4.
        """
        quantiles = _three_cumulants if self.edf >= MANY else _saddlepoint
        low, high = quantiles(self.matrix, self.edf, lower, upper)
        spread = np.sqrt(self.variance)
        return max(self.mean + low * spread, 0.0), self.mean + high * spread


def allan_band(
    psd: Density, taus: np.ndarray, n: int, h: float, probability: float
) -> tuple[np.ndarray, np.ndarray]:
    """Simultaneous limits (low, high), each (t,), of the overlapping Allan deviations.

    All the deviations lie between them with at least ``probability`` (Bonferroni, half of the rest
    on either side). ``psd(f)`` is the two-sided density of the Gaussian noise at f > 0 in Hz,
    ``taus`` (t,) are the cluster times in s, multiples of the sample period ``h`` [s], of a record
    of ``n`` samples. Raises ValueError where a tau is no multiple of h from h to n h / 2, or the
    probability not in (0, 1).
    """
    if not 0 < probability < 1:
        raise ValueError(f"the probability {probability} is not between 0 and 1")
    side = (1 - probability) / (2 * np.size(taus))
    limits = np.array([law.quantile(side, side) for law in allan_laws(psd, taus, n, h)])
    return np.sqrt(limits[:, 0]), np.sqrt(limits[:, 1])


def allan_laws(psd: Density, taus: np.ndarray, n: int, h: float) -> list[AllanLaw]:
    """The distribution of the overlapping Allan variance at each cluster time.

    Arguments and errors are those of ``allan_band``. Time and memory grow as 4 n log n.
    """
    taus = np.atleast_1d(np.asarray(taus, dtype=float))
    m = np.rint(taus / h).astype(int)
    if np.any(m < 1) or np.any(2 * m > n) or np.any(np.abs(m * h - taus) > 1e-6 * taus):
        raise ValueError(
            f"cluster times must be multiples of the sample period {h:g} s up to {n // 2 * h:g} s"
        )
    points = 1 << int(np.ceil(np.log2(GRID * n)))
    # Half a step away from the pole that a random walk has at zero.
    x = np.pi * (np.arange(points) + 0.5) / (2 * points)
    weighted = psd(x / (np.pi * h)) / (points * h * np.sin(x) ** 2)
    means = allan_deviation(psd, m * h, h) ** 2
    return [_law(weighted, x, size, n, mean) for size, mean in zip(m, means, strict=True)]


def _law(weighted: np.ndarray, x: np.ndarray, m: int, n: int, mean: float) -> AllanLaw:
    """The distribution for clusters of m samples in a record of n.

    ``weighted`` is the density over sin^2(x), x = pi f h, times the weights of the integral.
    """
    # The type-2 cosine transform is twice the sum over the grid, the integral over both signs.
    squared = np.sin(m * x) ** 2
    r = dct(weighted * squared * squared, type=2)[: n - 2 * m + 1] / m**2
    # A process slower than the record has a line at zero that the grid is too coarse for. What is
    # missing is a covariance that is nearly the same at all lags.
    r += mean - r[0]
    terms = len(r)
    variance = (
        2 / terms**2 * (terms * r[0] ** 2 + 2 * np.sum((terms - np.arange(1, terms)) * r[1:] ** 2))
    )
    few = 2 * r[0] ** 2 / variance < MANY
    # The middles of equal shares of the record stand for it better than every so many samples.
    apart = max(terms / PLACES, 1.0) if few else -(-m // SPLIT)
    lags = apart * np.arange(min(PLACES, int(terms / apart)))
    return AllanLaw(r[0], variance, toeplitz(np.interp(lags, np.arange(terms), r)))


def _three_cumulants(
    matrix: np.ndarray, edf: float, lower: float, upper: float
) -> tuple[float, float]:
    """Quantiles, in standard deviations from the mean, of a chi-square as skew as the estimate.

    With eigenvalues w, (sum w)(sum w^3) / (sum w^2)^2 hardly depends on how many clusters there
    are. It is one for a chi-square; its square is the factor by which the squared skewness exceeds
    8 / edf.
    """
    square = matrix @ matrix
    shape = np.trace(matrix) * np.sum(square * matrix) / np.trace(square) ** 2
    freedom = edf / shape**2
    return tuple(
        (q - freedom) / np.sqrt(2 * freedom)
        for q in (chi2.ppf(lower, freedom), chi2.isf(upper, freedom))
    )


def _saddlepoint(matrix: np.ndarray, edf: float, lower: float, upper: float) -> tuple[float, float]:
    """Quantiles, in standard deviations from the mean, of a weighted sum of squared normals.

    The weights w are the eigenvalues of ``matrix``. With K(t) = -1/2 sum log(1 - 2 t w), the
    quantile is K'(t) at the t where Lugannani and Rice's tail probability is the one given.
    """
    w = eigvalsh(matrix)
    w = w[w > 1e-12 * w[-1]] / w[-1]
    low = _sum_at(w, brentq(lambda v: _tail(w, v) - lower, -60.0, -1e-2))
    high = _sum_at(w, brentq(lambda v: _tail(w, v) - upper, 1e-2, 30.0))
    mean, spread = np.sum(w), np.sqrt(2 * np.sum(w**2))
    return (low - mean) / spread, (high - mean) / spread


def _rest(v: float) -> float:
    """1 - 2 t, where v replaces t as the variable and the largest weight is 1.

    v runs from minus infinity, as t does, to infinity, where t approaches its pole at 1/2.
    """
    return np.exp(-v)


def _sum_at(w: np.ndarray, v: float) -> float:
    """K'(t)."""
    return np.sum(w / (1 - w + w * _rest(v)))


def _tail(w: np.ndarray, v: float) -> float:
    """The probability beyond K'(t), on the side of the sign of v."""
    left, t = 1 - w + w * _rest(v), -np.expm1(-v) / 2
    k, first, second = -0.5 * np.sum(np.log(left)), np.sum(w / left), 2 * np.sum((w / left) ** 2)
    r = np.sqrt(2 * (t * first - k))
    return norm.sf(r) + norm.pdf(r) * (1 / (abs(t) * np.sqrt(second)) - 1 / r)
