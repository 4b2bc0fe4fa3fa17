"""The heading filter of a part as a block: a Kalman filter on heading, bias and scale factor.

Of the compensated rate m = (1 + s) r + b + w, with the body's rate r, the heading grows by r, the
bias b walks and the scale factor s stays (extended Kalman filter; Groves 2013, section 3.2). In a
rest the rate is none, and the sample measures the bias: m = b + w (zero-angular-rate update, ZARU;
Groves 2013, section 15.3.2); its noise then turns nothing. What is rest, and how a sway is told
from it, is that of the attitude filter (``pyimu.attitude.filter.stillness``), of which this is the
form for one axis: of a body that stands level, whose own rate against the Earth is one with its
bias.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import casadi as ca
import numpy as np

from pyimu.attitude.filter.compensation import Compensation, TriadNoise, noise_of
from pyimu.attitude.filter.sample import unknown_turn
from pyimu.attitude.filter.stillness import (
    GATE,
    SIZES,
    Stillness,
    followed,
    is_rest,
    is_still,
    share_of_noise,
    soon_drifts,
    sway,
)
from pyimu.attitude.filter.stillness import kept as kept_before
from pyimu.attitude.filter.timing import clock_error
from pyimu.attitude.filter.variables import (
    ABSURD,
    LEAST_ACCEL_STD,
    LEAST_HEADING_STD,
    LEAST_K,
    LEAST_N,
)
from pyimu.attitude.heading.about_vertical import about_the_vertical, left, without_idle
from pyimu.attitude.heading.variables import INPUTS, OUTPUTS, OWN_PARAMETERS
from pyimu.block.block import Block
from pyimu.block.plain import plain_function
from pyimu.model.effect import Effect
from pyimu.model.part import Part
from pyimu.symbolic.process_noise import process_noise

STATES = 3
"""Heading [rad], bias [rad/s], scale factor [1]."""

UPPER = [(i, j) for j in range(STATES) for i in range(j + 1)]

MOVED = 10.8
"""Squared difference of a rest's mean rate and the bias over its variance, which one rest in a
thousand exceeds by chance."""

AXES = 3
"""Of the stillness, whose noise is that of so many axes, one is seen here."""


def heading_estimator(part: Part) -> Block:
    """The filter ``HeadingEstimator`` of a part, a block.

    The part's own errors about the vertical are undone first, as far as they depend on what the
    unit is told; bias and scale factor of the filter are what remains. The state begins with
    heading, bias, scale factor and the upper triangle of their covariance.
    """
    return _of(part, part.gyro.effects, part.accel.effects)


@lru_cache(maxsize=16)
def _of(part: Part, *effects: tuple[Effect, ...]) -> Block:
    known = about_the_vertical(part)
    compensation = Compensation(known, now=False)
    u, p = ca.SX.sym("u", len(INPUTS)), ca.SX.sym("p", _parameters(known)[1])
    s, h = ca.SX.sym("s", sum(_sizes(compensation))), ca.SX.sym("h")
    after, y = _step(compensation, s, u, p, h)
    step = plain_function(
        "step",
        [s, u, p, ca.SX(0, 1), h],
        [*map(ca.densify, (after, y))],
        ["s", "u", "p", "w", "h"],
        ["s_next", "y"],
    )
    start = _start(compensation, p)
    shown = _shown(Estimate.unpack(start), 0, 0, 0)
    shown = [*map(ca.densify, (start, shown))]
    initial = plain_function("initial", [u, p], shown, ["u", "p"], ["s", "y"])
    step, initial, parameters = without_idle(step, initial, _parameters(known)[0])
    return Block(
        name="HeadingEstimator",
        description=f"Heading filter about the vertical of the part {part.name}{left(part)}",
        step=step,
        initial=initial,
        inputs=INPUTS,
        parameters=parameters,
        outputs=OUTPUTS,
        noise=(),
        sample_period=1.0 / part.sample_rate,
    )


def _parameters(part: Part) -> tuple[tuple, int]:
    """The block's parameters, and how many they are."""
    every = OWN_PARAMETERS + part.gyro.variables + part.accel.variables
    return every, len(every)


