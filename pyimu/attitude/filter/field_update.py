"""The update by the magnetic field: its horizontal direction is a heading, and tells no tilt.

What the direction has beside the magnetic north is coloured, and of two parts. What is fixed to the
body (a bias of the magnetometer, iron that moves along) changes as the body turns, and stays while
it rests: a Gauss-Markov process over the angle by which the body turns. What belongs to the place
lasts. Both are states (``Field.turned``) whose covariance with the error of the estimate is kept: a
field that is looked at for an hour from one attitude says no more of them than at once. How large
the first part is the run sees in strength and dip.

These states know of the other updates what they tell of the estimate: with the regression b = P^-1
c of a state on the error of the estimate, an update that measures the estimate alone leaves b as it
is, moves the state by b^T times the change of the estimate, and lessens its variance by b^T (P -
P+) b (Bierman 1977, section IX, has the same for biases that are estimated apart).
"""

from __future__ import annotations

from dataclasses import replace

import casadi as ca

from pyimu.attitude.filter.field import FIELD, PARTS, TINY, Field, is_magnetometer
from pyimu.attitude.filter.field_learning import (
    SMOOTHED,
    Step,
    begun,
    delayed,
    density,
    followed,
    in_new_place,
    lasting_time,
    parts_of,
    stationary,
    tolerance_of,
)
from pyimu.attitude.filter.gravity_update import tilt_variance, vertical
from pyimu.attitude.filter.heading_update import INNOVATION_GATE, KNOWN_TILT, angle
from pyimu.attitude.filter.late_heading import wrapped
from pyimu.attitude.filter.layout import Flags, Layout
from pyimu.attitude.filter.marginal import turn
from pyimu.attitude.filter.memory import ESTIMATE, WORKING, Memory
from pyimu.attitude.filter.unscented import (
    LARGEST_STD,
    WHOLE,
    Estimate,
    N,
    less_scaled,
    turned_axes,
)
from pyimu.attitude.filter.variables import MAG
from pyimu.block.plain import plain_function
from pyimu.symbolic import quaternion
from pyimu.symbolic.linear import backward, cholesky, forward, symmetric

LONGEST_HOLD = 0.1
"""s; a sample that repeats the last one is that one, held for a faster log, up to so long."""

LONGEST = 1.0
"""s; a sample stands for the time since the last one, and for no more than this."""

ALIKE = 0.999
"""Largest share of the variance of what the field's direction has beside the north that the error
of the estimate may explain."""

NONE = 1e-20
"""rad^2; variance of a part of the field's direction that is none."""

LEAST_HORIZONTAL = 0.05
"""Least share of the horizontal part of the field with which it has a direction: a dip of 87
degrees."""


def after_others(
    layout: Layout, field: ca.Function, x: ca.MX, before: ca.MX, s, u, p, h, rate, flags
) -> tuple[ca.MX, ca.MX]:
    """The working estimate ``x`` after all other updates and that by the ``field``; its memory.

    ``before`` is the working estimate as it was predicted.
    """
    given = [ca.vertcat(x, s[layout.field :]), before, u, p, h, rate, flags]
    symbols = [ca.MX.sym(f"i{i}", v.numel()) for i, v in enumerate(given)]
    same = plain_function("without_field", symbols, [symbols[0]])
    seen = Flags.unpack(flags).field
    out = ca.Function.if_else("perhaps_field", field, same)(seen, *given)
    return out[:WORKING], out[WORKING:]


