"""The demo says what was put in, what was found, and what its pictures show."""

import numpy as np
import pytest
from markupsafe import Markup

import pyimu
from pyimu.identification.model.simulated import Simulated
from pyimu.identification.report.page import page
from pyimu.identification.report.put_in import put_in
from pyimu.identification.search.choice import SET_WIDTH
from pyimu.rover import demo
from pyimu.rover.optical import WANDER


@pytest.fixture(scope="module")
def closed():
    return pyimu.close(demo.recording(), part="imt30")


@pytest.fixture(scope="module")
def entries(closed):
    return put_in(closed, demo.true_part())


def test_every_coefficient_that_differs_from_the_declared_part_is_listed_once(entries):
    keys = [(e.sensor, e.effect, e.place) for e in entries]
    axes = [("gyro", "scale_factor"), ("gyro", "turn_on_bias"), ("accel", "turn_on_bias")]
    wanted = [(*pair, i) for pair in (*axes, ("accel", "angle_random_walk")) for i in "xyz"]
    assert sorted(keys) == sorted(wanted)


def test_what_was_put_in_is_the_truth_and_what_was_found_the_model(closed, entries):
    """The model as it is kept is rounded to a few figures, by its errors."""
    scale = [e for e in entries if e.effect == "scale_factor"]
    assert [e.true for e in scale] == list(demo.UNDECLARED)
    found = closed.after.gyro.values["scale_factor"]["s"]
    for e, value in zip(scale, found, strict=True):
        assert e.found == pytest.approx(value, rel=1e-3) if value else np.isnan(e.found)
        if np.isfinite(e.found):
            assert (e.low <= e.true <= e.high) == (e.said == "found, in its interval")


def test_what_lies_below_the_smallest_visible_of_its_axis_is_said_to(closed, entries):
    """The rover turns about z alone: what x and y are not seen for is more than what z is."""
    seen = next(
        v for v in closed.observability if v.effect == "scale_factor" and v.sensor == "gyro"
    )
    scale = {e.place: e for e in entries if e.effect == "scale_factor"}
    assert seen.each[2,] == seen.smallest_visible < abs(scale["z"].true)
    for i, place in enumerate("xy"):
        least = seen.each.get((i,))
        assert least is None or abs(scale[place].true) < least
        said = "this log does not show" if least is None else "below the smallest"
        assert scale[place].said.startswith(f"not found: {said}")


def test_the_last_turn_shows_the_scale_factor_halfway_and_noise_at_its_end(closed):
    """Halfway 180 deg times the scale factor, within four standard deviations of the noise and the
    reference's wander; at the end nothing of it.
    """
    turn = demo.last_turn(closed, demo.recording())
    half = int(np.argmax(np.abs(turn.before)))
    reference = 2 * WANDER
    assert abs(turn.before[half] - np.pi * demo.UNDECLARED[2]) < 4 * np.hypot(
        turn.std[half], reference
    )
    for error in (turn.before, turn.after):
        assert abs(error[-1]) < 4 * np.hypot(turn.std[-1], reference)
    assert np.abs(turn.after).max() < np.abs(turn.before).max() / 2


def test_a_candidate_that_led_at_the_first_look_explains_no_more_when_fitted_in_full(closed):
    """No more by as much as two effects may differ that the data do not tell apart, unless it is
    refused, and said why.
    """
    gyro = {c.effect: c for c in closed.candidates if c.sensor == "gyro"}
    chosen = gyro["scale_factor"]
    ahead = [c for c in gyro.values() if c.gain and c.gain > chosen.gain]
    refused = [c for c in ahead if c.outcome == "refused"]
    assert ahead and all("beyond belief" in c.reason for c in refused)
    text = page(closed)
    for c in (c for c in ahead if c not in refused):
        assert c.fitted < chosen.fitted + SET_WIDTH
        led, apart = "though they led", "do not tell apart"
        assert (
            f"{c.effect} "
            in text[text.index("So ") : text.index(apart if c.outcome == "alternative" else led)]
        )


def test_page_and_report_say_that_the_rover_is_simulated(closed, entries):
    told = closed.__class__(**{**vars(closed), "simulated": Simulated(demo.MADE, entries)})
    assert Markup.escape(demo.MADE) in page(told)
    assert "This rover is simulated" in told.report()
    assert len(told.as_dict()["simulated"]["put_in"]) == len(entries)
    assert "simulated" not in closed.as_dict()
