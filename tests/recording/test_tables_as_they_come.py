"""Tables in text as loggers, phones and spreadsheets leave them: cut, remarked, in other codes."""

import gzip
import re
import threading

import numpy as np
import pyarrow as pa
import pytest
from pyarrow import csv as pacsv

from pyimu import read_recording
from pyimu.errors import UserError
from pyimu.recording.formats.lines import Body
from pyimu.recording.log import open_log

HEAD = "time [s],gyro_x [rad/s],gyro_y [rad/s],gyro_z [rad/s]"
ROWS = [f"{0.01 * k:.2f},0.1,{0.001 * (k % 7):.3f},0.3" for k in range(300)]


def of_kind(recording, kind):
    return [f for f in recording.findings if f.kind == kind]


def read(folder, lines, name="log.csv", end="\n"):
    (folder / name).write_text("\n".join(lines) + end)
    return read_recording(folder / name)


# Lines that are no rows


@pytest.mark.parametrize(
    "last, end",
    [
        (["3.00,0.1,0"], ""),
        (["3.0"], ""),
        (['3.00,"0.1,0'], ""),
        (["End of log"], "\n"),
        (["", "300 rows", "lost: 0", ""], "\n"),
        (["\0" * 40], ""),
    ],
)
def test_what_is_whole_of_a_cut_log_is_read(last, end, tmp_path):
    found = read(tmp_path, [HEAD, *ROWS, *last], end=end)
    np.testing.assert_array_equal(found.gyro, read(tmp_path, [HEAD, *ROWS]).gyro)
    (said,) = of_kind(found, "end_left_out")
    first = next(k for k, line in enumerate(last, 302) if line)
    assert (said.count, said.detail) == (len([t for t in last if t]), {"row": first})
    assert not of_kind(read(tmp_path, [HEAD, *ROWS], end=""), "end_left_out")


def test_a_long_log_with_comments_and_a_cut_end(tmp_path):
    """Of some blocks of 1 MiB; the remark is in another code."""
    rows = [f"{0.01 * k:.2f},0.1,{0.001 * (k % 7):.3f},0.3" for k in range(200_000)]
    lines = [HEAD, *rows[:150_000], "# " + HEAD, *rows[150_000:], "L\xe4nge 1", "\x83\xff"]
    (tmp_path / "log.csv").write_bytes("\n".join(lines).encode("latin-1"))
    found = read_recording(tmp_path / "log.csv")
    np.testing.assert_allclose(found.time, 0.01 * np.arange(200_000), atol=1e-11)
    (tmp_path / "log.csv").write_bytes("\n".join(lines[:-1]).encode("latin-1"))
    (said,) = of_kind(read_recording(tmp_path / "log.csv"), "end_left_out")
    assert said.detail == {"row": 200_003}


def test_a_cut_log_is_read_in_pieces_and_with_a_rate(tmp_path):
    path = tmp_path / "log.csv"
    path.write_text("\n".join([HEAD, *ROWS, "3.00,0.1"]))
    log = open_log(path)
    assert sum(len(piece) for piece, _ in log.pieces(64)) == 300
    assert [f.kind for f in log.findings] == ["end_left_out"]
    (tmp_path / "m.toml").write_text(
        'sample_rate = {value = 100, unit = "Hz"}\n[columns]\n"time [s]" = "clock"\n'
    )
    assert of_kind(read_recording(path, tmp_path / "m.toml"), "end_left_out")


@pytest.mark.parametrize("mark", ["# lost sync", "% a,b,c", "#" + HEAD, "// 1,2,3"])
@pytest.mark.parametrize("separator", [",", " "])
def test_a_comment_between_rows_is_left_out(mark, separator, tmp_path):
    head = HEAD if separator == "," else re.sub(r" \[", "[", HEAD)
    lines = [head, *ROWS[:150], mark, *ROWS[150:], "# end"]
    found = read(tmp_path, [line.replace(",", separator) for line in lines])
    assert len(found) == 300 and not of_kind(found, "end_left_out")


