"""Maximum likelihood of a model on trials."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyimu.identification.fit.fit import (
    Fit,
    declared_variances,
    gauss_newton,
    power,
    stepped,
    with_prior,
)
from pyimu.identification.fit.normal import Normal, Unit, solve, variances
from pyimu.identification.fit.reference_noise import equations, has_noise, smoothing

MOST_NOISE = 100.0
"""Power of a reference's noise over that of its motion up to which coefficients are freed of it: an
error c times the motion leaves at most so many times more of c times the noise."""


def fit(start: Fit) -> Fit:
    """The model at its maximum likelihood."""
    return fit_and_normal(start)[0]


def fit_and_normal(start: Fit, rounds: int = 3, steps: int = 6) -> tuple[Fit, Normal]:
    """Maximum likelihood of the free coefficients and the logs' own, and the equations there.

    The whitening is fitted anew in each round.
    """
    for _ in range(rounds):
        before = _values(start)
        start = gauss_newton(start, steps).with_noise()
        if np.allclose(before, _values(start), rtol=1e-4, atol=1e-9):
            break
    start = without_reference_noise(start)
    normal = with_prior(equations(start), start)
    variance = variances(normal.gram, normal.seen)
    # A coefficient that was set by other means than regression keeps the standard error it came
    # with.
    std = {**start.std, **{k: float(np.sqrt(variance[i])) for i, k in enumerate(normal.keys)}}
    return replace(start, log_likelihood=normal.log_likelihood - smoothing(start), std=std), normal


def _values(fit: Fit) -> np.ndarray:
    """The coefficients of a fit and of its logs."""
    states = fit.states.values()
    clocks = [(s.clock.offset, s.clock.drift) for s in states if s.clock is not None]
    own = [np.concatenate([s.bias, s.rotation.ravel(), [s.lag]]) for s in states]
    return np.concatenate([fit.sensor.p, *own, np.ravel(clocks)])


def wander_is_declared(fitted: Fit) -> bool:
    """Whether the part declares the random walk of an axis whose noise is fitted."""
    _, walk = declared_variances(fitted.sensor, fitted.trials[0].h)
    return any(walk[i] > 0.0 for i, n in fitted.noise.items() if not isinstance(n, Unit))


def advantage(larger: Fit, smaller: Fit) -> float:
    """Log-likelihood [nat] of a fitted model over one that lacks some of its coefficients.

    Where the part declares its random walk, both are judged by the noise that the larger leaves:
    one fitted to what it explains would take most of it for drift.
    """
    if not wander_is_declared(larger) or larger.noise == smaller.noise:
        return larger.log_likelihood - smaller.log_likelihood
    other = gauss_newton(replace(smaller, noise=larger.noise), 2)
    if has_noise(other):
        normal = with_prior(equations(other), other)
        other = stepped(other, normal.keys, solve(normal.gram, normal.score))
    return larger.log_likelihood - _likelihood(other)


def _likelihood(fitted: Fit) -> float:
    normal = with_prior(equations(fitted), fitted)
    return normal.log_likelihood - smoothing(fitted)


def without_reference_noise(fitted: Fit) -> Fit:
    """The fit less what the noise of its reference pulls coefficients by."""
    if not has_noise(fitted):
        return fitted
    normal = with_prior(equations(fitted), fitted)
    moved = stepped(fitted, normal.keys, solve(normal.gram, normal.score))
    # What the noise leaves of a column may be so little that the step goes beyond all bounds.
    with np.errstate(all="ignore"):
        is_step = power(moved) < MOST_NOISE * power(fitted)
    return (moved if is_step else fitted).with_noise()
