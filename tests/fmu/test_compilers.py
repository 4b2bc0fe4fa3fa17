"""What a library needs of the machine that loads it, and which compiler makes it."""

import os
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import casadi as ca
import numpy as np
import pytest
from fmu_toy import toy

from pyimu.block.block import Block
from pyimu.block.compiled import compiler_command
from pyimu.block.variables import Variable
from pyimu.fmu import FORMS, build, build_fmu, build_fmus, host_platform, simulate

linux = pytest.mark.skipif(
    sys.platform != "linux" or shutil.which("readelf") is None, reason="needs Linux and readelf"
)

OF_ONE = (
    "exp log log10 log1p expm1 sqrt sinh cosh tanh asinh acosh atanh asin acos sin tan erf "
    "floor ceil"
).split()
OF_TWO = "power fmod hypot atan2 remainder copysign fmax".split()


def mathematics() -> Block:
    """Every function of the C library that casadi calls."""
    a, b = ca.SX.sym("a"), ca.SX.sym("b")
    y = [*(getattr(ca, f)(a) for f in OF_ONE), *(getattr(ca, f)(a, b) for f in OF_TWO)]
    y.append(ca.power(2, a))
    nothing, u, p = ca.SX.zeros(0), ca.vertcat(a, b), ca.SX.sym("p", 0)
    s, w, h = ca.SX.sym("s", 0), ca.SX.sym("w", 0), ca.SX.sym("h")
    step = ca.Function("step", [s, u, p, w, h], [nothing, ca.vertcat(*y)])
    initial = ca.Function("initial", [u, p], [nothing, ca.SX.zeros(len(y))])
    inputs = tuple(Variable(f"u[{i}]") for i in (1, 2))
    outputs = tuple(Variable(f"y[{i + 1}]") for i in range(len(y)))
    return Block("Mathematics", "", step, initial, inputs, (), outputs, (), 0.1)


def versions(library):
    """The versions of glibc whose symbols a library asks for, as numbers."""
    said = subprocess.run(
        ["readelf", "-W", "--dyn-syms", library], capture_output=True, text=True, check=True
    ).stdout
    return {tuple(map(int, v.split("."))) for v in re.findall(r"@GLIBC_([\d.]+)", said)}


def library_of(fmu, folder):
    with zipfile.ZipFile(fmu) as archive:
        (name,) = (n for n in archive.namelist() if n.startswith("binaries/"))
        return archive.extract(name, folder)


@linux
@pytest.mark.parametrize("block", (mathematics(), toy()), ids=lambda b: b.name)
def test_a_library_loads_from_glibc_2_17_on(block, tmp_path):
    """Whatever it was linked against, here something newer."""
    for fmu in build_fmus(block, tmp_path, FORMS):
        asked = versions(library_of(fmu, tmp_path / fmu.name.partition(".fmu")[0]))
        assert asked and max(asked) <= (2, 17)


def test_the_first_versions_of_the_functions_give_the_bits_of_today(tmp_path):
    """Of arguments in and beyond the domain, what casadi's virtual machine gives, which calls the
    C library that is installed.
    """
    block = mathematics()
    edge = [0.0, 1.0, -1.0, 0.5, 710.0, -746.0, 1e300, -1e300, 1e-310, 1.5, 3.0]
    usual = np.random.default_rng(1).normal(0, 3, (200, 2))
    inputs = np.vstack([np.array([(a, b) for a in edge for b in edge]), usual])
    outputs = simulate(build_fmu(block, tmp_path), inputs, sample_period=0.1)
    np.testing.assert_array_equal(outputs[1:], block.run(inputs)[0])


# The package ziglang, where there is no other compiler

STAND_IN = """\
import os, subprocess, sys
mode, *arguments = sys.argv[1:]
assert mode == "cc"
if arguments[:1] == ["-target"]:
    with open({log!r}, "a") as log:
        log.write(arguments[1] + "\\n")
    arguments = arguments[2:]
sys.exit(subprocess.call([{gcc!r}, *arguments], env=os.environ | {{"PATH": {path!r}}}))
"""


