"""The report of ``characterize``: one page for people, the same in JSON, and the part, written as a
whole or not at all.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
from markupsafe import Markup, escape

from pyimu.characterization.allan.moments import TERMS
from pyimu.characterization.evidence import Comb, Excerpt, Steps, Timeline
from pyimu.characterization.noise.coefficients import Coefficient
from pyimu.characterization.report import pictures
from pyimu.characterization.report.words import (
    FURTHER,
    PEOPLE,
    READING_ORDER,
    SENSORS,
    TERM_NAMES,
    about,
    digits,
    doubts,
    fit_notes,
    frequency,
    grouped,
    headline,
    loop_sentence,
    reason_lines,
    searched,
    span,
    spectrum_note,
    split,
    thermal_sentence,
)
from pyimu.characterization.result import (
    SAMPLE,
    SI,
    Characterization,
    LogResult,
    Summary,
    floor,
    read_instability,
)
from pyimu.files import check_folder, staged, write_json, write_text
from pyimu.model.part import AXES
from pyimu.model.part_file import save_part
from pyimu.report.numbers import MISSING, SCRIPTS, in_unit, number, pretty, unit_for
from pyimu.report.page import Picture, Table, prose, templates

PART = "part.toml"


def write_characterization(c: Characterization, out: str | os.PathLike) -> Path:
    """Write ``report.html``, ``report.json`` and ``part.toml`` into the folder ``out``; returns the
    page's path.

    The three files take the place of earlier ones only once all are written. Raises UserError
    where the folder cannot be written.
    """
    out = Path(out)
    name = (
        c.logs[0].name
        if len(c.logs) == 1
        else os.path.commonprefix([log.name for log in c.logs]).strip("_-. ") or "characterised"
    )
    with staged(out) as stage:
        write_text(stage / "report.html", page(c))
        write_json(stage / "report.json", c.as_dict())
        save_part(c.part(name), stage / PART)
    return out / "report.html"


def check_delivery(out: str | os.PathLike) -> None:
    """Raise UserError now for what would else end ``write_characterization`` after all the work: a
    folder that is none.
    """
    check_folder(out)


def page(c: Characterization) -> str:
    """The report as one HTML page that needs nothing beside it."""
    return (
        templates("pyimu.characterization.report")
        .get_template("report.html")
        .render(**_contents(c))
    )


def _contents(c: Characterization) -> dict[str, Any]:
    return {
        "title": ", ".join(log.name for log in c.logs),
        "headline": headline(c),
        "logs": [f"{log.name}: {about(log)}" for log in c.logs],
        "notes": [line for log in c.logs for line in (*doubts(log), *split(log))] + reason_lines(c),
        "level": f"{100 * c.level:g}",
        "sensors": [_sensor(c, kind) for kind in c.kinds],
        "thermal": _thermal(c),
        "thermal_reasons": _thermal_reasons(c),
        "quality": _quality(c),
        "evidence": _evidence(c),
        "overviews": [_overview(log, kind) for log in c.logs for kind in log.sensors],
        "by_log": _by_log(c),
        "files": Table(
            ("file", "what it is"),
            [
                ("report.json", "everything of this page as data, and all curves"),
                (PART, "the part, for pyimu build, pyimu close and pyimu parts"),
            ],
        ),
    }


# A sensor


def _sensor(c: Characterization, kind: str) -> dict[str, Any]:
    name, several = SENSORS[kind], len(c.logs) > 1
    if not any(ch.noise for axis in AXES for ch in c.channel(f"{kind}_{axis}")):
        return {
            "name": name,
            "allan": None,
            "coefficients": Table(("",)),
            "notes": [],
            "others": None,
            "spectra": [],
            "lines": Table(("",)),
            "searched": [],
        }
    caption = (
        f"{name.capitalize()}: overlapping Allan deviation, measured and fitted; dotted, each term "
        "of the fit by itself."
        + (
            f" {len(c.logs)} logs."
            if several
            else " The interval is that of the degrees of freedom which the fitted noise leaves."
        )
    )
    others = (
        f"{name.capitalize()}: the modified deviation tells quantization from white noise, the "
        "Hadamard deviation does not see a ramp." + (f" Log {c.logs[0].name}." if several else "")
    )
    return {
        "name": name,
        "allan": Picture(
            Markup(pictures.allan(c, kind)), caption, f"Allan deviation of the {name}"
        ),
        "coefficients": _coefficients(c, kind),
        "notes": _notes(c, kind),
        "others": Picture(
            Markup(pictures.other_deviations(c, kind)), others, f"further deviations of the {name}"
        ),
        "spectra": [
            p for log in c.logs if kind in log.sensors and (p := _spectrum(log, kind, several))
        ],
        "lines": _lines(c, kind),
        "searched": list(
            dict.fromkeys(searched(log.sensors[kind]) for log in c.logs if kind in log.sensors)
        ),
    }


def _coefficients(c: Characterization, kind: str) -> Table:
    table = Table(("coefficient", *AXES))
    for term in READING_ORDER:
        found = [c.coefficients.get((f"{kind}_{axis}", term)) for axis in AXES]
        name = Markup('<span class="words"><b>{}</b> {}<small>{}</small></span>').format(
            term, TERM_NAMES[kind][term], pretty(PEOPLE[kind][term])
        )
        table.rows.append((name, *(_cell(s, SI[kind][term], PEOPLE[kind][term]) for s in found)))
        if term == "N":
            table.rows.extend(_further(kind, found))
    for title, f, unit in (
        ("lowest Allan deviation", lambda n: floor(n)[0], PEOPLE[kind]["B"]),
        ("B as read off it", read_instability, PEOPLE[kind]["B"]),
    ):
        cells = [[f(ch.noise) for ch in c.channel(f"{kind}_{axis}") if ch.noise] for axis in AXES]
        note = f"{pretty(unit)}" + (", over 0.664" if f is read_instability else "")
        shown = (_plain(np.mean(v), SAMPLE[kind], unit) if v else MISSING for v in cells)
        table.rows.append(
            (Markup('<span class="words">{}<small>{}</small></span>').format(title, note), *shown)
        )
    return table


def _cell(s: Summary | None, si: str, unit: str) -> Any:
    """A coefficient with its interval in people's unit, and in SI."""
    if s is None:
        return MISSING
    spread = f" ± {number(float(in_unit(s.spread, si, unit)), 2)}" if np.isfinite(s.spread) else ""
    shown = _span(s.mean, si, unit) + escape(spread)
    return (
        shown
        if unit == si
        else Markup("{}<small>{}</small>").format(shown, f"{_short(s.mean)} {pretty(si)}")
    )


