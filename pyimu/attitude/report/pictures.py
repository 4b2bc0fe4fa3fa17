"""The pictures of a run of the attitude filter: angles, bias, innovations, error and status."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.attitude.filter.status import STATUS_NAMES
from pyimu.attitude.outcome import NIS_BOUNDS, Outcome
from pyimu.numerics.laws import chi2
from pyimu.report.figures import (
    AFTER,
    BEFORE,
    BINS,
    FLOOR,
    GREY,
    INK,
    ON_WHITE,
    WIDTH,
    envelope,
    legend,
    new_figure,
    style,
    svg_of,
    unit_of_time,
)
from pyimu.report.numbers import in_unit, pretty, unit_for

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

WIDER = 2.0
"""Standard deviations on either side of an estimate that its band takes: 95 %."""

SHOWN = 98
"""Percentile of the standard deviations whose band an axis reaches to: what is larger for a moment,
as at the start, would press all else flat."""

PER_BIN = 200
"""Innovations from which the quantiles of one bin of time are taken, at least: five of them are
beyond either one."""

MOST_BINS = 120
"""Bins of time in which these quantiles are shown, on average so full."""

FEW = PER_BIN // 4
"""A bin with no more innovations shows nothing."""

LEVELS = (2.5, 50, 97.5)
"""Percentiles that are shown of the innovations."""

ANGLES = ("roll", "pitch", "yaw")


# The pictures


def angles_picture(a: Outcome) -> str:
    return _drawn(3, 1.35, lambda panels: draw_angles(a, panels), a, 3)


def bias_picture(a: Outcome) -> str:
    return _drawn(3, 1.1, lambda panels: draw_bias(a, panels), a, 2)


def nis_picture(a: Outcome) -> str:
    return _drawn(1, 2.0, lambda panels: draw_nis(a, panels[0]), a, 4)


def error_picture(a: Outcome) -> str:
    return _drawn(1, 2.0, lambda panels: _draw_error(a, panels[0]), a, 3)


def status_picture(a: Outcome) -> str:
    rows = 1 + len(a.events)
    return _drawn(1, 0.3 + 0.26 * rows, lambda panels: _draw_status(a, panels[0]), a, 0)


def whole_figure(a: Outcome) -> Figure:
    """Angles, bias and innovations above each other, on white."""
    with style(ON_WHITE):
        figure, panels = new_figure(9.0, 11.0, 7)
        draw_angles(a, panels[:3])
        draw_bias(a, panels[3:6])
        draw_nis(a, panels[6])
        panels[-1].set_xlabel(f"time [{unit_of_time(a.duration)[1]}]")
        legend(figure, panels[0], 3)
    return figure


def _drawn(rows: int, height: float, draw, a: Outcome, columns: int) -> str:
    """A figure of so many panels as an SVG; its legend has so many ``columns``, 0 for none."""
    with style():
        figure, panels = new_figure(WIDTH, 0.7 + height * rows, rows)
        draw(panels)
        panels[-1].set_xlabel(f"time [{unit_of_time(a.duration)[1]}]")
        if columns:
            legend(figure, panels[0], columns)
        return svg_of(figure, curves=True)


# What a panel shows


def draw_angles(a: Outcome, panels: list[Axes]) -> None:
    """Roll, pitch and yaw [deg] with their bands, and the reference's where there is one."""
    angles, stds = (np.degrees(v) for v in (np.unwrap(a.euler, axis=0), euler_std(a)))
    reference = _reference(a)
    for i, (name, panel) in enumerate(zip(ANGLES, panels, strict=True)):
        if reference is not None:
            rows, seen = reference
            turns = 360 * np.round((seen[:, i] - angles[rows, i]) / 360)
            _line(panel, a, a.time[rows], seen[:, i] - turns, BEFORE, "reference", lw=2.6)
        _band(panel, a, angles[:, i], stds[:, i], AFTER)
        panel.set_ylabel(f"{name} [deg]")


def euler_std(a: Outcome) -> np.ndarray:
    """Standard deviations (n, 3) [rad] of roll, pitch and yaw, to first order.

    A tilt about the nose's horizontal direction is a roll by 1/cos(pitch) of it, and turns the yaw
    by tan(pitch); the filter gives the root mean square of the tilt about two axes, which stands
    for either. At most half a turn.
    """
    pitch, tilt = a.euler[:, 1], a.tilt_std
    level = np.maximum(np.cos(pitch), 1e-9)
    yaw = np.hypot(a.heading_std, np.sin(pitch) / level * tilt)
    return np.minimum(np.column_stack([tilt / level, tilt, yaw]), np.pi)


def _reference(a: Outcome) -> tuple[np.ndarray, np.ndarray] | None:
    """Rows (m,) and roll, pitch, yaw (m, 3) [deg] of the reference, its heading set right."""
    if a.error is None:
        return None
    rows = np.flatnonzero(np.isfinite(a.recording.ref_q).all(axis=1))
    seen = Rotation.from_quat(a.recording.ref_q[rows], scalar_first=True)
    first = Rotation.from_quat(a.q[rows[0]], scalar_first=True) * seen[0].inv()
    seen = Rotation.from_euler("z", first.as_euler("ZYX")[0]) * seen
    return rows, np.degrees(seen.as_euler("ZYX")[:, ::-1])


