"""The pictures of the report, as inline SVG.

Clouds are rasterised, colours are CSS variables: one page serves day and night.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pyimu.identification.found.exhibits import Cloud, Comb, Driver, Spectrum, Trace
from pyimu.identification.report.strips import own_time, side_by_side
from pyimu.identification.search.screen import Screening
from pyimu.model.part import AXES
from pyimu.model.signals import SIGNALS
from pyimu.report.figures import (
    AFTER,
    BEFORE,
    FLOOR,
    GREY,
    INK,
    STYLE,
    envelope,
    legend,
    new_figure,
    plain_logarithm,
    style,
    svg_of,
)
from pyimu.report.numbers import in_unit, number, pretty, unit_for

POINTS = 3000
"""Points of a cloud, evenly picked."""

LEVELS = 22
"""Bins of the input in which a residual's median and quartiles are drawn."""

LEAST_IN_BIN = 5

# Residual over time


def over_time(found: Sequence[Trace], floor: np.ndarray | None, si: str) -> str:
    """Residual before and after on the held-out rows, both on one scale, as an SVG."""
    with style():
        return svg_of(time_figure(found, floor, si), curves=True)


def time_figure(
    found: Sequence[Trace], floor: np.ndarray | None, si: str, more: dict[str, Any] | None = None
) -> Figure:
    """Residual before and after: one row of panels an axis, one column a log.

    ``more`` is what the figure's style sets beside the package's.
    """
    with style(more):
        axes_shown = sorted({i for t in found for i in t.axes})
        unit = unit_for(_scale([t.before for t in found]), si)
        spans = [float(t.time[-1] - t.time[0]) if len(t.time) else 0.0 for t in found]
        figure, panels = side_by_side(len(axes_shown), spans, 1.35)
        for row, i in zip(panels, axes_shown, strict=True):
            for t, panel in zip(found, row, strict=True):
                _time_panel(panel, t, i, si, unit)
                if floor is not None and np.isfinite(floor[i]):
                    _noise_alone(panel, 2 * float(in_unit(floor[i], si, unit)))
            row[0].set_ylabel(f"{AXES[i]} [{pretty(unit)}]")
            limit = max(map(abs, row[0].get_ylim()))
            row[0].set_ylim(-limit, limit)
        for t, panel in zip(found, panels[-1], strict=True):
            own_time(panel, t.name, len(found))
        legend(figure, panels[0, 0], 3)
    return figure


def _scale(residuals: Sequence[np.ndarray]) -> float:
    return (
        float(np.sqrt(np.mean(np.concatenate(residuals) ** 2)))
        if residuals and sum(map(len, residuals))
        else 0.0
    )


def _time_panel(panel: Axes, t: Trace, i: int, si: str, unit: str) -> None:
    for name, colour in (("before", BEFORE), ("after", AFTER)):
        values = in_unit(getattr(t, name)[:, i], si, unit)
        at, low, high = envelope(t.time, values)
        panel.fill_between(at, low, high, color=colour, lw=0.6, label=name, zorder=2)


def _noise_alone(panel: Axes, limit: float) -> None:
    label = "±2σ of the noise alone"
    panel.axhspan(-limit, limit, color=FLOOR, alpha=0.25, lw=0, zorder=1, label=label)
    for edge in (-limit, limit):
        panel.axhline(edge, color=FLOOR, lw=0.8, zorder=3)


# Residual against what drives an effect


def cloud(c: Cloud, effect: str, si: str) -> str:
    """Residual of one axis, in the unit ``si``, against what drives an effect.

    A light cloud with binned medians and quartiles on it.
    """
    x, label = _people(c.driver, c.values, si)
    # A limit acts on the outermost samples, which are what a picture of anything else leaves out.
    span = np.quantile(x, [0.0, 1.0] if c.outermost else [0.001, 0.999])
    edges = np.linspace(*span, LEVELS + 1)
    unit = unit_for(_scale([c.without[:, None]]), si)
    with matplotlib.rc_context(STYLE):
        figure, (panel,) = new_figure(4.4, 2.9)
        seen = []
        for values, colour, said, shift in (
            (c.without, BEFORE, f"without {effect}", 0.0),
            (c.with_effect, AFTER, f"with {effect}", 0.2),
        ):
            y = in_unit(values, si, unit)
            _points(panel, x, y, colour)
            quartiles = _medians(panel, x, y, edges, colour, said, shift)
            seen += [np.quantile(y, [0.002, 0.998]), quartiles.ravel()]
        if c.formula is not None:
            _curve(panel, x, in_unit(c.formula, si, unit), edges)
        _limits(panel.set_xlim, span)
        _limits(panel.set_ylim, np.concatenate(seen))
        panel.locator_params(axis="x", nbins=6)
        panel.set(xlabel=label, ylabel=f"residual {AXES[c.axis]} [{pretty(unit)}]")
        legend(figure, panel, 2 if c.formula is None else 3)
        return svg_of(figure, curves=True)


