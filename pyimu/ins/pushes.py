"""Where a body that looks still is pushed: so gently that no window of its samples shows it."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import maximum_filter1d

from pyimu.recording.clock import runs

STEADY_GATE = 25.0
"""Squared difference of mean rate and bias over its variance, beyond which a still window is one of
a steady turn, and of mean force and that of the rest before, beyond which it is one of a steady
push."""

FORCE_STAYS, FOLLOWED = 0.005, 30.0
"""m/s^2, s; by how much the mean force of a body that rests may change, three standard deviations,
and the time over which it is the mean before: over minutes a temperature may change it more."""

MOMENT, SETTLED = 1.5, 10.0
"""s; for less the force of a body that drives may be that at rest, between speeding up and slowing
down, and for longer it has no other one."""

LASTING = 5.0
"""s; of the longest means by which a push is looked for."""

WHOLE = 4
"""Moments that a stretch is longer than, in which a push is looked for that lasts: means over a
moment show it, and lose a moment at either end."""

LEAST_SPEED, COMES_UP = 0.03, 5.0
"""m/s; a body that settles after a stop shows less. Assumed. And s, over which it may come up."""

CANDIDATES = 200
"""So many places of a still stretch at most are tried for its rest."""

LEAST = 2 * MOMENT
"""s; of what stays at another force, at least, that may be the rest. Assumed."""


def unpushed(force: np.ndarray, noise: np.ndarray, rows: int, period: float) -> np.ndarray:
    """Marks (n,) of a still stretch, less where its ``force`` (n, 3) m/s^2 of so much ``noise``
    (3,) changes from one mean to another. Each run of them stays at one force: at rest, at a
    constant speed or in an even push, which by itself it does not tell.
    """
    marks, waiting = np.zeros(len(force), dtype=bool), [(0, len(force))]
    while waiting:
        start, stop = waiting.pop()
        alike, apart = _alike(force[start:stop], noise, rows, period)
        for a, b in runs(alike):
            at_end = start + a == 0 or start + b == len(force)
            marks[start + a : start + b] = at_end or (b - a) * period >= LEAST
        others = [(start + a, start + b) for a, b in runs(apart)]
        waiting += [(a, b) for a, b in others if LEAST <= (b - a) * period and b - a < stop - start]
    for start, stop in runs(marks):
        own = force[start:stop]
        marks[start : start + _gained(own[::-1], noise, period)] = False
        marks[stop - _gained(own, noise, period) : stop] = False
    return marks


def _gained(force: np.ndarray, noise: np.ndarray, period: float) -> int:
    """How many of the last forces (n, 3), less those before them, gain a speed."""
    count = min(len(force) // 2, round(COMES_UP / period))
    if count < 1:
        return 0
    before = force[-count - round(SETTLED / period) : -count]
    speed = np.cumsum(force[-count:] - before.mean(axis=0), axis=0) * period
    of_noise = float(np.mean(noise**2)) * period**2 * count * (1 + count / len(before))
    least = np.sqrt(LEAST_SPEED**2 + (STEADY_GATE + 3) * of_noise)
    size = np.linalg.norm(speed, axis=1)
    if size[-1] <= least:
        return 0
    return count - int(np.flatnonzero(np.append(0.0, size) <= least / 2)[-1])


def _alike(
    force: np.ndarray, noise: np.ndarray, rows: int, period: float
) -> tuple[np.ndarray, np.ndarray]:
    """Marks (n,) of what of a stretch has the ``force`` (n, 3) that most of it has, by means over
    ``rows`` and over longer ones, and of what has another; neither where one becomes the other.

    A body that speeds up gently does so for a second or more, and the change within a window is
    lost in noise: the means of blocks of ``rows`` show it. Where they are as before for a moment
    alone, between speeding up and slowing down, it drives on.
    """
    lengths = [rows, *(max(rows, round(s / period)) for s in (MOMENT, LASTING))]
    moment = lengths[1] if len(force) > WHOLE * lengths[1] else rows
    at, rest = _rest_among(force, noise, moment, period)
    own, apart = np.ones(len(force), dtype=bool), np.zeros(len(force), dtype=bool)
    for long in lengths:
        for start, stop in runs(own):
            if long == rows or stop - start > WHOLE * long:
                part = slice(start, stop)
                alike = _as_before(force[part], noise, long, period, at - start, rest)
                # A push begins and ends within the blocks beside it.
                beside = 2 * min(long, lengths[1]) + 1
                own[part] = ~maximum_filter1d(~alike, beside, mode="nearest")
                apart[part] = ~alike
    return own, apart


def _means(force: np.ndarray, rows: int) -> tuple[np.ndarray, np.ndarray]:
    """Means (m, 3) of forces (n, 3) over blocks of ``rows``, the last with what is left, and of
    how many (m,) each is.
    """
    starts = rows * np.arange(max(1, len(force) // rows))
    counts = np.diff(np.append(starts, len(force)))
    return np.add.reduceat(force, starts, axis=0) / counts[:, None], counts


def _spread(noise: np.ndarray, rows: int) -> float:
    """(m/s^2)^2; variance of an axis of the difference of two means over ``rows`` of a rest."""
    return (FORCE_STAYS / 3) ** 2 + 2 * float(np.mean(noise**2)) / rows


def _rest_among(
    force: np.ndarray, noise: np.ndarray, rows: int, period: float
) -> tuple[int, np.ndarray]:
    """At which row of a stretch it may rest, and its force (3,) there: of moments that are alike
    that whose force most others have. A run may begin in the end of a push, and have another's top
    in its middle.
    """
    (means, _), spread = _means(force, rows), _spread(noise, rows)
    count = min(max(2, round(MOMENT / (rows * period))), len(means))
    starts = np.unique(np.linspace(0, len(means) - count, CANDIDATES).astype(int))
    shared = np.empty(len(starts))
    for i, k in enumerate(starts):
        own = means[k : k + count]
        off = np.sum((means - own.mean(axis=0)) ** 2, axis=1)
        alike = np.all(off[k : k + count] <= (STEADY_GATE + 3) * spread / 2)
        shared[i] = np.sum(np.exp(-off / (2 * spread))) if alike else 0.0
    calm = int(starts[np.argmax(shared)])
    # its first may be in the end of a push
    return calm * rows, np.median(means[calm : calm + count], axis=0)


def _as_before(
    force: np.ndarray, noise: np.ndarray, rows: int, period: float, at: int, rest: np.ndarray
) -> np.ndarray:
    """Marks (n,) of the blocks of ``rows`` whose mean is that of a ``rest`` (3,) at row ``at``,
    followed over ``FOLLOWED`` to either side.
    """
    (means, counts), limit = _means(force, rows), (STEADY_GATE + 3) * _spread(noise, rows)
    calm, share = int(np.clip(at // rows, 0, len(means) - 1)), min(rows * period / FOLLOWED, 1.0)
    alike = np.empty(len(means), dtype=bool)
    for order in (range(calm, -1, -1), range(calm, len(means))):
        follows = rest
        for k in order:
            alike[k] = np.sum((means[k] - follows) ** 2) <= limit
            if alike[k]:
                follows = follows + (means[k] - follows) * share
    short = max(2, round(MOMENT / (rows * period)))
    for start, stop in runs(alike):
        if start > 0 and stop < len(alike) and stop - start < short:
            alike[start:stop] = False
    return np.repeat(alike, counts)
