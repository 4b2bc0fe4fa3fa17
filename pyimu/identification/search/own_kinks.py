"""Kinks of effects that are in a model, where the sensor's own signal has them.

With e the noise of a derived reference, a kink of an effect c is smeared: c(x + e) is not c(x) in
the mean. What lies between the two follows the motion as no other effect does, and would look like
one that has no name; and the size of the effect is the wrong one. The sensor's own signal has none
of e, and its noise goes through the effect in truth.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from pyimu.identification.fit.errors_in_variables import moved
from pyimu.identification.fit.fit import Fit, Last, departure
from pyimu.identification.fit.inputs import LogState
from pyimu.identification.fit.keys import coefficients_of
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.fit.score import held_state
from pyimu.identification.fit.trial import MEASURED, Trial
from pyimu.identification.search.own_signal import AT_ZERO, predicted
from pyimu.model.sensor import Sensor

KINKED = ("scale_factor_asymmetry", *AT_ZERO)
"""Effects that bend the sensor's own signal at once, where it is zero or about."""

ROUNDS, SETTLED = 10, 0.1
"""Of the sizes of effects and of where the sensor's own signal has their kinks, at most, and the
standard errors within which the sizes stay."""


def with_own_kinks(after: Fit, held: Sequence[Trial]) -> tuple[Fit, list[Trial]]:
    """A model and trials held out beside it, the kinks of its effects where the sensor's own signal
    has them; as they are where no reference was derived.

    Smeared kinks answer less to a size than true ones do, down to the half: the next size goes
    beyond the true one by as much as this one lacks, and half way between the two it is found.
    """
    names = [n for n in KINKED if n in after.sensor.values and after.sensor.acts(n)]
    if not names or after.is_reduced or not any(map(_is_smeared, after.trials)):
        return after, list(held)
    sizes = after.sensor
    for _ in range(ROUNDS):
        trials = tuple(_bent(sizes, t, after.states[t.name], names) for t in after.trials)
        after = fit(replace(after, trials=trials, last=Last()).with_noise())
        if _stay(sizes, after, names):
            break
        sizes = _half_way(sizes, after.sensor, names)
    return after, [_bent(after.sensor, t, held_state(after, t)[0], names) for t in held]


def _stay(sizes: Sensor, after: Fit, names: Sequence[str]) -> bool:
    """Whether a model has the sizes that its kinks were made with, within what is known of them."""
    was = replace(after, sensor=sizes)
    keys = (k for n in names for k in coefficients_of(sizes, n) & after.free)
    return all(
        abs(departure(after, k) - departure(was, k)) <= SETTLED * after.std.get(k, 0.0)
        for k in keys
    )


def _half_way(one: Sensor, other: Sensor, names: Sequence[str]) -> Sensor:
    """The ``other`` sensor with the sizes of some effects half way to those of ``one``."""
    for name in names:
        both = one.values[name], other.values[name]
        half = {p: 0.5 * (np.asarray(both[0][p]) + both[1][p]) for p in both[1]}
        other = other.with_values(name, **half)
    return other


def _is_smeared(trial: Trial) -> bool:
    return trial.band_hz is not None and trial.reference not in MEASURED


def _bent(sensor: Sensor, trial: Trial, state: LogState, names: Sequence[str]) -> Trial:
    """The trial, and what it is with its reference moved by its noise, which no kink of the
    sensor's own signal follows.
    """
    if not _is_smeared(trial) or not len(trial.time):
        return trial
    own = trial.y - predicted(sensor, trial, state, np.zeros_like(trial.y))
    own = own + trial.y - predicted(sensor, trial, state, own)
    by_sensor = {n: _of_effect(sensor, trial, state, n, own) for n in names}
    out = _beyond_reference(sensor, trial, state, by_sensor)
    for sign in (1, -1) if trial.noise is not None else ():
        out.moved[sign] = _beyond_reference(sensor, moved(out, sign), state, by_sensor)
    return out


def _beyond_reference(
    sensor: Sensor, trial: Trial, state: LogState, by_sensor: Mapping[str, np.ndarray]
) -> Trial:
    nothing = np.zeros_like(trial.y)
    bent = {n: v - _of_effect(sensor, trial, state, n, nothing) for n, v in by_sensor.items()}
    return replace(trial, bent=bent)


def _of_effect(
    sensor: Sensor, trial: Trial, state: LogState, name: str, change: np.ndarray
) -> np.ndarray:
    """What an effect adds (n, 3) where the sensor's input is the reference's and a ``change`` of
    it.
    """
    plain = sensor.without(name)
    with_it, without = (predicted(s, trial, state, change) for s in (sensor, plain))
    return with_it - without
