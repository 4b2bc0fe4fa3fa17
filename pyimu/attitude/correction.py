"""The filter's updates as casadi functions of the working estimate (``pyimu.attitude.memory``): by
gravity, a heading, a zero rate.
"""

from __future__ import annotations

import casadi as ca

from pyimu.attitude import late_heading, marginal, unscented
from pyimu.attitude.compensation import Compensation
from pyimu.attitude.memory import ESTIMATE, WORKING, Memory, n_state
from pyimu.attitude.settings import Settings
from pyimu.attitude.unscented import Estimate, N, bounded, bounded_tilt, measure
from pyimu.attitude.variables import ABSURD, INPUTS, LEAST_HEADING_STD
from pyimu.symbolic import mrp, quaternion
from pyimu.symbolic.linear import cholesky, forward, symmetric

DOUBT = 25.0
"""Normalised innovation squared of three degrees of freedom above which a measurement is weighed
less; 1.5e-5 of all exceed it."""

HEADING_DOUBT = 18.7
"""The same of one degree of freedom, with the same probability."""

KNOWN_TILT = 0.3
"""rad; standard deviation of the tilt up to which a heading is used."""

RECOVERY = 0.2
"""s; while gravity contradicts the attitude, the variance of the tilt grows by a factor of e in so
long a time."""

LEVEL = 0.1
"""Least horizontal part of the forward axis for which a heading is used: up to 84 degrees of pitch.
"""

GRAVITY = 11
"""Numbers that the update by gravity takes: a force (3,), its variance (3,) as it weighs, the
magnitude of gravity, the sample period, and its variance (3,) as one sample has it."""

OPTIONS = {"cse": True}


def _with(s, x: Estimate):
    """The working estimate ``s`` with ``x`` in place of what it was."""
    return ca.vertcat(Memory.pack_estimate(x), s[ESTIMATE - 1 :])


def vertical(x: Estimate):
    """The upward direction (3,) in body axes."""
    return _seen_back(x.q, ca.vertcat(0, 0, 1))


def bounding() -> ca.Function:
    """An estimate whose attitude is lost, its standard deviations held."""
    s = ca.SX.sym("x", WORKING)
    x = Memory.estimate_of(s)
    return ca.Function(
        "bounding", [s], [_with(s, Estimate(x.q, x.bias, bounded(x.covariance)))], OPTIONS
    )


def bounding_tilt() -> ca.Function:
    """The same for gravity to set right."""
    s = ca.SX.sym("x", WORKING)
    return ca.Function(
        "bounding_tilt", [s], [_with(s, bounded_tilt(Memory.estimate_of(s)))], OPTIONS
    )


def by_gravity(form: str) -> ca.Function:
    """``x, (force, variance, g, h) -> x``: the force against gravity seen from the body, R_nb^T [0,
    0, g].

    Of an error p the part along the vertical turns nothing that gravity shows: the error is a tilt,
    and then a heading.
    """
    s, given = ca.SX.sym("x", WORKING), ca.SX.sym("gravity", GRAVITY)
    x, force, noise, own = Memory.estimate_of(s), given[:3], ca.diag(given[3:6]), ca.diag(given[8:])
    axes = quaternion.to_matrix(x.q)
    up = axes[2, :].T
    if form == "marginal":
        mean, variance, cross = marginal.measure_gravity(x, axes, given[6])
        x, nis, weight = marginal.correct(
            x, force - mean, variance + noise, variance + own, cross, up, DOUBT
        )
    else:
        mean, variance, cross = measure(
            x, lambda p: given[6] * _seen_back(mrp.to_quaternion(p - ca.dot(up, p) * up), up)
        )
        x, nis, weight = unscented.correct(
            x, force - mean, variance + noise, cross, up, DOUBT, variance + own
        )
    doubted = weight < 1
    x = Estimate(x.q, x.bias, _doubtful(x.covariance, vertical(x), doubted * given[7] / RECOVERY))
    return ca.Function(
        "by_gravity",
        [s, given],
        [ca.vertcat(Memory.pack_estimate(x), s[ESTIMATE - 1], nis, doubted, s[ESTIMATE + 2 :])],
        OPTIONS,
    )


def _seen_back(q, v):
    """A vector seen from axes that are turned by ``q``."""
    return quaternion.rotate(quaternion.conjugate(q), v)


def _doubtful(covariance, up, share):
    """The covariance with the tilt's variance larger by a ``share`` of itself, independent of the
    bias.

    A few wrong samples change little; an attitude that is far off, as one given upside down, is
    given up in time for gravity to set it right, without what it was off by being taken for bias.
    """
    tilt = tilt_variance(covariance, up) * share
    return symmetric(
        N,
        lambda i, j: (
            covariance[i, j] + tilt * ((i == j) - up[i] * up[j]) if j < 3 else covariance[i, j]
        ),
    )


