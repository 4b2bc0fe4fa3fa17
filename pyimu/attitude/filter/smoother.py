"""The fixed-interval smoother of the attitude filter as a block that goes back over its samples.

It is that of Rauch, Tung and Striebel 1965 (Sarkka 2013, section 8.2) on the error state. What is
known of the error after a sample, by the samples that follow, is a mean and a covariance P^s, in
the axes of the filter's estimate. Whatever updates the filter made, the same mean and covariance
hold of its prediction for that sample, P-. Before the prediction, P- = F P F^T + Q, W = (P-)^-1,

    x = F^-1 (I - Q W) x^s,
    P = F^-1 ((I - Q W) P^s (I - Q W)^T + Q - Q W Q) F^-T,

which is the usual form with the gain C = P F^T W = F^-1 (I - Q W) written out: F has a closed
inverse, P stays definite whatever the rounding, and what has no noise stays what it is. F and Q are
those of ``pyimu.attitude.filter.passed.Transition``.

What the filter does between prediction and estimate and is no measurement is undone one by one. A
contradicted attitude becomes less sure: that is a change of the attitude at this sample, of which
those before it know nothing. A correction of the tilt turns the axes of the covariance along
(``unscented.moved``). An attitude that may be lost is bounded. A velocity that begins anew tells
nothing of the one before; nor does the attitude after a turn that no gyro saw, as of a lost axis,
where it may be so large (``gravity_update.KNOWN_TILT``) that its errors are not linear.

A measurement that arrives late, as a heading of some age, belongs to an estimate before this one.
Here it counts as one of the present, which it is up to the noise of the gyro over its age.

The gyro's scale factors stay what the filter took them for, and the smoother has what they make of
its estimates as the filter has (``Estimate.scaled``).

The standard deviations are those of the filter's model. What the filter only stands for makes them
too small sooner than its own: a Gauss-Markov noise of the gyro with a correlation time of 10 s,
which it takes for a walk, leaves in the middle of a log a bias error 1.16 times as large as is
said. And of a fault that nobody declared, what the filter took for its own error until it was
contradicted is carried back.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache

import casadi as ca

from pyimu.attitude.filter.gravity_update import KNOWN_TILT
from pyimu.attitude.filter.marginal import factors
from pyimu.attitude.filter.memory import Memory
from pyimu.attitude.filter.passed import PACKED, PASSED, Passed
from pyimu.attitude.filter.unscented import AXES, WHOLE, Estimate, N, bounded, moved, shrunk
from pyimu.attitude.filter.updates import outputs, where
from pyimu.attitude.filter.variables import FOUND, OUTPUTS
from pyimu.block.block import Block
from pyimu.block.plain import plain_function
from pyimu.symbolic import mrp, quaternion
from pyimu.symbolic.linear import pack, symmetric, unpack

COLUMNS = 1 + AXES
"""Of the mean of an error: itself, and what one standard deviation of each of the gyro's scale
factors changes of it. The smoother is linear, so that what holds of the one holds of the other."""

MEAN = WHOLE * COLUMNS
"""Numbers of such a mean."""

BELIEF = MEAN + WHOLE * (WHOLE + 1) // 2
"""Numbers of what is known of an error: its mean and the upper triangle of its covariance."""

OPTIONS = {"cse": True}

TURNING, BIAS = list(range(N)), list(range(3, N))
"""Which errors are those of attitude and bias, and of the bias alone."""


@lru_cache(maxsize=1)
def smoother() -> Block:
    """The smoother ``AttitudeSmoother``, whose samples are those of a recorded filter, last first.

    Its inputs are the rows of ``pyimu.attitude.filter.passed``, its outputs those of the filter,
    smoothed; those of ``FOUND`` stay the filter's. The state is the mean
    (9, 4) of the error of the filter's estimate after the sample that comes next, and the upper
    triangle of its covariance (45,). It is the same for every part.
    """
    s, u, h = (ca.MX.sym(n, size) for n, size in (("s", BELIEF), ("u", len(PASSED)), ("h", 1)))
    y, less_sure, unseen = _shown()(s, u)
    before = where(less_sure, _before_a_change(), s, u)
    before = _before_the_updates()(before, u)
    before = where(u[-1], _before_a_bound(), before, u)
    before = where(u[-2], _before_a_beginning(TURNING), before, u)
    before = where(unseen, _before_a_beginning(BIAS), before, u)
    before = _before_the_prediction()(before, u)
    none = ca.MX(0, 1)
    return Block(
        name="AttitudeSmoother",
        description="Fixed-interval smoother of the unscented attitude filter",
        step=plain_function(
            "step", [s, u, none, none, h], [before, y], ["s", "u", "p", "w", "h"], ["s_next", "y"]
        ),
        initial=_initial(),
        inputs=PASSED,
        parameters=(),
        outputs=OUTPUTS,
        noise=(),
        sample_period=1.0,
    )


def _initial() -> ca.Function:
    u, none = ca.SX.sym("u", len(PASSED)), ca.SX(0, 1)
    start, shown = ca.SX.zeros(BELIEF), ca.SX.zeros(len(OUTPUTS))
    return plain_function("initial", [u, none], [start, shown], ["u", "p"], ["s", "y"])


@lru_cache(maxsize=1)
def last_belief() -> ca.Function:
    """``estimate -> belief``: the smoother's state at the last sample, from the packed estimate."""
    x = ca.SX.sym("x", PACKED)
    belief = _packed(ca.SX.zeros(WHOLE, COLUMNS), Memory.estimate_of(x).covariance)
    return plain_function("last_belief", [x], [belief], OPTIONS)


