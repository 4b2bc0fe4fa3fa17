"""Rows of zeros before the first sample are left out and said; all else is taken as it is."""

import numpy as np
import pandas as pd
import pytest

from pyimu import attitude
from pyimu.errors import UserError
from pyimu.recording.log import open_log, read_recording
from pyimu.recording.waking import LONGEST, Waking

N, H, ASLEEP = 1500, 0.01, 230
COLUMNS = [
    f"{sensor}_{axis} [{unit}]"
    for sensor, unit in (("gyro", "rad/s"), ("accel", "m/s^2"))
    for axis in "xyz"
]


def samples(asleep: int, n: int = N) -> np.ndarray:
    """Gyro and accelerometer at rest (n, 6), the first rows zero."""
    noise = np.random.default_rng(7).normal(0, 2e-3, (n, 6))
    values = noise + [0.01, -0.02, 0.005, 0.0, 0.0, 9.81]
    values[:asleep] = 0
    return values


@pytest.fixture
def log(tmp_path):
    """Writes a log of these samples and gives its path."""

    def write(values, columns=COLUMNS):
        frame = pd.DataFrame(values, columns=columns)
        frame.insert(0, "time [s]", np.arange(len(values)) * H)
        path = tmp_path / "log.csv"
        frame.to_csv(path, index=False)
        return path

    return write


def left_out(recording):
    return [(f.count, f.detail) for f in recording.findings if f.kind == "zeros_left_out"]


@pytest.mark.parametrize("asleep", [1, ASLEEP])
def test_zeros_before_the_first_sample_are_left_out_and_said(log, asleep):
    values = samples(asleep)
    found = read_recording(log(values))
    assert np.array_equal(found.gyro, values[asleep:, :3]) and found.time[0] == asleep * H
    assert left_out(found) == [(asleep, {"until": asleep * H})]


def test_pieces_are_what_reading_gives(log):
    path = log(samples(ASLEEP))
    pieces = [piece for piece, _ in open_log(path).pieces(100)]
    assert np.array_equal(
        np.concatenate([p.accel for p in pieces]), read_recording(path).accel
    ) and len(pieces) == -(-(N - ASLEEP) // 100)


def _empty(batch):
    """A batch all of whose rows had the time of the row before."""
    time, groups, share = batch
    return time[:0], {name: values[:0] for name, values in groups.items()}, share


@pytest.mark.parametrize("size", [1, 7, ASLEEP, ASLEEP + 1, N])
def test_it_does_not_depend_on_the_batches(size):
    values, time = samples(ASLEEP), np.arange(N) * H
    batches = [
        (time[k : k + size], {"gyro": v[:, :3], "accel": v[:, 3:]}, 0.5)
        for k in range(0, N, size)
        for v in [values[k : k + size]]
    ]
    batches.insert(0, _empty(batches[0]))
    waking = Waking()
    got = list(waking.awake(batches))
    assert np.array_equal(np.concatenate([t for t, _, _ in got]), time[ASLEEP:])
    assert np.array_equal(np.concatenate([g["gyro"] for _, g, _ in got]), values[ASLEEP:, :3])
    assert [f.count for f in waking.findings()] == [ASLEEP]


@pytest.mark.parametrize(
    "asleep, n",
    [(0, N), (N, N), (round(LONGEST / H) + 2, round(LONGEST / H) + N)],
    ids=["none", "all of them", "longer than a logger starts"],
)
def test_a_log_that_is_zero_throughout_or_for_long_is_taken_as_it_is(log, asleep, n):
    found = read_recording(log(samples(asleep, n)))
    assert len(found) == n and left_out(found) == []


def test_zeros_of_one_sensor_alone_are_samples(log):
    """A gyro without noise at rest, or a fall: neither is known not to be one."""
    for columns in (slice(0, 3), slice(3, 6)):
        values = samples(0)
        values[:ASLEEP, columns] = 0
        found = read_recording(log(values))
        assert len(found) == N and left_out(found) == []
    found = read_recording(log(samples(ASLEEP)[:, :3], COLUMNS[:3]))
    assert len(found) == N and left_out(found) == []


def test_too_few_samples_behind_the_zeros_are_refused(log):
    with pytest.raises(UserError, match="behind rows of zeros this one has 2"):
        read_recording(log(samples(ASLEEP, ASLEEP + 2)))


def test_the_attitude_filter_finds_the_rest_behind_the_zeros(log):
    """Of 12.7 s of rest it found 2 s, and of the bias nothing."""
    path = log(samples(ASLEEP))
    found = attitude.run(path)
    assert found.rest.seen and found.rest.duration > 0.9 * (N - ASLEEP) * H
    assert len(found.time) == N - ASLEEP
    bias = found.gyro_bias[-1] - [0.01, -0.02, 0.005]
    # The mean of n samples of the noise lies within 5 of its standard deviations.
    assert np.all(np.abs(bias) < 5 * 2e-3 / np.sqrt(N - ASLEEP))
