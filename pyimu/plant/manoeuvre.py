"""Drives as a function of time: rest, a move that starts and stops smoothly, rest.

A move is counted in seconds at cruising speed. That count and its derivatives are the only
functions of time; path and heading are the count times a constant speed or rate, which makes the
ends exact and the motion independent of the sample period.
"""

from __future__ import annotations

import casadi as ca

from pyimu.symbolic.linear import reciprocal
from pyimu.symbolic.quaternion import sinc


def smooth_step(x) -> tuple:
    """A step from 0 at x = 0 to 1 at x = 1, its first two derivatives and its integral from 0.

    10 x^3 - 15 x^4 + 6 x^5, the polynomial of least degree whose first two derivatives vanish at
    both ends (Perlin 2002, Improving Noise).
    """
    step = x * x * x * (10 + x * (6 * x - 15))
    slope = 30 * x * x * (1 - x) * (1 - x)
    curvature = 60 * x * (1 - x) * (1 - 2 * x)
    integral = x * x * x * x * (2.5 + x * (x - 3))
    return step, slope, curvature, integral


def progress(time, duration, ramp) -> tuple:
    """How many s at cruising speed are done ``time`` s after the start of a move, of ``duration``.

    It is followed by its three derivatives. The first, the speed as a share of the cruising speed,
    rises in the first ``ramp`` s, stays at 1 until ``duration``, and falls in ``ramp`` s more: both
    ramps together count as long as one of them at full speed, so that the end is ``duration``.
    """
    per_ramp = reciprocal(ramp)
    start, end = _between(time * per_ramp, 1), _between((time - duration) * per_ramp, 1)
    up, up_slope, up_bend, risen = smooth_step(start)
    down, down_slope, down_bend, fallen = smooth_step(end)
    steady = _between(time - ramp, duration - ramp)
    return (
        steady + ramp * (risen + (end - fallen)),
        up - down,
        (up_slope - down_slope) * per_ramp,
        (up_bend - down_bend) * (per_ramp * per_ramp),
    )


def _between(x, largest):
    return ca.fmin(ca.fmax(x, 0), largest)


def out_and_back(time, duration, ramp, pause, back) -> tuple:
    """``progress`` of a move, and where ``back`` is 1 of the same move back, ``pause`` s later."""
    out = progress(time, duration, ramp)
    returned = progress(time - duration - ramp - pause, duration, ramp)
    return tuple(a - back * b for a, b in zip(out, returned, strict=True))


def chord(path, turned, heading) -> tuple:
    """Displacement (east, north) over an arc of length ``path`` that has ``turned`` by an angle.

    At its start the heading is ``heading``. The chord is path sin(turned/2) / (turned/2), and its
    direction the mean of the headings.
    """
    length = path * sinc(turned * turned / 4)
    return length * ca.cos(heading + turned / 2), length * ca.sin(heading + turned / 2)
