"""Logs of tools that many have, in short pieces of their layouts with numbers of our own: what had
been refused, lost, or read in another unit or another column without a word.
"""

import json

import numpy as np
import pytest
from log_tables import empatica, nexus
from turned_logs import G, H, N, agrees, by_its_map, rows, turned, written

from pyimu import inspect, read_recording
from pyimu.errors import UserError
from pyimu.recording.guess.numbers import force_unit, sensitivities
from pyimu.recording.naming.languages import code_by_words, in_english
from pyimu.recording.naming.name import named


@pytest.fixture(scope="module")
def log():
    return turned()


# Headers in other languages, and in their codes

HEADS = {
    "german": ("Zeit [s]", "Beschleunigung {} [m/s²]", "Drehrate {} [rad/s]", "cp1252"),
    "glued": ("Zeit [s]", "Beschleunigung{} [m/s²]", "Winkelgeschwindigkeit{} [rad/s]", "utf-8"),
    "french": ("Temps (s)", "Accélération {} (m/s²)", "Vitesse angulaire {} (rad/s)", "cp1252"),
    "spanish": ("Tiempo (s)", "Aceleración {} (m/s²)", "Giroscopio {} (rad/s)", "utf-8"),
    "italian": ("Tempo (s)", "Accelerazione {} (m/s²)", "Velocità angolare {} (rad/s)", "utf-8"),
    "russian": ("Время (s)", "Ускорение {} (m/s^2)", "Угловая скорость {} (rad/s)", "cp1251"),
    "chinese": ("时间(s)", "加速度{}(m/s^2)", "角速度{}(rad/s)", "gb2312"),
    "taiwanese": ("時間(s)", "加速度{}(m/s^2)", "角速度{}(rad/s)", "big5"),
    "japanese": ("時刻[s]", "加速度{}[m/s^2]", "角速度{}[rad/s]", "shift_jis"),
    "korean": ("시간(s)", "가속도{}(m/s^2)", "각속도{}(rad/s)", "euc_kr"),
}


@pytest.mark.parametrize("language", HEADS)
def test_a_header_in_another_language_is_read_as_it_is(language, log, tmp_path):
    time, accel, gyro, code = HEADS[language]
    head = [time, *(accel.format(a) for a in "XYZ"), *(gyro.format(a) for a in "XYZ")]
    path = written(tmp_path / "log.csv", [",".join(head), *rows(log[0], log[2], log[1])], code)
    agrees(read_recording(path), log)


@pytest.mark.parametrize(
    "cell, words",
    [
        ("Winkelbeschleunigung X", ("alpha",)),  # an angular acceleration is no force
        ("角加速度X(rad/s^2)", ("alpha",)),
        ("Lineare Beschleunigung x (m/s²)", ("linear", "accel")),
        ("Template", ("template",)),
    ],
)
def test_words_of_other_languages(cell, words):
    assert named(cell).words == words


def test_english_stays_as_it_is():
    assert in_english("GyroX µT (°/s)") == "GyroX µT (°/s)"
    assert code_by_words(b"time,gyro") is None
    assert code_by_words("Größe [µT]".encode("cp1252")) is None


# Names

NAMES = {
    "IMeasureU": ("time_s", "ax_m/s/s", "gx_deg/s"),
    "Septentrio": ("TOW [s]", "X-Accel [m/s2]", "X-AngRate [deg/s]"),
    "x first": ("Time (s)", "X acceleration (m/s^2)", "X angular velocity (deg/s)"),
    "Delsys": ("Time [s]", "Trigno 1: ACC 1.X (IM) [m/s^2]", "Trigno 1: GYRO 1.X (IM) [deg/s]"),
}


@pytest.mark.parametrize("tool", NAMES)
def test_the_axis_and_the_unit_of_a_name(tool, log, tmp_path):
    """Of these the accelerometer or the gyro had been lost."""
    time, *vectors = NAMES[tool]
    split = [name.replace("ax", "aX").replace("gx", "gX").split("X") for name in vectors]
    cells = [f"{a}{axis}{b}" for a, b in split for axis in "XYZ"]
    cells = [c.lower() if tool == "IMeasureU" else c for c in cells]
    lines = [",".join([time, *cells]), *rows(log[0], log[2], np.degrees(log[1]))]
    agrees(read_recording(written(tmp_path / "log.csv", lines)), log)


