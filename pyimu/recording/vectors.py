"""The columns of a vector in a layout that is known."""

from __future__ import annotations

import re
from collections.abc import Sequence

from pyimu.recording.columns import XYZ
from pyimu.recording.formats.reader import Reader


def triad_map(names: Sequence[str], group: str, unit: str) -> dict[str, str]:
    """What a column map says of the three columns ``names`` of a vector, x first."""
    return {name: f"{group}_{a} [{unit}]" for name, a in zip(names, XYZ, strict=True)}


def unnamed(reader: Reader, word: str, width: int) -> list[str] | None:
    """The cells of a table of so many columns without names, in a file whose name has a ``word``;
    None of any other.
    """
    bare = all(re.fullmatch(r"column \d+", cell) for cell in reader.header)
    name = reader.path.name.casefold()
    return reader.header if bare and len(reader.header) == width and word in name else None
