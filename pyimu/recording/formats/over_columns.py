"""Which column of a table a name of its header is that of, where it has too few of them."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from pyimu.recording.formats.cells import MISSING, is_number
from pyimu.recording.naming.name import named


def is_behind(names: Sequence[str], rows: Sequence[Sequence[str]], decimal: str) -> bool:
    """Whether the names, one fewer than there are columns, begin above the second of them: R writes
    a column of row names without a name of its own, and others leave out that of the times.
    """
    width = len(names) + 1
    if len(rows) < 3 or len(rows[0]) != width or not all(cell.strip() for cell in names):
        return False
    rising = [_rises([row[k].strip(' "') for row in rows], decimal) for k in (0, 1, width - 1)]
    return rising[0] and not rising[2] and (rising[1] or bool(named(names[0]).axis))


def _rises(cells: Sequence[str], decimal: str) -> bool:
    if not all(is_number(cell, decimal) and cell not in MISSING for cell in cells):
        return False
    return all(a < b for a, b in pairwise(float(cell.replace(decimal, ".")) for cell in cells))


def with_axes(names: Sequence[str]) -> list[str]:
    """The names, of which a y alone behind an x, and a z behind that, have its words: ``Acc X, Y,
    Z, Gyro X, Y, Z``.
    """
    found: list[str] = []
    for name in names:
        before = found[-1] if found else ""
        axis = {"y": "x", "z": "y"}.get(name.casefold())
        stem, blank, last = before.rpartition(" ")
        goes_on = axis is not None and blank and last.casefold() == axis
        found.append(f"{stem} {name}" if goes_on else name)
    return found
