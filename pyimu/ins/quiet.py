"""How far a rest at the start is as quiet as it begins: what shakes it more is a motion.

A motion that speeds up gently changes no mean, and its vibration is less than what tells a motion
by itself, but more than the noise of the rest before it. Taken for noise, it would hide all that is
as quiet.
"""

from __future__ import annotations

import numpy as np

from pyimu.recording.recording import Recording

BLOCK = 1.0
"""s; over which noise is measured."""

LOUDER = 1.2
"""Factor of the noise of a motion beside that of a rest, at least. Assumed."""

BY_SIGMAS = 6.0
"""And by how many standard deviations of what it differs by from block to block in the rest."""

FEWEST = 2
"""Blocks of a rest, and of what is as quiet later in the log."""


def quiet_until(recording: Recording, stop: int) -> int:
    """The row, ``stop`` at most, until which the rest of the first rows is as quiet as it begins.

    Where nothing in the log is as quiet again, as where an engine is started, that is ``stop``.
    """
    rows = max(4, round(BLOCK / recording.sample_period))
    if stop < (FEWEST + 1) * rows:
        return stop
    sizes = _sizes(recording, rows, stop // rows)
    own, by_chance = sizes[: stop // rows], np.sqrt(3 / rows / 6)
    until = len(own)
    while until > FEWEST:
        at = _louder_from(own[:until], by_chance)
        if at is None:
            break
        until = at
    if until == len(own):
        return stop
    limit = own[:until].mean() + BY_SIGMAS / 2 * max(by_chance, float(own[:until].std()))
    again = np.sum(sizes[len(own) :] < limit)
    return until * rows if again >= FEWEST else stop


def _louder_from(sizes: np.ndarray, by_chance: float) -> int | None:
    """The block from which on the logs ``sizes`` (k,) of the noise are larger than before, as a
    step shows it best; None where they are not. It is said for blocks of which each differs by
    ``by_chance`` at least.
    """
    at = np.arange(FEWEST, len(sizes))
    if not len(at):
        return None
    sums = np.append(0.0, np.cumsum(sizes))
    before, after = sums[at] / at, (sums[-1] - sums[at]) / (len(sizes) - at)
    seen = (after - before) * np.sqrt(at * (len(sizes) - at) / len(sizes))
    best = int(np.argmax(seen))
    scatter = max(by_chance, float(sizes[: at[best]].std()))
    louder = after[best] - before[best] > 2 * np.log(LOUDER)
    return int(at[best]) if louder and seen[best] > BY_SIGMAS * scatter else None


def _sizes(recording: Recording, rows: int, first: int) -> np.ndarray:
    """Logs (k,) of the white noise's variance over blocks of so many ``rows``, the mean of all
    axes; infinite where samples are missing. A tenth of that of the ``first`` blocks is added, as a
    coarse converter shows none in some.
    """
    found = []
    for values in (recording.gyro, recording.accel):
        count = len(values) // rows
        steps = np.diff(values[: count * rows].reshape(count, rows, -1), axis=1)
        own = np.mean(steps**2, axis=1)
        known = np.nan_to_num(own[:first])
        found.append(np.log(own + known.mean(axis=0) / 10 + 1e-30))
    return np.nan_to_num(np.mean(np.hstack(found), axis=1), nan=np.inf)
