"""The attitude filter of a part as a block: an unscented filter on attitude error and gyro bias.

One sample does the following, in this order: hold what is not finite; undo the sensors' own errors; turn by the measured
rate less bias and Earth rate; correct by gravity's direction while quasi-static, by a heading, and by a zero rate.
Sources: Hidalgo 2012, sections 4 and 5; Crassidis and Markley 2003.

The sample of a rate stands for the period that ends with it.  The bias is what remains of the compensated rate.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import casadi as ca
import numpy as np

from pyimu.attitude.quasi_static import QuasiStatic, follow, is_quasi_static
from pyimu.attitude.unscented import LARGEST_STD, Estimate, N, bounded, correct, measure, propagate
from pyimu.block import Block, Variable
from pyimu.effect import Sensor
from pyimu.imu import Part
from pyimu.signals import vector
from pyimu.symbolic import quaternion
from pyimu.symbolic.earth import earth_rate
from pyimu.symbolic.linear import pack, unpack
from pyimu.symbolic.noise import process_noise
from pyimu.units import STANDARD_GRAVITY

STATUS = {1: "an input was not finite or absurd, and its last good value was held", 2: "a sample was at a sensor's limit"}
"""Bits of the output ``status``; 0 is well."""

UNKNOWN_LATITUDE = 10.0
"""rad; like every value outside -pi/2 to pi/2 (NaN too) it stands for "not known", and no Earth rate is subtracted."""

ABSURD = 1e6
"""SI; an input larger than this is treated like one that is not finite, since its square might not be."""

LEAST_N = 1e-9
"""rad/sqrt(s); the least angle random walk of the process noise.  Together with ``LEAST_K`` it keeps the covariance
definite for a part without noise."""

LEAST_K = 1e-10
"""rad/s/sqrt(s); the least rate random walk of the process noise."""

LEAST_ACCEL_STD = 1e-4
"""m/s^2; the least standard deviation of a sample of specific force."""

LEAST_HEADING_STD = 1e-6
"""rad; the least standard deviation of a heading."""

LEVEL = 0.1
"""Least horizontal part of the forward axis for which a heading is used: up to 84 degrees of pitch."""


def attitude_ukf(part: Part) -> Block:
    """The filter ``AttitudeUkf`` of a part with ``gyro`` and ``accel`` (``Sensor``) and ``sample_rate`` in Hz.

    State, in this order: q (4), bias (3), upper triangle of the covariance (21), magnitude of gravity and its variance,
    last good gyro (3), accel (3) and temperature, time each gyro axis has been lost (3) s, states of the two compensations.
    """
    parameters = (*_own_parameters(), *part.gyro.variables, *part.accel.variables)
    p, h, u = ca.SX.sym("p", len(parameters)), ca.SX.sym("h"), ca.SX.sym("u", len(INPUTS))
    memory_start, settings = _start(part, p), _Settings.of(part, p)
    s = ca.SX.sym("s", memory_start.pack().numel())
    following, outputs = _sample(part, _Memory.unpack(s, part), _Inputs.of(u), settings, h)
    step = ca.Function("step", [s, u, p, ca.SX(0, 1), h], [following.pack(), outputs],
                       ["s", "u", "p", "w", "h"], ["s_next", "y"], {"cse": True})
    first = _outputs(memory_start.estimate, quasi_static=0, nis=0, status=0)
    initial = ca.Function("initial", [p], [memory_start.pack(), first], ["p"], ["s", "y"])
    return Block(name="AttitudeUkf", description=f"Unscented attitude filter of the part {part.name}", step=step,
                 initial=initial, inputs=INPUTS, parameters=parameters, outputs=OUTPUTS, noise=(),
                 sample_period=1.0 / part.sample_rate)


# The variables


def _vector(name: str, unit: str, text: str, start: Iterable[float] = (0.0, 0.0, 0.0)) -> tuple[Variable, ...]:
    return tuple(Variable(f"{name}[{i + 1}]", unit, text, float(v)) for i, v in enumerate(start))


INPUTS = (
    *_vector("gyro", "rad/s", "measured rate against inertial space, body axes"),
    *_vector("accel", "m/s^2", "measured specific force, body axes", (0.0, 0.0, STANDARD_GRAVITY)),
    Variable("temperature", "degC", "temperature of the part", 25.0),
    Variable("heading", "rad", "heading, counter-clockwise from east"),
    Variable("heading_variance", "rad^2", "variance of the heading"),
    Variable("heading_valid", "1", "use the heading of this sample", kind="boolean"),
    Variable("stationary", "1", "the body does not turn against the Earth", kind="boolean"),
)

OUTPUTS = (
    *_vector("q", "1", "attitude, body to world (east-north-up), Hamilton, scalar first", (1.0, 0.0, 0.0, 0.0)),
    Variable("roll", "rad", "roll"), Variable("pitch", "rad", "pitch, nose up is negative"),
    Variable("yaw", "rad", "yaw, counter-clockwise from east"),
    *_vector("gyro_bias", "rad/s", "bias of the compensated rate"),
    *_vector("std", "rad", "standard deviation of the attitude error, body axes"),
    *(Variable(f"std[{i}]", "rad/s", "standard deviation of the gyro bias") for i in (4, 5, 6)),
    Variable("quasi_static", "1", "the accelerometer is used as an inclinometer", kind="boolean"),
    Variable("nis", "1", "normalised innovation squared of this sample's gravity update, 3 degrees of freedom; 0 without one"),
    Variable("status", "1", "; ".join(f"{bit}: {text}" for bit, text in STATUS.items()), kind="integer"),
)

SCALARS = (
    Variable("gravity", "m/s^2", "magnitude of gravity", STANDARD_GRAVITY, minimum=0.0),
    Variable("accel_std", "m/s^2", "standard deviation of the acceleration that passes as quasi-static", 0.1, minimum=0.0),
    Variable("accel_correlation_time", "s", "correlation time of that acceleration; 0 is white from sample to sample", 0.5,
             minimum=0.0),
    Variable("gravity_walk", "m/s^2/sqrt(s)", "random walk of the magnitude in the quasi-static estimator", 0.2, minimum=0.0),
    Variable("gravity_tolerance", "m/s^2", "quasi-static: largest difference of the estimated magnitude and gravity", 0.25,
             minimum=0.0),
    Variable("motion_tolerance", "m/s^2", "quasi-static: largest difference of a sample's magnitude and the estimated one", 1.0,
             minimum=0.0),
    Variable("stationary_std", "rad/s", "standard deviation of the rate of a body that is called stationary", 1e-5, minimum=0.0),
    Variable("lost_rate_std", "rad/s", "standard deviation of the rate along an axis whose gyro is lost", 1.0, minimum=0.0),
)


def _own_parameters() -> tuple[Variable, ...]:
    return (Variable("latitude", "rad", "latitude; a value outside -pi/2 to pi/2 is unknown: no Earth rate", UNKNOWN_LATITUDE),
            *_vector("q0", "1", "attitude before the first sample", (1.0, 0.0, 0.0, 0.0)),
            *_vector("bias0", "rad/s", "gyro bias before the first sample"),
            *_vector("std0", "rad", "standard deviation of the attitude before the first sample", (0.1, 0.1, 0.1)),
            *(Variable(f"std0[{i}]", "rad/s", "standard deviation of the bias before the first sample", 0.01) for i in (4, 5, 6)),
            *SCALARS)


@dataclass(frozen=True)
class _Settings:
    """The parameters as the equations use them."""

    scalar: dict[str, ca.SX]
    earth: ca.SX
    gyro: ca.SX
    accel: ca.SX
    angle_walk: ca.SX
    rate_walk: ca.SX
    accel_walk: ca.SX

    @classmethod
    def of(cls, part: Part, p) -> _Settings:
        own = _own_parameters()
        scalar = {v.name: p[i] for i, v in enumerate(own)}
        gyro, accel = ca.vertsplit(p[len(own):], [0, len(part.gyro.slots), p.numel() - len(own)])
        known = ca.fabs(scalar["latitude"]) <= np.pi / 2
        return cls(scalar, ca.if_else(known, earth_rate(scalar["latitude"]), 0), gyro, accel,
                   ca.fmax(_coefficient(part.gyro, gyro, "angle_random_walk", "N"), LEAST_N),
                   ca.fmax(_coefficient(part.gyro, gyro, "rate_random_walk", "K"), LEAST_K),
                   _coefficient(part.accel, accel, "angle_random_walk", "N"))


def _coefficient(sensor: Sensor, p, effect: str, parameter: str):
    """A triad's coefficient (3,) out of the sensor's parameters, zero where the part lacks the effect."""
    at = [i for i, slot in enumerate(sensor.slots) if (slot.effect, slot.parameter) == (effect, parameter)]
    return ca.vertcat(*[p[i] for i in at]) if at else ca.SX.zeros(3)


# The state and the inputs


@dataclass(frozen=True)
class _Memory:
    """The block's state, taken apart."""

    estimate: Estimate
    quasi: QuasiStatic
    held: _Raw
    lost_for: ca.SX
    gyro_state: ca.SX
    accel_state: ca.SX

    def pack(self) -> ca.SX:
        x = self.estimate
        return ca.densify(ca.vertcat(x.q, x.bias, pack(x.covariance), self.quasi.magnitude, self.quasi.variance,
                                     self.held.column, self.lost_for, self.gyro_state, self.accel_state))

    @classmethod
    def unpack(cls, s, part: Part) -> _Memory:
        sizes = (4, 3, N * (N + 1) // 2, 1, 1, 7, 3, len(part.gyro.chain.start), len(part.accel.chain.start))
        q, bias, covariance, magnitude, variance, held, lost_for, gyro, accel = ca.vertsplit(s, np.cumsum([0, *sizes]).tolist())
        return cls(Estimate(q, bias, unpack(covariance, N)), QuasiStatic(magnitude, variance), _Raw(held), lost_for, gyro, accel)


@dataclass(frozen=True)
class _Raw:
    """A sample of the sensors as measured: gyro (3) rad/s, accel (3) m/s^2, temperature degC in one column (7,)."""

    column: ca.SX

    @property
    def gyro(self) -> ca.SX:
        return self.column[:3]

    @property
    def accel(self) -> ca.SX:
        return self.column[3:6]

    @property
    def temperature(self) -> ca.SX:
        return self.column[6]


@dataclass(frozen=True)
class _Inputs:
    raw: _Raw
    heading: ca.SX
    heading_variance: ca.SX
    heading_valid: ca.SX
    stationary: ca.SX

    @classmethod
    def of(cls, u) -> _Inputs:
        return cls(_Raw(u[:7]), u[7], u[8], u[9] > 0.5, u[10] > 0.5)


def _start(part: Part, p) -> _Memory:
    """The state before the first sample, from the parameters."""
    at = {v.name: p[i] for i, v in enumerate(_own_parameters())}
    q0 = ca.vertcat(*[at[f"q0[{i}]"] for i in (1, 2, 3, 4)])
    usable = ca.dot(q0, q0) > 1e-12
    q = quaternion.normalized(ca.if_else(usable, q0, ca.SX([1, 0, 0, 0])))
    std = ca.vertcat(*[at[f"std0[{i}]"] for i in range(1, 7)])
    std = ca.vertcat(ca.fmin(ca.fmax(std[:3], LEAST_N), LARGEST_STD), ca.fmax(std[3:], LEAST_K))
    estimate = Estimate(q, ca.vertcat(*[at[f"bias0[{i}]"] for i in (1, 2, 3)]), ca.densify(ca.diag(std * std)))
    quasi = QuasiStatic(at["gravity"], ca.fmax(at["accel_std"], LEAST_ACCEL_STD) ** 2)
    held = _Raw(ca.vertcat(0, 0, 0, 0, 0, at["gravity"], 25))
    return _Memory(estimate, quasi, held, ca.SX.zeros(3), ca.SX(part.gyro.chain.start), ca.SX(part.accel.chain.start))


# One sample


@dataclass(frozen=True)
class _Sample:
    """A sample without the sensors' own errors: compensated ``rate`` and ``force``; which of it can be trusted."""

    rate: ca.SX
    force: ca.SX
    gyro_lost: ca.SX
    force_valid: ca.SX
    status: ca.SX


def _sample(part: Part, memory: _Memory, inputs: _Inputs, settings: _Settings, h) -> tuple[_Memory, ca.SX]:
    finite = ca.fabs(inputs.raw.column) <= ABSURD
    raw = _Raw(ca.if_else(finite, inputs.raw.column, memory.held.column))
    sample, gyro_state, accel_state = _compensate(part, memory, raw, finite, settings, h)
    x = _turn(memory, sample, inputs, settings, h)
    x, quasi, quasi_static, nis = _gravity_update(x, memory.quasi, sample, settings, h)
    x, heading_finite = _heading_update(x, inputs)
    x = _zero_rate_update(x, sample, inputs, settings, h)
    lost_for = ca.if_else(sample.gyro_lost, memory.lost_for + h, 0)
    status = ca.if_else(ca.logic_and(_all(finite), heading_finite), 0, 1) + 2 * sample.status
    following = _Memory(x, quasi, raw, lost_for, gyro_state, accel_state)
    return following, _outputs(x, quasi_static, nis, status)


def _all(flags):
    """Whether all elements of a column are true."""
    out = flags[0]
    for flag in ca.vertsplit(flags)[1:]:
        out = ca.logic_and(out, flag)
    return out


def _compensate(part: Part, memory: _Memory, raw: _Raw, finite, settings: _Settings, h):
    """The sensors' models solved for their inputs; the gyro's may need the specific force, so the accelerometer goes first."""
    around = vector({"rate": raw.gyro, "specific_force": raw.accel, "temperature": raw.temperature})
    accel_state, force, accel_lost = part.accel.compensation(memory.accel_state, raw.accel, around, settings.accel, h)
    around = vector({"rate": raw.gyro, "specific_force": force, "temperature": raw.temperature})
    gyro_state, rate, gyro_lost = part.gyro.compensation(memory.gyro_state, raw.gyro, around, settings.gyro, h)
    healthy = ca.logic_and(finite[:3], gyro_lost < 0.5), ca.logic_and(finite[3:6], accel_lost < 0.5)
    at_limit = ca.fmax(ca.mmax(gyro_lost), ca.mmax(accel_lost)) > 0.5
    return _Sample(rate, force, ca.logic_not(healthy[0]), _all(healthy[1]), at_limit), gyro_state, accel_state


def _turn(memory: _Memory, sample: _Sample, inputs: _Inputs, settings: _Settings, h) -> Estimate:
    """Propagation.  A stationary body keeps its attitude: its gyro then measures the bias, and must not be used twice."""
    moving = ca.if_else(inputs.stationary, 0, 1)
    earth = quaternion.rotate(quaternion.conjugate(memory.estimate.q), settings.earth)

    def turn(rate, error):
        return moving * (rate - quaternion.rotate(quaternion.conjugate(error), earth))

    noise = process_noise(settings.angle_walk, settings.rate_walk, h)
    keep = ca.vertcat(moving, moving, moving, 1, 1, 1)
    extra = ca.if_else(inputs.stationary, (h * settings.scalar["stationary_std"]) ** 2 + LEAST_N ** 2 * h,
                       _lost_variance(memory.lost_for, sample.gyro_lost, settings, h))
    noise = noise * (keep @ keep.T) + ca.diag(ca.vertcat(extra, ca.SX(3, 1)))
    x = propagate(memory.estimate, sample.rate, turn, noise, h)
    return Estimate(x.q, x.bias, bounded(x.covariance))


def _lost_variance(lost_for, lost, settings: _Settings, h):
    """Growth of the variance (3,) rad^2 of the angle about an axis whose rate is unknown.

    Over a loss of duration T the unknown rate is one number of variance s^2: the angle's variance grows as s^2 T^2.
    """
    growth = settings.scalar["lost_rate_std"] ** 2 * ((lost_for + h) ** 2 - lost_for ** 2)
    return ca.if_else(lost, growth, 0)


def _gravity_update(x: Estimate, quasi: QuasiStatic, sample: _Sample, settings: _Settings, h):
    """Specific force (3,) against gravity seen from the body, R_nb^T [0, 0, g], while quasi-static.

    An acceleration that lasts for a correlation time T has the density 2 T sigma^2, so that a sample of white noise
    that stands for it has the variance 2 T sigma^2 / h: the filter does not trust a faster log more.
    """
    at = settings.scalar
    passing = at["accel_std"] ** 2 * ca.fmax(1, 2 * at["accel_correlation_time"] / h)
    noise = passing + settings.accel_walk ** 2 / h + LEAST_ACCEL_STD ** 2
    magnitude = ca.norm_2(sample.force)
    quasi = follow(quasi, magnitude, at["gravity_walk"] ** 2 * h, ca.sum1(noise) / 3, sample.force_valid)
    steady = is_quasi_static(quasi, magnitude, at["gravity"], at["gravity_tolerance"], at["motion_tolerance"])
    valid = ca.logic_and(steady, sample.force_valid)
    seen = quaternion.rotate(quaternion.conjugate(x.q), ca.vertcat(0, 0, at["gravity"]))
    mean, variance, cross = measure(x, lambda error: quaternion.rotate(quaternion.conjugate(error), seen))
    x, nis = correct(x, sample.force - mean, variance + ca.diag(noise), cross, valid)
    return x, quasi, valid, nis


def _heading_update(x: Estimate, inputs: _Inputs) -> tuple[Estimate, ca.SX]:
    """A heading against the direction of the forward axis; also whether what should be used was finite.

    Angles are differences of directions (cross and dot product), so that nothing depends on where yaw wraps.
    """
    finite = _all(ca.vertcat(ca.fabs(inputs.heading) <= ABSURD, inputs.heading_variance >= 0, inputs.heading_variance <= ABSURD))
    wanted = inputs.heading_valid
    heading = ca.if_else(finite, inputs.heading, 0)
    noise = ca.if_else(finite, inputs.heading_variance, 1) + LEAST_HEADING_STD ** 2
    forward = quaternion.rotate(x.q, ca.vertcat(1, 0, 0))
    level = forward[0] ** 2 + forward[1] ** 2 > LEVEL ** 2

    def yaw_from_centre(error):
        other = quaternion.rotate(quaternion.product(x.q, error), ca.vertcat(1, 0, 0))
        return _angle(forward, other)

    mean, variance, cross = measure(x, yaw_from_centre)
    innovation = _angle(forward, ca.vertcat(ca.cos(heading), ca.sin(heading))) - mean
    valid = ca.logic_and(ca.logic_and(wanted, finite), level)
    return correct(x, innovation, variance + noise, cross, valid)[0], ca.logic_or(ca.logic_not(wanted), finite)


def _angle(a, b):
    """Angle in rad from the horizontal direction of ``a`` to that of ``b``, -pi to pi."""
    return ca.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1])


def _zero_rate_update(x: Estimate, sample: _Sample, inputs: _Inputs, settings: _Settings, h) -> Estimate:
    """The gyro of a stationary body shows bias and Earth rate: z = b + R_nb^T w_e + n, linear in the error state.

    To first order R_nb^T w_e of the true attitude is w_b + w_b x p.
    """
    earth = quaternion.rotate(quaternion.conjugate(x.q), settings.earth)
    slope = ca.horzcat(ca.skew(earth), ca.SX.eye(3))
    noise = settings.angle_walk ** 2 / h + settings.scalar["stationary_std"] ** 2
    cross = x.covariance @ slope.T
    valid = ca.logic_and(inputs.stationary, ca.logic_not(ca.mmax(sample.gyro_lost)))
    return correct(x, sample.rate - x.bias - earth, slope @ cross + ca.diag(noise), cross, valid)[0]


def _outputs(x: Estimate, quasi_static, nis, status) -> ca.SX:
    std = [ca.sqrt(ca.fmax(x.covariance[i, i], 0)) for i in range(N)]
    return ca.densify(ca.vertcat(x.q, quaternion.to_euler(x.q), x.bias, *std, quasi_static, nis, status))
