"""A low-pass filter that adapts, as those over hands, headsets and markers do: its cut-off rises
with the rate at which what it shows turns (Casiez, Roussel and Vogel 2012, "1 EUR filter", CHI,
equations 1 to 4).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit

from pyimu.recording.reference.filters import low_passed, seen_through

SPEED = 1.0
"""Hz; cut-off of the low-pass filter behind which the filter knows the rate (section "Tuning" of
the same)."""

SETTLED = 8.0
"""Time constants after which what was before the first row is forgotten, to 0.03 %."""


HALVINGS = 24
"""Of the time constants that a step may have had, until one agrees with what it shows."""


@dataclass(frozen=True)
class Adapting:
    """A low-pass filter of first order whose time constant is ``size`` s where nothing turns, and
    half as long at ``halves`` rad/s.

    By ``steps`` it is the filter of that paper, at the times of the samples that it shows: each
    takes a share of the way from the last to what is seen. Else it is one at a far higher rate.
    """

    size: float
    halves: float
    steps: bool = False

    def constants(self, rate: np.ndarray, h: float) -> np.ndarray:
        """Time constants (n,) s where it is shown a ``rate`` (n, 3) rad/s, ``h`` s apart; by
        ``steps`` that is the mean since the row before.
        """
        rows = 1.0 / (2.0 * np.pi * SPEED * h)
        slow = _stepping(rate, np.full(len(rate), rows)) if self.steps else low_passed(rate, rows)
        return self.size / (1.0 + np.linalg.norm(slow, axis=1) / self.halves)

    def constants_of(self, shown: np.ndarray, h: float) -> np.ndarray:
        """The time constants (n,) s with which it showed attitudes (n, 4), by ``steps``.

        From one to the next it is undone: what it was shown then tells by which share it followed.
        """
        rows = 1.0 / (2.0 * np.pi * SPEED * h)
        return _undone(np.ascontiguousarray(shown), h, 1.0 / (1.0 + rows), self.size, self.halves)

    def seen(self, rate: np.ndarray, h: float, turned: np.ndarray | None) -> np.ndarray:
        """What is seen of a ``rate`` (n, 3) rad/s behind the filter, or of attitudes (n, 4) behind
        it, by which the body has ``turned``.
        """
        since = np.vstack([rate[:1], 0.5 * (rate[1:] + rate[:-1])]) if self.steps else rate
        rows, behind = self.constants(since, h) / h, _stepping if self.steps else _behind
        return seen_through(lambda values: behind(values, rows), rate, h, turned)

    def reach(self, h: float) -> int:
        """Rows at either end that are not as they would be between others."""
        return int(np.ceil(SETTLED * (self.size / h + self.steps)))


@njit(cache=True)
def _stepping(values, rows):
    """Values (n, k) of which each takes one share in 1 + ``rows`` (n,) of the way from the last to
    what is seen (equations 1 and 3); what came before the first was like it.
    """
    out = np.empty_like(values)
    out[0] = values[0]
    for i in range(1, len(values)):
        for k in range(values.shape[1]):
            out[i, k] = out[i - 1, k] + (values[i, k] - out[i - 1, k]) / (1.0 + rows[i])
    return out


@njit(cache=True)
def _behind(values, rows):
    """Values (n, k) behind a low-pass filter with time constants of so many ``rows`` (n,); what
    came before the first was like it.
    """
    out = np.empty_like(values)
    out[0] = values[0]
    for i in range(1, len(values)):
        # Of a line from row to row, as that of a filter which does not adapt.
        kept = np.exp(-1.0 / rows[i])
        mean = rows[i] * (1.0 - kept)
        for k in range(values.shape[1]):
            driven = (1.0 - mean) * values[i, k] + (mean - kept) * values[i - 1, k]
            out[i, k] = kept * out[i - 1, k] + driven
    return out


@njit(cache=True)
def _undone(shown, h, slow, size, halves):
    """Time constants (n,) s of a filter that showed quaternions (n, 4), scalar first; ``slow`` is
    the share by which the rate that it knows follows.
    """
    lags, seen, rate = np.full(len(shown), size), shown[0].copy(), np.zeros(3)
    for i in range(1, len(shown)):
        step, low, high = _between(shown[i - 1], shown[i]), 0.0, size
        for _ in range(HALVINGS):
            lag = 0.5 * (low + high)
            now = _turned(shown[i], step * (lag / h))
            after = rate + slow * (_between(seen, now) / h - rate)
            if size / (1.0 + np.sqrt(np.sum(after * after)) / halves) > lag:
                low = lag
            else:
                high = lag
        seen, rate, lags[i] = now, after, lag
    return lags


@njit(cache=True)
def _turned(q, by):
    """A quaternion (4,) turned in the body by a rotation vector (3,)."""
    angle = np.sqrt(np.sum(by * by))
    half = 0.5 if angle < 1e-12 else np.sin(0.5 * angle) / angle
    return _product(q, np.cos(0.5 * angle), half * by)


@njit(cache=True)
def _between(p, q):
    """The rotation vector (3,) from the quaternion p to q, in axes of p."""
    d = _product(np.array([p[0], -p[1], -p[2], -p[3]]), q[0], q[1:])
    sine = np.sqrt(d[1] ** 2 + d[2] ** 2 + d[3] ** 2)
    if d[0] < 0.0:
        d = -d
    return d[1:] * (2.0 if sine < 1e-12 else 2.0 * np.arctan2(sine, d[0]) / sine)


@njit(cache=True)
def _product(p, w, v):
    """The product of a quaternion p (4,) and one of scalar w and vector v (3,)."""
    out = np.empty(4)
    out[0] = p[0] * w - p[1] * v[0] - p[2] * v[1] - p[3] * v[2]
    out[1] = p[0] * v[0] + p[1] * w + p[2] * v[2] - p[3] * v[1]
    out[2] = p[0] * v[1] - p[1] * v[2] + p[2] * w + p[3] * v[0]
    out[3] = p[0] * v[2] + p[1] * v[1] - p[2] * v[0] + p[3] * w
    return out
