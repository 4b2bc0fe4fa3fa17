"""The elements of an effect that were left out: which of them goes in after all, and what the
others may still be, in the errors of those that are in.

Of a row of a matrix the elements that explain enough go in, one by one. What the motion hardly
tells from them goes with it to those that are there: their values are off by it, and their standard
errors say nothing of it. Each element that was left out is therefore taken to be in with the
probability that the rows give it, of the size that is typical of it (a spike and a slab: Mitchell
and Beauchamp 1988, "Bayesian variable selection in linear regression", JASA 83; averaged as in
Hoeting et al. 1999, "Bayesian model averaging", Statistical Science 14).
"""

from __future__ import annotations

from collections.abc import Collection, Hashable, Iterable
from dataclasses import dataclass, replace

import numpy as np
from scipy.special import logsumexp

from pyimu.identification.fit.errors_in_variables import equations
from pyimu.identification.fit.fit import Fit, with_prior
from pyimu.identification.fit.keys import Coefficient, Key, coefficients_of
from pyimu.identification.fit.mixture import standard_error
from pyimu.identification.search.projected import Projected, dispersion
from pyimu.identification.search.screen import PENALTY
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.effects import EFFECTS
from pyimu.model.typical import CLASSES, magnitudes

ODDS = 1.0
"""That an element is there, to that it is not, before any row is seen: of an effect that is there
some are and some are not."""


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
    """The fit, the standard errors of ``effects`` such that intervals hold although some of their
    elements were left out; of the user's own nobody knows how large they are.
    """
    beside = LeftOut.of(fit, [e for e in effects if CATALOGUE[e] in EFFECTS])
    if beside is None:
        return fit
    std, projected = dict(fit.std), beside.projected
    for effect in {k.effect for k in beside.keys}:
        at = [n for n, k in enumerate(beside.keys) if k.effect == effect]
        size = magnitudes(effect, fit.sensor.kind)[CLASSES[-1]].si
        for key in _estimated(fit, effect):
            place = projected.normal.position.get(key)
            turn = np.zeros(0) if place is None else projected.turn[place, at]
            if np.any(turn) and 0.0 < std.get(key, 0.0) < np.inf:
                std[key] = _averaged(std[key], turn, projected, at, size)
    return replace(fit, std=std)


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
    std: float, turn: np.ndarray, projected: Projected, at: list[int], size: float
) -> float:
    """The standard error of an element, each of those left out that are ``at`` projected columns
    moving it by ``turn`` (k,) times its own value.
    """
    seen = (turn != 0.0) & (np.diag(projected.variance)[at] > 0.0)
    turn, at = turn[seen], np.array(at)[seen]
    gram, score = np.diag(projected.gram)[at], projected.score[at]
    variance, value = np.diag(projected.variance)[at] / gram**2, score / gram
    both = variance + size**2
    log_odds = 0.5 * (np.log(variance / both) + value**2 * size**2 / variance / both)
    mean, left = value * size**2 / both, variance * size**2 / both
    log_weights = np.append(0.0, np.log(ODDS) + log_odds)
    means = np.append(0.0, turn * mean)
    deviations = np.sqrt(std**2 + np.append(0.0, turn**2 * left))
    return standard_error(np.exp(log_weights - logsumexp(log_weights)), means, deviations)
