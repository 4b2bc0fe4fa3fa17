"""The page on attitude: its tables are the definitions', its code runs, its sample is printed, and
what it says is said stands in the package.
"""

import re

import attitude_page
import numpy as np
import pyarrow.parquet as parquet
import pytest
from places import CHECKOUT, measured

from pyimu import Recording, attitude
from pyimu.attitude.filter.variables import SETTINGS
from pyimu.attitude.report import words

PAGE = CHECKOUT / "docs" / "attitude.md"
TEXT = PAGE.read_text(encoding="utf-8")
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```", re.MULTILINE | re.DOTALL)
DIGITS = re.compile(r"\d+(?:\.\d+)?")


def test_the_tables_are_fresh():
    assert attitude_page.filled(TEXT) == TEXT, "make generate"
    assert attitude_page.filled(TEXT.replace("| `slip_std` |", "| `slip` |")) == TEXT


@pytest.mark.parametrize("name", sorted({v.name.partition("[")[0] for v in SETTINGS}))
def test_every_setting_is_in_the_table(name):
    assert re.search(rf"^\| `{name}(\[1\.\.6\])?` \|", TEXT, re.MULTILINE)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder with the files that the page names: a drive with a field, a part, a calibration."""
    monkeypatch.chdir(tmp_path)
    rng, time = np.random.default_rng(0), 0.01 * np.arange(1500)
    rate = np.where(time < 7, 0.0, 0.3)
    yaw = np.cumsum(rate) * 0.01
    gyro = np.column_stack([0 * rate, 0 * rate, rate]) + [0.01, -0.02, 0.015]
    field = np.column_stack([20e-6 * np.sin(yaw), 20e-6 * np.cos(yaw), -40e-6 + 0 * yaw])
    log = Recording.from_arrays(
        time=time,
        gyro=gyro + rng.normal(0, 2e-3, gyro.shape),
        accel=rng.normal(0, 0.02, gyro.shape) + [0, 0, 9.81],
        mag=field,
    )
    log.write(tmp_path / "drive.csv")
    (tmp_path / "model.toml").write_text(
        'name = "mine"\nsample_rate = {value = 100.0, unit = "Hz"}\n'
        '[gyro.angle_random_walk]\nN = {value = 3.0, unit = "deg/sqrt(h)"}\n'
    )
    (tmp_path / "magnetometer.toml").write_text(
        'bias = {value = [0.0, 0.0, 0.0], unit = "uT"}\nmatrix = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]'
    )
    return tmp_path


def test_its_python_runs(folder, capsys):
    (code,) = (block for language, block in BLOCK.findall(TEXT) if language == "python")
    names = {}
    exec(compile(code, PAGE.name, "exec"), names)
    printed = capsys.readouterr().out
    assert names["found"].report() in printed and len(names["yaw"]) == 1500


def test_the_columns_that_it_lists_are_those_of_the_file(folder):
    attitude.run("drive.csv").write("out")
    written = parquet.read_table("out/attitude.parquet").column_names
    for name in ("q_w [1]", "gyro_bias_x [rad/s]", "std_1 [rad]", "std_4 [rad/s]", "nis [1]"):
        assert name in written and f"`{name}`" in TEXT
    for name in ("heading_std [rad]", "quasi_static [1]", "at_rest [1]", "status [1]"):
        assert name in written and f"`{name}`" in TEXT


def test_its_sample_is_what_is_printed():
    """Word for word, but the numbers: these may differ by rounding."""
    log = measured("broad_11_undisturbed_slow_translation_B")
    result = attitude.run(log)
    printed = result.report().replace(result.name, "broad11").splitlines()
    printed = [DIGITS.sub("#", " ".join(line.split())) for line in printed]
    sample = TEXT.split("$ pyimu attitude broad11")[1].split("```")[0].splitlines()[1:]
    for line in sample:
        if line.strip() == "..." or line.startswith("report:"):
            continue
        begin, cut, _ = DIGITS.sub("#", " ".join(line.split())).partition("(...)")
        assert any(p.startswith(begin.rstrip()) if cut else p == begin for p in printed), line


def test_what_it_says_is_said_is_in_the_package():
    source = (CHECKOUT / "pyimu" / "attitude" / "report" / "words.py").read_text(encoding="utf-8")
    source = re.sub(r'"\s*\n\s*f?"', "", source)
    for said in ("gravity lies on -z", "do not turn as the gyro does", "has the wrong sign"):
        assert said in TEXT and said in source
    assert words.NOT_UNDONE.startswith("not undone") and "left in, not undone" in TEXT
