"""The band in which a derived reference can be trusted.

One linear-phase filter for gyro, reference and regressors alike.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.signal import upfirdn

OVERSAMPLING = 2.5
"""Rows for each period of the band's frequency."""

BEYOND = 2.0 / 0.7203
"""Times the band's edge above which nothing of what was differentiated is kept: where the window of
the band passes nothing any more of what the sensor shows there."""


@dataclass(frozen=True)
class Band:
    """A Hann-weighted moving average, kept every ``stride`` samples, half of its length.

    ``Band()`` is no filter at all. So long a window falls to 1/sqrt(2) at 0.36 of the row rate,
    nine tenths of the band's frequency, and the windows of all rows add up to a constant, so that
    the rows add up to what the samples do: of noise above the rows' rate nothing comes down to the
    lowest frequencies, where the derivative of an attitude's noise has least and a bias is told
    from it. Rows are kept no faster: whitening weighs every frequency up to half the row rate
    alike, and beyond the band there is nothing to trust.
    """

    weights: tuple[float, ...] = (1.0,)
    stride: int = 1

    @classmethod
    def below(cls, band_hz: float, sample_rate: float) -> Band:
        """Band up to ``band_hz`` at ``sample_rate``, both in Hz."""
        stride = round(sample_rate / (OVERSAMPLING * band_hz))
        if stride < 2:
            return cls()
        window = 1 + np.cos(np.pi * np.arange(1 - stride, stride) / stride)
        return cls(tuple(window / window.sum()), stride)

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
