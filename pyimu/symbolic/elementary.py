"""Elementary functions as plain arithmetic: no call, no branch, and so the same bits everywhere.

A function of the C library ends in other bits in another library, and takes about as long. These
are right to two units of the last place, ``tangent``, ``exponential_less_one`` and the hyperbolic
ones to five. Angles that are not finite, nor the sides of one, give no number.

Polynomials: Moshier 1989, Methods and Programs for Mathematical Functions (Cephes 2.8: sin.c,
atan.c, exp.c, log.c).
"""

from __future__ import annotations

from collections.abc import Sequence
from math import inf, nan, pi

import casadi as ca

SINE = (
    1.58962301576546568060e-10,
    -2.50507477628578072866e-8,
    2.75573136213857245213e-6,
    -1.98412698295895385996e-4,
    8.33333333332211858878e-3,
    -1.66666666666666307295e-1,
)
COSINE = (
    -1.13585365213876817300e-11,
    2.08757008419747316778e-9,
    -2.75573141792967388112e-7,
    2.48015872888517045348e-5,
    -1.38888888888730564116e-3,
    4.16666666666665929218e-2,
)
"""sin r = r + r z S(z) and cos r = 1 - z/2 + z^2 C(z) with z = r^2 up to r = pi/4, powers of z
falling."""

QUARTER = (1.57079625129699707031, 7.54978941586159635336e-8, 5.39030285815811905290e-15)
"""pi/2 in three parts; of the first two the multiples up to 2^29 are exact."""

EXP_UPPER = (1.26177193074810590878e-4, 3.02994407707441961300e-2, 9.99999999999999999910e-1)
EXP_LOWER = (
    3.00198505138664455042e-6,
    2.52448340349684104192e-3,
    2.27265548208155028766e-1,
    2.00000000000000000009,
)
"""exp r - 1 = 2 r U(z) / (L(z) - r U(z)) with z = r^2 up to r = log(2)/2."""

LOG_2, ONE_OVER_LOG_2 = (6.93145751953125e-1, 1.42860682030941723212e-6), 1.4426950408889634

LOG_UPPER = (
    1.01875663804580931796e-4,
    4.97494994976747001425e-1,
    4.70579119878881725854,
    1.44989225341610930846e1,
    1.79368678507819816313e1,
    7.70838733755885391666,
)
LOG_LOWER = (
    1.0,
    1.12873587189167450590e1,
    4.52279145837532221105e1,
    8.29875266912776603211e1,
    7.11544750618563894466e1,
    2.31251620126765340583e1,
)
"""log(1 + x) = x - x^2/2 + x^3 U(x) / L(x) from the root of 1/2 to that of 2."""

LOG_2_COARSE = (0.693359375, -2.121944400546905827679e-4)

TANGENT_UPPER = (
    -8.750608600031904122785e-1,
    -1.615753718733365076637e1,
    -7.500855792314704667340e1,
    -1.228866684490136173410e2,
    -6.485021904942025371773e1,
)
TANGENT_LOWER = (
    1.0,
    2.485846490142306297962e1,
    1.650270098316988542046e2,
    4.328810604912902668951e2,
    4.853903996359136964868e2,
    1.945506571482613964425e2,
)
"""atan t = t + t z U(z) / L(z) with z = t^2 up to t = ``FLAT``."""

FLAT = 0.66
"""t beyond which pi/4 + atan((t - 1)/(t + 1)) is taken."""

TINY = 1e-300
"""Added to the larger of two numbers, which it changes only where both are zero."""

BITS = range(9, -1, -1)
"""Of the exponent of a double, the largest first."""

LARGEST = 1023.0
"""The largest exponent of a double; the smallest of one with all its bits is -1022."""


def sine(x):
    """The sine of ``x`` rad."""
    return _of_quarter(*_reduced(x))


def cosine(x):
    """The cosine of ``x`` rad."""
    k, r = _reduced(x)
    return _of_quarter(k + 1, r)


def tangent(x):
    """The tangent of ``x`` rad."""
    return sine(x) / cosine(x)


def arc_tangent(y, x):
    """The angle of (x, y) in rad, -pi to pi, to two units of the last place; 0 for zeros."""
    across, along = ca.fabs(y), ca.fabs(x)
    steep = across > along
    less, more = steep * along + (1 - steep) * across, steep * across + (1 - steep) * along + TINY
    large = less > FLAT * more
    t = (less - large * more) / (more + large * less)
    square = t * t
    angle = (
        t
        + t * (square * _estrin(square, TANGENT_UPPER) / _estrin(square, TANGENT_LOWER))
        + large * (pi / 4)
    )
    # The magnitude of a difference is the one or the other, without a choice.
    angle = ca.fabs(steep * (pi / 2) - angle)
    return ca.copysign(ca.fabs((x < 0) * pi - angle), y)


