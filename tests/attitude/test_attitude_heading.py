"""A heading that arrives late by whole samples tells what it would have told on time."""

import numpy as np
import pytest
from attitude_cases import (
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

N_ROWS, HEADING_STD = 200, 0.05
STD0 = np.array([1e-3, 1e-3, 0.1, 1e-3, 1e-3, 0.02])
"""An attitude of unknown heading, and a gyro whose bias about z is unknown too."""


@pytest.fixture(scope="module")
def block():
    return attitude_ukf(part())


def turning(block, at: int, age: int, told: float, memory: float = 0.5, period: float = H, **more):
    """Outputs of a body that turns about z, a heading that was true at row ``at`` told ``age`` rows
    later.
    """
    gyro, accel, _ = measured(
        drive(np.tile([0.0, 0.0, 0.7], (N_ROWS, 1))), np.random.default_rng(5), np.zeros(3)
    )
    u = inputs(N_ROWS, gyro=gyro, accel=accel)
    u[at + age, 7:11] = told, HEADING_STD**2, 1, age * period
    return block.run(
        u, p=parameters(block, std0=STD0, heading_memory=memory, **more), sample_period=period
    )


def yaw_and_bias(block, y: np.ndarray) -> np.ndarray:
    """Yaw, vertical bias and their standard deviations of one row."""
    return np.array(
        [
            output(block, y, "yaw"),
            output(block, y, "gyro_bias")[:, 2],
            *output(block, y, "std")[:, [2, 5]].T,
        ]
    ).T


@pytest.mark.parametrize("age", [1, 2, 17, 49, 50])
def test_late_heading_tells_what_it_would_have_told_on_time(block, age):
    """One heading of a linear system: the same estimate, to second order of the standard
    deviations, here a few hundredths.
    """
    at, yaw = 120, 0.7 * H * 121 + 0.08
    on_time, late = (yaw_and_bias(block, turning(block, at, a, yaw)[0])[at + age] for a in (0, age))
    without = yaw_and_bias(block, turning(block, at, 0, yaw, q0=[1.0, 0, 0, 0])[0])[at - 1]
    assert without[2] > 2 * on_time[2], "the heading tells much"
    np.testing.assert_allclose(late[2:], on_time[2:], rtol=2e-3)
    np.testing.assert_allclose(late[:2], on_time[:2], atol=2e-3 * on_time[2])


@pytest.mark.parametrize("age", [10, 50])
def test_heading_taken_as_if_it_were_present_would_be_wrong(block, age):
    """The property above is not empty: the body has turned by many standard deviations since."""
    at, yaw = 120, 0.7 * H * 121 + 0.08
    gyro_turned = 0.7 * H * age
    on_time = yaw_and_bias(block, turning(block, at, 0, yaw)[0])[at + age]
    present = yaw_and_bias(block, turning(block, at + age, 0, yaw)[0])[at + age]
    assert abs(present[0] - on_time[0]) > gyro_turned / 2


def test_late_heading_on_a_gyro_without_errors_is_exact(block):
    """No noise and no bias between: the correction is that of the yaw then, whatever the age."""
    quiet = attitude_ukf(part(0, 0, 0))
    u = inputs(N_ROWS, gyro=np.array([0.0, 0.0, 2.9]), accel=np.full(3, 50.0))
    p = parameters(
        quiet,
        std0=np.array([1e-9, 1e-9, 0.1, 1e-12, 1e-12, 1e-12]),
        q0=Rotation.from_euler("z", 3.0).as_quat(scalar_first=True),
    )
    last = []
    for age in (0, 1, 25, 50):
        v = u.copy()
        v[100 + age, 7:11] = 3.0 + 2.9 * H * 101 + 0.05 - 2 * np.pi, 0.01, 1, age * H
        y, _ = quiet.run(v, p=p)
        last.append(output(quiet, y, "yaw")[-1])
    np.testing.assert_allclose(last, last[0], rtol=0, atol=1e-10)


def test_headings_late_by_different_ages_may_cross(block):
    """Told in another order than they were true: each against the yaw that it belongs to."""
    rng = np.random.default_rng(2)
    gyro, accel, _ = measured(drive(np.tile([0.0, 0.0, 0.7], (3000, 1))), rng, np.zeros(3))
    u = inputs(3000, gyro=gyro, accel=accel)
    told = np.flatnonzero(rng.random(3000) < 0.1)
    told = told[told > 60]
    age = rng.integers(0, 50, len(told))
    yaw = 0.7 * H * (told - age + 1)
    u[told, 7], u[told, 8], u[told, 9], u[told, 10] = (
        yaw + HEADING_STD * rng.standard_normal(len(told)),
        HEADING_STD**2,
        1,
        age * H,
    )
    y, _ = block.run(u, p=parameters(block, std0=STD0))
    off = (output(block, y, "yaw") - 0.7 * H * np.arange(1, 3001) + np.pi) % (2 * np.pi) - np.pi
    z = off[1000:] / output(block, y, "std")[1000:, 2]
    assert np.abs(z).max() < 5
    assert output(block, y, "std")[-1, 2] < HEADING_STD / 3


def test_heading_older_than_the_memory_or_the_run_is_not_used_and_said_so(block):
    for at, age in ((120, 64), (-3, 8)):
        y, _ = turning(block, at, age, 0.3)
        plain, _ = turning(block, at, age, np.nan)
        row = at + age
        assert (
            output(block, y, "status")[row] == 16
            and not np.delete(output(block, y, "status"), row).any()
        )
        np.testing.assert_array_equal(output(block, y, "q"), output(block, plain, "q"))


def test_longer_memory_takes_older_headings():
    """Two seconds at 100 Hz are more samples than yaws are kept: between them the course is a line,
    exact for a constant rate.
    """
    block = attitude_ukf(part(0, 0, 0))
    u = inputs(600, gyro=np.array([0.0, 0.0, 0.7]), accel=np.full(3, 50.0))
    p = parameters(block, std0=np.array([1e-9, 1e-9, 0.1, 1e-12, 1e-12, 1e-12]), heading_memory=2.0)
    moved = []
    for age in (0, 1, 7, 131, 199, 200):
        v = u.copy()
        v[300 + age, 7:11] = 0.7 * H * 301 + 0.05, 0.01, 1, age * H
        y, _ = block.run(v, p=p)
        moved.append(output(block, y, "yaw")[-1])
        assert not output(block, y, "status").any()
    np.testing.assert_allclose(moved, moved[0], rtol=0, atol=1e-10)


def test_course_between_kept_yaws_is_a_line():
    """Under an angular acceleration a the line is off by at most a d^2/8, d being the span between
    two kept yaws.
    """
    block, acceleration = attitude_ukf(part(0, 0, 0)), 3.0
    n, span = 600, 4 * H
    rate = acceleration * H * np.arange(n)
    yaw = np.cumsum(rate) * H
    u = inputs(n, gyro=np.column_stack([np.zeros((n, 2)), rate]), accel=np.full(3, 50.0))
    p = parameters(
        block, std0=np.array([1e-9, 1e-9, 0.003, 1e-12, 1e-12, 1e-12]), heading_memory=63 * span
    )
    worst = 0.0
    for age in range(100, 108):
        v = u.copy()
        v[500, 7:11] = yaw[500 - age], 1e-12, 1, age * H
        y, _ = block.run(v, p=p)
        off = (output(block, y, "yaw")[500] - yaw[500] + np.pi) % (2 * np.pi) - np.pi
        worst = max(worst, abs(off))
    assert 0 < worst < acceleration * span**2 / 8 * (1 + 1e-4)


def test_late_heading_widens_no_less_than_the_gyro_since_then(block):
    """Of a perfect heading the age's white noise is left: N^2 T."""
    gyro, accel, _ = measured(drive(np.zeros((N_ROWS, 3))), np.random.default_rng(1), np.zeros(3))
    for age in (10, 40):
        u = inputs(N_ROWS, gyro=gyro, accel=accel)
        u[100 + age, 7:11] = 0.0, 1e-12, 1, age * H
        y, _ = block.run(
            u, p=parameters(block, std0=np.array([1e-3, 1e-3, 0.05, 1e-9, 1e-9, 1e-9]))
        )
        np.testing.assert_allclose(
            output(block, y, "std")[100 + age, 2], N * np.sqrt(age * H), rtol=0.02
        )


@pytest.mark.parametrize(
    "settings, variance",
    [
        ({"lost_rate_std": 0.1}, (0.1 * 20 * H) ** 2),
        ({"rate_noise": 0.01}, (0.01 * 0.7) ** 2 * 40 * H),
    ],
    ids=["loss", "relative noise"],
)
def test_late_heading_leaves_whatever_widened_the_attitude_since_then(block, settings, variance):
    """Of a perfect heading, 40 samples old: beside N^2 T the unknown angle of a loss of 20 samples,
    or the noise that comes with the rate.
    """
    u = inputs(N_ROWS, gyro=np.array([0.0, 0.0, 0.7]), accel=np.full(3, 50.0))
    if "lost_rate_std" in settings:
        u[110:130, 2] = np.nan
    u[140, 7:11] = 0.7 * H * 101, 1e-12, 1, 40 * H
    y, _ = block.run(
        u, p=parameters(block, std0=np.array([1e-6, 1e-6, 0.2, 1e-9, 1e-9, 1e-9]), **settings)
    )
    left = variance + N**2 * 40 * H
    np.testing.assert_allclose(
        output(block, y, "std")[140, 2] ** 2, left, rtol=0.01 + left / 0.2**2
    )


# Many headings


@pytest.mark.parametrize(
    "every, age, white",
    [(1, 30, N), (10, 30, N), (1, None, N), (1, 30, N / 10)],
    ids=["each sample", "10 Hz", "each sample, of all ages", "each sample, a quiet gyro"],
)
def test_precise_headings_that_are_late_again_and_again_leave_the_filter_consistent(
    every, age, white, monkeypatch
):
    """Each may tell of what was before its age alone. Yaw and bias of many draws against their
    covariance; the covariance stays definite.
    """
    monkeypatch.setattr("attitude_cases.N", white)
    block, world = attitude_ukf(part(white)), drive(rover_rate(800) + [0, 0, 0.3])
    n, std, draws, total = 800, 1e-4, 24, np.zeros(2)
    yaw = np.unwrap(world.attitude.as_euler("ZYX")[:, 0])
    for seed in range(draws):
        rng = np.random.default_rng(seed)
        first = np.array([0.003, 0.003, 0.05, 0.001, 0.001, 0.003]) * rng.standard_normal(6)
        gyro, accel, bias = measured(world, rng, first[3:])
        u, told = inputs(n, gyro=gyro, accel=accel), np.arange(60, n, every)
        late = rng.integers(0, 50, len(told)) if age is None else np.full(len(told), age)
        u[told, 7:11] = np.column_stack(
            [
                yaw[told - late] + std * rng.standard_normal(len(told)),
                np.full((len(told), 2), [std**2, 1]),
                late * H,
            ]
        )
        q0 = Rotation.from_rotvec(first[:3]).inv().as_quat(scalar_first=True)
        y, state = block.run(
            u, p=parameters(block, q0=q0, std0=np.array([0.003, 0.003, 0.05, 0.001, 0.001, 0.003]))
        )
        covariance = covariance_of(state)
        scale = np.sqrt(np.diag(covariance))
        assert (
            np.isfinite(y).all()
            and np.linalg.eigvalsh(covariance / np.outer(scale, scale)).min() > 1e-6
        )
        off = np.array(
            [
                error(output(block, y, "q")[-1:], world.attitude[-1:])[0, 2],
                bias[-1, 2] - output(block, y, "gyro_bias")[-1, 2],
            ]
        )
        total += (off / scale[[2, 5]]) ** 2
    # Only from above: a filter that expects accelerations which are not there is too careful.
    assert total[0] < chi2.isf(1e-3 / 6, draws)
    assert total[1] < (1 if age else 4) * chi2.isf(1e-3 / 6, draws), (
        "of ages that differ, the bias is too sure by a factor of two at most"
    )
    assert output(block, y, "std")[-1, 2] < 0.05 / 20


def test_late_heading_after_better_ones_of_the_present_is_not_used_and_said(block):
    """The present yaw is better known than what the gyro's noise since then leaves of the late
    one.
    """
    u = inputs(N_ROWS, accel=np.full(3, 50.0))
    u[100:150, 7:11], u[150, 7:11] = [0, 1e-10, 1, 0], [0.001, 1e-10, 1, 40 * H]
    y, _ = block.run(u, p=parameters(block, std0=np.array([1e-6, 1e-6, 0.1, 1e-9, 1e-9, 1e-9])))
    status = output(block, y, "status")
    assert status[150] == 32 and not np.delete(status, 150).any()
