"""What ``docs/simulators.md`` shows of the simulators that are here runs as it stands."""

import re

import numpy as np
import pytest
from places import CHECKOUT
from simulators import installed

from pyimu import build, simulate
from pyimu import part as load
from pyimu.fmu.cosimulate import cosimulate
from pyimu.rover.system import rover_system, write_rover

PAGE = (CHECKOUT / "docs" / "simulators.md").read_text(encoding="utf-8")
SAMPLES = re.findall(r"^## (\w+)\n.*?```python\n(.*?)```", PAGE, re.DOTALL | re.MULTILINE)
NEEDS = {"fmpy": "fmpy", "ecos": "ecospy", "libcosim": "libcosimpy"}
STEPS = 98
"""In 0.1 s, and a part of one that fmpy makes whole."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    made = tmp_path_factory.mktemp("page")
    write_rover("imt30", made / "out" / "rover")
    return made


@pytest.fixture(scope="module")
def yaw(tmp_path_factory):
    system = rover_system("imt30", tmp_path_factory.mktemp("units"))
    assert f"step_size={system.step_size:g}" in PAGE
    return cosimulate(system, STEPS, ["Filter.yaw"])["Filter.yaw"][-1]


def test_each_simulator_that_is_here_is_shown():
    assert [name for name, _ in SAMPLES] == list(NEEDS)


@pytest.mark.parametrize("name, sample", SAMPLES, ids=NEEDS)
def test_the_sample_runs(name, sample, folder, yaw, monkeypatch, capfd):
    """It ends with the heading of the same system in a loop over fmpy: to the bit, but for the
    first step of fmpy's own reader.
    """
    installed(NEEDS[name])
    monkeypatch.chdir(folder)
    exec(compile(sample, f"docs/simulators.md, {name}", "exec"), {})
    *_, shown = re.findall(r"^-?\d[-.e\d]*$", capfd.readouterr().out, re.MULTILINE)
    shown = float(shown)
    if name == "fmpy":
        assert shown != yaw and abs(shown - yaw) < np.deg2rad(1.0)
    else:
        assert shown == yaw


def test_the_loop_of_one_s_own_shows_what_python_does(folder, monkeypatch, capsys):
    installed("fmpy")
    (sample,) = re.findall(r"^## A script of one's own\n.*?```python\n(.*?)```", PAGE, re.S | re.M)
    monkeypatch.chdir(folder)
    build("imt30", "out/rover", ("sensor",), (2,))
    exec(compile(sample, "docs/simulators.md, a script", "exec"), {})
    shown = [float(v) for v in capsys.readouterr().out.strip(" []\n").split(",")]
    motion = np.tile([0, 0, 0.1, 0, 0, 9.80665], (100, 1))
    gyro, _ = simulate(load("imt30"), motion[:, :3], motion[:, 3:], seed=1)
    assert shown == gyro[-1].tolist()
