"""Tables and lines as more loggers and programs print them: a gyro or a clock of theirs is neither
lost nor taken for another without a word.
"""

from functools import reduce

import numpy as np
import pandas as pd
import pytest
from rolling import rolls

from pyimu import inspect, read_recording
from pyimu.errors import UserError
from pyimu.recording.guess.numbers import force_unit
from pyimu.units import STANDARD_GRAVITY

N = 2000
TIME = 0.01 * np.arange(N)


@pytest.fixture(scope="module")
def vectors():
    """Gyro rad/s and accelerometer m/s^2 (n, 3) of a body that rolls."""
    rng = np.random.default_rng(17)
    gyro, up = rolls(TIME)
    noise = rng.standard_normal((2, N, 3))
    return (gyro + 2e-3 * noise[0]).round(6), (STANDARD_GRAVITY * up + 0.02 * noise[1]).round(6)


def written(path, head, columns, separator=",", code="utf-8"):
    """A table of ``columns`` of texts or numbers."""
    texts = [c if isinstance(c, list) else list(map(repr, c.tolist())) for c in columns]
    lines = [separator.join(row) for row in zip(*texts, strict=True)]
    path.write_text("\n".join([*head, *lines]) + "\n", encoding=code)
    return path


def same(found, gyro, accel):
    np.testing.assert_allclose(found.gyro, gyro, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(found.accel, accel, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(found.time - found.time[0], TIME, atol=1e-6)


def test_the_seconds_of_a_table_go_before_its_ticks(vectors, tmp_path):
    """Of DJI's tables as CsvView has them; ticks of 4.5 MHz are no us."""
    gyro, accel = vectors
    ticks = (4.5e6 * TIME).astype(int) + 10**9
    names = ["accelX", "accelY", "accelZ", "gyroX", "gyroY", "gyroZ"]
    head = ["Clock:Tick#", "Clock:offsetTime", *(f"IMU_ATTI(0):{n}" for n in names)]
    columns = [ticks, TIME.round(3), *accel.T / STANDARD_GRAVITY, *np.degrees(gyro).T]
    same(inspect(written(tmp_path / "log.csv", [",".join(head)], columns)).recording, gyro, accel)


@pytest.mark.parametrize("names", ["{}Rate-imu", "{} rate (rad/s)", "{}_rate"])
def test_rates_of_roll_pitch_and_yaw_are_a_gyro(names, vectors, tmp_path):
    gyro, accel = vectors
    turns = [names.format(t) for t in ("pitch", "roll", "yaw")]
    head = ",".join(["time (s)", *turns, *(f"{a}_Accel-imu" for a in "XYZ")])
    columns = [TIME, *gyro[:, [1, 0, 2]].T, *accel.T]
    same(inspect(written(tmp_path / "log.csv", [head], columns)).recording, gyro, accel)


def sentence(body):
    return f"${body}*{reduce(lambda a, b: a ^ b, body.encode(), 0):02X}"


def test_sentences_of_nmea(vectors, tmp_path):
    """What stands before a checksum is a number; other sentences and wrong ones are left out."""
    gyro, accel = vectors
    rows = np.column_stack([TIME, accel, gyro]).tolist()
    lines = [sentence("PIMU," + ",".join(map(repr, row))) for row in rows]
    lines[700] = lines[700].replace(",", ",9", 1)
    lines[::200] = [f"{line}\n{sentence('GPGGA,1,2,3')}" for line in lines[::200]]
    (tmp_path / "log.txt").write_text("\n".join(lines) + "\n")
    found = inspect(tmp_path / "log.txt").recording
    np.testing.assert_array_equal(found.gyro, np.delete(gyro, 700, axis=0))
    np.testing.assert_array_equal(found.accel, np.delete(accel, 700, axis=0))


def test_two_tabs_between_numbers_and_one_between_names(vectors, tmp_path):
    names = [f"{v}{a}" for v in ("Accel", "Gyro") for a in "XYZ"]
    head = "\t".join(["Time(ms)", *(f"{n}({'m/s^2' if 'A' in n else 'rad/s'})" for n in names)])
    columns = [(1000 * TIME).round().astype(int), *vectors[1].T, *vectors[0].T]
    same(read_recording(written(tmp_path / "log.txt", [head], columns, "\t\t")), *vectors)


START = pd.Timestamp("2024-05-06 23:59:55")

STAMPS = {
    "MATLAB's spans": [f"{t:g} sec" for t in TIME],
    "MATLAB's dates": [
        (START + pd.Timedelta(seconds=t)).strftime("%d-%b-%Y %H:%M:%S.%f") for t in TIME.round(2)
    ],
}


@pytest.mark.parametrize("stamps", STAMPS)
def test_times_of_a_timetable(stamps, vectors, tmp_path):
    names = [f"{v}_{k}" for v in ("AngularVelocity", "Acceleration") for k in (1, 2, 3)]
    columns = [STAMPS[stamps], *vectors[0].T, *vectors[1].T]
    path = written(tmp_path / "log.csv", [",".join(["Time", *names])], columns)
    same(inspect(path).recording, *vectors)


@pytest.mark.parametrize("code", ["utf-8", "gb2312"])
def test_names_in_chinese(code, vectors, tmp_path):
    """As WitMotion's program writes them."""
    head = ["时间(ms)", *(f"角速度{a}(°/s)" for a in "XYZ"), *(f"加速度{a}(g)" for a in "XYZ")]
    rates, forces = np.degrees(vectors[0]), vectors[1] / STANDARD_GRAVITY
    columns = [(1000 * TIME).round().astype(int), *rates.T, *forces.T]
    found = inspect(written(tmp_path / "log.txt", ["\t".join(head)], columns, "\t", code))
    same(found.recording, *vectors)
    assert {row[0] for row in found.columns} >= {"角速度X(°/s), 角速度Y(°/s), 角速度Z(°/s)"}


@pytest.mark.parametrize("name", ["Größe [µT]", "température (°C)", "résolution é"])
def test_western_letters_are_no_chinese_ones(name, tmp_path):
    columns = [TIME, *np.ones((4, N))]
    head = [f"time [s],gyro_x [rad/s],gyro_y [rad/s],gyro_z [rad/s],{name}"]
    path = written(tmp_path / "log.csv", head, columns, code="cp1252")
    assert name in {
        f.detail["header"] for f in read_recording(path).findings if "header" in f.detail
    }


LINES = {
    "several samples": (
        [
            "Type,Local Number,Message,Field 1,Value 1,Units 1",
            *['Data,3,gyroscope_data,gyro_x,"1|2|3",counts'] * 50,
        ],
        "is a list of FIT's messages, with several samples in a cell; have a table with a row for",
    ),
}


@pytest.mark.parametrize("lines", LINES)
def test_what_has_no_row_a_sample_says_so(lines, tmp_path):
    (tmp_path / "log.txt").write_text("\n".join(LINES[lines][0]))
    with pytest.raises(UserError, match=LINES[lines][1]):
        inspect(tmp_path / "log.txt")


def test_labview_without_a_column_of_times_has_their_distance(vectors, tmp_path):
    end = "***End_of_Header***"
    head = ["LabVIEW Measurement\t", "Separator\tTab", "Decimal_Separator\t.", "X_Columns\tNo"]
    head += [end, "Y_Unit_Label\trad/s\trad/s\trad/s\tm/s^2\tm/s^2\tm/s^2\t"]
    head += ["\t".join(["Delta_X", *["0.010000"] * 6, ""]), end]
    head += ["X_Value\tGyro_X\tGyro_Y\tGyro_Z\tAcc_X\tAcc_Y\tAcc_Z\tComment"]
    columns = [[""] * N, *vectors[0].T, *vectors[1].T]
    same(read_recording(written(tmp_path / "log.lvm", head, columns, "\t")), *vectors)


def test_of_a_table_that_states_its_units_a_map_may_say_the_rate_alone(vectors, tmp_path):
    names = [f"{v}{a}" for v in ("Accel", "Gyro") for a in "XYZ"]
    head = ",".join(f"{n}({'m/s^2' if 'A' in n else 'rad/s'})" for n in names)
    path = written(tmp_path / "log.csv", [head], [*vectors[1].T, *vectors[0].T])
    (tmp_path / "map.toml").write_text('sample_rate = {value = 100, unit = "samples/s"}\n')
    same(read_recording(path, tmp_path / "map.toml"), *vectors)
    found = inspect(path, tmp_path / "map.toml")
    assert found.readable and found.column_map.count("gyro_") == 3


def test_a_vector_called_by_its_axes_and_value_is_told_of(vectors, tmp_path):
    head = ["time,X_value,Y_value,Z_value"]
    path = written(tmp_path / "1.csv", head, [TIME, *vectors[0].T])
    (found,) = inspect(path).proposals
    assert any(
        "X_value, Y_value, Z_value are left out: they may be the gyro" in n for n in found.notes
    )


@pytest.mark.parametrize(
    "names", ["Unix Time,Microseconds", "tv_sec,tv_usec", "stamp.sec,stamp.usec"]
)
def test_seconds_and_microseconds_are_one_time(names, vectors, tmp_path):
    """As Advanced Navigation's tables have them, and what gettimeofday gives."""
    micros = (1e6 * TIME).round().astype(int) + 1_700_000_000_500_000
    head = [
        names + "," + ",".join(f"{v} {a}" for v in ("Accelerometer", "Gyroscope") for a in "XYZ")
    ]
    columns = [micros // 10**6, micros % 10**6, *vectors[1].T, *vectors[0].T]
    same(inspect(written(tmp_path / "log.csv", head, columns)).recording, *vectors)


def test_the_time_between_rows_is_none_and_axes_stand_before_words(vectors, tmp_path):
    """As ADI's evaluation software calls its outputs, with a thermometer in counts."""
    names = [f"{a}{v}_OUT" for v in ("GYRO", "ACCL") for a in "XYZ"]
    head = [",".join(["Delta Time (ms)", *names, "TEMP_OUT"])]
    columns = [np.full(N, 10.0), *vectors[0].T, *vectors[1].T, np.full(N, 250)]
    path = written(tmp_path / "log.csv", head, columns)
    (tmp_path / "map.toml").write_text('sample_rate = {value = 100, unit = "Hz"}\n')
    found = inspect(path, tmp_path / "map.toml")
    same(found.recording, *vectors)
    assert found.recording.temperature is None


def test_another_code_is_to_be_saved_as_utf8(tmp_path):
    """A code that a word for a quantity tells is read."""
    text = "番号,ひずみX(deg/s),ひずみY(deg/s),ひずみZ(deg/s)\n0,1,2,3\n"
    (tmp_path / "log.csv").write_bytes(text.encode("shift_jis"))
    with pytest.raises(UserError, match="save text in another code as UTF-8"):
        read_recording(tmp_path / "log.csv")


@pytest.mark.parametrize("middle, told", [(32768, None), (0, "g")])
def test_counts_without_a_sign_are_no_forces_yet(middle, told, vectors):
    """Zero is in the middle of a converter's numbers, as in OpenSignals' files."""
    counts = np.rint(8192 * vectors[1] / STANDARD_GRAVITY) + middle
    found = force_unit(counts)
    assert found.unit == told
    assert ("whole numbers about 32768" in found.why) == (told is None)
