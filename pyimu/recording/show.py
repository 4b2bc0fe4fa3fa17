"""A recording in a notebook: as a table, and over time. ``recording`` is a ``Recording``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pyimu.display import notebook
from pyimu.recording.columns import GROUPS, column_names
from pyimu.units import convert

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PEOPLE = {"rad/s": "deg/s", "m/s^2": "g", "rad": "deg", "T": "uT"}
"""Units in which people read a column; others stay as they are."""

BINS = 2000
"""Parts of a longer log, of each of which the smallest and the largest sample are drawn."""


def shown(group: str, values: np.ndarray) -> tuple[np.ndarray, str]:
    """The values of a group in the unit for people, as (n, columns), and that unit."""
    unit = GROUPS[group].unit
    people = PEOPLE.get(unit, unit)
    return np.reshape(convert(values, unit, people), (len(values), -1)), people


def as_html(recording: Any) -> str:
    """Rate, duration and gaps, and of each column its least, mean and largest value."""
    rows = []
    for group, values in recording.groups.items():
        array, unit = shown(group, values)
        for name, column in zip(column_names(group), array.T, strict=True):
            known = column[np.isfinite(column)]
            least, mean, most = (
                (known.min(), known.mean(), known.max()) if len(known) else (np.nan,) * 3
            )
            figures = (f"{v:.4g}" for v in (least, mean, most))
            rows.append(
                (name, "" if unit == "1" else unit, *figures, f"{len(column) - len(known)}")
            )
    span = recording.time[-1] - recording.time[0]
    note = (
        f"{len(recording):,} samples at {recording.sample_rate:.5g} Hz over {span:.5g} s, "
        f"{len(recording.segments) - 1} gaps, {len(recording.findings)} findings"
    )
    head = ("column", "unit", "least", "mean", "largest", "missing")
    return notebook.block(f"Recording {recording.name}", note, notebook.table(head, rows))


def plot(recording: Any) -> Figure:
    """The groups of a recording over time, a panel each, in deg/s, g and degC."""
    from matplotlib.figure import Figure

    groups = recording.groups
    figure = Figure(figsize=(8.0, 1.2 + 1.4 * max(len(groups), 1)), layout="constrained")
    panels = figure.subplots(max(len(groups), 1), 1, sharex=True, squeeze=False)[:, 0]
    for panel, (group, values) in zip(panels, groups.items()):
        array, unit = shown(group, values)
        for suffix, column in zip(GROUPS[group].suffixes or ("",), array.T, strict=True):
            panel.plot(*_drawn(recording.time, column), linewidth=0.8, label=suffix)
        panel.set_ylabel(group if unit == "1" else f"{group} [{unit}]")
        panel.grid(alpha=0.25)
        if GROUPS[group].suffixes:
            panel.legend(loc="upper right", ncols=4, fontsize="small", frameon=False)
    panels[-1].set_xlabel("time [s]")
    figure.suptitle(recording.name)
    return notebook.shown(figure)


def _drawn(time: np.ndarray, column: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A column over time; of a long one the extremes of equal parts, so that no spike is lost."""
    if len(column) <= 2 * BINS:
        return time, column
    size = -(-len(column) // BINS)
    whole = len(column) // size * size
    parts = column[:whole].reshape(-1, size)
    low, high = (np.where(np.isnan(parts), fill, parts) for fill in (np.inf, -np.inf))
    extremes = np.column_stack([low.min(axis=1), high.max(axis=1)])
    extremes[~np.isfinite(extremes)] = np.nan
    return np.repeat(time[:whole:size], 2), extremes.ravel()
