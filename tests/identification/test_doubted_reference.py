"""Whether what is left against a rate reference is its own noise, or an effect left it."""

from dataclasses import replace

import numpy as np
import pytest
import traps
from loop_cases import inputs, low_pass, smooth, trial
from world import drive, recording

import pyimu
from pyimu.identification.fit import maximum_likelihood
from pyimu.identification.fit.errors_in_variables import has_noise
from pyimu.identification.fit.fit import begin
from pyimu.identification.fit.high_differences import sensor_white
from pyimu.identification.fit.keys import Coefficient, coefficients_of
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.fit.reference_noise import drawn_again, with_reference_noise
from pyimu.identification.fit.trial import Doubt
from pyimu.identification.formula.columns import columns_of
from pyimu.identification.formula.effect import made
from pyimu.identification.formula.terms import library
from pyimu.identification.search import forward
from pyimu.identification.search.confirm import Evidence
from pyimu.identification.search.own_signal import is_of_reference
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.sensor import Sensor
from pyimu.model.signals import N_INPUT

PERIOD, WHITE = 0.02, 1e-3
SENSOR = Sensor("gyro", {"angle_random_walk": {"N": WHITE * np.sqrt(PERIOD)}})


def log(seed: int, hz: float, whose: str, dead: float = 0.0):
    """A gyro in a motion of 0.3 rad/s with rests, half hidden in which there is noise below ``hz``,
    of the ``reference`` or of the ``sensor``; it may have a dead zone, too.
    """
    rng, time = np.random.default_rng(seed), PERIOD * np.arange(15000)
    u = inputs(np.random.default_rng(99), time)
    u[:, :3] *= 0.3 * (0.2 + (time % 20.0 >= 6.0))[:, None]
    x = u[:, :3]
    more = low_pass(WHITE * rng.standard_normal(x.shape), hz, PERIOD)
    y = x - np.clip(x, -dead, dead) + WHITE * rng.standard_normal(x.shape)
    if whose == "sensor":
        y = y + more
    else:
        u[:, :3] += more
    return trial(time, y, u)


def looked(seed: int, hz: float, whose: str, dead: float = 0.0):
    return with_reference_noise(fit(begin(SENSOR, (), [log(seed, hz, whose, dead)])), [])[0]


@pytest.mark.parametrize("hz", [3.0, 6.0, 12.0])
@pytest.mark.parametrize("seed", range(4))
def test_coloured_noise_of_the_sensor_is_none_of_the_reference(hz, seed):
    """Wrong, by what is asked of it, in one log of a hundred at most."""
    found = looked(seed, hz, "sensor")
    assert found.trials[0].doubt is not Doubt.LIKELY and not found.coloured


@pytest.mark.parametrize("hz", [6.0, 12.0])
@pytest.mark.parametrize("seed", range(4))
def test_coloured_noise_of_the_reference_is_told_from_what_an_effect_leaves(hz, seed):
    """Below 3 Hz too few frames tell in one log of six: it stays open there."""
    found = looked(seed, hz, "reference")
    assert found.coloured or found.trials[0].doubt is Doubt.LIKELY


@pytest.mark.parametrize("seed", range(4))
def test_what_a_dead_zone_leaves_is_not_taken_for_noise_of_the_reference(seed):
    """Neither at first nor once the effect is known, beside such noise."""
    old = looked(seed, 6.0, "reference", dead=0.01)
    assert _is_of_reference(old) is False


def _is_of_reference(old) -> bool:
    """Whether a dead zone beside a model is only what the reference's noise looks like."""
    sensor = old.sensor.with_values("dead_zone", d=5e-3)
    free = old.free | coefficients_of(sensor, "dead_zone")
    new = fit(replace(old, sensor=sensor, free=free))
    return is_of_reference(old, new)


