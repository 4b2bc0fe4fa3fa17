"""The columns of a vector and of the time in a layout that is known."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import islice

from pyimu.recording.columns import XYZ
from pyimu.recording.formats.reader import Reader
from pyimu.recording.guess.numbers import time_unit
from pyimu.recording.naming.name import named


def triad_map(names: Sequence[str], group: str, unit: str | Sequence[str]) -> dict[str, str]:
    """What a column map says of the three columns ``names`` of a vector, x first, of one unit or of
    one each.
    """
    units = [unit] * 3 if isinstance(unit, str) else unit
    return {n: f"{group}_{a} [{u}]" for n, a, u in zip(names, XYZ, units, strict=True)}


def unnamed(reader: Reader, word: str, width: int) -> list[str] | None:
    """The cells of a table of so many columns without names, in a file whose name has a ``word``;
    None of any other.
    """
    bare = all(re.fullmatch(r"column \d+", cell) for cell in reader.header)
    name = reader.path.name.casefold()
    return reader.header if bare and len(reader.header) == width and word in name else None


def time_line(reader: Reader, cells: Sequence[str]) -> dict[str, str]:
    """What a column map says of the first of the ``cells`` that is a time whose unit is known, by
    its name or by its numbers; empty without one.
    """
    for cell in cells:
        unit = "s" if cell in reader.clocks else named(cell).clock
        at = reader.header.index(cell)
        if unit is None and at in reader.numeric():
            pieces = [c for (c,), _ in islice(reader.batches([at], at), 1)]
            unit = time_unit(pieces[0]).unit if pieces else None
        if unit is not None:
            return {cell: f"time [{unit}]"}
    return {}
