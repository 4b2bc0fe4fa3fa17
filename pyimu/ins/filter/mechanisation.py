"""Strapdown equations: from rate and specific force to attitude, velocity and position.

World axes are east-north-up at the start, taken as flat: over 1 km gravity tilts by 1.6e-4 rad.
"""

from __future__ import annotations

import casadi as ca

from pyimu.symbolic import quaternion


def turned(q, rates: tuple, earth, h):
    """The attitude (4,) after ``h`` s between two samples of the rate (3,) each, against inertial
    space in body axes.

    The rotation vector of a rate that changes linearly is h (w0 + w1) / 2 + h^2 (w0 x w1) / 12, the
    second term the integral of a x w / 2 over the angle a so far (the coning correction of Savage
    1998, part 1), and the world turns by the Earth's rate (3,) meanwhile.
    """
    before, after = rates
    angle = h / 2 * (before + after) + h * h / 12 * ca.cross(before, after)
    own = quaternion.product(q, quaternion.exponential(angle))
    return quaternion.product(quaternion.exponential(-h * earth), own)


def moved(attitudes: tuple, forces: tuple, velocity, position, earth, gravity, h) -> tuple:
    """Velocity and position (3,) after ``h`` s.

    ``attitudes`` (4,) and ``forces`` (3,), in body axes, are those before and after. v' = R f + g
    - 2 w x v (Groves 2013, eq. 5.53), by the trapezoid of R f in world axes: each force is turned
    by the attitude of its own instant, which has the sculling in it, and over a motion from rest to
    rest the errors of its steps cancel (Euler and Maclaurin).
    """
    force = sum(
        (quaternion.rotate(q, f) for q, f in zip(attitudes, forces, strict=True)), ca.SX.zeros(3)
    )
    force = force / 2
    change = h * (force - ca.vertcat(0, 0, gravity) - 2 * ca.cross(earth, velocity))
    after = velocity + change
    return after, position + h / 2 * (velocity + after)
