"""The attitude filter on bodies whose motion is known: closed forms, and its updates."""

import numpy as np
import pytest
from attitude_cases import (
    EARTH,
    GRAVITY,
    N_ACCEL,
    WHITE,
    H,
    K,
    N,
    covariance_of,
    drive,
    error,
    inputs,
    measured,
    output,
    parameters,
    part,
    rover_rate,
)
from scipy.spatial.transform import Rotation

from pyimu.attitude import attitude_ukf
from pyimu.attitude.filter.unscented import LARGEST_STD
from pyimu.attitude.filter.variables import UNKNOWN_LATITUDE
from pyimu.model.simulate import simulate


@pytest.fixture(scope="module")
def block():
    return attitude_ukf(part())


# Propagation


def test_noise_free_propagation_is_the_product_of_rotations():
    block, world = attitude_ukf(part(0, 0)), drive(rover_rate(2000), latitude=0.8)
    u = inputs(2000, gyro=world.inertial, accel=np.full(3, 50.0))
    y, _ = block.run(u, p=parameters(block, latitude=0.8, std0=np.zeros(6)))
    assert not output(block, y, "quasi_static").any()
    assert np.abs(error(output(block, y, "q"), world.attitude)).max() < 1e-12


def test_earth_rate_alone_turns_nothing_at_a_known_latitude():
    block, start = attitude_ukf(part(0, 0)), Rotation.from_rotvec([0.3, -0.5, 1.0])
    world = drive(np.zeros((500, 3)), start, latitude=-0.6)
    u = inputs(500, gyro=world.inertial, accel=np.full(3, 50.0))
    settings = {"q0": start.as_quat(scalar_first=True), "std0": np.zeros(6)}
    known, _ = block.run(u, p=parameters(block, latitude=-0.6, **settings))
    assert np.abs(error(output(block, known, "q"), world.attitude)).max() < 1e-13
    for unknown in (UNKNOWN_LATITUDE, -1.6):
        y, _ = block.run(u, p=parameters(block, latitude=unknown, **settings))
        turned = np.linalg.norm(error(output(block, y, "q")[-1:], start))
        np.testing.assert_allclose(turned, EARTH * 500 * H, rtol=1e-9)


def test_heading_variance_without_heading_grows_as_hidalgos_q():
    """Level and still, gravity says nothing of yaw: sigma^2 = s^2 + N^2 t + K^2 t^3/3 + s_b^2 t^2
    of noise alone.
    """
    block, n, std0 = attitude_ukf(part()), 3000, np.array([0.01, 0.01, 0.02, 1e-3, 1e-3, 1e-4])
    y, _ = block.run(inputs(n), p=parameters(block, std0=std0, rest_time=0))
    t = H * np.arange(1, n + 1)
    expected = std0[2] ** 2 + N**2 * t + K**2 * t**3 / 3 + (std0[5] * t) ** 2
    np.testing.assert_allclose(output(block, y, "std")[:, 2] ** 2, expected, rtol=1e-3)


def test_quaternion_keeps_its_length_and_covariance_stays_definite_over_a_long_run(block):
    state, p = None, parameters(block, std0=np.full(6, 0.05))
    for chunk in range(10):
        rate = rover_rate(10_000) * 5
        u = inputs(10_000, gyro=rate, accel=np.array([0.2, -0.3, GRAVITY]))
        y, state = block.run(u, p=p, state=state)
        np.testing.assert_allclose(np.linalg.norm(output(block, y, "q"), axis=1), 1, atol=4e-15)
        covariance = covariance_of(state)
        scale = np.sqrt(np.diag(covariance))
        assert np.linalg.eigvalsh(covariance / np.outer(scale, scale)).min() > 1e-9
        assert (scale[:3] <= LARGEST_STD * (1 + 1e-12)).all()


def test_half_run_and_half_run_are_the_whole_run(block):
    world = drive(rover_rate(400))
    gyro, accel, _ = measured(world, np.random.default_rng(0), np.zeros(3))
    u = inputs(400, gyro=gyro, accel=accel)
    whole, _ = block.run(u)
    first, state = block.run(u[:150])
    np.testing.assert_array_equal(np.vstack([first, block.run(u[150:], state=state)[0]]), whole)


