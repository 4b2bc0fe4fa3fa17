"""Drives whose noise is what the filter assumes: its errors and innovations have the distributions
that its covariance claims.
"""

import numpy as np
import pytest
from attitude_cases import (
    GRAVITY,
    WHITE,
    Drive,
    H,
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
from scipy.stats import chi2

from pyimu.attitude import attitude_ukf
from pyimu.attitude.filter.variables import UNKNOWN_LATITUDE

OUTSIDE = 1e-4
"""Probability on either side of a band."""


def within_chi2(value: float, degrees: float) -> None:
    low, high = chi2.ppf([OUTSIDE, 1 - OUTSIDE], degrees)
    assert low < value < high


@pytest.fixture(scope="module")
def block():
    return attitude_ukf(part())


STD0 = np.array([0.03, 0.03, 0.05, 0.01, 0.01, 0.01])


def one_draw(
    block,
    world: Drive,
    seed: int,
    std0: np.ndarray,
    heading_std: float,
    still: int,
    latitude: float,
):
    """Outputs (n, ny) and true bias (n, 3) of one seed, its initial error drawn from the initial
    covariance.
    """
    rng = np.random.default_rng(seed)
    first = std0 * rng.standard_normal(6)
    gyro, accel, bias = measured(world, rng, first[3:])
    n = len(gyro)
    q0 = Rotation.from_rotvec(first[:3]).inv().as_quat(scalar_first=True)
    u = inputs(n, gyro=gyro, accel=accel, stationary=np.arange(n) < still)
    if heading_std:
        yaw = world.attitude.as_euler("ZYX")[:, 0] + heading_std * rng.standard_normal(n)
        u[:, 7], u[:, 8], u[:, 9] = yaw, heading_std**2, np.arange(n) % 50 == 49
    y, state = block.run(u, p=parameters(block, q0=q0, std0=std0, latitude=latitude, **WHITE))
    return y, bias, state


@pytest.mark.parametrize(
    "heading_std, still", [(0.0, 0), (0.02, 300)], ids=["gravity", "gravity, heading, zero rate"]
)
@pytest.mark.parametrize(
    "n, std0",
    [(50, STD0), (1500, STD0), (1500, STD0 / 50)],
    ids=["early", "late", "late, noise prevails"],
)
def test_normalised_estimation_error_squared_of_many_draws_is_chi2(
    block, heading_std, still, n, std0
):
    """Bar-Shalom, Li and Kirubarajan 2001, section 5.4: the sum over M draws has 6 M degrees of
    freedom.
    """
    world, total, draws = drive(rover_rate(n, still), latitude=0.8), 0.0, 48
    for seed in range(draws):
        y, bias, state = one_draw(block, world, seed, std0, heading_std, still, 0.8)
        turn = error(output(block, y, "q")[-1:], world.attitude[-1:])[0]
        e = np.concatenate([turn, bias[-1] - output(block, y, "gyro_bias")[-1]])
        total += e @ np.linalg.solve(covariance_of(state), e)
    within_chi2(total, 6 * draws)


def test_normalised_innovations_squared_are_white_chi2_of_three(block):
    world = drive(rover_rate(4000), latitude=0.8)
    y, _, _ = one_draw(block, world, 7, STD0, 0.0, 0, 0.8)
    nis = output(block, y, "nis")
    updated = nis > 0
    assert updated.mean() > 0.99
    within_chi2(nis[updated].sum(), 3 * updated.sum())
    z = chi2.cdf(nis[updated], 3) - 0.5
    assert abs(np.sum(z[1:] * z[:-1])) < 4.5 * np.sqrt(len(z)) / 12


def test_heading_std_is_that_of_the_covariance_about_the_vertical(block):
    """On a tilted body no one of its axes is vertical: the covariance as a whole is needed."""
    start = Rotation.from_euler("ZYX", [0.5, -1.0, 0.9])
    world = drive(rover_rate(300), start)
    gyro, accel, _ = measured(world, np.random.default_rng(1), np.zeros(3))
    p = parameters(block, q0=start.as_quat(scalar_first=True), std0=STD0)
    y, state = block.run(inputs(300, gyro=gyro, accel=accel), p=p)
    last = Rotation.from_quat(output(block, y, "q")[-1], scalar_first=True)
    up = last.apply([0, 0, 1], inverse=True)
    assert np.abs(up).min() > 0.1
    variance = up @ covariance_of(state)[:3, :3] @ up
    assert output(block, y, "heading_std")[-1] == pytest.approx(np.sqrt(variance), rel=1e-12)


@pytest.mark.parametrize("start", [[0, 0, 0], [0, 0, 1.2], [0, -1.3, 0], [1.0, 0.7, 3.0]])
def test_heading_without_a_heading_walks_by_the_gyros_white_noise(start):
    """Its variance grows by N^2 in a second about the vertical, however the body lies; gravity
    says nothing of it.
    """
    n, block, attitude = 2000, attitude_ukf(part(k=0)), Rotation.from_euler("ZYX", start)
    q0, std0 = attitude.as_quat(scalar_first=True), [0.02, 0.02, 0.02, 0, 0, 0]
    force = attitude.apply([0, 0, GRAVITY], inverse=True)
    y, _ = block.run(inputs(n, accel=force), p=parameters(block, q0=q0, std0=std0, rest_time=0))
    variance = output(block, y, "heading_std")[-1] ** 2
    assert variance == pytest.approx(0.02**2 + N**2 * n * H, rel=1e-3)


def test_output_std_is_the_root_of_the_covariances_diagonal(block):
    y, _, state = one_draw(block, drive(rover_rate(300)), 1, STD0, 0.0, 0, UNKNOWN_LATITUDE)
    np.testing.assert_allclose(
        output(block, y, "std")[-1], np.sqrt(np.diag(covariance_of(state))), rtol=1e-14
    )
