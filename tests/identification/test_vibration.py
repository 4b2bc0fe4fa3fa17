"""Vibration that gyro and accelerometer feel together."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, RotationSpline

import pyimu
from pyimu.identification.logs.vibration import lines, vibrations
from pyimu.recording.recording import Recording

TIME = np.arange(0.0, 60.0, 0.01)


def log(frequency, size):
    """White noise of one unit, a slow turn, and a line of ``size`` units that both feel."""
    rng = np.random.default_rng(4)
    wave = size * np.sin(2 * np.pi * frequency * TIME)[:, None] * [1.0, 0.5, -0.3]
    turn = 30 * np.sin(2 * np.pi * 0.5 * TIME)[:, None]
    gyro, accel = (rng.standard_normal((len(TIME), 3)) + turn + wave for _ in range(2))
    return Recording.from_arrays(name="log", time=TIME, gyro=gyro, accel=accel)


@pytest.mark.parametrize("frequency", [12.0, 30.0, 45.0])
def test_a_line_that_both_feel_is_found_where_it_is(frequency):
    """Frames of 2 s under a Hann window spread a line over 2 Hz."""
    (found,) = vibrations(log(frequency, 3.0))
    assert found.kind == "vibration"
    assert abs(found.detail["least_frequency"] - frequency) <= 2.0
    assert abs(found.detail["largest_frequency"] - frequency) <= 2.0


@pytest.mark.parametrize("frequency, size", [(30.0, 0.0), (5.0, 3.0)])
def test_noise_and_motion_are_no_vibration(frequency, size):
    assert not list(vibrations(log(frequency, size)))


def test_a_line_that_one_axis_has_is_told():
    """What no reference reaches is noise for it; white it was taken for eight times the gyro's."""
    still = log(30.0, 0.0)
    assert not list(lines(still))
    gyro = np.array(still.gyro)
    gyro[:, 1] += 5.0 * np.sin(2 * np.pi * 23.4 * TIME)
    (said,) = lines(replace(still, gyro=gyro))
    assert (said.kind, said.column, said.count) == ("line", "gyro_y", 1)
    assert said.detail["frequency"] == pytest.approx(23.4, abs=0.01)
    assert said.detail["rms"] == pytest.approx(5.0 / np.sqrt(2), rel=0.02)


def test_the_noise_of_a_part_has_no_line_in_it():
    """White noise of 0.04 deg/s, and a line of 0.3 deg/s, beside attitudes."""
    rng = np.random.default_rng(6)
    angle = 0.5 * np.sin(2 * np.pi * np.outer(TIME, [0.31, 0.43, 0.27]))
    turn = Rotation.from_euler("ZYX", angle)
    gyro = RotationSpline(TIME, turn)(TIME, 1) + 7e-4 * rng.standard_normal((len(TIME), 3))
    gyro[:, 1] += np.radians(0.3) * np.sin(2 * np.pi * 23.4 * TIME)
    q = (turn * Rotation.from_rotvec(3e-4 * rng.standard_normal(gyro.shape))).as_quat()
    log = Recording.from_arrays("line", time=TIME, gyro=gyro, ref_q=np.roll(q, 1, axis=1))
    closed = pyimu.close(log)
    assert [f.column for f in closed.quality if f.kind == "line"] == ["gyro_y"]
    found = np.asarray(closed.after.gyro.values["angle_random_walk"]["N"])
    assert found == pytest.approx(7e-4 * 0.1, rel=0.1)
