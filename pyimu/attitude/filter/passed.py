"""What the filter leaves of a sample for a smoother: estimates, and how its errors changed."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from pyimu.attitude.filter.layout import Flags
from pyimu.attitude.filter.memory import ESTIMATE, Memory
from pyimu.attitude.filter.unscented import Estimate, N
from pyimu.attitude.filter.variables import OUTPUTS
from pyimu.attitude.filter.velocity import Push
from pyimu.block.variables import array
from pyimu.symbolic import quaternion

PACKED = ESTIMATE - 1
"""Numbers of a packed estimate."""

TRANSITION = 39
"""Numbers of a ``Transition``."""


@dataclass(frozen=True)
class Transition:
    """How a sample's prediction changes the error state: x' = T (F x + w), w of covariance Q.

    ``own`` (3, 3) and ``leak`` (3, 3) are R^T and G of ``marginal.turned``. With F the attitude
    error becomes R^T p + G b, that of the velocity R^T v - [c] R^T p with ``carried`` c (3,), and
    that of the bias stays. T adds [t] p to the velocity, ``tilting`` t (3,), what the tilt after
    the period makes of it, noise included (``velocity.pushed``). ``attitude``, ``both`` and
    ``bias`` (3,) are the noise of ``prediction.added_noise``, ``velocity`` (3,) that of the
    velocity. Before it the estimated bias was changed by ``set_back`` (3,) rad/s, as where a rest
    ends (``prediction.Rest``): the truth was not.
    """

    own: ca.SX
    leak: ca.SX
    carried: ca.SX
    tilting: ca.SX
    attitude: ca.SX
    both: ca.SX
    bias: ca.SX
    velocity: ca.SX
    set_back: ca.SX

    @classmethod
    def of(
        cls, own, leak, before: Estimate, after: Estimate, push: Push, noise, set_back
    ) -> Transition:
        """That of a prediction which made ``after`` of ``before``, by the arguments of
        ``velocity.pushed``.
        """
        carried = push.carried(own @ before.velocity)
        tilting = push.tilting(quaternion.to_matrix(after.q)[2, :].T, carried)
        return cls(own, leak, ca.densify(carried), tilting, *noise, push.variance, set_back)

    def pack(self) -> ca.SX:
        return ca.densify(ca.vertcat(*[ca.vec(v) for v in vars(self).values()]))

    @classmethod
    def unpack(cls, column) -> Transition:
        own, leak, *others = ca.vertsplit(column, [0, 9, *range(18, TRANSITION + 1, 3)])
        return cls(ca.reshape(own, 3, 3), ca.reshape(leak, 3, 3), *others)

    @property
    def noise(self) -> ca.SX:
        """Q (9, 9)."""
        both = ca.diag(self.both)
        turning = ca.blockcat([[ca.diag(self.attitude), both], [both, ca.diag(self.bias)]])
        return ca.diagcat(turning, ca.diag(self.velocity))

    def untilted(self, error) -> ca.SX:
        """T^-1 ``error`` (9, m)."""
        return ca.vertcat(error[:N, :], error[N:, :] - ca.skew(self.tilting) @ error[:3, :])

    def undone(self, error) -> ca.SX:
        """F^-1 ``error`` (9, m)."""
        p, b, v = ca.vertsplit(error, [0, 3, N, N + 3])
        turned = p - self.leak @ b
        carried = ca.skew(self.carried) @ turned
        return ca.vertcat(self.own.T @ turned, b, self.own.T @ (v + carried))


@dataclass(frozen=True)
class Passed:
    """What the filter leaves of a sample.

    Its ``outputs``; the estimate ``after`` the sample, and as it was ``predicted``; the
    ``transition`` from the estimate after the sample before; ``constant``, that of ``Flags``;
    whether the velocity ``begins`` anew with this sample, and whether the attitude was ``bounded``
    because it may be lost.
    """

    outputs: ca.SX
    after: Estimate
    predicted: Estimate
    transition: Transition
    constant: ca.SX
    begins: ca.SX
    bounded: ca.SX

    @classmethod
    def unpack(cls, row) -> Passed:
        y, after, predicted, transition, *flags = ca.vertsplit(row, ENDS)
        estimates = (Memory.estimate_of(x) for x in (after, predicted))
        return cls(y, *estimates, Transition.unpack(transition), *flags)


SIZES = (len(OUTPUTS), PACKED, PACKED, TRANSITION, 1, 1, 1)
ENDS = [sum(SIZES[:i]) for i in range(len(SIZES) + 1)]

PASSED = array("passed", "1", "a number of pyimu.attitude.filter.passed.Passed", [0.0] * ENDS[-1])
"""The outputs of a filter that is recorded."""

AFTER = slice(ENDS[1], ENDS[2])
"""Where a row has the estimate after its sample."""


def passed(y, estimate, predicted, transition, flags: Flags):
    """The columns of ``Passed`` from those of a step.

    The velocity begins anew where a force is taken for gravity (``gravity_update.corrected``), and
    with the first speed and after the last; an attitude that may be lost is bounded unless a force
    is about to correct it (``updates.bounded_where_lost``).
    """
    bounded = flags.lost * (1 - flags.gravity) * (1 - flags.velocity)
    begins = 1 - (1 - flags.gravity) * (1 - flags.anew)
    rows = (y, estimate[:PACKED], predicted[:PACKED], transition, flags.constant, begins, bounded)
    return ca.vertcat(*rows)
