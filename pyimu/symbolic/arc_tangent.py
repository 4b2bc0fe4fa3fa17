"""The arc tangent of two numbers as plain arithmetic: no call, no branch, the same bits always."""

from __future__ import annotations

from math import pi

import casadi as ca

UPPER = (
    -8.750608600031904122785e-1,
    -1.615753718733365076637e1,
    -7.500855792314704667340e1,
    -1.228866684490136173410e2,
    -6.485021904942025371773e1,
)
LOWER = (
    1.0,
    2.485846490142306297962e1,
    1.650270098316988542046e2,
    4.328810604912902668951e2,
    4.853903996359136964868e2,
    1.945506571482613964425e2,
)
"""atan(t) = t + t z U(z) / L(z) with z = t^2 up to t = ``LARGEST``, powers of z falling (Moshier
1989, Methods and Programs for Mathematical Functions; Cephes 2.8, atan.c)."""

LARGEST = 0.66
"""t beyond which pi/4 + atan((t - 1)/(t + 1)) is taken."""

TINY = 1e-300
"""Added to the larger of two numbers, which it changes only where both are zero."""


def arc_tangent(y, x):
    """The angle of (x, y) in rad, -pi to pi, to two units of the last place; 0 for zeros.

    A function of the C library takes longer than all of this arithmetic, and ends in other bits in
    another library.
    """
    across, along = ca.fabs(y), ca.fabs(x)
    steep = across > along
    less, more = steep * along + (1 - steep) * across, steep * across + (1 - steep) * along + TINY
    large = less > LARGEST * more
    t = (less - large * more) / (more + large * less)
    square = t * t
    angle = t + t * (square * _horner(square, UPPER) / _horner(square, LOWER)) + large * (pi / 4)
    # The magnitude of a difference is the one or the other, without a choice.
    angle = ca.fabs(steep * (pi / 2) - angle)
    return ca.copysign(ca.fabs((x < 0) * pi - angle), y)


def _horner(x, coefficients):
    total = coefficients[0]
    for coefficient in coefficients[1:]:
        total = total * x + coefficient
    return total
