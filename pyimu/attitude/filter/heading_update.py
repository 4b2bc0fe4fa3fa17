"""The update by a heading, also by one that arrives late, against the yaw to which it belongs."""

from __future__ import annotations

from dataclasses import dataclass, replace

import casadi as ca

from pyimu.attitude.filter import late_heading, unscented
from pyimu.attitude.filter.gravity_update import tilt_variance, vertical
from pyimu.attitude.filter.layout import Layout
from pyimu.attitude.filter.memory import ESTIMATE, WORKING, Memory
from pyimu.attitude.filter.settings import Settings
from pyimu.attitude.filter.unscented import WHOLE, Estimate, N
from pyimu.attitude.filter.variables import ABSURD, INPUTS, LEAST_HEADING_STD
from pyimu.block.plain import plain_function
from pyimu.symbolic import mrp, quaternion
from pyimu.symbolic.linear import cholesky, forward, symmetric

INNOVATION_GATE = 18.7
"""Normalised innovation squared of one degree of freedom, above which a heading gets less weight;
it is exceeded with a probability of 1.5e-5."""

KNOWN_TILT = 0.3
"""rad; standard deviation of the tilt up to which a heading is used."""

LEVEL = 0.1
"""Least horizontal part of the forward axis with which a heading is used: up to 84 degrees of
pitch."""

OPTIONS = {"cse": True}


@dataclass(frozen=True)
class Heading:
    """A heading of the inputs.

    ``angle`` in rad and its ``variance``, whether they are usable numbers (``good``), the sample
    ``period`` in s, ``rate_variance`` in (rad/s)^2 of the gyro's white noise about two axes in a
    sample, and its squared rate random walk ``walk`` (3,) in (rad/s)^2/s.
    """

    angle: ca.SX
    variance: ca.SX
    good: ca.SX
    period: ca.SX
    rate_variance: ca.SX
    walk: ca.SX

    def pack(self) -> ca.SX:
        return ca.vertcat(*vars(self).values())

    @classmethod
    def unpack(cls, column) -> Heading:
        return cls(*ca.vertsplit(column[:5]), column[5:])


HEADING = 8
"""Numbers of a ``Heading``."""


def by_heading(layout: Layout) -> ca.Function:
    """``x, s, u, p, h, rate, vertical_noise -> x``: the working estimate after a heading.

    ``s`` is the state of the block before the sample, ``vertical_noise`` that of ``Memory`` after
    it.
    """
    x, s, u, p, h, rate, vertical_noise = symbols = layout.symbols(
        ca.MX, "x s u p h rate vertical_noise"
    )
    heading, samples, each = _read(layout)(u, p, h)
    neighbours = late_heading.neighbours(
        s,
        layout.rings,
        ca.fmin(ca.fmax(samples, 1), late_heading.oldest(each)),
        s[layout.motion - 3],
        s[layout.motion - 2],
        each,
    )
    after = _past_heading()(x, neighbours, heading, samples, each, rate, vertical_noise)
    return plain_function("by_heading", symbols, [after])


def _read(layout: Layout) -> ca.Function:
    """``u, p, h -> heading, samples, each``: the ``Heading`` of the inputs and its age in samples.

    ``each`` is the number of samples per slot of the rings.
    """
    u, p, h = layout.symbols(ca.SX, "u p h")
    settings = Settings.of(layout.compensation, p)
    at = {v.name: u[i] for i, v in enumerate(INPUTS)}
    given = ca.vertcat(*[at[n] for n in ("heading", "heading_variance", "heading_age")])
    good = ca.mmin(ca.vertcat(ca.fabs(given) <= ABSURD, given[1] > 0, given[2] >= 0))
    given = ca.if_else(good, given, 0)
    variance = given[1] + LEAST_HEADING_STD**2
    rate_variance = ca.sumsqr(settings.gyro.white) * (2 / 3) / h
    heading = Heading(given[0], variance, good, h, rate_variance, settings.gyro.walk**2)
    samples = ca.floor(given[2] / h + 0.5)
    each = late_heading.samples_per_slot(settings.scalar["heading_memory"], h)
    return plain_function("heading", [u, p, h], [heading.pack(), samples, each], OPTIONS)


