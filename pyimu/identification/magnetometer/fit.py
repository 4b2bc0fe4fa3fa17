"""The calibration of a magnetometer against attitudes that a reference knows.

A sample is m = A f + b with f = C R^T F, the field F of the log's world turned into the sensor's
axes, which is one and the same wherever the sensor is; A is scale, misalignment and soft iron, b
hard iron and the sensor's own bias. A sample that is d s late shows f - d df/dt. Of A F only the
product of the sizes is seen: A has a determinant of 1. Against ``pyimu.characterization``, which
knows only the vertical, the yaw is known as well, so that the axes need no dip to be told.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.attitude.calibration import MagnetometerCalibration
from pyimu.characterization.magnetometer.constancy import (
    BLOCK,
    DELAY_STD,
    FREEDOM,
    LEAST_BLOCKS,
    MOST_BLOCKS,
    ROUNDS,
    SETTLED,
)
from pyimu.identification.magnetometer.rows import FieldRows, mean_field, unit_of

BIAS, MATRIX, OF_LOG = slice(0, 3), slice(3, 12), 4
"""Where the unknowns are, and how many each log has beside them: field and delay."""

SHARED = 12

BEFORE = np.array([1.0] * 3 + [0.3] * 9)
"""Standard deviations of bias and matrix before the logs show them, as shares of the field: so wide
that they tell nothing of what is seen."""

BEFORE_OF_LOG = np.array([10.0] * 3 + [DELAY_STD])
"""Those of a log's field, as shares of it, and of its delay in s."""

DEGREES = SHARED - 1
"""Unknowns that logs can show: the scale of all axes is none."""

FINEST = 1e-4
"""Standard deviation of a sample that is told from none, as a share of the field, 5 nT on Earth:
without it the scale of all axes, which the prior alone knows, is lost to rounding beside samples
of a simulation without noise. What a log has less of is in the jackknife's factor."""

ROUND_THE_CLOCK = 2000
"""Attitudes that stand for a body that turns every way."""


@dataclass(frozen=True)
class LogField:
    """The field (3,) T of a log in world axes, and the magnetometer's delay in s, with its std."""

    field: np.ndarray
    delay: float
    delay_std: float

    @property
    def strength(self) -> float:
        return float(np.linalg.norm(self.field))

    @property
    def dip(self) -> float:
        """rad below the horizon."""
        return float(np.arctan2(-self.field[2], np.hypot(*self.field[:2])))


@dataclass(frozen=True)
class FieldFit:
    """A calibration with the ``covariance`` (12, 12) of bias in T and matrix row by row; the field
    of each log by its name. Found in so many ``attitudes`` and ``blocks`` of time.
    """

    calibration: MagnetometerCalibration
    covariance: np.ndarray
    fields: dict[str, LogField]
    attitudes: int
    blocks: int


def predicted(c: MagnetometerCalibration, rows: FieldRows, of_log: LogField) -> np.ndarray:
    """What a magnetometer with a calibration shows (k, 3) T in the field of a log."""
    seen = (rows.axes - of_log.delay * rows.passing) @ of_log.field
    return seen @ c.matrix.T + c.bias


def fit(logs: Sequence[FieldRows], start: MagnetometerCalibration, shared: bool = True) -> FieldFit:
    """The most likely unknowns with errors of Student's t; the log's own alone if not ``shared``.

    What the field of a place is off stays off for a while: the covariance is that of independent
    errors times one factor, by which the jackknife's, over blocks of time, is larger; each fit
    without a block is a step of Newton's (Efron 1982, chapter 3).
    """
    unit = unit_of(logs)
    averaged = [r.attitudes() for r in logs]
    problem = _Problem([_in_unit(r, unit) for r in averaged], start, unit, shared)
    x, covariance, moved = problem.solved()
    blocks = len(moved)
    slope = np.zeros((SHARED, SHARED))
    matrix, size, share = _of_determinant_one(x[MATRIX].reshape(3, 3))
    slope[BIAS, BIAS] = unit * np.eye(3)
    slope[MATRIX, MATRIX] = np.eye(9) / size - np.outer(matrix.ravel(), share)
    of_shared = slope @ covariance[:SHARED, :SHARED] @ slope.T
    dispersion = 1.0
    if shared:
        away = (moved - moved.mean(axis=0))[:, :SHARED] @ (shown(of_shared) @ slope).T
        dispersion = float(np.sum(away**2) * (blocks - 1) / blocks / DEGREES)
    std = np.sqrt(dispersion * np.diag(covariance))
    fields = {
        r.name: LogField(unit * size * x[at][:3], float(x[at][3]), float(std[at][3]))
        for r, at in zip(logs, problem.places, strict=True)
    }
    return FieldFit(
        MagnetometerCalibration(unit * x[BIAS], matrix),
        dispersion * of_shared,
        fields,
        sum(map(len, averaged)),
        blocks,
    )


