"""``pyimu characterize`` on good logs and bad ones.

A run that is broken off leaves no half result; the other commands take the part.
"""

import html
import json
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

from pyimu import Recording
from pyimu.files.held import PREFIX

ROWS, H = 4000, 0.01


def gyro(seed=1):
    return 1e-3 * np.random.default_rng(seed).standard_normal((ROWS, 3))


def write(folder, name="rest", time=None, **groups):
    groups = groups or {"gyro": gyro()}
    return Recording.from_arrays(
        name, time=H * np.arange(len(groups["gyro"])) if time is None else time, **groups
    ).write(folder / f"{name}.csv")


def one_line(text, *words):
    assert text.startswith("pyimu: ") and text.endswith("\n") and text.count("\n") == 1, text
    missing = [w for w in words if w not in text]
    assert not missing, f"{missing} not in: {text}"


def findings(folder):
    data = json.loads((folder / "report.json").read_text())
    return {(f["kind"], f["column"]): f for log in data["logs"] for f in log["quality"]}


# Good logs


def test_a_log_gives_three_files_and_says_what_it_found(pyimu, tmp_path):
    code, out, err = pyimu("characterize", write(tmp_path), "--out", "out")
    assert code == 0 and err == ""
    assert sorted(p.name for p in (tmp_path / "out").iterdir()) == [
        "part.toml",
        "report.html",
        "report.json",
    ]
    for text in (
        "4,000 rows, 40.0 s, gyro at 100 Hz",
        "angle random walk",
        "deg/sqrt(h)",
        "report: out/report.html, part: out/part.toml",
    ):
        assert text in out


@pytest.mark.long
def test_the_part_can_be_built_and_closed_with(pyimu, tmp_path):
    log = write(tmp_path)
    assert pyimu("characterize", log, "--out", "out")[0] == 0
    code, out, _ = pyimu("build", "out/part.toml", "--out", "fmus", "--fmu", "sensor", "--fmi", "2")
    assert code == 0 and "ImuSensor.fmi2.fmu" in out
    code, out, _ = pyimu("close", log, "--part", "out/part.toml", "--out", "closed")
    assert code == 0 and out.startswith("verdict: ") and "rate residual" in out
    assert "N" in pyimu("parts", "out/part.toml")[1]


def test_what_was_measured_stands_beside_the_data_sheet(pyimu, undrawn, tmp_path):
    """Samples of 0.001 rad/s each at 100 Hz: N = 1e-4 rad/sqrt(s) = 0.344 deg/sqrt(h), of the
    data sheet's 0.212 (0.005 deg/s/sqrt(Hz), over sqrt(2)) 1.6 times; the standard error of N,
    of 4,000 samples, is a percent."""
    log = write(tmp_path)
    code, out, err = pyimu("characterize", log, "--part", "mpu6050", "--out", "out")
    assert (code, err) == (0, "")
    row = next(line for line in out.partition("beside mpu6050")[2].splitlines() if "walk" in line)
    assert row.split()[3:5] == ["deg/sqrt(h)", "0.212"] and "1.6" in row.rpartition("  ")[2]
    data = json.loads((tmp_path / "out" / "report.json").read_text())["data_sheet"]
    assert data["part"] == "mpu6050" and len(data["gyro"][0]["times"]) == 3
    assert data["gyro"][0]["upper_bound"] == [False] * 3
    assert pyimu("characterize", log, "--part", "mpu605", "--out", "no")[0] == 2
    assert not (tmp_path / "no").exists()


def test_a_deviation_that_falls_to_the_end_is_an_upper_bound(pyimu, undrawn, tmp_path):
    """White noise alone falls for ever: on the terminal, on the page and as data."""
    code, out, err = pyimu("characterize", write(tmp_path), "--part", "mpu6050", "--out", "out")
    table, _, beside = out.partition("beside mpu6050")
    for text in (table, beside):
        row = next(line for line in text.splitlines() if "lowest Allan deviation" in line)
        assert row.count(" < ") == 3
    assert row.endswith("–") and "the lowest one is an upper bound ('<')" in table
    text = html.unescape((tmp_path / "out" / "report.html").read_text())
    assert "the lowest one is an upper bound ('<')" in text
    for name in ("lowest Allan deviation", "B as read off it"):
        assert text.partition(f">{name}<")[2].partition("</tr>")[0].count("< ") == 3
    data = json.loads((tmp_path / "out" / "report.json").read_text())
    channels = data["logs"][0]["sensors"]["gyro"]["channels"].values()
    assert [ch["floor"]["upper_bound"] for ch in channels] == [True] * 3
    (beside,) = (v for v in data["data_sheet"]["gyro"] if v["name"].startswith("lowest"))
    assert beside["upper_bound"] == [True] * 3 and beside["times"] == [None] * 3


