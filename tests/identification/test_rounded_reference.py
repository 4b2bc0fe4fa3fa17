"""A reference whose numbers have few digits: on each it is off by the same every time."""

import numpy as np
import pytest

import pyimu
from pyimu.model.part_reader import parse_part
from pyimu.recording.quality.resolution import last_digit
from pyimu.recording.recording import Recording

H, DIGIT, NOISE = 0.01, np.radians(0.1), np.radians(0.05)


def table(seed, count, minutes=5.0):
    """Rates (n, 3) of a table that turns at ``count`` speeds, over and over, about each axis in
    turn, with ramps of half a second between and rests of two.
    """
    speeds, out = np.radians(np.random.default_rng(seed).uniform(-100.0, 100.0, count)), []
    while sum(map(len, out)) < minutes * 60 / H:
        stops = np.repeat([0.0, *speeds, 0.0], 2)
        at = np.cumsum([0.0, 2.0, *(count * (0.5, 3.0)), 0.5, 2.0])
        one = np.interp(np.arange(0.0, at[-1], H), at, stops)
        out.append(one[:, None] * np.eye(3)[len(out) % 3])
    return np.concatenate(out)


def log(seed, digit, count=3, noise=NOISE):
    rate = table(seed, count)
    noise = noise * np.random.default_rng(seed + 1).standard_normal(rate.shape)
    shown = np.rint(rate / digit) * digit if digit else rate
    time = H * np.arange(len(rate))
    return Recording.from_arrays(time=time, gyro=rate + noise, ref_rate=shown, name="table")


def test_the_last_digit_is_seen_and_the_speeds_that_somebody_set_are_none():
    rate = table(3, 3)[:, 0]
    assert last_digit(np.rint(rate / DIGIT) * DIGIT) == pytest.approx(DIGIT, rel=1e-9)
    assert last_digit(rate + 1e-9 * np.random.default_rng(1).standard_normal(len(rate))) == 0.0
    assert last_digit(np.repeat(np.radians([0.0, 10.0, 20.0, 50.0, 100.0]), 1000)) == 0.0


@pytest.mark.parametrize("seed", [12, pytest.param(23, marks=pytest.mark.long)])
def test_what_rounding_makes_is_no_effect_and_no_noise_that_follows_the_motion(seed):
    closed = pyimu.close(log(seed, DIGIT))
    assert not closed.added and closed.verdict == "clean", closed.report()
    assert any(f.kind == "reference_digits" for f in closed.quality)


def test_an_effect_larger_than_rounding_is_found_all_the_same():
    """A cubic scale factor of ten digits at the fastest speed."""
    rounded = log(13, DIGIT, count=12)
    rate = rounded.ref_rate
    bent = 10.0 * DIGIT * (rate / np.abs(rate).max()) ** 3
    gyro = rounded.gyro + bent
    closed = pyimu.close(Recording.from_arrays(time=rounded.time, gyro=gyro, ref_rate=rate))
    assert [a.effect for a in closed.added] == ["scale_factor_cubic"]


def test_digits_that_stand_and_jump_are_no_telegraph_noise():
    """A rate of sines whose digit is ten times the noise."""
    time = H * np.arange(6000)
    rate, noise = np.zeros((6000, 3)), np.random.default_rng(5).standard_normal((6000, 3))
    rate[:, 2] = np.sin(time)
    shown = np.where(rate, np.rint(rate / 0.01) * 0.01, np.nan)
    gyro = rate + 1e-3 * noise
    closed = pyimu.close(Recording.from_arrays(time=time, gyro=gyro, ref_rate=shown))
    assert not closed.added and not closed.unexplained, closed.report()


def declared(noise):
    """The part of ``log``, which hardly wanders."""
    return parse_part(f"""
name = "declared"
sample_rate = {{ value = 100, unit = "Hz" }}
[gyro]
angle_random_walk.N = {{ value = {noise * H**0.5}, unit = "rad/sqrt(s)" }}
rate_random_walk.K = {{ value = 1e-6, unit = "rad/s/sqrt(s)" }}
""")


@pytest.mark.parametrize(
    "seed, count, noise",
    [
        (31, 8, NOISE),
        pytest.param(33, 3, NOISE, marks=pytest.mark.long),
        pytest.param(33, 20, 2 * NOISE, marks=pytest.mark.long),
        (33, 20, 4 * NOISE),
    ],
)
def test_what_rounding_leaves_is_no_noise_of_the_sensor(seed, count, noise):
    """What a digit is off by stays for as long as the speed does: it was a drift, a bias of many
    levels, or what follows the rate.
    """
    closed = pyimu.close(log(seed, DIGIT, count, noise), declared(noise))
    assert closed.verdict == "clean" and not closed.added, closed.report()


@pytest.mark.parametrize("seed", [41, pytest.param(42, marks=pytest.mark.long)])
def test_a_drift_beyond_rounding_is_said_all_the_same(seed):
    """A random walk that ends some ten digits away."""
    rounded = log(seed, DIGIT)
    steps = np.random.default_rng(seed).standard_normal(rounded.gyro.shape)
    gyro = rounded.gyro + 1e-3 * np.sqrt(H) * np.cumsum(steps, axis=0)
    wanders = Recording.from_arrays(time=rounded.time, gyro=gyro, ref_rate=rounded.ref_rate)
    closed = pyimu.close(wanders, declared(NOISE))
    assert closed.verdict == "drift" or closed.added, closed.report()