def test_declared_errors_of_the_sensors_are_undone():
    """A sensor with known scale factor, misalignment, thermal bias, g-sensitivity: the same
    attitude as an ideal one.
    """
    m = np.array([[0, 0.01, -0.02], [0.005, 0, 0.01], [0.02, -0.01, 0]])
    g = np.array([[1e-3, 0, 2e-4], [0, -1e-3, 0], [3e-4, 0, 5e-4]])
    declared = part(
        0,
        0,
        scale_factor={"s": [0.03, -0.02, 0.01]},
        misalignment={"m": m},
        g_sensitivity={"G": g},
        thermal_bias={"kT": [1e-3, 2e-3, -1e-3]},
    )
    block, world = attitude_ukf(declared), drive(rover_rate(500))
    gyro, _ = simulate(declared, world.rate, world.force, 35.0, seed=None)
    assert np.abs(gyro - world.rate).max() > 0.01
    y, _ = block.run(
        inputs(500, gyro=gyro, accel=world.force, temperature=35.0),
        p=parameters(block, std0=np.zeros(6)),
    )
    assert np.abs(error(output(block, y, "q"), world.attitude)).max() < 1e-12


# The updates


@pytest.mark.parametrize(
    "start",
    [[0, 0, 0], [np.pi, 0, 0], [0, np.pi / 2, 0.3]],
    ids=["level", "upside down", "nose down"],
)
@pytest.mark.parametrize("wrong", [0.2, 1.5, 2.8])
def test_tilt_converges_to_gravitys_direction(start, wrong):
    block, truth = attitude_ukf(part()), Rotation.from_rotvec(start)
    axis = truth.apply([0, 0, 1], inverse=True)
    off = np.cross(axis, [0.6, 0.48, 0.64])
    q0 = (truth * Rotation.from_rotvec(wrong * off / np.linalg.norm(off))).as_quat(
        scalar_first=True
    )
    accel = truth.apply([0, 0, GRAVITY], inverse=True)
    y, _ = block.run(
        inputs(3000, accel=accel),
        p=parameters(block, q0=q0, std0=np.array([1, 1, 1, 1e-3, 1e-3, 1e-3]), **WHITE),
    )
    seen = Rotation.from_quat(output(block, y, "q")[-1], scalar_first=True).apply(
        [0, 0, 1], inverse=True
    )
    assert np.arccos(min(1, seen @ axis)) < 1e-3


def test_start_values_are_the_given_attitude(block):
    q0 = Rotation.from_euler("ZYX", [0.3, -0.2, 3.0])
    _, y = block.initial(
        block.start_inputs,
        parameters(block, q0=2 * q0.as_quat(scalar_first=True), bias0=[1e-3, 2e-3, 3e-3]),
    )
    y = np.array(y).T
    assert np.abs(error(output(block, y, "q"), q0)).max() < 1e-15
    np.testing.assert_allclose(
        [output(block, y, n)[0] for n in ("yaw", "pitch", "roll")], [0.3, -0.2, 3.0], atol=1e-14
    )
    np.testing.assert_array_equal(output(block, y, "gyro_bias")[0], [1e-3, 2e-3, 3e-3])


@pytest.mark.parametrize("rows", [1, 20])
def test_zeros_before_the_first_sample_are_no_free_fall(block, rows):
    """As sure afterwards as a filter that started later by so many samples."""
    rng = np.random.default_rng(3)
    u = inputs(100, gyro=N / np.sqrt(H) * rng.standard_normal((100, 3)))
    u[:, 3:6] += N_ACCEL / np.sqrt(H) * rng.standard_normal((100, 3))
    after, _ = block.run(np.vstack([inputs(rows, accel=0.0), u]))
    plain, _ = block.run(u)
    for name in ("quasi_static", "status"):
        np.testing.assert_array_equal(
            output(block, after, name)[rows:], output(block, plain, name), err_msg=name
        )
    # What gyro noise and the bias's standard deviation of 0.01 rad/s add while nothing is known.
    added = np.hypot(N * np.sqrt(rows * H), 0.01 * rows * H)
    std = (output(block, y, "std")[-1, :2] for y in (after[rows:], plain))
    np.testing.assert_allclose(*std, rtol=0.01, atol=added)
    assert not output(block, after, "quasi_static")[:rows].any()


def test_bias_across_gravity_is_found(block):
    bias = np.array([0.004, -0.006, 0.0])
    y, _ = block.run(inputs(20_000, gyro=bias), p=parameters(block, **WHITE))
    np.testing.assert_allclose(output(block, y, "gyro_bias")[-1, :2], bias[:2], atol=3e-5)


