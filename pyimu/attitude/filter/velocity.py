"""The body's velocity as three further error states: what tells tilt from acceleration in motion.

The specific force less gravity is the change of the velocity: v' = f - R^T g - w x v, in body axes.
A body that stays in its place has a bounded velocity, so that v = 0 is a measurement of it at every
sample, with the variance that the motion itself has; an error of the tilt makes the velocity grow
beyond. Without any motion the same measurement is that of gravity by the sample. The model is that
of navigation with zero velocity updates (Groves 2013, section 15.3), weighed by the motion.

In body axes the error of the velocity depends on the tilt alone and on no yaw, so that nothing is
learnt of the yaw. What an error of the rate turns of the velocity itself is left out: of the second
order.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import casadi as ca

from pyimu.attitude.filter.unscented import Estimate
from pyimu.symbolic import quaternion
from pyimu.symbolic.linear import symmetric

WINDOW = 10.0
"""Correlation times of the velocity over which its variance is estimated: the mean of so many
squares is off by half of itself."""

SLOW = 2.0
"""Correlation times of the velocity over which it is averaged to see its drift: of a bounded
velocity that leaves 1/(1 + SLOW) of the variance."""

DRIFT_GAIN = 100.0
"""By how much the walk that is added to the velocity in a correlation time exceeds the drift that
is seen. The walk lets the filter follow the drift, and so take it away: what is left of it in the
end is a hundredth."""


@dataclass(frozen=True)
class Push:
    """What a sample of the force changes of the velocity.

    ``change`` (3,) m/s is force times period, ``gravity`` in m/s that of gravity, both zero without
    a force; ``variance`` (3,) (m/s)^2 is added.
    """

    change: ca.SX
    gravity: ca.SX
    variance: ca.SX


@dataclass(frozen=True)
class Motion:
    """How much the body moves, as the run itself has shown.

    ``across`` and ``along`` the vertical the variance of its velocity in (m/s)^2. ``slow`` (3,) m/s
    is the estimated velocity in body axes less what is fast in it, ``drift`` (m/s)^2 its variance
    across beyond that of a bounded velocity.
    """

    across: ca.SX
    along: ca.SX
    slow: ca.SX
    drift: ca.SX


def pushed(before: Estimate, after: Estimate, own, leak, push: Push) -> Estimate:
    """The estimate ``after`` a period, of attitude and bias alone, with the velocity.

    ``own`` (3, 3) is the body's turn from old axes to new, ``leak`` (3, 3) the attitude error that
    an error of the bias makes in the period, in new axes. The error of the velocity becomes own v -
    g h [u] p with u the vertical and p the attitude error after the period, linearly.
    """
    up = quaternion.to_matrix(after.q)[2, :].T
    tilting = tilted(up, push)
    vp, vb, vv = (before.covariance[6:, at] for at in (slice(0, 3), slice(3, 6), slice(6, 9)))
    turned = own @ vp
    carried, biased = turned @ own.T + (own @ vb) @ leak.T, own @ vb
    attitude = carried + tilting @ after.covariance[:3, :3]
    bias = biased + tilting @ after.covariance[:3, 3:]
    half, one, two = own @ vv, tilting @ carried.T, attitude @ tilting.T

    def entry(i: int, j: int):
        if j < 6:
            return after.covariance[i, j]
        if i < 6:
            return attitude[j - 6, i] if i < 3 else bias[j - 6, i - 3]
        k, m = i - 6, j - 6
        whole = ca.dot(half[k, :], own[m, :]) + one[k, m] + two[k, m]
        return whole + push.variance[k] if k == m else whole

    velocity = own @ before.velocity + push.change - push.gravity * up
    return Estimate(after.q, after.bias, velocity, symmetric(9, entry))


def tilted(up, push: Push):
    """The error (3, 3) of the velocity that a tilt makes in a period; ``up`` is the vertical."""
    return -push.gravity * ca.skew(up)


def least_std(at: Mapping[str, ca.SX]):
    """Standard deviation [m/s] of the velocity that a body has at least, by the settings ``at``."""
    return at["accel_std"] * at["motion_time"]


def at_rest(x: Estimate, motion) -> Estimate:
    """The estimate of attitude and bias with a velocity of which only its variances are known.

    ``motion`` (3, 3) is its covariance in (m/s)^2.
    """
    covariance = ca.diagcat(x.covariance[:6, :6], motion)
    return Estimate(x.q, x.bias, ca.SX.zeros(3), covariance)


def covariance_of_motion(across, along, up):
    """The covariance (3, 3) in body axes of a velocity with variances ``across`` and ``along``."""
    return symmetric(3, lambda i, j: across * (i == j) + (along - across) * up[i] * up[j])


def followed(motion: Motion, x: Estimate, turned, used, std, time, h) -> Motion:
    """The motion after one more sample, whose velocity ``x`` has before its measurement.

    The mean square of the innovation, less the filter's own variance of it, is that of the
    measurement (Mehra 1972, section IV), here the velocity of the body: over ``WINDOW`` times its
    correlation ``time`` in s, and not below that of ``std`` in m/s. What an average over ``SLOW``
    times that time has beyond that is a walk: accelerations that last. ``turned`` (3, 3) is the
    body's turn from old axes to new; ``used`` 0 or 1 whether the sample counts. A ``std`` of zero
    says that the body does not move.
    """
    v, up = x.velocity, quaternion.to_matrix(x.q)[2, :].T
    own, whole = x.covariance[6:, 6:], ca.dot(x.velocity, x.velocity)
    above, own_along = ca.dot(up, v) ** 2, ca.dot(up, own @ up)
    own_across = (ca.trace(own) - own_along) / 2
    gain, floor = used * h / (WINDOW * time + h), std**2

    def mean(before, excess):
        return before + gain * (ca.fmax(excess, 0) - before)

    across = ca.fmax(mean(motion.across, (whole - above) / 2 - own_across), floor)
    along = ca.fmax(mean(motion.along, above - own_along), floor)
    carried = turned @ motion.slow
    slow = used * (carried + h / (SLOW * time + h) * (v - carried))
    left = (ca.dot(slow, slow) - ca.dot(up, slow) ** 2) / 2 - (across + own_across) * (
        1 / (1 + SLOW)
    )
    moves = std > 0
    return Motion(moves * across, moves * along, slow, moves * mean(motion.drift, left))
