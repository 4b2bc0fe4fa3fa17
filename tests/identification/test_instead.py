"""Random errors that look like something else, on cases of the benchmark."""

from types import SimpleNamespace

import numpy as np
import pytest
from effect_logs.cases import make
from effect_results.record import closed

import pyimu
from pyimu.identification.noise.jumps import POPCORN
from pyimu.identification.noise.laws import kinds, names_of
from pyimu.identification.report.page import page
from pyimu.identification.search.by_chance import Chance
from pyimu.identification.search.investigation import AS_NOISE
from pyimu.identification.search.taken_back import without
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording

MINUTES = (5.0, 8.0)

TO = 0.01 * 9.80665
"""m/s^2; to which samples are rounded."""


@pytest.mark.long
def test_a_walk_that_a_step_explains_on_the_fitted_rows_is_a_walk():
    """A step explained 35 nat of the fitted ones beside the walk as it was declared; beside one
    that is estimated anew it explains no more than the best of as many steps does of a walk.
    """
    found = closed(make("one/8/gyro.rate_random_walk", 0, MINUTES))
    assert not found.added and not found.refused, found.report()
    assert found.verdict == "drift"
    assert [c.effect for c in found.changed] == ["rate_random_walk"]


@pytest.mark.long
def test_a_step_that_was_let_in_is_taken_back_for_a_walk(monkeypatch):
    """Events that are placed beside the walk as it was declared, and are charged for nothing."""
    monkeypatch.setattr(Chance, "walks", {})
    monkeypatch.setattr(Chance, "tolls", lambda self, e, name, values, most: np.zeros(most))
    found = closed(make("one/8/accel.rate_random_walk", 0, MINUTES))
    assert not found.added, found.report()
    assert found.verdict == "drift"
    assert [(r.effect, r.reason) for _, r in found.refused] == [("bias_step", AS_NOISE)]
    assert [c.effect for c in found.changed] == ["rate_random_walk"]


@pytest.mark.long
@pytest.mark.parametrize("name, number", [("gyro", 3), ("accel", 1)])
def test_jumps_are_said_where_a_walk_is_left_to_the_data(name, number):
    found = closed(make(f"unknown/30/{name}.popcorn", number, MINUTES))
    assert not found.added, found.report()
    assert found.verdict == "unexplained"
    assert {u.shape for u in found.unexplained} == {POPCORN}


@pytest.mark.long
def test_steps_that_are_some_of_many_jumps_are_popcorn():
    """Four of some twenty jumps were bias steps, which keep what they explain beside any walk."""
    found = closed(make("unknown/30/accel.popcorn", 140, (6.0, 9.0)))
    assert not found.added, found.report()
    assert ("bias_step", AS_NOISE) in [(r.effect, r.reason) for _, r in found.refused]
    assert {u.shape for u in found.unexplained} == {POPCORN}


@pytest.mark.long
def test_a_process_too_large_for_one_effect_is_called_by_another_of_its_law():
    """q is 5.6e-4: a consumer part's is 3.9e-5, that of a second, faster process 3.9e-4."""
    found = closed(make("one/8/gyro.second_gauss_markov", 0, MINUTES))
    (added,) = found.added
    assert added.effect == "second_gauss_markov", found.report()
    assert "gauss_markov" in added.alternatives


@pytest.mark.long
def test_white_noise_that_is_larger_by_its_third_digit_is_said():
    """By 1.5 to 1.9 % on each axis, three to four standard errors, together 32 nat."""
    found = closed(make("one/8/gyro.angle_random_walk", 0, MINUTES))
    assert [c.effect for c in found.changed] == ["angle_random_walk"], found.report()


@pytest.mark.long
def test_what_explains_as_much_as_a_larger_walk_is_said():
    """A Gauss-Markov process of 19 s beside the declared walk: 64 nat by a walk three times as
    large, 67 by itself.
    """
    found = closed(make("one/12/accel.gauss_markov", 0, (6.0, 9.0)))
    (changed,) = found.changed
    assert found.verdict == "drift"
    assert changed.effect == "rate_random_walk" and "gauss_markov" in changed.alternatives
    assert any("the data allow gauss_markov" in r for r in found.remarks)
    assert "data allow as well: gauss_markov" in found.report()


@pytest.mark.long
def test_what_explains_as_much_as_another_declared_value_is_said():
    """A scale factor that follows a temperature far from 25 degC all through the log: what speaks
    against another scale factor is expected to be 0.4 nat.
    """
    found = closed(make("one/30/gyro.thermal_scale_factor", 0, (6.0, 9.0)))
    (changed,) = found.changed
    assert changed.effect == "scale_factor" and "thermal_scale_factor" in changed.alternatives
    assert any("the data allow thermal_scale_factor" in r for r in found.remarks)
    assert "thermal_scale_factor" in page(found)


def test_effects_of_one_law_share_their_names_as_far_as_a_part_lacks_them():
    first, second = "gauss_markov", "second_gauss_markov"
    both = {first: {"q": [1e-4] * 3, "tau": [5.0] * 3}}
    for values, known in ((({}, [first, second])), (both, [second])):
        sensor = Sensor("gyro", values)
        kind = {k.name: k for k in kinds(sensor, 0.01, 100.0)}[known[0]]
        assert names_of(kind, sensor) == known


@pytest.mark.long
@pytest.mark.parametrize("effect", ["hard_dead_zone", "saturation"])
def test_what_samples_show_is_no_noise(effect):
    """So few lie at the level or at zero that a walk explains their squares as well."""
    found = closed(make(f"one/8/gyro.{effect}", 5, MINUTES))
    assert [a.effect for a in found.added] == [effect], found.report()


@pytest.mark.parametrize("step, added", [(0.0, []), (0.1, ["bias_step"])])
def test_what_rounding_shifts_at_rest_is_no_step_of_the_bias(step, added):
    """At rest a noise of a sixth of the step does not dither: the mean is off by up to a quarter of
    it, and right again in motion. Samples to 0.01 g of three axes, at rest for 8 s first.
    """
    rng, time = np.random.default_rng(7), np.arange(6000) / 50
    moves = np.clip((time - 8.0) / 2.0, 0.0, 1.0)[:, None]
    force = 4.0 * moves * np.sin(2 * np.pi * np.outer(time, [0.31, 0.23, 0.17]))
    force = force + [0.13, -0.26, 9.8]
    accel = force + 0.016 * rng.standard_normal(force.shape)
    accel[time > 60.0, 1] += step
    accel = np.round(accel / TO) * TO
    found = pyimu.close(Recording.from_arrays("log", time=time, accel=accel, ref_force=force))
    assert sorted(a.effect for a in found.added) == [*added, "quantization"], found.report()


def test_an_effect_that_went_with_another_one_is_taken_back_once():
    """Of two that are to go the first may take the second with it, which leant on it."""
    inv = SimpleNamespace(steps=())
    assert without(inv, "bias_step", AS_NOISE) is inv
