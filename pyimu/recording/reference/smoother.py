"""A noisy quantity made smooth: by how much follows from its own noise."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numba import njit
from scipy.optimize import minimize_scalar

from pyimu.numerics.positive import cholesky, solve

STATES = 3
"""Value, slope and curvature: the least that gives a course its rate."""

RATIOS = (-15.0, 50.0)
"""Natural logarithms of q/r [1/s^5] that are looked at: from a receiver of 1 Hz and 3 m to an
optical system of 1 kHz and 0.01 mm."""

ALLOWANCE = 1.1
"""Times the noise of high differences that may be taken for noise: they know it to some percent."""

EXACT = 1e-8
"""Share of their extent that values without any noise may leave: rounding makes a tenth of it."""

DIFFUSE = 1e10
"""Variance of the first state, in units of the noise's: next to nothing is known of it."""


@dataclass(frozen=True)
class Smooth:
    """The smoothed quantity of one segment.

    ``time`` (n,) s; ``states`` (n, 3, d): value, slope and curvature at the nodes; ``variance``
    (n, 3, 3) their covariance, the same in each of the d directions.
    """

    time: np.ndarray
    states: np.ndarray
    variance: np.ndarray

    def at(self, time: np.ndarray) -> np.ndarray:
        """Value, slope and curvature (3, m, d) at times (m,) between the first node and the last.

        Between two nodes whose states are known the mean of a quantity with a white third
        derivative is the polynomial of fifth degree through them (quintic Hermite).
        """
        k = np.clip(np.searchsorted(self.time, time, side="right") - 1, 0, len(self.time) - 2)
        h = (self.time[k + 1] - self.time[k])[:, None]
        s = (time - self.time[k])[:, None] / h
        (x0, v0, a0), (x1, v1, a1) = (self.states[k + j].transpose(1, 0, 2) for j in (0, 1))
        v0, v1, a0, a1 = h * v0, h * v1, h**2 * a0, h**2 * a1
        # what a parabola from the left misses at the right: of value, slope and curvature
        x, v, a = x1 - x0 - v0 - a0 / 2, v1 - v0 - a0, a1 - a0
        c3, c4, c5 = 10 * x - 4 * v + a / 2, -15 * x + 7 * v - a, 6 * x - 3 * v + a / 2
        value = x0 + s * (v0 + s * (a0 / 2 + s * (c3 + s * (c4 + s * c5))))
        slope = v0 + s * (a0 + s * (3 * c3 + s * (4 * c4 + s * 5 * c5)))
        curvature = a0 + s * (6 * c3 + s * (12 * c4 + s * 20 * c5))
        return np.array([value, slope / h, curvature / h**2])

    def std_at(self, time: np.ndarray) -> np.ndarray:
        """Standard errors (3, m) of value, slope and curvature, from node to node on a line."""
        std = np.sqrt(np.maximum(np.diagonal(self.variance, axis1=1, axis2=2), 0.0))
        return np.array([np.interp(time, self.time, column) for column in std.T])


def smoothed(
    pieces: Sequence[tuple[np.ndarray, np.ndarray]], most: float = np.inf
) -> tuple[list[Smooth], float]:
    """The pieces (time (n,), values (n, d)), each smoothed, and the standard deviation of the
    values' noise, at most about ``most``.

    The values are a quantity whose third derivative is white noise of density q, and white noise of
    variance r; both are estimated from all pieces together by maximum likelihood, the smoothing is
    their fixed-interval smoother (Sarkka 2013, algorithms 4.2 and 8.2): a smoothing spline of fifth
    degree whose one parameter is the ratio q/r (Wecker and Ansley 1983). A drive whose turns are
    not of that kind may be likeliest as noise: ``most`` forbids it.
    """
    pieces = [(t, np.ascontiguousarray(v, dtype=float)) for t, v in pieces]

    def unlikely(log_ratio: float) -> float:
        squares, logs, count = _sums(pieces, log_ratio)
        if squares > count * (ALLOWANCE * most) ** 2:
            return np.inf
        return 0.5 * (count * np.log(max(squares, 1e-300) / count) + logs)

    coarse, step = np.linspace(*RATIOS, 27, retstep=True)
    extents = [float(np.ptp(v, axis=0).max()) for _, v in pieces]
    most = max(most, EXACT * max(extents, default=0.0))
    looked = np.array([unlikely(z) for z in coarse])
    at = int(np.argmin(looked))
    low = coarse[at] - (step if at and np.isfinite(looked[at - 1]) else 0.0)
    found = minimize_scalar(unlikely, bounds=(low, coarse[at] + step), method="bounded")
    squares, _, count = _sums(pieces, float(found.x))
    r, ratio = squares / count, float(np.exp(found.x))
    made = []
    for time, values in pieces:
        states, variance = _smooth(time, values - values[0], ratio)
        states[:, 0] += values[0]
        made.append(Smooth(time, states, r * variance))
    return made, float(np.sqrt(r))


