"""The logs of ``benchmarks/traps.py``: their kinematics, and one case of each through the
benchmark.
"""

from pathlib import Path

import numpy as np
import pytest
import traps
from generators import rotation
from generators.motion import GRAVITY, MOTIONS
from generators.tracked import TRACKED
from trap_logs.catalogue import TRAPS

STEP = 1e-4

README = Path(traps.__file__).parents[1] / "README.md"


def test_the_readme_counts_the_traps():
    assert f"{len(TRAPS)} kinds in all" in README.read_text(encoding="utf-8")


def spun(motion, time):
    """Central difference of the attitude over 2 ``STEP``."""
    before, after = motion.attitude(time - STEP), motion.attitude(time + STEP)
    turned = rotation.product(rotation.inverse(before), after)
    return rotation.to_vector(turned) / (2 * STEP)


@pytest.mark.parametrize("make", MOTIONS, ids=lambda m: m.__name__)
def test_the_rate_is_the_derivative_of_the_attitude(make):
    """A central difference misses by STEP^2/6 of the rate's second derivative, at most (2 pi 10
    Hz)^2 times 6 rad/s: 4e-5 rad/s.
    """
    motion = make(np.random.default_rng(5), 60.0)
    time = np.linspace(0.0, 60.0, 1501)
    np.testing.assert_allclose(spun(motion, time), motion.rate(time), atol=4e-5)


@pytest.mark.parametrize("make", MOTIONS, ids=lambda m: m.__name__)
def test_the_force_is_gravity_and_the_acceleration(make):
    """A rotation keeps the size of what it turns, to rounding."""
    motion = make(np.random.default_rng(6), 60.0)
    time = np.linspace(0.0, 60.0, 601)
    world = motion.acceleration(time) + [0.0, 0.0, GRAVITY]
    sizes = [np.linalg.norm(v, axis=1) for v in (motion.force(time), world)]
    np.testing.assert_allclose(*sizes, rtol=1e-12)


@pytest.mark.parametrize("make", TRACKED, ids=lambda m: m.__name__)
def test_a_tracked_motion_turns_and_moves_as_it_says(make):
    """Central differences: of places they miss by STEP^2/12 of the fourth derivative, and 10 m of
    rounding over STEP^2 is 2e-7.
    """
    motion = make(np.random.default_rng(5), 60.0)
    time = np.linspace(0.0, 60.0, 1501)
    np.testing.assert_allclose(spun(motion, time), motion.rate(time), atol=1e-3)
    before, here, after = (motion.position(time + k * STEP) for k in (-1, 0, 1))
    pushed = (before - 2.0 * here + after) / STEP**2
    bent = np.abs(motion.place(np.linspace(0.0, 60.0, 60001), 4)).max()
    least = 1.1 * STEP**2 / 12 * bent + 1e-6
    np.testing.assert_allclose(pushed, motion.acceleration(time), atol=least)


@pytest.mark.parametrize("name", TRAPS)
def test_a_trap_depends_on_its_generator_alone(name):
    one, other = (TRAPS[name](np.random.default_rng(7)) for _ in range(2))
    for a, b in zip(one.logs, other.logs, strict=True):
        assert a.keys() == b.keys()
        assert all(np.array_equal(a[k], b[k], equal_nan=True) for k in a)
        assert all(len(v) == len(a["time"]) for v in a.values())


@pytest.mark.parametrize(
    "name",
    [
        pytest.param("gyro_early_12_5_ms", marks=pytest.mark.long),
        pytest.param("slerp_60_to_200_hz", marks=pytest.mark.long),
        "thermometer_rounded",
        pytest.param("jitter_5_percent", marks=pytest.mark.long),
    ],
)
def test_a_blameless_sensor_is_not_blamed(name):
    """One case of each room: by chance one in a hundred may be blamed, which the fixed seed keeps
    out.
    """
    log = traps.case(name, seed=0, number=0)
    assert not traps.blamed(log, "undeclared", traps.closed(log, "undeclared"))


def test_an_early_gyro_is_the_clocks():
    log = traps.case("gyro_early_12_5_ms", seed=0, number=0)
    assert traps.names_clock(log, traps.closed(log, "declared"))


@pytest.mark.parametrize(
    "name",
    [
        pytest.param("jitter_20_percent", marks=pytest.mark.long),
        pytest.param("slerp_60_to_200_hz", marks=pytest.mark.long),
        pytest.param("held_at_20_hz", marks=pytest.mark.long),
        pytest.param("outliers", marks=pytest.mark.long),
        "dropped_rows",
        pytest.param("occlusions_and_jumps", marks=pytest.mark.long),
    ],
)
def test_what_is_wrong_with_samples_or_reference_is_named_and_the_sensor_is_examined(name):
    """One case each: the cause is found, the sensor is not blamed, and what is left of the log is
    explained to the noise of sensor and reference.
    """
    log = traps.case(name, seed=0, number=0)
    found = traps.closed(log, "declared")
    assert traps.NAMED[log.cause](log, found)
    assert not traps.blamed(log, "declared", found)
    gyro = found.errors["gyro"]
    assert gyro.after.total < 1.3 * gyro.noise


def test_a_reference_as_noisy_as_the_motion_stops_nothing():
    """What its noise leaves of some columns is next to nothing: a step by the equations without
    that noise went to 3e132.
    """
    log = traps.case("rate_with_correlated_noise", seed=7, number=2)
    found = traps.closed(log, "declared")
    assert not traps.blamed(log, "declared", found)
    assert np.isfinite(found.errors["gyro"].after.total)


@pytest.mark.parametrize(
    "name, number",
    [
        ("drift_0_1_deg_per_min", 0),
        pytest.param("drift_0_1_deg_per_min", 2, marks=pytest.mark.long),
        pytest.param("occlusions", 1, marks=pytest.mark.long),
    ],
)
def test_the_noise_of_a_derived_reference_is_no_dependence(name, number):
    """Of a term that the model explains but for the reference's noise next to nothing is left: its
    score, taken for a slope, was worth up to 450 nat.
    """
    log = traps.case(name, seed=7, number=number)
    found = traps.closed(log, "declared")
    assert not found.unexplained and not found.added, found.report()