# The state


@dataclass(frozen=True)
class Estimate:
    """Heading rad, bias rad/s and scale factor (3,), and their covariance (3, 3)."""

    x: ca.SX
    covariance: ca.SX

    @classmethod
    def unpack(cls, s) -> Estimate:
        covariance = type(s).zeros(STATES, STATES)
        for k, (i, j) in enumerate(UPPER):
            covariance[i, j] = covariance[j, i] = s[STATES + k]
        return cls(s[:STATES], covariance)

    def pack(self):
        return ca.vertcat(self.x, *[self.covariance[i, j] for i, j in UPPER])

    def corrected(self, direction, innovation, noise):
        """The estimate after a scalar measurement of ``direction`` (3,), and whether it
        contradicted.

        One beyond the gate is weighed as if its noise made it lie on the gate.
        """
        leak = self.covariance @ direction
        variance = ca.dot(direction, leak) + noise
        weighed = ca.fmax(variance, innovation**2 / GATE)
        gain = leak / weighed
        covariance = self.covariance - gain @ leak.T
        return Estimate(self.x + gain * innovation, covariance), weighed > variance


ESTIMATE = STATES + len(UPPER)

HELD = 5
"""Numbers of which the last good value is kept: rate, force and temperature."""


def _sizes(compensation: Compensation) -> list[int]:
    """Numbers of the state: estimate, stillness, the estimate as it was ``FAST`` to twice that ago
    and up to that, what is held, how long the gyro is lost, the sensors' memory.
    """
    return [ESTIMATE, *SIZES, ESTIMATE, ESTIMATE, HELD, 1, sum(compensation.sizes)]


def _start(compensation: Compensation, p):
    at = {v.name: p[i] for i, v in enumerate(OWN_PARAMETERS)}
    std = [at[f"std0[{i}]"] for i in (1, 2, 3)]
    covariance = ca.diag(ca.vertcat(*std) ** 2)
    covariance[1, 2] = covariance[2, 1] = at["correlation0"] * std[1] * std[2]
    x = ca.vertcat(at["heading0"], at["bias0"], at["scale_factor0"])
    held = ca.DM([v.start for v in INPUTS[:HELD]])
    estimate = Estimate(x, covariance).pack()
    return ca.vertcat(
        estimate,
        *Stillness.start().pack(),
        estimate,
        estimate,
        held,
        0,
        ca.DM(compensation.start),
    )


# The step


@dataclass(frozen=True)
class _Sample:
    """A row without the gyro's errors: ``rate`` rad/s, ``force`` (3,) m/s^2, and what of it cannot
    be used (``lost``, ``no_force``); ``held``, ``lost_for`` s and ``sensors`` are kept. A rate that
    is lost is the last good one, or the limit.
    """

    rate: ca.SX
    force: ca.SX
    lost: ca.SX
    no_force: ca.SX
    at_limit: ca.SX
    missing: ca.SX
    held: ca.SX
    lost_for: ca.SX
    sensors: ca.SX


@dataclass(frozen=True)
class _At:
    """What there is when a sample comes: the filter's own parameters and the inputs by name, the
    noise of gyro and accelerometer, and the period ``h`` s by the gyro's clock.
    """

    own: dict[str, ca.SX]
    inputs: dict[str, ca.SX]
    gyro: TriadNoise
    accel: TriadNoise
    h: ca.SX

    @property
    def declared(self):
        """Whether the body is said to be at rest, 0 or 1."""
        return self.inputs["stationary"] > 0.5

    @property
    def white(self):
        """(rad/s)^2 s; density of the gyro's white noise about the vertical."""
        return self.gyro.white[2] ** 2 + LEAST_N**2


