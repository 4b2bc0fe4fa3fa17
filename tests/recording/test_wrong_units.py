"""A header that states another unit than the numbers are in is told, of short logs too; one that is
right is left alone.
"""

from dataclasses import replace

import numpy as np
import pytest

from pyimu import Recording, inspect, read_recording
from pyimu.recording.guess.gravity_turning import LIKE, turning_of_gravity
from pyimu.recording.quality.gyro_axes import gyro_findings
from pyimu.recording.quality.inspect import inspect as of_samples
from pyimu.recording.quality.vehicle_turns import speed_in_turns

DEGREE = 180 / np.pi
H = 0.01


def hand(seed: int, seconds: float, push: float) -> Recording:
    """A hand that turns a sensor about all axes and pushes it by ``push`` m/s^2."""
    rng, n = np.random.default_rng(seed), round(seconds / H)
    time = H * np.arange(n)
    omega, phase = 2 * np.pi * rng.uniform(0.1, 1.0, (2, 3)), rng.uniform(0, 6, (2, 3))
    tilt, pushed = np.sin(omega[:, None] * time[:, None] + phase[:, None])
    roll, pitch, _ = (tilt * [0.8, 0.6, 0]).T
    zero = np.zeros(n)
    turning = np.gradient(np.stack([roll, pitch, zero]), H, axis=1)
    # R = Ry(pitch) Rx(roll): what turns in pitch is seen in the axes that roll
    gyro = np.stack([turning[0], np.cos(roll) * turning[1], -np.sin(roll) * turning[1]], axis=1)
    up = [-np.sin(pitch), np.cos(pitch) * np.sin(roll), np.cos(pitch) * np.cos(roll)]
    return Recording.from_arrays(
        time=time,
        gyro=gyro + [0.01, -0.02, 0.015] + rng.normal(0, 1e-3, (n, 3)),
        accel=9.81 * np.stack(up, axis=1) + push * pushed + rng.normal(0, 0.02, (n, 3)),
    )


@pytest.mark.parametrize("seconds, push", [(15, 1.0), (30, 1.0), (30, 3.0)])
@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("factor", [1.0, DEGREE, 1 / DEGREE])
def test_the_unit_of_a_gyro_in_a_short_log(seconds, push, seed, factor):
    right = hand(seed, seconds, push)
    found = gyro_findings(replace(right, gyro=right.gyro * factor))
    assert [f.detail["factor"] for f in found] == pytest.approx([] if factor == 1 else [factor])


@pytest.mark.parametrize("seed", range(12))
def test_the_turning_of_a_log_that_rests_but_for_a_second(seed):
    """Of the means that neighbour each other nearly all are at rest then, and agree at any scale
    of the rates.
    """
    right, n, rng = hand(seed, 30, 1.0), 2900, np.random.default_rng(5)
    still = rng.normal(0, 1, (2, n, 3)) * [[[1e-3]], [[0.02]]]
    gyro = np.concatenate([still[0], right.gyro[n:]])
    accel = np.concatenate([still[1] + right.accel[n], right.accel[n:]])
    assert 1 / LIKE < turning_of_gravity(gyro, accel, H) < LIKE


def test_a_vehicle_that_hardly_pitches_has_no_gyro_that_is_too_small():
    """It pitches by 0.3 deg when it brakes at 3 m/s^2: its forces turn 57 times as far as it does,
    and at the same moments.
    """
    time = H * np.arange(6000)
    speeding = 3 * np.sin(0.5 * time)
    pitch = -0.3 / DEGREE * speeding / 3
    zero = np.zeros_like(time)
    gyro = np.stack([zero, np.gradient(pitch, H), zero], axis=1)
    accel = np.stack([speeding - 9.81 * pitch, zero, 9.81 + zero], axis=1)
    noise = np.random.default_rng(1).normal(0, 1e-5, (2, 6000, 3))
    found = Recording.from_arrays(time=time, gyro=gyro + noise[0], accel=accel + noise[1])
    assert gyro_findings(found) == ()