def by_field(layout: Layout) -> ca.Function:
    """``x, before, u, p, h, rate, flags -> x``: the working estimate and the field's memory."""
    both = ca.SX.sym("x", WORKING + FIELD)
    before = ca.SX.sym("before", WORKING)
    u, p, h, rate, flags = symbols = layout.symbols(ca.SX, "u p h rate flags")
    working, kept = both[:WORKING], Field.unpack(both[WORKING:])
    x, predicted = Memory.estimate_of(working), Memory.estimate_of(before)
    told = Flags.unpack(flags)
    step = Step.of(layout, predicted, p, h, rate, told.moving)
    kept = replace(kept, shared=kept.shared * (1 - told.lost * _is_bounded(predicted)))
    kept = _carried(kept, predicted, x, step)
    tilt_known = tilt_variance(x.covariance, vertical(x)) <= KNOWN_TILT**2
    after, x, turned = _measured(kept, x, u[MAG], (working[ESTIMATE + 1] < 0.5) * tilt_known, step)
    total = wrapped(working[ESTIMATE - 1] + turned)
    others = working[ESTIMATE : WORKING - 1]
    out = ca.vertcat(Memory.pack_estimate(x), total, others, after.off, after.pack())
    return plain_function("by_field", [both, before, *symbols], [out], {"cse": True})


def _is_bounded(x: Estimate):
    """Whether standard deviations of an attitude that may be lost were bounded, 0 or 1."""
    tilted = tilt_variance(x.covariance, vertical(x)) > KNOWN_TILT**2
    turned = ca.mmax(ca.diag(x.covariance)[:3]) > LARGEST_STD**2
    return ca.logic_or(tilted, turned)


# What the direction has beside the magnetic north


def _carried(kept: Field, before: Estimate, x: Estimate, step: Step) -> Field:
    """The memory after a period and the other updates.

    ``before`` is the estimate before these, ``x`` after. An update that makes the estimate less
    sure of itself says nothing of the parts.
    """
    lasting = lasting_time(kept, step)
    stays = ca.vertcat(1 / (1 + step.attitudes), lasting / (lasting + step.h))
    shared = _propagated(kept.shared, before, step) @ ca.diag(stays)
    unknown = stationary(kept, step)
    covariance = unknown + ca.diag(stays) @ (kept.covariance - unknown) @ ca.diag(stays)
    root = cholesky(before.covariance)
    whitened = forward(root, shared)
    # Rounding and what is not linear must not make the parts more like the estimate than they are.
    whitened = whitened * ca.sqrt(ca.fmin(1, ALIKE * _room(covariance, whitened.T @ whitened)))
    slope, change = backward(root, whitened), _difference(before, x)
    # The covariance after an update is in axes that were turned with the vertical.
    turned = turned_axes(change, vertical(before)) @ slope[:3, :]
    told, slope_after = whitened.T @ whitened, ca.vertcat(turned, slope[3:, :])
    left = slope_after.T @ x.covariance @ slope_after
    grown = ca.fmin(1, ca.sqrt(ca.diag(told) / ca.fmax(ca.diag(left), TINY)))
    less = told - ca.diag(grown) @ left @ ca.diag(grown)
    return replace(
        kept,
        turned=stays * kept.turned + slope.T @ change,
        covariance=symmetric(PARTS, lambda i, j: covariance[i, j] - less[i, j]),
        shared=x.covariance @ slope_after @ ca.diag(grown),
    )


def _room(whole, told):
    """By which factor ``told`` (2, 2) may grow and be no more than the ``whole`` (2, 2) in any
    direction: the smallest m with det(whole - m told) = 0. Of a part that is none nothing is told.
    """
    whole = whole + NONE * ca.SX.eye(PARTS)
    both = [v[0, 0] * v[1, 1] - v[0, 1] ** 2 for v in (whole, told)]
    mixed = whole[0, 0] * told[1, 1] + whole[1, 1] * told[0, 0] - 2 * whole[0, 1] * told[0, 1]
    root = ca.sqrt(ca.fmax(mixed**2 - 4 * both[0] * both[1], 0))
    return 2 * ca.fmax(both[0], 0) / ca.fmax(mixed + root, TINY**2)


def _propagated(shared, x: Estimate, step: Step):
    """The covariance (9, 2) with the error of the estimate a period later, ``x`` its estimate.

    The error becomes R^T p + G b, b, and R^T v - g h [u] p (``marginal.propagate``,
    ``velocity.pushed``), to first order in the turn of one period.
    """
    p, b, v = shared[:3, :], shared[3:6, :], shared[6:, :]
    own = quaternion.to_matrix(turn(step.turn)[0]).T
    p = own @ p - step.h * step.moving * b
    tilting = step["gravity"] * step.h * ca.skew(vertical(x))
    return ca.vertcat(p, b, own @ v - tilting @ p)


