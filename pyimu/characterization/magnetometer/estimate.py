"""A magnetometer's calibration from a log in which it turns, with what it is known to."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.attitude.calibration import MagnetometerCalibration
from pyimu.attitude.magnetometer import magnetometer_of
from pyimu.attitude.outcome import Outcome
from pyimu.attitude.rest import white_std
from pyimu.characterization.magnetometer.constancy import (
    BIAS,
    DELAY,
    DIP,
    SHAPE,
    UNKNOWNS,
    Attitudes,
    Constancy,
    fit,
    residuals,
    sphere,
)
from pyimu.errors import UserError
from pyimu.recording.recording import Recording
from pyimu.recording.rest import rests
from pyimu.report.numbers import joined

TURN = 0.03
"""rad; turn over which samples are averaged: over it a direction bends by a ten-thousandth."""

LEAST = 10
"""Attitudes for each unknown, at least."""

STEP = 1e-5
"""Of the matrix, for the slope of its rotation."""

LEAST_LEVEL = 1e-3
"""Least square of the horizontal share of the field that tells of a turn: a dip of 88 degrees."""

WEAKEST = 0.1
"""Least information of an attitude about any combination of the unknowns, as a share of what it is
for a body that turns every way: the combination is known to no worse than three times that."""


@dataclass(frozen=True, eq=False)
class MagnetometerFit:
    """A magnetometer's ``calibration`` as a log shows it.

    ``covariance`` (12, 12) is that of bias in T and matrix row by row; the log says nothing of the
    strength of the field in true tesla, so that the matrix has a determinant of 1. ``strength`` T
    and ``dip`` rad, down, are the field's, ``delay`` s is the magnetometer's behind the
    accelerometer, each with its ``_std``. ``along`` and ``across`` are the RMS in T of what
    strength and dip are off, samples that are far off weighed less. ``noise`` (3,) T sqrt(s) is the
    root of the two-sided density of the white noise at rest, NaN without a rest. It was found in so
    many ``attitudes`` and ``blocks``.
    """

    calibration: MagnetometerCalibration
    covariance: np.ndarray
    strength: float
    strength_std: float
    dip: float
    dip_std: float
    delay: float
    delay_std: float
    along: float
    across: float
    noise: np.ndarray
    attitudes: int
    blocks: int

    @property
    def bias_std(self) -> np.ndarray:
        """T, (3,)."""
        return np.sqrt(np.diag(self.covariance)[:3])

    @property
    def matrix_std(self) -> np.ndarray:
        """(3, 3)."""
        return np.sqrt(np.diag(self.covariance)[3:].reshape(3, 3))

    @property
    def misalignment(self) -> np.ndarray:
        """rad, (3,); by how much the sensor's axes are turned against the accelerometer's, about
        its axes: the rotation in the matrix beside a symmetric part.
        """
        return _turn_in(self.calibration.matrix)

    @property
    def misalignment_std(self) -> np.ndarray:
        """rad, (3,)."""
        steps = STEP * np.eye(9).reshape(9, 3, 3)
        matrix = self.calibration.matrix
        slope = np.array([_turn_in(matrix + v) - _turn_in(matrix - v) for v in steps]).T / 2 / STEP
        return np.sqrt(np.diag(slope @ self.covariance[3:, 3:] @ slope.T))

    @property
    def direction_std(self) -> float:
        """rad; root mean square, over all directions of the field, of the error of its direction
        that the covariance leaves, about one axis.
        """
        # Of f = matrix^-1 (m - bias) the error is matrix^-1 of that of bias / F + matrix f / F.
        inverse = np.linalg.inv(self.calibration.matrix)
        found = 0.0
        for ahead in directions():
            row = np.kron(np.eye(3), ahead)
            slope = inverse @ np.column_stack([np.eye(3) / self.strength, row])
            across = np.eye(3) - np.outer(ahead, ahead)
            found += np.trace(across @ slope @ self.covariance @ slope.T) / 2
        return float(np.sqrt(found / len(directions())))


def _turn_in(matrix: np.ndarray) -> np.ndarray:
    """The rotation vector (3,) of the polar decomposition of a matrix."""
    u, _, v = np.linalg.svd(matrix)
    return Rotation.from_matrix(u @ v).as_rotvec()


def directions() -> np.ndarray:
    """Unit vectors (26, 3) all round: the faces, edges and corners of a cube."""
    grid = np.stack(np.meshgrid(*3 * [[-1, 0, 1]]), axis=-1).reshape(-1, 3)
    grid = grid[np.any(grid, axis=1)]
    return grid / np.linalg.norm(grid, axis=1)[:, None]


def magnetometer_fit(recording: Recording, attitude: Outcome) -> MagnetometerFit:
    """The calibration of a recording's magnetometer.

    ``attitude`` is that of the recording without the magnetometer, of which the tilt counts. What
    the field of a place has that comes back with the attitude (iron beside which the sensor is
    turned) is taken for the sensor's, and not in the covariance: to be turned outdoors.

    Raises UserError where there is no magnetometer, and where the body turned about too few axes.
    """
    seen = magnetometer_of(recording, True)
    if recording.mag is None or seen.findings and not seen.strength > 0:
        raise UserError(f"{recording.name}: no magnetometer that could be calibrated")
    if seen.findings and seen.findings[0].kind == "mag_axis_missing":
        axes = seen.findings[0].detail["axes"]
        raise UserError(f"{recording.name}: the magnetometer's axis {axes} shows zeros alone")
    a = attitudes_of(recording, attitude, seen.strength)
    few = f"{recording.name}: the magnetometer cannot be calibrated: it was seen in {len(a)}"
    if len(a) < LEAST * UNKNOWNS:
        raise UserError(
            f"{few} attitudes {np.degrees(TURN):.1f} deg apart, at least {LEAST * UNKNOWNS} are "
            "needed: turn the sensor about all three of its axes"
        )
    missing = missing_turns(sphere(a), a)
    if missing:
        raise UserError(
            f"{few} attitudes that do not tell all of bias, soft iron and misalignment: turn the "
            f"sensor all round about {len(missing)} more ax{'es' if len(missing) > 1 else 'is'} "
            f"({joined(missing)}), held level, once with each end ahead"
        )
    return _result(recording, fit(a), seen.strength, len(a))


def attitudes_of(recording: Recording, attitude: Outcome, unit: float) -> Attitudes:
    """Samples of the magnetometer in ``unit`` T, averaged over turns by ``TURN``."""
    fresh = fresh_rows(recording.mag)
    body = Rotation.from_quat(attitude.q, scalar_first=True)
    up = body.apply([0, 0, 1], inverse=True)
    rate = np.nan_to_num(recording.gyro - attitude.gyro_bias)
    period = recording.sample_period
    noise = np.sum(white_std(rate[rest_rows(recording)]) ** 2)
    turned = np.sqrt(np.maximum(np.sum(rate**2, axis=1) - 4 * noise, 0)) * period
    cell = np.floor(np.cumsum(turned) / TURN)[fresh]
    starts = np.flatnonzero(np.diff(cell, prepend=-1))
    count = np.diff(np.append(starts, len(cell)))[:, None]
    mag, passing = recording.mag[fresh] / unit, -np.cross(rate, up)[fresh]
    columns = (recording.time[fresh, None], mag, up[fresh], passing)
    time, *rest = (np.add.reduceat(v, starts, axis=0) / count for v in columns)
    return Attitudes(time.ravel(), *rest)


def fresh_rows(mag: np.ndarray) -> np.ndarray:
    """Rows with a sample that is not the one before, held for a faster log."""
    there = np.isfinite(mag).all(axis=1) & np.any(mag != 0, axis=1)
    rows = np.flatnonzero(there)
    new = np.any(np.diff(mag[rows], axis=0, prepend=np.inf) != 0, axis=1)
    return rows[new]


def rest_rows(recording: Recording) -> np.ndarray:
    """Rows at rest."""
    pieces = [np.arange(start, stop) for start, stop in rests(recording)]
    return np.concatenate([np.empty(0, dtype=int), *pieces])


def missing_turns(x: np.ndarray, a: Attitudes) -> list[str]:
    """The body's axes about which it must turn, too, so that all unknowns are seen; none if so."""
    names, more = [], a
    while weakest(x, more) < WEAKEST and len(names) < 3:
        open_ = [n for n in "xyz" if n not in names]
        tried = {n: more.joined(_turn_about("xyz".index(n), x, len(a))) for n in open_}
        best = max(tried, key=lambda n: weakest(x, tried[n]))
        names.append(best)
        more = tried[best]
    return sorted(names)