def driven(seed: int, speed: float, seconds: int = 400) -> Recording:
    """A vehicle that drives at about ``speed`` m/s and turns to the left and to the right."""
    rng, n = np.random.default_rng(seed), round(seconds / H)
    time = H * np.arange(n)
    v = speed * (1 + 0.3 * np.sin(0.05 * time + seed))
    knots = np.arange(0, seconds + 4, 4.0)
    yaw_rate = np.interp(time, knots, rng.normal(0, 0.6 * min(2 / speed, 0.5), len(knots)))
    zero = np.zeros(n)
    rate = np.stack([zero, zero, yaw_rate], axis=1) + rng.normal(0, 2e-3, (n, 3))
    force = np.stack([np.gradient(v, H), v * yaw_rate, 9.81 + zero], axis=1)
    return Recording.from_arrays(time=time, gyro=rate, accel=force + rng.normal(0, 0.5, (n, 3)))


@pytest.mark.parametrize("speed", [5.0, 12.0, 20.0])
@pytest.mark.parametrize("seed", range(3))
def test_a_vehicle_s_rates_are_told_by_the_force_in_its_turns(seed, speed):
    """57 times too small the speed is 57 times too large; gravity alone tells nothing of it."""
    right = driven(seed, speed)
    assert speed_in_turns(right.gyro, right.accel, H) == pytest.approx(speed, rel=0.1)
    assert gyro_findings(right) == ()
    (found,) = gyro_findings(replace(right, gyro=right.gyro / DEGREE))
    assert (found.kind, found.detail["factor"]) == ("gyro_unit", pytest.approx(1 / DEGREE))


