"""A noisy quantity made smooth: by how much follows from its own noise."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numba import njit
from scipy.optimize import minimize_scalar

STATES = 3
"""Value, slope and curvature: the least that gives a course its rate."""

RATIOS = (-15.0, 50.0)
"""Natural logarithms of q/r [1/s^5] that are looked at: from a receiver of 1 Hz and 3 m to an
optical system of 1 kHz and 0.01 mm."""

ALLOWANCE = 1.1
"""Times the noise of high differences that may be taken for noise: they know it to some percent."""

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
        std = np.sqrt(np.diagonal(self.variance, axis1=1, axis2=2))
        return np.array([np.interp(time, self.time, column) for column in std.T])


def white_noise(values: np.ndarray) -> float:
    """Standard deviation of the white noise of samples (n, d), from their fifth differences, which
    take slow motion out and have 252 times its variance; the median heeds no fault.

    It is at most too large: what is left of the motion adds to it.
    """
    if len(values) < 8:
        return np.inf
    size = np.abs(np.diff(values, n=5, axis=0))
    return float(np.median(size) / 0.6745 / np.sqrt(252))


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
def _transition(h, ratio):
    """Transition matrix and covariance over ``h`` s of a white third derivative."""
    f = np.array([[1.0, h, h**2 / 2], [0.0, 1.0, h], [0.0, 0.0, 1.0]])
    q = np.array(
        [
            [h**5 / 20, h**4 / 8, h**3 / 6],
            [h**4 / 8, h**3 / 3, h**2 / 2],
            [h**3 / 6, h**2 / 2, h],
        ]
    )
    return f, ratio * q


@njit(cache=True)
def _updated(x, p, value):
    """State and covariance with a value seen, its innovation (d,) and that one's variance."""
    s = p[0, 0] + 1.0
    gain = p[:, 0] / s
    miss = value - x[0]
    x = x + gain.reshape(-1, 1) * miss.reshape(1, -1)
    p = p - np.outer(gain, gain) * s
    return x, 0.5 * (p + p.T), miss, s


@njit(cache=True)
def _likelihood(time, values, ratio):
    x, p = np.zeros((STATES, values.shape[1])), DIFFUSE * np.eye(STATES)
    squares, logs = 0.0, 0.0
    for k in range(len(time)):
        if k:
            f, q = _transition(time[k] - time[k - 1], ratio)
            x, p = f @ x, f @ p @ f.T + q
        x, p, miss, s = _updated(x, p, values[k])
        if k >= STATES:
            squares += np.sum(miss**2) / s
            logs += len(miss) * np.log(s)
    return squares, logs


@njit(cache=True)
def _smooth(time, values, ratio):
    n, d = values.shape
    states, variance = np.empty((n, STATES, d)), np.empty((n, STATES, STATES))
    before, spread = np.empty((n, STATES, d)), np.empty((n, STATES, STATES))
    x, p = np.zeros((STATES, d)), DIFFUSE * np.eye(STATES)
    for k in range(n):
        if k:
            f, q = _transition(time[k] - time[k - 1], ratio)
            x, p = f @ x, f @ p @ f.T + q
        before[k], spread[k] = x, p
        x, p, _, _ = _updated(x, p, values[k])
        states[k], variance[k] = x, p
    for k in range(n - 2, -1, -1):
        f, _ = _transition(time[k + 1] - time[k], ratio)
        back = np.linalg.solve(spread[k + 1], f @ variance[k]).T
        states[k] += back @ (states[k + 1] - before[k + 1])
        variance[k] += back @ (variance[k + 1] - spread[k + 1]) @ back.T
    return states, variance
