"""How an attitude error moves, the Earth's rate, and the rate that a filter makes of a measured
one.
"""

from __future__ import annotations

from dataclasses import replace

import casadi as ca
import numpy as np
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from pyimu.derivations.independent import cross_matrix, largest, scalar_first, vectors
from pyimu.derivations.kinematics import CASES, CRASSIDIS, FROM_MRP, HIDALGO, ROUNDING, SHARE
from pyimu.derivations.model import Check, Derivation, Equation, Table, call
from pyimu.symbolic import mrp
from pyimu.symbolic.earth import EARTH_RATE, earth_rate
from pyimu.symbolic.process_noise import error_system

INTEGRATIONS = 20
TOLERANCE = 1e-12
"""Of the numerical integration, relative, for each of its steps; a few tens of steps add up."""


# Attitude error


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
    moved = d.function(("p_dot",), ("p", "omega_hat", "delta_omega", "a", "f"))
    rng, exact, earth = np.random.default_rng(5), [], []
    starts, rates, wrong, turns = (
        vectors(rng, INTEGRATIONS, low, high)
        for low, high in ((0.01, 2), (0.1, 3), (0.01, 1), (0.1, 1))
    )
    for v, rate, error, frame in zip(starts, rates, wrong, turns):
        a, f, h = rng.uniform(0, 1), rng.uniform(0.5, 4), 0.5
        p = _rodrigues(Rotation.from_rotvec(v), a, f)
        p = _integrated(lambda t, y: call(moved, y, rate, error, a, f)[0], p, h)  # noqa: B023  (used in this turn of the loop only)
        estimate, truth = (
            Rotation.from_rotvec(rate * h),
            Rotation.from_rotvec(v) * Rotation.from_rotvec((rate + error) * h),
        )
        exact.append((p, _rodrigues(estimate.inv() * truth, a, f)))
        earth.append(
            (
                p,
                _rodrigues(
                    _in_turning_frame(Rotation.identity(), rate, frame, h).inv()
                    * _in_turning_frame(Rotation.from_rotvec(v), rate + error, frame, h),
                    a,
                    f,
                ),
            )
        )
    bound = 100 * TOLERANCE
    return [
        Check(
            "scipy: truth and estimate turned apart, the equation integrated (tolerance 1e-12 a "
            "step)",
            INTEGRATIONS,
            largest(exact),
            bound,
        ),
        Check(
            "both quaternions integrated in a frame that turns: its rate drops out, so `F` has the "
            "rate against inertial space",
            INTEGRATIONS,
            largest(earth),
            bound,
        ),
        Check(
            "`F` and `G` as casadi's Jacobians of the exact equation at zero",
            CASES,
            _jacobians(d),
            ROUNDING,
        ),
        Check(
            "mrp.error_derivative and noise.error_system of the package",
            CASES,
            _library(d),
            ROUNDING,
        ),
    ]


def _rodrigues(turn: Rotation, a: float, f: float) -> np.ndarray:
    q = scalar_first(turn)
    return f * q[1:] * np.sign(q[0]) / (a + abs(q[0]))


def _integrated(derivative, y: np.ndarray, h: float) -> np.ndarray:
    return solve_ivp(derivative, (0, h), y, "DOP853", rtol=TOLERANCE, atol=TOLERANCE / 10).y[:, -1]


def _in_turning_frame(start: Rotation, rate: np.ndarray, frame: np.ndarray, h: float) -> Rotation:
    """Attitude against a frame that itself turns, q' = (q (0, rate) - (0, frame) q)/2, by the
    matrices' differential equation.
    """

    def derivative(t, y):
        r = y.reshape(3, 3)
        return (r @ cross_matrix(rate) - cross_matrix(frame) @ r).ravel()

    return Rotation.from_matrix(_integrated(derivative, start.as_matrix().ravel(), h).reshape(3, 3))


