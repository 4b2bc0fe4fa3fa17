"""The discrete process noise Q where the bias is a Gauss-Markov process, or a sum of them: the
flicker model.
"""

from __future__ import annotations

import casadi as ca
import numpy as np

from pyimu.derivations.independent import in_standard_deviations, van_loan, vectors
from pyimu.derivations.kinematics import CASES
from pyimu.derivations.model import EPS, Check, Derivation, Equation, Table, call
from pyimu.derivations.walk import (
    CROSS,
    INTEGRAL,
    MAGNITUDE,
    OF_COVARIANCE,
    ROUNDING,
    STILL,
    VAN_LOAN,
    Q,
)
from pyimu.model.sensor import Sensor
from pyimu.symbolic import process_noise as noise

CLOSED = 1e4 * EPS
"""Bound for closed forms where h/tau is a tenth and more: the angle's variance is what is left,
(h/tau)^3/3 at least, of terms of size h/tau."""

LIMIT = 1e-9
"""h/tau at which a Gauss-Markov process counts as a random walk; the first term that differs is of
that size."""


# One process, no rotation


def _check_markov(d: Derivation) -> list[Check]:
    printed = d.function(("Q",), ("N", "g", "tau", "h", "s"))
    library, still = _library(), STILL.function(("Q",), ("S_N", "S_K", "h", "s"))
    rng, exact, same, axes, walk = np.random.default_rng(20), [], [], [], []
    for _ in range(CASES):
        h, share, (n, g) = rng.uniform(0.1, 1), rng.uniform(0.2, 1.5), rng.uniform(0.1, 1, (2, 3))
        tau = h * 10.0 ** rng.uniform(0, 1, 3)
        ours = call(printed, n[0], g[0], tau[0], h, share)[0]
        exact.append(
            in_standard_deviations(
                ours, _van_loan(np.zeros(3), [n[0]] * 3, [([g[0]] * 3, [tau[0]] * 3)], h, share)
            )
        )
        same.append(
            in_standard_deviations(
                call(library, [n[0]] * 3, [g[0]] * 3, [tau[0]] * 3, h, share)[0], ours
            )
        )
        slow = h * 10.0 ** rng.uniform(0, 8, 3)
        axes.append(
            in_standard_deviations(
                call(library, n, g, slow, h, share)[0],
                _van_loan(np.zeros(3), n, [(g, slow)], h, share),
            )
        )
        frozen = call(library, n, g, [h / LIMIT] * 3, h, share)[0]
        walk.append(
            in_standard_deviations(frozen, call(still, np.diag(n**2), np.diag(g**2), h, share)[0])
        )
    return [
        Check(
            "Van Loan's method, random `N`, `g`, `tau`, `h`, `s`",
            CASES,
            max(exact),
            CLOSED,
            OF_COVARIANCE,
        ),
        Check(
            "noise.gauss_markov_process_noise of the package",
            CASES,
            max(same),
            CLOSED,
            OF_COVARIANCE,
        ),
        Check(
            "the same against Van Loan's method, axes that differ, `tau` up to 1e8 periods, where "
            "the series stand in",
            CASES,
            max(axes),
            ROUNDING,
            OF_COVARIANCE,
        ),
        Check(
            "the same at `tau = 10**9*h` against the random walk",
            CASES,
            max(walk),
            2 * LIMIT,
            OF_COVARIANCE,
        ),
        Check(
            "one step of the catalogue's effect gauss_markov: its decay, and the variance it adds "
            "to the bias",
            CASES // 10,
            _step(d),
            ROUNDING,
            "largest relative difference",
        ),
    ]


def _van_loan(rate, n, processes, h, share) -> np.ndarray:
    f, g = noise.error_system(
        ca.DM(rate), ca.DM(n), [(ca.DM(k), 1 / ca.DM(tau)) for k, tau in processes], share
    )
    return van_loan(np.array(f), np.array(g @ g.T), h)


def _library() -> ca.Function:
    n, g, tau, h, share = (
        ca.SX.sym(name, size) for name, size in (("n", 3), ("g", 3), ("tau", 3), ("h", 1), ("s", 1))
    )
    return ca.Function(
        "library",
        [n, g, tau, h, share],
        [ca.densify(noise.gauss_markov_process_noise(n, g, tau, h, share))],
    )