def weakest(x: np.ndarray, a: Attitudes) -> float:
    """The least information that an attitude has, on average, about a combination of unknowns.

    It is 1 for a body that turns every way: then a turn of the sensor's axes is what is known
    least, by the dip, to cos(D)^2 / 6 in squares of the field's strength and of a radian.
    """
    size = np.cbrt(np.linalg.det(x[SHAPE].reshape(3, 3)))
    unit = np.concatenate([np.full(3, 1 / size), np.full(9, size), np.ones(1)])
    slope = residuals(x, a)[1][:, :, :DELAY].reshape(-1, DELAY) * unit
    least = float(np.linalg.eigvalsh(slope.T @ slope / len(a))[0])
    return 6 * least / max(1 - x[DIP] ** 2, LEAST_LEVEL)


def _turn_about(axis: int, x: np.ndarray, count: int) -> Attitudes:
    """``count`` attitudes of two turns about an axis that is held level, half across the field, and
    then its other end.
    """
    along = np.eye(3)[axis]
    turn = Rotation.from_rotvec(np.linspace(0, 2 * np.pi, count, endpoint=False)[:, None] * along)
    up = turn.apply(np.roll(along, 1))
    sine = np.clip(x[DIP], -1, 1)
    end = np.where(np.arange(count) % 2, 1, -1)[:, None]
    ahead = (end * along + np.cross(up, along)) / np.sqrt(2)
    field = sine * up + np.sqrt(1 - sine**2) * ahead
    mag = field @ np.linalg.inv(x[SHAPE].reshape(3, 3)).T + x[BIAS]
    return Attitudes(np.zeros(count), mag, up, np.zeros_like(up))


