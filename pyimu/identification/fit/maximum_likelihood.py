"""Maximum likelihood of a model on trials."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyimu.identification.fit.attenuation import without_attenuation
from pyimu.identification.fit.fit import Fit, gauss_newton
from pyimu.identification.fit.normal import normal_equations, variances


def fit(start: Fit, rounds: int = 3, steps: int = 6) -> Fit:
    """Maximum likelihood of the free coefficients and the logs' own, whitening fitted anew in each
    round.
    """
    for _ in range(rounds):
        before = start.sensor.p
        start = gauss_newton(start, steps).with_noise()
        if np.allclose(before, start.sensor.p, rtol=1e-4, atol=1e-9):
            break
    start = without_attenuation(start)
    normal = normal_equations(start.linearise(), start.noise)
    variance = variances(normal.gram)
    # A coefficient that was set by other means than regression keeps the standard error it came
    # with.
    std = {**start.std, **{k: float(np.sqrt(variance[i])) for i, k in enumerate(normal.keys)}}
    return replace(start, log_likelihood=normal.log_likelihood, std=std)
