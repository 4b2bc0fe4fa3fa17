"""Attitude: quaternion kinematics, the paper's convention, Rodrigues parameters."""

from __future__ import annotations

import casadi as ca
import numpy as np
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

from pyimu.attitude import marginal
from pyimu.derivations.independent import largest, rotations, scalar_first, vectors
from pyimu.derivations.model import EPS, Check, Derivation, Equation, call
from pyimu.symbolic import mrp, quaternion

CASES = 100
SMALL_TURN = 0.3
"""rad; the first term that the series of ``marginal.mean_jacobian`` leaves out is then below
rounding, |a|^12/13!."""

ROUNDING = 200 * EPS
"""A hundred operations on numbers of order one, rounded once each, and those of scipy."""

CRASSIDIS = "Crassidis and Markley 2003 (doi 10.2514/2.5102)"
HIDALGO = "Hidalgo et al. 2012 (doi 10.3390/s120202219)"


# Continuous kinematics


XI = Equation("Xi", "blocks([-T(q_v)], [q_s*I_3 + skew(q_v)])")


def _check_kinematics(d: Derivation) -> list[Check]:
    derivative = d.function(("q_dot",), ("q_s", "q_v", "omega"))
    library = _library(quaternion.derivative, ("q", 4), ("rate", 3))
    rng, turned, same = np.random.default_rng(1), [], []
    for r, rate in zip(rotations(rng, CASES), vectors(rng, CASES, 1e-3, 10.0)):
        h, q = rng.uniform(0.01, 0.2), scalar_first(r)
        generator = np.column_stack([call(derivative, e[0], e[1:], rate)[0] for e in np.eye(4)])
        turned.append(
            (
                expm(generator * h) @ q,
                _same_sign(scalar_first(r * Rotation.from_rotvec(rate * h)), q),
            )
        )
        same.append((call(derivative, q[0], q[1:], rate)[0], call(library, q, rate)[0]))
    return [
        Check(
            "the rotation of scipy by `omega*h`, against the matrix exponential of this linear "
            "system",
            CASES,
            largest(turned),
            ROUNDING,
        ),
        Check(
            "quaternion.derivative, which the package computes with", CASES, largest(same), ROUNDING
        ),
    ]


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


def _mean_turn(angle: np.ndarray) -> np.ndarray:
    """Integral over s from 0 to 1 of the matrix (3, 3) of the turn by -s ``angle``, out of one
    matrix exponential (Van Loan 1978).
    """
    whole = np.zeros((6, 6))
    whole[:3, :3], whole[:3, 3:] = np.cross(np.eye(3), angle).T, np.eye(3)
    return expm(whole)[:3, 3:]


def _check_step(d: Derivation) -> list[Check]:
    printed = d.function(("Omega", "q_next"), ("omega", "h", "q"))
    library = _library(
        lambda q, rate, h: quaternion.step(q, rate, h), ("q", 4), ("rate", 3), ("h", 1)
    )
    library_matrix = _library(quaternion.step_matrix, ("rate", 3), ("h", 1))
    generator = KINEMATICS.function(("q_dot",), ("q_s", "q_v", "omega"))
    product = _library(
        lambda q, angle: quaternion.product(q, quaternion.exponential(angle)),
        ("q", 4),
        ("angle", 3),
    )
    turn = _library(
        lambda q, angle: quaternion.product(q, marginal.turn(angle)[0]), ("q", 4), ("angle", 3)
    )
    jacobian = _library(
        lambda angle: marginal.mean_jacobian(angle, marginal.turn(angle)[1]), ("angle", 3)
    )
    rng, exact, scipys, same, small, fast, mean = np.random.default_rng(2), [], [], [], [], [], []
    for r, rate in zip(rotations(rng, CASES), vectors(rng, CASES, 1e-2, 30.0)):
        h, q = rng.uniform(1e-3, 0.1), scalar_first(r)
        ours, after = call(printed, rate, h, q)
        linear = np.column_stack([call(generator, e[0], e[1:], rate)[0] for e in np.eye(4)])
        exact.append((ours, expm(linear * h)))
        scipys.append((after, _same_sign(scalar_first(r * Rotation.from_rotvec(rate * h)), q)))
        same += [
            (ours, call(library_matrix, rate, h)[0]),
            (after, call(library, q, rate, h)[0]),
            (after, call(product, q, rate * h)[0]),
        ]
        angle = rng.uniform(-np.pi, np.pi, 3)
        fast.append((call(turn, q, angle)[0], call(product, q, angle)[0]))
        angle *= SMALL_TURN / max(SMALL_TURN, np.linalg.norm(angle))
        mean.append((call(jacobian, angle)[0], _mean_turn(angle)))
        tiny = rate * 10.0 ** rng.uniform(-16, -2)
        small.append(
            (
                call(library_matrix, tiny, h)[0] @ q,
                _same_sign(scalar_first(r * Rotation.from_rotvec(tiny * h)), q),
            )
        )
    zero = call(library_matrix, np.zeros(3), 0.1)[0]
    return [
        Check(
            "the matrix exponential of the continuous kinematics", CASES, largest(exact), ROUNDING
        ),
        Check("the rotation of scipy by `omega*h`", CASES, largest(scipys), ROUNDING),
        Check(
            "quaternion.step and quaternion.step_matrix; the product with quaternion.exponential, "
            "which the filter of 13 points turns by",
            3 * CASES,
            largest(same),
            ROUNDING,
        ),
        Check(
            "marginal.turn, which the filter turns by: the same by series, up to half a turn about "
            "each axis",
            CASES,
            largest(fast),
            ROUNDING,
        ),
        Check(
            "marginal.mean_jacobian, by which a bias turns it: the integral of the turn's matrix, "
            f"for turns of up to {SMALL_TURN:g} rad in a step",
            CASES,
            largest(mean),
            ROUNDING,
        ),
        Check(
            "the same at rates down to 1e-18 rad/s and at zero, where the series stand in",
            CASES + 1,
            largest([*small, (zero, np.eye(4))]),
            ROUNDING,
        ),
    ]


