"""The model: every coefficient, and of what was added its equation, evidence and pictures."""

from __future__ import annotations

from typing import Any

import numpy as np
from markupsafe import Markup, escape

from pyimu.identification.found.entries import Added, Changed
from pyimu.identification.found.exhibits import MOST_AXES, Cloud, Comb
from pyimu.identification.magnetometer.words import notes as field_notes
from pyimu.identification.model.as_part import SENSORS, si_of
from pyimu.identification.outcome import Outcome
from pyimu.identification.report import pictures
from pyimu.identification.report.coefficients import rows
from pyimu.identification.report.words import FEW, dependence, in_words
from pyimu.identification.verdict.verdict import instead
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.kinds import KINDS, MAGNETOMETER
from pyimu.model.part import AXES
from pyimu.report.numbers import in_unit, number, pretty, si_quantity, unit_for, with_error
from pyimu.report.page import Picture, Table, equation, prose


def models(closed: Outcome) -> list[dict[str, Any]]:
    """Each sensor with all its coefficients, or why there are none."""
    return [
        {
            "name": SENSORS[kind].capitalize(),
            "reason": closed.not_examined.get(kind, ""),
            "passed": kind in KINDS,
            "table": _model(closed, kind),
            "notes": _notes(closed, kind),
        }
        for kind in SENSORS
        if any(v.sensor == kind for v in closed.estimated) or kind in closed.not_examined
    ]


def _model(closed: Outcome, kind: str) -> Table:
    table = Table(("coefficient", "x", "y", "z", "where from"))
    for r in rows(closed, kind):
        name = Markup('<span class="words">{}<small>{}</small></span>').format(
            r.name, pretty(r.unit)
        )
        source = r.origin + (f": {r.source}" if r.source else "")
        table.rows.append((name, *map(_interval, r.cells), prose(source)))
    return table


def _interval(cell: str) -> Markup:
    """A value, its interval on a line of its own."""
    value, bracket, rest = cell.partition(" (")
    return (
        Markup("{}<small>{}{}</small>").format(value, bracket.strip(), rest)
        if rest
        else escape(cell)
    )


def _notes(closed: Outcome, kind: str) -> list[str]:
    """What no log tells the effects of the model from, and in which field a magnetometer was."""
    found = {v.effect: v.note for v in closed.estimated if v.sensor == kind and v.note}
    said = [f"{effect}: {note}." for effect, note in found.items()]
    if kind == MAGNETOMETER and closed.magnetometer is not None:
        said += field_notes(closed.magnetometer)
    return said


def added(closed: Outcome, a: Added) -> dict[str, Any]:
    """An added effect, with all that speaks for it."""
    e = CATALOGUE[a.effect]
    others = f" The data allow as well: {', '.join(a.alternatives)}." if a.alternatives else ""
    evidence = f"Gain {number(a.gain, 4)} nat, gate {number(a.gate)} nat.{others}"
    formula = next((f for f in closed.formulas if f.name == a.effect), None)
    return {
        "name": a.effect,
        "formula": None if formula is None else in_words(formula),
        "term": e.term,
        "sensor": SENSORS[a.sensor],
        "equation": equation(e.equation),
        "source": e.source,
        "parameters": _parameters(a),
        "evidence": evidence,
        "note": a.note,
        "pictures": _effect_pictures(closed, a),
    }


def _effect_pictures(closed: Outcome, a: Added) -> list[Picture]:
    most = MOST_AXES if len(closed.added) <= FEW else 1
    strongest = closed.exhibits[a.sensor].of_effect.get(a.effect, ())[:most]
    si = closed.after.sensor(a.sensor).output.unit
    return [_effect_picture(a.effect, e, si) for e in sorted(strongest, key=lambda e: e.axis)]


def _effect_picture(effect: str, e: Cloud | Comb, si: str) -> Picture:
    if isinstance(e, Comb):
        svg, what = pictures.comb(e), "where the raw samples lie between two steps"
    else:
        svg = pictures.cloud(e, effect, si)
        what = (
            "residual without and with the effect against what drives it, fitted and held-out "
            "rows; medians and quartiles"
        )
    axis = AXES[e.axis]
    return Picture(Markup(svg), f"Axis {axis}: {what}.", f"{effect} on {axis}", small=True)


def _parameters(a: Added) -> Table:
    """Every coefficient that is not zero with its standard error, in people's units and in SI."""
    table = Table(("coefficient", "value", "SI"))
    for name, (value, std, si) in a.parameters.items():
        value, std, si = (
            np.asarray(value, dtype=float),
            np.asarray(std, dtype=float),
            si_of(a.effect, name, si),
        )
        unit = "degC" if si == "degC" else unit_for(value, si)
        place = CATALOGUE[a.effect].parameters[name].place
        for index in np.ndindex(*value.shape):
            if value.ndim == 0 or value[index] != 0.0:
                shown, error = (float(in_unit(v[index], si, unit)) for v in (value, std))
                plain = with_error(float(value[index]), float(std[index]))
                table.rows.append(
                    (
                        f"{name} {place(index)}".rstrip(),
                        f"{with_error(shown, error)} {pretty(unit)}",
                        f"{plain} {pretty(si)}",
                    )
                )
    return table


def changed_table(closed: Outcome) -> Table:
    """Declared values that the data contradict."""
    table = Table(("sensor", "value", "declared", "fitted", "SI, declared", "SI, fitted"))
    for c in closed.changed:
        table.rows.extend(_changed_rows(c))
    return table


def _changed_rows(c: Changed) -> list[tuple]:
    si = si_of(c.effect, c.parameter, c.unit)
    unit = unit_for(c.declared, si)
    place, rows = CATALOGUE[c.effect].parameters[c.parameter].place, []
    for index in np.ndindex(*np.shape(c.declared)):
        had, now, std = (float(np.asarray(v)[index]) for v in (c.declared, c.fitted, c.std))
        if np.isfinite(now) and now != had:
            shown = [float(in_unit(v, si, unit)) for v in (had, now, std)]
            rows.append(
                (
                    SENSORS[c.sensor],
                    f"{c.effect}.{c.parameter} {place(index)}".rstrip(),
                    f"{number(shown[0])} {pretty(unit)}",
                    f"{with_error(*shown[1:])} {pretty(unit)}",
                    si_quantity(had, si),
                    si_quantity(now, si),
                )
            )
    return rows


def remains(closed: Outcome) -> list[str]:
    """What no effect of the catalogue explains."""
    lines = []
    if closed.unexplained:
        lines.append(f"No effect of the catalogue describes that {dependence(closed)}.")
    for s, axes in closed.drift.items():
        for i, gain in axes.items():
            wanders = f"The {SENSORS[s]} wanders more than declared on {'xyz'[i]}"
            lines.append(f"{wanders}: a larger random walk gains {number(gain)} nat.")
    return lines + [f"{said[0].upper()}{said[1:]}." for said in instead(closed.changed)]
