"""Layouts that people bring, in short pieces with numbers of our own: what had been read wrong in
silence, or refused without the word that helps.
"""

import gzip

import numpy as np
import pytest
from turned_logs import G, H, N, agrees, by_its_map, rows, turned, written

from pyimu import inspect
from pyimu.errors import UserError
from pyimu.recording.formats.pairs import pairs_of
from pyimu.recording.guess.numbers import warmth_unit
from pyimu.recording.naming.name import named


@pytest.fixture(scope="module")
def log():
    return turned()


def test_cm_a_second_squared_without_a_unit_is_asked_about(log, tmp_path):
    """It had been taken for mg: every force 2 % too small, and "gravity is 981" in a remark."""
    head = "t_ms,ax,ay,az,gx,gy,gz"
    path = written(tmp_path / "log.csv", [head, *rows(1000 * log[0], 100 * log[2], log[1])])
    found = inspect(path)
    assert found.recording.accel is None
    assert "choose the unit of accel in the map" in found.report()
    chosen = found.column_map
    for axis in "xyz":
        assert f'# "a{axis}" = "accel_{axis} [mg]"' in chosen
        line = f'"a{axis}" = "accel_{axis} [cm/s^2]"'
        chosen = chosen.replace("# " + line, line)
    (tmp_path / "chosen.toml").write_text(chosen)
    agrees(inspect(path, tmp_path / "chosen.toml").recording, log)


def test_gal_as_geophysicists_write_it(log, tmp_path):
    head = "t [s],ax [gal],ay [gal],az [gal],gx [rad/s],gy [rad/s],gz [rad/s]"
    lines = [head, *rows(log[0], 100 * log[2], log[1])]
    agrees(by_its_map(written(tmp_path / "log.csv", lines), tmp_path), log)


@pytest.mark.parametrize(
    "cell, unit",
    [
        ("temp [F]", "degF"),
        ("Temperature (°F)", "degF"),
        ("temp_f", "degF"),
        ("MagX [mGa]", "mGa"),
        ("Mag_X_nT", "nT"),
    ],
)
def test_units_of_headers(cell, unit):
    assert named(cell).unit == unit


@pytest.mark.parametrize("middle, unit", [(77.0, None), (25.0, "degC"), (58.0, "degC"), (298, "K")])
def test_a_temperature_that_may_be_in_fahrenheit_is_asked_about(middle, unit):
    """25 degC in a room are 77 degF, which had been taken for degC."""
    assert warmth_unit(middle + 0.1 * np.sin(np.arange(300.0))).unit == unit


def of_vectors(form):
    """Lines with a vector behind each label."""

    def made(log):
        return [
            form.format(round(1000 * t), *(f"{v:.9g}" for v in (*f, *w)))
            for t, w, f in zip(*log, strict=True)
        ]

    return made


VECTORS = {
    "commas": of_vectors("acc: {1},{2},{3} gyro: {4},{5},{6}"),
    "named axes": of_vectors("AccXYZ={1};{2};{3} GyroXYZ={4};{5};{6}"),
    "a time": of_vectors("time: {0}, accel: {1}, {2}, {3}, gyro: {4}, {5}, {6}"),
    "brackets": of_vectors("{0} Acc [{1}, {2}, {3}] Gyro [{4}, {5}, {6}]"),
    "letters": of_vectors("t:{0} A:({1},{2},{3}) G:({4},{5},{6})"),
    "JSON": of_vectors('{{"t": {0}, "acc": [{1}, {2}, {3}], "gyr": [{4}, {5}, {6}]}}'),
    "units": of_vectors("acc: {1} {2} {3} m/s^2 gyro: {4} {5} {6} rad/s"),
    "two lines": of_vectors("acc: {1},{2},{3}\ngyro: {4},{5},{6}"),
    "labels alone": of_vectors("Acc\n{1}\n{2}\n{3}\nGyro\n{4}\n{5}\n{6}"),
    "labels above": of_vectors("Acc (m/s^2):\n{1} {2} {3}\nGyro (rad/s):\n{4} {5} {6}"),
}


@pytest.mark.parametrize("kind", VECTORS)
def test_a_label_before_a_vector(kind, log, tmp_path):
    """They had been cut at the commas, or taken for a table without names."""
    path = written(tmp_path / "log.txt", VECTORS[kind](log))
    rate = tmp_path / "rate.toml"
    rate.write_text(f'sample_rate = {{value = {1 / H}, unit = "Hz"}}\n')
    timeless = "time" not in [g.group for g in inspect(path).proposals[0].guesses]
    found = inspect(path, rate if timeless else None)
    agrees(found.recording, log)


def test_a_number_with_a_decimal_comma_behind_a_label_is_no_vector():
    """``ax: 0,12`` is neither 0 nor a vector of two."""
    assert pairs_of("ax: 0,12 ay: 0,34 az: 9,81") is None
    assert pairs_of("acc: 0,12 0,34 9,81") is None
    assert pairs_of("accel[0]: 0.12") == [("accel[0]", "0.12", None)]


