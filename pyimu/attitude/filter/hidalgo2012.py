"""The attitude filter as it is published (Hidalgo 2012, sections 4 to 6), as a block.

It shares with the package's own filter the reading of a sample, the compensation of the part's
errors, the quaternions and Rodrigues parameters and the outputs, and differs where the paper does:

* Sigma points (section 4): columns of +-sqrt((n + lambda) P) of the covariance alone, and the
  centre with the weight lambda/(n + lambda). lambda >= 0 is a parameter; at 0 the centre has no
  weight, and the 2n points are the paper's.
* Propagation (section 4.2): the rate of sample k, less the bias and the Earth's rate as they are
  after the update of sample k, turns the attitude until sample k + 1. The package's own filter
  takes a rate for that of the period which ends with its sample.
* Q (section 4.2): that of a body which does not turn, N and K alone.
* Low-pass (section 6.1): calibrated and compensated samples are low-pass filtered at 10 Hz before
  the filter sees them. The attitude is late by its delay, 22.5 ms, and the filter does not know.
* The quasi-static estimator (section 5): a scalar Kalman filter on the magnitude of the force
  alone; the accelerometer is used while that is within a tolerance of the magnitude of gravity at
  the rover's latitude. No velocity, no mean force, no innovation gate, no heading, no zero rate.

Where the paper is silent or wrong, this was taken:

* The error's scale. The paper names f = a = 1 but prints a Q that holds in rad, f = 2 (a + 1), the
  package's own (``pyimu.symbolic.mrp``). With a Q scaled to f = a = 1 the estimates are the same.
* Signs of Q. The minus off the diagonal is lost in the text; it must be there, as the bias is
  subtracted (``pyimu.symbolic.process_noise``).
* Misalignment and scale factor M. The paper subtracts M times the measured rate, which leaves
  M^2 w: 0.13 deg/s at 140 deg/s and 3 %. The part's effects are undone exactly here.
* lambda: silent; that of the package's own filter, 1.
* The measurement and its noise. The accelerometer is an inclinometer that gives pitch and roll, its
  axes three independent Gaussian variables: taken as the vector of gravity in body axes, R diagonal
  (Crassidis and Markley 2003, eq. 40). To first order that is pitch and roll, and it has no
  singularity. R is the white noise of a sample, N^2/h, plus ``accel_std``^2. The low-pass filter
  leaves the density at low frequencies as it is, so that N^2/h stays right for correlated samples.
* Gain of the quasi-static estimator and its tolerance: silent. The gain is that of a scalar Kalman
  filter with R's noise and the package's own ``gravity_walk``; the tolerance is the package's, too.
* ``accel_std``: silent. What passes the gate follows from its tolerance
  (``pyimu.attitude.filter.hidalgo2012_state.ACROSS``).
* Kind of the low-pass filter: silent; Butterworth's of second order, the effect ``lag`` of the
  catalogue. ``low_pass`` 0 leaves it out.
* The covariance after an update is not turned along with the body, as in Crassidis and Markley
  2003. Gravity then seems to tell something of a heading that is not known well.
* What is missing, stuck or at a limit, and a lost gyro: as in the package's own filter.
"""

from __future__ import annotations

from dataclasses import replace
from math import pi

import casadi as ca

from pyimu.attitude.filter.compensation import Compensation
from pyimu.attitude.filter.filter_block import left_in_words
from pyimu.attitude.filter.hidalgo2012_state import (
    ESTIMATE,
    OWN_PARAMETERS,
    Layout,
    State,
    estimate_of,
    gravity_of,
    packed,
)
from pyimu.attitude.filter.quasi_static import follow
from pyimu.attitude.filter.sample import Sample, look_closely, unknown_turn
from pyimu.attitude.filter.settings import Settings
from pyimu.attitude.filter.sigma_point_filter import propagate
from pyimu.attitude.filter.timing import clock_error
from pyimu.attitude.filter.unscented import Estimate, N, bounded, measure
from pyimu.attitude.filter.updates import outputs, where
from pyimu.attitude.filter.variables import LEAST_ACCEL_STD, LEAST_K, LEAST_N, OUTPUTS
from pyimu.block.block import Block
from pyimu.block.plain import plain_function
from pyimu.model.effects.dynamics import lag
from pyimu.model.part import Part
from pyimu.symbolic import mrp, quaternion
from pyimu.symbolic.linear import cholesky, forward, symmetric
from pyimu.symbolic.process_noise import process_noise

