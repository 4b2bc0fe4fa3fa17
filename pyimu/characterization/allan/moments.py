r"""Mean and covariance of overlapping Allan variances, in closed form.

The noise is made of the five terms Q, N, B, K, R. The sum of the rates, as a function of the
sample, has for each term a generalised covariance G(u) of lag u samples:

    Q^2 [u = 0],    -N^2 |u| / 2,    B^2 / (2 pi) u^2 ln|u|,    K^2 (|u|^3 - |u|) / 12

and, for Gauss-Markov noise of standard deviation s with a = exp(-1 / T), T its correlation time,

    -s^2 a^(1 + |u|) / (1 - a)^2 - s^2 (1 + a) / (1 - a) |u| / 2

whose second difference is minus its autocovariance s^2 a^|u|. All are in units in which the sample
period is one (an intrinsic random function: Matheron, Adv. Appl. Probab. 5 (1973), 439-468). That
of flicker belongs to a density B^2 / (2 pi f) at all frequencies, the others are exact for samples.
The estimate for clusters of m is the mean of the squares of d_j,
the second differences of that sum over sqrt(2) m. The differences for clusters of m and m', at
places u apart (from centre to centre), have the covariance

    R(u) = second difference by m of the second difference by m' of G, at u, over 2 m m'.

A ramp is no noise: it gives all d the mean R m / sqrt(2). By Isserlis' theorem the covariance of
two estimates is the mean over all pairs of places of 2 R(u)^2 + 4 (product of the means) R(u). R is
smooth except at u = 0, m, m' - m, m', m' + m. Around these the terms are summed one by one, in
between by the Gauss-Legendre rule, so that a record of a day takes as long as one of a minute.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache, partial
from itertools import pairwise

import numpy as np
from scipy.special import xlogy

TERMS = "QNBKR"
"""Quantization, angle random walk, bias instability, rate random walk, rate ramp (IEEE Std 952)."""

MARKOV = "GH"
"""Gauss-Markov noise, at most two of it, where it is looked for: behind the five, by its standard
deviation."""

RAMP = TERMS.index("R")
"""The one that is no noise."""

NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)

SUMMED = 64
"""Up to so many consecutive lags are summed one by one; for more an integral agrees with the sum
to (1 / SUMMED)^2."""

OCTAVES = 8
"""Octaves of lags beyond m + m' that are summed. Only flicker has an R other than zero there, and
it falls with the square of the lag."""


@dataclass(frozen=True)
class AllanMoments:
    """Means and covariances of the Allan variances at cluster sizes ``m`` (t,).

    They follow from the squares (k,) of the coefficients, for a sample period of one: the means
    through ``design`` (t, k), the covariances through ``products`` (k - 1, k - 1, t, t) and
    ``sums`` (k - 1, t, t), in which the ramp is left out. The first five are those of ``TERMS``,
    the others variances of Gauss-Markov noise.
    """

    m: np.ndarray
    design: np.ndarray
    products: np.ndarray
    sums: np.ndarray

    def covariance(self, squares: np.ndarray) -> np.ndarray:
        """Covariance (t, t) of the Allan variances of noise with these squares (k,)."""
        # Products of matrices, as fits ask for it thousands of times.
        noise, t = np.concatenate((squares[:RAMP], squares[RAMP + 1 :])), len(self.m)
        spread = np.outer(noise, noise).ravel() @ self.products.reshape(-1, t * t)
        if squares[RAMP]:
            area = np.outer(self.m, self.m).ravel()
            spread += squares[RAMP] * area * (noise @ self.sums.reshape(-1, t * t))
        return 2 * spread.reshape(t, t)


def moments(clusters: np.ndarray, n: int, times: tuple[float, ...] = ()) -> AllanMoments:
    """The moments for a record of ``n`` samples at cluster sizes (t,).

    ``times`` are the correlation times of Gauss-Markov noise beside the five terms, in samples.
    Raises ValueError for a cluster size that is no whole number from 1 to n / 2.
    """
    m = np.atleast_1d(clusters)
    if np.any(m != np.floor(m)) or np.any(m < 1) or np.any(2 * m > n):
        raise ValueError(f"cluster sizes must be whole numbers from 1 to {n // 2} for {n} samples")
    return _moments(tuple(int(k) for k in m), int(n), tuple(times))


@lru_cache(maxsize=16)
def _moments(sizes: tuple[int, ...], n: int, times: tuple[float, ...]) -> AllanMoments:
    t, m = len(sizes), np.array(sizes, dtype=float)
    markov = partial(_gauss_markov, time=np.array(times)[:, None])
    k = len(SECOND_DIFFERENCES) + len(times)
    products, sums = np.empty((k, k, t, t)), np.empty((k, t, t))
    for a in range(t):
        for b in range(a, t):
            u, weight = _lags(min(sizes[a], sizes[b]), max(sizes[a], sizes[b]), n)
            r = np.array([_cross(second, u, m[a], m[b]) for second in SECOND_DIFFERENCES])
            if times:
                r = np.vstack([r, _cross(markov, u, m[a], m[b])])
            products[:, :, a, b] = products[:, :, b, a] = (r * weight) @ r.T
            sums[:, a, b] = sums[:, b, a] = r @ weight
    return AllanMoments(m, design(m, times), products, sums)


def design(m: np.ndarray, times: tuple[float, ...] = ()) -> np.ndarray:
    """Allan variances (t, 5 + k) of the terms with coefficients of one, for clusters of m (t,)
    samples.

    The sample period is one (Hidalgo 2012, table 3; the random walk's as its samples have it). The
    k last are those of Gauss-Markov noise of these correlation ``times``.
    """
    flat = np.full(np.shape(m), 2 * np.log(2) / np.pi)
    five = (3 / m**2, 1 / m, flat, m / 3 + 1 / (6 * m), m**2 / 2)
    return np.column_stack([*five, *(_markov_variance(m, time) for time in times)])


def _markov_variance(m: np.ndarray, time: float) -> np.ndarray:
    """R(0) of Gauss-Markov noise, its Allan variances (t,)."""
    m = np.asarray(m, dtype=float)
    far, middle = (_gauss_markov(u, m, time) for u in (m, 0 * m))
    return (far - middle) / m**2


def _lags(m: int, wide: int, n: int) -> tuple[np.ndarray, np.ndarray]:
    """Lags u >= 0 and weights that average an even function of u over all pairs of places.

    The places are those of the differences for clusters of ``m`` <= ``wide`` in n samples.
    """
    places = (n - 2 * m + 1, n - 2 * wide + 1)
    reach = sum(places) / 2  # the number of pairs falls to nothing there
    octaves = (m + wide) * 2 ** np.arange(1, OCTAVES + 1)
    ends = np.unique(np.minimum([0, m, wide - m, wide, m + wide, *octaves], np.ceil(reach)))
    parts = [(ends, np.ones(len(ends))), *(_between(a, b) for a, b in pairwise(ends))]
    u, weight = (np.concatenate(p) for p in zip(*parts, strict=True))
    pairs = np.clip(reach - u, 0, min(places))
    return u, weight * np.where(u > 0, 2, 1) * pairs / np.prod(places, dtype=float)


def _between(a: float, b: float) -> tuple[np.ndarray, np.ndarray]:
    """Lags and weights that sum a function over the whole numbers between a and b, ends excluded.

    Where they are many, these are nodes and weights of the integral from a + 1/2 to b - 1/2.
    """
    count = int(b - a) - 1
    if count <= SUMMED:
        return np.arange(a + 1, b), np.ones(count)
    return (a + b) / 2 + count / 2 * NODES, count / 2 * WEIGHTS


def _cross(second: Callable, u: np.ndarray, m: float, wide: float) -> np.ndarray:
    """R at lags u of one term with a coefficient of one, from its second difference of G."""
    m, wide = min(m, wide), max(m, wide)
    return (second(u + wide, m) - 2 * second(u, m) + second(u - wide, m)) / (2 * m * wide)


def _quantization(u: np.ndarray, m: float) -> np.ndarray:
    """Second difference by m of G of quantization, [u = 0].

    The three functions below are those of the other G of the module's docstring, less what
    cancels.
    """
    return np.where(np.abs(u) == m, 1.0, 0.0) - np.where(u == 0, 2.0, 0.0)


def _white(u: np.ndarray, m: float) -> np.ndarray:
    return -np.maximum(m - np.abs(u), 0.0)


def _flicker(u: np.ndarray, m: float) -> np.ndarray:
    return (_square_log(u + m) - 2 * _square_log(u) + _square_log(u - m)) / (2 * np.pi)


def _square_log(u: np.ndarray) -> np.ndarray:
    return xlogy(u**2, np.abs(u))


def _random_walk(u: np.ndarray, m: float) -> np.ndarray:
    far = np.abs(u)
    cube = np.where(far >= m, 6 * far * m**2, 2 * m**3 + 6 * m * u**2 - 2 * far**3)
    return cube / 12 + _white(u, m) / 6


def _gauss_markov(u: np.ndarray, m: float, time: float | np.ndarray) -> np.ndarray:
    a, lost = np.exp(-1 / time), -np.expm1(-1 / time)
    far = np.abs(u)
    hump = sum(
        weight * np.expm1(-size / time)
        for weight, size in ((1, abs(u + m)), (-2, far), (1, abs(u - m)))
    )
    return (1 + a) / lost * _white(u, m) - a / lost**2 * hump


SECOND_DIFFERENCES = (_quantization, _white, _flicker, _random_walk)
