"""The command line: good runs deliver what they say, bad input ends in one line that helps, and
costs no earlier result.
"""

import ctypes
import json
import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import typer
from fmu_toy import Unit
from places import same_path

from pyimu import Recording, __version__, part
from pyimu.cli import app
from pyimu.cli.choices import complete_part
from pyimu.cli.logs import EXIT_CODES
from pyimu.cli.memory import keep_freed
from pyimu.fmu import simulate
from pyimu.identification.verdict.verdict import VERDICTS

RATE = 50.0
ROWS = 3000
SCALE = 0.03
NOISE = 1e-3
"""rad/s; of a gyro sample."""

PART = f"""\
name = "plain"
sample_rate = {{value = {RATE}, unit = "Hz"}}

[gyro.angle_random_walk]
N = {{value = {NOISE / RATE**0.5!r}, unit = "rad/sqrt(s)"}}
"""

FMUS = ["ImuSensor.fmi2.fmu", "ImuSensor.fmi3.fmu"]


# Logs, parts, and running


def motion(seed):
    """A reference rate (n, 3) rad/s in which each axis turns at its own frequency, and white noise
    of a gyro (n, 3).
    """
    time = np.arange(ROWS) / RATE
    rate = np.column_stack([0.5 * np.sin(2 * np.pi * f * time + seed) for f in (0.11, 0.17, 0.23)])
    return time, rate, NOISE * np.random.default_rng(seed).standard_normal((ROWS, 3))


def write_log(folder, name, seed=2, moves=True, reference=True):
    time, rate, noise = motion(seed)
    gyro = (1 + SCALE) * rate * moves + noise
    log = Recording.from_arrays(
        name=name, time=time, gyro=gyro, ref_rate=rate if reference else None
    )
    return log.write(folder / f"{name}.csv")


@pytest.fixture(scope="module")
def logs(tmp_path_factory):
    """A folder with good logs (rover, second), one at rest, one that moves without reference, and a
    part.
    """
    folder = tmp_path_factory.mktemp("logs")
    write_log(folder, "rover")
    write_log(folder, "second", seed=3)
    write_log(folder, "rest", moves=False, reference=False)
    write_log(folder, "moving", reference=False)
    (folder / "plain.toml").write_text(PART)
    return folder


@pytest.fixture
def here(logs, tmp_path, monkeypatch):
    """The folder that a test runs in, with earlier results in ``out`` and the logs under their
    names.
    """
    for file in logs.iterdir():
        os.link(file, tmp_path / file.name)  # a symbolic one needs a right on Windows
    results = tmp_path / "out"
    (results / "before").mkdir(parents=True)
    for name in ("report.html", "report.json", "model.toml", "before/ImuSensor.fmi2.fmu", *FMUS):
        (results / name).write_bytes(b"earlier " + name.encode())
    monkeypatch.chdir(tmp_path)
    return tmp_path


def in_a_process(*words):
    command = [sys.executable, "-m", "pyimu", *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)


