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
from pyimu.attitude.filter.filter_block import filter_block, step_function
from pyimu.attitude.filter.gravity_update import INNOVATION_GATE, by_velocity, corrected, push
from pyimu.attitude.filter.layout import GRAVITY, Flags, GravityMeasurement, Layout
from pyimu.attitude.filter.memory import ESTIMATE, WORKING, Memory
from pyimu.attitude.filter.prediction import ARGUMENTS, Instant, added_noise, predicted, rest_of
from pyimu.attitude.filter.sample import look_closely
from pyimu.attitude.filter.unscented import Estimate, N, correct, measure, sigma_points
from pyimu.attitude.filter.updates import after_gravity, bounded_where_lost, finish, where
from pyimu.attitude.filter.velocity import pushed
from pyimu.block.block import Block
from pyimu.model.part import Part
from pyimu.symbolic import mrp, quaternion


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
    s, u, p, h = symbols = layout.symbols(ca.MX, "s u p h")
    x, memory, rate, gravity, packed = _predict(layout)(
        s[:ESTIMATE], s[ESTIMATE : layout.rings], u, p, h
    )
    flags = Flags.unpack(packed)
    x = bounded_where_lost(x, flags)
    x = where(flags.gravity, _by_gravity(), x, gravity)
    x = where(flags.velocity, by_velocity(correct), x, gravity)
    x = after_gravity(layout, x, s, u, p, h, rate, flags)
    estimate, yaw, y = finish()(x, packed)
    return step_function(layout, symbols, estimate, memory, yaw, y)


# Prediction


def _predict(layout: Layout) -> ca.Function:
    """``estimate, memory, u, p, h -> x, memory, rate, gravity, flags``, as ``predicted`` has them.

    A stationary body keeps its attitude: its gyro then measures the bias, and must not be used
    twice.
    """
    symbols = layout.symbols(ca.SX, ARGUMENTS)
    at = Instant.of(layout, symbols)
    sample = look_closely(layout.compensation, at.memory, at.u, at.settings, at.h)
    rest = rest_of(at, sample)
    moving, noise = rest.moving, added_noise(at, sample, rest.moving)
    before = rest.before

    def turn(rate, error):
        return moving * (rate - quaternion.rotate(quaternion.conjugate(error), at.earth))

    x = propagate(before, sample.rate, turn, _matrix(noise), at.h)
    angle = at.h * turn(sample.rate - before.bias, ca.SX([1, 0, 0, 0]))
    own = quaternion.to_matrix(quaternion.exponential(angle)).T
    leak = -at.h * moving * marginal.mean_jacobian(angle, marginal.turn(angle)[1])
    x = pushed(before, x, own, leak, push(at.memory, sample, at.settings, at.h))
    in_inertial_space = quaternion.exponential(moving * (sample.rate - before.bias) * at.h)
    turned = quaternion.to_matrix(in_inertial_space).T
    return ca.Function(
        "predict", symbols, predicted(at, sample, rest, x, turned, noise), {"cse": True}
    )


def _matrix(noise):
    """The covariance (6, 6) of the noise that a sample adds, from its three diagonals."""
    attitude, cross, bias = (ca.diag(v) for v in noise)
    return ca.vertcat(ca.horzcat(attitude, cross), ca.horzcat(cross, bias))


def propagate(x: Estimate, rate, turn: Callable, noise, h) -> Estimate:
    """The estimate one sample period ``h`` s later, with the compensated rate (3,) rad/s.

    ``turn(rate, error)`` is the body's rate against the world for a rate less bias and an attitude
    error (quaternion); ``noise`` (6, 6) is added. Every sigma point turns by its own rate; what is
    left against the centre's turn is its new error (Crassidis and Markley 2003, eqs. 31 to 38).
    """
    sigma = sigma_points(x.covariance[:N, :N])
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
    return Estimate(quaternion.normalized(q), x.bias, x.velocity, covariance)


# Gravity


def _by_gravity() -> ca.Function:
    """``x, gravity -> x``: the update by gravity in body axes, R_nb^T [0, 0, g].

    Each sigma point turns gravity by its own attitude error.

    The part of an error along the vertical does not change gravity: the error is taken as a tilt,
    followed by a turn about the vertical.
    """
    symbols = working, packed = [ca.SX.sym("x", WORKING), ca.SX.sym("gravity", GRAVITY)]
    x, given = Memory.attitude_of(working), GravityMeasurement.unpack(packed)
    up = quaternion.to_matrix(x.q)[2, :].T

    def force(p):
        tilt = mrp.to_quaternion(p - ca.dot(up, p) * up)
        return given.magnitude * quaternion.rotate(quaternion.conjugate(tilt), up)

    mean, variance, cross = measure(x, force)
    after, nis, weight = correct(
        x,
        given.force - mean,
        variance + ca.diag(given.variance),
        cross,
        up,
        INNOVATION_GATE,
        variance + ca.diag(given.sample_variance),
    )
    out = corrected(working, given, after, nis, weight)
    return ca.Function("by_gravity", symbols, [out], {"cse": True})
