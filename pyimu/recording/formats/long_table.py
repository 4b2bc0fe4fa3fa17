"""Tables with a row for each value of each axis, as databases of time series export them."""

from __future__ import annotations

from collections.abc import Sequence

from pyimu.recording.formats.cells import is_number
from pyimu.recording.formats.told import Layout
from pyimu.recording.naming.name import named

VALUES = {"value", "values", "val", "reading"}
"""What the column of the numbers is called."""

INFLUX = {"_field", "_value"}
"""Columns of InfluxDB's tables, in which one axis stands below the other."""

MOST = 40
"""Different names of axes, at most."""

WIDER = (
    "has a row for each value of each axis ({names} in column {cell}); make a column of each, as a "
    "pivot table of a spreadsheet or of pandas does"
)
"""What is said of such a table."""


def long_table(rows: Sequence[str], form: Layout) -> str | None:
    """What is said of a table of that form with these first ``rows``, None of any other."""
    cells = [form.cells(row.rstrip("\r\n")) for row in rows]
    head = next((row for row in cells if VALUES & {c.strip("_ ").casefold() for c in row}), None)
    if head is None:
        return None
    if INFLUX <= set(map(str.strip, head)):
        return WIDER.format(names="its fields", cell="_field")
    below = [row for row in cells[cells.index(head) + 1 :] if len(row) == len(head)]
    for at, cell in enumerate(head):
        texts = [row[at].strip() for row in below]
        kinds = list(dict.fromkeys(texts))
        if not 3 <= len(kinds) <= MOST or any(map(is_number, kinds)) or 3 * len(kinds) > len(texts):
            continue
        if {"x", "y", "z"} <= {named(kind).axis for kind in kinds}:
            return WIDER.format(names=", ".join(kinds[:3]), cell=cell.strip() or at + 1)
    return None