@pytest.mark.parametrize("acceleration", [6.0, 3.0], ids=["jolt", "push"])
def test_acceleration_ends_the_quasi_static_update_and_gravity_resumes_it(block, acceleration):
    accel = np.tile([0.0, 0.0, GRAVITY], (3000, 1))
    accel[1000:2000, 0] = acceleration
    y, _ = block.run(inputs(3000, accel=accel))
    quasi_static, during = output(block, y, "quasi_static"), slice(1000, 2000)
    assert quasi_static[:1000].all() and quasi_static[2500:].all()
    assert not quasi_static[during].any()
    np.testing.assert_array_equal(output(block, y, "nis")[during], 0)


def test_push_that_hardly_changes_the_magnitude_is_detected_by_its_scatter():
    """The k-th sample of a push a differs by a (1 - m)^k from the mean, and the scatter is an
    exponential mean of the squares; until the mean has followed.
    """
    block, push, accel = attitude_ukf(part(0, 0)), 1.0, np.tile([0.0, 0.0, GRAVITY], (2000, 1))
    assert np.hypot(GRAVITY, push) - GRAVITY < 0.06
    accel[1000:, 0] = push
    y, _ = block.run(inputs(2000, accel=accel), p=parameters(block, std0=np.full(6, 1e-9)))
    k, m, g = np.arange(1, 1001), H / (1.0 + H), H / (0.3 + H)
    off = (push * (1 - m) ** k) ** 2
    scatter = np.array([np.sum(g * (1 - g) ** (n - k[:n]) * off[:n]) for n in k])
    white = N_ACCEL**2 / H + 1e-4**2
    np.testing.assert_array_equal(
        output(block, y, "quasi_static")[1000:], scatter <= 0.3**2 + 2 * 3 * white
    )


@pytest.mark.parametrize("yaw", [np.pi - 0.02, -np.pi + 0.02, 3.0])
def test_heading_update_goes_the_short_way_across_the_wrap(block, yaw):
    q0 = Rotation.from_euler("ZYX", [yaw, 0, 0]).as_quat(scalar_first=True)
    for heading in (yaw + 0.05, yaw - 0.05, yaw + 0.05 + 2 * np.pi):
        u = inputs(1, heading=heading, heading_variance=0.02**2, heading_valid=1)
        std0 = np.array([0.01, 0.01, 0.1, 1e-6, 1e-6, 1e-6])
        y, _ = block.run(u, p=parameters(block, q0=q0, std0=std0))
        prior = 0.1**2 + N**2 * H
        moved = (output(block, y, "yaw")[0] - yaw + np.pi) % (2 * np.pi) - np.pi
        wanted = (heading - yaw + np.pi) % (2 * np.pi) - np.pi
        np.testing.assert_allclose(moved, prior / (prior + 0.02**2) * wanted, rtol=0.01)
        np.testing.assert_allclose(
            output(block, y, "std")[0, 2] ** 2, prior * 0.02**2 / (prior + 0.02**2), rtol=0.01
        )


def test_heading_of_a_body_that_points_up_is_not_used(block):
    q0 = Rotation.from_euler("ZYX", [0.3, -np.pi / 2, 0]).as_quat(scalar_first=True)
    p = parameters(block, q0=q0)
    plain, _ = block.run(inputs(5, accel=np.array([GRAVITY, 0, 0])), p=p)
    told, _ = block.run(
        inputs(
            5, accel=np.array([GRAVITY, 0, 0]), heading=1.0, heading_variance=1e-4, heading_valid=1
        ),
        p=p,
    )
    np.testing.assert_array_equal(told, plain)


def test_zero_rate_update_averages_the_gyro_and_holds_the_attitude():
    """A still body's bias without random walk: a mean of n samples and the prior, each weighed by
    its variance.
    """
    block, n = attitude_ukf(part(k=0)), 500
    gyro = np.array([0.01, -0.02, 0.005]) + N / np.sqrt(H) * np.random.default_rng(
        3
    ).standard_normal((n, 3))
    q0 = Rotation.from_rotvec([0.1, 0.2, 0.3])
    accel = np.full(3, 50.0)
    y, _ = block.run(
        inputs(n, gyro=gyro, accel=accel, stationary=1),
        p=parameters(block, q0=q0.as_quat(scalar_first=True), stationary_std=0.0),
    )
    information = n / (N**2 / H)
    expected = information * gyro.mean(axis=0) / (information + 1 / 0.01**2)
    np.testing.assert_allclose(output(block, y, "gyro_bias")[-1], expected, rtol=1e-6)
    np.testing.assert_allclose(
        output(block, y, "std")[-1, 3:], (information + 1 / 0.01**2) ** -0.5, rtol=1e-6
    )
    assert np.abs(error(output(block, y, "q"), q0)).max() < 1e-12
