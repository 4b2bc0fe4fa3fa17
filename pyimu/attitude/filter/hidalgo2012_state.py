"""Parameters and state of the attitude filter as it is published (Hidalgo 2012)."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from pyimu.attitude.filter.compensation import Compensation
from pyimu.attitude.filter.drift import Drift
from pyimu.attitude.filter.memory import Memory, first_estimate
from pyimu.attitude.filter.quasi_static import GravitySize, MeanForce, QuasiStatic
from pyimu.attitude.filter.settings import Settings
from pyimu.attitude.filter.stillness import Stillness
from pyimu.attitude.filter.unscented import SPREAD, Estimate, N
from pyimu.attitude.filter.variables import (
    INPUTS,
    LEAST_ACCEL_STD,
    MAG,
    SETTINGS,
    START_VALUES,
    USUAL,
)
from pyimu.attitude.filter.variables import OWN_PARAMETERS as OURS
from pyimu.attitude.filter.velocity import Motion
from pyimu.block.variables import Variable
from pyimu.model.signals import SIGNALS
from pyimu.symbolic.earth import normal_gravity
from pyimu.symbolic.linear import pack, unpack
from pyimu.units import STANDARD_GRAVITY

LOW_PASS = 10.0
"""Hz; Hidalgo 2012, section 6.1."""

TOLERANCE = USUAL["gravity_tolerance"]
"""m/s^2; of the magnitude of gravity."""

ACROSS = (STANDARD_GRAVITY * TOLERANCE / 2) ** 0.5
"""m/s^2; standard deviation of an acceleration across gravity that a gate on the magnitude lets
pass. An acceleration a makes it sqrt(g^2 + a^2), g + a^2/(2 g): up to a^2 = 2 g times the tolerance
it is not seen. Over a disc of that radius the mean square of an axis is a quarter of a^2."""

SHARED = ("gravity_walk", "gravity_tolerance", "lost_rate_std", "stuck_time")
"""Settings that mean what they mean in the package's own filter; ``axis_stuck_time`` as well."""

OWN_PARAMETERS = (
    next(v for v in OURS if v.name == "latitude"),
    *START_VALUES,
    Variable(
        "lambda",
        "1",
        "spread of the sigma points; the centre has the weight lambda/(6 + lambda)",
        SPREAD,
        minimum=0.0,
    ),
    Variable("low_pass", "Hz", "corner of the low-pass filter; 0: none", LOW_PASS, minimum=0.0),
    Variable(
        "gravity",
        "m/s^2",
        "magnitude of gravity; 0: that of the latitude on the Earth (WGS 84), 9.80665 where the "
        "latitude is not known",
        minimum=0.0,
    ),
    Variable(
        "accel_std",
        "m/s^2",
        "standard deviation of a sample of the force as gravity, beside the accelerometer's noise",
        ACROSS,
        minimum=0.0,
    ),
    *(v for v in SETTINGS if v.name in SHARED or v.name.startswith("axis_stuck_time")),
)
"""The filter's own parameters; the coefficients of the part's sensors follow."""

ESTIMATE = 28
"""Numbers of the estimate: q (4), bias (3), the upper triangle of their covariance (21)."""


@dataclass(frozen=True)
class State:
    """What is kept from sample to sample.

    ``estimate`` of attitude and bias, covariance (6, 6), after the last update; ``quasi``, the
    estimated magnitude of gravity. ``rate`` (3,) rad/s of the last sample behind the low-pass
    filter, whose past inputs and outputs are ``passed`` (24,), first the gyro's. ``started`` is 1
    from the first sample on, ``seen`` the s for which there has been a force. The others are those
    of ``pyimu.attitude.filter.memory.Memory``.
    """

    estimate: Estimate
    quasi: QuasiStatic
    rate: ca.SX
    passed: ca.SX
    started: ca.SX
    seen: ca.SX
    held: ca.SX
    lost_for: ca.SX
    same_for: ca.SX
    sensors: ca.SX

    def pack(self) -> ca.SX:
        x, quasi = self.estimate, (self.quasi.magnitude, self.quasi.variance)
        others = (self.rate, self.passed, self.started, self.seen, self.held)
        more = (self.lost_for, self.same_for, self.sensors)
        return ca.densify(ca.vertcat(packed(x), *quasi, *others, *more))

    @property
    def memory(self) -> Memory:
        """The same for the reading of a sample."""
        zero = ca.SX.zeros(3)
        return Memory(
            self.estimate,
            self.quasi,
            GravitySize(self.quasi.magnitude, ca.SX(0), ca.SX(0)),
            MeanForce(zero, ca.SX(0), self.seen),
            Motion.start(ca.SX(0), ca.SX(0)),
            Stillness.start(),
            Drift.start(),
            safe=ca.SX.zeros(6),
            later=ca.SX.zeros(6),
            held=self.held,
            lost_for=self.lost_for,
            same_for=self.same_for,
            sensors=self.sensors,
            speed_for=ca.SX(0),
            calm=ca.SX(0),
            turning=ca.SX.zeros(5),
            known=ca.SX(0),
            by_scale=ca.SX.zeros(3),
            scales=ca.SX(0),
            vertical_noise=ca.SX(0),
            place=ca.SX.zeros(2),
            field=ca.SX(0),
        )


