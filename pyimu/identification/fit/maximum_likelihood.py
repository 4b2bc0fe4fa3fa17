"""Maximum likelihood of a model on trials."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyimu.identification.fit.fit import Fit, gauss_newton, stepped, with_prior
from pyimu.identification.fit.normal import Normal, solve, variances
from pyimu.identification.fit.reference_noise import equations, has_noise, smoothing


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
    start = without_reference_noise(start)
    normal = with_prior(equations(start), start)
    variance = variances(normal.gram)
    # A coefficient that was set by other means than regression keeps the standard error it came
    # with.
    std = {**start.std, **{k: float(np.sqrt(variance[i])) for i, k in enumerate(normal.keys)}}
    return replace(start, log_likelihood=normal.log_likelihood - smoothing(start), std=std), normal


def without_reference_noise(fitted: Fit) -> Fit:
    """The fit less what the noise of its reference pulls coefficients by."""
    if not has_noise(fitted):
        return fitted
    normal = with_prior(equations(fitted), fitted)
    return stepped(fitted, normal.keys, solve(normal.gram, normal.score)).with_noise()
