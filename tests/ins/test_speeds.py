"""A constant speed is told from a rest by what comes before it and after it."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.stats import chi2

from pyimu.ins.between import change_of_velocity
from pyimu.ins.detector import detect
from pyimu.ins.noise import Noise
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
    return runs(still), driven(time, gyro, accel, still, NOISE, H)[0]


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
    assert driven(time, gyro, accel, still, NOISE, H)[0] == [runs(still)[1]]


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
    assert not driven(time, gyro, accel, still, NOISE, H)[0]


def test_missing_samples_between_two_stretches_tell_nothing():
    time, gyro, accel = driving([(5.0, 0.8, 1.0), (12.0, 0.8, -1.0)], 20.0)
    accel[530:532] = np.nan
    accel[1230:1232] = np.nan
    stretches, moves = found(time, gyro, accel)
    assert len(stretches) == 3 and not moves


SPEED, ANGLE = 0.5, 1.5
"""m/s and rad; of a vehicle that drives on through a turn."""


def turning(null=(0.3, -0.4, 0.0), gain=0.01):
    """A vehicle without vibration: it speeds up, turns at its speed, and stops; by an accelerometer
    with a ``null`` m/s^2 and a gyro whose axis z is in x by ``gain``. Times, rates, forces, and
    marks of what looks still.
    """
    time = H * np.arange(2600)
    rate = ANGLE / 2 * raised((time - 10) / 4)
    push = SPEED * (raised((time - 5) / 1) - raised((time - 20) / 1)) / 0.5
    speed = np.cumsum(push) * H
    force = np.stack([push, speed * rate, np.full(len(time), 9.80665)], axis=1) + null
    gyro = NOISE.bias + np.stack([gain * rate, 0 * rate, rate], axis=1)
    moves = (5, 6), (10, 14), (20, 21)
    still = ~np.any([(time > a - H) & (time < b + H) for a, b in moves], axis=0)
    return time, gyro, force, still


def test_a_speed_that_goes_on_through_a_turn_is_no_rest():
    """An accelerometer's null of 50 mg turns with the body, and hid 2 m/s of what a turn shows. The
    two ends of the turn tell it."""
    time, gyro, accel, still = turning()
    assert driven(time, gyro, accel, still, NOISE, H)[0] == runs(still)[1:3]


def test_the_change_in_a_turn_is_known_beside_null_and_misalignment():
    """Its size and its variance: by a tenth of the speed that the turn turns, which with the null
    of the whole turn would be 1 m/s."""
    time, gyro, accel, still = turning()
    first, second = (
        SimpleNamespace(rate=gyro[a:b].mean(axis=0), force=accel[a:b].mean(axis=0), rows=b - a)
        for a, b in runs(still)[1:3]
    )
    rows = slice(*(f(runs(still)[i]) for i, f in ((1, max), (2, min))))
    found = change_of_velocity(gyro[rows], accel[rows], (first, second), NOISE, H)
    truth = SPEED * np.array([np.cos(ANGLE) - 1, np.sin(ANGLE), 0])
    off = found.velocity - truth
    assert off @ off < chi2.isf(1e-4, 3) * found.variance
    assert found.variance < 0.1**2


def test_what_is_pushed_for_a_moment_is_no_rest():
    """The even middle of a long push, as still as a rest: its force is none of the rests'."""
    time = H * np.arange(2000)
    push = 0.5 * (((time > 5) & (time < 9)).astype(float) - ((time > 12) & (time < 16)))
    accel = np.stack([push, 0 * push, 9.80665 + 0 * push], axis=1)
    gyro = np.tile(NOISE.bias, (len(time), 1))
    middles = [(0, 4.9), (6.5, 7.5), (9.1, 11.9), (13.5, 14.5), (16.1, 20)]
    still = np.any([(time >= a) & (time < b) for a, b in middles], axis=0)
    assert driven(time, gyro, accel, still, NOISE, H)[0] == runs(still)[1:4]
