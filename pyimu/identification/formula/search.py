"""The simplest formula for what no effect of the catalogue describes.

Terms are taken one after another, each beside all that went before, by the rules for effects: gain
over a gate that chance passes in one log of a hundred, a penalty for each coefficient, held-out
rows that must gain by it. What the loop had named is then looked for anew beside the formula:
effects that only mimicked it are not found again.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.keys import Coefficient, coefficients_of
from pyimu.identification.fit.maximum_likelihood import advantage, fit_and_normal
from pyimu.identification.formula.columns import values_of
from pyimu.identification.formula.effect import (
    coefficients,
    free_name,
    function_text,
    made,
    put,
)
from pyimu.identification.formula.formula import Formula
from pyimu.identification.formula.resembles import resembled
from pyimu.identification.formula.screen import UNEXPLAINED, Scored, Scores, gate, scored
from pyimu.identification.formula.terms import (
    LEVELS,
    Term,
    at_origin,
    library,
    rounded,
    switch,
)
from pyimu.identification.search.choice import SET_WIDTH
from pyimu.identification.search.confirm import SPEAKS, Evidence, evidence
from pyimu.identification.search.forward import Investigation, Step, form_error
from pyimu.identification.search.leftover import Unexplained
from pyimu.identification.search.own_signal import is_of_reference
from pyimu.identification.search.screen import PENALTY, fitted_dispersion, fitted_gain
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.signals import COLUMNS, START

MOST_TERMS, MOST_FIRSTS = 3, 3
"""Terms of a formula, and terms that are tried as its first, at most."""

CONFIRMED = 0.3
"""Share of what the models differ by on held-out rows that these must gain: all of it in the mean
where the formula is true, the contrary of it where it is not."""

DISPLACES = 0.2
"""Share of what effects with a name explain by which a formula must explain more to take their
place: near level a product with the vertical force is a multiple of gravity."""

FINER = 4
"""Times that a level or an origin is looked for between those on both sides of the best."""

Again = Callable[..., Investigation]

Chosen = list[tuple[Term, tuple[int, ...]]]
"""The terms of a formula, each with its axes."""


Found = tuple[float, Investigation, Formula]

Done = dict[frozenset[tuple[str, tuple[int, ...]]], tuple[Found | None, Chosen]]
"""What became of each formula, by its terms' texts and axes, that was investigated in full."""


@dataclass(frozen=True)
class Look:
    """What was made of what an investigation left."""

    investigation: Investigation
    formula: Formula | None = None
    unexplained: Unexplained | None = None


def look(
    inv: Investigation,
    again: Again,
    say: Callable[[str], None] = lambda text: None,
) -> Look:
    """Look for a formula for what an investigation left.

    ``again(sensor, free, believed=False)`` investigates with one in the model, or what may be noise
    of the reference believed.
    """
    trials, kind = inv.after.trials, inv.after.sensor.kind
    if any(t.reduction is not None for t in trials) or all(
        t.reference == "static" and "temperature" not in t.known for t in trials
    ):
        return Look(inv)
    say(f"{kind}: is anything left that depends on inputs")
    terms = library(kind, trials)
    if not terms:
        return Look(inv)
    judged = inv.after.as_declared()
    left = scored(judged, terms)
    fires = left.p_value < UNEXPLAINED
    if not fires and not _may_be_one(inv):
        return Look(inv)
    if fires and _is_of_reference(judged, left):
        again = partial(again, believed=True)
        return look(again(inv.before.sensor, inv.before.free), again, say)
    say(f"{kind}: looking for a formula")
    starts = [(inv.after, left)] if fires else []
    if inv.steps:
        before = inv.before.as_declared()
        starts.append((inv.before, scored(before, terms)))
    done: Done = {}
    found = [_tried(inv, start, scores, terms, again, done) for start, scores in starts]
    found = [f for f in found if f is not None]
    best = max(found, key=lambda f: f[0], default=None)
    if best is not None:
        _, after, formula = best
        put(formula.effect)
        formula = replace(formula, resembles=resembled(after, formula))
        if formula.is_new:
            return Look(after, formula, _unexplained(kind, scored(after.after, terms)))
        CATALOGUE.remove(formula.name)
    if not fires:
        return Look(inv)
    # By the noise that it shows itself: a residual that wanders more than is declared follows many
    # a slow input by chance.
    seen = left if judged is inv.after else scored(inv.after, terms)
    return Look(inv, None, _unexplained(kind, seen))