def shown(covariance: np.ndarray) -> np.ndarray:
    """Combinations (11, 12) of bias and matrix that the ``covariance`` (12, 12) makes independent
    and of variance 1; of the twelfth, the scale of all axes, it is singular.
    """
    scale = 1 / np.sqrt(np.diag(covariance))
    values, axes = np.linalg.eigh(covariance * np.outer(scale, scale))
    return (axes[:, 1:] / np.sqrt(values[1:])).T * scale


def _in_unit(rows: FieldRows, unit: float) -> FieldRows:
    of_field = ("mag", "white", "turned")
    return replace(rows, **{n: getattr(rows, n) / unit for n in of_field})


def _of_determinant_one(matrix: np.ndarray) -> tuple[np.ndarray, float, np.ndarray]:
    """The matrix over its size, that size, and the slope (9,) of the size as a share of it."""
    size = float(np.cbrt(np.linalg.det(matrix)))
    return matrix / size, size, np.linalg.inv(matrix).T.ravel() / 3


class _Problem:
    """Least squares with weights that settle, by Gauss and Newton, in units of the field."""

    def __init__(self, logs: list[FieldRows], start, unit: float, shared: bool) -> None:
        self.logs = logs
        ends = SHARED + OF_LOG * np.arange(len(logs) + 1)
        self.places = [slice(a, b) for a, b in zip(ends[:-1], ends[1:], strict=True)]
        self.start = np.concatenate(
            [start.bias / unit, start.matrix.ravel(), *map(self._first, logs)]
        )
        wide = np.concatenate([BEFORE, *[BEFORE_OF_LOG] * len(logs)])
        self.prior = np.diag(wide**-2.0)
        self.free = np.arange(0 if shared else SHARED, len(self.start))

    def _first(self, rows: FieldRows) -> np.ndarray:
        """The mean field of a log, and no delay."""
        return np.append(mean_field(rows.axes, rows.mag), 0.0)

    def solved(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The unknowns, the covariance that independent errors give them, and by how much (blocks,
        unknowns) they move without each block of time.
        """
        x, weights = np.array(self.start), [np.ones(len(r)) for r in self.logs]
        for _ in range(ROUNDS):
            off, slope = self._linear(x)
            square = np.concatenate([np.sum(v**2, axis=1) for v in off])
            variance = max(float(np.mean(np.concatenate(weights) * square)) / 3, FINEST**2)
            weights = [(FREEDOM + 3) / (FREEDOM + np.sum(v**2, axis=1) / variance) for v in off]
            normal, score = self._normal(x, off, slope, weights, variance)
            change = np.zeros(len(x))
            change[self.free] = np.linalg.solve(
                normal[np.ix_(self.free, self.free)], score[self.free]
            )
            x += change
            if change @ normal @ change < SETTLED**2 * len(x):
                break
        off, slope = self._linear(x)
        normal, _ = self._normal(x, off, slope, weights, variance)
        free, covariance = np.ix_(self.free, self.free), np.zeros_like(normal)
        covariance[free] = np.linalg.inv(normal[free])
        return x, covariance, self._without(off, slope, weights, variance)

    def _linear(self, x: np.ndarray) -> tuple[list[np.ndarray], list[np.ndarray]]:
        """What each log is off (k, 3), and the slope (k, 3, 12 + 4) of the model there."""
        A, off, slopes = x[MATRIX].reshape(3, 3), [], []
        for rows, at in zip(self.logs, self.places, strict=True):
            *field, delay = x[at]
            turned = rows.axes - delay * rows.passing
            f = turned @ field
            off.append(rows.mag - x[BIAS] - f @ A.T)
            slope = np.zeros((len(rows), 3, SHARED + OF_LOG))
            slope[:, range(3), range(3)] = 1.0
            for i in range(3):
                slope[:, i, 3 + 3 * i : 6 + 3 * i] = f
            slope[:, :, SHARED : SHARED + 3] = A @ turned
            slope[:, :, SHARED + 3] = -(rows.passing @ field) @ A.T
            slopes.append(slope)
        return off, slopes

    def _columns(self, at: slice) -> np.ndarray:
        return np.append(np.arange(SHARED), np.arange(at.start, at.stop))

    def _normal(self, x, off, slope, weights, variance) -> tuple[np.ndarray, np.ndarray]:
        normal, score = np.array(self.prior), self.prior @ (self.start - x)
        for v, s, w, at in zip(off, slope, weights, self.places, strict=True):
            columns = self._columns(at)
            weighed = s * (w / variance)[:, None, None]
            normal[np.ix_(columns, columns)] += np.einsum("kij,kil->jl", weighed, s)
            score[columns] += np.einsum("kij,ki->j", weighed, v)
        return normal, score

    def _without(self, off, slope, weights, variance) -> np.ndarray:
        """By how much (blocks, unknowns) the unknowns move without each block of time."""
        blocks, total = [], np.array(self.prior)
        least = -(-LEAST_BLOCKS // len(self.logs))
        for rows, at, *values in zip(self.logs, self.places, off, slope, weights, strict=True):
            columns = self._columns(at)
            count = min(max(int(np.ptp(rows.time) / BLOCK), least), MOST_BLOCKS, len(rows))
            for v, s, w in zip(*(np.array_split(a, count) for a in values), strict=True):
                known = np.zeros_like(total)
                known[np.ix_(columns, columns)] = _known(v, s, w, variance)
                score = np.zeros(len(total))
                score[columns] = np.einsum("kij,ki,k->j", s, v, w / variance)
                blocks.append((known, score))
                total += known
        free, moved = np.ix_(self.free, self.free), np.zeros((len(blocks), len(total)))
        for change, (known, score) in zip(moved, blocks, strict=True):
            change[self.free] = np.linalg.solve((total - known)[free], -score[self.free])
        return moved


def _known(v: np.ndarray, s: np.ndarray, w: np.ndarray, variance: float) -> np.ndarray:
    """The slope of the score by the unknowns, of which the weights ``w`` depend on them too."""
    found = np.einsum("k,kij,kil->jl", w / variance, s, s)
    turned = np.einsum("ki,kij->kj", v, s) / variance
    return found - np.einsum("k,kj,kl->jl", 2 * w**2 / (FREEDOM + 3), turned, turned)


def weakest(logs: Sequence[FieldRows]) -> float:
    """The least share of the information that logs have about a combination of bias and matrix, of
    what as many attitudes of a body that turns every way have.
    """
    rows = [_in_unit(r.attitudes(), unit_of(logs)) for r in logs]
    seen = sum(_information(r) for r in rows)
    count = sum(map(len, rows))
    every = Rotation.random(ROUND_THE_CLOCK, np.random.default_rng(0)).as_matrix()
    world = rows[0]
    field = mean_field(world.axes, world.mag)
    blank = np.zeros_like(every)
    still = world.white, world.turned
    full = FieldRows("", np.arange(len(every)), every @ field, every, blank, *still)
    whole = _information(full) * count / len(every)
    root = np.linalg.inv(np.linalg.cholesky(whole))
    return float(np.linalg.eigvalsh(root @ seen @ root.T)[0])


def _information(rows: FieldRows) -> np.ndarray:
    """Information (11, 11) about bias and shape of a log whose field and delay are not known.

    The shape is the matrix without what makes the field stronger, its trace.
    """
    problem = _Problem([rows], MagnetometerCalibration(), 1.0, True)
    _, (slope,) = problem._linear(problem.start)
    basis = np.linalg.svd(np.eye(3).ravel()[None])[2][1:].T
    known = np.zeros((SHARED + OF_LOG, 11 + OF_LOG))
    known[BIAS, :3], known[MATRIX, 3:11] = np.eye(3), basis
    known[SHARED:, 11:] = np.eye(OF_LOG)
    slope = slope @ known
    normal = np.einsum("kij,kil->jl", slope, slope)
    normal[11:, 11:] += np.diag(BEFORE_OF_LOG**-2.0)
    across = normal[:11, 11:]
    return normal[:11, :11] - across @ np.linalg.solve(normal[11:, 11:], across.T)
