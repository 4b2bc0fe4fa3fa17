"""Noise models of a residual and the filters that make it, and every regressor, white with unit
variance.

``RandomWalk``: white noise plus random walk, sampled at any times; its innovations filter is the
local-level Kalman filter (for equal steps (1 - B)/(1 - (1 - g) B), gain g). ``Autoregressive``:
for a residual whose reference was differentiated, so that its noise rises with frequency. A
constant bias is left to an explicit regressor.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace

import numpy as np
from numba import njit
from scipy.linalg import solve_toeplitz
from scipy.signal import lfilter

from pyimu.identification.fit import moving_average
from pyimu.identification.fit.local_level import LOGGED, ROUNDING, SAME, likeliest

Segments = list[tuple[int, int]]

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


def _steps(time: np.ndarray) -> np.ndarray:
    """Seconds (m,) from each row to the next, none before the first."""
    return np.diff(time, prepend=time[:1])


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


class _PredictionErrors(Filter):
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


class _Followed(Filter):
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
        errors = _PredictionErrors(self.coefficients, self.r, self.theta, segments)
        if not self.k2:
            return errors
        seen = self.predicted(len(time), segments)
        return _Followed(errors, seen, self.walk.filter(time[seen], []))

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
