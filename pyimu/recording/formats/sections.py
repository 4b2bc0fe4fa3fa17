"""Tables behind sections that say how they are taken apart.

LabVIEW's measurement files (National Instruments, "Specification for the LabVIEW Measurement File")
say separator, decimal mark, units and the time between samples; Racelogic's VBO files ("VBO file
format") the columns and their units, and have times of day as ``105950.12``; OpenSignals' text
("OpenSignals Text File Format", Plux) the columns and the rate of each device in JSON; Empatica's
tables (E4 connect, "info.txt") their first time and their rate in the rows before their numbers;
Vicon Nexus' tables of devices their rate in the second row.
"""

from __future__ import annotations

import json
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
    return _labview(rows) or _vbo(rows) or _opensignals(rows) or _empatica(rows)


OPEN_SIGNALS = "# OpenSignals Text File Format"
EMPATICA = ("ACC x", "ACC y", "ACC z")
"""What the columns of the only table of Empatica's that has three are called here."""

SINCE_1970 = (946684800.0, 4102444800.0)
"""s; from the year 2000 to 2100."""


def _opensignals(rows: Sequence[str]) -> Sections | None:
    end = next((k for k, row in enumerate(rows) if row.strip() == "# EndOfHeader"), None)
    if end is None or rows[0].strip() != OPEN_SIGNALS or end < 2:
        return None
    try:
        devices = list(json.loads(rows[1].lstrip("# ")).values())
        names = [str(name) for device in devices for name in device["column"]]
        rates = {float(device["sampling rate"]) for device in devices}
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return None
    names = [n if n not in names[:k] else f"{n} column {k + 1}" for k, n in enumerate(names)]
    width = len(rows[end + 1].split("\t")) if end + 1 < len(rows) else 0
    names += [f"column {k + 1}" for k in range(len(names), width)]
    rate = rates.pop() if len(rates) == 1 and min(rates) > 0 else None
    return Sections("\t", ".", tuple(names[: width or None]), end + 2, rate)


def _empatica(rows: Sequence[str]) -> Sections | None:
    cells = [[_number(cell) for cell in row.split(",")] for row in rows[:3]]
    if len(cells) < 3 or any(len(c) != len(EMPATICA) or None in c for c in cells):
        return None
    (since, *others), (rate, *rates), _ = cells
    if set(others) != {since} or set(rates) != {rate} or since is None or rate is None:
        return None
    if not (SINCE_1970[0] < since < SINCE_1970[1] and 0 < rate < 1000):
        return None
    return Sections(",", ".", EMPATICA, 3, rate)


def _number(cell: str) -> float | None:
    try:
        return float(cell)
    except ValueError:
        return None


def rate_of_devices(head: Sequence[str]) -> float | None:
    """Hz; what the second row of Vicon Nexus' table of devices says."""
    rows = [line.strip(" ,\t\r\n") for line in head[:2]]
    rate = _number(rows[1]) if rows[:1] == ["Devices"] and len(rows) > 1 else None
    return rate if rate is not None and rate > 0 else None


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
    for k, unit in enumerate(said.get("Y_Unit_Label", ())[: width - 1], 1):
        names[k] = f"{names[k]} [{unit}]" if unit_of(unit) else names[k]
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
