"""How an attitude error and a bias error move."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import casadi as ca
import numpy as np
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from pyimu.derivations.cases import rounds, vectors
from pyimu.derivations.independent import cross_matrix, scalar_first
from pyimu.derivations.kinematics.quaternions import ROUNDING
from pyimu.derivations.kinematics.rodrigues import FROM_MRP, SHARE
from pyimu.derivations.model import Check, Derivation, Equation, call
from pyimu.derivations.sources import CRASSIDIS
from pyimu.symbolic import mrp
from pyimu.symbolic.process_noise import error_system

INTEGRATIONS = 20
TOLERANCE = 1e-12
"""Of the numerical integration, relative, for each of its steps; a few tens of steps add up."""

DURATION = 0.5
"""s; of each integration."""

RATE_ERROR = Equation(
    "delta_omega",
    "-b - D_N@eta_N",
    "the bias is subtracted from the measured rate, and so is its error",
)
ERROR = Equation(
    "p_dot",
    "-skew(omega_hat)@p + (f*q_s/(a + q_s)*I_3 + skew(p) + p@T(p)/f)@delta_omega/2",
    "exact for an error of any size",
)
LINEAR = (
    Equation(
        "F",
        "blocks([-skew(omega_hat), -s*I_3], [O_3, O_3])",
        "derivative of `x_dot` by `x` at zero",
    ),
    Equation("G", "blocks([-s*D_N, O_3], [O_3, D_K])", "derivative of `x_dot` by `eta` at zero"),
    Equation(
        "x_dot",
        "F@x + G@eta",
        "to first order, with a random walk for the bias, `b_dot = D_K@eta_K`",
    ),
)


def _check_error(d: Derivation) -> list[Check]:
    derivative = d.function(("p_dot",), ("p", "omega_hat", "delta_omega", "a", "f"))
    exact, turning = [], []
    for case in _cases():
        p = case.integrated(derivative)
        exact.append((p, case.turned_apart()))
        turning.append((p, case.turned_apart_in_turning_frame()))
    bound = 100 * TOLERANCE
    return [
        Check.of_pairs(
            "scipy: truth and estimate turned apart, the equation integrated (tolerance 1e-12 a "
            "step)",
            exact,
            bound,
        ),
        Check.of_pairs(
            "both quaternions integrated in a frame that turns: its rate drops out, so `F` has the "
            "rate against inertial space",
            turning,
            bound,
        ),
        _check_jacobians(d),
        _check_library(d),
    ]


# The exact equation


class Case(NamedTuple):
    """A random case of the attitude error.

    The error ``start``, the estimated ``rate`` and its ``error``, the rate of a ``frame``, (3,)
    each; ``a`` and ``f`` of the Rodrigues parameters.
    """

    start: np.ndarray
    rate: np.ndarray
    error: np.ndarray
    frame: np.ndarray
    a: float
    f: float

    def integrated(self, derivative: ca.Function) -> np.ndarray:
        """The parameters (3,) at the end, by the differential equation that is checked."""

        def p_dot(t, p):
            return call(derivative, p, self.rate, self.error, self.a, self.f)[0]

        return _integrated(p_dot, self._rodrigues(Rotation.from_rotvec(self.start)))

    def turned_apart(self) -> np.ndarray:
        """The same by the turns of truth and estimate."""
        estimate, turn = (
            Rotation.from_rotvec(rate * DURATION) for rate in (self.rate, self.rate + self.error)
        )
        return self._rodrigues(estimate.inv() * (Rotation.from_rotvec(self.start) * turn))

    def turned_apart_in_turning_frame(self) -> np.ndarray:
        """The same by truth and estimate against a frame that itself turns."""
        estimate = _in_turning_frame(Rotation.identity(), self.rate, self.frame)
        start = Rotation.from_rotvec(self.start)
        truth = _in_turning_frame(start, self.rate + self.error, self.frame)
        return self._rodrigues(estimate.inv() * truth)

    def _rodrigues(self, turn: Rotation) -> np.ndarray:
        q = scalar_first(turn)
        return self.f * q[1:] * np.sign(q[0]) / (self.a + abs(q[0]))


def _cases() -> Iterator[Case]:
    rng = np.random.default_rng(5)
    bounds = ((0.01, 2), (0.1, 3), (0.01, 1), (0.1, 1))
    drawn = [vectors(rng, low, high, INTEGRATIONS) for low, high in bounds]
    for start, rate, error, frame in zip(*drawn, strict=True):
        yield Case(start, rate, error, frame, rng.uniform(0, 1), rng.uniform(0.5, 4))


def _integrated(derivative, y: np.ndarray) -> np.ndarray:
    span = (0, DURATION)
    return solve_ivp(derivative, span, y, "DOP853", rtol=TOLERANCE, atol=TOLERANCE / 10).y[:, -1]


def _in_turning_frame(start: Rotation, rate: np.ndarray, frame: np.ndarray) -> Rotation:
    """Attitude at the end against a frame that itself turns.

    q' = (q (0, rate) - (0, frame) q)/2, by the differential equation of the matrices.
    """

    def derivative(t, y):
        r = y.reshape(3, 3)
        return (r @ cross_matrix(rate) - cross_matrix(frame) @ r).ravel()

    return Rotation.from_matrix(_integrated(derivative, start.as_matrix().ravel()).reshape(3, 3))


# The linear system


def _check_jacobians(d: Derivation) -> Check:
    """F and G against the derivatives of the exact equations."""
    both = _jacobians(d)
    rng, zero, differences = np.random.default_rng(6), np.zeros(3), []
    for _ in rounds():
        rate, a, f = rng.normal(size=3), rng.uniform(0, 1), rng.uniform(0.5, 4)
        found = call(both, *[zero] * 4, rate, a, f, *rng.uniform(0, 1, (2, 3)))
        differences += zip(found[:3], found[3:], strict=True)
    return Check.of_pairs(
        "`F` and `G` as casadi's Jacobians of the exact equation at zero",
        differences,
        ROUNDING,
        each=3,
    )


def _jacobians(d: Derivation) -> ca.Function:
    """Derivatives of the exact equations by x, by the noises, and by both.

    Beside them are F, G and the derivatives of the linear equation.
    """
    p, b, eta, walk, rate, n, k = (
        ca.SX.sym(name, 3) for name in ("p", "b", "eta", "walk", "rate", "n", "k")
    )
    a, f = ca.SX.sym("a"), ca.SX.sym("f")
    printed = d.function(
        ("p_dot", "F", "G"), ("p", "b", "eta_N", "omega_hat", "a", "f", "D_N", "D_K")
    )
    p_dot, *linear = printed(p, b, eta, rate, a, f, ca.diag(n), ca.diag(k))
    x_dot = ca.vertcat(p_dot, k * walk)
    jacobians = [ca.densify(ca.jacobian(x_dot, ca.vertcat(*by))) for by in ((p, b), (eta, walk))]
    x, noise = ca.vertcat(p, b), ca.vertcat(eta, walk)
    small = d.function(("x_dot",), ("omega_hat", "a", "f", "D_N", "D_K", "x", "eta"))(
        rate, a, f, ca.diag(n), ca.diag(k), x, noise
    )
    linear += [ca.densify(ca.jacobian(small, ca.vertcat(x, noise)))]
    exact = [*jacobians, ca.horzcat(*jacobians)]
    return ca.Function("both", [p, b, eta, walk, rate, a, f, n, k], [*exact, *linear])


def _check_library(d: Derivation) -> Check:
    printed = d.function(
        ("p_dot", "F", "G"), ("p", "omega_hat", "delta_omega", "a", "f", "D_N", "D_K")
    )
    p, rate, error, n, k = (ca.SX.sym(name, 3) for name in ("p", "rate", "error", "n", "k"))
    a, f = ca.SX.sym("a"), ca.SX.sym("f")
    system = error_system(rate, n, [(k, ca.SX(3, 1))], mrp.share(a, f))
    package = ca.Function(
        "package",
        [p, rate, error, a, f, n, k],
        [mrp.error_derivative(p, rate, error, a, f), *map(ca.densify, system)],
    )
    rng, pairs = np.random.default_rng(7), []
    for _ in rounds():
        v, a0, f0 = rng.normal(size=(3, 3)) / 3, rng.uniform(0, 1), rng.uniform(0.5, 4)
        n0, k0 = rng.uniform(0, 1, (2, 3))
        ours = call(printed, *v, a0, f0, np.diag(n0), np.diag(k0))
        pairs += zip(ours, call(package, *v, a0, f0, n0, k0), strict=True)
    return Check.of_pairs(
        "mrp.error_derivative and noise.error_system of the package", pairs, ROUNDING, each=3
    )


ATTITUDE_ERROR = Derivation(
    "attitude_error",
    "Dynamics of the attitude error and the gyro bias",
    "The truth is the estimate turned by the error, whose Rodrigues parameters are `p` (body "
    "axes); `x`, that is `p` above `b`, is the filter's error state. "
    "With rates against inertial space the Earth's rate drops out where it is known, since it "
    "turns truth and estimate alike.",
    f"{CRASSIDIS}, section III, for the linear part; the exact equation follows from that of the "
    "Rodrigues parameters and the kinematics",
    (
        RATE_ERROR,
        replace(FROM_MRP, note="scalar part of the error's quaternion"),
        ERROR,
        SHARE,
        *LINEAR,
    ),
    _check_error,
)