def _may_be_one(inv: Investigation) -> bool:
    """Whether what was found may be parts of one thing that has no name: several effects, or a line
    in time, as what goes round with the heading leaves it where that turns steadily.
    """
    named = [CATALOGUE[s.effect] for s in inv.steps if not s.declared]
    return len(named) > 1 or any(e.is_line for e in named)


def _is_of_reference(left: Fit, scores: Scores) -> bool:
    """Whether the clearest dependence is only what a reference's noise makes look like one."""
    if not any(t.doubt for t in left.trials):
        return False
    best, name = min(scores.terms, key=lambda s: s.p_value), free_name()
    try:
        return is_of_reference(left, _with(left, name, [(best.term, (best.axis,))]))
    finally:
        if name in CATALOGUE:
            CATALOGUE.remove(name)


def _unexplained(kind: str, scores: Scores) -> Unexplained | None:
    """The term on which a residual depends most clearly, if on any."""
    if scores.p_value >= UNEXPLAINED:
        return None
    s = min(scores.terms, key=lambda s: s.p_value)
    return Unexplained(kind, "xyz"[s.axis], s.term.inputs, scores.p_value)


def _tried(
    inv: Investigation,
    start: Fit,
    scores: Scores,
    terms: list[Term],
    again: Again,
    done: Done,
) -> Found | None:
    """The formula that the residual of a fit speaks for and that held-out rows confirm, less the
    axes on which these speak against it; None where there is none. What is ``done`` is not done
    again: a whole investigation is long.
    """
    name, needed = free_name(), max(gate(scores), form_error(inv.steps))
    try:
        for first in _firsts(scores, needed):
            chosen, fitted = _composed(start, name, first, scores, terms, needed)
            # Held-out rows refuse most formulas.
            kept, found = _left(chosen, evidence(start, fitted, inv.held)), None
            if kept == chosen:
                found, kept = _once(done, inv, name, chosen, fitted, needed, again)
            fewer = [(t, a) for t, a in kept if a]
            if found is None and fewer and kept != chosen:
                fitted = _with(start, name, fewer)
                found, _ = _once(done, inv, name, fewer, fitted, needed, again)
            if found is not None:
                return found
        return None
    finally:
        if name in CATALOGUE:
            CATALOGUE.remove(name)


def _once(
    done: Done,
    inv: Investigation,
    name: str,
    chosen: Chosen,
    fitted: Fit,
    needed: float,
    again: Again,
) -> tuple[Found | None, Chosen]:
    """``_beside``, or what it gave of the same formula before."""
    known = frozenset((t.text, axes) for t, axes in chosen)
    if known not in done:
        done[known] = _beside(inv, name, chosen, fitted, needed, again)
    return done[known]


def _beside(
    inv: Investigation, name: str, chosen: Chosen, fitted: Fit, needed: float, again: Again
) -> tuple[Found | None, Chosen]:
    """A formula with what is found beside it, and the log-likelihood [nat] that both gain over an
    investigation; None where they gain too little. Gives the terms with the axes, too, that
    held-out rows leave them.
    """
    bare = inv.before.sensor.with_values(name, **fitted.sensor.values[name])
    beside = again(bare, inv.before.free | _keys(name, chosen))
    keys = coefficients_of(beside.after.sensor, name) & beside.after.free
    chosen = _grown(chosen, keys)
    own = fit_and_normal(beside.after)[1]
    spread = fitted_dispersion(own, keys)
    gain = fitted_gain(own, beside.after.sensor, keys)
    apart = advantage(beside.after, inv.after)
    ahead = apart / spread - PENALTY * (len(keys) + beside.brought_in - inv.brought_in)
    seen = evidence(inv.after, beside.after, inv.held)
    kept = _left(chosen, seen)
    if gain <= needed or ahead <= needed + DISPLACES * _displaced(inv, beside):
        return None, kept
    if not _confirmed(seen) or is_of_reference(inv.after, beside.after):
        return None, kept
    step = Step(name, keys, gain, needed, (), spread)
    whole = replace(beside, before=inv.before, steps=(step, *beside.steps), first=inv.first)
    kind, parts = inv.after.sensor.kind, _parted(chosen)
    text = function_text(name, kind, parts[0])
    return (ahead, whole, Formula(kind, name, *parts, CATALOGUE[name], text)), kept


