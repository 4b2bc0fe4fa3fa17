"""Noise models of a residual and the filters that make it, and every regressor, white with unit
variance.

``RandomWalk``: white noise plus random walk, sampled at any times; its innovations filter is the
local-level Kalman filter (for equal steps (1 - B)/(1 - (1 - g) B), gain g). ``Autoregressive``:
for a residual whose reference was differentiated, so that its noise rises with frequency. A
constant bias is left to an explicit regressor.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import solve_toeplitz
from scipy.signal import lfilter

from pyimu.identification.fit import moving_average
from pyimu.identification.fit.filters import (
    Filter,
    Followed,
    Innovations,
    PredictionErrors,
    Segments,
)
from pyimu.identification.fit.local_level import likeliest

LEAST_VARIANCE = 1e-22
"""Of a residual that is nothing but rounding, so that exact data have a likelihood too."""

AR_ORDER = 32
"""Longest memory of an autoregression; a fiftieth of the rows where there are few."""

SETTLED = 1024
"""Rows after which an autoregression has forgotten what it began with."""

SETTLES = 1.0 - 1e-6
"""Largest size of a pole: beyond it a filter settles in no log."""

HALVED = 20
"""Times that an interval is halved in which a variance is looked for: to a millionth of it."""

CHUNK = 65536
"""Rows that are put side by side with their predecessors at once."""


def _steps(time: np.ndarray) -> np.ndarray:
    """Seconds (m,) from each row to the next, none before the first."""
    return np.diff(time, prepend=time[:1])


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

    @property
    def slow(self) -> RandomWalk:
        """The noise as means over many rows show it."""
        return self

    def in_means(self, count: float) -> RandomWalk:
        """The noise of means over so many rows."""
        return replace(self, r=self.r / count)

    def whiten(self, values: np.ndarray, time: np.ndarray, segments: Segments) -> np.ndarray:
        """Innovations (m, c), unit variance, of columns (m, c) sampled at ``time`` (m,)."""
        return self.filter(time, segments).next(values)

    def filter(self, time: np.ndarray, segments: Segments) -> Innovations:
        """What makes columns sampled at ``time`` (m,) white."""
        return Innovations(time, self.before, self.r, self.k2)

    def log_det(self, time: np.ndarray, segments: Segments) -> float:
        """Sum of the logarithms of the innovation variances."""
        return self.filter(time, segments).log_det

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
        parts = [(np.ascontiguousarray(v), _steps(t)) for v, t, _ in residuals]
        r, k2 = likeliest(parts, LEAST_VARIANCE)
        return cls(r, k2)


@dataclass(frozen=True)
class Autoregressive:
    """Residual whose prediction from its ``len(coefficients)`` predecessors leaves variance
    ``r``, beside a random walk that grows by ``k2`` a second, which is slow beside them, and has
    walked for ``before`` seconds when the rows begin; ``beside_motion`` says that the motion in it
    was left out. It is the difference of each such row and ``theta`` times the one before: with 1
    the derivative of an attitude's noise, whose low frequencies no autoregression is long enough
    for.
    """

    coefficients: tuple[float, ...]
    r: float
    beside_motion: bool = False
    k2: float = 0.0
    before: float = 0.0
    theta: float = 0.0

    @property
    def slow(self) -> RandomWalk:
        """The noise as means over many rows show it."""
        r = self.r * ((1.0 - self.theta) / (1.0 - sum(self.coefficients))) ** 2
        return RandomWalk(r, self.k2, self.before)

    @property
    def walk(self) -> RandomWalk:
        """The walk as the prediction errors, of unit variance, show it."""
        return RandomWalk(1.0, self.k2 / self.slow.r, self.before)

    def no_quieter_than(self, level: float) -> Autoregressive:
        """The same with no less than the variance ``level`` where it is ``slow``: with a smaller
        ``theta``, else with as much white noise beside it, as an autoregression of the same memory.

        Of few rows the slow end is known by tenths, and what it lacks there makes of a bias that
        wanders a step.
        """
        if self.slow.r >= level:
            return self
        theta = 1.0 - abs(1.0 - sum(self.coefficients)) * float(np.sqrt(level / self.r))
        if self.theta and theta > 0.0:
            return replace(self, theta=theta)
        products, low, high = self._products(), 0.0, level - self.slow.r
        while _of_products(products, high).slow.r < level:
            low, high = high, 2.0 * high
        for _ in range(HALVED):
            middle = 0.5 * (low + high)
            enough = _of_products(products, middle).slow.r >= level
            low, high = (low, middle) if enough else (middle, high)
        found = _of_products(products, high)
        return replace(self, coefficients=found.coefficients, r=found.r, theta=0.0)

    def _products(self) -> np.ndarray:
        """Covariances (k + 1,) of rows so far apart as its memory is long."""
        turns = np.exp(-2j * np.pi * np.fft.rfftfreq(2 * SETTLED))
        taps = np.concatenate([[1.0], -np.array(self.coefficients)])
        density = self.r * np.abs((1.0 - self.theta * turns) / np.polyval(taps[::-1], turns)) ** 2
        return np.fft.irfft(density)[: len(taps)]

    def in_means(self, count: float) -> Autoregressive:
        """The noise of means over so many rows, one after another: a moving average that has their
        variance, and that of the mean of very many of them.
        """
        rows = np.zeros(round(count) + SETTLED)
        rows[: round(count)] = 1.0 / round(count)
        taps = np.concatenate([[1.0], -np.array(self.coefficients)])
        whole = float(self.r * np.sum(lfilter([1.0, -self.theta], taps, rows) ** 2))
        of_many = self.slow.r / count
        share = 1.0 - min(of_many / whole, 1.0)
        # (1 - theta)^2 r is the one, (1 + theta^2) r the other.
        theta = share / (1.0 + np.sqrt(1.0 - share**2))
        r = of_many / (1.0 - theta) ** 2
        return Autoregressive((), r, k2=self.k2, before=self.before, theta=theta)

    def whiten(self, values: np.ndarray, time: np.ndarray, segments: Segments) -> np.ndarray:
        """Prediction errors (m, c), unit variance.

        The first rows of a segment, which lack predecessors, are zero.
        """
        return self.filter(time, segments).next(values)

    def filter(self, time: np.ndarray, segments: Segments) -> Filter:
        """What makes columns in these segments white."""
        errors = PredictionErrors(self.coefficients, self.r, self.theta, segments)
        if not self.k2:
            return errors
        seen = self.predicted(len(time), segments)
        return Followed(errors, seen, self.walk.filter(time[seen], []))

    def predicted(self, rows: int, segments: Segments) -> np.ndarray:
        """Marks (rows,) of those that have their predecessors."""
        seen = np.zeros(rows, dtype=bool)
        for a, b in segments:
            seen[a + len(self.coefficients) : b] = True
        return seen

    def log_det(self, time: np.ndarray, segments: Segments) -> float:
        """Sum of the logarithms of the prediction error variances."""
        return self.filter(time, segments).log_det

    def variance_along(self, values: np.ndarray, time: np.ndarray, segments: Segments) -> float:
        """Variance of the sum of products of ``values`` (m,) with this noise: the noise is a filter
        of white noise, and its adjoint acts on the values.
        """
        taps = np.concatenate([[1.0], -np.array(self.coefficients)])
        seen = (lfilter([1.0, -self.theta], taps, values[a:b][::-1]) for a, b in segments)
        fast = float(self.r * sum(np.sum(v**2) for v in seen))
        slow = RandomWalk(0.0, self.k2, self.before)
        return fast + slow.variance_along(values, time, segments)

    @classmethod
    def fit(
        cls,
        residuals: list[tuple[np.ndarray, np.ndarray, Segments]],
        order: int = AR_ORDER,
        least: float | None = None,
    ) -> Autoregressive:
        """Least squares over all segments that are long enough; ``theta`` by the likelihood of the
        frequencies of at ``least`` so many cycles a row, 0 without.
        """
        order = max(2, min(order, sum(len(v) for v, _, _ in residuals) // 50))
        pieces = [v[a:b] for v, _, segments in residuals for a, b in segments if b - a > 3 * order]
        if not pieces:
            everything = np.concatenate([v for v, _, _ in residuals])
            return cls((), max(float(np.var(everything)), LEAST_VARIANCE))
        theta = moving_average.likeliest(pieces, order, least) if least else 0.0
        if theta:
            first = (moving_average.Innovations(theta, []).next(v[:, None])[:, 0] for v in pieces)
            pieces = [v[order:] for v in first]
        # Normal equations: an SVD of the same rows takes ten times longer, and the noise floor
        # keeps them regular.
        whole = sum(_lagged_products(v, order) for v in pieces)
        gram, right, power = whole[1:, 1:], whole[1:, 0], whole[0, 0]
        least = 1e-12 * np.trace(gram) + LEAST_VARIANCE
        coefficients = _settling(np.linalg.solve(gram + least * np.eye(order), right))
        left = power - 2 * coefficients @ right + coefficients @ gram @ coefficients
        rows = sum(len(v) - order for v in pieces)
        r = max(float(left) / rows, LEAST_VARIANCE)
        return cls(tuple(coefficients), r, theta=theta)


def _of_products(products: np.ndarray, white: float) -> Autoregressive:
    """The autoregression of rows with covariances (k + 1,), beside ``white`` noise of a variance
    (Yule and Walker).
    """
    whole = np.append(products[0] + white, products[1:])
    if len(whole) == 1:
        return Autoregressive((), float(whole[0]))
    coefficients = solve_toeplitz(whole[:-1], whole[1:])
    return Autoregressive(tuple(coefficients), float(whole[0] - coefficients @ whole[1:]))


def _settling(coefficients: np.ndarray) -> np.ndarray:
    """Coefficients (k,) of the same spectrum's shape whose filter settles: of a few rows least
    squares find some that grow. Poles outside the unit circle go to where they are mirrored.
    """
    poles = np.roots(np.concatenate([[1.0], -coefficients]))
    outside = np.abs(poles) > SETTLES
    if not outside.any():
        return coefficients
    poles[outside] = SETTLES**2 / poles[outside].conj()
    return -np.poly(poles).real[1:]


def _lagged_products(values: np.ndarray, order: int) -> np.ndarray:
    """Products (order + 1, order + 1), summed, of rows with themselves and their predecessors."""
    total = np.zeros((order + 1, order + 1))
    for first in range(0, len(values) - order, CHUNK):
        piece = values[first : first + CHUNK + order]
        rows = np.lib.stride_tricks.sliding_window_view(piece, order + 1)[:, ::-1]
        total += rows.T @ rows
    return total


WALKS = RandomWalk | Autoregressive
"""The noises that have a random walk, ``k2``."""