def test_the_lower_half_of_a_number_of_32_bits_is_no_gyro(log, tmp_path):
    """Analog Devices' FX3 writes a register a column, the lower halves first."""
    counts = np.rint(np.degrees(log[1]) / 0.025)
    low = np.random.default_rng(1).integers(0, 65536, (N, 3))
    names = [f"{a}_GYRO_{half}" for a in "XYZ" for half in ("LOW", "OUT")]
    columns = [c for pair in zip(low.T, counts.T, strict=True) for c in pair]
    head = ",".join(["Time (s)", *names, *(f"{a}_ACCL_OUT" for a in "XYZ")])
    lines = [head, *rows(log[0], *columns, np.rint(log[2] / G * 800))]
    found = by_its_map(written(tmp_path / "log.csv", lines), tmp_path)
    agrees(found, log, gyro=np.radians(0.0126), accel=G / 1600 * 1.01)


def test_a_temperature_beside_a_stated_rate_is_no_misspelling(log, tmp_path):
    """ActiGraph's IMU: a rate above the table, times in it, and a column ``Temperature``."""
    names = [f"{s} {a}" for s in ("Accelerometer", "Gyroscope") for a in "XYZ"]
    head = "--- Data File Created By ActiGraph ActiLife date format M/d/yyyy at 100 Hz IMU ---"
    stamps = [f"2024-02-01T10:30:{k * H:09.6f}" for k in range(N)]
    lines = [head, ",".join(["Timestamp", *names, "Temperature"])]
    lines += rows(stamps, log[2] / G, np.degrees(log[1]), np.full(N, 31.5))
    path = written(tmp_path / "log.csv", lines)
    with pytest.raises(UserError, match="name its columns in a column map"):
        read_recording(path)
    agrees(by_its_map(path, tmp_path), log)


# Sizes of counts


@pytest.mark.parametrize(
    "size, counts",
    [
        (4000.4, None),
        (4095.0, 4096),
        (4050.0, None),
        (8190.0, 8192),
        (801.0, 800),
        (1251.0, 1250),
        (1201.0, 1200),
        (1024.0, 1024),
        (16384.0, 16384),
        (10003.0, 10000),
        (9806.0, 9807),  # mm/s^2
        (6000.0, None),
    ],
)
def test_counts_of_a_g(size, counts):
    """Of 4000 a g 4096 had been taken, 2.4 % off. A bias of 23 mg makes 4000 of 4096: both are said
    where it may be either, and 4096 alone above it.
    """
    noise = np.random.default_rng(3).normal(0, 3, (3000, 3))
    found = force_unit(np.rint(noise + [0, 0, size]))
    assert (None if found.value is None else round(1 / found.value)) == counts
    either = {4050.0: [4096, 4000], 4000.4: [4000, 4096]}
    assert [round(1 / s) for s in found.sizes] == either.get(size, [])


@pytest.mark.parametrize("lsb, off", [(1000 * np.pi / 180, 1.004), (1000, 0.996), (16.4, 1.02)])
def test_whole_numbers_that_programs_write(lsb, off):
    """Of mrad/s the 16.4 counts a deg/s of InvenSense had been taken."""
    assert sensitivities(lsb * off).value == pytest.approx(1 / lsb)


@pytest.mark.parametrize(
    "tick, first, size",
    [
        ("Ticks", 638424000000000000, 1e-7),  # .NET's, since the year 1
        ("FileTime", 133512736520000000, 1e-7),  # Windows', since 1601
    ],
)
def test_ticks_of_100_ns(tick, first, size, log, tmp_path):
    """They had been taken for us, at a tenth of the rate."""
    stamps = [str(first + round(t / size)) for t in log[0]]
    head = ",".join([tick, *(f"{v}{a}" for v in ("Acc", "Gyr") for a in "XYZ")])
    lines = [head, *rows(stamps, log[2], log[1])]
    agrees(by_its_map(written(tmp_path / "log.csv", lines), tmp_path), log)


@pytest.mark.parametrize(
    "size, unit", [(980.4, None), (987.0, None), (993.0, "mg"), (1003.0, "mg")]
)
def test_numbers_near_1000_may_be_cm_a_second_squared(size, unit):
    """They had been taken for mg, 2 % off, with a remark in the map alone."""
    noise = np.random.default_rng(4).normal(0, 1, (3000, 3))
    found = force_unit(noise + [0, 0, size])
    assert found.unit == unit
    assert found.choices == (() if unit else ("mg", "cm/s^2"))


@pytest.mark.parametrize("lsb", [10, 20, 25, 40, 160, 100, 16.4, 65.5, 131])
@pytest.mark.parametrize("off", [0.98, 1.0, 1.02])
def test_counts_of_a_degree_a_second(lsb, off):
    """Of 40 (ADIS16495-2) the 32.8 of InvenSense had been taken."""
    found = sensitivities(lsb * off)
    assert found.value == pytest.approx(1 / lsb) or lsb in 1 / np.array(found.sizes)


