"""The course of a vehicle from its positions: smoothing, speed, mounting."""

import numpy as np
import pytest
import vehicle_drives
from scipy.integrate import cumulative_simpson
from scipy.spatial.transform import Rotation

from pyimu.recording.recording import Recording
from pyimu.recording.reference.course import course_of
from pyimu.recording.reference.rate import reference_rate
from pyimu.recording.reference.smoother import Smooth, _smooth, smoothed
from pyimu.recording.reference.track import Track

NOISE = 0.02


@pytest.fixture(scope="module")
def drive():
    return vehicle_drives.figure_eight(3)


def recording(drive, noise=NOISE, seed=1, mounting=None, **more):
    mounting = np.eye(3) if mounting is None else mounting
    gyro, accel = vehicle_drives.measured_by(drive, mounting, 0.0, seed)
    north, east = vehicle_drives.received(drive, noise, seed)
    return Recording.from_arrays(
        time=drive.time, gyro=gyro, accel=accel, ref_north=north, ref_east=east, **more
    )


def kriged(time, values, ratio, at):
    """Mean of a parabola and a twice integrated Wiener process of intensity ``ratio`` behind
    ``values`` with unit noise: the covariance of the process is the integral of
    (s - u)^2 (t - u)^2 / 4 over u up to the lesser of s and t.
    """

    def covariance(s, t):
        low, gap = np.minimum(s[:, None], t), np.abs(s[:, None] - t)
        return ratio / 4 * (low**5 / 5 + low**4 * gap / 2 + low**3 * gap**2 / 3)

    def trend(t):
        return np.column_stack([np.ones_like(t), t, t**2])

    inverse = np.linalg.inv(covariance(time, time) + np.eye(len(time)))
    x = trend(time)
    b = np.linalg.solve(x.T @ inverse @ x, x.T @ inverse @ values)
    return trend(at) @ b + covariance(at, time) @ inverse @ (values - x @ b)


def test_smoothing_is_the_mean_of_what_the_noisy_values_leave_open():
    """At uneven times, at and between the samples; dense algebra against the recursion."""
    rng = np.random.default_rng(2)
    time = np.cumsum(rng.uniform(0.05, 0.3, 40))
    values = np.sin(time)[:, None] + 0.1 * rng.standard_normal((40, 1))
    smooth = Smooth(time, *_smooth(time, values, 30.0))
    at = np.sort(np.concatenate([time, rng.uniform(time[0], time[-1], 60)]))
    # What is known of the first state, 1e10 times worse than the noise, and rounding of that.
    np.testing.assert_allclose(
        smooth.at(at)[0][:, 0], kriged(time, values[:, 0], 30.0, at), atol=1e-5
    )
    step = 1e-5
    for k in (0, 1):
        low, high = (smooth.at(at[1:-1] + s * step)[k] for s in (-1, 1))
        slope = smooth.at(at[1:-1])[k + 1]
        np.testing.assert_allclose((high - low) / (2 * step), slope, rtol=1e-4, atol=1e-3)


def test_the_noise_of_positions_is_found(drive):
    """Some 1,600 samples in two directions: the variance is known to sqrt(2 / 3200), its root to
    1.8 %, of which five.
    """
    north, east = vehicle_drives.received(drive, NOISE, 5)
    seen = np.isfinite(north)
    _, noise = smoothed([(drive.time[seen], np.column_stack([east, north])[seen])])
    assert noise == pytest.approx(NOISE, rel=0.09)


