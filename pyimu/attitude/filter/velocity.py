"""The body's velocity as three further error states: what tells tilt from acceleration in motion.

The specific force less gravity is the change of the velocity: v' = f - R^T g - w x v, in body axes.
A body that stays in its place has a bounded velocity, so that v = 0 is a measurement of it at every
sample, with the variance that the motion itself has; an error of the tilt makes the velocity grow
beyond. Without any motion the same measurement is that of gravity by the sample. The model is that
of navigation with zero velocity updates (Groves 2013, section 15.3), weighed by the motion.

In body axes the error of the velocity depends on the tilt alone and on no yaw, so that nothing is
learnt of the yaw. A body whose speed is known turns that velocity by its rate, and an error of the
rate turns it too far: e x v for the angle e that the rate is off. Of any other body that is left
out: of the second order.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import casadi as ca

from pyimu.attitude.filter.unscented import Estimate
from pyimu.symbolic import quaternion
from pyimu.symbolic.linear import reciprocal, symmetric

LEAST_STD = 0.01
"""m/s; of the velocity of a body that is turned in its place about a point near the sensor. Chosen
as the other times and factors here on recordings 02, 11 and 26 of BROAD
(``benchmarks/attitude_real.py``), and with seed 11 of ``benchmarks/attitude_honesty.py``."""

FIRST_STD = 0.08
"""m/s; of the velocity before the run has shown anything of it. A faster one shows at once
(``OUTLIER``), a slower one in several times ``WINDOW``."""

WINDOW, RISE = 8.0, 7.0
"""Correlation times of the velocity over which its variance is estimated, where it falls and where
it rises: the mean of so many squares is off by half of itself. With a rise that is much faster than
the fall, or with negative values taken for none, it would be too large."""

OUTLIER = 9.0
"""Squared velocity over its variance beyond which it shows by itself that this is too small."""

QUIET, QUIET_RISE = 60.0, 10.0
"""Correlation times of the velocity over which the run shows that a body moves less than the least
that was taken for it, where that share falls and where it rises again. A share falls by nothing
faster than linearly, to zero in so long, however unsure the filter's own velocity is."""

LEAST_SHARE = 0.01
"""Of the variances that a body has at least; a tenth of the velocity."""

SLOW = 3.0
"""Correlation times of the velocity over which it is averaged to see its drift."""

DRIFTS = 3.0
"""By which factor the mean square of that average must exceed what a bounded velocity leaves; that
does so with a probability of 5 %, exp(-3) of two axes."""

TINY = 1e-12
"""(m/s)^2; stands for no variance where it is divided by."""

SLIGHT = 0.005
"""m/s; a smaller drift is none."""

DRIFT_WINDOW, DRIFT_RISE = 60.0, 3.0
"""Correlation times of the velocity over which the drift is estimated, where it falls and where it
rises: a push shows as soon as the average does, and who drives now will push again."""

DRIFT_GAIN = 300.0
"""By how much the walk that is added to the velocity in a correlation time exceeds the drift that
is seen. The walk lets the filter follow the drift, and so take it away: what is left of it in the
end is a third of a hundredth."""


@dataclass(frozen=True)
class Push:
    """What a sample of the force changes of the velocity.

    ``change`` (3,) m/s is force times period, ``gravity`` in m/s that of gravity, both zero without
    a force; ``variance`` (3,) (m/s)^2 is added. ``driven`` says that the velocity is that of a
    speed.
    """

    change: ca.SX
    gravity: ca.SX
    variance: ca.SX
    driven: ca.SX | bool = False

    def carried(self, velocity):
        """The ``velocity`` (3,) m/s where it is that of a speed, else zero."""
        return ca.SX(3, 1) if self.driven is False else self.driven * velocity

    def tilting(self, up, carried):
        """t (3,) m/s: a tilt p after the period adds t x p to the velocity, ``up`` the vertical.

        So does an angle by which the body has turned further; ``carried`` (3,) m/s is what it turns
        of the velocity, in new axes.
        """
        return carried - self.gravity * up


@dataclass(frozen=True)
class Motion:
    """How much the body moves, as the run itself has shown.

    ``across`` and ``along`` the vertical the variance of its velocity in (m/s)^2. ``slow`` (3,) m/s
    is the estimated velocity in body axes less what is fast in it, ``drift`` (m/s)^2 its variance
    across beyond ``DRIFTS`` times that of a bounded velocity. ``share`` is how much of the least
    variances that the settings speak of the body shows at most, ``LEAST_SHARE`` to 1.
    """

    across: ca.SX
    along: ca.SX
    slow: ca.SX
    drift: ca.SX
    share: ca.SX


