"""What corrects the estimate: rest, a vehicle's wheels, a measured speed or position.

Each is z = h(x) + n with a covariance R. A measurement whose normalised innovation squared is above
its gate gets the weight with which it would be at the gate: one that is wrong, as a rest that is
none, then pulls the estimate by a few standard deviations and not by hundreds.
"""

from __future__ import annotations

from dataclasses import replace

import casadi as ca

from pyimu.attitude.filter.settings import Settings
from pyimu.ins.filter.layout import (
    BASE,
    GYRO_BIAS,
    POSITION,
    RESTING,
    TURN,
    UP,
    VELOCITY,
    Layout,
    State,
)
from pyimu.ins.filter.prediction import about_the_centre
from pyimu.ins.filter.weight import earth_by_turn
from pyimu.numerics.laws import chi2
from pyimu.symbolic import quaternion
from pyimu.symbolic.linear import cholesky, forward, reciprocal, symmetric
from pyimu.symbolic.missing import is_finite

BY_CHANCE = 1.5e-5
"""Probability with which a right measurement is above its gate, that of the attitude filter's."""


SLOW = 10.0
"""s; for which the speed of a slow drive is taken to stay the same. Assumed."""


def gate(freedom: int) -> float:
    """Normalised innovation squared above which a measurement is weighed down."""
    return float(chi2.isf(BY_CHANCE, freedom))


def corrected_by(
    layout: Layout, x: State, innovation, slope, noise, settings: Settings
) -> tuple[State, ca.SX, ca.SX]:
    """The estimate after a measurement, its normalised innovation squared, and the error (n,) that
    it took out.

    ``slope`` (m, n) is dh/dx, ``noise`` (m,) the variances.
    """
    count = innovation.numel()
    cross = x.covariance @ slope.T
    own = slope @ cross + ca.diag(noise)
    lower = cholesky(own)
    white = forward(lower, innovation)
    nis = ca.sumsqr(white)
    shrink = ca.fmin(1, gate(count) / ca.fmax(nis, 1e-30))
    gain = forward(lower, cross.T) * ca.sqrt(shrink)
    change = gain.T @ (white * ca.sqrt(shrink))
    covariance = symmetric(
        layout.errors, lambda i, j: x.covariance[i, j] - ca.dot(gain[:, i], gain[:, j])
    )
    change[UP] = change[UP] + _bent(change, settings.scalar["gravity"])
    return changed(layout, replace(x, covariance=covariance), change), nis, change


def changed(layout: Layout, x: State, error) -> State:
    """The estimate with an ``error`` (n,) added."""
    gains = slice(BASE, BASE + len(layout.gains))
    about = quaternion.exponential(ca.vertcat(0, 0, error[TURN][2]))
    turn, back = quaternion.exponential(error[TURN]), quaternion.conjugate(x.q)
    return replace(
        x,
        q=quaternion.normalized(quaternion.product(turn, x.q)),
        velocity=quaternion.rotate(turn, x.velocity + error[VELOCITY]),
        position=x.centre + quaternion.rotate(about, x.position - x.centre + error[POSITION]),
        gyro_bias=x.gyro_bias + quaternion.rotate(back, error[GYRO_BIAS]),
        resting=x.resting + quaternion.rotate(back, error[RESTING]),
        gains=x.gains + error[gains],
        mounting=x.mounting + error[layout.mounting],
        wheels=x.wheels + error[layout.of_wheels],
        lasting=x.lasting + error[layout.of_positions],
    )


def _bent(error, gravity):
    """What is of second order in the tilt of an ``error`` (n,) of the resting force upwards.

    A body that is tilted by phi feels less of its weight c there, by c phi^2 / 2. What of the tilt
    was there at the last rest is in the force that this has shown: it is the part of the error that
    looks like a bias, r - c x phi. The other part came up on the way.
    """
    tilt = error[TURN][:2]
    taken = error[RESTING][:2] / gravity - ca.vertcat(-tilt[1], tilt[0])
    return gravity / 2 * (ca.sumsqr(taken) - ca.sumsqr(tilt))


