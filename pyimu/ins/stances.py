"""The stances of a sensor on a foot: between two swings it hardly moves, but rolls over the sole.

The generalised likelihood ratio of Skog et al. 2010 (Zero-velocity detection, their SHOE): over a
window the force has gravity's size and one direction, and nothing turns. Their noise is not the
sensor's but what a foot does while it stands: in two stances of one measured walk (Voisard's
reference set of gait, file 12-1_rf) the rate is 0.1 to 0.8 rad/s, and the size of the force within
0.6 m/s^2 of gravity, while the swing beside them has 10 rad/s and 50 m/s^2.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.ndimage import uniform_filter1d

from pyimu.ins.measured import NoFoot
from pyimu.recording.clock import runs
from pyimu.recording.recording import Recording

WINDOW = 0.1
"""s; a stance is two of them at least."""

RATE, FORCE = 0.6, 2.0
"""rad/s and m/s^2; root mean squares over a window, either of which alone ends a stance. Chosen by
these two stances."""

SWING, TOGETHER = 2.5, 0.1
"""rad/s, of a leg's swing, and s: a swing that is slower for less is one. A vehicle turns more
slowly, but for a skid."""

STEP, FEWEST, MOST = (0.5, 2.5), 10, 0.6
"""s from a step to the next; so many are a walk, if they are so large a share of the swings: a
foot that is turned or set down otherwise takes some, too."""

KICK = 5.0
"""m/s^2; by which the size of the force is off gravity's somewhere in a swing of a leg: what is
turned from side to side in the hand, as for a calibration, hardly pushes. Assumed."""

STD = 0.05
"""m/s; of the velocity, as a sensor some 0.1 m above what a foot rolls over moves. Assumed."""


def standing(recording: Recording, bias: np.ndarray, gravity: float) -> Recording:
    """The recording with a measured velocity of 0 in each ``WINDOW`` of a stance, to ``STD``.

    The gyro's ``bias`` (3,) is in rad/s, ``gravity`` in m/s^2. It is no rest, whose rate is the
    bias. Raises NoFoot for a log that has measured velocities of its own.
    """
    if recording.velocity_east is not None or recording.velocity_north is not None:
        raise NoFoot(
            f"{recording.name}: --zupt foot makes velocities of 0 of the stances, and the log has "
            "measured ones; another --zupt takes these, --no-fixes leaves them out"
        )
    period, zero = recording.sample_period, np.full(len(recording), np.nan)
    every = max(1, round(WINDOW / period))
    for start, stop in runs(stances(recording.gyro - bias, recording.accel, gravity, period)):
        zero[start + (stop - start) % every // 2 : stop : every] = 0.0
    return replace(
        recording,
        velocity_east=zero,
        velocity_north=zero,
        velocity_up=zero,
        velocity_std=np.full(len(recording), STD),
    )


def steps(rates: np.ndarray, force: np.ndarray, gravity: float, period: float) -> int:
    """How many steps a foot takes, 0 of what is none; ``rates`` and ``force`` as for ``stances``.

    Swings follow each other as steps do and push, and between nearly all of them it stands: a hand
    that swings has no stance where it turns back, and what is set down now and then does not walk.
    """
    size = np.linalg.norm(np.nan_to_num(rates), axis=1)
    swings = runs(_closed(size > SWING, round(TOGETHER / period)))
    stands = stances(rates, force, gravity, period)
    starts, ends = (np.array([run[i] for run in swings], dtype=int) for i in (0, 1))
    if len(swings) < FEWEST:
        return 0
    every = np.diff((starts + ends) / 2) * period
    follows = (every > STEP[0]) & (every < STEP[1])
    standing = np.append(0, np.cumsum(stands))
    stood = (standing[starts[1:]] - standing[ends[:-1]]) * period >= WINDOW
    count = int(np.count_nonzero(follows & stood))
    off = np.abs(np.linalg.norm(np.nan_to_num(force), axis=1) - gravity)
    kicks = np.mean([off[a:b].max() > KICK for a, b in swings])
    return count if count >= max(FEWEST, MOST * len(every)) and kicks >= MOST else 0


def _closed(marks: np.ndarray, gap: int) -> np.ndarray:
    """Marks (n,) without gaps of fewer rows between them."""
    out = marks.copy()
    for start, stop in runs(~marks):
        if stop - start < gap:
            out[start:stop] = True
    return out


def stances(rates: np.ndarray, force: np.ndarray, gravity: float, period: float) -> np.ndarray:
    """Marks (n,) of stance by ``rates`` (n, 3) rad/s without bias and ``force`` (n, 3) m/s^2.

    A window's sum of |f - g u|^2, with u the direction of its mean force, is that of |f|^2 + g^2
    less 2 g times the size of the mean force, each by the number of its samples.
    """
    rows = max(3, round(WINDOW / period))
    known = np.isfinite(rates).all(axis=1) & np.isfinite(force).all(axis=1)
    rates, force = np.nan_to_num(rates), np.nan_to_num(force)

    def mean(values: np.ndarray) -> np.ndarray:
        return uniform_filter1d(values, rows, axis=0, mode="nearest")

    pushed = mean(np.sum(force**2, axis=1)) + gravity**2
    pushed = pushed - 2 * gravity * np.linalg.norm(mean(force), axis=1)
    turned = mean(np.sum(rates**2, axis=1))
    whole = mean(known.astype(float)) > 1 - 0.5 / rows
    return whole & (pushed / FORCE**2 + turned / RATE**2 < 1)
