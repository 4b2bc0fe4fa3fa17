"""Recordings and parts in a notebook: frames there and back, short lines, tables and pictures."""

import re
from html.parser import HTMLParser

import numpy as np
import pandas as pd
import pytest

import pyimu
from pyimu import Recording
from pyimu.errors import UserError
from pyimu.recording.show import BINS

N = 20_000


@pytest.fixture(scope="module")
def log():
    rng = np.random.default_rng(3)
    gyro = 1e-3 * rng.standard_normal((N, 3))
    gyro[123, 1], gyro[77, 2] = 1.0, np.nan
    accel = np.tile([0.0, 0.0, 9.80665], (N, 1))
    time = 0.01 * np.arange(N)
    return Recording.from_arrays("lab <1>", time=time, gyro=gyro, accel=accel, speed=np.ones(N))


class Cells(HTMLParser):
    """The text of all cells; an element that is not closed is an error."""

    def __init__(self, text):
        super().__init__()
        self.open, self.cells = [], []
        self.feed(text)
        assert not self.open

    def handle_starttag(self, tag, attributes):
        self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open[-1:] == ["td"]:
            self.cells.append(data)


def test_a_recording_comes_back_from_its_frame_to_the_bit(log):
    frame = log.to_frame()
    assert isinstance(frame, pd.DataFrame) and "gyro_x [rad/s]" in frame.columns
    again = Recording.from_frame(frame, "again")
    assert again.name == "again" and again.groups.keys() == log.groups.keys()
    np.testing.assert_array_equal(again.time, log.time)
    for group, values in log.groups.items():
        np.testing.assert_array_equal(getattr(again, group), values)


def test_a_frame_is_converted_from_its_units():
    frame = pd.DataFrame({"time [ms]": [0.0, 10.0, 20.0], "gyro_x [°/s]": [180.0, 0.0, 0.0]})
    frame["gyro_y [mdps]"] = frame["gyro_z [rpm]"] = 0.0
    recording = Recording.from_frame(frame)
    assert recording.gyro[0, 0] == pytest.approx(np.pi) and recording.time[1] == 0.01


BARE = pd.DataFrame({"t": [0.0, 10.0, 20.0], "gx": [180.0, 0.0, 0.0], "gy": 0.0, "gz": 0.0})
RENAMED = {"t": "time [ms]", "gx": "gyro_x [deg/s]", "gy": "gyro_y [deg/s]", "gz": "gyro_z [deg/s]"}


def test_a_frame_s_columns_are_named_by_a_map(tmp_path):
    """By new names, by the tables of a column map, and by its file; its axes are turned."""
    (tmp_path / "map.toml").write_text(
        "[columns]\n" + "".join(f'{k} = "{v}"\n' for k, v in RENAMED.items())
    )
    turned = {"columns": RENAMED, "frame": {"R": [[0, 1, 0], [-1, 0, 0], [0, 0, 1]]}}
    for columns in (RENAMED, turned, tmp_path / "map.toml"):
        found = Recording.from_frame(BARE, "bare", columns=columns)
        axis = 1 if columns is turned else 0
        assert found.name == "bare" and found.time[2] == 0.02
        assert abs(found.gyro[0, axis]) == pytest.approx(np.pi)
    with pytest.raises(UserError, match='columns."gw"'):
        Recording.from_frame(BARE, columns={"gw": "gyro_x [deg/s]"})
    with pytest.raises(UserError, match="columns is a list"):
        Recording.from_frame(BARE, columns=["t"])


STAMPS = pd.to_datetime(1.7e9 + 0.01 * np.arange(400), unit="s")
DAY = (1.7e9 % 86400) + 0.01 * np.arange(400)


@pytest.mark.parametrize(
    ("dated", "time"),
    [
        (lambda f: f.set_index(STAMPS), DAY),
        (lambda f: f.set_index(STAMPS.tz_localize("UTC").rename("stamp")), DAY),
        (lambda f: f.set_index(pd.to_timedelta(10.0 * np.arange(400), unit="ms")), DAY - DAY[0]),
        (lambda f: f.set_index(pd.Index(10.0 * np.arange(400), name="time [ms]")), DAY - DAY[0]),
        (lambda f: f.assign(time=STAMPS), DAY),
        (lambda f: f.assign(**{"time [ms]": STAMPS - STAMPS[0]}), DAY - DAY[0]),
    ],
)
def test_dates_spans_and_an_index_are_times(dated, time, tmp_path):
    """Dates from the midnight before the first. A Parquet file of the frame is read alike."""
    frame = pd.DataFrame({f"gyro_{a} [rad/s]": np.arange(400.0) for a in "xyz"})
    found = Recording.from_frame(dated(frame))
    np.testing.assert_allclose(found.time, time, atol=1e-6)
    columns = dated(frame).reset_index(names="time") if len(dated(frame).columns) == 3 else None
    if columns is not None and columns["time"].dtype.kind in "mM":
        columns.to_parquet(tmp_path / "log.parquet")
        read = pyimu.read_recording(tmp_path / "log.parquet")
        np.testing.assert_allclose(read.time, time, atol=1e-6)


