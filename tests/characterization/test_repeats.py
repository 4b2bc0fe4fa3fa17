"""Samples that stand there once more are in no noise of the part."""

from __future__ import annotations

import numpy as np
import pytest

import pyimu
from pyimu.errors import UserError
from pyimu.numerics.laws import norm
from pyimu.recording.recording import Recording

H, N, ROWS = 0.01, 2e-4, 16384
"""s; rad/sqrt(s); samples."""

FAR = norm.isf(5e-5)
"""Standard deviations that an estimate is beyond once in 10,000 times."""


def noise() -> np.ndarray:
    return N / np.sqrt(H) * np.random.default_rng(4).normal(size=(ROWS, 3))


def shown_again(values: np.ndarray, again: np.ndarray) -> np.ndarray:
    """The values with the one before wherever ``again`` (n,)."""
    rows = np.arange(len(values))
    return values[np.maximum.accumulate(np.where(again, 0, rows))]


def characterize(gyro: np.ndarray):
    return pyimu.characterize(Recording.from_arrays("log", time=H * np.arange(ROWS), gyro=gyro))


def right(channel) -> bool:
    n = channel.coefficient("N")
    return abs(n.value - N) < FAR * n.std


def in_runs(length: int, every: int) -> np.ndarray:
    return np.arange(ROWS) % every > every - length


def by_chance(share: float) -> np.ndarray:
    return np.random.default_rng(5).uniform(size=ROWS) < share


@pytest.mark.parametrize("again", [in_runs(20, 300), by_chance(0.08)], ids=["runs", "by chance"])
def test_repeats_are_left_out_of_the_noise(again):
    c = characterize(shown_again(noise(), again))
    assert all(right(channel) for channel in c.logs[0].channels)
    assert "repeats left out" in c.report()


def test_one_axis_that_hangs_at_times():
    gyro = noise()
    gyro[:, 0] = shown_again(gyro[:, :1], in_runs(20, 300))[:, 0]
    assert all(right(channel) for channel in characterize(gyro).logs[0].channels)


def test_an_axis_that_hung_for_long_costs_the_others_nothing():
    gyro = noise()
    gyro[2000:, 0] = gyro[2000, 0]
    x, y, z = characterize(gyro).logs[0].channels
    assert x.noise is None and "hung at one value for 88 %" in x.reason
    assert right(y) and right(z)


def test_of_too_many_repeats_nothing_is_written():
    accel = 9.81 + noise()
    gyro = shown_again(noise(), by_chance(0.5))
    c = pyimu.characterize(
        Recording.from_arrays("log", time=H * np.arange(ROWS), gyro=gyro, accel=accel)
    )
    assert "repeat the one before" in c.logs[0].sensors["gyro"].channels[0].reason
    assert c.part().gyro.effects == ()
    with pytest.raises(UserError, match="50 % of the samples repeat"):
        characterize(gyro)


@pytest.mark.parametrize("every", [2, 5])
def test_a_sensor_slower_than_its_log_keeps_its_samples(every):
    """N is that of the samples at their own rate."""
    held = np.repeat(noise(), every, axis=0)[:ROWS]
    c = characterize(held)
    assert not [f for f in c.findings if f.kind == "repeated_samples"]
    for channel in c.logs[0].channels:
        n = channel.coefficient("N")
        assert n.value == pytest.approx(N * np.sqrt(every), abs=FAR * n.std + 0.02 * n.value)


def read_at(times: np.ndarray, rate: float) -> np.ndarray:
    """The samples of a sensor of ``rate`` Hz that are there at ``times`` (n,) s: white noise N."""
    number = np.floor((times - times.min()) * rate + 0.37).astype(int)
    made = np.random.default_rng(6).normal(size=(number.max() + 1, 3))
    return N * np.sqrt(rate) * made[np.maximum.accumulate(number)]


@pytest.mark.parametrize("reads", [1.06, 1.5, 2.3])
@pytest.mark.parametrize("scatter", [0.0, 0.05], ids=["even", "scattered"])
def test_a_logger_quicker_than_its_sensor(reads, scatter):
    """N is that of white noise at the sensor's own rate; scattered reads lose up to 1 % of it."""
    times = H * (np.arange(ROWS) + scatter * np.random.default_rng(7).normal(size=ROWS))
    c = characterize(read_at(times, 1 / (reads * H)))
    assert [f.column for f in c.findings if f.kind == "held_samples"] == ["gyro"]
    assert "is slower than its log" in c.report()
    for channel in c.logs[0].channels:
        n = channel.coefficient("N")
        assert abs(n.value - N) < FAR * n.std + 0.005 * N
    assert 1 / c.part().sample_rate == pytest.approx(reads * H, rel=0.01)


def test_reads_too_uneven_for_a_rate():
    """A tenth of the samples is lost, and a quarter of the rows repeats the one before."""
    times = H * (np.arange(ROWS) + 0.3 * np.random.default_rng(7).normal(size=ROWS))
    with pytest.raises(UserError, match="neither the sensor's rate nor its noise"):
        characterize(read_at(times, 1 / (1.2 * H)))


def test_equal_samples_by_rounding_stay():
    step = 2 * N / np.sqrt(H)
    c = characterize(step * np.round(noise() / step))
    assert not [f for f in c.findings if f.kind == "repeated_samples"]
