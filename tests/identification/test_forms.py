"""Effects that have several forms, of which the data choose one, and the terms of an accelerometer
that follow turns, other axes and the sign of its input.
"""

import numpy as np
import pytest
from scipy.stats import binom
from world import _filtered, changes, drive, lambda_of, last, recording

import pyimu
from pyimu.identification.search.threshold import _least_output, _least_squares

SPREAD = np.array([1.0, -0.7, 0.5])


@pytest.fixture(scope="module")
def world():
    return drive(minutes=3, seed=3)


def single_pole(world, tau):
    """1 / (1 + j omega tau), through the spectrum."""
    return lambda v: _filtered(v, world.h, lambda w: 1 / (1 + 1j * w * tau))


def hard(d):
    return last(lambda v: np.where(np.abs(v) > d, v, 0.0))


def soft(d):
    return last(lambda v: np.sign(v) * np.maximum(np.abs(v) - d, 0.0))


def closed_with(world, change, kind="gyro", seed=5):
    log = recording(world, **{f"{kind}_change": change}, seed=seed, kinds=(kind,))
    return pyimu.close(log)


@pytest.mark.long
@pytest.mark.parametrize("tau", [0.001, 0.003, 0.01])
def test_a_first_order_lag_is_named_with_its_time_constant_and_nothing_beside_it(world, tau):
    """Its time constant is off by what the sampled form misses, (2 pi 2.5 Hz h)^3 / 4 of it, and by
    chance.
    """
    closed = closed_with(world, single_pole(world, tau))
    (added,) = closed.added
    assert added.effect == "first_order_lag", closed.report()
    value, std, unit = added.parameters["tau"]
    assert unit == "s"
    assert abs(value - tau) < 5 * std + (2 * np.pi * 2.5 * world.h) ** 3 / 4 * tau


def test_a_second_order_lag_is_told_from_a_first_order_one(world):
    """Well below the damping at which it is a delay."""
    closed = closed_with(world, changes(world, "gyro")["lag"](0.01))
    assert [a.effect for a in closed.added] == ["lag"], closed.report()


def test_where_the_forms_look_alike_the_others_are_alternatives(world):
    """At a hundredth of a sample period no form differs from another by more than rounding."""
    closed = closed_with(world, single_pole(world, 4e-5))
    (added,) = closed.added
    assert {added.effect, *added.alternatives} == {"first_order_lag", "lag", "time_delay"}


@pytest.mark.parametrize(
    "d",
    [pytest.param(0.003, marks=pytest.mark.long), 0.01, pytest.param(0.05, marks=pytest.mark.long)],
)
def test_a_hard_dead_zone_is_named_with_its_width(world, d):
    """The least of the outputs that are not zero lies above it by an exponential distance."""
    closed = closed_with(world, hard(d))
    (added,) = closed.added
    assert added.effect == "hard_dead_zone" and "dead_zone" not in added.alternatives
    value, std, _ = added.parameters["d"]
    # An exponential distance, less its mean: 12 of them are exceeded once in 100,000 times.
    assert np.all(np.abs(value - d) < 12 * std), (value, std)
    assert closed.errors["gyro"].after.total < closed.errors["gyro"].before.total


def test_a_soft_dead_zone_is_named_with_its_width(world):
    d = 0.0012
    closed = closed_with(world, soft(d))
    (added,) = closed.added
    assert added.effect == "dead_zone" and "hard_dead_zone" not in added.alternatives
    value, std, _ = added.parameters["d"]
    assert np.all(np.abs(value - d) < 5 * std)


def test_the_least_output_tells_the_threshold_within_its_standard_error():
    """Outputs evenly above 0.01: their least is off by an exponential distance, whose mean is taken
    off. It is within 1.96 of it with probability 1 - exp(-2.96).
    """
    count, inside = 300, 0
    for seed in range(count):
        y = np.random.default_rng(seed).uniform(0.01, 1.0, 2000)
        value, std = _least_output(np.append(y, np.zeros(500)))
        inside += abs(value - 0.01) < 1.96 * std
    # The mean distance is itself that of ten: a gamma variable, which takes some 5 % off.
    p = 1 - (1 + 2.96 / 10) ** -10
    assert binom.ppf(1e-4, count, p) <= inside <= binom.ppf(1 - 1e-4, count, p)


def test_least_squares_find_the_threshold_that_all_sums_of_squares_find():
    """Against the sum of squares of every threshold, worked out one by one."""
    rng = np.random.default_rng(2)
    x = rng.uniform(-1.0, 1.0, 400)
    y = np.where(np.abs(x) > 0.3, x, 0.0) + 0.05 * rng.standard_normal(400)
    value, std = _least_squares(x, y)
    edges = np.sort(np.abs(x))
    middles = (edges[1:] + edges[:-1]) / 2
    sums = [np.sum((y - np.where(np.abs(x) > d, x, 0.0)) ** 2) for d in middles]
    assert value == pytest.approx(middles[int(np.argmin(sums))], rel=1e-12)
    assert abs(value - 0.3) < 4 * std


def accelerometer_terms(world):
    """Name -> (effect, size -> change), in plain numpy."""
    rate, turned = world.rate, np.gradient(world.rate, world.h, axis=0)
    return {
        "K0'": ("bias_asymmetry", lambda s: lambda v: v + s / 2 * SPREAD * np.sign(v)),
        "K_pp": (
            "cross_axis_nonlinearity",
            lambda s: lambda v: v + s * SPREAD * np.roll(v, 1, axis=1) ** 2,
        ),
        "K_po": (
            "cross_axis_nonlinearity",
            lambda s: lambda v: v + s * SPREAD * np.roll(v, 1, axis=1) * np.roll(v, 2, axis=1),
        ),
        "spin": ("spin_sensitivity", lambda s: lambda v: v + s * SPREAD * rate**2),
        "anisoinertia": (
            "spin_sensitivity",
            lambda s: lambda v: v + s * SPREAD * rate * np.roll(rate, 1, axis=1),
        ),
        "angular acceleration": (
            "angular_acceleration",
            lambda s: lambda v: v + s * SPREAD * np.roll(turned, 1, axis=1),
        ),
    }


def size_of(world, make, wanted):
    """The size at which a change that grows with it in proportion is so many times detectable."""
    return wanted / lambda_of(world, "accel", make(1.0), structure=True)


@pytest.mark.long
@pytest.mark.parametrize(
    "name", ["K0'", "K_pp", "K_po", "spin", "anisoinertia", "angular acceleration"]
)
def test_a_term_of_ieee_std_1293_is_named_at_forty_sigmas(world, name):
    effect, make = accelerometer_terms(world)[name]
    closed = closed_with(world, make(size_of(world, make, 40.0)), "accel")
    (added,) = closed.added
    assert added.effect == effect, closed.report()


@pytest.mark.long
def test_drift_by_a_product_of_forces_is_said_with_the_product(world):
    f = world.force
    drift = np.column_stack([1.5e-5 * f[:, 1] * f[:, 2], 0 * f[:, 0], 0 * f[:, 0]])
    log = recording(world, gyro_change=lambda v: v + drift, seed=5)
    closed = pyimu.close(log)
    (added,) = closed.added
    assert added.effect == "g2_sensitivity"
    assert "(x from yz)" in closed.report()
