"""The coarse lag of a reference whose clock runs at another pace, or was set anew, or whose rows
were counted while some were lost.

One lag for the whole log is where the sizes of the two rates correlate best. Where no single one
does, each window of some seconds has its own, and the likeliest way through these is the one that
changes least: by the pace of a bare oscillator, or at once and seldom (Viterbi 1967).
"""

from __future__ import annotations

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from scipy.ndimage import uniform_filter1d

WINDOW = 5.0
"""s; windows in which a lag is looked for."""

PERIOD = 0.02
"""s; the sizes of the two rates are compared in means over so long, or over a row."""

REACH = 2.5
"""s; so far to either side of the lag that fits the whole log best."""

PACE = 0.03
"""Relative difference of two clocks that run, at most: oscillators on the chip of a sensor keep to
some percent."""

INDEPENDENT = 2.0
"""Values in a second of the size of a rate that tell something of their own: a hand turns to and
fro once in one."""

MOVE, JUMP = 2.0, 6.0
"""nat that a lag must gain which changes at that pace over a window, and one that jumps."""

SMOOTH = 0.1
"""s; rates are averaged over so long: the noise of an attitude is large in its rate."""

KNOWN = 0.5
"""Share of a window that both must have."""


def wandering_lag(
    time: np.ndarray, x: np.ndarray, y: np.ndarray, both: np.ndarray, about: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
    """Times (k,) s and lags (k,) s, with standard errors (k,) s, by which a sensor's rate ``y``
    (n, axes) follows that of its reference ``x`` (n, axes), in any axes, at ``time`` (n,), evenly
    spaced, near ``about`` s; rows that ``both`` (n,) have count. None where the lag stays the same,
    or the log is too short to tell.
    """
    h = float(np.median(np.diff(time)))
    every = max(round(PERIOD / h), 1)
    x, y = (_sizes(v, both, max(round(SMOOTH / h), 1))[::every] for v in (x, y))
    seen, step = both[::every], every * h
    length, reach = round(WINDOW / step), round(REACH / step)
    if len(x) < 4 * length:
        return None
    cost = _costs(x, y, seen, length, reach, round(about / step))
    path = _cheapest(cost, max(round(PACE * WINDOW / step), 1))
    if np.ptp(path) * step < PERIOD:
        return None
    middle = (np.arange(len(path)) + 0.5) * length * step
    off, std = _between(cost, path)
    return time[0] + middle, about + (path + off - reach) * step, std * step


def _sizes(rate: np.ndarray, both: np.ndarray, rows: int) -> np.ndarray:
    """Sizes (n,) of the means of a rate (n, axes) over so many of the rows that ``both`` (n,) have,
    less its median.
    """
    rate = np.where(both[:, None], rate - np.median(rate[both], axis=0), 0.0)
    known = np.maximum(uniform_filter1d(both.astype(float), rows), 1 / rows)
    return np.linalg.norm(uniform_filter1d(rate, rows, axis=0), axis=1) / known


def _costs(
    x: np.ndarray, y: np.ndarray, seen: np.ndarray, length: int, reach: int, about: int
) -> np.ndarray:
    """Cost (windows, 2 reach + 1) in nat of each lag in each window: what is left of the sensor's
    sizes beside the reference's, of so many values as tell something.
    """
    margin = reach + abs(about)
    x, mask = (np.pad(v.astype(float), margin) for v in (x * seen, seen))
    cost = []
    for a in range(0, len(y) - length + 1, length):
        first = margin + a - about - reach
        there = slice(first, first + length + 2 * reach)
        windows, masks = (sliding_window_view(v[there], length)[::-1] for v in (x, mask))
        masks = masks * seen[a : a + length]
        count = masks.sum(axis=1)
        r = _correlation(windows, y[a : a + length], masks, np.maximum(count, 1.0))
        r = np.where(count > KNOWN * length, np.clip(r, 0.0, 1 - 1e-6), 0.0)
        cost.append(0.5 * INDEPENDENT * WINDOW * np.log1p(-(r**2)))
    return np.array(cost)


def _correlation(x: np.ndarray, y: np.ndarray, masks: np.ndarray, count: np.ndarray) -> np.ndarray:
    """Correlations (k,) of windows ``x`` (k, n) with ``y`` (n,) over the rows of ``masks``."""
    dx, dy = (v - (np.sum(v * masks, axis=1) / count)[:, None] for v in (x, y[None, :]))
    dx, dy = dx * masks, dy * masks
    power = np.sum(dx**2, axis=1) * np.sum(dy**2, axis=1)
    return np.sum(dx * dy, axis=1) / np.sqrt(np.maximum(power, 1e-300))


def _cheapest(cost: np.ndarray, free: int) -> np.ndarray:
    """The lag (windows,) of each window on the cheapest way through all: it changes by up to
    ``free`` for up to ``MOVE``, by more for ``JUMP``.
    """
    lags = cost.shape[1]
    ways = [cost[0]]
    back = []
    moves = np.arange(-free, free + 1)
    for now in cost[1:]:
        before = np.pad(ways[-1], free, constant_values=np.inf)
        near = sliding_window_view(before, 2 * free + 1) + MOVE * np.abs(moves) / free
        best = np.argmin(near, axis=1)
        stay, source = near[np.arange(lags), best], np.arange(lags) + moves[best]
        leap = int(np.argmin(ways[-1]))
        jumps = ways[-1][leap] + JUMP < stay
        ways.append(np.where(jumps, ways[-1][leap] + JUMP, stay) + now)
        back.append(np.where(jumps, leap, source))
    path = [int(np.argmin(ways[-1]))]
    for source in back[::-1]:
        path.append(int(source[path[-1]]))
    return np.array(path[::-1])


def _between(cost: np.ndarray, path: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """How much later than on the ``path`` (windows,) the lag of each window is cheapest, within one
    to either side, by a parabola, and its standard error by how that bends.
    """
    row, middle = np.arange(len(path)), np.clip(path, 1, cost.shape[1] - 2)
    before, here, after = (cost[row, middle + k] for k in (-1, 0, 1))
    bent = np.maximum(before - 2 * here + after, 1e-3)
    off = np.clip(0.5 * (before - after) / bent, -1.0, 1.0)
    return off + middle - path, 1 / np.sqrt(bent)
