"""The process noise Q where the bias is a Gauss-Markov process."""

from __future__ import annotations

import casadi as ca
import numpy as np

from pyimu.derivations.cases import rounds, vectors
from pyimu.derivations.independent import in_standard_deviations
from pyimu.derivations.model import EPS, Check, Derivation, Equation, call, library
from pyimu.derivations.process_noise.integrals import MAGNITUDE
from pyimu.derivations.process_noise.random_walk import INTEGRAL, STILL, Q
from pyimu.derivations.process_noise.transition import CROSS, ROUNDING
from pyimu.derivations.sources import VAN_LOAN
from pyimu.model.sensor import Sensor
from pyimu.symbolic import process_noise as noise
from pyimu.symbolic.van_loan import van_loan

CLOSED = 1e4 * EPS
"""Bound for closed forms where h/tau is a tenth and more: the variance of the angle, at least
(h/tau)^3/3, is the difference of terms of size h/tau."""

LIMIT = 1e-9
"""h/tau at which a Gauss-Markov process counts as a random walk; the first term that differs is of
that size."""


def by_van_loan(rate, n, processes, h, share) -> np.ndarray:
    """Q (3 + 3 m, 3 + 3 m) of m ``processes``, pairs of g (3,) and tau (3,)."""
    pairs = [(ca.DM(g), 1 / ca.DM(tau)) for g, tau in processes]
    f, g = noise.error_system(ca.DM(rate), ca.DM(n), pairs, share)
    return van_loan(np.array(f), np.array(g @ g.T), h)


# Without rotation


def _check_markov(d: Derivation) -> list[Check]:
    drawn, package = _drawn(), library(noise.gauss_markov_process_noise, 3, 3, 3, 1, 1)
    return [
        *_check_printed(d, package, drawn),
        _check_axes(package, drawn),
        _check_limit(package, drawn),
        _check_step(d),
    ]


def _drawn() -> list[tuple]:
    """Periods, shares, N and g (3,), and correlation times (3,) of two kinds.

    The first are one to ten periods, the second up to 1e8 periods.
    """
    rng, drawn = np.random.default_rng(20), []
    for _ in rounds():
        h, share, (n, g) = rng.uniform(0.1, 1), rng.uniform(0.2, 1.5), rng.uniform(0.1, 1, (2, 3))
        tau = h * 10.0 ** rng.uniform(0, 1, 3)
        drawn.append((h, share, n, g, tau, h * 10.0 ** rng.uniform(0, 8, 3)))
    return drawn


def _check_printed(d: Derivation, package: ca.Function, drawn: list[tuple]) -> list[Check]:
    """The printed form, whose axes are equal, in two other ways."""
    printed, exact, same = d.function(("Q",), ("N", "g", "tau", "h", "s")), [], []
    for h, share, n, g, tau, _ in drawn:
        axes = [n[0]] * 3, [g[0]] * 3, [tau[0]] * 3
        ours = call(printed, n[0], g[0], tau[0], h, share)[0]
        reference = by_van_loan(np.zeros(3), axes[0], [axes[1:]], h, share)
        exact.append(in_standard_deviations(ours, reference))
        same.append(in_standard_deviations(call(package, *axes, h, share)[0], ours))
    return [
        Check.of_covariances("Van Loan's method, random `N`, `g`, `tau`, `h`, `s`", exact, CLOSED),
        Check.of_covariances("noise.gauss_markov_process_noise of the package", same, CLOSED),
    ]


def _check_axes(package: ca.Function, drawn: list[tuple]) -> Check:
    differences = [
        in_standard_deviations(
            call(package, n, g, slow, h, share)[0],
            by_van_loan(np.zeros(3), n, [(g, slow)], h, share),
        )
        for h, share, n, g, _, slow in drawn
    ]
    return Check.of_covariances(
        "the same against Van Loan's method, axes that differ, `tau` up to 1e8 periods, where "
        "the series stand in",
        differences,
        ROUNDING,
    )


def _check_limit(package: ca.Function, drawn: list[tuple]) -> Check:
    still, differences = STILL.function(("Q",), ("S_N", "S_K", "h", "s")), []
    for h, share, n, g, _, _ in drawn:
        frozen = call(package, n, g, [h / LIMIT] * 3, h, share)[0]
        walk = call(still, np.diag(n**2), np.diag(g**2), h, share)[0]
        differences.append(in_standard_deviations(frozen, walk))
    return Check.of_covariances(
        "the same at `tau = 10**9*h` against the random walk", differences, 2 * LIMIT
    )


