"""Whether the sensor's own signal shows what a candidate explains.

With e the noise of the reference, the columns c(x + e) of a candidate meet the residual's own -e,
and seem to explain it. With the sensor's signal in the place of the reference they do not: that has
none of e, and its own noise is known. It is an instrument (Durbin 1954, "Errors in variables",
Review of the International Statistical Institute 22), and what an effect left is in both.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pyimu.identification.fit.columns import band_segments, band_time, in_band, in_log, residual
from pyimu.identification.fit.damping import slopes
from pyimu.identification.fit.doubted import CERTAIN
from pyimu.identification.fit.errors_in_variables import STEP
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.high_differences import sensor_white
from pyimu.identification.fit.inputs import Inputs, LogState, own_rate, reference_input
from pyimu.identification.fit.noise_fit import declared_variances
from pyimu.identification.fit.response import predict
from pyimu.identification.fit.trial import MEASURED, Trial
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor

AT_ZERO = ("bias_asymmetry", "dead_zone", "hard_dead_zone")
"""Effects that make as much of an input near zero as of a larger one, or all of it: of an axis that
is at rest there they know the noise of its reference, however little that is."""


@dataclass(frozen=True)
class _Sums:
    """Sums of whitened products: of what lies between two models by the sensor's signal with
    itself, with the same by the reference, and with the residual.
    """

    own: float = 0.0
    effect: float = 0.0
    seen: float = 0.0

    def __add__(self, other: _Sums) -> _Sums:
        return _Sums(self.own + other.own, self.effect + other.effect, self.seen + other.seen)


def is_of_reference(
    old: Fit, new: Fit, certain: float = CERTAIN, seed: int = 1, follows: bool = False
) -> bool:
    """Whether what a ``new`` model explains beyond an ``old`` one is the noise of a doubted
    reference: by the sensor's own signal nothing is likelier than a true effect, by more than
    ``certain`` [nat].

    One that ``follows`` the noise of a reference takes it away as it does the motion, or has its
    sign where an axis is at rest: a reference that was measured is doubted then whatever it seems
    to have.
    """
    rng = np.random.default_rng(seed)
    trials = [t for t in new.trials if t.doubt or (follows and t.reference in MEASURED)]
    total = sum((_sums(old, new, t, rng) for t in trials), _Sums())
    if total.own <= 0.0:
        return False
    nothing = (0.5 * total.effect - total.seen) * total.effect / total.own
    return nothing > certain


def _sums(old: Fit, new: Fit, trial: Trial, rng: np.random.Generator) -> _Sums:
    state = old.states[trial.name]
    left = residual(old.sensor, trial, state)
    own, _ = declared_variances(old.sensor, trial.h)
    if not own.any():
        own = sensor_white(trial, left)
    drawn = np.sqrt(own) * rng.standard_normal(trial.y.shape)

    def between(change: np.ndarray) -> np.ndarray:
        after, before = (
            predicted(f.sensor, trial, f.states[trial.name], change) for f in (new, old)
        )
        return in_band(trial, after - before)

    by_reference, by_sensor = between(np.zeros_like(left)), between(left)
    up, down = (between(left + sign * STEP * drawn) for sign in (1.0, -1.0))
    echo, time = (up - down) / (2.0 * STEP), band_time(trial)
    rows, known = in_band(trial, left), in_band(trial, drawn)
    total = _Sums()
    for i in trial.axes:
        columns = [v[:, i] for v in (by_sensor, by_reference, rows, echo, known)]
        white = old.noise[i].whiten(np.column_stack(columns), time, band_segments(trial))
        a, b, r, c, e = white.T
        total += _Sums(float(a @ a), float(a @ b), float(a @ r - c @ e))
    return total


def predicted(sensor: Sensor, trial: Trial, state: LogState, change: np.ndarray) -> np.ndarray:
    """What a model says (n, 3) where the sensor's input is the reference's and a ``change`` (n, 3)
    of it.
    """
    u = reference_input(trial, state)
    at, rate = OWN[trial.kind], own_rate(trial.kind)
    _moved(u, trial, at, change)
    _moved(u, trial, rate, slopes(trial, change))
    return predict(in_log(sensor, state), u, trial.segments, trial.h)


def _moved(u: Inputs, trial: Trial, at: slice, change: np.ndarray) -> None:
    """Add a change (n, 3) on the axes that were measured."""
    wanted = np.isin(np.arange(3), trial.axes)
    u[:, at] = u[:, at] + np.where(wanted, change, 0.0)