def contents(folder):
    return {p.relative_to(folder): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def assert_one_line(text, *words):
    assert text.startswith("pyimu: ") and text.endswith("\n") and text.count("\n") == 1, text
    missing = [w for w in words if w not in text]
    assert not missing, f"{missing} not in: {text}"


def refused(pyimu, command, *words):
    """The command ends in one line on stderr that holds the words, exit status 2, and leaves
    ``out`` as it was.
    """
    before = contents(Path("out"))
    code, out, err = pyimu(*command)
    assert (code, out) == (2, ""), (code, out, err)
    assert_one_line(err, *words)
    assert contents(Path("out")) == before
    assert {p.name for p in Path("out").iterdir()} == {
        "before",
        "report.html",
        "report.json",
        "model.toml",
        *FMUS,
    }


# Bad logs


def cells(change):
    """A rewrite of a CSV's rows of cells."""
    return lambda lines: [",".join(row) for row in change([line.split(",") for line in lines])]


def header(old, new):
    return lambda lines: [lines[0].replace(old, new), *lines[1:]]


def with_cell(row, column, text):
    """A rewrite that puts ``text`` where a spreadsheet says ``row`` and ``column``, both from 1."""

    def change(rows):
        rows[row - 1][column - 1] = text
        return rows

    return cells(change)


BAD_LOGS = {
    "gyro_y is missing": (
        cells(lambda rows: [r[:2] + r[3:] for r in rows]),
        ["gyro_y is missing", "gyro_x, gyro_y, gyro_z"],
    ),
    "no time": (cells(lambda rows: [r[1:] for r in rows]), ["no 'time [s]' column"]),
    "no gyro, no accel": (header("gyro_", "gy"), ["neither gyro_x", "accel_x"]),
    "misspelt column": (header("gyro_z", "gyroz"), ["'gyroz'", "did you mean gyro_z"]),
    "unknown unit": (
        header("gyro_x [rad/s]", "gyro_x [rad/z]"),
        ["column gyro_x", "'rad/z' is not a unit"],
    ),
    "wrong dimension": (
        header("gyro_x [rad/s]", "gyro_x [m]"),
        ["column gyro_x", "'m'", "expected a unit like 'rad/s'"],
    ),
    "no unit": (
        header("gyro_x [rad/s]", "gyro_x"),
        ["column gyro_x has no unit", "gyro_x [...]", "rad/s or deg/s", "pyimu inspect bad.csv"],
    ),
    "text in a number": (
        with_cell(11, 2, "about 3"),
        ["row 11", "column gyro_x", "'about 3' is not a number"],
    ),
    "time runs backwards": (
        lambda lines: [*lines[:10], lines[11], lines[10], *lines[12:]],
        ["row 12", "time runs backwards", "0.18 s follows 0.2 s"],
    ),
    "time is missing": (with_cell(8, 1, ""), ["row 8", "time is missing"]),
    "a row too long": (
        lambda lines: [line + ",1" * (i % 20 == 5) for i, line in enumerate(lines)],
        ["row 6", "8 cells, expected 7"],
    ),
    "too short": (lambda lines: lines[:30], ["too short", "29 rows, at least 64"]),
    "no rows": (lambda lines: lines[:1], ["rows of data, this one has 0"]),
    "empty file": (lambda lines: [], ["is empty"]),
}


@pytest.mark.parametrize("case", BAD_LOGS)
def test_bad_log(here, pyimu, case):
    change, words = BAD_LOGS[case]
    (here / "bad.csv").write_text(
        "\n".join([*change((here / "rover.csv").read_text().splitlines()), ""])
    )
    refused(pyimu, ["close", "bad.csv", "--part", "plain.toml", "--out", "out"], "bad", *words)


BAD_COMMANDS = {
    "missing file": (["nothing.csv"], ["nothing.csv", "no such file"]),
    "other suffix": (["plain.toml"], ["plain.toml", "must end in .csv, .csv.gz", ".parquet"]),
    "no reference": (
        ["moving.csv"],
        ["moving", "no reference", "ref_rate, ref_q, ref_heading, ref_force", "must stand still"],
    ),
    "reference file without one": (
        ["rover.csv", "--reference", "moving.csv"],
        ["moving.csv", "no reference in it", "ref_north and ref_east"],
    ),
    "more references than logs": (
        ["rover.csv", "--reference", "rover.csv", "--reference", "rover.csv"],
        ["2 references for 1 logs", "in order"],
    ),
    "same log twice": (["rover.csv", "rover.csv"], ["rover", "given twice"]),
    "fitted and held out": (["rover.csv", "--holdout", "rover.csv"], ["rover", "given twice"]),
    "missing holdout": (["rover.csv", "--holdout", "nothing.csv"], ["nothing.csv", "no such file"]),
    "unknown part": (["rover.csv", "--part", "imt31"], ["imt31", "imt30"]),
    "missing part file": (["rover.csv", "--part", "other.toml"], ["other.toml", "no such file"]),
    "latitude": (["rover.csv", "--latitude", "100"], ["--latitude 100", "-90", "90"]),
    "latitude in words": (["rover.csv", "--latitude", "north"], ["--latitude", "number"]),
    "missing columns": (["rover.csv", "--columns", "map.toml"], ["map.toml", "no such file"]),
    "unknown option": (["rover.csv", "--hold", "x.csv"], ["--hold", "pyimu close --help"]),
    "no log": ([], ["LOG", "pyimu close --help"]),
}


@pytest.mark.parametrize("case", BAD_COMMANDS)
def test_bad_close(here, pyimu, case):
    given, words = BAD_COMMANDS[case]
    refused(pyimu, ["close", *given, "--out", "out"], *words)


def test_columns_of_another_log(here, pyimu):
    Path("map.toml").write_text('[columns]\n"GyrX" = "gyro_x [deg/s]"\n')
    refused(
        pyimu,
        ["close", "rover.csv", "--columns", "map.toml", "--out", "out"],
        "map.toml",
        "GyrX",
        "no such column",
    )


# Bad parts


BAD_PARTS = {
    "effect": (
        PART.replace("random", "randm"),
        ["gyro.angle_randm_walk", "unknown effect", "mean angle_random_walk"],
    ),
    "parameter": (
        PART.replace("N =", "n ="),
        ["gyro.angle_random_walk.n", "unknown parameter", "mean N"],
    ),
    "unit": (
        PART.replace("rad/sqrt(s)", "rad/sqrt(z)"),
        ["gyro.angle_random_walk.N.unit", "not a unit", "rad/sqrt(s)"],
    ),
    "dimension": (
        PART.replace("rad/sqrt(s)", "m/s"),
        ["gyro.angle_random_walk.N.unit", "'m/s'", "like rad/sqrt(s)"],
    ),
    "syntax": (PART + "[gyro.scale_factor\n", ["TOML", "line 6"]),
    "no rate": (PART.replace("sample_rate", "#"), ["sample_rate", "is missing", 'unit = "Hz"']),
}


@pytest.mark.parametrize("case", BAD_PARTS)
@pytest.mark.parametrize(
    "command",
    (["close", "rover.csv", "--part", "bad.toml"], ["build", "bad.toml"]),
    ids=("close", "build"),
)
def test_bad_part(here, pyimu, case, command):
    text, words = BAD_PARTS[case]
    Path("bad.toml").write_text(text)
    refused(pyimu, [*command, "--out", "out"], "bad.toml", *words)


def test_log_at_rest_cannot_give_what_needs_motion(here, pyimu):
    Path("asks.toml").write_text(PART + '\n[gyro.scale_factor]\ns = "estimate"\n')
    refused(
        pyimu,
        ["close", "rest.csv", "--part", "asks.toml", "--out", "out"],
        "rest",
        "no motion",
        "gyro.scale_factor.s",
        "give a log that moves",
    )


# Bad places and tools


COMMANDS = (["close", "rover.csv", "--part", "plain.toml"], ["build", "imt30"], ["demo"])


@pytest.mark.parametrize("command", COMMANDS, ids=lambda c: c[0])
@pytest.mark.parametrize("place", ("out/report.html", "out/report.html/deeper"))
def test_out_is_a_file(here, pyimu, command, place):
    refused(pyimu, [*command, "--out", place], place, "report.html is a file", "--out")


def test_a_terminal_that_lacks_a_letter_shows_its_number(tmp_path):
    """As consoles of Windows do; the name of a folder may have any."""
    done = subprocess.run(
        [sys.executable, "-m", "pyimu", "modelica", "imt30", "--out", "\u4e2d"],
        env=same_path() | {"PYTHONIOENCODING": "cp437"},
        cwd=tmp_path,
        capture_output=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, b"") and done.stdout.startswith(b"\\u4e2d")


def test_build_without_a_compiler(here, pyimu, monkeypatch):
    monkeypatch.setenv("CC", "no-such-compiler")
    words = ("no C compiler", "'no-such-compiler'", "CC", "pip install ziglang")
    refused(pyimu, ["build", "imt30", "--out", "out"], *words)


def test_build_with_half_a_quotation(here, pyimu, monkeypatch):
    monkeypatch.setenv("CC", 'cc "-O2')
    refused(pyimu, ["build", "imt30", "--out", "out"], "environment variable CC", 'cc "-O2')


def test_build_without_room_for_temporary_files(here, pyimu, monkeypatch, tmp_path):
    (tmp_path / "nowhere").write_text("no folder")
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "nowhere"))
    monkeypatch.setenv("PYIMU_CACHE", "")
    refused(pyimu, ["build", "imt30", "--out", "out"], "nowhere", "TMPDIR names another folder")


