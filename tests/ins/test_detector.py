"""Rest from the samples: the rate of false alarms is the stated one, a steady turn is no rest."""

import numpy as np
import pytest
from navigation_cases import SHORT, assumed
from scipy.stats import binom

from pyimu.ins.detector import detect, ratio, threshold
from pyimu.ins.noise import Noise
from pyimu.recording.clock import runs
from pyimu.rover.trajectory import motion, stop_times

H = 0.01
NOISE = Noise(np.full(3, 0.02), np.full(3, 0.05), np.zeros(3), np.array([0.01, 0.02, -0.01]))


def resting(n, seed=0):
    rng = np.random.default_rng(seed)
    gyro = NOISE.bias + NOISE.rate * rng.standard_normal((n, 3))
    accel = np.array([0.3, -0.2, 9.7]) + NOISE.force * rng.standard_normal((n, 3))
    return H * np.arange(n), gyro, accel


@pytest.mark.parametrize("alarm", (0.01, 0.1))
def test_windows_at_rest_are_above_the_threshold_as_often_as_stated(alarm):
    """Windows without common samples; the count is binomial, 99.9 % of which is allowed."""
    rows, n = 25, 100_000
    _, gyro, accel = resting(n)
    apart = ratio(gyro, accel, NOISE, rows)[rows : n - rows : rows]
    count = int(np.sum(apart > threshold(rows, alarm)))
    low, high = binom.ppf([0.0005, 0.9995], len(apart), alarm)
    assert low <= count <= high


def test_a_steady_turn_is_no_rest_and_is_said_to_be_one():
    time, gyro, accel = resting(3000)
    gyro[1000:2000, 2] += 0.3
    found = detect(time, gyro, accel, NOISE, H)
    assert not found.still[1000:2000].any()
    assert found.still[100:900].all() and found.still[2100:2900].all()
    assert len(found.steady) == 1


def test_a_bias_that_walks_stays_a_rest():
    time, gyro, accel = resting(60_000)
    gyro += np.cumsum(np.random.default_rng(1).normal(size=gyro.shape), axis=0) * 1e-4 * 0.1
    moving = slice(30_000, 30_500)
    accel[moving] += np.random.default_rng(2).normal(size=(500, 3))
    walking = Noise(NOISE.rate, NOISE.force, np.full(3, 1e-4), NOISE.bias)
    found = detect(time, gyro, accel, walking, H)
    assert found.still[40_000:50_000].mean() > 0.9
    assert not found.still[moving].any()


def test_it_finds_the_stops_of_a_drive_and_no_row_of_a_move():
    truth = motion(SHORT)
    log = assumed().specimen(4).simulate(truth, seed=4)
    rest = log.time < 4
    noise = Noise(
        log.gyro[rest].std(axis=0),
        log.accel[rest].std(axis=0),
        np.full(3, 5e-5),
        log.gyro[rest].mean(axis=0),
    )
    still = detect(log.time, log.gyro, log.accel, noise, log.sample_period).still
    assert not np.any(still & (np.linalg.norm(truth.ref_velocity, axis=1) > 1e-3))
    assert not np.any(still & (np.abs(truth.ref_rate[:, 2]) > 1e-2))
    assert len(runs(still)) == len(stop_times(SHORT))


def test_a_steady_push_is_no_rest():
    """A body that speeds up by 0.5 m/s^2 for seconds, as evenly as if it stood: 17 times what an
    accelerometer's error changes by. One that stands askew after it has tilted by 3 degrees shows
    as much, and rests.
    """
    time, gyro, accel = resting(4000)
    accel[1000:1500, 0] += 0.5
    accel[1500:2000, 0] -= 0.5
    tilt = np.radians(3.0)
    gyro[2500:2510, 1] += tilt / 0.1
    accel[2510:, 0] -= 9.7 * np.sin(tilt)
    found = detect(time, gyro, accel, NOISE, H)
    assert not found.still[1000:2000].any()
    assert found.still[100:900].all() and found.still[2100:2400].all()
    assert found.still[2600:3900].all() and not found.steady


def test_a_gentle_drive_between_two_rests_is_none():
    """A raised cosine of 0.3 m/s^2 over 6 s changes the force within a window by less than its
    noise; it stands out of the means. Where the drive begins and ends, and in its middle, the force
    is that at rest to the gate, the root of 28 (0.01^2 + 2 0.05^2 / 30): 0.09 m/s^2.
    """
    time, gyro, accel = resting(3600)
    drive = slice(1500, 2100)
    push = 0.3 * np.sin(2 * np.pi * np.arange(600) / 600)
    accel[drive, 0] += push
    found = detect(time, gyro, accel, NOISE, H)
    assert not found.still[drive][np.abs(push) > 0.1].any()
    assert not found.still[1650:1950].any()  # nor at full speed
    assert found.still[100:1400].all() and found.still[2200:3500].all()


