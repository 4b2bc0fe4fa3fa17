"""The parts of an unscented filter of attitude, gyro bias and velocity, as casadi expressions.

The estimate, its sigma points, measurement and correction.

The error state is x = (p, b, v). p (3,) is the small rotation in body axes that turns the estimate
into the truth, ``q_true = q p``, as modified Rodrigues parameters scaled to rad; b (3,) is the
error of the gyro bias in rad/s, v (3,) that of the velocity in m/s in body axes. The quaternion
carries the attitude itself, so that the mean of p is zero between the steps (Crassidis and Markley
2003, sections III and IV). The velocity is linear in p and b, and has no sigma points
(``pyimu.attitude.filter.velocity``).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import pi, tan

import casadi as ca

from pyimu.symbolic import mrp, quaternion
from pyimu.symbolic.linear import FLOOR, cholesky, forward, reciprocal, symmetric

AXES = 3
"""Of the gyro, each with a scale factor of its own."""

N = 6
"""Size of the error state that has sigma points: attitude and bias."""

WHOLE = 9
"""Size of the error state with the velocity."""

SPREAD = 1.0
"""lambda >= 0 of the sigma points; the centre has the weight lambda/(n + lambda)."""

LARGEST_STD = mrp.F / (N + SPREAD) ** 0.5
"""rad; the sigma point of an axis with this standard deviation is half a turn away. Beyond, an
angle says nothing."""

LARGEST_TILT_STD = mrp.F * tan(pi / 8) / (N + SPREAD) ** 0.5
"""rad; the sigma point of a tilt with this standard deviation is a quarter turn away. Beyond, the
horizontal part of gravity falls again, and at half a turn its slope is lost."""


@dataclass(frozen=True)
class Estimate:
    """Attitude ``q`` (4,), gyro ``bias`` (3,) rad/s, ``velocity`` (3,) m/s in body axes.

    ``covariance`` (9, 9) is that of their errors; (6, 6) where the velocity is left out. Beside it
    each error is ``scaled`` (9, 3) by the gyro's scale factors, of which nothing is learnt: a row
    has what one standard deviation of each axis's makes of it. None where that is not kept.
    """

    q: ca.SX
    bias: ca.SX
    velocity: ca.SX
    covariance: ca.SX
    scaled: ca.SX | None = None


@dataclass(frozen=True)
class Sigma:
    """The 13 sigma points as deviations (6,) from the mean, and their weights."""

    points: list[ca.SX]
    weights: tuple

    def mean(self, values: list):
        """Weighted mean of a value for each point."""
        return sum(w * v for w, v in zip(self.weights, values))

    def covariance(self, a: list, b: list):
        """Weighted sum of the products a b^T of deviations from the mean; a full matrix."""
        return sum(w * x @ y.T for w, x, y in zip(self.weights, a, b))

    def variance(self, a: list):
        """The covariance of ``a`` with itself, symmetric to the last bit."""
        return symmetric(
            a[0].shape[0], lambda i, j: sum(w * x[i] * x[j] for w, x in zip(self.weights, a))
        )


def sigma_points(covariance, spread=SPREAD) -> Sigma:
    """The centre and the 12 columns of +-sqrt((n + lambda) P); ``spread`` is lambda.

    Hidalgo 2012, section 4; Crassidis and Markley 2003, eq. 6.
    """
    return points_of(cholesky(covariance), spread)


def points_of(factor, spread=SPREAD) -> Sigma:
    """The sigma points along the first six columns of a Cholesky ``factor`` (n, n)."""
    root = (N + spread) ** 0.5 * factor
    columns = [root[:, i] for i in range(N)]
    centre, other = spread / (N + spread), 0.5 / (N + spread)
    return Sigma(
        [ca.SX(factor.shape[0], 1), *columns, *[-c for c in columns]], (centre, *[other] * 2 * N)
    )


def bounded(covariance):
    """The covariance (n, n) with the standard deviations of attitude at most ``LARGEST_STD``.

    An axis beyond is shrunk together with its correlations and filled up again with independent
    variance: an angle that may be anything says nothing of the bias. The result is definite where
    ``covariance`` is.
    """
    shrink, size = shrunk(covariance), covariance.shape[0]
    refill = LARGEST_STD**2 * (1 - shrink)
    return symmetric(
        size, lambda i, j: covariance[i, j] * shrink[i] * shrink[j] + (refill[i] if i == j else 0)
    )


def shrunk(covariance):
    """The factors (n,) by which ``bounded`` shrinks the errors."""
    largest, kept = LARGEST_STD**2, ca.SX.ones(covariance.shape[0] - 3)
    return ca.vertcat(*[ca.fmin(1, largest / covariance[i, i]) for i in range(3)], kept)


def bounded_tilt(x: Estimate) -> Estimate:
    """The estimate with its tilt's standard deviations at most ``LARGEST_TILT_STD``.

    Gravity can then correct it.

    Tilt is the attitude error about east and about north.
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
    whole = ca.diagcat(axes, ca.SX.eye(6))
    covariance = whole @ x.covariance @ whole.T
    return replace(x, covariance=symmetric(WHOLE, lambda i, j: covariance[i, j]))


def measure(x: Estimate, function: Callable, spread=SPREAD):
    """Predicted measurement (m,), its covariance (m, m), and that with the error state (n, m).

    They are made by sigma points.

    ``function(p)`` is the measurement for the attitude error ``p`` (3,), ``spread`` lambda. It
    tells of the velocity what the velocity has in common with p.
    """
    sigma = sigma_points(x.covariance[:N, :N], spread)
    values = [function(point[:3]) for point in sigma.points]
    mean = sigma.mean(values)
    deviations = [v - mean for v in values]
    cross = sigma.covariance(sigma.points, deviations)
    root = cholesky(x.covariance[:3, :3])
    shared = forward(root, x.covariance[:3, N:]).T @ forward(root, cross[:3, :])
    return mean, sigma.variance(deviations), ca.vertcat(cross, shared)


