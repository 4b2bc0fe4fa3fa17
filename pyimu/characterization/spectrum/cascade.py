"""One stage of the cascade of ``psd``: it transforms windows and passes every fourth sample on.

The samples that go on to the next stage are low-pass filtered.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numba import njit
from scipy.fft import rfft

DECIMATION = 4

STOP = 120.0
"""Attenuation in dB of what would fold into a level's band. Quantization needs it: it rises
steeply with frequency."""

_AT = np.arange(-25, 26)

_RAW = np.sinc(_AT / DECIMATION) * np.kaiser(len(_AT), 0.1102 * (STOP - 8.7))

TAPS = _RAW / _RAW.sum()
"""Low-pass filter, by Kaiser's window (Oppenheim and Schafer, Discrete-Time Signal Processing,
equations 7.75 and 7.76). In shares of the sample rate after decimation it is flat to 1e-5 up to
0.16 and at -120 dB from 0.84 on; so a level is read up to 0.16 only."""

BATCH = 2**16
"""Samples in the windows that are transformed at a time; as many as fit into a core's cache."""


class Stage:
    """One stage of the cascade: sums of periodograms, and the samples that wait to be processed.

    Samples wait until their window is full, and until the filter can reach over them.
    """

    def __init__(self, length: int, columns: int, room: int) -> None:
        """Start with windows of ``length`` samples; ``room`` samples wait to be transformed."""
        self.length, self.columns, self.windows, self._count = length, columns, 0, 0
        self.power = np.zeros((columns, length // 2 + 1))
        self._waiting = np.empty((columns, max(room, length) + length))
        self.forget()

    def forget(self) -> None:
        """Start a segment: no window and no filter reaches back across its start."""
        self.transform()
        self._count, self._past = 0, np.empty((self.columns, 0))

    def take(self, x: np.ndarray) -> np.ndarray:
        """Add samples (c, k); returns those for the next stage."""
        done = 0
        while done < x.shape[1]:
            if self._count == self._waiting.shape[1]:
                self.transform()
            k = min(x.shape[1] - done, self._waiting.shape[1] - self._count)
            self._waiting[:, self._count : self._count + k] = x[:, done : done + k]
            self._count, done = self._count + k, done + k
        return self._decimated(x)

    def transform(self) -> None:
        """Add the periodograms of the windows that are complete."""
        step = self.length // 2
        count = self._count // step - 1
        if count < 1:
            return
        at_once, w = max(1, BATCH // self.length), hann(self.length)
        for row, power in zip(self._waiting, self.power, strict=True):
            windows = np.lib.stride_tricks.sliding_window_view(row[: self._count], self.length)[
                ::step
            ]
            for a in range(0, count, at_once):
                x = rfft(windows[a : a + at_once] * w, overwrite_x=True)
                power += np.einsum("wk,wk->k", x.real, x.real) + np.einsum(
                    "wk,wk->k", x.imag, x.imag
                )
        self.windows += count
        rest = self._count - count * step
        self._waiting[:, :rest] = self._waiting[:, count * step : self._count].copy()
        self._count = rest

    def _decimated(self, x: np.ndarray) -> np.ndarray:
        """Every fourth output of the filter, as far as the segment's own samples determine it."""
        x = np.concatenate([self._past, x], axis=1)
        out = np.empty((len(x), max(0, (x.shape[1] - len(TAPS)) // DECIMATION + 1)))
        _fill_filtered(x, out)
        self._past = x[:, out.shape[1] * DECIMATION :].copy()
        return out


@njit(cache=True, nogil=True, fastmath={"reassoc", "contract"})
def _fill_filtered(x, out):
    """Fill ``out`` (c, k) with every fourth filtered sample of ``x``.

    The sums may be made in any order, so that the compiler takes several products at a time.
    """
    for c in range(len(out)):
        for k in range(out.shape[1]):
            total = 0.0
            for j in range(len(TAPS)):
                total += TAPS[j] * x[c, k * DECIMATION + j]
            out[c, k] = total


@lru_cache(maxsize=8)
def hann(length: int) -> np.ndarray:
    """Hann's window (length,), periodic."""
    return 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(length) / length)
