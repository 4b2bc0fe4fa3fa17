"""A gyro that has an axis of the wrong sign, beside a reference that does not show it.

Turned about one axis alone, a reference fits a gyro whose sign there is wrong once it is turned
upside down, as one whose axes are north-east-down and forward-right-down is. What little a body
leans shows which of the two it is: gravity turns as the right gyro says.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.errors import Finding
from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.moving import LEAST_ROWS, moving_pair, turned_onto
from pyimu.recording.readings import reading_named

UPSIDE_DOWN = np.pi / 2
"""rad; a reference that is turned further is nearer to a gyro with the other sign."""


def mirrored(trials: Iterable[Trial], findings: Iterable[Finding]) -> str:
    """Why the gyro of one of the ``trials`` cannot be compared: its axes are mirrored. Nothing
    where none is. ``findings`` are those of the logs, with their names.
    """
    said = {f.detail["recording"]: f.detail["axes"] for f in findings if f.kind == "gyro_axes"}
    for trial in trials:
        axes = said.get(trial.name, "")
        if axes and _fits_mirrored(trial, reading_named(axes)):
            return (
                f"gravity does not turn as the gyro of {trial.name} says, but as if {axes} in it, "
                "and the reference agrees: the gyro's axes are mirrored, put their signs right"
            )
    return ""


def _fits_mirrored(trial: Trial, reading: np.ndarray) -> bool:
    """Whether the gyro is mirrored by the right ``reading`` (3, 3) of its columns, and the
    reference is upside down as long as it is.
    """
    if np.linalg.det(reading) > 0:
        return False
    x, y = moving_pair(trial)
    if len(y) < LEAST_ROWS:
        return False
    if len(trial.axes) == 1:
        axis = trial.axes[0]
        return reading[axis, axis] < 0 and float(np.sum(x * y)) < 0.0
    if len(trial.axes) < 3:
        return False
    as_stated, as_read = (_angle(turned_onto(x, v)) for v in (y, y @ reading.T))
    return as_read < UPSIDE_DOWN < as_stated


def _angle(rotation: np.ndarray) -> float:
    return float(Rotation.from_matrix(rotation).magnitude())