def arc_sine(x):
    """The angle in rad, -pi/2 to pi/2, whose sine is ``x``."""
    return arc_tangent(x, ca.sqrt((1 - x) * (1 + x)))


def arc_cosine(x):
    """The angle in rad, 0 to pi, whose cosine is ``x``."""
    return arc_tangent(ca.sqrt((1 - x) * (1 + x)), x)


def exponential(x):
    """e to the power ``x``; 0 where that has fewer bits than others (x < -708), inf from 709 on."""
    return _scaled(x, lambda below, scale: (1 + below) * scale)


def exponential_less_one(x):
    """e to the power ``x``, less 1."""
    return _scaled(x, lambda below, scale: below * scale + (scale - 1))


def hyperbolic_tangent(x):
    less = exponential_less_one(-2 * ca.fabs(x))
    return ca.copysign(-less / (less + 2), x)


def hyperbolic_sine(x):
    more, less = (exponential_less_one(sign * ca.fabs(x)) for sign in (1, -1))
    return ca.copysign((more - less) / 2, x)


def hyperbolic_cosine(x):
    return (exponential(x) + exponential(-x)) / 2


def logarithm(x):
    """The natural logarithm of ``x``; -inf of 0, no number of what is below."""
    m, exponent = x, 0
    for bit in BITS:
        power = 2.0**2**bit
        large, small = m >= power, m * power < 1
        m = m * ca.if_else(large, 1 / power, ca.if_else(small, power, 1))
        exponent += 2**bit * (large - small)
    # From 1 to 2, but of what was one below: bring it about 1.
    low = m < 1
    m, exponent = m * (1 + low), exponent - low
    high = m > 2**0.5
    m, exponent = m * (1 - high / 2), exponent + high
    r = m - 1
    z = r * r
    y = r * (z * _horner(r, LOG_UPPER) / _horner(r, LOG_LOWER))
    y = y + exponent * LOG_2_COARSE[1] - z / 2
    found = r + y + exponent * LOG_2_COARSE[0]
    none = ca.if_else(x == 0, -inf, ca.if_else(x > 0, x, nan))
    return ca.if_else(ca.logic_and(x > 0, x < inf), found, none)


def _reduced(x):
    """k and r with x = k pi/2 + r, k whole and r within pi/4."""
    k = ca.floor(x * (2 / pi) + 0.5)
    for part in QUARTER:
        x = x - k * part
    return k, x


def _of_quarter(k, r):
    """sin(k pi/2 + r)."""
    z = r * r
    s = r + r * (z * _horner(z, SINE))
    c = 1 - z / 2 + z * z * _horner(z, COSINE)
    k = k - 4 * ca.floor(k / 4)
    turned, back = k - 2 * ca.floor(k / 2), k >= 2
    return (1 - 2 * back) * ca.if_else(turned, c, s)


def _scaled(x, of):
    """``of(exp r - 1, 2^k)`` with x = k log 2 + r, k whole."""
    k = ca.floor(x * ONE_OVER_LOG_2 + 0.5)
    r = x
    for part in LOG_2:
        r = r - k * part
    z = r * r
    upper = r * _horner(z, EXP_UPPER)
    below = 2 * upper / (_horner(z, EXP_LOWER) - upper)
    left, scale = ca.fmin(ca.fabs(k), LARGEST), 1.0
    for bit in BITS:
        set_ = left >= 2**bit
        left = left - set_ * 2**bit
        scale = scale * (1 + set_ * (2.0**2**bit - 1))
    inside = ca.if_else(k < 0, of(below, 1 / scale), of(below, scale))
    outside = ca.if_else(k > 0, inf, ca.if_else(k <= 0, of(0.0, 0.0), x))
    return ca.if_else(ca.logic_and(k <= LARGEST, k > -LARGEST), inside, outside)


def _horner(x, coefficients: Sequence[float]):
    total = coefficients[0]
    for coefficient in coefficients[1:]:
        total = total * x + coefficient
    return total


def _estrin(x, coefficients: Sequence[float]):
    """The same as ``_horner`` by pairs, in fewer operations one after the other (Estrin 1960).

    A filter's step ends with its angles, and the next one waits as long as these do.
    """
    while len(coefficients) > 1:
        alone = len(coefficients) % 2
        pairs = zip(coefficients[alone::2], coefficients[alone + 1 :: 2], strict=True)
        coefficients = [*coefficients[:alone], *(a * x + b for a, b in pairs)]
        x = x * x
    return coefficients[0]
