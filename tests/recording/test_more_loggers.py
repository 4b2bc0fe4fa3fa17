"""What boards, phones and programs write, in their layouts with numbers of our own: what had not
been read, or in the wrong axes.
"""

import json

import numpy as np
import pytest
from log_tables import FRD
from turned_logs import G, H, agrees, by_its_map, rows, tumbled, written

from pyimu import inspect, read_recording
from pyimu.errors import UserError


@pytest.fixture(scope="module")
def log():
    return tumbled()


def lines(log, form):
    """A line for each sample, ``form`` filled with ms, mg, m/s^2, deg/s and rad/s."""
    return [
        form.format(ms=round(1000 * t), mg=1000 * f / G, f=f, dps=np.degrees(w), w=w, s=t)
        for t, w, f in zip(*log, strict=True)
    ]


SPARKFUN = (
    "Scaled. Acc (mg) [ {mg[0]:010.3f}, {mg[1]:010.3f}, {mg[2]:010.3f} ], Gyr (DPS) [ "
    "{dps[0]:010.4f}, {dps[1]:010.4f}, {dps[2]:010.4f} ], Tmp (C) [ 00024.42 ]"
)
ADAFRUIT = (
    "Accl:\tx= {f[0]:.5f} |\ty= {f[1]:.5f} |\tz= {f[2]:.5f}\t"
    "Gyro:\tx= {w[0]:.6f} |\ty= {w[1]:.6f} |\tz= {w[2]:.6f}"
)
LISTED = "[{f[0]:.6f}, {f[1]:.6f}, {f[2]:.6f}, {w[0]:.6f}, {w[1]:.6f}, {w[2]:.6f}]"
NESTED = (
    '{{"t": {ms}, "accelerometer": {{"x": {f[0]:.6f}, "y": {f[1]:.6f}, "z": {f[2]:.6f}}}, '
    '"gyroscope": {{"x": {w[0]:.6f}, "y": {w[1]:.6f}, "z": {w[2]:.6f}}}}}'
)


@pytest.mark.parametrize("form", [SPARKFUN, ADAFRUIT, LISTED, NESTED])
def test_lines_of_boards(form, log, tmp_path):
    """SparkFun's ICM-20948 example, Adafruit's of the BNO055, a list on each line, and JSON in a
    file that is called a text.
    """
    path = written(tmp_path / "log.txt", ["Starting", *lines(log, form)][form == NESTED :])
    (tmp_path / "rate.toml").write_text(f'sample_rate = {{value = {1 / H}, unit = "Hz"}}\n')
    timed = form == NESTED
    found = inspect(path, None if timed else tmp_path / "rate.toml").recording
    agrees(found, log, gyro=2e-6, accel=1e-5)


def test_the_time_that_tera_term_writes(log, tmp_path):
    """``[Fri May 03 10:00:00.123 2024]``: the row behind it had been no number."""
    form = "[Fri May 03 10:00:{s:06.3f} 2024] " + LISTED.strip("[]").replace(", ", ",")
    agrees(by_its_map(written(tmp_path / "teraterm.log", lines(log, form)), tmp_path), log)


# Messages


STEM = "/sensor_combined/"
PX4 = ["__time", *(f"{STEM}accelerometer_m_s2.0{k}" for k in range(3))]
PX4 += [f"{STEM}gyro_rad.0{k}" for k in range(3)]


def test_axes_of_px4_in_plotjuggler(log, tmp_path):
    """They had been taken for forward-left-up in silence."""
    path = written(
        tmp_path / "log.csv", [",".join(PX4), *rows(log[0] + 3, log[2] * FRD, log[1] * FRD)]
    )
    agrees(read_recording(path), log)


@pytest.mark.parametrize("every", [1, 5])
def test_rows_of_another_message_are_none(every, log, tmp_path):
    """PlotJuggler's table of two topics: at one row in six nothing was known, and gravity was not
    seen.
    """
    names = [f"/imu/{n}/{a}" for n in ("angular_velocity", "linear_acceleration") for a in "xyz"]
    table = [",".join(["__time", *names, "/odom/speed"])]
    for k, row in enumerate(rows(1.7e9 + log[0], log[1], log[2], form="{:.12g}")):
        table += [row + ",", *[f"{1.7e9 + log[0][k] + 0.003:.6f},,,,,,,0.1"] * (k % every == 0)]
    agrees(by_its_map(written(tmp_path / "log.csv", table), tmp_path), log)


