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


def wheel_heights(planes: tuple, found, p: dict, rocker: Rocker) -> tuple:
    """Heights (``HEIGHTS``,) m of the wheels over level ground, and two derivatives of them.

    ``planes`` are a motion in the plane (``PLANE``,) and its derivatives, ``found`` the ground's
    waves, ``p`` the parameters by name.
    """
    waves = wavy(found, planes, rocker.wheels, p["roughness"])
    symbols = [ca.SX.sym(name, 3) for name in ("place", "first", "second")]
    there = ca.logic_or(p["boulders"] != 0, p["drive"] == DRIVES["obstacle"])
    for wheel, total in zip(rocker.wheels, waves, strict=True):
        end = _end(symbols[0], wheel)
        moving = [
            ca.substitute(m, ca.vertcat(*symbols), ca.vertcat(*[x[:3] for x in planes]))
            for m in (end, *along(end, *symbols))
        ]
        for i in range(BOULDERS):
            lifts = _boulder(moving, i, there, p)
            for j, lift in enumerate(lifts):
                total[j] += lift
    return tuple(ca.vertcat(*[total[i] for total in waves]) for i in range(3))


def _end(place, wheel: tuple[float, float]):
    """Where a wheel (forward, left) of a body at ``place`` (east, north, heading) is, (2,)."""
    c, s = ca.cos(place[2]), ca.sin(place[2])
    x, y = wheel
    return ca.vertcat(place[0] + c * x - s * y, place[1] + s * x + c * y)


def _boulder(moving: list, i: int, there, p: dict) -> list:
    """Height m by which boulder ``i`` lifts a wheel, and two derivatives.

    ``moving`` are the wheel's place (2,) and its derivatives; ``there`` is 1 where boulders are.
    """
    c, s = ca.cos(p["heading0"]), ca.sin(p["heading0"])
    forward, left = p["boulder_forward"][i], p["boulder_left"][i]
    middle = ca.vertcat(c * forward - s * left, s * forward + c * left)
    place, first, second = moving
    away = place - middle
    squares = [
        ca.dot(away, away),
        2 * ca.dot(away, first),
        2 * (ca.dot(first, first) + ca.dot(away, second)),
    ]
    symbols = [ca.SX.sym(name) for name in ("square", "first", "second")]
    lift = boulder(symbols[0], there * p["boulder_height"][i], p["boulder_width"][i])
    lifts = [lift, *along(lift, *symbols)]
    return ca.substitute(lifts, symbols, squares)


def attitude(plane, heights, p: dict, rocker: Rocker) -> tuple:
    """The attitude (4,) at a motion in the plane (``PLANE``,) over wheels at ``heights``.

    And the height m of the body's origin, and the displacement (3,) m in body axes by which it is
    shaken.
    """
    roll, pitch, up = rocker.pose(heights)
    turn, push = _shaken(plane, p, rocker.track)
    q = quaternion.from_euler(roll, pitch, plane[2])
    return quaternion.product(q, quaternion.exponential(turn)), up, push


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


@dataclass(frozen=True)
class Motion:
    """Attitude ``q`` (4,), ``position`` (3,) m, ``rate`` and specific ``force`` (3,), ``speed``."""

    q: ca.SX
    position: ca.SX
    rate: ca.SX
    force: ca.SX
    speed: ca.SX


def motion(planes: tuple, found, p: dict, rocker: Rocker) -> Motion:
    """The motion of the body on the ground, by derivatives of its attitude and its place.

    ``planes`` are a motion in the plane (``PLANE``,) and its derivatives.

    With the turn rate w = 2 vec(q* q') (Hidalgo 2012, section 4.1) and its derivative
    a = 2 vec(q* q''), both in body axes, rate = w + R^T o with the planet's rate o, and
    force = R^T (x'' + 2 o x v + g) + d'' + 2 w x d' + a x r + w x (w x r), where r = arm + d is
    the sensor's place in the body, shaken by d, and v = x' + R (d' + w x r) its velocity (Groves
    2013, eq. 2.110 and 5.53; the centrifugal force of the planet is part of gravity).
    """
    q, up, push = _derivatives(planes, found, p, rocker)
    back = quaternion.conjugate(q[0])
    w, a = (2 * quaternion.product(back, x)[1:4] for x in q[1:])
    place, velocity, acceleration = (
        ca.vertcat(plane[:2], height) for plane, height in zip(planes, up, strict=True)
    )
    arm = p["lever_arm"] + push[0]
    omega = quaternion.rotate(back, earth_rate(p["latitude"], p["rotation_rate"]))
    forward = quaternion.rotate(back, velocity)
    felt = quaternion.rotate(back, acceleration + ca.vertcat(0, 0, p["gravity"]))
    swing = ca.cross(w, arm)
    coriolis = 2 * ca.cross(omega, forward + push[1] + swing)
    of_arm = push[2] + 2 * ca.cross(w, push[1]) + ca.cross(a, arm) + ca.cross(w, swing)
    return Motion(
        q[0],
        place + quaternion.rotate(q[0], push[0]),
        w + omega,
        felt + coriolis + of_arm,
        (forward + push[1] + ca.cross(w, push[0]))[0],
    )


def _derivatives(planes: tuple, found, p: dict, rocker: Rocker) -> list[list]:
    """Each result of ``attitude`` with its first two derivatives in time."""
    heights = wheel_heights(planes, found, p, rocker)
    symbols = [ca.SX.sym(name, PLANE + HEIGHTS) for name in ("state", "first", "second")]
    results = attitude(symbols[0][:PLANE], symbols[0][PLANE:], p, rocker)
    values = [ca.vertcat(a, b) for a, b in zip(planes, heights, strict=True)]
    return [
        ca.substitute([result, *along(result, *symbols)], symbols, values) for result in results
    ]
