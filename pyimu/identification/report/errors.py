"""The error on data that was not fitted: pictures and tables."""

from __future__ import annotations

import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure

from pyimu.identification.fit.score import WINDOW
from pyimu.identification.found.entries import Errors
from pyimu.identification.found.exhibits import Exhibits, Spectrum
from pyimu.identification.model.as_part import SENSORS
from pyimu.identification.outcome import Outcome
from pyimu.identification.report import pictures
from pyimu.identification.report.words import AS_SET_RIGHT, QUANTITIES, gravity_at_rest
from pyimu.model.kinds import MAGNETOMETER
from pyimu.report.figures import ON_WHITE
from pyimu.report.numbers import MISSING, number, quantity, unit_for
from pyimu.report.page import Picture, Table, both, file_name, prose

BESIDE = 3
"""Logs that are drawn side by side; more would be too narrow to read."""


def over_time(closed: Outcome) -> list[Picture]:
    """The residual over the time of each log, so many logs a picture."""
    return [
        _over_time(closed, kind, e, k)
        for kind, e in closed.exhibits.items()
        for k in range(0, max(len(e.traces), 1), BESIDE)
    ]


def whole_figure(closed: Outcome, kind: str) -> Figure:
    """The residual of a sensor over the time of its first logs, on white."""
    errors, si = closed.errors.get(kind), closed.after.sensor(kind).output.unit
    floor = errors.floor.per_axis if errors and errors.floor else None
    traces = closed.exhibits[kind].traces[:BESIDE]
    return pictures.time_figure(traces, floor, si, ON_WHITE)


def _over_time(closed: Outcome, kind: str, e: Exhibits, first: int) -> Picture:
    errors, si = closed.errors.get(kind), closed.after.sensor(kind).output.unit
    floor = errors.floor.per_axis if errors and errors.floor else None
    rows = "the held-out rows" if e.held_out else "the fitted rows"
    rows = errors.data if errors and errors.data else rows
    caption = (
        f"{SENSORS[kind].capitalize()} residual, measured less model, on {rows}"
        f"{_band(closed, kind)}; smallest and largest sample in each column of the picture. Time "
        "is that of the log's own time column. Each axis has its own scale."
    )
    shown = e.traces[first : first + BESIDE]
    svg = Markup(pictures.over_time(shown, floor, si))
    return Picture(svg, caption, f"{SENSORS[kind]} residual over time before and after")


def _band(closed: Outcome, kind: str) -> str:
    band = closed.band_hz.get(kind)
    return "" if band is None else f", below {number(band)} Hz"


def spectra(closed: Outcome) -> list[Picture]:
    """The spectrum of each sensor's residual."""
    return [
        _spectrum(closed, kind, e.spectrum)
        for kind, e in closed.exhibits.items()
        if e.spectrum is not None
    ]


def _spectrum(closed: Outcome, kind: str, s: Spectrum) -> Picture:
    caption = (
        f"{SENSORS[kind].capitalize()} residual: root of the one-sided power spectral density, "
        f"mean of the axes (Welch, Hann window){_band(closed, kind)}. "
        "Dashed: what the noise model alone would leave."
    )
    svg = Markup(pictures.spectrum(s, closed.after.sensor(kind).output.unit))
    return Picture(svg, caption, f"spectrum of the {SENSORS[kind]} residual before and after")


def error_table(closed: Outcome) -> Table:
    """RMS before and after, all axes and each, beside the floor."""
    table = Table(("RMS", "before", "after", "ratio", "floor"))
    for kind, e in closed.errors.items():
        table.rows.extend(_error_rows(QUANTITIES[kind], e, e.unit, "total", "per_axis"))
        if kind == "gyro":
            table.rows.extend(
                _error_rows(f"angle in {WINDOW:g} s", e, "rad", "angle", "angle_per_axis")
            )
    for name, pair, si in (
        ("log-likelihood [nat/sample]", closed.log_likelihood, ""),
        (f"attitude ({AS_SET_RIGHT})", closed.attitude, "rad"),
        ("heading", closed.heading, "rad"),
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


def error_notes(closed: Outcome) -> list[str]:
    """On which rows the errors are, through which band, and what the floor is."""
    where = (
        "the logs named for it"
        if closed.held_out == "holdout"
        else f"{closed.held_out} of each log"
    )
    floor = "The floor is what the white noise of sensor and reference leaves of the same number."
    notes = [f"Held out: {where}. {floor}"]
    for g in closed.at_rest:
        rows = "rests" if g.sensor == "accel" else "turns between rests, by their time"
        notes.append(
            f"Rows of the {QUANTITIES[g.sensor]} are {rows}, each judged by a fit to the others; "
            f"the error of an axis is what lies along it: {gravity_at_rest(g)}."
        )
    for kind, e in closed.errors.items():
        if e.drift is not None and e.drift.total > 0:
            walk = quantity(e.drift.total, e.unit)
            whose = f"the {SENSORS[kind]}'s random walk"
            notes.append(f"Over the held-out rows {whose} may add {walk} to its floor.")
        if e.named is not None:
            slow = quantity(e.named.total, e.unit)
            notes.append(f"The slow noise that was named leaves {slow} of the {QUANTITIES[kind]}.")
    for kind, band in closed.band_hz.items():
        if band is not None:
            notes.append(
                f"The {SENSORS[kind]}'s reference is differentiated, and is trusted "
                f"below {number(band)} Hz. "
                "Measurement and reference go through the same filter, and every number here is of "
                "that band."
            )
    if MAGNETOMETER in closed.errors:
        notes.append(
            "The magnetometer is compared sample by sample, in no band, with a field that is the "
            "same everywhere, turned by the reference; its floor has its own noise, and what the "
            "noise of the reference's attitudes makes of that field."
        )
    return notes


def by_log_table(closed: Outcome) -> Table:
    """The same log by log."""
    table = Table(
        ("recording", "samples", "held out", "sensor", "before", "after", "ratio", "floor")
    )
    for r in closed.recordings:
        head = (file_name(r.file), f"{r.samples}", f"{r.held_out}")
        for kind, e in r.errors.items():
            values = [e.before.total, e.after.total, None if e.floor is None else e.floor.total]
            table.rows.append(
                (*head, SENSORS[kind], *_compared(values, e.unit, unit_for(values[0], e.unit)))
            )
            head = ("", "", "")
        if not r.errors:
            table.rows.append((*head, "fitted only", "", "", "", ""))
    return table