# Samples of one sensor each


@pytest.mark.parametrize("by", [";", ","])
def test_androids_numbers_of_sensors_need_no_header(by, log, tmp_path):
    table = []
    for t, w, f in zip(*log, strict=True):
        stamp = f"{round(1e9 * t) + 10**14}"
        table += [
            by.join([stamp, kind, *(f"{v:.7f}" for v in of)]) for kind, of in (("1", f), ("4", w))
        ]
    agrees(by_its_map(written(tmp_path / "log.txt", table), tmp_path), log)
    # Those of something that stays are none.
    quiet = [
        f"{row.partition(by)[0]}{by}{1 + 3 * (k > 60)}{by}0.1{by}0.2{by}0.3"
        for k, row in enumerate(table)
    ]
    assert "gyro" not in inspect(written(tmp_path / "other.txt", quiet)).proposals[0].groups


def test_sensor_loggers_json(log, tmp_path):
    """Each sample says whose it is; its Accelerometer is without gravity."""
    table = []
    for t, w, f in zip(*log, strict=True):
        for name, vector in (("Accelerometer", 0 * f), ("TotalAcceleration", f), ("Gyroscope", w)):
            time = {"time": str(17 * 10**17 + round(1e9 * t)), "seconds_elapsed": f"{t:.6f}"}
            table.append({"sensor": name} | time | dict(zip("xyz", map(str, vector), strict=True)))
    (tmp_path / "log.json").write_text(json.dumps(table))
    found = by_its_map(tmp_path / "log.json", tmp_path)
    agrees(found, log)
    (tmp_path / "map.toml").write_text('[topics]\nimu = "Barometer"\n')
    with pytest.raises(UserError, match="has no topics"):
        read_recording(tmp_path / "log.json", tmp_path / "map.toml")


# Tables of vehicles, and two in one


def test_rates_that_their_unit_tells(log, tmp_path):
    head = "time [s],ax [g],ay [g],az [g],roll [deg/s],pitch [deg/s],yaw [deg/s]"
    path = written(tmp_path / "log.csv", [head, *rows(log[0], log[2] / G, np.degrees(log[1]))])
    agrees(read_recording(path), log)


def test_what_a_blank_line_parts_from_the_names_is_none(log, tmp_path):
    """MoTeC's table; its accelerations had been left out without a word."""
    head = ["Format,MoTeC CSV File,,,Workbook,", "Sample Rate,100.000,Hz,,Range,", ""]
    head += [
        "Time,G Force Long,G Force Lat,G Force Vert,Gyro Roll Rate,Gyro Pitch Rate,Gyro Yaw Rate"
    ]
    head += ["s,G,G,G,deg/s,deg/s,deg/s", "", ""]
    path = written(tmp_path / "log.csv", [*head, *rows(log[0], log[2] / G, np.degrees(log[1]))])
    agrees(by_its_map(path, tmp_path), log)


def test_a_second_table_below_the_first_is_said(log, tmp_path):
    table = ["t,ax,ay,az", *rows(log[0], log[2]), "t,gx,gy,gz", *rows(log[0], log[1])]
    with pytest.raises(UserError, match=r"row 2002: 't' is no number.*a file of its own"):
        inspect(written(tmp_path / "log.csv", table))


def test_a_row_for_each_value_is_told_what_to_do(log, tmp_path):
    long, influx = ["time,sensor,axis,value"], [",result,table,_time,_value,_field,_measurement"]
    for t, w, f in zip(*log, strict=True):
        for name, vector in (("acc", f), ("gyro", w)):
            long += [f"{t:.3f},{name},{a},{v:.6f}" for a, v in zip("xyz", vector, strict=True)]
        influx.append(f",,0,2024-05-03T10:00:{t:06.3f}Z,{f[0]:.6f},ax,imu")
    for table in (long, influx):
        with pytest.raises(UserError, match="a row for each value of each axis .*; make a column"):
            inspect(written(tmp_path / "log.csv", table))
    # A column that is called a value beside a sensor's is none.
    whole = [
        "t,ax,ay,az,gx,gy,gz,value,state",
        *rows(*log[::2], log[1], log[0], ["x"] * len(log[0])),
    ]
    assert inspect(written(tmp_path / "log.csv", whole)).recording is not None


