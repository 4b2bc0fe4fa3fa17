"""Two effects at once, each of twelve standard errors, on cases of the benchmark."""

import pytest
from effect_logs.cases import make
from effect_results.record import closed


def named(case):
    return {(a.sensor, a.effect) for a in case.added}


@pytest.mark.long
def test_two_slow_effects_that_hide_each_other_are_both_named():
    """Beside a walk that nobody declared neither explains enough alone, 4.4 and 2.4 nat of 6.6: it
    was `clean`."""
    case = make("pair/12/gyro", 503, (5.0, 9.0))
    found = closed(case)
    assert named(found) == {(t.kind, t.effect) for t in case.truths}, found.report()


@pytest.mark.long
def test_of_elements_that_are_nearly_one_those_that_a_sensor_may_have_are_taken():
    """Force y of a level table is a little of force z: its coefficient, of 1.6 %/g, was beyond
    belief, and the effect refused with it."""
    found = closed(make("pair/12/gyro", 506, (5.0, 9.0)))
    (p,) = (a for a in found.added if a.effect == "scale_factor_g_sensitivity")
    value, std, _ = p.parameters["P"]
    assert abs(value[1, 0] + 9.09e-5) < 4.0 * std[1, 0]
    assert not value[1, 1], found.report()