@lru_cache(maxsize=1)
def before_a_gap() -> ca.Function:
    """``belief, estimate, walk -> belief``: before the bias walked by the variance ``walk`` (3,).

    ``estimate`` is the packed one after that.
    """
    s, x, walk = (ca.SX.sym(n, k) for n, k in (("s", BELIEF), ("x", PACKED), ("walk", 3)))
    whole = Memory.estimate_of(x).covariance
    noise = ca.diagcat(ca.SX(3, 3), ca.diag(walk), ca.SX(3, 3))
    out = _packed(*less_noise(*_unpacked(s), whole, noise))
    return plain_function("before_gap", [s, x, walk], [out], OPTIONS)


# The functions of a step


def _symbols() -> tuple[list[ca.SX], ca.SX, ca.SX, Passed]:
    """The arguments ``belief, u``, the mean (9, 4), the covariance (9, 9), and what has passed."""
    s, u = symbols = [ca.SX.sym("s", BELIEF), ca.SX.sym("u", len(PASSED))]
    return symbols, *_unpacked(s), Passed.unpack(u)


def _unpacked(s) -> tuple[ca.SX, ca.SX]:
    """The mean (9, 4) and the covariance (9, 9) of a belief."""
    return ca.reshape(s[:MEAN], WHOLE, COLUMNS), unpack(s[MEAN:], WHOLE)


def _packed(mean, covariance) -> ca.SX:
    return ca.densify(ca.vertcat(ca.vec(mean), pack(covariance)))


def _up(x: Estimate):
    """The vertical (3,) in the body axes of an estimate."""
    return quaternion.to_matrix(x.q)[2, :].T


def _shown() -> ca.Function:
    """``belief, u -> y, less_sure, unseen``: the outputs; whether the filter has become less sure,
    and whether the body may have turned unseen.
    """
    symbols, mean, covariance, row = _symbols()
    after = row.after
    left = after.scaled - mean[:, 1:]
    given = Estimate(after.q, after.bias, after.velocity, covariance, left)
    x = moved(given, mean[:, 0], _up(after))
    x = replace(x, q=quaternion.normalized(x.q))
    y = outputs(x, *(row.outputs[i] for i in FOUND), row.constant)
    least = ROUNDING * ca.trace(row.predicted.covariance[:3, :3])
    unseen = ca.mmax(row.transition.attitude) > KNOWN_TILT**2
    return plain_function("shown", symbols, [y, sum(_widened(row)) > least, unseen], OPTIONS)


ROUNDING = 1e-9
"""Relative change of a variance that may be one of rounding."""


def _widened(row: Passed):
    """By how much the updates of a sample have widened the variance of the tilt, and of the yaw.

    Of the tilt that is the most about any horizontal axis.
    """
    before, axes = row.predicted, _turned_back(row)
    world = quaternion.to_matrix(before.q)
    wider = axes @ row.after.covariance[:3, :3] @ axes.T - before.covariance[:3, :3]
    wider = world @ wider @ world.T
    mean, half = (wider[0, 0] + wider[1, 1]) / 2, (wider[0, 0] - wider[1, 1]) / 2
    tilt = mean + ca.sqrt(half**2 + wider[0, 1] ** 2)
    return ca.fmax(tilt, 0), ca.fmax(wider[2, 2], 0)


def _turned_back(row: Passed):
    """The turn (3, 3) from the axes of the estimate to those of the prediction, by ``moved``."""
    change, up = _rotation(row.predicted.q, row.after.q), _up(row.predicted)
    return quaternion.to_matrix(mrp.to_quaternion(change - ca.dot(up, change) * up))


def _before_a_change() -> ca.Function:
    """``belief, u -> belief``: before the attitude became less sure."""
    symbols, mean, covariance, row = _symbols()
    up, (tilt, yaw) = _up(row.after), _widened(row)
    noise = symmetric(3, lambda i, j: tilt * (i == j) + (yaw - tilt) * up[i] * up[j])
    noise = ca.diagcat(noise, ca.SX(N, N))
    out = _packed(*less_noise(mean, covariance, row.after.covariance, noise))
    return plain_function("before_a_change", symbols, [out], OPTIONS)


