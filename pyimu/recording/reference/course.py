"""The course of a vehicle from its positions or velocities, and the rate at which it turns."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pyimu.errors import Finding
from pyimu.numerics.columns import columns_at
from pyimu.recording.clock import runs
from pyimu.recording.quality.inspect import quietest_force
from pyimu.recording.recording import Recording
from pyimu.recording.reference.attitude import within
from pyimu.recording.reference.smoother import smoothed
from pyimu.recording.reference.track import Track, fresh
from pyimu.recording.reference.white_noise import white_noise

CRAWL = 10.0
"""Times its own standard error that a velocity must have for its direction to be a course: the
course is then known to a tenth of a radian, and what its rate lacks of its mean, the square of the
inverse, is 1 %."""

UNEVEN = 5.0
"""Times the median standard error of the rate of a course that one of it may have: that of a slow
vehicle is larger by the inverse of its speed, and beside the rest would be no noise of one size."""

FARTHEST = 10.0
"""s; so far off the clock of a course may be while its axis is looked for."""

SPIKE = 20.0
"""Times the noise of a position from which on a step there and back is a fault."""


DEGREES = (180.0, 90.0)
"""Largest size of a longitude and of a latitude in degrees."""

FASTEST_DEGREES = 1e-3
"""What a number of degrees changes in a second at most while it is a place: 111 m/s. A vehicle
whose place in metres changes by no more drives at a millimetre a second."""


@dataclass(frozen=True, eq=False)
class Course:
    """The course of a vehicle at n times, NaN where it is not known.

    ``course`` (n,) rad, counter-clockwise from east, without jumps within a run of known rows, and
    its ``rate`` (n,) rad/s; ``speed`` (n,) m/s; ``std`` (n,) rad/s is the standard error of the
    rate; ``noise`` the standard deviation of what was smoothed, a position [m] or a velocity
    [m/s]. ``track`` are its samples.
    """

    course: np.ndarray
    rate: np.ndarray
    speed: np.ndarray
    std: np.ndarray
    noise: float
    track: Track

    @property
    def turns(self) -> bool:
        """Whether its rate is more than its own error would make it: a body that turns on the spot
        has no course there, and none that turns anywhere else.
        """
        known = np.isfinite(self.rate)
        size = np.square(self.rate[known] / np.maximum(self.std[known], 1e-300))
        return bool(known.any() and np.mean(size) > 1.0)


def course_of(source: Recording, time: np.ndarray | None = None) -> Course | None:
    """The course of a vehicle whose positions or velocities ``source`` holds, at times (n,) or its
    own; None where it holds neither.

    Where there are both, it is that of which the rate is better known.
    """
    velocity = source.ref_velocity
    sources = [
        (_columns(source.ref_east, source.ref_north), 0),
        (None if velocity is None else velocity[:, :2], 1),
    ]
    at = source.time if time is None else time
    found = [_course(source.time, v, order, at) for v, order in sources if v is not None]
    return min(found, key=_median_std, default=None)


def looks_like_degrees(source: Recording) -> bool:
    """Whether north and east of a recording that moves are a latitude and a longitude.

    A place in degrees lies within 90 and 180, more than one from the origin, and changes by less
    than ``FASTEST_DEGREES`` in a second, yet by far more in all than what scatters from second to
    second: white noise spans less than four times the 95 % quantile of its change. A track in a
    room whose origin is near is told apart by that, one whose origin is far by its speed.
    """
    place = _columns(source.ref_east, source.ref_north)
    if place is None or len(known := fresh(place)) < 8:
        return False
    time, place = source.time[known], place[known]
    later = columns_at(time + 1.0, time, place)
    step = np.quantile(np.abs(later - place), 0.95, axis=0)
    centre, span = np.median(place, axis=0), np.ptp(place, axis=0)
    return bool(
        np.all(np.abs(centre) <= DEGREES)
        and np.all(step < FASTEST_DEGREES)
        and np.any(np.abs(centre) > 1.0)
        and np.any(span > 5 * step)
    )


def has_course(recording: Recording) -> bool:
    """Whether a recording has what a course follows from."""
    source = recording if recording.reference is None else recording.reference
    position = _columns(source.ref_east, source.ref_north) is not None
    return position or source.ref_velocity is not None


def upward(recording: Recording, rate: np.ndarray) -> np.ndarray:
    """The direction (3,) upward in the sensor's axes: that of the specific force in the quietest
    seconds, else of its mean, in which what a drive accelerates cancels. Without accelerometer it
    is the axis, and its sign, whose gyro follows the course's ``rate`` (n,) best.
    """
    if recording.accel is None or not np.isfinite(recording.accel).all(axis=1).any():
        return _axis_that_turns(recording, rate)
    force = quietest_force(recording)
    force = np.nanmean(recording.accel, axis=0) if force is None else force
    return force / np.linalg.norm(force)


def _axis_that_turns(recording: Recording, rate: np.ndarray) -> np.ndarray:
    """A unit vector (3,): the axis whose gyro has the largest covariance with the course's rate at
    any lag of some seconds.
    """
    up = np.array([0.0, 0.0, 1.0])
    if recording.gyro is None:
        return up
    gyro = np.nan_to_num(recording.gyro - np.nanmedian(recording.gyro, axis=0))
    x = np.nan_to_num(rate - np.nanmedian(rate))
    most = min(round(FARTHEST * recording.sample_rate), len(x) - 1)
    from scipy.signal import correlate  # a quarter of a second, and few logs need it

    lags = correlate(gyro, x[:, None], "full")[len(x) - 1 - most : len(x) + most]
    row, axis = np.unravel_index(np.argmax(np.abs(lags)), lags.shape)
    return np.sign(lags[row, axis]) * np.eye(3)[axis]


def mounted(up: np.ndarray) -> Finding:
    """Which way the sensor lies: the axis nearest to the vertical, and how far off that it is."""
    axis = int(np.argmax(np.abs(up)))
    tilt = float(np.arccos(min(1.0, abs(up[axis]))))
    side = "up" if up[axis] > 0 else "down"
    return Finding("mounted", f"gyro_{'xyz'[axis]}", 1, {"points": side, "tilt": tilt})


def _columns(*columns: np.ndarray | None) -> np.ndarray | None:
    return None if any(c is None for c in columns) else np.column_stack(columns)


def _median_std(found: Course) -> float:
    known = np.isfinite(found.std)
    return float(np.median(found.std[known])) if known.any() else np.inf


def _course(nodes_at: np.ndarray, values: np.ndarray, order: int, time: np.ndarray) -> Course:
    """At times (n,) from positions (``order`` 0) or velocities (1), (m, 2) east and north."""
    known = fresh(values)
    spread = white_noise(values[known])
    track = Track(nodes_at, known, lambda nodes: np.diff(values[nodes], axis=0), SPIKE * spread)
    seen = [(nodes_at[nodes], values[nodes]) for nodes in track.segments]
    pieces, noise = smoothed(seen, spread) if seen else ([], spread)
    course, rate, speed, std = np.full((4, len(time)), np.nan)
    for nodes, piece in zip(track.segments, pieces, strict=True):
        rows = within(time, nodes_at[nodes])
        v, a = piece.at(time[rows])[1 - order : 3 - order]
        std_v, std_a = piece.std_at(time[rows])[1 - order : 3 - order]
        speed[rows] = np.hypot(*v.T)
        fast = speed[rows] > CRAWL * std_v
        at = rows[fast]
        rate[at] = ((v[:, 0] * a[:, 1] - v[:, 1] * a[:, 0])[fast]) / speed[at] ** 2
        std[at] = std_a[fast] / speed[at]
        for i, j in runs(fast):
            course[rows[i:j]] = np.unwrap(np.arctan2(v[i:j, 1], v[i:j, 0]))
    known = np.isfinite(std)
    if known.any():
        lost = std > UNEVEN * np.median(std[known])
        rate[lost] = std[lost] = course[lost] = np.nan
    return Course(course, rate, speed, std, noise, track)
