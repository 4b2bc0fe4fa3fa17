"""The quasi-static estimator: can the accelerometer serve as an inclinometer just now?

A scalar Kalman filter follows the magnitude of the specific force, x+ = x- + K (a - x-). A body
that does not accelerate measures the magnitude of gravity (Hidalgo 2012, section 5). The magnitude
hardly changes with an acceleration across gravity. Therefore a mean of the force over a second is
kept as well, turned along with the body as the gyro measures: what a sample differs from that mean
is acceleration. For a body in motion whose tilt is not known yet the mean itself is the measurement
of gravity, because a body that stays in its place has no mean acceleration (Laidig and Seel 2023
average in the same way, in the frame of the gyro alone).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import casadi as ca

from pyimu.symbolic.linear import reciprocal

MEAN_TIME = 1.0
"""s; time constant of the mean force."""

PASSING_STD = 0.1
"""m/s^2; of the acceleration, and of the error of a consumer's accelerometer, that a force still
passes for gravity with; chosen by hand-held recordings (``benchmarks/attitude_real.py``)."""

MEAN_TOLERANCE = 0.1
"""By which share of the force's root mean square against its mean the mean may differ from gravity
beyond its tolerance."""

HAND_TIME = 0.06
"""s; velocity over acceleration of a hand's motion, chosen by hand-held recordings
(``benchmarks/attitude_real.py``)."""

SCATTER_TIME = 0.3
"""s; time constant of the mean square of the samples' differences from the mean force."""

DOUBT_TIME = 10.0
"""s; a force that does not have the size of gravity for so long is that of an accelerometer that
measures another: an acceleration along gravity that were large enough would make 2.5 m/s of it,
upwards or downwards."""

SIZE_TIME = 60.0
"""s; of rests over which the size of gravity is averaged. A steady push of some seconds looks like
a rest, and may not change it much."""

SHARE = 0.2
"""Of gravity; the size that an accelerometer measures of it differs by less. Uncalibrated consumer
parts have a bias of 80 mg and a scale factor of 3 % (MPU-6000 product specification rev. 3.4,
section 6.2)."""


@dataclass(frozen=True)
class QuasiStatic:
    """Estimated magnitude of gravity in m/s^2 and its variance, as casadi scalars."""

    magnitude: ca.SX
    variance: ca.SX


@dataclass(frozen=True)
class MeanForce:
    """The mean specific force and the samples' scatter about it.

    ``force`` (3,) m/s^2 in present body axes; ``scatter`` (m/s^2)^2 the mean square of the samples'
    differences from it; ``span`` s the time over which it is taken.
    """

    force: ca.SX
    scatter: ca.SX
    span: ca.SX


@dataclass(frozen=True)
class GravitySize:
    """What the accelerometer measures of gravity, in m/s^2.

    ``size`` is the mean over rests of ``learnt`` s, of the last ``SIZE_TIME`` at most; ``doubted``
    for how many s no force had it.
    """

    size: ca.SX
    learnt: ca.SX
    doubted: ca.SX

    def off(self, gravity):
        """By how much the size differs from that of ``gravity``, m/s^2."""
        return ca.fabs(self.size - gravity)

    def tolerance(self, gravity, tolerance):
        """By how much another force of gravity may differ from the size, m/s^2.

        An accelerometer that is off in one attitude may be right in another.
        """
        return tolerance + self.off(gravity)

    def in_doubt(self):
        """Whether no force has had the size for long, 0 or 1."""
        return self.doubted > DOUBT_TIME

    def followed(self, sure, rests, force, mean, gravity, valid, h) -> GravitySize:
        """The same after one more sample, which raises no doubt (``sure``, 0 or 1) or does.

        At rest (``rests``) it takes the size of the ``force`` (3,) of the rest into its mean, and
        in doubt it is ``mean``, that of the last second; in both cases only near ``gravity``.
        """
        anew = self.in_doubt()
        found = ca.if_else(anew, mean, ca.norm_2(force))
        near = ca.fabs(found - gravity) <= SHARE * gravity
        learns = where(valid, near * (1 - (1 - rests) * (1 - anew)))
        span = (1 - anew * learns) * self.learnt
        learnt = ca.fmin(span + learns * h, SIZE_TIME)
        size = self.size + learns * h / ca.fmax(learnt, h) * (found - self.size)
        doubted = where(valid, (1 - sure) * (self.doubted + h), self.doubted)
        return GravitySize(size, learnt, doubted)


