"""What the elements of an effect that were left out may still be, in the errors of its others.

Of a row of a matrix the elements that explain enough go in, one by one. What the motion hardly
tells from them goes with it to those that are there: their values are off by it, and their standard
errors say nothing of it. Each element that was left out is therefore taken to be in with the
probability that the rows give it, of the size that is typical of it (a spike and a slab: Mitchell
and Beauchamp 1988, "Bayesian variable selection in linear regression", JASA 83; averaged as in
Hoeting et al. 1999, "Bayesian model averaging", Statistical Science 14).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from pyimu.errors import UserError
from pyimu.identification.fit.fit import Fit, with_prior
from pyimu.identification.fit.keys import Coefficient, Key, coefficients_of
from pyimu.identification.fit.mixture import standard_error
from pyimu.identification.fit.reference_noise import equations
from pyimu.identification.search.projected import Projected
from pyimu.model.typical import CLASSES, magnitudes

ODDS = 1.0
"""That an element is there, to that it is not, before any row is seen: of an effect that is there
some are and some are not."""


def with_left_out(fit: Fit, effects: Iterable[str]) -> Fit:
    """The fit, the standard errors of ``effects`` such that intervals hold although some of their
    elements were left out.
    """
    out = {e: _left_out(fit, e) for e in effects}
    out = {e: keys for e, keys in out.items() if keys}
    if not out:
        return fit
    normal = with_prior(equations(fit, lambda f: f.linearise(out)), fit)
    few = {k for keys in out.values() for k in keys if k in normal.position}
    base = [i for i, k in enumerate(normal.keys) if k in fit.free or not isinstance(k, Coefficient)]
    wanted = sorted(few)
    projected = Projected.of(normal, base, [normal.position[k] for k in wanted])
    std = dict(fit.std)
    for effect, keys in out.items():
        at = [n for n, k in enumerate(wanted) if k in keys]
        size = magnitudes(effect, fit.sensor.kind)[CLASSES[-1]].si
        for key in _estimated(fit, effect):
            turn = projected.turn[normal.position[key], at] if key in normal.position else []
            if np.any(turn):
                std[key] = _averaged(std[key], turn, projected, at, size)
    return replace(fit, std=std)


def _estimated(fit: Fit, effect: str) -> list[Coefficient]:
    """The elements of an effect that are free, of the one coefficient that has any."""
    parameters = fit.sensor.effect(effect).parameters
    free = (k for k in fit.free if isinstance(k, Coefficient) and k.effect == effect)
    return [k for k in free if not (parameters[k.parameter].form or parameters[k.parameter].sought)]


def _left_out(fit: Fit, effect: str) -> set[Key]:
    """The elements of an effect beside those that are estimated."""
    free = _estimated(fit, effect)
    names = {k.parameter for k in free}
    try:
        magnitudes(effect, fit.sensor.kind)
    except UserError:
        return set()  # an effect of the user's own
    return {k for k in coefficients_of(fit.sensor, effect) if k.parameter in names} - {*free}


def _averaged(
    std: float, turn: np.ndarray, projected: Projected, at: list[int], size: float
) -> float:
    """The standard error of an element, each of those left out that are ``at`` projected columns
    moving it by ``turn`` (k,) times its own value.
    """
    seen = turn != 0.0
    turn, at = turn[seen], np.array(at)[seen]
    gram, score = np.diag(projected.gram)[at], projected.score[at]
    variance, value = np.diag(projected.variance)[at] / gram**2, score / gram
    both = variance + size**2
    odds = ODDS * np.sqrt(variance / both) * np.exp(0.5 * value**2 * size**2 / variance / both)
    mean, left = value * size**2 / both, variance * size**2 / both
    weights = np.append(1.0, odds)
    means = np.append(0.0, turn * mean)
    deviations = np.sqrt(std**2 + np.append(0.0, turn**2 * left))
    return standard_error(weights / weights.sum(), means, deviations)
