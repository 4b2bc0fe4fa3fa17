"""What may be left of a filter, or of a delay, that was taken out of positions.

Its size is known as far as the accelerometer showed it. A filter that is off by a little leaves
what the world's accelerations change by in time, once and twice: in the body's axes, f' + w x f. Of
a body that leans that is w x g mostly, a product of rates and forces, and no sensor's.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.identification.fit.damping import slopes
from pyimu.identification.fit.place import STILL_LATE, STILL_SMOOTH
from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.above import COLUMNS_OF_PLACES
from pyimu.identification.reference.place import at_the_point
from pyimu.model.signals import COLUMNS
from pyimu.recording.reference.unfiltered_places import EXPLAINED

SIZES = ("time_constant", "seconds", "late")
"""What the size of a filter in s is called in a finding, or that of a delay."""


def with_filter_left(trial: Trial) -> Trial:
    """The trial with what is left of a filter over its positions among what is not known of its
    force; as it is where none was taken out. What a change of it makes is the accelerometer's word,
    whose noise is less than that of positions by far.
    """
    size = _size(trial)
    if not size:
        return trial
    place, world = trial.place, turned(trial, at_the_point(trial))
    late = slopes(trial, place.shown(world, trial.segments))
    forces = np.array(place.forces)
    for at, change in ((STILL_LATE, late), (STILL_SMOOTH, -slopes(trial, late))):
        forces[at] = place.below(turned(trial, change, back=True), trial.segments).T
    return replace(trial, place=replace(place, forces=forces, size=size))


def turned(trial: Trial, values: np.ndarray, back: bool = False) -> np.ndarray:
    """Vectors (n, 3) in the body's axes in the world's, or ``back``; zero outside segments."""
    out = np.zeros(values.shape)
    for a, b in trial.segments:
        body = Rotation.from_quat(trial.u[a:b, COLUMNS["attitude"]], scalar_first=True)
        out[a:b] = body.apply(values[a:b], inverse=back)
    return out


def _size(trial: Trial) -> float:
    """The size in s of the filter, or the delay, that was taken out of a trial's positions."""
    found = (f for f in trial.findings if EXPLAINED in f.detail and f.column in COLUMNS_OF_PLACES)
    return max((abs(f.detail[s]) for f in found for s in SIZES if s in f.detail), default=0.0)