def passing_std(at: Mapping[str, ca.SX]):
    """Standard deviation in m/s^2 of what a force that passes for gravity is off it.

    Zero where the settings ``at`` say that the body never accelerates.
    """
    return ca.fmax(at["accel_std"], PASSING_STD) * (at["accel_std"] > 0)


def where(flag, value, otherwise=0):
    """``value`` where the flag holds, else ``otherwise``.

    A flag that is the Python value True costs no choice in the generated code.
    """
    return value if flag is True else ca.if_else(flag, value, otherwise)


def follow(x: QuasiStatic, measured, walk_variance, noise_variance, valid) -> QuasiStatic:
    """The estimator after one more ``measured`` magnitude in m/s^2 (Hidalgo 2012, section 5).

    Where the measurement is not ``valid`` the variance grows and the magnitude stays.
    """
    variance = x.variance + walk_variance
    gain = where(valid, variance / (variance + noise_variance))
    return QuasiStatic(x.magnitude + gain * (measured - x.magnitude), (1 - gain) * variance)


def is_quasi_static(x: QuasiStatic, measured, gravity, tolerance, motion):
    """Whether the body is quasi-static; all arguments are in m/s^2.

    The estimated magnitude must be within ``tolerance`` of ``gravity``, and the ``measured`` one
    within ``motion`` of the estimated.

    The first condition detects an acceleration that lasts, the second one that has only begun.
    """
    return (ca.fabs(x.magnitude - gravity) <= tolerance) * (
        ca.fabs(measured - x.magnitude) <= motion
    )


def is_near(force, magnitude, tolerance):
    """Whether the length of ``force`` (3,) differs from ``magnitude`` by at most ``tolerance``."""
    square, least = ca.sumsqr(force), magnitude - tolerance
    return (square <= (magnitude + tolerance) ** 2) * (square >= least * ca.fabs(least))


def average(x: MeanForce, force, turn, time, h, valid, turned) -> MeanForce:
    """The mean after one more ``force`` (3,), with the time constant ``time`` in s.

    ``turn`` (3, 3) is the body's turn, from old axes to new; that against inertial space serves,
    because the Earth turns little in such a time. The mean begins as a plain mean of the samples so
    far, so that no assumed attitude is in it. It begins anew where it cannot be turned along,
    because the gyro was lost (not ``turned``), and where no force was ``valid`` for as long as it
    spans.
    """
    before, whole = where(turned, x.span), time + h
    span = where(valid, whole + (before < time) * (before - time), (before > h) * (before - h))
    carried = turn @ x.force
    mean = carried + where(valid, h / span) * (force - carried)
    gain = where(valid, h / (SCATTER_TIME + h))
    return MeanForce(mean, x.scatter + gain * (ca.sumsqr(force - mean) - x.scatter), span)


def mean_variance(scatter, time, h):
    """Variance in (m/s^2)^2 of each sample's mean force as a measurement of gravity in motion.

    The mean over ``time`` T of an acceleration is the change of velocity over T. If the standard
    deviation of the velocity is s_v = ``HAND_TIME`` times that of the acceleration, the mean's
    variance is (s_v / T)^2. The mean changes in a time of about T: a sample of white noise that
    stands for it has the variance 2 T (s_v / T)^2 / h.
    """
    return 2 * HAND_TIME**2 * scatter / time * reciprocal(h)