def test_close_without_a_compiler_leaves_the_units_out_and_says_so(here, pyimu, monkeypatch):
    monkeypatch.setenv("CC", "no-such-compiler")
    status, said, _ = pyimu(*COMMANDS[0], "--out", "new")
    assert status == 0 and "the FMUs are left out: no C compiler" in said
    assert {p.name for p in Path("new").iterdir()} == {"report.html", "report.json", "model.toml"}
    assert json.loads(Path("new/report.json").read_text())["fmus"] == []
    assert "the FMUs are left out: no C compiler" in Path("new/report.html").read_text()


@pytest.mark.parametrize("command", COMMANDS[:2], ids=lambda c: c[0])
def test_compiler_that_fails(here, pyimu, monkeypatch, command):
    """Found out only after all the work: the results of an earlier run must still be there."""
    monkeypatch.setenv("CC", "false")
    refused(pyimu, [*command, "--out", "out"], "C compiler 'false' could not make")


BAD_BUILDS = {
    "part": (["imt31"], ["imt31", "imt30"]),
    "fmu": (["imt30", "--fmu", "sensor,kalman"], ["--fmu kalman", "sensor, ukf"]),
    "fmi": (["imt30", "--fmi", "2,4"], ["--fmi", "4", "2, 3"]),
    "platform": (["imt30", "--platform", "beos"], ["'beos'", "host, all, x86_64-linux"]),
    "nothing": ([], ["part", "pyimu build --help"]),
}


