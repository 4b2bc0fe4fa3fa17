"""The start of a recording: what is known of attitude and bias before the first sample, and how
well.

Errors are held against the standard deviations that the filter says itself; a family of such checks
leaves five of them by chance with a probability below 1e-5.
"""

import numpy as np
import pytest
from attitude_cases import EARTH, Drive, H, drive, error, part, rover_rate
from scipy.spatial.transform import Rotation

from pyimu.attitude import run
from pyimu.attitude.alignment import mean_bias_std
from pyimu.attitude.rest import find_rest
from pyimu.recording.recording import Recording

QUIET, WALK, QUIET_ACCEL = 1e-4, 1e-6, 1e-3
FAR = 5.0


def quiet(walk: float = WALK):
    return part(QUIET, walk, QUIET_ACCEL)


def recorded(world: Drive, seed: int = 0, bias=0.0, n: float = QUIET, **more) -> Recording:
    rng, shape = np.random.default_rng(seed), world.inertial.shape
    gyro = world.inertial + bias + n / np.sqrt(H) * rng.standard_normal(shape)
    force = world.force + QUIET_ACCEL / np.sqrt(H) * rng.standard_normal(shape)
    return Recording.from_arrays(
        time=H * np.arange(len(gyro)), **({"gyro": gyro, "accel": force} | more)
    )


def normalised(result, world: Drive, bias=0.0) -> np.ndarray:
    """Errors of attitude and bias (n, 6) over their standard deviations."""
    return np.hstack([error(result.q, world.attitude), bias - result.gyro_bias]) / result.std


def turning(rate: float, n: int = 4000) -> np.ndarray:
    out = np.zeros((n, 3))
    out[:, 2] = rate
    return out


# Yaw


def headed(world: Drive, rows: np.ndarray, seed: int = 1, std: float = 0.02) -> dict:
    """Headings of the rows, the other rows without."""
    heading, stds = np.full((2, len(world.rate)), np.nan)
    heading[rows] = world.attitude.as_euler("ZYX")[rows, 0] + std * np.random.default_rng(
        seed
    ).standard_normal(len(rows))
    stds[rows] = std
    return {"heading": heading, "heading_std": stds}


def test_a_heading_that_comes_after_turning_is_not_that_of_the_start():
    rate = rover_rate(6000, still=1000)
    rate[1000:3000, 2] = 0.08
    world = drive(rate, Rotation.from_euler("z", 2.5))
    result = run(recorded(world, **headed(world, np.arange(4000, 6000, 100))), quiet())
    assert np.abs(normalised(result, world)).max() < FAR
    assert result.std[3999, 2] > 1, "nothing is known of it until then"
    assert result.std[4000, 2] < 0.03


def test_the_first_heading_at_rest_counts_once():
    world = drive(np.zeros((2000, 3)), Rotation.from_euler("z", 2.5))
    result = run(recorded(world, **headed(world, np.array([500]))), quiet(walk=0))
    assert np.abs(normalised(result, world)).max() < FAR
    # What is counted twice makes a standard deviation at most a hundredth smaller; bias and noise
    # make it larger.
    assert result.std[500, 2] > 0.99 * 0.02


@pytest.mark.parametrize("given", ["heading0", "recorded"])
def test_a_body_that_points_up_has_no_heading_to_start_with(given):
    world = drive(np.zeros((2000, 3)), Rotation.from_euler("ZYX", [0.5, -np.pi / 2 + 0.02, 0.0]))
    recording = recorded(
        world, **({} if given == "heading0" else headed(world, np.arange(0, 2000, 100)))
    )
    result = run(recording, quiet(), **({"heading0": 0.5} if given == "heading0" else {}))
    assert result.parameters["std0[1]"] > 1, "about the forward axis, which is vertical"
    assert np.abs(normalised(result, world)[:, :3]).max() < FAR


# Level


NO_FORCE = {
    "no column": lambda force: None,
    "late": lambda force: np.where(np.arange(len(force))[:, None] < 3500, np.nan, force),
    "zeros": lambda force: 0 * force,
    "of an unknown unit": lambda force: force / 3,
}


@pytest.mark.parametrize("case", NO_FORCE)
def test_without_gravity_nothing_is_levelled(case):
    world = drive(rover_rate(5000, still=1000), Rotation.from_euler("ZYX", [0.0, 0.3, 0.4]))
    recording = recorded(world)
    force = NO_FORCE[case](recording.accel)
    without = Recording.from_arrays(
        time=recording.time, gyro=recording.gyro, **({} if force is None else {"accel": force})
    )
    for given in (quiet(), None):
        result = run(without, given)
        assert find_rest(without).force is None
        assert np.abs(normalised(result, world)[:, :3]).max() < FAR
        assert result.std[100, :2].min() > 0.6
        assert (result.std[-1, :3].min() < 0.2) == (case == "late"), (
            "levelled once there is gravity"
        )


