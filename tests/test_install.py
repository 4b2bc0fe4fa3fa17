"""The package works from an installed wheel, away from its checkout: sources, templates and parts
travel inside; and by its own dependencies alone, whatever else the tests have.
"""

import email
import os
import subprocess
import sys
import zipfile
from importlib.metadata import packages_distributions, requires
from pathlib import Path

import pytest
import raw_logs
from built import built
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
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


def needed(wheel):
    """The distributions that ``pip install`` of the wheel brings, without its extras."""
    with zipfile.ZipFile(wheel) as archive:
        (name,) = [n for n in archive.namelist() if n.endswith(".dist-info/METADATA")]
        lines = email.message_from_bytes(archive.read(name)).get_all("Requires-Dist")
    found, waiting = set(), [Requirement(line) for line in lines]
    while waiting:
        one = waiting.pop()
        wanted = one.marker is None or one.marker.evaluate({"extra": ""})
        if wanted and (canonicalize_name(one.name), *sorted(one.extras)) not in found:
            found.add((canonicalize_name(one.name), *sorted(one.extras)))
            waiting += _of_installed(one)
    return {name for name, *_ in found}


def _of_installed(one):
    """What an installed distribution needs in turn, with the extras that it is asked for."""
    for line in requires(one.name) or ():
        inner = Requirement(line)
        extras = ("", *one.extras)
        if inner.marker is None or any(inner.marker.evaluate({"extra": e}) for e in extras):
            inner.marker = None
            yield inner


BLOCKER = """
import sys
class Blocker:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in BLOCKED:
            raise ModuleNotFoundError(f"No module named {name!r}, which is not declared", name=name)
sys.meta_path.insert(0, Blocker())
"""


@pytest.fixture(scope="module")
def alone(wheel, tmp_path_factory):
    """A folder whose ``sitecustomize`` hides modules of distributions that nobody declared."""
    folder, there = tmp_path_factory.mktemp("alone"), needed(wheel)
    blocked = {
        module
        for module, names in packages_distributions().items()
        if not {canonicalize_name(name) for name in names} & there and module != "pyimu"
    }
    assert {"pytest", "pandas", "h5py"} & blocked and not {"numpy", "jinja2"} & blocked
    text = f"BLOCKED = {sorted(blocked)!r}\n{BLOCKER}"
    (folder / "sitecustomize.py").write_text(text, encoding="utf-8")
    return folder


def isolated(installed, cwd, *words, before=()):
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"} | {
        "PYTHONPATH": os.pathsep.join(map(str, (*before, installed)))
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


def test_installed_package_runs_on_its_dependencies_alone(installed, alone, tmp_path):
    """From a raw log to a page, a part and an export, with all other libraries hidden."""
    hidden = isolated(installed, tmp_path, "-c", "import pandas", before=[alone])
    assert hidden.returncode == 1 and "which is not declared" in hidden.stderr
    log = raw_logs.euroc(tmp_path, raw_logs.still(2000))
    for words in (
        ["inspect", log, "--out", "look"],
        ["characterize", log, "--out", "out"],
        ["attitude", log, "--part", "mpu6050", "--out", "angles"],
        ["export", "mpu6050", "--to", "kalibr,vins,gazebo,ros2,matlab,px4", "--out", "others"],
        ["build", "imt30", "--fmu", "sensor", "--fmi", "3", "--out", "x"],
    ):
        done = isolated(installed, tmp_path, "-m", "pyimu", *words, before=[alone])
        assert done.returncode == 0 and "not declared" not in done.stderr, done.stderr
    assert (tmp_path / "out" / "report.html").is_file()


def test_what_an_extra_brings_is_asked_for_in_a_line(installed, alone, tmp_path):
    (tmp_path / "log.h5").write_bytes(b"\x89HDF\r\n\x1a\n")
    done = isolated(installed, tmp_path, "-m", "pyimu", "inspect", "log.h5", before=[alone])
    assert done.returncode == 2 and done.stderr.count("\n") == 1
    assert "pip install 'pyimu[hdf5]'" in done.stderr
    ask = "import pyimu; pyimu.part('imt30').to_frame()"
    done = isolated(installed, tmp_path, "-c", ask, before=[alone])
    assert "UserError: a data frame needs pandas" in done.stderr
