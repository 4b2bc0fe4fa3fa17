"""The attitude filter over a recording."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import casadi as ca
import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.attitude.rest import Rest, find_rest
from pyimu.attitude.ukf import STATUS, UNKNOWN_LATITUDE, attitude_ukf
from pyimu.block import Block
from pyimu.effect import Sensor
from pyimu.errors import UserError
from pyimu.imu import Part
from pyimu.recording import Recording
from pyimu.signals import COLUMNS, START
from pyimu.symbolic import quaternion
from pyimu.symbolic.earth import earth_rate

TILT_STD = 0.01
"""rad; of an attitude levelled at rest: an accelerometer's turn-on bias of 10 mg."""

MOVING_TILT_STD = 0.3
"""rad; of an attitude levelled while moving."""

YAW_STD = 1e-3
"""rad; yaw starts at the given heading, or defines where it is zero."""

HEADING_STD = 0.035
"""rad; of a recorded heading that comes without a standard deviation."""

BIAS_STD = 0.01
"""rad/s; of the bias of a gyro that was not seen at rest."""

NOMINAL_K = 2e-5
"""rad/s/sqrt(s); rate random walk that is taken for a sensor of which nothing is known, 4 deg/h/sqrt(s)."""

LONGEST_GAP = 60.0
"""s; a gap in the recording counts at most as that long, by when the attitude is lost anyway."""


@dataclass(frozen=True, eq=False)
class AttitudeResult:
    """What the filter said, a row for each of the recording's.

    ``time`` (n,) s; ``q`` (n, 4), body to world, scalar first; ``gyro_bias`` (n, 3) rad/s; ``std`` (n, 6), of the attitude
    error in body axes in rad and of the bias in rad/s; ``quasi_static`` (n,) bool; ``nis`` (n,), 0 without a gravity
    update; ``status`` (n,) int, bits of ``pyimu.attitude.STATUS``.
    """

    name: str
    time: np.ndarray
    q: np.ndarray = field(repr=False)
    gyro_bias: np.ndarray = field(repr=False)
    std: np.ndarray = field(repr=False)
    quasi_static: np.ndarray = field(repr=False)
    nis: np.ndarray = field(repr=False)
    status: np.ndarray = field(repr=False)
    rest: Rest | None = None

    @property
    def euler(self) -> np.ndarray:
        """Roll, pitch, yaw (n, 3) in rad."""
        return Rotation.from_quat(self.q, scalar_first=True).as_euler("ZYX")[:, ::-1]

    def report(self) -> str:
        """A few lines for a terminal."""
        duration = self.time[-1] - self.time[0]
        start = f"{self.rest.duration:.1f} s at rest" if self.rest and self.rest.seen else "in motion"
        roll, pitch, yaw = np.degrees(self.euler[-1])
        bias, bias_std = np.degrees(self.gyro_bias[-1]), np.degrees(self.std[-1, 3:])
        updated = self.nis[self.nis > 0]
        lines = [f"{self.name}: {len(self.time)} samples, {duration:.1f} s, starts {start}",
                 (f"  last attitude   roll {roll:.2f}, pitch {pitch:.2f}, yaw {yaw:.2f} deg; "
                  f"std {', '.join(f'{s:.2f}' for s in np.degrees(self.std[-1, :3]))} deg (body x, y, z)"),
                 "  last gyro bias  " + ", ".join(f"{b:.4f} +- {s:.4f}" for b, s in zip(bias, bias_std)) + " deg/s",
                 f"  quasi-static    {np.mean(self.quasi_static):.1%} of the samples"
                 + (f", mean NIS {updated.mean():.3g} (3 degrees of freedom)" if len(updated) else "")]
        lines += [f"  status {bit}        {count} samples: {text}" for bit, text in STATUS.items()
                  if (count := int(np.sum(self.status & bit > 0)))]
        return "\n".join(lines)

    __str__ = report


def run(recording: Recording, part: Part | None = None, *, latitude: float | None = None, q0: np.ndarray | None = None,
        heading0: float | None = None, settings: Mapping[str, float] | None = None) -> AttitudeResult:
    """The attitude of a recording, by the filter of ``part`` (without one: of its noise at rest alone).

    ``latitude`` [rad] (else the recording's, else no Earth rate is subtracted), ``q0`` (4,) and ``heading0`` [rad] the attitude
    or the yaw of the first sample; otherwise tilt and bias come from the first seconds at rest, and yaw from the first
    recorded heading, or is zero.  ``settings`` are values of other parameters of the block, by name.  Raises UserError
    for a recording without gyro, a latitude beyond pi/2, a quaternion without length or an unknown setting.
    """
    if recording.gyro is None:
        raise UserError(f"{recording.name}: no gyro, an attitude needs gyro_x, gyro_y, gyro_z")
    latitude = _latitude(recording, latitude)
    rest = find_rest(recording)
    part = nominal_part(recording, rest) if part is None else part
    block = attitude_ukf(part)
    values = _initial_values(recording, part, rest, latitude, q0, heading0)
    p = _parameters(block, {**values, **(settings or {})})
    rows = _grid(recording)
    u = np.full((rows[-1] + 1, len(block.inputs)), np.nan)
    u[:, [7, 8, 9, 10]] = 0
    u[rows] = _inputs(recording, _temperature(recording, part))
    y, _ = block.run(u, p=p, sample_period=recording.sample_period)
    return _result(recording, block, y[rows], rest)


