"""The rate of a reference that was differentiated, without the noise above its band.

That grows with the frequency, and from row to row it may be as large as the motion. What is not
linear, as the size of a rate, a zone about zero or a product of rates, brings it down into the
band, where another effect or a step of something looks like it. Where a reference was smoothed, the
gyro's word stands there already.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyimu.identification.fit.band import BEYOND
from pyimu.identification.fit.inputs import copied, own_rate
from pyimu.identification.fit.trial import MEASURED, Trial
from pyimu.identification.reference.above import smoothing_of
from pyimu.model.kinds import OWN
from pyimu.recording.reference.filters import below_hz
from pyimu.recording.reference.unsmoothed import TURNING


def with_quiet_rate(trial: Trial) -> Trial:
    """The trial of a gyro with the rate of its reference low-passed above its band; as it is where
    that was not differentiated, or has no noise of its own there.
    """
    if trial.kind != "gyro" or trial.band_hz is None or trial.reference in MEASURED:
        return trial
    if smoothing_of(trial, TURNING) is not None:
        return trial
    cutoff = BEYOND * trial.band_hz
    if cutoff >= 0.5 / trial.h:
        return trial
    u, own, rate = copied(trial.u), OWN[trial.kind], own_rate(trial.kind)
    u[:, own] = below_hz(u[:, own], trial.segments, trial.h, cutoff)
    for a, b in trial.segments:
        if b - a > 1:
            u[a:b, rate] = np.gradient(u[a:b, own], trial.time[a:b], axis=0)
    return replace(trial, u=u, cutoff=cutoff)
