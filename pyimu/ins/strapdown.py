"""Navigation by integration alone: the equations of Wongwirat 2010, and exact ones beside them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import casadi as ca
import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.block.block import Block, Run
from pyimu.block.parameters import number
from pyimu.block.plain import plain_function
from pyimu.block.variables import Variable, array
from pyimu.errors import UserError
from pyimu.ins.filter.mechanisation import moved, turned
from pyimu.plant.low_pass import low_pass
from pyimu.recording.recording import Recording
from pyimu.symbolic import quaternion
from pyimu.symbolic.earth import earth_rate
from pyimu.units import STANDARD_GRAVITY

CUTOFF = 10.0
"""Hz; of the paper's low-pass, which it does not tell: below the vibration of a small robot, above
what its wheels can do."""

INPUTS = (*array("gyro", "rad/s", "rate, body axes"), *array("accel", "m/s^2", "force, body axes"))

PARAMETERS = (
    *array("q0", "1", "attitude at the first sample", (1.0, 0.0, 0.0, 0.0)),
    *array("velocity0", "m/s", "velocity at the first sample"),
    *array("earth", "rad/s", "the Earth's rate in the world"),
    Variable("gravity", "m/s^2", "magnitude of gravity", STANDARD_GRAVITY),
    Variable("orthonormal", "1", "the direction cosines are made orthonormal after each step"),
)

OUTPUTS = (
    *array("matrix", "1", "direction cosines, body to world, row by row", (0.0,) * 9),
    *array("velocity", "m/s", "velocity"),
    *array("position", "m", "position"),
)


@dataclass(frozen=True, eq=False)
class Path:
    """What an integration gives at n samples.

    ``time`` (n,) s; ``matrix`` (n, 3, 3) body to east-north-up; ``velocity`` m/s and ``position`` m
    (n, 3), from 0 at the first.
    """

    time: np.ndarray
    matrix: np.ndarray
    velocity: np.ndarray
    position: np.ndarray

    @property
    def euler(self) -> np.ndarray:
        """Roll, pitch, yaw (n, 3) in rad of eq. 5, as the matrix has them, orthonormal or not."""
        c = self.matrix
        return np.column_stack(
            [
                np.arctan2(c[:, 2, 1], c[:, 2, 2]),
                np.arctan2(-c[:, 2, 0], np.hypot(c[:, 0, 0], c[:, 1, 0])),
                np.arctan2(c[:, 1, 0], c[:, 0, 0]),
            ]
        )

    @property
    def q(self) -> np.ndarray:
        """The nearest attitude (n, 4), scalar first; NaN where the matrix is none."""
        good = np.isfinite(self.matrix).all(axis=(1, 2)) & (np.linalg.det(self.matrix) > 0)
        out = np.full((len(self.time), 4), np.nan)
        out[good] = Rotation.from_matrix(self.matrix[good]).as_quat(scalar_first=True)
        return out


def strapdown(
    recording: Recording,
    q0: np.ndarray,
    velocity0: np.ndarray | None = None,
    latitude: float | None = None,
    gravity: float = STANDARD_GRAVITY,
) -> Path:
    """The path of a recording by the equations of ``pyimu.ins.filter.mechanisation``.

    Exact rotation over a step with the coning of its two samples, velocity and position by the
    trapezoid in world axes, the Earth's rate and Coriolis force where ``latitude`` in rad is known.
    ``q0`` (4,) is the attitude, ``velocity0`` (3,) m/s the velocity of the first sample.

    Raises UserError for a recording without both sensors or with missing samples.
    """
    earth = np.zeros(3) if latitude is None else np.array(ca.DM(earth_rate(latitude))).ravel()
    p = np.concatenate([q0, np.zeros(3) if velocity0 is None else velocity0, earth, [gravity, 0]])
    return _run(_exact(), recording, p, _samples(recording))


def strapdown_wongwirat(
    recording: Recording,
    q0: np.ndarray | None = None,
    *,
    cutoff: float | None = CUTOFF,
    nulls: float | None = None,
    orthonormal: bool = False,
    gravity: float = STANDARD_GRAVITY,
) -> Path:
    """The path of a recording as Wongwirat 2010 makes it, section 2, eqs. 1 to 8.

    Low-pass of all channels at ``cutoff`` Hz (section 3; None: none), the direction cosines by C +
    C [w x] dt (eqs. 7 and 8, with dt, which the print lacks, and the signs of a rotation), f_n = C
    f_b (eq. 6), gravity taken off (in no equation), and v, x with the acceleration held over a step
    (eqs. 1 to 3). No Earth rate. Without ``q0`` (4,) the body starts level, with yaw 0.

    What the paper leaves out and its text regrets can be added: ``nulls``, the s at the start whose
    mean rate, and whose mean force less gravity along the start attitude, is taken off all samples;
    ``orthonormal`` makes the matrix orthonormal after each step.

    Raises UserError as ``strapdown`` does, and for nulls without samples.
    """
    q0 = np.array([1.0, 0.0, 0.0, 0.0]) if q0 is None else np.asarray(q0, dtype=float)
    u = _samples(recording)
    if nulls is not None:
        rows = recording.time <= recording.time[0] + number("nulls", nulls)
        if np.count_nonzero(rows) < 2:
            raise UserError(f"{recording.name}: no two samples in the first {nulls:g} s for nulls")
        level = Rotation.from_quat(q0, scalar_first=True).inv().apply([0.0, 0.0, gravity])
        u = u - u[rows].mean(axis=0) + np.concatenate([np.zeros(3), level])
    if cutoff is not None:
        u = _filtered(u, cutoff, recording.sample_period)
    p = np.concatenate([q0, np.zeros(6), [gravity, float(orthonormal)]])
    return _run(_printed(), recording, p, u)


def _filtered(u: np.ndarray, cutoff: float, period: float) -> np.ndarray:
    return low_pass(period, cutoff).run(u)[0]


def _samples(recording: Recording) -> np.ndarray:
    for name in ("gyro", "accel"):
        values = getattr(recording, name)
        if values is None:
            raise UserError(
                f"{recording.name}: no {name}; a position takes {name}_x, {name}_y, {name}_z"
            )
        if not np.isfinite(values).all():
            row = int(np.flatnonzero(~np.isfinite(values).all(axis=1))[0])
            raise UserError(
                f"{recording.name}: {name} is missing at {recording.time[row]:g} s; integration "
                "alone takes every sample (the filter does not)"
            )
    return np.column_stack([recording.gyro, recording.accel])


def _run(block: Block, recording: Recording, p: np.ndarray, u: np.ndarray) -> Path:
    """The block over samples (n, 6), each run of them with its own period."""
    run, y = Run(block, len(u), p=p), np.empty((len(u), len(OUTPUTS)))
    run.advance(u[:1], y=y[:1], sample_period=recording.sample_period)
    start = 1
    for stop, period in _periods(recording):
        run.advance(u[start:stop], y=y[start:stop], sample_period=period)
        start = stop
    matrix = y[:, :9].reshape(-1, 3, 3)
    return Path(recording.time, matrix, y[:, 9:12].copy(), y[:, 12:15].copy())


def _periods(recording: Recording) -> list[tuple[int, float]]:
    """Rows up to which each sample period in s holds: between gaps the mean one, and over a gap its
    own length.
    """
    found: list[tuple[int, float]] = []
    for start, stop in recording.segments:
        if start:
            found.append((start + 1, float(recording.time[start] - recording.time[start - 1])))
        if stop - start > 1:
            span = recording.time[stop - 1] - recording.time[start]
            found.append((stop, float(span) / (stop - start - 1)))
    return found


# The blocks


def _symbols() -> tuple:
    s, u, p, h = (
        ca.SX.sym(n, k) for n, k in (("s", 22), ("u", 6), ("p", len(PARAMETERS)), ("h", 1))
    )
    return s, u, p, h


def _block(name: str, advance) -> Block:
    """A block whose state is the matrix (9, by columns), velocity, position, the last samples (6)
    and whether there was one.
    """
    s, u, p, h = _symbols()
    matrix, velocity, position = ca.reshape(s[:9], 3, 3), s[9:12], s[12:15]
    after = advance(matrix, velocity, position, s[15:21], u, p, h)
    start = (quaternion.to_matrix(quaternion.normalized(p[:4])), p[4:7], ca.SX.zeros(3))
    kept = [ca.if_else(s[21] > 0, a, b) for a, b in zip(after, start, strict=True)]
    state = ca.vertcat(ca.vec(kept[0]), kept[1], kept[2], u, 1)
    y = ca.vertcat(ca.vec(kept[0].T), kept[1], kept[2])
    step = plain_function(
        "step",
        [s, u, p, ca.SX(0, 1), h],
        [state, y],
        ["s", "u", "p", "w", "h"],
        ["s_next", "y"],
        {"cse": True},
    )
    initial = plain_function(
        "initial", [u, p], [ca.SX(22, 1) + 0, ca.SX(15, 1) + 0], ["u", "p"], ["s", "y"]
    )
    return Block(name, name, step, initial, INPUTS, PARAMETERS, OUTPUTS, (), 0.01)


@lru_cache(maxsize=1)
def _exact() -> Block:
    def advance(matrix, velocity, position, last, u, p, h):
        earth, gravity = p[7:10], p[10]
        q = _quaternion(matrix)
        after = quaternion.normalized(turned(q, (last[:3], u[:3]), earth, h))
        forces = (last[3:], u[3:])
        v, x = moved((q, after), forces, velocity, position, earth, gravity, h)
        return quaternion.to_matrix(after), v, x

    return _block("Strapdown", advance)


@lru_cache(maxsize=1)
def _printed() -> Block:
    def advance(matrix, velocity, position, last, u, p, h):
        c = matrix + matrix @ ca.skew(last[:3]) * h
        c = ca.if_else(p[11] > 0, _orthonormal(c), c)
        acceleration = c @ u[3:] - ca.vertcat(0, 0, p[10])
        v = velocity + acceleration * h
        return c, v, position + velocity * h + acceleration * (h * h / 2)

    return _block("StrapdownWongwirat", advance)


def _orthonormal(c):
    """The rows made orthogonal to first order, and of length 1 (Groves 2013, eqs. 5.80, 5.81)."""
    off = c @ c.T - ca.SX.eye(3)
    return c - off @ c / 2


def _quaternion(matrix):
    """The attitude (4,) of an orthonormal matrix without branches on the trace.

    Of the four expressions the one with the largest pivot (Shepperd 1978).
    """
    m = matrix
    trace = m[0, 0] + m[1, 1] + m[2, 2]
    pivots = [1 + trace] + [1 + 2 * m[i, i] - trace for i in range(3)]
    a, b, c = m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]
    d, e, f = m[0, 1] + m[1, 0], m[0, 2] + m[2, 0], m[1, 2] + m[2, 1]
    rows = [
        ca.vertcat(pivots[0], a, b, c),
        ca.vertcat(a, pivots[1], d, e),
        ca.vertcat(b, d, pivots[2], f),
        ca.vertcat(c, e, f, pivots[3]),
    ]
    best, found = pivots[0], rows[0]
    for pivot, row in zip(pivots[1:], rows[1:], strict=True):
        found = ca.if_else(pivot > best, row, found)
        best = ca.fmax(pivot, best)
    return quaternion.normalized(found)
