"""What samples show of the motion, gathered between two looks at it."""

from dataclasses import replace

import casadi as ca
import numpy as np
import pytest

from pyimu.attitude.filter.gathered import LOOK, Gathered
from pyimu.attitude.filter.slow_motion import Bounds
from pyimu.attitude.filter.unscented import AXES, WHOLE, Estimate
from pyimu.attitude.filter.velocity import OUTLIER, RISE, Motion, followed, with_sample
from pyimu.attitude.filter.velocity import SIZES as MOTION_SIZES

TIME = 1.0
"""s; correlation time of the velocity."""


def numbers(column) -> np.ndarray:
    return ca.DM(ca.Function("f", [], [column])()["o0"]).full().ravel()


def gathered(rows: np.ndarray, h: float, used, goes_on=None) -> Gathered:
    """After samples (n, 7) of level velocity, squares, the filter's own variance and force."""
    found = Gathered.start()
    for row, counts, on in zip(rows, used, np.ones(len(rows)) if goes_on is None else goes_on):
        level, squares, own, force = ca.vertsplit(ca.SX(row), [0, 2, 4, 5, 7])
        found = found.with_sample(level, squares, own, force, counts, counts, on, on, h)
    return found


@pytest.mark.parametrize(
    ("h", "expected"), [(1 / 976, 10), (1 / 286, 3), (1 / 100, 1), (1 / 20, 1), (1 / 10_000, 100)]
)
def test_a_look_is_due_after_that_number_of_samples_which_is_nearest_to_its_time(h, expected):
    found, samples = Gathered.start(), 0
    assert numbers(found.is_due(TIME, h)) == 0
    while not numbers(found.is_due(TIME, h)):
        found, samples = gathered(np.ones((samples + 1, 7)), h, np.ones(samples + 1)), samples + 1
    assert samples == expected
    assert abs(samples * h - LOOK * TIME) <= h / 2 or samples == 1


def test_means_are_those_of_the_samples_that_count():
    rows, used = np.random.default_rng(1).standard_normal((8, 7)), [1, 0, 1, 1, 0, 1, 1, 1]
    means = numbers(ca.vertcat(*gathered(rows, 0.001, used).means()))
    # A span of 6 ms with ``TINY`` is off by 2e-10 of itself.
    np.testing.assert_allclose(means, rows[np.array(used) > 0].mean(axis=0), rtol=1e-9)
    nothing = numbers(ca.vertcat(*gathered(rows, 0.001, np.zeros(8)).means()))
    np.testing.assert_array_equal(nothing, 0)


def test_nothing_is_left_of_samples_before_the_motion_ended():
    rows = np.random.default_rng(2).standard_normal((5, 7))
    one = gathered(rows, 0.001, [1, 1, 0, 1, 1], [1, 1, 0, 1, 1])
    other = gathered(rows[3:], 0.001, [1, 1])
    for a, b in zip(one.pack(), other.pack(), strict=True):
        np.testing.assert_array_equal(numbers(a), numbers(b))


def resting_at(velocity) -> Estimate:
    """A level body of which all is known but how it moves, with a ``velocity`` (3,) m/s."""
    known = ca.SX.eye(WHOLE) * 1e-12
    return Estimate(ca.SX([1, 0, 0, 0]), ca.SX(3, 1), ca.SX(velocity), known, ca.SX(WHOLE, AXES))


def test_variance_rises_to_what_the_squares_have_in_seven_correlation_times():
    """Exactly by the factor 1 - s / (7 T + s) with each look of s seconds."""
    h, seconds, speed = 1 / 976, 3.0, 0.3
    x, bounds = resting_at([speed, speed, 0]), Bounds(ca.SX(0), ca.SX(0), ca.SX(TIME))
    column = ca.SX.sym("motion", sum(MOTION_SIZES))
    now = Motion.unpack(column)
    sampled = with_sample(now, x, ca.SX(3, 1), 1, 0, 1, 1, 1, h)[0]
    due = sampled.gathered.is_due(TIME, h)
    looked = followed(sampled, x, 1, bounds, 0, h)
    after = ca.if_else(due, looked.pack(), sampled.pack())
    steps = ca.Function("f", [column], [after]).mapaccum(round(seconds / h))
    motion = steps(Motion.start(ca.SX(0.1), ca.SX(TIME)).pack())
    span, looks = 10 * h, round(seconds / h) // 10
    left = (1 - span / (RISE * TIME + span)) ** looks
    want = speed**2 - (speed**2 - 0.01) * left
    # What is taken off for the filter's own variance is 1e-12 of 0.09.
    assert float(ca.DM(ca.evalf(motion[0, -1]))) == pytest.approx(want, rel=1e-9)


def test_a_velocity_beyond_all_that_was_found_shows_with_its_sample():
    motion, speed = Motion.start(ca.SX(0.1), ca.SX(TIME)), 3.0
    args = motion, resting_at([speed, speed, 0]), ca.SX(3, 1), 1, 0, 1, 1, 1, 1e-3
    after, bounded = with_sample(*args)
    assert numbers(bounded.variance)[0] == pytest.approx(speed**2 / OUTLIER, rel=1e-9)
    assert numbers(after.across) == pytest.approx(0.01)


def test_nothing_slow_is_left_of_a_motion_that_has_ended():
    """Neither a drift of the velocity, nor that a tilt by the gyro's scale factors shows in it."""
    start = Motion.start(ca.SX(0.1), ca.SX(TIME))
    motion = replace(start, slow=ca.SX([1, 2]), by_scale=ca.SX(1))
    for goes_on in (1, 0):
        args = motion, resting_at([0, 0, 0]), ca.SX(3, 1), goes_on, 0, goes_on, 1, 1, 1e-3
        after, _ = with_sample(*args)
        left = numbers(ca.vertcat(after.slow, after.by_scale, after.gathered.span > 0))
        np.testing.assert_array_equal(left, np.array([1, 2, 1, 1]) * goes_on)
