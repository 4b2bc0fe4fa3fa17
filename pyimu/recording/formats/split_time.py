"""A file whose times stand in several columns: whole seconds, and the milliseconds, microseconds or
nanoseconds of each; or hours, minutes and seconds of the day.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.column_map import ForeignMap
from pyimu.recording.columns import own_name
from pyimu.recording.formats.reader import Columns, Reader, ReaderOver
from pyimu.recording.naming.name import named

MILLISECOND, SECOND, MINUTE, HOUR = 10**6, 10**9, 60 * 10**9, 3600 * 10**9
"""ns."""


def _called(words: str) -> re.Pattern[str]:
    """What a column is called by one of the ``words``, alone or behind others."""
    return re.compile(rf"(?:(.*[^A-Za-z]))?(?:{words})", re.I)


_SECONDS = _called("secs?|seconds?|Unix ?Time")
_PARTS = {
    1: _called("(?:n|nano)secs?|nanoseconds?"),
    1000: _called("(?:u|micro)secs?|microseconds?"),
    MILLISECOND: _called("(?:m|milli)secs?|milliseconds?|ms"),
}
"""What the parts of a second are called, by their ns."""

_DAY = {HOUR: _called("hours?|hrs?|hh"), MINUTE: _called("minutes?|mins?|mm")}
"""And what is before the seconds of a day."""

_PIECES = {**_DAY, SECOND: _SECONDS, **_PARTS}

LATEST = 9e9
"""s; to there 64 bits hold the nanoseconds."""

LARGEST = {HOUR: 24.0 * HOUR, SECOND: LATEST * SECOND}
"""ns to which the first piece counts: hours to the end of the day."""


@dataclass(frozen=True)
class SplitTimeReader(ReaderOver):
    """What ``reader`` reads, with one column ``name`` [ns] for its columns at the positions of the
    ``pieces``, each in so many ns, the largest first.
    """

    reader: Reader
    pieces: Mapping[int, int]

    rate = None

    @property
    def parts(self) -> tuple[str, ...]:
        """The names of the columns."""
        return tuple(self.reader.header[k] for k in self.pieces)

    @property
    def name(self) -> str:
        """The name of the column that is made of them."""
        return f"time of {_and(map(_bare, self.parts))} [ns]"

    @property
    def whole(self) -> int:
        """The position of the first of them, where the time stands."""
        return next(iter(self.pieces))

    @property
    def findings(self) -> tuple[Finding, ...]:  # type: ignore[override]
        detail = {"read_as": f"one time of {_and(self.parts)}"}
        return (*self.reader.findings, Finding("layout", "time", 1, detail))

    @property
    def header(self) -> list[str]:  # type: ignore[override]
        return [self.name if k == self.whole else self.reader.header[k] for k in self._theirs]

    @property
    def _theirs(self) -> list[int]:
        """The file's position of each column."""
        return [
            k for k in range(len(self.reader.header)) if k == self.whole or k not in self.pieces
        ]

    def batches(self, positions: Sequence[int], long: int) -> Iterator[tuple[Columns, float]]:
        theirs, own = [self._theirs[p] for p in positions], self._theirs.index(self.whole)
        if own not in positions:
            yield from self.reader.batches(theirs, self._theirs[long])
            return
        at = positions.index(own)
        parts = [k for k in self.pieces if k != self.whole]
        for columns, share in self.reader.batches([*theirs, *parts], self.whole):
            others, rest = columns[: len(theirs)], columns[len(theirs) :]
            time = _joined([others[at], *rest], [*self.pieces.values()])
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
    if found is None or not times <= {found.name, *found.parts}:
        return reader, foreign
    parts = set(found.parts)
    if parts & set(foreign.columns) and times != parts:
        return reader, foreign
    columns = {cell: target for cell, target in foreign.columns.items() if cell not in parts}
    if columns:
        columns[found.name] = "time [ns]"
    return found, replace(foreign, columns=columns)


def _found(reader: Reader) -> SplitTimeReader | None:
    """``reader`` with one column of its several of times, None where it has no such.

    Their names are alike but for the words for the units, and the numbers of the first rows are in
    their ranges. Milliseconds and hours are pieces of a time where no other one is there.
    """
    names = [_bare(cell) for cell in reader.header]
    called = {size: _stems(pattern, names) for size, pattern in _PIECES.items()}
    numeric = set(reader.numeric())
    for stem in called[SECOND]:
        there = {size: at[stem] for size, at in called.items() if stem in at}
        part = [size for size in _PARTS if size in there][:1]
        day = [*_DAY] if set(_DAY) <= there.keys() else []
        pieces = {there[size]: size for size in (*day, SECOND, *part)}
        others = (cell for k, cell in enumerate(reader.header) if k not in pieces)
        sure = not day and part not in ([], [MILLISECOND])
        if len(pieces) > 1 and (sure or not any(named(cell).is_time for cell in others)):
            if set(pieces) <= numeric and _are_pieces(reader, pieces):
                return SplitTimeReader(reader, pieces)
    return None


def _bare(cell: str) -> str:
    """A header's cell without the unit in brackets, and without a sign of comment."""
    return re.sub(r"\s*[\[(].*", "", cell).strip("#% ")


def _and(names: Iterable[str]) -> str:
    """The names as a text: ``hour, minute and second``."""
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last


def _stems(pattern: re.Pattern[str], names: Sequence[str]) -> dict[str, int]:
    """What stands before the word for the unit in the names that have it, and where they are."""
    found = {k: match for k, name in enumerate(names) if (match := pattern.fullmatch(name))}
    return {match[1] or "": k for k, match in found.items()}


def _are_pieces(reader: Reader, pieces: Mapping[int, int]) -> bool:
    """Whether the numbers of the first rows are whole, but for the smallest unit of a day, and none
    is larger than the next unit.
    """
    sizes = list(pieces.values())
    columns, _ = next(reader.batches([*pieces], next(iter(pieces))), ([np.zeros(0)] * 9, 1.0))
    for column, size, larger in zip(columns, sizes, [LARGEST[sizes[0]], *sizes], strict=False):
        numbers = column[np.isfinite(column)].astype(float)
        whole = size == SECOND == sizes[-1] or np.all(numbers == np.rint(numbers))
        most = larger / size + (size == SECOND)  # a leap second
        if not len(numbers) or not whole or not np.all((numbers >= 0) & (numbers < most)):
            return False
    return True


def _joined(columns: Sequence[np.ndarray], sizes: Sequence[int]) -> np.ndarray:
    """ns (n,): of integers, which lose nothing, where no row lacks a piece or has a part of one."""
    if all(np.all((c == np.rint(c)) & (np.abs(c) < LATEST)) for c in columns):
        return sum(c.astype(np.int64) * size for c, size in zip(columns, sizes, strict=True))  # type: ignore[return-value]
    return sum(c * float(size) for c, size in zip(columns, sizes, strict=True))  # type: ignore[return-value]