def nominal_part(recording: Recording, rest: Rest) -> Part:
    """A part that knows of its sensors only the white noise that they show at rest."""
    n_gyro, n_accel = (s * np.sqrt(recording.sample_period) for s in (rest.rate_std, rest.force_std))
    gyro = Sensor("gyro", {"angle_random_walk": {"N": n_gyro}, "rate_random_walk": {"K": NOMINAL_K}})
    return Part("nominal", 1 / recording.sample_period, gyro, Sensor("accel", {"angle_random_walk": {"N": n_accel}}))


def _latitude(recording: Recording, latitude: float | None) -> float:
    if latitude is None:
        column = getattr(recording, "latitude", None)
        known = column is not None and np.isfinite(column).any()
        return float(np.nanmedian(column)) if known else UNKNOWN_LATITUDE
    if not abs(latitude) <= np.pi / 2:
        raise UserError(f"latitude is {latitude} rad, expected -pi/2 to pi/2")
    return float(latitude)


def _temperature(recording: Recording, part: Part) -> np.ndarray | float:
    """The recorded temperature, else the one at which the part has no thermal bias."""
    if recording.temperature is not None:
        return recording.temperature
    return float(part.gyro.values.get("thermal_bias", {}).get("T0", 25.0))


def _inputs(recording: Recording, temperature) -> np.ndarray:
    """The block's inputs (n, 11)."""
    n = len(recording.time)
    accel = np.full((n, 3), np.nan) if recording.accel is None else recording.accel
    heading, std = _recorded_heading(recording)
    valid = np.isfinite(heading) & np.isfinite(std)
    stationary = getattr(recording, "stationary", None)
    stationary = np.zeros(n) if stationary is None else np.nan_to_num(stationary)
    return np.column_stack([recording.gyro, accel, np.broadcast_to(temperature, n), np.where(valid, heading, 0),
                            np.where(valid, std ** 2, 0), valid, stationary])


def _recorded_heading(recording: Recording) -> tuple[np.ndarray, np.ndarray]:
    """Heading and its standard deviation (n,) rad, NaN where there is none."""
    n = len(recording.time)
    if getattr(recording, "heading", None) is None:
        return np.full(n, np.nan), np.full(n, np.nan)
    std = getattr(recording, "heading_std", None)
    return recording.heading, np.full(n, HEADING_STD) if std is None else std


def _grid(recording: Recording) -> np.ndarray:
    """Sample number (n,) of each row on a regular grid: a gap becomes missing samples, over which the filter widens."""
    steps = np.diff(recording.time) / recording.sample_period
    longest = max(1, round(LONGEST_GAP / recording.sample_period))
    # Only a gap counts: jitter of the time stamps neither drops nor adds a sample.
    counts = np.where(steps > 1.5, np.minimum(np.round(steps), longest), 1).astype(int)
    return np.concatenate([[0], np.cumsum(counts)])


# The start


def _initial_values(recording: Recording, part: Part, rest: Rest, latitude: float, q0,
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
    """Mean rate and specific force (3,) of the rest without the part's own errors."""
    temperature = np.broadcast_to(_temperature(recording, part), len(recording.time))[rest.rows]
    temperature = np.nanmean(temperature) if np.isfinite(temperature).any() else 25.0
    h, around = recording.sample_period, START.copy()
    around[COLUMNS["rate"]], around[COLUMNS["specific_force"]], around[COLUMNS["temperature"]] = rest.rate, rest.force, temperature
    force = part.accel.compensation(part.accel.chain.start, rest.force, around, part.accel.p, h)[1]
    around[COLUMNS["specific_force"]] = np.array(force).ravel()
    rate = part.gyro.compensation(part.gyro.chain.start, rest.rate, around, part.gyro.p, h)[1]
    return np.array(rate).ravel(), np.array(force).ravel()


def _initial_yaw(recording: Recording, heading0: float | None) -> tuple[float, float]:
    """Yaw of the first sample and its standard deviation in rad."""
    heading, std = _recorded_heading(recording)
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


def _parameters(block: Block, values: Mapping[str, float]) -> np.ndarray:
    at = {v.name: i for i, v in enumerate(block.parameters)}
    p = block.start.copy()
    for name, value in values.items():
        if name not in at:
            raise UserError(f"unknown setting '{name}' of the attitude filter; known are {', '.join(at)}")
        p[at[name]] = value
    return p


def _result(recording: Recording, block: Block, y: np.ndarray, rest: Rest) -> AttitudeResult:
    at = {v.name: i for i, v in enumerate(block.outputs)}

    def group(name: str) -> np.ndarray:
        return y[:, at[f"{name}[1]"]:][:, :sum(key.startswith(f"{name}[") for key in at)]

    return AttitudeResult(getattr(recording, "name", "recording"), recording.time, group("q"), group("gyro_bias"), group("std"),
                          y[:, at["quasi_static"]] > 0.5, y[:, at["nis"]], y[:, at["status"]].astype(int), rest)
