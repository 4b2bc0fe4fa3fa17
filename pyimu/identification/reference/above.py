"""What positions that were smoothed, or that their noise hides, cannot show of a force, as the
accelerometer shows it.

A force in the body's axes mixes frequencies: what is missing of the world's accelerations above
those that can be restored comes down into the band wherever the body turns as quickly, and looks
like products of rates and forces. Where reference and sensor agree there by definition, nothing is
said of the sensor, and nothing false.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.identification.fit.inputs import copied
from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.place import at_the_point, with_force
from pyimu.model.kinds import OWN
from pyimu.model.signals import COLUMNS
from pyimu.recording.reference.filters import below
from pyimu.recording.reference.unfiltered_places import GROUPS
from pyimu.recording.reference.unsmoothed import SMOOTHED, Smoothing

COLUMNS_OF_PLACES = frozenset(names[0] for names in GROUPS.values())


def with_sensor_above(trial: Trial) -> Trial:
    """The trial with the force that its places, once restored and freed of what is noise alone,
    still lack as its sensor shows it, less the rows near an end where nobody knows what they lack;
    as it is where they lack nothing.
    """
    smoothing, shown_hz = _smoothing(trial), trial.place.shown_hz
    if smoothing is None and shown_hz == np.inf:
        return trial
    reach = 0 if smoothing is None else smoothing.reach(trial.h)
    u, force, segments = copied(trial.u), at_the_point(trial), []
    for a, b in trial.segments:
        if b - a > 3 * reach:
            body = Rotation.from_quat(u[a:b, COLUMNS["attitude"]], scalar_first=True)
            world = body.apply(force[a:b])
            kept = world if smoothing is None else world - smoothing.lost(world, trial.h)
            lost = world - below(kept, 2.0 * trial.h * shown_hz)
            u[a:b, OWN[trial.kind]] += body.apply(lost, inverse=True)
            segments.append((a + reach, b - reach))
    return with_force(replace(trial, segments=segments), u) if segments else trial


def _smoothing(trial: Trial) -> Smoothing | None:
    """The smoothing of a trial's places that was undone, if any was."""
    found = (f for f in trial.findings if f.kind == SMOOTHED and f.column in COLUMNS_OF_PLACES)
    return next((Smoothing.of_detail(f.detail) for f in found), None)
