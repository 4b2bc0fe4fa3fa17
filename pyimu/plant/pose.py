"""From the motion in the plane to attitude, rate and specific force, by derivatives."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from pyimu.plant import vibration
from pyimu.plant.ground import boulder, wavy
from pyimu.plant.jet import along
from pyimu.plant.rover_variables import BOULDERS, DRIVES
from pyimu.plant.suspension import Rocker
from pyimu.symbolic import quaternion
from pyimu.symbolic.earth import earth_rate

PLANE = 7
"""Numbers of a motion in the plane: east and north m, heading rad, distance m, speed m/s, turn rate
rad/s, time s."""


HEIGHTS = 6
"""The heights of the wheels, which with the motion in the plane are the body's state."""


def wheel_heights(plane, first, second, found, p: dict, rocker: Rocker) -> tuple:
    """Heights (``HEIGHTS``,) m of the wheels over level ground, and two derivatives of them.

    ``plane``, ``first`` and ``second`` (``PLANE``,) are symbols of a motion in the plane and its
    derivatives, ``found`` the ground's waves, ``p`` the parameters by name.
    """
    c, s = ca.cos(plane[2]), ca.sin(plane[2])
    ends = [
        ca.vertcat(plane[0] + c * x - s * y, plane[1] + s * x + c * y) for x, y in rocker.wheels
    ]
    moving = [along(end, plane, first, second) for end in ends]
    waves = wavy(found, (plane[0], plane[1]), plane[2], rocker.wheels, moving)
    here, velocity, acceleration = (ca.SX.sym(name, 2) for name in ("here", "v", "a"))
    lift = _boulders(here, p)
    lifts = [lift, *along(lift, here, velocity, acceleration)]
    lifted = [
        ca.substitute(lifts, [here, velocity, acceleration], [end, *motion])
        for end, motion in zip(ends, moving, strict=True)
    ]
    return tuple(
        ca.vertcat(*[p["roughness"] * w[i] + b[i] for w, b in zip(waves, lifted, strict=True)])
        for i in range(3)
    )


def _boulders(place, p: dict):
    """Height m of the boulders at a place (2,), east and north."""
    there = ca.logic_or(p["boulders"] != 0, p["drive"] == DRIVES["obstacle"])
    c, s = ca.cos(p["heading0"]), ca.sin(p["heading0"])
    height = 0
    for i in range(BOULDERS):
        forward, left = p["boulder_forward"][i], p["boulder_left"][i]
        height += boulder(
            place[0] - (c * forward - s * left),
            place[1] - (s * forward + c * left),
            there * p["boulder_height"][i],
            p["boulder_width"][i],
        )
    return height


@dataclass(frozen=True)
class Pose:
    """Where the body is: attitude ``q`` (4,), ``position`` (3,) m, and the ``lever_arm``'s end.

    The end ``sensor`` (3,) m is in east-north-up axes, as the position is. All are expressions.
    """

    q: ca.SX
    position: ca.SX
    sensor: ca.SX


def pose(plane, heights, p: dict, rocker: Rocker) -> Pose:
    """The pose at a motion in the plane (``PLANE``,) over wheels at ``heights`` (``HEIGHTS``,)."""
    roll, pitch, up = rocker.pose(heights)
    turn, push = _shaken(plane, p, rocker.track)
    q = quaternion.product(
        quaternion.from_euler(roll, pitch, plane[2]), quaternion.exponential(turn)
    )
    position = ca.vertcat(plane[0], plane[1], up) + quaternion.rotate(q, push)
    return Pose(q, position, position + quaternion.rotate(q, p["lever_arm"]))


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


def motion(plane, first, second, found, p: dict, rocker: Rocker) -> tuple:
    """The pose at a motion in the plane, rate and specific force (3,) there, and the speed.

    ``plane``, ``first`` and ``second`` (``PLANE``,) are symbols of the motion and its derivatives.

    rate = 2 vec(q* q') + R^T omega (Hidalgo 2012, section 4.1; omega of the planet), and
    force = R^T (a + 2 omega x v + g) of the sensor's place with velocity v and acceleration a
    (Groves 2013, eq. 5.53; the centrifugal force is part of gravity).
    """
    heights = [ca.SX.sym(name, HEIGHTS) for name in ("heights", "rising", "bending")]
    state, velocities, accelerations = (
        ca.vertcat(a, b) for a, b in zip((plane, first, second), heights, strict=True)
    )
    at = pose(plane, heights[0], p, rocker)
    omega = earth_rate(p["latitude"], p["rotation_rate"])
    turning, _ = along(at.q, state, velocities, accelerations)
    velocity, acceleration = along(at.sensor, state, velocities, accelerations)
    of_origin, _ = along(at.position, state, velocities, accelerations)
    gravity = ca.vertcat(0, 0, p["gravity"])
    back = quaternion.conjugate(at.q)
    shown = [
        at.q,
        at.position,
        2 * quaternion.product(back, turning)[1:4] + quaternion.rotate(back, omega),
        quaternion.rotate(back, acceleration + 2 * ca.cross(omega, velocity) + gravity),
        quaternion.rotate(back, of_origin)[0],
    ]
    on_ground = wheel_heights(plane, first, second, found, p, rocker)
    return tuple(ca.substitute(shown, heights, list(on_ground)))
