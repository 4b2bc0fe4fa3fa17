"""Forms of effects that no slope leads to: found in a residual with known noise, and charged for
the choice.
"""

from dataclasses import replace

import numpy as np
import pytest
from loop_cases import inputs, noise, trial
from scipy.stats import binom

from pyimu.identification.fit.columns import residual
from pyimu.identification.fit.fit import begin
from pyimu.identification.fit.inputs import LogState
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.fit.mixture import LEVEL, REACH
from pyimu.identification.fit.response import is_driven, predict, with_memory
from pyimu.identification.fit.trial import marked
from pyimu.identification.search.choice import refine
from pyimu.identification.search.form import UNUSED, form_of
from pyimu.identification.search.forms import forms
from pyimu.identification.search.instants import at_instants
from pyimu.identification.search.screen import PENALTY, screen
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS

R = 1e-4
H = 0.04
ERRORS = 4.0
"""Standard errors; one in 16,000 is farther off."""

CASES = {
    "warm_up": {"A": [0.02, 0.0, -0.02], "tau": 30.0},
    "bias_step": {"A": np.c_[[0.01, 0.0, -0.01], np.zeros((3, 3))], "t0": [63.4, 0, 0, 0]},
    "thermal_hysteresis": {"kh": [0.01, -0.01, 0.0], "width": 2.0},
    "vibration_line": {"A": [0.004, 0.0, 0.003], "f0": 7.123, "phase": [1.0, 0.0, -2.0]},
}
SCANNED = {n: form_of(CATALOGUE[n]) for n in CASES}


def world(name: str = "", seed: int = 3):
    """A fitted trial of three minutes whose sensor has an effect that its model lacks."""
    rng, time = np.random.default_rng(seed), np.arange(4500) * H
    u = inputs(rng, time)
    u[:, COLUMNS["time"].start] = time
    y = u[:, OWN["gyro"]]
    if name:
        y = predict(Sensor("gyro", {name: CASES[name]}), u, [(0, len(u))], H)
    y = y + noise(rng, time, R, 0.0)
    known = frozenset({"rate", "specific_force", "temperature", "time"})
    return fit(begin(Sensor("gyro", {}), frozenset(), [trial(time, y, u, known=known)]))


@pytest.mark.parametrize("name", CASES)
def test_an_effect_is_found_with_its_form(name):
    seen = {c.effect: c for c in screen(world(name), ()).candidates}
    best = max(seen.values(), key=lambda c: c.gain)
    assert best.effect == name
    refined = refine(world(name), seen[name])
    parameter = SCANNED[name]
    found = np.ravel(refined.fit.sensor.values[name][parameter])[0]
    true = np.ravel(CASES[name][parameter])[0]
    index = (0,) if CATALOGUE[name].parameters[parameter].shape else ()
    assert abs(found - true) < ERRORS * refined.fit.std[Coefficient(name, parameter, index)]


@pytest.mark.parametrize("size", [pytest.param(0.002, marks=pytest.mark.long), 0.006])
def test_an_instant_lies_within_its_interval(size):
    """Of a step of 0.2 and of 0.6 standard deviations of a sample, whose instant is known to some
    seconds and to a few tenths; it is looked for from a second beside it.
    """
    rng, time, runs, inside = np.random.default_rng(8), np.arange(2000) * H, 60, 0
    u = inputs(rng, time)
    u[:, COLUMNS["time"].start] = time
    for _ in range(runs):
        y = u[:, OWN["gyro"]] + noise(rng, time, R, 0.0)
        y[:, 0] += size * (time >= 40.0)
        case = trial(time, y, u, known=frozenset({"rate", "time"}))
        sizes = np.zeros((3, 4))
        sizes[0, 0] = size
        sensor = Sensor("gyro", {"bias_step": {"A": sizes, "t0": [41.0, UNUSED, UNUSED, UNUSED]}})
        begun = begin(sensor, [Coefficient("bias_step", "A", (0, 0))], [case])
        found = at_instants(fit(begun), "bias_step")
        off = found.sensor.values["bias_step"]["t0"][0] - 40.0
        inside += abs(off) < REACH * found.std[Coefficient("bias_step", "t0", (0,))]
    assert inside >= binom.ppf(1e-3, runs, LEVEL)


@pytest.mark.long
@pytest.mark.parametrize("name", CASES)
def test_a_form_costs_more_than_chance_makes_of_it(name):
    """With nothing to find, one log in a hundred at the most gains so much."""
    passed = 0
    for seed in range(12):
        fitted = world(seed=seed)
        found = {c.effect: c for c in screen(fitted, ()).candidates}
        passed += found[name].gain > -np.log(0.01)
    assert passed <= 1  # P(2 or more of 12 at 1 %) is 0.6 %


def test_what_follows_from_other_signals_is_remembered_alone():
    fitted = world()
    (t,) = fitted.trials
    sensor = Sensor("gyro", {"thermal_hysteresis": CASES["thermal_hysteresis"]})
    assert is_driven(CATALOGUE["thermal_hysteresis"], "gyro")
    assert not is_driven(CATALOGUE["angle_quantization"], "gyro")
    assert len(with_memory(sensor, list(t.u.T), H)) > t.u.shape[1]
    kh, width = 0.01, 2.0
    played, at = [], t.u[0, COLUMNS["temperature"].start]
    for now in t.u[:, COLUMNS["temperature"].start]:
        at = max(now - width, min(now + width, at))
        played.append(at - now)
    change = predict(sensor, t.u, t.segments, H) - t.u[:, OWN["gyro"]]
    np.testing.assert_allclose(change[:, 0], kh * np.array(played), atol=1e-12)


@pytest.mark.parametrize("lag", [0.0, 20.0])
def test_the_end_of_a_log_remembers_what_came_before_it(lag):
    (whole,) = world().trials
    sensor = Sensor("gyro", {"thermal_hysteresis": CASES["thermal_hysteresis"]})
    state = LogState(lag=lag)
    expected = residual(sensor, whole, state)
    first, rest = whole.split(0.4)
    _, end = rest.head()
    assert end.count > 1000
    np.testing.assert_allclose(residual(sensor, first, state), expected[: len(first.time)])
    for part in (rest, end):
        np.testing.assert_allclose(residual(sensor, part, state), expected[-len(part.time) :])
        forgetful = residual(sensor, replace(part, earlier=None), state)
        assert np.abs(forgetful - expected[-len(part.time) :]).max() > 1e-3


def test_a_gap_does_not_make_a_play_forget():
    (t,) = world().trials
    sensor = Sensor("gyro", {"thermal_hysteresis": CASES["thermal_hysteresis"]})
    n = len(t.time)
    broken = replace(t, segments=[(0, n // 2), (n // 2 + 50, n)])
    rows = marked(broken.segments, n)
    whole, pieces = (residual(sensor, one, LogState()) for one in (t, broken))
    np.testing.assert_allclose(pieces[rows], whole[rows])


def test_forms_are_not_sought_in_rows_that_are_no_samples():
    fitted = world()
    (t,) = fitted.trials
    apart = replace(fitted, trials=(replace(t, reduction=object()),))
    assert forms(apart, [CATALOGUE["warm_up"]], PENALTY) == {}
