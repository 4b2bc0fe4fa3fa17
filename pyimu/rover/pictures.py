"""The pictures of the test drives' page, as inline SVG, after figures 9 and 10 of Hidalgo 2012."""

from __future__ import annotations

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from pyimu.report.figures import AFTER, BEFORE, FLOOR, GREY, INK, STYLE, legend, new_figure, svg_of
from pyimu.rover.outcome import DriveRuns, RoverOutcome
from pyimu.rover.paper import ANGLES

COLOURS = (GREY, BEFORE, AFTER)
"""Of the methods."""


def over_time(o: RoverOutcome, r: DriveRuns) -> str:
    """Heading, pitch and roll of one drive by the reference and each method."""
    t = r.traces
    with matplotlib.rc_context(STYLE):
        figure, panels = new_figure(7.4, 4.6, 3)
        for i, (panel, angle) in enumerate(zip(panels, ANGLES, strict=True)):
            truth = t.reference[:, i] - (t.reference[0, i] if i == 0 else 0.0)
            panel.plot(t.time, truth, color=INK, lw=1.6, label="optical reference")
            for m, (name, colour) in enumerate(zip(o.methods, COLOURS, strict=True)):
                found = truth + t.errors[m, :, i]
                panel.plot(t.time, found, color=colour, lw=1.1, label=name)
            panel.set_ylabel(f"{angle} [deg]")
        for limit in (t.start, t.end):
            for panel in panels:
                panel.axvline(limit, color=GREY, lw=0.7, ls=(0, (2, 2)))
        panels[-1].set_xlabel("time [s]")
        legend(figure, panels[0], 4)
        return svg_of(figure, curves=True)


def errors_picture(o: RoverOutcome) -> str:
    """Heading error of each drive by the two filters, on what the noise alone makes of it."""
    with matplotlib.rc_context(STYLE):
        columns = min(2, len(o.runs))
        rows = -(-len(o.runs) // columns)
        figure = Figure(figsize=(7.4, 0.5 + 2.3 * rows), layout="constrained")
        panels = figure.subplots(rows, columns, squeeze=False).ravel()
        for panel, r in zip(panels, o.runs, strict=False):
            t = r.traces
            driving = (t.time >= t.start) & (t.time <= t.end)
            since = t.time[driving] - t.start
            band = 2 * np.rad2deg(r.noise.std(since))
            panel.fill_between(
                since, -band, band, color=FLOOR, alpha=0.25, lw=0, label="±2σ, declared noise"
            )
            for m in (1, 2):
                error = t.errors[m, driving, 0]
                panel.plot(since, error, color=COLOURS[m], lw=1.2, label=o.methods[m])
            panel.set_title(r.paper.title, fontsize=9.5)
            panel.set(xlabel="time driven [s]", ylabel="heading error [deg]")
        for panel in panels[len(o.runs) :]:
            panel.set_visible(False)
        legend(figure, panels[0], 3)
        return svg_of(figure, curves=True)
