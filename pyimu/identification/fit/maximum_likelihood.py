"""Maximum likelihood of a model on trials."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np

from pyimu.identification.fit.errors_in_variables import (
    equations,
    has_noise,
    power_without_noise,
    smoothing,
)
from pyimu.identification.fit.fit import Fit, gauss_newton, with_prior
from pyimu.identification.fit.noise_fit import declared_variances
from pyimu.identification.fit.normal import Noise, Normal, Unit, standard_errors
from pyimu.identification.fit.whiten import Autoregressive, RandomWalk

ROUNDS = 25
"""Fits of noise and coefficients in turn at most; an effect that was taken for a walk comes out of
it by a factor of about three a round."""

WALKS_TRIED = 8
"""Sizes of a walk beside another model's noise, each half the variance of the one before."""

CIRCLE = 3
"""Rounds that change the noise by no less than the round before does, from which on the rounds are
not thought to stand still some day; so many places a circle has at most."""


def fit(start: Fit) -> Fit:
    """The model at its maximum likelihood."""
    return fit_and_normal(start)[0]


def fit_and_normal(start: Fit, steps: int = 6) -> tuple[Fit, Normal]:
    """Maximum likelihood of the free coefficients and the logs' own, and the equations there.

    The whitening is fitted anew in each round, until it or they stay. Where the residual of an axis
    has shown more than motion it is taken whole from then on: by the noise beside the motion the
    coefficients go where less than motion is left, by that of the whole they come back, for ever.
    Beside a reference whose noise is taken out the rounds may go in a circle, too: the likeliest of
    its places is taken then.
    """
    whole: frozenset[int] = frozenset()
    rounds = [start]
    for _ in range(ROUNDS):
        before = start
        start = _least_squares(start, steps).with_noise(whole)
        whole |= _beside_motion(before.seen) - _beside_motion(start.seen)
        stay = np.allclose(_values(before), _values(start), rtol=1e-4, atol=1e-9)
        if stay or _alike(before.noise, start.noise):
            break
        rounds.append(start)
        if has_noise(start) and _is_circle(rounds):
            start = max(rounds[-CIRCLE:], key=_settled_likelihood)
            break
    start.last.settle()
    normal = with_prior(equations(start), start)
    # A coefficient that was set by other means than regression keeps the standard error it came
    # with.
    std = {**start.std, **standard_errors(normal)}
    return replace(start, log_likelihood=normal.log_likelihood - smoothing(start), std=std), normal


def _least_squares(start: Fit, steps: int) -> Fit:
    """Least squares of the whitened residual, freed of the noise of the reference where there is
    any: with it a coefficient would go to where it lowers that noise.
    """
    if has_noise(start):
        return gauss_newton(start, steps, equations, power_without_noise)
    return gauss_newton(start, steps)


def _beside_motion(noise: Noise) -> frozenset[int]:
    """The axes whose noise is that of a residual less motion."""
    return frozenset(i for i, n in noise.items() if getattr(n, "beside_motion", False))


def _alike(one: Noise, other: Noise) -> bool:
    """Whether the noise of each axis is the same: its white part to 1e-4, and its walk or what it
    is predicted by to 1e-3.
    """
    return all(_is_same(n, other[i]) for i, n in one.items())


def _is_circle(rounds: list[Fit]) -> bool:
    """Whether ``CIRCLE`` of the rounds changed the noise by no less than the round before did."""
    changes = [_change(a.noise, b.noise) for a, b in pairwise(rounds)]
    return sum(b >= a for a, b in pairwise(changes)) >= CIRCLE


def _change(one: Noise, other: Noise) -> float:
    """By how much the white part of the noise of an axis changes at most, as a share of it."""
    pairs = [(getattr(n, "r", 1.0), getattr(other[i], "r", 1.0)) for i, n in one.items()]
    return max((abs(a - b) / max(a, b, 1e-300) for a, b in pairs), default=0.0)


