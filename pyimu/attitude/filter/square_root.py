"""The filter of 13 sigma points in square-root form: it carries the Cholesky factor S, P = S S^T.

The future work of Hidalgo 2012 (section 7), after van der Merwe and Wan 2001. The estimates are
those of ``pyimu.attitude.filter.sigma_point_filter``, to rounding. The factor is propagated and
corrected by triangular factors of deviations (``pyimu.symbolic.linear.triangular``), and the
covariance, whose condition is the square of the factor's, is nowhere formed where it must be
factored again:

* Propagation: S- is that of [sqrt(w_i) (x_i - mean), root of Q] (van der Merwe and Wan 2001, eq.
  20; all weights are positive here, so that their eq. 21 needs no downdate). The other form takes
  the products of the same columns.
* Measurement: instead of their downdates of S by K S_y (eqs. 27 and 28) the factor of the joint
  deviations of measurement and state,

      [ root of R   sqrt(w_i) (y_i - mean) ]                 [ S_y   0  ]
      [ 0           sqrt(w_i) x_i          ]  =  L Q,    L = [ K S_y S+ ]

  (the array form of Kailath, Sayed and Hassibi 2000, section 12.4). No difference is taken, so that
  S+ is real whatever rounding does.

What is rare, a heading, a zero rate and a lost attitude, goes by way of the covariance and the
functions that all filters share.

Measured (``benchmarks/square_root.py``): in double precision it buys nothing. The estimates are the
same to 1e-9 of a standard deviation on consumer and tactical parts, and no covariance was found
that is not definite. Where the state is kept in single precision, the factor gives the right
standard deviations even for sensors with next to no noise, whose tilt and bias are known from each
other to 1e-4, and the covariance does not; the attitude is then off by its own rounding in both
forms, and computing all in single precision fails in both. It takes three times the time.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import casadi as ca

from pyimu.attitude.filter.compensation import Compensation
from pyimu.attitude.filter.field_update import after_others, by_field
from pyimu.attitude.filter.filter_block import filter_block, step_function
from pyimu.attitude.filter.gravity_update import (
    INNOVATION_GATE,
    RECOVERY,
    scaled_in_gravity,
    vertical,
)
from pyimu.attitude.filter.layout import FLAGS, GRAVITY, Flags, GravityMeasurement, Layout
from pyimu.attitude.filter.look import look
from pyimu.attitude.filter.memory import ESTIMATE, WORKING, Memory
from pyimu.attitude.filter.prediction import ARGUMENTS, Instant, added_noise, predicted, rest_of
from pyimu.attitude.filter.sample import look_closely
from pyimu.attitude.filter.sigma_point_filter import (
    deviations_after,
    gravity_seen,
    scaled_after,
    weighed,
)
from pyimu.attitude.filter.unscented import (
    WHOLE,
    Estimate,
    N,
    doubt,
    less_scaled,
    moved,
    points_of,
    turned_axes,
)
from pyimu.attitude.filter.updates import (
    after_gravity,
    bounded_where_lost,
    by_zero_rate,
    finish,
    where,
)
from pyimu.attitude.filter.velocity import at_rest, covariance_of_motion
from pyimu.block.block import Block
from pyimu.block.plain import plain_function
from pyimu.model.part import Part
from pyimu.symbolic import quaternion
from pyimu.symbolic.linear import cholesky, forward, symmetric, triangular

OPTIONS = {"cse": True}


def square_root_filter(part: Part) -> Block:
    """The filter ``AttitudeSquareRoot`` of a part, a block.

    The part has ``gyro`` and ``accel`` (``Sensor``) and ``sample_rate`` in Hz.

    Its variables are those of ``pyimu.attitude.attitude_ukf``; its state has the transposed factor
    where theirs has the upper triangle of the covariance.
    """
    layout = Layout(Compensation(part))
    title = "Unscented attitude filter in square-root form"
    block = filter_block("AttitudeSquareRoot", title, layout, _step(layout))
    u, p = (block.initial.sx_in(i) for i in range(2))
    state, shown = block.initial(u, p)
    state = ca.vertcat(_factored(state[: ESTIMATE - 1]), state[ESTIMATE - 1 :])
    initial = plain_function("initial", [u, p], [state, shown], ["u", "p"], ["s", "y"])
    return replace(block, initial=initial)


def _step(layout: Layout) -> ca.Function:
    """The steps of ``sigma_point_filter`` on the factor."""
    s, u, p, h = symbols = layout.symbols(ca.MX, "s u p h")
    x, memory, motion, due, rate, gravity, packed = _predict(layout)(
        s[:ESTIMATE], s[ESTIMATE : layout.rings], u, p, h
    )
    flags, before = Flags.unpack(packed), _to_covariance()(x)
    motion = where(due, look(layout), motion, before, p, h)
    x = where(flags.lost, _bounded_where_lost(), x, packed)
    x = where(flags.gravity, _by_gravity(), x, gravity)
    x = where(flags.velocity, _by_velocity(), x, gravity)
    others = _after_gravity(layout)
    asked = flags.heading + flags.stationary + flags.resting + flags.speed + flags.anew > 0
    x = where(asked, others, x, s, u, p, h, rate, gravity, packed)
    whole = _to_covariance()(x)
    whole, field = after_others(layout, by_field(layout), whole, before, s, u, p, h, rate, packed)
    x = where(flags.field, _factor_of(), x, whole)
    shown, yaw, y = finish()(whole, packed)
    estimate = ca.vertcat(shown[:4], x[4:ESTIMATE])
    return step_function(layout, symbols, estimate, memory, motion, yaw, field, y)


# The estimate and its factor


@dataclass(frozen=True)
class Rooted:
    """Attitude ``q`` (4,), gyro ``bias`` (3,) rad/s, ``velocity`` (3,) m/s in body axes.

    ``factor`` (9, 9), lower triangular, is the Cholesky factor of the covariance of their errors;
    on the way to it (9, m), of any form.
    """

    q: ca.SX
    bias: ca.SX
    velocity: ca.SX
    factor: ca.SX
    scaled: ca.SX

    @classmethod
    def unpack(cls, column) -> Rooted:
        """From a column of the state or a working estimate."""
        x = Memory.estimate_of(column)
        return cls(x.q, x.bias, x.velocity, ca.tril(x.covariance), x.scaled)

    def pack(self) -> ca.SX:
        """As a column (82,)."""
        upper = Estimate(self.q, self.bias, self.velocity, self.factor.T, self.scaled)
        return Memory.pack_estimate(upper)

    @property
    def estimate(self) -> Estimate:
        """The same with the covariance."""
        s = self.factor
        whole = symmetric(WHOLE, lambda i, j: ca.dot(s[i, :], s[j, :]))
        return Estimate(self.q, self.bias, self.velocity, whole, self.scaled)


def _factored(column):
    """The column of an estimate with the factor in place of its covariance."""
    x = Memory.estimate_of(column)
    return Rooted(x.q, x.bias, x.velocity, cholesky(x.covariance), x.scaled).pack()


def _to_covariance() -> ca.Function:
    """``x -> x``: the working estimate with the covariance in place of its factor."""
    x = ca.SX.sym("x", WORKING)
    whole = Memory.pack_estimate(Rooted.unpack(x).estimate)
    return plain_function("to_covariance", [x], [ca.vertcat(whole, x[ESTIMATE - 1 :])], OPTIONS)


def _to_factor() -> ca.Function:
    """``x -> x``: the inverse of ``_to_covariance``."""
    x = ca.SX.sym("x", WORKING)
    return plain_function("to_factor", [x], [ca.vertcat(_factored(x), x[ESTIMATE - 1 :])], OPTIONS)


def _factor_of() -> ca.Function:
    """``x, whole -> x``: the working estimate with the factor of that with a covariance."""
    x, whole = ca.SX.sym("x", WORKING), ca.SX.sym("whole", WORKING)
    factor = ca.vertcat(_factored(whole), whole[ESTIMATE - 1 :])
    return plain_function("factor_of", [x, whole], [factor], OPTIONS)


# Prediction


def _predict(layout: Layout) -> ca.Function:
    """``estimate, memory, u, p, h -> x, memory, motion, due, rate, gravity, flags``, as
    ``predicted`` has them.

    The ``estimate`` and ``x`` have the factor.
    """
    symbols = layout.symbols(ca.SX, ARGUMENTS)
    before = Rooted.unpack(symbols[0])
    whole = ca.vertcat(Memory.pack_estimate(before.estimate), symbols[0][ESTIMATE - 1])
    at = Instant.of(layout, [whole, *symbols[1:]])
    sample = look_closely(layout.compensation, at.memory, at.u, at.settings, at.h)
    rest = rest_of(at, sample)
    q, velocity, w, turned = deviations_after(at, sample, rest, before.factor)
    x = Rooted(q, rest.before.bias, velocity, triangular(w), scaled_after(at, sample, rest, q))
    noise = added_noise(at, sample, rest)
    working, *others = predicted(at, sample, rest, x.estimate, turned, noise)
    working = ca.vertcat(x.pack(), working[ESTIMATE - 1 :])
    return plain_function("predict", symbols, [working, *others], OPTIONS)


# Gravity


def _by_gravity() -> ca.Function:
    """``x, gravity -> x``: the update by gravity in body axes; the velocity begins anew."""
    symbols = working, packed = [ca.SX.sym("x", WORKING), ca.SX.sym("gravity", GRAVITY)]
    x, given = Rooted.unpack(working), GravityMeasurement.unpack(packed)
    up = quaternion.to_matrix(x.q)[2, :].T
    sigma = points_of(x.factor[:N, :N])
    seen = [gravity_seen(up, given.magnitude)(point[:3]) for point in sigma.points]
    mean = sigma.mean(seen)
    off = ca.horzcat(*weighed(sigma, [v - mean for v in seen]))
    states = ca.vertcat(ca.horzcat(*weighed(sigma, sigma.points)), ca.SX(3, 2 * N + 1))
    roots = [ca.diag(ca.sqrt(v)) for v in (given.variance, given.sample_variance)]
    gate = triangular(ca.horzcat(roots[1], off))
    seen = scaled_in_gravity(x.estimate, mean)
    after, nis, weight = _corrected(x, given.force - mean, roots[0], off, states, up, gate, seen)
    beyond = weight < 1
    now = vertical(after.estimate)
    after = _less_sure(after, now, beyond * given.period)
    moving = cholesky(covariance_of_motion(given.motion[0], given.motion[1], now))
    factor = ca.diagcat(after.factor[:N, :N], moving)
    resting = at_rest(after.estimate, ca.SX(3, 3))
    after = Rooted(after.q, after.bias, resting.velocity, factor, resting.scaled)
    out = _reported(working, after, nis, beyond)
    return plain_function("by_gravity", symbols, [out], OPTIONS)


def _by_velocity() -> ca.Function:
    """``x, gravity -> x``: the update by the velocity, as ``gravity_update.by_velocity`` has it."""
    symbols = working, packed = [ca.SX.sym("x", WORKING), ca.SX.sym("gravity", GRAVITY)]
    x, given = Rooted.unpack(working), GravityMeasurement.unpack(packed)
    up, own = quaternion.to_matrix(x.q)[2, :].T, x.factor[N:, :]
    across, along = (ca.sqrt(given.motion[i]) for i in range(2))
    moving = across * ca.SX.eye(3) + (along - across) * up @ up.T
    single = covariance_of_motion(given.motion[0], given.motion[1], up)
    single = single - given.coloured * ca.SX.eye(3)
    gate = cholesky(symmetric(3, lambda i, j: ca.dot(own[i, :], own[j, :]) + single[i, j]))
    root = ca.sqrt(given.lasting) * moving
    after, nis, weight = _corrected(
        x,
        -x.velocity,
        root,
        own,
        x.factor,
        up,
        gate,
        x.scaled[N:, :],
        given.plausible,
        doubt(x.estimate, up, given.false_rate, given.upright),
    )
    contradicted = 1 - (1 - (weight < 1) * given.plausible) * (1 - given.contradicts)
    after = _less_sure(after, up, contradicted * given.period)
    out = _reported(working, after, nis, contradicted)
    return plain_function("by_velocity", symbols, [out], OPTIONS)


def _corrected(
    x: Rooted, innovation, root, off, states, up, gate, seen, beyond=1, unbelieved=None
) -> tuple[Rooted, ca.SX, ca.SX]:
    """The estimate after a measurement, its normalised innovation squared, and its weight.

    Its factor (9, 21) is not triangular yet. ``root`` (m, m) is one of the measurement's own
    variance; ``off`` (m, k) and ``states`` (9, k) are the deviations of measurement and state,
    whose products are their covariances; ``gate`` (m, m) is the factor that normalises the
    innovation. The others are as for ``unscented.correct``. A weight w below 1 leaves P less w
    times what the measurement takes: w of the corrected covariance and 1 - w of the one before.
    """
    size = off.shape[0]
    both = ca.vertcat(ca.horzcat(root, off), ca.horzcat(ca.SX(WHOLE, size), states))
    whole = triangular(both)
    gain, corrected = whole[size:, :size], whole[size:, size:]
    own = forward(gate, innovation)
    nis = ca.dot(own, own)
    weight = ca.if_else(nis > INNOVATION_GATE, beyond * INNOVATION_GATE / nis, 1)
    left = ca.SX(WHOLE, size) if unbelieved is None else unbelieved(gain)
    change = weight * ((gain - left) @ forward(whole[:size, :size], innovation))
    axes = ca.diagcat(turned_axes(change, up), ca.SX.eye(WHOLE - 3))
    corrected = ca.horzcat(corrected, left)
    mixed = ca.horzcat(ca.sqrt(weight) * corrected, ca.sqrt(1 - weight) * x.factor)
    scaled = less_scaled(x.estimate, weight * (gain - left), forward(whole[:size, :size], seen))
    after = moved(replace(x.estimate, scaled=scaled), change, up)
    q = quaternion.normalized(after.q)
    return Rooted(q, after.bias, after.velocity, axes @ mixed, after.scaled), nis, weight


def _less_sure(x: Rooted, up, time) -> Rooted:
    """The estimate, its factor triangular, with a tilt contradicted for ``time`` s less sure."""
    level = ca.SX.eye(3) - up @ up.T
    # The mean variance of the two axes of the tilt, without a difference.
    std = ca.sqrt(ca.sumsqr(level @ x.factor[:3, :]) / 2 * (time / RECOVERY))
    tilt = ca.vertcat(std * level, ca.SX(WHOLE - 3, 3))
    return replace(x, factor=triangular(ca.horzcat(x.factor, tilt)))


def _reported(working, after: Rooted, nis, beyond):
    """The ``working`` estimate with ``after`` in place of its estimate, and with its report."""
    yaw, others = working[ESTIMATE - 1], working[ESTIMATE + 2 :]
    return ca.vertcat(after.pack(), yaw, nis, beyond, others)


# By way of the covariance


def _bounded_where_lost() -> ca.Function:
    """``x, flags -> x``, as ``updates.bounded_where_lost`` has it."""
    x, packed = ca.MX.sym("x", WORKING), ca.MX.sym("flags", FLAGS)
    after = bounded_where_lost(_to_covariance()(x), Flags.unpack(packed))
    return plain_function("bounded_where_lost", [x, packed], [_to_factor()(after)])


def _after_gravity(layout: Layout) -> ca.Function:
    """``x, s, u, p, h, rate, flags -> x``: the updates that follow gravity's."""
    x, s, u, p, h, rate, gravity, packed = symbols = layout.symbols(
        ca.MX, "x s u p h rate gravity flags"
    )
    whole = _to_covariance()(x)
    after = after_gravity(
        layout, by_zero_rate(layout), whole, s, u, p, h, rate, gravity, Flags.unpack(packed)
    )
    return plain_function("after_gravity", symbols, [_to_factor()(after)])