@pytest.mark.parametrize("degrees", [0.1, 0.3])
def test_what_a_force_does_to_a_gyro_is_no_turn_of_a_vehicle(degrees):
    """A table that is tilted by 0, 15 and -15 deg, and a gyro of so many deg/s/g."""
    n = 18_000
    tilt = np.radians(np.repeat([0, 15, -15, 15, 0, -15], n // 6))
    force = 9.81 * np.stack([np.sin(tilt), 0 * tilt, np.cos(tilt)], axis=1)
    rate = np.zeros((n, 3))
    rate[:, 2] = np.radians(degrees) * force[:, 0] / 9.81
    noise = np.random.default_rng(6).normal(0, 1, (2, n, 3)) * [[[1e-4]], [[0.02]]]
    log = Recording.from_arrays(time=H * np.arange(n), gyro=rate + noise[0], accel=force + noise[1])
    assert gyro_findings(log) == ()


@pytest.mark.parametrize("lsb", [131, 65.5, 16.4, 1000 / 8.75, 1000 / 70])
def test_counts_in_radians_that_are_called_degrees_at_rest(lsb):
    """Nothing of the motion tells it: the size of a count does."""
    counts = np.rint(np.random.default_rng(8).normal(3, 0.1 * lsb, (4000, 3)))
    accel = [0, 0, 9.81] + np.random.default_rng(9).normal(0, 0.02, (4000, 3))
    for once, said in ((1.0, []), (np.radians(1.0), [1 / DEGREE])):
        stated = np.round(once * counts / lsb, 7)  # deg/s in the file
        log = Recording.from_arrays(time=H * np.arange(4000), gyro=np.radians(stated), accel=accel)
        assert [f.detail["factor"] for f in gyro_findings(log)] == pytest.approx(said)


def kinds(recording):
    return {f.kind for f in of_samples(recording)}


@pytest.mark.parametrize("factor, said", [(1.0, set()), (DEGREE, {"gyro_fast"})])
def test_rates_beyond_the_range_of_most_gyros(factor, said):
    """Without an accelerometer too; a few are spikes."""
    right = replace(hand(1, 30, 1.0), accel=None)
    assert kinds(replace(right, gyro=right.gyro * factor)) & {"gyro_fast"} == said
    spiked = right.gyro.copy()
    spiked[::1500] = 40.0
    assert "gyro_fast" not in kinds(replace(right, gyro=spiked))


@pytest.mark.parametrize("axis, said", [(0, {"gyro_at_rest"}), (2, set())])
def test_a_rate_while_gravity_stands_still(axis, said):
    """1 deg/s read as 1 rad/s; about the vertical it may be a turntable."""
    n, rng = 3000, np.random.default_rng(2)
    gyro = rng.normal(0, 1e-3, (n, 3)) + np.eye(3)[axis]
    accel = [0, 0, 9.81] + rng.normal(0, 0.02, (n, 3))
    log = Recording.from_arrays(time=H * np.arange(n), gyro=gyro, accel=accel)
    assert kinds(log) & {"gyro_at_rest"} == said
    assert "gyro_at_rest" not in kinds(replace(log, gyro=log.gyro * [0.3, 0.3, 1]))


@pytest.mark.parametrize("density", [0.005, 0.1])
def test_white_noise_that_no_gyro_has(density):
    """Of the noisiest gyro of the built-in parts and of an MPU-6050: deg/s/sqrt(Hz), one-sided."""
    n, rng = 3000, np.random.default_rng(4)
    sigma = np.radians(density) * np.sqrt(0.5 / H)
    gyro, accel = rng.normal(0, sigma, (n, 3)), [0, 0, 9.81] + rng.normal(0, 0.02, (n, 3))
    right = Recording.from_arrays(time=H * np.arange(n), gyro=gyro, accel=accel)
    assert "gyro_noisy" not in kinds(right)
    assert "gyro_noisy" in kinds(replace(right, gyro=DEGREE * gyro))


def written(path, unit, times):
    head = f"time [{unit}]," + ",".join(f"gyro_{a} [rad/s]" for a in "xyz")
    rates = np.random.default_rng(3).normal(0, 0.01, (len(times), 3))
    rows = [",".join([t, *(f"{v:.6f}" for v in r)]) for t, r in zip(times, rates, strict=True)]
    path.write_text("\n".join([head, *rows]) + "\n")
    return path


@pytest.mark.parametrize(
    "unit, ticks, said",
    [
        ("ms", 10_000, "0.1 Hz; it would be 100 Hz if {}smaller"),
        ("us", 10, "100000 Hz; it would be 100 Hz if {}larger"),
        ("ms", 10, ""),
        ("s", 1, ""),
    ],
)
def test_a_clock_whose_unit_is_wrong_by_a_thousand(unit, ticks, said, tmp_path):
    log = written(tmp_path / "log.csv", unit, [str(ticks * k) for k in range(500)])
    lines = [line for line in inspect(log).lines() if "unlikely rate" in line]
    why = said.format("the times were in a unit 1,000 times ")
    assert lines == ([f"  unlikely rate: {why}"] if said else [])


@pytest.mark.parametrize("span, name", [(604800, "GPS week"), (86400, "day")])
@pytest.mark.parametrize("unit, size", [("s", 1), ("ms", 1000)])
def test_times_go_on_behind_the_end_of_a_week_and_of_a_day(span, name, unit, size, tmp_path):
    ticks = (np.arange(500) * 10 + (span * 1000 - 2000)) % (span * 1000)
    times = [f"{t * size / 1000:.2f}" if unit == "s" else str(t) for t in ticks]
    found = read_recording(written(tmp_path / "log.csv", unit, times))
    np.testing.assert_allclose(np.diff(found.time), H, atol=1e-9)
    (said,) = (f for f in found.findings if f.kind == "counter_wrapped")
    assert (said.count, said.detail) == (1, {"after": name})
    # and where the unit is guessed
    head = written(tmp_path / "log.csv", unit, times).read_text().replace(f"time [{unit}]", "tow")
    (tmp_path / "log.csv").write_text(head)
    assert inspect(tmp_path / "log.csv").recording.sample_rate == pytest.approx(100)
