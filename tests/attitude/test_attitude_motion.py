"""The velocity of the body as a state: what the run itself shows of the motion weighs gravity."""

from dataclasses import replace

import casadi as ca
import numpy as np
import pytest
from attitude_cases import (
    GRAVITY,
    N_ACCEL,
    WHITE,
    H,
    K,
    N,
    attitude_after,
    inputs,
    output,
    parameters,
    part,
    rover_rate,
)
from scipy.linalg import solve_continuous_are
from scipy.signal import lfilter
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

import pyimu
from pyimu.attitude import attitude_ukf
from pyimu.attitude.filter.unscented import WHOLE
from pyimu.attitude.filter.velocity import covariance_of_motion

ROWS = 12_000
SETTLED = slice(3_000, None)
STD0 = np.array([0.01, 0.01, 0.01, 1e-3, 1e-3, 1e-3])


@pytest.fixture(scope="module")
def block():
    return attitude_ukf(part())


def moved(
    acceleration: np.ndarray, turning: bool = True, seed: int = 0, n: float = N
) -> tuple[np.ndarray, Rotation]:
    """Inputs (n, 15) of a body that has this ``acceleration`` (n, 3) in world axes, and its
    attitude: level, or ``turning``; ``n`` is the gyro's white noise.
    """
    rng, rate = np.random.default_rng(seed), turning * rover_rate(len(acceleration))
    world = attitude_after(rate)
    force = world.apply(acceleration + [0, 0, GRAVITY], inverse=True)
    gyro, accel = (rng.standard_normal(rate.shape) for _ in range(2))
    u = inputs(
        len(rate), gyro=rate + n / np.sqrt(H) * gyro, accel=force + N_ACCEL / np.sqrt(H) * accel
    )
    return u, world


def tilt(block, y: np.ndarray, world: Rotation) -> np.ndarray:
    """Angle (n,) in rad between the estimated and the true vertical."""
    q = Rotation.from_quat(output(block, y, "q"), scalar_first=True)
    up, true_up = (r.apply([0, 0, 1], inverse=True) for r in (q, world))
    return np.linalg.norm(up - true_up, axis=1)


def sines(size: float, omega: float) -> np.ndarray:
    """Acceleration (n, 3) of sines about each axis, of ``size`` m/s^2 and near ``omega`` rad/s."""
    t = H * np.arange(ROWS)[:, None]
    return size * np.sin(omega * np.array([0.83, 1.0, 1.21]) * t + [0.0, 1.0, 2.0])


