"""The quasi-static estimator: is the accelerometer an inclinometer just now?

A scalar Kalman filter follows the magnitude of the specific force, x+ = x- + K (a - x-); a body
that does not accelerate shows gravity's (Hidalgo 2012, section 5). A magnitude hardly sees an
acceleration across gravity, so beside it stands the mean of the force over a second, carried along
as the gyro says the body turns: what a sample differs from it by is acceleration. In motion that
mean is itself the measurement of gravity, since a body that stays in its place has no mean
acceleration (Laidig and Seel 2023 average in the same way, in the frame of the gyro alone).
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

SCATTER_TIME = 0.3
"""s; time constant of the mean square of what the samples differ from the mean force by."""


@dataclass(frozen=True)
class QuasiStatic:
    """Estimated magnitude of gravity in m/s^2 and its variance, as casadi scalars."""

    magnitude: ca.SX
    variance: ca.SX


@dataclass(frozen=True)
class MeanForce:
    """The mean specific force (3,) in present body axes, m/s^2, the mean square (m/s^2)^2 of the
    samples against it, and the s that it spans.
    """

    force: ca.SX
    scatter: ca.SX
    span: ca.SX


def where(flag, value, otherwise=0):
    """``value`` where the flag holds, else ``otherwise``; a flag that is True beforehand makes no
    choice.
    """
    return value if flag is True else ca.if_else(flag, value, otherwise)


def follow(x: QuasiStatic, measured, walk_variance, noise_variance, valid) -> QuasiStatic:
    """The estimator after one more magnitude ``measured``, m/s^2; where it is not ``valid`` only
    the variance grows.
    """
    variance = x.variance + walk_variance
    gain = where(valid, variance / (variance + noise_variance))
    return QuasiStatic(x.magnitude + gain * (measured - x.magnitude), (1 - gain) * variance)


def is_quasi_static(x: QuasiStatic, measured, gravity, tolerance, motion):
    """Whether the followed magnitude is gravity's to ``tolerance``, and this sample's no further
    than ``motion`` from it.

    The first condition sees what lasts, the second what has only begun; all in m/s^2.
    """
    return (ca.fabs(x.magnitude - gravity) <= tolerance) * (
        ca.fabs(measured - x.magnitude) <= motion
    )


def is_near(force, magnitude, tolerance):
    """Whether the length of ``force`` (3,) differs from ``magnitude`` by at most ``tolerance``."""
    square, least = ca.sumsqr(force), magnitude - tolerance
    return (square <= (magnitude + tolerance) ** 2) * (square >= least * ca.fabs(least))


def average(x: MeanForce, force, turn, time, h, valid, turned) -> MeanForce:
    """The mean after one more ``force`` (3,), the body having turned by ``turn`` (3, 3), old axes
    to new; ``time`` constant in s.

    The turn is that in inertial space, as the Earth turns little in such a time. It begins as a
    plain mean, so that nothing of an assumed attitude is in it. Where the gyro was lost (not
    ``turned``) nobody could carry it along, and where no force was ``valid`` for as long as it
    spans it is out of date: it begins anew.
    """
    before, whole = where(turned, x.span), time + h
    span = where(valid, whole + (before < time) * (before - time), (before > h) * (before - h))
    carried = turn @ x.force
    mean = carried + where(valid, h / span) * (force - carried)
    gain = where(valid, h / (SCATTER_TIME + h))
    return MeanForce(mean, x.scatter + gain * (ca.sumsqr(force - mean) - x.scatter), span)


def mean_variance(scatter, time, motion_time, h):
    """Variance that each sample's mean force has as a measurement of gravity, (m/s^2)^2, while the
    body moves.

    The mean over ``time`` T of an acceleration is the change of velocity over T. With velocities
    of the standard deviation s_v = ``motion_time`` times that of the acceleration its variance is
    (s_v / T)^2, and it keeps for about T: a sample of white noise that stands for it has the
    variance 2 T (s_v / T)^2 / h.
    """
    return 2 * motion_time**2 * scatter / (time * h)
