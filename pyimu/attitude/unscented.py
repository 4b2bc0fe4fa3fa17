"""The unscented filter on attitude error and gyro bias: sigma points, propagation and correction as
casadi expressions.

The error state is x = (p, b): p (3,) the small rotation in body axes (modified Rodrigues parameters
scaled to rad) that turns the estimate into the truth, ``q_true = q p``, and b (3,) the gyro bias in
rad/s. The quaternion carries the attitude itself, so that the mean of p is zero between the steps
(Crassidis and Markley 2003, sections III and IV).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import pi, tan

import casadi as ca

from pyimu.symbolic import mrp, quaternion
from pyimu.symbolic.linear import cholesky, forward, symmetric

N = 6
"""Size of the error state."""

SPREAD = 1.0
"""lambda >= 0 of the sigma points; the centre weighs lambda/(n + lambda)."""

LARGEST_STD = mrp.F / (N + SPREAD) ** 0.5
"""rad; a sigma point on an axis with this standard deviation is half a turn away, beyond which an
angle says nothing."""

LARGEST_TILT_STD = mrp.F * tan(pi / 8) / (N + SPREAD) ** 0.5
"""rad; a sigma point of a tilt with this standard deviation is a quarter turn away. Beyond,
gravity falls again, and at half a turn its slope is lost."""


@dataclass(frozen=True)
class Estimate:
    """Attitude ``q`` (4,), gyro bias (3,) rad/s and the covariance (6, 6) of their errors, as
    casadi matrices.
    """

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
        """Weighted sum of the products a b^T, for deviations from the mean; a full (not symmetric)
        matrix.
        """
        return sum(w * x @ y.T for w, x, y in zip(self.weights, a, b))

    def variance(self, a: list):
        """The same of ``a`` with itself, symmetric to the last bit."""
        return symmetric(
            a[0].shape[0], lambda i, j: sum(w * x[i] * x[j] for w, x in zip(self.weights, a))
        )


def sigma_points(covariance) -> Sigma:
    """The centre and the 12 columns of +-sqrt((n + lambda) P) (Hidalgo 2012, section 4; Crassidis
    and Markley 2003, eq. 6).
    """
    root = (N + SPREAD) ** 0.5 * cholesky(covariance)
    columns = [root[:, i] for i in range(N)]
    centre, other = SPREAD / (N + SPREAD), 0.5 / (N + SPREAD)
    return Sigma([ca.SX(N, 1), *columns, *[-c for c in columns]], (centre, *[other] * 2 * N))


def propagate(x: Estimate, rate, turn: Callable, noise, h) -> Estimate:
    """The estimate one sample period ``h`` s later, with the compensated rate (3,) rad/s.

    ``turn(rate, error)`` is the body's rate against the world for a rate less bias and an attitude
    error (quaternion); ``noise`` (6, 6) is added. Every sigma point turns by its own rate; what is
    left against the centre's turn is its new error (Crassidis and Markley 2003, eqs. 31 to 38).
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

    An axis beyond it is shrunk together with its correlations and refilled with independent
    variance, because an angle that is known to no turn says nothing of the bias. The result is
    definite where ``covariance`` is.
    """
    largest = LARGEST_STD**2
    shrink = ca.vertcat(*[ca.fmin(1, largest / covariance[i, i]) for i in range(3)], 1, 1, 1)
    refill = largest * (1 - shrink)
    return symmetric(
        N, lambda i, j: covariance[i, j] * shrink[i] * shrink[j] + (refill[i] if i == j else 0)
    )


def bounded_tilt(x: Estimate) -> Estimate:
    """The estimate with the standard deviations of its tilt, about east and north, held at
    ``LARGEST_TILT_STD``: what gravity can set right.
    """
    world = quaternion.to_matrix(x.q)
    axes = ca.SX.eye(3)
    for i in range(2):
        std = ca.sqrt(ca.dot(world[i, :], (x.covariance[:3, :3] @ world[i, :].T).T))
        axes -= (
            (1 - ca.fmin(1, LARGEST_TILT_STD / ca.fmax(std, LARGEST_TILT_STD / 2)))
            * world[i, :].T
            @ world[i, :]
        )
    whole = ca.diagcat(axes, ca.SX.eye(3))
    covariance = whole @ x.covariance @ whole.T
    return Estimate(x.q, x.bias, symmetric(N, lambda i, j: covariance[i, j]))


def measure(x: Estimate, function: Callable):
    """Predicted measurement (m,), its covariance (m, m) and its covariance with the error state (6,
    m).

    ``function(p)`` is the measurement for the attitude error ``p`` (3,).
    """
    sigma = sigma_points(x.covariance)
    values = [function(point[:3]) for point in sigma.points]
    mean = sigma.mean(values)
    deviations = [v - mean for v in values]
    return mean, sigma.variance(deviations), sigma.covariance(sigma.points, deviations)


def correct(
    x: Estimate, innovation, variance, cross, up, limit: float | None = None, judged=None
) -> tuple[Estimate, ca.SX, ca.SX]:
    """The estimate after a measurement, its normalised innovation squared, and how it was weighed,
    1 up to ``limit``.

    ``variance`` (m, m) of the innovation (m,), ``cross`` (6, m) its covariance with the error
    state, ``up`` as for ``moved``. With L the root of the variance, gain times innovation is (L^-1
    cross^T)^T (L^-1 innovation), and K S K^T a sum of squares. Beyond ``limit`` the gain is that
    share smaller which brings the innovation back to it, and the covariance falls by no more than
    that; the innovation is normalised by ``judged`` (m, m) where that is given.
    """
    root = cholesky(variance)
    whitened, gain = forward(root, innovation), forward(root, cross.T).T
    own = whitened if judged is None else forward(cholesky(judged), innovation)
    nis = ca.dot(own, own)
    weight = 1 if limit is None else ca.fmin(1, limit / ca.fmax(nis, limit))
    change = weight * (gain @ whitened)
    covariance = symmetric(
        N, lambda i, j: x.covariance[i, j] - weight * ca.dot(gain[i, :], gain[j, :])
    )
    after = moved(Estimate(x.q, x.bias, covariance), change, up)
    return Estimate(quaternion.normalized(after.q), after.bias, after.covariance), nis, weight


def moved(x: Estimate, change, up) -> Estimate:
    """The estimate with ``change`` (6,) of its errors added to it, ``up`` (3,) the vertical in its
    body axes before that.

    What nobody measures is the angle about the vertical, and it must stay so: the covariance is
    turned with the estimated vertical, from old body axes to new. Left where it was, the large
    uncertainty of a heading would lie askew by the tilt's correction, and gravity would seem to
    tell of it. A turn about the vertical leaves tilts and bias in body axes as they are.
    """
    turn = change[:3] - ca.dot(up, change[:3]) * up
    axes = quaternion.to_matrix(mrp.to_quaternion(turn)).T
    half, cross = axes @ x.covariance[:3, :3], axes @ x.covariance[:3, 3:]
    own = {(i, j): ca.dot(half[i, :], axes[j, :]) for i in range(3) for j in range(i, 3)}
    both = {(i, j + 3): cross[i, j] for i in range(3) for j in range(3)}
    covariance = symmetric(N, lambda i, j: (own | both).get((i, j), x.covariance[i, j]))
    return Estimate(
        quaternion.product(x.q, mrp.to_quaternion(change[:3])), x.bias + change[3:], covariance
    )
