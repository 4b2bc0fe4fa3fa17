"""The simplest formula for what no effect of the catalogue describes.

Terms are taken one after another, each beside all that went before, by the rules for effects: gain
over a gate that chance passes in one log of a hundred, a penalty for each coefficient, held-out
rows that must gain by it. What the loop had named is then looked for anew beside the formula:
effects that only mimicked it are not found again.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from pyimu.display.silent import silent
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.keys import Coefficient, coefficients_of
from pyimu.identification.fit.maximum_likelihood import advantage, fit_and_normal
from pyimu.identification.formula.compose import (
    Chosen,
    borne,
    composed,
    firsts,
    keys_of_terms,
    with_terms,
)
from pyimu.identification.formula.effect import (
    coefficients,
    free_name,
    function_text,
    put,
)
from pyimu.identification.formula.formula import Formula
from pyimu.identification.formula.judge import (
    DOUBTFUL,
    is_confirmed,
    is_denied,
    left_of,
    outweighs,
)
from pyimu.identification.formula.memory import Remembered
from pyimu.identification.formula.resembles import resembled
from pyimu.identification.formula.screen import UNEXPLAINED, Scores, gate, scored
from pyimu.identification.formula.terms import (
    Term,
    library,
)
from pyimu.identification.search.choice import SET_WIDTH
from pyimu.identification.search.confirm import evidence
from pyimu.identification.search.inexact import left_by_forms
from pyimu.identification.search.investigation import Investigation, Refused, Step
from pyimu.identification.search.leftover import Unexplained
from pyimu.identification.search.own_lag import has_lag
from pyimu.identification.search.own_signal import is_of_reference
from pyimu.identification.search.rounded import within_digits, without_rounding
from pyimu.identification.search.screen import PENALTY, fitted_dispersion, fitted_gain
from pyimu.model.catalogue import CATALOGUE

MOSTLY = 0.5
"""Share of the power of what a formula adds from which on another effect would add most of it."""

Again = Callable[..., Investigation]


@dataclass(frozen=True)
class Found:
    """A formula with what is found beside it: by how much [nat] both are ``ahead`` of what the loop
    had named; ``shown`` is whether held-out rows tell it from nothing.
    """

    ahead: float
    investigation: Investigation
    formula: Formula
    shown: bool


Done = dict[frozenset[tuple[str, tuple[int, ...]]], tuple[Found | None, Chosen]]
"""What became of each formula, by its terms' texts and axes, that was investigated in full."""


@dataclass(frozen=True)
class Look:
    """What was made of what an investigation left; where no formula was found, ``memory`` is what
    this remembers of the motion, and ``inconstant`` what comes of effects that are no constants.
    """

    investigation: Investigation
    formula: Formula | None = None
    unexplained: Unexplained | None = None
    memory: Remembered | None = None
    inconstant: tuple[Unexplained, ...] = ()


def look(
    inv: Investigation,
    again: Again,
    say: Callable[[str], None] = silent,
) -> Look:
    """Look for a formula for what an investigation left.

    ``again(sensor, free, believed=False, lags=True)`` investigates with one in the model, or what
    may be noise of the reference believed; without ``lags`` that clocks hide, where none was found.
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
    fires = left.p_value < UNEXPLAINED and not _is_rounding(judged, terms)
    if not fires and not _may_be_one(inv):
        return Look(inv)
    # By the noise that it shows itself: a residual that wanders more than is declared follows many
    # a slow input by chance.
    seen = left if judged is inv.after or not fires else scored(inv.after, terms)
    if fires and seen.p_value < UNEXPLAINED and _is_of_reference(judged, left):
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
    best = max(found, key=lambda f: (f.shown, f.ahead), default=None)
    if best is not None:
        after, formula = best.investigation, best.formula
        put(formula.effect)
        formula = replace(formula, resembles=resembled(after, formula))
        new = formula.is_new(after.steps[0])
        if _is_no_sensors(best, formula, inv):
            CATALOGUE.remove(formula.name)
            return Look(inv, None, _unexplained(kind, seen) if fires else None)
        if new and best.shown:
            return Look(after, formula, _unexplained(kind, scored(after.after, terms)))
        CATALOGUE.remove(formula.name)
        if new:
            left_open = _left_open(best, _displaced(inv, after))
            return Look(left_open, None, _unexplained(kind, scored(left_open.after, terms)))
    if not fires:
        return Look(inv)
    return Look(inv, None, _unexplained(kind, seen))


def _may_be_one(inv: Investigation) -> bool:
    """Whether what was found may be parts of one thing that has no name: several effects, or a line
    in time, as what goes round with the heading leaves it where that turns steadily.
    """
    named = [CATALOGUE[s.effect] for s in inv.steps if not s.declared]
    return len(named) > 1 or any(e.is_line for e in named)


def _is_rounding(fit: Fit, terms: list[Term]) -> bool:
    """Whether nothing is left that depends on inputs beside the rounding of the references."""
    beside = without_rounding(fit)
    return beside is not None and scored(beside, terms).p_value >= UNEXPLAINED


def _is_of_reference(left: Fit, scores: Scores) -> bool:
    """Whether the clearest dependence is only what a reference's noise makes look like one."""
    if not any(t.doubt for t in left.trials):
        return False
    best, name = min(scores.terms, key=lambda s: s.p_value), free_name()
    try:
        return is_of_reference(left, with_terms(left, name, [(best.term, (best.axis,))]), DOUBTFUL)
    finally:
        if name in CATALOGUE:
            CATALOGUE.remove(name)


