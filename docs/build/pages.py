"""What the programs that write documentation share."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from pyimu.files import write_text

DOCS = Path(__file__).resolve().parents[1]
"""The folder of the documentation."""


def write_changed(page: Path, text: str) -> bool:
    """Write a page unless it holds this text; gives whether it was written."""
    if page.is_file() and page.read_bytes() == text.encode():
        return False
    write_text(page, text)
    return True


def row(cells: Iterable[str]) -> str:
    """One row of a table."""
    return f"| {' | '.join(map(_cell, cells))} |"


def _cell(text: str) -> str:
    """A bar inside a cell would end it."""
    return text.replace("|", r"\vert{}" if text.startswith("$") else r"\|")
