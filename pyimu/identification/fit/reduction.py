"""Trials whose rows are not samples but what whole stretches of a log say.

How each row follows the sensor's output, and how far each is from what the others predict.

No row has an equation of its own for every axis, so the few that there are come already weighed:
their covariance is known before the fit, and the fit sees them white.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.linalg import cholesky, solve_triangular
from scipy.sparse import csr_array

from pyimu.identification.fit.filters import Filter
from pyimu.identification.fit.response import (
    after_dynamics,
    behind_dynamics,
    memoryless,
    predict,
    with_memory,
)
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor

GAIN = "scale_factor"
"""The effect that is a gain of each axis."""

STRUCTURE = (GAIN, "misalignment")
"""What stretches of a log show first, beside the bias."""

Segments = list[tuple[int, int]]

ROUNDS = 4
"""Newton steps of the inverse of a sensor's output; errors of some percent fall to rounding."""

EXACT = 1e-12
"""Share of the output by which the inverse may be off."""


@dataclass(frozen=True)
class Rows:
    """What a trial's stretches say under a model.

    ``u`` (n, N_INPUT) are the inputs at which it was linearised, ``residual`` (m,) measured less
    model, ``weights`` for each axis (m, n) how a row follows a change of the sensor's output, and
    ``along`` (m, 3) the direction, in body axes, of the error that a row stands for.
    """

    u: np.ndarray
    residual: np.ndarray
    weights: tuple[csr_array, csr_array, csr_array]
    along: np.ndarray


@dataclass(frozen=True)
class Reduction(ABC):
    """How a trial's samples become rows.

    ``white``, ``wander`` and ``common`` (m, m) are the covariance of the rows' errors by its cause:
    the sensor's white noise, what else changes its output from one stretch to another, and what
    the reference leaves open. ``group`` (m,) numbers the rows that stand and fall together,
    ``time`` (m,) s is when they were; ``samples`` is how many samples they are made of, and
    ``sample_std`` (3,) the white noise of one. ``any_turn`` says that a turn of the whole triad
    changes no row, ``bias`` (3,) is what is plain of it before any fit.
    """

    white: np.ndarray
    wander: np.ndarray
    common: np.ndarray
    group: np.ndarray
    time: np.ndarray
    samples: int
    sample_std: np.ndarray
    any_turn: bool
    bias: np.ndarray

    @abstractmethod
    def of_gravity(self, errors: np.ndarray) -> np.ndarray:
        """The errors (g,) of gravity that the rows' errors (m,) amount to."""

    @abstractmethod
    def rows(
        self, sensor: Sensor, y: np.ndarray, u: np.ndarray, segments: Segments, h: float
    ) -> Rows:
        """The rows under a model, of ``y`` (n, 3) measured less the log's bias and inputs ``u``
        (n, N_INPUT).
        """

    @cached_property
    def root(self) -> np.ndarray:
        """Lower root (m, m) of the rows' covariance."""
        return cholesky(self.white + self.wander + self.common, lower=True)

    def whiten(self, values: np.ndarray) -> np.ndarray:
        """Rows (m, c) with unit variance and without correlation."""
        return solve_triangular(self.root, values, lower=True)


class _Unchanged(Filter):
    """Of rows that are white already."""

    log_det = 0.0

    def next(self, values: np.ndarray) -> np.ndarray:
        return np.array(values)


@dataclass(frozen=True)
class Unit:
    """The noise of rows that come white with unit variance."""

    def filter(self, time: np.ndarray, segments: Segments) -> Filter:
        return _Unchanged()

    def whiten(self, values: np.ndarray, time: np.ndarray, segments: Segments) -> np.ndarray:
        return np.array(values)

    def log_det(self, time: np.ndarray, segments: Segments) -> float:
        return 0.0


def compensated(
    sensor: Sensor, y: np.ndarray, u: np.ndarray, segments: Segments, h: float
) -> tuple[np.ndarray, np.ndarray]:
    """Inputs (n, N_INPUT) with the sensor's own signal such that it would have given ``y`` (n, 3),
    and the inverse (n, 3, 3) of the output's slope there.
    """
    own, u, rest = OWN[sensor.kind], np.array(u), after_dynamics(sensor)
    response = memoryless(rest.chain)
    u[:, own] = y
    for _ in range(ROUNDS):
        moved = with_memory(rest, behind_dynamics(sensor, u, segments, h), h)
        back = _inverse(response(moved, rest.p, h)[1])
        change = np.einsum("nij,nj->ni", back, y - predict(sensor, u, segments, h))
        u[:, own] += change
        if np.abs(change).max(initial=0.0) < EXACT * np.abs(y).max(initial=0.0):
            break
    return u, back


def _inverse(slope: np.ndarray) -> np.ndarray:
    """Inverses (n, 3, 3); where an axis has stopped following, it says nothing."""
    try:
        return np.linalg.inv(slope)
    except np.linalg.LinAlgError:
        return np.linalg.pinv(slope)
