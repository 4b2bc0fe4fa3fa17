"""Sheets as engineers keep them: a unit for each axis, sums below the samples, names that stretch
over lines, times in pieces and steps of time in place of times.
"""

import re

import log_sheets
import numpy as np
import pytest
from log_sheets import HEAD
from turned_logs import G, agrees, by_its_map, rows, tumbled, written

from pyimu import inspect, read_recording
from pyimu.errors import UserError


@pytest.fixture(scope="module")
def log():
    return tumbled()


def stated(log, head, **form):
    """Lines with ms, m/s^2 and deg/s below a ``head``."""
    return [*head, *rows(np.rint(1000 * log[0]), log[2], np.degrees(log[1]), **form)]


# Units


@pytest.mark.parametrize(
    "head",
    [
        ["t [ms],ax [g],ay [m/s^2],az [mg],gx [deg/s],gy [rad/s],gz [deg/s]"],
        ["t,ax,ay,az,gx,gy,gz", "ms,g,m/s2,mg,deg/s,rad/s,deg/s"],
    ],
)
def test_axes_in_units_of_their_own(head, log, tmp_path):
    """All three had been taken in the unit that fits the largest, one of them 57 times too small,
    and the accelerometer had been left out.
    """
    time, gyro, accel = log
    force = accel / [G, 1.0, G / 1000]
    rate = np.column_stack([np.degrees(gyro[:, 0]), gyro[:, 1], np.degrees(gyro[:, 2])])
    path = written(tmp_path / "log.csv", [*head, *rows(np.rint(1000 * time), force, rate)])
    agrees(read_recording(path), log)
    assert "gyro [deg/s, rad/s, deg/s] from gx" in inspect(path).report()


def test_what_is_asked_about_is_no_column_that_is_misspelled(log, tmp_path):
    """``accel[0]`` beside ``time [s]`` was "unknown column 'accel', did you mean accel_x?"."""
    names = [f"{n}[{k}]" for n in ("accel", "gyro") for k in range(3)]
    lines = [",".join(["time [s]", *names]), *rows(log[0], 1000 / G * log[2], log[1])]
    found = inspect(written(tmp_path / "log.csv", lines))
    assert "choose the unit of accel in the map" in found.report()
    assert "misspelled" not in found.problem and "did you mean" not in found.problem


def test_two_units_beside_none_are_asked_about(log, tmp_path):
    head = ["t [ms],ax [g],ay [g],az [g],gx [deg/s],gy [rad/s],gz"]
    path = written(tmp_path / "log.csv", stated(log, head))
    found = inspect(path)
    assert "choose the unit of gyro in the map" in found.report()
    assert "the header says deg/s, rad/s, nothing" in found.column_map


def test_one_unit_beside_none_is_looked_at(log, tmp_path):
    """As where a unit stands once above three columns."""
    head = ["t [ms],ax [m/s^2],ay,az,gx [deg/s],gy,gz"]
    agrees(by_its_map(written(tmp_path / "log.csv", stated(log, head)), tmp_path), log)


# Names


@pytest.mark.parametrize("by", [",", ";", "\t"])
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_names_that_go_on_in_the_next_line(by, end, log, tmp_path):
    """As where a spreadsheet broke them: it was said that a quotation mark is not closed."""
    names = [f'"{name.replace(" (", end + "(")}"' for name in HEAD.split(",")]
    path = written(tmp_path / "log.csv", stated(log, [by.join(names)], by=by))
    found = read_recording(path)
    agrees(found, log)
    lines = path.read_text().replace(f"{by}-", f"{by}a-", 1)
    row = next(k for k, line in enumerate(lines.split("\n"), 1) if "a-" in line)
    path.write_text(lines)
    with pytest.raises(UserError, match=f"row {row}, column"):
        read_recording(path)


def test_a_mark_that_is_not_closed_is_said_as_before(log, tmp_path):
    path = written(tmp_path / "log.csv", stated(log, [HEAD.replace("Acc X", '"Acc X')]))
    with pytest.raises(UserError, match="row 1: a quotation mark is not closed"):
        read_recording(path)


