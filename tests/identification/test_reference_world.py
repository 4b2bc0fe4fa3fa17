"""A reference attitude in a world that is not level."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, RotationSpline

import pyimu
from pyimu.identification.reference.level import leaning, uncertain
from pyimu.recording.recording import Recording

H, NOISE = 0.01, 2e-3
NED = Rotation.from_matrix([[0.0, 1, 0], [1, 0, 0], [0, 0, -1]])
FRD = Rotation.from_euler("x", np.pi)
Y_UP = Rotation.from_euler("x", -np.pi / 2)


def sways(seed=0):
    """A hand sways a sensor without fault, in a world of east-north-up."""
    rng, time = np.random.default_rng(seed), np.arange(0.0, 60.0, H)
    frequency, phase = rng.uniform(0.1, 0.8, (3, 4)), rng.uniform(0, 2 * np.pi, (3, 4))
    angle = 2 * np.pi * frequency * time[:, None, None] + phase
    attitude = RotationSpline(time, Rotation.from_rotvec(0.2 * np.sin(angle).sum(axis=2)))
    force = attitude(time).apply([0.0, 0.0, 9.80665], inverse=True)
    return Recording.from_arrays(
        name="hand",
        time=time,
        gyro=attitude(time, 1) + NOISE * rng.standard_normal(force.shape),
        accel=force + 0.02 * rng.standard_normal(force.shape),
        ref_q=attitude(time).as_quat(scalar_first=True),
    )


def turned(recording, world, body=None):
    """The same attitude as another world, and another body, would have it."""
    body = Rotation.identity() if body is None else body
    attitude = world * Rotation.from_quat(recording.ref_q, scalar_first=True) * body
    return replace(recording, ref_q=attitude.as_quat(scalar_first=True))


@pytest.mark.long
@pytest.mark.parametrize(
    "world, body, said",
    [
        (NED, None, "z points down, as in north-east-down"),
        (NED, FRD, "z points down, as in north-east-down"),
        (Y_UP, None, "y points up"),
        (Rotation.from_euler("y", 25, degrees=True), None, "z is 25 deg off the vertical"),
    ],
)
def test_a_world_that_is_not_level_is_said_and_costs_the_attitude_nothing(world, body, said):
    level, closed = (pyimu.close(r) for r in (sways(), turned(sways(), world, body)))
    assert not [r for r in level.remarks if "not level" in r]
    (remark,) = [r for r in closed.remarks if "not level" in r]
    assert said in remark and "loses the attitude" not in closed.report()
    # The mounting, fitted anew, and the heading of the start alone differ.
    assert closed.attitude[1] == pytest.approx(level.attitude[1], rel=0.05)


def test_no_bias_of_an_accelerometer_is_a_leaning_world():
    """A body that never turns: its accelerometer's bias leans as a world would."""
    flat = Rotation.identity(100)
    for share, found in ((0.9, False), (1.1, True)):
        estimate = Rotation.from_rotvec(np.tile([share * uncertain(), 0.0, 0.0], (100, 1)))
        world = leaning(estimate.as_quat(scalar_first=True), flat)
        assert (world is not None) is found
    assert world.tilt == pytest.approx(1.1 * uncertain(), rel=1e-9)


def test_an_attitude_that_is_lost_leans_in_no_world():
    rng = np.random.default_rng(1)
    lost = Rotation.random(500, random_state=rng).as_quat(scalar_first=True)
    assert leaning(lost, Rotation.identity(500)) is None
