"""The attitude, the bias and their uncertainty before the first sample of a recording: from its first seconds at rest."""

from __future__ import annotations

import casadi as ca
import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.attitude.columns import extra_column, recorded_heading, temperature_of
from pyimu.attitude.compensation import Compensation
from pyimu.attitude.rest import Rest
from pyimu.attitude.variables import EXTRA_INPUTS
from pyimu.errors import UserError
from pyimu.imu import Part
from pyimu.recording import Recording
from pyimu.signals import SIGNALS
from pyimu.symbolic import quaternion
from pyimu.symbolic.earth import earth_rate

TILT_STD = 0.01
"""rad; of an attitude levelled at rest: an accelerometer's turn-on bias of 10 mg."""

MOVING_TILT_STD = 0.3
"""rad; of an attitude levelled while moving."""

YAW_STD = 1e-3
"""rad; yaw starts at the given heading, or defines where it is zero."""

BIAS_STD = 0.01
"""rad/s; of the bias of a gyro that was not seen at rest."""


def initial_values(recording: Recording, part: Part, rest: Rest, latitude: float, q0,
                    heading0: float | None) -> dict[str, float]:
    """Start values of the filter, by parameter name."""
    rate, force = _compensated(part, rest, recording)
    yaw, yaw_std = _initial_yaw(recording, heading0)
    attitude = _levelled(force, yaw) if q0 is None else _given(q0)
    tilt_std = TILT_STD if rest.seen or q0 is not None else MOVING_TILT_STD
    axes = attitude.inv().as_matrix()
    attitude_std = np.sqrt(axes ** 2 @ np.array([tilt_std, tilt_std, yaw_std]) ** 2)
    earth = np.array(earth_rate(ca.DM(latitude))).ravel() if abs(latitude) <= np.pi / 2 else np.zeros(3)
    bias = rate - attitude.inv().apply(earth) if rest.seen else np.zeros(3)
    bias_std = np.hypot(rest.rate_mean_std, 0 if np.any(earth) else 7.3e-5) if rest.seen else np.full(3, BIAS_STD)
    named = {"q0": attitude.as_quat(scalar_first=True), "bias0": bias, "std0": np.concatenate([attitude_std, bias_std])}
    return {"latitude": latitude, **{f"{n}[{i + 1}]": float(v) for n, array in named.items() for i, v in enumerate(array)}}


def _compensated(part: Part, rest: Rest, recording: Recording) -> tuple[np.ndarray, np.ndarray]:
    """Mean rate and specific force (3,) of the rest without the part's own errors, as after a long time at rest."""
    known = {"rate": rest.rate, "specific_force": rest.force, "temperature": _mean(temperature_of(recording, part), rest, 25.0)}
    for signal in EXTRA_INPUTS:
        if signal in part.signals:
            known[signal] = _mean(extra_column(recording, part, signal), rest, SIGNALS[signal].start)
    compensation, h = Compensation(part), ca.SX(recording.sample_period)
    values = {n: ca.SX(ca.DM(v)) for n, v in known.items()} | {"latitude_known": ca.SX(0)}
    _, rate, force, *_ = compensation.apply(ca.SX(ca.DM(compensation.start)), values, ca.SX(ca.DM(part.gyro.p)), ca.SX(ca.DM(part.accel.p)), h)
    return tuple(np.array(ca.evalf(v), dtype=float).ravel() for v in (rate, force))


def _mean(column, rest: Rest, otherwise) -> np.ndarray:
    """Mean of a signal over the rest, ``otherwise`` where it is missing there."""
    if np.ndim(column) == 0:
        return np.atleast_1d(column)
    rows = column[rest.rows]
    rows = rows[np.isfinite(rows).reshape(len(rows), -1).all(axis=1)]
    return np.atleast_1d(rows.mean(axis=0) if len(rows) else otherwise)


def _initial_yaw(recording: Recording, heading0: float | None) -> tuple[float, float]:
    """Yaw of the first sample and its standard deviation in rad."""
    heading, std = recorded_heading(recording)
    known = np.flatnonzero(np.isfinite(heading) & np.isfinite(std))
    if heading0 is None and len(known):
        return float(heading[known[0]]), max(float(std[known[0]]), YAW_STD)
    return (0.0 if heading0 is None else float(heading0)), YAW_STD


def _levelled(force: np.ndarray, yaw: float) -> Rotation:
    """The attitude in which gravity is the only force: roll and pitch from its direction (Groves 2013, eqs. 5.101)."""
    roll, pitch = np.arctan2(force[1], force[2]), np.arctan2(-force[0], np.hypot(force[1], force[2]))
    q = quaternion.from_euler(ca.DM(roll), ca.DM(pitch), ca.DM(yaw))
    return Rotation.from_quat(np.array(q).ravel(), scalar_first=True)


def _given(q0) -> Rotation:
    q0 = np.asarray(q0, dtype=float)
    if q0.shape != (4,) or not np.linalg.norm(q0) > 0:
        raise UserError(f"q0 is {q0.tolist()}, expected four numbers (w, x, y, z) that are not all zero")
    return Rotation.from_quat(q0, scalar_first=True)
