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
from scipy.ndimage import convolve1d
from scipy.signal import firwin

from pyimu.errors import Finding
from pyimu.identification.fit.damping import Damped, beyond_noise
from pyimu.identification.fit.fit import Fit, Last
from pyimu.identification.fit.inputs import copied
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.fit.trial import TURNS, Trial
from pyimu.identification.search.own_lag import may_hide_a_lag
from pyimu.model.kinds import OWN

DAMPED = "motion_damped"
"""The finding of motion that is damped."""

OF_MEANS = 24.0
"""By which half the second derivative of a gain goes into the square of the time over which means
damp as much: sin(x) / x of x = w T / 2 falls by w^2 T^2 / 24."""


FADES, HANN = 1.5, 1.6
"""Of the frequencies that are bent: where half of that is left, over where all is; and periods of
the latter on either side that a filter through Hann's window takes to fall to nothing between one
and twice that."""

EDGE = 0.25
"""Frequency, a row, from which on there is no room for that."""

SURE = 3.0
"""Standard errors within which a period is that of the samples."""

SAME = 0.03
"""Share by which what means over a period damp may seem off: of quick motion more than the square
of the frequency counts."""


def damps_by(current: Fit, gate: float) -> Damped | None:
    """How the gyro of a model damps the motion, where that is no lag; None where it does not, or
    what it does explains no more than ``gate`` [nat].

    By the motion as the sensor shows it, the sensor's noise makes it look as if it damped less:
    more than by that it must damp, whatever the noise of the reference.
    """
    if current.sensor.kind != "gyro" or not all(map(_may_damp, current.trials)):
        return None
    if all(map(_is_of_means, current.trials)):
        return None
    seen = beyond_noise(current)
    if not _is_sure(seen, gate) or not _is_sure(beyond_noise(current, share=1.0), gate):
        return None
    hides = all(t.clock is not None for t in current.trials)
    of_period = _of_period(current, seen)
    if of_period and (hides or _is_no_lag(current, seen)):
        return replace(seen, falls=of_period)
    return seen if hides else None


def means_over_a_period(current: Fit, gate: float) -> bool:
    """Whether the gyro of a model damps the motion as means over the period of its samples do. A
    lag that damps as much by chance is not told from that where a clock hides its delay; means need
    nothing to be estimated.
    """
    found = damps_by(current, gate)
    return found is not None and bool(_of_period(current, found))


def _of_period(current: Fit, seen: Damped) -> float:
    """By how much means over the period of a model's samples damp, where that is what is seen;
    zero where it is not.
    """
    periods = [t.h for t in current.trials]
    expected = float(np.mean(periods)) ** 2 / OF_MEANS
    alike = np.ptp(periods) < SAME * max(periods)
    same = abs(seen.falls - expected) < max(SURE * seen.std, SAME * expected)
    return expected if alike and same else 0.0


def _is_of_means(trial: Trial) -> bool:
    """Whether a trial has the motion as means over the period of its samples already."""
    periods = [f.detail["period"] for f in trial.findings if f.kind == DAMPED]
    return bool(np.isclose(periods, trial.h).any())


def _is_sure(seen: Damped, gate: float) -> bool:
    return seen.gain > gate and seen.falls > 0.0


def _may_damp(trial: Trial) -> bool:
    """Whether it may show in a trial that a sensor damps: beside a clock that hides the delay of a
    lag, or on the clock of the samples.
    """
    return trial.reference in TURNS and (trial.clock is None or may_hide_a_lag(trial))


def _is_no_lag(current: Fit, seen: Damped) -> bool:
    """Whether a sensor on its reference's clock is less late than any lag that damps as much: the
    gain of one falls by no more than half of the square of its delay.
    """
    has_delay = any(current.sensor.effect(n).delay is not None for n in current.sensor.values)
    return not has_delay and seen.late < 0.5 * np.sqrt(2.0 * seen.falls)


def damped(current: Fit, by: Damped) -> Fit:
    """A model fitted beside the motion as a sensor that damps it so shows it."""
    return _beside(current, lambda t: damped_trial(t, by))


def sharp(current: Fit) -> Fit:
    """A model fitted beside the motion as it was before ``damped``."""
    if all(t.undamped is None for t in current.trials):
        return current
    return _beside(current, sharp_trial)


def damped_trial(trial: Trial, by: Damped | None) -> Trial:
    """The trial with the motion as a sensor that damps it so shows it; sharp where none does."""
    trial = sharp_trial(trial)
    if by is None:
        return trial
    period = float(np.sqrt(OF_MEANS * by.falls))
    u, own = copied(trial.u), trial.u[:, OWN[trial.kind]]
    u[:, OWN[trial.kind]] = own + _bent(trial, own, period / trial.h, by.below * trial.h)
    found = Finding(DAMPED, trial.kind, 1, {"period": period})
    return replace(trial, u=u, undamped=own, findings=(*trial.findings, found))


def sharp_trial(trial: Trial) -> Trial:
    """The trial as it was before ``damped_trial``."""
    if trial.undamped is None:
        return trial
    u = copied(trial.u)
    u[:, OWN[trial.kind]] = trial.undamped
    findings = tuple(f for f in trial.findings if f.kind != DAMPED)
    return replace(trial, u=u, undamped=None, findings=findings)


def _beside(current: Fit, as_seen: Callable[[Trial], Trial]) -> Fit:
    return fit(
        replace(current, trials=tuple(map(as_seen, current.trials)), last=Last()).with_noise()
    )


def _bent(trial: Trial, values: np.ndarray, rows: float, below: float) -> np.ndarray:
    """What means of values (n, 3) over so many ``rows`` about each are more than these, within a
    trial's segments, at frequencies ``below`` so many a row: above, there is noise alone, and what
    means make of that is none of the sensor's.

    By the second and fourth derivatives, T^2/24 d^2 + T^4/1920 d^4, from differences.
    """
    out = np.zeros(values.shape)
    second, fourth = rows**2 / 24.0, rows**4 / 1920.0 - rows**2 / 288.0
    for a, b in trial.segments:
        if b - a > 4:
            out[a + 1 : b - 1] += second * np.diff(values[a:b], n=2, axis=0)
            out[a + 2 : b - 2] += fourth * np.diff(values[a:b], n=4, axis=0)
            if 0.0 < below < EDGE:
                weights = firwin(2 * int(HANN / below) + 1, FADES * below, window="hann", fs=1.0)
                out[a:b] = convolve1d(out[a:b], weights, axis=0, mode="nearest")
    return out
