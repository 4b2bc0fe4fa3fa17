"""The few filters and spectra that the reading and explaining of logs is made of.

``scipy.signal`` has them all. Importing it imports ``scipy.stats``, half a second in all, which is
a good part of what a short log takes.
"""

from __future__ import annotations

import numpy as np
from numba import njit
from scipy.fft import irfft, next_fast_len, rfft

LONGER = 8
"""Times as long as a response are the pieces that it is convolved with."""


def hann(length: int) -> np.ndarray:
    """The periodic Hann window."""
    return 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(length) / length)


def decimated(values: np.ndarray, weights: np.ndarray, stride: int) -> np.ndarray:
    """Sums (m, c), weighed (k,), of every k rows of values (n, c) that follow each other, one every
    ``stride`` rows.
    """
    return _decimated(np.ascontiguousarray(values.T), weights, stride).T


@njit(cache=True, fastmath={"reassoc"})
def _decimated(columns, weights, stride):
    c, n = columns.shape
    out = np.empty((c, (n - len(weights)) // stride + 1))
    for j in range(c):
        for k in range(out.shape[1]):
            total = 0.0
            for t in range(len(weights)):
                total += weights[t] * columns[j, k * stride + t]
            out[j, k] = total
    return out


@njit(cache=True)
def recursive(values, coefficients):
    """Rows (n,) each of which is what its predecessors predict by ``coefficients`` (k,), the
    nearest first, and its own of ``values`` (n,); zero before the first.
    """
    out = np.empty(len(values))
    for k in range(len(values)):
        out[k] = values[k]
        for t in range(min(k, len(coefficients))):
            out[k] += coefficients[t] * out[k - 1 - t]
    return out


def gain(weights: np.ndarray, turn: np.ndarray) -> np.ndarray:
    """Gain (f,) of a sum of values weighed (k,) at frequencies of so many turns a sample."""
    return np.abs(np.polynomial.polynomial.polyval(np.exp(-2j * np.pi * turn), weights))


def convolved(values: np.ndarray, response: np.ndarray) -> np.ndarray:
    """Values (n, c) through filters with a ``response`` (k, c) each to an impulse, from rest on: of
    pieces that overlap (overlap-add).
    """
    (n, c), k = values.shape, len(response)
    size = next_fast_len(LONGER * k, real=True)
    step = size - k + 1
    count = -(-n // step)
    pieces, out = np.zeros((c, count * step)), np.zeros((c, (count + 1) * step))
    pieces[:, :n] = values.T
    made = rfft(pieces.reshape(c, count, step), size)
    made *= rfft(response.T, size)[:, None]
    parts = irfft(made, size, overwrite_x=True)
    out[:, : count * step].reshape(c, count, step)[...] = parts[:, :, :step]
    out[:, step:].reshape(c, count, step)[:, :, : k - 1] += parts[:, :, step:]
    return out[:, :n].T


def density(values: np.ndarray, rate: float, length: int) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies (f,) and one-sided densities (f, c) of values (n, c) at a sample ``rate``, of
    frames of so many rows, half of each in the next (Welch 1967).
    """
    apart = length - length // 2
    frames = np.lib.stride_tricks.sliding_window_view(values, length, axis=0)[::apart]
    frames = frames - frames.mean(axis=-1, keepdims=True)
    window = hann(length)
    power = np.mean(np.abs(rfft(frames * window)) ** 2, axis=0).T
    power *= 2.0 / (rate * (window @ window))
    power[0] /= 2.0
    power[-1] /= 1.0 if length % 2 else 2.0
    return np.fft.rfftfreq(length, 1.0 / rate), power
