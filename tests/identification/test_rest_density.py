"""The density of a sensor's white noise beside a reference attitude, as its rests show it."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import butter, lfilter
from scipy.spatial.transform import Rotation, RotationSpline

import pyimu
from pyimu.identification.fit.sample_noise import (
    CORRELATED,
    quiet_noise,
    rest_density,
    rest_noise,
)
from pyimu.identification.fit.trials import gyro_trial
from pyimu.recording.recording import Recording

H, N = 0.002, 1e-4
TIME = np.arange(0.0, 40.0, H)


def log(seed, bandwidth=None, rest=10.0):
    """A gyro that rests for ``rest`` s, then turns, behind a low-pass filter of ``bandwidth``
    Hz.
    """
    rng = np.random.default_rng(seed)
    fade = np.clip((TIME - rest) / 2.0, 0.0, 1.0)[:, None]
    angle = np.sin(2 * np.pi * TIME[:, None] * rng.uniform(0.2, 1.0, 3) + rng.uniform(0, 6, 3))
    attitude = RotationSpline(TIME, Rotation.from_rotvec(0.5 * fade**2 * angle))
    gyro = attitude(TIME, 1) + N / H**0.5 * rng.standard_normal((len(TIME), 3))
    if bandwidth:
        gyro = lfilter(*butter(2, 2 * H * bandwidth), gyro, axis=0)
    optical = attitude(TIME) * Rotation.from_rotvec(1e-4 * rng.standard_normal((len(TIME), 3)))
    return Recording.from_arrays(
        name="log", time=TIME, gyro=gyro, ref_q=optical.as_quat(scalar_first=True)
    )


@pytest.mark.long
@pytest.mark.parametrize("bandwidth, least", [(None, 0.9), (42.0, 0.75), (20.0, 0.7)])
def test_white_noise_behind_a_low_pass_filter_keeps_its_density(bandwidth, least):
    """A filter hides it from differences of neighbouring samples. Where the means of the longest
    are few, less than three standard errors of theirs, a fifth, are not told.
    """
    found = np.mean([rest_density(gyro_trial(log(k, bandwidth))) for k in range(4)], axis=0)
    assert np.all((least * N < found) & (found < 1.15 * N))
    if bandwidth:
        assert np.all(rest_noise(gyro_trial(log(0, bandwidth))) * H**0.5 < 0.1 * N)


def test_motion_is_not_taken_for_noise():
    trial = gyro_trial(log(1, rest=0.0))
    np.testing.assert_array_equal(rest_density(trial), rest_noise(trial) * H**0.5)


@pytest.mark.parametrize("louder", [1.0, 3.0])
def test_noise_of_one_level_is_read_as_it_is(louder):
    """In twelve logs of 20 s, of which half may be louder: within four standard errors, of the
    third differences of the rest. The quietest seconds are quieter than the noise is.
    """
    rng, logs, rows = np.random.default_rng(7), 12, 2000
    level = np.where(np.arange(rows) < rows // 2, 1.0, louder)[:, None]
    found = [
        quiet_noise(level * rng.standard_normal((rows, 3)), [(0, rows)], 0.01) ** 2
        for _ in range(logs)
    ]
    taken = logs * 3 * (rows if louder == 1.0 else rows // 2)
    assert np.mean(found) == pytest.approx(1.0, abs=4 * np.sqrt(2 * CORRELATED / taken))


@pytest.mark.long
def test_the_part_has_the_density_that_its_filter_leaves():
    closed = pyimu.close(log(5, 42.0))
    assert closed.after.gyro.values["angle_random_walk"]["N"] == pytest.approx(N, rel=0.3)


def test_seconds_at_a_limit_show_no_noise():
    """Of the ten of forty in which the gyro stands at it. Third differences of the quietest second
    or more know the noise to so many standard errors.
    """
    held = np.array(log(3, rest=0.0).gyro)
    limit = np.abs(held).max()
    held[TIME < 10.0] = limit
    trial = gyro_trial(replace(log(3, rest=0.0), gyro=held))
    found = rest_noise(trial) * H**0.5 / N
    np.testing.assert_allclose(found, 1.0, atol=5 * np.sqrt(CORRELATED / 2 * H))
