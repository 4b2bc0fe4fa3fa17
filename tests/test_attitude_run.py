"""The attitude filter over recordings: how it starts, gaps and missing columns, and what it refuses."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from test_attitude_ukf import EARTH, GRAVITY, Drive, H, N, drive, error, inputs, measured, part, rover_rate

from pyimu.attitude import attitude_ukf, run
from pyimu.errors import UserError
from pyimu.recording import Recording

BIAS = np.array([0.01, -0.02, 0.015])


def recorded(world: Drive, seed: int = 0, **more) -> Recording:
    gyro, accel, _ = measured(world, np.random.default_rng(seed), BIAS)
    return Recording.from_arrays(time=H * np.arange(len(gyro)), gyro=gyro, accel=accel, **more)


def tilt_error(result, truth: Rotation) -> np.ndarray:
    """Angle (n,) between the estimated and the true vertical."""
    up = Rotation.from_quat(result.q, scalar_first=True).apply([0, 0, 1], inverse=True)
    return np.arccos(np.clip(np.sum(up * truth.apply([0, 0, 1], inverse=True), axis=1), -1, 1))


@pytest.mark.parametrize("start", [[0.0, 0.0, 0.0], [0.0, 0.2, np.pi], [0.0, -1.4, 0.0]], ids=["level", "upside down", "nose up"])
def test_rest_levels_the_attitude_and_gives_the_bias(start):
    truth = Rotation.from_euler("ZYX", start)
    world = drive(rover_rate(3000, still=1500), truth)
    result = run(recorded(world), part())
    assert result.rest.seen and 9 < result.rest.duration < 15
    assert tilt_error(result, world.attitude).max() < 0.01
    # The mean of ten seconds, and what has walked since: four standard deviations.
    std = np.hypot(N / np.sqrt(10), 2e-4 * np.sqrt(10))
    np.testing.assert_allclose(result.gyro_bias[0], BIAS, atol=4 * std)
    np.testing.assert_allclose(np.linalg.norm(result.q, axis=1), 1, atol=1e-14)


def test_without_a_part_the_noise_at_rest_stands_for_it():
    world = drive(rover_rate(3000, still=1000))
    assert tilt_error(run(recorded(world)), world.attitude).max() < 0.01


def test_earth_rate_is_not_taken_for_bias_at_a_known_latitude():
    world = drive(np.zeros((3000, 3)), latitude=0.9)
    recording = Recording.from_arrays(time=H * np.arange(3000), gyro=world.inertial, accel=world.force)
    np.testing.assert_allclose(run(recording, part(), latitude=0.9).gyro_bias, 0, atol=1e-4 * EARTH)
    unknown = run(recording, part()).gyro_bias
    np.testing.assert_allclose(unknown[-1], EARTH * np.array([0, np.cos(0.9), np.sin(0.9)]), atol=1e-6)


def test_yaw_starts_where_it_is_told_else_at_the_recorded_heading_else_at_zero():
    world = drive(np.zeros((500, 3)))
    heading = np.full(500, -3.1)
    runs = run(recorded(world), part(), heading0=2.0), run(recorded(world, heading=heading), part()), run(recorded(world), part())
    np.testing.assert_allclose([r.euler[0, 2] for r in runs], [2.0, -3.1, 0.0], atol=1e-2)


def test_given_attitude_is_where_the_run_starts():
    q0 = Rotation.from_euler("ZYX", [1.0, 0.0, 0.0])
    result = run(recorded(drive(np.zeros((500, 3)), q0)), part(), q0=q0.as_quat(scalar_first=True))
    assert np.linalg.norm(error(result.q[:1], q0)) < 0.01


def test_given_bias_and_standard_deviations_are_where_the_run_starts():
    recording = recorded(drive(np.zeros((500, 3))))
    bias, std = np.array([1e-3, -2e-3, 3e-3]), np.array([0.3, 0.2, 0.1, 1e-6, 1e-6, 1e-6])
    result = run(recording, part(k=0), bias0=bias, std0=std)
    np.testing.assert_allclose(result.gyro_bias[0], bias, atol=1e-9)
    np.testing.assert_allclose(result.std[0, 3:], std[3:], rtol=1e-3)
    assert result.std[0, 0] <= 0.3 and result.std[0, 2] == pytest.approx(0.1, rel=1e-3)
    assert [result.parameters[f"std0[{i}]"] for i in range(1, 7)] == std.tolist()


def test_gap_widens_the_covariance_and_keeps_the_rows():
    world = drive(rover_rate(3000, still=1000))
    whole = recorded(world)
    keep = np.r_[0:1500, 1600:3000]
    cut = Recording.from_arrays(time=whole.time[keep], gyro=whole.gyro[keep], accel=whole.accel[keep])
    result = run(cut, part())
    assert len(result.time) == len(result.q) == len(keep)
    assert result.std[1500, 2] > 0.9 and result.std[1499, 2] < 0.1
    assert tilt_error(result, world.attitude[keep])[-1] < 0.02


def test_recording_without_accelerometer_is_integrated():
    world = drive(rover_rate(500))
    recording = Recording.from_arrays(time=H * np.arange(500), gyro=world.inertial)
    certain = {f"std0[{i}]": 0.0 for i in range(1, 7)}
    result = run(recording, part(0, 0), q0=np.array([1.0, 0, 0, 0]), settings=certain)
    assert np.abs(error(result.q, world.attitude)).max() < 1e-9
    np.testing.assert_array_equal(result.status, 1)
    assert not result.quasi_static.any()


def test_missing_cells_are_marked_and_survived():
    world = drive(rover_rate(2000, still=1000))
    recording = recorded(world)
    recording.gyro[1500:1503, 0] = np.nan
    recording.accel[1200:1300] = np.nan
    result = run(recording, part())
    assert np.isfinite(result.q).all() and np.sum(result.status & 1) == 103
    assert "103 samples" in result.report()


def test_run_is_the_block_on_the_recordings_columns():
    recording = recorded(drive(rover_rate(300)))
    block = attitude_ukf(part())
    result = run(recording, part(), settings={f"std0[{i}]": 0.02 for i in range(1, 7)} | {"bias0[1]": 0.0},
                 q0=np.array([1.0, 0, 0, 0]))
    p = block.start.copy()
    for i, v in enumerate(block.parameters):
        p[i] = 0.02 if v.name.startswith("std0") else p[i]
    assert not result.rest.seen
    y, _ = block.run(inputs(300, gyro=recording.gyro, accel=recording.accel), p=p)
    np.testing.assert_allclose(result.q, y[:, :4], atol=1e-12)


def test_what_cannot_be_used_is_refused_with_its_reason():
    recording = recorded(drive(np.zeros((200, 3))))
    with pytest.raises(UserError, match="latitude is 52.0 rad"):
        run(recording, part(), latitude=52.0)
    with pytest.raises(UserError, match="q0 is"):
        run(recording, part(), q0=np.zeros(4))
    with pytest.raises(UserError, match="bias0 is .* expected 3 finite numbers"):
        run(recording, part(), bias0=[0.1, np.nan, 0.0])
    with pytest.raises(UserError, match="std0 is .* expected 6 finite numbers"):
        run(recording, part(), std0=np.ones(3))
    with pytest.raises(UserError, match="unknown setting 'gravty'"):
        run(recording, part(), settings={"gravty": 9.8})
    with pytest.raises(UserError, match="no gyro"):
        run(Recording.from_arrays(time=np.arange(5.0), accel=np.full((5, 3), GRAVITY)), part())
