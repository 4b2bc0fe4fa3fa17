"""Loggers and data sets whose tables are known by what describes them, and tables without names."""

import json

import log_lines
import numpy as np
import pytest
import raw_logs
from log_lines import COUNTS

from pyimu import UserError, inspect, read_recording
from pyimu.recording.log import read_reference

LOG = raw_logs.still(300)
TIME, GYRO, ACCEL = LOG
Q = np.tile([0.5, -0.5, 0.5, 0.5], (300, 1))


def agrees(found, digits=0.0):
    np.testing.assert_allclose(found.gyro, GYRO, rtol=0, atol=digits)
    np.testing.assert_allclose(found.accel, ACCEL, rtol=0, atol=digits)
    np.testing.assert_allclose(np.diff(found.time), 0.01, rtol=0, atol=1e-6)


def recognised(found):
    (said,) = [f for f in found.findings if f.kind == "recognised"]
    return said.detail["as"]


@pytest.mark.parametrize("name", ["clip.gcsv", "clip.csv"])
def test_gyroflow_says_the_sizes_of_its_counts(name, tmp_path):
    found = read_recording(log_lines.gyroflow(tmp_path, LOG).rename(tmp_path / name))
    assert "Gyroflow" in recognised(found)
    np.testing.assert_allclose(found.gyro, GYRO, rtol=0, atol=0.501 * COUNTS[0])
    np.testing.assert_allclose(found.accel, ACCEL, rtol=0, atol=0.501 * 9.80665 * COUNTS[1])
    assert found.sample_rate == pytest.approx(100.0)


@pytest.mark.parametrize("size", ["note,x", "gscale,0", "gscale,nan"])
def test_gyroflow_without_a_size_is_refused(size, tmp_path):
    path = log_lines.gyroflow(tmp_path, LOG, ("tscale,0.001", size, "ascale,1"))
    with pytest.raises(UserError, match="have no gscale, the size of a count; add"):
        read_recording(path)


@pytest.mark.parametrize("frame", ["imu_link", "''"])
def test_ros2_topic_echo_csv(frame, tmp_path):
    found = read_recording(log_lines.echoed(tmp_path, LOG, frame))
    agrees(found)
    assert "sensor_msgs/Imu" in recognised(found) and found.ref_q is None


@pytest.mark.parametrize("named", [False, True])
def test_a_ros_message_with_a_pose_is_a_reference(named, tmp_path):
    """By its own stamp, not by the time at which it was logged."""
    path = log_lines.posed(tmp_path, LOG, named)
    found = read_reference(path)
    x, y, z, w = log_lines.POSED
    np.testing.assert_array_equal(found.ref_q, np.tile([w, x, y, z], (300, 1)))
    np.testing.assert_array_equal(found.ref_east, np.full(300, 1.0))
    np.testing.assert_allclose(found.ref_up, 0.01 * np.arange(300))
    (origin,) = [f.detail["origin"] for f in found.findings if f.kind == "time_origin"]
    assert origin == raw_logs.FIRST / 1e9
    whole = inspect(path)
    assert whole.kind == "known" and "pose" in whole.format


def test_openlog_artemis(tmp_path):
    found = read_recording(log_lines.open_log(tmp_path, LOG))
    agrees(found, 4e-15)
    np.testing.assert_allclose(found.mag[0], [1e-5, -2e-5, 3e-5], rtol=1e-12)
    assert found.temperature[0] == 28.75 and "OpenLog" in recognised(found)


def test_imu_txt_of_a_bag(tmp_path):
    found = read_recording(log_lines.bag_text(tmp_path, LOG))
    agrees(found)
    assert "imu.txt" in recognised(found)


def test_ronin_takes_the_phone_s_own_raw_arrays(tmp_path):
    pytest.importorskip("h5py")
    found = read_recording(log_lines.ronin(tmp_path, LOG))
    agrees(found)
    assert found.ref_q is None and "RoNIN" in recognised(found)


def test_nuscenes_in_json(tmp_path):
    found = read_recording(log_lines.nuscenes(tmp_path, LOG))
    agrees(found)
    assert found.ref_q is None and "nuScenes" in recognised(found)


