"""Accelerations in g under a header of m/s^2: no command takes them for what they are not."""

from __future__ import annotations

import numpy as np
import pytest

from pyimu.model.part_file import part
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