def test_a_log_that_moves_is_called_one_first_and_gives_no_part(pyimu, undrawn, tmp_path):
    """Nor does it leave an earlier part to be taken for its own, nor an export of it."""
    turning = gyro() + np.outer(np.sin(0.5 * H * np.arange(ROWS)), [0, 1.0, 0])
    (tmp_path / "out").mkdir()
    for earlier in ("part.toml", "ekf2.params"):
        (tmp_path / "out" / earlier).write_text("earlier")
    log = write(tmp_path, "drive", gyro=turning)
    words = ("characterize", log, "--part", "mpu6050", "--out", "out")
    code, out, err = pyimu(*words, "--export", "px4")
    assert (code, err) == (0, "") and out.startswith("drive moves: ")
    assert "gyro (noise and motion together) " in out and "bandwidth" not in out
    assert "not set beside mpu6050: the log moves" in out and "measured over it" not in out
    text = html.unescape((tmp_path / "out" / "report.html").read_text())
    assert "Coefficients: noise and motion together" in text and "bandwidth" not in text
    assert "Gyro, noise and motion together: overlapping Allan deviation" in text
    assert "Gyro x, y, z: white noise N" not in text and "Beside the data sheet" not in text
    assert "no part: the log moves" in out.splitlines()[-2]
    assert out.splitlines()[-1] == "nothing exported (px4): the log moves"
    assert sorted(p.name for p in (tmp_path / "out").iterdir()) == ["report.html", "report.json"]
    data = json.loads((tmp_path / "out" / "report.json").read_text())
    assert data["moving"] == ["drive"] and data["data_sheet"] is None
    channels = data["logs"][0]["sensors"]["gyro"]["channels"].values()
    assert [ch["bandwidth"] for ch in channels] == [None] * 3


def test_a_script_can_tell_a_log_that_moves(pyimu, undrawn, tmp_path):
    """By the exit status where it is asked for; what it asked for and does not get is said."""
    turning = gyro() + np.outer(np.sin(0.5 * H * np.arange(ROWS)), [0, 1.0, 0])
    moves, rests = write(tmp_path, "drive", gyro=turning), write(tmp_path)
    for log, options, status, said in (
        (rests, ("--exit-code",), 0, ""),
        (moves, (), 0, ""),
        (moves, ("--exit-code",), 17, ""),
        (moves, ("--exit-code", "--export", "kalibr"), 17, "nothing exported (kalibr): the log"),
    ):
        code, out, err = pyimu("characterize", log, "--quiet", *options, "--out", "out")
        assert (code, out) == (status, "") and said in err and bool(said) == bool(err)


def test_a_gyro_in_another_unit_is_said_before_its_coefficients(pyimu, undrawn, tmp_path):
    accel = [0, 0, 9.81] + 0.02 * np.random.default_rng(2).standard_normal((ROWS, 3))
    log = write(tmp_path, gyro=gyro() * 180 / np.pi, accel=accel)
    code, out, _ = pyimu("characterize", log, "--out", tmp_path)
    assert code == 0
    first = out[: out.index("angle random walk")]
    assert "are the numbers in deg/s where rad/s is stated?" in first


def test_the_part_is_exported_too(pyimu, undrawn, tmp_path):
    log = write(tmp_path, accel=1e-2 * gyro(2) + [0, 0, 9.8], gyro=gyro())
    code, out, _ = pyimu("characterize", log, "--export", "kalibr,px4", "--out", "out")
    assert code == 0 and "imu.yaml: noise 10 times" in out
    assert {"imu.yaml", "ekf2.params"} < {p.name for p in (tmp_path / "out").iterdir()}


def test_several_logs_go_together(pyimu, undrawn, tmp_path):
    logs = [write(tmp_path, f"test_{k}", gyro=gyro(k)) for k in (1, 2)]
    code, out, _ = pyimu("characterize", *logs, "--out", "out")
    assert (
        code == 0
        and "Means over 2 logs" in out
        and 'name = "test"' in (tmp_path / "out" / "part.toml").read_text()
    )


def test_a_file_is_given_once_and_equal_names_are_told_apart(pyimu, undrawn, tmp_path):
    log = write(tmp_path)
    code, _, err = pyimu("characterize", log, tmp_path / "." / "rest.csv", "--out", "out")
    assert code == 2 and not (tmp_path / "out").exists()
    one_line(err, "rest.csv", "given twice")
    for k in ("a", "b"):
        (tmp_path / k).mkdir()
        write(tmp_path / k, gyro=gyro(ord(k)))
    code, out, _ = pyimu("characterize", "a/rest.csv", "b/rest.csv", log, "--out", "out")
    assert code == 0 and "a/rest: 4,000 rows" in out and "b/rest: 4,000 rows" in out


