"""The state of an attitude filter's block: its parts, their sizes, and the start."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np

from pyimu.attitude.filter import late_heading, turning
from pyimu.attitude.filter.compensation import Compensation
from pyimu.attitude.filter.drift import SIZES as DRIFT
from pyimu.attitude.filter.drift import Drift
from pyimu.attitude.filter.field import Field
from pyimu.attitude.filter.quasi_static import GravitySize, MeanForce, QuasiStatic, passing_std
from pyimu.attitude.filter.stillness import SIZES as STILLNESS
from pyimu.attitude.filter.stillness import Stillness
from pyimu.attitude.filter.unscented import AXES, LARGEST_STD, WHOLE, Estimate, N
from pyimu.attitude.filter.variables import (
    LARGEST_BIAS,
    LEAST_ACCEL_STD,
    LEAST_K,
    LEAST_N,
    OWN_PARAMETERS,
)
from pyimu.attitude.filter.velocity import SIZES, Motion, first_push, first_std
from pyimu.model.signals import SIGNALS
from pyimu.symbolic import quaternion
from pyimu.symbolic.linear import pack, unpack
from pyimu.symbolic.missing import faded

ESTIMATE = 83
"""Numbers of the state that the updates change: q (4), bias (3), the upper triangle of their
covariance (21), velocity (3), its covariance with them (18) and its own upper triangle (6), what
the gyro's scale factors make of all errors (27), and the sum in rad of all corrections of yaw by
headings."""

SCALED = slice(55, 82)
"""Of these numbers what the gyro's scale factors make of the errors."""

FADING = slice(0, ESTIMATE - 1)
"""Of these numbers those that may fade on a body that stands, all but that sum."""

REPORTED = 7
"""Numbers by which the updates report: gravity's normalised innovation squared and whether it
exceeded the innovation gate; whether a heading was too old, was no usable number, was held back,
exceeded its innovation gate; whether the magnetic field was disturbed."""

NO_SPEED = 1e9
"""s ago; stands for a speed that never was."""

HOLD = 1.0
"""s; so long after a speed the body still drives."""

WORKING = ESTIMATE + REPORTED
"""Numbers of the working estimate, which the updates take and give."""

MOTION = sum(SIZES)
"""Numbers of a ``Motion``, which the memory ends with."""

BIAS_VARIANCE = tuple(7 + i for i in (15, 18, 20))
"""Where the state has the variances of the bias: after q (4) and bias (3) comes the upper triangle
of the covariance, row by row."""


@dataclass(frozen=True)
class Memory:
    """What is kept from sample to sample, in the order of the state, in which ``motion`` is last.

    ``safe`` and ``later`` (6,) are the bias (3,) rad/s and its variance as ``stillness.kept`` has
    them. ``held`` is the last good gyro (3), accel (3), temperature and further inputs.
    ``lost_for`` (3,) is how many s each gyro axis has been lost, ``same_for`` (8,) how many s gyro
    and accelerometer have not changed, and then each of their axes, while others of its triad did.
    ``sensors`` is the compensation's memory, ``speed_for`` how many s ago there was a speed,
    ``calm`` that of ``stillness.calmer``, ``turning`` (5,) that of ``turning.followed``,
    ``known`` (rad/s)^2 the variance of the bias about the vertical by all but rests that may sway,
    ``drift`` its walk as the rests show it.
    ``by_scale`` (3,) rad^2/s is the noise of the attitude that ``prediction`` makes of the gyro's
    scale factors, ``scales`` 0 or 1 whether these have had a part in any error.
    ``vertical_noise`` is the variance in rad^2 that was added about the vertical since the start.
    ``place`` (2,) is where the newest entry stands in the rings of past yaws and past
    ``vertical_noise``; ``field`` 0 or 1, whether a magnetometer has been seen. The rings and the
    memory of the magnetic field follow.
    """

    estimate: Estimate
    quasi: QuasiStatic
    size: GravitySize
    mean: MeanForce
    motion: Motion
    stillness: Stillness
    drift: Drift
    safe: ca.SX
    later: ca.SX
    held: ca.SX
    lost_for: ca.SX
    same_for: ca.SX
    sensors: ca.SX
    speed_for: ca.SX
    calm: ca.SX
    turning: ca.SX
    known: ca.SX
    by_scale: ca.SX
    scales: ca.SX
    vertical_noise: ca.SX
    place: ca.SX
    field: ca.SX

    @staticmethod
    def pack_estimate(x: Estimate) -> ca.SX:
        """The estimate as a column (82,)."""
        angular, moving = pack(x.covariance[:N, :N]), pack(x.covariance[N:, N:])
        both = ca.vec(x.covariance[:N, N:])
        scaled = ca.vec(x.scaled)
        return ca.densify(ca.vertcat(x.q, x.bias, angular, x.velocity, both, moving, scaled))

    @staticmethod
    def estimate_of(column) -> Estimate:
        """The estimate that a column of the state or a working estimate begins with."""
        both = ca.reshape(column[31:49], N, 3)
        angular, moving = unpack(column[7:28], N), unpack(column[49:55], 3)
        covariance = ca.blockcat([[angular, both], [both.T, moving]])
        scaled = ca.reshape(column[SCALED], WHOLE, AXES)
        return Estimate(column[:4], column[4:7], column[28:31], covariance, scaled)

    @staticmethod
    def attitude_of(column) -> Estimate:
        """The same without the velocity."""
        scaled = ca.reshape(column[SCALED], WHOLE, AXES)
        return Estimate(column[:4], column[4:7], ca.SX(0, 1), unpack(column[7:28], N), scaled)

    def pack_memory(self, without_faded: bool = True) -> tuple[ca.SX, ca.SX]:
        """All but the estimate as two columns, of which the second one is the ``motion``;
        ``without_faded``, what has faded is zero in them.
        """
        kept = faded if without_faded else lambda value: value
        quasi = (self.quasi.magnitude, self.quasi.variance)
        size = (self.size.size, self.size.learnt, self.size.doubted)
        mean = (kept(self.mean.force), kept(self.mean.scatter), self.mean.span)
        sensors = (self.held, self.lost_for, self.same_for, self.sensors)
        still = (*self.stillness.pack(), *self.drift.pack())
        memory = ca.densify(
            ca.vertcat(
                *quasi,
                *size,
                *mean,
                *still,
                self.safe,
                self.later,
                *sensors,
                self.speed_for,
                self.calm,
                self.turning,
                self.known,
                kept(self.by_scale),
                self.scales,
                self.vertical_noise,
                self.place,
                self.field,
            )
        )
        return memory, self.motion.pack(kept)

    @classmethod
    def unpack(cls, estimate, column, compensation: Compensation) -> Memory:
        """The inverse of ``pack_estimate`` and ``pack_memory``."""
        ends = np.cumsum([0, *memory_sizes(compensation)]).tolist()
        parts = ca.vertsplit(column, ends)
        quasi, size = QuasiStatic(*parts[:2]), GravitySize(*parts[2:5])
        mean, motion = MeanForce(*parts[5:8]), Motion.unpack(parts[-1])
        drift = 8 + len(STILLNESS)
        others = drift + len(DRIFT)
        rest = Stillness(*parts[8:drift]), Drift(*parts[drift:others])
        x = cls.estimate_of(estimate)
        return cls(x, quasi, size, mean, motion, *rest, *parts[others:-1])


