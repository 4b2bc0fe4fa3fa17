"""Pictures of the evidence of findings."""

from __future__ import annotations

from collections.abc import Callable

import matplotlib
import numpy as np
from matplotlib.axes import Axes

from pyimu.characterization.evidence import (
    LEVELS,
    STEP_EDGES,
    Evidence,
    Excerpt,
    LevelHistogram,
    StepHistogram,
    Timeline,
)
from pyimu.characterization.outcome import SAMPLE
from pyimu.characterization.report.coefficients import SAMPLE_UNIT
from pyimu.report.figures import AFTER, BEFORE, STYLE, new_figure, plain_logarithm, svg_of
from pyimu.report.numbers import in_unit, number, pretty, unit_for


def evidence_picture(found: Evidence, column: str) -> str:
    """The evidence of a finding in a column, as an SVG."""
    draw: Callable = {
        Excerpt: _excerpt,
        LevelHistogram: _levels,
        StepHistogram: _steps,
        Timeline: _timeline,
    }[type(found)]
    with matplotlib.rc_context(STYLE):
        figure, (panel,) = new_figure(4.4, 1.3 if isinstance(found, Timeline) else 2.4)
        draw(panel, found, column)
        return svg_of(figure)


def _excerpt(panel: Axes, e: Excerpt, column: str) -> None:
    kind = column.partition("_")[0]
    unit, time = SAMPLE_UNIT[kind], e.time - e.time[0]
    values = in_unit(e.values, SAMPLE[kind], unit)
    panel.plot(time, values, ".-", color=AFTER, lw=0.8, ms=3)
    panel.plot(time[e.first : e.last], values[e.first : e.last], "o", color=BEFORE, ms=5, mew=0)
    panel.set(xlabel=f"time [s] since {e.time[0]:.6g} s", ylabel=f"{column[-1]} [{pretty(unit)}]")


def _levels(panel: Axes, histogram: LevelHistogram, column: str) -> None:
    kind = column.partition("_")[0]
    panel.bar(np.arange(-LEVELS, LEVELS + 1), 100 * histogram.share, width=0.25, color=AFTER)
    step = number(float(in_unit(histogram.step, SAMPLE[kind], SAMPLE_UNIT[kind])), 4)
    panel.set(
        xlabel=f"{column[-1]}, from its median, in steps of {step} {pretty(SAMPLE_UNIT[kind])}",
        ylabel="samples [%]",
    )


def _steps(panel: Axes, histogram: StepHistogram, _: str) -> None:
    unit = unit_for(histogram.h, "s")
    panel.stairs(
        np.maximum(histogram.count, 0.5),
        in_unit(STEP_EDGES * histogram.h, "s", unit),
        color=AFTER,
        fill=True,
        baseline=0.5,
    )
    panel.set(
        yscale="log",
        ylim=(0.5, None),
        xlabel=f"time step [{pretty(unit)}]; longer ones in the last bin",
        ylabel="steps",
    )
    panel.locator_params(axis="x", nbins=6)
    plain_logarithm(panel.yaxis)


def _timeline(panel: Axes, line: Timeline, _: str) -> None:
    start = line.segments[0][0]
    bars = [(a - start, max(b - a, 0.0)) for a, b in line.segments]
    panel.broken_barh(bars, (0, 1), color=AFTER)
    panel.set(yticks=[], ylim=(-0.2, 1.2), xlabel="time [s]; samples without gap")
    panel.grid(axis="y", visible=False)
