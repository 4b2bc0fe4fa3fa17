"""``pyimu navigate`` on good logs and bad ones: what it writes, what it says, and how it ends."""

import json
from dataclasses import replace

import numpy as np
import pytest
from navigation_cases import PART, SHORT, assumed
from pyarrow import parquet

from pyimu import read_recording
from pyimu.ins import run
from pyimu.recording.recording import Recording
from pyimu.report.numbers import quantity
from pyimu.rover.trajectory import motion


@pytest.fixture(scope="module")
def square_log():
    return assumed().specimen(4).simulate(motion(SHORT, 50.0), seed=4)


@pytest.fixture
def log(square_log, tmp_path):
    return square_log.write(tmp_path / "square.csv")


def one_line(text, *words):
    assert text.startswith("pyimu: ") and text.endswith("\n") and text.count("\n") == 1, text
    missing = [w for w in words if w not in text]
    assert not missing, f"{missing} not in: {text}"


def test_it_writes_four_files_and_says_what_it_found(pyimu, log, tmp_path):
    code, out, err = pyimu("navigate", log, "--part", PART, "--out", "out")
    assert code == 0 and err == ""
    files = ["estimate.parquet", "navigation.parquet", "report.html", "report.json"]
    assert sorted(p.name for p in (tmp_path / "out").iterdir()) == files
    for text in (
        "12 scale factors and misalignments estimated",
        "It rests in",
        "4 times after the start",
        "Yaw cannot be seen from zero velocities",
        "mean NIS",
        "report: out/report.html, estimates: out/navigation.parquet",
    ):
        assert text in out, text
    data = json.loads((tmp_path / "out" / "report.json").read_text())
    ends = {name: m["error"]["end"] for name, m in data["methods"].items()}
    assert set(ends) == {"paper", "strapdown", "filter", "smoother"}
    assert ends["filter"] < 1.0 < ends["strapdown"] < ends["paper"]
    assert data["rests"]["stops"] == 4
    assert data["parameters"]["zupt"] == 1.0


def test_the_report_as_json_alone_or_not_at_all(pyimu, log, tmp_path):
    words = ("navigate", log, "--part", PART, "--method", "filter", "--out", "out")
    code, out, err = pyimu(*words, "--json")
    assert code == 0 and err == "" and out == (tmp_path / "out" / "report.json").read_text()
    assert pyimu(*words, "--quiet") == (0, "", "")
    assert pyimu(*words, "--json", "--quiet")[0] == 2


def test_a_part_of_another_rate_than_the_log_is_said(pyimu, log, tmp_path):
    (tmp_path / "slow.toml").write_text(
        'name = "slow"\nsample_rate = {value = 1.0, unit = "Hz"}\n'
        '[gyro.angle_random_walk]\nN = {value = 0.2, unit = "deg/sqrt(h)"}\n'
    )
    words = ("navigate", log, "--method", "filter", "--out", "out")
    said = "rate of part: the part's rate is 1 Hz, the log's 50 Hz"
    code, out, _ = pyimu(*words, "--part", "slow.toml")
    assert code == 0 and said in out
    data = json.loads((tmp_path / "out" / "report.json").read_text())
    assert "rate_of_part" in [f["kind"] for f in data["findings"]]
    assert "rate of part" not in pyimu(*words)[1]


def test_an_antenna_is_three_numbers(pyimu, log, tmp_path):
    words = ("navigate", log, "--part", PART, "--method", "filter", "--out", "out")
    assert pyimu(*words, "--antenna", "0.2,0,0.5", "--quiet") == (0, "", "")
    data = json.loads((tmp_path / "out" / "report.json").read_text())
    assert [data["parameters"][f"antenna[{i}]"] for i in (1, 2, 3)] == [0.2, 0.0, 0.5]
    code, _, err = pyimu(*words, "--antenna", "0.2,up")
    assert code == 2
    one_line(err, "--antenna 0.2,up", "X,Y,Z in m")


def test_the_estimate_is_a_recording_with_the_best_path(pyimu, log, tmp_path, square_log):
    assert pyimu("navigate", log, "--part", PART, "--out", "out")[0] == 0
    back = read_recording(tmp_path / "out" / "estimate.parquet")
    table = parquet.read_table(tmp_path / "out" / "navigation.parquet")
    np.testing.assert_array_equal(back.ref_east, table["smoother_position_east [m]"])
    np.testing.assert_array_equal(back.gyro, square_log.gyro)


def test_one_method_and_no_updates(pyimu, log):
    words = ("--part", PART, "--method", "filter", "--zupt", "off", "--out", "out")
    code, out, _ = pyimu("navigate", log, *words)
    assert code == 0 and "Zero-velocity updates are off" in out and "paper" not in out


