"""Maximum likelihood of a model on trials."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyimu.identification.fit.attenuation import without_attenuation
from pyimu.identification.fit.fit import Fit, gauss_newton, with_prior
from pyimu.identification.fit.normal import Normal, normal_equations, variances


def fit(start: Fit) -> Fit:
    """The model at its maximum likelihood."""
    return fit_and_normal(start)[0]


def fit_and_normal(start: Fit, rounds: int = 3, steps: int = 6) -> tuple[Fit, Normal]:
    """Maximum likelihood of the free coefficients and the logs' own, and the equations there.

    The whitening is fitted anew in each round.
    """
    for _ in range(rounds):
        before = start.sensor.p
        start = gauss_newton(start, steps).with_noise()
        if np.allclose(before, start.sensor.p, rtol=1e-4, atol=1e-9):
            break
    start = without_attenuation(start)
    normal = with_prior(normal_equations(start.linearise(), start.noise), start)
    variance = variances(normal.gram)
    # A coefficient that was set by other means than regression keeps the standard error it came
    # with.
    std = {**start.std, **{k: float(np.sqrt(variance[i])) for i, k in enumerate(normal.keys)}}
    return replace(start, log_likelihood=normal.log_likelihood, std=std), normal