def _step(d: Derivation) -> float:
    """The catalogue's own discretisation against the printed decay and variance."""
    printed, rng, worst = (
        d.function(("E", "Q_bb"), ("g", "tau", "h")),
        np.random.default_rng(21),
        0.0,
    )
    for _ in range(CASES // 10):
        g, tau, h = rng.uniform(0.1, 1), rng.uniform(1, 10), rng.uniform(0.1, 1)
        ((kept, fresh),) = _processes("gauss_markov", {"q": g, "tau": tau}, h)
        decay, variance = call(printed, g, tau, h)
        worst = max(worst, abs(kept / decay - 1), abs(fresh**2 / variance[0, 0] - 1))
    return worst


def _processes(effect: str, values: dict, h: float) -> list[tuple[float, float]]:
    """Decay over ``h`` s and standard deviation of what a step adds, of each Gauss-Markov process
    of an effect's first axis.
    """
    sensor = Sensor("gyro", {effect: values})
    s, w = sensor.step.sx_in(0), sensor.step.sx_in(3)
    following = sensor.step(s, ca.DM.zeros(sensor.step.size_in(1)), sensor.p, w, h)[0]
    jacobians = ca.Function(
        "jacobians", [s, w], [ca.densify(ca.jacobian(following, by)) for by in (s, w)]
    )
    # All states one: the flag that tells a process has started, too.
    kept, fresh = (np.array(m) for m in jacobians(1, 0))
    fresh = fresh[:, ::3]
    rows = np.flatnonzero(fresh.any(axis=1))
    return [(float(kept[i, i]), float(np.abs(fresh[i]).max())) for i in rows]


DECAY = (Equation("E", "exp(-(h/tau))"),)
MARKOV = Derivation(
    "process_noise_gauss_markov",
    "Discrete process noise, Gauss-Markov bias, body that does not turn",
    "The bias obeys `b_dot = -b/tau + g*eta_K` instead of `b_dot = K*eta_K`; its two-sided "
    "density at the frequency `nu` is "
    f"`(g*tau)**2/(1 + (2*pi*nu*tau)**2)`. {INTEGRAL} "
    "Each axis on its own. For `tau` to infinity it is the random walk with `K = g`. Where `h/tau` "
    "is small the package computes the same by series.",
    f"derived here; {VAN_LOAN} for the check; the process: IEEE Std 952-2020, exponentially "
    "correlated noise",
    (
        *DECAY,
        Equation("Q_pp", "s**2*(N**2*h + g**2*tau**2*(h - 2*tau*(1 - E) + tau*(1 - E**2)/2))*I_3"),
        Equation("Q_pb", "-(s*g**2*tau**2*(1 - E)**2/2*I_3)"),
        Equation("Q_bb", "g**2*tau*(1 - E**2)/2*I_3"),
        Q,
    ),
    _check_markov,
)


# One process, constant rate


def _check_turning(d: Derivation) -> list[Check]:
    printed = d.function(("Q",), ("omega", "N", "g", "tau", "h", "s"))
    series = _series(1)
    rng, exact, same, axes = np.random.default_rng(22), [], [], []
    for rate in vectors(rng, CASES, 0.5, 3):
        h, share, (n, g) = rng.uniform(0.3, 1), rng.uniform(0.2, 1.5), rng.uniform(0.1, 1, (2, 3))
        tau = h * 10.0 ** rng.uniform(0, 1, 3)
        ours = call(printed, rate, n[0], g[0], tau[0], h, share)[0]
        exact.append(
            in_standard_deviations(
                ours, _van_loan(rate, [n[0]] * 3, [([g[0]] * 3, [tau[0]] * 3)], h, share)
            )
        )
        same.append(
            in_standard_deviations(
                call(series, rate, [n[0]] * 3, [g[0]] * 3, [tau[0]] * 3, h, share)[0], ours
            )
        )
        slow, slower = h * 10.0 ** rng.uniform(0, 8, 3), rate * 10.0 ** rng.uniform(-12, 0)
        axes.append(
            in_standard_deviations(
                call(series, slower, n, g, slow, h, share)[0],
                _van_loan(slower, n, [(g, slow)], h, share),
            )
        )
    return [
        Check(
            "Van Loan's method, random `omega`, `N`, `g`, `tau`, `h`, `s`",
            CASES,
            max(exact),
            CLOSED,
            OF_COVARIANCE,
        ),
        Check(
            "noise.discretised of noise.error_system, casadi's series in `F`, `G` and `h`",
            CASES,
            max(same),
            CLOSED,
            OF_COVARIANCE,
        ),
        Check(
            "the same against Van Loan's method, axes that differ, rates down to 1e-12 rad/s, "
            "`tau` up to 1e8 periods",
            CASES,
            max(axes),
            ROUNDING,
            OF_COVARIANCE,
        ),
    ]


def _series(processes: int) -> ca.Function:
    """Q of any constant rate and any number of processes, by casadi from F, G and h."""
    rate, n, h, share = (
        ca.SX.sym(name, size) for name, size in (("rate", 3), ("n", 3), ("h", 1), ("s", 1))
    )
    pairs = [(ca.SX.sym(f"g{i}", 3), ca.SX.sym(f"tau{i}", 3)) for i in range(processes)]
    f, g = noise.error_system(rate, n, [(k, 1 / tau) for k, tau in pairs], share)
    flat = [v for pair in pairs for v in pair]
    return ca.Function(
        "series", [rate, n, *flat, h, share], [ca.densify(noise.discretised(f, g @ g.T, h, 4)[1])]
    )


TURNING_MARKOV = Derivation(
    "process_noise_gauss_markov_turning",
    "Discrete process noise, Gauss-Markov bias, body at a constant rate, equal axes",
    f"{INTEGRAL} Exact where the three axes have the same `N`, `g` and `tau`. Where `w*h` or "
    "`h/tau` is small, and where axes differ, the package "
    "computes it as a series in `F`, `G` and `h` (noise.discretised).",
    f"derived here; {VAN_LOAN} for the check",
    (
        MAGNITUDE,
        CROSS,
        Equation("kappa", "1/tau"),
        Equation("E", "exp(-kappa*h)"),
        Equation("V", "(1 - E**2)/(2*kappa)"),
        Equation(
            "c_w",
            "(kappa - E*(kappa*cos(w*h) - w*sin(w*h)))/(kappa**2 + w**2)",
            "integral of `exp(-kappa*t)*cos(w*t)`",
        ),
        Equation(
            "s_w",
            "(w - E*(w*cos(w*h) + kappa*sin(w*h)))/(kappa**2 + w**2)",
            "integral of `exp(-kappa*t)*sin(w*t)`",
        ),
        Equation("I_0", "(h - 2*(1 - E)/kappa + V)/kappa**2"),
        Equation("I_1", "(h - 2*c_w + V)/(kappa**2 + w**2)"),
        Equation("J_0", "(1 - E)**2/(2*kappa**2)"),
        Equation("J_c", "(kappa*(c_w - V) + w*s_w)/(kappa**2 + w**2)"),
        Equation("J_s", "(w*(c_w - V) - kappa*s_w)/(w*(kappa**2 + w**2))"),
        Equation("Q_pp", "s**2*((N**2*h + g**2*I_0)*I_3 + g**2*(I_0 - I_1)/w**2*W**2)"),
        Equation("Q_pb", "-s*g**2*(J_0*I_3 + J_s*W + (J_0 - J_c)/w**2*W**2)"),
        Equation("Q_bb", "g**2*V*I_3"),
        Q,
    ),
    _check_turning,
)


# Flicker


BAND = (1e-5, 1.0)
"""Hz; between the slowest and the fastest of the catalogue's processes."""

RIPPLE = 0.3
"""dB; by which a sum of processes a decade apart may miss a straight line: their own ripple, and
the ends of the band."""


def _check_flicker(d: Derivation) -> list[Check]:
    printed = d.function(("Q",), ("N", "g_1", "tau_1", "g_2", "tau_2", "h", "s"))
    two, turning = _flicker_library(2), _series(2)
    rng, exact, same, turned = np.random.default_rng(23), [], [], []
    for rate in vectors(rng, CASES, 1e-3, 3):
        h, share, (n, g_1, g_2) = (
            rng.uniform(0.1, 1),
            rng.uniform(0.2, 1.5),
            rng.uniform(0.1, 1, (3, 3)),
        )
        tau_1, tau_2 = h * 10.0 ** rng.uniform(0, 1, (2, 3))
        ours = call(printed, n[0], g_1[0], tau_1[0], g_2[0], tau_2[0], h, share)[0]
        whole = _van_loan(np.zeros(3), n, [(g_1, tau_1), (g_2, tau_2)], h, share)
        exact.append(in_standard_deviations(ours, whole[::3, ::3]))
        same.append(
            in_standard_deviations(call(two, n, g_1, tau_1, g_2, tau_2, h, share)[0], whole)
        )
        turned.append(
            in_standard_deviations(
                call(turning, rate, n, g_1, tau_1, g_2, tau_2, h, share)[0],
                _van_loan(rate, n, [(g_1, tau_1), (g_2, tau_2)], h, share),
            )
        )
    processes = _catalogue()
    f = np.geomspace(*BAND, 400)
    return [
        Check(
            "Van Loan's method, one axis, random `N`, `g_i`, `tau_i`, `h`, `s`",
            CASES,
            max(exact),
            CLOSED,
            OF_COVARIANCE,
        ),
        Check(
            "noise.flicker_process_noise of the package against Van Loan's method, three axes that "
            "differ",
            CASES,
            max(same),
            ROUNDING,
            OF_COVARIANCE,
        ),
        Check(
            "noise.discretised against Van Loan's method for a body at a constant rate",
            CASES,
            max(turned),
            ROUNDING,
            OF_COVARIANCE,
        ),
        Check(
            f"noise.flicker_process_noise with the catalogue's {len(processes)} processes of "
            "bias_instability, `h` = 10 ms",
            1,
            _catalogue_case(processes),
            ROUNDING,
            OF_COVARIANCE,
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


def _flicker_library(m: int) -> ca.Function:
    n, h, share = ca.SX.sym("n", 3), ca.SX.sym("h"), ca.SX.sym("s")
    pairs = [(ca.SX.sym(f"g{i}", 3), ca.SX.sym(f"tau{i}", 3)) for i in range(m)]
    q = noise.flicker_process_noise(n, pairs, h, share)
    return ca.Function(
        "flicker", [n, *[v for pair in pairs for v in pair], h, share], [ca.densify(q)]
    )


def _catalogue() -> list[tuple[float, float]]:
    """Strength (for B = 1) and correlation time in s of each process of the catalogue's
    ``bias_instability``, from its step.
    """
    h, out = 1e-2, []
    for kept, fresh in _processes(
        "bias_instability", {"B": 1.0, "f_low": BAND[0], "f_high": BAND[1]}, h
    ):
        tau = -h / np.log(kept)
        out.append((fresh / np.sqrt(-tau / 2 * np.expm1(-2 * h / tau)), tau))
    return out


def _catalogue_case(processes: list[tuple[float, float]]) -> float:
    three = [([g] * 3, [tau] * 3) for g, tau in processes]
    ours = call(
        _flicker_library(len(three)), [0.1] * 3, *[v for pair in three for v in pair], 1e-2, 1.0
    )[0]
    return in_standard_deviations(ours, _van_loan(np.zeros(3), [0.1] * 3, three, 1e-2, 1.0))


def _decibel(processes: list[tuple[float, float]], f: np.ndarray) -> np.ndarray:
    """Two-sided density of the sum of processes against 1/(2 pi f), in dB."""
    density = sum((g * tau) ** 2 / (1 + (2 * np.pi * f * tau) ** 2) for g, tau in processes)
    return 10 * np.log10(density * 2 * np.pi * f)


def _shown(d: Derivation) -> list[Table]:
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
    tables=_shown,
)


DERIVATIONS = (MARKOV, TURNING_MARKOV, FLICKER)
