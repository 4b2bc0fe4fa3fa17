"""The updates that both filters share, as casadi functions of the working estimate; the outputs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import casadi as ca

from pyimu.attitude.filter import late_heading, unscented
from pyimu.attitude.filter.gravity_update import vertical
from pyimu.attitude.filter.heading_update import LEVEL, by_heading
from pyimu.attitude.filter.layout import FLAGS, Flags, Layout
from pyimu.attitude.filter.memory import ESTIMATE, WORKING, Memory
from pyimu.attitude.filter.settings import Settings
from pyimu.attitude.filter.speed_update import by_speed, velocity_anew
from pyimu.attitude.filter.unscented import LARGEST_STD, Estimate, N, bounded, bounded_tilt
from pyimu.block.plain import plain_function
from pyimu.symbolic import quaternion
from pyimu.symbolic.elementary import arc_tangent
from pyimu.symbolic.linear import reciprocal, symmetric

OPTIONS = {"cse": True}

TURN_DENSITY = 0.01
"""(rad/s)^2 s; of the turn about the vertical of a body of which it is in doubt whether it rests:
0.01 rad/s for some 50 s, as of a ship at its anchor, or 0.03 for 5 s. What the bias is shows in
minutes."""


def where(condition, function: ca.Function, values, *more):
    """``function(values, *more)`` where ``condition`` holds, else ``values``.

    The function runs only then.
    """
    symbols = [ca.MX.sym(f"i{i}", function.numel_in(i)) for i in range(function.n_in())]
    same = plain_function(f"without_{function.name()}", symbols, [symbols[0]])
    return ca.Function.if_else(f"perhaps_{function.name()}", function, same)(
        condition, values, *more
    )


# A lost attitude


def bounded_where_lost(x: ca.MX, flags: Flags) -> ca.MX:
    """The working estimate with its attitude's standard deviations bounded where it may be lost.

    Where gravity is about to correct it, those of the tilt are bounded so that it can.
    """
    by_force = flags.gravity + flags.velocity
    return where(flags.lost * by_force, _bounding_tilt(), where(flags.lost, _bounding(), x))


def _bounding() -> ca.Function:
    """``x -> x`` with the standard deviation about each axis bounded."""
    s = ca.SX.sym("x", WORKING)
    x = Memory.estimate_of(s)
    after = replace(x, covariance=bounded(x.covariance))
    return plain_function("bounding", [s], [_with_estimate(s, after)], OPTIONS)


def _bounding_tilt() -> ca.Function:
    """``x -> x`` with the standard deviation of the tilt bounded."""
    s = ca.SX.sym("x", WORKING)
    after = bounded_tilt(Memory.estimate_of(s))
    return plain_function("bounding_tilt", [s], [_with_estimate(s, after)], OPTIONS)


def _with_estimate(working, x: Estimate):
    """The ``working`` estimate with ``x`` in place of its estimate."""
    return ca.vertcat(Memory.pack_estimate(x), working[ESTIMATE - 1 :])


# Heading and zero rate


def after_gravity(
    layout: Layout, zero_rate: ca.Function, x, s, u, p, h, rate, gravity, flags: Flags
) -> ca.MX:
    """The working estimate after the updates that follow gravity's.

    These are by a speed, by a heading and by a ``zero_rate``, where the ``flags`` ask for them.
    """
    x = where(flags.anew, velocity_anew(layout), x, gravity, u, p, flags.driven)
    x = where(flags.speed * (1 - flags.anew), by_speed(layout), x, gravity, u, p)
    x = where(flags.heading, by_heading(layout), x, s, u, p, h, rate, flags.vertical_noise)
    resting = flags.stationary + flags.resting > 0
    return where(resting, zero_rate, x, rate, p, h, flags.rest)


def by_zero_rate(layout: Layout, correct: Callable = unscented.correct) -> ca.Function:
    """``x, rate, p, h, rest -> x``: the gyro of a body that does not turn against the Earth.

    It measures bias and Earth rate, z = b + R_nb^T w_e + n. To first order R_nb^T w_e of the true
    attitude is w_b + w_b x p, with w_b that of the estimate: linear in the error state. ``rest``
    (3,) says whether it was found, whether in doubt, and with what sway, as ``Flags`` have them. A
    body that may drive on may turn about the vertical. ``correct`` is the correction of one of the
    filters.
    """
    rest = ca.SX.sym("rest", 3)
    s, rate, p, h = layout.symbols(ca.SX, "x rate p h")
    x, settings = Memory.estimate_of(s), Settings.of(layout.compensation, p)
    earth = quaternion.rotate(quaternion.conjugate(x.q), settings.earth)
    slope = ca.horzcat(ca.skew(earth), ca.SX.eye(3), ca.SX(3, 3))
    cross = x.covariance @ slope.T
    slow = ca.if_else(rest[0], rest[2], settings.scalar["stationary_std"] ** 2)
    noise, up = settings.gyro.white**2 * reciprocal(h) + slow, vertical(x)
    turning = rest[0] * rest[1] * TURN_DENSITY * reciprocal(h)
    variance = symmetric(3, lambda i, j: (noise[i] if i == j else 0) + turning * up[i] * up[j])
    off, seen = rate - x.bias - earth, slope @ x.scaled
    after, _, _ = correct(x, off, slope @ cross + variance, cross, up, seen=seen)
    return plain_function(
        "by_zero_rate", [s, rate, p, h, rest], [_with_estimate(s, after)], OPTIONS
    )


# Outputs


def finish() -> ca.Function:
    """``x, flags -> estimate, yaw, y``: what a step gives after its updates.

    The estimate with q at unit length, its yaw as the ring keeps it, and the outputs.
    """
    given, packed = ca.SX.sym("x", WORKING), ca.SX.sym("flags", FLAGS)
    x, flags = Memory.estimate_of(given), Flags.unpack(packed)
    # Of unit length but for rounding, so that one step of Newton's for 1 / |q| does it.
    q = x.q * (1.5 - 0.5 * ca.sumsqr(x.q))
    nis, *report = ca.vertsplit(given[ESTIMATE:])
    status = _status(flags, report, ca.diag(x.covariance)[:N])
    found = flags.quasi_static, nis * flags.quasi_static, status, flags.at_rest
    # What follows from the attitude need not wait for its length.
    y = ca.vertcat(q, outputs(x, *found, flags.constant)[4:])
    level = (1 - 2 * (q[2] * q[2] + q[3] * q[3])) ** 2 + (
        2 * (q[1] * q[2] + q[0] * q[3])
    ) ** 2 > LEVEL**2
    yaw = ca.if_else(level, y[6] - given[ESTIMATE - 1], late_heading.NEVER)
    estimate = ca.vertcat(q, given[4:ESTIMATE])
    return plain_function("finish", [given, packed], [estimate, yaw, y], OPTIONS)


def _status(flags: Flags, report: list, variances):
    """The bits of ``STATUS`` from the prediction's flags and the updates' report."""
    gravity_beyond, old, unusable, held_back, heading_beyond, field_off = report
    no_variance = 1 - ca.mmin(variances > 0)
    not_finite = flags.missing + unusable - flags.missing * unusable
    return flags.faults + (
        not_finite
        + 8 * gravity_beyond
        + 16 * old
        + 32 * held_back
        + 64 * heading_beyond
        + 128 * no_variance
        + 256 * field_off
    )


def outputs(x: Estimate, quasi_static, nis, status, at_rest, constant=0) -> ca.SX:
    """The block's outputs (``pyimu.attitude.filter.variables.OUTPUTS``) as a column.

    ``constant`` rad^2 is added to the variance of the tilt; that by the gyro's scale factors to
    all.
    """
    up, pp = quaternion.to_matrix(x.q)[2, :].T, x.covariance[:3, :3]
    added, about = _by_scale(x, up)
    added += ca.vertcat(constant * (1 - up**2), ca.SX(3, 1))
    std = [ca.sqrt(ca.fmax(x.covariance[i, i], 0) + added[i]) for i in range(6)]
    heading_std = ca.sqrt(ca.fmax(ca.dot(up, pp @ up), 0) + about)
    angles = ca.vertcat(*[arc_tangent(*sides) for sides in quaternion.euler_sides(x.q)])
    flags = (quasi_static, nis, status, heading_std, at_rest)
    return ca.densify(ca.vertcat(x.q, angles, x.bias, *std, *flags))


def _by_scale(x: Estimate, up):
    """Variances (6,) of attitude and bias, and about the vertical, by the gyro's scale factors.

    Those of the attitude are together no more than what an angle can have.
    """
    if x.scaled is None:
        return ca.SX.zeros(N), ca.SX(0)
    own = ca.sum2(x.scaled[:N, :] ** 2)
    about = ca.sumsqr(up.T @ x.scaled[:3, :])
    most = ca.fmin(1, LARGEST_STD**2 / ca.fmax(ca.sum1(own[:3]), LARGEST_STD**2 / 2))
    return ca.vertcat(most * own[:3], own[3:]), most * about
