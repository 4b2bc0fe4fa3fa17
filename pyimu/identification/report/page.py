"""The report of ``close``: one page for people, the same in JSON, and the model, written as a whole
or not at all.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from markupsafe import Markup
from scipy.spatial.transform import Rotation

from pyimu.identification.exhibits import MOST_AXES, Cloud, Comb, Exhibits, Spectrum
from pyimu.identification.fit.score import WINDOW
from pyimu.identification.found import Added, Changed, Errors, Visibility
from pyimu.identification.outcome import Outcome
from pyimu.identification.report import pictures
from pyimu.identification.report.words import (
    FEW,
    QUANTITIES,
    SENSORS,
    dependence,
    headline,
    si_of,
)
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.part import AXES
from pyimu.report.numbers import (
    MISSING,
    in_unit,
    number,
    pretty,
    quantity,
    si_quantity,
    unit_for,
    with_error,
)
from pyimu.report.page import Picture, Table, both, equation, prose, quality_table, templates

MODEL = "model.toml"


def page(closed: Outcome, fmus: tuple[str, ...] = ()) -> str:
    """The report as one HTML page that needs nothing beside it."""
    return (
        templates("pyimu.identification.report")
        .get_template("report.html")
        .render(**_contents(closed, fmus))
    )


def _contents(closed: Outcome, fmus: tuple[str, ...]) -> dict[str, Any]:
    return {
        "verdict": closed.verdict,
        "headline": headline(closed),
        "about": _about(closed),
        "over_time": [_over_time(closed, kind, e) for kind, e in closed.exhibits.items()],
        "errors": _errors(closed),
        "error_notes": _error_notes(closed),
        "by_log": _by_log(closed),
        "log_states": _log_states(closed),
        "references": _references(closed),
        "added": [_added(closed, a) for a in closed.added],
        "refused": _refused(closed),
        "changed": _changed(closed),
        "remains": _remains(closed),
        "screenings": [
            _screening(closed, kind, e)
            for kind, e in closed.exhibits.items()
            if e.first.candidates and 0 < e.first.gate < np.inf
        ],
        "observability": _observability(closed.observability),
        "spectra": [
            _spectrum(closed, kind, e.spectrum)
            for kind, e in closed.exhibits.items()
            if e.spectrum is not None
        ],
        "quality": quality_table(closed.quality),
        "files": _files(fmus),
    }


def _about(closed: Outcome) -> str:
    count = len(closed.recordings)
    return f"{count} recording{'s' * (count != 1)}, part {closed.before.name}"


# Pictures with their captions


def _over_time(closed: Outcome, kind: str, e: Exhibits) -> Picture:
    errors, si = closed.errors.get(kind), closed.after.sensor(kind).output.unit
    floor = errors.floor.per_axis if errors and errors.floor else None
    names = [t.name for t in e.traces]
    logs = f" Dotted lines part the logs: {', '.join(names)}." if len(names) > 1 else ""
    rows = "held-out rows" if e.held_out else "fitted rows"
    caption = (
        f"{SENSORS[kind].capitalize()} residual, measured less model, on the {rows}"
        f"{_band(closed, kind)}; smallest and largest sample in each column of the picture. "
        f"Each axis has its own scale.{logs}"
    )
    return Picture(
        Markup(pictures.over_time(e.traces, floor, si)),
        caption,
        f"{SENSORS[kind]} residual over time before and after",
    )


def _band(closed: Outcome, kind: str) -> str:
    band = closed.band_hz.get(kind)
    return "" if band is None else f", below {number(band)} Hz"


def _screening(closed: Outcome, kind: str, e: Exhibits) -> Picture:
    added = [a.effect for a in closed.added if a.sensor == kind]
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
    svg = Markup(pictures.screening(e.first, e.last, added))
    return Picture(svg, caption, f"gain of each candidate effect of the {SENSORS[kind]}")


def _spectrum(closed: Outcome, kind: str, s: Spectrum) -> Picture:
    caption = (
        f"{SENSORS[kind].capitalize()} residual: root of the one-sided power spectral density, "
        f"mean of the axes (Welch, Hann window){_band(closed, kind)}. "
        "Dashed: what the noise model alone would leave."
    )
    svg = Markup(pictures.spectrum(s, closed.after.sensor(kind).output.unit))
    return Picture(svg, caption, f"spectrum of the {SENSORS[kind]} residual before and after")


# Error


def _errors(closed: Outcome) -> Table:
    table = Table(("RMS", "before", "after", "ratio", "floor"))
    for kind, e in closed.errors.items():
        table.rows.extend(_error_rows(QUANTITIES[kind], e, e.unit, "total", "per_axis"))
        if kind == "gyro":
            table.rows.extend(
                _error_rows(f"angle in {WINDOW:g} s", e, "rad", "angle", "angle_per_axis")
            )
    for name, pair, si in (
        ("log-likelihood [nat/sample]", closed.log_likelihood, ""),
        ("attitude", closed.attitude, "rad"),
    ):
        if pair is not None:
            cells = tuple(both(v, si) if si else number(v, 5) for v in pair)
            change = number(pair[1] / pair[0], 2) if si else f"{pair[1] - pair[0]:+.3g}"
            table.rows.append((prose(name), *cells, change, MISSING))
    return table


def _error_rows(name: str, e: Errors, si: str, total: str, per_axis: str) -> list[tuple]:
    """One row for all axes and one for each."""
    tallies = (e.before, e.after, e.floor)
    whole = [None if t is None else getattr(t, total) for t in tallies]
    if not np.isfinite(whole[0]):
        return []
    unit = unit_for(whole[0], si)
    rows = [(name, *_compared(whole, si, unit))]
    for i in range(3):
        values = [None if t is None else getattr(t, per_axis)[i] for t in tallies]
        if np.isfinite(values[0]):
            rows.append(
                (
                    Markup('<span class="axis">{}</span>').format("xyz"[i]),
                    *_compared(values, si, unit),
                )
            )
    return rows


def _compared(values: list, si: str, unit: str) -> tuple:
    """Before, after, ratio, floor."""
    before, after, floor = values
    ratio = number(after / before, 2) if before else MISSING
    return both(before, si, unit), both(after, si, unit), ratio, both(floor, si, unit)


def _error_notes(closed: Outcome) -> list[str]:
    where = (
        "the logs named for it"
        if closed.held_out == "holdout"
        else f"{closed.held_out} of each log"
    )
    floor = "The floor is what the white noise of sensor and reference leaves of the same number."
    notes = [f"Held out: {where}. {floor}"]
    for kind, e in closed.errors.items():
        if e.drift is not None and e.drift.total > 0:
            walk = quantity(e.drift.total, e.unit)
            whose = f"the {SENSORS[kind]}'s random walk"
            notes.append(f"Over the held-out rows {whose} may add {walk} to its floor.")
    for kind, band in closed.band_hz.items():
        if band is not None:
            notes.append(
                f"The {SENSORS[kind]}'s reference was derived from an attitude and is trusted "
                f"below {number(band)} Hz. "
                "Measurement and reference go through the same filter, and every number here is of "
                "that band."
            )
    return notes


def _by_log(closed: Outcome) -> Table:
    table = Table(
        ("recording", "samples", "held out", "sensor", "before", "after", "ratio", "floor")
    )
    for r in closed.recordings:
        head = (prose(r.file), f"{r.samples}", f"{r.held_out}")
        for kind, e in r.errors.items():
            values = [e.before.total, e.after.total, None if e.floor is None else e.floor.total]
            table.rows.append(
                (*head, SENSORS[kind], *_compared(values, e.unit, unit_for(values[0], e.unit)))
            )
            head = ("", "", "")
        if not r.errors:
            table.rows.append((*head, "fitted only", "", "", "", ""))
    return table


def _log_states(closed: Outcome) -> Table:
    table = Table(("recording", "sensor", "bias x", "bias y", "bias z", "mounting rotation", ""))
    for r in closed.recordings:
        for kind, state in r.log_state.items():
            if state:
                si = closed.after.sensor(kind).output.unit
                bias = [both(b, si, unit_for(state["bias"], si)) for b in state["bias"]]
                rest = {
                    k: v for k, v in state.items() if k not in ("bias", "rotation", "reference")
                }
                further = ", ".join(
                    f"{k.replace('_', ' ')} {number(v) if isinstance(v, float) else v}"
                    for k, v in rest.items()
                )
                turn = _turn(state.get("rotation"))
                table.rows.append((prose(r.file), SENSORS[kind], *bias, turn, prose(further)))
    return table


def _references(closed: Outcome) -> Table:
    """Of each log that moves, how its reference goes with the sensor."""
    table = Table(("recording", "sensor", "reference", "late by [ms]", "the lag is", "explains"))
    for r in closed.recordings:
        for kind, state in r.log_state.items():
            reference = state.get("reference") or {}
            if reference.get("clock"):
                share = f"{100 * reference['explained']:.4g} %"
                lag = _lag(reference["clock"])
                table.rows.append(
                    (prose(r.file), SENSORS[kind], reference["kind"], *map(prose, lag), share)
                )
    return table


def _lag(clock: dict[str, float | bool | None]) -> tuple[str, str]:
    """How late the sensor is by the reference's clock, and what became of it."""
    if clock["std"] is None:
        return "not seen", "too few rows follow the reference"
    late, least, most, std = (1e3 * clock[k] for k in ("late", "least", "most", "std"))
    if least != most:
        said = f"{number(least)} to {number(most)}"
    else:
        said = with_error(late, std)
    if clock["taken_out"]:
        return said, "the clocks', taken out"
    return said, "left to the sensor" if clock["left_to_sensor"] else "within its error"


