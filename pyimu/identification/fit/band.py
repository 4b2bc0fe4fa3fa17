"""The band in which a derived reference can be trusted.

One linear-phase filter for gyro, reference and regressors alike.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.optimize import brentq
from scipy.signal import upfirdn

OVERSAMPLING = 2.5
"""Rows for each period of the band's frequency, at the least."""

HANN = 0.7203
"""Frequency at which the power behind a Hann window has halved, times its length."""

SHORTEST = 1.001
"""Samples of a smoothing window that is hardly any."""

HALF = float(np.sqrt(0.5))
"""Gain at which the power is half."""


@dataclass(frozen=True)
class Band:
    """A weighted moving average of an odd number of samples, kept every ``stride`` samples.

    ``Band()`` is no filter at all. The window is a plain average over a stride, smoothed by the
    half wave of a cosine as long as makes the power fall to half at its frequency: nearly a Hann
    window. So the windows of all rows add up to a constant, and the rows to what the samples add up
    to: of noise above the rows' rate nothing comes down to the lowest frequencies, where the
    derivative of an attitude's noise has least and a bias is told from it. Rows are kept at
    ``OVERSAMPLING`` times the band's frequency, faster only where no window of so long a stride
    passes it: whitening weighs every frequency up to half the row rate alike, and beyond the band
    there is nothing to trust.
    """

    weights: tuple[float, ...] = (1.0,)
    stride: int = 1

    @classmethod
    def below(cls, band_hz: float, sample_rate: float) -> Band:
        """Band up to ``band_hz`` (-3 dB) at ``sample_rate``, both in Hz."""
        return _below(band_hz / sample_rate)

    @property
    def half(self) -> int:
        """Samples on either side that an output draws on."""
        return len(self.weights) // 2

    def centres(self, segments: list[tuple[int, int]]) -> np.ndarray:
        """Indices of the samples that outputs stand for, so that none draws on a sample outside its
        segment.
        """
        parts = [np.arange(r.start, r.stop, r.step) for r in (self.rows(*s) for s in segments)]
        return np.concatenate(parts) if parts else np.arange(0)

    def rows(self, a: int, b: int) -> range:
        """Those of one segment."""
        return range(a + self.half, b - self.half, self.stride)

    def apply(self, values: np.ndarray, segments: list[tuple[int, int]]) -> np.ndarray:
        """Filter (n, c) within each segment; gives (m, c), one row for each of ``centres``.

        It may be a view of ``values`` where nothing is filtered.
        """
        if len(segments) == 1 and len(self.weights) == 1:
            return values[slice(*segments[0])]
        if len(self.weights) == 1:
            return np.concatenate([values[a:b] for a, b in segments]) if segments else values[:0]
        parts = [self._one(values[a:b]) for a, b in segments if b - a > 2 * self.half]
        return np.concatenate(parts) if parts else values[:0]

    def _one(self, values: np.ndarray) -> np.ndarray:
        rows = len(range(self.half, len(values) - self.half, self.stride))
        shifted = values[: (rows - 1) * self.stride + len(self.weights)]
        # upfirdn keeps outputs 0, stride, 2 stride ...; dropping whole strides first puts them on
        # the centres.
        lead = (-2 * self.half) % self.stride
        padded = np.concatenate([np.zeros((values.shape[1], lead)), shifted.T], axis=1)
        first = (2 * self.half + lead) // self.stride
        return upfirdn(np.array(self.weights), padded, 1, self.stride)[:, first : first + rows].T


@lru_cache(maxsize=64)
def _below(share: float) -> Band:
    """Band up to a ``share`` of the sample rate."""
    if HANN <= 2 * share:
        return Band()
    stride = round(1.0 / (OVERSAMPLING * share))
    while _passed(share, stride, SHORTEST) <= HALF:
        stride -= 1
    support = brentq(lambda m: _passed(share, stride, m) - HALF, SHORTEST, 1.5 / share)
    return Band(tuple(_window(stride, support)), stride)


def _passed(share: float, stride: int, support: float) -> float:
    """Gain of a window at a ``share`` of the sample rate."""
    weights = _window(stride, support)
    k = np.arange(len(weights)) - len(weights) // 2
    return float(np.cos(2 * np.pi * share * k) @ weights)


def _window(stride: int, support: float) -> np.ndarray:
    """Weights, an odd number, of a plain average over ``stride`` samples, smoothed by the half wave
    of a cosine over a ``support`` of no whole number of samples.
    """
    # Of an even stride the middle lies between two samples: that of the other must do so, too.
    between = 0.5 * (1 - stride % 2)
    at = np.arange(between, support / 2)
    at = np.concatenate([-at[::-1][: len(at) - (stride % 2)], at])
    wave = np.cos(np.pi * at / support)
    return np.convolve(wave / wave.sum(), np.full(stride, 1.0 / stride))
