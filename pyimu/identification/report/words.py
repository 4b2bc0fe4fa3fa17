"""What ``close`` found in sentences: the verdict, an effect with its coefficients."""

from __future__ import annotations

import numpy as np

from pyimu.identification.fit.score import WINDOW
from pyimu.identification.formula.effect import TERM, coefficients
from pyimu.identification.formula.formula import Formula
from pyimu.identification.found.entries import Added, AtRest, Errors
from pyimu.identification.model.as_part import SENSORS, si_of
from pyimu.identification.noise.shapes import SHAPES
from pyimu.identification.outcome import Outcome
from pyimu.identification.search.leftover import Unexplained
from pyimu.model.arguments import Parameter
from pyimu.model.catalogue import CATALOGUE
from pyimu.report.numbers import (
    in_unit,
    joined,
    number,
    pretty,
    quantity,
    unit_for,
)

AS_SET_RIGHT = f"heading set right every {WINDOW:g} s where none is recorded"
"""What the attitude before and after is compared as."""

QUANTITIES = {"gyro": "rate", "accel": "specific force", "mag": "magnetic field"}

FEW = 2
"""Up to so many effects of a sensor are said with their coefficients; more only by name, or nobody
reads to the end."""


def headline(closed: Outcome) -> str:
    """The verdict as a person would say it."""
    sentences = {
        "named": _named,
        "partly": _named,
        "not_confirmed": _not_confirmed,
        "unexplained": _unexplained,
        "drift": _drift,
        "clean": _clean,
        "reference_unfit": _unfit,
    }
    said = sentences.get(closed.verdict, _undecidable)(closed)
    return " ".join([said, *(f"{r[0].upper()}{r[1:]}." for r in closed.remarks)])


def _not_confirmed(closed: Outcome) -> str:
    return f"Nothing is confirmed: {closed.reason}.{_level(closed)}"


def _unfit(closed: Outcome) -> str:
    return f"The reference does not belong to this sensor: {closed.reason}."


def _named(closed: Outcome) -> str:
    parts = []
    for kind in dict.fromkeys(a.sensor for a in closed.added):
        added = [a for a in closed.added if a.sensor == kind]
        symptoms = dict.fromkeys(CATALOGUE[a.effect].symptom for a in added)
        does = joined([symptom for symptom in symptoms if symptom])
        what = (
            ", and ".join(map(missing, added))
            if len(added) <= FEW
            else joined([a.effect.replace("_", " ") for a in added])
        )
        subject = f"The {SENSORS[kind]} {does}: {what}" if does else f"The {SENSORS[kind]}: {what}"
        parts.append(f"{subject}{_were(len(added))} missing from the model.")
        if kind in closed.errors:
            parts.append(fall(kind, closed.errors[kind]))
    if not closed.added:
        parts.append(f"The model lacks {closed.reason}.")
    if closed.unexplained:
        parts.append(f"Something is still unexplained: {dependence(closed)}.")
    return " ".join(parts)


def _were(count: int) -> str:
    return " was" if count == 1 else ", were" if count <= FEW else " were"


def _unexplained(closed: Outcome) -> str:
    if closed.formulas:
        return _by_formula(closed)
    if not closed.unexplained:
        return f"More than noise is left: {closed.reason}.{_level(closed)}"
    return (
        "Something is missing that no effect of the catalogue describes: "
        f"{dependence(closed)}.{_level(closed)}"
    )


def _by_formula(closed: Outcome) -> str:
    """An error that has a formula and no name."""
    parts = ["Something is missing that no effect of the catalogue describes."]
    for f in closed.formulas:
        parts.append(f"Of the {SENSORS[f.sensor]} a formula does, {TERM}: c * ({f.said}).")
        if f.sensor in closed.errors:
            parts.append(fall(f.sensor, closed.errors[f.sensor]))
    return " ".join(parts)


def in_words(f: Formula) -> str:
    """A formula, and what it looks like in the catalogue."""
    named = coefficients(f.terms)
    y = "rate" if f.sensor == "gyro" else "specific force"
    terms = [f"{c} * {t.in_text(k)}" for c, t, k in named]
    like = [f"{n.replace('_', ' ')} ({r:.2f})" for n, r in f.resembles]
    looks = (
        f"In these logs it looks like {joined(like)} (correlation with the best the effect "
        "could make of it)."
        if like
        else "In these logs it looks like no effect of the catalogue."
    )
    return f"{y} measured = {y} + {' + '.join(terms)}, on each axis with its own factor. {looks}"


def _drift(closed: Outcome) -> str:
    where = joined(
        [
            f"the {SENSORS[s]} on {joined(['xyz'[i] for i in axes])}"
            for s, axes in closed.drift.items()
        ]
    )
    return (
        f"The bias of {where} wanders more than the model declares: it follows an input that "
        f"nobody logged.{_level(closed)}"
    )