@pytest.mark.parametrize("line", ["", "lost", "acc: 0.1,0.2", "acc: 0.1,0.2,0.3,0.4 gyro: 1,2,3"])
def test_a_line_that_lost_some_of_a_vector_is_no_row(line, log, tmp_path):
    lines = VECTORS["a time"](log)
    lines.insert(200, line)
    found = by_its_map(written(tmp_path / "log.txt", lines), tmp_path)
    agrees(found, log)
    assert ("rows_left_out" in {f.kind for f in found.findings}) == bool(line)


@pytest.mark.parametrize("frames, each", [(25, 4), (50, 2), (100, 1)])
def test_frames_and_hundredths_behind_a_third_colon(frames, each, log, tmp_path):
    """They had been no times at all."""
    some = [part[::each] for part in log]
    whole = np.rint(some[0] * frames).astype(int)
    stamps = [f"23:59:{50 + k // frames:02d}:{k % frames:02d}" for k in whole if k < 10 * frames]
    stamps += [f"00:00:{k // frames - 10:02d}:{k % frames:02d}" for k in whole if k >= 10 * frames]
    lines = ["Timecode,ax,ay,az,gx,gy,gz", *rows(stamps, some[2], some[1])]
    agrees(by_its_map(written(tmp_path / "log.csv", lines), tmp_path), some)


@pytest.mark.parametrize("cell, every", [("unixtime", 1.0), ("time_s", 1.0), ("time_s", 0.02)])
def test_numbers_coarser_than_the_samples_are_times(cell, every, log, tmp_path):
    """Whole seconds, as of a log with one stamp for all rows of a second, had been no times."""
    stamps = 1.7e9 * (cell == "unixtime") + every * np.floor(log[0] / every + 1e-6)
    lines = [f"{cell},ax,ay,az,gx,gy,gz", *rows(stamps, log[2], log[1], form="{:.12g}")]
    found = by_its_map(written(tmp_path / "log.csv", lines), tmp_path)
    assert "coarse_stamps" in {f.kind for f in found.findings}
    agrees(found, log)


def test_a_time_beyond_all_numbers_is_no_bug(log, tmp_path):
    """Two columns of times, of which one jumps to 1e308, had ended in a traceback."""
    time = log[0].copy()
    time[30:] += 1e308
    lines = ["time_s,stamp_s,ax,ay,az,gx,gy,gz", *rows(time, time, log[2], log[1])]
    assert inspect(written(tmp_path / "log.csv", lines)).recording is None


@pytest.mark.parametrize("by", [",", ";", "\t"])
def test_a_header_that_stands_again_is_no_row(by, log, tmp_path):
    """As loggers write it that are switched off and on: "'time' is not a number"."""
    head = by.join(["time_s", "ax", "ay", "az", "gx", "gy", "gz"])
    lines = [head, *rows(log[0], log[2], log[1], by=by)]
    lines[501:501] = [head]
    lines[1200:1200] = [head + " "]
    found = by_its_map(written(tmp_path / "log.csv", lines), tmp_path)
    assert [(f.count, f.detail) for f in found.findings if f.kind == "header_again"] == [
        (2, {"first_row": 502})
    ]
    agrees(found, log)


@pytest.mark.parametrize("code", ["utf-16-le", "utf-16-be"])
def test_text_in_utf_16_without_its_mark(code, log, tmp_path):
    """ "Its lines end with a carriage return alone" had been said of it."""
    lines = ["time_s,ax,ay,az,gx,gy,gz\r", *(f"{r}\r" for r in rows(log[0], log[2], log[1]))]
    agrees(by_its_map(written(tmp_path / "log.csv", lines, code), tmp_path), log)


def test_lines_that_end_with_a_carriage_return_alone_are_refused_as_such(log, tmp_path):
    """A log longer than a line may be, too: "this is no table" had been said of it."""
    text = "\r".join(["time_s,ax,ay,az,gx,gy,gz", *rows(*log) * 3])
    with pytest.raises(UserError, match="carriage return alone"):
        inspect(written(tmp_path / "log.csv", [text]))


def test_a_labview_file_with_fewer_columns_than_units_is_no_bug(tmp_path):
    """Found by the fuzzer: an IndexError."""
    end = "***End_of_Header***"
    head = [
        "LabVIEW Measurement\t",
        "Separator\tTab",
        end,
        "Y_Unit_Label\trad/s\trad/s\trad/s",
        end,
    ]
    path = written(tmp_path / "log.lvm", [*head, "X_Value\tGyro_X", *["0.1\t0.2"] * 30])
    assert inspect(path).recording is None


@pytest.mark.parametrize(
    "unit, factor, stated", [("g", 9.80665, "m/s^2"), ("g", 1000, "mg"), ("m/s^2", 100, "cm/s^2")]
)
def test_a_force_that_is_too_large_by_a_factor_of_units(unit, factor, stated, log, tmp_path):
    """Under a header of g, m/s^2 had been read without a word: ten times the gravity."""
    head = ",".join(["time [s]", *(f"gyro_{a} [rad/s]" for a in "xyz")])
    head += "".join(f",accel_{a} [{unit}]" for a in "xyz")
    force = factor * log[2] / (G if unit == "g" else 1.0)
    found = inspect(written(tmp_path / "log.csv", [head, *rows(log[0], log[1], force)]))
    told = [f.detail for f in found.findings if f.kind == "force_unit"]
    assert [(d["stated"], d["as"]) for d in told] == [(unit, stated)]