def _grown(chosen: Chosen, keys: frozenset[Coefficient]) -> Chosen:
    """The terms with the axes on which one of their coefficients is among ``keys``."""
    named = coefficients([t for t, _ in chosen])
    axes = {
        t.text: {k.index[0] for c, of, _ in named if of is t for k in keys if k.parameter == c}
        for t, _ in chosen
    }
    return [(t, tuple(sorted(axes[t.text]))) for t, _ in chosen]


def _left(chosen: Chosen, seen: Evidence) -> Chosen:
    """The terms with the axes that held-out rows do not speak against."""
    denied = (seen.difference > SPEAKS) & (seen.gained < CONFIRMED * seen.difference)
    return [(t, tuple(i for i in a if not denied[i])) for t, a in chosen]


def _displaced(inv: Investigation, beside: Investigation) -> float:
    """Gain [nat] of the effects with a name that a formula would take the place of."""
    names = {s.effect for s in beside.steps}
    return sum(s.gain for s in inv.steps if s.effect not in names)


def _parted(chosen) -> tuple[tuple[Term, ...], tuple[tuple[int, ...], ...]]:
    return tuple(t for t, _ in chosen), tuple(a for _, a in chosen)


def _confirmed(seen: Evidence) -> bool:
    """Whether held-out rows gain by a formula as they must where it is true, and all rows as much
    as an effect with a name must.
    """
    if seen.raises or seen.is_little:
        return False
    gained, difference = float(seen.gained.sum()), float(seen.difference.sum())
    return difference > SET_WIDTH / 2 and gained > CONFIRMED * difference


# Terms, one after another


def _firsts(scores: Scores, needed: float) -> list[Scored]:
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


def _composed(
    start: Fit,
    name: str,
    first: Scored,
    scores: Scores,
    terms: list[Term],
    needed: float,
) -> tuple[Chosen, Fit]:
    """The terms that explain what a fit leaves, each with its axes, and the fit with them."""
    chosen: Chosen = []
    fitted, best = start, first
    while True:
        best = _sharpened(fitted.as_declared(), best)
        chosen.append((best.term, best.axes))
        fitted = _with(start, name, chosen)
        if len(chosen) == MOST_TERMS:
            break
        following = _firsts(scored(fitted.as_declared(), terms), needed)
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
    values = np.sort(_values(fit, factor))
    share = np.searchsorted(values, best.term.level) / len(values)
    width = LEVELS[1] - LEVELS[0]
    for _ in range(FINER):
        shares = np.clip(np.linspace(share - width, share + width, 11), 0.0, 1.0)
        levels = dict.fromkeys(switch(factor, float(v)) for v in np.quantile(values, shares))
        found = scored(fit, list(levels)).terms
        best = max([best, *found], key=lambda s: s.gain)
        share = np.searchsorted(values, best.term.level) / len(values)
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


def _keys(name: str, chosen: Chosen) -> frozenset[Coefficient]:
    axes = {t.text: a for t, a in chosen}
    named = coefficients([t for t, _ in chosen])
    return frozenset(Coefficient(name, c, (i,)) for c, t, _ in named for i in axes[t.text])


def _with(start: Fit, name: str, chosen: Chosen) -> Fit:
    """A fit with terms added, at its maximum likelihood."""
    made(name, start.sensor.kind, [t for t, _ in chosen])
    sensor = start.sensor.without(name).with_values(name)
    free = start.free | _keys(name, chosen)
    return fit_and_normal(replace(start, sensor=sensor, free=free).with_noise())[0]


def _backward(
    start: Fit, name: str, chosen: Chosen, fitted: Fit, needed: float
) -> tuple[Chosen, Fit]:
    """The terms less those that later ones made superfluous."""
    while len(chosen) > 1:
        normal = fit_and_normal(fitted)[1]
        named = coefficients([t for t, _ in chosen])
        gains = []
        for term, axes in chosen:
            keys = [Coefficient(name, c, (i,)) for c, t, _ in named if t is term for i in axes]
            gains.append(fitted_gain(normal, fitted.sensor, keys))
        least = int(np.argmin(gains))
        if gains[least] > needed:
            break
        chosen = [c for k, c in enumerate(chosen) if k != least]
        fitted = _with(start, name, chosen)
    return chosen, fitted