CLOSED_STEP = Derivation(
    "quaternion_step",
    "One step at a constant rate, closed form",
    "The kinematics solved for a rate that is constant over the sample period `h`: the product "
    "with the quaternion of the turn `omega*h`.",
    f"{HIDALGO}, section 4.2, Omega of the angular velocity, in its order of the elements",
    (*TURN, STEP, Equation("q_next", "Omega@q")),
    _check_step,
)


# The paper's convention


def _check_convention(d: Derivation) -> list[Check]:
    permuted = d.function(("q_H", "A", "Omega_H", "qH_next", "P_H"), ("q_s", "q_v", "omega", "h"))
    attitude = d.function(("A",), ("q_s", "q_v"))
    ours = CLOSED_STEP.function(("Omega",), ("omega", "h"))
    rng, matrices, steps, orders = np.random.default_rng(3), [], [], []
    for r, rate in zip(rotations(rng, CASES), vectors(rng, CASES, 1e-2, 30.0)):
        h, q = rng.uniform(1e-3, 0.1), scalar_first(r)
        q_paper, a, omega_paper, after, p = call(permuted, q[0], q[1:], rate, h)
        step = call(ours, rate, h)[0]
        matrices += [(a, r.as_matrix().T), (q_paper, p @ q)]
        steps += [(omega_paper, p @ step @ p.T), (after, p @ step @ q)]
        turn = scalar_first(Rotation.from_rotvec(rate * h))
        orders.append(
            (call(attitude, after[3], after[:3])[0], call(attitude, turn[0], turn[1:])[0] @ a)
        )
    return [
        Check(
            "the transpose of scipy's matrix `R_nb`: `A` turns the world's axes into the body's",
            CASES,
            largest(matrices),
            ROUNDING,
        ),
        Check(
            "`Omega` and `q` of the package with rows and columns permuted by `P_H`: the same four "
            "numbers",
            CASES,
            largest(steps),
            ROUNDING,
        ),
        Check(
            "the product of the attitude matrices, that of the turn times that before it, the "
            "order of Lefferts and Markley",
            CASES,
            largest(orders),
            ROUNDING,
        ),
    ]


CONVENTION = Derivation(
    "hidalgo_convention",
    "The paper's convention, vector part first",
    "The paper writes the vector part first, has an attitude matrix `A` from world to body axes, "
    "and composes in the order "
    "of the matrices. Its quaternion is the package's with the elements in another order, its "
    "matrix the transpose of `R_nb`: "
    "the same rotation, and the same step.",
    f"{HIDALGO}, sections 4.1 and 4.2; Lefferts, Markley and Shuster 1982 for the attitude matrix",
    (
        Equation("P_H", "blocks([O_31, I_3], [1, T(O_31)])"),
        Equation("q_H", "blocks([q_v], [q_s])", "`= P_H@q`"),
        Equation("A", "(q_s**2 - T(q_v)@q_v)*I_3 + 2*q_v@T(q_v) - 2*q_s*skew(q_v)", "`= T(R_nb)`"),
        Equation(
            "Omega_H",
            "blocks([c*I_3 - skew(psi), psi], [-T(psi), c])",
            "`= P_H@Omega@T(P_H)`, with `psi` and `c` of the closed form",
        ),
        Equation("qH_next", "Omega_H@q_H"),
    ),
    _check_convention,
    given=TURN,
)


