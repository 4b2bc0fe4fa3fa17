"""The discrete process noise Q of attitude error and gyro bias where the bias is a random walk."""

from __future__ import annotations

from math import factorial

import casadi as ca
import numpy as np
from scipy.linalg import expm

from pyimu.derivations.independent import in_standard_deviations, largest, van_loan, vectors
from pyimu.derivations.kinematics import CASES, CRASSIDIS, HIDALGO
from pyimu.derivations.model import EPS, Check, Derivation, Equation, call
from pyimu.symbolic import process_noise as noise

ROUNDING = 1000 * EPS
"""Van Loan's matrix exponential squares and multiplies matrices of size 12 a few times; its entries
reach a hundred."""

OF_COVARIANCE = "largest difference in standard deviations"
VAN_LOAN = "Van Loan 1978 (doi 10.1109/TAC.1978.1101743)"
INTEGRAL = (
    "`Q` is the integral of `exp(F*t)@G@T(G)@T(exp(F*t))` from 0 to `h`, with `F` and `G` of the "
    "attitude error."
)
SLOWEST, FASTEST = 0.5, 3.0
"""rad/s; rates of the random cases, whose periods are 0.3 to 1 s."""


# The integrals of sine and cosine


MAGNITUDE = Equation("w", "norm(omega)")
PSI = (
    Equation("psi_1", "sin(w*h)/w"),
    Equation("psi_2", "(1 - cos(w*h))/w**2"),
    Equation("psi_3", "(w*h - sin(w*h))/w**3"),
    Equation("psi_4", "((w*h)**2/2 - 1 + cos(w*h))/w**4"),
    Equation("psi_5", "((w*h)**3/6 - w*h + sin(w*h))/w**5"),
    Equation("psi_6", "((w*h)**4/24 - (w*h)**2/2 + 1 - cos(w*h))/w**6"),
    Equation("psi_7", "((w*h)**5/120 - (w*h)**3/6 + w*h - sin(w*h))/w**7"),
)
SERIES = Equation(
    "psi_k", "h**k*sines(k, w*h)", "the same as a series, which is computed where `w*h` is below 2"
)


