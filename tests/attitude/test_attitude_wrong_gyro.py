"""A gyro in another unit, or in axes that are not the accelerometer's, is said with its reading;
one that is right is left alone, whatever moves the body.
"""

from dataclasses import replace

import numpy as np
import pytest
from attitude_cases import attitude_after
from scipy.spatial.transform import Rotation
from test_attitude_headed import H, robot, turning
from test_attitude_speed import vehicle
from walks import walk

from pyimu import Recording, attitude
from pyimu.recording.quality.gyro_axes import gyro_findings

N = 9000
TIME = H * np.arange(N)


def hand(seed: int, push: float = 1.0) -> Recording:
    """A hand that turns a sensor by half a radian to and fro and pushes it by ``push`` m/s^2."""
    rng = np.random.default_rng(seed)
    omega, phase = 2 * np.pi * rng.uniform(0.1, 1.0, (2, 3, 3)), rng.uniform(0, 6, (2, 3, 3))
    waves = np.sin(omega[:, None] * TIME[:, None, None] + phase[:, None]).sum(axis=2)
    waves[:, TIME < 5] = 0
    world = attitude_after(rate := 0.8 * waves[0])
    force = world.apply(push * waves[1] + [0, 0, 9.81], inverse=True)
    return Recording.from_arrays(
        time=TIME,
        gyro=rate + [0.01, -0.02, 0.015] + rng.normal(0, 1e-3, (N, 3)),
        accel=force + rng.normal(0, 0.02, (N, 3)),
    )


WRONG = {
    "degrees a second": (np.eye(3) * 180 / np.pi, "gyro_unit", 180 / np.pi, "57.3 times too large"),
    "radians twice": (np.eye(3) * np.pi / 180, "gyro_unit", np.pi / 180, "57.3 times too small"),
    "y mirrored": (np.diag([1.0, -1, 1]), "gyro_axes", "y is -y", "(y is -y)"),
    "x and y swapped": (np.eye(3)[[1, 0, 2]], "gyro_axes", "x is y, y is x", "(x is y, y is x)"),
    "cyclic": (np.eye(3)[[1, 2, 0]], "gyro_axes", "x is z, y is x, z is y", "(x is z"),
}


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("case", WRONG)
def test_the_reading_is_named_by_the_turning_of_gravity(case, seed):
    matrix, kind, reading, _ = WRONG[case]
    right = hand(seed)
    (found,) = gyro_findings(replace(right, gyro=right.gyro @ matrix.T))
    assert found.kind == kind and reading in found.detail.values()


@pytest.mark.parametrize("case", WRONG)
def test_it_is_said_first(case):
    matrix, _, _, said = WRONG[case]
    right = hand(1)
    result = attitude.run(replace(right, gyro=right.gyro @ matrix.T))
    assert said in result.report().splitlines()[1]


def test_headings_are_not_judged_by_a_gyro_that_is_wrong():
    """Those in radians turn as a gyro does that is 57 times too small if they were degrees."""
    right = hand(2)
    yaw = np.cumsum(right.gyro[:, 2]) * H
    slow = replace(right, gyro=right.gyro * np.pi / 180, heading=yaw)
    assert [f.kind for f in attitude.run(slow).findings if "gyro" in f.kind] == ["gyro_unit"]
    assert not [f for f in attitude.run(slow).findings if f.kind == "heading_reading"]


@pytest.mark.parametrize("push", [0.0, 1.0, 3.0, 8.0])
@pytest.mark.parametrize("seed", range(3))
def test_a_hand_with_a_right_gyro_is_left_alone(seed, push):
    assert gyro_findings(hand(seed, push)) == ()


def foot(seed: int, **how: float) -> Recording:
    """A sensor on a foot, with what an uncalibrated one adds."""
    rng, own = np.random.default_rng(seed), walk(seed, **how)
    n = len(own.time)
    return Recording.from_arrays(
        time=own.time,
        gyro=own.rate + rng.normal(0, 0.01, 3) + rng.normal(0, 2e-3, (n, 3)),
        accel=own.force * (1 + rng.normal(0, 0.01, 3)) + rng.normal(0, 0.02, (n, 3)),
    )


@pytest.mark.parametrize("pitch", [0.3, 0.9, 1.3])
@pytest.mark.parametrize("seed", range(2))
def test_a_foot_with_a_right_gyro_is_left_alone(seed, pitch):
    """It swings forwards when its toes go down: by a mirrored pitch its forces scatter less, about
    a mean beyond gravity.
    """
    assert gyro_findings(foot(seed, pitch=pitch)) == ()


@pytest.mark.parametrize("seed, share", [(1, 0.5), (2, 0.35), (8, 0.5)])
def test_rates_at_the_gyros_limit_tell_nothing(seed, share):
    """A foot that turns further than its gyro shows turns as if by other axes, or units."""
    right = foot(seed, pitch=1.0)
    limit = share * np.abs(right.gyro).max()
    assert gyro_findings(replace(right, gyro=np.clip(right.gyro, -limit, limit))) == ()


def test_of_a_foot_a_mirrored_pitch_is_named():
    right = foot(3)
    (found,) = gyro_findings(replace(right, gyro=right.gyro * [1, -1, 1]))
    assert found.kind == "gyro_axes" and "y is -y" in found.detail["axes"]


@pytest.mark.parametrize("size", [0.1, 9.80665])
def test_a_force_of_another_size_than_gravity_tells_nothing(size):
    right = hand(1)
    assert gyro_findings(replace(right, accel=right.accel * size, gyro=-right.gyro)) == ()


@pytest.mark.parametrize("matrix", [np.eye(3), np.diag([1.0, 1, -1]), np.eye(3)[[0, 2, 1]]])
def test_a_vehicle_that_pushes_for_long_shows_nothing(matrix):
    """Its forces turn with it, so that they say of no gyro that it is another one."""
    world, _ = vehicle()
    time = H * np.arange(len(world.rate))
    right = Recording.from_arrays(time=time, gyro=world.rate, accel=world.force)
    assert gyro_findings(replace(right, gyro=right.gyro @ matrix.T)) == ()


def test_a_short_log_and_one_without_accelerometer_show_nothing():
    right = hand(1)
    assert gyro_findings(right.slice(0, 700)) == ()
    assert gyro_findings(replace(right, accel=None)) == ()


@pytest.mark.parametrize("factor", [1.0, 180 / np.pi, np.pi / 180])
@pytest.mark.parametrize("turned", [(0, 0, 0), (np.pi, 0, 0), (0.3, 1.0, -2.0)])
def test_of_a_level_robot_its_reference_tells_the_unit(factor, turned):
    """The size of a turn is the same in all axes, and in any order of the quaternion."""
    recording, yaw = turning(robot())
    q = (Rotation.from_euler("z", yaw[:, None]) * Rotation.from_rotvec(turned)).as_quat(
        scalar_first=True
    )
    for ref_q in (q, np.roll(q, -1, axis=1), q * [1, -1, -1, -1]):
        log = replace(recording, gyro=recording.gyro * factor, ref_q=ref_q)
        found = [f.detail["factor"] for f in gyro_findings(log)]
        assert found == ([] if factor == 1 else [factor])
