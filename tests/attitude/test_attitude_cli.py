"""``pyimu attitude`` on good logs and bad ones: what it writes, what it says, and how it ends."""

import json

import numpy as np
import pytest
from attitude_cases import H, drive, measured, rover_rate
from pyarrow import parquet

from pyimu import Recording, attitude, read_recording

LATITUDE = 0.7


@pytest.fixture
def log(tmp_path):
    """The path of a log with a reference attitude."""
    world = drive(rover_rate(2000, still=1000), latitude=LATITUDE)
    gyro, accel, _ = measured(world, np.random.default_rng(0), np.array([0.01, -0.02, 0.015]))
    reference = world.attitude.as_quat(scalar_first=True)
    recording = Recording.from_arrays(
        time=H * np.arange(2000), gyro=gyro, accel=accel, ref_q=reference
    )
    return recording.write(tmp_path / "log.csv")


def one_line(text, *words):
    assert text.startswith("pyimu: ") and text.endswith("\n") and text.count("\n") == 1, text
    missing = [w for w in words if w not in text]
    assert not missing, f"{missing} not in: {text}"


def test_it_writes_three_files_and_says_what_it_found(pyimu, log, tmp_path):
    code, out, err = pyimu("attitude", log, "--out", "out")
    assert code == 0 and err == ""
    files = ["attitude.parquet", "report.html", "report.json"]
    assert sorted(p.name for p in (tmp_path / "out").iterdir()) == files
    for text in (
        "log: 2,000 samples, 20.0 s at 100 Hz, starts",
        "of the heading",
        "deg/s",
        "inclination",
        "axes are assumed to be the sensor's",
        "report: out/report.html, estimates: out/attitude.parquet",
    ):
        assert text in out


def test_its_options_are_those_of_the_function(pyimu, log, tmp_path):
    words = ("--part", "imt30", "--latitude", np.degrees(LATITUDE), "--heading0", "30")
    code, out, _ = pyimu("attitude", log, "--out", "out", *words)
    want = attitude.run(read_recording(log), "imt30", latitude=LATITUDE, heading0=np.radians(30.0))
    table = parquet.read_table(tmp_path / "out" / "attitude.parquet")
    assert code == 0 and "part imt30" in out
    np.testing.assert_allclose(table["q_z [1]"], want.q[:, 3], atol=1e-12)
    np.testing.assert_allclose(table["heading_std [rad]"], want.heading_std, rtol=1e-9)
    data = json.loads((tmp_path / "out" / "report.json").read_text())
    assert data["part"] == "imt30"
    assert data["parameters"]["latitude"] == pytest.approx(LATITUDE)


def test_what_the_filter_leaves_in_is_said_before_it_runs(pyimu, log, tmp_path):
    """Also where the log then cannot be read; not with ``--quiet``, and not in the data."""
    (tmp_path / "coarse.toml").write_text(
        'name = "coarse"\nsample_rate = {value = 100.0, unit = "Hz"}\n'
        '[gyro.quantization]\nq = {value = 0.01, unit = "deg/s"}\n'
    )
    said = "coarse: left in, not undone"
    code, out, err = pyimu("attitude", log, "--part", "coarse.toml", "--out", "out", "--json")
    assert code == 0 and err.startswith(said) and "quantization of the gyro" in err
    assert json.loads(out)["left_in"] == ["quantization of the gyro"]
    assert pyimu("attitude", "none.csv", "--part", "coarse.toml")[2].startswith(said)
    quiet = pyimu("attitude", log, "--part", "coarse.toml", "--out", "out", "--quiet")
    assert quiet == (0, "", "")


def test_a_part_of_another_rate_than_the_log_is_said(pyimu, log, tmp_path):
    (tmp_path / "slow.toml").write_text(
        'name = "slow"\nsample_rate = {value = 1.0, unit = "Hz"}\n'
        '[gyro.angle_random_walk]\nN = {value = 0.2, unit = "deg/sqrt(h)"}\n'
    )
    code, out, _ = pyimu("attitude", log, "--part", "slow.toml", "--out", "out")
    assert code == 0 and "rate of part: the part's rate is 1 Hz, the log's 100 Hz" in out
    data = json.loads((tmp_path / "out" / "report.json").read_text())
    assert "rate_of_part" in [f["kind"] for f in data["quality"]]
    assert "rate of part" not in pyimu("attitude", log, "--out", "out")[1]


def test_a_foreign_log_goes_through_a_column_map(pyimu, log, tmp_path):
    text = log.read_text().replace("gyro_x [rad/s]", "wx", 1)
    (tmp_path / "foreign.csv").write_text(text)
    (tmp_path / "map.toml").write_text('[columns]\nwx = "gyro_x [rad/s]"\n')
    assert pyimu("attitude", "foreign.csv", "--columns", "map.toml", "--out", "out")[0] == 0
    code, _, err = pyimu("attitude", "foreign.csv", "--out", "other")
    assert code == 2 and not (tmp_path / "other").exists()
    one_line(err, "foreign.csv", "gyro_x")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("missing.csv",), ("missing.csv", "no such file")),
        (("log.csv", "--latitude", "91"), ("--latitude 91", "-90 and 90 deg")),
        (("log.csv", "--latitude", "nan"), ("--latitude nan", "-90 and 90 deg")),
        (("log.csv", "--heading0", "inf"), ("--heading0 inf", "-360 and 360 deg")),
        (("log.csv", "--part", "imt31"), ("imt31", "no built-in part")),
        (("log.csv", "--out", "log.csv"), ("log.csv", "is a file")),
        (("log.csv", "--columns", "none.toml"), ("none.toml",)),
        ((), ("LOG", "--help")),
    ],
)
def test_wrong_calls_end_in_one_line(pyimu, log, words, said):
    code, out, err = pyimu("attitude", *words)
    assert code == 2 and out == ""
    one_line(err, *said)


def test_a_run_that_is_broken_off_costs_no_earlier_result(pyimu, log, tmp_path, monkeypatch):
    assert pyimu("attitude", log, "--out", "out")[0] == 0
    before = {p.name: p.read_bytes() for p in (tmp_path / "out").iterdir()}

    def fail(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("pyimu.attitude.result.write_json", fail)
    code, _, err = pyimu("attitude", log, "--out", "out", "--heading0", "10")
    assert code == 130
    one_line(err, "interrupted")
    assert {p.name: p.read_bytes() for p in (tmp_path / "out").iterdir()} == before
