"""A table with the samples of several inertial units: that of its first one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.formats.reader import Columns, Reader, ReaderOver

NUMBERED: tuple[tuple[str, frozenset[str]], ...] = (
    ("I", frozenset(("TimeUS", "GyrX", "GyrY", "GyrZ", "AccX", "AccY", "AccZ"))),
    ("id", frozenset(("time_usec", "abs_pressure", "xgyro", "ygyro", "zgyro"))),
)
"""Columns that number the units in tables of ArduPilot's IMU and MAVLink's HIGHRES_IMU, and what is
beside them there."""


@dataclass(frozen=True)
class OneUnitReader(ReaderOver):
    """What ``reader`` reads in rows whose column ``at`` is ``unit``."""

    reader: Reader
    at: int
    unit: int
    _left_out: list[int] = field(default_factory=list, compare=False, repr=False)

    def batches(self, positions: Sequence[int], long: int) -> Iterator[tuple[Columns, float]]:
        self._left_out[:] = [0]
        for columns, share in self.reader.batches([*positions, self.at], long):
            *columns, number = columns
            own = number == self.unit
            self._left_out[0] += int(np.count_nonzero(~own))
            yield [column[own] for column in columns], share

    def at_end(self) -> tuple[Finding, ...]:
        detail = {"unit": self.unit, "column": self.header[self.at]}
        count = sum(self._left_out)
        return (*self.reader.at_end(), *([Finding("other_units", "", count, detail)] * bool(count)))

    def count(self, long: int) -> None:
        return None

    def numeric(self) -> list[int]:
        return self.reader.numeric()

    def place(self, index: int) -> str:
        before, first = 0, 0
        for (number,), _ in self.reader.batches([self.at], self.at):
            own = np.flatnonzero(number == self.unit)
            if index < before + len(own):
                return self.reader.place(first + int(own[index - before]))
            before, first = before + len(own), first + len(number)
        return self.reader.place(index)


def with_one_unit(reader: Reader) -> Reader:
    """``reader`` with the samples of the first of its units, where a table has those of several."""
    names = set(reader.header)
    cell = next((cell for cell, beside in NUMBERED if {cell, *beside} <= names), None)
    at = -1 if cell is None else reader.header.index(cell)
    if at not in reader.numeric():
        return reader
    columns, _ = next(reader.batches([at], at), ([np.zeros(0)], 1.0))
    numbers = np.unique(columns[0])
    several = len(numbers) > 1 and np.array_equal(numbers, np.round(numbers))
    return OneUnitReader(reader, at, int(columns[0][0])) if several else reader