def test_samples_in_json_with_objects_in_them(tmp_path):
    """A list by itself or within an object; a member that is missing is a missing value."""
    rows = [
        {"t": 0.01 * k, "gyro": dict(zip("xyz", w)), "note": "x", "accel": a, "ok": True}
        for k, (w, a) in enumerate(zip(GYRO.tolist(), ACCEL.tolist(), strict=True))
    ]
    names = {f"gyro.{a}": f"gyro_{a} [rad/s]" for a in "xyz"}
    names |= {f"accel[{k}]": f"accel_{a} [m/s^2]" for k, a in enumerate("xyz")}
    lines = [f'"{cell}" = "{name}"' for cell, name in ({"t": "time [s]"} | names).items()]
    (tmp_path / "map.toml").write_text("\n".join(["[columns]", *lines]))
    del rows[7]["accel"]
    for data in (rows, {"device": "a", "samples": rows}):
        (tmp_path / "log.json").write_text(json.dumps(data))
        found = read_recording(tmp_path / "log.json", tmp_path / "map.toml")
        np.testing.assert_array_equal(found.gyro, GYRO)
        assert np.isnan(found.accel[7]).all()
        np.testing.assert_array_equal(np.delete(found.accel, 7, 0), np.delete(ACCEL, 7, 0))


@pytest.mark.parametrize(
    "text",
    [
        "[]",
        "{}",
        "[1, 2]",
        '{"a": [{}], "b": [{}]}',
        "[{",
        '"a"',
        "[{}]",
        '[{"a": 1%s}]' % (400 * "0"),
    ],
)
def test_what_is_no_list_of_samples_is_refused(text, tmp_path):
    (tmp_path / "log.json").write_text(text)
    with pytest.raises(UserError, match="no list of samples|cannot be read as JSON \\("):
        read_recording(tmp_path / "log.json")


def test_a_trajectory_of_tum_without_names(tmp_path):
    """Scalar last, and the time is the first column, not the place that rises as one."""
    columns = [1.54e9 + TIME * 1e-9, TIME * 1e-9, *np.zeros((2, 300)), *Q[:, [1, 2, 3, 0]].T]
    path = raw_logs.text(tmp_path / "poses.txt", [], columns, " ")
    found = inspect(path)
    assert "is z up?" in found.column_map
    column_map = found.write_map(tmp_path / "map.toml")
    np.testing.assert_array_equal(read_reference(path, column_map).ref_q, Q)
    with pytest.raises(UserError, match="neither gyro_x.* goes beside .* as --reference"):
        read_recording(path, column_map)


def test_a_vector_without_names_is_told_by_the_name_of_its_file(tmp_path):
    """As ADVIO has them; a folder says which files are in it."""
    for name, values in (("gyro", GYRO), ("accelerometer", ACCEL)):
        raw_logs.text(tmp_path / f"{name}.csv", [], [TIME * 1e-9, *values.T])
    (proposal,) = inspect(tmp_path / "gyro.csv").proposals
    assert set(proposal.groups) == {"time", "gyro"}
    with pytest.raises(UserError, match="files in it .*: accelerometer.csv, gyro.csv"):
        read_recording(tmp_path)


def test_gopro_s_tables_state_all_but_their_milliseconds(tmp_path):
    """``cts``, and axes in the order of the camera's."""
    for name, unit, values in (("Accelerometer", "m/s2", ACCEL), ("Gyroscope", "rad/s", GYRO)):
        rows = [
            f"{100.5 + 10 * k!r},2022-12-20T13:12:13.739Z,{v[2]!r},{v[0]!r},{v[1]!r},27.8"
            for k, v in enumerate(values.tolist())
        ]
        axes = ",".join(f"{name} ({a}) [{unit}]" for a in "zxy")
        head = f"cts,date,{axes},temperature [°C]"
        found = read_recording(log_lines.lines_of(tmp_path / f"GH01-{name}.csv", [head, *rows]))
        got = found.accel if name == "Accelerometer" else found.gyro
        np.testing.assert_array_equal(got, values)
        assert found.sample_rate == pytest.approx(100.0)
