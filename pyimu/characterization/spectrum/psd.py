r"""One-sided power spectral density of a record: Welch's, logarithmically averaged, in bounded
memory.

The record goes through a cascade that keeps every fourth sample of a low-pass filtered copy, then
of that, and so on. On every level windows of ``length`` samples, overlapping by half, give Welch's
estimate (IEEE Trans. Audio Electroacoust. 15 (1967), 70-73)

    S(f_k) = 2 h / (K sum w^2) sum over K windows |sum_t w_t x_t exp(-2 pi i k t / L)|^2

so that high frequencies have many averages and low ones long windows (Troebs and Heinzel,
Measurement 39 (2006), 120-129). Bins are then averaged in groups of equal width in log f.

Nothing is taken off a window but one constant, the same for all windows of a segment: a mean or a
line taken off each would take flicker with it. Hann's window lets a constant reach no bin from the
second on, and makes the density of a random walk, 1 / f^2, too large by 1 / k^2 at bin k: 0.1 % and
less, but for the lowest level, where it is 6 % at ``FIRST_BIN``. A ramp is no noise: it looks like
a density that falls with f^6.

A density of m groups of bins over K windows counts as a chi-square of 2 n degrees of freedom, n the
number of independent averages with the same variance: (K m) / n sums the squared correlations of
windowed white noise over windows and bins.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from scipy.stats import chi2

from pyimu.characterization.spectrum.cascade import DECIMATION, Stage, hann

CHUNK = 2**17
"""Samples of a column that are taken, and wait, at a time."""

SHARE = 32
"""A level is read from bin length / SHARE, where the next one, of four times its resolution,
begins."""

FIRST_BIN = 4
"""The lowest bin that is shown, on the lowest level."""

SHORTEST, LONGEST = 256, 16384
"""Window lengths that are chosen for a record, the longest that it holds sixteen times."""


@dataclass(frozen=True)
class Psd:
    """One-sided densities: ``density`` (m, c) in the square of the samples' unit per Hz at
    ``frequency`` (m,) Hz.

    ``averages`` (m,): equivalent independent averages; an estimate has twice as many degrees of
    freedom. White noise N has the one-sided density 2 N^2.
    """

    frequency: np.ndarray
    density: np.ndarray
    averages: np.ndarray

    def interval(self, probability: float = 0.95) -> tuple[np.ndarray, np.ndarray]:
        """Limits (low, high), each (m, c), that hold the true density at each frequency with this
        probability.
        """
        freedom = 2 * self.averages[:, None]
        side = (1 - probability) / 2
        return self.density * freedom / chi2.isf(side, freedom), self.density * freedom / chi2.ppf(
            side, freedom
        )


@dataclass(frozen=True)
class Level:
    """All bins of one level: one-sided ``density`` (length / 2 + 1, c) of ``windows`` windows of
    ``length`` samples ``h`` s apart.

    ``first`` and ``last`` are the bins it is read from and to (the latter excluded).
    """

    density: np.ndarray
    windows: int
    length: int
    h: float
    first: int
    last: int

    @property
    def resolution(self) -> float:
        """Hz from bin to bin."""
        return 1 / (self.length * self.h)

    @property
    def decimated(self) -> bool:
        """Whether it comes out of the filter, and holds nothing near its Nyquist frequency."""
        return self.last < self.length // 2

    @cached_property
    def averages(self) -> float:
        """Equivalent independent averages of one bin."""
        return float(independent_averages(self.windows, 1))


def psd_one_sided(
    samples: np.ndarray,
    h: float,
    segments: Sequence[tuple[int, int]] | None = None,
    points_per_decade: int = 20,
) -> Psd:
    """Density of ``samples`` (n,) or (n, c), ``h`` s apart, over index ranges (start, stop) without
    gap; see ``SpectrumAccumulator``.

    A result without a single frequency means that no segment is as long as a window.
    """
    return accumulate(samples, h, segments).result(points_per_decade)


def accumulate(
    samples: np.ndarray, h: float, segments: Sequence[tuple[int, int]] | None = None
) -> SpectrumAccumulator:
    """The accumulator of a whole record, with a window length chosen for its longest segment;
    arguments as ``psd_one_sided``.
    """
    segments = [(0, len(samples))] if segments is None else list(segments)
    spectrum = SpectrumAccumulator(h, window_length(max((b - a for a, b in segments), default=0)))
    for a, b in segments:
        spectrum.add(samples[a:b])
        spectrum.end_segment()
    return spectrum


def window_length(n: int) -> int:
    """A power of two for a segment of ``n`` samples."""
    return int(np.clip(2 ** int(np.log2(max(n, 16) / 16)), SHORTEST, LONGEST))


class SpectrumAccumulator:
    """Densities of a record that comes in pieces: ``add(block)`` for each, ``end_segment()`` where
    it is interrupted, ``result()``.

    Samples ``h`` s apart; windows of ``length`` samples, a power of two from 256. A row with a
    value that is not finite ends a segment, for all columns; no window and no filter reaches
    across. Memory: some 3 ``CHUNK`` samples a column.
    """

    def __init__(self, h: float, length: int = LONGEST) -> None:
        if length < SHORTEST or length & (length - 1):
            raise ValueError(
                f"a window of {length} samples: a power of two from {SHORTEST} on is asked for"
            )
        self.h, self.length = float(h), length
        self._stages: list[Stage] = []
        self._offset: np.ndarray | None = None

    def add(self, block: np.ndarray) -> None:
        """The next samples (k,) or (k, c); raises ValueError for another number of columns than
        before.
        """
        block = np.asarray(block)
        rows = block[:, None] if block.ndim == 1 else block
        if not self._stages:
            self._stages.append(Stage(self.length, rows.shape[1], CHUNK))
        if rows.shape[1] != self._stages[0].columns:
            raise ValueError(f"{rows.shape[1]} columns after {self._stages[0].columns}")
        for a in range(0, len(rows), CHUNK):
            self._add(np.array(rows[a : a + CHUNK].T, dtype=float, order="C"))

    def end_segment(self) -> None:
        """The next sample does not follow the last one."""
        self._offset = None
        for stage in self._stages:
            stage.forget()

    def _add(self, x: np.ndarray) -> None:
        """Samples (c, k): columns apart, so that both the transform and the filter run along
        memory.
        """
        whole = np.isfinite(x).all(axis=0)
        if whole.all():
            return self._run(x)
        edges = np.flatnonzero(np.diff(whole, prepend=False, append=False))
        for a, b in zip(edges[::2], edges[1::2], strict=True):
            if a > 0:
                self.end_segment()
            self._run(x[:, a:b].copy())
        if not whole[-1]:
            self.end_segment()

    def _run(self, x: np.ndarray) -> None:
        if not x.shape[1]:
            return
        if self._offset is None:
            self._offset = x[:, :1].copy()
        x -= self._offset
        self._pass(x, 0)

    def _pass(self, x: np.ndarray, level: int) -> None:
        if level == len(self._stages):
            self._stages.append(Stage(self.length, len(x), CHUNK // DECIMATION**level))
        kept = self._stages[level].take(x)
        if kept.shape[1]:
            self._pass(kept, level + 1)

    def levels(self) -> list[Level]:
        """Every level that had a window, from the highest rate on."""
        for stage in self._stages:
            stage.transform()
        filled = [s for s in self._stages if s.windows]
        w = hann(self.length)
        out = []
        for j, stage in enumerate(filled):
            h = self.h * DECIMATION**j
            density = stage.power * (2 * h / (stage.windows * np.sum(w**2)))
            first = self.length // SHARE if j + 1 < len(filled) else FIRST_BIN
            # The bin at Nyquist has no mirror image.
            last = self.length // 2 if j == 0 else self.length * DECIMATION // SHARE
            out.append(Level(density.T, stage.windows, self.length, h, first, last))
        return out

    def result(self, points_per_decade: int = 20) -> Psd:
        """The density so far, by rising frequency; more may be added afterwards."""
        columns = self._stages[0].columns if self._stages else 1
        parts = [_grouped(level, points_per_decade) for level in reversed(self.levels())]
        if not parts:
            return Psd(np.empty(0), np.empty((0, columns)), np.empty(0))
        return Psd(*(np.concatenate(p) for p in zip(*parts, strict=True)))


def _grouped(level: Level, points_per_decade: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Frequencies, densities and averages of groups of a level's bins, edges on one grid for all
    levels.
    """
    k = np.arange(level.first, level.last)
    cell = np.floor(points_per_decade * np.log10(k / level.last) + 1e-9)
    starts = np.flatnonzero(np.diff(cell, prepend=-np.inf))
    sizes = np.diff(np.append(starts, len(k)))
    frequency = np.add.reduceat(k, starts) / sizes * level.resolution
    density = (
        np.add.reduceat(level.density[level.first : level.last], starts, axis=0) / sizes[:, None]
    )
    return frequency, density, np.array([independent_averages(level.windows, m) for m in sizes])