def _check_step(d: Derivation) -> Check:
    """The catalogue's own discretisation against the printed decay and variance."""
    printed = d.function(("E", "Q_bb"), ("g", "tau", "h"))
    rng, worst = np.random.default_rng(21), 0.0
    for _ in rounds(10):
        g, tau, h = rng.uniform(0.1, 1), rng.uniform(1, 10), rng.uniform(0.1, 1)
        ((kept, fresh),) = step_of("gauss_markov", {"q": g, "tau": tau}, h)
        decay, variance = call(printed, g, tau, h)
        worst = max(worst, abs(kept / decay - 1), abs(fresh**2 / variance[0, 0] - 1))
    return Check(
        "one step of the catalogue's effect gauss_markov: its decay, and the variance it adds "
        "to the bias",
        len(rounds(10)),
        worst,
        ROUNDING,
        "largest relative difference",
    )


def step_of(effect: str, values: dict, h: float) -> list[tuple[float, float]]:
    """Decay over ``h`` s and standard deviation added, of each process of an effect's first axis.

    The processes are Gauss-Markov; the standard deviation is that of what a step adds.
    """
    sensor = Sensor("gyro", {effect: values})
    s, w = sensor.step.sx_in(0), sensor.step.sx_in(3)
    following = sensor.step(s, ca.DM.zeros(sensor.step.size_in(1)), sensor.p, w, h)[0]
    jacobians = ca.Function(
        "jacobians", [s, w], [ca.densify(ca.jacobian(following, by)) for by in (s, w)]
    )
    # All states one: the flag that says a process has started, too.
    kept, fresh = (np.array(m) for m in jacobians(1, 0))
    fresh = fresh[:, ::3]
    rows = np.flatnonzero(fresh.any(axis=1))
    return [(float(kept[i, i]), float(np.abs(fresh[i]).max())) for i in rows]


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
        Equation("E", "exp(-(h/tau))"),
        Equation("Q_pp", "s**2*(N**2*h + g**2*tau**2*(h - 2*tau*(1 - E) + tau*(1 - E**2)/2))*I_3"),
        Equation("Q_pb", "-(s*g**2*tau**2*(1 - E)**2/2*I_3)"),
        Equation("Q_bb", "g**2*tau*(1 - E**2)/2*I_3"),
        Q,
    ),
    _check_markov,
)


# At a constant rate, equal axes


def _check_turning(d: Derivation) -> list[Check]:
    printed, series = d.function(("Q",), ("omega", "N", "g", "tau", "h", "s")), series_of(1)
    rng, exact, same, axes = np.random.default_rng(22), [], [], []
    for rate in vectors(rng, 0.5, 3):
        h, share, (n, g) = rng.uniform(0.3, 1), rng.uniform(0.2, 1.5), rng.uniform(0.1, 1, (2, 3))
        tau = h * 10.0 ** rng.uniform(0, 1, 3)
        equal = [n[0]] * 3, [g[0]] * 3, [tau[0]] * 3
        ours = call(printed, rate, n[0], g[0], tau[0], h, share)[0]
        reference = by_van_loan(rate, equal[0], [equal[1:]], h, share)
        exact.append(in_standard_deviations(ours, reference))
        same.append(in_standard_deviations(call(series, rate, *equal, h, share)[0], ours))
        slow, slower = h * 10.0 ** rng.uniform(0, 8, 3), rate * 10.0 ** rng.uniform(-12, 0)
        reference = by_van_loan(slower, n, [(g, slow)], h, share)
        found = call(series, slower, n, g, slow, h, share)[0]
        axes.append(in_standard_deviations(found, reference))
    return [
        Check.of_covariances(
            "Van Loan's method, random `omega`, `N`, `g`, `tau`, `h`, `s`", exact, CLOSED
        ),
        Check.of_covariances(
            "noise.discretised of noise.error_system, casadi's series in `F`, `G` and `h`",
            same,
            CLOSED,
        ),
        Check.of_covariances(
            "the same against Van Loan's method, axes that differ, rates down to 1e-12 rad/s, "
            "`tau` up to 1e8 periods",
            axes,
            ROUNDING,
        ),
    ]


def series_of(processes: int) -> ca.Function:
    """Q of any constant rate and any number of processes, by casadi from F, G and h.

    Its arguments are the rate, N, g and tau of each process, (3,) each, h and s.
    """

    def series(rate, n, *flat):
        *pairs, h, share = flat
        biases = [(g, 1 / tau) for g, tau in zip(pairs[::2], pairs[1::2], strict=True)]
        f, g = noise.error_system(rate, n, biases, share)
        return noise.discretised(f, g @ g.T, h, 4)[1]

    return library(series, 3, 3, *[3, 3] * processes, 1, 1)


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