def _jacobians(d: Derivation) -> float:
    """Largest difference of F and G from the derivatives of the exact equations."""
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
    both = ca.Function(
        "both", [p, b, eta, walk, rate, a, f, n, k], [*jacobians, ca.horzcat(*jacobians), *linear]
    )
    rng, zero, differences = np.random.default_rng(6), np.zeros(3), []
    for _ in range(CASES):
        found = call(
            both,
            *[zero] * 4,
            rng.normal(size=3),
            rng.uniform(0, 1),
            rng.uniform(0.5, 4),
            *rng.uniform(0, 1, (2, 3)),
        )
        differences += zip(found[:3], found[3:], strict=True)
    return largest(differences)


def _library(d: Derivation) -> float:
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
    for _ in range(CASES):
        v, a0, f0, n0, k0 = (
            rng.normal(size=(3, 3)) / 3,
            rng.uniform(0, 1),
            rng.uniform(0.5, 4),
            *rng.uniform(0, 1, (2, 3)),
        )
        pairs += zip(
            call(printed, *v, a0, f0, np.diag(n0), np.diag(k0)), call(package, *v, a0, f0, n0, k0)
        )
    return largest(pairs)


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


# Earth rate


def _check_earth(d: Derivation) -> list[Check]:
    printed = d.function(("omega_enu", "omega_nwu"), ("lat", "omega_ie"))
    rng, moved, papers, same = np.random.default_rng(8), [], [], []
    for _ in range(CASES):
        latitude, longitude, turn = rng.uniform(-1.5, 1.5), rng.uniform(-3, 3), rng.uniform(0.1, 1)
        east_north_up, north_west_up = call(printed, latitude, 1.0)
        before, after = (_axes(latitude, longitude + angle) for angle in (0, turn))
        moved.append((east_north_up, (before.inv() * after).as_rotvec() / turn))
        papers.append((north_west_up, east_north_up[[1, 0, 2]] * [1, -1, 1]))
        same.append(
            (call(printed, latitude, EARTH_RATE)[0], np.array(earth_rate(ca.DM(latitude))).ravel())
        )
    return [
        Check(
            "the frame carried round by the Earth in scipy: its turn between two instants, by the "
            "angle of the Earth",
            CASES,
            largest(moved),
            ROUNDING,
        ),
        Check(
            "the paper's axes north, west, up turned into east, north, up",
            CASES,
            largest(papers),
            ROUNDING,
        ),
        Check(
            "earth.earth_rate, which the filter computes with, relative to the Earth's rate",
            CASES,
            largest(same) / EARTH_RATE,
            ROUNDING,
        ),
    ]


def _axes(latitude: float, longitude: float) -> Rotation:
    """East, north, up in axes of the Earth's centre, z towards the north pole."""
    up = np.array(
        [
            np.cos(latitude) * np.cos(longitude),
            np.cos(latitude) * np.sin(longitude),
            np.sin(latitude),
        ]
    )
    east = np.array([-np.sin(longitude), np.cos(longitude), 0])
    return Rotation.from_matrix(np.column_stack([east, np.cross(up, east), up]))


EARTH = Derivation(
    "earth_rate",
    "Earth rate by latitude",
    "Rate of the Earth-fixed world frame against inertial space, in the package's axes east, "
    "north, up and in the paper's north, west, up.",
    f"{HIDALGO}, section 4.2, the Earth rotation vector (its exponent is lost in the text: "
    "7.292115e-5 rad/s, WGS 84); Groves 2013, eq. 2.123",
    (
        Equation("omega_enu", "blocks([0], [omega_ie*cos(lat)], [omega_ie*sin(lat)])"),
        Equation(
            "omega_nwu", "blocks([omega_ie*cos(lat)], [0], [omega_ie*sin(lat)])", "the paper's"
        ),
    ),
    _check_earth,
)


# The compensated rate