@pytest.mark.parametrize("case", BAD_BUILDS)
def test_bad_build(here, pyimu, case):
    given, words = BAD_BUILDS[case]
    refused(pyimu, ["build", *given, "--out", "out"], *words)


def test_unknown_command(here, pyimu):
    refused(pyimu, ["clos", "rover.csv"], "'clos'", "close")


def test_bad_input_in_a_process(here):
    """What no test of ``main`` shows: nothing else is printed around it, at import or at exit."""
    done = in_a_process("close", "nothing.csv", "--out", "out")
    assert (done.returncode, done.stdout) == (2, "")
    assert_one_line(done.stderr, "nothing.csv", "no such file")


# Good runs


@pytest.fixture(scope="module")
def closed(logs, tmp_path_factory):
    """``pyimu close`` of the log whose scale factor nobody declared, in a process of its own: what
    it said, its folder.
    """
    out = tmp_path_factory.mktemp("closed") / "new" / "folder"
    return in_a_process(
        "close", logs / "rover.csv", "--part", logs / "plain.toml", "--out", out
    ), out


def test_close_delivers(closed):
    done, out = closed
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("verdict: named (gyro scale_factor)")
    assert done.stdout.endswith(f"report: {out / 'report.html'}\n")
    made = {p.as_posix() for p in contents(out)}
    assert made == {
        "report.html",
        "report.json",
        "model.toml",
        *FMUS,
        *(f"before/{f}" for f in FMUS),
    }


def listed(report, names):
    return {name: type(report[name]) for name in names}


def test_report_keeps_its_contract(closed):
    report = json.loads((closed[1] / "report.json").read_text())
    assert report["verdict"] == "named" and report["unexplained"] is None
    assert listed(
        report, ("added", "changed", "observability", "quality", "recordings", "fmus")
    ) == dict.fromkeys(("added", "changed", "observability", "quality", "recordings", "fmus"), list)
    assert report["model"] == "model.toml" and set(FMUS) <= set(report["fmus"])
    (added,) = report["added"]
    assert (added["sensor"], added["effect"], added["alternatives"]) == ("gyro", "scale_factor", [])
    assert listed(added["evidence"], ("gain", "gate")) == {"gain": float, "gate": float}
    assert added["evidence"]["gain"] > added["evidence"]["gate"]
    s = added["parameters"]["s"]
    assert s["unit"] == "1" and len(s["value"]) == len(s["std"]) == 3
    for one in report["observability"]:
        assert {"sensor", "effect", "smallest_visible", "unit", "inseparable_from"} <= one.keys()
    (log,) = report["recordings"]
    assert (log["file"], log["samples"], log["held_out"]) == ("rover.csv", ROWS, round(0.3 * ROWS))
    assert {"before", "after", "floor"} <= log["rate"].keys()


def test_report_gives_the_error_before_after_and_floor(closed):
    error = json.loads((closed[1] / "report.json").read_text())["error"]
    units = {"rate": "rad/s", "angle": "rad"}
    for name, unit in units.items():
        e = error[name]
        assert e["unit"] == unit and [
            len(e["per_axis"][when]) for when in ("before", "after", "floor")
        ] == [3, 3, 3]
        assert e["after"] < 0.5 * e["before"]
    assert error["rate"]["after"] == pytest.approx(NOISE, rel=0.05) and error["rate"][
        "floor"
    ] == pytest.approx(NOISE, rel=0.05)
    assert error["angle"]["window"] > 0
    likelihood = error["log_likelihood"]
    assert likelihood["unit"] == "nat/sample" and likelihood["after"] > likelihood["before"]
    assert error["specific_force"] is None and error["attitude"] is None