def _step(compensation: Compensation, s, u, p, h):
    """The state and the outputs after the sample."""
    part, own = compensation.part, len(OWN_PARAMETERS)
    gyro_p, accel_p = ca.vertsplit(p[own:], [0, len(part.gyro.slots), p.numel() - own])
    at = _At(
        {v.name: p[i] for i, v in enumerate(OWN_PARAMETERS)},
        {v.name: u[i] for i, v in enumerate(INPUTS)},
        noise_of(part.gyro, gyro_p, part.sample_period),
        noise_of(part.accel, accel_p, part.sample_period),
        h * (1 + clock_error(part.gyro, gyro_p)),
    )
    ends = np.cumsum(_sizes(compensation)).tolist()
    estimate, *still, safe, later, held, lost_for, sensors = ca.vertsplit(s, [0, *ends])
    before = Stillness(*still)
    sample = _read(compensation, (held, lost_for, sensors), u, (gyro_p, accel_p), at.h)
    x, after, resting = _rest(*map(Estimate.unpack, (estimate, safe)), before, sample, at)
    safe, later = kept_before(before, after, safe, later, x.pack())
    x, faults = _updated(x, after, resting, sample, at)
    faults = faults + sample.missing + 2 * sample.at_limit + 128 * resting * sample.no_force
    kept = (safe, later, sample.held, sample.lost_for, sample.sensors)
    state = ca.vertcat(x.pack(), *after.pack(), *kept)
    return state, _shown(x, sample.rate, ca.fmax(resting, at.declared), faults)


def _read(compensation: Compensation, kept, u, p, h) -> _Sample:
    held, lost_for, sensors = kept
    good = ca.fabs(u[:HELD]) <= ABSURD
    turn = ca.fabs(u[0]) <= ca.pi / h
    now = ca.if_else(ca.vertcat(good[0] * turn, good[1:]), u[:HELD], held)
    measured = {
        "rate": ca.vertcat(0, 0, now[0]),
        "specific_force": now[1:4],
        "temperature": now[4],
        "latitude_known": 0,
    }
    sensors, rate, force, gyro_lost, accel_lost = compensation.apply(sensors, measured, *p, h)
    known = ca.fabs(rate[2]) <= ABSURD
    limit = (gyro_lost[2] > 0.5) + good[0] * (1 - turn) > 0
    lost = 1 - good[0] * (1 - limit) * known
    # A force of nothing is none: a unit in a simulation, or a log, without an accelerometer.
    no_force = 1 - good[1] * good[2] * good[3] * (ca.sumsqr(now[1:4]) > 0)
    return _Sample(
        ca.if_else(known, rate[2], 0),
        ca.if_else(no_force, ca.vertcat(0, 0, 0), force),
        lost,
        no_force,
        limit,
        1 - good[0] * good[4],
        now,
        ca.if_else(lost, lost_for + h, 0),
        sensors,
    )


def _rest(x: Estimate, safe: Estimate, before: Stillness, sample: _Sample, at: _At):
    """The estimate, the stillness after the sample, and whether the body rests by it.

    Where a rest has ended the estimate is the ``safe`` one, as it was before the last samples of
    that rest, covariance and all: they may be of the motion. At rest the heading was the same.
    """
    own, time, z = at.own, at.own["rest_time"], ca.vertcat(0, 0, 1)
    # The squared noise of three axes is what the stillness expects, whichever of them turns.
    noise = (ca.vertcat(1, 1, 1) * at.white / at.h, at.accel.white**2 / at.h + LEAST_ACCEL_STD**2)
    tolerance, rate = (own["rest_rate_tolerance"], own["rest_force_tolerance"]), z * sample.rate
    alike = is_still(before, rate, sample.force, tolerance, noise, at.h) * (1 - sample.lost)
    still = followed(before, rate, sample.force, alike, at.h)
    sought = (time > 0) * (1 - at.declared)
    resting = alike * (before.span >= time) * before.rests * sought
    x = _where(sought * (before.rests > alike), safe, x)
    begins = (before.span < time) * (still.span >= time)
    covariance = x.covariance[1, 1] * (z @ z.T)
    off = still.slow - z * x.x[1]
    drifts = soon_drifts(at.white)
    found = is_rest(off, covariance, z, at.white, still.span, drifts=drifts)
    rests = ca.if_else(begins, found, before.rests * (still.span > 0))
    # A rest shows a bias that has drifted as the part does not say.
    variance = x.covariance[1, 1] + at.white / still.span
    less_known = ca.if_else(off[2] ** 2 > MOVED * variance, off[2] ** 2 - variance, 0)
    anew = Estimate(x.x, ca.SX(x.covariance))
    anew.covariance[1, 1] += less_known
    return _where(begins * found, anew, x), replace(still, rests=rests), resting