@pytest.mark.parametrize("seed", range(2))
def test_a_draw_of_more_than_all_that_is_left_is_drawn_again(seed):
    """With an effect that left three times the noise of the reference, and has come in since: the
    new draw is what a draw beside the whole model has been from the start, to the rounding of the
    fit. One that is no more than what is left stays.
    """
    true, apart = with_reference_noise(
        fit(begin(SENSOR, (), [log(seed, 6.0, "reference")])), [log(9, 6.0, "reference")], True
    )
    larger, more = (
        [replace(t, noise=3.0 * t.noise) for t in trials] for trials in (true.trials, apart)
    )
    anew, held = drawn_again(replace(true, trials=tuple(larger)), more, True)
    for one, other in zip((*anew.trials, *held), (*true.trials, *apart), strict=True):
        np.testing.assert_allclose(one.noise.std(axis=0), other.noise.std(axis=0), rtol=1e-6)
    smaller = replace(true, trials=tuple(replace(t, noise=0.5 * t.noise) for t in true.trials))
    assert drawn_again(smaller, apart, True) == (smaller, apart)


def sums(before, after, noise):
    none = np.zeros(3)
    return Evidence(none, none, none, none, none, none, np.array([before, after]), np.array(noise))


@pytest.mark.parametrize(
    ("before", "after", "little"),
    [
        ([-2.0, 5.0, 0.0], [-3.0, 5.0, 0.0], False),  # all of x is noise of the reference
        ([0.5, 5.0, 0.0], [0.3, 5.0, 0.0], False),
        ([-2.0, 5.0, 0.0], [-2.0, 4.9, 0.0], True),
        ([3.0, 5.0, 0.0], [2.9, 5.0, 0.0], True),
    ],
)
def test_where_nothing_is_left_above_the_noise_nothing_unknown_looks_like_an_effect(
    before, after, little
):
    """Squares less those of a draw as large as they are lie about zero: a g-sensitivity of 70 nat
    was refused as 1 % of what is left, which is what it explained on the other axes.
    """
    assert sums(before, after, [1.0, 1.0, 0.0]).is_little is little


def test_what_the_error_of_a_draw_leaves_has_no_unknown_cause():
    """A draw of the noise of attitudes is known to 3 % of its power: 2 % of it that are left above
    it are no reason to refuse a scale factor of 19 nat; 12 % are.
    """
    less = sums([3.0, -5.0, 0.0], [2.99, -4.99, 0.0], [1.0, 1.0, 0.0])
    assert less.is_little
    assert not replace(less, unsure=np.array([3.0, 3.0, 0.0])).is_little
    assert replace(less, unsure=np.array([0.5, 0.5, 0.0])).is_little


def test_rounds_that_go_in_a_circle_beside_noise_of_the_reference_end_at_its_likeliest(monkeypatch):
    """Steps to and fro between the truth and a scale factor of 5 %, whatever is fitted."""
    sensor = SENSOR.with_values("scale_factor")
    found = fit(begin(sensor, (), [log(1, 6.0, "reference")]))
    true, _ = with_reference_noise(found, [], believed=True)
    assert has_noise(true)
    wrong = replace(true, sensor=sensor.with_values("scale_factor", s=np.full(3, 0.05)))
    taken = []

    def to_and_fro(start, steps):
        taken.append(true if start.sensor == wrong.sensor else wrong)
        return taken[-1]

    monkeypatch.setattr(maximum_likelihood, "_least_squares", to_and_fro)
    assert fit(true).sensor == true.sensor
    assert len(taken) < maximum_likelihood.ROUNDS / 2


def test_a_search_that_doubts_its_reference_whatever_it_finds_ends(monkeypatch):
    """It begins anew once, with the doubt believed; a log in which it still doubted never ended."""
    searches = []
    monkeypatch.setattr(forward, "_is_of_reference", lambda search: searches.append(search) or True)
    found = forward.investigate(SENSOR, frozenset(), [log(1, 6.0, "reference")], [])
    assert found.believed and len(searches) == 1


@pytest.mark.long
@pytest.mark.parametrize(
    "number, seed, form", [(0, 5, "undeclared"), (0, 21, "declared"), (1, 7, "declared")]
)
def test_a_rate_with_noise_that_motion_hides_blames_no_sensor(number, seed, form):
    """Its noise was thrown away, and a dead zone, a switch, or "depends on rate" was found."""
    case = traps.case("rate_with_correlated_noise", seed=seed, number=number)
    found = traps.closed(case, form)
    assert not traps.blamed(case, form, found) and not found.unexplained
    assert traps.NAMED[case.cause](case, found)


