"""What ``close`` found, for a terminal or a notebook."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from pyimu.identification.model.as_part import SENSORS, si_of
from pyimu.identification.outcome import Outcome
from pyimu.identification.report.coefficients import LEGEND, rows
from pyimu.identification.report.next import gains
from pyimu.identification.report.words import (
    AS_SET_RIGHT,
    QUANTITIES,
    gravity_at_rest,
    missing,
    named,
)
from pyimu.report.findings import in_line
from pyimu.report.lines import in_columns
from pyimu.report.numbers import in_unit, joined, number, unit_for

MOST_CANDIDATES = 8
"""Candidates that are listed; the page has all of them."""


def in_lines(closed: Outcome) -> str:
    """The findings in lines of text: verdict, what was found, the model, the error, the logs."""
    lines = [*closed.simulated.lines, ""] if closed.simulated else []
    lines += [f"verdict: {closed.verdict}" + (f" ({closed.reason})" if closed.reason else "")]
    lines += [f"  {text}" for text in (*closed.remarks, *_found(closed))]
    for kind in SENSORS:
        table = [(r.name, r.unit, *r.cells, r.origin) for r in rows(closed, kind)]
        if table:
            head = (SENSORS[kind], "", "x", "y", "z", "")
            named = [(f"  {name}", *cells) for name, *cells in table]
            lines += ["", *in_columns([head, *named])]
    if closed.estimated:
        lines += ["", LEGEND]
    lines += ["", *_errors(closed)]
    seen = (f for f in closed.quality if f.kind != "not_shown_at_rest")
    lines += [f"log: {text}" for text in in_line(seen)]
    if closed.next:
        best = closed.next[0]
        said = "; ".join((*gains(best), *([best.why] if best.why else [])))
        lines += ["", f"to measure next: {best.measure} ({said})"]
    return "\n".join(lines).rstrip()


def _found(closed: Outcome) -> Iterator[str]:
    for a in closed.added:
        yield f"added to the {SENSORS[a.sensor]}: {missing(a)}{_allowed(a.alternatives)}"
        if a.note:
            yield f"  {a.note}"
    for c in closed.changed:
        si = si_of(c.effect, c.parameter, c.unit)
        unit = unit_for(c.declared, si)
        had, now = (_short(in_unit(v, si, unit)) for v in (c.declared, c.fitted))
        said = f"{c.sensor} {c.effect}.{c.parameter}: declared {had}, found {now} {unit}"
        yield said + _allowed(c.alternatives)
    beside = [c for c in closed.candidates if c.outcome not in ("added", "changed")]
    for c in beside[:MOST_CANDIDATES]:
        yield f"{c.sensor} {named(c.effect)}, {c.outcome}: {c.reason}"
    if len(beside) > MOST_CANDIDATES:
        yield f"and {len(beside) - MOST_CANDIDATES} candidates more, on the page"
    for u in closed.unexplained:
        inputs = f"depends on {' x '.join(u.depends_on)} (p = {u.p_value:.1g})"
        yield f"unexplained: {u.sensor} {u.axis} {f'is {u.shape}' if u.shape else inputs}"


def _allowed(alternatives: Iterable[str]) -> str:
    names = joined([named(e) for e in alternatives])
    return f"; the data allow as well: {names}" if names else ""


def _short(values: np.ndarray) -> str:
    texts = [number(float(v)) for v in np.ravel(values)]
    return texts[0] if len(set(texts)) == 1 else f"[{', '.join(texts)}]"


def _errors(closed: Outcome) -> Iterator[str]:
    """Before and after in one unit, what is left of it, and how far that is from the floor."""
    where = "the logs held out" if closed.held_out == "holdout" else f"the {closed.held_out}"
    for kind, e in closed.errors.items():
        if not np.isfinite(e.before.total):
            continue
        values = (e.before.total, e.after.total)
        left = f", {_share(values[1] / values[0])} of it" if values[0] > 0 else ""
        floor = ""
        if e.floor is not None and e.floor.total > 0:
            times = number(values[1] / e.floor.total, 2)
            unit = unit_for(values[0], e.unit)
            least = number(float(in_unit(e.floor.total, e.unit, unit)))
            floor = f", {times} times the floor of {least} {unit}"
            if e.noise > 1.01 * e.floor.total:
                slow = number(values[1] / e.noise, 2)
                what = "the random walk that may be in it" if e.named is None else "all its noise"
                floor += f" ({slow} times with {what})"
        rows = e.data or where
        yield f"{QUANTITIES[kind]} residual on {rows}: {_fall(values, e.unit)}{left}{floor}"
    yield from map(gravity_at_rest, closed.at_rest)
    for name, note in (("attitude", f" ({AS_SET_RIGHT})"), ("heading", "")):
        pair = getattr(closed, name)
        if pair is not None:
            yield f"{name} error{note}: {_fall(pair, 'rad')}, {_share(pair[1] / pair[0])} of it"


def _share(ratio: float) -> str:
    """What is left, with a figure more where that is nearly all."""
    return number(ratio, 3 if 0.9 < ratio < 1.1 else 2)


def _fall(values: tuple[float, float], si: str) -> str:
    unit = unit_for(values[0], si)
    before, after = (number(float(in_unit(v, si, unit))) for v in values)
    return f"{before} -> {after} {unit}"