def pushes(size: float, time: float) -> np.ndarray:
    """Acceleration (n, 3) of pushes that last ``time`` s, to and fro, with rests between."""
    t = H * np.arange(ROWS)
    whole = np.where(t % (2 * time) < time, size * (-1.0) ** (t // (2 * time)), 0)
    return whole[:, None] * [0.6, 0.8, 0.0]


@pytest.mark.parametrize(
    "acceleration",
    [sines(5.0, 16.0), sines(1.5, 3.0), pushes(0.5, 3.0)],
    ids=["hand", "slow sway", "pushes of a vehicle"],
)
def test_motion_of_any_size_and_time_is_weighed_without_a_setting(block, acceleration):
    """A third of the tilt that the force itself shows, and no further off than the filter says:
    beyond three of its standard deviations in a hundredth of the time.
    """
    shown = np.sqrt(np.mean(np.sum(acceleration[SETTLED, :2] ** 2, axis=1))) / GRAVITY
    for turning in (True, False):
        u, world = moved(acceleration, turning)
        y, _ = block.run(u, p=parameters(block, std0=STD0))
        off = tilt(block, y, world)[SETTLED]
        assert np.sqrt(np.mean(off**2)) < shown / 3
    std = np.linalg.norm(output(block, y, "std")[SETTLED, :2], axis=1)
    assert np.mean(off > 3 * std) < 0.01


def test_more_motion_makes_the_tilt_less_sure_and_rest_makes_it_sure_again(block):
    """The run finds out how large the velocity is, up and down: within six of its windows, of which
    the longest is that of the drift, 60 correlation times.
    """
    acceleration = np.vstack([sines(5.0, 3.0), np.zeros((2 * ROWS, 3))])
    acceleration[:3000], acceleration[6000:] = 0, 0
    u, _ = moved(acceleration, turning=False)
    y, _ = block.run(u, p=parameters(block, std0=STD0, rest_time=0, motion_time=0.5))
    std = output(block, y, "std")[:, 0]
    assert std[5990] > 1.5 * std[2990]
    assert std[-1] < 1.1 * std[2990]


def test_a_body_that_shows_no_motion_is_claimed_not_to_move_until_it_does():
    """Level in its place and never called at rest, after fifteen seconds its tilt is claimed to be
    at most by half as unsure again as if it was known never to accelerate, and chi-square of as
    many bodies holds; what shakes it then makes it unsure again.
    """
    block, bodies, squares, claimed = attitude_ukf(part(3e-4, 1e-5, 1e-3)), 8, [], []
    known_std = np.array([1e-3] * 3 + [1.5e-4] * 3)
    known = parameters(block, std0=known_std, rest_time=0)
    shaken = np.vstack([np.zeros((9000, 3)), sines(1.5, 3.0)[:3000]])
    for seed in range(bodies):
        u, world = moved(shaken, turning=False, seed=seed, n=3e-4)
        y, _ = block.run(u, p=known)
        claimed.append(np.linalg.norm(output(block, y, "std")[:, :2], axis=1))
        squares.append(tilt(block, y, world) ** 2 / (claimed[-1] ** 2 / 2))
    at = [6000, 7000, 8000, 8900]
    assert np.all(np.sum(squares, axis=0)[at] < chi2.ppf(1 - 1e-3 / len(at), 2 * bodies))
    y, _ = block.run(u[:9000], p=parameters(block, std0=known_std, **WHITE))
    least = np.linalg.norm(output(block, y, "std")[:, :2], axis=1)
    early, late, moving = np.mean(claimed, axis=0)[[1500, 8900, 11_900]]
    assert early < 1.5 * least[1500] and late < 1.5 * least[8900] and moving > 2 * late


def test_a_drive_of_long_pushes_is_no_more_off_than_claimed():
    """Pushes of 0.5 m/s^2 for 5 s, either way along two axes, of a body that turns, by a gyro whose
    bias is known from a rest: the squared error of the tilt over its claimed variance is no larger
    than chi-square of as many drives lets it be.
    """
    block, drives, squares, claimed = attitude_ukf(part(3e-4, 1e-5, 1e-3)), 8, [], []
    known = parameters(block, std0=[1e-3] * 3 + [1.5e-4] * 3)
    for seed in range(drives):
        signs = np.random.default_rng(100 + seed).choice([-0.5, 0.0, 0.5], (ROWS // 500, 3))
        u, world = moved(np.repeat(signs * [1, 1, 0], 500, axis=0), seed=seed, n=3e-4)
        y, _ = block.run(u, p=known)
        claimed.append(np.linalg.norm(output(block, y, "std")[:, :2], axis=1))
        squares.append(tilt(block, y, world) ** 2 / (claimed[-1] ** 2 / 2))
    at = np.arange(1500, ROWS, 1500)
    total = np.sum(squares, axis=0)[at]
    assert np.all(total < chi2.ppf(1 - 1e-3 / len(at), 2 * drives))
    # A force taken for gravity would be off by 3 deg.
    assert np.degrees(np.mean(claimed)) < 2.5


def test_hard_pushes_do_not_contradict_a_tilt_once_the_run_has_seen_such():
    """Of 2 m/s^2, twice what contradicts a tilt at first, 11 deg if taken for gravity: after the
    first, from 24 to 28 s, no force contradicts the tilt, which is no more off than claimed.
    """
    block, drives, squares = attitude_ukf(part(3e-4, 1e-5, 1e-3)), 8, []
    known = parameters(block, std0=[1e-3] * 3 + [1.5e-4] * 3)
    acceleration = pushes(2.0, 4.0)
    acceleration[:2000] = 0
    acceleration = lfilter(np.full(50, 1 / 50), 1, acceleration, axis=0)
    for seed in range(drives):
        u, world = moved(acceleration, seed=seed, n=3e-4)
        y, _ = block.run(u, p=known)
        contradicted = np.flatnonzero(output(block, y, "status").astype(int) & 8)
        assert 2400 < contradicted[0] and contradicted[-1] < 2850
        std = np.linalg.norm(output(block, y, "std")[:, :2], axis=1)
        squares.append(tilt(block, y, world) ** 2 / (std**2 / 2))
    at = np.arange(1500, ROWS, 1500)
    assert np.all(np.sum(squares, axis=0)[at] < chi2.ppf(1 - 1e-3 / len(at), 2 * drives))


def test_velocity_of_a_body_that_never_accelerates_is_gravity_by_the_sample(block):
    """Its covariance is the steady one of tilt and bias, measured by the force itself: no state of
    the velocity is in it.
    """
    u, _ = moved(np.zeros((ROWS, 3)), turning=False)
    y, _ = block.run(u, p=parameters(block, std0=STD0, **WHITE))
    slope = np.array([[GRAVITY], [0.0]])
    walk, density = np.diag([N**2, K**2]), np.array([[N_ACCEL**2]])
    steady = solve_continuous_are(np.array([[0.0, 0.0], [-1.0, 0.0]]), slope, walk, density)
    found = output(block, y, "std")[-1]
    np.testing.assert_allclose(found[:2] ** 2, steady[0, 0], rtol=0.05)
    np.testing.assert_allclose(found[3:5] ** 2, steady[1, 1], rtol=0.05)


def test_yaw_stays_as_unknown_as_the_gyro_leaves_it_in_any_motion(block):
    """Motion of a body tells nothing of its heading: sigma^2 = s^2 + N^2 t + K^2 t^3/3 + s_b^2 t^2
    about the vertical, for a level body.
    """
    u, _ = moved(sines(5.0, 3.0), turning=False)
    y, _ = block.run(u, p=parameters(block, std0=STD0))
    t = H * ROWS
    expected = STD0[2] ** 2 + N**2 * t + K**2 * t**3 / 3 + (STD0[5] * t) ** 2
    np.testing.assert_allclose(output(block, y, "std")[-1, 2] ** 2, expected, rtol=1e-2)


def test_covariance_of_all_states_stays_definite_in_motion(block):
    u, _ = moved(sines(5.0, 3.0))
    u[5000:5003, 3] = np.nan
    _, state = block.run(u, p=parameters(block, std0=STD0))
    p = np.zeros((WHOLE, WHOLE))
    p[np.triu_indices(6)] = state[7:28]
    p[:6, 6:] = state[31:49].reshape(3, 6).T
    p[6:, 6:][np.triu_indices(3)] = state[49:55]
    p = p + np.triu(p, 1).T
    scale = np.sqrt(np.diag(p))
    assert np.linalg.eigvalsh(p / np.outer(scale, scale)).min() > 1e-6


def test_lost_forces_widen_the_velocity_and_do_no_harm(block):
    """A tenth of all forces is missing in motion: about as good as without."""
    u, world = moved(sines(1.5, 3.0))
    whole, _ = block.run(u, p=parameters(block, std0=STD0))
    u[np.random.default_rng(1).random(ROWS) < 0.1, 3] = np.nan
    y, _ = block.run(u, p=parameters(block, std0=STD0))
    off, before = (np.sqrt(np.mean(tilt(block, v, world)[SETTLED] ** 2)) for v in (y, whole))
    assert off < 1.5 * before
    assert (output(block, y, "std")[-1] > 0.99 * output(block, whole, "std")[-1]).all()


def test_a_tilt_that_is_wrong_and_claimed_to_be_known_is_set_right_in_motion(block):
    """Half a radian off, fifty times what is claimed: taken for a push that lasts at first, not for
    ever.
    """
    u, world = moved(sines(1.5, 3.0))
    q0 = Rotation.from_rotvec([0.5, 0, 0]).as_quat(scalar_first=True)
    y, _ = block.run(u, p=parameters(block, q0=q0, std0=STD0))
    assert (output(block, y, "status").astype(int)[:300] & 8).any()
    off = tilt(block, y, world)
    assert off[6000:].max() < 0.04
    assert off[9000:].max() < 0.03


@pytest.mark.parametrize("which", (0, 1))
@pytest.mark.parametrize("lasting", (1.0, 2e9))
def test_a_velocity_along_one_axis_alone_has_a_definite_covariance(which, lasting):
    """Forces that contradict gravity for minutes make a velocity of 70 m/s along the vertical and
    none across it: the bias was 5e17 rad/s once the smaller variance was lost in the rounding."""
    variances = [4e-14, 4e-14]
    variances[which] = 4.8e3
    up, across, along = ca.SX.sym("up", 3), *variances
    moving = ca.Function("moving", [up], [lasting * covariance_of_motion(across, along, up)])
    axes = np.random.default_rng(0).standard_normal((200, 3))
    for one in axes / np.linalg.norm(axes, axis=1)[:, None]:
        matrix = np.array(moving(one))
        assert np.linalg.eigvalsh(matrix).min() > 0
        np.linalg.cholesky(matrix)


@pytest.mark.long
def test_pushes_that_contradict_gravity_for_half_an_hour_leave_a_number():
    """Each of up to a minute and some 2 m/s^2, of a body that does not turn and is in no rest: the
    filter ended in NaN."""
    n, rng = 200_000, np.random.default_rng(1)
    force, at = np.tile([0.0, 0.0, GRAVITY], (n, 1)), 0
    while at < n:
        lasts = int(rng.uniform(5, 60) / H)
        force[at : at + lasts] += rng.normal(scale=2.0, size=3)
        at += lasts
    gyro, accel = (rng.standard_normal((n, 3)) for _ in range(2))
    u = inputs(n, gyro=0.001 * gyro, accel=force + 0.01 * accel)
    block = attitude_ukf(replace(pyimu.part("imt30"), sample_rate=1 / H, tolerances=()))
    y, _ = block.run(u, p=parameters(block, rest_time=0.0))
    assert np.all(np.isfinite(y)) and not np.any(output(block, y, "status").astype(int) & 128)
    assert np.abs(output(block, y, "gyro_bias")).max() < 1.0
