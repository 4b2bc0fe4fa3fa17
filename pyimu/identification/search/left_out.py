"""The elements of an effect that were left out: which of them goes in after all, and what the
others may still be, in the errors of those that are in.

Of a row of a matrix the elements that explain enough go in, one by one. What the motion hardly
tells from them goes with it to those that are there: their values are off by it, and their standard
errors say nothing of it; of those that went in on little, some are noise. Every choice of the
elements of an axis is therefore taken to be the true one with the probability that the rows give
it, its elements of the size of those that were found (a spike and a slab: Mitchell and Beauchamp
1988, "Bayesian variable selection in linear regression", JASA 83; averaged as in Hoeting et al.
1999, "Bayesian model averaging", Statistical Science 14).
"""

from __future__ import annotations

from collections.abc import Collection, Hashable, Iterable
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
from scipy.special import logsumexp

from pyimu.identification.fit.errors_in_variables import equations
from pyimu.identification.fit.fit import Fit, with_prior
from pyimu.identification.fit.keys import Coefficient, Key, LogLag, coefficients_of
from pyimu.identification.fit.mixture import standard_error
from pyimu.identification.fit.normal import Normal
from pyimu.identification.search.projected import Projected, dispersion
from pyimu.identification.search.screen import PENALTY
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.effects import EFFECTS

HARDLY = 1e-3
"""Share of a standard error within which an element that is not there is zero."""


@dataclass(frozen=True)
class LeftOut:
    """The columns of the elements that were left out, beside all that a fit has."""

    keys: list[Coefficient]
    projected: Projected

    @classmethod
    def of(cls, fit: Fit, effects: Iterable[str]) -> LeftOut | None:
        """Those of ``effects``; None where none was left out."""
        out = {e: keys for e in effects if (keys := _left_out(fit, e))}
        if not out:
            return None
        normal = with_prior(equations(fit, lambda f: f.linearise(out)), fit)
        keys = sorted(k for some in out.values() for k in some if k in normal.position)
        base = [
            i for i, k in enumerate(normal.keys) if k in fit.free or not isinstance(k, Coefficient)
        ]
        return cls(keys, Projected.of(normal, base, [normal.position[k] for k in keys]))

    def largest(self, but: Collection[Key] = ()) -> tuple[frozenset[Coefficient], float, float]:
        """The element that explains most, ``but`` for some, with its gain [nat] and the scatter
        that it is corrected for; of a formula all on an axis are one. Empty where there is none.
        """
        groups: dict[Hashable, list[int]] = {}
        for n, k in enumerate(self.keys):
            if k not in but:
                own = k if CATALOGUE[k.effect] in EFFECTS else (k.effect, k.index)
                groups.setdefault(own, []).append(n)
        found = ((frozenset(self.keys[n] for n in at), *self._gain(at)) for at in groups.values())
        return max(found, key=lambda f: f[1], default=(frozenset(), -np.inf, 1.0))

    def _gain(self, at: list[int]) -> tuple[float, float]:
        """Log-likelihood [nat] that elements add, penalised, and the scatter of their score."""
        score, variance = self.projected.score[at], self.projected.variance[np.ix_(at, at)]
        if not np.all(np.diag(variance) > 0.0):
            return -np.inf, 1.0
        spread = dispersion(self.projected, at)
        gain = 0.5 * float(score @ np.linalg.lstsq(variance, score)[0])
        return gain / spread - PENALTY * len(at), spread


def with_left_out(fit: Fit, effects: Iterable[str]) -> Fit:
    """The fit, the standard errors of ``effects`` such that intervals hold although their elements
    were chosen by the same rows; of the user's own nobody knows what they are made of.
    """
    wanted = [e for e in effects if CATALOGUE[e] in EFFECTS]
    chosen = {e: _estimated(fit, e) for e in wanted}
    out = {e: _left_out(fit, e) for e in wanted}
    if not wanted:
        return fit
    normal = with_prior(equations(fit, lambda f: f.linearise(out)), fit)
    std = dict(fit.std)
    for effect in wanted:
        for axis in {k.index[:1] for k in chosen[effect]}:
            own, beside = (
                sorted(k for k in some if k.index[:1] == axis and k in normal.position)
                for some in (chosen[effect], out[effect])
            )
            if own:
                std |= _averaged(fit, normal, own, beside, _size(fit, chosen[effect]))
    return replace(fit, std=std)


