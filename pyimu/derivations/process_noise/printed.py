"""The process noise as Hidalgo 2012 prints it, term by term beside the derived one."""

from __future__ import annotations

import casadi as ca
import numpy as np

from pyimu.derivations.cases import rounds, vectors
from pyimu.derivations.independent import in_standard_deviations
from pyimu.derivations.model import Check, Derivation, Equation, Table, call
from pyimu.derivations.process_noise.random_walk import STILL, Q
from pyimu.derivations.process_noise.transition import ROUNDING, by_van_loan
from pyimu.derivations.sources import HIDALGO
from pyimu.model.part_file import part
from pyimu.symbolic import mrp
from pyimu.symbolic import process_noise as noise

DEGREE = np.pi / 180
BLOCKS = ("angle, angle", "angle, bias", "bias, bias")
CORNERS = ((0, 0), (0, 3), (3, 3))
"""Where the three blocks of a matrix (6, 6) begin."""

SCALINGS = {"`f = 2*(a + 1)`": mrp.share(1.0, 4.0), "`f = a = 1`": mrp.share(1.0, 1.0)}
"""The two scalings of the Rodrigues parameters, by how s comes out."""


def _check(d: Derivation) -> list[Check]:
    printed = d.function(("Q",), ("N", "K", "h"))
    rng, minus, scaled, plus = np.random.default_rng(30), [], [], []
    small = np.diag([SCALINGS["`f = a = 1`"]] * 3 + [1.0] * 3)
    for _ in rounds():
        n, k, h = rng.uniform(0.1, 1, 3)
        ours = call(printed, n, k, h)[0]
        radians, quarters = (
            by_van_loan(np.zeros(3), [n] * 3, [k] * 3, h, s) for s in SCALINGS.values()
        )
        minus.append(in_standard_deviations(ours, radians))
        scaled.append(in_standard_deviations(small @ ours @ small, quarters))
        # With the other sign the two differ by twice the correlation of angle and bias.
        difference = in_standard_deviations(_other_sign(ours), radians)
        plus.append(abs(difference - 2 * abs(_correlation(radians))))
    return [
        Check.of_covariances(
            "with minus signs off the diagonal, in rad (`f = 2*(a + 1)`): Van Loan's method",
            minus,
            ROUNDING,
        ),
        Check.of_covariances(
            "the same with 1/16 and 1/4 put in, for `f = a = 1`: Van Loan's method",
            scaled,
            ROUNDING,
        ),
        Check.of_covariances(
            "with plus signs: wrong by twice the correlation of angle and bias, no more and no "
            "less",
            plus,
            ROUNDING,
        ),
    ]


def _other_sign(q: np.ndarray) -> np.ndarray:
    """Q (6, 6) with the other sign off the diagonal."""
    out = q.copy()
    out[:3, 3:] *= -1
    out[3:, :3] *= -1
    return out


def _correlation(q: np.ndarray) -> float:
    """Of angle and bias about the first axis."""
    return q[0, 3] / np.sqrt(q[0, 0] * q[3, 3])


def _tables(d: Derivation) -> list[Table]:
    return [_term_by_term(d), _wrong_sign(d), _turning()]


def _term_by_term(d: Derivation) -> Table:
    """Each block of the printed matrix divided by the derived one; the same at any N, K and h."""
    printed, derived = (
        d.function(("Q",), ("N", "K", "h")),
        STILL.function(("Q",), ("S_N", "S_K", "h", "s")),
    )
    n, k, h, rows = 0.2, 0.3, 0.7, []
    terms = ("`N**2*h + K**2*h**3/3`", "`-(K**2*h**2/2)`", "`K**2*h`")
    for name, term, (i, j) in zip(BLOCKS, terms, CORNERS, strict=True):
        ours = call(printed, n, k, h)[0][i, j]
        ratios = [
            call(derived, np.eye(3) * n**2, np.eye(3) * k**2, h, s)[0][i, j] / ours
            for s in SCALINGS.values()
        ]
        rows.append((name, term, *[_fraction(r) for r in ratios]))
    return Table(
        "Derived divided by printed, term by term",
        ("block", "printed (with the minus)", *[f"derived at {s}" for s in SCALINGS]),
        tuple(rows),
    )


