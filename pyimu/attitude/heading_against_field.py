"""Whether a recording's headings and its magnetometer tell the same heading."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.attitude.columns import recorded_age, recorded_heading
from pyimu.attitude.filter.field_learning import MEAN
from pyimu.attitude.headed import LEVEL
from pyimu.errors import Finding
from pyimu.recording.recording import Recording

WINDOW = 20.0
"""s; of each the median counts: noise is averaged out, and the windows' scatter is what lasts."""

SIGMAS, LEAST = 4.0, 0.05
"""Standard deviations of a difference, and rad of it, from which on it is said: by less a mounting
or a calibrated magnetometer is off."""

STEADY = 0.05
"""rad; standard deviation of the windows up to which the difference is the same all the time."""


def field_against_headings(
    recording: Recording, q: np.ndarray, declination: float, turning: float
) -> Finding | None:
    """A finding ``heading_against_field`` where the two differ by more than they are said to.

    ``angle`` in rad is by how much the headings count more than the magnetometer, levelled by the
    attitude ``q`` (n, 4) and turned by the ``declination`` in rad: whatever yaw that attitude has
    is in both. Its ``std`` is by the scatter of the windows, by the headings' own standard
    deviation, and by what turns with the body, ``turning`` T, of which the share ``MEAN`` lasts.
    ``scatter`` in rad is that of the windows.
    """
    heading, std = recorded_heading(recording)
    rows = np.flatnonzero(np.isfinite(heading) & np.isfinite(std) & (std > 0))
    true_at = np.searchsorted(recording.time, recording.time[rows] - recorded_age(recording)[rows])
    true_at = np.minimum(true_at, rows)
    mag = recording.mag[true_at]
    axes = Rotation.from_quat(q[true_at], scalar_first=True)
    ahead = axes.apply([1.0, 0.0, 0.0])
    usable = np.isfinite(mag).all(axis=1) & (np.hypot(*ahead.T[:2]) > LEVEL)
    usable &= np.any(mag != 0, axis=1)
    if not usable.any():
        return None
    rows, ahead = rows[usable], ahead[usable]
    field = axes[usable].apply(mag[usable])
    yaw = np.arctan2(ahead[:, 1], ahead[:, 0])
    by_field = yaw - (np.arctan2(field[:, 1], field[:, 0]) - np.pi / 2 + declination)
    off = heading[rows] - by_field
    middle = np.angle(np.mean(np.exp(1j * off)))
    off = middle + np.angle(np.exp(1j * (off - middle)))
    window = ((recording.time[rows] - recording.time[0]) // WINDOW).astype(int)
    medians = np.array([np.median(off[window == n]) for n in np.unique(window)])
    angle, scatter = float(np.median(medians)), float(np.std(medians))
    level = float(np.median(np.hypot(field[:, 0], field[:, 1])))
    own = np.median(std[rows]) / np.sqrt(len(rows))
    whole = [scatter / np.sqrt(max(len(medians) - 1, 1)), own, np.sqrt(MEAN) * turning / level]
    error = float(np.linalg.norm(whole))
    if abs(angle) < max(SIGMAS * error, LEAST):
        return None
    detail = {"angle": angle, "std": error, "scatter": scatter}
    return Finding("heading_against_field", "heading", len(rows), detail)
