"""Headings that are something else than their header says are found by the gyro's turns, said, and
not used; headings that are noisy, late or of a tilted body are left alone.
"""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pyimu import Recording, attitude
from pyimu.attitude.headed import heading_findings

N, H = 6000, 0.01
TIME = H * np.arange(N)
RATE = np.where(TIME < 5, 0.0, 0.5 * np.sin(2 * np.pi * TIME / 17))
YAW = np.cumsum(RATE) * H


def log(heading, tilt=(0.0, 0.0, 0.0), **more) -> Recording:
    """A body that turns to and fro about the vertical, mounted with a tilt; headings in rad."""
    rng = np.random.default_rng(5)
    mounted = Rotation.from_rotvec(tilt)
    zero = np.zeros(N)
    gyro = mounted.apply(np.column_stack([zero, zero, RATE])) + [0.01, -0.02, 0.015]
    accel = mounted.apply(np.tile([0.0, 0.0, 9.81], (N, 1)))
    return Recording.from_arrays(
        time=TIME,
        gyro=gyro + rng.normal(0, 1e-3, (N, 3)),
        accel=accel + rng.normal(0, 0.02, (N, 3)),
        heading=heading,
        **more,
    )


NOISE = np.random.default_rng(6).normal(0, 0.03, N)
WRONG = {
    "degrees": (np.degrees(YAW + NOISE), "write heading [deg]"),
    "degrees from 0 to 360": (np.degrees(np.mod(YAW + NOISE, 2 * np.pi)), "write heading [deg]"),
    "compass": (np.pi / 2 - YAW + NOISE, "90 deg less the compass heading"),
    "compass in degrees": (np.degrees(np.mod(np.pi / 2 - YAW, 2 * np.pi)), "write heading [deg]"),
}


@pytest.mark.parametrize("tilt", [(0.0, 0.0, 0.0), (0.7, 0.0, 0.0), (np.pi, 0.0, 0.0)])
@pytest.mark.parametrize("case", WRONG)
def test_headings_of_another_reading_are_named(case, tilt):
    (found,) = heading_findings(log(WRONG[case][0], tilt))
    assert found.kind == "heading_reading" and case.startswith(found.detail["as"])


@pytest.mark.parametrize("case", WRONG)
def test_they_are_said_and_not_used(case):
    heading, said = WRONG[case]
    result = attitude.run(log(heading))
    assert said in result.report() and not [e for e in result.events if e.bit == 64]
    np.testing.assert_array_equal(result.q, attitude.run(log(None)).q)


RIGHT = {
    "as stated": YAW + NOISE,
    "modulo a turn": np.mod(YAW, 2 * np.pi),
    "noise as large as the turns": YAW + np.random.default_rng(7).normal(0, 1.0, N),
    "half a second late": np.roll(YAW, 50),
    "nothing but noise": np.random.default_rng(8).uniform(-np.pi, np.pi, N),
    "one in ten": np.where(np.arange(N) % 10, np.nan, YAW),
    "one alone": np.where(np.arange(N), np.nan, YAW),
}


@pytest.mark.parametrize("case", RIGHT)
def test_others_are_left_alone(case):
    assert heading_findings(log(RIGHT[case])) == ()


def test_a_body_that_does_not_turn_shows_nothing():
    still = Recording.from_arrays(
        time=TIME,
        gyro=np.random.default_rng(1).normal(0, 1e-3, (N, 3)),
        accel=np.tile([0.0, 0.0, 9.81], (N, 1)),
        heading=np.degrees(NOISE),
    )
    assert heading_findings(still) == ()


@pytest.mark.parametrize("name, of", [("heading_std", "heading"), ("speed_std", "speed")])
def test_a_column_that_says_nothing_alone_is_said(name, of):
    result = attitude.run(log(None, **{name: np.full(N, 0.1)}))
    assert f"the column {name} has no column {of} beside it" in result.report()


def test_a_log_without_accelerometer_is_said():
    gyro = np.random.default_rng(1).normal(0, 1e-3, (N, 3))
    assert "no accelerometer" in attitude.run(Recording.from_arrays(time=TIME, gyro=gyro)).report()
