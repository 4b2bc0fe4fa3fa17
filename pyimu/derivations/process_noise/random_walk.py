"""The process noise Q where the bias is a random walk: the body at rest, and at a constant rate."""

from __future__ import annotations

import casadi as ca
import numpy as np

from pyimu.derivations.independent import in_standard_deviations
from pyimu.derivations.model import Check, Derivation, Equation, call, library
from pyimu.derivations.process_noise.integrals import MAGNITUDE, PSI
from pyimu.derivations.process_noise.transition import CROSS, ROUNDING, by_van_loan, cases
from pyimu.derivations.sources import CRASSIDIS, HIDALGO, VAN_LOAN
from pyimu.symbolic import process_noise as noise

INTEGRAL = (
    "`Q` is the integral of `exp(F*t)@G@T(G)@T(exp(F*t))` from 0 to `h`, with `F` and `G` of the "
    "attitude error."
)

Q = Equation("Q", "blocks([Q_pp, Q_pb], [T(Q_pb), Q_bb])")


# Without rotation


def _check_still(d: Derivation) -> list[Check]:
    printed = d.function(("Q",), ("S_N", "S_K", "h", "s"))
    derived, package = by_casadi(still=True), library(noise.process_noise, 3, 3, 1)
    rng, exact, integrated, same = np.random.default_rng(12), [], [], []
    for _, h, share in cases(rng):
        n, k = rng.uniform(0.1, 1, (2, 3))
        squares, zero = (np.diag(n**2), np.diag(k**2)), np.zeros(3)
        ours = call(printed, *squares, h, share)[0]
        exact.append(in_standard_deviations(ours, by_van_loan(zero, n, k, h, share)))
        integrated.append(in_standard_deviations(ours, call(derived, zero, n, k, h, share)[0]))
        unscaled = call(printed, *squares, h, 1.0)[0]
        same.append(in_standard_deviations(call(package, n, k, h)[0], unscaled))
    return [
        Check.of_covariances(
            "casadi's integral from `F`, `G` and `h`: `F**2 = 0`, so its series ends by itself",
            integrated,
            ROUNDING,
        ),
        Check.of_covariances(
            "Van Loan's method, scipy's matrix exponential, random `N`, `K`, `h`, `a`, `f`",
            exact,
            ROUNDING,
        ),
        Check.of_covariances(
            "noise.process_noise, which the filter computes with (`s = 1`)", same, ROUNDING
        ),
    ]


def by_casadi(still: bool) -> ca.Function:
    """Q from rate, N, K (3,) each, h and s by casadi alone.

    The integral is taken term by term in powers of F; its sum is Q' = F Q + Q F^T + G G^T.
    """

    def integral(rate, n, k, h, share):
        rate = ca.SX(3, 1) if still else rate
        f, g = noise.error_system(rate, n, [(k, ca.SX(3, 1))], share)
        return noise.discretised(f, g @ g.T, h, 0 if still else 3)[1]

    return library(integral, 3, 3, 3, 1, 1)


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


# At a constant rate, equal axes


def _check_turning(d: Derivation) -> list[Check]:
    printed, derived = d.function(("Q",), ("omega", "N", "K", "h", "s")), by_casadi(still=False)
    package = library(noise.turning_process_noise, 3, 3, 3, 1, 1)
    drawn, exact, integrated, same = _drawn(), [], [], []
    for (rate, h, share), n, k, _ in drawn:
        ours, axes = call(printed, rate, n, k, h, share)[0], ([n] * 3, [k] * 3)
        exact.append(in_standard_deviations(ours, by_van_loan(rate, *axes, h, share)))
        integrated.append(in_standard_deviations(call(derived, rate, *axes, h, share)[0], ours))
        same.append(in_standard_deviations(call(package, rate, *axes, h, share)[0], ours))
    return [
        Check.of_covariances(
            "casadi's integral from `F`, `G` and `h`, as a series", integrated, ROUNDING
        ),
        _check_equation(d),
        Check.of_covariances(
            "Van Loan's method, random `omega`, `N`, `K`, `h`, `a`, `f`", exact, ROUNDING
        ),
        Check.of_covariances("noise.turning_process_noise of the package", same, ROUNDING),
        *_check_slow(package, drawn),
    ]


def _drawn() -> list[tuple]:
    """Cases, each with N and K of all axes, and a factor by which its turn is slower."""
    rng = np.random.default_rng(13)
    return [(case, *rng.uniform(0.1, 1, 2), 10.0 ** rng.uniform(-12, -1)) for case in cases(rng)]


def _check_equation(d: Derivation) -> Check:
    """|Q' - F Q - Q F^T - G G^T| in standard deviations of Q over h, with casadi's derivative."""
    rate, n, k, h, share = ca.SX.sym("rate", 3), *(ca.SX.sym(name) for name in ("n", "k", "h", "s"))
    q = d.function(("Q",), ("omega", "N", "K", "h", "s"))(rate, n, k, h, share)
    f, g = noise.error_system(rate, ca.repmat(n, 3), [(ca.repmat(k, 3), ca.SX(3, 1))], share)
    slope = ca.reshape(ca.jacobian(ca.vec(q), h), 6, 6)
    both = ca.Function(
        "both",
        [rate, n, k, h, share],
        [ca.densify(slope * h), ca.densify((f @ q + q @ f.T + g @ g.T) * h), q],
    )
    rng, residuals = np.random.default_rng(14), []
    for w, period, s in cases(rng):
        left, right, covariance = call(both, w, *rng.uniform(0.1, 1, 2), period, s)
        std = np.sqrt(np.diag(covariance))
        residuals.append(float(np.max(np.abs(left - right) / np.outer(std, std))))
    return Check.of_covariances(
        "the differential equation `Q_dot = F@Q + Q@T(F) + G@T(G)`, by casadi's derivative of "
        "the printed form by `h`",
        residuals,
        ROUNDING,
    )


def _check_slow(package: ca.Function, drawn: list[tuple]) -> list[Check]:
    """The package near and at no rotation, where the printed form has no digits left."""
    still, slow, zero = STILL.function(("Q",), ("S_N", "S_K", "h", "s")), [], []
    for (rate, h, share), n, k, factor in drawn:
        slower, axes = rate * factor, ([n] * 3, [k] * 3)
        reference = by_van_loan(slower, *axes, h, share)
        slow.append(in_standard_deviations(call(package, slower, *axes, h, share)[0], reference))
        at_rest = call(still, np.eye(3) * n**2, np.eye(3) * k**2, h, share)[0]
        found = call(package, np.zeros(3), *axes, h, share)[0]
        zero.append(in_standard_deviations(found, at_rest))
    return [
        Check.of_covariances(
            "the same against Van Loan's method where `w*h` goes down to 1e-13 and the series "
            "stand in",
            slow,
            ROUNDING,
        ),
        Check.of_covariances(
            "the same at `omega = 0` against the form for a body that does not turn", zero, ROUNDING
        ),
    ]


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