@lru_cache(maxsize=1024)
def independent_averages(windows: int, bins: int) -> float:
    """Of ``windows`` overlapping windows and ``bins`` adjoining bins of white noise."""
    j, d = np.arange(-1, 2), np.arange(-min(bins, REACH) + 1, min(bins, REACH))
    weights = np.outer(np.maximum(windows - np.abs(j), 0), bins - np.abs(d))
    return (windows * bins) ** 2 / float(np.sum(weights * CORRELATION[:, d + REACH - 1]))


REACH = 8
"""Bins from which on two are independent."""


def _correlations() -> np.ndarray:
    """Squared correlations (3, 2 REACH - 1) of bins of windows -1, 0, 1 half windows and up to
    REACH - 1 bins apart.
    """
    w, half = hann(SHORTEST), SHORTEST // 2
    t, d = np.arange(SHORTEST), np.arange(-REACH + 1, REACH)
    products = np.array(
        [
            np.append(w[half:] * w[:half], np.zeros(half)),
            w * w,
            np.append(np.zeros(half), w[half:] * w[:half]),
        ]
    )
    return (
        np.abs(products @ np.exp(2j * np.pi * np.outer(t, d) / SHORTEST)) ** 2 / np.sum(w**2) ** 2
    )


CORRELATION = _correlations()
