"""The candidates: how they compared, what became of each, and what the logs could show."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from markupsafe import Markup

from pyimu.identification.found.entries import Visibility
from pyimu.identification.found.exhibits import Exhibits
from pyimu.identification.model.as_part import SENSORS, si_of
from pyimu.identification.outcome import Outcome
from pyimu.identification.report import pictures
from pyimu.identification.verdict.fates import Fate
from pyimu.model.catalogue import CATALOGUE
from pyimu.report.numbers import MISSING, joined, number
from pyimu.report.page import Picture, Table, both, prose


def screenings(closed: Outcome) -> list[Picture]:
    """The gain of each candidate at the first look and at the last."""
    return [
        _screening(closed, kind, e)
        for kind, e in closed.exhibits.items()
        if e.first is not None and e.first.candidates and 0 < e.first.gate < np.inf
    ]


def fate_table(closed: Outcome) -> Table:
    """What became of each candidate above the gate, and why."""
    head = (
        "sensor",
        "candidate",
        "first look",
        "fitted in full",
        "last look",
        "what became of it",
        "why",
    )
    return Table(
        head,
        [
            (
                SENSORS[c.sensor],
                prose(c.effect),
                _nat(c.gain),
                _nat(c.fitted),
                _nat(c.last),
                c.outcome,
                prose(c.reason),
            )
            for c in closed.candidates
        ],
    )


def _nat(gain: float | None) -> str:
    return MISSING if gain is None else f"{number(gain)} nat" if gain > 0 else "nothing"


def _screening(closed: Outcome, kind: str, e: Exhibits) -> Picture:
    added = [a.effect for a in closed.added if a.sensor == kind]
    fates = [c for c in closed.candidates if c.sensor == kind]
    fitted = {c.effect: c.fitted for c in fates if c.fitted is not None}
    caption = (
        f"{SENSORS[kind].capitalize()}: how much each absent effect would explain. "
        "Bars: the first look, before anything was added. "
        f"Gate {number(e.first.gate)} nat: chance alone passes it once in a hundred."
    )
    if e.last is not e.first:
        caption += (
            " Diamonds: what remains to be explained after the last addition "
            f"(gate {number(e.last.gate)} nat)."
        )
    caption += _led(fates, fitted)
    svg = Markup(pictures.screening(e.first, e.last, added, fitted))
    return Picture(svg, caption, f"gain of each candidate effect of the {SENSORS[kind]}")


def _led(fates: list[Fate], fitted: dict[str, float]) -> str:
    """What the picture shows of candidates that stand above one that was added."""
    if not fitted:
        return ""
    said = (
        " Dots, and numbers behind an arrow: what each explains alone once it is fitted in full, "
        "which decides; the first look takes slopes where the effect is nought and the noise as it "
        "was, and only picks the few that are worth it."
    )
    chosen = [c for c in fates if c.outcome == "added" and c.gain is not None and c.fitted]
    ahead = [
        c
        for c in fates
        if chosen
        and c.outcome not in ("added", "refused")
        and (c.gain or 0.0) > min(a.gain or 0.0 for a in chosen)
    ]
    kept = joined([f"{a.effect} {_nat(a.fitted)}" for a in chosen])
    as_much = [c for c in ahead if c.outcome == "alternative"]
    less = [c for c in ahead if c.outcome != "alternative"]
    for some, why in (
        (less, "though they led at the first look"),
        (as_much, "which these data do not tell apart: the plainest goes in"),
    ):
        told = [f"{c.effect} {_nat(c.fitted)}" for c in some if c.fitted is not None]
        if told:
            said += f" So {joined(told)} against {kept}, {why}."
    return said


def observability_table(entries: Iterable[Visibility]) -> Table:
    """The smallest coefficient of each absent effect that the logs would show."""
    table = Table(
        ("sensor", "effect", "smallest visible", "looks like, in these logs", "not visible because")
    )
    for v in entries:
        first = next(iter(CATALOGUE[v.effect].parameters), "") if v.effect in CATALOGUE else ""
        seen = (
            MISSING
            if v.smallest_visible is None
            else both(v.smallest_visible, si_of(v.effect, first, v.unit))
        )
        table.rows.append(
            (
                SENSORS[v.sensor],
                v.effect,
                seen,
                prose(", ".join(v.inseparable_from) or MISSING),
                prose(v.reason),
            )
        )
    return table
