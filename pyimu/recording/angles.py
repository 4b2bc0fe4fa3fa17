"""Attitudes as roll, pitch and yaw, the aerospace sequence Rz(yaw) Ry(pitch) Rx(roll)."""

from __future__ import annotations

import warnings

import numpy as np
from scipy.spatial.transform import Rotation

SEQUENCE = "zyx"
"""The axes about which yaw, pitch and roll turn, one after the other, each of the turned body."""


def of_angles(angles: np.ndarray, sequence: str = SEQUENCE) -> np.ndarray:
    """The quaternions (n, 4) of roll, pitch and yaw (n, 3) rad, body to world, scalar first.

    They are the angles about x, y and z, which turn in the ``sequence``.

    NaN where one of the three is missing. Where the nose points straight up or down roll and yaw
    turn about one axis, and each of their pairs gives the attitude all the same. The equation is
    that of ``pyimu.symbolic.quaternion.from_euler``.
    """
    q, seen = np.full((len(angles), 4), np.nan), np.isfinite(angles).all(axis=1)
    if seen.any():
        columns = ["xyz".index(axis) for axis in sequence]
        turned = Rotation.from_euler(sequence.upper(), angles[np.ix_(seen, columns)])
        q[seen] = turned.as_quat(scalar_first=True)
    return q


def angles_of(q: np.ndarray) -> np.ndarray:
    """Roll, pitch, yaw (n, 3) rad of attitudes (n, 4), as ``of_angles`` has them, less whole turns.

    NaN where the attitude is not known.
    """
    angles, seen = np.full((len(q), 3), np.nan), np.isfinite(q).all(axis=1)
    if seen.any():
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of gimbal lock, where one of the two angles is free
            angles[seen] = Rotation.from_quat(q[seen], scalar_first=True).as_euler("ZYX")[:, ::-1]
    return angles
