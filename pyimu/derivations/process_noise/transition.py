"""The transition matrix of attitude error and gyro bias where the bias is a random walk."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import casadi as ca
import numpy as np
from scipy.linalg import expm

from pyimu.derivations.cases import vectors
from pyimu.derivations.model import EPS, Check, Derivation, Equation, call
from pyimu.derivations.process_noise.integrals import MAGNITUDE, PSI
from pyimu.derivations.sources import CRASSIDIS
from pyimu.symbolic import process_noise as noise
from pyimu.symbolic.van_loan import van_loan

ROUNDING = 1000 * EPS
"""Van Loan's matrix exponential squares and multiplies matrices of size 12 a few times; its entries
reach a hundred."""

SLOWEST, FASTEST = 0.5, 3.0
"""rad/s; rates of the random cases, whose periods are 0.3 to 1 s."""


class Case(NamedTuple):
    """A rate (3,) rad/s, a period in s, and the share of the Rodrigues parameters."""

    rate: np.ndarray
    h: float
    share: float


def cases(rng: np.random.Generator) -> Iterator[Case]:
    """Rates, periods and shares (f and a at random).

    The printed closed forms lose about 3/(w h)^2 roundings; below the turns drawn here the package
    takes the series.
    """
    for rate in vectors(rng, SLOWEST, FASTEST):
        a, f = rng.uniform(0, 1), rng.uniform(0.5, 4)
        yield Case(rate, rng.uniform(0.3, 1), f / (2 * (a + 1)))


def system(rate, n, k, share) -> tuple[np.ndarray, np.ndarray]:
    """F and G G^T as arrays where the bias is a random walk; ``rate``, ``n`` and ``k`` are (3,)."""
    f, g = noise.error_system(ca.DM(rate), ca.DM(n), [(ca.DM(k), ca.DM.zeros(3))], share)
    return np.array(f), np.array(g @ g.T)


def by_van_loan(rate, n, k, h, share) -> np.ndarray:
    """Q (6, 6) of that system."""
    return van_loan(*system(rate, n, k, share), h)


CROSS = Equation("W", "skew(omega)", "the matrix of the cross product with `omega`")
PP, PB = (
    Equation(
        "Phi_pp", "I_3 - psi_1*W + psi_2*W**2", "`= exp(-W*h)`, the turn of the body backwards"
    ),
    Equation("Phi_pb", "-s*(h*I_3 - psi_2*W + psi_3*W**2)"),
)


def _check_transition(d: Derivation) -> list[Check]:
    printed = d.function(("Phi",), ("omega", "h", "s"))
    pairs, general = [], []
    for rate, h, share in cases(np.random.default_rng(11)):
        f, _ = system(rate, np.ones(3), np.ones(3), share)
        pairs.append((call(printed, rate, h, share)[0], expm(f * h)))
        general.append((np.array(noise.turning_transition(ca.DM(f), rate @ rate, h)), expm(f * h)))
    return [
        Check.of_pairs("the matrix exponential of `F*h` by scipy", pairs, ROUNDING),
        Check.of_pairs(
            "noise.turning_transition, `I_6 + h*F + psi_2*F**2 + psi_3*F**3`", general, ROUNDING
        ),
    ]


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
