"""The unscented attitude filter with all of its sigma points, 13 for six states.

It is written to be read, and the tests hold the fast filter (``pyimu.attitude.filter.ukf``) against
it, which makes the same estimates with a fifth of the arithmetic. The two differ in propagation and
in the measurement of gravity; the other steps are functions that both use. Sources: Hidalgo 2012,
section 4; Crassidis and Markley 2003.
"""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca

from pyimu.attitude.filter import marginal
from pyimu.attitude.filter.compensation import Compensation
from pyimu.attitude.filter.field_update import after_others, by_field
from pyimu.attitude.filter.filter_block import (
    filter_block,
    inputs_of_the_sample,
    step_function,
)
from pyimu.attitude.filter.gravity_update import (
    INNOVATION_GATE,
    by_velocity,
    corrected,
    push,
    scaled_in_gravity,
)
from pyimu.attitude.filter.layout import GRAVITY, Flags, GravityMeasurement, Layout
from pyimu.attitude.filter.look import look
from pyimu.attitude.filter.memory import ESTIMATE, WORKING, Memory
from pyimu.attitude.filter.prediction import (
    ARGUMENTS,
    Instant,
    Rest,
    added_noise,
    predicted,
    rest_of,
)
from pyimu.attitude.filter.sample import Sample, look_closely
from pyimu.attitude.filter.unscented import (
    SPREAD,
    WHOLE,
    Estimate,
    N,
    Sigma,
    correct,
    measure,
    points_of,
    sigma_points,
)
from pyimu.attitude.filter.updates import (
    after_gravity,
    bounded_where_lost,
    by_zero_rate,
    finish,
    where,
)
from pyimu.attitude.filter.velocity import rescaled
from pyimu.block.block import Block
from pyimu.block.plain import plain_function
from pyimu.model.part import Part
from pyimu.symbolic import mrp, quaternion
from pyimu.symbolic.linear import cholesky, symmetric


def sigma_point_filter(part: Part) -> Block:
    """The filter ``AttitudeSigmaPoints`` of a part, a block.

    The part has ``gyro`` and ``accel`` (``Sensor``) and ``sample_rate`` in Hz.

    Its variables and its state are those of ``pyimu.attitude.attitude_ukf``.
    """
    layout = Layout(Compensation(part))
    title = "Unscented attitude filter of 13 sigma points"
    return filter_block("AttitudeSigmaPoints", title, layout, _step(layout))


def _step(layout: Layout) -> ca.Function:
    """Check each sample number by number, predict, and correct by what its flags ask for."""
    s, _, p, h = symbols = layout.symbols(ca.MX, "s u p h")
    u = inputs_of_the_sample(layout, symbols)
    x, memory, motion, due, rate, gravity, packed = _predict(layout)(
        s[:ESTIMATE], s[ESTIMATE : layout.rings], u, p, h
    )
    flags = Flags.unpack(packed)
    before, motion = x, where(due, look(layout), motion, x, p, h)
    x = bounded_where_lost(x, flags)
    x = where(flags.gravity, _by_gravity(), x, gravity)
    x = where(flags.velocity, by_velocity(correct), x, gravity)
    x = after_gravity(layout, by_zero_rate(layout), x, s, u, p, h, rate, gravity, flags)
    x, field = after_others(layout, by_field(layout), x, before, s, u, p, h, rate, packed)
    estimate, yaw, y = finish()(x, packed)
    return step_function(layout, symbols, estimate, memory, motion, yaw, field, y)


# Prediction


def _predict(layout: Layout) -> ca.Function:
    """``estimate, memory, u, p, h -> x, memory, motion, due, rate, gravity, flags``, as
    ``predicted`` has them.

    A stationary body keeps its attitude: its gyro then measures the bias, and must not be used
    twice.
    """
    symbols = layout.symbols(ca.SX, ARGUMENTS)
    at = Instant.of(layout, symbols)
    sample = look_closely(layout.compensation, at.memory, at.u, at.settings, at.h)
    rest = rest_of(at, sample)
    q, velocity, w, turned = deviations_after(at, sample, rest, cholesky(rest.before.covariance))
    whole = symmetric(WHOLE, lambda i, j: ca.dot(w[i, :], w[j, :]))
    scaled, noise = scaled_after(at, sample, rest, q), added_noise(at, sample, rest)
    x = Estimate(q, rest.before.bias, velocity, whole, scaled)
    outputs = predicted(at, sample, rest, x, turned, noise)
    return plain_function("predict", symbols, outputs, {"cse": True})


