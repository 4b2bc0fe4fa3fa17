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

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import casadi as ca
import numpy as np

from pyimu.attitude.filter import long_push, slow_motion
from pyimu.attitude.filter.gathered import SIZES as GATHERED_SIZES
from pyimu.attitude.filter.gathered import Gathered
from pyimu.attitude.filter.long_push import SIZES as LONG_SIZES
from pyimu.attitude.filter.long_push import LongPush
from pyimu.attitude.filter.slow_motion import SIZES as SLOW_SIZES
from pyimu.attitude.filter.slow_motion import TINY, Bounds, SlowMotion
from pyimu.attitude.filter.unscented import Estimate
from pyimu.symbolic import quaternion
from pyimu.symbolic.linear import reciprocal, symmetric

FIRST_STD = 0.08
"""m/s; of the velocity before the run has shown anything of it. A faster one shows at once
(``OUTLIER``). The times and factors here were chosen on recordings 02, 11 and 26 of BROAD
(``benchmarks/attitude_real.py``), and with seeds 11 and 911 of
``benchmarks/attitude_honesty.py``."""

FIRST_TIME = 2.0
"""Correlation times of the velocity over which a slower one must show to count as much as that."""

UNLEVELLED, MOST_AT_FIRST = 0.3, 0.3
"""s, m/s; a body whose tilt is not known is in motion, as one that is held or flies, with a
velocity of so many seconds of the force that tilts it, and at most of this."""

PUSHED_FOR = 6.0
"""s; a body that is on its way before the first sample has the velocity of its pushes over so
long. With 3 s a drone that circles is 1.3 times as far off and a car as far, with 12 s a fast hand
1.1 times; chosen with seeds 0, 2, 4 and 6 as ``underway.LENGTH``."""

WINDOW, RISE = 8.0, 7.0
"""Correlation times of the velocity over which its variance is estimated, where it falls and where
it rises: the mean of so many squares is off by half of itself. With a rise that is much faster than
the fall, or with negative values taken for none, it would be too large."""

ALIKE = 2.0
"""Of a body that the run has not shown yet, and whose tilt was not known, the variance of the
velocity across the vertical is at least so many times that along it. Such a tilt, and its bias, fit
themselves to waves that push the body to and fro, and no velocity across shows in them; one along
the vertical does. Chosen on the boats of ``benchmarks/attitude_honesty.py`` with seed 77, runs 0 to
5."""

OUTLIER = 9.0
"""Squared velocity over its variance beyond which it shows by itself that this is too small."""

SLOW = 3.0
"""Correlation times of the velocity over which it is averaged to see its drift."""

DRIFTS = 3.0
"""By which factor the mean square of that average must exceed what a bounded velocity leaves; that
does so with a probability of 5 %, exp(-3) of two axes."""

SLIGHT = 0.005
"""m/s; a smaller drift is none."""

DRIFT_WINDOW, DRIFT_RISE = 60.0, 3.0
"""Correlation times of the velocity over which the drift is estimated, where it falls and where it
rises: a push shows as soon as the average does, and who drives now will push again."""

DRIFT_GAIN = 300.0
"""By how much the walk that is added to the velocity in a correlation time exceeds the drift that
is seen. The walk lets the filter follow the drift, and so take it away: what is left of it in the
end is a third of a hundredth."""

FLAT = 1e-13
"""Least share of the larger of the two variances of a velocity, across the vertical and along it,
that the smaller has: some hundred units in the last place."""