def _span(c: Coefficient, si: str, unit: str) -> Markup:
    text = span(c, si, unit)
    value, bracket, rest = text.partition(" (")
    return Markup('{}<span class="interval">{}{}</span>').format(value, bracket, rest)


def _short(c: Coefficient) -> str:
    """In SI: value and interval, on one power of ten."""
    if not c.needed:
        return f"< {number(c.high)}" if np.isfinite(c.high) else MISSING
    size = int(np.floor(np.log10(c.value)))
    scale = 1.0 if -3 <= size < 4 else 10.0**size
    value, low, high = (number(v / scale, digits(c)) for v in (c.value, c.low, c.high))
    if scale == 1.0:
        return f"{value} ({low} to {high})"
    return f"{value} ({low} to {high}) ×10{str(size).translate(SCRIPTS)}"


def _further(kind: str, found: list[Summary | None]) -> list[tuple]:
    """N as data sheets have it: the one-sided density, and in the other usual unit."""
    si, rows = SI[kind]["N"], []
    density = {"gyro": "deg/s/sqrt(Hz)", "accel": "ug/sqrt(Hz)"}[kind]
    for text, unit, factor in (
        ("noise density, one-sided (√2 N)", density, np.sqrt(2)),
        ("N", FURTHER[kind], 1.0),
    ):
        cells = [
            MISSING
            if s is None
            else number(factor * float(in_unit(s.mean.value, si, unit)))
            if s.mean.needed
            else f"< {number(factor * float(in_unit(s.mean.high, si, unit)))}"
            for s in found
        ]
        rows.append(
            (
                Markup('<span class="words axis">{}<small>{}</small></span>').format(
                    text, pretty(unit)
                ),
                *cells,
            )
        )
    return rows


def _plain(value: float, si: str, unit: str) -> str:
    return number(float(in_unit(value, si, unit)))


def _notes(c: Characterization, kind: str) -> list[str]:
    notes = [
        (log, ch, text)
        for log in c.logs
        if kind in log.sensors
        for i, ch in enumerate(log.sensors[kind].channels)
        for text in (fit_notes(ch), spectrum_note(log.sensors[kind], i))
    ]
    alike: dict[tuple[str, str], list[str]] = {}
    for log, ch, text in notes:
        if text:
            alike.setdefault((log.name if len(c.logs) > 1 else "", text), []).append(ch.name)
    return [
        f"{name}{', ' if name else ''}{', '.join(channels)}: {text}."
        for (name, text), channels in alike.items()
    ]


def _spectrum(log: LogResult, kind: str, several: bool) -> Picture | None:
    svg = pictures.spectrum(log.sensors[kind])
    where = f" Log {log.name}." if several else ""
    taken_off = " and ".join(
        n
        for n in ("temperature", "warm-up")
        if any(n in ch.taken_off for ch in log.sensors[kind].channels)
    )
    warm = (
        f" The samples are as measured, the noise is that without {taken_off}." if taken_off else ""
    )
    caption = (
        f"{SENSORS[kind].capitalize()}: root of the one-sided power spectral density (Welch, Hann "
        "window, averaged in logarithm) and "
        "the noise fitted to the Allan deviation, also one-sided: white noise N lies at √2 "
        f"N.{warm}{where}"
    )
    return (
        None if svg is None else Picture(Markup(svg), caption, f"spectrum of the {SENSORS[kind]}")
    )


