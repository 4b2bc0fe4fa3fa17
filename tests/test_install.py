"""The package works from an installed wheel, away from its checkout: sources, templates and parts
travel inside.
"""

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from built import built
from places import CHECKOUT

from pyimu.attitude import attitude_ukf
from pyimu.model.part_file import part


def pip(*words):
    command = [sys.executable, "-m", "pip", "--disable-pip-version-check", *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)


def build_options():
    """Take the installed build backend where there is one; else pip gets it, which needs a
    network.
    """
    try:
        import hatchling  # noqa: F401
    except ImportError:
        return []
    return ["--no-build-isolation"]


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    done = pip("wheel", CHECKOUT, "--no-deps", *build_options(), "-w", folder)
    if done.returncode and "build dependencies" in done.stderr:
        pytest.skip("pip cannot get the build backend: no hatchling is installed, and no network")
    assert done.returncode == 0, done.stdout + done.stderr
    (path,) = folder.glob("pyimu-*.whl")
    return path


@pytest.fixture(scope="module")
def installed(wheel, tmp_path_factory):
    """A folder that holds the package as installed, and nothing else of it."""
    folder = tmp_path_factory.mktemp("site")
    done = pip("install", "--no-deps", "--no-index", "--target", folder, wheel)
    assert done.returncode == 0, done.stderr
    return folder


def files_of(folder, *patterns):
    """Paths of the files below a folder of the checkout, relative to the checkout."""
    return {
        p.relative_to(CHECKOUT).as_posix()
        for pattern in patterns
        for p in (CHECKOUT / folder).rglob(pattern)
        if p.is_file()
    }


def test_wheel_holds_what_the_package_reads(wheel):
    with zipfile.ZipFile(wheel) as archive:
        names = set(archive.namelist())
    want = {name for name in files_of("pyimu", "*") if "__pycache__" not in name}
    want |= {f"pyimu/{name}" for name in files_of("fmu_src", "*.c", "*.h")}
    assert {
        "pyimu/model/parts/imt30.toml",
        "pyimu/fmu/templates/model_table.h",
        "pyimu/fmu_src/block.c",
    } <= want
    assert any("/vendor/" in name for name in want)
    assert want <= names
    assert not [n for n in names if n.startswith(("tests/", "benchmarks/", "fmu_src/"))]


def isolated(installed, cwd, *words):
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"} | {
        "PYTHONPATH": str(installed)
    }
    command = [sys.executable, *map(str, words)]
    return subprocess.run(
        command, cwd=cwd, env=environment, capture_output=True, text=True, timeout=120, check=False
    )


def test_installed_package_builds_fmus(installed, tmp_path, tmp_path_factory):
    ask = "import pyimu, pyimu.fmu as f; print(pyimu.__file__, f.source_folder(), sep='\\n')"
    said = isolated(installed, tmp_path, "-c", ask)
    places = [Path(line) for line in said.stdout.split("\n") if line]
    assert len(places) == 2 and all(p.is_relative_to(installed) for p in places), (
        said.stdout + said.stderr
    )
    done = isolated(installed, tmp_path, "-m", "pyimu", "build", "imt30", "--out", "x")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.split() == [
        f"x/{n}.{form}.fmu"
        for n in ("ImuSensor", "AttitudeUkf")
        for form in ("fmi2", "fmi3", "block")
    ]
    imt30 = part("imt30")
    for block in (imt30.block, attitude_ukf(imt30)):
        for made in built(block, tmp_path_factory).values():
            assert (tmp_path / "x" / made.name).read_bytes() == made.read_bytes(), (
                f"{made.name} differs from the checkout's"
            )
