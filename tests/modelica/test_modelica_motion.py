"""Drives, attitude and temperature in Modelica against the package's own and closed forms."""

import math

import numpy as np
import pytest
from modelica_cases import simulated, vector
from scipy.spatial.transform import Rotation

from pyimu.rover import drives
from pyimu.rover.indoor import indoor
from pyimu.rover.trajectory import square
from pyimu.symbolic.earth import EARTH_RATE

DRIVES = {"straight": "Straight", "obstacle": "Obstacle", "ackermann": "Ackermann"} | {
    "turn_on_spot": "TurnOnSpot"
}
PERIOD = 0.5
"""s; of the points at which drives are compared."""

ANGLE = 1e-9
"""rad, and m; what the two may differ by. It is the rounding of times of some 1000 s, 1e-13 s, in
degrees of freedom that move by 1e-2 a second, with four digits to spare.
"""


@pytest.mark.parametrize("name", DRIVES)
def test_drive_is_that_of_the_unit(name):
    """On level ground, from the rest before it to the rest after it."""
    own = {"start_time": 20.0, "heading0": 0.4, "roughness": 0.0}
    quick = {"straight": {"cruise_speed": 0.1}, "obstacle": {"cruise_speed": 0.1}}
    quick |= {"ackermann": {"cruise_speed": 0.1}, "turn_on_spot": {"spot_turn_rate": 0.2}}
    want = drives.drive(name, sample_rate=1 / PERIOD, rest=5.0, **own, **quick[name])
    given = ", ".join(
        f"{key}={value}"
        for key, value in {
            "startTime": 20.0,
            "heading0": 0.4,
            "cruiseSpeed" if name != "turn_on_spot" else "spotTurnRate": [*quick[name].values()][0],
        }.items()
    )
    stop = len(want.time) * PERIOD
    text = f"model Test PyImu.Rover.{DRIVES[name]} drive({given}); end Test;"
    rows = simulated("Test", stop, PERIOD, text)
    assert np.ptp(want.position, axis=0).max() > 1.0 or np.ptp(want.yaw) > 1.0
    for mine, theirs, size in (
        ("q", want.q, 4),
        ("rate", want.rate, 3),
        ("specificForce", want.specific_force, 3),
        ("position", want.position, 3),
    ):
        got = vector(rows, f"drive.{mine}", size)[1:]
        np.testing.assert_allclose(got, theirs, rtol=0, atol=ANGLE, err_msg=mine)


def test_square_is_that_of_the_package():
    """A triangle to the right as well, and both seen from another heading at the start."""
    for given, own, heading in (
        ("", {}, 0.0),
        ("legs=3, turn=-2, turnRate=0.5, stops=1, side=1, heading0=0.4", None, 0.4),
    ):
        own = (
            {"legs": 3, "turn": -2.0, "turn_rate": 0.5, "stops": 1.0, "side": 1.0}
            if own is None
            else own
        )
        want = square(sample_rate=4.0, **own)
        text = f"model Test PyImu.Rover.Square drive({given}); end Test;"
        rows = simulated("Test", want.time[-1], 0.25, text)
        turned = Rotation.from_euler("Z", heading)
        got = Rotation.from_quat(vector(rows, "drive.q", 4), scalar_first=True)
        seen = turned * Rotation.from_quat(want.ref_q, scalar_first=True)
        assert (got * seen.inv()).magnitude().max() < ANGLE
        place = np.column_stack([want.ref_east, want.ref_north, want.ref_up])
        np.testing.assert_allclose(
            vector(rows, "drive.position"), turned.apply(place), rtol=0, atol=ANGLE
        )
        if not heading:
            for mine, theirs in (("rate", want.ref_rate), ("specificForce", want.ref_force)):
                np.testing.assert_allclose(
                    vector(rows, f"drive.{mine}"), theirs, rtol=0, atol=ANGLE, err_msg=mine
                )


def test_indoor_drive_is_that_of_the_package():
    """The start-up motion with its slip, the first cycles, and the end, at 10 Hz."""
    h = 0.1
    want = indoor(1 / h, slip=0.01, wander=0.0)
    text = f"model Test PyImu.Rover.Indoor drive(samplePeriod={h}, slip=0.01); end Test;"
    rows = simulated("Test", want.time[-1], h, text)
    for mine, theirs in (
        ("rate[3]", want.rate),
        ("heading", want.heading),
        ("nominalHeading", want.nominal),
        ("standing", want.standing),
    ):
        np.testing.assert_allclose(rows[f"drive.{mine}"], theirs, rtol=0, atol=ANGLE, err_msg=mine)