def tilt_variance(covariance, up):
    """Variance of the tilt in rad^2, the mean of its two axes."""
    pp = covariance[:3, :3]
    return (ca.trace(pp) - ca.dot(up, pp @ up)) / 2


# Heading


def by_heading(compensation: Compensation, n_inputs: int, n_parameters: int) -> ca.Function:
    """``x, s, u, p, h, rate, grown -> x`` with the state ``s`` of the block before the sample,
    ``grown`` that of ``Memory`` after it.
    """
    n = n_state(compensation)
    sizes = {"x": WORKING, "s": n, "u": n_inputs, "p": n_parameters, "h": 1, "rate": 3, "grown": 1}
    x, s, u, p, h, rate, grown = given = [ca.MX.sym(name, size) for name, size in sizes.items()]
    ring = n - 2 * late_heading.SLOTS
    heading, samples, each = _heading(compensation, n_inputs, n_parameters)(u, p, h)
    neighbours = late_heading.picked(
        s,
        ring,
        ca.fmin(ca.fmax(samples, 1), late_heading.oldest(each)),
        s[ring - 2],
        s[ring - 1],
        each,
    )
    return ca.Function(
        "by_heading", given, [_past_heading()(x, neighbours, heading, samples, each, rate, grown)]
    )


def _heading(compensation: Compensation, n_inputs: int, n_parameters: int) -> ca.Function:
    """``u, p, h -> heading, samples, each``: the heading and its variance, whether they are usable
    numbers, the period, the gyro's squared rate random walk (3,); its age in samples; samples per
    slot of the rings.
    """
    u, p, h = (
        ca.SX.sym(name, size) for name, size in (("u", n_inputs), ("p", n_parameters), ("h", 1))
    )
    settings, at = Settings.of(compensation, p), {v.name: u[i] for i, v in enumerate(INPUTS)}
    given = ca.vertcat(*[at[n] for n in ("heading", "heading_variance", "heading_age")])
    good = ca.mmin(ca.vertcat(ca.fabs(given) <= ABSURD, given[1] > 0, given[2] >= 0))
    given = ca.if_else(good, given, 0)
    return ca.Function(
        "heading",
        [u, p, h],
        [
            ca.vertcat(given[0], given[1] + LEAST_HEADING_STD**2, good, h, settings.gyro.walk**2),
            ca.floor(given[2] / h + 0.5),
            late_heading.samples_per_slot(settings.scalar["heading_memory"], h),
        ],
        OPTIONS,
    )


def _past_heading() -> ca.Function:
    """``x, neighbours, heading, samples, each, rate, grown -> x``: a heading against the yaw that
    it belongs to.

    Of an age T, the heading saw the attitude before the gyro's noise of that time, and before its
    bias error had turned it: yaw then = yaw now + T u b - w, with u the vertical in body axes, b
    the bias error and w the angle about it that the noise made. As w is in the present error too,
    it lessens the innovation's variance, and the covariance with the error alike. Angles are
    differences, so that nothing depends on where yaw wraps.

    It is held back while gravity contradicts the attitude or the tilt is not known: what turns a
    heading is then no error of yaw.
    """
    sizes = {
        "x": WORKING,
        "neighbours": 5,
        "heading": 7,
        "samples": 1,
        "each": 1,
        "rate": 3,
        "grown": 1,
    }
    s, neighbours, given, samples, each, rate, grown = symbols = [
        ca.SX.sym(name, size) for name, size in sizes.items()
    ]
    x, done, (heading, noise, good, h) = (
        Memory.estimate_of(s),
        s[ESTIMATE - 1],
        ca.vertsplit(given[:4]),
    )
    now, up, doubted = quaternion.rotate(x.q, ca.vertcat(1, 0, 0)), vertical(x), s[ESTIMATE + 1]
    past, there = late_heading.between(neighbours)
    then = ca.if_else(samples < 1, ca.atan2(now[1], now[0]), past + done)
    kept = ca.logic_or(samples < 1, ca.logic_and(there, samples <= late_heading.oldest(each)))

    def yaw_from_centre(p):
        return angle(
            now,
            quaternion.rotate(quaternion.product(x.q, mrp.to_quaternion(p)), ca.vertcat(1, 0, 0)),
        )

    mean, variance, cross = measure(x, yaw_from_centre)
    age = samples * h
    since = ca.if_else(samples < 1, 0, ca.fmax(grown - late_heading.grown_between(neighbours), 0))
    variance, cross, apart = _aged(x, variance, cross, up, age, since, ca.dot(up * up, given[4:]))
    # Beyond the first order: a tilt's error shows in the yaw by how much the body has tilted since.
    noise += tilt_variance(x.covariance, up) * ca.sumsqr(ca.cross(up, rate - x.bias)) * age**2
    after, _, weight = unscented.correct(
        x, late_heading.wrapped(heading - then) - mean, variance + noise, cross, up, HEADING_DOUBT
    )
    after = Estimate(
        after.q, after.bias, _unsure_of_yaw(after.covariance, vertical(after), weight < 1)
    )
    done = late_heading.wrapped(done + angle(now, quaternion.rotate(after.q, ca.vertcat(1, 0, 0))))
    told = ca.logic_and(ca.sumsqr(now[:2]) > LEVEL**2, ca.logic_and(good, kept))
    clear = ca.logic_and(
        ca.logic_and(doubted < 0.5, tilt_variance(x.covariance, up) <= KNOWN_TILT**2), apart
    )
    out = ca.if_else(
        ca.logic_and(told, clear), ca.vertcat(Memory.pack_estimate(after), done), s[:ESTIMATE]
    )
    report = ca.vertcat(
        ca.logic_and(good, ca.logic_not(kept)),
        ca.logic_not(good),
        ca.logic_and(told, ca.logic_not(clear)),
        ca.logic_and(ca.logic_and(told, clear), weight < 1),
    )
    return ca.Function(
        "past_heading", symbols, [ca.vertcat(out, s[ESTIMATE : ESTIMATE + 2], report)], OPTIONS
    )


