"""Which way is up in a vehicle that leans into its turns, as one on two wheels does.

Its course says how fast it turns about the vertical; a gyro that leans with it shows the cosine of
that. The accelerometer does not see the lean, as the force of the turn lies along the body, but
the gyro does: the direction upward is followed through each turn, and comes back where the vehicle
drives straight or stands, which two wheels do upright.
"""

from __future__ import annotations

import numpy as np
from scipy.ndimage import maximum_filter1d, uniform_filter1d

from pyimu.errors import Finding
from pyimu.recording.recording import Recording, filled
from pyimu.recording.reference.upward import followed

STRAIGHT = 0.03
"""rad/s; a vehicle that turns more slowly drives straight, in curves of 300 m at 10 m/s."""

BACK, FORGOTTEN = 1.0, 300.0
"""s; within which the direction upward comes back on a straight, and in a turn, which is shorter
than that."""

ABOUT = 1.0
"""s before and after a turn in which a vehicle leans already, or still."""

LEAST_STRAIGHT = 0.1
"""Share of the log on straights, by which the gyro's bias is known."""

LEANS = 0.002
"""Share of the rate that a lean must take away to be heeded: below it vehicles only roll on their
springs."""

FITS = 0.97
"""Share of what the course leaves of the gyro that may be left once the lean is heeded."""


def upward_through(
    recording: Recording, rate: np.ndarray, up: np.ndarray
) -> tuple[np.ndarray, Finding | None]:
    """The direction (n, 3) upward in the sensor's axes, which is ``up`` (3,) on the straight, and a
    finding where the vehicle leans; ``rate`` (n,) rad/s is that of its course, NaN where unknown.
    """
    still = np.broadcast_to(up, (len(rate), 3))
    if recording.gyro is None or not np.isfinite(recording.gyro).all(axis=1).any():
        return still, None
    gyro = np.column_stack([filled(recording.time, v) for v in recording.gyro.T])
    axis, rows = int(np.argmax(np.abs(up))), 2 * round(ABOUT / recording.sample_period) + 1
    about = uniform_filter1d(gyro[:, axis] - np.median(gyro[:, axis]), rows)
    straight = maximum_filter1d(np.abs(about), rows) < STRAIGHT
    if straight.mean() < LEAST_STRAIGHT:
        return still, None
    gyro = gyro - np.median(gyro[straight], axis=0)
    pull = np.where(straight, 1.0 / BACK, 1.0 / FORGOTTEN)
    # Behind a gap it leans nobody knows how far.
    pieces = [slice(a, b) for a, b in recording.segments]
    found = np.concatenate(
        [followed(recording.time[p], gyro[p], up, still[p], pull[p]) for p in pieces]
    )
    turn, known, cosine = np.nan_to_num(rate), np.isfinite(rate), found @ up
    leans = np.sum(turn**2 * (1.0 - cosine)) >= LEANS * np.sum(turn**2)
    seen = np.where(known, gyro[:, axis], 0.0)
    left = [_left(seen, turn * v[:, axis], rows) for v in (still, found)]
    if not leans or left[1] > FITS * left[0]:
        return still, None
    largest = float(np.arccos(np.clip(np.quantile(cosine, 0.01), -1.0, 1.0)))
    return found, Finding("leans", "", 1, {"angle": largest})


def _left(seen: np.ndarray, said: np.ndarray, rows: int) -> float:
    """Power of what a gain leaves of what the gyro has ``seen`` (n,), in means over ``rows``."""
    seen, said = (uniform_filter1d(v, rows) for v in (seen, said))
    return float(np.sum((seen - said * (said @ seen) / max(said @ said, 1e-300)) ** 2))
