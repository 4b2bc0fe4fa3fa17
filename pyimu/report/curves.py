"""The curves of a figure as numbers: for the page to zoom into, and to be downloaded as CSV."""

from __future__ import annotations

import base64
import csv
import io
import json
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise, zip_longest
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST = 6000
"""Points of a curve beyond which it stays out: the page would be larger than the log."""

METADATA = re.compile(r'<metadata data-panels="([^"]*)">([^<]*)</metadata>')


@dataclass(frozen=True)
class Curves:
    """The curves of a picture: ``table`` is CSV in base 64, ``panels`` JSON that tells its columns.

    A panel has ``x`` (a column), ``xlabel``, ``ylabel``, ``xlog``, ``ylog`` and ``series``, each
    with a ``label``, a ``column``, a ``colour`` (a CSS variable) and whether it is ``dashed``.
    """

    panels: str
    table: str

    @property
    def element(self) -> str:
        """The curves as an element of an SVG, which draws nothing."""
        panels = self.panels.replace("&", "&amp;").replace('"', "&quot;")
        return f'<metadata data-panels="{panels}">{self.table}</metadata>'

    @staticmethod
    def of(figure: Figure, variables: dict[str, str]) -> Curves | None:
        """Those of a figure's lines and bands that have a label; None where there are none.

        ``variables`` are the CSS variables of its colours.
        """
        columns: list[tuple[str, np.ndarray]] = []
        panels = [p for axes in figure.axes if (p := _panel(axes, columns, variables))]
        if not panels:
            return None
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow([name for name, _ in columns])
        for row in zip_longest(*(values for _, values in columns)):
            writer.writerow(
                ["" if v is None or not np.isfinite(v) else f"{float(v):.7g}" for v in row]
            )
        table = base64.b64encode(text.getvalue().encode()).decode()
        return Curves(json.dumps(panels, separators=(",", ":")), table)


def _panel(
    axes: Axes, columns: list[tuple[str, np.ndarray]], variables: dict[str, str]
) -> dict[str, Any] | None:
    """A panel of a figure; its ``columns`` are added to those of the table."""
    xlabel = axes.get_xlabel() or next(
        (a.get_xlabel() for a in reversed(axes.figure.axes) if a.get_xlabel()), "x"
    )
    ylabel, series, x = axes.get_ylabel(), [], None
    for label, across, up, colour, dashed in _series(axes):
        if x is None:
            x, shared = len(columns), across
            columns.append((f"{xlabel} ({ylabel})", across))
        if len(across) == len(shared) and np.array_equal(across, shared, equal_nan=True):
            named = {"label": label, "column": len(columns), "dashed": dashed}
            series.append(named | {"colour": variables.get(colour, colour)})
            columns.append((f"{label}: {ylabel}", up))
    if x is None:
        return None
    scales = {"xlog": axes.get_xscale() == "log", "ylog": axes.get_yscale() == "log"}
    return {"x": x, "xlabel": xlabel, "ylabel": ylabel, "series": series} | scales


def _series(axes: Axes) -> Iterator[tuple[str, np.ndarray, np.ndarray, str, bool]]:
    """Label, abscissae, ordinates, colour and whether it is dashed, of each curve."""
    from matplotlib.collections import PolyCollection
    from matplotlib.colors import to_hex

    for line in axes.lines:
        label, n = str(line.get_label()), len(line.get_xdata())
        if not label.startswith("_") and 2 < n <= MOST and line.get_linestyle() != "None":
            x, y = (np.asarray(v, dtype=float) for v in line.get_data())
            yield label, x, y, to_hex(line.get_color()), line.get_linestyle() == "--"
    for band in axes.collections:
        label = str(band.get_label())
        if isinstance(band, PolyCollection) and not label.startswith("_"):
            edges = [_edges(path.vertices) for path in band.get_paths()]
            if 2 < sum(len(low) for low, _ in edges) <= MOST:
                colour = to_hex(band.get_facecolor()[0])
                for name, parts in zip(("low", "high"), zip(*edges, strict=True), strict=True):
                    x, y = _joined(parts)
                    yield f"{label}, {name}", x, y, colour, True


def _edges(vertices: Any) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper edge (n, 2) of a band as ``fill_between`` makes one: start, lower edge, end,
    and the upper one back.
    """
    points = np.asarray(vertices, dtype=float)
    n = (len(points) - 3) // 2
    return points[1 : n + 1], points[n + 2 : -1][::-1]


def _joined(parts: Sequence[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """The pieces (n, 2) of an edge as one, with an empty point in each gap between them."""
    rows = [parts[0]]
    for before, after in pairwise(parts):
        rows += [[[0.5 * (before[-1, 0] + after[0, 0]), np.nan]], after]
    x, y = np.concatenate(rows).T
    return x, y