def _past_heading() -> ca.Function:
    """The function that corrects by a heading against the yaw of ``samples`` ago.

    ``x, neighbours, heading, samples, each, rate, vertical_noise -> x``.

    It is held back while gravity is beyond its innovation gate or the tilt is not known: its
    innovation is then no error of yaw. Angles are differences, so that nothing depends on where yaw
    wraps.
    """
    sizes = {"x": WORKING, "neighbours": 5, "heading": HEADING, "samples": 1, "each": 1, "rate": 3}
    sizes |= {"vertical_noise": 1}
    symbols = [ca.SX.sym(name, size) for name, size in sizes.items()]
    working, neighbours, packed, samples, each, rate, vertical_noise = symbols
    x, heading = Memory.estimate_of(working), Heading.unpack(packed)
    total, beyond = working[ESTIMATE - 1], working[ESTIMATE + 1]
    past = _past_yaw(x, total, neighbours, samples, each, heading.period, vertical_noise)
    after, weight, separable = _corrected(x, heading, past, rate)

    total = late_heading.wrapped(total + angle(_forward(x), _forward(after)))
    level = ca.sumsqr(_forward(x)[:2]) > LEVEL**2
    there = ca.logic_and(level, ca.logic_and(heading.good, past.kept))
    tilt_known = tilt_variance(x.covariance, vertical(x)) <= KNOWN_TILT**2
    clear = ca.logic_and(ca.logic_and(beyond < 0.5, tilt_known), separable)
    used = ca.logic_and(there, clear)
    estimate = ca.vertcat(Memory.pack_estimate(after), total)
    report = (
        ca.logic_and(heading.good, ca.logic_not(past.kept)),
        ca.logic_not(heading.good),
        ca.logic_and(there, ca.logic_not(clear)),
        ca.logic_and(used, weight < 1),
    )
    out = ca.vertcat(
        ca.if_else(used, estimate, working[:ESTIMATE]),
        working[ESTIMATE : ESTIMATE + 2],
        *report,
        working[ESTIMATE + 6 :],
    )
    return plain_function("past_heading", symbols, [out], OPTIONS)


@dataclass(frozen=True)
class PastYaw:
    """A past yaw in rad as the filter now believes it.

    ``kept`` says whether it is in the rings, ``age`` is in s, and ``since`` the variance in rad^2
    that was added about the vertical since then.
    """

    yaw: ca.SX
    kept: ca.SX
    age: ca.SX
    since: ca.SX


def _past_yaw(x: Estimate, total, neighbours, samples, each, period, vertical_noise) -> PastYaw:
    """The yaw of ``samples`` ago, the present one at 0.

    ``total`` rad is the sum of the corrections by headings so far.
    """
    now, present = _forward(x), samples < 1
    past, there = late_heading.past_yaw(neighbours)
    yaw = ca.if_else(present, ca.atan2(now[1], now[0]), past + total)
    kept = ca.logic_or(present, ca.logic_and(there, samples <= late_heading.oldest(each)))
    since = ca.fmax(vertical_noise - late_heading.past_noise(neighbours), 0)
    return PastYaw(yaw, kept, samples * period, ca.if_else(present, 0, since))


def _corrected(x: Estimate, heading: Heading, past: PastYaw, rate):
    """The estimate after the heading, its weight, and whether it is separable from later noise.

    The last is that of ``_aged``.

    Of an age T, the heading belongs to the attitude before the gyro's noise of that time, and
    before its bias error had turned it: yaw then = yaw now + T u b - w, with u the vertical in body
    axes, b the bias error and w the angle about it that the noise made. As w is in the present
    error as well, it lessens the variance of the innovation and its covariance with the error.
    """
    up, slope = vertical(x), yaw_slope(x)
    cross = x.covariance[:, :3] @ slope.T
    variance = slope @ cross[:3]
    walk = ca.dot(up * up, heading.walk)
    variance, cross, separable = _aged(x, variance, cross, up, past, walk)
    # Beyond the first order: a tilt error changes the yaw by as much as the body has tilted since.
    # The error lasts for longer than the age, so that all headings of that time share it.
    square = ca.fmax(ca.sumsqr(ca.cross(up, rate - x.bias)) - heading.rate_variance, 0)
    tilted = tilt_variance(x.covariance, up) * square * past.age**2
    tilted *= ca.fmax(1, past.age / heading.period)
    innovation = mrp.F * ca.tan(late_heading.wrapped(heading.angle - past.yaw) / mrp.F)
    seen = slope @ x.scaled[:3, :]
    after, _, weight = unscented.correct(
        x, innovation, variance + (heading.variance + tilted), cross, up, INNOVATION_GATE, seen=seen
    )
    return _with_less_known_yaw(after, weight < 1), weight, separable


