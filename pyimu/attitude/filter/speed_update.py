"""The update by a measured speed: a vehicle that drives forward, along its x axis.

Its velocity in body axes is the speed, with nothing across and upwards but slip. The force less
gravity is the change of that velocity, so that pushes and turns of any length are known for what
they are, and do not tilt the attitude: f = v' + w x v + R^T g (Groves 2013, section 15.4, calls the
two parts without speed the nonholonomic constraints).

Across, the balance is f_y = v (w_z - b) + g p, with b the error of the bias about the vertical and
p that of the tilt. Two errors make it say too much of b, and with it of the heading, where they are
taken for white noise:

* An angle c between accelerometer and gyro turns with the body, while a tilt stays behind. After a
  quarter turn the balance is off by g c, and b = g c / v explains that turn after turn: 10 mg at
  10 m/s are 0.6 deg/s. ``axes_std`` is that of c, in ``Estimate.scaled``, and here the gains know
  of it: they are those of Schmidt's consider filter with all that is scaled (Schmidt 1966), so that
  b is learnt by the change of the speed alone.
* A body squats and pitches on its springs for as long as it speeds up or turns, which is a velocity
  upwards that lasts: no noise from sample to sample (``SLIP_TIME``).

While speeds come the body is not one that stays in its place. Before the first and after the last
the velocity begins anew.
"""

from __future__ import annotations

from dataclasses import replace

import casadi as ca

from pyimu.attitude.filter import unscented
from pyimu.attitude.filter.gravity_update import (
    INNOVATION_GATE,
    PUSH_TIME,
    less_sure,
    reported,
    vertical,
)
from pyimu.attitude.filter.layout import GravityMeasurement, Layout
from pyimu.attitude.filter.memory import ESTIMATE, Memory
from pyimu.attitude.filter.unscented import WHOLE, Estimate
from pyimu.attitude.filter.variables import INPUTS, LEAST_SPEED_STD, OWN_PARAMETERS
from pyimu.attitude.filter.velocity import at_rest, covariance_of_motion
from pyimu.block.plain import plain_function
from pyimu.symbolic.linear import reciprocal, symmetric

SPEED, SPEED_VARIANCE = ([v.name for v in INPUTS].index(n) for n in ("speed", "speed_variance"))

SLIP = [v.name for v in OWN_PARAMETERS].index("slip_std")

SLIP_TIME = PUSH_TIME
"""s; how long a slip upwards lasts, as the pushes that make it. Where a speed does not come with
each sample it tells less of it than it could, which is little in any case: upwards no tilt shows.
"""

OPTIONS = {"cse": True}


def by_speed(layout: Layout) -> ca.Function:
    """``x, gravity, u, p -> x``: the working estimate after a speed."""
    symbols = working, packed, u, p = layout.symbols(ca.SX, "x gravity u p")
    x, given = Memory.estimate_of(working), GravityMeasurement.unpack(packed)
    off = ca.vertcat(u[SPEED], 0, 0) - x.velocity
    noise = _noise(u, p, 1 + 2 * SLIP_TIME * reciprocal(given.period))
    x, up = _with_scaled(x, 1), vertical(x)
    variance, cross, seen = x.covariance[6:, 6:] + noise, x.covariance[:, 6:], x.scaled[6:, :]
    after, _, weight = unscented.correct(x, off, variance, cross, up, INNOVATION_GATE, seen=seen)
    after, beyond = _with_scaled(after, -1), weight < 1
    after = less_sure(after, up, beyond * given.period)
    return plain_function("by_speed", symbols, [reported(working, after, 0, beyond)], OPTIONS)


def velocity_anew(layout: Layout) -> ca.Function:
    """``x, gravity, u, p, driven -> x``: the velocity is the speed where the body is ``driven``,
    else that of one that stays in its place.
    """
    driven = ca.SX.sym("driven")
    symbols = working, packed, u, p = layout.symbols(ca.SX, "x gravity u p")
    x, given = Memory.estimate_of(working), GravityMeasurement.unpack(packed)
    moving = covariance_of_motion(given.motion[0], given.motion[1], vertical(x))
    after: Estimate = at_rest(x, ca.if_else(driven, _noise(u, p), moving))
    after = replace(after, velocity=ca.vertcat(driven * u[SPEED], 0, 0))
    out = ca.vertcat(Memory.pack_estimate(after), working[ESTIMATE - 1 :])
    return plain_function("velocity_anew", [*symbols, driven], [out], OPTIONS)


def _with_scaled(x: Estimate, sign: int) -> Estimate:
    """The estimate whose covariance has, or has no longer, what ``Estimate.scaled`` makes of it."""
    d = x.scaled

    def entry(i: int, j: int):
        return x.covariance[i, j] + sign * ca.dot(d[i, :], d[j, :])

    return replace(x, covariance=symmetric(WHOLE, entry))


def _noise(u, p, upwards=1):
    """The covariance (3, 3) in (m/s)^2 of a speed as the velocity in body axes.

    ``upwards`` is the factor of the variance there.
    """
    along, slip = u[SPEED_VARIANCE] + LEAST_SPEED_STD**2, p[SLIP] ** 2 + LEAST_SPEED_STD**2
    return ca.diag(ca.vertcat(along, slip, upwards * slip))