@pytest.mark.parametrize(
    ("words", "said"),
    (
        (("--method", "papper"), ("papper", "did you mean paper?")),
        (("--zupt", "maybe"), ("maybe", "auto, live, foot, declared, off")),
        (("--zupt", "declared"), ("stationary [1]", "--zupt auto")),
        (("--latitude", "95"), ("--latitude 95", "-90 and 90")),
        (("--top-speed", "-1"), ("top_speed",)),
        (("--position-age", "0.2"), ("position_age was told", "position_east")),
    ),
)
def test_wrong_options_end_with_a_line(pyimu, log, tmp_path, words, said):
    code, _, err = pyimu("navigate", log, *words, "--out", "out")
    assert code == 2
    one_line(err, *said)
    assert not list(tmp_path.glob("out/*"))


def changed(square_log, **groups):
    return replace(square_log, **groups)


@pytest.mark.parametrize(
    ("change", "said"),
    (
        (lambda r: {"accel": None}, ("no accel", "accel_x [m/s^2]")),
        (lambda r: {"gyro": None}, ("no gyro", "gyro_x [rad/s]")),
        (lambda r: {"accel": r.accel / 9.80665}, ("show a gravity of", "accel_x [g]")),
        (lambda r: {"accel": r.accel * [1, -1, -1]}, ("gravity is on -z", "frd")),
        (lambda r: {"stationary": None, "accel": np.full_like(r.accel, np.nan)}, ("no accel",)),
    ),
)
def test_a_log_that_cannot_be_used_ends_with_a_line(pyimu, square_log, tmp_path, change, said):
    path = changed(square_log, **change(square_log)).write(tmp_path / "bad.csv")
    code, _, err = pyimu("navigate", path, "--out", "out")
    assert code == 2
    one_line(err, "bad", *said)


def test_no_rest_at_the_start_is_said_and_the_tilt_is_not_known(square_log):
    moving = square_log.slice(int(np.searchsorted(square_log.time, 8.0)))
    found = run(moving, assumed(), method="filter", zupt="off")
    assert "no rest at the start" in found.report()
    assert found.filter.vector("attitude_std")[0, 0] > 0.2


def test_a_log_without_rest_says_so_first(square_log):
    moving = square_log.slice(*(int(np.searchsorted(square_log.time, t)) for t in (5.5, 11.0)))
    found = run(moving, assumed(), method="filter")
    text = found.report()
    assert "no rest in this log" in text.splitlines()[1]
    # a drive as steady as a rest by itself is none by the noise of its part
    assert "no rest at the start" in text and "at rest is" not in text


def test_a_log_that_never_stops_says_first_what_its_end_is_worth(square_log):
    """With a rest at the start, and with what else holds it."""
    driven = square_log.slice(0, int(np.searchsorted(square_log.time, 11.0)))
    found = run(driven, assumed(), method="filter")
    std = np.linalg.norm(found.tracks["filter"].position_std[-1, :2])
    first = found.report().splitlines()[1]
    assert "no rest after that at the start" in first and "nothing to update with" in first
    assert f"standard deviation has grown to {quantity(std, 'm')} at the end" in first
    first = run(driven, assumed(), method="filter", nhc=True).report().splitlines()[1]
    assert "what holds the position is the vehicle's constraint; the standard" in first
    assert "has grown" not in run(driven, assumed(), method="strapdown").report()


def test_a_wrong_scale_of_the_accelerometer_is_said(square_log):
    found = run(replace(square_log, accel=1.06 * square_log.accel), assumed(), method="filter")
    assert "gravity off" in found.report()


def test_a_rate_too_high_for_the_sample_rate_is_said(square_log):
    fast = np.array(square_log.gyro)
    fast[700] = [0.0, 0.0, 20.0]
    found = run(replace(square_log, gyro=fast), assumed(), method="filter")
    assert "between two samples (at 14 s): the sample rate is too low" in found.report()
    assert "or the unit of gyro or time" in found.report()


def test_integration_alone_is_left_out_where_samples_are_missing(square_log):
    holes = np.array(square_log.accel)
    holes[800:803] = np.nan
    found = run(replace(square_log, accel=holes), assumed(), method="all")
    assert set(found.tracks) == {"filter", "smoother"}
    assert "was left out: " in found.report()
    assert np.isfinite(found.filter.y).all()
    assert np.count_nonzero(found.filter.scalar("status").astype(int) & 1) == 3


def test_a_data_frame_is_a_recording_too(square_log):
    import pandas as pd

    names = {
        f"{k}_{a} [{u}]": square_log.groups[k][:, i]
        for k, u in (("gyro", "rad/s"), ("accel", "m/s^2"))
        for i, a in enumerate("xyz")
    }
    frame = pd.DataFrame({"time [s]": square_log.time} | names)
    same = Recording.from_arrays(time=square_log.time, gyro=square_log.gyro, accel=square_log.accel)
    pair = [run(r, assumed(), method="filter") for r in (frame, same)]
    np.testing.assert_array_equal(pair[0].filter.y, pair[1].filter.y)
