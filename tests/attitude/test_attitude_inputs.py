"""Inputs that are missing, absurd or at a sensor's limit: the filter's state stays finite, and its
covariance says what is not known.
"""

import numpy as np
import pytest
from attitude_cases import GRAVITY, H, covariance_of, inputs, output, parameters, part

from pyimu.attitude import attitude_ukf
from pyimu.attitude.filter.sigma_point_filter import sigma_point_filter
from pyimu.attitude.filter.unscented import LARGEST_STD


@pytest.fixture(scope="module")
def block():
    return attitude_ukf(part())


BAD = [np.nan, np.inf, -np.inf, 1e300]


@pytest.mark.parametrize("bad", BAD)
@pytest.mark.parametrize("column", range(18))
def test_input_that_is_not_finite_never_poisons_the_state(block, column, bad):
    u = inputs(
        60,
        gyro=np.array([0.1, 0.0, -0.05]),
        heading_variance=1e-2,
        heading_valid=np.arange(60) % 10 == 9,
    )
    u[20:30, column] = bad
    y, state = block.run(u)
    assert np.isfinite(y).all() and np.isfinite(state).all()
    status = output(block, y, "status")
    assert not status[:20].any() and not status[30:].any()
    if column < 7:
        np.testing.assert_array_equal(status[20:30], 1)


def test_everything_lost_from_the_first_sample_on_leaves_an_honest_attitude(block):
    u = np.full((3000, 18), np.nan)
    y, state = block.run(u)
    assert np.isfinite(y).all() and np.isfinite(state).all()
    np.testing.assert_allclose(output(block, y, "std")[-1, :3], LARGEST_STD, rtol=1e-3)


def test_lost_gyro_holds_the_last_rate_and_widens_by_the_unknown_angle():
    """Over a loss of T s, the angle's variance grows by s^2 T^2 about the lost axis, and not about
    the others.
    """
    block, n = attitude_ukf(part(1e-6, 0)), 100
    u = inputs(n, gyro=np.array([0.0, 0.0, 0.2]), accel=np.full(3, 50.0))
    u[50:, 2] = np.nan
    y, _ = block.run(u, p=parameters(block, std0=np.full(6, 1e-6), lost_rate_std=0.3))
    np.testing.assert_allclose(output(block, y, "yaw")[-1], 0.2 * n * H, rtol=1e-9)
    np.testing.assert_allclose(output(block, y, "std")[-1, 2], 0.3 * 50 * H, rtol=1e-6)
    assert output(block, y, "std")[-1, :2].max() < 1e-4


def test_an_axis_that_stays_lost_widens_as_a_body_that_turns_to_and_fro():
    """In a second it turns one way, so that the variance of the angle grows by 2 s^2 a second after
    the first; and an axis that gravity or a heading shows is as sure as these make it.
    """
    block, n = attitude_ukf(part(1e-6, 0)), 1000
    u = inputs(n, gyro=np.array([0.0, 0.0, 0.2]), accel=np.full(3, 50.0))
    u[:, 2] = np.nan
    y, _ = block.run(u, p=parameters(block, std0=np.full(6, 1e-6), lost_rate_std=0.1))
    expected = 0.1 * np.sqrt(2 * n * H - 1)
    np.testing.assert_allclose(output(block, y, "std")[-1, 2], expected, rtol=1e-6)
    u = inputs(n, gyro=np.array([np.nan, 0.0, 0.0]))
    level, _ = block.run(u, p=parameters(block, std0=np.full(6, 1e-6)))
    assert np.degrees(output(block, level, "std")[-1, 0]) < 15.0


def test_saturated_gyro_is_marked_and_widens_the_covariance():
    block = attitude_ukf(part(saturation={"limit": 2.0}))
    u = inputs(40, gyro=np.zeros(3))
    u[20:30, 1] = 2.0
    y, _ = block.run(u)
    status, std = output(block, y, "status"), output(block, y, "std")
    np.testing.assert_array_equal(
        status, np.where((np.arange(40) >= 20) & (np.arange(40) < 30), 2, 0)
    )
    assert std[20, 1] - std[19, 1] > 20 * (std[20, 0] - std[19, 0])


def test_rate_of_more_than_half_a_turn_in_a_period_is_a_lost_axis():
    """Of such a sample nobody knows the turn: its axis widens by the unknown rate, and it is
    said.
    """
    block, n = attitude_ukf(part()), 6
    u = inputs(n, gyro=np.array([0.0, 0.0, 3.0]), accel=np.full(3, 50.0))
    u[3:, 2] = 3.3
    y, _ = block.run(
        u, p=parameters(block, std0=np.full(6, 1e-6), lost_rate_std=0.1), sample_period=1.0
    )
    std = output(block, y, "std")
    np.testing.assert_array_equal(output(block, y, "status"), [0, 0, 0, 2, 2, 2])
    np.testing.assert_allclose(
        np.sqrt(std[3:, 2] ** 2 - std[2, 2] ** 2), 0.1 * np.sqrt([1, 3, 5]), rtol=1e-2
    )


@pytest.mark.parametrize("make", [attitude_ukf, sigma_point_filter])
@pytest.mark.parametrize("bias", [30.0, 3e4, 1e6])
def test_absurd_bias_is_bounded_and_makes_no_number_that_is_none(make, bias):
    block = make(part())
    y, state = block.run(inputs(300), p=parameters(block, bias0=[bias, -bias, bias]))
    assert np.isfinite(y).all() and np.isfinite(state).all()
    limits = {v.name: (v.minimum, v.maximum) for v in block.parameters}
    assert limits["bias0[1]"] == (-100, 100)


def test_covariance_stays_definite_under_fast_turns_of_an_unknown_bias_and_long_periods():
    """A bias unknown by more than a turn in a period: the worst that start values within their
    bounds can ask for.
    """
    block, n = attitude_ukf(part()), 40
    for seed in range(400):
        rng = np.random.default_rng(seed)
        rate = 10 ** rng.uniform(-4, 1) * rng.standard_normal((n, 3))
        u = inputs(
            n,
            gyro=rate,
            accel=[0, 0, GRAVITY] + 10 ** rng.uniform(-4, 1) * rng.standard_normal((n, 3)),
        )
        std0 = np.concatenate([10 ** rng.uniform(-9, 1, 3), 10 ** rng.uniform(-1, 1, 3)])
        p = parameters(block, q0=rng.standard_normal(4), bias0=rng.standard_normal(3), std0=std0)
        y, state = block.run(u, p=p, sample_period=10 ** rng.uniform(-1, 0.5))
        assert np.isfinite(state).all() and not (output(block, y, "status").astype(int) & 128).any()
        covariance = covariance_of(state)
        scale = np.sqrt(np.diag(covariance))
        assert np.linalg.eigvalsh(covariance / np.outer(scale, scale)).min() > -1e-9


def test_sensors_whose_errors_cannot_be_undone_do_not_poison_the_state():
    """A scale factor of -1 has no inverse."""
    block = attitude_ukf(part(scale_factor={"s": [-1.0, 0, 0]}))
    y, state = block.run(inputs(50, gyro=np.array([0.1, 0.2, 0.3])))
    assert np.isfinite(y).all() and np.isfinite(state).all()