def test_attitude_is_the_integral_of_the_rate():
    """A constant rate about a slanted axis turns by rate times time (Rodrigues' formula)."""
    rate, stop = np.array([0.3, -0.2, 0.5]), 20.0
    text = """model Test
      PyImu.Attitude.QuaternionKinematics kinematics(q0={0.8, 0.6, 0, 0});
    equation
      kinematics.rate = {0.3, -0.2, 0.5};
    end Test;"""
    rows = simulated("Test", stop, 0.01, text, tolerance=1e-12)
    start = Rotation.from_quat([0.8, 0.6, 0.0, 0.0], scalar_first=True)
    want = start * Rotation.from_rotvec(np.outer(np.arange(2001) * 0.01, rate))
    got = Rotation.from_quat(vector(rows, "kinematics.q", 4), scalar_first=True)
    assert (got * want.inv()).magnitude().max() < 1e-9
    euler = Rotation.from_quat(vector(rows, "kinematics.q", 4), scalar_first=True).as_euler("ZYX")
    np.testing.assert_allclose(vector(rows, "kinematics.euler"), euler[:, ::-1], rtol=0, atol=1e-12)


def test_quaternion_keeps_its_length_for_an_hour():
    text = """model Test
      PyImu.Attitude.QuaternionKinematics kinematics;
    equation
      kinematics.rate = {0.3*sin(0.1*time), -0.2, 0.5*cos(0.07*time)};
    end Test;"""
    rows = simulated("Test", 3600.0, 1.0, text)
    lengths = np.linalg.norm(vector(rows, "kinematics.q", 4), axis=1)
    assert len(lengths) == 3601 and np.abs(lengths - 1).max() <= 1e-12


def test_body_at_rest_on_the_turning_earth_keeps_its_attitude():
    """Its gyros read the Earth's rate, in east-north-up (0, cos, sin) of the latitude."""
    rate = EARTH_RATE * np.array([0.0, math.cos(0.9), math.sin(0.9)])
    values = ", ".join(map(repr, rate.tolist()))
    text = f"""model Test
      PyImu.Attitude.QuaternionKinematics kinematics(turningEarth=true, latitude=0.9);
    equation
      kinematics.rate = {{{values}}};
    end Test;"""
    rows = simulated("Test", 100.0, 1.0, text)
    np.testing.assert_allclose(vector(rows, "kinematics.euler"), 0, rtol=0, atol=1e-12)


def test_alignment_levels_a_body_at_rest():
    want = Rotation.from_euler("ZYX", [0.7, -0.3, 0.4])
    force = ", ".join(map(repr, want.inv().apply([0, 0, 9.81]).tolist()))
    text = f"""model Test
      PyImu.Attitude.Alignment alignment(yaw=0.7);
    equation
      alignment.specificForce = {{{force}}};
    end Test;"""
    got = vector(simulated("Test", 1.0, 1.0, text), "alignment.q", 4)[-1]
    np.testing.assert_allclose(got, want.as_quat(scalar_first=True), rtol=0, atol=1e-15)


def test_error_of_the_attitude_grows_with_the_error_of_the_rate():
    """At rest by rate error times time; Rodrigues' parameters of f = 4 are 4 tan(angle/4)."""
    text = """model Test
      PyImu.Attitude.MrpError error;
    equation
      error.rate = {0, 0, 0};
      error.rateError = {0, 0, 0.01};
    end Test;"""
    rows = simulated("Test", 50.0, 1.0, text, tolerance=1e-12)
    want = 4 * np.tan(0.01 * np.arange(51) / 4)
    np.testing.assert_allclose(rows["error.p[3]"], want, rtol=0, atol=1e-9)


def test_part_warms_up_as_its_time_constant_says():
    """The integral of the differential equation is the exponential of the other block."""
    text = """model Test
      PyImu.Thermal.Heating heating(tau=100, rise=6, start=20);
      PyImu.Thermal.WarmUp warmUp(tau=100, rise=6, start=20);
      PyImu.Thermal.Cycle cycle(period=400);
      PyImu.Thermal.Ramp ramp(duration=200);
    equation
      heating.ambient = 20;
    end Test;"""
    rows, t = simulated("Test", 400.0, 1.0, text, tolerance=1e-12), np.arange(401.0)
    want = 20 + 6 * (1 - np.exp(-t / 100))
    np.testing.assert_allclose(rows["warmUp.temperature"], want, rtol=1e-15)
    np.testing.assert_allclose(rows["heating.temperature"], want, rtol=0, atol=1e-9)
    np.testing.assert_allclose(
        rows["cycle.temperature"], 25 + 10 * np.sin(2 * np.pi * t / 400), rtol=0, atol=1e-13
    )
    np.testing.assert_allclose(rows["ramp.temperature"], np.minimum(15 + 0.1 * t, 35), rtol=1e-15)
