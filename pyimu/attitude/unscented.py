"""The unscented filter on attitude error and gyro bias: sigma points, propagation and correction as casadi expressions.

The error state is x = (p, b): p (3,) the small rotation in body axes (modified Rodrigues parameters scaled to rad) that
turns the estimate into the truth, ``q_true = q p``, and b (3,) the gyro bias in rad/s.  The quaternion carries the
attitude itself, so that the mean of p is zero between the steps (Crassidis and Markley 2003, sections III and IV).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import casadi as ca

from pyimu.symbolic import mrp, quaternion
from pyimu.symbolic.linear import cholesky, forward, symmetric

N = 6
"""Size of the error state."""

SPREAD = 1.0
"""lambda >= 0 of the sigma points; the centre weighs lambda/(n + lambda)."""

LARGEST_STD = mrp.F / (N + SPREAD) ** 0.5
"""rad; a sigma point on an axis with this standard deviation is half a turn away, beyond which an angle says nothing."""


@dataclass(frozen=True)
class Estimate:
    """Attitude ``q`` (4,), gyro bias (3,) rad/s and the covariance (6, 6) of their errors, as casadi matrices."""

    q: ca.SX
    bias: ca.SX
    covariance: ca.SX


@dataclass(frozen=True)
class Sigma:
    """Deviations of the 13 sigma points from the mean, columns of (6, 13), and their weights."""

    points: list[ca.SX]
    weights: tuple[float, ...]

    def mean(self, values: list):
        return sum(w * v for w, v in zip(self.weights, values))

    def covariance(self, a: list, b: list):
        """Weighted sum of the products a b^T, for deviations from the mean; a full (not symmetric) matrix."""
        return sum(w * x @ y.T for w, x, y in zip(self.weights, a, b))

    def variance(self, a: list):
        """The same of ``a`` with itself, symmetric to the last bit."""
        return symmetric(a[0].shape[0], lambda i, j: sum(w * x[i] * x[j] for w, x in zip(self.weights, a)))


def sigma_points(covariance) -> Sigma:
    """The centre and the 12 columns of +-sqrt((n + lambda) P) (Hidalgo 2012, section 4; Crassidis and Markley 2003, eq. 6)."""
    root = (N + SPREAD) ** 0.5 * cholesky(covariance)
    columns = [root[:, i] for i in range(N)]
    centre, other = SPREAD / (N + SPREAD), 0.5 / (N + SPREAD)
    return Sigma([ca.SX(N, 1), *columns, *[-c for c in columns]], (centre, *[other] * 2 * N))


def propagate(x: Estimate, rate, turn: Callable, noise, h) -> Estimate:
    """The estimate one sample period ``h`` s later, with the compensated rate (3,) rad/s.

    ``turn(rate, error)`` is the body's rate against the world for a rate less bias and an attitude error (quaternion);
    ``noise`` (6, 6) is added.  Every sigma point turns by its own rate; what is left against the centre's turn is its
    new error (Crassidis and Markley 2003, eqs. 31 to 38).
    """
    sigma = sigma_points(x.covariance)
    centre = quaternion.exponential(turn(rate - x.bias, ca.SX([1, 0, 0, 0])) * h)
    errors = []
    for point in sigma.points:
        error = mrp.to_quaternion(point[:3])
        own = quaternion.exponential(turn(rate - x.bias - point[3:], error) * h)
        left = quaternion.product(quaternion.conjugate(centre), quaternion.product(error, own))
        errors.append(ca.vertcat(mrp.from_quaternion(left), point[3:]))
    mean = ca.vertcat(sigma.mean(errors)[:3], ca.SX(3, 1))
    covariance = sigma.variance([e - mean for e in errors]) + noise
    q = quaternion.product(quaternion.product(x.q, centre), mrp.to_quaternion(mean[:3]))
    return Estimate(quaternion.normalized(q), x.bias, covariance)


def bounded(covariance):
    """The covariance (6, 6) with the attitude's standard deviations held at ``LARGEST_STD``.

    An axis beyond it is shrunk together with its correlations and refilled with independent variance, because an
    angle that is known to no turn says nothing of the bias.  The result is definite where ``covariance`` is.
    """
    largest = LARGEST_STD ** 2
    shrink = ca.vertcat(*[ca.fmin(1, largest / covariance[i, i]) for i in range(3)], 1, 1, 1)
    refill = largest * (1 - shrink)
    return symmetric(N, lambda i, j: covariance[i, j] * shrink[i] * shrink[j] + (refill[i] if i == j else 0))


def measure(x: Estimate, function: Callable):
    """Predicted measurement (m,), its covariance (m, m) and its covariance with the error state (6, m).

    ``function(error)`` is the measurement for the true attitude ``q error`` with the quaternion ``error``.
    """
    sigma = sigma_points(x.covariance)
    values = [function(mrp.to_quaternion(point[:3])) for point in sigma.points]
    mean = sigma.mean(values)
    deviations = [v - mean for v in values]
    return mean, sigma.variance(deviations), sigma.covariance(sigma.points, deviations)


def correct(x: Estimate, innovation, variance, cross, valid) -> tuple[Estimate, ca.SX]:
    """The estimate after a measurement, unchanged where ``valid`` is false, and the normalised innovation squared.

    ``variance`` (m, m) of the innovation (m,), ``cross`` (6, m) its covariance with the error state.  With L the root
    of the variance, gain times innovation is (L^-1 cross^T)^T (L^-1 innovation), and K S K^T a sum of squares.
    """
    root = cholesky(variance)
    whitened = ca.if_else(valid, forward(root, innovation), 0)
    gain = ca.if_else(valid, forward(root, cross.T), 0).T
    change = gain @ whitened
    covariance = symmetric(N, lambda i, j: x.covariance[i, j] - ca.dot(gain[i, :], gain[j, :]))
    q = quaternion.normalized(quaternion.product(x.q, mrp.to_quaternion(change[:3])))
    return Estimate(q, x.bias + change[3:], covariance), ca.dot(whitened, whitened)
