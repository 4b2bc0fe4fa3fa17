"""What a heading is to the gyro of a body that rolls and pitches while it turns, as boats do.

With u the direction upward in the body's axes the heading of its x axis grows by
(q u_y + r u_z) / (1 - u_x^2), q and r being the rates about y and z (Titterton and Weston 2004,
section 3.6, with Euler's angles): a pitch rate of 2 deg/s beside a roll of 5 deg is 0.17 deg/s of
heading that the gyro about z does not show.
"""

from __future__ import annotations

import numpy as np
from scipy.ndimage import uniform_filter1d

from pyimu.errors import Finding
from pyimu.recording.recording import Recording, filled
from pyimu.recording.reference.upward import followed

SETTLES = 10.0
"""s; over which the accelerometer says what is upward, and the gyro within."""

BETWEEN = 1.0, 30.0
"""s; bodies rock within such times: quicker is a heading's noise, slower what a gyro drifts."""

FITS = 0.97
"""Share of what the heading leaves of the gyro that may be left once the rocking is heeded."""


def rate_about_z(recording: Recording, rate: np.ndarray) -> tuple[np.ndarray, Finding | None]:
    """The rate (n,) rad/s about the body's z axis that belongs to a heading's ``rate`` (n,) rad/s,
    NaN where that is unknown, and a finding where the body rocks so that it differs.
    """
    if recording.gyro is None or recording.accel is None:
        return rate, None
    both = recording.gyro, recording.accel
    if not all(np.isfinite(v).any(axis=0).all() for v in both):
        return rate, None
    gyro, force = (filled(recording.time, v) for v in both)
    gyro = gyro - np.median(gyro, axis=0) * [1.0, 1.0, 0.0]
    pieces = [slice(a, b) for a, b in recording.segments]
    up = np.concatenate([_upward(recording.time[p], gyro[p], force[p]) for p in pieces])
    if np.min(up[:, 2]) < 0.5:
        return rate, None
    seen, known = gyro[:, 2], np.isfinite(rate)
    said = (rate * (1.0 - up[:, 0] ** 2) - gyro[:, 1] * up[:, 1]) / up[:, 2]
    rows = [max(1, round(s / recording.sample_period)) for s in BETWEEN]
    left = [_left(seen, v, known, rows) for v in (rate, said)]
    if left[1] >= FITS * left[0]:
        return rate, None
    largest = float(np.quantile(np.arccos(np.clip(up[:, 2], -1.0, 1.0)), 0.99))
    return said, Finding("rocks", "", 1, {"angle": largest})


def _left(seen: np.ndarray, said: np.ndarray, known: np.ndarray, rows: list[int]) -> float:
    """Power of what a gain leaves of what the gyro has ``seen`` (n,), in means over the first of
    ``rows`` less those over the second.
    """
    if np.count_nonzero(known) < 2:
        return 0.0
    quick, slow = ([uniform_filter1d(v[known], n) for v in (said, seen)] for n in rows)
    x, y = (a - b for a, b in zip(quick, slow, strict=True))
    return float(np.sum((y - x * (x @ y) / max(float(x @ x), 1e-300)) ** 2))


def _upward(time: np.ndarray, gyro: np.ndarray, force: np.ndarray) -> np.ndarray:
    """The direction (n, 3) upward in body axes: by the gyro, drawn to that of the force."""
    toward = force / np.linalg.norm(force, axis=1, keepdims=True)
    mean = force[time - time[0] <= SETTLES].mean(axis=0)
    pull = np.full(len(time), 1.0 / SETTLES)
    return followed(time, gyro, mean / np.linalg.norm(mean), toward, pull)
