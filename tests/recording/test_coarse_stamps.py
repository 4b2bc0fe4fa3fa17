"""Stamps coarser than the sample period, of rows that come evenly, and of rows that do not."""

import numpy as np
import pandas as pd
import pytest

from pyimu.recording.coarse import LEAST_STAMPS, EvenTimes, even_times
from pyimu.recording.log import open_log, read_recording, recording_of
from pyimu.recording.recording import Recording, join

H, ROWS = 0.01, 6000
TIME = H * np.arange(ROWS)


def cut(time, unit):
    """Stamps of a clock that shows whole units; 1e-9 of one keeps rounding from deciding."""
    return np.floor(time / unit + 1e-9) * unit


def written(path, stamps, seed=0, **columns):
    rng = np.random.default_rng(seed)
    values = {f"gyro_{a} [rad/s]": rng.standard_normal(len(stamps)) for a in "xyz"}
    pd.DataFrame({"time [s]": stamps} | values | columns).to_parquet(path)
    return path


def spread(stamps):
    even = even_times(stamps, np.zeros(len(stamps), dtype=bool))
    return None if even is None else even.add(stamps)


@pytest.mark.parametrize("unit", [0.016, 0.02, 0.0256, 0.1, 1.0])
@pytest.mark.parametrize("start", [0.0, 3.337])
def test_rows_that_share_stamps_get_their_own_times_but_for_one_offset(unit, start):
    """Each stays within a unit of its stamp, and is a period behind the row before."""
    time, stamps = start + TIME, cut(start + TIME, unit)
    found = spread(stamps)
    assert (found >= stamps - 1e-9).all() and (found <= stamps + unit + 1e-9).all()
    off = found - time
    # The period is known to a unit over the span of the stamps.
    assert np.ptp(off) < H / 2 and np.abs(np.diff(found) - H).max() < H / 2
    assert np.abs(np.diff(found)[len(TIME) // 2 :] - H).max() < 2 * H * unit / TIME[-1] + 1e-9


def test_packets_with_one_stamp_each_are_spread_over_the_time_until_the_next():
    packet = np.arange(ROWS) // 5
    late = np.random.default_rng(2).uniform(0.0, 0.4 * H, packet[-1] + 1)
    found = spread(5 * H * packet + late[packet])
    assert np.std(np.diff(found)[LEAST_STAMPS * 5 :]) < 0.05 * H


def test_rows_that_are_missing_stay_missing():
    there = (TIME < 20.0) | (TIME > 23.0)
    found = spread(cut(TIME[there], 0.02))
    gap = np.flatnonzero(np.diff(found) > 1.0)
    assert len(gap) == 1 and found[gap[0] + 1] - found[gap[0]] == pytest.approx(3.0, abs=0.021)


def test_stamps_that_are_fine_enough_stay_as_they_are():
    assert spread(TIME) is None and spread(cut(TIME, 0.006)) is None


def test_rows_that_come_when_they_like_are_not_spread():
    time = np.sort(np.random.default_rng(1).uniform(0.0, ROWS * H, ROWS))
    assert spread(cut(time, 0.02)) is None


def test_rows_that_repeat_a_sensors_values_are_no_samples_of_their_own(tmp_path):
    """Two streams in one table: each row shows what is new of the one, and the other as it was."""
    stamps = np.repeat(TIME[: ROWS // 2], 2)
    accel = np.repeat(np.random.default_rng(3).standard_normal(ROWS // 2), 2)
    more = {f"accel_{a} [m/s^2]": accel for a in "xyz"}
    found = read_recording(written(tmp_path / "log.parquet", stamps, **more))
    assert len(found) == ROWS // 2 and "coarse_stamps" not in {f.kind for f in found.findings}


def test_a_log_of_whole_seconds_is_read_at_its_rate_and_says_so(tmp_path):
    found = read_recording(written(tmp_path / "log.parquet", cut(TIME, 1.0)))
    assert len(found) == ROWS and found.sample_rate == pytest.approx(100.0, rel=0.02)
    (said,) = (f for f in found.findings if f.kind == "coarse_stamps")
    assert said.count == ROWS - 60 and said.detail["unit"] == pytest.approx(1.0)


def test_even_times_do_not_depend_on_the_pieces(tmp_path, monkeypatch):
    path = written(tmp_path / "log.parquet", cut(TIME, 0.016))
    whole = read_recording(path)
    monkeypatch.setattr("pyimu.recording.formats.parquet.BATCH", 77)
    pieces = join([piece for piece, _ in open_log(path).pieces(500)])
    np.testing.assert_array_equal(pieces.time, whole.time)
    parts, even = np.array_split(cut(TIME, 0.016), 9), EvenTimes(H, 0.016, 0.0)
    once = EvenTimes(H, 0.016, 0.0).add(cut(TIME, 0.016))
    np.testing.assert_array_equal(np.concatenate([even.add(p) for p in parts]), once)


def in_bursts(size, seed=4):
    """Stamps of rows that a bus hands over ``size`` at a time, read 0.2 ms apart 2 to 5 ms after
    the last of them was sampled.
    """
    row, rng = np.arange(ROWS), np.random.default_rng(seed)
    burst = row // size
    wait = rng.uniform(0.002, 0.005, burst[-1] + 1)[burst]
    return H * (burst * size + size - 1) + wait + 2e-4 * (row % size)


@pytest.mark.parametrize("size", [2, 5, 8, 32])
def test_rows_that_come_in_bursts_get_the_times_before_they_were_read(size):
    """By what the bus waits at most all are late together, and by its scatter of 3 ms each."""
    found = spread(in_bursts(size))
    off = found - TIME
    assert off.min() > 0.0 and off.max() < 0.0061
    assert np.abs(np.diff(found) - H).max() < H / 2


def test_stamps_that_scatter_and_rows_that_are_lost_are_no_bursts():
    rng = np.random.default_rng(5)
    scattered = TIME + np.clip(0.3 * rng.standard_normal(ROWS), -0.45, 0.45) * H
    assert spread(scattered) is None and spread(TIME[rng.random(ROWS) > 0.1]) is None


def test_bursts_do_not_depend_on_the_pieces_nor_on_where_they_come_from(tmp_path):
    stamps = in_bursts(6)
    once = spread(stamps)
    even = even_times(stamps, np.zeros(ROWS, dtype=bool))
    pieces = np.concatenate([even.add(p) for p in np.array_split(stamps, 11)])
    np.testing.assert_array_equal(pieces, once)
    read = read_recording(written(tmp_path / "log.parquet", stamps))
    given = recording_of(Recording.from_arrays("log", time=stamps, gyro=np.zeros((ROWS, 3))))
    for found in (read, given):
        assert found.sample_rate == pytest.approx(100.0, rel=1e-3) and len(found.segments) == 1
        assert "coarse_stamps" in {f.kind for f in found.findings}
