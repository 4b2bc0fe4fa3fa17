"""Data frames, as pandas has them: named columns in memory."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pyarrow as pa

from pyimu.errors import UserError
from pyimu.recording.columns import own_name
from pyimu.recording.formats.clock_times import Stamps, is_clock
from pyimu.recording.formats.parquet import must_be_numbers
from pyimu.recording.formats.reader import Columns, Reader, as_number
from pyimu.recording.formats.text import to_numpy

NAME = "frame"
"""What messages call it, and the name of its recording."""


def is_frame(source: Any) -> bool:
    """Whether ``source`` is a data frame: it has named columns, and a column by its name."""
    return hasattr(source, "columns") and hasattr(source, "__getitem__")


@dataclass(frozen=True)
class FrameReader(Reader):
    """A data frame; ``header`` are its column names, ``columns`` what it holds by them.

    The index is the time of a frame without such a column, where it is named so or counts dates or
    spans of time.
    """

    header: list[str]
    columns: Sequence[Any]
    rows: int
    clocks: tuple[str, ...] = ()
    path: Path = Path(NAME)
    in_memory = True

    @classmethod
    def of(cls, frame: Any) -> FrameReader:
        names = list(frame.columns)
        header, columns = [str(name).strip() for name in names], [frame[name] for name in names]
        index = getattr(frame, "index", None)
        if index is not None and not any(own_name(cell) == "time" for cell in header):
            name = _time_of(index)
            if name is not None:
                header, columns = [name, *header], [index, *columns]
        clocks = tuple(n for n, c in zip(header, columns, strict=True) if _is_clock(c))
        return cls(header, columns, len(frame), clocks)

    def batches(self, positions: Sequence[int], long: int) -> Iterator[tuple[Columns, float]]:
        """All rows at once. Raises UserError for a column that holds no numbers."""
        columns = [self._numbers(p) for p in positions]
        yield [as_number(c, p == long) for p, c in zip(positions, columns, strict=True)], 1.0

    def _numbers(self, position: int) -> Any:
        name = self.header[position]
        try:
            column = pa.array(self.columns[position], from_pandas=True)
        except pa.ArrowException:
            raise UserError(f"{NAME}: column {name} holds more than numbers") from None
        must_be_numbers(self.path, name, column.type)
        return Stamps().add(column) if is_clock(column.type) else to_numpy(column)

    def count(self, long: int) -> int:
        return self.rows

    def place(self, index: int) -> str:
        return f"row {index} from 0"


def _is_clock(column: Any) -> bool:
    """Whether a column or an index holds dates or spans of time."""
    try:
        return is_clock(pa.array(column[:0], from_pandas=True).type)
    except (pa.ArrowException, TypeError):
        return False


def _time_of(index: Any) -> str | None:
    """The name of an index as a column of times, None where it is none."""
    name = "" if getattr(index, "name", None) is None else str(index.name).strip()
    if own_name(name) == "time":
        return name
    return "time" if _is_clock(index) else None
