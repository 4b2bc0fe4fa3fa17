"""How far a smoothing of a reference went, by what the gyro shows once it is undone.

What judges a filter fits a gain beside it. Where a body moves at few frequencies, a filter that is
a little long and a gain that is a little large are alike to it, and the gain would be the sensor's
scale factor in the end. What is left beside the restored reference tells them apart by the noise of
both.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from pyimu.identification.fit.damping import beyond_noise
from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.above import smoothing_of, with_gyro_above
from pyimu.identification.reference.align import fitted_structure
from pyimu.identification.reference.behind import Undo
from pyimu.identification.reference.moving import in_own_band
from pyimu.model.sensor import Sensor
from pyimu.recording.reference.unsmoothed import KINDS, TURNING, unsmoothed


def resized(trial: Trial, sensor: Sensor) -> Undo | None:
    """What takes the smoothing out of the log of a ``trial`` by the size that leaves nothing that
    looks like it; None where none was taken out, or it has no variance to put right.
    """
    smoothing = smoothing_of(trial, TURNING)
    variance = KINDS[smoothing.kind].variance if smoothing else 0.0
    if not variance:
        return None
    left = beyond_noise(fitted_structure(with_gyro_above(in_own_band(trial)), sensor))
    squared = smoothing.size**2 - 2.0 * left.falls / variance
    if not np.isfinite(left.std) or squared <= 0.0:
        return None
    return partial(unsmoothed, smoothing=replace(smoothing, size=float(np.sqrt(squared))))
