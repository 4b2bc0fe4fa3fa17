"""Whether the positions of a log are of another scale, or the accelerometer's scale factors are.

A search lets the axes of a scale factor in one by one. Beside positions of a scale that is not
known none of them is seen by itself where all three are off alike, although gravity tells the two
apart. Where it does, and says that it is the sensor, the positions are held in the scale that they
have beside free scale factors while something is looked for. They are let go once that is found:
what their scale leaves open is in its interval.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from pyimu.identification.fit.clock import WIDE
from pyimu.identification.fit.errors_in_variables import equations
from pyimu.identification.fit.fit import Fit, Last, begin, gauss_newton, with_prior
from pyimu.identification.fit.inputs import copied
from pyimu.identification.fit.keys import Key, LogPlace, coefficients_of
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.fit.normal import variances
from pyimu.identification.fit.place import SCALE, SCALED
from pyimu.identification.fit.reduction import GAIN
from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.place import with_force
from pyimu.identification.reference.scales import with_gains
from pyimu.identification.search.investigation import Investigation
from pyimu.identification.search.screen import fitted_dispersion
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor

ROUNDS, STEPS = 3, 4
"""Of what belongs to the log: the noise of each round is what the one before left."""


class Share(NamedTuple):
    """By which the body's way is longer than positions: what these are held at, and the standard
    error beside free scale factors.
    """

    value: float
    std: float


Shares = Mapping[str, Share]


def held_shares(sensor: Sensor, free: frozenset[Key], trials: Sequence[Trial]) -> Shares:
    """In which scale positions are to be held, of the logs that do not know it; none where the
    accelerometer's scale factors are free, or where gravity does not show that they are others than
    declared.
    """
    names = [t.name for t in trials if t.place is not None and t.place.scale_std]
    if not names or coefficients_of(sensor, GAIN) <= free:
        return {}
    found = with_gains(begin(sensor, free, trials))
    for _ in range(ROUNDS):
        found = gauss_newton(found.with_noise(), STEPS)
    normal = with_prior(equations(found), found)
    values = found.sensor.values[GAIN]["s"]
    known = sensor.values.get(GAIN, {}).get("s", np.zeros(3))
    std = dict(zip(normal.keys, np.sqrt(variances(normal.gram)), strict=True))

    def error(key: Key) -> float:
        if key not in std:
            return np.inf
        return float(std[key] * np.sqrt(fitted_dispersion(normal, [key])))

    gains = coefficients_of(found.sensor, GAIN)
    if not any(abs(values[k.index] - known[k.index]) > WIDE * error(k) for k in gains):
        return {}
    shares = {n: Share(found.states[n].place[SCALE], error(LogPlace(n, SCALE))) for n in names}
    return {n: s if abs(s.value) > WIDE * s.std else Share(0.0, s.std) for n, s in shares.items()}


def with_scale_held(trial: Trial, shares: Shares) -> Trial:
    """The trial with its positions in the scale in which they are to be held."""
    if trial.name not in shares:
        return trial
    return _scaled(trial, 1.0 + shares[trial.name].value, 0.0)


def names_gain(inv: Investigation) -> bool:
    """Whether an investigation found scale factors of the sensor, declared ones or new ones."""
    return any(s.effect == GAIN for s in inv.steps)


def let_go(inv: Investigation, shares: Shares) -> Investigation:
    """An investigation beside positions whose scale is not known, as before anything was held; as
    it is where that goes elsewhere then, because the model has not all that gravity shows.
    """
    before, after = _let_go(inv.before, shares), fit(_let_go(inv.after, shares))
    away = ((after.states[n].place[SCALE] - s.value, s.std) for n, s in shares.items())
    if any(abs(moved) > WIDE * std for moved, std in away):
        return inv
    held = tuple(_as_it_was(t, shares) for t in inv.held)
    return replace(inv, before=before, after=after, held=held)


def _let_go(fitted: Fit, shares: Shares) -> Fit:
    trials = tuple(_as_it_was(t, shares) for t in fitted.trials)
    states = dict(fitted.states)
    for name, share in shares.items():
        states[name] = states[name].moved(LogPlace(name, SCALE), share.value)
    return replace(fitted, trials=trials, states=states, last=Last())


def _as_it_was(trial: Trial, shares: Shares) -> Trial:
    if trial.name not in shares:
        return trial
    return _scaled(trial, 1.0 / (1.0 + shares[trial.name].value), SCALED)


def _scaled(trial: Trial, factor: float, std: float) -> Trial:
    """The trial with its positions larger by a ``factor``, whose scale is known to ``std``."""
    u = copied(trial.u)
    u[:, OWN[trial.kind]] += (factor - 1.0) * trial.place.forces[SCALE].T
    return with_force(replace(trial, place=replace(trial.place, scale_std=std)), u)
