"""Logs as people bring them: the same columns in each format, cells without a value, dates of
spreadsheets, and files that are no log, of which a line says what to do.
"""

import json

import h5py
import numpy as np
import pandas as pd
import pyarrow as pa
import pytest
from pyarrow import parquet
from rolling import rolls
from scipy.io import savemat

from pyimu import Recording, inspect, read_recording
from pyimu.errors import UserError
from pyimu.units import STANDARD_GRAVITY

NAMES = {
    "letters": ["t", "gx", "gy", "gz", "ax", "ay", "az"],
    "points": ["t", *(f"{v}.{a}" for v in ("gyro", "accel") for a in "xyz")],
}


@pytest.fixture(scope="module")
def columns():
    """Time s, gyro rad/s and accelerometer m/s^2 (7, n) of a body that rolls."""
    rng = np.random.default_rng(23)
    time = np.arange(4000) * 0.01
    gyro, up = (v.T for v in rolls(time))
    noise = rng.standard_normal((2, 3, 4000))
    accel = STANDARD_GRAVITY * up + 0.02 * noise[1]
    return np.concatenate([time[None], gyro + 1e-3 * noise[0], accel])


def _parquet(path, table):
    parquet.write_table(pa.table(table), path)


def _hdf5(path, table):
    with h5py.File(path, "w") as file:
        for name, values in table.items():
            file[name] = values


def _samples(table):
    return [dict(zip(table, map(float, row), strict=True)) for row in zip(*table.values())]


WRITERS = {
    "log.parquet": _parquet,
    "log.h5": _hdf5,
    "log.mat": lambda path, table: savemat(path, table),
    "log.json": lambda path, table: path.write_text(json.dumps(_samples(table))),
    "log.jsonl": lambda path, table: path.write_text("\n".join(map(json.dumps, _samples(table)))),
    "columns.json": lambda path, table: path.write_text(
        json.dumps({name: list(values) for name, values in table.items()})
    ),
}


@pytest.mark.parametrize("names", NAMES)
@pytest.mark.parametrize("file", WRITERS)
def test_usual_names_in_files_that_are_no_text(file, names, columns, tmp_path):
    """Names that a text of Gyroflow's or HyperIMU's has, too; a list of JSON has no ends of
    lines.
    """
    if (file, names) == ("log.mat", "points"):
        pytest.skip("no name of MATLAB's")
    WRITERS[file](tmp_path / file, dict(zip(NAMES[names], columns, strict=True)))
    found = inspect(tmp_path / file).recording
    np.testing.assert_array_equal(found.gyro, columns[1:4].T)
    np.testing.assert_array_equal(found.accel, columns[4:].T)


@pytest.mark.parametrize("names", NAMES.values())
def test_a_frame_of_such_names_is_asked_for_their_units(names, columns):
    frame = pd.DataFrame(dict(zip(names, columns, strict=True)))
    with pytest.raises(UserError, match=r"name them by Recording.from_frame"):
        Recording.from_frame(frame)


def test_a_time_may_have_its_plural(columns, tmp_path):
    table = {"imu/gyro": columns[1:4].T, "imu/accel": columns[4:].T}
    _hdf5(tmp_path / "log.h5", {"imu/timestamps": (1e9 * columns[0]).round().astype(int), **table})
    np.testing.assert_allclose(inspect(tmp_path / "log.h5").recording.time, columns[0], atol=1e-12)


HEAD = "time [s],gyro_x [rad/s],gyro_y [rad/s],gyro_z [rad/s]"


def rows(columns):
    return [[f"{v:.6f}" for v in row] for row in columns[:4].T]


@pytest.mark.parametrize(
    "cell", [" ", "      ", " NA", "NA ", " -", "1.#QNAN", "-1.#IND", "<NA>", "?", "#VALUE!"]
)
@pytest.mark.parametrize("first", [False, True])
def test_cells_that_hold_no_value(cell, first, columns, tmp_path):
    """Blanks around them, too, and where a row begins with one."""
    cells = rows(columns)
    cells[500][1] = cell
    order = [1, 0, 2, 3] if first else [0, 1, 2, 3]
    table = [HEAD.split(","), *cells]
    text = "\n".join(",".join(row[k] for k in order) for row in table)
    (tmp_path / "log.csv").write_text(text)
    found = read_recording(tmp_path / "log.csv")
    assert np.flatnonzero(np.isnan(found.gyro[:, 0])).tolist() == [500]
    assert len(found) == len(cells) and not np.isnan(found.gyro[:, 1:]).any()


