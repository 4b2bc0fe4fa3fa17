"""What was seen in a log, as one HTML page."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from markupsafe import Markup

from pyimu.inspection.outcome import Outcome
from pyimu.recording.columns import GROUPS
from pyimu.recording.recording import Recording
from pyimu.report.figures import (
    AFTER,
    BEFORE,
    FLOOR,
    GREY,
    INK,
    WIDTH,
    envelope,
    legend,
    new_figure,
    style,
    svg_of,
    unit_of_time,
)
from pyimu.report.numbers import in_unit, pretty, unit_for
from pyimu.report.page import Picture, Table, file_name, prose, quality_table, templates

SHOWN = ("gyro", "accel", "mag", "temperature", "ref_rate", "ref_heading", "heading", "speed")
"""Groups that are drawn."""

COLOURS = (AFTER, BEFORE, FLOOR, INK)


def page(found: Outcome) -> str:
    """The page, which needs nothing beside it."""
    head = ("column", "meaning", "unit", "numbers", "how it is known")
    rows = [
        (file_name(cells), group, unit, numbers, prose(why))
        for cells, group, unit, numbers, why in found.columns
    ]
    return (
        templates("pyimu.inspection")
        .get_template("report.html")
        .render(
            title=found.path.name,
            lines=[line for line in found.lines() if not line.startswith((" ", "columns"))],
            known=found.format or found.kind,
            problem=found.problem,
            columns=Table(head, rows),
            notes=[note for p in found.proposals for note in p.notes],
            pictures=[] if found.recording is None else _pictures(found),
            quality=quality_table((found.path.name, found.findings)),
            column_map=found.column_map,
            given_to=found.proposals[0].given_to,
        )
    )


def _pictures(found: Outcome) -> list[Picture]:
    recording = found.recording
    assert recording is not None
    groups = [g for g in SHOWN if g in recording.groups] or [*recording.groups]
    caption = "Least and largest sample over time" + (
        "; the grey bars below are stretches at rest." if len(found.rests) else "."
    )
    drawn = [
        Picture(Markup(_over_time(recording, groups, found.rests)), caption, "samples over time")
    ]
    if len(recording) > 2:
        text = "Steps between the times, in sample periods: even steps are one."
        drawn.append(Picture(Markup(_steps(recording)), text, "steps of the time", small=True))
    return drawn


def _over_time(recording: Recording, groups: list[str], rests: Iterable[tuple[int, int]]) -> str:
    with style():
        figure, panels = new_figure(WIDTH, 1.5 * len(groups) + 0.6, len(groups))
        size, unit = unit_of_time(float(np.ptp(recording.time)))
        start = recording.time[0]
        for panel, group in zip(panels, groups, strict=True):
            values = recording.groups[group].reshape(len(recording), -1)
            si = GROUPS[group].unit
            shown = unit_for(np.nanmax(np.abs(values)) if np.isfinite(values).any() else 1.0, si)
            for k, column in enumerate(values.T):
                at, low, high = envelope(recording.time, in_unit(column, si, shown))
                axis = (GROUPS[group].suffixes or (group,))[k]
                at = (at - start) / size
                panel.fill_between(at, low, high, color=COLOURS[k], lw=0.6, alpha=0.75, label=axis)
            for a, b in rests:
                ends = (recording.time[[a, b - 1]] - start) / size
                panel.axvspan(*ends, ymin=0, ymax=0.03, color=GREY, lw=0)
            panel.set_ylabel(f"{group} [{pretty(shown)}]")
        panels[-1].set_xlabel(f"time [{unit}]")
        if len(GROUPS[groups[0]].suffixes) > 1:
            legend(figure, panels[0], 3)
        return svg_of(figure, curves=True)


def _steps(recording: Recording) -> str:
    steps = np.diff(recording.time) / recording.sample_period
    with style():
        figure, (panel,) = new_figure(WIDTH, 2.0)
        top = max(2.5, float(np.quantile(steps, 0.999)))
        panel.hist(np.clip(steps, 0, top), bins=120, range=(0, top), color=AFTER)
        panel.set_yscale("log")
        panel.set_ylim(bottom=0.7)
        panel.set_xlabel("step of the time [sample periods]")
        panel.set_ylabel("steps")
        return svg_of(figure, curves=True)
