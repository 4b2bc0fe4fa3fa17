"""Generalised Rodrigues parameters: p = f r / (a + w) for the quaternion (w, r).

They are a small rotation as three numbers.

``a`` = ``f`` = 1 are the modified Rodrigues parameters, ``a`` = 0 and ``f`` = 1 the Gibbs vector.
With ``f`` = 2 (a + 1) the vector p is the rotation vector in rad to second order, so that its
covariance is in rad^2.
"""

from __future__ import annotations

import casadi as ca

A = 1.0
"""The package's own; with a = 1 the singularity is a whole turn away."""

F = 2 * (A + 1)
"""The package's own; p is then in rad."""


def from_quaternion(q, a: float = A, f: float = F):
    """p (3,) of the unit quaternion ``q`` (4,).

    Hidalgo 2012, equation of the delta quaternion; Crassidis and Markley 2003, eq. 16.
    """
    return f * q[1:4] / (a + q[0])


def to_quaternion(p, a: float = A, f: float = F):
    """The unit quaternion (4,) of ``p`` (3,), the inverse of ``from_quaternion``.

    Crassidis and Markley 2003, eqs. 21.
    """
    square = ca.dot(p, p)
    w = (f * ca.sqrt(f * f + (1 - a * a) * square) - a * square) / (f * f + square)
    return ca.vertcat(w, (a + w) / f * p)


def share(a: float = A, f: float = F):
    """The factor f / (2 (a + 1)) from a small rotation vector to p.

    It is 1 at the package's own scaling, 1/4 at f = a = 1.
    """
    return f / (2 * (a + 1))


def error_derivative(p, rate, rate_error, a: float = A, f: float = F):
    """p' (3,) of the attitude error p (3,) in body axes, truth = estimate p.

    The estimate turns at ``rate`` (3,) rad/s.

    ``rate_error`` (3,) is the true rate less ``rate``. Exact for an error of any size; to first
    order p' = -rate x p + share(a, f) rate_error (Crassidis and Markley 2003, section III, has the
    linear part). With rates against inertial space it holds in any turning frame, because a known
    Earth rate turns truth and estimate alike.
    """
    w = to_quaternion(p, a, f)[0]
    return (
        -ca.cross(rate, p)
        + (f * w / (a + w) * rate_error + ca.cross(p, rate_error) + p * ca.dot(p, rate_error) / f)
        / 2
    )
