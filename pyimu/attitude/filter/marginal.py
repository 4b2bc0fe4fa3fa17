"""Propagation and gravity's measurement in fast, marginalised form.

What is linear in the error state needs no sigma points.

The error of the rate is bilinear in attitude error and bias, so that the propagated mean and
covariance have a closed form; the sigma points of attitude of the 13-point filter cancel to the
fourth order of the standard deviations. Gravity depends on the tilt alone: two pairs of points are
left, whose odd and even parts are written out. Both functions give what
``pyimu.attitude.filter.sigma_point_filter`` gives, with a fifth of its arithmetic, and neither
branches.
"""

from __future__ import annotations

from dataclasses import replace
from math import factorial

import casadi as ca

from pyimu.attitude.filter.unscented import SPREAD, Estimate, N, less_scaled, moved
from pyimu.attitude.filter.velocity import Push, pushed, rescaled
from pyimu.symbolic import mrp, quaternion
from pyimu.symbolic.linear import FLOOR, reciprocal, symmetric

SCALE = N + SPREAD
"""A sigma point is the root of this many times the covariance."""

LARGEST_TURN = 7.0
"""rad in a sample, more than half a turn about each axis. A larger one, which only an absurd bias
can cause, counts as none, because the series of ``turn`` would not converge."""

TERMS = 7
"""Terms of the series of sine and cosine; at half a turn about each axis the rest is 2e-16 for an
eighth of the angle."""


def _series(square, first: int):
    """cos(x) (``first`` 0) or sin(x)/x (1) of ``square`` = x^2."""
    return _horner(square, [1 / factorial(2 * i + first) for i in range(TERMS + 1)])


def _horner(square, coefficients: list[float]):
    """The sum of coefficients[i] (-square)^i."""
    total = coefficients[-1]
    for coefficient in reversed(coefficients[:-1]):
        total = coefficient - square * total
    return total


def turn(angle):
    """The quaternion (4,) of the rotation vector ``angle`` (3,) rad, and k.

    k is the quaternion's vector part over ``angle``.

    Serves up to half a turn about each axis: a quarter of the angle by series, doubled twice, as
    (w, k a) squared is (2 w^2 - 1, 2 w k a).
    """
    square = ca.dot(angle, angle) / 64
    w, k = _series(square, 0), _series(square, 1) / 8
    for _ in range(2):
        w, k = 2 * w * w - 1, 2 * w * k
    return ca.vertcat(w, k * angle), k


def mean_jacobian(angle, k):
    """J (3, 3) with exp(a - d) = exp(a) exp(-J d) for small d.

    J = I - (1 - cos a)/a^2 [a] + (a - sin a)/a^3 [a]^2 (Sola 2017, eq. 183). ``k`` is that of
    ``turn``.
    """
    square = ca.dot(angle, angle)
    b, c = 2 * k * k, _horner(square, [1 / factorial(3 + 2 * i) for i in range(5)])
    outer = symmetric(3, lambda i, j: c * angle[i] * angle[j])
    return (1 - c * square) * ca.SX.eye(3) - b * ca.skew(angle) + outer


def turned(x: Estimate, rate, earth, moving, h):
    """The turn of the body in a period, by the arguments of ``propagate``, and what errors become.

    The quaternion (4,) of its turn against the world, the turn R^T (3, 3) in inertial space from
    the old body axes to the new, which is that of an attitude error, and G = -h J (3, 3), the
    attitude error that an error of the bias makes.
    """
    step = h * moving
    angle = (rate - x.bias - earth) * step
    angle *= ca.sumsqr(angle) <= LARGEST_TURN**2
    centre, k = turn(angle)
    own = quaternion.to_matrix(quaternion.product(centre, ca.vertcat(1, earth * step / 2))).T
    return centre, own, -step * mean_jacobian(angle, k)


def propagate(
    x: Estimate, rate, earth, moving, noise, push: Push, scale_std, h
) -> tuple[Estimate, ca.SX]:
    """The estimate one period ``h`` s later, and the body's turn (3, 3) in inertial space.

    The turn is from the old body axes to the new.

    ``rate`` (3,) rad/s is the compensated rate, ``earth`` (3,) rad/s the Earth's in body axes,
    ``moving`` 0 or 1 whether the body turns at all. ``noise`` is the variance that is added to the
    attitude, to attitude and bias together, and to the bias, (3,) each; ``push`` changes the
    velocity; ``scale_std`` is that of the gyro's scale factors. With R the turn and G = -h J the
    error becomes R^T p + G b + R^T p x G b / 2, and the mean of the last term is the mean error.
    The quaternion keeps its length however large that mean is: the updates that follow rely on a
    vertical of unit length.
    """
    centre, own, leak = turned(x, rate, earth, moving, h)
    covariance, mixed = _propagated(x.covariance, own, leak, noise)
    mean = (
        ca.vertcat(mixed[1, 2] - mixed[2, 1], mixed[2, 0] - mixed[0, 2], mixed[0, 1] - mixed[1, 0])
        / 2
    )
    q = quaternion.product(quaternion.product(x.q, centre), mrp.to_quaternion(mean))
    scaled = rescaled(x, q, own, leak, rate, scale_std, push)
    after = Estimate(q, x.bias, x.velocity, covariance, scaled)
    return pushed(x, after, own, leak, push), own


