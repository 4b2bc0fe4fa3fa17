"""Unit quaternions (4,), Hamilton, scalar first, from body to world axes: ``v_n = q v_b q*``."""

from __future__ import annotations

import casadi as ca

SMALL = 1e-3
"""rad^2; square of half the angle below which series replace sine and cosine. Their first neglected
terms are 3e-18."""


def product(a, b):
    """The product a b (4,), the rotation by ``b`` followed by that by ``a``; Hamilton's i j = k."""
    av, bv = a[1:4], b[1:4]
    return ca.vertcat(a[0] * b[0] - ca.dot(av, bv), a[0] * bv + b[0] * av + ca.cross(av, bv))


def conjugate(q):
    """The inverse of a unit quaternion, (4,)."""
    return ca.vertcat(q[0], -q[1:4])


def normalized(q):
    """``q`` at unit length.

    After a product one Newton step would do, but the root is exact for any length.
    """
    return q / ca.sqrt(ca.dot(q, q))


def rotate(q, v):
    """The vector ``v`` (3,) of the body in world axes.

    v + 2 w (r x v) + 2 r x (r x v) for q = (w, r).
    """
    t = 2 * ca.cross(q[1:4], v)
    return v + q[0] * t + ca.cross(q[1:4], t)


def to_matrix(q):
    """``R_nb`` (3, 3) with v_n = R_nb v_b; its columns are the rotated axes.

    Markley and Crassidis 2014, eq. 2.125.
    """
    w, x, y, z = (q[i] for i in range(4))
    return ca.vertcat(
        ca.horzcat(1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        ca.horzcat(2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        ca.horzcat(2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    )


def exponential(angle):
    """The rotation by the vector ``angle`` a (3,) rad: (cos(|a|/2), sin(|a|/2) a/|a|).

    It is smooth at zero.

    cos(x) and sin(x)/x are even functions, so both are written in the square of the length: no root
    is taken and no quotient 0/0 formed where their derivatives would not exist.
    """
    square = ca.dot(angle, angle) / 4
    return ca.vertcat(_cosine(square), sinc(square) / 2 * angle)


def derivative(q, rate):
    """q' (4,) of a body that turns at ``rate`` (3,) rad/s in body axes: q (0, rate) / 2.

    Hidalgo 2012, section 4.1, there with the vector part first.
    """
    return product(q, ca.vertcat(0, rate)) / 2


def step_matrix(rate, h):
    """Omega (4, 4) with ``step(q, rate, h)`` = Omega q.

    Hidalgo 2012, section 4.2, Omega of the angular velocity, with rows and columns put scalar
    first.
    """
    turn = exponential(rate * h)
    c, v = turn[0], turn[1:4]
    return ca.vertcat(ca.horzcat(c, -v.T), ca.horzcat(v, c * type(v).eye(3) - ca.skew(v)))


def step(q, rate, h):
    """Attitude (4,) after ``h`` s at the constant body rate ``rate`` (3,) rad/s: q exp(rate h / 2).

    The solution of q' = q (0, rate)/2; Hidalgo 2012, equation of the discrete kinematics, there
    with the vector part first.
    """
    return product(q, exponential(rate * h))


def sinc(square):
    """sin(x)/x of ``square`` = x^2."""
    series = 1 - square / 6 * (1 - square / 20 * (1 - square / 42))
    root = _root(square)
    return ca.if_else(square < SMALL, series, ca.sin(root) / root)


def _cosine(square):
    """cos(x) of ``square`` = x^2."""
    series = 1 - square / 2 * (1 - square / 12 * (1 - square / 30 * (1 - square / 56)))
    return ca.if_else(square < SMALL, series, ca.cos(_root(square)))


def _root(square):
    """The root of ``square``, 1 where the series is used.

    There 0 times an infinite slope would spoil its derivative.
    """
    return ca.sqrt(ca.if_else(square < SMALL, 1, square))


def from_euler(roll, pitch, yaw):
    """The quaternion (4,) of Rz(yaw) Ry(pitch) Rx(roll), angles in rad.

    Yaw is counter-clockwise from east, nose up is negative pitch (REP 103).
    """

    def about(axis: int, angle):
        parts = [ca.cos(angle / 2), 0, 0, 0]
        parts[axis] = ca.sin(angle / 2)
        return ca.vertcat(*parts)

    return product(about(3, yaw), product(about(2, pitch), about(1, roll)))


def to_euler(q):
    """Roll, pitch, yaw (3,) in rad, the inverse of ``from_euler`` for |pitch| < pi/2.

    Pitch is an arc tangent, not an arc sine: it keeps its digits close to +-pi/2, and needs no
    clamp.
    """
    return ca.vertcat(*[ca.atan2(*sides) for sides in euler_sides(q)])


def euler_sides(q) -> tuple:
    """The pairs (y, x) of which roll, pitch and yaw are the arc tangents."""
    w, x, y, z = (q[i] for i in range(4))
    forward_east, forward_north = 1 - 2 * (y * y + z * z), 2 * (x * y + w * z)
    level = ca.sqrt(forward_east * forward_east + forward_north * forward_north)
    # Casadi knows that a root is not below zero. If it did here, pitch would be made in fewer steps
    # than the others, and no longer as lanes of the same vectors.
    return (
        (2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
        (2 * (w * y - x * z), ca.fmax(level, 0)),
        (forward_north, forward_east),
    )
