"""The quasi-static estimator: is the accelerometer an inclinometer just now?

A scalar Kalman filter follows the magnitude of the specific force, x+ = x- + K (a - x-); a body that does not
accelerate shows gravity's (Hidalgo 2012, section 5).
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca


@dataclass(frozen=True)
class QuasiStatic:
    """Estimated magnitude of gravity in m/s^2 and its variance, as casadi scalars."""

    magnitude: ca.SX
    variance: ca.SX


def follow(x: QuasiStatic, measured, walk_variance, noise_variance, valid) -> QuasiStatic:
    """The estimator after one more magnitude ``measured``, m/s^2; where it is not ``valid`` only the variance grows."""
    variance = x.variance + walk_variance
    gain = ca.if_else(valid, variance / (variance + noise_variance), 0)
    return QuasiStatic(x.magnitude + gain * (measured - x.magnitude), (1 - gain) * variance)


def is_quasi_static(x: QuasiStatic, measured, gravity, tolerance, motion):
    """Whether the followed magnitude is gravity's to ``tolerance``, and this sample's no further than ``motion`` from it.

    The first condition sees what lasts, the second what has only begun; all in m/s^2.
    """
    return ca.logic_and(ca.fabs(x.magnitude - gravity) <= tolerance, ca.fabs(measured - x.magnitude) <= motion)
