"""A table with the samples of several inertial units: that of its first one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from pyimu.errors import Finding, UserError
from pyimu.recording.formats.bodies import WISDM
from pyimu.recording.formats.reader import Columns, Reader, ReaderOver
from pyimu.recording.naming.name import named

PERSON = "user"
"""People come one behind the other, the second perhaps far behind the first rows."""

NUMBERED: tuple[tuple[str, frozenset[str]], ...] = (
    ("I", frozenset(("TimeUS", "GyrX", "GyrY", "GyrZ", "AccX", "AccY", "AccZ"))),
    ("id", frozenset(("time_usec", "abs_pressure", "xgyro", "ygyro", "zgyro"))),
    (PERSON, frozenset(WISDM)),
)
"""Columns that number the units in tables of ArduPilot's IMU and MAVLink's HIGHRES_IMU, and the
people in WISDM's, each with a phone; and what is beside them there."""

NUMBERS = tuple((word,) for word in ("id", "sensor", "imu", "device", "node", "unit", "instance"))
"""Last words of the names of columns that may number the units in any other table."""

COUNTED = {"no", "nr", "num", "number", "index"}
"""Last words behind one of those: ``sensor_no``."""

MOST_UNITS = 16
"""Units whose samples stand in one table, at most."""

EVEN = 0.5
"""Share of its part of the rows that each unit has at least."""


@dataclass(frozen=True)
class OneUnitReader(ReaderOver):
    """What ``reader`` reads in rows whose column ``at`` is ``unit``."""

    reader: Reader
    at: int
    unit: int
    _left_out: list[int] = field(default_factory=list, compare=False, repr=False)

    def batches(self, positions: Sequence[int], long: int) -> Iterator[tuple[Columns, float]]:
        """Raises UserError where no row is of that unit."""
        self._left_out[:], seen = [0], False
        for columns, share in self.reader.batches([*positions, self.at], long):
            *columns, number = columns
            own = number == self.unit
            self._left_out[0] += int(np.count_nonzero(~own))
            seen = seen or bool(own.any())
            yield [column[own] for column in columns], share
        if not seen:
            raise UserError(f"{self.path}: no row has {self.unit} as its {self.header[self.at]}")

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


def with_one_unit(reader: Reader, wanted: str = "") -> Reader:
    """``reader`` with the samples of one of its units, where a table has those of several: that
    with the number ``wanted``, the first where none is named.
    """
    at = unit_column(reader)
    if at is None:
        return reader
    first = next(reader.batches([at], at))[0][0][0]
    return OneUnitReader(reader, at, int(wanted) if wanted.isdigit() else int(first))


def unit_column(reader: Reader) -> int | None:
    """The position of the column that numbers the units of a table with several, else None."""
    names = set(reader.header)
    known = [cell for cell, beside in NUMBERED if {cell, *beside} <= names]
    told = known or [cell for cell in reader.header if _is_number_of_unit(cell)]
    if not told or reader.header.index(told[0]) not in reader.numeric():
        return None
    at = reader.header.index(told[0])
    columns, _ = next(reader.batches([at], at), ([np.zeros(0)], 1.0))
    numbers, counts = np.unique(columns[0], return_counts=True)
    several = (len(numbers) > 1 or told[0] == PERSON) and np.array_equal(numbers, np.round(numbers))
    return at if several and (known or _come_in_turn(columns[0], counts)) else None


def _is_number_of_unit(cell: str) -> bool:
    """Whether a column is called as one that numbers sensors is: ``sensor_id``, ``Device``."""
    name = named(cell)
    words = name.words[:-1] if name.words[-1:] and name.words[-1] in COUNTED else name.words
    return words[-1:] in NUMBERS and not name.axis and not name.unit


def _come_in_turn(numbers: np.ndarray, counts: np.ndarray) -> bool:
    """Whether rows of few units alternate; those of a state stay for long, and a counter's are
    many.
    """
    even = len(counts) <= MOST_UNITS and counts.min() * len(counts) > EVEN * counts.sum()
    return bool(even and np.mean(np.diff(numbers) != 0) > EVEN / MOST_UNITS)
