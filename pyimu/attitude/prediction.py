"""From a sample of the inputs to the propagated estimate, and to what the update by gravity
needs.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from pyimu.attitude import late_heading, marginal, unscented
from pyimu.attitude.compensation import Compensation
from pyimu.attitude.memory import ESTIMATE, REPORTED, Memory, n_memory
from pyimu.attitude.quasi_static import (
    average,
    follow,
    is_near,
    is_quasi_static,
    mean_variance,
    where,
)
from pyimu.attitude.sample import Sample, look_closely, raw_of, read
from pyimu.attitude.settings import Settings
from pyimu.attitude.unscented import LARGEST_STD, LARGEST_TILT_STD, Estimate
from pyimu.attitude.variables import INPUTS, LEAST_ACCEL_STD, LEAST_K, LEAST_N
from pyimu.symbolic import quaternion
from pyimu.symbolic.process_noise import process_noise

OPTIONS = {"cse": True}

FLAGS = 9
"""Which updates are needed, 0: none, 1: gravity's, 2: others; whether gravity corrects, whether the
body is quasi-static, whether its attitude may be lost, whether a heading and a zero rate correct;
whether an input was missing; the other bits of the status; and in rad^2 the variance that was added
about the vertical since the start."""


@dataclass(frozen=True)
class Given:
    """The symbols that every part of the step takes: estimate, memory, inputs, parameters, sample
    period.
    """

    estimate: ca.SX
    memory: ca.SX
    u: ca.SX
    p: ca.SX
    h: ca.SX

    @classmethod
    def of(cls, compensation: Compensation, n_inputs: int, n_parameters: int) -> Given:
        sizes = {
            "x": ESTIMATE,
            "m": n_memory(compensation),
            "u": n_inputs,
            "p": n_parameters,
            "h": 1,
        }
        return cls(*[ca.SX.sym(n, size) for n, size in sizes.items()])

    @property
    def all(self) -> list[ca.SX]:
        return [self.estimate, self.memory, self.u, self.p, self.h]


def predict(compensation: Compensation, n_inputs: int, n_parameters: int, form: str) -> ca.Function:
    """``(estimate, memory, u, p, h) -> (x, memory, rate, gravity, flags)``; ``x`` has ``WORKING``
    numbers, ``rate`` (3,) is compensated.
    """
    symbols = Given.of(compensation, n_inputs, n_parameters)
    first = _reading(compensation, symbols)
    reading = ca.SX.sym("reading", first.numel_out(0))
    ordinary = _predicted(
        "ordinary_row", compensation, symbols, reading, _unpacked(reading, symbols), form
    )
    memory, settings = (
        Memory.unpack(symbols.estimate, symbols.memory, compensation),
        Settings.of(compensation, symbols.p),
    )
    closely = look_closely(compensation, memory, symbols.u, settings, symbols.h)
    other = _predicted("other_row", compensation, symbols, reading, closely, form)
    given = [ca.MX.sym(s[0].name().split("_")[0], s.numel()) for s in symbols.all]
    read_, is_ordinary = first(*given)
    rows = ca.Function.if_else("row", ordinary, other)(is_ordinary, *given, read_)
    return ca.Function("predict", given, list(rows), {"always_inline": True})


def _reading(compensation: Compensation, symbols: Given) -> ca.Function:
    """The sample as if it were ordinary, packed, and whether it is."""
    memory, settings = (
        Memory.unpack(symbols.estimate, symbols.memory, compensation),
        Settings.of(compensation, symbols.p),
    )
    sample, ordinary = read(compensation, memory, symbols.u, settings, symbols.h)
    packed = ca.densify(ca.vertcat(sample.rate, sample.force, sample.same_for, sample.sensors))
    return ca.Function("reading", symbols.all, [packed, ordinary], OPTIONS)


def _unpacked(reading, symbols: Given) -> Sample:
    return Sample(
        raw_of(symbols.u), reading[:3], reading[3:6], reading[8:], reading[6:8], ca.SX.zeros(3)
    )


def _predicted(
    name: str, compensation: Compensation, symbols: Given, reading, sample: Sample, form: str
) -> ca.Function:
    u, h = symbols.u, symbols.h
    memory, settings = (
        Memory.unpack(symbols.estimate, symbols.memory, compensation),
        Settings.of(compensation, symbols.p),
    )
    stationary, heading = (u[i] > 0.5 for i in (STATIONARY, HEADING_VALID))
    noise = _added(memory, sample, 1 - stationary, settings, h)
    x, turned = _turn(memory, sample, stationary, settings, noise, form, h)
    grown = memory.grown + _about_the_vertical(x, noise[0])
    quasi, mean, gravity, use, quasi_static = _gravity(memory, sample, turned, settings, h)
    still = (
        stationary
        if sample.gyro_lost is False
        else ca.logic_and(stationary, ca.logic_not(ca.mmax(sample.gyro_lost)))
    )
    lost = sum((x.covariance[i, i] > LARGEST_TILT_STD**2 for i in range(3)), 0) > 0
    place = late_heading.following(
        memory.place[0], memory.place[1], settings.scalar["heading_memory"], h
    )
    after = Memory(
        x,
        quasi,
        mean,
        sample.held,
        sample.lost_for,
        sample.same_for,
        sample.sensors,
        grown,
        ca.vertcat(*place),
    )
    which = use + (lost + heading + still > 0) * (2 - use)
    flags = ca.vertcat(
        which,
        use,
        quasi_static,
        lost,
        heading,
        still,
        sample.missing,
        2 * sample.at_limit + 4 * sample.stuck,
        grown,
    )
    column = ca.vertcat(
        Memory.pack_estimate(x), symbols.estimate[ESTIMATE - 1], ca.SX.zeros(REPORTED)
    )
    return ca.Function(
        name,
        [*symbols.all, reading],
        [column, after.pack_memory(), sample.rate, gravity, ca.densify(flags)],
        OPTIONS,
    )


def _position(name: str) -> int:
    return [v.name for v in INPUTS].index(name)


STATIONARY, HEADING_VALID = _position("stationary"), _position("heading_valid")


# Propagation


def _turn(
    memory: Memory, sample: Sample, stationary, settings: Settings, noise, form: str, h
) -> tuple[Estimate, ca.SX]:
    """Propagation, and the turn (3, 3) in inertial space from old body axes to new.

    A stationary body keeps its attitude: its gyro then measures the bias, and must not be used
    twice.
    """
    moving = 1 - stationary  # casadi would draw a choice into every product
    x = memory.estimate
    earth = quaternion.rotate(quaternion.conjugate(x.q), settings.earth)
    if form == "marginal":
        return marginal.propagate(x, sample.rate, earth, moving, noise, h)

    def turn(rate, error):
        return moving * (rate - quaternion.rotate(quaternion.conjugate(error), earth))

    attitude, cross, bias = (ca.diag(v) for v in noise)
    full = ca.vertcat(ca.horzcat(attitude, cross), ca.horzcat(cross, bias))
    turned = quaternion.to_matrix(quaternion.exponential(moving * (sample.rate - x.bias) * h)).T
    return unscented.propagate(x, sample.rate, turn, full, h), turned


def _added(memory: Memory, sample: Sample, moving, settings: Settings, h):
    """Variance (3,) each that a sample adds to the attitude, to attitude and bias together, and to
    the bias.
    """
    noise = process_noise(settings.gyro.white, settings.gyro.walk, h)
    square = sample.rate**2
    relative = (
        settings.scalar["rate_noise"] ** 2 * ca.sum1(square) + settings.gyro.relative**2 * square
    ) * h
    still, least = (h * settings.scalar["stationary_std"]) ** 2, LEAST_N**2 * h
    turned = ca.diag(noise[:3, :3]) + relative
    if sample.gyro_lost is not False:
        turned = turned + ca.if_else(
            sample.gyro_lost, _lost_variance(memory.lost_for, settings, h), 0
        )
    return (
        least + still + moving * (turned - still),
        moving * ca.diag(noise[:3, 3:]),
        ca.diag(noise[3:, 3:]) + LEAST_K**2 * h,
    )


def _about_the_vertical(x: Estimate, added):
    """Of a variance (3,) that a sample adds to the attitude the part about the vertical, and no
    more than an angle can have.
    """
    q = x.q
    up = ca.vertcat(
        2 * (q[1] * q[3] - q[0] * q[2]),
        2 * (q[2] * q[3] + q[0] * q[1]),
        1 - 2 * (q[1] * q[1] + q[2] * q[2]),
    )
    variance, most = ca.dot(up * up, added), LARGEST_STD**2
    return ca.if_else(variance < most, variance, most)


def _lost_variance(lost_for, settings: Settings, h):
    """Growth of the variance (3,) rad^2 of the angle about an axis whose rate is unknown.

    Over a loss of duration T the unknown rate is one number of variance s^2: the angle's variance
    grows as s^2 T^2.
    """
    return settings.scalar["lost_rate_std"] ** 2 * ((lost_for + h) ** 2 - lost_for**2)


# Gravity


def _gravity(memory: Memory, sample: Sample, turned, settings: Settings, h):
    """The quasi-static estimator and the mean force; the force that stands for gravity with its
    variance, and whether it may.

    An acceleration that lasts for a correlation time T has the density 2 T sigma^2, so that a
    sample of white noise that stands for it has the variance 2 T sigma^2 / h: the filter does not
    trust a faster log more.
    """
    at, valid, gravity, per_sample = (
        settings.scalar,
        sample.force_valid,
        settings.scalar["gravity"],
        1 / h,
    )
    white = (
        settings.accel.white**2 + settings.accel.relative**2 * gravity**2
    ) * per_sample + LEAST_ACCEL_STD**2
    noise = at["accel_std"] ** 2 * (1 + 2 * at["accel_correlation_time"] * per_sample) + white
    magnitude = ca.norm_2(sample.force)
    quasi = follow(memory.quasi, magnitude, at["gravity_walk"] ** 2 * h, ca.sum1(noise) / 3, valid)
    carried = True if sample.gyro_lost is False else ca.logic_not(ca.mmax(sample.gyro_lost))
    mean = average(memory.mean, sample.force, turned, at["mean_time"], h, valid, carried)
    steady = is_quasi_static(
        quasi, magnitude, gravity, at["gravity_tolerance"], at["motion_tolerance"]
    ) * (mean.scatter <= at["steady_tolerance"] ** 2 + 2 * ca.sum1(white))
    tolerance = at["gravity_tolerance"] + at["mean_tolerance"] * ca.sqrt(
        mean.scatter
    )  # a push that lasts has no scatter
    followed = (
        (at["mean_time"] > 0)
        * (2 * mean.span > at["mean_time"])
        * is_near(mean.force, gravity, tolerance)
    )
    in_motion = (
        mean_variance(
            mean.scatter + at["accel_std"] ** 2, at["mean_time"] + h, at["motion_time"], h
        )
        + white
    )
    force = mean.force + steady * (sample.force - mean.force)
    variance = in_motion + steady * (noise - in_motion)
    lasting = at["mean_time"] + steady * (at["accel_correlation_time"] - at["mean_time"])
    use = where(valid, 1 - (1 - steady) * (1 - followed))
    # Of one sample, the acceleration has its own variance, however long it lasts: by that a sample
    # can contradict the attitude.
    judged = variance - (1 - 1 / (1 + 2 * lasting * per_sample)) * (variance - white)
    return quasi, mean, ca.vertcat(force, variance, gravity, h, judged), use, where(valid, steady)