BUTTERWORTH = 0.5**0.5
"""Damping ratio of Butterworth's low-pass filter of second order."""

OPTIONS = {"cse": True}


def attitude_hidalgo2012(part: Part) -> Block:
    """The filter ``AttitudeHidalgo2012`` of a part, a block.

    The part has ``gyro`` and ``accel`` (``Sensor``) and ``sample_rate`` in Hz. Its inputs are
    ``gyro``, ``accel``, ``temperature``, and what else the part's errors depend on; its outputs are
    those of ``AttitudeUkf``, at
    the instant at which a gyro that is late took its sample.
    """
    layout = Layout(Compensation(part, now=False))
    p = ca.SX.sym("p", len(layout.parameters))
    first = layout.start(p)
    shown = outputs(first.estimate, 0, 0, 0, 0)
    u = ca.SX.sym("u", len(layout.inputs))
    return Block(
        name="AttitudeHidalgo2012",
        description=(
            f"Unscented attitude filter as of Hidalgo 2012 of the part {part.name}"
            f"{left_in_words(part, delayed=True)}"
        ),
        step=_step(layout),
        initial=plain_function("initial", [u, p], [first.pack(), shown], ["u", "p"], ["s", "y"]),
        inputs=layout.inputs,
        parameters=layout.parameters,
        outputs=OUTPUTS,
        noise=(),
        sample_period=1.0 / part.sample_rate,
    )


# The step


def _step(layout: Layout) -> ca.Function:
    """Low-pass filter, propagation, quasi-static estimator, and the correction where it says so."""
    symbols = {"s": sum(layout.sizes), "u": len(layout.inputs), "p": len(layout.parameters)}
    s, u, p = (ca.MX.sym(name, size) for name, size in symbols.items())
    w, h = ca.MX(0, 1), ca.MX.sym("h")
    state, force, flags = _predict(layout)(s, u, p, h)
    working = ca.vertcat(state[:ESTIMATE], 0)
    x = where(flags[0], _by_gravity(), working, force)
    return plain_function(
        "step",
        [s, u, p, w, h],
        [ca.vertcat(x[:ESTIMATE], state[ESTIMATE:]), _shown()(x, flags)],
        ["s", "u", "p", "w", "h"],
        ["s_next", "y"],
    )


def _predict(layout: Layout) -> ca.Function:
    """``s, u, p, h -> s, force, flags``.

    The state with the propagated estimate; the force (3,), its variance (3,), the magnitude of
    gravity and lambda; whether the body is quasi-static, and the status.
    """
    symbols = {"s": sum(layout.sizes), "u": len(layout.inputs), "p": len(layout.parameters)}
    s, u, p = (ca.SX.sym(name, size) for name, size in symbols.items())
    period = ca.SX.sym("h")
    before = layout.state(s)
    settings = Settings.of(layout.compensation, p, OWN_PARAMETERS)
    at, gravity = settings.scalar, gravity_of(settings)
    h = period * (1 + clock_error(layout.compensation.part.gyro, settings.gyro_p))
    row = layout.row(u)
    sample = look_closely(layout.compensation, before.memory, row, settings, h)
    rate, force, passed = _low_passed(before, sample, at["low_pass"], h)
    x = _propagated(before, sample, settings, h)
    accel = settings.accel
    noise = (accel.white**2 + accel.relative**2 * gravity**2) / h + LEAST_ACCEL_STD**2
    noise = noise + at["accel_std"] ** 2
    magnitude, valid = ca.norm_2(force), sample.force_valid
    walk = at["gravity_walk"] ** 2 * h
    quasi = follow(before.quasi, magnitude, walk, ca.sum1(noise) / 3, valid)
    static = ca.logic_and(valid, ca.fabs(quasi.magnitude - gravity) <= at["gravity_tolerance"])
    after = replace(
        before,
        estimate=x,
        quasi=quasi,
        rate=rate,
        passed=passed,
        started=ca.SX(1),
        seen=before.seen + ca.if_else(valid, h, 0),
        held=sample.held,
        lost_for=sample.lost_for,
        same_for=sample.same_for,
        sensors=sample.sensors,
    )
    status = sample.missing + 2 * sample.at_limit + 4 * sample.stuck
    measured = ca.densify(ca.vertcat(force, noise, gravity, at["lambda"]))
    flags = ca.densify(ca.vertcat(static, status))
    return plain_function("predict", [s, u, p, period], [after.pack(), measured, flags], OPTIONS)