def _aged(x: Estimate, variance, cross, up, age, since, walk):
    """Variance of the yaw ``age`` T s ago and its covariance (6,) with the present error, from
    those of the present yaw; and whether they are had.

    ``since`` rad^2 is the variance about the vertical u that the angle w got in the meantime,
    ``walk`` K^2 that of the bias in a second. Together they gave the errors of angle and bias along
    u the covariance Q = [since + K^2 T^3/3, -K^2 T^2/2; -K^2 T^2/2, K^2 T]. If nothing else told of
    them, the present covariance P is that without them, and U Q U^T more, U = [u 0; 0 u] (6, 2).
    Others may have told of it, as a heading of the present does: to subtract all of Q makes the yaw
    then seem better known than it is, by which the heading is weighed less, and what is left of the
    covariance is too large, never too small. Where less than Q is left the heading would tell
    nothing, and none is had. Otherwise P - U Q U^T is semidefinite, and with it what a correction
    leaves: the eigenvalues of Q U^T P^-1 U are at most 1, which by Schur is the same.
    """
    leaked = age * (x.covariance[:, 3:] @ up)
    variance, cross = (
        variance + age * (2 * ca.dot(up, cross[3:]) + ca.dot(up, leaked[3:])),
        cross + leaked,
    )
    along = ca.vertcat(ca.horzcat(up, ca.SX(3, 1)), ca.horzcat(ca.SX(3, 1), up))
    noise = ca.vertcat(
        ca.horzcat(since + walk * age**3 / 3, -walk * age**2 / 2),
        ca.horzcat(-walk * age**2 / 2, walk * age),
    )
    root = cholesky(x.covariance)
    whitened = forward(root, along)
    slope = whitened.T @ forward(root, cross)
    shares = noise @ (whitened.T @ whitened)
    apart = ca.logic_and(
        ca.trace(shares) < 2,
        ca.trace(shares) - (shares[0, 0] * shares[1, 1] - shares[0, 1] * shares[1, 0]) < 1,
    )
    return variance - ca.dot(slope, noise @ slope), cross - along @ (noise @ slope), apart


def _unsure_of_yaw(covariance, up, doubted):
    """The covariance with twice the variance about the vertical where a heading is ``doubted``,
    independent of the bias.

    One that is wrong changes little; a yaw that is far off is given up after some.
    """
    yaw = doubted * ca.dot(up, covariance[:3, :3] @ up)
    return symmetric(
        N, lambda i, j: covariance[i, j] + yaw * up[i] * up[j] if j < 3 else covariance[i, j]
    )


def angle(a, b):
    """Angle in rad from the horizontal direction of ``a`` to that of ``b``, -pi to pi."""
    return ca.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1])


# Zero rate


def by_zero_rate(compensation: Compensation, n_parameters: int) -> ca.Function:
    """``x, rate, p, h -> x``: the gyro of a stationary body shows bias and Earth rate, z = b +
    R_nb^T w_e + n, linear in the error state.

    To first order R_nb^T w_e of the true attitude is w_b + w_b x p.
    """
    s, rate, p, h = (
        ca.SX.sym(name, size)
        for name, size in (("x", WORKING), ("rate", 3), ("p", n_parameters), ("h", 1))
    )
    x, settings = Memory.estimate_of(s), Settings.of(compensation, p)
    earth = _seen_back(x.q, settings.earth)
    slope = ca.horzcat(ca.skew(earth), ca.SX.eye(3))
    cross = x.covariance @ slope.T
    noise = settings.gyro.white**2 / h + settings.scalar["stationary_std"] ** 2
    after, _, _ = unscented.correct(
        x, rate - x.bias - earth, slope @ cross + ca.diag(noise), cross, vertical(x)
    )
    return ca.Function("by_zero_rate", [s, rate, p, h], [_with(s, after)], OPTIONS)
