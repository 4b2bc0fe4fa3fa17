"""The process noise Q where the bias is a sum of Gauss-Markov processes: the flicker model."""

from __future__ import annotations

import casadi as ca
import numpy as np

from pyimu.derivations.cases import vectors
from pyimu.derivations.independent import in_standard_deviations
from pyimu.derivations.model import Check, Derivation, Equation, Table, call, library
from pyimu.derivations.process_noise.gauss_markov import CLOSED, by_van_loan, series_of, step_of
from pyimu.derivations.process_noise.transition import ROUNDING
from pyimu.derivations.sources import VAN_LOAN
from pyimu.symbolic import process_noise as noise

BAND = (1e-5, 1.0)
"""Hz; between the slowest and the fastest of the catalogue's processes."""

RIPPLE = 0.3
"""dB; by which the density of processes a decade apart may differ from a straight line: their own
ripple, and the ends of the band."""


def _check_flicker(d: Derivation) -> list[Check]:
    printed = d.function(("Q",), ("N", "g_1", "tau_1", "g_2", "tau_2", "h", "s"))
    package, series, exact, same, turned = _library(2), series_of(2), [], [], []
    for rate, h, share, n, (first, second) in _drawn():
        axis = [v[0] for v in (n, *first, *second)]
        arguments = (n, *first, *second, h, share)
        whole = by_van_loan(np.zeros(3), n, [first, second], h, share)
        ours = call(printed, *axis, h, share)[0]
        exact.append(in_standard_deviations(ours, whole[::3, ::3]))
        same.append(in_standard_deviations(call(package, *arguments)[0], whole))
        reference = by_van_loan(rate, n, [first, second], h, share)
        turned.append(in_standard_deviations(call(series, rate, *arguments)[0], reference))
    return [
        Check.of_covariances(
            "Van Loan's method, one axis, random `N`, `g_i`, `tau_i`, `h`, `s`", exact, CLOSED
        ),
        Check.of_covariances(
            "noise.flicker_process_noise of the package against Van Loan's method, three axes that "
            "differ",
            same,
            ROUNDING,
        ),
        Check.of_covariances(
            "noise.discretised against Van Loan's method for a body at a constant rate",
            turned,
            ROUNDING,
        ),
        *_check_catalogue(),
    ]


def _drawn() -> list[tuple]:
    """Rates (3,), periods, shares, N (3,), and g and tau (3,) of two processes."""
    rng, drawn = np.random.default_rng(23), []
    for rate in vectors(rng, 1e-3, 3):
        h, share = rng.uniform(0.1, 1), rng.uniform(0.2, 1.5)
        n, g_1, g_2 = rng.uniform(0.1, 1, (3, 3))
        tau_1, tau_2 = h * 10.0 ** rng.uniform(0, 1, (2, 3))
        drawn.append((rate, h, share, n, ((g_1, tau_1), (g_2, tau_2))))
    return drawn


def _library(processes: int) -> ca.Function:
    """The package's Q from N, g and tau of each process, (3,) each, h and s."""

    def flicker(n, *flat):
        *pairs, h, share = flat
        processes = list(zip(pairs[::2], pairs[1::2], strict=True))
        return noise.flicker_process_noise(n, processes, h, share)

    return library(flicker, 3, *[3, 3] * processes, 1, 1)


# The catalogue's model


def _check_catalogue() -> list[Check]:
    processes, h, f = _catalogue(), 1e-2, np.geomspace(*BAND, 400)
    three = [([g] * 3, [tau] * 3) for g, tau in processes]
    flat = [v for pair in three for v in pair]
    ours = call(_library(len(three)), [0.1] * 3, *flat, h, 1.0)[0]
    reference = by_van_loan(np.zeros(3), [0.1] * 3, three, h, 1.0)
    return [
        Check.of_covariances(
            f"noise.flicker_process_noise with the catalogue's {len(processes)} processes of "
            "bias_instability, `h` = 10 ms",
            [in_standard_deviations(ours, reference)],
            ROUNDING,
        ),
        Check(
            f"`B**2/(2*pi*nu)`: density of the sum of those processes, {BAND[0]:g} to {BAND[1]:g} "
            "Hz",
            len(f),
            float(np.max(np.abs(_decibel(processes, f)))),
            RIPPLE,
            "largest difference in dB",
        ),
    ]


def _catalogue() -> list[tuple[float, float]]:
    """g (for B = 1) and tau in s of each process of the catalogue's ``bias_instability``.

    They are taken from its step.
    """
    h, out = 1e-2, []
    for kept, fresh in step_of(
        "bias_instability", {"B": 1.0, "f_low": BAND[0], "f_high": BAND[1]}, h
    ):
        tau = -h / np.log(kept)
        out.append((fresh / np.sqrt(-tau / 2 * np.expm1(-2 * h / tau)), tau))
    return out


def _decibel(processes: list[tuple[float, float]], f: np.ndarray) -> np.ndarray:
    """Two-sided density of the sum of processes against 1/(2 pi f), in dB."""
    density = sum((g * tau) ** 2 / (1 + (2 * np.pi * f * tau) ** 2) for g, tau in processes)
    return 10 * np.log10(density * 2 * np.pi * f)


def _tables(d: Derivation) -> list[Table]:
    rows = tuple(
        (str(i + 1), f"{tau:.4g}", f"{g:.4g}", f"{g * np.sqrt(tau / 2):.4g}")
        for i, (g, tau) in enumerate(_catalogue())
    )
    return [
        Table(
            f"The catalogue's flicker model, {BAND[0]:g} to {BAND[1]:g} Hz, for B = 1",
            ("process", "tau [s]", "g/B [1/sqrt(s)]", "standard deviation/B"),
            rows,
        )
    ]


def _process(i: int) -> tuple[Equation, ...]:
    e, g, tau = f"E_{i}", f"g_{i}", f"tau_{i}"
    return (
        Equation(e, f"exp(-(h/{tau}))"),
        Equation(f"v_{i}", f"{g}**2*{tau}**2*(h - 2*{tau}*(1 - {e}) + {tau}*(1 - {e}**2)/2)"),
        Equation(f"c_{i}", f"{g}**2*{tau}**2*(1 - {e})**2/2"),
        Equation(f"d_{i}", f"{g}**2*{tau}*(1 - {e}**2)/2"),
    )


FLICKER = Derivation(
    "process_noise_flicker",
    "Discrete process noise, flicker: a sum of Gauss-Markov processes",
    "Flicker noise `B`, of two-sided density `B**2/(2*pi*nu)` at the frequency `nu`, is modelled "
    "as the sum of independent Gauss-Markov processes, one or more a decade, each "
    "a state of its own. One axis of `p`, `b_1`, `b_2` for a body that does not turn; each further "
    "process adds its `v_i`, `c_i` and `d_i` in the same way. "
    "For a body that turns the package computes the series in `F`, `G` and `h` "
    "(noise.discretised).",
    f"derived here; {VAN_LOAN} for the check; the flicker model: IEEE Std 952-2020, bias "
    "instability",
    (
        *_process(1),
        *_process(2),
        Equation(
            "Q",
            "blocks([s**2*(N**2*h + v_1 + v_2), -s*c_1, -s*c_2], [-s*c_1, d_1, 0], [-s*c_2, 0, "
            "d_2])",
        ),
    ),
    _check_flicker,
    tables=_tables,
)