def draw_bias(a: Outcome, panels: list[Axes]) -> None:
    """The gyro's bias about each axis with its band."""
    unit = unit_for(a.gyro_bias, "rad/s")
    bias, std = (in_unit(v, "rad/s", unit) for v in (a.gyro_bias, a.std[:, 3:]))
    for i, (axis, panel) in enumerate(zip("xyz", panels, strict=True)):
        _band(panel, a, bias[:, i], std[:, i], AFTER)
        panel.set_ylabel(f"bias {axis} [{pretty(unit)}]")


def draw_nis(a: Outcome, panel: Axes) -> None:
    """The normalised innovations squared, and between which bounds 95 % of them should lie."""
    time, nis = a.time[a.updates] - a.time[0], a.nis[a.updates]
    second = unit_of_time(a.duration)[0]
    median = float(chi2.ppf(0.5, 3))
    for level, dash in zip((*NIS_BOUNDS, median), ("--", "--", ":"), strict=True):
        label = {NIS_BOUNDS[0]: "its 95 % bounds", median: "its median"}.get(level)
        panel.axhline(level, color=INK, lw=0.9, ls=dash, label=label)
    bins = min(len(nis) // PER_BIN, MOST_BINS)
    if bins < 2:
        panel.plot(time / second, nis, ".", color=AFTER, ms=2.5, label="NIS")
    else:
        groups = _by_time(time, a.duration, bins)
        none = np.full(3, np.nan)
        found = [np.percentile(nis[g], LEVELS) if len(g) > FEW else none for g in groups]
        low, middle, high = np.array(found).T
        at = (np.arange(bins) + 0.5) * a.duration / bins / second
        panel.fill_between(at, low, high, color=AFTER, alpha=0.25, lw=0, label="95 % of the NIS")
        panel.plot(at, middle, color=AFTER, lw=1.2, label="median")
    panel.set_yscale("log")
    panel.set_ylim(0.5 * min(NIS_BOUNDS[0], *panel.get_ylim()), None)
    panel.set_xlim(0, a.duration / second)
    panel.set_ylabel("NIS [1]")


def _draw_error(a: Outcome, panel: Axes) -> None:
    """Inclination and total error [deg], and what the filter claims of the inclination."""
    error, claimed = a.error, np.degrees(np.sqrt(2) * a.tilt_std)
    _line(panel, a, error.time, np.degrees(error.total), GREY, "total")
    _line(panel, a, error.time, np.degrees(error.inclination), AFTER, "inclination")
    _line(panel, a, a.time, claimed, FLOOR, "RMS of the inclination as claimed", lw=1.0)
    panel.set_ylim(0, 1.1 * np.degrees(error.total.max()) + 1.5 * np.median(claimed))
    panel.set_xlim(0, a.duration / unit_of_time(a.duration)[0])
    panel.set_ylabel("error [deg]")


def _draw_status(a: Outcome, panel: Axes) -> None:
    """Over time the share of the samples that are quasi-static, and where a bit was set."""
    second, bins = unit_of_time(a.duration)[0], 2 * BINS
    rows = [("quasi-static", a.quasi_static, AFTER), ("at rest", a.at_rest, AFTER)]
    rows += [(STATUS_NAMES[e.bit], a.status & e.bit > 0, BEFORE) for e in a.events]
    edges = np.linspace(0, a.duration, bins + 1) / second
    for k, (_, marks, colour) in enumerate(reversed(rows)):
        share = np.array(
            [marks[g].mean() if len(g) else 0.0 for g in _by_time(a.time, a.duration, bins)]
        )
        height = 0.8 * share if colour == AFTER else 0.8 * (share > 0)
        panel.stairs(k + height, edges, baseline=k, fill=True, color=colour, lw=0)
    panel.set_yticks(np.arange(len(rows)) + 0.4, [name for name, *_ in reversed(rows)])
    panel.set_ylim(-0.1, len(rows))
    panel.set_xlim(0, a.duration / second)
    panel.grid(False, axis="y")


# Curves


def _by_time(time: np.ndarray, duration: float, bins: int) -> list[np.ndarray]:
    """The rows of each of ``bins`` equal spans of the rising ``time`` (n,)."""
    edges = time[0] + (duration / bins) * np.arange(1, bins) if len(time) else []
    return np.split(np.arange(len(time)), np.searchsorted(time, edges))


def _band(panel: Axes, a: Outcome, values: np.ndarray, std: np.ndarray, colour: str) -> None:
    """An estimate (n,) and two standard deviations on either side."""
    second = unit_of_time(a.duration)[0]
    time = a.time - a.time[0]
    at, low, _ = envelope(time, values - WIDER * std)
    _, _, high = envelope(time, values + WIDER * std)
    panel.fill_between(
        at / second, low, high, color=colour, alpha=0.22, lw=0, label=f"± {WIDER:g} std"
    )
    _line(panel, a, a.time, values, colour, "smoothed" if a.smoothed else "estimate")
    least, most = values.min(), values.max()
    room = 1.1 * WIDER * np.percentile(std, SHOWN) + 0.05 * (most - least) + 1e-12
    panel.set_ylim(least - room, most + room)
    panel.set_xlim(0, a.duration / second)


def _line(panel: Axes, a: Outcome, time, values, colour: str, label: str, lw: float = 1.2) -> None:
    """A curve; where samples share a column of the picture, from the least to the largest."""
    at, low, high = envelope(time - a.time[0], values)
    at = at / unit_of_time(a.duration)[0]
    panel.plot(at, (low + high) / 2, color=colour, lw=lw, label=label)
    panel.fill_between(at, low, high, color=colour, alpha=0.45, lw=0)
