"""The attitude filter over a recording."""

from __future__ import annotations

import os
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace

import casadi as ca
import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.attitude.alignment import Yaw, initial_values, initial_yaw
from pyimu.attitude.columns import (
    CHUNK,
    NOMINAL_RATE_NOISE,
    Columns,
    latitude_of,
    nominal_part,
    number,
    settings_of,
)
from pyimu.attitude.compensation import noise_of
from pyimu.attitude.rest import Rest, find_rest
from pyimu.attitude.ukf import attitude_ukf
from pyimu.attitude.variables import LEAST_K, OWN_PARAMETERS, STATUS
from pyimu.block.block import Block, Run
from pyimu.block.variables import Variable
from pyimu.errors import UserError
from pyimu.model.part import Part
from pyimu.model.part_file import part as part_of
from pyimu.recording.recording import Recording


@dataclass(frozen=True, eq=False)
class AttitudeResult:
    """What the filter said, a row for each of the recording's.

    ``time`` (n,) s; ``q`` (n, 4), body to world, scalar first; ``gyro_bias`` (n, 3) rad/s; ``std``
    (n, 6), of the attitude error in body axes in rad and of the bias in rad/s; ``quasi_static``
    (n,) bool; ``nis`` (n,), 0 without a gravity update; ``status`` (n,) int, bits of
    ``pyimu.attitude.STATUS``. ``parameters`` are the values with which ``AttitudeUkf`` says the
    same.
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
    parameters: Mapping[str, float] = field(default_factory=dict, repr=False)

    @property
    def euler(self) -> np.ndarray:
        """Roll, pitch, yaw (n, 3) in rad."""
        return Rotation.from_quat(self.q, scalar_first=True).as_euler("ZYX")[:, ::-1]

    def report(self) -> str:
        """A few lines for a terminal."""
        duration = self.time[-1] - self.time[0]
        start = (
            f"{self.rest.duration:.1f} s at rest" if self.rest and self.rest.seen else "in motion"
        )
        roll, pitch, yaw = np.degrees(self.euler[-1])
        bias, bias_std = np.degrees(self.gyro_bias[-1]), np.degrees(self.std[-1, 3:])
        updated = self.nis[self.nis > 0]
        lines = [
            f"{self.name}: {len(self.time)} samples, {duration:.1f} s, starts {start}",
            (
                f"  last attitude   roll {roll:.2f}, pitch {pitch:.2f}, yaw {yaw:.2f} deg; "
                f"std {', '.join(f'{s:.2f}' for s in np.degrees(self.std[-1, :3]))} deg (body x, "
                "y, z)"
            ),
            "  last gyro bias  "
            + ", ".join(f"{b:.4f} +- {s:.4f}" for b, s in zip(bias, bias_std))
            + " deg/s",
            f"  quasi-static    {np.mean(self.quasi_static):.1%} of the samples"
            + (
                f", mean NIS {updated.mean():.3g} (3 degrees of freedom, if accelerations are as "
                "accel_std)"
                if len(updated)
                else ""
            ),
        ]
        lines += [
            f"  status {bit}        {count} samples: {text}"
            for bit, text in STATUS.items()
            if (count := int(np.sum(self.status & bit > 0)))
        ]
        return "\n".join(lines)

    __str__ = report


def run(
    recording: Recording,
    part: Part | str | os.PathLike | None = None,
    *,
    latitude: float | None = None,
    q0: np.ndarray | None = None,
    heading0: float | None = None,
    bias0: np.ndarray | None = None,
    std0: np.ndarray | None = None,
    settings: Mapping[str, float] | None = None,
) -> AttitudeResult:
    """The attitude of a recording, by the filter of ``part`` (without one: of its noise at rest
    alone).

    ``latitude`` [rad] (else the recording's, else no Earth rate is subtracted), ``q0`` (4,) and
    ``heading0`` [rad] the attitude or the yaw of the first sample, ``bias0`` (3,) [rad/s] the gyro
    bias, ``std0`` (6,) the standard deviations of attitude in body axes [rad] and bias [rad/s];
    what is not given comes from the first seconds at rest, and yaw from the first recorded heading,
    or is zero. ``settings`` are values of other parameters of the block, by name. ``part`` is a
    ``Part``, the name of one, or a TOML file. A gap widens the estimate, and the row after it has
    bit 1 of the status. Raises UserError for a recording without gyro or with one row, a latitude
    beyond pi/2, a quaternion without length, other than so many finite numbers, and a setting that
    is unknown or outside its bounds.
    """
    if recording.gyro is None:
        raise UserError(f"{recording.name}: no gyro, an attitude needs gyro_x, gyro_y, gyro_z")
    if len(recording.time) < 2:
        raise UserError(f"{recording.name}: one sample, an attitude over time needs two or more")
    latitude, heading0 = (
        latitude_of(recording, latitude),
        None if heading0 is None else number("heading0", heading0),
    )
    rest = find_rest(recording)
    nominal, part = part is None, nominal_part(recording, rest) if part is None else part_of(part)
    block = attitude_ukf(part)

    def turned(row: int) -> float:
        cadence = recording.cadence
        before = replace(
            recording.slice(None, row + 1),
            heading=None,
            heading_std=None,
            period=cadence.period,
            longest=cadence.longest,
        )
        return float(
            run(
                before,
                part,
                latitude=latitude if abs(latitude) <= np.pi / 2 else None,
                bias0=bias0,
                settings=settings,
            ).euler[-1, 2]
        )

    yaw = initial_yaw(recording, rest, heading0, turned) if q0 is None else Yaw()
    values = {
        **settings_of(recording, part, rest),
        **initial_values(recording, part, rest, latitude, q0, yaw),
    }
    values |= _numbered("bias0", bias0, 3) | _numbered("std0", std0, 6)
    if nominal:
        values["rate_noise"] = NOMINAL_RATE_NOISE
    p = _parameters(block, {**values, **(settings or {})})
    columns = Columns(recording, part, [v.name for v in block.inputs])
    steps = Run(block, columns.rows[-1] + 1, p=p, sample_period=recording.sample_period)
    outputs = _outputs(block, columns, steps, _walk(part, p))
    outputs["status"][columns.after_gap] |= 1
    return AttitudeResult(
        getattr(recording, "name", "recording"),
        recording.time,
        **outputs,
        rest=rest,
        parameters={v.name: value for v, value in zip(block.parameters, p.tolist(), strict=True)},
    )


def _numbered(name: str, values, size: int) -> dict[str, float]:
    """A given vector as parameters; nothing where it is not given."""
    if values is None:
        return {}
    try:
        array = np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        array = np.zeros(0)
    if array.shape != (size,) or not np.isfinite(array).all():
        raise UserError(f"{name} is {str(values)[:60]}, expected {size} finite numbers")
    return {f"{name}[{i + 1}]": float(v) for i, v in enumerate(array)}


def _parameters(block: Block, values: Mapping[str, float]) -> np.ndarray:
    """The block's parameters with ``values`` by name. Raises UserError for an unknown name, and
    for what is outside the bounds.
    """
    at = {v.name: i for i, v in enumerate(block.parameters)}
    p = block.start.copy()
    for name, value in values.items():
        if name not in at:
            raise UserError(
                f"unknown setting '{name}' of the attitude filter; known are {', '.join(at)}"
            )
        p[at[name]] = value if name == "latitude" else _bounded(block.parameters[at[name]], value)
    return p


def _bounded(variable: Variable, value) -> float:
    value, low, high = number(variable.name, value), variable.minimum, variable.maximum
    if low is not None and value < low or high is not None and value > high:
        raise UserError(
            f"{variable.name} is {value:g} {variable.unit}, expected "
            + " to ".join(f"{v:g}" for v in (low, high) if v is not None)
            + (" or more" if high is None else "")
        )
    return value


OUTPUTS = {
    "q": (4, float),
    "gyro_bias": (3, float),
    "std": (6, float),
    "quasi_static": (0, bool),
    "nis": (0, float),
    "status": (0, np.uint8),
}
"""Of the block's outputs those that a result keeps, how many numbers each has (0: one, without an
axis), and their type."""


def _walk(part: Part, p: np.ndarray) -> np.ndarray:
    """Variance (3,) by which the gyro's bias walks in a second, (rad/s)^2/s, as the filter has
    it.
    """
    first = len(OWN_PARAMETERS)
    walk = noise_of(
        part.gyro, ca.SX(ca.DM(p[first : first + len(part.gyro.slots)])), 1 / part.sample_rate
    ).walk
    return np.array(ca.evalf(walk), dtype=float).ravel() ** 2 + LEAST_K**2


BIAS_VARIANCE = tuple(7 + i for i in (15, 18, 20))
"""Where the block's state has the variances of the bias: q (4), bias (3), and the upper triangle of
the covariance row by row."""


def _outputs(block: Block, columns: Columns, steps: Run, walk: np.ndarray) -> dict[str, np.ndarray]:
    """The outputs at the recording's rows; the bias walks on over what a gap exceeds its missing
    samples by.

    A second thread puts away what has been made, as memory that is touched for the first time can
    cost more than the filter.
    """
    names = [v.name for v in block.outputs]
    at = {n: names.index(f"{n}[1]" if size else n) for n, (size, _) in OUTPUTS.items()}
    out = {
        n: np.empty((len(columns.rows), size) if size else len(columns.rows), dtype=kind)
        for n, (size, kind) in OUTPUTS.items()
    }

    def keep(y: np.ndarray, rows: slice, where: np.ndarray) -> None:
        found = y if len(where) == len(y) else y[where]
        for n, (size, _) in OUTPUTS.items():
            out[n][rows] = found[:, at[n] : at[n] + size] if size else found[:, at[n]]

    with ThreadPoolExecutor(1) as second:
        buffers, kept = (
            [np.empty((min(CHUNK, columns.rows[-1] + 1), len(names))) for _ in range(2)],
            None,
        )
        for u, rows, where, left_out in columns.pieces():
            steps.state[list(BIAS_VARIANCE)] += walk * left_out
            buffers.reverse()
            y = buffers[0][: len(u)]
            steps.advance(u, y=y)
            if kept is not None:
                kept.result()
            kept = second.submit(keep, y, rows, where)
        kept.result()
    return out