FORMS = {
    "AM and PM over noon": ("2024-03-31T11:59:50", "%m/%d/%Y %I:%M:%S.%f %p"),
    "AM and PM over midnight": ("2024-03-31T23:59:50", "%I:%M:%S.%f %p"),
    "with the year first": ("2024-02-29T23:59:50", "%Y-%m-%d %I:%M:%S.%f %p"),
}


@pytest.mark.parametrize("form", FORMS)
def test_times_of_a_dial(form, columns, tmp_path):
    start, written = FORMS[form]
    stamps = pd.Timestamp(start) + pd.to_timedelta(columns[0].round(3), unit="s")
    lines = [",".join([s.strftime(written), *r[1:]]) for s, r in zip(stamps, rows(columns))]
    (tmp_path / "log.csv").write_text("\n".join([HEAD, *lines]))
    found = read_recording(tmp_path / "log.csv").time
    np.testing.assert_allclose(found - found[0], columns[0], atol=6e-11)


def test_spans_of_pandas(columns, tmp_path):
    spans = map(str, pd.to_timedelta(86390 + columns[0].round(3), unit="s"))
    lines = [",".join([span, *r[1:]]) for span, r in zip(spans, rows(columns))]
    (tmp_path / "log.csv").write_text("\n".join([HEAD, *lines]))
    found = read_recording(tmp_path / "log.csv").time
    np.testing.assert_allclose(found - found[0], columns[0], atol=6e-11)


def test_fahrenheit(columns, tmp_path):
    head = "Time (s),Gyro X (dps),Gyro Y (dps),Gyro Z (dps),Temp (°F)"
    (tmp_path / "log.csv").write_text(
        "\n".join([head, *(",".join([*r, "77"]) for r in rows(columns))])
    )
    np.testing.assert_allclose(read_recording(tmp_path / "log.csv").temperature, 25, rtol=1e-12)


# What is no log


@pytest.mark.parametrize(
    "name, content, said",
    [
        ("log.xlsx", b"PK", "save its sheet as CSV"),
        ("log.zip", b"PK", "unpack it"),
        ("log.csv.xz", b"", "unpack it"),
        ("log.pkl", b"", "make a CSV or Parquet of it"),
        ("imu.yaml", b"", "rostopic echo -p"),
        ("log.abc", b"", "rename text to .txt"),
        ("log.csv", b"", "log.csv: is empty"),
        ("log.csv", b"\n \n", "log.csv: is empty"),
        ("log.csv", f"{HEAD}\r0,0,0,0\r1,0,0,0\r".encode(), "a carriage return alone"),
        (
            "log.txt",
            b"angular_velocity:\n  x: 0.1\n  y: 0.1\nlinear_acceleration:\n  x: 0.1\n---\n" * 9,
            "ros2 topic echo --csv",
        ),
    ],
)
def test_what_is_to_be_done_is_said(name, content, said, tmp_path):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(UserError, match=said):
        inspect(tmp_path / name)


def test_times_that_are_none_are_named(columns, tmp_path):
    lines = [",".join(["01:59", *r[1:]]) for r in rows(columns)]
    head = HEAD.replace("time [s]", "stamp").replace(" [rad/s]", "_dps")
    (tmp_path / "log.csv").write_text("\n".join([head, *lines]))
    assert "stamp has no numbers, dates" in inspect(tmp_path / "log.csv").problem


def test_rows_of_one_time_are_told_of(columns, tmp_path):
    lines = [",".join(["5", *r[1:]]) for r in rows(columns)]
    (tmp_path / "log.csv").write_text("\n".join([HEAD, *lines]))
    with pytest.raises(UserError, match="this one has 1; 3,999 more have the time of the row befo"):
        read_recording(tmp_path / "log.csv")


def test_what_to_do_where_time_runs_backwards(columns, tmp_path):
    cells = rows(columns)
    anew = [*cells[:2000], *cells[:2000]]
    (tmp_path / "log.csv").write_text("\n".join([HEAD, *map(",".join, anew)]))
    with pytest.raises(UserError, match="row 2002: .*; cut the log where its clock was set anew"):
        read_recording(tmp_path / "log.csv")


@pytest.mark.parametrize("name", ["Temperatur [°C]", "Teplota (°C)", "die (degC)"])
def test_a_column_in_degc_is_a_temperature_whatever_its_name(name, columns, tmp_path):
    head = f"Time (s),Gyro X (dps),Gyro Y (dps),Gyro Z (dps),{name}"
    lines = [",".join([*r, "25.5"]) for r in rows(columns)]
    (tmp_path / "log.csv").write_text("\n".join([head, *lines]))
    np.testing.assert_allclose(read_recording(tmp_path / "log.csv").temperature, 25.5)