def _difference(a: Estimate, b: Estimate):
    """The error state (9,) that turns the estimate ``a`` into ``b``, to first order."""
    q = quaternion.product(quaternion.conjugate(a.q), b.q)
    p = 2 * q[1:4] * ca.if_else(q[0] < 0, -1, 1)
    return ca.vertcat(p, b.bias - a.bias, b.velocity - a.velocity)


# A sample


def _measured(kept: Field, x: Estimate, mag, clear, step: Step) -> tuple[Field, Estimate, ca.SX]:
    """Memory and estimate after a sample ``mag`` (3,), and the angle by which yaw was corrected.

    It is used where the tilt is ``clear``.
    """
    there = is_magnetometer(mag, step.settings)
    mag = ca.if_else(there, mag, kept.held)
    since = ca.fmin(kept.since + step.h, LONGEST)
    another = ca.logic_or(ca.sum1((mag - kept.held) ** 2) > 0, since >= LONGEST_HOLD)
    fresh = there * another
    late = quaternion.rotate(x.q, mag)
    passing = ca.cross(quaternion.rotate(x.q, step.turn / step.h), late)
    seen = late - kept.late[0] * passing
    now = parts_of(seen)
    usable = fresh * clear * (now[0] > LEAST_HORIZONTAL * ca.norm_2(mag))
    kept = replace(
        kept,
        held=mag,
        since=ca.if_else(fresh, 0, since),
        off=kept.off * (since < LONGEST),
    )
    kept = begun(kept, now, usable, step)
    aside = _beside_north(kept, seen, step)
    tolerance = tolerance_of(kept, x, step)
    off = usable * (ca.sumsqr(now - kept.known) > tolerance)
    kept, beyond = _against_heading(kept, x, seen, aside, usable - off, since, step)
    good = usable - off - beyond
    kept = followed(kept, now, usable, good, x, since, step)
    kept, new, doubt = in_new_place(kept, now, aside, usable, good, tolerance, x, since, step)
    good += new
    x = _less_known(x, vertical(x), doubt)
    level = ca.fmax(ca.norm_2(late[:2]), TINY)
    slope = ca.vertcat(ca.dot(late[:2], passing[:2]) / level, passing[2])
    lateral = (late[0] * passing[1] - late[1] * passing[0]) / level
    kept = delayed(kept, now, slope, x, good * since, step)
    return _by_direction(kept, x, seen, lateral, good, since, step)


# The direction


def _against_heading(kept: Field, x: Estimate, seen, aside, usable, dt, step: Step):
    """The memory with the innovation without noise, and whether it contradicts the estimate where
    the field is ``usable``, 0 or 1.

    What the gyro's scale factors may make of the heading contradicts nothing.
    """
    beside = kept.beside + usable * dt / (SMOOTHED + dt) * (aside - kept.beside)
    slope = _slope(kept, x, seen)
    own = _innovation_variance(kept, x, slope)[2] + ca.sumsqr(slope.T @ x.scaled[:3, :])
    noise = step["field_noise"] ** 2 / (2 * SMOOTHED * ca.fmax(kept.known[0], TINY) ** 2)
    beyond = usable * (beside**2 > INNOVATION_GATE * (own + noise))
    return replace(kept, beside=beside), beyond


