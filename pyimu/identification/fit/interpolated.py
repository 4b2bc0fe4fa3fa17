"""Evenly spaced samples at places between them."""

from __future__ import annotations

from functools import cache

import numpy as np
from numba import njit
from scipy.special import i0

TAPS, SHAPE = 12, 10.0
"""Samples on either side from which a shifted reference is interpolated, and the shape of their
Kaiser window: its side lobes shift what is interpolated by less than 1e-4 samples."""

PHASES = 4096
"""Parts of a sample for which the weights of the interpolation are tabled; a line between two of
them is off by (pi^2 / 3) / 8 of their distance's square, 2.5e-8."""


def interpolated(x: np.ndarray, row: np.ndarray) -> np.ndarray:
    """Values of ``x`` (n, k) at fractional rows (m,).

    A sinc under a Kaiser window, so that white noise keeps its size where a line between neighbours
    would smooth it.
    """
    out = np.empty((len(row), x.shape[1]))
    _weighed(np.ascontiguousarray(x), row, _weights(), out)
    return out


def delayed(x: np.ndarray, rows: float | np.ndarray) -> np.ndarray:
    """Values of ``x`` (n, k) so many ``rows`` earlier, one number or (n,): those at an end where
    there are none.
    """
    return interpolated(x, np.clip(np.arange(len(x)) - rows, 0, len(x) - 1))


@cache
def _weights() -> np.ndarray:
    """Weights (PHASES + 1, 2 TAPS) of the samples around a place so far past one of them."""
    past = np.arange(PHASES + 1)[:, None] / PHASES
    away = past - np.arange(1 - TAPS, TAPS + 1)
    window = i0(SHAPE * np.sqrt(np.maximum(1 - (away / TAPS) ** 2, 0.0)))
    weights = np.sinc(away) * window
    return weights / weights.sum(axis=1, keepdims=True)


@njit(cache=True)
def _weighed(x, row, weights, out):
    """Fill ``out`` (m, k) with what ``x`` (n, k) is at each of the fractional rows (m,)."""
    last, own = len(x) - 1, np.empty(2 * TAPS)
    for r in range(len(row)):
        left = int(np.floor(row[r]))
        phase = (row[r] - left) * PHASES
        i = min(int(phase), PHASES - 1)
        share = phase - i
        for j in range(2 * TAPS):
            own[j] = weights[i, j] + share * (weights[i + 1, j] - weights[i, j])
        first = left + 1 - TAPS
        inside = first >= 0 and first + 2 * TAPS - 1 <= last
        for k in range(x.shape[1]):
            total = 0.0
            if inside:
                for j in range(2 * TAPS):
                    total += own[j] * x[first + j, k]
            else:
                for j in range(2 * TAPS):
                    total += own[j] * x[min(max(first + j, 0), last), k]
            out[r, k] = total