# Rodrigues parameters


SHARE = Equation("s", "f/(2*(a + 1))")
FROM_MRP = Equation(
    "q_s", "(f*sqrt(f**2 + (1 - a**2)*T(p)@p) - a*T(p)@p)/(f**2 + T(p)@p)", "the inverse"
)


def _check_mrp(d: Derivation) -> list[Check]:
    forward = d.function(("p",), ("q_s", "q_v", "a", "f"))
    inverse = d.function(("q_s", "q_v"), ("p", "a", "f"))
    share = d.function(("s",), ("a", "f"))
    library = _library(mrp.from_quaternion, ("q", 4), ("a", 1), ("f", 1))
    library_inverse = _library(mrp.to_quaternion, ("p", 3), ("a", 1), ("f", 1))
    rng, standard, back, slopes, same = np.random.default_rng(4), [], [], [], []
    for v in vectors(rng, CASES, 1e-6, 3.0):
        q, a, f = scalar_first(Rotation.from_rotvec(v)), rng.uniform(0, 1), rng.uniform(0.5, 4)
        standard.append((call(forward, q[0], q[1:], 1, 1)[0], Rotation.from_rotvec(v).as_mrp()))
        p = call(forward, q[0], q[1:], a, f)[0]
        back.append((np.hstack(call(inverse, p, a, f)), q))
        same += [
            (p, call(library, q, a, f)[0]),
            (np.hstack(call(inverse, p, a, f)), call(library_inverse, p, a, f)[0]),
        ]
        slope, bend = _at_zero(a, f)
        slopes += [
            (slope, call(share, a, f)[0] * np.eye(3)),
            (bend, np.zeros_like(bend)),
            (mrp.share(a, f), call(share, a, f)[0]),
        ]
    return [
        Check(
            "scipy's modified Rodrigues parameters, at `f = a = 1`",
            CASES,
            largest(standard),
            ROUNDING,
        ),
        Check(
            "there and back at random `a` and `f`: the quaternion", CASES, largest(back), ROUNDING
        ),
        Check(
            "casadi's derivatives at zero: slope `s`, no curvature, so that `p = s*r` to second "
            "order",
            CASES,
            largest(slopes),
            ROUNDING,
        ),
        Check(
            "mrp.from_quaternion and mrp.to_quaternion, which the filter computes with",
            CASES,
            largest(same),
            ROUNDING,
        ),
    ]


def _at_zero(a: float, f: float) -> tuple[np.ndarray, np.ndarray]:
    """First and second derivative of p by the rotation vector at zero."""
    r = ca.SX.sym("r", 3)
    p = mrp.from_quaternion(quaternion.exponential(r), a, f)
    slope = ca.jacobian(p, r)
    both = ca.Function("both", [r], [ca.densify(slope), ca.densify(ca.jacobian(slope, r))])
    return tuple(np.array(m) for m in both(np.zeros(3)))


RODRIGUES = Derivation(
    "rodrigues_parameters",
    "Generalised Rodrigues parameters and their inverse",
    "Three numbers for a small rotation with the quaternion `q_s`, `q_v`. They are `s` times the "
    "rotation vector `r`: the package's filter has `a = 1`, "
    "`f = 4`, so that `s = 1` and `p` is in rad; the paper's `f = a = 1` makes `p` a quarter of "
    "the angle.",
    f"{HIDALGO}, section 4.1, the delta quaternion; {CRASSIDIS}, eqs. 16 and 21",
    (Equation("p", "f*q_v/(a + q_s)"), SHARE, FROM_MRP, Equation("q_v", "(a + q_s)/f*p")),
    _check_mrp,
)


# Helpers


def _library(function, *inputs: tuple[str, int]) -> ca.Function:
    """A function of the package as a casadi function."""
    symbols = [ca.SX.sym(name, size) for name, size in inputs]
    return ca.Function("library", symbols, [ca.densify(function(*symbols))])


def _same_sign(q: np.ndarray, like: np.ndarray) -> np.ndarray:
    """q or -q, the same rotation, whichever is closer to ``like``."""
    return q if q @ like >= 0 else -q


DERIVATIONS = (KINEMATICS, CLOSED_STEP, CONVENTION, RODRIGUES)