def test_report_needs_nothing_from_elsewhere(closed):
    page = (closed[1] / "report.html").read_text()
    assert page.lower().startswith("<!doctype html>") and "scale factor" in page
    assert 'src="http' not in page and 'href="http' not in page


def six_sigma():
    """Of a scale factor: white noise of ``NOISE`` over the sine of amplitude 0.5 in the fitted 70 %
    of the rows.
    """
    return 6 * NOISE / (0.5 * np.sqrt(0.7 * ROWS / 2))


def test_model_holds_the_scale_factor(closed):
    model = part(closed[1] / "model.toml")
    np.testing.assert_allclose(model.gyro.values["scale_factor"]["s"], SCALE, atol=six_sigma())
    np.testing.assert_array_equal(
        model.gyro.values["angle_random_walk"]["N"], np.full(3, NOISE / RATE**0.5)
    )
    assert model.sample_rate == RATE and not model.estimate


@pytest.mark.parametrize("name", FMUS)
def test_fmus_show_the_scale_factor(closed, name):
    """Noise off, output over input is 1 + s in the new units, and 1 in those of the part as it was
    declared.
    """
    silent = {f"gyro_error.angle_random_walk.N[{i}]": 0.0 for i in (1, 2, 3)}
    inputs = np.column_stack([motion(0)[1][:50], np.zeros((50, 3)), np.full(50, 25.0)])
    for folder, ratio in (
        ("", 1 + part(closed[1] / "model.toml").gyro.values["scale_factor"]["s"]),
        ("before", np.ones(3)),
    ):
        y = simulate(closed[1] / folder / name, inputs, sample_period=1 / RATE, start_values=silent)
        np.testing.assert_allclose(y[1:, :3], ratio * inputs[:, :3], rtol=1e-14)


def test_fmus_draw_noise_as_declared(closed):
    """White noise of a sample has the standard deviation N / sqrt(h); of 3 x 2000 its estimate is
    good to 4/sqrt(12000).
    """
    with Unit(closed[1] / FMUS[0]).start() as unit:
        y = unit.run(np.zeros((2000, 7)), period=1 / RATE)[:, :3]
    assert y.std() == pytest.approx(NOISE, rel=4 / np.sqrt(2 * y.size))


def test_holdout(here, pyimu):
    code, out, err = pyimu(
        "close", "rover.csv", "--part", "plain.toml", "--holdout", "second.csv", "--out", "out"
    )
    assert (code, err) == (0, "") and "rate residual on the logs held out" in out
    report = json.loads(Path("out/report.json").read_text())
    assert report["error"]["data"] == "holdout"
    assert [(r["file"], r["rate"] is None) for r in report["recordings"]] == [
        ("rover.csv", True),
        ("second.csv", False),
    ]
    assert contents(Path("out"))[Path("before/ImuSensor.fmi2.fmu")][:2] == b"PK"


def test_columns_and_latitude(here, pyimu, uncompiled):
    """A log with other names, units and axes (forward, right, down) gives the same scale factor."""
    table = np.genfromtxt("rover.csv", delimiter=",", skip_header=1)
    turned = table * [1e3, *np.tile(np.rad2deg([1, -1, -1]), 2)]
    np.savetxt(
        "foreign.csv",
        turned,
        delimiter=",",
        header="ms,GyrX,GyrY,GyrZ,RefX,RefY,RefZ",
        comments="",
        fmt="%.12g",
    )
    names = {"ms": "time [ms]"} | {
        f"{a}{axis}": f"{b}_{axis.lower()} [deg/s]"
        for a, b in (("Gyr", "gyro"), ("Ref", "ref_rate"))
        for axis in "XYZ"
    }
    Path("map.toml").write_text(
        "[columns]\n"
        + "".join(f'{k} = "{v}"\n' for k, v in names.items())
        + '[frame]\nbody = "frd"\n'
    )
    options = ["--part", "plain.toml", "--columns", "map.toml", "--latitude", "52.2"]
    code, out, err = pyimu("close", "foreign.csv", *options, "--out", "out", "--quiet")
    assert (code, out, err) == (0, "", "")
    np.testing.assert_allclose(
        part("out/model.toml").gyro.values["scale_factor"]["s"], SCALE, atol=six_sigma()
    )


