"""The pictures of the heading by several methods."""

from __future__ import annotations

from collections.abc import Callable

import matplotlib
import numpy as np
from matplotlib.axes import Axes

from pyimu.heading.outcome import Outcome, Track
from pyimu.report.figures import (
    AFTER,
    BEFORE,
    FLOOR,
    GREY,
    INK,
    STYLE,
    WIDTH,
    envelope,
    legend,
    new_figure,
    svg_of,
    unit_of_time,
)

WIDER = 2.0
"""Standard deviations on either side that a band takes."""

COLOURS = {
    "integrate": GREY,
    "self-calibration": INK,
    "threshold": FLOOR,
    "paper": BEFORE,
    "filter": AFTER,
}


def error_picture(found: Outcome) -> str:
    """Heading error of each method over the first log."""
    return _drawn(found, [_draw_errors], 2.2, 5)


def estimates_picture(found: Outcome) -> str:
    """Bias and scale factor of the filter over the first log."""
    return _drawn(found, [_draw_bias, _draw_scale], 1.3, 0)


def runs_picture(found: Outcome) -> str:
    """The errors of all logs, a row of points a method."""
    with matplotlib.rc_context(STYLE):
        figure, (panel,) = new_figure(WIDTH, 0.8 + 0.32 * len(found.methods))
        for k, m in enumerate(found.methods):
            errors = np.degrees(m.errors)
            across = k + 0.22 * np.linspace(-1, 1, len(errors))
            panel.plot(errors, across, ".", ms=3, color=COLOURS[m.name], rasterized=True)
        panel.set_yticks(range(len(found.methods)), [m.name for m in found.methods])
        panel.invert_yaxis()
        panel.set_xlabel("heading error at the end [deg]")
        return svg_of(figure, curves=True)


def transfer_picture(found: Outcome) -> str:
    """Residual of the rate transfer in percent of the range, over the rate."""
    t = found.transfer
    with matplotlib.rc_context(STYLE):
        figure, (panel,) = new_figure(WIDTH, 2.4)
        panel.axhline(0.0, color=GREY, lw=0.8)
        panel.plot(np.degrees(t.rate), t.percent, "o", ms=4, color=AFTER)
        panel.set_xlabel("rate of the table [deg/s]")
        panel.set_ylabel("residual [% of range]")
        return svg_of(figure, curves=True)


def _drawn(
    found: Outcome, draw: list[Callable[[Outcome, Axes, float], None]], height: float, columns: int
) -> str:
    time = found.methods[0].tracks[0].time
    size, unit = unit_of_time(float(time[-1] - time[0]))
    with matplotlib.rc_context(STYLE):
        figure, panels = new_figure(WIDTH, 0.7 + height * len(draw), len(draw))
        for one, panel in zip(draw, panels, strict=True):
            one(found, panel, size)
        panels[-1].set_xlabel(f"time [{unit}]")
        if columns:
            legend(figure, panels[0], columns)
        return svg_of(figure, curves=True)


def _filtered(found: Outcome) -> Track | None:
    return next((m.tracks[0] for m in found.methods if m.tracks[0].filter is not None), None)


def _band(panel: Axes, time: np.ndarray, middle: np.ndarray, std: np.ndarray, size: float) -> None:
    for sign in (-1, 1):
        at, low, high = envelope(time, middle + sign * WIDER * std)
        panel.plot(at / size, 0.5 * (low + high), color=AFTER, lw=1.0, ls=":")


def _draw_errors(found: Outcome, panel: Axes, size: float) -> None:
    for m in found.methods:
        t = m.tracks[0]
        if t.error is not None:
            at, low, high = envelope(t.time, np.degrees(t.error))
            panel.plot(at / size, 0.5 * (low + high), color=COLOURS[m.name], lw=1.2, label=m.name)
    own = _filtered(found)
    if own is not None:
        zero = np.zeros(len(own.time))
        _band(panel, own.time, zero, np.degrees(own.filter.heading_std), size)
    panel.set_ylabel("heading error [deg]")


def _draw_bias(found: Outcome, panel: Axes, size: float) -> None:
    _draw_estimate(found, panel, size, "bias", np.degrees(1.0), "bias [deg/s]")


def _draw_scale(found: Outcome, panel: Axes, size: float) -> None:
    _draw_estimate(found, panel, size, "scale_factor", 100.0, "scale factor [%]")


def _draw_estimate(
    found: Outcome, panel: Axes, size: float, name: str, factor: float, text: str
) -> None:
    t = _filtered(found)
    if t is not None:
        value, std = (factor * getattr(t.filter, n) for n in (name, f"{name}_std"))
        at, low, high = envelope(t.time, value)
        panel.plot(at / size, 0.5 * (low + high), color=AFTER, lw=1.2)
        _band(panel, t.time, value, std, size)
    panel.set_ylabel(text)