def test_arrow_holds_nothing_of_pythons(monkeypatch, tmp_path):
    """What its threads let go of while Python ends would abort the process: a log with comments is
    read by the thread that asks for it, and Arrow has a copy.
    """
    threads, blocks, given = set(), [], []

    def watched(self):
        for block in made(self):
            threads.add(threading.get_ident())
            blocks.append(block)
            yield block

    def parsed(source, *options, **named):
        given.append(source)
        address = source.read_buffer().address
        assert address != pa.py_buffer(blocks[-1]).address
        source.seek(0)
        return read_csv(source, *options, **named)

    made, read_csv = Body.blocks, pacsv.read_csv
    monkeypatch.setattr(Body, "blocks", watched)
    monkeypatch.setattr(pacsv, "read_csv", parsed)
    assert len(read(tmp_path, [HEAD, *ROWS[:150], "# lost", *ROWS[150:]])) == 300
    assert threads == {threading.get_ident()} and blocks
    assert {type(source) for source in given} == {pa.BufferReader}


def test_a_row_may_begin_with_a_missing_value(tmp_path):
    rows = [",".join([*row.split(",")[1:], row.split(",")[0]]) for row in ROWS]
    rows[200] = "#N/A" + rows[200][3:]
    found = read(tmp_path, [",".join([*HEAD.split(",")[1:], "time [s]"]), *rows])
    assert len(found) == 300 and np.flatnonzero(np.isnan(found.gyro[:, 0])).tolist() == [200]


WRONG = ["1.49,0.1", "lost sync", "1.49,0.1,0.2,0.3,0.4", '1.49,"0,1",0.2']


@pytest.mark.parametrize("wrong", WRONG)
def test_other_lines_between_rows_are_refused_where_they_are_many(wrong, tmp_path):
    """More than one in a hundred."""
    with pytest.raises(UserError, match=r"row 152: \d cells, expected 4"):
        read(tmp_path, [HEAD, *ROWS[:150], *[wrong] * 4, *ROWS[150:]])
    with pytest.raises(UserError, match=r"row 302: \d cells, expected 4"):
        read(tmp_path, [HEAD, *ROWS, *["a remark"] * 21])


@pytest.mark.parametrize("end", ["", "3.00,0.1,0"])
@pytest.mark.parametrize("separator", [",", "\t"])
@pytest.mark.parametrize("wrong", WRONG)
def test_few_broken_lines_between_rows_are_left_out(wrong, separator, end, tmp_path):
    """As a serial line makes them; rows behind them keep their times, and their places."""
    lines = [HEAD, *ROWS[:150], wrong, *ROWS[150:200], wrong, *ROWS[200:], end]
    found = read(tmp_path, [line.replace(",", separator) for line in lines])
    np.testing.assert_array_equal(found.gyro, read(tmp_path, [HEAD, *ROWS]).gyro)
    (said,) = of_kind(found, "rows_left_out")
    assert (said.count, said.detail) == (2 + bool(end), {"first_row": 152})
    lines[250] = lines[250].replace("0.3", "0.x")
    with pytest.raises(UserError, match=r"row 251, column gyro_z .*'0.x' is not a number"):
        read(tmp_path, lines)


def test_a_lost_row_is_a_gap_and_of_a_log_without_times_an_error(tmp_path):
    broken = [*ROWS[:150], "1.50,0.1", *ROWS[151:]]
    found = read(tmp_path, [HEAD, *broken])
    assert len(found) == 299 and len(found.segments) == 2
    (tmp_path / "m.toml").write_text(
        'sample_rate = {value = 100, unit = "Hz"}\n[columns]\n"time [s]" = "clock"\n'
    )
    with pytest.raises(UserError, match="row 152 is no whole row, and none can be left out"):
        read_recording(tmp_path / "log.csv", tmp_path / "m.toml")


# Dates and times of day

START = np.datetime64("2024-02-28T23:59:58.500")
STEPS = (np.arange(300) * 10).astype("timedelta64[ms]")


@pytest.mark.parametrize(
    "form, separator",
    [
        ("{d}T{t}", ","),
        ("{d} {t}", ","),
        ("{d}T{t}Z", ","),
        ("{d}T{t}+02:00", ","),
        ("{d} {t}-0330", ";"),
        ("{t}", ","),
        ("{d} {t}", "\t"),
        ("{d}T{t}", " "),
    ],
)
@pytest.mark.parametrize("name", ["Timestamp", "time [s]", "time [ms]", "Date (UTC)"])
def test_dates_and_times_of_day_are_times(form, separator, name, tmp_path):
    """Over midnight, and over the day that a leap year has more."""
    stamps = [str(stamp).split("T") for stamp in START + STEPS]
    cells = [form.format(d=d, t=t) for d, t in stamps]
    name = name.replace(" ", "") if separator == " " else name
    head = separator.join([name, *(f"gyro_{a}(deg/s)" for a in "xyz")])
    rows = [separator.join([cell, "1.5", f"{k % 7}.25", "0"]) for k, cell in enumerate(cells)]
    found = read(tmp_path, [head, *rows])
    # 1e5 s in doubles are known to 1.5e-11 s
    np.testing.assert_allclose(found.time - found.time[0], np.arange(300) * 0.01, atol=6e-11)
    assert [f.detail for f in of_kind(found, "clock_times")] == [{"from": name}]