@dataclass(frozen=True)
class Push:
    """What a sample of the force changes of the velocity.

    ``change`` (3,) m/s is force times period, ``gravity`` in m/s that of gravity, both zero without
    a force; ``variance`` (3,) (m/s)^2 is added. ``driven`` says that the velocity is that of a
    speed; ``axes_std`` rad is then the setting.
    """

    change: ca.SX
    gravity: ca.SX
    variance: ca.SX
    driven: ca.SX | bool = False
    axes_std: ca.SX | float = 0.0

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

    ``across`` and ``along`` the vertical the variance of its velocity in (m/s)^2. ``slow`` (2,) m/s
    is the estimated velocity east and north less what is fast in it, ``drift`` (m/s)^2 its variance
    beyond ``DRIFTS`` times that of a bounded velocity. ``slowly`` is what is slow in it, ``known``
    over how many correlation times the run has shown it, ``WINDOW`` at most; ``long`` are the
    pushes that last. ``by_scale`` is which share of the tilt that the gyro's scale factors may have
    made shows in the velocity, 0 to 1. ``gathered`` is what samples have shown since all that was
    last followed.
    """

    across: ca.SX
    along: ca.SX
    slow: ca.SX
    drift: ca.SX
    known: ca.SX
    by_scale: ca.SX
    slowly: SlowMotion
    long: LongPush
    gathered: Gathered

    @classmethod
    def start(cls, std, time, pushed: ca.SX | float = 0.0) -> Motion:
        """That before the first sample: a velocity of the standard deviation ``std`` m/s and the
        correlation ``time`` s; ``pushed`` (m/s^2)^2 is the variance of pushes that last.
        """
        first = std**2
        none = ca.SX.zeros(2), ca.SX(0), ca.SX(0), ca.SX(0)
        parts = SlowMotion.start(first, time), LongPush.start(pushed), Gathered.start()
        return cls(first, first, *none, *parts)

    def pack(self, kept: Callable = lambda value: value) -> ca.SX:
        """Its numbers as a column, in the order of ``SIZES``; ``kept`` is applied to those that may
        fade.
        """
        across, along, *others = list(vars(self).values())[:OWN]
        parts = self.slowly, self.long, self.gathered
        fading = *others, *(v for part in parts for v in part.pack())
        return ca.densify(ca.vertcat(across, along, *(kept(v) for v in fading)))

    @classmethod
    def unpack(cls, column) -> Motion:
        """The inverse of ``pack``."""
        parts = ca.vertsplit(column, np.cumsum([0, *SIZES]).tolist())
        after = OWN + len(SLOW_SIZES)
        last = after + len(LONG_SIZES)
        slowly, long = SlowMotion(*parts[OWN:after]), LongPush(*parts[after:last])
        return cls(*parts[:OWN], slowly, long, Gathered(*parts[last:]))


OWN = 6
"""Parts of a ``Motion`` that have no parts."""

SIZES = (1, 1, 2, 1, 1, 1, *SLOW_SIZES, *LONG_SIZES, *GATHERED_SIZES)
"""Of what ``Motion.pack`` gives."""


@dataclass(frozen=True)
class Bounded:
    """The velocity of a body that stays in its place, as it is measured to be zero.

    ``variance`` (2,) (m/s)^2 across and along the vertical; ``slow`` is its density at low
    frequency over that of the correlation time of the settings.
    """

    variance: ca.SX
    slow: ca.SX


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
    return Estimate(after.q, after.bias, velocity, symmetric(9, entry), after.scaled)


def rescaled(before: Estimate, q, own, leak, rate, scale_std, push: Push):
    """``Estimate.scaled`` a period later, at the attitude ``q``, by the arguments of ``pushed``.

    The ``rate`` (3,) rad/s turns the body by the share ``scale_std`` of it too far, about each
    axis, as a bias of that size does. In a turn that goes on this grows as the angle, and a turn
    back takes it away, which no white noise does. The gains know nothing of it, but for those of a
    speed, and the estimates stay what they are: each correction takes of it what it sees, as in
    Schmidt's consider filter.

    Of a body that is driven the rate is also askew by ``Push.axes_std`` against the vertical that
    its accelerometer shows. What it carries of its velocity turns as the gyro says: of the angle
    the forces upwards would seem to show that it is none, where a bias of the accelerometer makes
    it.
    """
    up, moved = quaternion.to_matrix(q)[2, :].T, own @ before.velocity
    carried = push.carried(moved)
    p, b, v = (before.scaled[at, :] for at in (slice(0, 3), slice(3, 6), slice(6, 9)))
    turned = own @ p
    rate = rate - before.bias
    askew = push.axes_std * (leak @ ca.skew(rate))
    attitude = turned + leak @ (b + scale_std * ca.diag(rate)) + askew
    velocity = own @ v - ca.skew(carried) @ (turned + askew)
    velocity += ca.skew(push.tilting(up, carried)) @ attitude
    return ca.vertcat(attitude, b, velocity)


def first_std(at: Mapping[str, ca.SX]):
    """Standard deviation [m/s] of the velocity before the first sample, by the settings ``at``.

    Zero where they say that it never accelerates, larger where no rest has shown the tilt, and of a
    body that was on its way.
    """
    least = ca.fmax(FIRST_STD, MOST_AT_FIRST * unlevelled(at))
    least = ca.fmax(least, PUSHED_FOR * at["push_std"])
    return ca.fmax(at["accel_std"] * at["motion_time"], least) * (at["accel_std"] > 0)


def first_push(at: Mapping[str, ca.SX]):
    """Variance [(m/s^2)^2] of the pushes that last before the first sample, by the settings ``at``.

    Zero where they say that it never accelerates.
    """
    return at["push_std"] ** 2 * (at["accel_std"] > 0)


def unlevelled(at: Mapping[str, ca.SX]):
    """How little is known of the tilt before the first sample, by the settings ``at``: 0 of a body
    that is level, 1 of one that may move by ``MOST_AT_FIRST``.
    """
    tilted = UNLEVELLED / MOST_AT_FIRST * at["gravity"] * _first_tilt_std(at)
    return ca.fmin(ca.fmax(tilted, at["push_std"] > 0), 1)


def _first_tilt_std(at: Mapping[str, ca.SX]):
    """Standard deviation [rad] of the tilt before the first sample, the mean of its two axes."""
    w, x, y, z = (at[f"q0[{i}]"] for i in (1, 2, 3, 4))
    up = ca.vertcat(2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z)
    along = up**2 * reciprocal(ca.sumsqr(up) + TINY)
    std = ca.vertcat(*[at[f"std0[{i}]"] for i in (1, 2, 3)])
    return ca.sqrt(ca.dot(1 - along, std**2) / 2)


def at_rest(x: Estimate, motion) -> Estimate:
    """The estimate of attitude and bias with a velocity of which only its variances are known.

    ``motion`` (3, 3) is its covariance in (m/s)^2.
    """
    covariance = ca.diagcat(x.covariance[:6, :6], motion)
    scaled = None if x.scaled is None else ca.vertcat(x.scaled[:6, :], ca.SX.zeros(3, 3))
    return Estimate(x.q, x.bias, ca.SX.zeros(3), covariance, scaled)


def covariance_of_motion(across, along, up):
    """The covariance (3, 3) in body axes of a velocity with variances ``across`` and ``along``.

    Of a velocity that seems to grow without end along the one, and not to be along the other, the
    smaller would be lost in the rounding of the larger, and the matrix indefinite.
    """
    across, along = ca.fmax(across, FLAT * along), ca.fmax(along, FLAT * across)
    return symmetric(3, lambda i, j: across * (i == j) + (along - across) * up[i] * up[j])


def with_sample(
    motion: Motion, x: Estimate, force, used, pushes, goes_on, may, moves, h
) -> tuple[Motion, Bounded]:
    """The motion with what one more sample shows of it, and how the velocity ``x`` has before its
    measurement is measured.

    A velocity that is much larger than what was found so far shows at once. ``force`` (3,) m/s^2 is
    the sample's. ``used`` 0 or 1 says whether the sample counts and ``goes_on`` whether the motion
    does, ``pushes`` and ``may`` the same of pushes that last, ``moves`` whether the body moves at
    all.
    """
    v, axes = x.velocity, quaternion.to_matrix(x.q)
    up, own = axes[2, :].T, x.covariance[6:, 6:]
    above, own_along = ca.dot(up, v) ** 2, ca.dot(up, own @ up)
    own_across = (ca.trace(own) - own_along) / 2
    squares = ca.vertcat((ca.dot(v, v) - above) / 2 - own_across, above - own_along)
    level, force = axes[:2, :] @ v, axes[:2, :] @ force
    gathered = motion.gathered.with_sample(
        level, squares, own_across, force, used, pushes, goes_on, may, h
    )
    seen = ca.vertcat(motion.across, motion.along)
    variance = moves * ca.fmax(seen, squares * (1 / OUTLIER))
    long = replace(motion.long, force=may * motion.long.force, first=may * motion.long.first)
    slow, by_scale = goes_on * motion.slow, goes_on * motion.by_scale
    after = replace(motion, slow=slow, by_scale=by_scale, long=long, gathered=gathered)
    return after, Bounded(variance, motion.slowly.share)


def followed(motion: Motion, x: Estimate, moves, bounds: Bounds, tilted, h) -> Motion:
    """The motion after a look at what was ``gathered`` of it, with the estimate ``x`` of now.

    The mean square of the innovation, less the filter's own variance of it, is that of the
    measurement (Mehra 1972, section IV), here the velocity of the body: over ``WINDOW`` or ``RISE``
    times its correlation time T of ``bounds``, at first no less across than along the vertical
    (``ALIKE``). The innovations of a filter whose model is right are
    white (section III there): their mean over ``SLOW`` times T has half their density over that,
    the density 2 T s^2 of the velocity and P h of the filter's own variance. What it has beyond
    ``DRIFTS`` times that, and times what the gyro's scale factors may make of it, and ``SLIGHT``,
    is a walk: accelerations that last. While the body may be pushed as none was yet
    (``LongPush.is_excluded``), its velocity walks so freely that it shows none of this. What a tilt
    by these scale factors makes of it is compared with all of it but the bounded one's. ``moves`` 0
    or 1 says whether the body moves at all, ``tilted`` (m/s^2)^2 is the variance that its tilt
    makes of the force on a level axis.
    """
    time, gathered = bounds.time, motion.gathered
    level, squares, own, force = gathered.means()
    span = gathered.span
    least = bounds.least / 2 * reciprocal(time + h)
    shows = motion.long.is_excluded
    window = ca.fmin(motion.known + FIRST_TIME, WINDOW)
    known = ca.fmin(motion.known + shows * span * reciprocal(time + span), WINDOW)

    def mean(before, found, fall, rise):
        gain = ca.if_else(found > before, span / (rise * time + span), span / (fall * time + span))
        return before + shows * gain * (found - before)

    across, along = (
        moves * ca.fmax(mean(before, squares[i], window, RISE), least)
        for i, before in enumerate((motion.across, motion.along))
    )
    across = ca.fmax(across, ALIKE * bounds.unlevelled * (1 - known * (1 / WINDOW)) * along)
    slow = motion.slow + span / (SLOW * time + span) * (level - motion.slow)
    beyond = _beyond_bounded(slow, across, own, time, h)
    scaled = _by_scale(x, quaternion.to_matrix(x.q))
    left = beyond - DRIFTS * scaled
    drift = moves * mean(motion.drift, ca.fmax(left, 0), DRIFT_WINDOW, DRIFT_RISE)
    seen = moves * ca.fmax(across, squares[0] * (1 / OUTLIER))
    slowly = slow_motion.followed(motion.slowly, level, seen, drift, own, bounds, span, h)
    shown = ca.fmin(ca.fmax(beyond, 0) * reciprocal(scaled + TINY), 1)
    pushed_for = gathered.pushed_for
    long = long_push.followed(motion.long, force, tilted, motion.across, time, pushed_for)
    return Motion(across, along, slow, drift, known, shown, slowly, long, Gathered.start())


def _beyond_bounded(slow, across, own_across, time, h):
    """(m/s)^2; what the mean square of the ``slow`` velocity (2,) m/s has beyond ``DRIFTS`` times
    that of a bounded velocity, of which ``across`` is the variance, and beyond ``SLIGHT``.
    """
    white = across * time + own_across * h / 2
    return ca.sumsqr(slow) / 2 - DRIFTS / SLOW * white * reciprocal(time) - SLIGHT**2


def _by_scale(x: Estimate, axes):
    """(m/s)^2; the variance of a level axis of the velocity that the gyro's scale factors make."""
    return ca.sumsqr(axes[:2, :] @ x.scaled[6:, :]) / 2