def test_levelled_in_motion_the_tilt_is_as_unsure_as_its_means_scatter():
    """Means over a third of ten seconds have next to nothing of a sine of half a second, whatever
    its size, and all of a push that comes and goes. A row without a finite force has no say.
    """
    world, rows = drive(turning(1.0, 1000)), np.arange(1000)
    found = {}
    for size, time in ((0.0, 1.0), (1.5, 0.6), (9.0, 0.6), (1.5, 10.0)):
        force = recorded(world).accel.copy()
        force[:, 0] += size * np.sin(2 * np.pi * H * rows / time)
        force[7] = np.inf
        result = run(recorded(world, accel=force), quiet())
        found[size, time] = np.array([result.parameters[f"std0[{i}]"] for i in (1, 2)])
        assert np.abs(normalised(result, world)[0, :2]).max() < FAR
    even = found[0.0, 1.0]
    np.testing.assert_allclose(found[1.5, 0.6], even, rtol=0.1)
    np.testing.assert_allclose(found[9.0, 0.6], even, rtol=0.3)
    assert (found[1.5, 10.0] > 1.2 * even).all() and even.max() < 0.1


# Bias


def test_a_turn_that_is_faster_than_a_bias_is_none():
    rate = 0.15
    rates = np.vstack([turning(rate), turning(0, 2000)])
    world = drive(rates)
    for given in (quiet(), None):
        assert np.abs(normalised(run(recorded(world), given), world)).max() < FAR


def test_a_gyro_off_by_five_degrees_per_second_is_within_it_too():
    bias = np.radians([3.0, -2.0, 5.0])
    world = drive(np.zeros((4000, 3)), Rotation.from_euler("ZYX", [0.0, 0.3, 0.4]))
    result = run(recorded(world, bias=bias), quiet())
    assert np.abs(normalised(result, world, bias)).max() < FAR
    np.testing.assert_allclose(result.gyro_bias[0], bias, atol=FAR * QUIET / np.sqrt(30) + 1e-4)


def test_a_declared_rest_gives_the_vertical_bias_too():
    bias = np.array([0.01, -0.02, 0.015])
    world = drive(rover_rate(4000, still=3000))
    result = run(
        recorded(world, bias=bias, stationary=(np.arange(4000) < 3000).astype(float)), quiet(walk=0)
    )
    # Declared, the rest's mean is as good as its white noise allows, and no better for being used
    # twice.
    np.testing.assert_allclose(result.std[2999, 3:], QUIET / np.sqrt(30), rtol=0.05)
    assert np.abs(normalised(result, world, bias)).max() < FAR


def test_mean_of_a_rest_has_the_part_s_walk_and_correlated_noise_in_it():
    """N^2/T + K^2 T/3; a Gauss-Markov process that is fast against T adds 2 s^2 tau/T, with s^2 =
    q^2 tau/2, and the filter takes it for wider.
    """
    recording = recorded(drive(np.zeros((2900, 3))))
    rest = find_rest(recording)
    rows = recording.gyro[rest.rows]
    np.testing.assert_allclose(
        mean_bias_std(part(0.0, 0.0), rest),
        np.hypot(rows.std(axis=0) / np.sqrt(len(rows)), 1e-6),
        rtol=1e-6,
    )
    walking = mean_bias_std(part(QUIET, 1e-3), rest)
    np.testing.assert_allclose(
        walking, np.sqrt(QUIET**2 / rest.duration + 1e-6 * rest.duration / 3), rtol=0.05
    )
    correlated = mean_bias_std(part(0.0, 0.0, gauss_markov={"q": 0.1, "tau": 0.01}), rest)
    assert np.all(correlated > 0.1 * 0.01 / np.sqrt(rest.duration))


@pytest.mark.parametrize("yaw", [0.0, 2.0, np.pi])
def test_without_a_heading_the_earth_s_horizontal_rate_is_not_taken_as_known(yaw):
    latitude = 0.8
    world = drive(np.zeros((3000, 3)), Rotation.from_euler("z", yaw), latitude)
    result = run(recorded(world, n=1e-6), part(1e-6, 1e-7, QUIET_ACCEL), latitude=latitude)
    assert np.abs(normalised(result, world)[0, 3:]).max() < FAR
    assert result.std[0, 3:5].min() > 0.9 * EARTH * np.cos(latitude)
    known = run(
        recorded(world, n=1e-6), part(1e-6, 1e-7, QUIET_ACCEL), latitude=latitude, heading0=yaw
    )
    assert np.abs(normalised(known, world)[0, 3:]).max() < FAR
    assert known.std[0, 3:5].max() < 0.5 * EARTH * np.cos(latitude)