def test_angles_between_samples_are_no_rates(log, tmp_path):
    """KVH's fibre-optic units give the angle since the last sample, in degrees."""
    head = "Time (s),Gyro X (deg),Gyro Y (deg),Gyro Z (deg),Accel X (g),Accel Y (g),Accel Z (g)"
    lines = [head, *rows(log[0], np.degrees(log[1]) * H, log[2] / G)]
    found = by_its_map(written(tmp_path / "log.txt", lines), tmp_path)
    agrees(found, log, gyro=1e-5)


def test_numbers_of_the_sensors_between_the_vectors_are_no_axes(log, tmp_path):
    """Sensorstream on Android: 3 before the accelerations, 4 before the rates."""
    lines = rows(log[0], np.full(N, 3), log[2], np.full(N, 4), log[1], by=", ")
    agrees(by_its_map(written(tmp_path / "log.csv", lines), tmp_path), log)


# Programs


def opensignals(tmp_path, values):
    device = {"sampling rate": 100, "column": ["nSeq", "I1", "O1", "A1", "A2", "A3"]}
    lines = [
        "# OpenSignals Text File Format",
        f"# {json.dumps({'98:D3': device})}",
        "# EndOfHeader",
    ]
    zeros = np.zeros(N)
    lines += rows(np.arange(N) % 16, zeros, zeros, np.rint(values), by="\t")
    return written(tmp_path / "opensignals.txt", lines)


def test_opensignals_has_its_names_and_its_rate(log, tmp_path):
    path = opensignals(tmp_path, 512 + 100 * log[2] / G)
    found = inspect(path)
    assert 'sample_rate = {value = 100, unit = "Hz"}' in found.column_map
    assert "A1, A2, A3 may be the accel: whole numbers about 512" in found.column_map
    assert found.recording is None  # and neither mg nor another channel's columns
    scale = '[scale]\naccel = {value = 0.01, unit = "g", offset = -5.12}\n'
    columns = "".join(f'"A{k}" = "accel_{a} [count]"\n' for k, a in enumerate("xyz", 1))
    (tmp_path / "map.toml").write_text(f"[columns]\n{columns}{scale}")
    read = read_recording(path, tmp_path / "map.toml")
    np.testing.assert_allclose(read.accel, log[2], rtol=0, atol=0.006 * G)
    np.testing.assert_allclose(read.time, log[0], atol=1e-9)


@pytest.mark.parametrize("head", ["{", "[]", '{"a": 1}', '{"a": {"column": 3}}'])
def test_a_damaged_head_of_opensignals_is_a_table_all_the_same(head, log, tmp_path):
    path = opensignals(tmp_path, 512 + 100 * log[2] / G)
    lines = path.read_text().splitlines()
    written(path, [lines[0], f"# {head}", *lines[2:]])
    assert inspect(path).recording is None


def test_empatica_has_its_time_and_its_rate_above_its_numbers(log, tmp_path):
    found = read_recording(empatica(tmp_path, log))
    np.testing.assert_allclose(found.accel, log[2], rtol=0, atol=G / 128 * 1.001)
    np.testing.assert_allclose(found.time, np.arange(N) / 32, atol=1e-9)


def test_vicon_nexus_says_the_rate_of_its_devices(log, tmp_path):
    agrees(read_recording(nexus(tmp_path, log)), log, accel=1e-4)


# A word in each row that says whose sample it is


def mixed(log, head, words, form="{time},{word},{values}"):
    """Rows of gyro and accelerometer in turn, each vector at its own time."""
    lines = [head] if head else []
    for k, t in enumerate(log[0]):
        for word, vector, late in zip(words, log[1:], (0, 0.004), strict=True):
            values = ",".join(f"{v:.9g}" for v in vector[k])
            lines.append(form.format(time=f"{1000 * (t + late):.9g}", word=word, values=values))
    return lines


@pytest.mark.parametrize(
    "head, words, form",
    [
        ("timestamp (ms),sensor,x,y,z", ("GYR", "ACC"), "{time},{word},{values}"),
        ("", ("Gyroscope", "Accelerometer"), "{word},{time},{values}"),
        ("ms,sensor_type,x,y,z", ("4", "1"), "{time},{word},{values}"),  # Android's
        ("type;ms;x;y;z", ("gyroscope", "accelerometer"), "{word};{time};{values}"),
        (
            "",
            ("android.sensor.gyroscope", "android.sensor.accelerometer"),
            "{time},{word},{values}",
        ),
    ],
)
def test_rows_of_several_sensors(head, words, form, log, tmp_path):
    lines = mixed(log, head, words, form)
    if ";" in form:
        lines = [line.replace(",", ";") for line in lines]
    found = by_its_map(written(tmp_path / "log.csv", lines), tmp_path)
    np.testing.assert_allclose(found.gyro, log[1], rtol=0, atol=1e-8)
    np.testing.assert_allclose(found.accel, log[2], rtol=0, atol=1e-7)
    assert np.median(np.diff(found.time)) == pytest.approx(H)


