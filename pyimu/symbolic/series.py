"""Smooth functions for discretisation: Stumpff's for a turn, phi for a decay."""

from __future__ import annotations

from math import factorial

import casadi as ca

TURN, TURN_TERMS = 4.0, 13
"""z of ``stumpff``, the square of an angle, below which a series replaces the closed form, which
loses digits with powers of 1/z; and the terms of that series, whose rest is below 1e-17."""

DECAY, DECAY_TERMS = 1.0, 19
"""The same for ``phi``."""


def stumpff(k: int, z):
    """c_k(z) = 1/k! - z/(k+2)! + z^2/(k+4)! - ... for z >= 0.

    c_0 = cos(x), c_1 = sin(x)/x, c_2 = (1 - cos(x))/x^2 and so on with x^2 = z (Stumpff 1959;
    Battin 1999, section 4.5).
    """
    safe = ca.if_else(z < TURN, 1, z)
    root = ca.sqrt(safe)
    closed = ca.cos(root) if k % 2 == 0 else ca.sin(root) / root
    for i in range(k % 2, k, 2):
        closed = (1 / factorial(i) - closed) / safe
    return ca.if_else(
        z < TURN, _series(z, [factorial(k + 2 * i) for i in range(TURN_TERMS)]), closed
    )


def phi(k: int, z):
    """phi_k(-z) = 1/k! - z/(k+1)! + z^2/(k+2)! - ... for z >= 0.

    phi_0 = exp(-z), phi_1 = (1 - exp(-z))/z and so on (Hochbruck and Ostermann 2010, eq. 2.10).
    """
    safe = ca.if_else(z < DECAY, 1, z)
    closed = ca.exp(-safe)
    for i in range(k):
        closed = (1 / factorial(i) - closed) / safe
    return ca.if_else(z < DECAY, _series(z, [factorial(k + i) for i in range(DECAY_TERMS)]), closed)


def _series(z, divisors: list[int]):
    """The sum of (-z)^i / divisors[i], by Horner's rule."""
    total = 1 / divisors[-1]
    for divisor in reversed(divisors[:-1]):
        total = 1 / divisor - z * total
    return total
