"""Cases of ``benchmarks/effects.py`` in which an effect had another beside it or gave way to it."""

import numpy as np
import pytest
from effect_logs.cases import make
from effect_results.record import closed

MINUTES = 6.0, 9.0


@pytest.mark.parametrize("kind", ["accel", "gyro"])
def test_a_dead_zone_whose_zeros_one_axis_shows_is_looked_for_on_the_others(kind):
    """On each within four standard errors: 1 in 16,000 by chance."""
    made = make(f"one/30/{kind}.dead_zone", 0, MINUTES)
    (truth,) = made.truths
    found = closed(made)
    (added,) = found.added
    assert added.effect == "dead_zone", found.report()
    value, std, _ = added.parameters["d"]
    assert np.array_equal(value > 0.0, truth.value > 0.0)
    there = truth.value > 0.0
    assert np.all(np.abs(value - truth.value)[there] < 4.0 * std[there])


def test_an_element_that_is_not_shown_does_not_take_its_effect_along():
    """One of g2_sensitivity came out at 407 deg/h/g², give or take 140, and all of it was refused:
    what it left was named vibration_rectification.
    """
    found = closed(make("together/8/gyro.g2_sensitivity", 2, MINUTES))
    assert [a.effect for a in found.added] == ["g2_sensitivity"], found.report()
