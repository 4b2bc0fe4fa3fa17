"""Tails and quantiles of the laws that intervals, gates and tests are made of.

``scipy.stats`` has them under the same names, by the same functions of ``scipy.special``. Importing
it makes an object of each of a hundred laws, which takes a third of a second, and its calls look at
their arguments for longer than they compute: who reads a log need not wait for either.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike
from scipy import special


class chi2:
    """Chi squared with ``df`` degrees of freedom."""

    @staticmethod
    def sf(x: ArrayLike, df: ArrayLike) -> np.ndarray:
        """The probability above ``x``."""
        return special.chdtrc(df, x)

    @staticmethod
    def isf(p: ArrayLike, df: ArrayLike) -> np.ndarray:
        """What is exceeded with the probability ``p``."""
        return special.chdtri(df, p)

    @staticmethod
    def ppf(p: ArrayLike, df: ArrayLike) -> np.ndarray:
        """What is not exceeded with the probability ``p``."""
        return 2 * special.gammaincinv(np.divide(df, 2), p)

    @staticmethod
    def logcdf(x: ArrayLike, df: ArrayLike) -> np.ndarray:
        """The logarithm of the probability below ``x``."""
        return _log(special.chdtr(df, x), special.chdtrc(df, x))

    @staticmethod
    def logsf(x: ArrayLike, df: ArrayLike) -> np.ndarray:
        """The logarithm of the probability above ``x``."""
        return _log(special.chdtrc(df, x), special.chdtr(df, x))

    @staticmethod
    def logpdf(x: ArrayLike, df: ArrayLike) -> np.ndarray:
        """The logarithm of the density at ``x``, above zero."""
        half, x = np.divide(df, 2), np.asarray(x)
        return special.xlogy(half - 1, x) - x / 2 - special.gammaln(half) - math.log(2) * half


class norm:
    """The standard normal law."""

    @staticmethod
    def pdf(x: ArrayLike) -> np.ndarray:
        """The density at ``x``."""
        return np.exp(-np.square(x) / 2) / math.sqrt(2 * math.pi)

    @staticmethod
    def sf(x: ArrayLike) -> np.ndarray:
        """The probability above ``x``."""
        return special.ndtr(np.negative(x))

    @staticmethod
    def isf(p: ArrayLike) -> np.ndarray:
        """What is exceeded with the probability ``p``."""
        return -special.ndtri(p)

    @staticmethod
    def ppf(p: ArrayLike) -> np.ndarray:
        """What is not exceeded with the probability ``p``."""
        return special.ndtri(p)


class beta:
    """The beta law."""

    @staticmethod
    def sf(x: ArrayLike, a: ArrayLike, b: ArrayLike) -> np.ndarray:
        """The probability above ``x``."""
        return special.betaincc(a, b, x)


class f:
    """Fisher's law of the ratio of two variances."""

    @staticmethod
    def sf(x: ArrayLike, above: ArrayLike, below: ArrayLike) -> np.ndarray:
        """The probability above ``x``, by the degrees of freedom above and below the stroke."""
        return special.fdtrc(above, below, x)

    @staticmethod
    def ppf(p: ArrayLike, above: ArrayLike, below: ArrayLike) -> np.ndarray:
        """What is not exceeded with the probability ``p``."""
        return special.fdtri(above, below, p)


class t:
    """Student's law with ``df`` degrees of freedom."""

    @staticmethod
    def sf(x: ArrayLike, df: ArrayLike) -> np.ndarray:
        """The probability above ``x``."""
        return special.stdtr(df, np.negative(x))

    @staticmethod
    def isf(p: ArrayLike, df: ArrayLike) -> np.ndarray:
        """What is exceeded with the probability ``p``."""
        return -special.stdtrit(df, p)


def _log(p: np.ndarray, rest: np.ndarray) -> np.ndarray:
    """The logarithm of a probability, near one from the ``rest``."""
    with np.errstate(divide="ignore"):
        return np.where(p < 0.5, np.log(p), np.log1p(-rest))