def test_log_at_rest_is_undecidable(here, pyimu, uncompiled):
    code, out, err = pyimu("close", "rest.csv", "--out", "out", "--json", "--exit-code")
    assert (code, err) == (EXIT_CODES["undecidable"], "")
    report = json.loads(out)
    assert report == json.loads(Path("out/report.json").read_text())
    assert (
        report["verdict"] == "undecidable"
        and "no motion" in report["reason"]
        and report["added"] == []
    )
    found = part("out/model.toml").gyro.values["angle_random_walk"]["N"]
    # Rows of three axes: the standard error of a standard deviation is 1 / sqrt(2 n) of it.
    np.testing.assert_allclose(found, NOISE / RATE**0.5, rtol=5 / np.sqrt(2 * 0.7 * ROWS))


def test_every_verdict_has_an_exit_status_of_its_own(pyimu):
    """None is that of bad input, of an error inside or of a run broken off; the help names all."""
    assert set(EXIT_CODES) == set(VERDICTS) and EXIT_CODES["clean"] == 0
    codes = list(EXIT_CODES.values())
    assert len(set(codes)) == len(codes) and not {1, 2, 130} & set(codes)
    help_text = " ".join(pyimu("close", "--help")[1].split())
    assert all(f"{name} {code}" in help_text for name, code in EXIT_CODES.items())


def test_json_beside_quiet_is_refused_and_parts_are_data(pyimu):
    code, out, _ = pyimu("parts", "mpu6050", "--json")
    found = json.loads(out)
    N = found["coefficients"]["gyro.angle_random_walk.N"]
    np.testing.assert_array_equal(N["value"], part("mpu6050").gyro.values["angle_random_walk"]["N"])
    assert code == 0 and N["unit"] == "rad/sqrt(s)" and "page 12" in N["source"]
    code, out, err = pyimu("characterize", "x.csv", "--json", "--quiet")
    assert (code, out) == (2, "") and "--json beside --quiet" in err


def commands():
    """Every command by its name."""
    return sorted(typer.main.get_command(app).commands.items())


@pytest.mark.parametrize(("name", "command"), commands(), ids=lambda v: str(v)[:20])
def test_every_command_is_data_or_silent_but_not_both(pyimu, name, command):
    options = {o for p in command.params for o in p.opts}
    assert {"--json", "--quiet"} <= options
    needed = {"plan": ["mpu6050", "--for", "lag"], "export": ["mpu6050", "--to", "px4"]}
    taken = ["x"] * any(p.required for p in command.params)
    code, out, err = pyimu(name, *needed.get(name, taken), "--json", "--quiet")
    assert (code, out) == (2, "") and "--json beside --quiet" in err


def test_a_template_of_a_part_and_a_modelica_class_are_data_or_silent(here, pyimu):
    for words, file in (
        (("parts", "--new", "mine"), "mine.toml"),
        (("modelica", "imt30", "--out", "mo"), str(Path("mo", "Imt30.mo"))),
    ):
        code, out, err = pyimu(*words, "--json")
        assert (code, err, json.loads(out)["files"]) == (0, "", [file]) and Path(file).is_file()
        Path(file).unlink()
        assert pyimu(*words, "--quiet") == (0, "", "") and Path(file).is_file()
    assert pyimu("parts", "--quiet") == (0, "", "")
    assert pyimu("parts", "none", "--quiet")[0] == 2


@pytest.mark.parametrize("option", ["--json", "--quiet"])
def test_the_demo_is_data_or_silent(here, pyimu, monkeypatch, option):
    """What is printed of it, not the loop itself, which takes half a minute."""

    def done(out, say):
        (Path(out) / "report.json").write_text('{"verdict": "named"}\n')
        return SimpleNamespace(report=lambda: pytest.fail("printed as text"))

    monkeypatch.setattr("pyimu.rover.demo.run_demo", done)
    code, out, err = pyimu("demo", "--out", "out", option)
    assert (code, err) == (0, "")
    assert out == "" if option == "--quiet" else json.loads(out) == {"verdict": "named"}


