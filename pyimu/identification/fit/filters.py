"""Filters that make columns white with unit variance, block after block of their rows."""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np
from numba import njit

from pyimu.identification.fit import moving_average
from pyimu.identification.fit.local_level import LOGGED, ROUNDING, SAME

Segments = list[tuple[int, int]]


@njit(cache=True)
def _gains(time, before, r, k2, gain, scale):
    """Fill the Kalman gain (m,) of each row and what its innovation is to be multiplied by (m,),
    of rows at a ``time`` (m,) of which the first comes ``before`` seconds after nothing is known.

    Returns the sum of the logarithms of the variances of the innovations.
    """
    known, total, product = 0.0, 0.0, 1.0
    step, settled, f, share, root = -1.0, False, 1.0, 0.0, 1.0
    for k in range(len(time)):
        passed = time[k] - time[k - 1] if k else before
        if abs(passed - step) > SAME * step:
            step, settled = passed, False
        if not settled:
            grown = known + k2 * step
            f = grown + r
            share = grown / f
            root = 1.0 / np.sqrt(f)
            settled = abs(share * r - known) <= ROUNDING * known
            known = share * r
        gain[k], scale[k] = share, root
        product *= f
        if k % LOGGED == LOGGED - 1:
            total += np.log(product)
            product = 1.0
    return total + np.log(product)


@njit(cache=True)
def _filtered(values, gain, scale, level, out):
    """Fill ``out`` (m, c) with the innovations of ``values`` (m, c), from a ``level`` (c,) on."""
    m, c = values.shape
    for k in range(m):
        for j in range(c):
            v = values[k, j] - level[j]
            # A column that has long been zero decays into denormal numbers, a hundred times
            # slower than any other.
            moved = level[j] + gain[k] * v
            level[j] = moved if abs(moved) > 1e-200 else 0.0
            out[k, j] = v * scale[k]


@njit(cache=True)
def _power(values, gain, scale):
    """Sum of the squares of the innovations of ``values`` (m,)."""
    level, total = 0.0, 0.0
    for k in range(len(values)):
        v = values[k] - level
        level += gain[k] * v
        total += (v * scale[k]) ** 2
    return total


@njit(cache=True)
def _powers(values, gain, scale, level, out):
    """Add to ``out`` (c,) the sums of squares of the innovations of columns (c, m), from a
    ``level`` (c,) on; four at a time, for each innovation waits for the one before.
    """
    c, m = values.shape
    for j in range(0, c, 4):
        one, two = min(j + 1, c - 1), min(j + 2, c - 1)
        three = min(j + 3, c - 1)
        a, b, d, e = level[j], level[one], level[two], level[three]
        of_a, of_b, of_d, of_e = 0.0, 0.0, 0.0, 0.0
        for k in range(m):
            va, vb = values[j, k] - a, values[one, k] - b
            vd, ve = values[two, k] - d, values[three, k] - e
            a, b, d, e = a + gain[k] * va, b + gain[k] * vb, d + gain[k] * vd, e + gain[k] * ve
            sure = scale[k] * scale[k]
            of_a, of_b = of_a + va * va * sure, of_b + vb * vb * sure
            of_d, of_e = of_d + vd * vd * sure, of_e + ve * ve * sure
        level[j], out[j] = a, out[j] + of_a
        if j + 1 < c:
            level[one], out[one] = b, out[one] + of_b
        if j + 2 < c:
            level[two], out[two] = d, out[two] + of_d
        if j + 3 < c:
            level[three], out[three] = e, out[three] + of_e


@njit(cache=True)
def _back(white, gain, scale, out):
    """Fill ``out`` (m, c) with what the transpose of ``_filtered`` makes of ``white`` (m, c)."""
    later = np.zeros(white.shape[1])
    for k in range(len(white) - 1, -1, -1):
        for j in range(len(later)):
            out[k, j] = white[k, j] * scale[k] + gain[k] * later[j]
            later[j] -= out[k, j]


@njit(cache=True)
def _of_steps(gain, scale, out):
    """Fill ``out`` (m + 1,) with the sums of squares of the innovations of a step at each row, of
    which each is one less its gain times the one before.
    """
    out[len(gain)] = 0.0
    for k in range(len(gain) - 1, -1, -1):
        out[k] = scale[k] ** 2 + (1.0 - gain[k]) ** 2 * out[k + 1]


