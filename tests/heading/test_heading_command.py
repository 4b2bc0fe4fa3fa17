"""``pyimu heading`` on good logs and bad ones: what it writes, what it says, and how it ends."""

import json
from dataclasses import replace

import numpy as np
import pytest
from heading_cases import one_line
from pyarrow import parquet

from pyimu import heading, read_recording
from pyimu.heading import METHODS
from pyimu.recording.recording import Recording
from pyimu.rover.indoor_runs import Assumptions, one_run


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A folder with logs of two runs, start-up and drive in one, and of one run apart."""
    folder = tmp_path_factory.mktemp("logs")
    for i in range(2):
        one = one_run(i, Assumptions(slip=0.0))
        m = one.motion
        gyro = np.concatenate([one.known.gyro[:-1, 2], one.log.gyro[:, 2]])
        m.recording(gyro, name=f"run{i}").write(folder / f"run{i}.csv")
    one.known.write(folder / "known.csv")
    one.log.write(folder / "drive.csv")
    return folder


def test_it_writes_three_files_and_a_row_for_each_method(pyimu, whole, tmp_path):
    code, out, err = pyimu("heading", whole / "run0.csv", whole / "run1.csv", "--out", "out")
    assert code == 0 and err == ""
    files = ["heading.parquet", "report.html", "report.json"]
    assert sorted(p.name for p in (tmp_path / "out").iterdir()) == files
    lines = out.splitlines()
    for name in METHODS:
        assert any(line.startswith(f"{name} ") for line in lines), name
    assert "threshold less paper" in out and "report: out/report.html" in out
    data = json.loads((tmp_path / "out" / "report.json").read_text())
    assert [m["name"] for m in data["methods"]] == list(METHODS)
    want = heading.run([read_recording(whole / f"run{i}.csv") for i in range(2)])
    for m in data["methods"]:
        assert m["error"]["rms"] == pytest.approx(want[m["name"]].statistics.rms)
        assert m["error"]["count"] == 2
    table = parquet.read_table(tmp_path / "out" / "heading.parquet")
    np.testing.assert_allclose(table["filter [rad]"], want["filter"].tracks[0].heading)


def test_a_known_motion_may_be_a_log_of_its_own(pyimu, whole, tmp_path):
    words = ("--known", whole / "known.csv", "--method", "paper,filter", "--slip", "0.3")
    code, out, _ = pyimu("heading", whole / "drive.csv", *words, "--out", "out")
    assert code == 0 and "a known motion of its own" in out
    data = json.loads((tmp_path / "out" / "report.json").read_text())
    last = data["methods"][1]["logs"][0]["last"]
    # The scale factor is known to the slip and no better: its share of 1 + s.
    assert last["scale_factor_std"] == pytest.approx(0.003, rel=0.02)


def test_a_part_of_another_rate_than_the_log_is_said(pyimu, whole, tmp_path):
    (tmp_path / "slow.toml").write_text(
        'name = "slow"\nsample_rate = {value = 1.0, unit = "Hz"}\n'
        '[gyro.angle_random_walk]\nN = {value = 0.2, unit = "deg/sqrt(h)"}\n'
    )
    words = ("heading", whole / "run0.csv", "--method", "filter", "--out", "out")
    code, out, _ = pyimu(*words, "--part", "slow.toml")
    assert code == 0 and "run0: the part's rate is 1 Hz, the log's " in out
    assert "the part's rate" not in pyimu(*words)[1]


def test_without_a_reference_the_methods_that_need_none_go_on(pyimu, whole, tmp_path):
    text = read_recording(whole / "run0.csv")
    replace(text, ref_heading=None).write(tmp_path / "bare.csv")
    code, out, _ = pyimu("heading", "bare.csv", "--out", "out")
    assert code == 0
    for words in ("self-calibration and paper are left out", "without a known motion"):
        assert words in out
    assert "no log has a reference of its heading" in out
    code, _, err = pyimu("heading", "bare.csv", "--method", "paper", "--out", "other")
    assert code == 2 and not (tmp_path / "other").exists()
    one_line(err, "bare", "no reference", "ref_heading")


def test_the_report_as_json_alone_or_not_at_all(pyimu, whole, tmp_path):
    words = ("heading", whole / "run0.csv", "--method", "integrate", "--out", "out")
    code, out, err = pyimu(*words, "--json")
    assert code == 0 and err == "" and out == (tmp_path / "out" / "report.json").read_text()
    assert pyimu(*words, "--quiet") == (0, "", "")


def test_what_is_missing_or_late_is_said(pyimu, whole, tmp_path):
    log = read_recording(whole / "run0.csv")
    gyro, true = np.array(log.gyro), np.array(log.ref_heading)
    gyro[2000:2003], true[8000:] = np.nan, np.nan
    rows = np.r_[0:5000, 5100 : len(log)]
    late = np.interp(log.time - 0.013, log.time, true)
    groups = {"gyro": gyro, "ref_heading": late, "accel": log.accel}
    gappy = Recording.from_arrays(
        "gappy", time=log.time[rows], **{name: v[rows] for name, v in groups.items()}
    )
    gappy.write(tmp_path / "gappy.csv")
    code, out, err = pyimu("heading", "gappy.csv", "--out", "out")
    assert code == 0 and err == ""
    for said in (
        "gyro_z is missing in 3 rows, the first at 40 s",
        "a gap of 2.02 s after 99.98 s",
        "the reference ends at",
        "the reference is late by 13",
    ):
        assert said in out, out


def test_of_two_references_the_one_that_is_named_is_believed(pyimu, whole, tmp_path):
    log = read_recording(whole / "run0.csv")
    rate = np.zeros((len(log), 3))
    rate[1:, 2] = 0.8 * np.diff(log.ref_heading) * log.sample_rate
    replace(log, ref_rate=rate, stationary=None).write(tmp_path / "two.csv")
    words = ("heading", "two.csv", "--method", "self-calibration", "--out", "out")
    code, _, err = pyimu(*words)
    assert code == 2
    one_line(err, "ref_heading and ref_rate_z disagree", "--reference")
    found = {}
    for name in ("heading", "rate"):
        assert pyimu(*words, "--reference", name, "--quiet") == (0, "", "")
        data = json.loads((tmp_path / "out" / "report.json").read_text())
        found[name] = data["methods"][0]["logs"][0]
    # By the rate, which is a fifth too slow, all turns of the log are as well: 72 of 360 deg.
    s = {name: one["calibration"]["s"]["value"] for name, one in found.items()}
    assert (1 + s["rate"]) / (1 + s["heading"]) == pytest.approx(1 / 0.8, rel=0.01)
    turned = found["heading"]["heading"] - found["rate"]["heading"]
    assert turned == pytest.approx(0.2 * 2 * np.pi, rel=0.05)
    assert abs(found["rate"]["error"]) < 0.1


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("missing.csv",), ("missing.csv", "no such file")),
        (("LOG", "--method", "papre"), ("--method papre", "paper", "known are")),
        (("LOG", "--threshold", "-1"), ("--threshold is -1", "not negative")),
        (("LOG", "--threshold", "45"), ("slowest turn", "45 deg/s", "--threshold")),
        (("LOG", "--start-up", "500"), ("no longer than its start-up", "--start-up")),
        (("LOG", "--reference", "yaw"), ("--reference yaw", "heading, rate")),
        (("LOG", "--part", "imt31"), ("imt31", "no built-in part")),
        (("LOG", "--release", "1"), ("release", "above the threshold")),
        (("LOG", "--slip", "-1"), ("--slip is -1", "not negative")),
        (("LOG", "--start-up", "nan"), ("--start-up is nan", "not negative")),
        (("LOG", "--json", "--quiet"), ("--json", "--quiet", "one of the two")),
        ((), ("LOG", "--help")),
    ],
)
def test_wrong_calls_end_in_one_line(pyimu, whole, tmp_path, words, said):
    given = [whole / "run0.csv" if w == "LOG" else w for w in words]
    code, out, err = pyimu("heading", *given, "--out", "out")
    assert code == 2 and out == "" and not (tmp_path / "out").exists()
    one_line(err, *said)


def test_help_opens_with_an_example(pyimu):
    code, out, _ = pyimu("heading", "--help")
    assert code == 0 and "Example: pyimu heading robot.csv --method all --out out/heading" in out
