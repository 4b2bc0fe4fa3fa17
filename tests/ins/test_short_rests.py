"""The stances of a foot are rests, though each is shorter than what else counts as one; of what
does not swing, or stops but now and then, no moment is. Of a foot that rolls over its sole
``--zupt foot`` takes them.
"""

from contextlib import nullcontext
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from walks import G, Walk, walk

from pyimu import Recording, ins
from pyimu.errors import UserError
from pyimu.ins.checks import without_outliers
from pyimu.ins.detector import detect
from pyimu.ins.measured import CONTRADICTED, Fixes, check_fixes
from pyimu.ins.noise import Noise
from pyimu.ins.short_rests import LEAST, between_swings
from pyimu.ins.stances import stances, steps
from pyimu.recording.clock import runs

H = 0.005
NOISE = Noise(np.full(3, 2e-3), np.full(3, 0.02), np.zeros(3), np.array([0.01, -0.02, 0.015]))


def measured(own: Walk, seed: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    shape = own.rate.shape
    gyro = own.rate + NOISE.bias + NOISE.rate * rng.standard_normal(shape)
    return gyro, own.force + NOISE.force * rng.standard_normal(shape)


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("stance", [0.36, 0.5])
def test_stances_are_found_and_no_row_of_a_swing(stance, seed):
    own = walk(seed, stance=stance)
    still = detect(own.time, *measured(own, seed), NOISE, H).still
    stances = [rows for rows in runs(own.stands) if 8 < own.time[rows[0]] < 54]
    assert len(stances) > 30
    assert all(still[slice(*rows)].any() for rows in stances)
    assert not np.any(still & ~own.stands)


def test_the_path_of_a_foot_holds_by_default():
    """60 s of it, some 54 m: without stances it ends tens of metres off."""
    own = walk(2)
    gyro, accel = measured(own, 2)
    log = Recording.from_arrays(time=own.time, gyro=gyro, accel=accel)
    found = ins.run(log, method="filter", heading0=walk_heading(own))
    off = found.tracks["filter"].position[-1] - own.place[-1]
    way = np.linalg.norm(np.diff(own.place[::20], axis=0), axis=1).sum()
    assert way > 40 and np.linalg.norm(off) < 0.05 * way


def test_landings_are_no_outliers_and_what_is_far_beyond_them_is():
    """At 100 Hz a landing of some 9 g is one sample or two. A sample left out of each is a step of
    the velocity."""
    own = walk(0, hz=100.0, strike=1.0)
    log = Recording.from_arrays(time=own.time, gyro=own.rate, accel=own.force)
    kept, said = without_outliers(log, acceleration=5.0, turn_rate=2.0)
    assert not said
    np.testing.assert_array_equal(kept.accel, own.force)
    force = own.force.copy()
    force[400] = 1e4
    kept, (one,) = without_outliers(replace(log, accel=force), acceleration=5.0, turn_rate=2.0)
    assert one.count == 1 and np.isnan(kept.accel[400]).all()


ROLL = 0.3
"""rad/s; of a stance."""


@pytest.mark.parametrize("seed", range(2))
def test_a_foot_that_rolls_over_its_sole_has_stances(seed):
    own = walk(seed, roll=ROLL)
    gyro, accel = measured(own, seed)
    assert not detect(own.time, gyro, accel, NOISE, H).still[2000:-1200].any()
    marks = stances(gyro - NOISE.bias, accel, 9.80665, H)
    rows = [rows for rows in runs(own.stands) if 8 < own.time[rows[0]] < 54]
    assert all(marks[slice(*r)].mean() > 0.5 for r in rows)
    speed = np.linalg.norm(np.gradient(own.place, H, axis=0), axis=1)
    assert speed[marks].max() < 0.1 < speed.max()


def test_a_stance_with_missing_samples_is_none():
    own = walk(0)
    gyro, accel = measured(own, 0)
    gyro[500, 1] = accel[800, 2] = np.nan
    marks = stances(gyro - NOISE.bias, accel, 9.80665, H)
    assert not marks[491:510].any() and not marks[791:810].any()
    assert marks[100:480].all() and marks[520:780].all()


def test_the_path_of_a_foot_that_rolls_holds_where_it_is_said_to_be_one():
    own = walk(2, roll=ROLL)
    gyro, accel = measured(own, 2)
    log = Recording.from_arrays(time=own.time, gyro=gyro, accel=accel)
    plain, found = (
        ins.run(log, method="filter", zupt=zupt, heading0=walk_heading(own))
        for zupt in ("live", "foot")
    )
    assert "on a foot, --zupt foot takes" in plain.report().splitlines()[1]
    assert "--zupt foot" not in found.report()
    off = [np.linalg.norm(r.tracks["filter"].position[-1] - own.place[-1]) for r in (found, plain)]
    assert off[0] < 0.02 * 55 < off[1]
    assert "moments of stance correct the filter" in found.report()


def test_a_log_with_velocities_of_its_own_is_told_so():
    own = walk(2, seconds=20.0)
    log = Recording.from_arrays(time=own.time, gyro=own.rate, accel=own.force)
    zero = np.zeros(len(own.time))
    measured_too = replace(log, velocity_east=zero, velocity_north=zero, velocity_std=zero + 1)
    with pytest.raises(UserError, match="the log has measured ones"):
        ins.run(measured_too, method="filter", zupt="foot")
    assert ins.run(measured_too, method="filter", zupt="foot", fixes=False).fixes is not None


def test_stances_of_which_most_contradict_the_filter_are_refused():
    """As those of a car, that drives on and looks like one."""
    log = Recording.from_arrays(time=H * np.arange(100), gyro=np.zeros((100, 3)))
    none = np.zeros(0, dtype=int), np.zeros((0, 3)), 0.0
    fixes = Fixes({"velocity_valid": np.ones(100)}, *none)
    for wrong, refused in ((80, True), (20, False)):
        status = CONTRADICTED["velocity"] * (np.arange(100) < wrong)
        found = SimpleNamespace(scalar=lambda _, status=status: status)
        with pytest.raises(UserError, match="on a foot") if refused else nullcontext():
            (said,) = check_fixes(log, fixes, found, moves=False, foot=True)
            assert said.count == wrong


def walk_heading(own: Walk) -> float:
    """rad; of the first step, which the foot's yaw at the start is."""
    first = own.place[np.argmax(np.linalg.norm(own.place[:, :2], axis=1) > 0.5)]
    return float(np.arctan2(first[1], first[0]))


def swinging(count: int, size: float, windows: int) -> np.ndarray:
    """The marks of a log of so many moments in which windows pass, between swings of ``size``."""
    passed, rates = np.zeros(200 * (count + 1), dtype=bool), np.zeros((200 * (count + 1), 3))
    rates[:, 1] = size
    for k in range(count):
        rows = slice(200 * k + 150, 200 * k + 150 + windows)
        passed[rows], rates[rows] = True, 0
    return between_swings(passed, rates, 60, H)


def test_they_need_swings_and_company():
    assert np.count_nonzero(swinging(LEAST, 3.0, 20)) == 20 * LEAST
    assert not swinging(LEAST - 1, 3.0, 20).any()
    assert not swinging(2 * LEAST, 1.0, 20).any()
    assert not swinging(2 * LEAST, 3.0, 60).any()


@pytest.mark.parametrize("roll", (0.0, 0.3))
def test_a_foot_is_told_by_its_steps_and_a_hand_is_none(roll):
    """44 swings between stances; what swings on without them, as an arm does, takes no step."""
    own = walk(7330, roll=roll)
    assert 40 < steps(own.rate, own.force, G, 1 / 200) < 50
    t = own.time
    arm = np.stack([0 * t, 4 * np.sin(2 * np.pi * t), 0 * t], axis=1)
    force = np.stack([3 * np.cos(2 * np.pi * t), 0 * t, G + 3 * np.sin(4 * np.pi * t)], axis=1)
    assert steps(arm, force, G, 1 / 200) == 0


def test_what_is_turned_over_from_side_to_side_takes_no_steps():
    """Quarter turns of 0.8 s about one axis after another, and a second's hold, as for a
    calibration: its holds looked like stances, and the turns like swings.
    """
    h, up, force, rates = 1 / 200, np.array([0.0, 0.0, 1.0]), [], []
    u = np.arange(0.0, 0.8, h)
    for k in range(24):
        axis = np.eye(3)[k % 3]
        size = np.pi / 2 / 0.8 * (1 - np.cos(2 * np.pi * u / 0.8))
        angle = np.append(0.0, np.cumsum(size) * h)
        turned = Rotation.from_rotvec(-angle[:, None] * axis).apply(up)
        up = turned[-1]
        force += [G * turned[:-1], np.tile(G * up, (200, 1))]
        rates += [size[:, None] * axis, np.zeros((200, 3))]
    assert steps(np.concatenate(rates), np.concatenate(force), G, h) == 0


def test_a_foot_that_nobody_named_is_navigated_as_one():
    """By its stances, as beside --zupt foot, and said; a vehicle of the same samples is not."""
    own, rng = walk(7331, seconds=30.0, roll=0.3), np.random.default_rng(1)
    log = Recording.from_arrays(
        time=own.time,
        gyro=own.rate + 1.4e-3 * rng.standard_normal(own.rate.shape),
        accel=own.force + 0.03 * rng.standard_normal(own.force.shape),
    )
    found, named = (ins.run(log, zupt=zupt, method="filter") for zupt in ("auto", "foot"))
    np.testing.assert_array_equal(found.filter.y, named.filter.y)
    assert "This looks like a sensor on a foot, by" in found.report()
    assert "looks like a sensor on a foot" not in named.report()
