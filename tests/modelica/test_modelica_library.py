"""The files of the library: fresh, complete, and readable by two parsers."""

import logging
import re
from difflib import unified_diff
from itertools import islice

import pytest
from modelica_cases import LIBRARY

from pyimu.modelica.generate import CHECKED_IN, generate
from pyimu.modelica.library import FOLDERS, library
from pyimu.modelica.names import BUILTIN, KEYWORDS

ROOT = LIBRARY / "PyImu"
FILES = sorted(ROOT.rglob("*.mo"))
PACKAGES = sorted(p.parent for p in ROOT.rglob("package.mo"))

LONG = {"Lag", "TimeDelay", "BiasInstability"}
"""Effects with many states or many operations."""


def test_generated_files_are_fresh():
    """``make generate`` writes them; nobody edits them."""
    lines = []
    for path, text in library().items():
        file = ROOT / path
        have = file.read_text(encoding="utf-8") if file.is_file() else ""
        lines += islice(unified_diff(have.splitlines(), text.splitlines(), path, n=0), 6)
    assert not lines, "modelica/PyImu is not what the definitions give:\n" + "\n".join(lines[:40])


def test_folders_of_generated_files_hold_nothing_else():
    for folder in FOLDERS:
        wanted = {path for path in library() if path.startswith(f"{folder}/")}
        assert {p.relative_to(ROOT).as_posix() for p in (ROOT / folder).iterdir()} == wanted


def test_only_what_changed_is_written(tmp_path):
    first = generate(tmp_path)
    stale = tmp_path / FOLDERS[0] / "Old.mo"
    stale.write_text("")
    assert len(first) == len(library()) and generate(tmp_path) == [stale]
    assert not stale.exists() and CHECKED_IN == ROOT


@pytest.mark.parametrize("package", PACKAGES, ids=lambda p: p.relative_to(LIBRARY).as_posix())
def test_order_names_every_class_of_a_package(package):
    """One class a file, named after it, and within its package."""
    classes = [p.stem for p in package.glob("*.mo") if p.stem != "package"]
    folders = [p.name for p in package.iterdir() if (p / "package.mo").is_file()]
    order = (package / "package.order").read_text().split()
    assert sorted(order) == sorted([*classes, *folders])
    within = ".".join(package.relative_to(LIBRARY).parts)
    for name in classes:
        text = (package / f"{name}.mo").read_text()
        assert re.search(rf"^within {re.escape(within)};$", text, re.MULTILINE), name
        kind = r"^((partial|impure) )?(package|model|block|function|class) "
        whole = rf"{kind}{name} \".*\n(.*\n)*end {name};\n\Z"
        assert re.search(whole, text, re.MULTILINE) or f"\ntype {name} = " in text, name


@pytest.mark.parametrize("path", FILES, ids=lambda p: p.relative_to(LIBRARY).as_posix())
def test_two_parsers_read_every_file(path):
    rumoca = pytest.importorskip("rumoca", reason="rumoca has no wheel for this Python")
    pymoca = pytest.importorskip("pymoca.parser", reason="pymoca is not installed")
    found = [d for d in rumoca.validate(str(path)) if d.rule == "syntax-error"]
    assert not found, found[0].message
    logging.getLogger("pymoca").setLevel(logging.ERROR)
    assert pymoca.parse(path.read_text(encoding="utf-8")) is not None


def test_parsers_refuse_what_is_no_modelica(tmp_path):
    rumoca = pytest.importorskip("rumoca", reason="rumoca has no wheel for this Python")
    pymoca = pytest.importorskip("pymoca.parser", reason="pymoca is not installed")
    text = "model Wrong Real x = ; end Wrong;"
    (tmp_path / "Wrong.mo").write_text(text)
    found = rumoca.validate(str(tmp_path / "Wrong.mo"))
    assert "syntax-error" in {d.rule for d in found}
    with pytest.raises(pymoca.ModelicaSyntaxError):
        pymoca.parse(text)


def test_files_differ_by_more_than_the_case_of_their_names():
    """Windows and macOS would take two of them for one."""
    names = [p.relative_to(ROOT).as_posix().lower() for p in FILES]
    assert len(names) == len(set(names))


@pytest.mark.parametrize("path", FILES, ids=lambda p: p.relative_to(LIBRARY).as_posix())
def test_no_function_has_the_name_of_a_builtin(path):
    """Modelica specification 3.6, 3.7: some tools know these before they look for a class."""
    text = path.read_text(encoding="utf-8")
    named = re.findall(r"^ *(?:partial )?function (\w+)", text, re.MULTILINE)
    named += re.findall(r"^ *input Real (?:\w+(?:\[[^]]*\])?, )*(\w+)", text, re.MULTILINE)
    assert not set(named) & (BUILTIN | KEYWORDS)


@pytest.mark.parametrize("path", sorted((ROOT / "Effects").glob("*.mo")), ids=lambda p: p.stem)
def test_effects_read_well(path):
    """Short, the page of documentation aside, in short lines, and nothing but what Modelica has."""
    text = path.read_text()
    assert path.stem in LONG or text.partition("  annotation(Documentation(")[0].count("\n") <= 70
    code = [line for line in text.splitlines() if not line.startswith("<p>") and "<t" not in line]
    assert max(map(len, code)) <= 110
    assert not re.search(r"\b(inf|nan)\b", "\n".join(code))


@pytest.mark.parametrize("path", FILES, ids=lambda p: p.relative_to(LIBRARY).as_posix())
def test_every_class_is_described_and_documented(path):
    """And has an icon: its own, or that of what it extends or is short for."""
    text = path.read_text(encoding="utf-8")
    page = re.search(r'Documentation\(info="<html>\n(.*?)</html>"\)', text, re.DOTALL)
    assert page and len(page[1]) > 20
    kind = re.search(r"^(?:partial |impure )?(\w+) \w+", text, re.MULTILINE)[1]
    assert "  extends " in text or "Icon(" in text or kind in ("type", "connector", "within")


def test_g_sensitivity_reads_as_its_equation():
    text = (ROOT / "Effects" / "GSensitivity.mo").read_text()
    assert "y[1] := x[1] + (G[1,1]*f[1] + G[1,2]*f[2] + G[1,3]*f[3]);" in text
    assert 'parameter Real G[3,3](each unit="rad.s/m")' in text
