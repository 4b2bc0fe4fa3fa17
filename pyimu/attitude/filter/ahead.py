"""A unit whose gyro is late: its outputs belong to now, its estimate to an earlier instant.

The body is taken to turn on as it did then. What that leaves out follows from how the rate has
changed over the delay, and is in the standard deviations.
"""

from __future__ import annotations

from dataclasses import replace

import casadi as ca

from pyimu.attitude.filter.compensation import RATES
from pyimu.attitude.filter.gravity_update import constant_variance
from pyimu.attitude.filter.layout import Layout
from pyimu.attitude.filter.memory import Memory
from pyimu.attitude.filter.settings import Settings
from pyimu.attitude.filter.timing import estimate_latency
from pyimu.attitude.filter.updates import outputs
from pyimu.attitude.filter.variables import FOUND, INPUTS, OUTPUTS
from pyimu.block.plain import plain_function
from pyimu.symbolic import quaternion
from pyimu.symbolic.linear import symmetric

OPTIONS = {"cse": True}

HEADING, AGE = ([v.name for v in INPUTS].index(n) for n in ("heading", "heading_age"))


def shown_now(layout: Layout) -> ca.Function:
    """``estimate, memory, y, p, h -> y``: the outputs turned on over the estimate's delay d.

    q' = q exp((w - b) d), and with R the turn its error is R^T p - d e_b + d n + d^2 w'/2: that of
    the bias, the last sample's noise n, of which the estimate has h n already, and how the rate
    changes. Of d w' the difference of the rate and its mean over d is the size. An axis that is
    lost may turn by any rate.
    """
    estimate, memory, p, h = symbols = layout.symbols(ca.SX, "estimate memory p h")
    y = ca.SX.sym("y", len(OUTPUTS))
    settings, delay = Settings.of(layout.compensation, p), _delay(layout, p, h)
    kept = Memory.unpack(estimate, memory, layout.compensation)
    x, rate, mean = kept.estimate, *ca.vertsplit(kept.sensors[-RATES:], RATES // 2)
    turn = quaternion.exponential(delay * (rate - x.bias))
    own = quaternion.to_matrix(turn).T
    pp, pb, bb = x.covariance[:3, :3], x.covariance[:3, 3:6], x.covariance[3:6, 3:6]
    mixed = -delay * own @ pb
    attitude = own @ pp @ own.T + mixed + mixed.T + delay**2 * bb
    lost = (kept.lost_for > 0) * settings.scalar["lost_rate_std"]
    left = (delay * (rate - mean) / 2) ** 2 + (delay * lost) ** 2
    left += (delay**2 / h + 2 * ca.fmax(delay, 0)) * settings.gyro.white**2
    covariance = symmetric(
        6, lambda i, j: attitude[i, j] + (left[i] if i == j else 0) if j < 3 else x.covariance[i, j]
    )
    scaled = ca.vertcat(own @ x.scaled[:3, :] - delay * x.scaled[3:6, :], x.scaled[3:, :])
    now = replace(x, q=quaternion.product(x.q, turn), covariance=covariance, scaled=scaled)
    found = [y[i] for i in FOUND]
    shown = outputs(now, *found, constant_variance(kept.size, settings))
    return plain_function("shown_now", [*symbols[:2], y, p, h], [shown], OPTIONS)


def headings_of_the_sample(layout: Layout) -> ca.Function:
    """``estimate, memory, u, p, h -> u``: the inputs with a heading as it was at the estimate's
    instant.

    One that is older than that is younger by the delay; from a newer one is taken by how much the
    yaw has changed since. ``estimate`` and ``memory`` are those before the sample.
    """
    estimate, memory, u, p, h = symbols = layout.symbols(ca.SX, "estimate memory u p h")
    kept = Memory.unpack(estimate, memory, layout.compensation)
    x, rate, ahead = kept.estimate, kept.sensors[-RATES:][:3], _delay(layout, p, h) - u[AGE]
    newer = quaternion.exponential(ca.fmax(ahead, 0) * (rate - x.bias))
    turned = _yaw(quaternion.product(x.q, newer)) - _yaw(x.q)
    out = ca.vertcat(u[:HEADING], u[HEADING] - turned, u[HEADING + 1 :])
    # An age below zero is no age, and stays what it is.
    out[AGE] = ca.if_else(u[AGE] >= 0, ca.fmax(-ahead, 0), u[AGE])
    return plain_function("headings_of_the_sample", symbols, [out], OPTIONS)


def _delay(layout: Layout, p, h):
    gyro_p = Settings.of(layout.compensation, p).gyro_p
    return estimate_latency(layout.compensation.part.gyro, gyro_p, h)


def _yaw(q):
    return quaternion.to_euler(q)[2]