@pytest.mark.parametrize(
    "frame", [BARE, BARE.rename(columns={"t": "time", "gx": "gyro_x"}), BARE.drop(columns="t")]
)
def test_what_a_frame_lacks_is_said_without_the_command_line(frame):
    with pytest.raises(UserError) as said:
        Recording.from_frame(frame)
    assert "--" not in str(said.value) and "pyimu inspect" not in str(said.value)


@pytest.mark.parametrize("given", [3, [1, 2], "log.csv", None])
def test_what_is_no_frame_is_refused(given):
    with pytest.raises(UserError, match="is no data frame"):
        Recording.from_frame(given)


def test_the_table_has_each_column_in_units_for_people(log):
    cells = Cells(log._repr_html_()).cells
    rows = {cells[i]: cells[i + 1 : i + 6] for i in range(0, len(cells), 6)}
    assert rows["gyro_y"][0] == "deg/s" and float(rows["gyro_y"][3]) == pytest.approx(57.30)
    assert rows["accel_z"][:2] == ["g", "1"] and rows["gyro_z"][4] == "1"
    assert "lab &lt;1&gt;" in log._repr_html_() and "20,000 samples at 100 Hz" in log._repr_html_()


def test_the_picture_has_a_panel_for_each_group_and_keeps_a_single_spike(log):
    panels = log.plot().axes
    assert [p.get_ylabel() for p in panels] == ["gyro [deg/s]", "accel [g]", "speed [m/s]"]
    drawn = panels[0].lines[1].get_ydata()
    assert len(drawn) <= 2 * BINS and np.nanmax(drawn) == pytest.approx(np.degrees(1.0))


def test_a_part_is_a_line_and_a_table(log):
    part = pyimu.part("mpu6050")
    assert len(repr(part)) < 250 and "mpu6050" in repr(part) and "array" not in repr(part)
    cells = Cells(part._repr_html_()).cells
    assert "gyro.angle_random_walk.N" in cells and "0.005 deg/s/sqrt(Hz) (one-sided)" in cells
    assert sum(c.startswith("+-") for c in cells) >= 8


def test_an_inspection_is_a_line_a_table_and_a_picture(log, tmp_path):
    found = pyimu.inspect(log.write(tmp_path / "log.csv"))
    assert len(repr(found)) < 300 and "20000 samples" in repr(found) and "gyro" in repr(found)
    assert "gyro" in Cells(found._repr_html_()).cells
    assert found.plot().axes[0].get_ylabel() == "gyro [deg/s]"
    (tmp_path / "bare.csv").write_text("t,a,b\n" + "0,1,2\n" * 50)
    unread = pyimu.inspect(tmp_path / "bare.csv")
    assert unread.problem and len(repr(unread)) < 300
    assert "<table>" in unread._repr_html_()
    with pytest.raises(UserError, match="nothing to draw"):
        unread.plot()


def test_a_part_is_a_frame_of_its_coefficients():
    frame = pyimu.part("mpu6050").to_frame().set_index("coefficient")
    N = frame.loc["gyro.angle_random_walk.N"]
    want = np.radians(0.005) / np.sqrt(2)
    np.testing.assert_allclose(N["value"], np.full(3, want), rtol=1e-9)
    assert N["unit"] == "rad/sqrt(s)" and "0.005" in N["quoted"] and not N["estimate"]


def test_results_are_lines_too(log):
    found = pyimu.characterize(log.slice(200, 4200))
    assert re.fullmatch(r"Characterization\(lab <1>: gyro, accel, \d+ findings\)", repr(found))
    html = found._repr_html_()
    assert html.count("<svg") == 1 and "angle random walk" in html and "&lt;1&gt;" in html
    level = np.tile([0.0, 0.0, 9.80665], (400, 1)) + 0.01 * log.gyro[200:600]
    rest = Recording.from_arrays("rest", time=log.time[:400], gyro=log.gyro[200:600], accel=level)
    attitude = pyimu.attitude.run(rest)
    assert repr(attitude) == "AttitudeResult('rest': 400 samples, 3.99 s)"
    assert "<svg" in attitude._repr_html_()
    frame = attitude.to_frame()
    assert len(frame) == 400 and "q_w [1]" in frame.columns
    frame = found.to_frame().set_index(["channel", "term"])
    N = found.coefficients["gyro_x", "N"].mean
    assert frame.loc[("gyro_x", "N"), "value"] == N.value
    assert frame.loc[("gyro_x", "N"), "unit"] == "rad/sqrt(s)"
    panels = found.plot().axes
    assert [p.get_ylabel().split()[0] for p in panels[::3]] == ["gyro_x", "accel_x"]
