"""Headings that are something else than their header says are found by the gyro's turns, said, and
not used; headings that are noisy, late or of a tilted body are left alone.
"""

from dataclasses import replace

import numpy as np
import pytest
from attitude_cases import attitude_after
from scipy.spatial.transform import Rotation
from test_attitude_speed import vehicle

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


def turning(rate, seed=4) -> tuple[Recording, np.ndarray]:
    """A body that turns by ``rate`` (n, 3) rad/s in place, and its yaw (n,); no heading yet."""
    world = attitude_after(np.asarray(rate))
    gyro, accel = rate, world.apply([0, 0, 9.81], inverse=True)
    rng = np.random.default_rng(seed)
    gyro = gyro + [0.01, -0.02, 0.015] + rng.normal(0, 1e-3, (len(rate), 3))
    accel = accel + rng.normal(0, 0.02, (len(rate), 3))
    recording = Recording.from_arrays(time=H * np.arange(len(rate)), gyro=gyro, accel=accel)
    return recording, world.as_euler("ZYX")[:, 0]


def hand() -> np.ndarray:
    """Rates (n, 3) of a hand that rolls and pitches by half a radian and yaws by less."""
    phase = 2 * np.pi * TIME[:, None] * [0.71, 0.53, 0.23] + [0.3, 1.2, 2.0]
    return np.where(TIME[:, None] < 5, 0.0, np.array([2.0, 1.6, 0.6]) * np.cos(phase))


def robot() -> np.ndarray:
    """Rates (n, 3) of a robot that stands and drives, and turns four times by 90 deg."""
    turns = (TIME % 15 > 8) & (TIME % 15 < 10.5)
    return np.column_stack([0 * TIME, 0 * TIME, np.where(turns, np.pi / 5, 0.0)])


READ = {
    "compass": lambda yaw: np.pi / 2 - yaw,
    "degrees": lambda yaw: np.degrees(np.mod(yaw, 2 * np.pi)),
}


@pytest.mark.parametrize("kind", READ)
@pytest.mark.parametrize("motion", [hand, robot])
def test_of_a_hand_and_of_few_turns_too(motion, kind):
    recording, yaw = turning(motion())
    assert heading_findings(replace(recording, heading=yaw + NOISE)) == ()
    (found,) = heading_findings(replace(recording, heading=READ[kind](yaw + NOISE)))
    assert found.detail["as"] == kind


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("rate", [0.0, 0.01, 0.02, 0.5])
def test_an_even_turn_tells_no_reading(rate, seed):
    """A gyro's bias is one, too: a slow turn against it looks like one that goes back."""
    steady = np.column_stack([0 * TIME, 0 * TIME, np.full(N, rate)])
    recording, yaw = turning(steady, seed)
    recording = replace(recording, gyro=recording.gyro - [0, 0, 3 * rate])
    noise = np.random.default_rng(seed).normal(0, 0.03, N)
    assert heading_findings(replace(recording, heading=yaw + noise)) == ()


def test_of_a_vehicle_they_are_left_alone():
    """Pushes of seconds tilt what the forces call the vertical."""
    world, _ = vehicle()
    yaw = world.attitude.as_euler("ZYX")[:, 0]
    recording = Recording.from_arrays(time=TIME, gyro=world.rate, accel=world.force)
    assert heading_findings(replace(recording, heading=yaw + NOISE)) == ()
    (found,) = heading_findings(replace(recording, heading=NOISE - yaw))
    assert found.detail["as"] == "compass"


def test_headings_that_come_late_with_their_age_are_of_that_time():
    """Two seconds late, a turn to and fro of four seconds would be its own mirror image."""
    wave = np.column_stack([0 * TIME, 0 * TIME, np.cos(2 * np.pi * TIME / 4)])
    recording, yaw = turning(wave)
    late = replace(recording, heading=np.roll(yaw, 200), heading_age=np.full(N, 2.0))
    assert heading_findings(late.slice(200, None)) == ()


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