def _low_passed(before: State, sample: Sample, corner, h):
    """Rate and force (3,) behind the low-pass filter, and its memory (24,).

    Each begins as if its first sample had been there for long.
    """
    found, passed = [], []
    for i, (values, begun) in enumerate(
        ((sample.rate, before.started), (sample.force, before.seen > 0))
    ):
        first = ca.repmat(values, 4, 1)
        past = ca.if_else(begun, before.passed[12 * i : 12 * i + 12], first)
        out, after = lag.function(values, 2 * pi * corner, BUTTERWORTH, *ca.vertsplit(past, 3), h)
        found.append(out)
        passed += [after[name] for name in ("x1", "x2", "y1", "y2")]
    return *found, ca.vertcat(*passed)


def _propagated(before: State, sample: Sample, settings: Settings, h) -> Estimate:
    """The estimate at this sample, turned by the rate of the one before; the first has none.

    Each sigma point turns by omega = measured - C omega_earth - bias with the attitude C and the
    bias that are its own, by Omega(omega) (Hidalgo 2012, section 4.2).
    """
    x, at, h = before.estimate, settings.scalar, h * before.started
    earth = quaternion.rotate(quaternion.conjugate(x.q), settings.earth)

    def turn(rate, error):
        return rate - quaternion.rotate(quaternion.conjugate(error), earth)

    noise = process_noise(settings.gyro.white, settings.gyro.walk, h)
    lost = settings.scalar["lost_rate_std"] ** 2 * unknown_turn(before.lost_for, sample.lost_for)
    attitude = LEAST_N**2 * h + before.started * ca.if_else(sample.gyro_lost, lost, 0)
    more = ca.diag(ca.vertcat(attitude, LEAST_K**2 * h * ca.SX.ones(3)))
    after = propagate(x, before.rate, turn, noise + more, h, at["lambda"])
    return replace(after, velocity=x.velocity, covariance=bounded(after.covariance))


def _by_gravity() -> ca.Function:
    """``x, force -> x``: the correction by gravity in body axes, R_nb^T [0, 0, g].

    x+ = x- + K v, P+ = P- - K S K^T (Crassidis and Markley 2003, eqs. 11 to 14); with L the
    Cholesky factor of S, K v = (L^-1 cross^T)^T L^-1 v. The last number of ``x`` becomes the
    normalised innovation squared.
    """
    working, given = ca.SX.sym("x", ESTIMATE + 1), ca.SX.sym("force", 8)
    measured, noise, gravity, spread = ca.vertsplit(given, [0, 3, 6, 7, 8])
    x = estimate_of(working)
    up = quaternion.to_matrix(x.q)[2, :].T

    def force(p):
        return gravity * quaternion.rotate(quaternion.conjugate(mrp.to_quaternion(p)), up)

    mean, variance, cross = measure(x, force, spread)
    root = cholesky(variance + ca.diag(noise))
    whitened, gain = forward(root, measured - mean), forward(root, cross.T).T
    change = gain @ whitened
    covariance = symmetric(N, lambda i, j: x.covariance[i, j] - ca.dot(gain[i, :], gain[j, :]))
    q = quaternion.normalized(quaternion.product(x.q, mrp.to_quaternion(change[:3])))
    after = Estimate(q, x.bias + change[3:], x.velocity, covariance)
    out = ca.vertcat(packed(after), ca.dot(whitened, whitened))
    return plain_function("by_gravity", [working, given], [out], OPTIONS)


def _shown() -> ca.Function:
    """``x, flags -> y``: the outputs."""
    working, flags = ca.SX.sym("x", ESTIMATE + 1), ca.SX.sym("flags", 2)
    x = estimate_of(working)
    no_variance = 1 - ca.mmin(ca.diag(x.covariance) > 0)
    y = outputs(x, flags[0], working[ESTIMATE], flags[1] + 128 * no_variance, 0)
    return plain_function("shown", [working, flags], [y], OPTIONS)
