"""A file whose time of day stands as one number, ``120102.34`` for 12:01:02.34, as receivers of
satellites and boards with a clock write it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.column_map import ForeignMap
from pyimu.recording.formats.ends import end_of_samples
from pyimu.recording.formats.reader import Columns, Reader, ReaderOver
from pyimu.recording.naming.name import named

NAMES = {"utc", "gmt", "hhmmss", "clock"}
"""Words of such a column beside those for times."""

LARGEST = 240000
"""What is larger is no time of day."""

LEAST, FEW = 0.5, 10
"""Steps by which a minute begins, where it is told by that."""


@dataclass(frozen=True)
class DigitTimeReader(ReaderOver):
    """What ``reader`` reads, with the times of day in its column ``at`` in s."""

    reader: Reader
    at: int

    @property
    def header(self) -> list[str]:  # type: ignore[override]
        cells = list(self.reader.header)
        cells[self.at] = f"time of day of {cells[self.at]} [s]"
        return cells

    @property
    def findings(self) -> tuple[Finding, ...]:  # type: ignore[override]
        said = f"{self.reader.header[self.at]} as hours, minutes and seconds in one number"
        return (*self.reader.findings, Finding("layout", "time", 1, {"read_as": said}))

    def batches(self, positions: Sequence[int], long: int) -> Iterator[tuple[Columns, float]]:
        for columns, share in self.reader.batches(positions, long):
            if self.at in positions:
                k = positions.index(self.at)
                columns[k] = _seconds(columns[k].astype(float))
            yield columns, share

    def count(self, long: int) -> int | None:
        return self.reader.count(long)

    def numeric(self) -> list[int]:
        return self.reader.numeric()


def with_time_of_digits(reader: Reader, foreign: ForeignMap) -> tuple[Reader, ForeignMap]:
    """``reader`` with the time of day in s that stands in the digits of a column which no map
    names.
    """
    numeric = set(reader.numeric())
    for at, cell in enumerate(reader.header):
        name = named(cell)
        called = name.is_time or bool(set(name.words) & NAMES)
        if called and name.unit is None and at in numeric and cell not in foreign.columns:
            columns, _ = next(reader.batches([at], at), ([np.zeros(0)], 1.0))
            numbers = columns[0][: end_of_samples(columns[0])].astype(float)
            if _are_digits(numbers[np.isfinite(numbers)]):
                return DigitTimeReader(reader, at), foreign
    return reader, foreign


def _seconds(digits: np.ndarray) -> np.ndarray:
    """Seconds (n,) of the day of ``hhmmss``."""
    whole = np.floor(digits / 100)
    return 3600 * np.floor(whole / 100) + 60 * (whole % 100) + digits - 100 * whole


def _are_digits(numbers: np.ndarray) -> bool:
    """Whether numbers are such times: none has 60 s or 60 minutes, and where a minute begins they
    jump by 40 more.
    """
    steps = np.diff(numbers)
    if not len(steps) or np.any(steps < 0) or numbers[0] < 0 or numbers[-1] >= LARGEST:
        return False
    if np.any(numbers % 100 >= 60) or np.any(np.floor(numbers / 100) % 100 >= 60):
        return False
    begins = np.diff(np.floor(numbers / 100)) > 0
    late, usual = np.diff(_seconds(numbers)), steps[~begins & (steps > 0)]
    if not begins.any() or len(usual) < FEW:  # steps of 100 are ms
        return False
    return bool(LEAST < np.median(late[begins]) / np.median(usual) < FEW)
