"""A reference's attitude between its samples."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation, RotationSpline

from pyimu.recording.recording import Recording
from pyimu.recording.reference.track import Track, fresh


def attitude_track(source: Recording) -> Track:
    """The samples of ``ref_q`` that can be differentiated."""
    q = source.ref_q

    def steps(nodes: np.ndarray) -> np.ndarray:
        attitude = Rotation.from_quat(q[nodes], scalar_first=True)
        return (attitude[:-1].inv() * attitude[1:]).as_rotvec()

    return Track(source.time, fresh(q), steps)


def attitude_curve(source: Recording, nodes: np.ndarray) -> RotationSpline:
    """The attitude through the samples ``nodes`` (m,) of ``ref_q``, body to world."""
    q = Rotation.from_quat(source.ref_q[nodes], scalar_first=True)
    return RotationSpline(source.time[nodes], q)


def attitude_at(source: Recording, time: np.ndarray) -> np.ndarray:
    """The attitude (n, 4) at times (n,), NaN where the reference does not cover them."""
    q = np.full((len(time), 4), np.nan)
    for nodes in attitude_track(source).segments:
        rows = within(time, source.time[nodes])
        if len(rows):
            q[rows] = attitude_curve(source, nodes)(time[rows]).as_quat(scalar_first=True)
    return q


def within(time: np.ndarray, nodes: np.ndarray) -> np.ndarray:
    """Which times (n,) lie between the first and the last of ``nodes`` (m,), as row numbers."""
    return np.flatnonzero((time >= nodes[0]) & (time <= nodes[-1]))