def _is_no_sensors(best: Found, formula: Formula, inv: Investigation) -> bool:
    """Whether an effect of a size that no sensor has would add most of what a formula does, and
    explains as much: what makes the reference look like the one makes it look like the other.
    """
    alike = {name for name, r in formula.resembles if r**2 > MOSTLY}
    refused = [r for r in inv.refused if r.beyond_belief and r.effect in alike]
    return best.ahead <= max((r.gain for r in refused), default=-np.inf) + SET_WIDTH


def _unexplained(kind: str, scores: Scores) -> Unexplained | None:
    """The term on which a residual depends most clearly, if on any."""
    if scores.p_value >= UNEXPLAINED:
        return None
    # Of terms that say the same but for rounding the plainest.
    s = min(scores.terms, key=lambda s: (float(f"{s.p_value:.6g}"), s.term.size))
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
    axes on which these speak against it; else one of which they show nothing, where that explains
    more than what has a name; None where there is neither. What is ``done`` is not done again: a
    whole investigation is long.
    """
    name, needed = free_name(), max(gate(scores), left_by_forms(start, inv.steps))
    rival: Found | None = None

    def left(chosen: Chosen, fitted: Fit) -> Chosen:
        return left_of(chosen, evidence(start, fitted, inv.held))

    def bears(chosen: Chosen, fitted: Fit) -> bool:
        return any(axes for _, axes in left(chosen, fitted))

    try:
        for first in firsts(scores, needed):
            chosen, fitted = composed(start, name, first, scores, terms, needed, bears)
            # Held-out rows refuse most formulas.
            kept, found = left(chosen, fitted), None
            if kept == chosen:
                found, kept = _once(done, inv, start, name, chosen, fitted, needed, again)
            fewer = [(t, a) for t, a in kept if a]
            if found is None and fewer and kept != chosen:
                fitted = with_terms(start, name, fewer)
                found, _ = _once(done, inv, start, name, fewer, fitted, needed, again)
            if found is not None and found.shown:
                return found
            rival = rival or found
        return rival
    finally:
        if name in CATALOGUE:
            CATALOGUE.remove(name)


def _once(
    done: Done,
    inv: Investigation,
    start: Fit,
    name: str,
    chosen: Chosen,
    fitted: Fit,
    needed: float,
    again: Again,
) -> tuple[Found | None, Chosen]:
    """``_beside``, or what it gave of the same formula before; nothing where the formula beside all
    that was found, which has whatever it may explain, is denied, or is not confirmed and explains
    too little to take the place of any of it: an investigation is long, and asks the same of what
    it leaves.
    """
    known = frozenset((t.text, axes) for t, axes in chosen)
    if known not in done:
        beyond = fitted if start is inv.after else with_terms(inv.after, name, chosen)
        seen = evidence(inv.after, beyond, inv.held)
        keys = keys_of_terms(name, chosen)
        most = advantage(beyond, inv.after) - PENALTY * (len(keys) - inv.brought_in)
        may_displace = bool(inv.steps) and most > needed
        denied = is_denied(inv, beyond, seen) or within_digits(inv.after, beyond)
        if (may_displace or is_confirmed(seen)) and not denied:
            done[known] = _beside(inv, name, chosen, fitted, needed, again)
        else:
            done[known] = None, left_of(chosen, seen)
    return done[known]


def _beside(
    inv: Investigation, name: str, chosen: Chosen, fitted: Fit, needed: float, again: Again
) -> tuple[Found | None, Chosen]:
    """A formula with what is found beside it, where both gain enough over an investigation and
    nothing denies it. Gives the terms with the axes, too, that what is found beside them and
    held-out rows leave them.
    """
    bare = inv.before.sensor.with_values(name, **fitted.sensor.values[name])
    free = inv.before.free | keys_of_terms(name, chosen)
    beside = again(bare, free, lags=has_lag(inv.before))
    keys = coefficients_of(beside.after.sensor, name) & beside.after.free
    chosen, own = _grown(chosen, keys), fit_and_normal(beside.after)[1]
    left = borne(own, beside.after.sensor, name, chosen, needed)
    if left != chosen:
        return None, left
    spread = fitted_dispersion(own, keys)
    gain = fitted_gain(own, beside.after.sensor, keys)
    apart = advantage(beside.after, inv.after)
    ahead = apart / spread - PENALTY * (len(keys) + beside.brought_in - inv.brought_in)
    seen = evidence(inv.after, beside.after, inv.held)
    kept, displaced = left_of(chosen, seen), _displaced(inv, beside)
    if gain <= needed or not outweighs(displaced, ahead, seen, needed):
        return None, kept
    shown = is_confirmed(seen)
    if not (shown or displaced) or is_denied(inv, beside.after, seen):
        return None, kept
    if not shown:
        # What it explains of held-out rows, what it displaces may explain nearly as well.
        alone = evidence(_less(beside.after, name, keys), beside.after, inv.held)
        shown = is_confirmed(alone)
    step = Step(name, keys, gain, needed, (), spread)
    whole = replace(beside, before=inv.before, steps=(step, *beside.steps), first=inv.first)
    kind, parts = inv.after.sensor.kind, _parted(chosen)
    text = function_text(name, kind, parts[0])
    return Found(ahead, whole, Formula(kind, name, *parts, CATALOGUE[name], text), shown), kept


def _less(after: Fit, name: str, keys: frozenset[Coefficient]) -> Fit:
    """A fit without a formula."""
    sensor, free = after.sensor.without(name), after.free - keys
    return fit_and_normal(replace(after, sensor=sensor, free=free).with_noise())[0]


def _left_open(rival: Found, displaced: list[Step]) -> Investigation:
    """What is found beside a formula that held-out rows show nothing of, without the formula, and
    what it displaced as refused: nothing tells that the loop had the right one.
    """
    whole, formula = rival.investigation, rival.formula
    step, *beside = whole.steps
    reason = f"{formula.said} explains {rival.ahead:.0f} nat more, and held-out rows do not test it"
    refused = tuple(Refused(s.effect, s.gain, reason) for s in displaced)
    after = _less(whole.after, formula.name, step.keys)
    return replace(whole, after=after, steps=tuple(beside), refused=(*whole.refused, *refused))


def _grown(chosen: Chosen, keys: frozenset[Coefficient]) -> Chosen:
    """The terms with the axes on which one of their coefficients is among ``keys``."""
    named = coefficients([t for t, _ in chosen])
    axes = {
        t.text: {k.index[0] for c, of, _ in named if of is t for k in keys if k.parameter == c}
        for t, _ in chosen
    }
    return [(t, tuple(sorted(axes[t.text]))) for t, _ in chosen]


def _displaced(inv: Investigation, beside: Investigation) -> list[Step]:
    """The effects with a name that a formula takes the place of."""
    names = {s.effect for s in beside.steps}
    return [s for s in inv.steps if s.effect not in names]


def _parted(chosen) -> tuple[tuple[Term, ...], tuple[tuple[int, ...], ...]]:
    return tuple(t for t, _ in chosen), tuple(a for _, a in chosen)
