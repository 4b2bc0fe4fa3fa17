"""The process noise Q of a body at a constant rate whose axes have different random walks."""

from __future__ import annotations

import numpy as np

from pyimu.derivations.independent import in_standard_deviations
from pyimu.derivations.model import Check, Derivation, Equation, call, library
from pyimu.derivations.process_noise.integrals import MAGNITUDE, PSI
from pyimu.derivations.process_noise.random_walk import by_casadi
from pyimu.derivations.process_noise.transition import ROUNDING, by_van_loan, cases, system
from pyimu.derivations.sources import VAN_LOAN
from pyimu.symbolic import process_noise as noise
from pyimu.symbolic.van_loan import van_loan

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
    printed, derived = d.function(("Q",), ("F", "G", "omega", "h")), by_casadi(still=False)
    package = library(noise.turning_process_noise, 3, 3, 3, 1, 1)
    rng, exact, integrated, same, slow = np.random.default_rng(15), [], [], [], []
    for rate, h, share in cases(rng):
        n, k = rng.uniform(0.1, 1, (2, 3))
        f, density = system(rate, n, k, share)
        ours = call(printed, f, np.sqrt(density), rate, h)[0]
        exact.append(in_standard_deviations(ours, van_loan(f, density, h)))
        integrated.append(in_standard_deviations(call(derived, rate, n, k, h, share)[0], ours))
        same.append(in_standard_deviations(call(package, rate, n, k, h, share)[0], ours))
        slower = rate * 10.0 ** rng.uniform(-12, -1)
        reference = by_van_loan(slower, n, k, h, share)
        slow.append(in_standard_deviations(call(package, slower, n, k, h, share)[0], reference))
    return [
        Check.of_covariances(
            "casadi's integral from `F`, `G` and `h`, as a series", integrated, ROUNDING
        ),
        Check.of_covariances(
            "Van Loan's method, random `omega`, `N`, `K` of each axis, `h`, `a`, `f`",
            exact,
            ROUNDING,
        ),
        Check.of_covariances("noise.turning_process_noise of the package", same, ROUNDING),
        Check.of_covariances(
            "the same against Van Loan's method, `w*h` down to 1e-13", slow, ROUNDING
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
