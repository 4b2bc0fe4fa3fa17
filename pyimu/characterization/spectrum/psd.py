r"""One-sided power spectral density of a record: Welch's estimate, logarithmically averaged.

The memory that it takes is bounded. The record goes through a cascade that keeps every fourth
sample of a low-pass filtered copy, then of that, and so on. On every level windows of ``length``
samples, overlapping by half, give Welch's estimate (IEEE Trans. Audio Electroacoust. 15 (1967),
70-73)

    S(f_k) = 2 h / (K sum w^2) sum over K windows |sum_t w_t x_t exp(-2 pi i k t / L)|^2

so that high frequencies have many averages and low ones long windows (Troebs and Heinzel,
Measurement 39 (2006), 120-129). Bins are then averaged in groups of equal width in log f.

Nothing is subtracted from a window but one constant, the same for all windows of a segment: a mean
or a line subtracted from each would take flicker with it. With Hann's window a constant reaches no
bin from the second on, and the density of a random walk, 1 / f^2, comes out too large by 1 / k^2 at
bin k: by 0.1 % and less, except on the lowest level, where it is 6 % at ``FIRST_BIN``. A ramp is no
noise: it looks like a density that falls with f^6.

A density of m groups of bins over K windows counts as a chi-square of 2 n degrees of freedom, n the
number of independent averages with the same variance: (K m) / n sums the squared correlations of
windowed white noise over windows and bins.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from pyimu.characterization.spectrum.cascade import DECIMATION, Stage, hann
from pyimu.display.brief import Brief
from pyimu.numerics.laws import chi2

PIECE = 2**17
"""Samples of a column that are processed, and wait, at a time."""

SHARE = 32
"""A level is read from bin length / SHARE on; below, the next level has four times its
resolution."""

FIRST_BIN = 4
"""The lowest bin that is read on the lowest level."""

SHORTEST, LONGEST = 256, 16384
"""Limits of the window length, which is otherwise the longest that a record holds sixteen times."""


@dataclass(frozen=True, repr=False)
class Psd(Brief):
    """One-sided densities (m, c), in the square of the samples' unit per Hz.

    They are at ``frequency`` (m,) Hz. ``averages`` (m,) are the equivalent independent averages; an
    estimate has twice as many degrees of freedom. White noise N has the one-sided density 2 N^2.
    """

    frequency: np.ndarray
    density: np.ndarray
    averages: np.ndarray

    def interval(self, probability: float = 0.95) -> tuple[np.ndarray, np.ndarray]:
        """Limits (low, high), each (m, c), of the true density at each frequency.

        Each pair holds it with this ``probability``.
        """
        freedom = 2 * self.averages[:, None]
        side = (1 - probability) / 2
        return self.density * freedom / chi2.isf(side, freedom), self.density * freedom / chi2.ppf(
            side, freedom
        )


@dataclass(frozen=True)
class Level:
    """All bins of one level of the cascade: one-sided ``density`` (length / 2 + 1, c).

    It comes from ``windows`` windows of ``length`` samples ``h`` s apart, and is read from bin
    ``first`` to bin ``last`` (excluded).
    """

    density: np.ndarray
    windows: int
    length: int
    h: float
    first: int
    last: int

    @property
    def resolution(self) -> float:
        """Distance of the bins [Hz]."""
        return 1 / (self.length * self.h)

    @property
    def decimated(self) -> bool:
        """Whether its samples were filtered, and hold nothing near their Nyquist frequency."""
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
    """One-sided density of ``samples`` (n,) or (n, c), ``h`` s apart; see ``SpectrumAccumulator``.

    ``segments`` are row ranges (start, stop) without gap, None for all rows. A result without a
    single frequency means that no segment is as long as a window.
    """
    return accumulate(samples, h, segments).result(points_per_decade)


def accumulate(
    samples: np.ndarray, h: float, segments: Sequence[tuple[int, int]] | None = None
) -> SpectrumAccumulator:
    """The accumulator of a whole record, its window length chosen for the longest segment.

    Arguments are those of ``psd_one_sided``.
    """
    segments = [(0, len(samples))] if segments is None else list(segments)
    spectrum = SpectrumAccumulator(h, window_length(max((b - a for a, b in segments), default=0)))
    for a, b in segments:
        spectrum.add(samples[a:b])
        spectrum.end_segment()
    return spectrum


def window_length(n: int) -> int:
    """The window length, a power of two, for a segment of ``n`` samples."""
    return int(np.clip(2 ** int(np.log2(max(n, 16) / 16)), SHORTEST, LONGEST))


class SpectrumAccumulator:
    """One-sided densities of a record that comes in pieces.

    Call ``add(piece)`` for each, ``end_segment()`` where the record is interrupted, and
    ``result()``. Samples are ``h`` s apart; windows have ``length`` samples, a power of two from
    256 on. A row with a value that is not finite ends a segment, for all columns; no window and no
    filter reaches across. Memory: some 3 ``PIECE`` samples a column.
    """

    def __init__(self, h: float, length: int = LONGEST) -> None:
        if length < SHORTEST or length & (length - 1):
            raise ValueError(
                f"a window of {length} samples: a power of two from {SHORTEST} on is asked for"
            )
        self.h, self.length = float(h), length
        self._stages: list[Stage] = []
        self._offset: np.ndarray | None = None

    def add(self, piece: np.ndarray) -> None:
        """Add the next samples (k,) or (k, c).

        Raises ValueError for another number of columns than before.
        """
        piece = np.asarray(piece)
        rows = piece[:, None] if piece.ndim == 1 else piece
        if not self._stages:
            self._stages.append(Stage(self.length, rows.shape[1], PIECE))
        if rows.shape[1] != self._stages[0].columns:
            raise ValueError(f"{rows.shape[1]} columns after {self._stages[0].columns}")
        for a in range(0, len(rows), PIECE):
            self._add(np.array(rows[a : a + PIECE].T, dtype=float, order="C"))

    def end_segment(self) -> None:
        """End the segment: the next sample does not follow the last one."""
        self._offset = None
        for stage in self._stages:
            stage.forget()

    def _add(self, x: np.ndarray) -> None:
        """Add samples (c, k), column by column in memory, as the transform and the filter run."""
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
            self._stages.append(Stage(self.length, len(x), PIECE // DECIMATION**level))
        kept = self._stages[level].take(x)
        if kept.shape[1]:
            self._pass(kept, level + 1)

    def levels(self) -> list[Level]:
        """Every level that had a window, the highest sample rate first."""
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
    """Frequencies (g,), densities (g, c) and averages (g,) of groups of a level's bins.

    The edges of the groups lie on one grid for all levels.
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
    """Equivalent independent averages of white noise.

    They are those of ``windows`` windows that overlap by half and ``bins`` adjoining bins.
    """
    j, d = np.arange(-1, 2), np.arange(-min(bins, REACH) + 1, min(bins, REACH))
    weights = np.outer(np.maximum(windows - np.abs(j), 0), bins - np.abs(d))
    return (windows * bins) ** 2 / float(np.sum(weights * CORRELATION[:, d + REACH - 1]))


REACH = 8
"""Bins from which on two are independent."""


def _correlations() -> np.ndarray:
    """Squared correlations (3, 2 REACH - 1) of the bins of two windows of white noise.

    The windows are -1, 0, 1 half windows apart, the bins up to REACH - 1.
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