def _propagated(covariance, own, g, noise):
    """The covariance (6, 6) of R^T p + G b and b with ``noise``, and that of its bilinear part.

    The second is the covariance (3, 3) of R^T p + G b / 2 with G b.

    ``own`` is R^T, ``g`` is G.
    """
    pp, pb, bb = covariance[:3, :3], covariance[:3, 3:N], covariance[3:N, 3:N]
    turned, leaked = own @ pb, g @ bb
    mixed, both = (turned + leaked / 2) @ g.T, turned + leaked
    half = own @ pp

    def entry(i: int, j: int):
        if j < 3:
            return ca.dot(half[i, :], own[j, :]) + mixed[i, j] + mixed[j, i]
        return both[i, j - 3] if i < 3 else bb[i - 3, j - 3]

    attitude, cross, bias = noise
    added = {(i, i): attitude[i] for i in range(3)}
    added |= {(i, i + 3): cross[i] for i in range(3)}
    added |= {(i + 3, i + 3): bias[i] for i in range(3)}
    whole = symmetric(N, lambda i, j: entry(i, j) + added[i, j] if (i, j) in added else entry(i, j))
    return whole, mixed


def factors(matrix, columns: int):
    """D and the columns of the unit lower triangular L with L D L^T = ``matrix``, symmetric.

    With fewer ``columns`` than the matrix has, L D L^T is the part of it that these account for.
    The pivots D need no root (Golub and Van Loan 2013, section 4.1.2).
    """
    size, pivots, lower = matrix.shape[0], [], []
    whole: list[list] = []  # the columns of L D, which are known a division sooner than those of L

    def left(i: int, j: int):
        return matrix[i, j] - sum((lower[k][i] * whole[k][j] for k in range(j)), 0)

    for j in range(columns):
        # A pivot below zero is one of rounding: its magnitude serves as well, and needs no choice.
        pivot = ca.fabs(left(j, j)) + FLOOR
        inverse, rest = reciprocal(pivot), [left(i, j) for i in range(j + 1, size)]
        pivots.append(pivot)
        whole.append([*[0] * j, pivot, *rest])
        lower.append(ca.vertcat(*[0] * j, 1, *(v * inverse for v in rest)))
    return pivots, lower


def measure_gravity(x: Estimate, axes, magnitude):
    """Predicted force (3,), its covariance (3, 3), and its covariance with the error state (n, 3).

    The measurement is of gravity of ``magnitude`` m/s^2.

    ``axes`` (3, 3) has east, north and up in body axes for its rows. Gravity depends on the tilt
    alone, the attitude error along east and north: two pairs of sigma points are left. A pair +-p
    of Rodrigues parameters changes g by an odd part along p x g and an even one along p x (p x g).
    """
    gravity = magnitude * axes[2, :].T
    both = x.covariance[:, :3] @ axes[:2, :].T
    tilt = axes[:2, :] @ both[:3, :]
    pivots, lower = factors(tilt, 2)
    along = [axes[0, :].T + lower[0][1] * axes[1, :].T, axes[1, :].T]
    columns = [both[:, 0], both[:, 1] - lower[0][1] * both[:, 0]]
    odd, even, cross = [], [], []
    for pivot, p, column in zip(pivots, along, columns, strict=True):
        inverse = 1 / (mrp.F**2 + SCALE * pivot * ca.dot(p, p))
        across = ca.cross(p, gravity)
        slope = -4 * mrp.F * (2 * mrp.F**2 * inverse - 1) * inverse
        odd.append((slope * slope * pivot, across))
        even.append(8 * SCALE * mrp.F**2 * inverse**2 * pivot * ca.cross(p, across))
        cross.append((slope * column, across))
    shift = sum(even) / SCALE
    variance = symmetric(
        3,
        lambda i, j: (
            sum(s * a[i] * a[j] for s, a in odd)
            + sum(e[i] * e[j] for e in even) / SCALE
            - shift[i] * shift[j]
        ),
    )
    return gravity + shift, variance, sum(c @ a.T for c, a in cross)


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
    """The estimate after a measurement of three numbers, its NIS, and its weight.

    NIS is the normalised innovation squared.

    The same as ``unscented.correct``, with factors L D L^T in place of roots.
    """
    pivots, lower = factors(variance, 3)
    inverse = [reciprocal(p) for p in pivots]
    white = _solved(lower, [innovation[i] for i in range(3)])
    gain = _solved(lower, [cross[:, i] for i in range(3)])
    own_pivots, own_lower = (pivots, lower) if gate_variance is None else factors(gate_variance, 3)
    nis = sum(
        w * w * reciprocal(d)
        for w, d in zip(
            _solved(own_lower, [innovation[i] for i in range(3)]), own_pivots, strict=True
        )
    )
    weight = (
        1
        if innovation_gate is None
        else ca.if_else(nis > innovation_gate, beyond * innovation_gate / nis, 1)
    )
    factors_of = [d * weight for d in inverse]
    scaled = [g * d for g, d in zip(gain, factors_of, strict=True)]
    left = [] if unbelieved is None else [unbelieved(g) for g in gain]

    def taken(i: int, j: int):
        whole = sum(g[i] * s[j] for g, s in zip(gain, scaled, strict=True))
        if j < N:
            whole -= sum(g[i] * g[j] * d for g, d in zip(left, factors_of))
        return whole

    covariance = symmetric(cross.shape[0], lambda i, j: x.covariance[i, j] - taken(i, j))
    if left:
        scaled = [s - g * d for s, g, d in zip(scaled, left, factors_of, strict=True)]
    change = sum(g * w for g, w in zip(scaled, white, strict=True))
    if seen is not None:
        seen = ca.vertcat(*_solved(lower, [seen[i, :] for i in range(3)]))
    scaled = less_scaled(x, ca.horzcat(*scaled), seen)
    return moved(replace(x, covariance=covariance, scaled=scaled), change, up), nis, weight


def _solved(lower, values: list) -> list:
    """L^-1 applied to numbers or rows; ``lower`` are the columns of L as ``factors`` gives them."""
    out: list = []
    for i, value in enumerate(values):
        out.append(value - sum((lower[k][i] * out[k] for k in range(i)), 0))
    return out