def yaw_slope(x: Estimate):
    """The slope (1, 3) of yaw over the attitude error p, at none.

    A turn about the vertical by an angle y changes the yaw by y and p by F tan(y/F) along the
    vertical: with that for the innovation the measurement is linear in a yaw that is off by any
    angle. Sigma points of a yaw that is hardly known would lie where the angle wraps.
    """
    axes = quaternion.to_matrix(x.q)
    change = -axes @ ca.skew(ca.vertcat(1, 0, 0))
    east, north = axes[0, 0], axes[1, 0]
    return (east * change[1, :] - north * change[0, :]) / (east * east + north * north)


def _aged(x: Estimate, variance, cross, up, past: PastYaw, walk):
    """Variance of the past yaw and its covariance (9,) with the present error; whether separable.

    They are made from those of the present yaw.

    ``past.since`` is the variance about the vertical u that the angle w got in the age T,
    ``walk`` K^2 that of the bias in a second. Together they gave the errors of angle and bias along
    u the covariance Q = [since + K^2 T^3/3, -K^2 T^2/2; -K^2 T^2/2, K^2 T]. If nothing else was
    measured of them, the present covariance P is that without them, and U Q U^T more, U = [u 0; 0
    u] (6, 2). If something was, as by a heading of the present, then subtracting all of Q makes the
    yaw of then seem better known than it is: the heading gets less weight, and what is left of the
    covariance is too large, never too small. Where less than Q is left the heading would tell
    nothing, and the two cannot be separated. Otherwise P - U Q U^T is semidefinite, and with it
    what a correction leaves: the eigenvalues of Q U^T P^-1 U are at most 1, which by Schur is the
    same.
    """
    age, since = past.age, past.since
    leaked = age * (x.covariance[:, 3:N] @ up)
    variance = variance + age * (2 * ca.dot(up, cross[3:N]) + ca.dot(up, leaked[3:N]))
    cross = cross + leaked
    along = ca.vertcat(ca.horzcat(up, ca.SX(3, 1)), ca.horzcat(ca.SX(3, 1), up))
    noise = ca.vertcat(
        ca.horzcat(since + walk * age**3 / 3, -walk * age**2 / 2),
        ca.horzcat(-walk * age**2 / 2, walk * age),
    )
    root = cholesky(x.covariance[:N, :N])
    whitened = forward(root, along)
    slope = whitened.T @ forward(root, cross[:N])
    shares = noise @ (whitened.T @ whitened)
    separable = ca.logic_and(
        ca.trace(shares) < 2,
        ca.trace(shares) - (shares[0, 0] * shares[1, 1] - shares[0, 1] * shares[1, 0]) < 1,
    )
    told = ca.vertcat(along, ca.SX(3, 2)) @ (noise @ slope)
    return variance - ca.dot(slope, noise @ slope), cross - told, separable


def _with_less_known_yaw(x: Estimate, beyond) -> Estimate:
    """The estimate with a doubled yaw variance where a heading is ``beyond`` its innovation gate.

    The variance is that about the vertical; what is added is independent of the bias.

    One wrong heading changes little; a yaw that is far off is given up after some.
    """
    up, covariance = vertical(x), x.covariance
    yaw = beyond * ca.dot(up, covariance[:3, :3] @ up)
    wider = symmetric(
        WHOLE,
        lambda i, j: covariance[i, j] + yaw * up[i] * up[j] if j < 3 else covariance[i, j],
    )
    return replace(x, covariance=wider)


def _forward(x: Estimate):
    """The forward axis (3,) of the body in world axes."""
    return quaternion.rotate(x.q, ca.vertcat(1, 0, 0))


def angle(a, b):
    """Angle in rad from the horizontal direction of ``a`` (3,) to that of ``b``, -pi to pi."""
    return ca.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1])
