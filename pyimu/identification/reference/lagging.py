"""A reference that lags behind what it measures, as one behind a low-pass filter does.

Filters of tachometers, of a second unit, or of tracking in real time. A clock takes a lag out at
low frequencies; what it leaves is a gain that falls with the square of the frequency, and would be
the sensor's by every effect that knows the rate. The rate that went into a filter of first order is
its output and the time constant times that one's slope.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache, partial

import numpy as np
from scipy.optimize import minimize_scalar

from pyimu.identification.fit.columns import band_time
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.maximum_likelihood import advantage_by_one_noise
from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.align import SIGNIFICANT, fitted_structure, in_band_of
from pyimu.identification.reference.clock import measure, shifted
from pyimu.identification.reference.moving import in_own_band
from pyimu.identification.reference.track import WANDERS
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording
from pyimu.recording.reference.unlagged import FILTERED, unlagged, unlagged_rate

SHARES = 1.0, 0.5, 0.25
"""Of what the sensor is early, time constants to begin with: all where the two clocks are one, and
less where they are not. The likelihood rises up to 1.4 times the right one."""

CLOSE, ROUNDS = 0.01, 14
"""The square of the time constant is looked for to this share of itself, in so many steps at
most."""

LEAST = 0.05
"""Sample periods; a filter that is quicker changes nothing of what such rows show."""

LONGEST = 2.0
"""Times the time constant to begin with that one may be."""


def without_lag(trial: Trial, sensor: Sensor) -> Callable[[Recording], Recording] | None:
    """What takes the lag out of the reference of a trial's log; None where it has none."""
    lag = _lag(trial, sensor) if may_lag(trial) else None
    return None if lag is None else partial(unlagged, lag=lag)


def may_lag(trial: Trial) -> bool:
    """Whether the sensor is early: where it is late, a lag is its own."""
    clock = trial.clock
    return (
        trial.reference in FILTERED
        and clock is not None
        and clock.taken_out
        and clock.keeps_step
        and clock.mean < -SIGNIFICANT * clock.std
    )


def _lag(trial: Trial, sensor: Sensor) -> float | None:
    """Time constant [s] of the low-pass filter of the trial's reference; None where it has none."""
    # Above the filter the noise, which a slope makes larger, rewards a lag that is too short.
    trial = in_band_of(in_own_band(_quick(trial, -trial.clock.mean)), trial)
    before = fitted_structure(trial, sensor)
    gain = cache(partial(_gain, trial, before, sensor))
    first = next((b for share in SHARES if gain(b := -share * trial.clock.mean) > WANDERS), None)
    if first is None:
        return None
    # What a clock leaves of a filter, 1 - (b s)^2 / 2 + ..., is linear in b^2: what is left of the
    # sensor's power is a parabola in it.
    count = len(band_time(trial)) * len(trial.axes)
    tried = {first: gain(first)}

    def left(square: float) -> float:
        lag = float(np.sqrt(square))
        tried[lag] = gain(lag)
        return float(np.exp(-2.0 * max(tried[lag], -count) / count))

    bounds, options = (0.0, (LONGEST * first) ** 2), {"xatol": CLOSE * first**2, "maxiter": ROUNDS}
    minimize_scalar(left, bounds=bounds, method="bounded", options=options)
    best = max(tried, key=tried.get)
    return best if best > LEAST * trial.h else None


def _gain(trial: Trial, before: Fit, sensor: Sensor, lag: float) -> float:
    """Log-likelihood [nat] that a reference without ``lag`` s, on the sensor's clock, gains."""
    quick = _quick(trial, lag)
    clock = measure(quick, sensor)
    if clock is None or not np.isfinite(clock.std):
        return -np.inf
    moved = replace(shifted(quick, clock), clock=replace(clock, taken_out=True))
    return advantage_by_one_noise(fitted_structure(in_band_of(trial, moved), sensor), before)


def _quick(trial: Trial, lag: float) -> Trial:
    """The trial with a reference that does not lag, on the clock on which it is."""
    u, own = np.array(trial.u), OWN[trial.kind]
    for a, b in trial.segments:
        u[a:b, own] = unlagged_rate(trial.time[a:b], u[a:b, own], lag, trial.reference)
    return replace(trial, u=u)
