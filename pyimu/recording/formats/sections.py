"""Tables behind sections that say how they are taken apart.

LabVIEW's measurement files (National Instruments, "Specification for the LabVIEW Measurement File")
say separator, decimal mark, units and the time between samples; Racelogic's VBO files ("VBO file
format") the columns and their units, and have times of day as ``105950.12``.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from pyimu.recording.formats.marked import Rewrite
from pyimu.recording.spelling import unit_of

END = "***End_of_Header***"
"""What ends each of LabVIEW's sections."""

_TIME_OF_DAY = re.compile(r"(\d\d)(\d\d)(\d\d(?:\.\d+)?)")


@dataclass(frozen=True)
class Sections:
    """How the table is taken apart: its ``names``, the line of its ``first`` row, from 1, what
    makes a row between commas of a line, and the columns of times of day.
    """

    separator: str
    decimal: str
    names: tuple[str, ...]
    first: int
    rate: float | None = None
    rewrite: Rewrite | None = None
    clocks: tuple[int, ...] = ()


def sections(head: Sequence[str]) -> Sections | None:
    """Of the first lines of a text, None where they have no such sections."""
    rows = [line.rstrip("\r\n") for line in head]
    return _labview(rows) or _vbo(rows)


def _labview(rows: Sequence[str]) -> Sections | None:
    ends = [k for k, row in enumerate(rows) if row.startswith(END)]
    if not ends or not rows[0].startswith("LabVIEW") or ends[-1] + 2 >= len(rows):
        return None
    said: dict[str, list[str]] = {}
    separator = "," if "Separator,Comma" in rows else "\t"
    for row in rows[: ends[-1]]:
        key, *values = row.rstrip(separator).split(separator)
        said[key] = values
    decimal = ",".join(said.get("Decimal_Separator", ["."])) or ","
    width = len(rows[ends[-1] + 2].split(separator))
    names = (rows[ends[-1] + 1].split(separator) + [""] * width)[:width]
    for k, unit in enumerate(said.get("Y_Unit_Label", ()), 1):
        names[k:] = [f"{names[k]} [{unit}]", *names[k + 1 :]] if unit_of(unit) else names[k:]
    timed = said.get("X_Columns", ["One"])[0] != "No"
    if timed and set(said.get("X_Dimension", ["Time"])) == {"Time"}:
        names[0] = "Time [s]"
    steps = {step.replace(",", ".") for step in said.get("Delta_X", ())}
    rate = None if timed or len(steps) != 1 else _rate(steps.pop())
    return Sections(separator, decimal, tuple(names), ends[-1] + 3, rate)


def _rate(step: str) -> float | None:
    """Hz; of the time [s] between samples."""
    try:
        seconds = float(step)
    except ValueError:
        return None
    return 1 / seconds if 0 < seconds < float("inf") else None


def _vbo(rows: Sequence[str]) -> Sections | None:
    at = {row.strip().casefold(): k for k, row in enumerate(rows) if row.startswith("[")}
    if not {"[column names]", "[data]"} <= set(at):
        return None
    names = rows[at["[column names]"] + 1].split()
    units: list[str] = []
    if "[channel units]" in at:
        start = at["[channel units]"] + 1
        stop = next((k for k in range(start, len(rows)) if rows[k][:1] in ("", "[")), start)
        units = [row.strip() for row in rows[start:stop]]
    for k, unit in enumerate(units, len(names) - len(units)) if len(units) <= len(names) else ():
        names[k] = f"{names[k]} [{unit}]" if unit_of(unit) else names[k]
    clocks = tuple(k for k, name in enumerate(names) if name.casefold() == "time")

    def rewrite(line: str) -> str | None:
        cells = line.split()
        if len(cells) != len(names):
            return line
        for k in clocks:
            cells[k] = _TIME_OF_DAY.sub(r"\1:\2:\3", cells[k])
        return ",".join(cells)

    return Sections(",", ".", tuple(names), at["[data]"] + 2, rewrite=rewrite, clocks=clocks)
