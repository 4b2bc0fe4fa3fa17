"""Figures of a page as inline SVG.

Clouds are rasterised; colours are CSS variables, so that one page serves day and night.
"""

from __future__ import annotations

import io
import re
from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, Any

import numpy as np

from pyimu.report.curves import Curves

if TYPE_CHECKING:  # it takes half a second, which who draws nothing does without
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure

INK, BEFORE, AFTER, FLOOR, GREY = "#010203", "#e69f00", "#0072b2", "#009e73", "#808487"
"""Okabe-Ito, so that the two series differ for every eye; grey for what does not matter."""

WIDTH = 7.2
"""Width of a picture [inch] that takes the page's."""

VARIABLES = {
    INK: "var(--ink)",
    BEFORE: "var(--before)",
    AFTER: "var(--after)",
    FLOOR: "var(--floor)",
    GREY: "var(--grey)",
}

STYLE = {
    "svg.fonttype": "none",
    "svg.hashsalt": "pyimu",
    "font.family": "sans-serif",
    "font.size": 9.5,
    "axes.unicode_minus": False,  # as in the text, where a number can be looked for and copied
    "axes.linewidth": 0.7,
    "text.color": INK,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "xtick.color": INK,
    "ytick.color": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": GREY,
    "grid.alpha": 0.25,
    "grid.linewidth": 0.5,
    "legend.frameon": False,
    "figure.facecolor": "none",
    "axes.facecolor": "none",
}

TIMES = ((3 * 3600.0, 3600.0, "h"), (600.0, 60.0, "min"))
"""Units of time and their seconds, by the duration [s] above which they are used instead of s."""

CLOUD_DPI = 144
"""Dots an inch of what is rasterised."""

BINS = 420
"""Columns of a time series; each shows the smallest and the largest sample that falls into it, so
that spikes survive."""


ON_WHITE = {"figure.facecolor": "white", "axes.facecolor": "white"}
"""What ``style`` sets for a figure that stands by itself, not in a page."""


def style(more: dict[str, Any] | None = None) -> AbstractContextManager[None]:
    """The context in which a figure has the package's style, and what ``more`` sets."""
    import matplotlib

    return matplotlib.rc_context(STYLE | (more or {}))


def new_figure(width: float, height: float, rows: int = 1) -> tuple[Figure, list[Axes]]:
    """A figure of so many inches with panels above each other on one abscissa."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), layout="constrained")
    axes = list(figure.subplots(rows, 1, sharex=True, squeeze=False)[:, 0])
    for panel in axes[:-1]:
        panel.xaxis.set_in_layout(False)  # it shows no numbers, and to look for them takes as long
    return figure, axes


def svg_of(figure: Figure, curves: bool = False) -> str:
    """The figure as an SVG element that can stand in a page.

    It has no prolog and no repeated identifiers, and no metadata but, where they are asked for, its
    ``curves``, which a page then lets its reader zoom into and download.
    """
    text = _drawn(figure)
    text = text[text.index("<svg") :]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    text = re.sub(r' id="[A-Za-z0-9]+_\d+"| xmlns(:xlink)?="[^"]*"', "", text)
    text = re.sub(
        r'(<svg[^>]*?) width="[^"]*"',
        r"\1",
        re.sub(r'(<svg[^>]*?) height="[^"]*"', r"\1", text, count=1),
        count=1,
    )
    text = re.sub(r"\n\s*", "\n", text)
    for colour, variable in VARIABLES.items():
        text = text.replace(colour, variable)
    numbers = Curves.of(figure, VARIABLES) if curves else None
    return text if numbers is None else text.replace("</svg>", numbers.element + "</svg>")


def _drawn(figure: Figure) -> str:
    """The figure as matplotlib writes it, clouds at ``CLOUD_DPI``.

    Laid out once and drawn once: ``savefig`` does both twice, and most of a page's time is that.
    """
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    layout = figure.get_layout_engine()
    if layout is not None:
        layout.execute(figure)
        figure.set_layout_engine("none")
    buffer = io.StringIO()
    figure.set_dpi(CLOUD_DPI)
    nothing = dict.fromkeys(("Date", "Creator", "Format", "Type"))
    FigureCanvasSVG(figure).print_svg(buffer, metadata=nothing)
    return buffer.getvalue()


def legend(figure: Figure, panel: Axes, columns: int) -> None:
    """The legend of a panel above the figure."""
    figure.legend(
        *panel.get_legend_handles_labels(),
        loc="outside upper left",
        ncols=columns,
        borderaxespad=0.1,
        handlelength=1.4,
        columnspacing=1.1,
        fontsize=8.5,
    )


def plain_logarithm(axis: Axis) -> None:
    """Numbers without powers; 1, 2, 5 where less than two decades are seen, else decades.

    The marks between them are drawn as one line: as ticks, each a dozen objects, they would take
    longer than all else in a picture. So this comes last, when the limits are what they will be.
    """
    from matplotlib.lines import Line2D
    from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

    low, high = axis.get_view_interval()
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if high < 100 * low else (1.0,)))
    axis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:g}"))
    axis.set_minor_locator(NullLocator())
    decades = 10.0 ** np.arange(np.floor(np.log10(low)), np.ceil(np.log10(high)))
    marks = np.outer(decades, np.arange(2, 10)).ravel()
    marks = marks[(marks >= low) & (marks <= high)]
    if not len(marks):
        return  # an empty line lies at the figure's corner, and the layout makes room for it there
    panel, across = axis.axes, axis.axis_name == "x"
    places = (marks, np.zeros(len(marks)))
    panel.add_artist(
        Line2D(
            *(places if across else places[::-1]),
            linestyle="none",
            marker=3 if across else 0,  # TICKDOWN, TICKLEFT
            markersize=2,
            markeredgewidth=0.6,
            color=INK,
            clip_on=False,
            transform=panel.get_xaxis_transform() if across else panel.get_yaxis_transform(),
        )
    )


def unit_of_time(duration: float) -> tuple[float, str]:
    """Seconds and name of the unit in which an axis shows so many s."""
    return next(((size, unit) for least, size, unit in TIMES if duration > least), (1.0, "s"))


def envelope(
    time: np.ndarray, values: np.ndarray, bins: int = BINS
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Smallest and largest value in each of ``bins`` intervals of time.

    They are NaN where an interval has no sample but missing ones.
    """
    if len(time) <= bins:
        return time, values, values
    edges = np.linspace(time[0], time[-1], bins + 1)
    place = np.clip(np.searchsorted(edges, time, side="right") - 1, 0, bins - 1)
    low, high = np.full(bins, np.inf), np.full(bins, -np.inf)
    np.fmin.at(low, place, values)
    np.fmax.at(high, place, values)
    empty = low > high
    low[empty] = high[empty] = np.nan
    return 0.5 * (edges[1:] + edges[:-1]), low, high
