"""The pictures of a campaign: errors, normalised errors, causes and faults."""

from __future__ import annotations

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pyimu.numerics.laws import chi2
from pyimu.report.figures import (
    AFTER,
    BEFORE,
    FLOOR,
    GREY,
    INK,
    STYLE,
    WIDTH,
    plain_logarithm,
    svg_of,
)
from pyimu.rover.campaign.faults import NONE
from pyimu.rover.campaign.report.words import plain_name
from pyimu.rover.campaign.score import ANGLES, FREEDOM
from pyimu.rover.campaign.summary import CLAIM, TARGETS, Summary

SHOWN = 8
"""Parameters of a list of causes."""

MOST_BINS = 60
"""Bars of a histogram at most; else as many as the square root of the runs."""


def errors_picture(s: Summary) -> str:
    """How large the largest errors of the runs are."""
    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=(WIDTH, 2.5), layout="constrained")
        for name, panel in zip(reversed(ANGLES), figure.subplots(1, 3), strict=True):
            _errors(s, name, panel)
        return svg_of(figure)


def _errors(s: Summary, name: str, panel: Axes) -> None:
    column = f"{name}_error_max [rad]"
    values = np.rad2deg(s.of_fault(NONE, column))
    panel.hist(values, _bins(values), color=AFTER, alpha=0.75)
    shown = list(zip(s.quantiles(column)[::2], ("-", "--"), strict=True))
    for q, style in shown:
        panel.axvline(np.rad2deg(q.value), color=INK, lw=1, ls=style)
    if values.max() > np.rad2deg(CLAIM):
        panel.axvline(np.rad2deg(CLAIM), color=BEFORE, lw=1.4)
    said = "\n".join(f"{q.p:.0%} below {np.rad2deg(q.value):.3g} deg" for q, _ in shown)
    panel.set_title(said, fontsize=8.5)
    panel.set(xlabel=f"largest {name} error [deg]", xlim=(0, None))
    panel.locator_params(axis="x", nbins=3)  # small errors have long numbers
    if name == "heading":
        panel.set_ylabel("runs")


def _bins(values: np.ndarray) -> np.ndarray:
    count = int(min(MOST_BINS, max(8, np.sqrt(len(values)))))
    # The last hundredth may lie far out and is the last bar.
    return np.linspace(values.min(), max(np.quantile(values, 0.995), values.min() + 1e-12), count)


def honesty_picture(s: Summary) -> str:
    """The normalised errors squared of the ends of the runs, and how they should lie."""
    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=(WIDTH, 2.5), layout="constrained")
        for (name, freedom), panel in zip(FREEDOM.items(), figure.subplots(1, 3), strict=True):
            values = s.of_fault(NONE, f"nees_{name}_end [1]")
            edges = chi2.ppf(np.linspace(0, 1, 21)[:-1], freedom)
            share = np.histogram(np.minimum(values, 1e300), [*edges, np.inf])[0] / len(values)
            place = np.arange(20) * 5 + 2.5
            panel.bar(place, share, 4.6, color=AFTER, alpha=0.75)
            panel.axhline(0.05, color=INK, lw=1, ls="--")
            panel.set(xlabel=f"{name}: chi-square percentile", xlim=(0, 100))
            if name == "attitude":
                panel.set_ylabel("share of the runs")
        return svg_of(figure)


def causes_picture(s: Summary) -> str:
    """First-order indices of the parameters, the largest of each error."""
    rows = max(min(SHOWN, len(s.causes[t])) for t in TARGETS)
    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=(WIDTH, 3 * (0.6 + 0.2 * rows)), layout="constrained")
        for target, panel in zip(TARGETS, figure.subplots(3, 1, sharex=True), strict=True):
            shown = s.causes[target][:SHOWN][::-1]
            place = np.arange(len(shown))
            width = [i.value for i in shown]
            half = [i.half_width for i in shown]
            panel.barh(place, width, 0.7, color=AFTER, alpha=0.75, xerr=half, ecolor=INK)
            panel.axvline(s.chance, color=GREY, lw=1, ls="--")
            panel.set_yticks(place, [plain_name(i.factor) for i in shown], fontsize=8)
            panel.set_title(plain_name(target).replace("_", " "), fontsize=9, loc="left")
            panel.set_xlim(0, 1)
        panel.set_xlabel("share of the variance that the parameter explains by itself")
        return svg_of(figure)


def faults_picture(s: Summary) -> str:
    """The largest heading errors by fault."""
    names = s.fault_names
    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=(WIDTH, 0.9 + 0.35 * len(names)), layout="constrained")
        panel = figure.subplots()
        for place, name in enumerate(reversed(names)):
            values = np.rad2deg(s.of_fault(name, "heading_error_max [rad]"))
            low, half, high = np.quantile(values, (0.05, 0.5, 0.95))
            colour = FLOOR if name == NONE else BEFORE
            panel.plot([low, high], [place, place], color=colour, lw=5, alpha=0.6)
            panel.plot(half, place, "o", color=INK, ms=4)
        panel.set_yticks(range(len(names)), list(reversed(names)))
        panel.set_xscale("log")
        plain_logarithm(panel.xaxis)
        panel.set_xlabel("largest heading error [deg]: 5 to 95 % of the runs, and the median")
        panel.set_ylim(-0.6, len(names) - 0.4)
        return svg_of(figure)
