"""Kinks of effects that are in a model, where the sensor's own signal has them.

With e the noise of a derived reference, a kink of an effect c is smeared: c(x + e) is not c(x) in
the mean. What lies between the two follows the motion as no other effect does, and would look like
one that has no name; and the size of the effect is the wrong one. The sensor's own signal has none
of e, and its noise goes through the effect in truth.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from pyimu.identification.fit.fit import Fit, Last
from pyimu.identification.fit.inputs import LogState
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.fit.score import held_state
from pyimu.identification.fit.trial import MEASURED, Trial
from pyimu.identification.search.own_signal import AT_ZERO, predicted
from pyimu.model.sensor import Sensor

KINKED = ("scale_factor_asymmetry", *AT_ZERO)
"""Effects that bend the sensor's own signal at once, where it is zero or about."""

ROUNDS = 3
"""Of the sizes of effects and of where the sensor's own signal has their kinks."""


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
        sizes = _half_way(sizes, after.sensor, names)
    return after, [_bent(after.sensor, t, held_state(after, t)[0], names) for t in held]


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
    if not _is_smeared(trial) or not len(trial.time):
        return trial
    nothing = np.zeros_like(trial.y)
    own = trial.y - predicted(sensor, trial, state, nothing)
    own = own + trial.y - predicted(sensor, trial, state, own)
    bent = {}
    for name in names:
        plain = sensor.without(name)
        by_sensor, by_reference = (
            predicted(sensor, trial, state, change) - predicted(plain, trial, state, change)
            for change in (own, nothing)
        )
        bent[name] = by_sensor - by_reference
    return replace(trial, bent=bent)
