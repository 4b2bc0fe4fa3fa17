"""Free drives: speed and turn rate that follow commands smoothly, and where they lead."""

from __future__ import annotations

import casadi as ca

SPREAD = 84.0**-0.5
"""Time constant of the three lags over the ramp of a move: a step then takes as long, the standard
deviation of its slope over time being that of ``smooth_step``, whose slope is a beta distribution
of variance 1/28; three lags have 3 of their squared time constant."""


def follow(state, command, lag, h) -> tuple:
    """A speed after ``h`` s under a constant ``command``, and the distance gone meanwhile.

    ``state`` (3,) is the speed and its first two derivatives. It follows by three equal lags,
    (1 + lag d/dt)^3 v = command: what is left of the difference is (c0 + c1 t + c2 t^2)
    exp(-t/lag), the solution for equal roots, and the distance is the integral of the equation.
    Both are exact for a held command. The acceleration is continuous.
    """
    a = 1 / lag
    difference = state[0] - command
    c0, c1 = difference, state[1] + a * difference
    c2 = (state[2] + 2 * a * state[1] + a * a * difference) / 2
    decay = ca.exp(-a * h)
    left, slope, bend = c0 + h * (c1 + h * c2), c1 + 2 * h * c2, 2 * c2
    following = ca.vertcat(
        command + decay * left,
        decay * (slope - a * left),
        decay * (bend - 2 * a * slope + a * a * left),
    )
    change = following - state
    return following, h * command - lag * (3 * change[0] + lag * (3 * change[1] + lag * change[2]))


def displaced(before, after, h) -> ca.SX:
    """The integral over ``h`` s of a function given at both ends with two derivatives.

    ``before`` and ``after`` (3,) are value, first and second derivative. The rule is exact for
    polynomials of fifth degree; its error is h^7 f''''''/100800 (Lanczos 1956, Applied
    Analysis, quadrature with the end data).
    """
    value, slope, bend = before + after, before - after, before + after
    return h / 2 * value[0] + h * h / 10 * slope[1] + h * h * h / 120 * bend[2]


def courses(speed, turn_rate, heading) -> tuple:
    """East and north velocity (3,) each, with two derivatives.

    ``speed`` and ``turn_rate`` are (3,), value and derivatives; ``heading`` is in rad.
    """
    v, v1, v2 = (speed[i] for i in range(3))
    w, w1 = turn_rate[0], turn_rate[1]
    c, s = ca.cos(heading), ca.sin(heading)
    along, across = v2 - v * w * w, 2 * v1 * w + v * w1
    return (
        ca.vertcat(v * c, v1 * c - v * w * s, along * c - across * s),
        ca.vertcat(v * s, v1 * s + v * w * c, along * s + across * c),
    )
