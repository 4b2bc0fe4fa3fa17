"""The updates by gravity: what measures it, its weight, and its innovation gate.

While the tilt is known to a few degrees, the velocity of a body that stays in its place measures
gravity (``pyimu.attitude.filter.velocity``). Until then it is a sample of the specific force while
the body is quasi-static, and in motion the mean force of the last second
(``pyimu.attitude.filter.quasi_static``).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import casadi as ca

from pyimu.attitude.filter.layout import GRAVITY, GravityMeasurement
from pyimu.attitude.filter.long_push import LongPush
from pyimu.attitude.filter.memory import ESTIMATE, WORKING, Memory
from pyimu.attitude.filter.quasi_static import (
    MEAN_TIME,
    MEAN_TOLERANCE,
    GravitySize,
    MeanForce,
    QuasiStatic,
    average,
    follow,
    is_near,
    is_quasi_static,
    mean_variance,
    passing_std,
    where,
)
from pyimu.attitude.filter.sample import Sample
from pyimu.attitude.filter.settings import Settings
from pyimu.attitude.filter.stillness import FAST, STEADY
from pyimu.attitude.filter.unscented import Estimate, doubt
from pyimu.attitude.filter.variables import LEAST_ACCEL_STD
from pyimu.attitude.filter.velocity import (
    DRIFT_GAIN,
    Bounded,
    Push,
    at_rest,
    covariance_of_motion,
)
from pyimu.block.plain import plain_function
from pyimu.symbolic import quaternion
from pyimu.symbolic.linear import reciprocal, symmetric

INNOVATION_GATE = 25.0
"""Normalised innovation squared of three degrees of freedom, above which a measurement gets less
weight; it is exceeded with a probability of 1.5e-5."""

PUSHED = 25.0
"""The same of the two degrees of freedom across the vertical, above which a steady force is no rest
but a push: what is a rest and is taken for none leaves the tilt wrong for as long as it lasts. With
9, one of a hundred rests was lost, and more after a stop that had tilted the estimate."""

PUSH_TIME = 5.0
"""s; how long a vehicle turns or speeds up one way. A force that is off by its share is so for that
long: it is no noise from sample to sample, and does not average out as one."""

RECOVERY = 0.2
"""s; while gravity is beyond its innovation gate, the variance of the tilt grows by a factor of e
in this time."""

PUSH_STD = 0.2
"""m/s^2; of a push that lasts, before the run has shown any. Five times that, beyond which its
force contradicts a tilt that is known, are 0.1 g, a drive without haste. A larger one leaves a tilt
that is wrong by a fault wrong for longer; chosen on runs 100 to 115 of the vehicles of
``benchmarks/attitude_honesty.py``."""

SHOWN = 9.0
"""Variances of a mean force; what the square of its difference from gravity exceeds them by is no
noise of the accelerometer."""

LEAST_LEARNT = 1e-3
"""s; of rests over which the size of gravity is averaged, where it is divided by."""

SLOW_TIME = 0.3
"""s; velocity over acceleration of a slow motion by hand, of three rad/s."""

KNOWN_TILT = 0.05
"""rad; standard deviation of the tilt up to which the velocity measures gravity: what is not linear
in the tilt is then below 0.025 m/s^2."""

BESIDE = 0.02
"""s^2/m; by so much of a push that lasts the variance may be larger: half of it times gravity,
which is not linear, is then a tenth of the push."""

UPRIGHT = 0.88
"""Share of gravity that the mean force has along a vertical that may be right: it is off it by half
a radian then, which no push of a vehicle makes."""

MOST_TILT = 0.3
"""rad; beyond it what is linear in the tilt is off by a twentieth."""


@dataclass(frozen=True)
class Body:
    """What is known of the body: whether it ``rests``, with the mean force ``at_rest_force`` (3,),
    whether it is ``sure`` that it does not drive on, whether it is ``driven``, as speeds say, and
    the ``false_rate`` and ``upright`` (3,) of ``unscented.doubt``.
    """

    rests: ca.SX
    at_rest_force: ca.SX
    sure: ca.SX
    driven: ca.SX
    false_rate: ca.SX
    upright: ca.SX


@dataclass(frozen=True)
class Inclination:
    """What a sample of the accelerometer says of the inclination.

    The estimators after it, the ``measurement`` of gravity, whether that is ``usable`` by itself,
    whether the ``velocity`` is, and whether the body is ``quasi_static``.
    """

    quasi: QuasiStatic
    mean: MeanForce
    size: GravitySize
    measurement: GravityMeasurement
    usable: ca.SX
    velocity: ca.SX
    quasi_static: ca.SX


def inclination(
    memory: Memory,
    sample: Sample,
    x: Estimate,
    motion: Bounded,
    turned,
    settings: Settings,
    h,
    body: Body,
) -> Inclination:
    """The quasi-static estimator and the mean force one sample later, and the gravity they measure.

    ``x`` is the propagated estimate, ``turned`` (3, 3) its turn in inertial space in the period
    ``h`` s, from old axes to new. A constant force off the vertical is a push and no rest. The
    forces of a body that is driven do not raise doubts of the size of gravity.
    """
    at, valid, size = settings.scalar, sample.force_valid, memory.size.size
    tolerance = memory.size.tolerance(at["gravity"], at["gravity_tolerance"])
    white = white_variance(settings, h)
    noise = _acceleration_variance(passing_std(at), settings, h) + white
    magnitude = ca.norm_2(sample.force)
    quasi = follow(
        memory.quasi, magnitude, at["gravity_walk"] ** 2 * h, ca.sum1(noise) * (1 / 3), valid
    )
    carried = True if sample.gyro_lost is False else ca.logic_not(ca.mmax(sample.gyro_lost))
    mean = average(memory.mean, sample.force, turned, MEAN_TIME, h, valid, carried)
    steady = is_quasi_static(quasi, magnitude, size, tolerance, at["motion_tolerance"]) * (
        mean.scatter <= at["steady_tolerance"] ** 2 + 2 * ca.sum1(white)
    )
    plausible = where(
        valid, 1 - (1 - steady) * (1 - _is_mean_gravity(mean, size, tolerance, settings))
    )
    long = memory.motion.long
    known = is_tilt_known(x, memory, at)
    measured = _measured(sample.force, mean, steady, noise, white, long, settings, h)
    rests = body.rests * (1 - is_pushed(body.at_rest_force, x, settings, h))
    resting = rests * body.sure
    variance = _lessened(motion.variance, resting, _std_at_rest(at) ** 2)
    # Pushes that lasted are in a slow velocity, and not in that of a body that rests.
    slow = _lessened(motion.slow, resting, 1)
    pushed = memory.motion.drift * reciprocal(at["motion_time"] + h) ** 2
    pushed = ca.fmax(pushed, long.variance)
    contradicts = plausible * _contradicts(measured[0], mean, pushed, x, white, settings)
    motion = replace(motion, variance=variance, slow=slow)
    judged = plausible, contradicts, body.false_rate, body.upright
    given = _measurement(measured, size, motion, judged, settings, h)
    # A turn on wheels makes the force larger, but not its part along the vertical.
    up = vertical(x)
    seen = ca.if_else(known, ca.dot(up, mean.force), ca.norm_2(mean.force))
    upright = known * (ca.fabs(seen - size) <= tolerance)
    no_doubt = 1 - (1 - plausible) * (1 - body.driven) * (1 - upright)
    force = body.at_rest_force
    learnt = memory.size.followed(no_doubt, rests, force, seen, at["gravity"], valid, h)
    usable, velocity = plausible * (1 - known), where(valid, known)
    return Inclination(quasi, mean, learnt, given, usable, velocity, where(valid, steady))


def _lessened(value, resting, most):
    """The ``value``, and at most ``most`` where the body is ``resting``, 0 or 1."""
    return value + resting * (ca.fmin(value, most) - value)


def _measurement(measured, size, motion: Bounded, judged, settings: Settings, h):
    """What ``_measured`` gave and the ``motion`` as the updates take them; ``judged`` are the last
    of ``GravityMeasurement``.
    """
    at = settings.scalar
    return GravityMeasurement(
        *measured,
        size,
        h,
        motion.variance,
        2 * at["motion_time"] * motion.slow * reciprocal(h),
        2 * h * at["accel_correlation_time"] * at["accel_std"] ** 2,
        *judged,
    )


def _contradicts(force, mean: MeanForce, pushed, x: Estimate, white, settings: Settings):
    """Whether a ``force`` (3,) that may be gravity is too far off the vertical of ``x``.

    A tilt that is wrong from the start or by a fault makes a velocity that looks like motion; the
    force in itself tells them apart, where it is farther off than a push makes it. ``pushed``
    (m/s^2)^2 is the variance of the pushes that the run has seen.
    """
    passing = passing_std(settings.scalar)
    pushes = ca.fmax(ca.fmax(passing, PUSH_STD) ** 2, pushed)
    spread = ca.sum1(white) * (1 / 3) + (passing > 0) * pushes + SLOW_TIME**2 * mean.scatter
    return _is_off(force, x, spread, settings, INNOVATION_GATE)


def is_pushed(force, x: Estimate, settings: Settings, h):
    """Whether the mean ``force`` (3,) of a body that looks still pushes it, 0 or 1."""
    return _is_off(force, x, ca.sum1(white_variance(settings, h)) * (h / 3), settings, PUSHED)


def _is_off(force, x: Estimate, spread, settings: Settings, gate: float):
    """Whether a ``force`` (3,) is farther off the vertical of ``x`` than the tilt is known.

    ``spread`` (m/s^2)^2 is the variance of an axis of the force; ``gate`` is for the square over
    the variance.
    """
    up = vertical(x)
    off = ca.sumsqr(force) - ca.dot(up, force) ** 2
    own = settings.scalar["gravity"] ** 2 * tilt_variance(x.covariance, up)
    return off > gate * (own + spread)


def is_tilt_known(x: Estimate, memory: Memory, at: Mapping[str, ca.SX]):
    """Whether the tilt is known well enough for the velocity to be linear in its error, 0 or 1.

    Beside pushes that last what is not linear may be a share of them; and of a body that was on its
    way beside a velocity that changes much in its correlation time, unless the mean force says that
    the vertical is quite another one, as of a body that is called upright and hangs upside down.
    """
    motion, up = memory.motion, vertical(x)
    upright = ca.dot(up, memory.mean.force) > UPRIGHT * at["gravity"]
    changes = upright * (1 - motion.long.is_excluded) * motion.across
    changes *= reciprocal(at["motion_time"]) ** 2
    beside = ca.fmin(BESIDE * ca.sqrt(motion.long.variance + changes), MOST_TILT**2)
    return tilt_variance(x.covariance, up) <= KNOWN_TILT**2 + beside


def _std_at_rest(at: Mapping[str, ca.SX]):
    """Standard deviation in m/s of the velocity of a body at rest, by the settings ``at``.

    It is that of a motion which has begun and does not show yet: the mean force may be off by its
    share of the tolerance for the time of the fast mean. A larger one would leave the tilt so
    unsure that a velocity that begins is taken for it.
    """
    return STEADY * at["rest_force_tolerance"] * FAST


def constant_variance(size: GravitySize, settings: Settings):
    """Variance in rad^2 of the tilt by which an accelerometer is off that has a constant error.

    An error of b across gravity looks like a tilt of b / g, which no time averages out. Where its
    size is not known, what the accelerometer makes of the size of gravity tells of it, beyond what
    its noise makes of that.
    """
    at, white = settings.scalar, settings.accel.white
    by_noise = ca.sumsqr(white) * (1 / 3) * reciprocal(size.learnt + LEAST_LEARNT)
    beyond = ca.fmax(size.off(at["gravity"]) ** 2 - SHOWN * by_noise, 0)
    square = at["accel_bias_std"] ** 2 + beyond
    return square / ca.fmax(at["gravity"], LEAST_ACCEL_STD) ** 2


def push(memory: Memory, sample: Sample, settings: Settings, h, resting) -> Push:
    """What the sample changes of the velocity.

    Pushes that last are none where the body is ``resting``, 0 or 1. Where the velocity is that of a
    speed the acceleration is in the force, but for a share of it. A force that is lost is taken for
    gravity, with the scatter that it had: for as long as the body may keep an acceleration the
    unknown change of the velocity grows as its time.
    """
    at, valid = settings.scalar, sample.force_valid
    white = white_variance(settings, h)
    declared = _acceleration_variance(at["accel_std"], settings, h)
    lost_for = ca.fmin(ca.fmax(MEAN_TIME - memory.mean.span, 0), at["motion_time"])
    lost = memory.mean.scatter * (1 + 2 * lost_for * reciprocal(h))
    drift = (1 - resting) * DRIFT_GAIN * memory.motion.drift * h / (at["motion_time"] + h)
    drift += (1 - resting) * h * memory.motion.long.density(at["motion_time"])
    unknown, axes_std = h**2 * declared + drift, 0.0
    if sample.driven is not False:
        off = 2 * PUSH_TIME * h * (at["speed_tolerance"] * _acceleration(memory)) ** 2
        unknown = (1 - sample.driven) * unknown + sample.driven * off
        axes_std = sample.driven * at["axes_std"]
    return Push(
        where(valid, h * sample.force),
        where(valid, h * memory.size.size),
        h**2 * where(valid, white, lost) + unknown,
        sample.driven,
        axes_std,
    )


def _acceleration(memory: Memory):
    """The acceleration (3,) in m/s^2 in body axes, by the mean force of the last second."""
    return memory.mean.force - memory.size.size * vertical(memory.estimate)


def _acceleration_variance(std, settings: Settings, h):
    """Variance in (m/s^2)^2 of white noise in a sample that stands for an acceleration of ``std``.

    An acceleration that lasts for a correlation time T has the density 2 T sigma^2, so that a
    sample of white noise that stands for it has the variance 2 T sigma^2 / h: a faster log is not
    trusted more.
    """
    return std**2 * (1 + 2 * settings.scalar["accel_correlation_time"] * reciprocal(h))


def white_variance(settings: Settings, h):
    """Variance (3,) in (m/s^2)^2 of the white noise in a sample of the force."""
    accel, gravity = settings.accel, settings.scalar["gravity"]
    return (accel.white**2 + accel.relative**2 * gravity**2) * reciprocal(h) + LEAST_ACCEL_STD**2


def _is_mean_gravity(mean: MeanForce, size, tolerance, settings: Settings):
    """Whether the mean force spans enough time, and has the ``size`` of gravity."""
    at = settings.scalar
    # A push that lasts causes no scatter, so that for it the tolerance stays narrow.
    wider = tolerance + MEAN_TOLERANCE * ca.sqrt(mean.scatter)
    return (at["accel_std"] > 0) * (2 * mean.span > MEAN_TIME) * is_near(mean.force, size, wider)


def _measured(
    sampled, mean: MeanForce, steady, noise, white, long: LongPush, settings: Settings, h
):
    """The sampled force (3,) where the body is ``steady``, else the mean force, with its variance
    and that of one sample; each with the pushes that last.

    ``noise`` (3,) is the variance of the sampled force, ``white`` (3,) its part that is white
    noise. In a single sample the acceleration has its own variance, however long it lasts; that one
    decides whether a sample contradicts the attitude.
    """
    at = settings.scalar
    passing = passing_std(at) ** 2
    scatter = mean.scatter + passing
    noise = noise + 2 * passing * at["motion_time"] * reciprocal(h)
    in_motion = mean_variance(scatter, MEAN_TIME + h, h) + white
    force = mean.force + steady * (sampled - mean.force)
    variance = in_motion + steady * (noise - in_motion)
    lasting = MEAN_TIME + steady * (at["accel_correlation_time"] + at["motion_time"] - MEAN_TIME)
    of_sample = variance - (1 - 1 / (1 + 2 * lasting * reciprocal(h))) * (variance - white)
    pushed = long.density(at["motion_time"]) * reciprocal(h)
    return force, variance + pushed, of_sample + long.variance


def corrected(working, given: GravityMeasurement, x: Estimate, nis, weight):
    """The working estimate after the update by a force that is gravity.

    The update gave ``x``, the normalised innovation squared ``nis`` and its ``weight``. The
    velocity begins anew, as that of the motion.

    A few wrong samples change little. An attitude that is far off, such as one given upside down,
    becomes uncertain in time for gravity to correct it, without its error being taken for bias.
    """
    up, beyond = vertical(x), weight < 1
    moving = covariance_of_motion(given.motion[0], given.motion[1], up)
    after = at_rest(less_sure(x, up, beyond * given.period), moving)
    return reported(working, after, nis, beyond)


def scaled_in_gravity(x: Estimate, gravity):
    """What of ``Estimate.scaled`` is seen (3, 3) in ``gravity`` (3,), which an attitude error p
    turns by g x p.
    """
    return ca.skew(gravity) @ x.scaled[:3, :]


def by_velocity(correct: Callable) -> ca.Function:
    """``x, gravity -> x``: the working estimate after the update by the velocity of a body that
    stays in its place.

    That is measured as zero, with the variance of the motion. ``correct`` is the correction of one
    of the filters, by its arguments (``unscented.correct``). A velocity beyond all of the motion
    contradicts the attitude only where the force may be gravity.
    """
    symbols = working, packed = [ca.SX.sym("x", WORKING), ca.SX.sym("gravity", GRAVITY)]
    x, given = Memory.estimate_of(working), GravityMeasurement.unpack(packed)
    up, own = quaternion.to_matrix(x.q)[2, :].T, x.covariance[6:, 6:]
    moving = covariance_of_motion(given.motion[0], given.motion[1], up)
    after, nis, weight = correct(
        x,
        -x.velocity,
        own + given.lasting * moving,
        x.covariance[:, 6:],
        up,
        INNOVATION_GATE,
        own + moving - given.coloured * ca.SX.eye(3),
        given.plausible,
        x.scaled[6:, :],
        doubt(x, up, given.false_rate, given.upright),
    )
    contradicted = 1 - (1 - (weight < 1) * given.plausible) * (1 - given.contradicts)
    after = less_sure(after, up, contradicted * given.period)
    out = reported(working, after, nis, contradicted)
    return plain_function("by_velocity", symbols, [out], {"cse": True})


def less_sure(x: Estimate, up, time) -> Estimate:
    """The estimate with a tilt that was contradicted for ``time`` s less sure."""
    tilt = tilt_variance(x.covariance, up) * (time / RECOVERY)
    return replace(x, covariance=_with_tilt_variance(x.covariance, up, tilt))


def reported(working, after: Estimate, nis, beyond):
    """The ``working`` estimate with ``after`` in place of its estimate, and with its report."""
    yaw, others = working[ESTIMATE - 1], working[ESTIMATE + 2 :]
    return ca.vertcat(Memory.pack_estimate(after), yaw, nis, beyond, others)


def _with_tilt_variance(covariance, up, variance):
    """The covariance with ``variance`` added to the tilt, independent of the bias."""
    return symmetric(
        covariance.shape[0],
        lambda i, j: (
            covariance[i, j] + variance * ((i == j) - up[i] * up[j]) if j < 3 else covariance[i, j]
        ),
    )


def tilt_variance(covariance, up):
    """Variance of the tilt in rad^2, the mean of its two axes; ``up`` (3,) is the vertical."""
    pp = covariance[:3, :3]
    return (ca.trace(pp) - ca.dot(up, pp @ up)) / 2


def scaled_tilt(x: Estimate, up):
    """What the gyro's scale factors make of the tilt (3, 3) rad: ``Estimate.scaled`` less its part
    along the vertical, ``up`` (3,).
    """
    own = x.scaled[:3, :]
    return own - up @ (up.T @ own)


def vertical(x: Estimate):
    """The upward direction (3,) in body axes."""
    return quaternion.to_matrix(x.q)[2, :].T