@njit(cache=True)
def _predicted(values, taps, out):
    """Fill ``out`` (m, c) with what a filter of ``taps`` (k,) makes of the last m rows of
    ``values`` (m + k - 1, c).
    """
    m, c = out.shape
    for k in range(m):
        out[k] = 0.0
        for t in range(len(taps)):
            for j in range(c):
                out[k, j] += taps[t] * values[k + len(taps) - 1 - t, j]


class Filter(ABC):
    """What makes columns white, block after block of their rows.

    ``log_det`` is the sum of the logarithms of the variances that it divides by.
    """

    log_det: float

    @abstractmethod
    def next(self, values: np.ndarray) -> np.ndarray:
        """The next rows (k, c) of columns, white with unit variance."""

    def power(self, values: np.ndarray) -> float:
        """Sum of squares of all rows (m,) of one column, white."""
        return float(np.sum(self.next(values[:, None]) ** 2))


class Innovations(Filter):
    """Of white noise of variance ``r`` and a random walk of ``k2`` a second."""

    def __init__(self, time: np.ndarray, before: float, r: float, k2: float) -> None:
        self.gain, self.scale = np.empty(len(time)), np.empty(len(time))
        self.row, self.level = 0, np.zeros(0)
        self.log_det = _gains(time, before, r, k2, self.gain, self.scale)

    def next(self, values: np.ndarray) -> np.ndarray:
        if not self.row:
            self.level = np.zeros(values.shape[1])
        at = slice(self.row, self.row + len(values))
        self.row += len(values)
        out = np.empty(values.shape)
        values = values if values.flags.f_contiguous else np.ascontiguousarray(values)
        _filtered(values, self.gain[at], self.scale[at], self.level, out)
        return out

    def power(self, values: np.ndarray) -> float:
        return _power(values, self.gain, self.scale)

    def powers(self, values: np.ndarray) -> np.ndarray:
        """Sums of squares (c,) of the next rows of columns (c, m), white."""
        if not self.row:
            self.level = np.zeros(len(values))
        at = slice(self.row, self.row + values.shape[1])
        self.row += values.shape[1]
        out = np.zeros(len(values))
        _powers(values, self.gain[at], self.scale[at], self.level, out)
        return out

    def of_steps(self) -> np.ndarray:
        """Sums of squares (m + 1,) of steps at each row and beyond the last, white."""
        out = np.empty(len(self.gain) + 1)
        _of_steps(self.gain, self.scale, out)
        return out

    def back(self, white: np.ndarray) -> np.ndarray:
        """What the transpose of the filter makes of all rows (m, c)."""
        out = np.empty(white.shape)
        _back(white, self.gain, self.scale, out)
        return out


class PredictionErrors(Filter):
    """Of an autoregression, or a moving average of it, each of ``segments`` begun anew: its first
    rows, which lack predecessors, are zero.
    """

    def __init__(
        self, coefficients: tuple[float, ...], r: float, theta: float, segments: Segments
    ) -> None:
        self.order, self.segments, self.row = len(coefficients), segments, 0
        self.taps = np.concatenate([[1.0], -np.array(coefficients)]) / np.sqrt(r)
        self.before = np.zeros((0, 0))
        rows = sum(max(0, b - a - self.order) for a, b in segments)
        self.log_det = rows * float(np.log(r))
        self.average = None
        if theta:
            self.average = moving_average.Innovations(theta, segments)
            self.log_det += sum(
                moving_average.log_determinant(theta, b - a, self.order) for a, b in segments
            )

    def next(self, values: np.ndarray) -> np.ndarray:
        values = values if self.average is None else self.average.next(values)
        if not self.row:
            self.before = np.zeros((self.order, values.shape[1]))
        out, known = np.zeros(values.shape), np.concatenate([self.before, values])
        for a, b in self.segments:
            first = max(a + self.order - self.row, 0)
            last = min(b - self.row, len(values))
            if first < last:
                _predicted(known[first : last + self.order], self.taps, out[first:last])
        self.row += len(values)
        self.before = known[len(known) - self.order :]
        return out


class Followed(Filter):
    """Prediction errors, of which those that are ``seen`` (m,) go through another filter."""

    def __init__(self, errors: Filter, seen: np.ndarray, other: Filter) -> None:
        self.errors, self.seen, self.other, self.row = errors, seen, other, 0
        self.log_det = errors.log_det + other.log_det

    def next(self, values: np.ndarray) -> np.ndarray:
        out = self.errors.next(values)
        seen = self.seen[self.row : self.row + len(values)]
        self.row += len(values)
        if seen.any():
            out[seen] = self.other.next(np.ascontiguousarray(out[seen]))
        return out