def test_the_accelerometer_s_file_beside_a_gyro_s_is_named(log, tmp_path):
    """ADVIO: tables of the time and a vector, without names."""
    gyro = written(tmp_path / "gyro.csv", rows(log[0], log[1]))
    written(tmp_path / "frames.csv", rows(log[0], range(len(log[0]))))
    written(tmp_path / "linear_acceleration.csv", rows(log[0], 0 * log[2]))
    assert "inspect" not in inspect(gyro).problem
    force = written(tmp_path / "accelerometer.csv", rows(log[0], log[2]))
    assert (
        f"or let the accelerometer beside it tell: pyimu inspect {gyro} {force}"
        in inspect(gyro).problem
    )
    (tmp_path / "map.toml").write_text(inspect([gyro, force]).column_map)
    agrees(read_recording(gyro, tmp_path / "map.toml"), log)


# Frames and prints


@pytest.mark.parametrize("kind", ["parquet", "json"])
def test_dates_in_the_index_of_a_frame_are_its_times(kind, log, tmp_path):
    """They had been said to count the rows, as what is called an index does."""
    pandas = pytest.importorskip("pandas")
    names = [f"{n}{a}" for n in "ag" for a in "xyz"]
    times = pandas.to_datetime(1_714_730_462_000 + np.rint(1000 * log[0]), unit="ms")
    frame = pandas.DataFrame(np.column_stack([log[2], log[1]]), columns=names, index=times)
    path = tmp_path / f"log.{kind}"
    if kind == "parquet":
        frame.to_parquet(path)
    else:
        whole = frame.reset_index().assign(index=1_714_730_462_000 + np.rint(1000 * log[0]))
        whole.to_json(path, orient="records", double_precision=12)
    agrees(by_its_map(path, tmp_path), log)


def test_arrays_as_numpy_prints_them_behind_a_time(log, tmp_path):
    """Blanks pad their numbers, so that rows had eight cells or seven."""
    form = "{s:.3f} [{f[0]: .6f} {f[1]: .6f} {f[2]: .6f}] [{w[0]: .6f} {w[1]: .6f} {w[2]: .6f}]"
    agrees(by_its_map(written(tmp_path / "log.txt", lines(log, form)), tmp_path), log)


def test_units_in_letters_of_any_size(log, tmp_path):
    head = "t [mS],ax [mG],ay [mG],az [mG],gx [mDPS],gy [mDPS],gz [mDPS]"
    table = [head, *rows(1000 * log[0], 1000 * log[2] / G, 1000 * np.degrees(log[1]))]
    agrees(by_its_map(written(tmp_path / "log.csv", table), tmp_path), log)


@pytest.mark.parametrize(
    "form, second",
    [
        ("{v}{a}_{s}", "right"),
        ("{v}_{a}_{word}", "right"),
        ("{v}{a}{dot}", "1"),
        ("{part}_{v}{a}", "bmi160"),
    ],
)
def test_the_second_sensor_by_what_stands_behind_its_axes(form, second, log, tmp_path):
    """They were told by their numbers, or not at all, and none was offered."""
    sides = [
        {"s": "L", "word": "left", "dot": "", "part": "mpu6050"},
        {"s": "R", "word": "right", "dot": ".1", "part": "bmi160"},
    ]
    names = [form.format(v=v, a=a, **side) for side in sides for v in ("a", "g") for a in "xyz"]
    if "word" in form:
        names = [n.replace("a_", "acc_").replace("g_", "gyr_") for n in names]
    other = [part[:, [1, 2, 0]] for part in log[1:]]
    table = [",".join(["t", *names]), *rows(log[0], log[2], log[1], other[1], other[0])]
    path = written(tmp_path / "log.csv", table)
    agrees(by_its_map(path, tmp_path), log)
    agrees(inspect(path, sensor=second).recording, [log[0], *other])
