"""Motion that a gyro damps a little, too little for a lag to be named.

Samples that are means over a time, as of gyros that integrate between samples or decimate, damp the
motion by a share that rises with the square of the frequency; a clock has the delay. It bends the
motion, and products of rates and of their slopes follow that: each would look like an effect. What
a reference damps so little is left in it: undone there, its noise would be the larger.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from pyimu.errors import Finding
from pyimu.identification.fit.damping import damping, slopes
from pyimu.identification.fit.fit import Fit, Last
from pyimu.identification.fit.inputs import copied, own_rate
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.fit.trial import Trial
from pyimu.identification.search.own_lag import may_hide_a_lag
from pyimu.model.kinds import OWN

DAMPED = "motion_damped"
"""The finding of motion that is damped."""

OF_MEANS = 24.0
"""By which half the second derivative of a gain goes into the square of the time over which means
damp as much: sin(x) / x of x = w T / 2 falls by w^2 T^2 / 24."""


def damps_by(current: Fit, gate: float) -> float:
    """Half of the second derivative [s^2] of the gain by which the gyro of a model damps the
    motion: the lesser of what the motion as the reference shows it says, and as the gyro does. The
    noise of the one makes it look as if the other damped. Zero where one of them says that it does
    not, where they explain no more than ``gate`` [nat], or clocks hide no lag.
    """
    if current.sensor.kind != "gyro" or not all(map(may_hide_a_lag, current.trials)):
        return 0.0
    (gain, falls), (seen, other) = damping(current), damping(current, by_sensor=True)
    if min(gain, seen) <= gate or min(falls, other) <= 0.0:
        return 0.0
    return min(falls, other)


def damped(current: Fit, falls: float) -> Fit:
    """A model fitted beside the motion as a gain that ``falls`` so shows it."""
    return _beside(current, damped_trial, falls) if falls else current


def sharp(current: Fit, falls: float) -> Fit:
    """A model fitted beside the motion as it was before ``damped``."""
    return _beside(current, sharp_trial, falls) if falls else current


def damped_trial(trial: Trial, falls: float) -> Trial:
    """The trial with the motion as a gain that ``falls`` so shows it."""
    if not falls:
        return trial
    found = Finding(DAMPED, trial.kind, 1, {"period": float(np.sqrt(OF_MEANS * falls))})
    return replace(_bent(trial, falls), findings=(*trial.findings, found))


def sharp_trial(trial: Trial, falls: float) -> Trial:
    """The trial as it was before ``damped_trial``."""
    if not falls:
        return trial
    findings = tuple(f for f in trial.findings if f.kind != DAMPED)
    return replace(_bent(trial, -falls), findings=findings)


def _beside(current: Fit, as_seen: Callable[[Trial, float], Trial], falls: float) -> Fit:
    trials = tuple(as_seen(t, falls) for t in current.trials)
    return fit(replace(current, trials=trials, last=Last()).with_noise())


def _bent(trial: Trial, falls: float) -> Trial:
    u = copied(trial.u)
    bent = slopes(trial, trial.u[:, own_rate(trial.kind)])
    u[:, OWN[trial.kind]] = trial.u[:, OWN[trial.kind]] + falls * bent
    return replace(trial, u=u)