def _is_same(a, b) -> bool:
    if isinstance(a, RandomWalk) and isinstance(b, RandomWalk):
        return bool(np.isclose(a.r, b.r, 1e-4, 0.0) and np.isclose(a.k2, b.k2, 1e-3, 0.0))
    if isinstance(a, Autoregressive) and isinstance(b, Autoregressive):
        alike = len(a.coefficients) == len(b.coefficients) and np.isclose(a.r, b.r, 1e-4, 0.0)
        alike = alike and np.isclose(a.k2, b.k2, 1e-3, 0.0)
        alike = alike and np.isclose(1.0 - a.theta, 1.0 - b.theta, 1e-3, 0.0)
        return bool(alike and np.allclose(a.coefficients, b.coefficients, 0.0, 1e-3))
    return False


def _values(fit: Fit) -> np.ndarray:
    """The coefficients of a fit and of its logs."""
    states = fit.states.values()
    clocks = [(s.clock.offset, s.clock.drift) for s in states if s.clock is not None]
    own = [np.concatenate([s.bias, s.rotation.ravel(), [s.lag], s.place]) for s in states]
    return np.concatenate([fit.sensor.p, *own, np.ravel(clocks)])


def wander_is_declared(fitted: Fit) -> bool:
    """Whether the part declares the random walk of an axis whose noise is fitted."""
    _, walk = declared_variances(fitted.sensor, fitted.trials[0].h)
    return any(walk[i] > 0.0 for i, n in fitted.noise.items() if not isinstance(n, Unit))


def advantage(larger: Fit, smaller: Fit) -> float:
    """Log-likelihood [nat] of a fitted model over one that lacks some of its coefficients.

    Where the part declares its random walk, both are judged by the noise that the larger leaves:
    one fitted to what it explains would take most of it for drift. Elsewhere the smaller is judged
    by its own noise or that of the larger, by which it is the likelier: rounds of noise and
    coefficients may end where another noise is likelier, above all beside a reference whose noise
    is taken out, and what the larger gains by that is none of its coefficients'. An autoregression
    of the larger's may have no walk left, which the smaller may have beside it, too.
    """
    own = larger.log_likelihood - smaller.log_likelihood
    declared = wander_is_declared(larger)
    if larger.noise == smaller.noise or not (declared or own > 0.0):
        return own
    other = _least_squares(replace(smaller, noise=larger.noise), 2)
    by_one = larger.log_likelihood - _likelihood(other)
    if declared:
        return by_one
    return min(own, by_one, larger.log_likelihood - _beside_its_walk(smaller, larger.noise))


def _beside_its_walk(fitted: Fit, noise: Noise) -> float:
    """The largest log-likelihood [nat] of a model beside autoregressions of another with as much
    walk as the model's own noise has, or less.
    """
    walks = {
        i: fitted.noise[i].k2
        for i, n in noise.items()
        if isinstance(n, Autoregressive) and fitted.noise[i].k2 > n.k2
    }
    best = -np.inf
    for k in range(WALKS_TRIED if walks else 0):
        more = {i: replace(noise[i], k2=max(noise[i].k2, k2 / 2.0**k)) for i, k2 in walks.items()}
        found = _likelihood(_least_squares(replace(fitted, noise={**noise, **more}), 2))
        if found <= best:
            break
        best = found
    return best


def advantage_by_its_noise(start: Fit, current: Fit, steps: int = 6) -> float:
    """Log-likelihood [nat] of least squares from a ``start`` on, by the noise that the current
    model has, over that model.
    """
    moved = _least_squares(replace(start, noise=current.noise), steps)
    return _likelihood(moved) - _likelihood(current)


def advantage_by_one_noise(one: Fit, other: Fit) -> float:
    """Log-likelihood [nat] of one fitted model over another on rows of the same samples, both by
    the noise of the one that leaves less.

    Of a motion that repeats an autoregression predicts all that a wrong model leaves: by a noise of
    its own each, neither would be ahead.
    """
    left = [
        sum(
            float(np.sum(np.log(np.var(r.residual[:, list(f.noise)], axis=0))))
            for r in f.residuals()
        )
        for f in (one, other)
    ]
    first, second, sign = (one, other, 1.0) if left[0] <= left[1] else (other, one, -1.0)
    judged = _least_squares(replace(second, noise=first.noise), 2)
    return sign * (first.log_likelihood - _likelihood(judged))


def _settled_likelihood(fitted: Fit) -> float:
    fitted.last.settle()
    return _likelihood(fitted)


def _likelihood(fitted: Fit) -> float:
    normal = with_prior(equations(fitted), fitted)
    return normal.log_likelihood - smoothing(fitted)
