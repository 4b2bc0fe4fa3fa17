"""The update by a measured speed: a vehicle that drives forward, along its x axis.

Its velocity in body axes is the speed, with nothing across and upwards but slip. The force less
gravity is the change of that velocity, so that pushes and turns of any length are known for what
they are, and do not tilt the attitude: f = v' + w x v + R^T g (Groves 2013, section 15.4, calls the
two parts without speed the nonholonomic constraints).

While speeds come the body is not one that stays in its place. Before the first and after the last
the velocity begins anew.
"""

from __future__ import annotations

from dataclasses import replace

import casadi as ca

from pyimu.attitude.filter import unscented
from pyimu.attitude.filter.gravity_update import INNOVATION_GATE, less_sure, reported, vertical
from pyimu.attitude.filter.layout import GravityMeasurement, Layout
from pyimu.attitude.filter.memory import ESTIMATE, Memory
from pyimu.attitude.filter.unscented import Estimate
from pyimu.attitude.filter.variables import INPUTS, LEAST_SPEED_STD, OWN_PARAMETERS
from pyimu.attitude.filter.velocity import at_rest, covariance_of_motion
from pyimu.block.plain import plain_function

SPEED, SPEED_VARIANCE = ([v.name for v in INPUTS].index(n) for n in ("speed", "speed_variance"))

SLIP = [v.name for v in OWN_PARAMETERS].index("slip_std")

OPTIONS = {"cse": True}


def by_speed(layout: Layout) -> ca.Function:
    """``x, gravity, u, p -> x``: the working estimate after a speed."""
    symbols = working, packed, u, p = layout.symbols(ca.SX, "x gravity u p")
    x, given = Memory.estimate_of(working), GravityMeasurement.unpack(packed)
    off, noise = ca.vertcat(u[SPEED], 0, 0) - x.velocity, _noise(u, p)
    own, up = x.covariance[6:, 6:], vertical(x)
    after, _, weight = unscented.correct(
        x, off, own + noise, x.covariance[:, 6:], up, INNOVATION_GATE, seen=x.scaled[6:, :]
    )
    beyond = weight < 1
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


def _noise(u, p):
    """The covariance (3, 3) in (m/s)^2 of a speed as the velocity in body axes."""
    along, slip = u[SPEED_VARIANCE] + LEAST_SPEED_STD**2, p[SLIP] ** 2 + LEAST_SPEED_STD**2
    return ca.diag(ca.vertcat(along, slip, slip))