def _fraction(ratio: float) -> str:
    """1, 1/4 or 1/16, else the number itself."""
    inverse = round(1 / ratio)
    if abs(inverse * ratio - 1) >= 1e-12:
        return f"{ratio:.6g}"
    return "1" if inverse == 1 else f"1/{inverse}"


def _wrong_sign(d: Derivation) -> Table:
    """The correlation of angle and bias with either sign, beside Van Loan's."""
    printed, rows = d.function(("Q",), ("N", "K", "h")), []
    for n, k, h, where in (
        (0.2, 0.3, 0.7, "N = 0.2, K = 0.3, h = 0.7 s"),
        (*_imt30(), 1 / 976, "IMT30 about z, h = 1/976 s"),
        (*_imt30(), 60.0, "IMT30 about z, h = 60 s"),
    ):
        right = _correlation(by_van_loan(np.zeros(3), [n] * 3, [k] * 3, h, 1.0))
        ours = _correlation(call(printed, n, k, h)[0])
        rows.append((where, f"{right:.4g}", f"{ours:.4g}", f"{-ours:.4g}"))
    return Table(
        "Correlation of angle and bias that one period adds",
        ("case", "Van Loan", "printed with minus", "printed with plus"),
        tuple(rows),
    )


def _turning() -> Table:
    """What the printed matrix leaves out where the body turns."""
    rows = []
    for n, k, h, w, where in (
        (0.2, 0.3, 0.7, 1.0, "N = 0.2, K = 0.3, h = 0.7 s, 1 rad/s"),
        (*_imt30(), 1 / 976, 0.02, "IMT30 about z, h = 1/976 s, 0.02 rad/s (turn on spot)"),
        (*_imt30(), 1 / 976, 140 * DEGREE, "IMT30 about z, h = 1/976 s, 140 deg/s"),
        (*_imt30(), 1.0, 140 * DEGREE, "IMT30 about z, h = 1 s, 140 deg/s"),
    ):
        worst, relative, columns = [], [], [ca.DM([v] * 3) for v in (n, k)]
        still = np.array(noise.process_noise(*columns, h))
        for rate in vectors(np.random.default_rng(31), w, w * (1 + 1e-12), 50):
            exact = np.array(noise.turning_process_noise(ca.DM(rate), *columns, h))
            worst.append(np.abs(exact - still).max())
            relative.append(in_standard_deviations(still, exact))
        rows.append((where, f"{max(worst):.2g}", f"{max(relative):.2g}"))
    return Table(
        "What the form without rotation leaves out at a constant rate, largest of 50 directions",
        ("case", "largest element [SI]", "in standard deviations"),
        tuple(rows),
    )


def _imt30() -> tuple[float, float]:
    """N and K of the paper's gyro about z, SI, from the part that declares its tables 2 and 4."""
    gyro = part("imt30").gyro.values
    return float(gyro["angle_random_walk"]["N"][2]), float(gyro["rate_random_walk"]["K"][2])


PRINTED = Derivation(
    "hidalgo_process_noise",
    "The paper's printed process noise, term by term",
    "The paper's process noise, equal axes, with the sign that is right. The text of the paper "
    "that was read has lost its minus signs, so which "
    "sign was printed off the diagonal is not settled here; that it must be minus is: the bias is "
    "subtracted from the rate. The printed matrix holds "
    "for `p` in rad, `f = 2*(a + 1)`. For `f = a = 1`, which the paper names beside it, `p` is a "
    "quarter of the angle: the angle's block is 1/16 of the "
    "printed, the other off the diagonal 1/4. And it holds for a body that does not turn.",
    f"{HIDALGO}, section 4.2, Q_k, after Crassidis and Markley 2003, eq. 27",
    (
        Equation("Q_pp", "(N**2*h + K**2*h**3/3)*I_3"),
        Equation("Q_pb", "-(K**2*h**2/2*I_3)"),
        Equation("Q_bb", "K**2*h*I_3"),
        Q,
    ),
    _check,
    tables=_tables,
)
