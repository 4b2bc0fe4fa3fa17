"""What docs/security.md says of what is executed, and what never is."""

import ast
import pickle
import re
import subprocess
import sys
from pathlib import Path

import pytest
from places import CHECKOUT, same_path

PAGE = (CHECKOUT / "docs" / "security.md").read_text(encoding="utf-8")

RUNS_TEXT = {"eval", "exec", "compile", "__import__"}
"""Built-in functions that make code of text."""

OTHERS_BYTES = {"pickle", "cPickle", "marshal", "shelve", "dill", "cloudpickle", "joblib", "yaml"}
NETWORK = {"socket", "ssl", "urllib", "http", "ftplib", "smtplib", "requests", "httpx", "aiohttp"}
STARTS = {"subprocess", "multiprocessing", "ctypes", "pty", "runpy", "code", "codeop"}


def modules():
    """Each module of the package: its path as the page writes it, and its syntax tree."""
    for path in sorted((CHECKOUT / "pyimu").rglob("*.py")):
        yield path.relative_to(CHECKOUT).as_posix(), ast.parse(path.read_text(encoding="utf-8"))


def imported(tree):
    """The top names of all that a module imports, anywhere in it."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name.partition(".")[0] for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and not node.level and node.module:
            yield node.module.partition(".")[0]


def users_of(names):
    return {path for path, tree in modules() if names & set(imported(tree))}


def listed(heading):
    """The files that a section of the page names."""
    section = PAGE.partition(f"\n## {heading}\n")[2].partition("\n## ")[0]
    assert section, f"docs/security.md has no section {heading}"
    return set(re.findall(r"`(pyimu/[\w/]+\.py)`", section))


def test_no_module_reads_others_objects_or_the_network():
    assert users_of(OTHERS_BYTES) == set() and users_of(NETWORK) == set()


def test_programs_and_libraries_are_started_where_the_page_says():
    assert users_of(STARTS) == listed("Programs and libraries")


def test_text_becomes_code_where_the_page_says():
    """An empty text, and formulas that the loop writes itself."""
    found = set()
    for path, tree in modules():
        for node in ast.walk(tree):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
                if node.func.id in RUNS_TEXT:
                    found.add(path)
            if isinstance(node, ast.Attribute) and node.attr == "exec_module":
                found.add(path)
    assert found == listed("Text that becomes code")


def test_nothing_goes_through_a_shell_and_no_array_holds_objects():
    for path, tree in modules():
        for node in ast.walk(tree):
            if isinstance(node, ast.Call):
                for k in node.keywords:
                    given = isinstance(k.value, ast.Constant) and k.value.value
                    assert not (k.arg in ("shell", "allow_pickle") and given), path
                name = getattr(node.func, "attr", "")
                of = getattr(getattr(node.func, "value", None), "id", "")
                assert (of, name) not in {("os", "system"), ("os", "popen")}, path


class Bomb:
    """An object that writes a file when it is read back."""

    def __init__(self, trace):
        self.trace = trace

    def __reduce__(self):
        return (Path.touch, (self.trace,))


@pytest.mark.parametrize(
    "suffix",
    ("csv", "csv.gz", "parquet", "mat", "h5", "bag", "mcap", "db3", "toml", "pkl", "npy", "npz"),
)
def test_an_object_in_a_file_is_not_read_back(pyimu, tmp_path, suffix):
    """Whatever the file is called: as a log, a part, a map of columns."""
    trace = tmp_path / "trace"
    bomb = tmp_path / f"bomb.{suffix}"
    bomb.write_bytes(pickle.dumps(Bomb(trace)))
    pickle.loads(bomb.read_bytes())
    assert trace.exists()
    trace.unlink()
    out = str(tmp_path / "out")
    for words in (
        ["characterize", str(bomb), "--out", out],
        ["build", str(bomb), "--out", out],
        ["characterize", "rest.csv", "--columns", str(bomb), "--out", out],
    ):
        status, _, said = pyimu(*words)
        assert status == 2 and said.count("\n") == 1
    assert not trace.exists()


WATCHED = """
import os, sys
STARTS = ("subprocess.Popen", "os.system", "os.exec", "os.posix_spawn")
NETWORK = ("socket.connect", "socket.bind", "socket.getaddrinfo", "socket.sendto", "urllib.Request")
def watch(event, arguments):
    if event in STARTS:
        program = arguments[1][0] if event == "subprocess.Popen" else arguments[0]
        os.write(2, f"STARTS {program}\\n".encode())
    if event in NETWORK:
        os.write(2, f"NETWORK {event} {arguments}\\n".encode())
sys.addaudithook(watch)
sys.argv = ["pyimu", *sys.argv[1:]]
from pyimu.cli import main
main()
"""


def watched(folder, *words, **environment):
    """What a command starts, and what of the network it touches, as Python itself tells."""
    done = subprocess.run(
        [sys.executable, "-c", WATCHED, *words],
        cwd=folder,
        env=same_path() | environment,
        capture_output=True,
        text=True,
        check=True,
    )
    return [line for line in done.stderr.splitlines() if line.startswith(("STARTS", "NETWORK"))]


def test_building_starts_the_compiler_and_nothing_else(tmp_path):
    words = ("build", "imt30", "--fmu", "low-pass", "--fmi", "2", "--out", "units")
    told = watched(tmp_path, *words, PYIMU_CACHE="", CC="cc")
    # The second asks where the C library lies, for numba.
    assert "STARTS cc" in told and set(told) <= {"STARTS cc", "STARTS /sbin/ldconfig"}


def test_listing_parts_starts_nothing(tmp_path):
    assert set(watched(tmp_path, "parts", "imt30")) <= {"STARTS /sbin/ldconfig"}
