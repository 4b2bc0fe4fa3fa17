"""Jumps of a reference's world: turns that its attitude shows at once and the gyro does not share.

What the attitude turned beyond the gyro since the log began wanders slowly, with a bias, a delay, a
scale factor, and scatters with the reference's noise; a jump is a step of it.
"""

from __future__ import annotations

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from scipy.ndimage import maximum_filter1d, median_filter

from pyimu.numerics.columns import columns_at
from pyimu.recording.clock import runs
from pyimu.recording.quality.clipping import clipped
from pyimu.recording.reference.epoch import ALIKE, correlations

SIDE = 12
"""Samples on either side through which a line is laid: a step is how far the two lines are apart in
the middle."""

NEAR = 256
"""Samples around each in which the usual distance of the two lines is measured."""

SIGMAS = 7.0
"""A jump exceeds so many robust standard deviations near it: noise does once in 7e9 samples."""

TAIL = 3.0
"""It exceeds the 95 % quantile of its segments by this factor, for motion has longer tails."""

SLIP = 1.5
"""Samples by which a clock may slip at once, its own jitter included."""

AT_ONCE = 0.5
"""Share of a jump that may lie in other steps than its own: what takes longer is motion that sensor
and reference show with different delays."""

FARTHEST = 900
"""Samples by which the clocks of the two may be apart, half a minute of a camera's: one further off
is set right before anything is looked at."""

PLAINLY = 0.5
"""Of what a lag of zero leaves of the correlation, what another may leave."""

USUAL = 0.98
"""Share of the steps that are no jumps, and no faults."""

REPEATS, BESIDE = 2.0, 0.01
"""Times what the best lag leaves of the correlation, and share of it, within which another is as
good."""

ISOLATION = 3.0
"""And what is near but does not share its samples: fast motion that a delayed reference shows late
comes in waves, a jump alone."""