def test_a_time_of_day_that_is_none_is_missing(tmp_path):
    rows = [f"12:00:{k / 100:05.2f},0.1,{k % 7},0.3" for k in range(300)]
    rows[200] = "12:00:xx" + rows[200][11:]
    with pytest.raises(UserError, match="row 202: the time is missing"):
        read(tmp_path, [HEAD, *rows])


# Codes of the letters, and commas in numbers


@pytest.mark.parametrize("name", ["log.csv", "log.csv.gz"])
@pytest.mark.parametrize(
    "code, said",
    [
        ("utf-8", ""),
        ("utf-8-sig", ""),
        ("latin-1", ", text in Windows-1252"),
        ("utf-16", ", text in UTF-16"),
        ("utf-16-be", ", text in UTF-16"),
    ],
)
def test_letters_in_other_codes(code, said, name, tmp_path):
    head = "Time [s];Gyro X (°/s);Gyro Y (°/s);Gyro Z (°/s);Temp. (°C)"
    rows = [";".join(c.replace(".", ",") for c in [*row.split(","), "21.5"]) for row in ROWS]
    text = ("\ufeff" if code == "utf-16-be" else "") + "\r\n".join([head, *rows]) + "\r\n"
    data = text.encode(code)
    (tmp_path / name).write_bytes(gzip.compress(data) if name.endswith("gz") else data)
    found = read_recording(tmp_path / name)
    gyro = np.array([row.split(",")[1:] for row in ROWS], dtype=float)
    np.testing.assert_allclose(np.degrees(found.gyro), gyro, rtol=1e-14)
    assert set(found.temperature) == {21.5}
    (layout,) = of_kind(found, "layout")
    assert layout.detail["read_as"] == "columns separated by semicolons, decimal commas" + said


@pytest.mark.parametrize("form", ["{:.3f}", "{:.4f}"])
def test_decimal_points_of_a_time_beside_decimal_commas(form, tmp_path):
    """Three digits behind a point may be thousands, but not behind a zero alone."""
    rows = [row.split(",") for row in ROWS]
    text = [
        ";".join([form.format(float(t)), *(v.replace(".", ",") for v in gyro)]) for t, *gyro in rows
    ]
    (tmp_path / "log.csv").write_text("\n".join([HEAD.replace(",", ";"), *text]))
    found = read_recording(tmp_path / "log.csv")
    np.testing.assert_allclose(found.time, [float(t) for t, *_ in rows], rtol=1e-14)
    np.testing.assert_array_equal(found.gyro, read_recording(_plain(tmp_path)).gyro)
    assert "decimal commas and decimal points" in of_kind(found, "layout")[0].detail["read_as"]


def _plain(folder):
    (folder / "plain.csv").write_text("\n".join([HEAD, *ROWS]))
    return folder / "plain.csv"


def test_utf16_that_is_cut_within_a_letter(tmp_path):
    text = "\n".join([HEAD, *ROWS, "3.00,0.1"]).encode("utf-16")[:-1]
    (tmp_path / "log.csv").write_bytes(text)
    assert len(read_recording(tmp_path / "log.csv")) == 300
    (tmp_path / "log.csv").write_bytes(b"\xff\xfe" + b"\x00\xd8" * 300)
    with pytest.raises(UserError, match="is not text in UTF-16"):
        read_recording(tmp_path / "log.csv")


@pytest.mark.parametrize("ints", [False, True])
def test_decimal_commas_in_quotation_marks(ints, tmp_path):
    """As spreadsheets and pandas write them between commas; whole numbers may stand without."""
    cells = [[c.replace(".", ",") for c in row.split(",")] for row in ROWS]
    rows = [",".join(f'"{c}"' for c in row) + (",7" if ints else "") for row in cells]
    found = read(tmp_path, [HEAD + (",supply [V]" if ints else ""), *rows])
    np.testing.assert_array_equal(found.gyro, read(tmp_path, [HEAD, *ROWS]).gyro)
    assert found.sample_rate == pytest.approx(100)