def memory_sizes(compensation: Compensation) -> tuple[int, ...]:
    """Sizes of what ``Memory.pack_memory`` packs, in its order."""
    held = 7 + sum(SIGNALS[n].size for n in compensation.extra)
    own = held, 3, 8, len(compensation.start), 1, 1, 5, 1, 3, 1, 1, 2, 1
    return 1, 1, 1, 1, 1, 3, 1, 1, *STILLNESS, *DRIFT, 6, 6, *own, MOTION


def start(compensation: Compensation, p) -> tuple[Estimate, ca.SX]:
    """The estimate before the first sample, from the parameters, and the whole state."""
    at = {v.name: p[i] for i, v in enumerate(OWN_PARAMETERS)}
    estimate = first_estimate(at)
    held = [v for name in compensation.extra for v in SIGNALS[name].start]
    memory = Memory(
        estimate,
        QuasiStatic(at["gravity"], ca.fmax(passing_std(at), LEAST_ACCEL_STD) ** 2),
        GravitySize(at["gravity"], ca.SX(0), ca.SX(0)),
        MeanForce(ca.SX.zeros(3), ca.SX(0), ca.SX(0)),
        Motion.start(first_std(at), at["motion_time"], first_push(at)),
        Stillness.start(),
        Drift.start(at["bias_drift"] ** 2),
        safe=ca.SX.zeros(6),
        later=ca.SX.zeros(6),
        held=ca.vertcat(0, 0, 0, 0, 0, at["gravity"], 25, *held),
        lost_for=ca.SX.zeros(3),
        same_for=ca.SX.zeros(8),
        sensors=ca.SX(ca.DM(compensation.start)),
        speed_for=ca.SX(NO_SPEED),
        calm=ca.SX(1),
        turning=turning.start(quaternion.to_matrix(estimate.q)[2, :].T),
        known=ca.SX(0),
        by_scale=ca.SX.zeros(3),
        scales=ca.SX(0),
        vertical_noise=ca.SX(0),
        place=ca.vertcat(late_heading.SLOTS - 1, late_heading.NEVER),
        field=ca.SX(0),
    )
    rings, field = late_heading.empty(), Field.start(at).pack()
    state = (Memory.pack_estimate(estimate), 0, *memory.pack_memory(), rings, field)
    return estimate, ca.vertcat(*state)


def first_estimate(at: dict) -> Estimate:
    """Attitude, bias and standard deviations of the parameters, within what the filter bears.

    ``q0`` without length stands for no rotation.
    """
    q0, bias0, std0 = (
        ca.vertcat(*[at[f"{name}[{i + 1}]"] for i in range(size)])
        for name, size in (("q0", 4), ("bias0", 3), ("std0", 6))
    )
    usable = ca.dot(q0, q0) > 1e-12
    q = quaternion.normalized(ca.if_else(usable, q0, ca.SX([1, 0, 0, 0])))
    std = ca.vertcat(ca.fmin(ca.fmax(std0[:3], LEAST_N), LARGEST_STD), ca.fmax(std0[3:], LEAST_K))
    bias = ca.fmin(ca.fmax(bias0, -LARGEST_BIAS), LARGEST_BIAS)
    moving = first_std(at) ** 2 * ca.SX.ones(3)
    covariance = ca.densify(ca.diag(ca.vertcat(std * std, moving)))
    return Estimate(q, bias, ca.SX.zeros(3), covariance, ca.SX.zeros(WHOLE, AXES))
