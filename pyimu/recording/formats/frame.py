"""Data frames, as pandas has them: named columns in memory."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pyarrow as pa

from pyimu.errors import UserError
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
    """A data frame; ``header`` are its column names."""

    frame: Any
    header: list[str]
    path: Path = Path(NAME)

    @classmethod
    def of(cls, frame: Any) -> FrameReader:
        return cls(frame, [str(name).strip() for name in frame.columns])

    def batches(self, positions: Sequence[int], long: int) -> Iterator[tuple[Columns, float]]:
        """All rows at once. Raises UserError for a column that holds no numbers."""
        names = list(self.frame.columns)
        columns = [self._numbers(names[p]) for p in positions]
        yield [as_number(c, p == long) for p, c in zip(positions, columns, strict=True)], 1.0

    def _numbers(self, name: Any) -> Any:
        try:
            column = pa.array(self.frame[name], from_pandas=True)
        except pa.ArrowException:
            raise UserError(f"{NAME}: column {name} holds more than numbers") from None
        must_be_numbers(self.path, str(name), column.type)
        return to_numpy(column)

    def count(self, long: int) -> int:
        return len(self.frame)

    def place(self, index: int) -> str:
        return f"row {index} from 0"
