"""Commands of README and docs run as they are shown, page by page, on logs that are made here."""

import re
import shlex
from glob import glob
from pathlib import Path

import pytest
from places import CHECKOUT
from shown_files import FILES, OF_A_PAGE
from typer.testing import CliRunner

from pyimu.cli import app
from pyimu.cli.logs import EXIT_CODES
from pyimu.model.catalogue import CATALOGUE
from pyimu.recording.column_map import read_map

FENCE = re.compile(r"^```(\w*)\n(.*?)^```", re.MULTILINE | re.DOTALL)
PAGES = ["README.md", *sorted(f"docs/{p.name}" for p in (CHECKOUT / "docs").glob("*.md"))]

ELSEWHERE = {
    "close out/demo/rover.csv --part imt30 --out out/rover": "test_readme.py",
    "attitude out/demo/rover.csv --part out/demo/model.toml --out out/attitude": "test_readme.py",
    "campaign stim300 --runs 100000 --scheduler tcp://HOST:8786 --out out/campaign": (
        "test_campaign_dask.py: a scheduler on another machine"
    ),
}
"""Commands that are run by another test, and which."""

SHORTER = {"--runs 1000": "--runs 1 --rate 2 --terrains 1 --workers 0"}
"""Words of a command that are others here: a thousand drives take an hour."""


def blocks(page: str, language: str = "") -> list[str]:
    text = (CHECKOUT / page).read_text(encoding="utf-8")
    return [block for found, block in FENCE.findall(text) if found == language]


def commands(page: str) -> list[str]:
    return [
        line.removeprefix("$ pyimu ").partition(" #")[0].strip()
        for block in blocks(page)
        for line in block.splitlines()
        if line.startswith("$ pyimu ")
    ]


SHOWN = {page: commands(page) for page in PAGES}


@pytest.fixture
def catalogue():
    """Effects of a user's own would stay for the tests that follow."""
    known = set(CATALOGUE)
    yield
    CATALOGUE.remove(*(set(CATALOGUE) - known))


def words_of(page: str, line: str) -> list[str]:
    """The words of a command as a shell gives them, their files made in the current folder."""
    for long, short in SHORTER.items():
        line = line.replace(long, short)
    makers = FILES | OF_A_PAGE.get(page, {})
    words = []
    for word in shlex.split(line):
        named = [n for n in makers if re.fullmatch(word.replace("*", r"\d*"), n)]
        for name in named:
            if not Path(name).exists():
                makers[name](Path(name))
        words += sorted(glob(word)) if "*" in word else [word]
    return words


@pytest.mark.parametrize("page", [page for page, lines in SHOWN.items() if lines])
def test_the_commands_of_a_page_run_as_they_are_shown(
    page, tmp_path, monkeypatch, uncompiled, undrawn, catalogue
):
    """One after the other in one folder, as a later one takes what an earlier one wrote."""
    monkeypatch.chdir(tmp_path)
    ran = 0
    for line in SHOWN[page]:
        if line in ELSEWHERE:
            continue
        words = words_of(page, line)
        ended = CliRunner().invoke(app, words)
        # The log of the test bench lacks a scale factor, which is found and named.
        status = EXIT_CODES["named"] if "--exit-code" in words else 0
        assert ended.exit_code == status, (line, ended.output, ended.exception)
        if "--out" in words:
            assert any(Path(words[words.index("--out") + 1]).iterdir()), line
        ran += 1
    assert ran == sum(line not in ELSEWHERE for line in SHOWN[page])


def test_no_command_is_excused_that_is_not_shown():
    assert {line for lines in SHOWN.values() for line in lines} >= ELSEWHERE.keys()
    assert all(any(long in line for lines in SHOWN.values() for line in lines) for long in SHORTER)


def test_what_export_prints_is_shown(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    first, *printed = blocks("docs/export.md")[0].splitlines()
    ended = CliRunner().invoke(app, shlex.split(first)[2:])
    assert ended.output.splitlines() == printed


def test_the_column_map_that_is_shown_is_read(tmp_path):
    (block,) = blocks("docs/logs.md", "toml")
    (tmp_path / "map.toml").write_text(block)
    assert read_map(tmp_path / "map.toml").rate == pytest.approx(285.7)
