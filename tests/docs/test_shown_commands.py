"""Commands of the docs that take seconds run as they are shown, on logs that are made here.

Those that take longer are parsed (``test_pages.py``), and run by the tests of their commands.
"""

import re
import shlex

import numpy as np
import pandas as pd
import pytest
from places import CHECKOUT
from typer.testing import CliRunner

from pyimu.cli import app
from pyimu.recording.column_map import read_map

FENCE = re.compile(r"^```(\w*)\n(.*?)^```", re.MULTILINE | re.DOTALL)
QUICK = ("parts", "export", "inspect", "modelica")
SAMPLES = 4000


def blocks(page: str, language: str = "") -> list[str]:
    text = (CHECKOUT / page).read_text(encoding="utf-8")
    return [block for found, block in FENCE.findall(text) if found == language]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with the files that the commands name."""
    made, rng = tmp_path_factory.mktemp("shown"), np.random.default_rng(3)
    columns = {"time [s]": 0.01 * np.arange(SAMPLES)}
    for name, unit, size, last in (("gyro", "deg/s", 0.1, 0.0), ("accel", "m/s^2", 0.01, 9.80665)):
        for axis, level in zip("xyz", (0.0, 0.0, last), strict=True):
            columns[f"{name}_{axis} [{unit}]"] = level + size * rng.standard_normal(SAMPLES)
    pd.DataFrame(columns).to_csv(made / "log.csv", index=False)
    return made


def shown() -> list[tuple[str, str]]:
    """Page and command of all that are quick, those of one page one after the other."""
    pages = ("README.md", *(f"docs/{n}.md" for n in ("start", "logs", "export", "modelica")))
    return [
        (page, line.removeprefix("$ pyimu "))
        for page in pages
        for block in blocks(page)
        for line in block.splitlines()
        # Effects of one's own would stay in the catalogue of the tests that follow.
        if line.startswith("$ pyimu ") and line.split()[2] in QUICK and "--effects" not in line
    ]


@pytest.mark.parametrize(("page", "line"), shown(), ids=lambda v: v.replace("docs/", "")[:40])
def test_a_quick_command_runs_as_it_is_shown(page, line, folder, monkeypatch):
    monkeypatch.chdir(folder)
    words = shlex.split(line, comments=True)
    ended = CliRunner().invoke(app, words)
    assert ended.exit_code == 0, (page, line, ended.output, ended.exception)


def test_what_export_prints_is_shown(folder, monkeypatch):
    monkeypatch.chdir(folder)
    first, *printed = blocks("docs/export.md")[0].splitlines()
    ended = CliRunner().invoke(app, shlex.split(first)[2:])
    assert ended.output.splitlines() == printed


def test_the_column_map_that_is_shown_is_read(tmp_path):
    (block,) = blocks("docs/logs.md", "toml")
    (tmp_path / "map.toml").write_text(block)
    assert read_map(tmp_path / "map.toml").rate == pytest.approx(285.7)
