"""What a residual remembers of the motion: a bias that turns feed and that fades after them."""

import numpy as np
import pytest
from effect_logs.cases import make
from effect_results.record import closed

from pyimu.identification.formula.memory import Remembered, low_passed
from pyimu.identification.noise.named import Noise
from pyimu.identification.search.leftover import Unexplained
from pyimu.identification.verdict.random import _unless_remembered

SEEN = (Unexplained("gyro", "x", ("rate",), 1e-9, "a memory of the rate"),)


def test_a_low_pass_answers_a_step_by_an_exponential():
    values = np.append(np.zeros(5), np.ones(50))
    expected = 1.0 - np.exp(-0.1 * np.arange(1, 51))
    np.testing.assert_allclose(low_passed(values, 0.1)[5:], expected, rtol=1e-12)


def test_a_low_pass_has_seen_its_first_value_for_ever():
    np.testing.assert_allclose(low_passed(np.full(20, 3.0), 0.3), 3.0, rtol=1e-12)


@pytest.mark.parametrize(("gain", "is_memory"), [(430.0, False), (436.0, True)])
def test_a_memory_is_said_where_it_explains_more_than_the_walk(gain, is_memory):
    """By more than 6 nat, as one effect is preferred to another."""
    walk = Noise(drift={0: 428.0})
    assert _unless_remembered(walk, Remembered(gain, 0.0, SEEN)).shapes == SEEN * is_memory


def test_jumps_between_two_levels_stay_what_they_are():
    jumps = Noise(shapes=(Unexplained("gyro", "x", (), 1e-9, "popcorn"),))
    assert _unless_remembered(jumps, Remembered(1e3, 0.0, SEEN)) is jumps


@pytest.mark.long
@pytest.mark.parametrize("kind", ["gyro", "accel"])
def test_a_bias_that_turns_feed_is_neither_a_walk_nor_a_warm_up(kind):
    """It was called drift of the gyro, and of the accelerometer a warm-up that explains 9 nat of
    450.
    """
    found = closed(make(f"strange/30/{kind}.after_turns", 220, (5.0, 6.0)))
    assert found.verdict == "unexplained" and not found.added, found.report()
    assert "a memory of the size of the angular rate" in found.reason


@pytest.mark.long
def test_the_sign_of_a_slope_is_no_multiple_of_the_slope():
    """angular_acceleration explains 292 of 450 nat, and was named."""
    found = closed(make("strange/30/gyro.slope_sign", 220, (5.0, 6.0)))
    assert [a.effect for a in found.added] == ["found_effect"], found.report()
    assert "angular acceleration" in found.formulas[0].said