def _check_rate(d: Derivation) -> list[Check]:
    exact, orders = d.function(("omega_hat",), ("M", "omega_m", "beta")), _orders(d)
    rng, solved, first, second = np.random.default_rng(9), [], [], []
    for rate, bias in zip(vectors(rng, CASES, 0.1, 1), vectors(rng, CASES, 0.01, 0.1)):
        m = rng.uniform(-0.1, 0.1, (3, 3))
        measured = rate + m @ rate + bias
        solved.append((call(exact, m, measured, bias)[0], rate))
        *lower, coefficient, leading = call(orders, m, measured, bias)
        first += [(order, np.zeros(3)) for order in lower]
        second.append((coefficient, leading))
    return [
        Check("the sensor's equation: the true rate comes back", CASES, largest(solved), ROUNDING),
        Check(
            "casadi's derivatives: `omega_1 - omega_hat` vanishes to first order where `M` and "
            "`beta` are small alike",
            CASES,
            largest(first),
            ROUNDING,
        ),
        Check("casadi's derivatives: its second order is `e_1`", CASES, largest(second), ROUNDING),
    ]


def _orders(d: Derivation) -> ca.Function:
    """Taylor coefficients 0, 1 and 2 of omega_1 - omega_hat, M and beta both multiplied by what it
    is expanded in; and e_1.
    """
    small, m, measured, beta = (
        ca.SX.sym("small"),
        ca.SX.sym("M", 3, 3),
        ca.SX.sym("omega_m", 3),
        ca.SX.sym("beta", 3),
    )
    first, exact = d.function(("omega_1", "omega_hat"), ("M", "omega_m", "beta"))(
        small * m, measured, small * beta
    )
    orders = [first - exact]
    orders += [ca.jacobian(orders[0], small)]
    orders += [ca.jacobian(orders[1], small) / 2]
    leading = d.function(("e_1",), ("M", "omega_m", "beta"))(m, measured, beta)
    at_zero = [ca.densify(ca.substitute(order, small, 0)) for order in orders]
    return ca.Function("orders", [m, measured, beta], [*at_zero, leading])


def _cost(d: Derivation) -> list[Table]:
    both, rows = d.function(("omega_hat", "omega_1"), ("M", "omega_m", "beta")), []
    for rate, scale, bias in ((140, 0.03, 0.0), (140, 0.03, 0.5), (1.15, 0.03, 0.0)):
        measured = np.array([0, 0, (1 + scale) * rate + bias])
        exact, first = call(both, scale * np.eye(3), measured, [0, 0, bias])
        wrong = first[2] - exact[2]
        rows.append(
            (f"{rate:g}", f"{scale:.0%}", f"{bias:g}", f"{wrong:.4f}", f"{wrong / rate * 180:.3f}")
        )
    return [
        Table(
            "What the first-order form costs",
            (
                "rate [deg/s]",
                "scale factor",
                "bias [deg/s]",
                "rate error [deg/s]",
                "after 180 deg [deg]",
            ),
            tuple(rows),
        )
    ]


RATE = Derivation(
    "compensated_rate",
    "The rate without the sensor's errors: exact, and as the paper prints it",
    "The measured rate is `omega_m = (I_3 + M)@omega + beta` and noise. The package solves for the "
    "rate against inertial space, `omega_hat`; the "
    "paper prints `omega_1`, which is its first order and wrong by `e_1` to second order. Less the "
    "Earth's rate in body axes, "
    "`T(R_nb)@omega_enu`, either is the rate against the world.",
    f"{HIDALGO}, section 4.2, equation of the post-update angular velocity",
    (
        Equation("omega_hat", "inv(I_3 + M)@(omega_m - beta)"),
        Equation("omega_1", "omega_m - M@omega_m - beta", "the paper's"),
        Equation(
            "e_1",
            "-M**2@omega_m - M@beta",
            "`= omega_1 - omega_hat` to second order in `M` and `beta`",
        ),
    ),
    _check_rate,
    tables=_cost,
)


DERIVATIONS = (ATTITUDE_ERROR, EARTH, RATE)