def _by_direction(kept: Field, x: Estimate, seen, lateral, good, dt, step: Step):
    """Memory and estimate after the direction of the field, where it is ``good``; the correction.

    ``seen`` (3,) is the field in world axes. With u the vertical, n the direction of the field's
    horizontal part, both in body axes, and t the tangent of its dip upwards, the direction is off
    by (t n - u) p and the two parts; a delay that is not known turns it by what passes
    ``lateral`` T/s. By what strength and dip are off just now the direction is off as well.
    """
    innovation, up, slope = _beside_north(kept, seen, step), vertical(x), _slope(kept, x, seen)
    passing = 2 * SMOOTHED * lateral**2 / kept.late[1]
    now = (step["field_turning_std"] > 0) * ca.sumsqr(kept.smooth - kept.known) / 2
    white = density(replace(kept, scatter=ca.fmax(kept.scatter, now)), step) + passing
    level = ca.fmax(kept.known[0], TINY) ** 2
    cross, parts, own = _innovation_variance(kept, x, slope)
    variance = own + white / (level * dt)
    own_gain = _about_the_vertical(up, cross, good / variance)
    x, corrected = _corrected(x, up, cross, variance, own_gain, slope, innovation)
    gain = good * parts / variance
    after = symmetric(PARTS, lambda i, j: kept.covariance[i, j] - gain[i] * parts[j])
    kept = replace(
        kept,
        turned=kept.turned + gain * innovation,
        covariance=after,
        shared=kept.shared - cross @ gain.T,
    )
    return kept, x, corrected


def _slope(kept: Field, x: Estimate, seen):
    """The slope (3,) of the direction over the attitude error, of a field ``seen`` (3,)."""
    ahead = ca.vertcat(seen[:2] / ca.fmax(ca.norm_2(seen[:2]), TINY), 0)
    level = quaternion.rotate(quaternion.conjugate(x.q), ahead)
    return kept.known[1] / ca.fmax(kept.known[0], TINY) * level - vertical(x)


def _beside_north(kept: Field, seen, step: Step):
    """The angle in rad by which the field ``seen`` (3,) is beside where it is expected."""
    north = ca.vertcat(ca.sin(step["declination"]), ca.cos(step["declination"]))
    return wrapped(angle(north, seen) - ca.sum1(kept.turned))


def _innovation_variance(kept: Field, x: Estimate, slope):
    """Covariance of the innovation with the estimate's error (9,), with the parts (2,), its own."""
    cross = x.covariance[:, :3] @ slope + ca.sum2(kept.shared)
    parts = kept.shared[:3, :].T @ slope + ca.sum2(kept.covariance)
    return cross, parts, ca.dot(slope, cross[:3]) + ca.sum1(parts)


def _about_the_vertical(up, cross, scale):
    """The gain (9,) of an innovation for the estimate, ``scale`` times the covariance ``cross``.

    That for the tilt, for the velocity, and for the bias across the vertical, which would tilt, is
    zero: these stay as they are, and their variance is accounted for (Schmidt's consider filter;
    Joseph's form, Bierman 1977, section II.4).
    """
    about, along = scale * ca.dot(up, cross[:3]), scale * ca.dot(up, cross[3:N])
    return ca.vertcat(about * up, along * up, ca.SX.zeros(3))


def _corrected(x: Estimate, up, cross, variance, gain, slope, innovation) -> tuple[Estimate, ca.SX]:
    """The estimate after the innovation, and the turn about ``up`` in rad."""
    covariance = symmetric(
        WHOLE,
        lambda i, j: (
            x.covariance[i, j]
            - gain[i] * cross[j]
            - cross[i] * gain[j]
            + variance * gain[i] * gain[j]
        ),
    )
    corrected = ca.dot(up, gain[:3]) * innovation
    correction = ca.vertcat(ca.cos(corrected / 2), ca.sin(corrected / 2) * up)
    q = quaternion.product(x.q, correction)
    scaled = less_scaled(x, gain, slope.T @ x.scaled[:3, :])
    return Estimate(q, x.bias + gain[3:N] * innovation, x.velocity, covariance, scaled), corrected


def _less_known(x: Estimate, up, more) -> Estimate:
    """The estimate with its variance about the vertical ``more`` rad^2 larger."""
    return replace(
        x,
        covariance=symmetric(
            WHOLE,
            lambda i, j: x.covariance[i, j] + (more * up[i] * up[j] if j < 3 else 0),
        ),
    )
