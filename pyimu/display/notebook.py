"""HTML for notebooks: a title, a note, tables and pictures, in the notebook's own style."""

from __future__ import annotations

import io
from collections.abc import Iterable, Sequence
from html import escape
from typing import TYPE_CHECKING, Any

from pyimu.errors import UserError

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from pandas import DataFrame

COLOURS = {
    "ink": "currentColor",
    "before": "#e69f00",
    "after": "#0072b2",
    "floor": "#009e73",
    "grey": "#808487",
}
"""What the pictures of the pages take for their colours, Okabe-Ito."""

LEFT = "text-align: left"


def block(title: str, note: str = "", *parts: str) -> str:
    """A result for a notebook: what it is, one line on it, and tables or pictures (HTML)."""
    line = f"<div>{escape(note)}</div>" if note else ""
    return f"<div><b>{escape(title)}</b>{line}{''.join(parts)}</div>"


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table of text; the first column is flush left."""
    cells = "".join(f'<th style="{LEFT}">{escape(h)}</th>' for h in head)
    body = "".join(
        "<tr>" + "".join(f'<td style="{LEFT}">{escape(str(c))}</td>' for c in row) + "</tr>"
        for row in rows
    )
    return f"<table><thead><tr>{cells}</tr></thead><tbody>{body}</tbody></table>"


def lines(text: str) -> str:
    """Text of a terminal, its columns kept, which scrolls where it is wide."""
    return f'<pre style="overflow-x: auto; white-space: pre">{escape(text)}</pre>'


def data_frame(columns: Any) -> DataFrame:
    """A pandas data frame of columns or rows. Raises UserError where pandas is not installed."""
    try:
        from pandas import DataFrame
    except ImportError:
        raise UserError(
            "a data frame needs pandas, which is not installed; install the extra: pip install "
            "'pyimu[frames]'"
        ) from None
    return DataFrame(columns)


def shown(figure: Figure) -> Figure:
    """The figure, which a notebook then shows as a picture, whatever its matplotlib is set to."""

    def png() -> bytes:
        buffer = io.BytesIO()
        figure.savefig(buffer, format="png", dpi=100)
        return buffer.getvalue()

    figure._repr_png_ = png  # type: ignore[attr-defined]
    return figure


def picture(svg: str) -> str:
    """A picture of a page (SVG) with the colours that the page would give it."""
    colours = "; ".join(f"--{name}: {value}" for name, value in COLOURS.items())
    return f'<div style="{colours}; max-width: 720px">{svg}</div>'
