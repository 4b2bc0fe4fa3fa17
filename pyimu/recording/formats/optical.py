"""Tables of optical systems: of Motive (OptiTrack), Vicon Nexus and Tracker, and Qualisys.

Each has lines before the table that say the rate, and rows above the numbers that say in one cell
for several columns which body they are of.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass

LENGTHS = {"millimeters": "mm", "centimeters": "cm", "meters": "m"}
"""Motive's units of lengths."""

VICON = ("objects", "segments")
"""First lines of Vicon's tables of bodies."""

QUALISYS = "NO_OF_FRAMES"
"""What Qualisys Track Manager's tables begin with."""

FRAME, SUB_FRAME, SECONDS, TIME = "Frame", "Sub Frame", "Time (Seconds)", "Time"


@dataclass(frozen=True)
class Optical:
    """The ``names`` of the columns, the line of the first numbers, from 1, and the rate [Hz]."""

    separator: str
    names: tuple[str, ...]
    first: int
    rate: float | None


def optical(head: Sequence[str]) -> Optical | None:
    """How a table of an optical system stands in its file, None of any other."""
    start = head[0].lstrip("\ufeff").strip() if head else ""
    if start.startswith("Format Version,"):
        return _motive(_cells(head, ","))
    if start.rstrip(",").casefold() in VICON:
        return _vicon(_cells(head, ","))
    return _qualisys(_cells(head, "\t")) if start.startswith(QUALISYS) else None


def _cells(head: Sequence[str], separator: str) -> list[list[str]]:
    """The cells of each line; none of one in which a quotation mark is left open."""
    return [[cell.strip() for cell in _row(line, separator)] for line in head]


def _row(line: str, separator: str) -> list[str]:
    try:
        return next(csv.reader([line], delimiter=separator), [])
    except csv.Error:
        return []


def _motive(rows: Sequence[Sequence[str]]) -> Optical | None:
    """Motive (its manual, "Data Export: CSV"): rows of the kind, the name and the quantity of each
    column above that of the axes.
    """
    at = next((k for k, row in enumerate(rows) if row[:2] == [FRAME, SECONDS]), None)
    if at is None:
        return None
    said = dict(zip(rows[0][::2], rows[0][1::2], strict=False))
    length = LENGTHS.get(said.get("Length Units", "").casefold(), "")
    above = [row for row in rows[1:at] if any(row)]
    names = list(rows[at])
    for k in range(2, len(names)):
        name, what = (_at(above, row, k) for row in (1, -1))
        unit = f" [{length}]" if length and what == "Position" else ""
        names[k] = " ".join(filter(None, (name, what, names[k]))) + unit
    rate = _number(said.get("Export Frame Rate", ""))
    return Optical(",", tuple(names), at + 2, rate if _counted(rows[at + 1 :], rate) else None)


def _counted(rows: Sequence[Sequence[str]], rate: float | None) -> bool:
    """Whether the first numbers of rows, of frames, are the second ones, in s, times the ``rate``:
    but for their rounding to ms.
    """
    pairs = [(_number(row[0]) or 0.0, _number(row[1]) or 0.0) for row in rows if len(row) > 1]
    if rate is None or len(pairs) < 2:
        return False
    frames, seconds = pairs[-1][0] - pairs[0][0], pairs[-1][1] - pairs[0][1]
    return abs(frames / rate - seconds) <= 0.0011


def _at(rows: Sequence[Sequence[str]], row: int, column: int) -> str:
    """A cell, empty where there is none."""
    there = len(rows) > max(row, -row - 1) and len(rows[row]) > column
    return rows[row][column] if there else ""


def _vicon(rows: Sequence[Sequence[str]]) -> Optical | None:
    """Vicon: the rate in the second line, names of bodies in the third, units below the axes."""
    if len(rows) < 5 or rows[3][:2] != [FRAME, SUB_FRAME]:
        return None
    names, body = list(rows[3]), ""
    while names and not names[-1]:
        names.pop()
    for k in range(2, len(names)):
        body = re.sub("^Global Angle ", "", _at(rows, 2, k)) or body
        unit = _at(rows, 4, k)
        names[k] = f"{body} {names[k]}" + (f" [{unit}]" if unit else "")
    return Optical(",", tuple(names), 6, _number(rows[1][0] if rows[1] else ""))


def _qualisys(rows: Sequence[Sequence[str]]) -> Optical | None:
    """Qualisys Track Manager (its manual, "TSV file formats"): lines of a word and its value, then
    the row of names; places are in mm.
    """
    at = next((k for k, row in enumerate(rows) if row[:2] == [FRAME, TIME]), None)
    if at is None:
        return None
    names = [re.sub(r"(.+ [XYZ])$", r"\1 [mm]", cell) for cell in rows[at]]
    while names and not names[-1]:
        names.pop()
    said = {row[0]: row[1] for row in rows[:at] if len(row) > 1}
    return Optical("\t", tuple(names), at + 2, _number(said.get("FREQUENCY", "")))


def _number(text: str) -> float | None:
    try:
        value = float(text)
    except ValueError:
        return None
    return value if 0 < value < float("inf") else None