@pytest.mark.parametrize("held", [False, True])
def test_course_rate_is_that_of_the_drive_and_nothing_at_a_stand(drive, held):
    """Its error is at most what the smoother claims, whose third derivative is white while the
    drive is smoother than that.
    """
    log = recording(drive)
    if held:  # as a logger writes that repeats the last position it has
        last = 10 * (np.arange(len(log.time)) // 10)
        log = Recording.from_arrays(
            time=log.time, gyro=log.gyro, ref_north=log.ref_north[last], ref_east=log.ref_east[last]
        )
    found = course_of(log)
    known = np.isfinite(found.rate)
    error = found.rate[known] - drive.rate[known]
    assert np.sqrt(np.mean(error**2)) < np.sqrt(np.mean(found.std[known] ** 2)) < 0.2
    assert not known[drive.speed < 0.02].any() and known[drive.speed > 1.0].mean() > 0.99
    turn = np.exp(1j * (found.course - drive.course)[known])
    assert abs(np.angle(turn.mean())) < 0.01


def test_velocity_gives_the_course_as_well(drive):
    rng = np.random.default_rng(7)
    velocity = np.full((len(drive.time), 3), np.nan)
    along = drive.speed[:, None] * np.column_stack([np.cos(drive.course), np.sin(drive.course)])
    velocity[::10] = np.column_stack([along, 0 * drive.time])[::10]
    velocity[::10] += 0.03 * rng.standard_normal(velocity[::10].shape)
    found = course_of(Recording.from_arrays(time=drive.time, ref_velocity=velocity))
    known = np.isfinite(found.rate)
    error = found.rate[known] - drive.rate[known]
    # Errors hang together over about a second: the RMS over some 140 s scatters by 6 %, times five.
    assert np.sqrt(np.mean(error**2)) < 1.3 * np.sqrt(np.mean(found.std[known] ** 2))
    # Of a position as bad as that of a receiver without corrections nothing is taken
    both = recording(drive, noise=2.0, ref_velocity=velocity)
    np.testing.assert_array_equal(course_of(both).rate, found.rate)


@pytest.mark.parametrize("angles", [(0, 0, 0), (180, 0, 50), (3, -5, 170), (0, 90, 0), (-87, 0, 9)])
def test_the_axis_nearest_to_the_vertical_carries_the_course(drive, angles):
    mounting = Rotation.from_euler("xyz", angles, degrees=True).as_matrix()
    log = recording(drive, mounting=mounting)
    reference = reference_rate(log)
    up = mounting[:, 2]
    assert reference.kind == "course"
    # Acceleration noise of 0.05 and what the eights leave of their own mean, of 9.8 m/s^2.
    np.testing.assert_allclose(reference.up, up, atol=0.02)
    axis = int(np.argmax(np.abs(up)))
    known = np.isfinite(reference.rate)
    assert known.any(axis=0).tolist() == [i == axis for i in range(3)]
    gain = np.polyfit(reference.rate[known[:, axis], axis], log.gyro[known[:, axis], axis], 1)[0]
    assert gain == pytest.approx(1.0, abs=0.05)
    (found,) = [f for f in reference.findings if f.kind == "mounted"]
    assert found.detail["points"] == ("up" if up[axis] > 0 else "down")
    assert found.column == f"gyro_{'xyz'[axis]}"


def test_a_position_that_jumps_and_comes_back_is_left_out(drive):
    log = recording(drive)
    north = log.ref_north.copy()
    north[8000] += 3.0
    log = Recording.from_arrays(
        time=log.time, gyro=log.gyro, accel=log.accel, ref_north=north, ref_east=log.ref_east
    )
    reference = reference_rate(log)
    assert any(f.kind == "reference_spikes" for f in reference.findings)
    assert np.isnan(reference.rate[7990:8010]).all()
    assert np.isfinite(reference.rate[7800, 2]) or drive.speed[7800] < 0.5


@pytest.mark.parametrize("axis, sign", [(2, -1.0), (0, 1.0), (1, -1.0)])
def test_without_accelerometer_the_axis_is_the_one_that_turns(drive, axis, sign):
    up = sign * np.eye(3)[axis]
    turn = Rotation.align_vectors([up], [[0.0, 0.0, 1.0]])[0].as_matrix()
    gyro, _ = vehicle_drives.measured_by(drive, turn, 0.7, 1)
    north, east = vehicle_drives.received(drive, NOISE, 1)
    log = Recording.from_arrays(time=drive.time, gyro=gyro + 0.02, ref_north=north, ref_east=east)
    np.testing.assert_array_equal(reference_rate(log).up, up)


def test_turns_that_the_receiver_hardly_resolves_are_no_noise():
    """Positions of 1 Hz and 0.5 m at 12 m/s: the likelihood alone takes the turns for noise."""
    fast = vehicle_drives.figure_eight(21, seconds=400.0, fast=12.0)
    north, east = vehicle_drives.received(fast, 0.5, 1, every=100)
    found = course_of(Recording.from_arrays(time=fast.time, ref_north=north, ref_east=east))
    known = np.isfinite(found.rate)
    assert found.noise < 1.5
    error = np.std(found.rate[known] - fast.rate[known])
    assert error < 0.5 * np.std(fast.rate[known])


@pytest.mark.parametrize("every", [1, 10])
def test_positions_without_noise_keep_their_course(every):
    """They were smoothed by all they may be, as no smoothing leaves as little as they have noise:
    turns came out a twentieth too slow. A spline of fifth degree through 10 Hz of a turn of 0.45
    rad/s that comes and goes in a second is right to 1e-3.
    """
    time = np.arange(0, 60, 0.01)
    rate = 0.45 * np.sin(2 * np.pi * time / 10) ** 3
    heading = cumulative_simpson(rate, x=time, initial=0)
    way = np.column_stack([np.cos(heading), np.sin(heading)]) * 10.0
    east, north = cumulative_simpson(way, x=time, axis=0, initial=0).T
    seen = np.arange(len(time)) % every == 0
    log = Recording.from_arrays(
        time=time, ref_east=np.where(seen, east, np.nan), ref_north=np.where(seen, north, np.nan)
    )
    found = course_of(log, time).rate
    known = np.isfinite(found)
    assert known.sum() > 0.9 * len(time)
    np.testing.assert_allclose(
        found[known] @ rate[known] / np.sum(rate[known] ** 2), 1.0, atol=1e-3
    )


def test_a_place_that_never_changes_has_no_spikes():
    """Its steps are zero, and so is the largest of them and what they are measured by."""
    time, place = np.arange(200) / 50.0, np.zeros((200, 3))
    track = Track(time, np.arange(200), lambda n: np.diff(place[n], axis=0), 0.0)
    assert not track.findings and [len(nodes) for nodes in track.segments] == [200]