def _of_one_axis(still: Stillness) -> Stillness:
    """The stillness whose density is that of the one axis that was seen."""
    return replace(still, density=AXES * still.density)


def _updated(x: Estimate, still: Stillness, resting, sample: _Sample, at: _At):
    """The estimate turned on by the sample and corrected, and bits of the status."""
    still = _of_one_axis(still)
    moving = (1 - at.declared) * (1 - resting * share_of_noise(still, at.white))
    x = _turned(x, sample, moving, at)
    noise = (at.white + resting * sway(still, at.white)) / at.h
    noise = noise + at.declared * at.own["stationary_std"] ** 2
    usable = ca.fmax(at.declared, resting) * (1 - sample.lost)
    seen, off = x.corrected(ca.vertcat(0, 1, 0), sample.rate - x.x[1], noise)
    x, faults = _where(usable, seen, x), 8 * usable * at.declared * off
    asked, heading = at.inputs["heading_valid"] > 0.5, at.inputs["heading"]
    variance = at.inputs["heading_variance"]
    usable = asked * (ca.fabs(heading) <= ABSURD) * (ca.fabs(variance) <= ABSURD) * (variance >= 0)
    gap = ca.if_else(usable, _wrapped(heading - x.x[0]), 0)
    variance = ca.fmax(ca.if_else(usable, variance, 0), LEAST_HEADING_STD**2)
    seen, off = x.corrected(ca.vertcat(1, 0, 0), gap, variance)
    faults = faults + 64 * usable * off + asked * (1 - usable) * (1 - sample.missing)
    return _where(usable, seen, x), faults


def _turned(x: Estimate, sample: _Sample, moving, at: _At) -> Estimate:
    """The estimate after the turn of a sample, of which the share ``moving`` is one."""
    heading, bias, scale = ca.vertsplit(x.x)
    h, gain, there = at.h, 1 / (1 + scale), 1 - sample.lost
    rate, seen = gain * (sample.rate - bias), moving * there
    transition = ca.SX.eye(STATES)
    transition[0, 1], transition[0, 2] = -seen * gain * h, -seen * gain * rate * h
    both = process_noise(ca.vertcat(1, 1, 1) * ca.sqrt(at.white), at.gyro.walk, h)
    relative = (at.own["rate_noise"] ** 2 + at.gyro.relative[2] ** 2) * rate**2 * h
    before = sample.lost_for - sample.lost * h
    unknown = at.own["lost_rate_std"] ** 2 * unknown_turn(before, sample.lost_for)
    noise = ca.SX.zeros(STATES, STATES)
    noise[0, 0] = seen * (gain**2 * both[2, 2] + relative) + sample.lost * moving * unknown
    noise[0, 1] = noise[1, 0] = seen * gain * both[2, 5]
    noise[1, 1] = both[5, 5] + LEAST_K**2 * h
    noise[2, 2] = at.own["scale_factor_walk"] ** 2 * h
    covariance = transition @ x.covariance @ transition.T + noise
    return Estimate(ca.vertcat(heading + moving * rate * h, bias, scale), covariance)


def _where(flag, one: Estimate, other: Estimate) -> Estimate:
    return Estimate(
        ca.if_else(flag, one.x, other.x), ca.if_else(flag, one.covariance, other.covariance)
    )


def _wrapped(angle):
    return angle - 2 * ca.pi * ca.floor((angle + ca.pi) / (2 * ca.pi))


def _shown(x: Estimate, measured, at_rest, status):
    heading, bias, scale = ca.vertsplit(x.x)
    std = ca.sqrt(ca.fmax(ca.diag(x.covariance), 0))
    rate = (measured - bias) / (1 + scale)
    shown = (_wrapped(heading), std[0], bias, std[1], scale, std[2], rate, heading, at_rest, status)
    return ca.vertcat(*shown)
