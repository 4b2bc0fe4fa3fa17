"""The standard filters on continuous white noise, and their exact discretisation.

They are written independently of the effects.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise

import control
import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq

from pyimu.errors import UserError
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.law import Law
from pyimu.symbolic.van_loan import van_loan


def white(gain: float) -> control.StateSpace:
    """Static gain: the density gain^2 at every frequency."""
    return control.ss(np.zeros((0, 0)), np.zeros((0, 1)), np.zeros((1, 0)), [[gain]])


def processes(strengths: np.ndarray, rates: np.ndarray) -> control.StateSpace:
    """The sum of b_i' = -rate_i b_i + strength_i w_i, each with its own white noise.

    A rate of zero is a random walk.
    """
    m = len(rates)
    return control.ss(-np.diag(rates), np.diag(strengths), np.ones((1, m)), np.zeros((1, m)))


def continuous_filter(
    effect: str, coefficients: Mapping[str, float], at: float = 0.0, slope: float = 0.0
) -> control.StateSpace:
    """The continuous filter from white noises of density one to an effect's output, for one axis.

    It is the effect's law as a system, with the input ``at`` and its rate ``slope``.

    Raises UserError for an effect that has none: jitter, quantization and what is no noise.
    """
    law = CATALOGUE[effect].law
    if not has_filter(law):
        known = [e.name for e in CATALOGUE.values() if has_filter(e.law)]
        raise UserError(
            f"{effect} has no continuous shaping filter, only {', '.join(known)} have one"
        )
    walk, markov = (law.value(part, coefficients) for part in ("walk", "markov"))
    states = [] if walk is None else [(np.sqrt(walk), 0.0)]
    states += [(np.sqrt(2 * variance / tau), 1 / tau) for variance, tau in markov or ()]
    density = law.value("white", coefficients, x=at, slope=slope)
    systems = [processes(*np.transpose(states))] if states else []
    systems += [] if density is None else [white(np.sqrt(density))]
    if len(systems) == 1:
        return systems[0]
    sum_of_outputs = control.ss([], [], [], np.ones((1, len(systems))))
    return sum_of_outputs * control.append(*systems)


def has_filter(law: Law | None) -> bool:
    """Whether a law is one of noise in continuous time."""
    parts = law and (law.white, law.walk, law.markov)
    return bool(parts) and not law.sampled and any(parts)


def discretise(system: control.StateSpace, sample_period: float) -> control.StateSpace:
    """The discrete system, driven by standard normals, that is equal in law at the samples.

    The step [s] may have any length.

    x_k+1 = exp(A h) x_k + v_k with the covariance of v by Van Loan's integral, y_k = C x_k; an
    input that goes straight to the output is averaged over a sample, D / sqrt(h). Raises
    ValueError for an input that does both, which has no such law.
    """
    straight = np.any(system.D != 0, axis=0)
    if np.any(system.B[:, straight] != 0):
        raise ValueError(
            "an input drives a state and the output: average the output over the sample first"
        )
    b = system.B[:, ~straight]
    transition, covariance = _transition(system.A, b @ b.T, sample_period)
    root = covariance_root(covariance)
    straight_gain = system.D[:, straight] / np.sqrt(sample_period)
    return control.ss(
        transition,
        np.hstack([root, np.zeros((system.nstates, straight.sum()))]),
        system.C,
        np.hstack([np.zeros((system.noutputs, root.shape[1])), straight_gain]),
        sample_period,
    )


def _transition(a: np.ndarray, density: np.ndarray, h: float) -> tuple[np.ndarray, np.ndarray]:
    """exp(a h) and the covariance that white noise of this ``density`` adds in h s.

    Over a part of h that is short against every pole, because Van Loan's exponential grows with
    exp(|a| h); then doubled.
    """
    if not len(a):
        return np.zeros((0, 0)), np.zeros((0, 0))
    halvings = max(0, int(np.ceil(np.log2(max(np.linalg.norm(a, 1) * h, 1)))))
    part = h / 2**halvings
    transition, covariance = expm(a * part), van_loan(a, density, part)
    for _ in range(halvings):
        transition, covariance = (
            transition @ transition,
            covariance + transition @ covariance @ transition.T,
        )
    return transition, covariance


def covariance_root(q: np.ndarray) -> np.ndarray:
    """B with B B^T = q, for a covariance that may be singular; diagonal where q is."""
    std = np.sqrt(np.diag(q))
    scale = np.where(std > 0, std, 1.0)
    if np.count_nonzero(q - np.diag(np.diag(q))) == 0:
        return np.diag(std)
    values, vectors = np.linalg.eigh(q / np.outer(scale, scale))
    return scale[:, None] * vectors * np.sqrt(np.maximum(values, 0.0))


def transfer_function(system: control.StateSpace) -> control.TransferFunction:
    """The transfer function from one white noise of density 1 to the output.

    The system is a static gain or a sum of ``processes``.
    """
    if system.nstates == 0:
        return control.tf([float(np.linalg.norm(system.D))], [1.0])
    return spectral_factor(np.diag(system.B), -np.diag(system.A))


def spectral_factor(strengths: np.ndarray, rates: np.ndarray) -> control.TransferFunction:
    """The one minimum-phase filter H with |H|^2 = sum g_i^2 / (a_i^2 + w^2).

    ``strengths`` are g (m,), ``rates`` are a (m,), rising.

    Over p = s^2 the density is sum g_i^2 / (a_i^2 - p), which rises from minus to plus infinity
    between neighbouring a_i^2 and so has exactly one zero there.
    """
    g2, a = np.asarray(strengths, dtype=float) ** 2, np.asarray(rates, dtype=float)
    if not np.any(g2):
        return control.tf([0.0], [1.0])

    def zero(low: float, high: float) -> float:
        edge = 1e-9 * (high - low)
        return brentq(
            lambda z: np.sum(g2 / ((a - z) * (a + z))),
            low + edge,
            high - edge,
            xtol=1e-15 * high,
            rtol=1e-15,
        )

    zeros = [zero(low, high) for low, high in pairwise(a)]
    return control.zpk(-np.array(zeros), -a, np.sqrt(np.sum(g2)))