def _check_psi(d: Derivation) -> list[Check]:
    closed, series = d.function(tuple(e.left for e in PSI), ("w", "h")), d.equations[-1].formula
    library = _library(
        lambda w, h: ca.vertcat(*[noise.psi(k, w * w, h) for k in range(1, 8)]), 1, 1
    )
    rng, integrals, same, small, edge = np.random.default_rng(10), [], [], [], []
    for _ in range(CASES // 10):
        w, h = rng.uniform(4, 8), rng.uniform(0.5, 1)
        scale = np.array([h**k / factorial(k) for k in range(1, 8)])
        ours = np.array(call(closed, w, h)) / scale
        integrals.append((ours, [_repeated_integral(k, w, h) for k in range(1, 8)] / scale))
        same.append((ours, call(library, w, h)[0] / scale))
        tiny = w * 10.0 ** rng.uniform(-9, -1)
        small.append(
            (
                call(library, tiny, h)[0] / scale,
                [_repeated_integral(k, tiny, h) for k in range(1, 8)] / scale,
            )
        )
        small.append(
            (
                [
                    float(series.evaluate({"k": k, "w": ca.DM(tiny), "h": ca.DM(h)}))
                    for k in range(1, 8)
                ]
                / scale,
                small[-1][1],
            )
        )
        edge.append(
            (
                call(library, (2 - 1e-15) / h, h)[0] / scale,
                call(library, (2 + 1e-15) / h, h)[0] / scale,
            )
        )
    # At w h = 2 the closed form of psi_7 is what is left, 0.022, of terms of size (w h)^5/120 and
    # smaller; each rounds once or twice.
    bound = 100 * EPS
    return [
        Check(
            "the `k`-fold integral of `cos(w*t)` by Gauss's quadrature",
            CASES // 10,
            largest(integrals),
            bound,
            "largest relative difference",
        ),
        Check(
            "noise.psi of the package",
            CASES // 10,
            largest(same),
            bound,
            "largest relative difference",
        ),
        Check(
            "the series, as printed and of the package, by quadrature, `w*h` down to 1e-9",
            CASES // 10,
            largest(small),
            bound,
            "largest relative difference",
        ),
        Check(
            "both sides of where the series takes over",
            CASES // 10,
            largest(edge),
            bound,
            "largest relative difference",
        ),
    ]


def _repeated_integral(k: int, w: float, h: float) -> float:
    """The k-fold integral of cos(w t) from 0 to h, by Cauchy's formula."""
    t, weights = np.polynomial.legendre.leggauss(40)
    t = h * (t + 1) / 2
    return h / 2 * weights @ ((h - t) ** (k - 1) / factorial(k - 1) * np.cos(w * t))


INTEGRALS = Derivation(
    "integrals",
    "Integrals of sine and cosine, and their series near zero",
    "`psi_k` is the `k`-fold integral of `cos(w*t)` from 0 to `h`, so that each is the integral of "
    "the one before. Closed forms lose their digits where `w*h` is small, the series do not. "
    "(`psi_k/h**k` are Stumpff's functions of `(w*h)**2`.)",
    "Battin 1999, section 4.5, for Stumpff's functions; written out here",
    (*PSI, SERIES),
    _check_psi,
)


# Transition matrix


CROSS = Equation("W", "skew(omega)", "the matrix of the cross product with `omega`")
PP, PB = (
    Equation(
        "Phi_pp", "I_3 - psi_1*W + psi_2*W**2", "`= exp(-W*h)`, the turn of the body backwards"
    ),
    Equation("Phi_pb", "-s*(h*I_3 - psi_2*W + psi_3*W**2)"),
)


def _check_transition(d: Derivation) -> list[Check]:
    printed = d.function(("Phi",), ("omega", "h", "s"))
    rng, pairs, general = np.random.default_rng(11), [], []
    for rate, h, share in _cases(rng):
        f, _ = _system(rate, np.ones(3), np.ones(3), share)
        pairs.append((call(printed, rate, h, share)[0], expm(f * h)))
        general.append((np.array(noise.turning_transition(ca.DM(f), rate @ rate, h)), expm(f * h)))
    return [
        Check("the matrix exponential of `F*h` by scipy", CASES, largest(pairs), ROUNDING),
        Check(
            "noise.turning_transition, `I_6 + h*F + psi_2*F**2 + psi_3*F**3`",
            CASES,
            largest(general),
            ROUNDING,
        ),
    ]


def _cases(rng: np.random.Generator):
    """Rates, periods and shares (f and a at random).

    The printed closed forms lose about 3/(w h)^2 roundings; below the turns drawn here the package
    takes the series.
    """
    for rate in vectors(rng, CASES, SLOWEST, FASTEST):
        a, f = rng.uniform(0, 1), rng.uniform(0.5, 4)
        yield rate, rng.uniform(0.3, 1), f / (2 * (a + 1))


def _system(rate, n, k, share) -> tuple[np.ndarray, np.ndarray]:
    """F and G G^T as arrays."""
    f, g = noise.error_system(ca.DM(rate), ca.DM(n), [(ca.DM(k), ca.DM.zeros(3))], share)
    return np.array(f), np.array(g @ g.T)


TRANSITION = Derivation(
    "transition_matrix",
    "Transition matrix of the error state at a constant rate",
    "`Phi = exp(F*h)` in closed form: `F**4 = -w**2*F**2`, so that all higher powers of `F` fold "
    "into four.",
    f"{CRASSIDIS}, section III, has its first order; Trawny and Roumeliotis 2005, section 2.4, the "
    "same matrices for s = 1",
    (MAGNITUDE, CROSS, PP, PB, Equation("Phi", "blocks([Phi_pp, Phi_pb], [O_3, I_3])")),
    _check_transition,
    given=PSI,
)


# Q without rotation


Q = Equation("Q", "blocks([Q_pp, Q_pb], [T(Q_pb), Q_bb])")


def _check_still(d: Derivation) -> list[Check]:
    printed = d.function(("Q",), ("S_N", "S_K", "h", "s"))
    derived, library = _by_casadi(still=True), _library(noise.process_noise, 3, 3, 1)
    rng, exact, by_casadi, same = np.random.default_rng(12), [], [], []
    for _, h, share in _cases(rng):
        n, k = rng.uniform(0.1, 1, (2, 3))
        ours = call(printed, np.diag(n**2), np.diag(k**2), h, share)[0]
        exact.append(in_standard_deviations(ours, van_loan(*_system(np.zeros(3), n, k, share), h)))
        by_casadi.append(
            in_standard_deviations(ours, call(derived, np.zeros(3), n, k, h, share)[0])
        )
        unscaled = call(printed, np.diag(n**2), np.diag(k**2), h, 1.0)[0]
        same.append(in_standard_deviations(call(library, n, k, h)[0], unscaled))
    return [
        Check(
            "casadi's integral from `F`, `G` and `h`: `F**2 = 0`, so its series ends by itself",
            CASES,
            max(by_casadi),
            ROUNDING,
            OF_COVARIANCE,
        ),
        Check(
            "Van Loan's method, scipy's matrix exponential, random `N`, `K`, `h`, `a`, `f`",
            CASES,
            max(exact),
            ROUNDING,
            OF_COVARIANCE,
        ),
        Check(
            "noise.process_noise, which the filter computes with (`s = 1`)",
            CASES,
            max(same),
            ROUNDING,
            OF_COVARIANCE,
        ),
    ]


def _by_casadi(still: bool) -> ca.Function:
    """Q from F, G and h by casadi alone: the integral term by term in powers of F, whose sum is Q'
    = F Q + Q F^T + G G^T.
    """
    rate, n, k, h, share = (
        ca.SX.sym("rate", 3),
        ca.SX.sym("n", 3),
        ca.SX.sym("k", 3),
        ca.SX.sym("h"),
        ca.SX.sym("s"),
    )
    f, g = noise.error_system(ca.SX(3, 1) if still else rate, n, [(k, ca.SX(3, 1))], share)
    return ca.Function(
        "by_casadi",
        [rate, n, k, h, share],
        [ca.densify(noise.discretised(f, g @ g.T, h, 0 if still else 3)[1])],
    )


STILL = Derivation(
    "process_noise",
    "Discrete process noise, body that does not turn",
    f"{INTEGRAL} Each axis on its own; any scaling of the Rodrigues parameters by `s = f/(2*(a + "
    "1))`.",
    f"{CRASSIDIS}, eq. 27; {HIDALGO}, section 4.2, Q_k; {VAN_LOAN} for the check",
    (
        Equation("Q_pp", "s**2*(h*S_N + h**3/3*S_K)"),
        Equation("Q_pb", "-(s*h**2/2*S_K)"),
        Equation("Q_bb", "h*S_K"),
        Q,
    ),
    _check_still,
)


# Q of a body that turns


def _check_turning(d: Derivation) -> list[Check]:
    printed = d.function(("Q",), ("omega", "N", "K", "h", "s"))
    derived, library = _by_casadi(still=False), _turning_library()
    still = STILL.function(("Q",), ("S_N", "S_K", "h", "s"))
    rng, exact, by_casadi, same, slow, tiny = np.random.default_rng(13), [], [], [], [], []
    for rate, h, share in _cases(rng):
        n, k = rng.uniform(0.1, 1, 2)
        ours = call(printed, rate, n, k, h, share)[0]
        exact.append(
            in_standard_deviations(ours, van_loan(*_system(rate, [n] * 3, [k] * 3, share), h))
        )
        by_casadi.append(
            in_standard_deviations(call(derived, rate, [n] * 3, [k] * 3, h, share)[0], ours)
        )
        same.append(
            in_standard_deviations(call(library, rate, [n] * 3, [k] * 3, h, share)[0], ours)
        )
        slower = rate * 10.0 ** rng.uniform(-12, -1)
        slow.append(
            in_standard_deviations(
                call(library, slower, [n] * 3, [k] * 3, h, share)[0],
                van_loan(*_system(slower, [n] * 3, [k] * 3, share), h),
            )
        )
        squares = np.eye(3) * n**2, np.eye(3) * k**2
        tiny.append(
            in_standard_deviations(
                call(library, np.zeros(3), [n] * 3, [k] * 3, h, share)[0],
                call(still, *squares, h, share)[0],
            )
        )
    return [
        Check(
            "casadi's integral from `F`, `G` and `h`, as a series",
            CASES,
            max(by_casadi),
            ROUNDING,
            OF_COVARIANCE,
        ),
        Check(
            "the differential equation `Q_dot = F@Q + Q@T(F) + G@T(G)`, by casadi's derivative of "
            "the printed form by `h`",
            CASES,
            _residual(d),
            ROUNDING,
            OF_COVARIANCE,
        ),
        Check(
            "Van Loan's method, random `omega`, `N`, `K`, `h`, `a`, `f`",
            CASES,
            max(exact),
            ROUNDING,
            OF_COVARIANCE,
        ),
        Check(
            "noise.turning_process_noise of the package", CASES, max(same), ROUNDING, OF_COVARIANCE
        ),
        Check(
            "the same against Van Loan's method where `w*h` goes down to 1e-13 and the series "
            "stand in",
            CASES,
            max(slow),
            ROUNDING,
            OF_COVARIANCE,
        ),
        Check(
            "the same at `omega = 0` against the form for a body that does not turn",
            CASES,
            max(tiny),
            ROUNDING,
            OF_COVARIANCE,
        ),
    ]


def _residual(d: Derivation) -> float:
    """Largest |Q' - F Q - Q F^T - G G^T| in standard deviations of Q over h, with casadi's
    derivative by h.
    """
    rate, n, k, h, share = ca.SX.sym("rate", 3), *(ca.SX.sym(name) for name in ("n", "k", "h", "s"))
    q = d.function(("Q",), ("omega", "N", "K", "h", "s"))(rate, n, k, h, share)
    f, g = noise.error_system(rate, ca.repmat(n, 3), [(ca.repmat(k, 3), ca.SX(3, 1))], share)
    slope = ca.reshape(ca.jacobian(ca.vec(q), h), 6, 6)
    both = ca.Function(
        "both",
        [rate, n, k, h, share],
        [ca.densify(slope * h), ca.densify((f @ q + q @ f.T + g @ g.T) * h), q],
    )
    rng, worst = np.random.default_rng(14), 0.0
    for w, period, s in _cases(rng):
        left, right, covariance = call(both, w, *rng.uniform(0.1, 1, 2), period, s)
        std = np.sqrt(np.diag(covariance))
        worst = max(worst, float(np.max(np.abs(left - right) / np.outer(std, std))))
    return worst


def _turning_library() -> ca.Function:
    return _library(noise.turning_process_noise, 3, 3, 3, 1, 1)


TURNING = Derivation(
    "process_noise_turning",
    "Discrete process noise, body at a constant rate, equal axes",
    f"{INTEGRAL} Exact where the three axes have the same `N` and `K`; the terms with `W` are what "
    "the form without rotation leaves out.",
    f"derived here; {CRASSIDIS}, eq. 27, is its limit for `omega = 0`; {VAN_LOAN} for the check",
    (
        MAGNITUDE,
        CROSS,
        Equation("Q_pp", "s**2*((N**2*h + K**2*h**3/3)*I_3 + 2*K**2*psi_5*W**2)"),
        Equation("Q_pb", "-s*K**2*(h**2/2*I_3 - psi_3*W + psi_4*W**2)"),
        Equation("Q_bb", "K**2*h*I_3"),
        Q,
    ),
    _check_turning,
    given=PSI,
)


TWICE = (
    Equation("chi_5", "h**5*sines(5, 2*w*h)", "`psi_5` at twice the rate"),
    Equation("chi_7", "h**7*sines(7, 2*w*h)", "`psi_7` at twice the rate"),
)
PRODUCTS = (
    Equation("m_00", "h"),
    Equation("m_01", "h**2/2"),
    Equation("m_02", "psi_3"),
    Equation("m_03", "psi_4"),
    Equation("m_11", "h**3/3"),
    Equation("m_12", "h*psi_3 - psi_4"),
    Equation("m_13", "h*psi_4 - psi_5"),
    Equation("m_22", "8*chi_5 - 2*psi_5"),
    Equation("m_23", "psi_3**2/2"),
    Equation("m_33", "32*chi_7 - 2*h*psi_6 + 2*psi_7"),
)
SUM = (
    "m_00*S + m_01*(F@S + S@T(F)) + m_02*(F**2@S + S@T(F**2)) + m_03*(F**3@S + S@T(F**3)) + "
    "m_11*F@S@T(F) "
    "+ m_12*(F**2@S@T(F) + F@S@T(F**2)) + m_13*(F**3@S@T(F) + F@S@T(F**3)) + m_22*F**2@S@T(F**2) "
    "+ m_23*(F**3@S@T(F**2) + F**2@S@T(F**3)) + m_33*F**3@S@T(F**3)"
)


def _check_axes(d: Derivation) -> list[Check]:
    printed = d.function(("Q",), ("F", "G", "omega", "h"))
    derived, library = _by_casadi(still=False), _turning_library()
    rng, exact, by_casadi, same, fast = np.random.default_rng(15), [], [], [], []
    for rate, h, share in _cases(rng):
        n, k = rng.uniform(0.1, 1, (2, 3))
        f, density = _system(rate, n, k, share)
        ours, reference = call(printed, f, np.sqrt(density), rate, h)[0], van_loan(f, density, h)
        exact.append(in_standard_deviations(ours, reference))
        by_casadi.append(in_standard_deviations(call(derived, rate, n, k, h, share)[0], ours))
        same.append(in_standard_deviations(call(library, rate, n, k, h, share)[0], ours))
        slower = rate * 10.0 ** rng.uniform(-12, -1)
        fast.append(
            in_standard_deviations(
                call(library, slower, n, k, h, share)[0], van_loan(*_system(slower, n, k, share), h)
            )
        )
    return [
        Check(
            "casadi's integral from `F`, `G` and `h`, as a series",
            CASES,
            max(by_casadi),
            ROUNDING,
            OF_COVARIANCE,
        ),
        Check(
            "Van Loan's method, random `omega`, `N`, `K` of each axis, `h`, `a`, `f`",
            CASES,
            max(exact),
            ROUNDING,
            OF_COVARIANCE,
        ),
        Check(
            "noise.turning_process_noise of the package", CASES, max(same), ROUNDING, OF_COVARIANCE
        ),
        Check(
            "the same against Van Loan's method, `w*h` down to 1e-13",
            CASES,
            max(fast),
            ROUNDING,
            OF_COVARIANCE,
        ),
    ]


AXES = Derivation(
    "process_noise_axes",
    "Discrete process noise, body at a constant rate, axes that differ",
    "With `exp(F*t) = I_6 + t*F + psi_2*F**2 + psi_3*F**3` the integral is a sum over products; "
    "`m_ij` is the integral of the product of the i-th "
    "and the j-th, counted from 0, of the functions 1, `t`, `psi_2`, `psi_3` of `t`. Any `N` and "
    "`K` for each axis.",
    f"derived here; {VAN_LOAN} for the check",
    (MAGNITUDE, *TWICE, *PRODUCTS, Equation("S", "G@T(G)"), Equation("Q", SUM)),
    _check_axes,
    given=PSI,
)


def _library(function, *sizes: int) -> ca.Function:
    symbols = [ca.SX.sym(f"x{i}", size) for i, size in enumerate(sizes)]
    return ca.Function("library", symbols, [ca.densify(function(*symbols))])


DERIVATIONS = (INTEGRALS, TRANSITION, STILL, TURNING, AXES)