@pytest.mark.parametrize(
    "head",
    [
        ["Time,Accelerometer,,,Gyroscope,,", ",X,Y,Z,X,Y,Z", "ms,m/s2,m/s2,m/s2,deg/s,deg/s,deg/s"],
        ["Time,Accelerometer,,,Gyroscope,,", "ms,m/s2,,,deg/s,,", ",X,Y,Z,X,Y,Z"],
        ["Time,Accelerometer,,,Gyroscope,,", "[ms],m/s2,m/s2,m/s2,dps,dps,dps", ",X,Y,Z,X,Y,Z"],
    ],
)
def test_a_line_of_names_one_of_units_and_one_of_axes(head, log, tmp_path):
    agrees(by_its_map(written(tmp_path / "log.csv", stated(log, head)), tmp_path), log)


# Cells


@pytest.mark.parametrize("form", ['="{}"', '"=""{}"""'])
@pytest.mark.parametrize("by, decimal", [(",", "."), (";", ",")])
def test_cells_that_are_formulas_of_texts(form, by, decimal, log, tmp_path):
    """As programs write them that keep Excel from rounding: ``="0.1"``."""
    cells = [line.split(",") for line in stated(log, [HEAD])]
    lines = [by.join(form.format(c.replace(".", decimal)) for c in row) for row in cells]
    found = read_recording(written(tmp_path / "log.csv", lines))
    agrees(found, log)
    assert any('formulas (="0.1")' in str(f.detail) for f in found.findings)


# Below the samples


def below(log, label, of):
    """A line with what a sheet has computed of each column."""
    values = [of(v, axis=0) for v in (np.rint(1000 * log[0]), log[2], np.degrees(log[1]))]
    cells = [f"{v:.6g}" for v in np.hstack(values)]
    return ",".join(cells if label is None else [label, *cells[1:]])


@pytest.mark.parametrize("label", ["Mean", "", None])
@pytest.mark.parametrize("blank", ["", ",,,,,,"])
def test_sums_below_the_samples_are_none(label, blank, log, tmp_path):
    last = [blank, *(below(log, label, of) for of in (np.mean, np.std))]
    last += [",,,,,,", "Notes: warm,,,,,,"] if label == "Mean" else []
    path = written(tmp_path / "log.csv", [*stated(log, [HEAD]), *last])
    for _ in range(2):  # what is said is not added up from one reading to the next
        found = read_recording(path)
        agrees(found, log)
        (said,) = (f for f in found.findings if f.kind == "end_left_out")
        # Arrow leaves out a blank row, and so is it counted here.
        assert said.count == sum(bool(line) for line in last)
        assert said.detail["row"] == len(log[0]) + 2 + (not blank)


@pytest.mark.parametrize("size", [60_000, 65_536])
def test_a_counter_that_begins_anew_in_the_last_rows_is_no_sum(size, log, tmp_path):
    ms = (np.rint(1000 * log[0]).astype(int) + size - 19_900) % size
    path = written(tmp_path / "log.csv", [HEAD, *rows(ms, log[2], np.degrees(log[1]))])
    agrees(read_recording(path), log)


def test_a_clock_that_is_set_anew_is_no_end(log, tmp_path):
    lines = stated(log, [HEAD])
    path = written(tmp_path / "log.csv", [*lines, *lines[500:530]])
    with pytest.raises(UserError, match="row 2002: the time runs backwards"):
        read_recording(path)


# Times


@pytest.mark.parametrize("size, after", [(1000, "second"), (60_000, "minute"), (65_536, "16 bits")])
def test_milliseconds_that_begin_anew(size, after, log, tmp_path):
    ms = (np.rint(1000 * log[0]).astype(int) + size - 500) % size
    found = read_recording(
        written(tmp_path / "log.csv", [HEAD, *rows(ms, log[2], np.degrees(log[1]))])
    )
    agrees(found, log)
    (said,) = (f for f in found.findings if f.kind == "counter_wrapped")
    assert said.detail["after"] == after


