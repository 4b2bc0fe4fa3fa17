"""Accelerations in g under a header of m/s^2: no command takes them for what they are not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pyimu.model.part_file import part
from pyimu.recording.quality.false_force import false_force
from pyimu.recording.quality.inspect import force_findings
from pyimu.recording.recording import Recording
from pyimu.units import STANDARD_GRAVITY

H, ROWS = 0.01, 4096
SAID = "accel_x, accel_y, accel_z show a gravity of 1 m/s^2"


@pytest.fixture(scope="module")
def log(tmp_path_factory):
    """A log at rest whose forces are in g, and whose header says m/s^2."""
    draw = np.random.default_rng(8)
    accel = [0.0, 0.0, 1.0] + 1e-3 * draw.normal(size=(ROWS, 3))
    gyro = 2e-3 * draw.normal(size=(ROWS, 3))
    path = tmp_path_factory.mktemp("log") / "rest.csv"
    Recording.from_arrays("rest", time=H * np.arange(ROWS), gyro=gyro, accel=accel).write(path)
    return path


@pytest.mark.parametrize("command", ["close", "attitude", "navigate --part mpu6050"])
def test_what_needs_the_forces_refuses(command, log, pyimu, tmp_path):
    name, *more = command.split()
    code, _, said = pyimu(name, log, *more, "--out", "out")
    assert code == 2 and SAID in said and "write accel_x [g]" in said
    assert not (tmp_path / "out").exists()


def test_characterize_writes_no_part(log, pyimu, tmp_path, undrawn):
    code, said, _ = pyimu("characterize", log, "--out", "out", "--exit-code")
    assert code == 17 and SAID in said and "accelerometer (in a false unit)" in said
    assert (tmp_path / "out/report.html").exists() and not (tmp_path / "out/part.toml").exists()


def test_inspect_proposes_the_map(log, pyimu, undrawn):
    code, said, _ = pyimu("inspect", log, "--write-map", "map.toml")
    assert code == 0 and "--columns map.toml" in said
    code, said, _ = pyimu("characterize", log, "--columns", "map.toml", "--out", "out")
    assert code == 0 and SAID not in said
    white = part("out/part.toml").accel.values["angle_random_walk"]["N"]
    assert np.mean(white) == pytest.approx(1e-3 * STANDARD_GRAVITY * np.sqrt(H), rel=0.1)


def test_a_body_that_turns_every_way_has_the_gravity_of_each_instant():
    """The median of forces that point all round is near zero, or 1 m/s^2, and no gravity: of 60
    bodies that tumble, none is in g, and each is once its forces are.
    """
    for seed in range(60):
        turn = Rotation.random(ROWS // 128, np.random.default_rng(seed))
        force = np.repeat(turn.apply([0.0, 0.0, STANDARD_GRAVITY]), 128, axis=0)
        noise = 0.01 * np.random.default_rng(seed).normal(size=force.shape)
        time, gyro = H * np.arange(ROWS), np.zeros((ROWS, 3))
        log = Recording.from_arrays("tumble", time=time, gyro=gyro, accel=force + noise)
        assert false_force(force_findings(log)) is None, seed
        in_g = replace(log, accel=log.accel / STANDARD_GRAVITY)
        assert false_force(force_findings(in_g)).kind == "force_in_g", seed