def test_the_sensors_white_noise_is_seen_beside_motion_and_noise_of_the_reference():
    """Neither enters, nor does the choice of what is quiet: four standard errors of the mean of 60,
    1 in 16,000 by chance. The quietest quarter of the sensor's own seconds is 16 % lower.
    """
    time, seen = PERIOD * np.arange(6000), []
    for seed in range(20):
        rng = np.random.default_rng(seed)
        x = (
            smooth(rng, time, 0.1)
            + smooth(rng, time, 2e-3, highest=15.0) * (time % 9.0 > 4.0)[:, None]
        )
        u = np.zeros((len(time), N_INPUT))
        u[:, :3] = x + WHITE * rng.standard_normal(x.shape)
        y = x + WHITE * rng.standard_normal(x.shape)
        seen += list(sensor_white(trial(time, y, u), y - u[:, :3]) / WHITE**2)
    assert abs(np.mean(seen) - 1.0) < 4.0 * np.std(seen) / np.sqrt(len(seen))
    assert np.std(seen) < 0.1


def test_a_formula_of_the_sensors_own_signal_follows_the_motion_not_the_bias():
    """Its slope is the term that was scored, at a bias a hundred times the level of the switch."""
    time = PERIOD * np.arange(4000)
    u = inputs(np.random.default_rng(3), time)
    one = trial(time, u[:, :3] + 0.05, u)
    term = next(t for t in library("gyro", (one,)) if t.switch is not None and "rate" in t.signals)
    made("found_effect", "gyro", [term])
    try:
        start = begin(SENSOR.with_values("found_effect"), (), [one])
        key = Coefficient("found_effect", "c1", (0,))
        free = begin(start.sensor, {key}, [one])
        (linear,) = free.linearise()
        (scored,) = start.beside(start.linearise(), [columns_of("gyro", [term])])
        slope = linear.columns[0].arrays[linear.keys[0].index(key)]
        of_term = [n for n, k in enumerate(scored.keys[0]) if getattr(k, "term", "") == term.text]
        np.testing.assert_array_equal(slope, scored.columns[0].arrays[of_term[0]])
        assert 0.01 < slope.mean() < 0.99
    finally:
        CATALOGUE.remove("found_effect")


@pytest.mark.parametrize("whose", ["sensor", "reference"])
def test_a_line_is_the_sensors_only_where_its_own_signal_shows_it(whose):
    """Four times the noise of a sample in the whole log: an encoder's counts, or the sensor's."""
    world = drive(minutes=4, seed=31)
    made = recording(world, seed=5, kinds=("gyro",))
    line = np.radians(0.02) * np.sin(2 * np.pi * 3.1 * made.time)[:, None] * [0.0, 1.0, 0.0]
    if whose == "sensor":
        made = replace(made, ref_force=None, gyro=made.gyro + line)
    else:
        made = replace(made, ref_force=None, ref_rate=made.ref_rate + line)
    closed = pyimu.close(made)
    found = [f for f in closed.quality if f.kind == "reference_line"]
    if whose == "sensor":
        assert [a.effect for a in closed.added] == ["vibration_line"] and not found
        return
    assert closed.verdict == "clean", closed.report()
    assert found[0].detail["frequency"] == pytest.approx(3.1, abs=1e-3)
    assert found[0].detail["amplitude"] == pytest.approx(np.radians(0.02), rel=0.1)


def test_a_reference_that_shakes_where_it_moves_is_no_lag_of_the_sensor():
    """In quiet it has no noise, and a lag would take much of what it has away; the sensor's own
    signal shows none of it.
    """
    found = traps.closed(traps.case("rate_of_a_shaken_unit", 27000, 0), "declared")
    assert not found.added
    (refused,) = [r for _, r in found.refused if r.effect == "lag"]
    assert "own signal does not show it" in refused.reason
