"""What a reference that was smoothed, or that its noise hides, cannot show above the frequencies
that can be restored, as the sensor shows it.

Of a body that moves as quickly that comes down into the band: in part through the band's window,
which no window that is short enough shuts at once, and of a force in the body's axes wherever the
body turns, as products of rates and forces. Where reference and sensor agree there by definition,
nothing is said of the sensor, and nothing false.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.identification.fit.damping import slopes
from pyimu.identification.fit.inputs import copied, own_rate
from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.place import at_the_point, with_force
from pyimu.model.kinds import OWN
from pyimu.model.signals import COLUMNS
from pyimu.recording.reference.filters import below
from pyimu.recording.reference.unfiltered_places import GROUPS
from pyimu.recording.reference.unsmoothed import SMOOTHED, TURNING, Smoothing

COLUMNS_OF_PLACES = frozenset(names[0] for names in GROUPS.values())


def with_sensor_above(trial: Trial) -> Trial:
    """The trial with the force that its places, once restored and freed of what is noise alone,
    still lack as its sensor shows it, less the rows near an end where nobody knows what they lack;
    as it is where they lack nothing.
    """
    smoothing, shown_hz = _smoothing(trial, COLUMNS_OF_PLACES), trial.place.shown_hz
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


def with_gyro_above(trial: Trial) -> Trial:
    """The trial with the rate that its reference, once restored, still lacks as the gyro shows it;
    as it is where it lacks none.
    """
    smoothing = _smoothing(trial, TURNING)
    if trial.kind != "gyro" or smoothing is None:
        return trial
    u, lost, axes = copied(trial.u), np.zeros(trial.y.shape), list(trial.axes)
    for a, b in trial.segments:
        lost[a:b, axes] = smoothing.lost(trial.y[a:b, axes], trial.h)
    u[:, OWN["gyro"]] += lost
    u[:, own_rate("gyro")] += slopes(trial, lost)
    return replace(trial, u=u)


def _smoothing(trial: Trial, columns: frozenset[str]) -> Smoothing | None:
    """The smoothing of some ``columns`` of a trial's reference that was undone, if any was."""
    found = (f for f in trial.findings if f.kind == SMOOTHED and f.column in columns)
    return next((Smoothing.of_detail(f.detail) for f in found), None)
