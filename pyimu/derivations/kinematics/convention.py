"""The paper's convention for quaternions, vector part first."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.derivations.cases import rotations, vectors
from pyimu.derivations.independent import scalar_first
from pyimu.derivations.kinematics.quaternions import CLOSED_STEP, ROUNDING, TURN
from pyimu.derivations.model import Check, Derivation, Equation, call
from pyimu.derivations.sources import HIDALGO


def _check_convention(d: Derivation) -> list[Check]:
    permuted = d.function(("q_H", "A", "Omega_H", "qH_next", "P_H"), ("q_s", "q_v", "omega", "h"))
    attitude = d.function(("A",), ("q_s", "q_v"))
    ours = CLOSED_STEP.function(("Omega",), ("omega", "h"))
    rng, matrices, steps, orders = np.random.default_rng(3), [], [], []
    for r, rate in zip(rotations(rng), vectors(rng, 1e-2, 30.0)):
        h, q = rng.uniform(1e-3, 0.1), scalar_first(r)
        q_paper, a, omega_paper, after, p = call(permuted, q[0], q[1:], rate, h)
        step = call(ours, rate, h)[0]
        matrices += [(a, r.as_matrix().T), (q_paper, p @ q)]
        steps += [(omega_paper, p @ step @ p.T), (after, p @ step @ q)]
        turn = scalar_first(Rotation.from_rotvec(rate * h))
        turned = call(attitude, turn[0], turn[1:])[0] @ a
        orders.append((call(attitude, after[3], after[:3])[0], turned))
    return [
        Check.of_pairs(
            "the transpose of scipy's matrix `R_nb`: `A` turns the world's axes into the body's",
            matrices,
            ROUNDING,
            each=2,
        ),
        Check.of_pairs(
            "`Omega` and `q` of the package with rows and columns permuted by `P_H`: the same four "
            "numbers",
            steps,
            ROUNDING,
            each=2,
        ),
        Check.of_pairs(
            "the product of the attitude matrices, that of the turn times that before it, the "
            "order of Lefferts and Markley",
            orders,
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
