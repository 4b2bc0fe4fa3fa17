"""The state of the attitude filter's block, taken apart."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np

from pyimu.attitude import late_heading
from pyimu.attitude.compensation import Compensation
from pyimu.attitude.quasi_static import MeanForce, QuasiStatic
from pyimu.attitude.unscented import LARGEST_STD, Estimate, N
from pyimu.attitude.variables import LARGEST_BIAS, LEAST_ACCEL_STD, LEAST_K, LEAST_N, OWN_PARAMETERS
from pyimu.model.signals import SIGNALS
from pyimu.symbolic import quaternion
from pyimu.symbolic.linear import pack, unpack

ESTIMATE = 29
"""Numbers of the state that the updates change: q (4), bias (3), the covariance's upper triangle
(21), and the yaw in rad by which headings have corrected so far."""

REPORTED = 6
"""Numbers by which the updates report: the normalised innovation squared, whether gravity was
doubted, a heading too old, or no number, or held back, or doubted."""

WORKING = ESTIMATE + REPORTED


@dataclass(frozen=True)
class Memory:
    """What is kept from sample to sample, in the order of the state.

    ``held`` is the last good gyro (3), accel (3), temperature and further inputs; ``lost_for`` (3,)
    s how long each gyro axis has been lost; ``same_for`` (2,) s how long gyro and accelerometer
    have not changed; ``sensors`` the compensation's memory; ``grown`` rad^2 the variance that was
    added about the vertical since the start; ``place`` (2,) where in the rings of past yaws and of
    ``grown`` the newest stands. The rings follow.
    """

    estimate: Estimate
    quasi: QuasiStatic
    mean: MeanForce
    held: ca.SX
    lost_for: ca.SX
    same_for: ca.SX
    sensors: ca.SX
    grown: ca.SX
    place: ca.SX

    @staticmethod
    def pack_estimate(x: Estimate) -> ca.SX:
        return ca.densify(ca.vertcat(x.q, x.bias, pack(x.covariance)))

    @staticmethod
    def estimate_of(column) -> Estimate:
        return Estimate(column[:4], column[4:7], unpack(column[7:28], N))

    def pack_memory(self) -> ca.SX:
        return ca.densify(
            ca.vertcat(
                self.quasi.magnitude,
                self.quasi.variance,
                self.mean.force,
                self.mean.scatter,
                self.mean.span,
                self.held,
                self.lost_for,
                self.same_for,
                self.sensors,
                self.grown,
                self.place,
            )
        )

    @classmethod
    def unpack(cls, estimate, column, compensation: Compensation) -> Memory:
        ends = np.cumsum([0, *_memory_sizes(compensation)]).tolist()
        (
            magnitude,
            variance,
            force,
            scatter,
            span,
            held,
            lost_for,
            same_for,
            sensors,
            grown,
            place,
        ) = ca.vertsplit(column, ends)
        return cls(
            cls.estimate_of(estimate),
            QuasiStatic(magnitude, variance),
            MeanForce(force, scatter, span),
            held,
            lost_for,
            same_for,
            sensors,
            grown,
            place,
        )


def _memory_sizes(compensation: Compensation) -> tuple[int, ...]:
    held = 7 + sum(SIGNALS[n].size for n in compensation.extra)
    return 1, 1, 3, 1, 1, held, 3, 2, len(compensation.start), 1, 2


def n_memory(compensation: Compensation) -> int:
    """Numbers of the state between the estimate and the rings."""
    return sum(_memory_sizes(compensation))


def n_state(compensation: Compensation) -> int:
    return ESTIMATE + n_memory(compensation) + 2 * late_heading.SLOTS


def start(compensation: Compensation, p) -> tuple[Estimate, ca.SX]:
    """The estimate before the first sample, from the parameters, and the whole state."""
    at = {v.name: p[i] for i, v in enumerate(OWN_PARAMETERS)}
    q0 = ca.vertcat(*[at[f"q0[{i}]"] for i in (1, 2, 3, 4)])
    usable = ca.dot(q0, q0) > 1e-12
    q = quaternion.normalized(ca.if_else(usable, q0, ca.SX([1, 0, 0, 0])))
    std = ca.vertcat(*[at[f"std0[{i}]"] for i in range(1, 7)])
    std = ca.vertcat(ca.fmin(ca.fmax(std[:3], LEAST_N), LARGEST_STD), ca.fmax(std[3:], LEAST_K))
    bias = ca.fmin(
        ca.fmax(ca.vertcat(*[at[f"bias0[{i}]"] for i in (1, 2, 3)]), -LARGEST_BIAS), LARGEST_BIAS
    )
    estimate = Estimate(q, bias, ca.densify(ca.diag(std * std)))
    quasi = QuasiStatic(at["gravity"], ca.fmax(at["accel_std"], LEAST_ACCEL_STD) ** 2)
    mean = MeanForce(ca.SX.zeros(3), ca.SX(0), ca.SX(0))
    held = ca.vertcat(
        0, 0, 0, 0, 0, at["gravity"], 25, *[v for n in compensation.extra for v in SIGNALS[n].start]
    )
    place = ca.vertcat(late_heading.SLOTS - 1, late_heading.NEVER)
    memory = Memory(
        estimate,
        quasi,
        mean,
        held,
        ca.SX.zeros(3),
        ca.SX.zeros(2),
        ca.SX(ca.DM(compensation.start)),
        ca.SX(0),
        place,
    )
    rings = ca.vertcat(
        late_heading.NEVER * ca.SX.ones(late_heading.SLOTS), ca.SX.zeros(late_heading.SLOTS)
    )
    return estimate, ca.vertcat(Memory.pack_estimate(estimate), 0, memory.pack_memory(), rings)