def _slope(layout: Layout, rows: int, **parts) -> ca.SX:
    out = ca.SX(rows, layout.errors)
    places = {"turn": TURN, "velocity": VELOCITY, "position": POSITION, "gyro_bias": GYRO_BIAS}
    for name, value in parts.items():
        out[:, places[name]] = value
    return out


def by_zero_velocity(layout: Layout, x: State, slow, settings: Settings, h) -> tuple:
    """A body at rest: v = 0 (zero-velocity update; Groves 2013, section 15.3.1).

    It has no velocity in its own axes either, R^T v + R^T e with the errors of ``prediction``: in
    that form no attitude is in it. With the velocity in world axes, v + e + phi x v, a wrong
    velocity would tell of the yaw. A body that drives slowly, as far as is known with the mean
    square ``slow`` m^2/s^2 (0 at rest), is told so once in ``SLOW`` s.
    """
    slope = _slope(layout, 3, velocity=ca.SX.eye(3))
    noise = ca.fmax(settings.scalar["zupt_std"] ** 2, slow * SLOW * reciprocal(h))
    noise = noise * ca.SX.ones(3)
    return corrected_by(layout, x, -x.velocity, slope, noise, settings)


def by_zero_rate(layout: Layout, x: State, rate, settings: Settings, h) -> tuple:
    """A body that does not turn against the Earth: its gyro shows (1 + M) R^T w_e + bias + n."""
    back = quaternion.to_matrix(quaternion.conjugate(x.q))
    earth = back @ settings.earth
    slope = _slope(layout, 3, turn=back @ earth_by_turn(x, settings.earth), gyro_bias=back)
    expected = earth + layout.matrix(x.gains, "gyro") @ earth + x.gyro_bias
    noise = settings.gyro.white**2 * reciprocal(h) + 1e-16
    return corrected_by(layout, x, rate - expected, slope, noise, settings)


def by_vehicle(layout: Layout, x: State, rate, settings: Settings, h) -> tuple:
    """A vehicle whose wheels do not slip: no speed sideways nor upwards in its own axes.

    With the velocity v_b = R^T v + w x l of the point at the lever arm l in body axes, and the
    mounting (a, b), vehicle axes pitched by a and turned by b: v_y - b v_x = 0 and v_z + a v_x = 0.
    A slip lasts: its variance holds for ``nhc_time``, so that each sample has that of white noise
    of the same density. It grows with the speed, as tyres slip and springs pitch by an angle. The
    mounting is estimated with the rest.
    """
    at = settings.scalar
    back = quaternion.to_matrix(quaternion.conjugate(x.q))
    arm = _lever_arm(layout, x, settings)
    speed = back @ x.velocity + ca.cross(rate - x.gyro_bias, arm)
    pitched, turned = x.mounting[0], x.mounting[1]
    if layout.wheels:
        turned = turned + x.wheels[-1]
    of_speed = ca.vertcat(ca.horzcat(-turned, 1, 0), ca.horzcat(pitched, 0, 1))
    slope = _slope(
        layout,
        2,
        velocity=of_speed @ back,
        gyro_bias=of_speed @ ca.skew(arm) @ back,
    )
    slope[0, layout.mounting.start + 1] = -speed[0]
    slope[1, layout.mounting.start] = speed[0]
    if layout.wheels:
        by_arm = of_speed @ ca.skew(rate - x.gyro_bias)
        slope[:, layout.of_wheels.start + 2 : layout.crabs] = by_arm[:, :2]
        slope[0, layout.crabs] = -speed[0]
    own = settings.gyro.white**2 * reciprocal(h)
    of_arm = (of_speed @ ca.skew(arm)) ** 2 @ own
    slip = at["nhc_std"] ** 2 + (at["nhc_angle_std"] * speed[0]) ** 2
    noise = slip * ca.fmax(2 * at["nhc_time"] * reciprocal(h), 1) + of_arm
    return corrected_by(layout, x, -of_speed @ speed, slope, noise, settings)


