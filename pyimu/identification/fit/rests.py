"""Rests in several positions as the reference of an accelerometer: of each, gravity's size.

A rest's direction is nobody's knowledge but the accelerometer's own, so a rest is one row: the size
of the compensated mean less gravity's. Its slope against a change dy of the output is
d^T J^-1 dy, d being the direction of gravity and J the output's slope against the force. (What is
fitted is the ellipsoid of Frosio, Pedersini and Borghese 2009, eq. 8, in the sensor's own
coefficients.)
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import diags_array

from pyimu.identification.fit.reduction import Reduction, Rows, Segments, compensated
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor


@dataclass(frozen=True)
class Rests(Reduction):
    """A trial whose samples are the means of rests; ``gravity`` in m/s^2."""

    gravity: float

    def of_gravity(self, errors: np.ndarray) -> np.ndarray:
        """Of gravity's size, m/s^2."""
        return errors

    def rows(
        self, sensor: Sensor, y: np.ndarray, u: np.ndarray, segments: Segments, h: float
    ) -> Rows:
        """The size of each rest's compensated mean less gravity's."""
        u, back = compensated(sensor, y, u, segments, h)
        force = u[:, OWN[sensor.kind]]
        size = np.linalg.norm(force, axis=1)
        down = force / size[:, None]
        slopes = np.einsum("ni,nij->nj", down, back)
        weights = tuple(diags_array(slopes[:, i]).tocsr() for i in range(3))
        return Rows(u, size - self.gravity, weights, down)