def test_of_rows_of_several_sensors_one_that_is_not_there_is_named(log, tmp_path):
    path = written(tmp_path / "log.csv", mixed(log, "t,sensor,x,y,z", ("GYR", "ACC")))
    (tmp_path / "map.toml").write_text('[columns]\n"t" = "time [ms]"\n[topics]\nimu = "MAG"\n')
    with pytest.raises(UserError, match="topic"):
        read_recording(path, tmp_path / "map.toml")


def test_a_name_of_a_device_in_each_row_is_no_sensor(log, tmp_path):
    """WitMotion's tables have one, and all values in each row."""
    head = ",".join(["Time(s)", "Device", *(f"{n}{a}" for n in ("a", "w") for a in "xyz")])
    head = head.replace("ax", "ax(g)").replace("wx", "wx(deg/s)")
    lines = [head, *rows(log[0], ["WT901"] * N, log[2] / G, np.degrees(log[1]))]
    assert inspect(written(tmp_path / "log.csv", lines)).proposals[0].topic == ""


# Lines with labels


def test_a_number_in_front_of_the_labels_is_the_time(log, tmp_path):
    lines = [
        f"{round(1000 * t)}: " + " ".join(f"{n}={v:.9g}" for n, v in zip(LABELS, row, strict=True))
        for t, row in zip(log[0], np.hstack([log[2], log[1]]), strict=True)
    ]
    agrees(by_its_map(written(tmp_path / "serial.txt", lines), tmp_path), log)


LABELS = ("ax", "ay", "az", "gx", "gy", "gz")

ADAFRUIT = (
    "\t\tTemperature 25.00 deg C",
    "\t\tAccel X: {:.7f} \tY: {:.7f} \tZ: {:.7f} m/s^2 ",
    "\t\tGyro X: {:.7f} \tY: {:.7f} \tZ: {:.7f} radians/s ",
    "",
)
"""What the examples of Adafruit's libraries print of a sample."""


def printed(log, first=0, without=()):
    """The lines of the samples; ``without`` are (sample, line) that were lost."""
    lines = []
    for k in range(first, N):
        parts = (ADAFRUIT[0], ADAFRUIT[1].format(*log[2][k]), ADAFRUIT[2].format(*log[1][k]), "")
        lines += [line for i, line in enumerate(parts) if (k, i) not in without]
    return lines


def test_a_sample_in_several_lines(log, tmp_path):
    path = written(tmp_path / "serial.txt", ["MPU6050 Found!", *printed(log)])
    found = by_its_map(path, tmp_path, rate=100)
    agrees(found, log)
    (said,) = [f.detail["read_as"] for f in found.findings if f.kind == "layout"]
    assert "a sample in 2 lines" in said


def test_a_lost_line_of_a_sample_is_no_sample_of_another(log, tmp_path):
    """Without times it cannot be left out, and the row that is named is where it is missing."""
    lines = printed(log, without={(900, 2)})
    path = written(tmp_path / "serial.txt", lines)
    (tmp_path / "map.toml").write_text('sample_rate = {value = 100, unit = "Hz"}\n')
    with pytest.raises(UserError, match="row 36.. is no whole row.* mend it"):
        read_recording(path, tmp_path / "map.toml")


def test_a_log_of_samples_in_several_lines_that_was_cut(log, tmp_path):
    """It begins and ends in the middle of a sample."""
    lines = printed(log)[2:-2]
    found = by_its_map(written(tmp_path / "serial.txt", lines), tmp_path, rate=100)
    np.testing.assert_allclose(found.gyro, log[1][1:-1], rtol=0, atol=1e-6)
    np.testing.assert_allclose(found.accel, log[2][1:-1], rtol=0, atol=1e-6)


def test_lines_of_a_sample_out_of_turn_are_refused(tmp_path):
    kinds = np.random.default_rng(2).integers(0, 2, 200)
    lines = [f"{('Acceleration', 'Rotation')[k]} X: {i}, Y: 1" for i, k in enumerate(kinds)]
    with pytest.raises(UserError, match="in several lines, which do not come in turn, those of"):
        read_recording(written(tmp_path / "serial.txt", lines))
