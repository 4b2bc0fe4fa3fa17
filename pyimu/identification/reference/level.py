"""A reference attitude whose world is not level: gravity stands in it along another axis than z."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.attitude.error import angle_between, root_mean_square
from pyimu.attitude.reference_reading import BETTER
from pyimu.model.typical import CLASSES, magnitudes
from pyimu.recording.recording import Recording
from pyimu.recording.reference.orders import read_as
from pyimu.units import STANDARD_GRAVITY

UP = np.array([0.0, 0.0, 1.0])

WAYS = {
    "z points down, as in north-east-down, or the forces' signs are Core Motion's, or, where it "
    "turns about the vertical alone, the gyro's sign is wrong there": -UP,
    "y points up": np.array([0.0, 1.0, 0.0]),
    "y points down, as a camera's does": np.array([0.0, -1.0, 0.0]),
    "x points up": np.array([1.0, 0.0, 0.0]),
    "x points down": np.array([-1.0, 0.0, 0.0]),
}
"""Worlds that are not level, and the way up (3,) in each."""


@dataclass(frozen=True)
class Leaning:
    """A world that is not level: ``up`` (3,) is the way up in it."""

    up: np.ndarray

    @property
    def tilt(self) -> float:
        """rad; from its z axis to the vertical."""
        return float(angle_between(self.up, UP))

    @property
    def said(self) -> str:
        """Which axis of it points where, or by how much it leans."""
        near = (way for way, up in WAYS.items() if angle_between(self.up, up) < uncertain())
        return next(near, f"z is {np.degrees(self.tilt):.3g} deg off the vertical")

    def levelled(self, recording: Recording) -> Recording:
        """The recording with a reference attitude whose world is level, its heading left open."""
        return read_as(recording, self._levelled)

    def _levelled(self, q: np.ndarray) -> np.ndarray:
        known, turned = np.isfinite(q).all(axis=1), np.full_like(q, np.nan)
        turn, _ = Rotation.align_vectors(UP[None], self.up[None])
        reference = Rotation.from_quat(q[known], scalar_first=True)
        turned[known] = (turn * reference).as_quat(scalar_first=True)
        return turned


def uncertain() -> float:
    """rad; by which the bias of a consumer accelerometer tilts what a filter takes for level."""
    return magnitudes("turn_on_bias", "accel")[CLASSES[-1]].si / STANDARD_GRAVITY


def leaning(q: np.ndarray, reference: Rotation) -> Leaning | None:
    """In which world a ``reference`` of m attitudes has the vertical of the estimates ``q`` (m, 4);
    None where that is level as far as an accelerometer tells, or no one world has it.

    The way up of an estimate, seen in the world of the reference, is the same whatever the heading
    that nothing measures; it is one way throughout where nothing but that world is another.
    """
    if not len(q):
        return None
    up = reference.apply(Rotation.from_quat(q, scalar_first=True).inv().apply(UP))
    mean = up.mean(axis=0)
    found = Leaning(mean / max(np.linalg.norm(mean), 1e-300))
    before, after = (root_mean_square(angle_between(up, way)) for way in (UP, found.up))
    return found if found.tilt > uncertain() and BETTER * after < before else None