def _curve(panel: Axes, x: np.ndarray, y: np.ndarray, edges: np.ndarray) -> None:
    """The mean of what a formula adds, in bins finer than those of the residual."""
    fine = np.interp(np.linspace(0, LEVELS, 4 * LEVELS + 1), np.arange(LEVELS + 1), edges)
    place = np.searchsorted(fine, x) - 1
    at = [k for k in range(4 * LEVELS) if np.any(place == k)]
    middles = [0.5 * (fine[k] + fine[k + 1]) for k in at]
    panel.plot(
        middles, [y[place == k].mean() for k in at], color=INK, lw=1.4, label="formula", zorder=5
    )


UNITS = {"rate": "deg/s", "specific_force": "g", "temperature": "degC"}
"""Units that people expect on the axis of a signal, whatever its size."""


def _people(driver: Driver, values: np.ndarray, si: str) -> tuple[np.ndarray, str]:
    """The values of a driver in the unit that people use, and the label of their axis."""
    if driver.signal == "formula":
        unit = "deg" if driver.unit == "rad" else unit_for(values, driver.unit)
        shown = values if unit == driver.unit else in_unit(values, driver.unit, unit)
        return shown, f"{driver.label} [{pretty(unit)}]"
    if driver.signal == "time":
        return values, "time since the first row of the log [s]"
    if driver.signal == "contribution":
        unit = "deg/s" if si == "rad/s" else "mg"
        return in_unit(values, si, unit), f"what the effect adds [{unit}]"
    unit = UNITS.get(driver.signal) or unit_for(values, driver.unit)
    shown = values if unit == driver.unit else in_unit(values, driver.unit, unit)
    axis = f" {AXES[driver.component]}" if SIGNALS[driver.signal].size == 3 else ""
    label = f"{driver.signal.replace('_', ' ')}{axis}"
    if driver.change:
        unit, label = f"{unit}/s".replace("deg/s/s", "deg/s^2"), f"change of {label}"
    return shown, f"{label} [{pretty(unit)}]"


def _points(panel: Axes, x: np.ndarray, y: np.ndarray, colour: str) -> None:
    pick = np.linspace(0, len(x) - 1, min(POINTS, len(x))).astype(int)
    alpha = 0.5 if len(x) < 1000 else 0.38
    panel.plot(
        x[pick], y[pick], ".", ms=2.8, mew=0, color=colour, alpha=alpha, rasterized=True, zorder=2
    )


def _medians(
    panel: Axes,
    x: np.ndarray,
    y: np.ndarray,
    edges: np.ndarray,
    colour: str,
    label: str,
    shift: float,
) -> np.ndarray:
    """Draw, and give, median and quartiles (k, 3) of ``y`` in bins of ``x``.

    ``shift`` [bins] parts two series.
    """
    place = np.searchsorted(edges, x) - 1
    rows = [
        (k, np.quantile(y[place == k], [0.25, 0.5, 0.75]))
        for k in range(LEVELS)
        if np.sum(place == k) >= LEAST_IN_BIN
    ]
    if not rows:
        return np.empty((0, 3))
    at = np.array([edges[k] + (0.4 + shift) * (edges[1] - edges[0]) for k, _ in rows])
    q = np.array([v for _, v in rows])
    panel.errorbar(
        at,
        q[:, 1],
        yerr=[q[:, 1] - q[:, 0], q[:, 2] - q[:, 1]],
        fmt="o-",
        ms=3.2,
        lw=1.2,
        elinewidth=1.0,
        color=colour,
        label=label,
        zorder=4,
    )
    return q


def _limits(set_limits: Callable, values: np.ndarray) -> None:
    """A twentieth of margin around what must be seen; outliers beyond it are cut."""
    low, high = float(np.min(values)), float(np.max(values))
    margin = 0.05 * (high - low) or 1.0
    set_limits(low - margin, high + margin)


def comb(c: Comb) -> str:
    """Where the raw samples lie between two multiples of the step found."""
    with matplotlib.rc_context(STYLE):
        figure, (panel,) = new_figure(4.4, 2.4)
        shares = np.full(len(c.offsets), 100.0 / len(c.offsets))
        panel.hist(c.offsets, bins=41, range=(-0.5, 0.5), color=AFTER, weights=shares)
        panel.set(
            xlabel=f"sample {AXES[c.axis]}, distance to the nearest multiple [steps]",
            ylabel="samples [%]",
        )
        return svg_of(figure, curves=True)


# Screening


