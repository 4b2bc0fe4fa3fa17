"""A heading that arrives late by whole samples tells what it would have told on time."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from test_attitude_ukf import H, N, drive, inputs, measured, output, parameters, part

from pyimu.attitude import attitude_ukf

N_ROWS, HEADING_STD = 200, 0.05
STD0 = np.array([1e-3, 1e-3, 0.1, 1e-3, 1e-3, 0.02])
"""An attitude of unknown heading, and a gyro whose bias about z is unknown too."""


@pytest.fixture(scope="module")
def block():
    return attitude_ukf(part())


def turning(block, at: int, age: int, told: float, memory: float = 0.5, period: float = H, **more):
    """Outputs of a body that turns about z, a heading that was true at row ``at`` told ``age`` rows later."""
    gyro, accel, _ = measured(drive(np.tile([0.0, 0.0, 0.7], (N_ROWS, 1))), np.random.default_rng(5), np.zeros(3))
    u = inputs(N_ROWS, gyro=gyro, accel=accel)
    u[at + age, 7:11] = told, HEADING_STD ** 2, 1, age * period
    return block.run(u, p=parameters(block, std0=STD0, heading_memory=memory, **more), sample_period=period)


def shown(block, y: np.ndarray) -> np.ndarray:
    """Yaw, vertical bias and their standard deviations of one row."""
    return np.array([output(block, y, "yaw"), output(block, y, "gyro_bias")[:, 2], *output(block, y, "std")[:, [2, 5]].T]).T


@pytest.mark.parametrize("age", [1, 2, 17, 49, 50])
def test_late_heading_tells_what_it_would_have_told_on_time(block, age):
    """One heading of a linear system: the same estimate, to second order of the standard deviations, here a few hundredths."""
    at, yaw = 120, 0.7 * H * 121 + 0.08
    on_time, late = (shown(block, turning(block, at, a, yaw)[0])[at + age] for a in (0, age))
    without = shown(block, turning(block, at, 0, yaw, q0=[1.0, 0, 0, 0])[0])[at - 1]
    assert without[2] > 2 * on_time[2], "the heading tells much"
    np.testing.assert_allclose(late[2:], on_time[2:], rtol=2e-3)
    np.testing.assert_allclose(late[:2], on_time[:2], atol=2e-3 * on_time[2])


@pytest.mark.parametrize("age", [10, 50])
def test_heading_taken_as_if_it_were_present_would_be_wrong(block, age):
    """The property above is not empty: the body has turned by many standard deviations since."""
    at, yaw = 120, 0.7 * H * 121 + 0.08
    gyro_turned = 0.7 * H * age
    on_time = shown(block, turning(block, at, 0, yaw)[0])[at + age]
    present = shown(block, turning(block, at + age, 0, yaw)[0])[at + age]
    assert abs(present[0] - on_time[0]) > gyro_turned / 2


def test_late_heading_on_a_gyro_without_errors_is_exact(block):
    """No noise and no bias between: the correction is that of the yaw then, whatever the age."""
    quiet = attitude_ukf(part(0, 0, 0))
    u = inputs(N_ROWS, gyro=np.array([0.0, 0.0, 2.9]), accel=np.full(3, 50.0))
    p = parameters(quiet, std0=np.array([1e-9, 1e-9, 0.1, 1e-12, 1e-12, 1e-12]), q0=Rotation.from_euler("z", 3.0).as_quat(scalar_first=True))
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
    u[told, 7], u[told, 8], u[told, 9], u[told, 10] = yaw + HEADING_STD * rng.standard_normal(len(told)), HEADING_STD ** 2, 1, age * H
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
        assert output(block, y, "status")[row] == 16 and not np.delete(output(block, y, "status"), row).any()
        np.testing.assert_array_equal(output(block, y, "q"), output(block, plain, "q"))


def test_longer_memory_takes_older_headings():
    """Two seconds at 100 Hz are more samples than yaws are kept: between them the course is a line, exact for a constant rate."""
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
    """Under an angular acceleration a the line is off by at most a d^2/8, d being the span between two kept yaws."""
    block, acceleration = attitude_ukf(part(0, 0, 0)), 3.0
    n, span = 600, 4 * H
    rate = acceleration * H * np.arange(n)
    yaw = np.cumsum(rate) * H
    u = inputs(n, gyro=np.column_stack([np.zeros((n, 2)), rate]), accel=np.full(3, 50.0))
    p = parameters(block, std0=np.array([1e-9, 1e-9, 0.003, 1e-12, 1e-12, 1e-12]), heading_memory=63 * span)
    worst = 0.0
    for age in range(100, 108):
        v = u.copy()
        v[500, 7:11] = yaw[500 - age], 1e-12, 1, age * H
        y, _ = block.run(v, p=p)
        off = (output(block, y, "yaw")[500] - yaw[500] + np.pi) % (2 * np.pi) - np.pi
        worst = max(worst, abs(off))
    assert 0 < worst < acceleration * span ** 2 / 8 * (1 + 1e-4)


def test_late_heading_widens_no_less_than_the_gyro_since_then(block):
    """Of a perfect heading the age's white noise is left: N^2 T."""
    gyro, accel, _ = measured(drive(np.zeros((N_ROWS, 3))), np.random.default_rng(1), np.zeros(3))
    for age in (10, 40):
        u = inputs(N_ROWS, gyro=gyro, accel=accel)
        u[100 + age, 7:11] = 0.0, 0.0, 1, age * H
        y, _ = block.run(u, p=parameters(block, std0=np.array([1e-3, 1e-3, 0.05, 1e-9, 1e-9, 1e-9])))
        np.testing.assert_allclose(output(block, y, "std")[100 + age, 2], N * np.sqrt(age * H), rtol=0.02)