def pushed(before: Estimate, after: Estimate, own, leak, push: Push) -> Estimate:
    """The estimate ``after`` a period, of attitude and bias alone, with the velocity.

    ``own`` (3, 3) is the body's turn from old axes to new, ``leak`` (3, 3) the attitude error that
    an error of the bias makes in the period, in new axes. The error of the velocity becomes own v -
    g h [u] p + [c] (p - own o), linearly, with u the vertical, p the attitude error after the
    period and o that before it, and c what is ``carried`` of the velocity.
    """
    up, moved = quaternion.to_matrix(after.q)[2, :].T, own @ before.velocity
    carried = push.carried(moved)
    tilting, turning = ca.skew(push.tilting(up, carried)), ca.skew(carried)
    pp, pb = before.covariance[:3, :3], before.covariance[:3, 3:6]
    vp, vb, vv = (before.covariance[6:, at] for at in (slice(0, 3), slice(3, 6), slice(6, 9)))
    turned, biased = own @ vp - turning @ (own @ pp), own @ vb - turning @ (own @ pb)
    shared = turned @ own.T
    both = shared + biased @ leak.T
    attitude = both + tilting @ after.covariance[:3, :3]
    bias = biased + tilting @ after.covariance[:3, 3:]
    half, one, two = own @ vv, tilting @ both.T, attitude @ tilting.T
    lessened = turning @ shared.T
    lessened += lessened.T + turning @ (own @ pp @ own.T) @ turning.T

    def entry(i: int, j: int):
        if j < 6:
            return after.covariance[i, j]
        if i < 6:
            return attitude[j - 6, i] if i < 3 else bias[j - 6, i - 3]
        k, m = i - 6, j - 6
        whole = ca.dot(half[k, :], own[m, :]) + one[k, m] + two[k, m] - lessened[k, m]
        return whole + push.variance[k] if k == m else whole

    velocity = moved + push.change - push.gravity * up
    return Estimate(after.q, after.bias, velocity, symmetric(9, entry))


def least_std(at: Mapping[str, ca.SX]):
    """Standard deviation [m/s] of the velocity that a body has at least, by the settings ``at``.

    Zero where they say that it never accelerates.
    """
    declared = at["accel_std"] * at["motion_time"]
    return ca.fmax(declared, LEAST_STD) * (declared > 0)


def first_std(at: Mapping[str, ca.SX]):
    """Standard deviation [m/s] of the velocity before the first sample, by the settings ``at``."""
    return ca.fmax(least_std(at), FIRST_STD) * (least_std(at) > 0)


def at_rest(x: Estimate, motion) -> Estimate:
    """The estimate of attitude and bias with a velocity of which only its variances are known.

    ``motion`` (3, 3) is its covariance in (m/s)^2.
    """
    covariance = ca.diagcat(x.covariance[:6, :6], motion)
    return Estimate(x.q, x.bias, ca.SX.zeros(3), covariance)


def covariance_of_motion(across, along, up):
    """The covariance (3, 3) in body axes of a velocity with variances ``across`` and ``along``."""
    return symmetric(3, lambda i, j: across * (i == j) + (along - across) * up[i] * up[j])


def followed(motion: Motion, x: Estimate, turned, used, std, time, h) -> tuple[Motion, ca.SX]:
    """The motion after one more sample, whose velocity ``x`` has before its measurement.

    With it the variance (2,) across and along the vertical by which that velocity is measured.

    The mean square of the innovation, less the filter's own variance of it, is that of the
    measurement (Mehra 1972, section IV), here the velocity of the body: over ``WINDOW`` or ``RISE``
    times its correlation ``time`` in s, and not below the share of ``std`` in m/s that the run
    shows. The innovations of a filter whose model is right are white (section III there): their
    mean over ``SLOW`` times that time has half their density over that, the density 2 T s^2 of the
    velocity and P h of the filter's own variance. What it has beyond ``DRIFTS`` times that, and
    ``SLIGHT``, is a walk: accelerations that last. ``turned`` (3, 3) is the body's turn from old
    axes to new; ``used`` 0 or 1 whether the sample counts. A ``std`` of zero says that the body
    does not move.
    """
    v, up = x.velocity, quaternion.to_matrix(x.q)[2, :].T
    own, whole = x.covariance[6:, 6:], ca.dot(x.velocity, x.velocity)
    above, own_along = ca.dot(up, v) ** 2, ca.dot(up, own @ up)
    own_across = (ca.trace(own) - own_along) / 2
    moves, floor = std > 0, std**2
    least = motion.share * floor

    def mean(before, found, fall, rise):
        gain = h / (ca.if_else(found > before, rise, fall) * time + h)
        return before + used * gain * (found - before)

    def grown(before, excess):
        after = moves * ca.fmax(mean(before, excess, WINDOW, RISE), least)
        return after, moves * ca.fmax(after, excess / OUTLIER)

    excess = (whole - above) / 2 - own_across
    across, seen_across = grown(motion.across, excess)
    along, seen_along = grown(motion.along, above - own_along)
    carried = turned @ motion.slow
    slow = used * (carried + h / (SLOW * time + h) * (v - carried))
    white = across * time + own_across * h / 2
    bounded = DRIFTS / SLOW * white * reciprocal(time)
    left = (ca.dot(slow, slow) - ca.dot(up, slow) ** 2) / 2 - bounded - SLIGHT**2
    drift = moves * mean(motion.drift, ca.fmax(left, 0), DRIFT_WINDOW, DRIFT_RISE)
    shown = (excess + DRIFT_GAIN * drift) * reciprocal(ca.fmax(floor, TINY))
    share = _share(motion.share, shown, used, time, h)
    return Motion(across, along, slow, drift, share), ca.vertcat(seen_across, seen_along)


def _share(before, shown, used, time, h):
    """The share of the least variances of motion after a sample that has ``shown`` so much of them.

    A walk that lets the filter follow pushes hides them from its velocity, and counts as shown.
    """
    gain = h / (ca.if_else(shown > before, QUIET_RISE, QUIET) * time + h)
    after = before + used * gain * (ca.fmax(shown, -1) - before)
    return ca.fmin(ca.fmax(after, LEAST_SHARE), 1)