def _turn(rotation: list | None) -> Any:
    """Angle of a rotation matrix; none where it is the identity."""
    if rotation is None:
        return MISSING
    angle = float(Rotation.from_matrix(rotation).magnitude())
    return both(angle, "rad") if angle else "none"


# Effects


def _added(closed: Outcome, a: Added) -> dict[str, Any]:
    e = CATALOGUE[a.effect]
    others = f" The data allow as well: {', '.join(a.alternatives)}." if a.alternatives else ""
    evidence = f"Gain {number(a.gain, 4)} nat, gate {number(a.gate)} nat.{others}"
    return {
        "name": a.effect,
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
        for index in np.ndindex(*value.shape):
            if value.ndim == 0 or value[index] != 0.0:
                shown, error = (float(in_unit(v[index], si, unit)) for v in (value, std))
                plain = with_error(float(value[index]), float(std[index]))
                table.rows.append(
                    (
                        name + _axes(index),
                        f"{with_error(shown, error)} {pretty(unit)}",
                        f"{plain} {pretty(si)}",
                    )
                )
    return table


def _axes(index: tuple[int, ...]) -> str:
    return f" {','.join('xyz'[i] for i in index)}" if index else ""


def _refused(closed: Outcome) -> Table:
    return Table(
        ("sensor", "effect", "gain [nat]", "why"),
        [(SENSORS[s], r.effect, number(r.gain), prose(r.reason)) for s, r in closed.refused],
    )


def _changed(closed: Outcome) -> Table:
    table = Table(("sensor", "value", "declared", "fitted", "SI, declared", "SI, fitted"))
    for c in closed.changed:
        table.rows.extend(_changed_rows(c))
    return table


def _changed_rows(c: Changed) -> list[tuple]:
    si = si_of(c.effect, c.parameter, c.unit)
    unit = unit_for(c.declared, si)
    rows = []
    for index in np.ndindex(*np.shape(c.declared)):
        had, now, std = (float(np.asarray(v)[index]) for v in (c.declared, c.fitted, c.std))
        if np.isfinite(now) and (had or now):
            shown = [float(in_unit(v, si, unit)) for v in (had, now, std)]
            rows.append(
                (
                    SENSORS[c.sensor],
                    f"{c.effect}.{c.parameter}{_axes(index)}",
                    f"{number(shown[0])} {pretty(unit)}",
                    f"{with_error(*shown[1:])} {pretty(unit)}",
                    si_quantity(had, si),
                    si_quantity(now, si),
                )
            )
    return rows


def _remains(closed: Outcome) -> list[str]:
    """What no effect of the catalogue explains."""
    lines = (
        [f"No effect of the catalogue describes that {dependence(closed)}."]
        if closed.unexplained
        else []
    )
    return lines + [
        f"The {SENSORS[s]} wanders more than declared on {'xyz'[i]}: a larger random walk gains "
        f"{number(g)} nat."
        for s, axes in closed.drift.items()
        for i, g in axes.items()
    ]


def _observability(entries: Iterable[Visibility]) -> Table:
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


# Quality and files


def _files(fmus: tuple[str, ...]) -> Table:
    rows = [
        ("report.json", "everything of this page as data"),
        (MODEL, "the model with what was added"),
    ]
    return Table(("file", "what it is"), rows + [(f, _unit_of(f)) for f in fmus])


def _unit_of(name: str) -> str:
    return (
        f"the sensor {'as it was' if name.startswith('before/') else 'with what was added'}, as a "
        "co-simulation unit"
    )
