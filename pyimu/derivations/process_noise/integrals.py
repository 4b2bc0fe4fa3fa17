"""The integrals of sine and cosine that a turn brings into the process noise."""

from __future__ import annotations

from collections.abc import Iterator
from math import factorial

import casadi as ca
import numpy as np

from pyimu.derivations.cases import rounds
from pyimu.derivations.independent import largest
from pyimu.derivations.model import EPS, Check, Derivation, Equation, call, library
from pyimu.symbolic import process_noise as noise

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
ORDERS = range(1, len(PSI) + 1)

ROUNDING = 100 * EPS
"""At w h = 2 the closed form of psi_7, 0.022, is the difference of terms of size (w h)^5/120 and
smaller; each rounds once or twice."""


def _check_psi(d: Derivation) -> list[Check]:
    closed, series = d.function(tuple(e.left for e in PSI), ("w", "h")), d.equations[-1].formula
    package = library(lambda w, h: ca.vertcat(*[noise.psi(k, w * w, h) for k in ORDERS]), 1, 1)
    integrals, same, small, edge = [], [], [], []
    for w, h, tiny in _cases():
        scale = np.array([h**k / factorial(k) for k in ORDERS])
        ours = np.array(call(closed, w, h)) / scale
        integrals.append((ours, _integrals(w, h) / scale))
        same.append((ours, call(package, w, h)[0] / scale))
        near_zero = _integrals(tiny, h) / scale
        at = {"w": ca.DM(tiny), "h": ca.DM(h)}
        printed = [float(series.evaluate({"k": k} | at)) for k in ORDERS]
        small += [(call(package, tiny, h)[0] / scale, near_zero), (printed / scale, near_zero)]
        below, above = (call(package, (2 + e) / h, h)[0] / scale for e in (-1e-15, 1e-15))
        edge.append((below, above))
    return [
        _check("the `k`-fold integral of `cos(w*t)` by Gauss's quadrature", integrals),
        _check("noise.psi of the package", same),
        _check(
            "the series, as printed and of the package, by quadrature, `w*h` down to 1e-9", small
        ),
        _check("both sides of where the series takes over", edge),
    ]


def _cases() -> Iterator[tuple[float, float, float]]:
    """A rate and a period, and a rate near zero."""
    rng = np.random.default_rng(10)
    for _ in rounds(10):
        w, h = rng.uniform(4, 8), rng.uniform(0.5, 1)
        yield w, h, w * 10.0 ** rng.uniform(-9, -1)


def _check(against: str, pairs: list[tuple]) -> Check:
    return Check(against, len(rounds(10)), largest(pairs), ROUNDING, "largest relative difference")


def _integrals(w: float, h: float) -> np.ndarray:
    """The k-fold integrals (7,) of cos(w t) from 0 to h, by Cauchy's formula."""
    t, weights = np.polynomial.legendre.leggauss(40)
    t = h * (t + 1) / 2
    return np.array(
        [h / 2 * weights @ ((h - t) ** (k - 1) / factorial(k - 1) * np.cos(w * t)) for k in ORDERS]
    )


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