def screening(
    first: Screening, last: Screening, added: Sequence[str], fitted: Mapping[str, float]
) -> str:
    """Gain of each candidate at the first look (bars), ``fitted`` in full (dots) and at the last
    look (diamonds), with the gate. The numbers are of the first look and, behind an arrow, in full.
    """
    rows = sorted(first.candidates, key=lambda c: c.gain)
    remaining = {c.effect: c.gain for c in last.candidates}
    gate = first.gate if np.isfinite(first.gate) else 1.0
    left = 0.3 * min(1.0, gate)
    with matplotlib.rc_context(STYLE):
        figure, (panel,) = new_figure(5.4, 1.0 + 0.27 * len(rows))
        for k, c in enumerate(rows):
            colour = AFTER if c.effect in added else BEFORE if c.gain > gate else GREY
            panel.barh(k, max(c.gain, left) - left, left=left, height=0.62, color=colour)
            clear = max(c.gain, gate, remaining.get(c.effect, 0.0), fitted.get(c.effect, 0.0))
            gains = [c.gain, fitted[c.effect]] if c.effect in fitted else [c.gain]
            panel.annotate(
                " → ".join(number(g) if g > left else "nothing" for g in gains),
                (clear, k),
                xytext=(7, 0),
                color=INK,
                textcoords="offset points",
                va="center",
                fontsize=8.5,
            )
            if c.effect in remaining and last is not first:
                _mark(panel, max(remaining[c.effect], left), k, LAST)
            if c.effect in fitted:
                _mark(panel, max(fitted[c.effect], left), k, FITTED)
        panel.axvline(gate, color=INK, lw=1.0, ls=(0, (4, 2)))
        panel.set_yticks(range(len(rows)), [c.effect for c in rows])
        panel.set(
            xscale="log",
            xlim=(left, 6 * max([gate, *(c.gain for c in rows), *fitted.values()])),
            xlabel="gain in log-likelihood [nat]",
        )
        plain_logarithm(panel.xaxis)
        panel.grid(axis="y", visible=False)
        _screening_legend(figure, panel, last is not first, bool(fitted))
        return svg_of(figure, curves=True)


LAST: dict[str, Any] = {"marker": "D", "ms": 4.5, "mfc": "none", "mec": INK, "mew": 1.0}
FITTED: dict[str, Any] = {"marker": "o", "ms": 5.5, "mfc": INK, "mec": "white", "mew": 0.8}
"""Marks of the last look and of a candidate fitted in full."""


def _mark(panel: Axes, x: float, y: int, style: dict[str, Any]) -> None:
    panel.plot(x, y, ls="", clip_on=False, zorder=5, **style)


def _screening_legend(figure: Figure, panel: Axes, looked_again: bool, fitted: bool) -> None:
    for colour, label in (
        (AFTER, "added"),
        (BEFORE, "above the gate, not added"),
        (GREY, "below the gate"),
    ):
        panel.bar(0, 0, color=colour, label=label)
    panel.plot([], [], color=INK, lw=1.0, ls=(0, (4, 2)), label="gate (1 % by chance)")
    if fitted:
        panel.plot([], [], ls="", label="fitted in full", **FITTED)
    if looked_again:
        panel.plot([], [], ls="", label="at the last look", **LAST)
    legend(figure, panel, 3)


# Spectrum


def spectrum(s: Spectrum, si: str) -> str:
    """One-sided amplitude density of the residual before and after, and of the noise alone.

    The residual is in the unit ``si``.
    """
    unit = "deg/s" if si == "rad/s" else "mg"
    lines = (
        (s.before, BEFORE, "-", "before"),
        (s.after, AFTER, "-", "after"),
        (s.noise, FLOOR, (0, (5, 2)), "the noise alone"),
    )
    with matplotlib.rc_context(STYLE):
        figure, (panel,) = new_figure(5.4, 3.0)
        for power, colour, style, label in lines:
            amplitude = in_unit(np.sqrt(power), si, unit)
            panel.loglog(s.frequency, amplitude, color=colour, ls=style, lw=1.5, label=label)
        if s.band_hz is not None:
            _mark_band(panel, s.band_hz)
        panel.set(xlabel="frequency [Hz]", ylabel=f"density, one-sided [{unit}/√Hz]")
        for axis in (panel.xaxis, panel.yaxis):
            plain_logarithm(axis)
        legend(figure, panel, 3)
        return svg_of(figure, curves=True)


def _mark_band(panel: Axes, band_hz: float) -> None:
    panel.axvline(band_hz, color=INK, lw=0.8, ls=(0, (1, 2)))
    panel.annotate(
        "band",
        (band_hz, 0.02),
        xycoords=("data", "axes fraction"),
        xytext=(-3, 0),
        textcoords="offset points",
        ha="right",
        fontsize=8.5,
    )
