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
from pyimu.recording.formats.nested import Leaf, is_number, leaves
from pyimu.recording.formats.reader import Columns, Reader, as_number
from pyimu.recording.formats.streams import must_be_held, reading
from pyimu.recording.formats.text import to_numpy

BATCH = 1 << 16
"""Rows of a piece."""

FIRST = 64
"""Rows at the start that tell how long the lists of a column are."""

BUFFER = 1 << 20
"""Bytes read ahead of each column: without it a row group's columns are held whole, and a file may
be one row group.

For the same reason nothing is "pre-buffered": what that reads ahead is kept to the end of the file.
"""


@dataclass(frozen=True)
class ParquetReader(Reader):
    """A Parquet file of ``rows``; ``leaves`` are its columns, each number of a row one."""

    path: Path
    leaves: tuple[Leaf, ...]
    rows: int

    @property
    def header(self) -> list[str]:  # type: ignore[override]
        return [leaf.name for leaf in self.leaves]

    @property
    def clocks(self) -> tuple[str, ...]:  # type: ignore[override]
        return tuple(leaf.name for leaf in self.leaves if is_clock(leaf.kind))

    @classmethod
    def open(cls, path: Path) -> ParquetReader:
        """Raises UserError for a file that cannot be read."""
        with _reading(path), parquet.ParquetFile(path) as file:
            schema, rows = file.schema_arrow, file.metadata.num_rows
            must_be_held(path, "its table", rows)
            nested = [f.name for f in schema if pa.types.is_nested(f.type)]
            some = next(file.iter_batches(FIRST, columns=nested), None) if nested else None
            found = [
                leaf
                for f in schema
                for leaf in (
                    [Leaf(f.name.strip(), f.name, f.type)]
                    if some is None or f.name not in nested
                    else leaves(f.name, f.type, some.column(f.name))
                )
            ]
            return cls(path, tuple(found), rows)

    def numeric(self) -> list[int]:
        return [k for k, leaf in enumerate(self.leaves) if leaf.is_number]

    def batches(self, positions: Sequence[int], long: int) -> Iterator[tuple[Columns, float]]:
        """Raises UserError for a column that holds no numbers."""
        with (
            _reading(self.path),
            parquet.ParquetFile(self.path, buffer_size=BUFFER, pre_buffer=False) as file,
        ):
            asked = [self.leaves[position] for position in positions]
            for leaf in asked:
                must_be_numbers(self.path, leaf.name, leaf.kind)
            stamps = {leaf.name: Stamps() for leaf in asked if is_clock(leaf.kind)}
            tops, done = list(dict.fromkeys(leaf.top for leaf in asked)), 0
            for batch in file.iter_batches(BATCH, columns=tops, use_threads=True):
                cells = [leaf.of(batch.column(leaf.top)) for leaf in asked]
                columns = [
                    stamps[leaf.name].add(c) if leaf.name in stamps else to_numpy(c)
                    for leaf, c in zip(asked, cells, strict=True)
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
    if not is_number(kind) and not is_clock(kind):
        raise UserError(f"{path}: column {name} holds {kind}, expected numbers")


@contextmanager
def _reading(path: Path) -> Iterator[None]:
    with reading(path, "Parquet"):
        yield