def deviations_after(
    at: Instant, sample: Sample, rest: Rest, root
) -> tuple[ca.SX, ca.SX, ca.SX, ca.SX]:
    """Attitude and velocity one sample later, W (9, 25) with the covariance W W^T, and the turn.

    ``root`` (9, 9) is the Cholesky factor of the covariance before. Its first six columns are the
    sigma points, in which attitude and bias take along what the velocity has in common with them;
    what it has alone, the last three columns, is linear. The velocity's error turns with the body,
    and a tilt adds to it as ``pyimu.attitude.filter.velocity`` has it. Together
    in one matrix they are definite however uncertain the attitude is. The turn (3, 3) is that in
    inertial space, from old body axes to new.
    """
    before, change = rest.before, push(at.memory, sample, at.settings, at.h, rest.surely)

    def turn(rate, error):
        return rest.moving * (rate - quaternion.rotate(quaternion.conjugate(error), at.earth))

    sigma = points_of(root)
    q, errors = turned_points(before, sigma, sample.rate, turn, at.h)
    rate, up = sample.rate - before.bias, quaternion.to_matrix(q)[2, :].T
    own, turned = (
        quaternion.to_matrix(quaternion.exponential(r * at.h)).T
        for r in (turn(rate, ca.SX([1, 0, 0, 0])), rest.moving * rate)
    )
    velocity = own @ before.velocity
    carried = change.carried(velocity)
    tilting, turning = ca.skew(change.tilting(up, carried)), ca.skew(carried)
    moved = [
        own @ p[N:] - turning @ (own @ p[:3]) + tilting @ e[:3]
        for p, e in zip(sigma.points, errors, strict=True)
    ]
    points = [ca.vertcat(e, v) for e, v in zip(errors, moved, strict=True)]
    noise = _root_of(added_noise(at, sample, rest))
    alone = ca.horzcat(own @ root[N:, N:], ca.diag(ca.sqrt(change.variance)))
    w = ca.horzcat(
        *weighed(sigma, points),
        ca.vertcat(noise, tilting @ noise[:3, :]),
        ca.vertcat(ca.SX(N, 6), alone),
    )
    return q, velocity + change.change - change.gravity * up, w, turned


def scaled_after(at: Instant, sample: Sample, rest: Rest, q):
    """``Estimate.scaled`` one sample later, at the attitude ``q``: linear, as it is small."""
    change = push(at.memory, sample, at.settings, at.h, rest.surely)
    _, own, leak = marginal.turned(rest.before, sample.rate, at.earth, rest.moving, at.h)
    std = at.settings.scalar["scale_std"]
    return rescaled(rest.before, q, own, leak, sample.rate, std, change)


def weighed(sigma: Sigma, values: list) -> list:
    """The values by the roots of their weights."""
    return [w**0.5 * v for w, v in zip(sigma.weights, values, strict=True)]


def _root_of(noise):
    """The factor (6, 6) of the noise that a sample adds, from its three diagonals."""
    attitude, cross, bias = noise
    own = ca.sqrt(attitude)
    shared = cross / own
    upper = ca.horzcat(ca.diag(own), ca.SX(3, 3))
    return ca.vertcat(upper, ca.horzcat(ca.diag(shared), ca.diag(ca.sqrt(bias - shared**2))))


def propagate(x: Estimate, rate, turn: Callable, noise, h, spread=SPREAD) -> Estimate:
    """The estimate one sample period ``h`` s later, with the compensated rate (3,) rad/s.

    ``turn(rate, error)`` is the body's rate against the world for a rate less bias and an attitude
    error (quaternion); ``noise`` (6, 6) is added; ``spread`` is lambda. Every sigma point turns by
    its own rate; what is left against the centre's turn is its new error (Crassidis and Markley
    2003, eqs. 31 to 38).
    """
    sigma = sigma_points(x.covariance[:N, :N], spread)
    q, deviations = turned_points(x, sigma, rate, turn, h)
    return Estimate(q, x.bias, x.velocity, sigma.variance(deviations) + noise)


def turned_points(x: Estimate, sigma: Sigma, rate, turn: Callable, h) -> tuple[ca.SX, list]:
    """The attitude one sample period later, and the deviations (6,) of the sigma points from it.

    The arguments are those of ``propagate``.
    """
    centre = quaternion.exponential(turn(rate - x.bias, ca.SX([1, 0, 0, 0])) * h)
    errors = []
    for point in sigma.points:
        error = mrp.to_quaternion(point[:3])
        own = quaternion.exponential(turn(rate - x.bias - point[3:N], error) * h)
        left = quaternion.product(quaternion.conjugate(centre), quaternion.product(error, own))
        errors.append(ca.vertcat(mrp.from_quaternion(left), point[3:N]))
    mean = ca.vertcat(sigma.mean(errors)[:3], ca.SX(3, 1))
    q = quaternion.product(quaternion.product(x.q, centre), mrp.to_quaternion(mean[:3]))
    return quaternion.normalized(q), [e - mean for e in errors]


# Gravity


def _by_gravity() -> ca.Function:
    """``x, gravity -> x``: the update by gravity in body axes, R_nb^T [0, 0, g]."""
    symbols = working, packed = [ca.SX.sym("x", WORKING), ca.SX.sym("gravity", GRAVITY)]
    x, given = Memory.attitude_of(working), GravityMeasurement.unpack(packed)
    up = quaternion.to_matrix(x.q)[2, :].T
    mean, variance, cross = measure(x, gravity_seen(up, given.magnitude))
    after, nis, weight = correct(
        x,
        given.force - mean,
        variance + ca.diag(given.variance),
        cross,
        up,
        INNOVATION_GATE,
        variance + ca.diag(given.sample_variance),
        seen=scaled_in_gravity(x, mean),
    )
    out = corrected(working, given, after, nis, weight)
    return plain_function("by_gravity", symbols, [out], {"cse": True})


def gravity_seen(up, magnitude) -> Callable:
    """Gravity in body axes as a sigma point's attitude error (3,) turns it.

    The part of an error along the vertical, ``up`` (3,), does not change gravity: the error is
    taken as a tilt, followed by a turn about the vertical.
    """

    def force(p):
        tilt = mrp.to_quaternion(p - ca.dot(up, p) * up)
        return magnitude * quaternion.rotate(quaternion.conjugate(tilt), up)

    return force
