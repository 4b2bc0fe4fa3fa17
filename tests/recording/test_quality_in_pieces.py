"""Quality of a log in pieces: faults are found at their rows and counted up; one window gives what
the whole does; words that wrapped.
"""

import numpy as np
import pytest

from pyimu.errors import Finding
from pyimu.recording.quality.clipping import clipped
from pyimu.recording.quality.in_pieces import WINDOW_ROWS, Inspector
from pyimu.recording.quality.inspect import inspect
from pyimu.recording.quality.stuck import held_rows
from pyimu.recording.quality.wraps import wraps
from pyimu.recording.recording import Recording


def noisy(n, seed=0):
    rng = np.random.default_rng(seed)
    gyro = np.round(rng.standard_normal((n, 3)) / 0.4) * 4e-4
    return Recording.from_arrays(
        time=np.arange(n) * 0.001, gyro=gyro, accel=rng.standard_normal((n, 3)) * 0.01 + [0, 0, 9.8]
    )


def inspected(recording, rows):
    inspector = Inspector()
    for start in range(0, len(recording), rows):
        inspector.add(recording.slice(start, start + rows))
    return inspector.findings()


def test_inspector_of_one_window_is_inspect():
    recording = noisy(50_000)
    recording.gyro[1000:1100, 0] = recording.gyro[1000, 0]
    recording.accel[7000, 1] = 4
    recording.accel[:, 2] = 9.8
    assert inspected(recording, 3001) == inspect(recording) != ()


@pytest.fixture(scope="module")
def faulty_windows():
    """Three windows: one ends in a stuck run, one is stuck on gyro y, and one has a spike."""
    recording = noisy(3 * WINDOW_ROWS)
    recording.gyro[WINDOW_ROWS - 60 : WINDOW_ROWS, 0] = 4e-4
    recording.gyro[WINDOW_ROWS : 2 * WINDOW_ROWS, 1] = 4e-4
    recording.accel[2 * WINDOW_ROWS + 500, 2] = 11
    return recording


@pytest.mark.parametrize("rows", [100_000, 3 * WINDOW_ROWS])
def test_inspector_adds_up_over_windows(rows, faulty_windows):
    found = {(f.kind, f.column): f for f in inspected(faulty_windows, rows)}
    stuck, dead = found["stuck_samples", "gyro_x"], found["stuck_samples", "gyro_y"]
    assert (stuck.count, stuck.detail["first_row"]) == (60, WINDOW_ROWS - 60)
    assert (dead.count, dead.detail["first_row"], dead.detail["runs"]) == (
        WINDOW_ROWS,
        WINDOW_ROWS,
        1,
    )
    assert (found["spikes", "accel_z"].count, found["spikes", "accel_z"].detail["first_row"]) == (
        1,
        2 * WINDOW_ROWS + 500,
    )
    assert found["quantization_step", "gyro_x"].count == 3 * WINDOW_ROWS and found[
        "quantization_step", "gyro_x"
    ].detail["step"] == pytest.approx(4e-4)
    assert len(found) == 6


def test_channel_that_is_constant_throughout():
    recording = noisy(2 * WINDOW_ROWS)
    recording.accel[:, 0] = 0.5
    assert inspected(recording, 50_000)[-1] == Finding(
        "constant_channel", "accel_x", 2 * WINDOW_ROWS, {"value": 0.5}
    )


@pytest.mark.parametrize("bits", [8, 12, 16, 24])
@pytest.mark.parametrize("reach", [1.3, 2.4])
def test_integers_that_wrapped(bits, reach):
    """The jumps are counted as they were made; their size is the word's range, to the slope's
    change over three samples.
    """
    t, half, step = np.arange(20_000) * 0.01, 2.0 ** (bits - 1), 0.02
    true = np.rint(reach * half * np.sin(2 * t) + np.random.default_rng(0).standard_normal(len(t)))
    wrapped = (true + half) % (2 * half) - half
    rows, span = wraps(wrapped * step)
    assert np.array_equal(rows, np.flatnonzero(np.diff((true + half) // (2 * half))) + 1)
    assert span == pytest.approx(2 * half * step, rel=0.02)
    recording = Recording.from_arrays(time=t, gyro=np.column_stack([wrapped * step] * 3))
    assert {f.column for f in inspect(recording) if f.kind == "wrapped"} == {
        "gyro_x",
        "gyro_y",
        "gyro_z",
    }


def test_the_edge_of_a_word_is_no_clipping():
    t = np.arange(20_000) * 0.01
    values = (2.2 * np.sin(np.pi * t) + 1) % 2 - 1
    values[15_000:15_100] = 0.99999  # stays at the edge: a plateau
    assert clipped(values).sum() >= 100
    found = inspect(Recording.from_arrays(time=t, gyro=np.column_stack([values] * 3)))
    assert {f.kind for f in found if f.column == "gyro_x"} & {"wrapped", "clipping"} == {"wrapped"}


@pytest.mark.parametrize("sigma", [0, 1e-3, 1e-2, 0.1])
def test_square_waves_clipping_and_noise_are_no_wraps(sigma):
    t, noise = np.arange(20_000) * 0.01, sigma * np.random.default_rng(0).standard_normal(20_000)
    spiky = np.where(np.arange(20_000) % 1000 == 0, 40.0, np.sin(t))
    for values in (3 * np.sign(np.sin(t)), np.clip(6 * np.sin(t), -3, 3), np.sin(t), spiky, 0 * t):
        assert not len(wraps(values + noise)[0])


@pytest.mark.parametrize("ratio", [2, 2.5, 4, 9.76, 50])
@pytest.mark.parametrize("step", [0, 0.3, 1])
def test_slow_sensor_in_a_fast_log_is_found(ratio, step):
    """Rounding to a standard deviation lets 28 % of the new values equal the old: some intervals
    are two or three as long.
    """
    rng = np.random.default_rng(0)
    slow = rng.standard_normal(60_000)
    slow = np.round(slow / step) * step if step else slow
    n = 120_000
    values = slow[(np.arange(n) / ratio).astype(int)]
    found = held_rows(values)
    assert found == pytest.approx(
        ratio / (1 - np.mean(slow[1:] == slow[:-1])), rel=0.05
    )  # of 1700 changes at least: 3.9 sigma
    recording = Recording.from_arrays(
        time=np.arange(n) * 0.001, gyro=np.column_stack([values, rng.standard_normal((n, 2))])
    )
    assert [f.column for f in inspect(recording) if f.kind == "held_samples"] == ["gyro_x"]


@pytest.mark.parametrize("step", [0, 0.5, 1, 1.5, 2, 3])
@pytest.mark.parametrize("seed", range(3))
def test_coarse_noise_and_ramps_are_not_held(step, seed):
    noise = np.random.default_rng(seed).standard_normal(40_000)
    ramp = np.arange(40_000) * 0.01
    for values in (noise, noise + ramp, ramp, np.sin(ramp)):
        assert held_rows(np.round(values / step) * step if step else values) is None
