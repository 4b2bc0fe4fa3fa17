"""The picture of a channel's bias against temperature."""

from __future__ import annotations

import matplotlib
import numpy as np
from matplotlib.axes import Axes

from pyimu.characterization.outcome import SAMPLE, Channel
from pyimu.report.figures import (
    AFTER,
    BEFORE,
    GREY,
    INK,
    STYLE,
    legend,
    new_figure,
    svg_of,
)
from pyimu.report.numbers import in_unit, pretty, unit_for

BRANCHES = ((1, BEFORE, "rising"), (-1, AFTER, "falling"), (0, GREY, "turning"))


def temperature_picture(ch: Channel) -> str:
    """Bias against temperature with the fit, and the residual, as an SVG.

    Rising and falling temperature have colours of their own, as in Hidalgo 2012, figure 3.
    """
    t, si = ch.thermal, SAMPLE[ch.kind]
    unit = unit_for(np.ptp(t.bias), si)
    offset, (at, fitted) = np.mean(t.bias), t.curve
    with matplotlib.rc_context(STYLE):
        figure, (bias, residual) = new_figure(4.4, 3.9, 2)
        name = "fit" if t.order else "mean"
        for panel, points, line in (
            (bias, t.bias - offset, fitted - offset),
            (residual, t.residual, np.zeros(len(at))),
        ):
            _branches(panel, t.temperature, in_unit(points, si, unit), t.branch)
            panel.plot(at, in_unit(line, si, unit), color=INK, lw=1.3, label=name)
        bias.set_ylabel(f"bias {ch.axis} [{pretty(unit)}]")
        residual.set_ylabel(f"left over [{pretty(unit)}]")
        residual.set_xlabel("temperature [°C]")
        legend(figure, bias, 4)
        return svg_of(figure)


def _branches(panel: Axes, temperature: np.ndarray, values: np.ndarray, branch: np.ndarray) -> None:
    """The averages, coloured by whether the temperature rises or falls."""
    for way, colour, name in BRANCHES:
        rows = branch == way
        if rows.any():
            panel.plot(
                temperature[rows],
                values[rows],
                ".",
                ms=3.5,
                mew=0,
                color=colour,
                alpha=0.6,
                rasterized=True,
            )
            # For the legend, which needs a larger one.
            panel.plot([], [], "o", ms=5, mew=0, color=colour, label=name)