def _size(fit: Fit, keys: Iterable[Coefficient]) -> float:
    """What an element of an effect is like, from those that were found."""
    return float(np.sqrt(np.mean([_value(fit, k) ** 2 for k in keys])))


def _value(fit: Fit, key: Coefficient) -> float:
    return float(fit.sensor.values[key.effect][key.parameter][key.index])


def _estimated(fit: Fit, effect: str) -> list[Coefficient]:
    """The elements of an effect that are free, of the one coefficient that has any."""
    parameters = fit.sensor.effect(effect).parameters
    free = (k for k in fit.free if isinstance(k, Coefficient) and k.effect == effect)
    return [k for k in free if not (parameters[k.parameter].form or parameters[k.parameter].sought)]


def _left_out(fit: Fit, effect: str) -> set[Coefficient]:
    """The elements of an effect beside those that are estimated."""
    free = _estimated(fit, effect)
    names = {k.parameter for k in free}
    return {k for k in coefficients_of(fit.sensor, effect) if k.parameter in names} - {*free}


def _averaged(
    fit: Fit, normal: Normal, own: list[Coefficient], beside: list[Coefficient], size: float
) -> dict[Key, float]:
    """The standard errors of the elements ``own`` of an axis, those ``beside`` them left out, where
    any of both is there or not.

    The lag of a thermometer is a share of what goes with temperature: it makes that unsure, and no
    element that is not there likelier.
    """
    base = [
        i
        for i, k in enumerate(normal.keys)
        if (k in fit.free or not isinstance(k, Coefficient)) and k not in own
    ]
    lagless = [i for i in base if not isinstance(normal.keys[i], LogLag)]
    at_own = [normal.position[k] for k in own]
    projected = Projected.of(normal, lagless, [*at_own, *(normal.position[k] for k in beside)])
    gram, n = projected.gram, len(own)
    known = gram[:n, :n] if lagless == base else Projected.of(normal, base, at_own).gram
    if not np.all(np.diag(known) > 0.0):
        return {}
    value = np.array([_value(fit, k) for k in own])
    alone = np.diag(np.linalg.pinv(known))
    score = projected.score + gram[:, :n] @ value
    wider: dict[Key, float] = {}
    for at, key in enumerate(own):
        std = fit.std.get(key, 0.0)
        if 0.0 < std < np.inf and alone[at] > 0.0:
            scatter = std**2 / alone[at]
            weights, means, deviations = _choices(gram / scatter, score / scatter, size, at)
            near = np.maximum(deviations, HARDLY * std)
            wider[key] = max(std, standard_error(weights, means - value[at], near))
    return wider


def _choices(
    gram: np.ndarray, score: np.ndarray, size: float, at: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Of each choice of the elements (k,) of an axis, its probability, and mean and standard
    deviation of the element ``at`` in it; ``score`` is what the rows say of them from zero on.
    """
    places = range(len(score))
    found = []
    for count in range(len(score) + 1):
        for choice in combinations(places, count):
            chosen = np.array(choice, dtype=int)
            inside = gram[np.ix_(chosen, chosen)]
            inverse = np.linalg.inv(inside + np.eye(count) / size**2)
            mean = inverse @ score[chosen]
            occam = np.linalg.slogdet(np.eye(count) + size**2 * inside)[1]
            weight = 0.5 * float(score[chosen] @ mean) - 0.5 * float(occam)
            if at in choice:
                here = choice.index(at)
                found.append((weight, mean[here], np.sqrt(inverse[here, here])))
            else:
                found.append((weight, 0.0, 0.0))
    log_weights, means, deviations = np.array(found).T
    return np.exp(log_weights - logsumexp(log_weights)), means, deviations