@pytest.mark.parametrize("length", [1, 60])
def test_trials_of_a_second_or_a_minute_are_no_counter(length, log, tmp_path):
    times = log[0] * length / 5 % length
    path = written(tmp_path / "log.csv", [HEAD.replace("ms", "s"), *rows(times, log[2], log[1])])
    with pytest.raises(UserError, match="row 502: the time runs backwards"):
        read_recording(path)


PIECES = {
    "sec,msec": lambda ms: (ms // 1000, ms % 1000),
    "seconds,milliseconds": lambda ms: (ms // 1000, ms % 1000),
    "hour,minute,second": lambda ms: (ms // 3600000 % 24, ms // 60000 % 60, ms % 60000 / 1000),
    "h_utc,hour,min,sec,ms": lambda ms: (
        (0 * ms, ms // 3600000 % 24, ms // 60000 % 60, ms // 1000 % 60, ms % 1000)
    ),
    "gps_hour,gps_minute,gps_second,gps_usec": lambda ms: (
        (ms // 3600000 % 24, ms // 60000 % 60, ms // 1000 % 60, ms % 1000 * 1000)
    ),
}


@pytest.mark.parametrize("names", PIECES)
def test_times_in_pieces(names, log, tmp_path):
    """They had been refused; hours go on over midnight."""
    ms = np.rint(1000 * log[0]).astype(int) + 86_390_000
    head = HEAD.replace("Time (ms)", names)
    path = written(
        tmp_path / "log.csv", [head, *rows(*PIECES[names](ms), log[2], np.degrees(log[1]))]
    )
    found = read_recording(path)
    agrees(found, log)
    assert any("one time of" in str(f.detail) for f in found.findings)


def test_pieces_beside_a_time_are_none(log, tmp_path):
    ms = np.rint(1000 * log[0]).astype(int)
    head = f"hour,minute,second,{HEAD}"
    lines = [head, *rows(ms // 3600000, ms // 60000, ms // 1000, ms, log[2], np.degrees(log[1]))]
    found = read_recording(written(tmp_path / "log.csv", lines))
    agrees(found, log)
    assert not any("one time of" in str(f.detail) for f in found.findings)


@pytest.mark.parametrize(
    "name, unit",
    [("dt_ms", 1e-3), ("delta t [s]", 1.0), ("Δt (us)", 1e-6), ("time diff (ms)", 1e-3)],
)
def test_steps_in_place_of_times(name, unit, log, tmp_path):
    """A mean rate had been made of them, so that gaps and jitter were lost; or nothing, of a first
    step of 0.
    """
    steps = np.diff(log[0], prepend=log[0][0]) + 1e-3 * np.random.default_rng(1).integers(
        -1, 2, len(log[0])
    )
    steps[0], steps[700] = 0.0, 1.3
    head = HEAD.replace("Time (ms)", name)
    path = written(tmp_path / "log.csv", [head, *rows(steps / unit, log[2], np.degrees(log[1]))])
    found = read_recording(path)
    agrees(found, (np.cumsum(steps), *log[1:]))
    assert {"gaps", "layout"} <= {f.kind for f in found.findings}


def test_a_name_with_its_unit_twice_is_one_of_steps(log, tmp_path):
    head = ["dt_ms,ax,ay,az,gx,gy,gz", "ms,m/s2,m/s2,m/s2,deg/s,deg/s,deg/s"]
    lines = [*head, *rows(["10"] * len(log[0]), log[2], np.degrees(log[1]))]
    agrees(read_recording(written(tmp_path / "log.csv", lines)), log)


def test_steps_of_no_unit_are_asked_about_or_told(log, tmp_path):
    head = HEAD.replace("Time (ms)", "dt")
    lines = [head, *rows(np.full(len(log[0]), 0.01), log[2], np.degrees(log[1]))]
    agrees(by_its_map(written(tmp_path / "log.csv", lines), tmp_path), log)


VECTORS = "".join(
    f'"{cell} {a.upper()} ({unit})" = "{group}_{a} [{unit}]"\n'
    for cell, group, unit in (("Acc", "accel", "m/s2"), ("Gyro", "gyro", "deg/s"))
    for a in "xyz"
)


@pytest.mark.parametrize(
    "name, said",
    [
        ("when", '"when" = "time [ms]"'),
        ("Time (ms)", r'"Time \(ms\)" = "time [ms]"'),
        ("seq", "none rises; say the rate of a log without times: sample_rate = "),
    ],
)
def test_a_map_without_a_time_is_told_which_column_may_be_it(name, said, log, tmp_path):
    """It had been said that the header has no 'time [s]', and what columns there are."""
    (tmp_path / "map.toml").write_text("[columns]\n" + VECTORS)
    lines = stated(log, [HEAD.replace("Time (ms)", name)])
    if name == "seq":
        lines = [lines[0], *(f"{k}{line[line.index(',') :]}" for k, line in enumerate(lines[1:]))]
    path = written(tmp_path / "log.csv", lines)
    with pytest.raises(UserError, match=r"map.toml: names no column as the time.*") as error:
        read_recording(path, tmp_path / "map.toml")
    assert said.replace("\\", "") in str(error.value)
    assert len(str(error.value).splitlines()) == 1


# Rows of binary numbers


@pytest.mark.parametrize(
    "kinds", ["<f8,6<f8", "<f4,9<f4", "<u4,6<f4", "<u8,6<f8", "<f8,6<f4", "<u8,7<f4"]
)
def test_a_time_and_floating_point_numbers_are_told_by_their_bytes(kinds, log, tmp_path):
    """Seven numbers of eight bytes alone had been; of others it was said that they are no dataflash
    log.
    """
    first, rest = kinds.split(",")
    table = np.zeros(len(log[0]), [("t", first), ("v", rest[1:], (int(rest[0]),))])
    table["t"] = log[0] if "f" in first else np.rint(1000 * log[0])
    table["v"][:, :3], table["v"][:, 3:6], table["v"][:, 6:] = *log[1:], 25.0
    table.tofile(tmp_path / "log.bin")
    found = by_its_map(tmp_path / "log.bin", tmp_path)
    time = table["t"].astype(float) / (1 if "f" in first else 1000)
    agrees(found, (time, *log[1:]), gyro=1e-5, accel=1e-5)
    assert any("rows of" in str(f.detail) for f in found.findings)


def test_rows_that_a_map_describes(log, tmp_path):
    """Counts of a board, behind a head of 12 bytes, and cut off at the end."""
    nano = (np.rint(1e9 * log[0]).astype(np.int64), *log[1:])
    path = log_sheets.struct(tmp_path, nano)
    path.write_bytes(b"head of 12 b" + path.read_bytes()[:-3])
    text = log_sheets.STRUCT_MAP.replace("[columns]", "skip = 12\n[columns]")
    (tmp_path / "map.toml").write_text(text)
    found = read_recording(path, tmp_path / "map.toml")
    one = np.radians(0.5 / 16.4), 0.5 * G / 2048
    agrees(found, [part[:-1] for part in log], gyro=one[0] + 1e-9, accel=one[1] + 1e-9)
    assert "13 bytes at the end are no whole row" in str(found.findings)
    alone = text.partition("[columns]")[0]
    (tmp_path / "binary.toml").write_text(alone)
    seen = inspect(path, tmp_path / "binary.toml")
    (tmp_path / "written.toml").write_text(seen.column_map)
    again = read_recording(path, tmp_path / "written.toml")
    np.testing.assert_allclose(again.gyro, found.gyro, rtol=1e-12)


@pytest.mark.parametrize(
    "text, said",
    [
        ('dtype = "float16"\ncolumns = 7', "key binary.dtype: 'float16', known are int8"),
        ('dtype = "float32"', "key binary must be such as"),
        ('dtype = ["float32"]\ncolumns = 2', "key binary must be such as"),
        ("columns = 7", "key binary must be such as"),
        ('dtype = "float32"\ncolumns = 7\nrows = 3', "key binary must be such as"),
        ('dtype = "float32"\ncolumns = 7\nskip = -1', "binary.skip is a number of bytes"),
        ('dtype = "float64"\ncolumns = 4000', "has no row of 32000 bytes"),
    ],
)
def test_what_is_no_row_is_refused(text, said, tmp_path):
    (tmp_path / "log.bin").write_bytes(bytes(4000))
    (tmp_path / "map.toml").write_text(f"[binary]\n{text}\n")
    with pytest.raises(UserError, match=re.escape(said)):
        read_recording(tmp_path / "log.bin", tmp_path / "map.toml")


def test_other_bytes_are_told_what_would_read_them(tmp_path):
    (tmp_path / "log.bin").write_bytes(np.random.default_rng(1).bytes(4000))
    with pytest.raises(UserError, match=r"column map says what they are: \[binary\] with dtype"):
        read_recording(tmp_path / "log.bin")


@pytest.mark.parametrize("name", ["raw.bin", "raw.gps", "raw.log", "raw.txt", "raw"])
@pytest.mark.parametrize("sync", [b"\xaa\x44\x12\x1c", b"\xaa\x44\x13\x28"])
def test_a_binary_log_of_novatel_s(name, sync, tmp_path):
    (tmp_path / name).write_bytes((sync + bytes(range(64))) * 50)
    with pytest.raises(UserError, match=r"binary log of NovAtel's; log RAWIMUSXA"):
        read_recording(tmp_path / name)


# Several people, by number


def test_the_second_person_of_wisdm(log, tmp_path):
    """``[topics]`` was for bags alone."""
    stamps = [f"{int(t)}" for t in np.rint(1e9 * log[0]) + 49105962326000]
    both = [("33", log[2]), ("17", log[2][::-1])]
    lines = [
        f"{user},Jogging,{t},{row};"
        for user, force in both
        for t, row in zip(stamps, rows(force), strict=True)
    ]
    path = written(tmp_path / "WISDM_ar_v1.1_raw.txt", lines)
    (tmp_path / "map.toml").write_text('[topics]\nimu = "17"\n')
    found = read_recording(path, tmp_path / "map.toml")
    np.testing.assert_allclose(found.accel, log[2][::-1], atol=1e-5)
    assert inspect(path, tmp_path / "map.toml").recording is not None
    (tmp_path / "map.toml").write_text('[topics]\nimu = "99"\n')
    with pytest.raises(UserError, match="no row has 99 as its user"):
        read_recording(path, tmp_path / "map.toml")


# Clocks of digits


def clock(seconds, form):
    """Times of day of the ``seconds`` (n,), in a form of hours, minutes, seconds and their ms."""
    ms = [round(1000 * s) for s in seconds]
    return [form(m // 3600000 % 24, m // 60000 % 60, m // 1000 % 60, m % 1000) for m in ms]


def dial(h, m, s, ms):
    return f"{(h - 1) % 12 + 1}:{m:02d}:{s:02d}.{ms:03d}"


@pytest.mark.parametrize(
    "form",
    [
        lambda h, m, s, ms: f"20240503{h:02d}{m:02d}{s:02d}.{ms:03d}",
        lambda h, m, s, ms: f"20240503{h:02d}{m:02d}{s:02d}{ms:03d}",
        lambda h, m, s, ms: f"20240503_{h:02d}{m:02d}{s:02d}_{ms:03d}",
        lambda h, m, s, ms: f"{h:02d}{m:02d}{s:02d}.{ms:03d}",
        dial,
    ],
)
def test_times_of_digits_and_of_a_dial(form, log, tmp_path):
    """Of digits each minute was a gap of 40 s; on a dial the time ran backwards at 12:59."""
    stamps = clock(12 * 3600 + 59 * 60 + 50 + log[0], form)
    head = HEAD.replace("Time (ms)", "utc time")
    path = written(tmp_path / "log.csv", [head, *rows(stamps, log[2], np.degrees(log[1]))])
    agrees(by_its_map(path, tmp_path), log)


@pytest.mark.parametrize("first, step, count", [(1000, 0.1, None), (0, 100, 59), (0, 50, 119)])
def test_numbers_that_count_are_no_times_of_digits(first, step, count, log, tmp_path):
    """Nor are ms of a short log at 10 or 20 Hz, none of which ends with 60 or more."""
    head, part = HEAD.replace("Time (ms)", "time"), slice(count)
    times = first + step * np.arange(len(log[0]))
    lines = [head, *rows(times[part], log[2][part], np.degrees(log[1])[part])]
    found = inspect(written(tmp_path / "log.csv", lines))
    assert found.proposals[0].header[0] == "time"


def test_a_time_that_a_sheet_rounded_is_said(log, tmp_path):
    stamps = ["1.71473E+12"] * len(log[0])
    lines = ["time_ms,ax,ay,az,gx,gy,gz", *rows(stamps, log[2], np.degrees(log[1]))]
    said = inspect(written(tmp_path / "log.csv", lines)).report()
    assert "time_ms is 1.71473e+12 in every row, and no time: sheets round" in said


def test_numbers_that_an_apostrophe_marks_as_texts(log, tmp_path):
    stamps = [f"'{1714730462000 + round(1000 * t)}" for t in log[0]]
    agrees(
        read_recording(
            written(tmp_path / "log.csv", [HEAD, *rows(stamps, log[2], np.degrees(log[1]))])
        ),
        log,
    )


# Names of vectors


@pytest.mark.parametrize(
    "names",
    ["rollrate,pitchrate,yawrate", "rollspeed,pitchspeed,yawspeed", "RollVel,PitchVel,YawVel"],
)
def test_rates_of_angles_in_one_word(names, log, tmp_path):
    path = written(tmp_path / "log.csv", [f"t,ax,ay,az,{names}", *rows(log[0], log[2], log[1])])
    agrees(by_its_map(path, tmp_path), log)


def test_a_letter_says_less_than_gravity(log, tmp_path):
    """``Gx`` of a force in g had been a gyro's, whose unit was asked for."""
    table = ["t,Gx,Gy,Gz,Rx,Ry,Rz", *rows(log[0], log[2] / G, np.degrees(log[1]))]
    agrees(by_its_map(written(tmp_path / "log.csv", table), tmp_path), log)
    # A bias of 1 deg/s at rest is none.
    rate = np.random.default_rng(2).normal([0.9, 0.3, 0.3], 0.02, (len(log[0]), 3))
    found = inspect(written(tmp_path / "rest.csv", ["t,gx,gy,gz", *rows(log[0], rate)]))
    assert found.proposals[0].groups == ["time", "gyro"]


def test_sums_above_the_samples_are_none(log, tmp_path):
    head = [HEAD, *(below(log, label, np.mean) for label in ("Mean", "Max"))]
    agrees(read_recording(written(tmp_path / "log.csv", stated(log, head))), log)


@pytest.mark.parametrize("unit, one", [("mdps", np.degrees(1000)), ("mrad/s", 1000.0)])
def test_thousandths_without_a_unit_are_told_by_gravity(unit, one, log, tmp_path):
    """Their unit had been asked for, of rad/s and deg/s."""
    lines = ["t,ax,ay,az,gx,gy,gz", *rows(log[0], log[2], one * log[1])]
    found = inspect(written(tmp_path / "log.csv", lines))
    assert found.proposals[0].units["gyro"] == unit
    agrees(found.recording, log)
    # Where nothing turns, numbers that no gyro shows in deg/s are asked about.
    rate = np.random.default_rng(3).normal(0, 4000, log[1].shape)
    still = np.random.default_rng(4).normal([0, 0, G], 0.01, log[2].shape)
    lines = ["t,ax,ay,az,gx,gy,gz", *rows(log[0], still, rate)]
    asked = inspect(written(tmp_path / "rest.csv", lines)).column_map
    assert '# "gx" = "gyro_x [mdps]"' in asked and "more than any gyro shows" in asked