def test_a_gentle_turn_between_two_rests_is_none_and_they_stay():
    """0.2 rad/s that come and go over 8 s: no window shows them, and the mean over all is no bias.
    A tilted accelerometer feels it, too, so that the force of the second rest is another. A mean
    over 0.3 s is off the bias by its gate at 0.02 rad/s.
    """
    time, gyro, accel = resting(3600)
    turn = slice(1200, 2000)
    rate = 0.1 * (1 - np.cos(2 * np.pi * np.arange(800) / 800))
    gyro[turn, 2] += rate
    angle = np.cumsum(rate) * H
    accel[turn, 0] += 0.3 * np.sin(angle)
    accel[2000:, 0] += 0.3 * np.sin(angle[-1])
    found = detect(time, gyro, accel, NOISE, H)
    assert not found.still[turn][rate > 0.03].any() and found.steady
    assert found.still[100:1100].all() and found.still[2150:3500].all()


def test_a_run_that_begins_in_a_push_keeps_its_rest():
    """It ends at 3 s, and a window that looked still begins in its last second."""
    time, gyro, accel = resting(2400)
    accel[300:900, 0] += 0.3 * np.sin(np.pi * np.arange(600) / 600)
    accel[300:700] += np.random.default_rng(3).normal(size=(400, 3))
    found = detect(time, gyro, accel, NOISE, H)
    assert not found.still[300:850].any() and found.still[1000:2300].all()


def test_a_force_that_wanders_over_minutes_stays_a_rest():
    """An accelerometer that warms up, by 0.1 m/s^2 in ten minutes."""
    time, gyro, accel = resting(60_000)
    accel[:, 2] += 0.1 * (1 - np.exp(-time / 200.0))
    assert detect(time, gyro, accel, NOISE, H).still[100:-100].mean() > 0.99


def test_a_body_that_turned_far_rests_in_any_attitude():
    """An accelerometer of 80 mg, turned over between two rests: its error keeps its axis while
    gravity does not.
    """
    time, gyro, accel = resting(3000)
    half = np.linspace(0.0, np.pi, 200)
    gyro[1000:1200, 0] += np.pi / 2.0 * 1.02  # over in two seconds, by a gyro 2 % off
    bias = np.array([0.3, -0.2, 0.8])
    gravity = np.array([0.0, 0.0, 9.8])
    noise = accel - accel.mean(axis=0)
    turned = np.stack([0 * half, 9.8 * np.sin(half), 9.8 * np.cos(half)], axis=1)
    accel[:] = gravity + bias
    accel[1000:1200] = turned + bias
    accel[1200:] = turned[-1] + bias
    found = detect(time, gyro, accel + noise, NOISE, H)
    assert found.still[100:900].all() and found.still[1300:2900].all()


@pytest.mark.parametrize("seed", range(4))
def test_a_turn_that_grows_in_short_even_stretches_takes_no_bias_along(seed):
    """Of 0.8 s each, and faster by 10 mrad/s each time: 4.5 standard deviations of its own mean,
    which is no more than passes for a rest. What is known of the bias by 15 s of rest stays, and
    the fourth stretch is 17 off it, as is the rest after them where the bias follows each.
    """
    time, gyro, accel = resting(4000, seed)
    shaken = np.random.default_rng(50 + seed).normal(size=(4000, 3))
    moves = np.zeros(4000, dtype=bool)
    moves[1500:2400] = True
    for k in range(4):
        even = slice(1600 + 200 * k, 1680 + 200 * k)
        moves[even] = False
        gyro[even, 2] += 0.010 * (k + 1)
    accel[moves] += shaken[moves]
    found = detect(time, gyro, accel, NOISE, H)
    assert not found.still[2200:2280].any()
    assert found.still[2450:3950].mean() > 0.95


def shaken(accel, first, stop, seed):
    accel[first:stop] += np.random.default_rng(100 + seed).normal(size=(stop - first, 3))


@pytest.mark.parametrize("seed", range(4))
def test_a_rest_before_a_turn_that_no_window_shows_stays(seed):
    """12 mrad/s: 3 standard deviations of a block's mean, and 13 of that of rest and turn together,
    for which both were taken for a turn."""
    time, gyro, accel = resting(3000, seed)
    shaken(accel, 1500, 1700, seed)
    gyro[2100:2700, 2] += 0.012
    shaken(accel, 2700, 3000, seed)
    found = detect(time, gyro, accel, NOISE, H)
    assert found.still[1750:2000].all()
    assert found.still[2150:2650].mean() < 0.1
    assert len(found.steady) == 1


def test_a_rest_is_told_by_the_middle_of_what_most_of_a_stretch_has():
    """A stretch of alike forces may begin in the end of a push, here 0.06 m/s^2 that is within the
    limit of 0.073: beside it a rest at 0.015 m/s^2 to the other side was a push."""
    push = [-0.015] * 9 + [0.1, 0.16, 0.2, 0.2, 0.16, 0.1, 0.06] + [0.0] * 8
    push += [-0.1, -0.16, -0.2, -0.2, -0.16, -0.1] + [0.0] * 13
    accel = np.array([0.3, -0.2, 9.7]) + np.repeat(push, 30)[:, None] * [1.0, 0.0, 0.0]
    time, gyro = H * np.arange(len(accel)), np.tile(NOISE.bias, (len(accel), 1))
    found = detect(time, gyro, accel, NOISE, H)
    assert found.still[30:240].all() and found.still[-360:-20].all()


def test_missing_samples_are_no_rest():
    time, gyro, accel = resting(1000)
    accel[500] = np.nan
    found = detect(time, gyro, accel, NOISE, H)
    assert not found.still[495:505].any() and found.still[100:400].all()
