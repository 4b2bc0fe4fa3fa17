r"""The background of a spectrum: a smooth curve beneath its lines, and what noise makes over it.

A spectrum is looked at on several scales: bin by bin, and in groups of 4, 16, ... bins, in which
lines stand out whose frequency wanders, and narrow bands of noise. The curve is local: at each
place the logarithm of the density is a straight line in log f over the bins around, so that every
power of f is described exactly, and a sum of several nearly. Bins that stand out are left out with
their neighbours, and the curve is fitted again.

Relative to the curve, Welch's estimate of Gaussian noise is a weighted sum of exponentials. Bin by
bin it is the mean of K windows of which neighbours have the correlation r = 1/6 (Hann's window,
half overlap), with the cumulants, in units of the curve,

    1,   (1 + 2 r^2 (K - 1) / K) / K,   2 (1 + 6 r^2 (K - 1) / K) / K^2

Its distribution is taken as the shifted gamma distribution with these three; for groups it is the
gamma distribution with their equivalent averages. The probability that noise alone stands out is
averaged over the standard error of the curve.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.special import digamma, gammaincc, gammainccinv, polygamma

from pyimu.characterization.spectrum.psd import (
    CORRELATION,
    FIRST_BIN,
    REACH,
    Level,
    independent_averages,
)

GUARD = 3
"""Neighbours on either side that a line in the middle reaches, and that say nothing about the noise
beneath it."""

WIDEST, NARROWEST = 64, 16
"""Half widths, in bins or groups, over which the curve is a straight line; the first for the
longest windows."""

COARSEST = 1024
"""Length of a window whose bins are as wide as the widest groups of a longer window."""

HIGHEST, HIGHEST_GROUP = 2, 16
"""Bins and groups below Nyquist that are not searched: in the bins a line meets its own mirror
image; in the groups a density that falls to zero at Nyquist looks like a band."""

OUTLIER = 1e-4
"""Densities that noise makes more rarely than this are left out of the curve."""

FADED = 0.05
"""A broad line ends where noise is as high with this probability, several times in a row."""

ROUNDS = 8
"""The most times that the curve is fitted."""

BAND = 0.16
"""Share of the sample rate up to which a decimated level is flat."""

RULE = np.polynomial.hermite_e.hermegauss(21)
"""Nodes and weights that average over a standard normal."""

SQUARE = float(CORRELATION[0, REACH - 1])
"""r^2."""


@dataclass(frozen=True)
class Scale:
    """One column of a level in groups of ``bins``: ``density`` (m,) about the bins ``k`` (m,).

    The density is the mean of a group. ``searched`` (m,) is the mask of the groups in which lines
    are looked for.
    """

    level: Level
    bins: int
    k: np.ndarray
    density: np.ndarray
    searched: np.ndarray

    @property
    def averages(self) -> float:
        """Equivalent independent averages of a group."""
        return float(independent_averages(self.level.windows, self.bins))

    @property
    def repeated(self) -> float:
        """Ratio of the variance of a long mean to that of as many independent groups."""
        return WIDEST * self.averages / independent_averages(self.level.windows, WIDEST * self.bins)

    @property
    def frequency(self) -> np.ndarray:
        """Frequencies (m,) of the groups [Hz]."""
        return self.k * self.level.resolution


def scales(level: Level, column: int, lowest: int) -> list[Scale]:
    """A column of the level bin by bin, and in groups.

    Groups within ``lowest`` of their own widths of zero, and near Nyquist, are not searched.
    """
    stop, out, bins = int(BAND * level.length) if level.decimated else level.length // 2, [], 1
    while bins == 1 or level.length // bins >= COARSEST:
        count = (stop - FIRST_BIN) // bins
        # Counted from above, where a level has no neighbours to spare.
        k = np.arange(stop - count * bins, stop).reshape(count, bins)
        middle = k.mean(axis=1)
        highest = level.length / 2 - (HIGHEST if bins == 1 else HIGHEST_GROUP) * bins
        searched = (middle >= max(level.first, lowest * bins)) & (middle < min(level.last, highest))
        out.append(Scale(level, bins, middle, level.density[k, column].mean(axis=1), searched))
        bins *= 4
    return out


@dataclass(frozen=True)
class Background:
    """The background of one scale, and the distribution of noise about it.

    ``density`` (m,) is infinite where nothing can be said, ``error`` (m,) is its relative standard
    error. ``averages`` are the equivalent independent averages of an estimate: fewer than the
    scale's where the scatter from group to group is wider than that of stationary noise.
    ``skewness`` is the third cumulant over that of the gamma distribution.
    """

    density: np.ndarray
    error: np.ndarray
    averages: float
    skewness: float

    @property
    def windows(self) -> float:
        """Number of windows that give as many equivalent averages of one bin."""
        return self.averages * (1 + 2 * SQUARE)

    def chance(self, density: np.ndarray) -> np.ndarray:
        """Probability (m,) that noise alone gives as much as ``density`` (m,), each by itself.

        It is set to one where it is more than ``FADED``.
        """
        out, far = np.ones(len(density)), ~self.faded(density)
        out[far] = self._tail(density[far] / self.density[far], self.error[far])
        return out

    def outliers(self, density: np.ndarray) -> np.ndarray:
        """Mask (m,) of densities that noise makes more rarely than ``OUTLIER``.

        The error of the curve is not allowed for.
        """
        return density / self.density > self._limit(OUTLIER)

    def faded(self, density: np.ndarray) -> np.ndarray:
        """Mask (m,) of densities that noise makes more often than ``FADED``."""
        return density / self.density < self._limit(FADED)

    def _limit(self, probability: float) -> float:
        shape, scale = self._gamma
        return 1 + scale * (gammainccinv(shape, probability) - shape)

    def _tail(self, ratio: np.ndarray, error: np.ndarray) -> np.ndarray:
        (shape, scale), (nodes, weights) = self._gamma, RULE
        over = (ratio * np.exp(nodes[:, None] * error) - 1) / scale + shape
        return weights @ gammaincc(shape, np.maximum(over, 0.0)) / weights.sum()

    @property
    def _gamma(self) -> tuple[float, float]:
        return self.averages / self.skewness**2, self.skewness / self.averages


def background(scale: Scale) -> Background:
    """The background at every group of the scale."""
    windows = scale.level.windows
    again = SQUARE * (windows - 1) / windows
    skewness = (1 + 6 * again) / (1 + 2 * again) ** 2 if scale.bins == 1 else 1.0
    found = Background(
        np.full(len(scale.k), np.inf), np.zeros(len(scale.k)), scale.averages, skewness
    )
    if len(scale.k) < 2 * NARROWEST or not np.all(scale.density > 0):
        # Exact zeros, as of a constant: there is no noise to stand out from.
        return found
    line, quiet = _LocalLine(scale), np.ones(len(scale.k), dtype=bool)
    for _ in range(ROUNDS):
        found = line(quiet, found)
        found = replace(found, averages=_effective(scale, found, quiet))
        again = ~_spread(found.outliers(scale.density), GUARD)
        if np.array_equal(again, quiet):
            break
        quiet = again
    return found


class _LocalLine:
    """Straight lines through the logarithms of the densities around each group of a scale."""

    def __init__(self, scale: Scale) -> None:
        count, self.scale = len(scale.k), scale
        half = min(int(np.clip(scale.level.length // 256, NARROWEST, WIDEST)), (count - 1) // 2)
        at = np.arange(count)
        self.near = np.clip(at - half, 0, count - 2 * half - 1)[:, None] + np.arange(2 * half + 1)
        # Near zero and Nyquist, where the density may have a pole and a zero, the line reaches over
        # half the distance to them.
        to_end = np.inf if scale.level.decimated else scale.level.length / 2 - scale.k
        own = np.clip((np.minimum(scale.k, to_end) / scale.bins / 2).astype(int), GUARD + 5, half)
        apart = np.abs(self.near - at[:, None])
        self.weight = ((apart > GUARD) & (apart <= own[:, None])).astype(float)
        k = np.log(scale.k)
        self.x = k[self.near] - k[:, None]
        self.y = np.log(scale.density)[self.near]

    def __call__(self, quiet: np.ndarray, before: Background) -> Background:
        freedom = before.averages
        w = self.weight * quiet[self.near]
        wx = w * self.x
        s0, s1, s2 = w.sum(axis=1), wx.sum(axis=1), np.einsum("ij,ij->i", wx, self.x)
        t0, t1 = np.einsum("ij,ij->i", w, self.y), np.einsum("ij,ij->i", wx, self.y)
        determinant = s0 * s2 - s1**2
        fits = (s0 >= 6) & (determinant > 1e-9 * s0 * s2)
        determinant[~fits] = 1.0
        height = (s2 * t0 - s1 * t1) / determinant - (digamma(freedom) - np.log(freedom))
        error = np.sqrt(s2 / determinant * polygamma(1, freedom) * self.scale.repeated)
        if not fits.any():
            return replace(before, density=np.full(len(fits), np.inf), error=np.zeros(len(fits)))
        # Across a line so strong that it covers all neighbours, from one side to the other.
        k, known = np.log(self.scale.k), np.flatnonzero(fits)
        density, error = (
            np.exp(np.interp(k, k[known], height[known])),
            np.interp(k, k[known], error[known]),
        )
        return replace(before, density=density, error=np.where(fits, error, 2 * error))


def _effective(scale: Scale, found: Background, quiet: np.ndarray) -> float:
    """Equivalent averages of the scale, fewer where the scatter about the curve is too wide.

    Too wide is a scatter beyond what chance makes of the scale's averages; the averages are then
    those that would give it.
    """
    use = quiet & np.isfinite(found.density) & scale.searched
    if use.sum() < 2 * NARROWEST:
        return scale.averages
    expected = polygamma(1, scale.averages)
    scatter = np.log(scale.density[use] / found.density[use])
    wide = np.mean((scatter - scatter.mean()) ** 2) / (expected + np.mean(found.error[use] ** 2))
    # Relative standard error of the variance of a logarithm of few averages, which has heavy tails.
    error = np.sqrt(
        (2 + polygamma(3, scale.averages) / expected**2) * scale.repeated / len(scatter)
    )
    return max(scale.averages / wide, 1.0) if wide > 1 + 4 * error else scale.averages


def _spread(found: np.ndarray, places: int) -> np.ndarray:
    """The mask ``found`` extended by that many ``places`` on either side."""
    return np.convolve(found, np.ones(2 * places + 1), mode="same") > 0.5
