"""comma2k19's folders: a time and a value, arrays of NumPy without suffix, for each sensor."""

from __future__ import annotations

import numpy as np
import pytest

from pyimu.errors import UserError
from pyimu.inspection.run import inspect
from pyimu.recording.log import open_log, recording_of

RATE, N = 100.0, 500


def saved(path, array):
    """An array as numpy.save writes it, under a name without suffix."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("wb") as stream:
        np.save(stream, array)


@pytest.fixture
def segment(tmp_path):
    draw, folder = np.random.default_rng(1), tmp_path / "40"
    values = {
        "gyro_uncalibrated": 1e-2 * draw.normal(size=(N, 3)),
        "gyro": np.zeros((N, 3)),
        "accelerometer": [0.0, 0.0, -9.8] + 1e-2 * draw.normal(size=(N, 3)),
    }
    for name, value in values.items():
        where = folder / "processed_log" / "IMU" / name
        saved(where / "t", 1000.0 + 2e-3 * (name == "accelerometer") + np.arange(N) / RATE)
        saved(where / "value", value)
    return folder, values


@pytest.mark.parametrize("inside", ["", "processed_log", "processed_log/IMU"])
def test_a_segment_is_one_log(segment, inside):
    folder, values = segment
    log = recording_of(folder / inside)
    assert log.name == "40" and set(log.groups) == {"gyro", "accel"}
    assert log.sample_rate == pytest.approx(RATE)
    # Forward-right-down there, forward-left-up here.
    np.testing.assert_allclose(log.gyro, values["gyro_uncalibrated"] * [1, -1, -1])
    np.testing.assert_allclose(log.accel, values["accelerometer"] * [1, -1, -1])
    assert inspect(folder / inside).readable


def test_the_corrected_gyro_where_there_is_no_other(segment):
    folder, values = segment
    for name in ("t", "value"):
        (folder / "processed_log" / "IMU" / "gyro_uncalibrated" / name).unlink()
    np.testing.assert_allclose(recording_of(folder).gyro, values["gyro"])


@pytest.mark.parametrize("damage", ["text", "objects", "longer"])
def test_a_damaged_array_is_said(segment, damage):
    where = segment[0] / "processed_log" / "IMU" / "gyro_uncalibrated"
    if damage == "text":
        (where / "value").write_text("no array")
    elif damage == "objects":
        saved(where / "value", np.array([None, {}], dtype=object))
    else:
        saved(where / "t", np.arange(N + 7) / RATE)
    with pytest.raises(UserError, match="gyro_uncalibrated"):
        open_log(segment[0]).read()