def _lines(c: Characterization, kind: str) -> Table:
    table = Table(
        ("line", "frequency [Hz]", "amplitude (peak)", "above background", "by chance", "relation")
    )
    for log in c.logs:
        for ch in (ch for ch in log.channels if ch.kind == kind):
            for v in sorted(ch.lines, key=lambda v: -v.amplitude):
                name = f"{ch.name}" + (f", {log.name}" if len(c.logs) > 1 else "")
                wide = f", {number(v.width, 2)} wide" if v.width else ""
                unit = unit_for(v.amplitude, SAMPLE[kind])
                std = number(float(in_unit(v.amplitude_std, SAMPLE[kind], unit)), 2)
                amplitude = f"{_plain(v.amplitude, SAMPLE[kind], unit)} ± {std} {pretty(unit)}"
                table.rows.append(
                    (
                        prose(name),
                        f"{frequency(v)} ± {number(v.frequency_std, 2)}{wide}",
                        amplitude,
                        f"{number(v.ratio)} times",
                        f"< {number(max(v.p_value, 1e-12), 1)}",
                        prose(v.relation.text if v.relation else ""),
                    )
                )
    return table


# Temperature


def _thermal(c: Characterization) -> list[dict[str, Any]]:
    entries = []
    for log in c.logs:
        for ch in log.channels:
            if ch.thermal is not None:
                caption = (
                    f"{ch.name}{f', {log.name}' if len(c.logs) > 1 else ''}: "
                    f"{thermal_sentence(ch)}. {_sentence(loop_sentence(ch))}"
                )
                entries.append(
                    {
                        "picture": Picture(
                            Markup(pictures.thermal(ch)),
                            caption,
                            f"bias of {ch.name} against temperature",
                            small=True,
                        )
                    }
                )
    return entries


def _sentence(text: str) -> str:
    return f"{text[:1].upper()}{text[1:]}." if text else ""


def _thermal_reasons(c: Characterization) -> list[str]:
    found = [
        (ch.thermal_reason, f"{log.name}: {ch.name}")
        for log in c.logs
        for ch in log.channels
        if ch.thermal is None and ch.thermal_reason
    ]
    reasons: dict[str, list[str]] = {}
    for reason, who in found:
        reasons.setdefault(reason, []).append(who)
    # Of all channels alike.
    alone = len(reasons) == 1 and len(found) == sum(1 for log in c.logs for _ in log.channels)
    return [
        _sentence(reason) if alone else f"{', '.join(who)}: {reason}."
        for reason, who in reasons.items()
    ]


# Quality


def _quality(c: Characterization) -> Table:
    table = Table(("finding", "column", "count", "detail"))
    for log in c.logs:
        for kind, columns, count, text in grouped(log.findings):
            where = f"{log.name}: " if len(c.logs) > 1 else ""
            table.rows.append(
                (kind, prose(f"{where}{columns or 'all'}"), f"{count:,}", prose(text))
            )
    return table


SHOWS = {
    Excerpt: "the samples around the first",
    Comb: "the levels that the samples keep to",
    Steps: "how long the steps of the time are",
    Timeline: "where there are samples",
}


def _evidence(c: Characterization) -> list[Picture]:
    made = []
    for log in c.logs:
        for (kind, column), shown in log.evidence.items():
            where = f", {log.name}" if len(c.logs) > 1 else ""
            caption = f"{kind.replace('_', ' ')}, {column}{where}: {SHOWS[type(shown)]}."
            svg = Markup(pictures.finding(shown, column.partition(" ")[0]))
            made.append(
                Picture(svg, caption.capitalize() if not where else caption, caption, small=True)
            )
    return made


def _overview(log: LogResult, kind: str) -> Picture:
    caption = (
        f"{SENSORS[kind].capitalize()}, {log.name}: least, mean and largest sample of stretches of "
        "the log."
    )
    return Picture(Markup(pictures.over_time(log, kind)), caption, f"{SENSORS[kind]} over time")


def _by_log(c: Characterization) -> Table:
    """Coefficients log by log, where there are several."""
    table = Table(("coefficient", *(log.name for log in c.logs), "mean", "spread"))
    if len(c.logs) < 2:
        return table
    for (name, term), s in sorted(
        c.coefficients.items(), key=lambda e: (TERMS.index(e[0][1]), e[0][0])
    ):
        kind = name.partition("_")[0]
        si, unit = SI[kind][term], PEOPLE[kind][term]
        each = [
            next((ch for ch in log.channels if ch.name == name and ch.noise), None)
            for log in c.logs
        ]
        if not s.mean.needed and not any(
            ch is not None and ch.coefficient(term).needed for ch in each
        ):
            continue
        cells = [MISSING if ch is None else _span(ch.coefficient(term), si, unit) for ch in each]
        label = Markup("{} {}<small>{}</small>").format(term, name, pretty(unit))
        spread = number(float(in_unit(s.spread, si, unit)), 2) if np.isfinite(s.spread) else MISSING
        table.rows.append((label, *cells, _span(s.mean, si, unit), spread))
    return table
