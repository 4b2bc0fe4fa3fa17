"""A file whose times stand in two columns: whole seconds, and the nanoseconds or the microseconds
of each.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.column_map import ForeignMap
from pyimu.recording.columns import own_name
from pyimu.recording.formats.reader import Columns, Reader, ReaderOver

_SECONDS = re.compile(r"(.*[^A-Za-z])?secs?|(.*[^A-Za-z])?seconds?|Unix ?Time", re.I)
_PARTS = {
    1: re.compile(r"(.*[^A-Za-z])?(?:n|nano)secs?|(.*[^A-Za-z])?nanoseconds?", re.I),
    1000: re.compile(r"(.*[^A-Za-z])?(?:u|micro)secs?|(.*[^A-Za-z])?microseconds?", re.I),
}
"""What the parts of a second are called, by their ns."""

SECOND = 10**9
"""ns."""

LATEST = 9e9
"""s; to there 64 bits hold the nanoseconds."""


@dataclass(frozen=True)
class SplitTimeReader(ReaderOver):
    """What ``reader`` reads, with one column ``name`` [ns] for its columns at ``whole``, of
    seconds, and at ``part``, of what has ``size`` ns.
    """

    reader: Reader
    whole: int
    part: int
    size: int = 1

    rate = None

    @property
    def parts(self) -> tuple[str, str]:
        """The names of the two columns."""
        return self.reader.header[self.whole], self.reader.header[self.part]

    @property
    def name(self) -> str:
        """The name of the column that is made of them."""
        return f"time of {' and '.join(map(_bare, self.parts))} [ns]"

    @property
    def findings(self) -> tuple[Finding, ...]:  # type: ignore[override]
        detail = {"read_as": f"one time of {' and '.join(self.parts)}"}
        return (*self.reader.findings, Finding("layout", "time", 1, detail))

    @property
    def header(self) -> list[str]:  # type: ignore[override]
        return [self.name if k == self.whole else self.reader.header[k] for k in self._theirs]

    @property
    def _theirs(self) -> list[int]:
        """The file's position of each column."""
        return [k for k in range(len(self.reader.header)) if k != self.part]

    def batches(self, positions: Sequence[int], long: int) -> Iterator[tuple[Columns, float]]:
        theirs, own = [self._theirs[p] for p in positions], self._theirs.index(self.whole)
        if own not in positions:
            yield from self.reader.batches(theirs, self._theirs[long])
            return
        at = positions.index(own)
        for columns, share in self.reader.batches([*theirs, self.part], self.whole):
            *others, part = columns
            time = _joined(others[at], self.size * part)
            others[at] = time if long == own else time.astype(float)
            yield others, share

    def count(self, long: int) -> int | None:
        return self.reader.count(self._theirs[long])

    def numeric(self) -> list[int]:
        theirs = set(self.reader.numeric())
        return [p for p, k in enumerate(self._theirs) if k in theirs]


def with_one_time(reader: Reader, foreign: ForeignMap) -> tuple[Reader, ForeignMap]:
    """``reader`` with one time where it stands in two columns, and the map with that.

    A map may give both the name of the time, or leave both out; one that takes one of them alone,
    another column or a rate is followed as it is.
    """
    times = {cell for cell, target in foreign.columns.items() if own_name(target) == "time"}
    if foreign.rate is not None or any(own_name(cell) == "time" for cell in reader.header):
        return reader, foreign
    found = _found(reader)
    if found is None or not times <= {found.name, *found.parts} or len(times) > 2:
        return reader, foreign
    parts = set(found.parts)
    if parts & set(foreign.columns) and times != parts:
        return reader, foreign
    columns = {cell: target for cell, target in foreign.columns.items() if cell not in parts}
    if columns:
        columns[found.name] = "time [ns]"
    return found, replace(foreign, columns=columns)


def _found(reader: Reader) -> SplitTimeReader | None:
    """``reader`` with one column of its two of times, None where it has no such two.

    Their names are alike but for ``sec`` and ``nsec`` or ``usec``, in one of their spellings, and
    the numbers of its first rows are whole, the parts less than a second.
    """
    names = [_bare(cell) for cell in reader.header]
    for size, parts in _PARTS.items():
        stems = {_stem(parts, name): k for k, name in enumerate(names) if parts.fullmatch(name)}
        for whole, name in enumerate(names):
            part = stems.get(_stem(_SECONDS, name)) if _SECONDS.fullmatch(name) else None
            if part is not None and {whole, part} <= set(reader.numeric()):
                if _are_parts(reader, whole, part, SECOND // size):
                    return SplitTimeReader(reader, whole, part, size)
    return None


def _bare(cell: str) -> str:
    """A header's cell without the unit in brackets, and without a sign of comment."""
    return re.sub(r"\s*[\[(].*", "", cell).strip("#% ")


def _stem(pattern: re.Pattern[str], name: str) -> str:
    """What stands before the word for the unit."""
    found = pattern.fullmatch(name)
    return next((text for text in found.groups() if text), "") if found else ""


def _are_parts(reader: Reader, whole: int, part: int, second: int) -> bool:
    """Whether the numbers are whole seconds and parts of one, of which it has ``second``, in the
    first rows.
    """
    columns, _ = next(reader.batches([whole, part], whole), ([np.zeros(0)] * 2, 1.0))
    seconds, rest = (column[np.isfinite(column)].astype(float) for column in columns)
    return (
        len(rest) > 0
        and bool(np.all(seconds == np.rint(seconds)) and np.all(rest == np.rint(rest)))
        and bool(np.all((rest >= 0) & (rest < second)))
    )


def _joined(seconds: np.ndarray, rest: np.ndarray) -> np.ndarray:
    """ns (n,): of integers, which lose nothing, where no row lacks one of the two."""
    if np.all(np.abs(seconds) < LATEST) and np.all(np.abs(rest) < SECOND):
        return seconds.astype(np.int64) * SECOND + rest.astype(np.int64)
    return seconds * float(SECOND) + rest