def correct(
    x: Estimate,
    innovation,
    variance,
    cross,
    up,
    innovation_gate: float | None = None,
    gate_variance=None,
    beyond=1,
    seen=None,
    unbelieved=None,
) -> tuple[Estimate, ca.SX, ca.SX]:
    """The estimate after a measurement, its normalised innovation squared, and its weight.

    ``variance`` (m, m) is that of the ``innovation`` (m,), ``cross`` (n, m) the covariance of the
    innovation with the error state, ``up`` as for ``moved``. With L the Cholesky factor of the
    variance, gain times innovation is (L^-1 cross^T)^T (L^-1 innovation), and K S K^T is a sum of
    squares. Up to ``innovation_gate`` the weight is 1. Beyond, the gain is smaller by the factor
    that brings the normalised innovation squared back to the gate, and the covariance falls by no
    more than that. Where ``gate_variance`` (m, m) is given, it normalises the innovation instead of
    ``variance``. ``beyond`` is a further factor of the weight there: at 0 what contradicts is not
    used. ``seen`` (m, 3) is what the innovation has of ``Estimate.scaled``, None for nothing.
    ``unbelieved`` gives the part of a gain that is not used (``doubt``), None for nothing.
    """
    root = cholesky(variance)
    whitened, gain = forward(root, innovation), forward(root, cross.T).T
    own = whitened if gate_variance is None else forward(cholesky(gate_variance), innovation)
    nis = ca.dot(own, own)
    weight = 1
    if innovation_gate is not None:
        weight = ca.if_else(nis > innovation_gate, beyond * innovation_gate / nis, 1)
    left = None if unbelieved is None else unbelieved(gain)
    used = gain if left is None else gain - left
    change = weight * (used @ whitened)

    def taken(i: int, j: int):
        whole = ca.dot(gain[i, :], gain[j, :])
        return whole if left is None or j >= N else whole - ca.dot(left[i, :], left[j, :])

    covariance = symmetric(cross.shape[0], lambda i, j: x.covariance[i, j] - weight * taken(i, j))
    scaled = less_scaled(x, weight * used, None if seen is None else forward(root, seen))
    after = moved(replace(x, covariance=covariance, scaled=scaled), change, up)
    return replace(after, q=quaternion.normalized(after.q)), nis, weight


def doubt(x: Estimate, up, false_rate, upright) -> Callable:
    """The part of a gain (n, m) of gravity that is not believed, as a function of the gain.

    Gravity shows a bias about the vertical by the way in which the body tilts while it turns, and
    axes that are off by e or a clock look like a bias of e times the rate: ``false_rate`` rad/s, a
    standard deviation. What is known better than that learns nothing from gravity, what is known
    less learns: the bias along ``upright`` (3,), the mean of the vertical in body axes, by its
    square, and the angle about the vertical ``up`` (3,). A correction that is left out leaves the
    variance, as in the partial updates of Brink 2017 ("Partial-update Schmidt-Kalman filter", J.
    Guidance 40:2214).
    """
    own, false = ca.dot(upright, x.covariance[3:N, 3:N] @ upright), false_rate**2
    share = ca.fmin(1, false * ca.sumsqr(upright) * reciprocal(own + FLOOR))

    def unbelieved(gain):
        own = [share * v @ (v.T @ gain[i : i + 3, :]) for i, v in ((0, up), (3, upright))]
        return ca.vertcat(*own, ca.SX(gain.shape[0] - N, gain.shape[1]))

    return unbelieved


def less_scaled(x: Estimate, gain, seen):
    """``Estimate.scaled`` after a correction: of what is ``seen`` (m, 3) of it in the innovation,
    the ``gain`` (n, m) takes its share away.
    """
    if x.scaled is None or seen is None:
        return x.scaled
    return x.scaled - ca.vertcat(gain @ seen, ca.SX(x.scaled.shape[0] - gain.shape[0], AXES))


def turned_axes(change, up):
    """The turn (3, 3) of the estimated vertical by ``change`` (n,), from old body axes to new."""
    turn = change[:3] - ca.dot(up, change[:3]) * up
    return quaternion.to_matrix(mrp.to_quaternion(turn)).T


def moved(x: Estimate, change, up) -> Estimate:
    """The estimate with ``change`` (n,) of its errors added.

    ``up`` (3,) is the vertical in its body axes before that.

    Gravity says nothing of the angle about the vertical, and that must stay so: the covariance is
    turned along with the estimated vertical, from old body axes to new. Otherwise the large
    uncertainty of a heading would lie askew by the correction of the tilt, and gravity would seem
    to reduce it. A turn about the vertical leaves tilt and bias in body axes as they are.
    """
    axes = turned_axes(change, up)
    half, cross = axes @ x.covariance[:3, :3], axes @ x.covariance[:3, 3:]
    own = {(i, j): ca.dot(half[i, :], axes[j, :]) for i in range(3) for j in range(i, 3)}
    size = x.covariance.shape[0]
    both = {(i, j + 3): cross[i, j] for i in range(3) for j in range(size - 3)}
    covariance = symmetric(size, lambda i, j: (own | both).get((i, j), x.covariance[i, j]))
    q = quaternion.product(x.q, mrp.to_quaternion(change[:3]))
    velocity = x.velocity if size == N else x.velocity + change[N:]
    scaled = None if x.scaled is None else ca.vertcat(axes @ x.scaled[:3, :], x.scaled[3:, :])
    return Estimate(q, x.bias + change[3:N], velocity, covariance, scaled)
