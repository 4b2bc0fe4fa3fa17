"""A constant speed is told from a rest by what comes before it and after it."""

import numpy as np
import pytest

from pyimu.ins.detector import Noise, detect
from pyimu.ins.speeds import driven
from pyimu.recording.clock import runs

H = 0.01
NOISE = Noise(np.full(3, 0.02), np.full(3, 0.05), np.zeros(3), np.array([0.01, 0.02, -0.01]))


def driving(pushes, seconds, seed=0, turns=()):
    """Rates and forces with ``pushes`` (start s, seconds, m/s^2) along x, as raised cosines, and
    ``turns`` (start s, seconds, rad) about z.
    """
    rng, n = np.random.default_rng(seed), round(seconds / H)
    time = H * np.arange(n)
    gyro = NOISE.bias + NOISE.rate * rng.standard_normal((n, 3))
    accel = np.array([0.3, -0.2, 9.7]) + NOISE.force * rng.standard_normal((n, 3))
    for start, long, size in pushes:
        accel[:, 0] += size * raised((time - start) / long)
    for start, long, angle in turns:
        gyro[:, 2] += angle / (long / 2) * raised((time - start) / long)
    return time, gyro, accel


def raised(t):
    return np.where((t > 0) & (t < 1), 0.5 - 0.5 * np.cos(2 * np.pi * t), 0.0)


def found(time, gyro, accel):
    """Which stretches look still, and which of them are driven."""
    still = detect(time, gyro, accel, NOISE, H).still
    return runs(still), driven(time, gyro, accel, still, NOISE, H)


def test_a_constant_speed_between_two_rests_is_driven():
    """0.4 m/s for 6 s, which come and go within 0.8 s: 0.4 m/s is 40 times what is unknown."""
    log = driving([(5.0, 0.8, 1.0), (12.0, 0.8, -1.0)], 20.0)
    stretches, moves = found(*log)
    assert len(stretches) == 3 and moves == [stretches[1]]


def test_speeds_that_follow_each_other_are_driven_until_all_is_gone():
    pushes = [(5.0, 0.8, 1.0), (8.0, 0.8, 0.6), (11.0, 0.8, -0.7), (14.0, 0.8, -0.9)]
    stretches, moves = found(*driving(pushes, 24.0))
    assert len(stretches) == 5 and moves == stretches[1:4]


def test_a_change_of_velocity_that_nothing_takes_back_is_left_to_the_filter():
    """An accelerometer that misses a part of a blow: the body rests, and so it does after each of
    two drives with stops.
    """
    drives = [(14.0, 0.8, 1.0), (16.0, 0.8, -1.0), (21.0, 0.8, 1.0), (23.0, 0.8, -1.0)]
    stretches, moves = found(*driving([(8.0, 0.2, 2.0), *drives], 30.0))
    rests = [s for s in stretches if s not in moves]
    middles = [H * (a + b) / 2 for a, b in rests]
    assert any(9 < m < 14 for m in middles)
    assert any(17 < m < 21 for m in middles) and any(24 < m for m in middles)
    assert not any(14.8 < m < 16 or 21.8 < m < 23 for m in middles)


@pytest.mark.parametrize("first, second", [(0.09, -0.10), (0.13, -0.20)])
def test_a_speed_that_is_lost_in_its_error_is_driven_where_the_next_change_takes_it_back(
    first, second
):
    """Of changes within 2 s, known to 0.019 m/s each and together to 0.034, the first may be below
    the gate of 0.10 m/s, or more than half of it may be left: 0.07 m/s of 0.13. Before, either
    stretch was a rest."""
    time = H * np.arange(1600)
    gyro, accel = np.tile(NOISE.bias, (1600, 1)), np.tile([0.3, -0.2, 9.7], (1600, 1))
    seconds = (2.0, 0.6) if second == -0.10 else (2.0, 2.0)
    at = np.cumsum([5.0, seconds[0], 3.0, seconds[1]])
    for start, size, long in zip(at[::2], (first, second), seconds, strict=True):
        accel[:, 0] += size / long * ((time >= start) & (time < start + long))
    rests = [(0.0, at[0]), (at[1], at[2]), (at[3], 16.0)]
    still = np.any([(time >= a) & (time < b) for a, b in rests], axis=0)
    assert driven(time, gyro, accel, still, NOISE, H) == [runs(still)[1]]


def test_a_log_that_ends_while_it_drives_ends_without_a_rest():
    stretches, moves = found(*driving([(5.0, 0.8, 1.0)], 10.0))
    assert len(stretches) == 2 and moves == [stretches[1]]


@pytest.mark.parametrize("seed", range(8))
def test_rests_between_drives_and_turns_stay_rests(seed):
    """Stops of 3 s after moves of up to 3 s, at which every velocity is zero. What the noise makes
    of one is above the gate with a probability of 1e-5.
    """
    rng = np.random.default_rng(100 + seed)
    pushes, turns, at, rests = [], [], 6.0, [(0.0, 6.0)]
    for k in range(6):
        long = rng.uniform(0.6, 1.2)
        if k % 2:
            turns.append((at, 2 * long, rng.choice([-1, 1]) * np.pi / 2))
        else:
            size = rng.uniform(0.5, 1.5)
            pushes += [(at, long, size), (at + long, long, -size)]
        rests.append((at + 2 * long, at + 2 * long + 3.0))
        at += 2 * long + 3.0
    stretches, moves = found(*driving(pushes, at, seed, turns))
    kept = [H * (a + b) / 2 for a, b in stretches if (a, b) not in moves]
    assert len(kept) == 7
    assert all(a < middle < b for middle, (a, b) in zip(kept, rests, strict=True))


@pytest.mark.parametrize("seed", range(4))
def test_the_variance_of_a_change_is_not_below_that_of_its_noise(seed):
    """Of a body that rests all along, over 80 stretches of 2 s that are left out. The gate is that
    of chi-square with three degrees at 28, 4e-6.
    """
    time, gyro, accel = driving([], 400.0, seed)
    still = (np.arange(len(time)) % 500) >= 200
    assert not driven(time, gyro, accel, still, NOISE, H)


def test_missing_samples_between_two_stretches_tell_nothing():
    time, gyro, accel = driving([(5.0, 0.8, 1.0), (12.0, 0.8, -1.0)], 20.0)
    accel[530:532] = np.nan
    accel[1230:1232] = np.nan
    stretches, moves = found(time, gyro, accel)
    assert len(stretches) == 3 and not moves
