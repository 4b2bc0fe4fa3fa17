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
"""m/s^2, s; by how much the mean force of a body that rests may change, and the time over which it
is the mean before: over minutes a temperature may change it more."""

MOMENT, SETTLED = 1.5, 10.0
"""s; for less the force of a body that drives may be that at rest, between speeding up and slowing
down, and for longer it has no other one."""

WHOLE = 4
"""Moments that a stretch is longer than, in which a push is looked for that lasts: means over a
moment show it, and lose a moment at either end."""

LEAST_SPEED, COMES_UP = 0.03, 5.0
"""m/s; a body that settles after a stop shows less. Assumed. And s, over which it may come up."""

CANDIDATES = 200
"""So many places of a still stretch at most are tried for its rest."""


def unpushed(force: np.ndarray, noise: np.ndarray, rows: int, period: float) -> np.ndarray:
    """Marks (n,) of a still stretch, less where its ``force`` (n, 3) m/s^2 of so much ``noise``
    (3,) has another mean than before: by blocks of ``rows``, by longer ones of what these leave,
    and by the speed that comes up before a push is seen.
    """
    still, long = _alike(force, noise, rows, period), max(rows, round(MOMENT / period))
    for start, stop in runs(still):
        if stop - start > WHOLE * long:
            still[start:stop] = _alike(force[start:stop], noise, long, period)
    for start, stop in runs(still):
        own = force[start:stop]
        still[start : start + _gained(own[::-1], noise, period)] = False
        still[stop - _gained(own, noise, period) : stop] = False
    return still


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


def _alike(force: np.ndarray, noise: np.ndarray, rows: int, period: float) -> np.ndarray:
    """Marks (n,) of a still stretch, less where its ``force`` (n, 3) has another mean over ``rows``
    than before.

    A body that speeds up gently does so for a second or more, and the change within a window is
    lost in noise: the means of blocks of ``rows`` show it. Where they are as before for a moment
    alone, between speeding up and slowing down, it drives on; where they stay at another value for
    ``SETTLED``, it stands askew.
    """
    n, block = len(force) // rows, rows * period
    if n < 3:
        return np.ones(len(force), dtype=bool)
    means = force[: n * rows].reshape(n, rows, 3).mean(axis=1)
    limit = (STEADY_GATE + 3) * (FORCE_STAYS**2 + 2 * float(np.mean(noise**2)) / rows)
    short = max(2, round(MOMENT / block))
    calm = _rest_among(means, short, limit)
    still = np.empty(n, dtype=bool)
    # its first may be in the end of a push
    rest = np.median(means[calm : calm + short], axis=0)
    still[calm:] = _as_before(means[calm:], rest, limit, block)
    still[: calm + 1] = _as_before(means[calm::-1], rest, limit, block)[::-1]
    for start, stop in runs(still):
        if start > 0 and stop < n and stop - start < short:
            still[start:stop] = False
    # A push begins and ends within the blocks beside it.
    still = ~maximum_filter1d(~still, 3, mode="nearest")
    return np.append(np.repeat(still, rows), np.full(len(force) - n * rows, still[-1]))


def _rest_among(means: np.ndarray, count: int, limit: float) -> int:
    """Which of the means (n, 3) begins the rest: of ``count`` of them that follow each other and
    are alike to the root of ``limit``, those whose force most others have. A run may begin in the
    end of a push, and have another's top in its middle.
    """
    count = min(count, len(means))
    starts = np.unique(np.linspace(0, len(means) - count, CANDIDATES).astype(int))
    shared = np.empty(len(starts))
    for i, k in enumerate(starts):
        own = means[k : k + count]
        off = np.sum((means - own.mean(axis=0)) ** 2, axis=1)
        shared[i] = np.sum(off <= limit / 2) if np.all(off[k : k + count] <= limit / 2) else 0
    return int(starts[np.argmax(shared)])


def _as_before(means: np.ndarray, rest: np.ndarray, limit: float, block: float) -> np.ndarray:
    """Marks (n,) of means (n, 3) over ``block`` s that are that of a ``rest`` (3,), followed over
    ``FOLLOWED``, to the root of ``limit``; and of others that stay so for ``SETTLED``.
    """
    long = max(2, round(SETTLED / block))
    still = np.ones(len(means), dtype=bool)
    for k, mean in enumerate(means):
        last = means[max(0, k - long + 1) : k + 1]
        still[k] = np.sum((mean - rest) ** 2) <= limit
        if still[k]:
            rest = rest + (mean - rest) * block / FOLLOWED
        elif len(last) == long and np.all(np.sum((last - last.mean(axis=0)) ** 2, 1) <= limit):
            still[k - long + 1 : k + 1], rest = True, last.mean(axis=0)
    return still
