"""The pictures of a navigated recording: path, position over time, error, innovations."""

from __future__ import annotations

from collections.abc import Callable

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Ellipse

from pyimu.ins.outcome import Outcome
from pyimu.ins.track import Track
from pyimu.numerics.laws import chi2
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

COLOURS = {"paper": GREY, "strapdown": BEFORE, "filter": AFTER, "smoother": FLOOR}

ELLIPSES = 12
"""Ellipses along a path, at most."""

INSIDE = float(np.sqrt(chi2.ppf(0.95, 2)))
"""Standard deviations of the half axes of a 95 % ellipse."""

LONGEST = 2000
"""Points of a drawn path, at most."""

TALLEST, AROUND, BESIDE = 5.4, 0.9, 0.7
"""Inches: of the picture of a path at most, and of what stands above and below the path, and beside
it."""

ROOM = 4.0
"""A path that leaves the reference's, or the smoothed one's, extent by more times its size would
press that flat: the picture ends there."""


def drawn(rows: int, height: float, draw: Callable[[list[Axes]], None], a: Outcome) -> str:
    with matplotlib.rc_context(STYLE):
        figure, panels = new_figure(WIDTH, 0.7 + height * rows, rows)
        draw(panels)
        panels[-1].set_xlabel(f"time [{unit_of_time(a.duration)[1]}]")
        legend(figure, panels[0], 5)
        return svg_of(figure, curves=True)


def path_picture(a: Outcome) -> str:
    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=(WIDTH, TALLEST), layout="constrained")
        panel = figure.subplots()
        draw_path(a, panel)
        figure.set_figheight(_height(panel))
        legend(figure, panel, 5)
        return svg_of(figure, curves=True)


def draw_path(a: Outcome, panel: Axes) -> None:
    """The paths in the plane, with 95 % ellipses along the best one."""
    if a.reference is not None:
        east, north = a.reference.position[:, :2].T
        panel.plot(east, north, color=INK, lw=2.6, alpha=0.35, label="reference")
    for name, track in a.tracks.items():
        rows = np.unique(np.linspace(0, len(a.time) - 1, LONGEST).astype(int))
        place = track.position[rows]
        panel.plot(place[:, 0], place[:, 1], color=COLOURS[name], lw=1.2, label=name)
    best = a.best
    if best is not None and best.position_std is not None:
        for row in _ellipse_rows(a):
            panel.add_patch(ellipse(best, row, COLOURS[best.method]))
    panel.set_aspect("equal", adjustable="box")
    _frame(a, panel)
    panel.set_xlabel("east [m]")
    panel.set_ylabel("north [m]")


def _height(panel: Axes) -> float:
    """Of a picture without an empty band above a path that is longer than wide."""
    across, along = np.ptp(panel.get_ylim()), np.ptp(panel.get_xlim())
    return min(TALLEST, AROUND + (WIDTH - BESIDE) * across / along)


def _frame(a: Outcome, panel: Axes) -> None:
    best = a.best
    shown = [] if best is None else [best.position[:, :2]]
    if a.reference is not None:
        shown.append(a.reference.position[:, :2])
    if not shown:
        return
    points = np.concatenate(shown)
    points = points[np.isfinite(points).all(axis=1)]
    low, high = points.min(axis=0), points.max(axis=0)
    margin = 0.15 * max(np.max(high - low), 0.1)
    panel.set_xlim(low[0] - margin, high[0] + margin)
    panel.set_ylim(low[1] - margin, high[1] + margin)


def _ellipse_rows(a: Outcome) -> np.ndarray:
    """Rows where an ellipse is drawn: the starts of the later stops, else evenly."""
    rows = np.array([start for start, _ in a.later_stops], dtype=int)
    if not 2 <= len(rows) <= 3 * ELLIPSES:
        rows = np.linspace(0, len(a.time) - 1, ELLIPSES + 1).astype(int)[1:]
    return rows