@pytest.mark.parametrize("name", ["sensor_id", "imu", "Device"])
def test_rows_of_two_sensors_are_not_those_of_one(name, log, tmp_path):
    """They had been read as one sensor of twice the rate whose stamps are coarse."""
    head = f"time_s,{name},ax,ay,az,gx,gy,gz"
    own, other = (rows(log[0], np.full(N, k), log[2] * (1 - k / 5), log[1]) for k in (0, 1))
    lines = [line for pair in zip(own, other, strict=True) for line in pair]
    found = by_its_map(written(tmp_path / "log.csv", [head, *lines]), tmp_path)
    assert [f.count for f in found.findings if f.kind == "other_units"] == [N]
    agrees(found, log)


def test_a_state_of_the_sensor_does_not_number_it(log, tmp_path):
    state = np.repeat([0, 1, 2, 3], N // 4)
    lines = ["time_s,sensor,ax,ay,az,gx,gy,gz", *rows(log[0], state, log[2], log[1])]
    agrees(by_its_map(written(tmp_path / "log.csv", lines), tmp_path), log)


def test_times_in_minutes(log, tmp_path):
    """They had been taken for seconds, at 6 kHz."""
    lines = ["Time (min),ax,ay,az,gx,gy,gz", *rows(log[0] / 60, log[2], log[1], form="{:.15g}")]
    agrees(by_its_map(written(tmp_path / "log.csv", lines), tmp_path), log)


@pytest.mark.parametrize(
    "head, first",
    [
        ("time ax ay az gx gy gz", [f'"{k}"' for k in range(1, N + 1)]),
        ('"time" "ax" "ay" "az" "gx" "gy" "gz"', [f'"{k}"' for k in range(1, N + 1)]),
        ("ax ay az gx gy gz", None),
    ],
)
def test_names_that_begin_above_the_second_column(head, first, log, tmp_path):
    """As R writes them: each name had been taken for that of the column before its own."""
    lines = rows(log[0], log[2], log[1], by=" ")
    if first is not None:
        lines = [f"{k} {line}" for k, line in zip(first, lines, strict=True)]
    agrees(by_its_map(written(tmp_path / "log.txt", [head, *lines]), tmp_path), log)


def test_axes_that_go_on_in_a_header(log, tmp_path):
    lines = ["Time (s),Acc X,Y,Z,Gyro X,Y,Z", *rows(log[0], log[2], log[1])]
    agrees(by_its_map(written(tmp_path / "log.csv", lines), tmp_path), log)
    lines = ["Time (s),X,Y,Z", *rows(log[0], log[1])]
    found = inspect(written(tmp_path / "gyro.csv", lines))
    assert [g.cell for g in found.proposals[0].guesses] == ["Time (s)", "X", "Y", "Z"]


def test_a_packed_text_needs_no_name_of_one(log, tmp_path):
    lines = ["time_s,ax,ay,az,gx,gy,gz", *rows(log[0], log[2], log[1])]
    path = written(tmp_path / "log.csv", lines)
    path.write_bytes(gzip.compress(path.read_bytes()))
    agrees(by_its_map(path, tmp_path), log)


@pytest.mark.parametrize(
    "sign, said",
    [
        (b"PK\x03\x04", "save its sheet as CSV"),
        (b"SQLite format 3\0", "database"),
        (b"\x89HDF\r\n", "end in .h5"),
    ],
)
def test_what_is_no_text_is_called_what_it_is(sign, said, tmp_path):
    """ "Save text in another code as UTF-8" had been said of it."""
    (tmp_path / "log.csv").write_bytes(sign + bytes(range(256)) * 40)
    with pytest.raises(UserError, match=said):
        inspect(tmp_path / "log.csv")


def test_counts_that_lost_their_sign(log, tmp_path):
    """-1 as 65535: the accelerometer had been read in a wrong size, the gyro not at all."""
    counts = np.hstack([log[2] / G * 16384, np.degrees(log[1]) * 131]).round().astype(int)
    lines = ["ms,ax,ay,az,gx,gy,gz", *rows(1000 * log[0], counts & 0xFFFF)]
    found = by_its_map(written(tmp_path / "log.csv", lines), tmp_path)
    (said,) = [f.detail["columns"] for f in found.findings if f.kind == "sign_lost"]
    assert said == "ax, ay, az, gx, gy, gz"
    agrees(found, log, gyro=1e-3, accel=2e-3)


def test_a_counter_of_16_bits_has_no_sign(log, tmp_path):
    ticks = (np.rint(1000 * log[0]).astype(int) + 60_000) % 65_536
    middle = np.rint(log[2] / G * 4096).astype(int) + 32_768
    lines = ["ms,x_raw,y_raw,z_raw,gx,gy,gz", *rows(ticks, middle, log[1])]
    found = inspect(written(tmp_path / "log.csv", lines))
    assert "sign_lost" not in {f.kind for f in found.findings}
