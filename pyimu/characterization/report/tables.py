"""The tables of the page: coefficients, lines, coefficients log by log, and quality."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np
from markupsafe import Markup, escape

from pyimu.characterization.allan.moments import MARKOV, TERMS
from pyimu.characterization.noise.coefficients import Coefficient
from pyimu.characterization.outcome import SAMPLE, SI, Channel, LogResult, Outcome, Summary
from pyimu.characterization.report.channel_notes import frequency
from pyimu.characterization.report.coefficients import (
    DENSITY_UNIT,
    MARKOV_NAME,
    READING_ORDER,
    SECOND_N_UNIT,
    TERM_NAMES,
    UNITS,
    floor_cell,
    value_or_bound,
    with_interval,
    with_interval_si,
)
from pyimu.characterization.report.log_notes import duration
from pyimu.characterization.spectrum.lines import Line
from pyimu.model.part import AXES
from pyimu.report.numbers import MISSING, in_unit, joined, number, pretty, unit_for
from pyimu.report.page import Table, prose
from pyimu.shaping import flicker_floor

COMPARED = 4
"""Models of a channel that are shown."""


def coefficient_table(c: Outcome, kind: str) -> Table:
    """The coefficients of a sensor over all logs, an axis a column."""
    table = Table(("coefficient", *AXES))
    for term in READING_ORDER:
        found = [c.coefficients.get((f"{kind}_{axis}", term)) for axis in AXES]
        si, unit = SI[kind][term], UNITS[kind][term]
        name = Markup('<span class="words"><b>{}</b> {}<small>{}</small></span>').format(
            term, TERM_NAMES[kind][term], pretty(unit)
        )
        table.rows.append((name, *(_cell(s, si, unit) for s in found)))
        if term == "N":
            table.rows.extend(_other_n(kind, found))
    table.rows.extend(_markov(c, kind))
    table.rows.extend(_floors(c, kind))
    return table


def _markov(c: Outcome, kind: str) -> Iterator[tuple]:
    """The Gauss-Markov noise of the axes: standard deviation, and correlation time below it."""
    unit, axes = UNITS[kind]["B"], [c.markov(f"{kind}_{axis}") for axis in AXES]
    for k in range(max(map(len, axes))):
        name = Markup('<span class="words"><b>{}</b> {}<small>{}</small></span>').format(
            MARKOV[k], MARKOV_NAME, f"standard deviation [{pretty(unit)}], correlation time"
        )
        cells = (
            Markup("{}<small>{}</small>").format(
                _in(own[k][0], SAMPLE[kind], unit), duration(own[k][1])
            )
            if len(own) > k
            else MISSING
            for own in axes
        )
        yield (name, *cells)


def model_table(c: Outcome, kind: str) -> Table:
    """The models of the noise that were compared, of each channel the best ``COMPARED``."""
    table = Table(("channel", "model", "evidence [nat]", "describes to"))
    for log in c.logs:
        where = f", {log.name}" if len(c.logs) > 1 else ""
        for ch in (ch for ch in log.channels if ch.kind == kind and ch.noise):
            models, h = ch.noise.fit.models, ch.noise.fit.sample_period
            for k, m in enumerate(models[:COMPARED] if len(models) > 1 else ()):
                times = f" of {joined([duration(time * h) for time in m.times])}" if m.times else ""
                table.rows.append(
                    (
                        prose(f"{ch.name}{where}" if not k else ""),
                        prose(f"{' + '.join(m.terms)}{times}{' (taken)' if not k else ''}"),
                        number(m.score - models[0].score, 2) if k else "0",
                        f"{number(100 * m.error, 2)} %" if m.error else "its own scatter",
                    )
                )
    return table


def _cell(s: Summary | None, si: str, unit: str) -> Any:
    """A coefficient with its interval in the unit for people, and in SI."""
    if s is None:
        return MISSING
    spread = f" ± {number(float(in_unit(s.spread, si, unit)), 2)}" if np.isfinite(s.spread) else ""
    text = _interval(s.mean, si, unit) + escape(spread)
    return (
        text
        if unit == si
        else Markup("{}<small>{}</small>").format(text, f"{with_interval_si(s.mean)} {pretty(si)}")
    )


def _interval(c: Coefficient, si: str, unit: str) -> Markup:
    """A coefficient, its interval in a form of its own."""
    value, bracket, rest = with_interval(c, si, unit).partition(" (")
    return Markup('{}<span class="interval">{}{}</span>').format(value, bracket, rest)


def _other_n(kind: str, found: Sequence[Summary | None]) -> Iterator[tuple]:
    """N as data sheets have it: the one-sided density, and in the other usual unit."""
    for text, unit, factor in (
        ("noise density, one-sided (√2 N)", DENSITY_UNIT[kind], np.sqrt(2)),
        ("N", SECOND_N_UNIT[kind], 1.0),
    ):
        name = Markup('<span class="words axis">{}<small>{}</small></span>').format(
            text, pretty(unit)
        )
        cells = (
            MISSING if s is None else value_or_bound(s.mean, SI[kind]["N"], unit, factor)
            for s in found
        )
        yield (name, *cells)


def _floors(c: Outcome, kind: str) -> Iterator[tuple]:
    """The lowest Allan deviations, and B as it is read off them."""
    unit = UNITS[kind]["B"]
    for title, note, factor in (
        ("lowest Allan deviation", "", 1.0),
        ("B as read off it", ", over 0.664", 1 / flicker_floor(1.0)),
    ):
        name = Markup('<span class="words">{}<small>{}</small></span>').format(
            title, f"{pretty(unit)}{note}"
        )
        yield (name, *(floor_cell(f, kind, factor) for f in c.floors(kind)))


def _in(value: float, si: str, unit: str) -> str:
    return number(float(in_unit(value, si, unit)))


def line_table(c: Outcome, kind: str) -> Table:
    """The lines of a sensor, those of a channel by amplitude."""
    table = Table(
        ("line", "frequency [Hz]", "amplitude (peak)", "above background", "by chance", "relation")
    )
    for log in c.logs:
        where = f", {log.name}" if len(c.logs) > 1 else ""
        for ch in (ch for ch in log.channels if ch.kind == kind):
            for v in sorted(ch.lines, key=lambda v: -v.amplitude):
                table.rows.append((prose(f"{ch.name}{where}"), *_line(v, SAMPLE[kind])))
    return table


def _line(v: Line, si: str) -> tuple:
    width = f", {number(v.width, 2)} wide" if v.width else ""
    unit = unit_for(v.amplitude, si)
    std = number(float(in_unit(v.amplitude_std, si, unit)), 2)
    return (
        f"{frequency(v)} ± {number(v.frequency_std, 2)}{width}",
        f"{_in(v.amplitude, si, unit)} ± {std} {pretty(unit)}",
        f"{number(v.ratio)} times",
        f"< {number(max(v.p_value, 1e-12), 1)}",
        prose(v.relation.text if v.relation else ""),
    )


def log_table(c: Outcome) -> Table:
    """The coefficients log by log, where there are several."""
    table = Table(("coefficient", *(log.name for log in c.logs), "mean", "spread"))
    if len(c.logs) < 2:
        return table
    for (name, term), s in sorted(
        c.coefficients.items(), key=lambda e: (TERMS.index(e[0][1]), e[0][0])
    ):
        each = [_characterised(log, name) for log in c.logs]
        if s.mean.needed or any(ch is not None and ch.coefficient(term).needed for ch in each):
            table.rows.append(_log_row(name, term, s, each))
    return table


def _characterised(log: LogResult, name: str) -> Channel | None:
    """The channel of a name, if its noise was characterised."""
    return next((ch for ch in log.channels if ch.name == name and ch.noise), None)


def _log_row(name: str, term: str, s: Summary, each: Iterable[Channel | None]) -> tuple:
    kind = name.partition("_")[0]
    si, unit = SI[kind][term], UNITS[kind][term]
    cells = [MISSING if ch is None else _interval(ch.coefficient(term), si, unit) for ch in each]
    label = Markup("{} {}<small>{}</small>").format(term, name, pretty(unit))
    spread = number(float(in_unit(s.spread, si, unit)), 2) if np.isfinite(s.spread) else MISSING
    return (label, *cells, _interval(s.mean, si, unit), spread)