def _before_the_updates() -> ca.Function:
    """``belief, u -> belief``: the same of the prediction.

    ``moved`` has turned the covariance along with the vertical; here it is turned back. What the
    scale factors leave of the smoothed estimate is the same of both.
    """
    symbols, mean, covariance, row = _symbols()
    after, before = row.after, row.predicted
    axes = ca.diagcat(_turned_back(row), ca.SX.eye(6))
    half = axes @ covariance
    covariance = symmetric(WHOLE, lambda i, j: ca.dot(half[i, :], axes[j, :]))
    change, scaled = mean[:, 0], before.scaled - axes @ (after.scaled - mean[:, 1:])
    q = quaternion.product(after.q, mrp.to_quaternion(change[:3]))
    bias, velocity = after.bias + change[3:N], after.velocity + change[N:]
    change = ca.vertcat(_rotation(before.q, q), bias - before.bias, velocity - before.velocity)
    mean = ca.horzcat(change, scaled)
    return plain_function("before_updates", symbols, [_packed(mean, covariance)], OPTIONS)


def _rotation(a, b):
    """The rotation (3,) in rad from the attitude ``a`` to ``b``, at most half a turn."""
    q = quaternion.product(quaternion.conjugate(a), b)
    return mrp.from_quaternion(q * ca.if_else(q[0] < 0, -1, 1))


def _before_a_beginning(kept: list[int]) -> ca.Function:
    """``belief, u -> belief``: of the other errors only what those ``kept`` tell of them is known.

    By the prediction the others are ``gain`` times these, and what is independent of them.
    """
    symbols, mean, covariance, row = _symbols()
    others = [i for i in range(WHOLE) if i not in kept]
    whole, own = row.predicted.covariance, covariance[kept, kept]
    gain = whole[others, kept] @ inverse(whole[kept, kept])
    cross = gain @ own
    rest = whole[others, others] + (cross - whole[others, kept]) @ gain.T
    order = [(kept + others).index(i) for i in range(WHOLE)]
    covariance = ca.blockcat([[own, cross.T], [cross, rest]])[order, order]
    mean = ca.vertcat(mean[kept, :], gain @ mean[kept, :])[order, :]
    name = f"before_beginning_beside_{len(kept)}"
    return plain_function(name, symbols, [_packed(mean, covariance)], OPTIONS)


def _before_a_bound() -> ca.Function:
    """``belief, u -> belief``: before an attitude that may be lost was bounded, x' = S x + w.

    S shrinks, and P' is the bounded covariance: the gain is P S (P')^-1.
    """
    symbols, mean, covariance, row = _symbols()
    whole = row.predicted.covariance
    after = bounded(whole)
    gain = whole @ ca.diag(shrunk(whole)) @ inverse(after)
    half = gain @ (covariance - after)
    covariance = symmetric(WHOLE, lambda i, j: whole[i, j] + ca.dot(half[i, :], gain[j, :]))
    return plain_function("before_bound", symbols, [_packed(gain @ mean, covariance)], OPTIONS)


def _before_the_prediction() -> ca.Function:
    """``belief, u -> belief``: after the sample before."""
    symbols, mean, covariance, row = _symbols()
    to = row.transition
    mean, covariance, whole = (
        to.untilted(mean),
        _of_both(to.untilted, covariance),
        _of_both(to.untilted, row.predicted.covariance),
    )
    mean, covariance = less_noise(mean, covariance, whole, to.noise)
    mean = to.undone(mean)
    mean[3:N, 0] += to.set_back
    out = _packed(mean, _of_both(to.undone, covariance))
    return plain_function("before_prediction", symbols, [out], OPTIONS)


def _of_both(function: Callable, covariance):
    """The covariance A P A^T of what ``function`` makes of an error, A x."""
    return function(function(covariance).T)


def less_noise(mean, covariance, whole, noise):
    """Mean and covariance of an error before ``noise`` (9, 9) was added to it.

    ``whole`` (9, 9) is the filter's covariance after that, without the samples that follow.
    """
    kept = ca.SX.eye(WHOLE) - noise @ inverse(whole)
    half = kept @ covariance
    left = kept @ noise
    return kept @ mean, symmetric(WHOLE, lambda i, j: ca.dot(half[i, :], kept[j, :]) + left[i, j])


def inverse(matrix):
    """The inverse of a symmetric definite ``matrix``, by its factors L D L^T.

    The ``columns`` are those of L^-1, by forward substitution.
    """
    size = matrix.shape[0]
    pivots, lower = factors(matrix, size)
    columns = []
    for j in range(size):
        column: list = [0] * j + [1]
        for i in range(j + 1, size):
            column.append(-sum((lower[k][i] * column[k] for k in range(j, i)), 0))
        columns.append(column)
    scaled = [[v / p for v, p in zip(column, pivots, strict=True)] for column in columns]
    return symmetric(
        size, lambda i, j: sum((columns[i][k] * scaled[j][k] for k in range(j, size)), 0)
    )
