"""What a characterisation found, for a terminal or a notebook."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pyimu.characterization.allan.moments import MARKOV
from pyimu.characterization.outcome import SAMPLE, SI, LogResult, Outcome, Summary
from pyimu.characterization.report.beside import beside_lines
from pyimu.characterization.report.channel_notes import (
    bandwidth_sentence,
    frequency,
    loop_sentence,
    thermal_sentence,
)
from pyimu.characterization.report.coefficients import (
    MARKOV_NAME,
    READING_ORDER,
    TERM_NAMES,
    UNITS,
    floor_cell,
    with_interval,
)
from pyimu.characterization.report.log_notes import about, duration, notes, what_it_is, why_no_part
from pyimu.characterization.report.magnetometer import magnetometer_lines
from pyimu.model.part import AXES
from pyimu.report.findings import SENSORS, in_line
from pyimu.report.lines import in_columns
from pyimu.report.numbers import MISSING, in_unit, number, quantity


def in_lines(c: Outcome) -> str:
    """The report for a terminal."""
    lines = [*why_no_part(c), *(f"{log.name}: {about(log)}" for log in c.logs), *notes(c)]
    for kind in c.kinds:
        lines += ["", *in_columns(_rows(c, kind))]
    lines += [
        "",
        (
            f"Intervals: {100 * c.level:g} %. '<' is an upper bound: the data do not need the "
            "term, or the log is too short to show how low the deviation comes. N is the root of "
            "the two-sided density."
        ),
    ]
    if len(c.logs) > 1:
        lines.append(f"Means over {len(c.logs)} logs; ± is the standard deviation of the logs.")
    for log in c.logs:
        lines += [
            f"{log.name}: {text}" for text in (*_lines(log), *_thermal(log), *in_line(log.findings))
        ]
    return "\n".join([*lines, *magnetometer_lines(c), *beside_lines(c)])


def _rows(c: Outcome, kind: str) -> list[tuple[str, ...]]:
    """The coefficients of a sensor, one a row, and its lowest Allan deviations."""
    what = what_it_is(c, kind)
    rows = [(f"{SENSORS[kind]} ({what})" if what else SENSORS[kind], "", *AXES)]
    for term in READING_ORDER:
        summaries = [c.coefficients.get((f"{kind}_{axis}", term)) for axis in AXES]
        if any(summaries):
            name = f"  {term} {TERM_NAMES[kind][term]}"
            rows.append((name, UNITS[kind][term], *(_cell(s, kind, term) for s in summaries)))
    rows.extend(_markov(c, kind))
    cells = [
        f"{floor_cell(f, kind)} at {number(f[0].tau)} s" if f else MISSING for f in c.floors(kind)
    ]
    return [*rows, ("  lowest Allan deviation", UNITS[kind]["B"], *cells)]


def _markov(c: Outcome, kind: str) -> Iterator[tuple[str, ...]]:
    """The Gauss-Markov noise of the axes, one a row."""
    unit, axes = UNITS[kind]["B"], [c.markov(f"{kind}_{axis}") for axis in AXES]
    for k in range(max(map(len, axes))):
        cells = (
            f"{number(float(in_unit(own[k][0], SAMPLE[kind], unit)))} with {duration(own[k][1])}"
            if len(own) > k
            else MISSING
            for own in axes
        )
        yield (f"  {MARKOV[k]} {MARKOV_NAME}", unit, *cells)


def _cell(s: Summary | None, kind: str, term: str) -> str:
    if s is None:
        return MISSING
    si, unit = SI[kind][term], UNITS[kind][term]
    spread = f" ± {number(float(in_unit(s.spread, si, unit)), 2)}" if np.isfinite(s.spread) else ""
    return with_interval(s.mean, si, unit) + spread


def _lines(log: LogResult) -> Iterator[str]:
    """The bandwidth and the strongest lines of each channel that has any."""
    for ch in log.channels:
        if ch.bandwidth is not None:
            yield f"{ch.name}: {bandwidth_sentence(ch)}"
        if ch.lines:
            top = sorted(ch.lines, key=lambda v: -v.amplitude)[:4]
            more = f" and {len(ch.lines) - len(top)} more" if len(ch.lines) > len(top) else ""
            said = [f"{frequency(v)} Hz ({quantity(v.amplitude, SAMPLE[ch.kind])})" for v in top]
            yield f"{ch.name} has lines at {', '.join(said)}{more}"


def _thermal(log: LogResult) -> Iterator[str]:
    for ch in log.channels:
        if ch.thermal is not None:
            h = ch.thermal.hysteresis
            loop = f"; {loop_sentence(ch)}" if h is not None and h.warranted else ""
            yield f"{ch.name}: {thermal_sentence(ch)}{loop}"
