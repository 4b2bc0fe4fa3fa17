"""Columns of foreign logs by their names: each vector is found or told of, in no wrong unit."""

import re

import numpy as np
import pytest
import raw_logs
from scipy.spatial.transform import Rotation
from test_raw_logs import turned

from pyimu import inspect, read_recording
from pyimu.errors import UserError
from pyimu.recording.formats.suffix import open_reader
from pyimu.recording.guess.proposal import proposed
from pyimu.recording.naming.name import named, thermometer

G = 9.80665


def written(folder, header, columns, name="log.csv"):
    return raw_logs.text(folder / name, [header], columns)


@pytest.mark.parametrize(
    "gyro, accel, in_degrees, in_g",
    [
        ("gx_dps,gy_dps,gz_dps", "ax_g,ay_g,az_g", True, True),
        ("xgyro,ygyro,zgyro", "xacc,yacc,zacc", False, True),
        ("p,q,r", "ax,ay,az", False, False),
        ("p_dps,q_dps,r_dps", "AccX,AccY,AccZ", True, False),
        ("rate_x,rate_y,rate_z", "acc_x,acc_y,acc_z", False, False),
        ("ang_vel_x,ang_vel_y,ang_vel_z", "lin_acc_x,lin_acc_y,lin_acc_z", False, False),
        *[(",".join(f"angular_velocity_{a}" for a in "xyz"), "f_x,f_y,f_z", False, False)],
        ("wx,wy,wz", "gFx,gFy,gFz", False, True),
        ("gyro_x,gyro_y,gyro_z", "gForce_x,gForce_y,gForce_z", False, True),
        ("spin_x,spin_y,spin_z", "acc_x,acc_y,acc_z", True, False),
        ("gyr_x,gyr_y,gyr_z", "push_x,push_y,push_z", True, True),
    ],
)
def test_no_vector_is_left_out(gyro, accel, in_degrees, in_g, tmp_path):
    time, rates, forces = turned()
    columns = [*(np.degrees(rates) if in_degrees else rates).T, *(forces / (G if in_g else 1)).T]
    path = written(tmp_path, f"time_us,{gyro},{accel}", [time // 1000, *columns])
    found = inspect(path).recording
    np.testing.assert_allclose(found.gyro, rates, rtol=1e-14)
    np.testing.assert_allclose(found.accel, forces, rtol=1e-14)


def test_a_vector_that_nothing_tells_is_told_of(tmp_path):
    time, rates, forces = raw_logs.still(400)
    head = "time_ms,acc_x_g,acc_y_g,acc_z_g,foo_x,foo_y,foo_z"
    path = written(tmp_path, head, [time // 10**6, *(forces / G).T, *rates.T])
    (said,) = (f for f in read_recording(path).findings if f.kind == "vector_left_out")
    assert said.detail == {"columns": "foo_x, foo_y, foo_z"}
    (note,) = proposed(open_reader(path)).notes
    assert note.startswith("foo_x, foo_y, foo_z are left out: they may be the gyro")
    path = written(tmp_path, head.replace("foo", "pos"), [time // 10**6, *forces.T, *rates.T])
    assert "vector_left_out" not in {f.kind for f in read_recording(path).findings}


@pytest.mark.parametrize(
    "cell, unit",
    [
        ("gyro_x_rad_s", "rad/s"),
        ("gyro_x_deg_s", "deg/s"),
        ("gyro_x_rads", "rad/s"),
        ("acc_x_m_s2", "m/s^2"),
        ("acc_x_m_s_2", "m/s^2"),
        ("acc_x_ms2", "m/s^2"),
        ("acc_x_m_per_s2", "m/s^2"),
        ("Accel_LN_X_CAL m/(s^2)", "m/(s^2)"),
        ("Accel_LN_X_CAL [m/(s^2)]", "m/(s^2)"),
        ("Accel X (m/(s^2))", "m/(s^2)"),
        ("mag_x_uT", "uT"),
        ("temp_degC", "degC"),
        ("imu_temperature_c", "degC"),
        ("tempC", "degC"),
        ("board_temp_k", "K"),
        ("time_s", "s"),
        ("w", None),
        ("g_x", None),
    ],
)
def test_unit_that_ends_a_name(cell, unit):
    assert named(cell).unit == unit


@pytest.mark.parametrize(
    "cells, own",
    [
        (["temp_c", "pressure_pa"], "temp_c"),
        (["sht_temperature_c", "qmp_temperature_c", "imu_temperature_c"], "imu_temperature_c"),
        (["gyro_temp", "baro_temp"], "gyro_temp"),
        (["cpu_temp", "baro_temp"], None),
        (["gyro_temp", "accel_temp"], None),
    ],
)
def test_the_thermometer_of_the_sensors(cells, own):
    """Of several the one that is named as theirs: what warms is said by none of the others."""
    found = thermometer(named(cell) for cell in cells)
    assert (found and found.cell) == own


def test_a_counter_is_in_no_unit():
    """A part file's ``counts`` are LSB; names of counters end so, and stay whole."""
    assert named("sample_count").words == ("sample", "count")
    assert named("sample_counts").unit is None


@pytest.mark.parametrize(
    "gyro, accel",
    [("gyro_{}_rad_s", "acc_{}_m_s2"), ("gyro_{}_mm", "acc_{}_s"), ("gyro {} (g)", "acc {} (deg)")],
)
def test_a_unit_that_cannot_be_is_not_proposed(gyro, accel, tmp_path):
    time, rates, forces = turned()
    cells = [form.format(a) for form in (gyro, accel) for a in "xyz"]
    path = written(tmp_path, ",".join(["time_s", *cells]), [time * 1e-9, *rates.T, *forces.T])
    assert proposed(open_reader(path)).units == {"time": "s", "gyro": "rad/s", "accel": "m/s^2"}


def test_rows_of_names_and_of_units_in_brackets(tmp_path):
    time, rates, forces = turned()
    names = [f"Shimmer_Accel_LN_{a}_CAL" for a in "XYZ"] + [f"Shimmer_Gyro_{a}_CAL" for a in "XYZ"]
    units = ["ms", *["m/(s^2)"] * 3, *["(deg/s)"] * 3]
    lines = ["\t".join(["Timestamp", *names]), "\t".join(units)]
    columns = [time * 1e-6, *forces.T, *np.degrees(rates).T]
    found = read_recording(raw_logs.text(tmp_path / "log.csv", lines, columns, "\t"))
    np.testing.assert_array_equal(found.accel, forces)
    np.testing.assert_allclose(found.gyro, rates, rtol=1e-14)


@pytest.mark.parametrize("file", ["Gyroskop.csv", "1.csv"])
def test_a_vector_without_a_name_is_told_by_its_unit(file, tmp_path):
    time, rates, _ = turned()
    path = written(
        tmp_path, "Time (s),X (rad/s),Y (rad/s),Z (rad/s)", [time * 1e-9, *rates.T], file
    )
    np.testing.assert_array_equal(inspect(path).recording.gyro, rates)


def test_xsens_with_its_magnetometer_and_angles(tmp_path):
    time, rates, forces = raw_logs.still(300)
    names = ["PacketCounter", "SampleTimeFine", *(f"Acc_{a}" for a in "XYZ")]
    names += [*(f"Gyr_{a}" for a in "XYZ"), *(f"Mag_{a}" for a in "XYZ"), "Roll", "Pitch", "Yaw"]
    more = np.tile([0.1, 0.2, 0.3, 1, 2, 3], (300, 1))
    columns = [np.arange(300), time // 10**5, *forces.T, *rates.T, *more.T]
    path = raw_logs.text(
        tmp_path / "mt.txt", ["// Update Rate: 100.0Hz", "\t".join(names)], columns, "\t"
    )
    np.testing.assert_array_equal(read_recording(path).gyro, rates)
    found = inspect(path)
    assert (found.problem, found.kind) == ("", "known") and len(found.recording) == 300
    read_recording(path, found.write_map(tmp_path / "map.toml"))


def test_movella_dot_behind_its_lines_of_tags(tmp_path):
    time, rates, forces = raw_logs.still(300)
    head = ["DeviceTag:,foo", "FirmwareVersion:,1.0", "OutputRate:,100Hz", ""]
    names = ["PacketCounter", "SampleTimeFine", *(f"Euler_{a}" for a in "XYZ")]
    names += [*(f"Acc_{a}" for a in "XYZ"), *(f"Gyr_{a}" for a in "XYZ")]
    columns = [np.arange(300), time // 1000, *np.zeros((3, 300)), *forces.T, *rates.T]
    for lines in (head, ["sep=,"]):
        path = raw_logs.text(tmp_path / "dot.csv", [*lines, ",".join(names)], columns)
        found = read_recording(path)
        np.testing.assert_allclose(np.degrees(found.gyro), rates, rtol=1e-14)
        assert found.findings[1].detail == {"as": "Xsens, by its manuals"}


# Own names beside others


def mixed(folder, head, columns):
    path = written(folder, head, columns, "mixed.csv")
    found = inspect(path)
    return path, found, read_recording(path, found.write_map(folder / "map.toml"))


@pytest.mark.parametrize(
    "head, at_once",
    [
        ("time [s],{g}_x [dps],{g}_y [dps],{g}_z [dps],acc_x [g],acc_y [g],acc_z [g]", True),
        ("time_s,{g}_x [dps],{g}_y [dps],{g}_z [dps],accel_x [g],accel_y [g],accel_z [g]", True),
        ("time,{g}_x [dps],{g}_y [dps],{g}_z [dps],acc_x [g],acc_y [g],acc_z [g]", False),
        ("time [s],{g}_x [dps],{g}_y [dps],{g}_z [dps],acc_x,acc_y,acc_z", False),
        ("time[s],gx[deg/s],gy[deg/s],gz[deg/s],ax[g],ay[g],az[g]", False),
    ],
)
def test_own_names_beside_others_are_guessed(head, at_once, tmp_path):
    time, rates, forces = turned()
    columns = [time * 1e-9, *np.degrees(rates).T, *(forces / G).T, 21.5 + 0 * rates[:, 0]]
    path, found, mapped = mixed(tmp_path, head.format(g="gyro") + ",supply [V]", columns)
    assert not found.problem and found.proposals[0].open_questions == []
    for recording in [found.recording, mapped, *([read_recording(path)] if at_once else [])]:
        np.testing.assert_allclose(recording.gyro, rates, rtol=1e-14)
        np.testing.assert_allclose(recording.accel, forces, rtol=1e-14)
        assert set(recording.supply) == {21.5}


def test_a_map_s_own_misspelling_is_told(tmp_path):
    time, rates, _ = raw_logs.still(100)
    path = written(tmp_path, "t,wx,wy,wz", [time, *rates.T])
    (tmp_path / "m.toml").write_text(
        '[columns]\n"t" = "time [ns]"\n"wx" = "gyr_x [rad/s]"\n'
        '"wy" = "gyro_y [rad/s]"\n"wz" = "gyro_z [rad/s]"\n'
    )
    with pytest.raises(UserError, match="unknown column 'gyr_x', did you mean gyro_x"):
        read_recording(path, tmp_path / "m.toml")


def test_two_lines_of_comment_name_columns_and_units(tmp_path):
    time, rates, forces = turned()
    lines = ["% time gx gy gz ax ay az", "% s rad/s rad/s rad/s m/s2 m/s2 m/s2"]
    path = raw_logs.text(tmp_path / "l.txt", lines, [time * 1e-9, *rates.T, *forces.T], " ")
    found = inspect(path)
    assert not found.problem
    np.testing.assert_array_equal(found.recording.accel, forces)


def test_a_map_may_take_another_column_for_a_name_without_a_unit(tmp_path):
    """A table may have a ``time`` of its own beside the one that a map names, as guessed or given;
    a name that the map itself leaves without a unit is refused still.
    """
    stamps, rates = np.arange(300) * 10_000_000, np.full(300, 0.1)
    path = raw_logs.text(
        tmp_path / "l.csv", ["time,stamp,gx,gy,gz"], [stamps + 7, stamps, *[rates] * 3]
    )
    names = [f'"g{a}" = "gyro_{a} [rad/s]"' for a in "xyz"]
    own = tmp_path / "map.toml"
    own.write_text("\n".join(["[columns]", '"stamp" = "time [ns]"', *names]))
    found = read_recording(path, own)
    np.testing.assert_allclose(found.time, stamps * 1e-9, rtol=0, atol=1e-15)
    assert [f.column for f in found.findings if f.kind == "unused_column"] == ["time"]
    own.write_text("\n".join(["[columns]", '"stamp" = "time"', *names]))
    with pytest.raises(UserError, match="column time has no unit"):
        read_recording(path, own)


def test_what_is_a_plain_number_needs_no_unit(tmp_path):
    q, rates = np.tile([1.0, 0.0, 0.0, 0.0], (50, 1)), np.full(50, 0.1)
    names = [*(f"ref_q_{c}" for c in "wxyz"), "stationary", *(f"gyro_{c} [rad/s]" for c in "xyz")]
    columns = [0.01 * np.arange(50), *q.T, np.ones(50), *[rates] * 3]
    found = read_recording(
        raw_logs.text(tmp_path / "l.csv", [",".join(["time [s]", *names])], columns)
    )
    np.testing.assert_array_equal(found.ref_q, q)
    assert found.stationary.all()


def attitudes(rows, turning):
    """Unit quaternions (rows, 4) of a tumbling body, or of one that is level, of nine digits."""
    angle = 2e-3 * np.outer(np.arange(rows), [1.0, 1.7, 0.6]) if turning else np.zeros((rows, 3))
    q = Rotation.from_euler("xyz", angle).as_quat(scalar_first=True)
    return np.round(q, 9)


@pytest.mark.parametrize("turning", [True, False], ids=["tumbling", "level"])
def test_a_quaternion_without_a_name_is_no_accelerometer(turning, tmp_path):
    """Poses without a header: of a level body the first three are (1, 0, 0), as of gravity in g."""
    time = np.arange(3000) * 2778
    place = np.cumsum(0.01 * np.random.default_rng(2).standard_normal((3000, 3)), axis=0)
    path = written(tmp_path, "", [time, *place.T, *attitudes(3000, turning).T])
    path.write_text(path.read_text().lstrip("\n"))
    found = inspect(path)
    assert found.proposals[0].groups == ["time"]
    assert "column 5, column 6, column 7, column 8 are left out" in found.proposals[0].notes[0]
    assert found.problem.endswith("name them in the map")


@pytest.mark.parametrize("noise", [1e-3, 1e-2], ids=["quiet", "noisy"])
@pytest.mark.parametrize("before", [0, 4], ids=["alone", "behind a quaternion"])
def test_an_accelerometer_in_g_at_rest_beside_a_gyro_is_no_quaternion(before, noise, tmp_path):
    """Four columns of it are as near to one as a quaternion of few digits."""
    time, gyro, accel = raw_logs.still(3000)
    force = [0.6, 0.0, 0.8] + noise * (accel - [0, 0, 9.81])
    columns = [time // 1000, *attitudes(3000, True).T[:before], *force.T, *gyro.T]
    path = written(tmp_path, "", columns)
    path.write_text(path.read_text().lstrip("\n"))
    (guess,) = (g for g in proposed(open_reader(path)).guesses if g.target == "accel_x")
    assert (guess.cell, guess.unit) == (f"column {2 + before}", "g")


def in_two(folder, whole, part, names="gyro_{} [rad/s]", late=0):
    """A log whose times stand in two columns; of the second second, for it is in no first row."""
    stamps = np.arange(300, dtype=np.int64) * 10_000_000 + raw_logs.FIRST + 123_456_789
    cells = [whole, part, *(names.format(a) for a in "xyz")]
    columns = [stamps // 10**9, stamps % 10**9 + late, *[np.full(300, 0.1)] * 3]
    return written(folder, ",".join(cells), columns), stamps


@pytest.mark.parametrize(
    "whole, part",
    [("sec", "nsec"), ("#secs", "nsecs"), ("seconds", "nanoseconds"), ("Sec [s]", "nSec [ns]")]
    + [("header.stamp.secs", "header.stamp.nsecs"), ("stamp_sec", "stamp_nanosec")],
)
def test_seconds_and_nanoseconds_are_one_time(whole, part, tmp_path):
    path, stamps = in_two(tmp_path, whole, part)
    found = read_recording(path)
    # whole nanoseconds, each rounded once
    np.testing.assert_array_equal(found.time, (stamps - stamps[0]) * 1e-9)
    (said,) = (f for f in found.findings if f.column == "time" and f.kind == "layout")
    assert said.detail == {"read_as": f"one time of {whole.strip('#')} and {part}"}


def test_a_time_in_two_columns_by_the_map_that_is_written(pyimu, tmp_path):
    path, stamps = in_two(tmp_path, "sec", "nsec", "w{}")
    assert pyimu("inspect", path, "--write-map", "map.toml")[0] == 1
    text = (tmp_path / "map.toml").read_text()
    assert '"time of sec and nsec [ns]" = "time [ns]"' in text
    (tmp_path / "map.toml").write_text(re.sub(r"# (.*rad/s\].*)", r"\1", text))
    found = read_recording(path, tmp_path / "map.toml")
    np.testing.assert_array_equal(found.time, (stamps - stamps[0]) * 1e-9)


def test_what_is_no_part_of_a_second_is_no_second_column(tmp_path):
    """Nanoseconds that count on; and a map that takes one of the two alone is followed."""
    path, _ = in_two(tmp_path, "sec", "nsec", late=10**9)
    with pytest.raises(UserError):
        read_recording(path)
    path, _ = in_two(tmp_path, "sec", "nsec", "w{}")
    lines = ["[columns]", '"sec" = "time [s]"', *(f'"w{a}" = "gyro_{a} [rad/s]"' for a in "xyz")]
    (tmp_path / "map.toml").write_text("\n".join(lines))
    kinds = {f.kind for f in read_recording(path, tmp_path / "map.toml").findings}
    assert "layout" not in kinds and kinds & {"repeated_time", "repeated_rows", "coarse_stamps"}


def test_a_row_without_one_half_of_its_time_is_refused(tmp_path):
    path, _ = in_two(tmp_path, "sec", "nsec")
    lines = path.read_text().splitlines()
    lines[200] = re.sub(r",\d+,", ",,", lines[200], count=1)
    path.write_text("\n".join(lines))
    with pytest.raises(UserError, match="row 201: the time is missing"):
        read_recording(path)


def test_columns_of_one_name_are_told_apart_in_a_map(tmp_path):
    """By their numbers: a key stands once in a map."""
    time, rates, forces = turned()
    path = written(tmp_path, "t,x,y,z,x,y,z", [time // 1000, *rates.T, *forces.T])
    found = inspect(path)
    read = read_recording(path, found.write_map(tmp_path / "map.toml"))
    np.testing.assert_array_equal(read.gyro, rates)
    np.testing.assert_array_equal(read.accel, forces)


@pytest.mark.parametrize("name, unit", [("micros", "us"), ("time_us", "us"), ("t", "us")])
def test_a_counter_that_wraps_is_a_time(name, unit, tmp_path):
    time, rates, forces = turned()
    ticks = (time // 1000 + 2**32 - 7_000_000) % 2**32
    path = written(tmp_path, f"{name},gx,gy,gz,ax,ay,az", [ticks, *rates.T, *forces.T])
    found = inspect(path)
    assert found.proposals[0].units["time"] == unit
    np.testing.assert_allclose(np.diff(found.recording.time), 0.01, rtol=1e-9)
    assert "counter_wrapped" in {f.kind for f in found.findings}


@pytest.mark.parametrize("name", ["Timestamp", "when"])
def test_a_date_is_proposed_as_the_time(name, tmp_path):
    _, rates, forces = turned()
    stamps = np.datetime64("2024-02-01T12:00:00.000") + np.arange(3000) * np.timedelta64(10, "ms")
    rows = [",".join(map(str, [t, *w, *f])) for t, w, f in zip(stamps, rates, forces, strict=True)]
    (tmp_path / "l.csv").write_text("\n".join([f"{name},gx,gy,gz,ax,ay,az", *rows]) + "\n")
    found = inspect(tmp_path / "l.csv")
    assert found.proposals[0].units == {"time": "s", "gyro": "rad/s", "accel": "m/s^2"}
    assert found.recording.time[0] == 12 * 3600
    assert found.recording.sample_rate == pytest.approx(100)


def test_a_map_whose_gyro_nobody_chose_a_unit_for_says_so(pyimu, tmp_path):
    """At rest nothing tells rad/s from deg/s: the map has a # before both."""
    time, rates, forces = raw_logs.still(400)
    written(tmp_path, "t,gx,gy,gz,ax,ay,az", [time * 1e-9, *rates.T, *(forces / G).T], "bare.csv")
    code, _, _ = pyimu("inspect", "bare.csv", "--write-map", "bare.toml")
    found = read_recording(tmp_path / "bare.csv", tmp_path / "bare.toml")
    (said,) = (f for f in found.findings if f.kind == "vector_left_out")
    assert code == 1 and said.detail == {"columns": "gx, gy, gz"}
    text = (tmp_path / "bare.toml").read_text()
    text = re.sub(r'(?m)^# ("g." = "gyro_. \[rad)', r"\1", text)
    (tmp_path / "bare.toml").write_text(text)
    found = read_recording(tmp_path / "bare.csv", tmp_path / "bare.toml")
    assert found.gyro is not None
    assert "vector_left_out" not in {f.kind for f in found.findings}


@pytest.mark.parametrize("name", ["Time (µs)", "time [us]", "t (usec)"])
def test_a_clock_s_unit_is_overruled_where_no_sensor_is_so_fast(name, tmp_path):
    """Steps of 0.01 us are 100 MHz; g's with 9.81 at rest are m/s^2. The header is quoted."""
    time, rates, forces = turned()
    head = f"{name},wx (rad/s),wy (rad/s),wz (rad/s),AccelX (g's),AccelY (g's),AccelZ (g's)"
    path = written(tmp_path, head, [time * 1e-9, *rates.T, *forces.T])
    why = {g.group: (g.unit, g.why) for g in proposed(open_reader(path)).guesses}
    assert why["time"][0] == "s" and re.search(r"\(the header says .*: 1e\+08 Hz\)", why["time"][1])
    assert why["accel"][0] == "m/s^2" and why["accel"][1].endswith("(the header says g's)")


@pytest.mark.parametrize(
    "name, size", [("Timestamp (µs)", 1000), ("Time (sec)", 1e9), ("t [milliseconds]", 1e6)]
)
def test_a_clock_s_unit_is_one_in_any_spelling(name, size, tmp_path):
    time, rates, forces = turned()
    head = f"{name}," + ",".join(f"gyro_{a} (rad/s)" for a in "xyz")
    head += "," + ",".join(f"acc_{a} (m/s^2)" for a in "xyz")
    read = read_recording(written(tmp_path, head, [time / size, *rates.T, *forces.T]))
    assert read.sample_rate == pytest.approx(100)


def test_of_a_header_whose_time_cannot_be_the_map_is_by_the_numbers(tmp_path):
    time, rates, forces = turned()
    head = "Time (µs),gyro_x (rad/s),gyro_y (rad/s),gyro_z (rad/s),"
    head += ",".join(f"acc_{a} (m/s^2)" for a in "xyz")
    path = written(tmp_path, head, [time * 1e-9, *rates.T, *forces.T])
    found = inspect(path)
    assert "are they in s, at 100 Hz?" in found.problem
    read = read_recording(path, found.write_map(tmp_path / "map.toml"))
    np.testing.assert_array_equal(read.gyro, rates)
    assert read.sample_rate == pytest.approx(100)


def test_of_too_few_rows_the_numbers_are_not_asked(tmp_path):
    head = "Time (ms),gyro_x (rad/s),gyro_y (rad/s),gyro_z (rad/s)"
    (tmp_path / "log.csv").write_text(f"{head}\n0,1,2,3\n10,1,2,3\n")
    found = inspect(tmp_path / "log.csv")
    assert "at least 3 rows of data" in found.problem
    assert found.proposals[0].units["time"] == "ms"
