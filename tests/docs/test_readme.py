"""What the README shows of ``close``, and counts, is what it is today."""

import re
import shlex
import shutil
from pathlib import Path

import pytest
from typer.testing import CliRunner

import pyimu
from pyimu.cli import app
from pyimu.model.effects import EFFECTS
from pyimu.rover.demo import recording

README = Path(__file__).parents[2] / "README.md"
COMMAND = "$ pyimu close out/demo/rover.csv --part imt30"
PYTHON = re.compile(r"^```python\n(.*?)^```", re.MULTILINE | re.DOTALL)
EFFECTS_BY_NAME = {e.name: e for e in EFFECTS}
NUMBER = re.compile(r"\d+(?:\.\d+)?")


def words(line: str) -> str:
    """A line without its numbers and the widths of its columns."""
    return " ".join(NUMBER.sub("#", line).split())


def shown() -> list[str]:
    """The lines of the README's sample, less the command."""
    text = README.read_text(encoding="utf-8")
    sample = text[text.index(COMMAND) :].split("```")[0].splitlines()[1:]
    return [line for line in sample if line.strip() != "..."]


def run(command: str) -> str:
    """Run a command of the README, as it is shown; gives what it prints."""
    text = README.read_text(encoding="utf-8")
    (line,) = re.findall(rf"^\$ pyimu ({re.escape(command)}.*)$", text, re.MULTILINE)
    ended = CliRunner().invoke(app, shlex.split(line))
    assert ended.exit_code == 0, (ended.output, ended.exception)
    return ended.output


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Where the commands run: behind ``make demo``, of which there is the log."""
    made = tmp_path_factory.mktemp("readme")
    recording().write(made / "out" / "demo" / "rover.csv")
    return made


@pytest.fixture(scope="module")
def printed(folder) -> dict[str, str]:
    """What ``close`` prints."""
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        said = run("close out/demo/rover.csv")
    # The demo closes the same loop on the same log.
    shutil.copy(folder / "out" / "rover" / "model.toml", folder / "out" / "demo" / "model.toml")
    return {words(line): line for line in said.splitlines()}


@pytest.fixture
def as_after_the_commands(printed, folder, monkeypatch):
    """A folder with what the commands that stand above the blocks leave there."""
    monkeypatch.chdir(folder)
    pyimu.build("mpu6050", folder / "out" / "fmus", ["sensor"], [3])


def test_attitude_runs_as_it_is_shown(as_after_the_commands):
    assert "report: out/attitude/report.html" in run("attitude out/demo/rover.csv")
    assert Path("out/attitude/attitude.parquet").stat().st_size > 100_000


def test_every_block_of_python_runs(as_after_the_commands, capsys):
    """One after the other, as someone would paste them."""
    blocks = PYTHON.findall(README.read_text(encoding="utf-8"))
    names: dict = {}
    for block in blocks:
        exec(compile(block, "README.md", "exec"), names)
    assert len(blocks) == 3 and Path("attitude.png").stat().st_size > 10_000
    assert names["found"].report() in capsys.readouterr().out
    assert names["g_sensitivity"].equation == EFFECTS_BY_NAME["g_sensitivity"].equation


def test_the_sample_of_close_is_what_it_prints(printed):
    """Word for word; a number may differ in the last place or two, as processors and libraries
    round differently. What stands in brackets as (...) is left out of a line.
    """
    for line in shown():
        begin, left_out, end = line.partition("(...)")
        found = [
            p for w, p in printed.items() if w.startswith(words(begin)) and w.endswith(words(end))
        ]
        assert found, f"not printed: {line}"
        assert left_out or words(found[0]) == words(line), line
        numbers = [[float(v) for v in NUMBER.findall(x)] for x in (line, found[0])]
        for old, new in zip(*numbers, strict=False):
            assert old == pytest.approx(new, rel=0.03), f"{line}\n{found[0]}"


def test_it_counts_the_effects_that_there_are():
    assert f"The {len(EFFECTS)} effects that there are" in README.read_text(encoding="utf-8")