@pytest.fixture
def zig_alone(tmp_path, monkeypatch):
    """No compiler on the path, and a package ziglang that hands on to gcc; gives its log."""
    package = tmp_path / "site" / "ziglang"
    package.mkdir(parents=True)
    (package / "__init__.py").write_text("")
    names = {"log": str(tmp_path / "log"), "gcc": shutil.which("gcc"), "path": os.environ["PATH"]}
    (package / "__main__.py").write_text(STAND_IN.format(**names))
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path / "nothing"))
    monkeypatch.setenv("PYIMU_CACHE", "")
    monkeypatch.syspath_prepend(str(package.parent))
    monkeypatch.setenv(
        "PYTHONPATH", os.pathsep.join((str(package.parent), os.environ.get("PYTHONPATH", "")))
    )
    return tmp_path / "log"


@pytest.mark.skipif(shutil.which("gcc") is None, reason="needs gcc")
def test_ziglang_compiles_where_there_is_no_other_compiler(zig_alone, tmp_path):
    """For this machine, with the name that zig has for it and its old glibc."""
    block = toy()
    fmu = build_fmu(block, tmp_path)
    machine = host_platform().partition("-")[0]
    (target,) = set(zig_alone.read_text().split())
    assert target.startswith(machine) and (sys.platform != "linux" or target.endswith("gnu.2.17"))
    inputs = np.random.default_rng(2).normal(size=(20, 4)).round()
    silent = {"noise.N": 0.0, "noise.K": 0.0}
    p = [0.0 if v.name in silent else v.start for v in block.parameters]
    outputs = simulate(fmu, inputs, sample_period=block.sample_period, start_values=silent)
    np.testing.assert_array_equal(outputs[1:], block.run(inputs, p=np.array(p))[0])


def test_a_compiler_that_was_named_is_not_replaced(zig_alone, monkeypatch):
    assert compiler_command() == [sys.executable, "-m", "ziglang", "cc"]
    monkeypatch.setenv("CC", "no-such-compiler")
    assert compiler_command() == []


def test_each_platform_is_compiled_by_its_name_into_its_folder(monkeypatch, tmp_path):
    """What zig is told, and where its libraries lie, with no compiler at all; nothing is left where
    one happens to be.
    """
    here = tmp_path / "here"
    here.mkdir()
    monkeypatch.chdir(here)
    monkeypatch.setenv("PYIMU_CACHE", "")
    monkeypatch.setattr(build, "find_spec", lambda name: object())
    monkeypatch.setattr(build, "header_folder", lambda: tmp_path)
    targets = []

    def pretend(command, folder, what):
        target = command[command.index("-target") + 1]
        targets.append(target)
        Path(folder, command[command.index("-o") + 1]).write_text(target)
        assert ("-install_name" in " ".join(command)) == (what.endswith(".dylib"))

    monkeypatch.setattr(build, "_run", pretend)
    two, three = build_fmus(toy(), tmp_path, (2, 3), "all")
    want = {
        "x86_64-linux": ("linux64", "so", "x86_64-linux-gnu.2.17"),
        "aarch64-linux": ("aarch64-linux", "so", "aarch64-linux-gnu.2.17"),
        "x86_64-windows": ("win64", "dll", "x86_64-windows-gnu"),
        "x86_64-darwin": ("darwin64", "dylib", "x86_64-macos.11.0"),
        "aarch64-darwin": ("aarch64-darwin", "dylib", "aarch64-macos.11.0"),
    }
    assert set(targets) == {target for *_, target in want.values()}
    assert not list(here.iterdir())
    for fmu, folder in ((two, 0), (three, None)):
        with zipfile.ZipFile(fmu) as archive:
            found = {n: archive.read(n) for n in archive.namelist() if n.startswith("binaries/")}
        assert found == {
            f"binaries/{name if folder is None else own[folder]}/Toy.{own[1]}": own[2].encode()
            for name, own in want.items()
        }
