"""Small multiples of the logs: size of the rate, and temperature, over each log's own time."""

from __future__ import annotations

import re
from collections.abc import Sequence

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pyimu.identification.logs.overview import Overview, Strip
from pyimu.report.figures import AFTER, GREY, STYLE, svg_of

PANEL = 1.15
"""Inches of height of a panel."""


def side_by_side(
    rows: int, durations: Sequence[float], height: float = PANEL
) -> tuple[Figure, np.ndarray]:
    """A figure and its panels (rows, logs), one column a log.

    No column is narrower than a third of the widest; panels of a row share their ordinate.
    """
    widths = np.maximum(durations, max([*durations, 1e-9]) / 3)
    width = 5.4 if len(widths) == 1 else 7.0
    figure = Figure(figsize=(width, 0.9 + height * rows), layout="constrained")
    panels = figure.subplots(
        rows,
        len(widths),
        sharex="col",
        sharey="row",
        squeeze=False,
        gridspec_kw={"width_ratios": widths},
    )
    return figure, panels


def own_time(panel: Axes, name: str, count: int) -> None:
    """The abscissa of a log: seconds of its time column, said in full."""
    panel.set_xlabel(f"time [s] of {_folded(name, 84 // count - 6)}", fontsize=8.5)
    panel.locator_params(axis="x", nbins=max(3, 9 // count))
    panel.ticklabel_format(axis="x", style="plain", useOffset=False)


def _folded(name: str, width: int) -> str:
    """A name in lines of at most so many characters, folded behind underscores."""
    lines = [""]
    for word in re.findall(r"[^_]*_?", name):
        if lines[-1] and len(lines[-1]) + len(word) > width:
            lines.append("")
        lines[-1] += word
    return "\n".join(lines)


def strips(logs: Sequence[tuple[str, Overview]]) -> str:
    """The logs beside each other, the held-out rows shaded."""
    warm = any(o.warmth is not None for _, o in logs)
    with matplotlib.rc_context(STYLE):
        figure, panels = side_by_side(1 + warm, [o.duration for _, o in logs])
        for column, (name, o) in enumerate(logs):
            _filled(panels[0, column], o.speed, np.degrees(1.0))
            if warm and o.warmth is not None:
                _filled(panels[1, column], o.warmth, 1.0)
            for panel in panels[:, column]:
                for span in o.held:
                    panel.axvspan(*span, color=GREY, alpha=0.22, lw=0, zorder=0)
            own_time(panels[-1, column], name, len(logs))
        panels[0, 0].set_ylabel("rate [deg/s]")
        panels[0, 0].set_ylim(bottom=0.0)
        if warm:
            panels[1, 0].set_ylabel("temp. [°C]")
        figure.align_ylabels(panels[:, 0])
        return svg_of(figure, curves=True)


def lags(logs: Sequence[tuple[str, np.ndarray, np.ndarray]]) -> str:
    """The lag [s] of each log, by name with its time [s], beside each other."""
    with matplotlib.rc_context(STYLE):
        figure, panels = side_by_side(1, [float(np.ptp(time)) for _, time, _ in logs], 1.35)
        for panel, (name, time, late) in zip(panels[0], logs, strict=True):
            panel.plot(time, 1e3 * late, color=AFTER, lw=1.2)
            own_time(panel, name, len(logs))
        panels[0, 0].set_ylabel("sensor late by [ms]")
        return svg_of(figure, curves=True)


def _filled(panel: Axes, s: Strip | None, factor: float) -> None:
    if s is not None:
        panel.fill_between(s.time, factor * s.low, factor * s.high, color=AFTER, lw=0.7, zorder=2)