def jumps(
    time: np.ndarray, steps: np.ndarray, known: np.ndarray, gyro: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Where a reference's world jumps, and by how much.

    The reference has samples at ``known`` (m,) s and rotates by ``steps`` (m - 1, 3) rad between
    them; ``gyro`` (n, 3) rad/s are the samples at ``time`` (n,). Gives the numbers (j,) of the
    samples before which a jump lies, and their angles (j,) rad.
    """
    none = np.zeros(0, dtype=int), np.zeros(0)
    usable = _usable(time, known, gyro)
    if len(steps) < 4 * SIDE or np.count_nonzero(usable) < 4 * SIDE:
        return none
    from scipy.integrate import cumulative_trapezoid  # a tenth of a second, and few logs need it

    angle = cumulative_trapezoid(np.nan_to_num(gyro), time, axis=0, initial=0.0)
    own = np.diff(columns_at(known, time, angle), axis=0)
    late = _late(steps, own, usable) * float(np.median(np.diff(known)))
    if late:
        usable = _usable(time, known + late, gyro)
        own = np.diff(columns_at(known + late, time, angle), axis=0)
        if np.count_nonzero(usable) < 4 * SIDE:
            return none
    beyond = _beyond(steps, own, usable)
    vectors = _distances(np.cumsum(beyond, axis=0), usable)
    size = np.linalg.norm(vectors, axis=1)
    at, gate = _peaks(size)
    at = at[np.linalg.norm(vectors[at] - beyond[at], axis=1) < AT_ONCE * size[at]]
    at = _alone(size, at)
    at = at[_less_a_slip(vectors[at], (steps - beyond)[at]) > gate[at]]
    # Sample 0 has no step before it: distance k lies between samples k and k + 1.
    return at + 1, size[at]


def _late(steps: np.ndarray, turned: np.ndarray, usable: np.ndarray) -> int:
    """Samples by which the gyro shows later what the reference does, by the sizes of their turns
    (m, 3), which no mounting changes; of a motion that repeats itself the nearest lag, 0 where none
    is plain.
    """
    x, y = (np.linalg.norm(v, axis=1) for v in (steps, turned))
    # A jump is one step, and would tell farther lags that leave it out from nearer ones.
    x, y = (np.minimum(v, np.quantile(v[usable], USUAL)) for v in (x, y))
    most = min(FARTHEST, len(x) // 4)
    lags, known = np.arange(-most, most + 1), usable.astype(float)
    r = correlations(np.where(usable, x, 0.0), known, np.where(usable, y, 0.0), known, lags, most)
    alike = np.flatnonzero(1 - r <= REPEATS * (1 - r.max()) + BESIDE)
    first = alike[np.argmin(np.abs(lags[alike]))]
    near = np.flatnonzero(np.abs(lags - lags[first]) <= SIDE)
    best = int(near[np.argmax(r[near])])
    return int(lags[best]) if r[best] > ALIKE and 1 - r[best] < PLAINLY * (1 - r[most]) else 0


def _less_a_slip(jump: np.ndarray, turn: np.ndarray) -> np.ndarray:
    """Sizes (j,) of jumps (j, 3) less what a reference does whose clock slips by one sample, in
    which the gyro turns by ``turn`` (j, 3): that is the clock's, and no turn of a world.
    """
    speed = np.maximum(np.linalg.norm(turn, axis=1, keepdims=True), 1e-300)
    along = np.sum(jump * turn, axis=1, keepdims=True) / speed
    slip = np.clip(along, -SLIP * speed, SLIP * speed) * turn / speed
    return np.linalg.norm(jump - slip, axis=1)


def _usable(time: np.ndarray, known: np.ndarray, gyro: np.ndarray) -> np.ndarray:
    """Steps (m - 1,) during which the gyro was seen, within its range."""
    bad = ~np.isfinite(gyro).all(axis=1) | np.any([clipped(v) for v in gyro.T], axis=0)
    count = np.concatenate([[0], np.cumsum(bad)])
    first = np.searchsorted(time, known[:-1], side="right") - 1
    last = np.searchsorted(time, known[1:], side="left")
    inside = (first >= 0) & (last < len(time))
    first, last = np.clip(first, 0, len(time) - 1), np.clip(last, 0, len(time) - 1)
    return inside & (count[last + 1] == count[first])


def _beyond(steps: np.ndarray, turned: np.ndarray, usable: np.ndarray) -> np.ndarray:
    """Steps (m, 3) less what the gyro ``turned`` (m, 3), whose axes, gain and clock may be others.

    The gain, and what a sample earlier or later makes of it, are fitted twice, the second time
    without the tenth that they missed most.
    """
    first = np.gradient(turned, axis=0)
    columns = np.column_stack([np.ones(len(turned)), turned, first, np.gradient(first, axis=0)])
    rows, left = usable, steps
    for _ in range(2):
        left = steps - columns @ np.linalg.lstsq(columns[rows], steps[rows], rcond=1e-9)[0]
        miss = np.linalg.norm(left, axis=1)
        rows = usable & (miss <= np.quantile(miss[usable], 0.9))
    return left


def _distances(level: np.ndarray, usable: np.ndarray) -> np.ndarray:
    """How far (m, 3) the lines before and after each step of a level (m, 3) are apart in its
    middle; zero where fewer than ``SIDE`` steps that are usable lie on either side.
    """
    out = np.zeros(level.shape)
    if len(level) < 2 * SIDE:
        return out
    place = np.arange(SIDE) - (SIDE - 1) / 2
    weight = 1 / SIDE + place * (SIDE / 2) / np.sum(place**2)
    windows = sliding_window_view(level, SIDE, axis=0) @ np.column_stack([weight, weight[::-1]])
    before, after = windows[: len(level) - 2 * SIDE + 1, :, 0], windows[SIDE:, :, 1]
    out[SIDE : len(level) - SIDE + 1] = after - before
    whole = np.zeros(len(level), bool)
    for a, b in runs(usable):
        whole[a + SIDE : max(b - SIDE + 1, a + SIDE)] = True
    return np.where(whole[:, None], out, 0.0)


def _peaks(size: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Places (j,) of the distances (m,) that stand out from all around, and the size (m,) from
    which on one does.
    """
    seen = size > 0.0
    if not seen.any():
        return np.zeros(0, dtype=int), size
    # The size of a vector of three normal numbers has a median of 1.538 standard deviations.
    usual = median_filter(size, min(NEAR, len(size)), mode="nearest") / 1.538
    gate = np.maximum(SIGMAS * usual, TAIL * np.quantile(size[seen], 0.95))
    peak = size == maximum_filter1d(size, 2 * SIDE + 1, mode="nearest")
    return np.flatnonzero(peak & seen & (size > gate)), gate


def _alone(size: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Those of the places ``at`` (j,) whose distances (m,) stand out from what is near them and
    shares no sample with any of them.
    """
    others = np.array(size)
    for k in at:
        others[max(k - 2 * SIDE, 0) : k + 2 * SIDE + 1] = 0.0
    return np.array([k for k in at if size[k] > ISOLATION * _near(others, k)], dtype=int)


def _near(size: np.ndarray, k: int) -> float:
    """The largest distance near ``k`` that shares no sample with it."""
    return float(size[max(k - 6 * SIDE, 0) : k + 6 * SIDE + 1].max())
