"""Parquet files, read in pieces of a row group."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import pyarrow as pa
from pyarrow import parquet

from pyimu.errors import UserError
from pyimu.recording.formats.clock_times import Stamps, is_clock
from pyimu.recording.formats.reader import Columns, Reader, as_number
from pyimu.recording.formats.streams import must_be_held, reading
from pyimu.recording.formats.text import to_numpy

BATCH = 1 << 16
"""Rows of a piece."""

BUFFER = 1 << 20
"""Bytes read ahead of each column: without it a row group's columns are held whole, and a file may
be one row group.

For the same reason nothing is "pre-buffered": what that reads ahead is kept to the end of the file.
"""


@dataclass(frozen=True)
class ParquetReader(Reader):
    """A Parquet file; ``header`` are its column names, ``rows`` how many it has."""

    path: Path
    header: list[str]
    rows: int
    clocks: tuple[str, ...] = ()

    @classmethod
    def open(cls, path: Path) -> ParquetReader:
        """Raises UserError for a file that cannot be read."""
        with _reading(path), parquet.ParquetFile(path) as file:
            schema = file.schema_arrow
            clocks = tuple(field.name.strip() for field in schema if is_clock(field.type))
            header = [name.strip() for name in schema.names]
            must_be_held(path, "its table", file.metadata.num_rows)
            return cls(path, header, file.metadata.num_rows, clocks)

    def batches(self, positions: Sequence[int], long: int) -> Iterator[tuple[Columns, float]]:
        """Raises UserError for a column that holds no numbers."""
        with (
            _reading(self.path),
            parquet.ParquetFile(self.path, buffer_size=BUFFER, pre_buffer=False) as file,
        ):
            fields = [file.schema_arrow.field(position) for position in positions]
            for position, field in zip(positions, fields):
                must_be_numbers(self.path, self.header[position], field.type)
            stamps = {f.name: Stamps() for f in fields if is_clock(f.type)}
            done = 0
            for batch in file.iter_batches(
                BATCH, columns=[field.name for field in fields], use_threads=True
            ):
                columns = [
                    stamps[f.name].add(batch.column(f.name))
                    if f.name in stamps
                    else to_numpy(batch.column(f.name))
                    for f in fields
                ]
                done += batch.num_rows
                yield (
                    [as_number(c, p == long) for p, c in zip(positions, columns)],
                    done / self.rows,
                )

    def count(self, long: int) -> int:
        return self.rows


def must_be_numbers(path: Path, name: str, kind: pa.DataType) -> None:
    """Raises UserError for a column ``name`` of another ``kind``; a clock's is one of seconds."""
    numbers = (pa.types.is_floating, pa.types.is_integer, pa.types.is_boolean, is_clock)
    if not any(test(kind) for test in numbers):
        raise UserError(f"{path}: column {name} holds {kind}, expected numbers")


@contextmanager
def _reading(path: Path) -> Iterator[None]:
    with reading(path, "Parquet"):
        yield