@pytest.mark.parametrize("even", (True, False))
def test_coarse_time_stamps(pyimu, tmp_path, even):
    """Of rows that come evenly each gets a time of its own; of others too few are left."""
    import pandas as pd

    rng = np.random.default_rng(6)
    steps = np.full(ROWS, H) if even else rng.exponential(H, ROWS)
    columns = {"time [s]": (1e5 + np.cumsum(steps)).astype(np.float32)} | {
        f"gyro_{a} [rad/s]": v for a, v in zip("xyz", gyro().T, strict=True)
    }
    pd.DataFrame(columns | {"time [s]": np.floor(columns["time [s]"] * 50) / 50}).to_csv(
        tmp_path / "coarse.csv", index=False
    )
    code, out, err = pyimu("characterize", "coarse.csv", "--out", "out")
    if even:
        assert code == 0 and "coarse stamps" in out
        return
    assert code == 2 and not (tmp_path / "out").exists()
    one_line(err, "coarse:", "time of the row before", "float32")


def test_a_foreign_log_goes_through_a_column_map(pyimu, undrawn, tmp_path):
    rows = "\n".join(
        f"{k * H},{a},{b},{c}" for k, (a, b, c) in enumerate(np.rint(gyro() / 1e-5).astype(int))
    )
    (tmp_path / "raw.csv").write_text(f"t,gx,gy,gz\n{rows}\n")
    (tmp_path / "map.toml").write_text(
        '[columns]\nt = "time [s]"\ngx = "gyro_x [count]"\ngy = "gyro_y [count]"\ngz = "gyro_z '
        '[count]"\n'
        '[scale]\ngyro = {value = 1e-5, unit = "rad/s"}\n'
    )
    assert pyimu("characterize", "raw.csv", "--columns", "map.toml", "--out", "out")[0] == 0
    data = json.loads((tmp_path / "out" / "report.json").read_text())
    assert data["part"]["gyro_x"]["N"]["value"] == pytest.approx(1e-3 * np.sqrt(H), rel=0.1)


# Logs with something wrong: the command ends with a line, or the report says so


def test_a_constant_channel_is_left_out_and_said_so(pyimu, tmp_path):
    values = gyro()
    values[:, 1] = 0.5
    code, out, _ = pyimu("characterize", write(tmp_path, gyro=values), "--out", "out")
    assert (
        code == 0
        and "gyro_y is left out: it is constant" in out
        and ("constant_channel", "gyro_y") in findings(tmp_path / "out")
    )
    code, _, err = pyimu("characterize", write(tmp_path, gyro=0 * values), "--out", "out")
    assert code == 2
    one_line(err, "rest", "no channel can be characterised", "constant")


def test_two_rates_in_one_file(pyimu, tmp_path):
    clock = H * np.arange(ROWS)
    clock[2000:] = clock[2000] + 4 * (clock[2000:] - clock[2000])
    code, _, err = pyimu("characterize", write(tmp_path, time=clock, gyro=gyro()), "--out", "out")
    assert code == 2 and not (tmp_path / "out").exists()
    one_line(err, "rest: two sample rates", "100 Hz", "25 Hz", "a log of its own")


def test_integers_that_wrapped(pyimu, tmp_path):
    values, step = gyro(), 1e-4
    smooth = np.cumsum(np.full(ROWS, 0.003)) + gyro(2)[:, 0]
    values[:, 2] = step * ((np.rint(smooth / step).astype(int) + 2**15) % 2**16 - 2**15)
    code, out, _ = pyimu("characterize", write(tmp_path, gyro=values), "--out", "out")
    assert (
        code == 0
        and "gyro_z is left out: its integers wrapped" in out
        and ("wrapped", "gyro_z") in findings(tmp_path / "out")
    )


def test_counts_without_a_scale(pyimu, tmp_path):
    (tmp_path / "counts.csv").write_text(
        "time [s],gyro_x [count],gyro_y [count],gyro_z [count]\n"
        + "".join(f"{k},{k},1,2\n" for k in range(9))
    )
    code, _, err = pyimu("characterize", "counts.csv")
    assert code == 2
    one_line(err, "counts.csv", "gyro_x", "[scale]")
    (tmp_path / "nothing.csv").write_text(
        "time [s],gyro_x,gyro_y,gyro_z\n" + "".join(f"{k},{k},1,2\n" for k in range(9))
    )
    one_line(pyimu("characterize", "nothing.csv")[2], "nothing.csv", "gyro_x", "unit")


