"""From the motion in the plane to attitude, rate and specific force, by derivatives."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from pyimu.plant import vibration
from pyimu.plant.ground import boulder, wavy
from pyimu.plant.jet import along
from pyimu.plant.rover_variables import BOULDERS
from pyimu.plant.suspension import Rocker
from pyimu.symbolic import quaternion
from pyimu.symbolic.earth import earth_rate

PLANE = 7
"""Numbers of a motion in the plane: east and north m, heading rad, distance m, speed m/s, turn rate
rad/s, time s."""


@dataclass(frozen=True)
class Pose:
    """Where the body is: attitude ``q`` (4,), ``position`` (3,) m, and the ``lever_arm``'s end.

    The end ``sensor`` (3,) m is in east-north-up axes, as the position is. All are expressions.
    """

    q: ca.SX
    position: ca.SX
    sensor: ca.SX


def pose(plane, found, p, rocker: Rocker) -> Pose:
    """The pose on the ground at ``plane``, a motion in the plane.

    ``found`` are the ground's waves, ``p`` the parameters by name.
    """
    east, north, heading = plane[0], plane[1], plane[2]
    c, s = ca.cos(heading), ca.sin(heading)
    places = [(east + c * x - s * y, north + s * x + c * y) for x, y in rocker.wheels]
    heights = [_height(place, found, p) for place in places]
    roll, pitch, up = rocker.pose(heights)
    turn, push = _shaken(plane, p, rocker.track)
    q = quaternion.product(
        quaternion.from_euler(roll, pitch, heading), quaternion.exponential(turn)
    )
    position = ca.vertcat(east, north, up) + quaternion.rotate(q, push)
    return Pose(q, position, position + quaternion.rotate(q, p["lever_arm"]))


def _height(place, found, p):
    """Height m of the ground at (east, north)."""
    there = ca.logic_or(p["boulders"] != 0, p["drive"] == 2)
    c, s = ca.cos(p["heading0"]), ca.sin(p["heading0"])
    height = p["roughness"] * wavy(found, *place)
    for i in range(BOULDERS):
        forward, left = p["boulder_forward"][i], p["boulder_left"][i]
        middle = (c * forward - s * left, s * forward + c * left)
        height += boulder(
            place[0] - middle[0],
            place[1] - middle[1],
            there * p["boulder_height"][i],
            p["boulder_width"][i],
        )
    return height


def _shaken(plane, p, track):
    """Rotation rad and displacement m (3,) of the body by its motors and wheels."""
    turned, distance, speed, turn_rate, time = (plane[i] for i in range(2, PLANE))
    turned = turned - p["heading0"]
    on = vibration.running(*vibration.wheel_speeds(speed, turn_rate, track))
    motors = vibration.motor_line(time, p["motor_frequency"], on, p["motor_rate"], p["motor_force"])
    wheels = vibration.wheel_line(
        vibration.wheel_speeds(distance, turned, track),
        p["tread_spacing"],
        p["cruise_speed"],
        p["tread_rate"],
        p["tread_force"],
    )
    return tuple(a + b for a, b in zip(motors, wheels, strict=True))


def motion(state, first, second, found, p, rocker: Rocker) -> tuple:
    """The pose at a motion in the plane, rate and specific force (3,) there, and the speed.

    ``state``, ``first`` and ``second`` (``PLANE``,) are symbols of the motion and its derivatives.

    rate = 2 vec(q* q') + R^T omega (Hidalgo 2012, section 4.1; omega of the planet), and
    force = R^T (a + 2 omega x v + g) of the sensor's place with velocity v and acceleration a
    (Groves 2013, eq. 5.53; the centrifugal force is part of gravity).
    """
    at = pose(state, found, p, rocker)
    omega = earth_rate(p["latitude"], p["rotation_rate"])
    turning, _ = along(at.q, state, first, second)
    velocity, acceleration = along(at.sensor, state, first, second)
    gravity = ca.vertcat(0, 0, p["gravity"])
    back = quaternion.conjugate(at.q)
    rate = 2 * quaternion.product(back, turning)[1:4] + quaternion.rotate(back, omega)
    force = quaternion.rotate(back, acceleration + 2 * ca.cross(omega, velocity) + gravity)
    of_origin, _ = along(at.position, state, first, second)
    return at, rate, force, quaternion.rotate(back, of_origin)[0]
