"""The noise of positions, which is differentiated twice: as much as there is is taken out."""

import numpy as np
import pytest
import test_filtered_places
from test_filtered_places import Wand

from pyimu.identification.close import _free, _prior, undeclared
from pyimu.identification.fit.columns import in_band
from pyimu.identification.fit.fit import Fit, begin
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.fit.reference_noise import with_reference_noise
from pyimu.identification.fit.trial import accel_trial
from pyimu.identification.search.forward import _first
from pyimu.identification.trials import prepared
from pyimu.model.kinds import OWN

PLACE_NOISE = 1e-3


def trial_of(wand: Wand, **changes):
    (trial,), _ = prepared([accel_trial(wand.log(**changes), False)], [], True)
    return trial


def fitted(trial) -> Fit:
    """The model of a part that nobody declared beside the noise of its reference."""
    start = undeclared(1.0 / trial.h)
    free = _free(start, False, start.accel, [trial])
    first = _first(begin(start.accel, free, [trial], _prior(start.accel, free)), False)
    return fit(with_reference_noise(first, [], False)[0])


def scales(found: Fit) -> np.ndarray:
    """Scale factors (k,) that were found, of a sensor that has none, in standard errors."""
    keys = [k for k in found.free if isinstance(k, Coefficient) and k.effect == "scale_factor"]
    values = found.sensor.values["scale_factor"]["s"]
    return np.array([values[k.index] / found.std[k] for k in keys])


def test_as_much_noise_is_drawn_as_positions_have():
    """The low-pass that the force goes through is no reason to draw it twice over. It is read off
    two windows of 64 rows: four standard errors of a variance by so many are 4 sqrt(2 / 128).
    """
    wand = Wand(seed=41, place_noise=PLACE_NOISE)
    trial, without = trial_of(wand), trial_of(wand, places=Wand(seed=41, place_noise=0.0).place)
    there = in_band(trial, (trial.u - without.u)[:, OWN["accel"]])
    drawn = in_band(trial, fitted(trial).trials[0].noise)
    assert drawn.var(axis=0).mean() == pytest.approx(there.var(axis=0).mean(), rel=0.5)


def test_a_long_arm_is_no_noise_of_positions(monkeypatch):
    """Before it is found 0.4 m of it leave ten times the noise that there is: taken for noise, they
    had scale factors 13 standard errors off.
    """
    monkeypatch.setattr(test_filtered_places, "ARM", np.array([0.3, -0.2, 0.25]))
    off = scales(fitted(trial_of(Wand(seed=52, place_noise=PLACE_NOISE))))
    assert len(off) == 3 and np.abs(off).max() < 4.5