def test_counts_that_claim_another_unit(pyimu, undrawn, tmp_path):
    """It is said first, and no part in a false unit is written."""
    log = write(tmp_path, gyro=np.rint(gyro() / 1e-5))
    code, out, _ = pyimu("characterize", log, "--exit-code", "--out", "out")
    assert code == 17 and out.startswith("rest holds raw counts: what follows is in a false unit")
    assert "hold whole numbers" in out and "[scale]" in out
    assert "no part: the log holds raw counts" in out.splitlines()[-1]
    assert ("counts", "gyro_x") in findings(tmp_path / "out")
    assert json.loads((tmp_path / "out" / "report.json").read_text())["in_counts"] == ["rest"]
    assert not (tmp_path / "out" / "part.toml").exists()


@pytest.mark.parametrize("rows", (3, 50))
def test_too_few_samples(pyimu, tmp_path, rows):
    code, _, err = pyimu("characterize", write(tmp_path, gyro=gyro()[:rows]), "--out", "out")
    assert code == 2
    one_line(err, "rest", f"{rows} samples", "at least 64")


def test_gaps_are_used_around_and_said(pyimu, tmp_path):
    clock = H * np.arange(ROWS)
    clock[1000:] += 5
    clock[2500:] += 1.5
    code, out, _ = pyimu("characterize", write(tmp_path, time=clock, gyro=gyro()), "--out", "out")
    assert code == 0 and "2 gaps. Nothing is bridged" in out and "all 3 segments" in out
    gaps = findings(tmp_path / "out")["gaps", "time"]
    assert gaps["count"] == 2 and gaps["detail"]["longest"] == pytest.approx(5 + H)
    assert "Nothing is bridged" in (tmp_path / "out" / "report.html").read_text()


@pytest.mark.parametrize(
    "words, said",
    (
        (("missing.csv",), ("missing.csv", "no such file")),
        (("rest.csv", "--level", "2"), ("level 2", "between 0 and 1")),
        (("rest.csv", "--out", "rest.csv"), ("rest.csv", "is a file")),
        (("rest.csv", "--columns", "none.toml"), ("none.toml",)),
        ((), ("LOG", "--help")),
    ),
)
def test_wrong_calls_end_in_one_line(pyimu, tmp_path, words, said):
    write(tmp_path)
    code, out, err = pyimu("characterize", *words)
    assert code == 2 and out == ""
    one_line(err, *said)


# A run that is broken off


def test_an_interrupt_leaves_earlier_results_and_nothing_else(tmp_path):
    """Ctrl-C while it reads or computes gives status 130 and one line.

    The folder and the folder of temporary files are as they were.
    """
    n = 400_000
    noise = 1e-3 * np.random.default_rng(1).standard_normal((n, 3))
    log = Recording.from_arrays("long", time=H * np.arange(n), gyro=noise).write(
        tmp_path / "long.parquet"
    )
    out, scratch = tmp_path / "out", tmp_path / "scratch"
    out.mkdir()
    scratch.mkdir()
    (out / "report.html").write_text("earlier")
    run = subprocess.Popen(
        [sys.executable, "-m", "pyimu", "characterize", str(log), "--out", str(out)],
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "TMPDIR": str(scratch), "PYTHONUNBUFFERED": "1"},
    )
    # It is at work once it has opened its temporary files, which have no names. A file with a name
    # is that by which Python tries the folder before; an interrupt just then would leave it there.
    while run.poll() is None and not holds_files_of(run.pid, scratch):
        time.sleep(0.02)
    run.send_signal(signal.SIGINT)
    _, err = run.communicate()
    assert run.returncode == 130 and "interrupted" in err and err.count("\n") == 1
    assert [p.name for p in out.iterdir()] == ["report.html"] and (
        out / "report.html"
    ).read_text() == "earlier"
    assert not [p for p in scratch.iterdir() if not p.name.startswith(f"{PREFIX}locks")]


def holds_files_of(pid, folder):
    """Whether a process has files open that were in the folder and have no name any more."""
    try:
        opened = [os.readlink(f"/proc/{pid}/fd/{fd}") for fd in os.listdir(f"/proc/{pid}/fd")]
    except OSError:
        return False
    return any(name.startswith(str(folder)) and name.endswith(" (deleted)") for name in opened)


def test_a_report_that_cannot_be_drawn_costs_no_earlier_one(pyimu, undrawn, tmp_path, monkeypatch):
    log = write(tmp_path)
    assert pyimu("characterize", log, "--out", "out")[0] == 0
    before = {p.name: p.read_bytes() for p in (tmp_path / "out").iterdir()}

    def fail(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("pyimu.characterization.result.save_part", fail)
    assert pyimu("characterize", log, "--out", "out")[0] == 130
    assert {p.name: p.read_bytes() for p in (tmp_path / "out").iterdir()} == before
