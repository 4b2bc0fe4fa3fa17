"""Noise models of a residual and the filters that make it, and every regressor, white with unit
variance.

``RandomWalk``: white noise plus random walk, sampled at any times; its innovations filter is the
local-level Kalman filter (for equal steps (1 - B)/(1 - (1 - g) B), gain g). ``Autoregressive``:
for a residual whose reference was differentiated, so that its noise rises with frequency. A
constant bias is left to an explicit regressor.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from scipy.optimize import minimize_scalar
from scipy.signal import lfilter, upfirdn

Segments = list[tuple[int, int]]

LEAST_VARIANCE = 1e-22
"""Of a residual that is nothing but rounding, so that exact data have a likelihood too."""

AR_ORDER = 32
"""Longest memory of an autoregression; a fiftieth of the rows where there are few."""

CHUNK = 65536
"""Rows that are put side by side with their predecessors at once."""


SIDE_BY_SIDE = 8
"""Columns that are filtered together: while one waits for its last step the others go on."""


@njit(cache=True)
def _gains(steps, r, k2, gain, scale):
    """Fill the Kalman gain (m,) of each step and one over the root of its innovation's variance.

    Returns the sum of the logarithms of these variances.
    """
    variance, total = 0.0, 0.0
    for k in range(len(steps)):
        variance += k2 * steps[k]
        f = variance + r
        gain[k], scale[k] = variance / f, 1.0 / np.sqrt(f)
        total += np.log(f)
        variance = variance * r / f
    return total


@njit(cache=True)
def _filtered(values, gain, scale, out):
    """Fill ``out`` with the innovations (c, m) of rows of ``values``."""
    c, m = values.shape
    level = np.zeros(SIDE_BY_SIDE)
    for first in range(0, c, SIDE_BY_SIDE):
        last = min(first + SIDE_BY_SIDE, c)
        level[:] = 0.0
        for k in range(m):
            for j in range(first, last):
                v = values[j, k] - level[j - first]
                # A column that has long been zero decays into denormal numbers, a hundred times
                # slower than any other.
                moved = level[j - first] + gain[k] * v
                level[j - first] = moved if abs(moved) > 1e-200 else 0.0
                out[j, k] = v * scale[k]


def _steps(time: np.ndarray) -> np.ndarray:
    """Seconds (m,) from each row to the next, none before the first."""
    return np.diff(time, prepend=time[:1])


def _innovations(
    values: np.ndarray, steps: np.ndarray, r: float, k2: float
) -> tuple[np.ndarray, float]:
    """Innovations (m, c) of columns (m, c), and the sum of the logarithms of their variances."""
    gain, scale = np.empty_like(steps), np.empty_like(steps)
    total = _gains(steps, r, k2, gain, scale)
    rows = np.ascontiguousarray(values.T)
    out = np.empty_like(rows)
    _filtered(rows, gain, scale, out)
    return out.T, total


def power_less_bias(white: np.ndarray) -> float:
    """Sum of squares of a whitened residual, column 0, less what a constant, column 1 of (m, 2),
    takes of it.
    """
    residual, constant = white.T
    return float(residual @ residual - (residual @ constant) ** 2 / (constant @ constant))


@dataclass(frozen=True)
class RandomWalk:
    """White noise of variance ``r`` a sample and a random walk that grows by ``k2`` a second.

    It has walked for ``before`` seconds when the rows begin.
    """

    r: float
    k2: float
    before: float = 0.0

    def whiten(self, values: np.ndarray, time: np.ndarray, segments: Segments) -> np.ndarray:
        """Innovations (m, c), unit variance, of columns (m, c) sampled at ``time`` (m,)."""
        return _innovations(values, self._steps(time), self.r, self.k2)[0]

    def log_det(self, time: np.ndarray, segments: Segments) -> float:
        """Sum of the logarithms of the innovation variances."""
        return _innovations(np.zeros((len(time), 0)), self._steps(time), self.r, self.k2)[1]

    def variance_along(self, values: np.ndarray, time: np.ndarray, segments: Segments) -> float:
        """Variance of the sum of products of ``values`` (m,) with this noise.

        The walk that begins at each step goes on through all that follow.
        """
        later = np.cumsum(values[::-1])[::-1]
        return float(self.r * np.sum(values**2) + self.k2 * np.sum(self._steps(time) * later**2))

    def _steps(self, time: np.ndarray) -> np.ndarray:
        steps = _steps(time)
        steps[:1] = self.before
        return steps

    @classmethod
    def fit(cls, residuals: list[tuple[np.ndarray, np.ndarray, Segments]]) -> RandomWalk:
        """Maximum likelihood over residuals ``(values (m,), time (m,), segments)`` that share the
        noise.

        The bias of each log goes with the noise: one that fitted a larger random walk would keep
        that walk alive.
        """
        parts = [(np.array([v, np.ones(len(v))]).T, _steps(t)) for v, t, _ in residuals]
        count = sum(len(v) for v, _ in parts)
        step = float(np.median(np.concatenate([d[1:] for _, d in parts])))

        def concentrated(log_ratio: float) -> tuple[float, float]:
            k2 = np.exp(log_ratio) / step
            white = [_innovations(v, d, 1.0, k2) for v, d in parts]
            power = max(sum(power_less_bias(w) for w, _ in white) / count, LEAST_VARIANCE)
            return 0.5 * sum(logs for _, logs in white) + 0.5 * count * np.log(power), power

        best = minimize_scalar(
            lambda x: concentrated(x)[0],
            bounds=(-40.0, 8.0),
            method="bounded",
            options={"xatol": 0.02},
        )
        low, high = concentrated(-40.0), concentrated(best.x)
        # A random walk that does not pay for itself is left out: the likelihood is flat towards
        # zero.
        ratio, power = (0.0, low[1]) if low[0] <= high[0] + 0.01 else (np.exp(best.x), high[1])
        return cls(power, power * ratio / step)


@dataclass(frozen=True)
class Autoregressive:
    """Residual whose prediction from its ``len(coefficients)`` predecessors leaves variance
    ``r``.
    """

    coefficients: tuple[float, ...]
    r: float

    def whiten(self, values: np.ndarray, time: np.ndarray, segments: Segments) -> np.ndarray:
        """Prediction errors (m, c), unit variance.

        The first rows of a segment, which lack predecessors, are zero.
        """
        out = np.zeros_like(values)
        taps = np.concatenate([[1.0], -np.array(self.coefficients)])
        for a, b in segments:
            if values[a:b].size:
                out[a:b] = upfirdn(taps, values[a:b].T)[:, : b - a].T / np.sqrt(self.r)
            out[a : min(b, a + len(self.coefficients))] = 0.0
        return out

    def log_det(self, time: np.ndarray, segments: Segments) -> float:
        """Sum of the logarithms of the prediction error variances."""
        return sum(max(0, b - a - len(self.coefficients)) for a, b in segments) * float(
            np.log(self.r)
        )

    def variance_along(self, values: np.ndarray, time: np.ndarray, segments: Segments) -> float:
        """Variance of the sum of products of ``values`` (m,) with this noise: the noise is a filter
        of white noise, and its adjoint acts on the values.
        """
        taps = np.concatenate([[1.0], -np.array(self.coefficients)])
        seen = (lfilter([1.0], taps, values[a:b][::-1]) for a, b in segments)
        return float(self.r * sum(np.sum(v**2) for v in seen))

    @classmethod
    def fit(
        cls, residuals: list[tuple[np.ndarray, np.ndarray, Segments]], order: int = AR_ORDER
    ) -> Autoregressive:
        """Least squares over all segments that are long enough."""
        order = max(2, min(order, sum(len(v) for v, _, _ in residuals) // 50))
        pieces = [v[a:b] for v, _, segments in residuals for a, b in segments if b - a > 3 * order]
        if not pieces:
            everything = np.concatenate([v for v, _, _ in residuals])
            return cls((), max(float(np.var(everything)), LEAST_VARIANCE))
        # Normal equations: an SVD of the same rows takes ten times longer, and the noise floor
        # keeps them regular.
        whole = sum(_lagged_products(v, order) for v in pieces)
        gram, right, power = whole[1:, 1:], whole[1:, 0], whole[0, 0]
        least = 1e-12 * np.trace(gram) + LEAST_VARIANCE
        coefficients = np.linalg.solve(gram + least * np.eye(order), right)
        left = power - 2 * coefficients @ right + coefficients @ gram @ coefficients
        rows = sum(len(v) - order for v in pieces)
        return cls(tuple(coefficients), max(float(left) / rows, LEAST_VARIANCE))


def _lagged_products(values: np.ndarray, order: int) -> np.ndarray:
    """Products (order + 1, order + 1), summed, of rows with themselves and their predecessors."""
    total = np.zeros((order + 1, order + 1))
    for first in range(0, len(values) - order, CHUNK):
        piece = values[first : first + CHUNK + order]
        rows = np.lib.stride_tricks.sliding_window_view(piece, order + 1)[:, ::-1]
        total += rows.T @ rows
    return total