def _result(recording: Recording, found: Constancy, unit: float, count: int) -> MagnetometerFit:
    x = found.x
    inverse = np.linalg.inv(x[SHAPE].reshape(3, 3))
    size = np.cbrt(np.linalg.det(inverse))
    matrix = inverse / size
    slope = np.zeros((13, UNKNOWNS))
    slope[:3, BIAS] = unit * np.eye(3)
    # d(T^-1) = -T^-1 dT T^-1, and the cube root of its determinant grows by a third of its trace.
    change = -np.einsum("ai,jb->abij", inverse, inverse).reshape(9, 9) / size
    share = -inverse.T.ravel() / 3
    slope[3:12, SHAPE] = change - np.outer(matrix.ravel(), share)
    slope[12, SHAPE] = unit * size * share
    covariance = slope @ found.covariance @ slope.T
    std = np.sqrt(np.diag(found.covariance))
    sine = float(np.clip(x[DIP], -1, 1))
    strength = float(unit * size)
    return MagnetometerFit(
        MagnetometerCalibration(unit * x[BIAS], matrix),
        covariance[:12, :12],
        strength,
        float(np.sqrt(covariance[12, 12])),
        float(-np.arcsin(sine)),
        float(std[DIP] / np.sqrt(max(1 - sine**2, LEAST_LEVEL))),
        float(x[DELAY]),
        float(std[DELAY]),
        *(strength * found.std).tolist(),
        _noise(recording),
        count,
        found.blocks,
    )


def _noise(recording: Recording) -> np.ndarray:
    fresh = fresh_rows(recording.mag)
    still = np.intersect1d(fresh, rest_rows(recording))
    if len(still) < 3 or len(fresh) < 2:
        return np.full(3, np.nan)
    period = float(np.median(np.diff(recording.time[fresh])))
    return white_std(recording.mag[still]) * np.sqrt(period)
