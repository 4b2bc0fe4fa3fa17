"""Generalised Rodrigues parameters and their inverse."""

from __future__ import annotations

import casadi as ca
import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.derivations.cases import vectors
from pyimu.derivations.independent import scalar_first
from pyimu.derivations.kinematics.quaternions import ROUNDING
from pyimu.derivations.model import Check, Derivation, Equation, call, library
from pyimu.derivations.sources import CRASSIDIS, HIDALGO
from pyimu.symbolic import mrp, quaternion

SHARE = Equation("s", "f/(2*(a + 1))")
FROM_MRP = Equation(
    "q_s", "(f*sqrt(f**2 + (1 - a**2)*T(p)@p) - a*T(p)@p)/(f**2 + T(p)@p)", "the inverse"
)


def _check_mrp(d: Derivation) -> list[Check]:
    forward = d.function(("p",), ("q_s", "q_v", "a", "f"))
    inverse = d.function(("q_s", "q_v"), ("p", "a", "f"))
    package, inverted = library(mrp.from_quaternion, 4, 1, 1), library(mrp.to_quaternion, 3, 1, 1)
    rng, scalings, standard, back, same = np.random.default_rng(4), [], [], [], []
    for v in vectors(rng, 1e-6, 3.0):
        q, a, f = scalar_first(Rotation.from_rotvec(v)), rng.uniform(0, 1), rng.uniform(0.5, 4)
        standard.append((call(forward, q[0], q[1:], 1, 1)[0], Rotation.from_rotvec(v).as_mrp()))
        p = call(forward, q[0], q[1:], a, f)[0]
        returned = np.hstack(call(inverse, p, a, f))
        back.append((returned, q))
        same += [(p, call(package, q, a, f)[0]), (returned, call(inverted, p, a, f)[0])]
        scalings.append((a, f))
    return [
        Check.of_pairs("scipy's modified Rodrigues parameters, at `f = a = 1`", standard, ROUNDING),
        Check.of_pairs("there and back at random `a` and `f`: the quaternion", back, ROUNDING),
        _check_slopes(d, scalings),
        Check.of_pairs(
            "mrp.from_quaternion and mrp.to_quaternion, which the filter computes with",
            same,
            ROUNDING,
            each=2,
        ),
    ]


def _check_slopes(d: Derivation, scalings: list[tuple[float, float]]) -> Check:
    share, slopes = d.function(("s",), ("a", "f")), []
    for a, f in scalings:
        slope, curvature = _at_zero(a, f)
        s = call(share, a, f)[0]
        slopes += [
            (slope, s * np.eye(3)),
            (curvature, np.zeros_like(curvature)),
            (mrp.share(a, f), s),
        ]
    return Check.of_pairs(
        "casadi's derivatives at zero: slope `s`, no curvature, so that `p = s*r` to second order",
        slopes,
        ROUNDING,
        each=3,
    )


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
