"""The update by gravity: the force that measures it, its weight, and its innovation gate.

Gravity is a sample of the specific force while the body is quasi-static, and in motion the mean
force of the last second (``pyimu.attitude.quasi_static``).
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from pyimu.attitude.layout import GravityMeasurement
from pyimu.attitude.memory import ESTIMATE, Memory
from pyimu.attitude.quasi_static import (
    MeanForce,
    QuasiStatic,
    average,
    follow,
    is_near,
    is_quasi_static,
    mean_variance,
    where,
)
from pyimu.attitude.sample import Sample
from pyimu.attitude.settings import Settings
from pyimu.attitude.unscented import Estimate, N
from pyimu.attitude.variables import LEAST_ACCEL_STD
from pyimu.symbolic import quaternion
from pyimu.symbolic.linear import symmetric

INNOVATION_GATE = 25.0
"""Normalised innovation squared of three degrees of freedom, above which a measurement gets less
weight; it is exceeded with a probability of 1.5e-5."""

RECOVERY = 0.2
"""s; while gravity is beyond its innovation gate, the variance of the tilt grows by a factor of e
in this time."""


@dataclass(frozen=True)
class Inclination:
    """What a sample of the accelerometer says of the inclination.

    The estimators after it, the ``measurement`` of gravity, whether that is ``usable``, and whether
    the body is ``quasi_static``.
    """

    quasi: QuasiStatic
    mean: MeanForce
    measurement: GravityMeasurement
    usable: ca.SX
    quasi_static: ca.SX


def inclination(memory: Memory, sample: Sample, turned, settings: Settings, h) -> Inclination:
    """The quasi-static estimator and the mean force one sample later, and the gravity they measure.

    ``turned`` (3, 3) is the body's turn in inertial space in the period ``h`` s, from old axes to
    new.
    """
    at, valid = settings.scalar, sample.force_valid
    white = _white_variance(settings, h)
    noise = at["accel_std"] ** 2 * (1 + 2 * at["accel_correlation_time"] * (1 / h)) + white
    magnitude = ca.norm_2(sample.force)
    quasi = follow(memory.quasi, magnitude, at["gravity_walk"] ** 2 * h, ca.sum1(noise) / 3, valid)
    carried = True if sample.gyro_lost is False else ca.logic_not(ca.mmax(sample.gyro_lost))
    mean = average(memory.mean, sample.force, turned, at["mean_time"], h, valid, carried)
    steady = is_quasi_static(
        quasi, magnitude, at["gravity"], at["gravity_tolerance"], at["motion_tolerance"]
    ) * (mean.scatter <= at["steady_tolerance"] ** 2 + 2 * ca.sum1(white))
    measurement = _measurement(sample.force, mean, steady, noise, white, settings, h)
    usable = where(valid, 1 - (1 - steady) * (1 - _is_mean_gravity(mean, settings)))
    return Inclination(quasi, mean, measurement, usable, where(valid, steady))


def _white_variance(settings: Settings, h):
    """Variance (3,) in (m/s^2)^2 of the white noise in a sample of the force."""
    accel, gravity = settings.accel, settings.scalar["gravity"]
    return (accel.white**2 + accel.relative**2 * gravity**2) * (1 / h) + LEAST_ACCEL_STD**2


def _is_mean_gravity(mean: MeanForce, settings: Settings):
    """Whether the mean force spans enough time, and has the magnitude of gravity."""
    at = settings.scalar
    # A push that lasts causes no scatter, so that for it the tolerance stays narrow.
    tolerance = at["gravity_tolerance"] + at["mean_tolerance"] * ca.sqrt(mean.scatter)
    return (
        (at["mean_time"] > 0)
        * (2 * mean.span > at["mean_time"])
        * is_near(mean.force, at["gravity"], tolerance)
    )


def _measurement(
    sampled, mean: MeanForce, steady, noise, white, settings: Settings, h
) -> GravityMeasurement:
    """The sampled force (3,) where the body is ``steady``, else the mean force.

    ``noise`` (3,) is the variance of the sampled force, ``white`` (3,) its part that is white
    noise. An acceleration that lasts for a correlation time T has the density 2 T sigma^2, so that
    a sample of white noise that stands for it has the variance 2 T sigma^2 / h: a faster log is not
    trusted more. In a single sample the acceleration has its own variance, however long it lasts;
    that one decides whether a sample contradicts the attitude.
    """
    at = settings.scalar
    scatter = mean.scatter + at["accel_std"] ** 2
    in_motion = mean_variance(scatter, at["mean_time"] + h, at["motion_time"], h) + white
    force = mean.force + steady * (sampled - mean.force)
    variance = in_motion + steady * (noise - in_motion)
    lasting = at["mean_time"] + steady * (at["accel_correlation_time"] - at["mean_time"])
    of_sample = variance - (1 - 1 / (1 + 2 * lasting * (1 / h))) * (variance - white)
    return GravityMeasurement(force, variance, at["gravity"], h, of_sample)


def corrected(working, given: GravityMeasurement, x: Estimate, nis, weight):
    """The working estimate after the update by gravity.

    The update gave ``x``, the normalised innovation squared ``nis`` and its ``weight``.

    A few wrong samples change little. An attitude that is far off, such as one given upside down,
    becomes uncertain in time for gravity to correct it, without its error being taken for bias.
    """
    beyond = weight < 1
    tilt = tilt_variance(x.covariance, vertical(x)) * (beyond * given.period / RECOVERY)
    after = Estimate(x.q, x.bias, _with_tilt_variance(x.covariance, vertical(x), tilt))
    yaw, others = working[ESTIMATE - 1], working[ESTIMATE + 2 :]
    return ca.vertcat(Memory.pack_estimate(after), yaw, nis, beyond, others)


def _with_tilt_variance(covariance, up, variance):
    """The covariance with ``variance`` added to the tilt, independent of the bias."""
    return symmetric(
        N,
        lambda i, j: (
            covariance[i, j] + variance * ((i == j) - up[i] * up[j]) if j < 3 else covariance[i, j]
        ),
    )


def tilt_variance(covariance, up):
    """Variance of the tilt in rad^2, the mean of its two axes; ``up`` (3,) is the vertical."""
    pp = covariance[:3, :3]
    return (ca.trace(pp) - ca.dot(up, pp @ up)) / 2


def vertical(x: Estimate):
    """The upward direction (3,) in body axes."""
    return quaternion.rotate(quaternion.conjugate(x.q), ca.vertcat(0, 0, 1))