def test_the_shell_completes_names_of_parts():
    assert complete_part("icm4") == ["icm42670", "icm42688", "icm45686"]
    done = subprocess.run(
        [sys.executable, "-m", "pyimu"],
        env={**os.environ, "_PYIMU_COMPLETE": "complete_bash"}
        | {"COMP_WORDS": "pyimu export mti", "COMP_CWORD": "2"},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.stdout.split() == ["mti3", "mti300"]


def test_build_lists_what_it_made(here, pyimu, uncompiled):
    code, out, err = pyimu("build", "imt30", "--out", "fmus")
    assert (code, err) == (0, "")
    assert out.split() == [
        f"fmus/{n}.{form}.fmu"
        for n in ("ImuSensor", "AttitudeUkf")
        for form in ("fmi2", "fmi3", "block")
    ]
    assert all(Path(line).read_bytes()[:2] == b"PK" for line in out.split())


def test_build_one(here, pyimu):
    code, out, _ = pyimu("build", "plain.toml", "--fmu", "sensor", "--fmi", "3", "--out", "fmus")
    assert (code, out.split()) == (0, ["fmus/ImuSensor.fmi3.fmu"])
    assert [p.name for p in Path("fmus").iterdir()] == ["ImuSensor.fmi3.fmu"]


# Help


@pytest.mark.parametrize(
    "command",
    ([], ["demo"], ["close"], ["rover"], ["build"], ["parts"], ["modelica"], ["derive"]),
    ids=lambda c: " ".join(c) or "pyimu",
)
def test_help_opens_with_an_example(pyimu, command):
    code, out, err = pyimu(*command, "--help")
    paragraphs = [p.strip() for p in out.split("\n\n")]
    assert (code, err) == (0, "") and paragraphs[0].startswith("Usage: pyimu")
    assert paragraphs[1].startswith(" ".join(["Example: pyimu", *command]))


def test_no_command_shows_the_help(pyimu):
    assert pyimu() == pyimu("--help")


def test_help_is_quick():
    """Nothing heavy is loaded to show the help: it would take seconds."""
    code = (
        "import sys, pyimu.cli; sys.argv = ['pyimu', '--help']\ntry: pyimu.cli.main()\nexcept "
        "SystemExit: pass\n"
        "print(*{'casadi', 'scipy', 'matplotlib', 'numba', 'fmpy'} & set(sys.modules), "
        "file=sys.stderr)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=False
    )
    assert "Example" in done.stdout and done.stderr == "\n"


SIGNAL = ("scipy.signal", "scipy.stats")
"""The first imports the second; together they take a quarter of a second."""


@pytest.mark.parametrize(
    "module, without",
    [
        ("pyimu", {"numpy", "scipy", "casadi", "matplotlib", "numba", "pyarrow", "fmpy"}),
        ("pyimu.attitude", {"matplotlib", "fmpy", "control", "numba", *SIGNAL, "scipy.optimize"}),
        ("pyimu.recording.log", {"casadi", "numba", "matplotlib", "fmpy", "control", *SIGNAL}),
        ("pyimu.characterization.run", {"fmpy", "control", *SIGNAL}),
        ("pyimu.ins", {"fmpy", "control", *SIGNAL}),
        ("pyimu.identification.close", {"control"}),
    ],
)
def test_what_an_import_does_not_load(module, without):
    """What takes tenths of a second each is loaded by who uses it."""
    code = f"import sys, {module}; print(*set(sys.modules) & {without!r})"
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=False
    )
    assert (done.stdout, done.stderr) == ("\n", "")