def packed(x: Estimate) -> ca.SX:
    """The estimate as a column (28,)."""
    return ca.densify(ca.vertcat(x.q, x.bias, pack(x.covariance)))


def estimate_of(column) -> Estimate:
    """The inverse of ``packed``."""
    return Estimate(column[:4], column[4:7], ca.SX(0, 1), unpack(column[7:ESTIMATE], N))


@dataclass(frozen=True)
class Layout:
    """The variables and the state of the block, for the sensors of a part."""

    compensation: Compensation

    @property
    def inputs(self) -> tuple[Variable, ...]:
        return (*INPUTS[:7], *self._mag, *self.compensation.extra_inputs)

    @property
    def _mag(self) -> tuple[Variable, ...]:
        return INPUTS[MAG] if "mag" in self.compensation.extra else ()

    def row(self, u) -> ca.SX:
        """The inputs ``u`` among those of the package's own filter, the others zero."""
        mag = u[7 : 7 + len(self._mag)] if self._mag else ca.SX.zeros(3)
        others = ca.SX.zeros(len(INPUTS) - 10)
        return ca.vertcat(u[:7], others, mag, u[7 + len(self._mag) :])

    @property
    def parameters(self) -> tuple[Variable, ...]:
        part = self.compensation.part
        return (*OWN_PARAMETERS, *part.gyro.variables, *part.accel.variables)

    @property
    def sizes(self) -> list[int]:
        """Sizes of what the state packs, in its order."""
        held = 7 + sum(SIGNALS[n].size for n in self.compensation.extra)
        return [ESTIMATE, 1, 1, 3, 24, 1, 1, held, 3, 8, len(self.compensation.start)]

    def state(self, column) -> State:
        """The inverse of ``State.pack``."""
        ends = [sum(self.sizes[:i]) for i in range(len(self.sizes) + 1)]
        x, magnitude, variance, *others = ca.vertsplit(column, ends)
        return State(estimate_of(x), QuasiStatic(magnitude, variance), *others)

    def start(self, p) -> State:
        """The state before the first sample."""
        settings = Settings.of(self.compensation, p, OWN_PARAMETERS)
        at, gravity = settings.scalar, gravity_of(settings)
        still = first_estimate(at | {"accel_std": 0, "motion_time": 0, "push_std": 0})
        held = [v for name in self.compensation.extra for v in SIGNALS[name].start]
        return State(
            Estimate(still.q, still.bias, ca.SX(0, 1), still.covariance[:N, :N]),
            QuasiStatic(gravity, ca.fmax(at["accel_std"], LEAST_ACCEL_STD) ** 2),
            rate=ca.SX.zeros(3),
            passed=ca.SX.zeros(24),
            started=ca.SX(0),
            seen=ca.SX(0),
            held=ca.vertcat(0, 0, 0, 0, 0, gravity, 25, *held),
            lost_for=ca.SX.zeros(3),
            same_for=ca.SX.zeros(8),
            sensors=ca.SX(ca.DM(self.compensation.start)),
        )


def gravity_of(settings: Settings):
    """The magnitude of gravity in m/s^2 that the quasi-static estimator is told.

    The theoretical value based on the rover's location (Hidalgo 2012, section 5).
    """
    given = settings.scalar["gravity"]
    there = ca.if_else(settings.known, normal_gravity(settings.latitude), STANDARD_GRAVITY)
    return ca.if_else(given > 0, given, there)
