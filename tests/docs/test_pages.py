"""README and docs: no link leads nowhere, every command and option that is shown exists, what is
shown as TOML is read, and each effect is found by a symptom.
"""

import json
import re
import shlex
import tomllib
from pathlib import Path

import pytest
import typer
from places import CHECKOUT

from pyimu.cli import app
from pyimu.model.effects import EFFECTS
from pyimu.model.part_reader import parse_part

PAGES = sorted(
    [*CHECKOUT.glob("*.md"), *(CHECKOUT / "docs").glob("*.md")], key=lambda p: p.as_posix()
)
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
FENCE = re.compile(r"^```(\w*)\n(.*?)^```", re.MULTILINE | re.DOTALL)
SPAN = re.compile(r"`(pyimu [a-z][^`]*)`")
COMMANDS = typer.main.get_command(app).commands


def text(page: Path) -> str:
    return page.read_text(encoding="utf-8")


def prose(page: Path) -> str:
    """A page without its code."""
    return FENCE.sub("", text(page))


def name(page: Path) -> str:
    return page.relative_to(CHECKOUT).as_posix()


def anchors(page: Path) -> set[str]:
    """What the headings of a page are linked to by, as GitHub makes it."""
    heads = re.findall(r"^#+ (.*)$", prose(page), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", h.lower()).replace(" ", "-") for h in heads}


def links(page: Path) -> list[str]:
    if page.suffix == ".ipynb":
        cells = json.loads(text(page))["cells"]
        written = "\n".join("".join(c["source"]) for c in cells if c["cell_type"] == "markdown")
        return LINK.findall(written)
    return LINK.findall(prose(page))


@pytest.mark.parametrize("page", [*PAGES, *(CHECKOUT / "docs").rglob("*.ipynb")], ids=name)
def test_no_link_leads_nowhere(page):
    for link in links(page):
        if re.match(r"https?://", link):
            continue
        path, _, anchor = link.partition("#")
        target = (page.parent / path).resolve() if path else page
        assert target.exists(), link
        assert not anchor or anchor in anchors(target), link


def test_every_page_of_the_docs_is_linked_from_another():
    found = {
        (page.parent / link.partition("#")[0]).resolve() for page in PAGES for link in links(page)
    }
    pages = {*(CHECKOUT / "docs").glob("*.md"), *(CHECKOUT / "docs").rglob("*.ipynb")}
    assert pages <= found, pages - found


def lines() -> list[tuple[str, str]]:
    """Page and line of every command that is shown with a prompt."""
    return [
        (name(page), line.removeprefix("$ "))
        for page in PAGES
        for _, block in FENCE.findall(text(page))
        for line in block.splitlines()
        if line.startswith("$ pyimu ")
    ]


@pytest.mark.parametrize(("page", "line"), lines())
def test_a_command_that_is_shown_is_understood(page, line):
    """Parsed as the command line parses it, down to the types of its options, and not run."""
    _, command, *words = shlex.split(line, comments=True)
    context = COMMANDS[command].make_context(command, list(words))
    assert not context.args


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_commands_and_options_that_are_spoken_of_exist(page):
    for span in SPAN.findall(prose(page)):
        words = shlex.split(span.replace("...", ""))
        command = COMMANDS.get(words[1])
        assert command is not None, span
        known = {o for p in command.params for o in p.opts} | {"--help"}
        asked = {w.partition("=")[0] for w in words if w.startswith("--")}
        assert asked <= known, (span, asked - known)


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_toml_that_is_shown_is_a_part_or_a_piece_of_one(page):
    head = 'name = "shown"\nsample_rate = {value = 100.0, unit = "Hz"}\n'
    for language, block in FENCE.findall(text(page)):
        if language == "toml" and re.search(r"^\[(gyro|accel|mag|tolerance)\b", block, re.M):
            shown = tomllib.loads(block)
            part = parse_part(block if "sample_rate" in shown else head + block)
            for kind in ("gyro", "accel", "mag"):
                declared = getattr(part, kind, None)
                there = set(declared.values) if declared is not None else set()
                assert set(shown.get(kind, {})) <= there, (kind, block)


def test_every_effect_is_found_by_a_symptom_and_none_that_is_not():
    rows = [line for line in text(CHECKOUT / "docs" / "symptoms.md").splitlines() if "|" in line]
    cells = [line.split("|")[2] for line in rows]
    named = {e for cell in cells for e in re.findall(r"`(\w+)`", cell)}
    assert named == {e.name for e in EFFECTS}


RUN = {
    "README.md": "docs/test_readme.py",
    "docs/attitude.md": "docs/test_attitude_page.py",
    "docs/close.md": "docs/test_close_page.py",
    "docs/api.md": "docs/test_site.py",  # signatures: the page is what the package says
    "docs/noise.md": "docs/test_noise_page.py",
    "docs/simulators.md": "docs/test_simulators_page.py",
}
"""Pages with Python, and the test that runs it."""

NOT_RUN = {
    "make": "installs and runs all of this",
    "$ dask": "starts servers on other machines; test_campaign_dask.py runs them on this one",
    "$ git": "from wherever the project is",
    "$ python3": "needs a network; test_install.py installs a wheel",
    "oms_": "OMSimulator is in no registry",
    "function ": "a piece of the library, which tests/modelica compiles whole",
    "model ": "needs a compiler of Modelica's own library",
}
"""How lines begin that no test runs as they stand, and why."""


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_every_block_of_code_is_run_or_it_is_said_why_not(page):
    for language, block in FENCE.findall(text(page)):
        if language == "python":
            assert (CHECKOUT / "tests" / RUN[name(page)]).is_file()
        elif language != "toml":
            prompts = [line for line in block.splitlines() if line.startswith("$ ")]
            for line in prompts or block.splitlines()[:1]:
                # test_shown_commands.py runs every command of pyimu.
                assert line.startswith(("$ pyimu ", *NOT_RUN)), line