def by_speed(
    layout: Layout, x: State, speed, variance, motion: tuple, settings: Settings, h
) -> tuple:
    """A measured speed along the body's x axis, of the point that does not slip.

    The ``motion`` is rate and mean force (3,). A speed that is counted over an interval is that of
    the interval's middle: it is late, and beside an acceleration that is no noise. That is the mean
    one: beside single forces, which shake, the delay is found too small, as every slope beside what
    is itself in error is, and the scale with it.
    """
    rate, force = motion
    arm, turns = _lever_arm(layout, x, settings), rate - x.gyro_bias
    back = quaternion.to_matrix(quaternion.conjugate(x.q))
    along = back[0, :]
    moves = along @ x.velocity + ca.cross(turns, arm)[0]
    scale = 1
    if layout.wheels:
        scale, pushed = 1 + x.wheels[0], (force - x.resting)[0]
        moves = moves - x.wheels[1] * pushed
    by_bias = scale * ca.skew(arm)[0, :]
    slope = _slope(layout, 1, velocity=scale * along, gyro_bias=by_bias @ back)
    if layout.wheels:
        of_arm = scale * ca.skew(turns)[0, :2]
        slope[0, layout.of_wheels] = ca.horzcat(moves, -scale * pushed, of_arm, 0)
    noise = variance + by_bias**2 @ (settings.gyro.white**2 * reciprocal(h))
    return corrected_by(layout, x, speed - scale * moves, slope, noise, settings)


def by_position(layout: Layout, x: State, position, variance, settings: Settings) -> tuple:
    """A measured position (3,) of the antenna, p + R l, each of its axes with the ``variance``."""
    arm = quaternion.rotate(x.q, _arm(settings, "antenna"))
    turns = about_the_centre(x.position - x.centre) - ca.skew(arm)
    slope = _slope(layout, 3, position=ca.SX.eye(3), turn=turns)
    off = position - x.position - arm
    if layout.lasting:
        slope[:, layout.of_positions] = ca.SX.eye(3)
        off = off - x.lasting
    off, noise = _of_known_axes(off, variance)
    return corrected_by(layout, x, off, slope, noise, settings)


def by_velocity(layout: Layout, x: State, velocity, variance, rate, settings: Settings, h) -> tuple:
    """A measured velocity (3,) of the antenna in world axes, each axis with the ``variance``.

    It is u = v + R (w x l), which is u + e + phi x u - d x R l with the errors of ``prediction``;
    the gyro's noise acts by the arm.
    """
    arm, axes = _arm(settings, "antenna"), quaternion.to_matrix(x.q)
    moves = x.velocity + axes @ ca.cross(rate - x.gyro_bias, arm)
    slope = _slope(
        layout,
        3,
        turn=-ca.skew(moves),
        velocity=ca.SX.eye(3),
        gyro_bias=ca.skew(axes @ arm),
    )
    by_arm = ca.mmax(settings.gyro.white) ** 2 * reciprocal(h) * ca.sumsqr(arm)
    off, noise = _of_known_axes(velocity - moves, variance + by_arm)
    return corrected_by(layout, x, off, slope, noise, settings)


def _lever_arm(layout: Layout, x: State, settings: Settings) -> ca.SX:
    """From the sensor to the point that does not slip (3,) m, as it is known."""
    told = _arm(settings, "lever_arm")
    return told + ca.vertcat(x.wheels[2:4], 0) if layout.wheels else told


def _arm(settings: Settings, name: str) -> ca.SX:
    return ca.vertcat(*[settings.scalar[f"{name}[{i}]"] for i in (1, 2, 3)])


UNKNOWN = 1e12
"""Variance in SI of an axis that was not measured."""


def _of_known_axes(off, variance) -> tuple:
    """An innovation (3,) and its variances (3,), without what an axis that is NaN would say."""
    known = is_finite(off)
    return ca.if_else(known, off, 0), ca.if_else(known, variance, UNKNOWN)
