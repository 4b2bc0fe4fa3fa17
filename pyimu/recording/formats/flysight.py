"""FlySight 2's SENSOR.CSV (its user guide, "Sensor file"): lines that begin with the sensor's word,
of which ``$COL`` and ``$UNIT`` in the head say the fields and their units.
"""

from __future__ import annotations

from collections.abc import Sequence

from pyimu.recording.formats.marked import Marked
from pyimu.recording.naming.name import named
from pyimu.recording.spelling import unit_of

SENSORS = ("IMU", "MAG")
"""Words of the lines that are read; the log's times are those of the first."""


def flysight(lines: Sequence[str], topic: str = "") -> Marked | None:
    """How the lines of one sensor of a FlySight are read, of ``topic`` where it is named; None of
    any other file.
    """
    if not any(line.startswith("$FLYS,") for line in lines[:1]):
        return None
    heads = [line.strip().split(",") for line in lines if line.startswith(("$COL,", "$UNIT,"))]
    said = {(row[0], row[1]): row[2:] for row in heads if len(row) > 2}
    there = [word for word in SENSORS if ("$COL", word) in said]
    own = topic or next(iter(there), "")
    if own not in there:
        return None
    fields = said["$COL", own]
    units = [*said.get(("$UNIT", own), []), *[""] * len(fields)]
    names = tuple(_name(f, u, own) for f, u in zip(fields, units, strict=False))
    begin = f"${own},"

    def rewrite(line: str) -> str | None:
        return line[len(begin) :] if line.startswith(begin) else None

    others = tuple(word for word in there if word != own)
    return Marked(names, rewrite, f"the lines ${own}", word=own, words=others)


def _name(field: str, unit: str, word: str) -> str:
    """A field's name with its unit; one that is an axis alone is the sensor's."""
    field = field if named(field).words else f"{word.lower()}_{field}"
    known = unit_of(unit.replace("deg C", "degC"))
    return field if known is None else f"{field} [{known}]"