@pytest.mark.parametrize("command", ["attitude", "characterize"])
def test_what_a_log_at_rest_does_not_load(command, tmp_path):
    """Nor is it loaded where it would be used: not for a rest, a page or a table of results."""
    write_rest(tmp_path / "rest.csv")
    names = {*SIGNAL, "pandas", "rich", "fmpy", "control"}
    code = (
        "import sys, pyimu.cli\ntry: pyimu.cli.main()\nexcept SystemExit: pass\n"
        f"print(*set(sys.modules) & {names!r})"
    )
    arguments = (command, "rest.csv", "--out", "out", "--quiet")
    done = subprocess.run(
        [sys.executable, "-c", code, *arguments],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert (done.stdout, done.stderr) == ("\n", "") and (tmp_path / "out/report.html").is_file()


def write_rest(path):
    """A log of two minutes at rest, ten samples a second."""
    rng, n = np.random.default_rng(0), 1200
    rate, force = 1e-3 * rng.standard_normal((n, 3)), 1e-2 * rng.standard_normal((n, 3))
    force += [0.0, 0.0, 9.81]
    Recording.from_arrays(time=0.1 * np.arange(n), gyro=rate, accel=force).write(path)


@pytest.mark.parametrize("library", [lambda name: object(), lambda name: ctypes.c_int("no path")])
def test_a_c_library_that_keeps_memory_in_its_own_way_is_left_alone(library, monkeypatch):
    """Of musl and macOS there is no such function, on Windows no such library."""
    asked = []
    monkeypatch.setattr(ctypes, "CDLL", lambda name: asked.append(name) or library(name))
    keep_freed()
    assert asked == [None]


def test_version():
    done = in_a_process("--version")
    assert (done.returncode, done.stdout, done.stderr) == (0, f"{__version__}\n", "")


def test_export_and_build_are_data_or_silent(pyimu, tmp_path):
    code, out, _ = pyimu("export", "adis16500", "--to", "kalibr,px4", "--json")
    files = json.loads(out)["files"]
    assert code == 0 and [f["target"] for f in files] == ["kalibr", "px4"]
    assert all((tmp_path / f["file"]).is_file() and "accelerometer" in f["missing"] for f in files)
    assert pyimu("export", "mpu6050", "--to", "ros2", "--quiet") == (0, "", "")
    built = ("build", "imt30", "--fmu", "sensor", "--fmi", "2", "--out", "fmus")
    code, out, _ = pyimu(*built, "--json")
    assert code == 0 and all((tmp_path / f).is_file() for f in json.loads(out)["files"])
    assert pyimu(*built, "--quiet") == (0, "", "")
    for command in (built, ("export", "mpu6050", "--to", "px4"), ("inspect", "log.csv")):
        assert pyimu(*command, "--quiet", "--json")[0] == 2


def test_inspect_s_status_says_whether_the_log_can_be_read(pyimu, tmp_path):
    rows = "".join(f"{0.01 * k:.2f},0.1,0.2,0.{k % 7}\n" for k in range(200))
    names = [f"gyro_{a} [rad/s]" for a in "xyz"]
    (tmp_path / "good.csv").write_text(f"time [s],{','.join(names)}\n{rows}")
    (tmp_path / "bare.csv").write_text(f"a,b,c,d\n{rows}")
    assert pyimu("inspect", "good.csv", "--quiet") == (0, "", "")
    assert pyimu("inspect", "bare.csv", "--quiet", "--write-map", "map.toml") == (1, "", "")
    assert (tmp_path / "map.toml").is_file()
    code, out, _ = pyimu("inspect", "bare.csv", "--json")
    assert code == 1 and json.loads(out)["problem"]
    assert pyimu("inspect", "bare.csv")[0] == 1 and pyimu("inspect", "none.csv")[0] == 2


def test_inspect_of_a_log_whose_columns_are_guessed_ends_with_1(pyimu, tmp_path):
    """Its samples were read by the guess; no other command reads it before a map says so."""
    rows = "".join(f"{0.01 * k:.2f},0.1,0.2,0.{k % 7},0.1,0.{k % 3},9.81\n" for k in range(200))
    (tmp_path / "guess.csv").write_text(f"t,gx,gy,gz,ax,ay,az\n{rows}")
    code, out, _ = pyimu("inspect", "guess.csv", "--json")
    said = json.loads(out)
    assert (code, said["columns_known_by"], said["problem"]) == (1, "guessed", None)
    assert said["open_questions"] == ["gyro"] and pyimu("attitude", "guess.csv")[0] == 2


def test_several_files_for_one_log_are_told_the_map(pyimu, tmp_path):
    for name in ("Gyroscope.csv", "Accelerometer.csv"):
        (tmp_path / name).write_text("time,x,y,z\n")
    code, out, err = pyimu("attitude", "Gyroscope.csv", "Accelerometer.csv")
    assert (code, out) == (2, "") and err.count("\n") == 1
    assert "pyimu inspect FILE FILE --write-map map.toml" in err and "--columns" in err
    assert "inspect" not in pyimu("attitude", "Gyroscope.csv", "nothing")[2]


def test_an_option_without_its_value_says_what_it_is_for(pyimu):
    code, out, err = pyimu("parts", "--new")
    assert (code, out) == (2, "") and err.count("\n") == 1
    assert (
        "Option '--new' requires an argument. Write pyimu parts ... --new and its value: Wri" in err
    )