def _sums(pieces, log_ratio: float) -> tuple[float, float, int]:
    """Sum of squares of the innovations in units of their own deviation where r is 1, sum of the
    logarithms of their variances, and their number.
    """
    found = [_likelihood(t, v - v[0], float(np.exp(log_ratio))) for t, v in pieces]
    squares, logs = (float(sum(f[k] for f in found)) for k in (0, 1))
    return squares, logs, sum((len(t) - STATES) * v.shape[1] for t, v in pieces)


@njit(cache=True)
def _ahead(x, h):
    """Bring states (3, d) ``h`` s on, in their place."""
    for j in range(x.shape[1]):
        x[0, j] += h * (x[1, j] + 0.5 * h * x[2, j])
        x[1, j] += h * x[2, j]


@njit(cache=True)
def _predict(x, p, h, ratio):
    """Bring states (3, d) and their covariance (3, 3) ``h`` s on, under a white third derivative of
    density ``ratio``.
    """
    _ahead(x, h)
    _ahead(p, h)
    _ahead(p.T, h)
    p[0, 0] += ratio * h**5 / 20
    p[1, 1] += ratio * h**3 / 3
    p[2, 2] += ratio * h
    for i, j, q in ((0, 1, h**4 / 8), (0, 2, h**3 / 6), (1, 2, h**2 / 2)):
        p[i, j] += ratio * q
        p[j, i] = p[i, j]


@njit(cache=True)
def _update(x, p, value):
    """States (3, d) and covariance with a value (d,) seen, in their place.

    Gives the sum of squares of the innovation and its variance.
    """
    s, squares = p[0, 0] + 1.0, 0.0
    gain = p[:, 0] / s
    for j in range(len(value)):
        miss = value[j] - x[0, j]
        squares += miss**2
        for i in range(STATES):
            x[i, j] += gain[i] * miss
    for i in range(STATES):
        for j in range(i, STATES):
            p[i, j] -= gain[i] * gain[j] * s
            p[j, i] = p[i, j]
    return squares, s


@njit(cache=True)
def _likelihood(time, values, ratio):
    x, p = np.zeros((STATES, values.shape[1])), DIFFUSE * np.eye(STATES)
    squares, logs = 0.0, 0.0
    for k in range(len(time)):
        if k:
            _predict(x, p, time[k] - time[k - 1], ratio)
        square, s = _update(x, p, values[k])
        if k >= STATES:
            squares += square / s
            logs += values.shape[1] * np.log(s)
    return squares, logs


@njit(cache=True)
def _smooth(time, values, ratio):
    n, d = values.shape
    states, variance = np.zeros((n, STATES, d)), np.zeros((n, STATES, STATES))
    before, spread = np.zeros((n, STATES, d)), np.zeros((n, STATES, STATES))
    x, p = np.zeros((STATES, d)), DIFFUSE * np.eye(STATES)
    for k in range(n):
        if k:
            _predict(x, p, time[k] - time[k - 1], ratio)
        _add(before[k], x, 1.0)
        _add(spread[k], p, 1.0)
        _update(x, p, values[k])
        _add(states[k], x, 1.0)
        _add(variance[k], p, 1.0)
    for k in range(n - 2, -1, -1):
        gain = _gain(variance[k], spread[k + 1], time[k + 1] - time[k])
        _add(before[k + 1], states[k + 1], -1.0)
        _add(spread[k + 1], variance[k + 1], -1.0)
        for i in range(STATES):
            for j in range(STATES):
                for c in range(d):
                    states[k, i, c] -= gain[i, j] * before[k + 1, j, c]
                for a in range(STATES):
                    for b in range(STATES):
                        variance[k, i, j] -= gain[i, a] * spread[k + 1, a, b] * gain[j, b]
    return states, variance


@njit(cache=True)
def _gain(variance, spread, h):
    """What a state takes of the error of its prediction over ``h`` s, whose covariance (3, 3) is
    ``spread``.
    """
    ahead, root = variance.copy(), cholesky(spread)
    _ahead(ahead, h)
    out = ahead.T.copy()
    for i in range(STATES):
        solve(root, out[i])
    return out


@njit(cache=True)
def _add(to, what, share):
    """Add a share of an array (m, d) to another."""
    for i in range(to.shape[0]):
        for j in range(to.shape[1]):
            to[i, j] += share * what[i, j]