def ellipse(track: Track, row: int, colour: str) -> Ellipse:
    """The 95 % ellipse of a position in the plane."""
    std, correlation = track.position_std[row], track.correlation[row]
    both = correlation * std[0] * std[1]
    values, axes = np.linalg.eigh([[std[0] ** 2, both], [both, std[1] ** 2]])
    width, height = 2 * INSIDE * np.sqrt(np.maximum(values, 0))
    angle = np.degrees(np.arctan2(axes[1, 0], axes[0, 0]))
    return Ellipse(
        track.position[row, :2], width, height, angle=angle, fill=False, ec=colour, lw=0.8
    )


def position_picture(a: Outcome) -> str:
    return drawn(3, 1.3, lambda panels: draw_position(a, panels), a)


def draw_position(a: Outcome, panels: list[Axes]) -> None:
    """East, north and up over time, with two standard deviations of the filter."""
    second = unit_of_time(a.duration)[0]
    time = (a.time - a.time[0]) / second
    for i, (axis, panel) in enumerate(zip(("east", "north", "up"), panels, strict=True)):
        if a.reference is not None and np.isfinite(a.reference.position[:, i]).any():
            seen = a.reference.position[:, i]
            panel.plot(
                time[a.reference.rows], seen, color=INK, lw=2.6, alpha=0.35, label="reference"
            )
        for name, track in a.tracks.items():
            at, low, high = envelope(time, track.position[:, i])
            panel.plot(at, (low + high) / 2, color=COLOURS[name], lw=1.2, label=name)
            if track.position_std is not None:
                std = track.position_std[:, i]
                at, low, _ = envelope(time, track.position[:, i] - 2 * std)
                _, _, high = envelope(time, track.position[:, i] + 2 * std)
                panel.fill_between(at, low, high, color=COLOURS[name], alpha=0.18, lw=0)
        best = a.best
        values = best.position[:, i]
        if a.reference is not None and np.isfinite(a.reference.position[:, i]).any():
            values = np.concatenate([values, a.reference.position[:, i]])
        low, high = np.nanmin(values), np.nanmax(values)
        room = 0.2 * (high - low) + 1e-3
        panel.set_ylim(low - room, high + room)
        panel.set_ylabel(f"{axis} [m]")
        panel.set_xlim(0, a.duration / second)


def error_picture(a: Outcome) -> str:
    return drawn(1, 2.2, lambda panels: draw_error(a, panels[0]), a)


def draw_error(a: Outcome, panel: Axes) -> None:
    """The horizontal error of each method, and what the filter and smoother claim of theirs."""
    second = unit_of_time(a.duration)[0]
    for name, e in a.errors.items():
        at, low, high = envelope(e.time - a.time[0], np.maximum(e.horizontal, 1e-4))
        panel.plot(at / second, (low + high) / 2, color=COLOURS[name], lw=1.3, label=name)
        std = a.tracks[name].position_std
        if std is not None:
            claimed = np.maximum(np.hypot(std[:, 0], std[:, 1]), 1e-4)
            at, low, high = envelope(a.time - a.time[0], claimed)
            panel.plot(at / second, (low + high) / 2, color=COLOURS[name], lw=0.9, ls="--")
    panel.set_yscale("log")
    panel.set_xlim(0, a.duration / second)
    panel.set_ylabel("horizontal error [m]")


def nis_picture(a: Outcome) -> str:
    return drawn(1, 2.0, lambda panels: draw_nis(a, panels[0]), a)


def draw_nis(a: Outcome, panel: Axes) -> None:
    """The innovations of the first zero velocity of each stop, and their 95 % bounds."""
    second = unit_of_time(a.duration)[0]
    nis = a.filter.scalar("zupt_nis")
    rows = [start for start, _ in a.later_stops if nis[start] > 0]
    panel.plot(
        (a.time[rows] - a.time[0]) / second, nis[rows], "o", color=AFTER, label="first of a stop"
    )
    low, high = chi2.ppf([0.025, 0.975], 3)
    panel.axhspan(low, high, color=GREY, alpha=0.2, lw=0, label="95 % of them")
    panel.set_yscale("log")
    panel.set_xlim(0, a.duration / second)
    panel.set_ylabel("NIS [1]")
