"""The terms of a formula, one after another, each beside all that went before."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import replace

import numpy as np

from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.fit.maximum_likelihood import fit_and_normal
from pyimu.identification.fit.normal import Normal
from pyimu.identification.formula.columns import values_of
from pyimu.identification.formula.effect import coefficients, made
from pyimu.identification.formula.levels import SHARES, Levels
from pyimu.identification.formula.screen import Scored, Scores, scored
from pyimu.identification.formula.terms import Term, at_origin, rounded, switch
from pyimu.identification.search.choice import SET_WIDTH
from pyimu.identification.search.screen import PENALTY, fitted_gain
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS, START

MOST_TERMS, MOST_FIRSTS = 3, 3
"""Terms of a formula, and terms that are tried as its first, at most."""

FINER = 4
"""Times that a level or an origin is looked for between those on both sides of the best."""

Chosen = list[tuple[Term, tuple[int, ...]]]
"""The terms of a formula, each with its axes."""


def firsts(scores: Scores, needed: float) -> list[Scored]:
    """The terms to begin with: the simplest of those that explain as much as the best, and where
    held-out rows refuse it the next.
    """
    if not scores.terms or scores.terms[0].gain <= needed:
        return []
    close = [s for s in scores.terms if s.gain > scores.terms[0].gain - SET_WIDTH]
    # On one axis a term by the axis's name and one by its place are the same column.
    columns: dict[Hashable, Scored] = {}
    for s in sorted(close, key=_how_simple):
        columns.setdefault((s.axes, f"{s.gain:.6g}"), s)
    return list(columns.values())[:MOST_FIRSTS]


def _how_simple(s: Scored) -> tuple[int, bool, float]:
    """What is to be taken in; what acts on one axis alone is said by that axis's own names."""
    return s.term.size, s.term.each and len(s.axes) == 1, -s.gain


def composed(
    start: Fit,
    name: str,
    first: Scored,
    scores: Scores,
    terms: list[Term],
    needed: float,
    bears: Callable[[Chosen, Fit], bool],
) -> tuple[Chosen, Fit]:
    """The terms that explain what a fit leaves, each with its axes, and the fit with them; no more
    are looked for beside those that held-out rows do not bear out.
    """
    chosen: Chosen = []
    fitted, best = start, first
    while True:
        best = _sharpened(fitted.as_declared(), best)
        chosen.append((best.term, best.axes))
        fitted = with_terms(start, name, chosen)
        if len(chosen) == MOST_TERMS or not bears(chosen, fitted):
            break
        following = firsts(scored(fitted.as_declared(), terms), needed)
        if not following:
            break
        best = following[0]
    return _backward(start, name, chosen, fitted, needed)


def _sharpened(fit: Fit, best: Scored) -> Scored:
    """A term with the level of its switch, or the origin of its surrounding, found between those
    that were tried.
    """
    if best.term.switch is not None:
        return _with_level(fit, best)
    return best if best.term.origin is None else _with_origin(fit, best)


def _with_level(fit: Fit, best: Scored) -> Scored:
    factor = best.term.switch
    levels, width = Levels.of(_values(fit, factor)), SHARES[1] - SHARES[0]
    share = levels.share(best.term.level)
    for _ in range(FINER):
        shares = np.clip(np.linspace(share - width, share + width, 11), 0.0, 1.0)
        terms = dict.fromkeys(switch(factor, float(v)) for v in levels.at(shares))
        best = max([best, *scored(fit, list(terms)).terms], key=lambda s: s.gain)
        share = levels.share(best.term.level)
        width /= 5
    return best


def _with_origin(fit: Fit, best: Scored) -> Scored:
    """The origin of the catalogue costs nothing, any other as much as a coefficient."""
    name = next(f.signal for f in best.term.factors if f.origin is not None)
    spread = float(np.concatenate([t.u[:, COLUMNS[name]] for t in fit.trials]).std())
    usual = scored(fit, [at_origin(best.term, float(START[COLUMNS[name]][0]))]).terms
    width = 3 * spread
    for _ in range(FINER):
        about = best.term.origin + np.linspace(-width, width, 11)
        terms = dict.fromkeys(at_origin(best.term, rounded(float(v), spread)) for v in about)
        best = max([best, *scored(fit, list(terms)).terms], key=lambda s: s.gain)
        width /= 4
    return max([*usual, best], key=lambda s: s.gain - PENALTY * (s not in usual))


def _values(fit: Fit, factor) -> np.ndarray:
    inside = [t.u[a:b] for t in fit.trials for a, b in t.segments]
    return values_of(fit.sensor.kind, factor.code, np.concatenate(inside))[:, 0]


def keys_of_terms(name: str, chosen: Chosen) -> frozenset[Coefficient]:
    return frozenset(k for keys in _keys(name, chosen) for k in keys)


def with_terms(start: Fit, name: str, chosen: Chosen) -> Fit:
    """A fit with terms added, at its maximum likelihood."""
    made(name, start.sensor.kind, [t for t, _ in chosen])
    sensor = start.sensor.without(name).with_values(name)
    free = start.free | keys_of_terms(name, chosen)
    return fit_and_normal(replace(start, sensor=sensor, free=free).with_noise())[0]


def _backward(
    start: Fit, name: str, chosen: Chosen, fitted: Fit, needed: float
) -> tuple[Chosen, Fit]:
    """The terms less those that later ones made superfluous."""
    while len(chosen) > 1:
        normal = fit_and_normal(fitted)[1]
        gains = [fitted_gain(normal, fitted.sensor, keys) for keys in _keys(name, chosen)]
        least = int(np.argmin(gains))
        if gains[least] > needed:
            break
        chosen = [c for k, c in enumerate(chosen) if k != least]
        fitted = with_terms(start, name, chosen)
    return chosen, fitted


def borne(normal: Normal, sensor: Sensor, name: str, chosen: Chosen, needed: float) -> Chosen:
    """The terms, each with its axes, that fitted rows speak for beside all that is in a model: as
    when they were chosen, an axis by more than its penalty and a term by more than is ``needed``.
    """
    out: Chosen = []
    for (term, axes), keys in zip(chosen, _keys(name, chosen), strict=True):
        by_axis = [[k for k in keys if k.index == (i,)] for i in axes]
        gains = [fitted_gain(normal, sensor, own) for own in by_axis]
        seen = [k for own, gain in zip(by_axis, gains, strict=True) if gain > 0.0 for k in own]
        if seen and fitted_gain(normal, sensor, seen) > needed:
            kept = {k.index[0] for k in seen}
            out.append((term, tuple(i for i in axes if i in kept)))
    return out


def _keys(name: str, chosen: Chosen) -> list[list[Coefficient]]:
    """The coefficients of each term on its axes."""
    named = coefficients([t for t, _ in chosen])
    return [
        [Coefficient(name, c, (i,)) for c, t, _ in named if t is term for i in axes]
        for term, axes in chosen
    ]
