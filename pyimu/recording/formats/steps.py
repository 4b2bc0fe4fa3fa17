"""A file that has the time from row to row in place of times: they are the sums of it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.column_map import ForeignMap
from pyimu.recording.formats.reader import Columns, Reader, ReaderOver
from pyimu.recording.naming.endings import in_brackets
from pyimu.recording.naming.name import named
from pyimu.recording.naming.words import CLOCKS, NUMBERS, PERIODS, SUMMED, TIMES

NAME = " ".join(SUMMED)


@dataclass(frozen=True)
class StepsReader(ReaderOver):
    """What ``reader`` reads, with the times for the steps in its column ``at``, in their unit."""

    reader: Reader
    at: int

    rate = None

    @property
    def header(self) -> list[str]:  # type: ignore[override]
        cells = list(self.reader.header)
        cells[self.at] = made_of(cells[self.at])
        return cells

    @property
    def findings(self) -> tuple[Finding, ...]:  # type: ignore[override]
        detail = {"read_as": f"times that are the sums of {self.reader.header[self.at]}"}
        return (*self.reader.findings, Finding("layout", "time", 1, detail))

    def batches(self, positions: Sequence[int], long: int) -> Iterator[tuple[Columns, float]]:
        before: float | np.integer = 0
        for columns, share in self.reader.batches(positions, long):
            if self.at in positions and len(columns[0]):
                k = positions.index(self.at)
                columns[k] = before + np.cumsum(columns[k])
                before = columns[k][-1]
            yield columns, share

    def count(self, long: int) -> int | None:
        return self.reader.count(long)

    def numeric(self) -> list[int]:
        return self.reader.numeric()


def made_of(cell: str) -> str:
    """The name of the column of times for one of steps, with its unit."""
    unit = named(cell).clock
    return f"{NAME} {cell}" + (f" [{unit}]" if unit and in_brackets(cell) is None else "")


def with_summed_steps(reader: Reader, foreign: ForeignMap) -> tuple[Reader, ForeignMap]:
    """``reader`` with times of its steps where it has no others, and nobody says its rate, or what
    else the column is.
    """
    names = [named(cell) for cell in reader.header]
    at = next((k for k, name in enumerate(names) if _are_steps(name.words) and not name.axis), None)
    if at is None or foreign.rate is not None or reader.rate is not None or reader.clocks:
        return reader, foreign
    cell = reader.header[at]
    others = (n.is_time and not set(n.words) & NUMBERS for k, n in enumerate(names) if k != at)
    if cell in foreign.columns or any(others) or at not in reader.numeric():
        return reader, foreign
    columns, _ = next(reader.batches([at], at), ([np.zeros(0)], 1.0))
    steps = columns[0][np.isfinite(columns[0])]
    # A time that is called an interval or elapsed rises.
    rise = len(steps) > 2 and bool(np.all(np.diff(steps) > 0))
    if len(steps) < 3 or steps.min() < 0 or steps.max() <= 0 or rise:
        return reader, foreign
    return StepsReader(reader, at), foreign


def _are_steps(words: Sequence[str]) -> bool:
    """Whether a column is called as the time from row to row is, and is nothing else."""
    return bool(set(words) & PERIODS) and set(words) <= PERIODS | TIMES | {*CLOCKS}