def _clean(closed: Outcome) -> str:
    count = len(closed.changed)
    correct = (
        f" {count} declared value{'s' * (count > 1)} should be corrected (see below)."
        if count
        else ""
    )
    return f"Nothing is missing: what the model leaves looks like noise.{_level(closed)}{correct}"


def _undecidable(closed: Outcome) -> str:
    if closed.errors and closed.reason.startswith("nothing is missing"):
        return f"These logs decide a part of it: {closed.reason}.{_level(closed)}"
    return f"These logs cannot decide it: {closed.reason.rstrip('.') or 'too little to go by'}."


def _level(closed: Outcome) -> str:
    said: dict[str, list[str]] = {}
    for k, e in closed.errors.items():
        if np.isfinite(e.after.total):
            residual = f"the {QUANTITIES[k]} residual is {quantity(e.after.total, e.unit)}"
            said.setdefault(judged_on(e), []).append(residual)
    return "".join(f" On {where} {joined(each)}." for where, each in said.items())


def judged_on(e: Errors) -> str:
    """What was left out of the fit and judged by it."""
    return f"{e.data}, left out of the fit," if e.data else "held-out data"


def dependence(closed: Outcome) -> str:
    """On what the residual still depends."""
    return joined(
        [f"the {SENSORS[u.sensor]} residual on {u.axis} {_does(u)}" for u in closed.unexplained]
    )


def _does(u: Unexplained) -> str:
    if u.shape:
        looks = SHAPES.get(u.shape)
        return f"is {u.shape}" + (f": {looks}" if looks else "")
    return f"depends on {joined([_input(d) for d in u.depends_on])} (p = {number(u.p_value, 1)})"


def _input(name: str) -> str:
    head, _, axis = name.rpartition("_")
    return f"{head.replace('_', ' ')} {axis}" if axis in ("x", "y", "z") else name.replace("_", " ")


def fall(kind: str, e: Errors) -> str:
    """Before and after in one sentence."""
    before, after = e.before.total, e.after.total
    unit = unit_for(before, e.unit)
    old, new = (number(float(in_unit(v, e.unit, unit))) for v in (before, after))
    lead = f"The {QUANTITIES[kind]} residual on {judged_on(e)}"
    if not before > 0.0 or not np.isfinite(after):
        return f"{lead} could not be compared."
    ratio = after / before
    if abs(ratio - 1.0) < 0.005:
        return f"{lead} stays at {new} {pretty(unit)}."
    return (
        f"{lead} {'falls' if ratio < 1 else 'rises'} from {old} to {new} {pretty(unit)}, to "
        f"{number(ratio, 2)} of what it was."
    )


def missing(a: Added) -> str:
    """An effect with its coefficients: ``saturation at 421 and 424 deg/s on x and y``."""
    given = {n: v for n, (v, _, _) in a.parameters.items() if np.any(v)} or a.parameters
    name, e = next(iter(given)), CATALOGUE[a.effect]
    value, _, si = a.parameters[name]
    return f"{e.phrase} {coefficient(value, si_of(a.effect, name, si), e.parameters[name])}"


def named(effect: str) -> str:
    """The key of an effect and the field's name of it: ``saturation (input range)``."""
    known = CATALOGUE.get(effect)
    words = known.term.partition(",")[0].partition(" (")[0] if known else ""
    return effect if words in ("", effect.replace("_", " ")) else f"{effect} ({words})"


def coefficient(value: np.ndarray, si: str, definition: Parameter) -> str:
    """A coefficient in words: every axis that has one; of a matrix the largest entry."""
    value = np.asarray(value, dtype=float)
    unit = unit_for(value, si)
    shown = in_unit(value, si, unit)
    if value.ndim == 0 or not np.any(value):
        return f"{number(float(shown.flat[0]))} {pretty(unit)}".rstrip()
    if value.ndim == 1:
        on = np.flatnonzero(value)
        numbers = f"{joined([number(float(shown[i])) for i in on])} {pretty(unit)}".rstrip()
        return f"{numbers} on {joined([definition.place((int(i),)) for i in on])}"
    i, j = map(int, np.unravel_index(np.nanargmax(np.abs(shown)), shown.shape))
    return f"up to {number(float(abs(shown[i, j])))} {pretty(unit)} ({definition.place((i, j))})"


def gravity_at_rest(g: AtRest) -> str:
    """How far gravity at rest is off, as measured and with each position or turn left out."""
    of, fold = ("size", "position") if g.sensor == "accel" else ("direction", "turn")
    if not g.judged:
        return f"gravity's {of}: no {fold} at rest can be judged by the {g.folds - 1} others"
    unit = unit_for(g.as_measured, g.unit)
    said = [
        f"{number(float(in_unit(v, g.unit, unit)))} {pretty(unit)}"
        for v in (g.as_measured, g.before, g.after)
    ]
    return (
        f"gravity's {of} at rest is off by {said[0]} as measured; each of {g.folds} {fold}s left "
        f"out in turn, by {said[1]} before and {said[2]} after"
    )
