"""Quaternion kinematics, continuous and over one step."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import casadi as ca
import numpy as np
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

from pyimu.attitude.filter import marginal
from pyimu.derivations.cases import rotations, vectors
from pyimu.derivations.independent import cross_matrix, same_sign, scalar_first
from pyimu.derivations.model import EPS, Check, Derivation, Equation, call, library
from pyimu.derivations.sources import HIDALGO
from pyimu.symbolic import quaternion

SMALL_TURN = 0.3
"""rad; the first term that the series of ``marginal.mean_jacobian`` leaves out is then below
rounding, |a|^12/13!."""

ROUNDING = 200 * EPS
"""A hundred operations on numbers of order one, rounded once each, and those of scipy."""


# Continuous kinematics


XI = Equation("Xi", "blocks([-T(q_v)], [q_s*I_3 + skew(q_v)])")


def _check_kinematics(d: Derivation) -> list[Check]:
    derivative = d.function(("q_dot",), ("q_s", "q_v", "omega"))
    package = library(quaternion.derivative, 4, 3)
    rng, turned, same = np.random.default_rng(1), [], []
    for r, rate in zip(rotations(rng), vectors(rng, 1e-3, 10.0)):
        h, q = rng.uniform(0.01, 0.2), scalar_first(r)
        turned.append((expm(_generator(derivative, rate) * h) @ q, _turned(r, rate * h)))
        same.append((call(derivative, q[0], q[1:], rate)[0], call(package, q, rate)[0]))
    return [
        Check.of_pairs(
            "the rotation of scipy by `omega*h`, against the matrix exponential of this linear "
            "system",
            turned,
            ROUNDING,
        ),
        Check.of_pairs("quaternion.derivative, which the package computes with", same, ROUNDING),
    ]


def _generator(derivative: ca.Function, rate: np.ndarray) -> np.ndarray:
    """The matrix (4, 4) of the kinematics, which are linear in q."""
    return np.column_stack([call(derivative, e[0], e[1:], rate)[0] for e in np.eye(4)])


def _turned(before: Rotation, angle: np.ndarray) -> np.ndarray:
    """The quaternion (4,) after a turn by the rotation vector ``angle`` (3,), by scipy."""
    return same_sign(scalar_first(before * Rotation.from_rotvec(angle)), scalar_first(before))


KINEMATICS = Derivation(
    "quaternion_kinematics",
    "Quaternion kinematics, continuous time",
    "The attitude `q`, scalar part `q_s` and vector part `q_v`, of a body that turns at the rate "
    "`omega` in body axes. It is linear in `q`.",
    f"{HIDALGO}, section 4.1, equation of the attitude kinematics and Xi; there the vector part "
    "stands first",
    (XI, Equation("q_dot", "Xi@omega/2")),
    _check_kinematics,
)


# One step


TURN = (
    Equation("w", "norm(omega)"),
    Equation("c", "cos(w*h/2)"),
    Equation(
        "psi",
        "sin(w*h/2)/w*omega",
        "for `w*h` near zero `sin(x)/x` and `cos(x)` are computed by their series",
    ),
)
STEP = Equation("Omega", "blocks([c, -T(psi)], [psi, c*I_3 - skew(psi)])")


class Step(NamedTuple):
    """A random case of one step.

    An attitude ``before``, a ``rate`` (3,) over ``h`` s; an ``angle`` (3,) of up to half a turn
    about each axis, and a ``tiny`` factor.
    """

    before: Rotation
    rate: np.ndarray
    h: float
    angle: np.ndarray
    tiny: float

    @property
    def q(self) -> np.ndarray:
        return scalar_first(self.before)


def _steps() -> Iterator[Step]:
    rng = np.random.default_rng(2)
    for r, rate in zip(rotations(rng), vectors(rng, 1e-2, 30.0)):
        h, angle = rng.uniform(1e-3, 0.1), rng.uniform(-np.pi, np.pi, 3)
        yield Step(r, rate, h, angle, 10.0 ** rng.uniform(-16, -2))


def _check_step(d: Derivation) -> list[Check]:
    printed, steps = d.function(("Omega", "q_next"), ("omega", "h", "q")), list(_steps())
    derivative = KINEMATICS.function(("q_dot",), ("q_s", "q_v", "omega"))
    exact, scipys = [], []
    for step in steps:
        matrix, after = call(printed, step.rate, step.h, step.q)
        exact.append((matrix, expm(_generator(derivative, step.rate) * step.h)))
        scipys.append((after, _turned(step.before, step.rate * step.h)))
    return [
        Check.of_pairs("the matrix exponential of the continuous kinematics", exact, ROUNDING),
        Check.of_pairs("the rotation of scipy by `omega*h`", scipys, ROUNDING),
        _check_library(printed, steps),
        *_check_fast(steps),
        _check_small(steps),
    ]


def _product(q, angle):
    """The product by which the filter of 13 points turns."""
    return quaternion.product(q, quaternion.exponential(angle))


def _check_library(printed: ca.Function, steps: list[Step]) -> Check:
    step_, matrix_ = library(quaternion.step, 4, 3, 1), library(quaternion.step_matrix, 3, 1)
    product, same = library(_product, 4, 3), []
    for step in steps:
        matrix, after = call(printed, step.rate, step.h, step.q)
        same += [
            (matrix, call(matrix_, step.rate, step.h)[0]),
            (after, call(step_, step.q, step.rate, step.h)[0]),
            (after, call(product, step.q, step.rate * step.h)[0]),
        ]
    return Check.of_pairs(
        "quaternion.step and quaternion.step_matrix; the product with quaternion.exponential, "
        "which the filter of 13 points turns by",
        same,
        ROUNDING,
    )


def _check_fast(steps: list[Step]) -> list[Check]:
    """The functions by which the fast filter turns."""
    product = library(_product, 4, 3)
    turn = library(lambda q, angle: quaternion.product(q, marginal.turn(angle)[0]), 4, 3)
    jacobian = library(lambda angle: marginal.mean_jacobian(angle, marginal.turn(angle)[1]), 3)
    fast, mean = [], []
    for step in steps:
        fast.append((call(turn, step.q, step.angle)[0], call(product, step.q, step.angle)[0]))
        small = step.angle * (SMALL_TURN / max(SMALL_TURN, np.linalg.norm(step.angle)))
        mean.append((call(jacobian, small)[0], _mean_turn(small)))
    return [
        Check.of_pairs(
            "marginal.turn, which the filter turns by: the same by series, up to half a turn about "
            "each axis",
            fast,
            ROUNDING,
        ),
        Check.of_pairs(
            "marginal.mean_jacobian, by which a bias turns it: the integral of the turn's matrix, "
            f"for turns of up to {SMALL_TURN:g} rad in a step",
            mean,
            ROUNDING,
        ),
    ]


def _mean_turn(angle: np.ndarray) -> np.ndarray:
    """Integral over s from 0 to 1 of the matrix (3, 3) of the turn by -s ``angle``.

    It comes from one matrix exponential (Van Loan 1978).
    """
    whole = np.zeros((6, 6))
    whole[:3, :3], whole[:3, 3:] = cross_matrix(angle).T, np.eye(3)
    return expm(whole)[:3, 3:]


def _check_small(steps: list[Step]) -> Check:
    matrix = library(quaternion.step_matrix, 3, 1)
    small = [(call(matrix, np.zeros(3), 0.1)[0], np.eye(4))]
    for step in steps:
        rate = step.rate * step.tiny
        after = call(matrix, rate, step.h)[0] @ step.q
        small.append((after, _turned(step.before, rate * step.h)))
    return Check.of_pairs(
        "the same at rates down to 1e-18 rad/s and at zero, where the series stand in",
        small,
        ROUNDING,
    )


CLOSED_STEP = Derivation(
    "quaternion_step",
    "One step at a constant rate, closed form",
    "The kinematics solved for a rate that is constant over the sample period `h`: the product "
    "with the quaternion of the turn `omega*h`.",
    f"{HIDALGO}, section 4.2, Omega of the angular velocity, in its order of the elements",
    (*TURN, STEP, Equation("q_next", "Omega@q")),
    _check_step,
)
