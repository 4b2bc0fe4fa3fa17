"""CSV files, plain and gzipped, read in pieces, and with the place of what is wrong."""

from __future__ import annotations

import csv
import gzip
import re
import zlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

import numpy as np
import pyarrow as pa
from pyarrow import csv as pacsv

from pyimu.errors import UserError
from pyimu.recording.formats.reader import Columns, Reader

MISSING = ("", "NaN", "nan", "NAN", "NA", "null", "-nan")
"""Cells of a CSV file that hold no value."""


@dataclass(frozen=True)
class CsvReader(Reader):
    """A CSV file, plain or gzipped; ``header`` are the cells of its first row."""

    path: Path
    header: list[str]

    @classmethod
    def open(cls, path: Path) -> CsvReader:
        """Open a CSV file.

        Raises UserError for a file that cannot be read, or whose separator is not a comma.
        """
        first = next(_csv_rows(path), (1, []))[1]
        if len(first) == 1 and re.search(r"[;\t]", first[0]):
            raise UserError(f"{path}: row 1: columns must be separated by commas")
        return cls(path, [cell.strip() for cell in first])

    def batches(self, positions: Sequence[int], long: int) -> Iterator[tuple[Columns, float]]:
        """``long`` is int64 where its numbers need it.

        Raises UserError, with row and column, for a cell that is no number and for a row of another
        length.
        """
        names = [str(position) for position in range(len(self.header))]
        kept = [names[position] for position in positions]
        kinds = {name: pa.float64() for name in kept} | (
            {names[long]: pa.int64()} if self._is_long(long) else {}
        )
        if not self._has_rows():
            return
        done = 0
        try:
            with pa.OSFile(str(self.path)) as raw:
                size = max(raw.size(), 1)
                for batch in pacsv.open_csv(
                    pa.CompressedInputStream(raw, "gzip") if _is_gzip(self.path) else raw,
                    read_options=pacsv.ReadOptions(column_names=names, skip_rows=1),
                    convert_options=pacsv.ConvertOptions(
                        column_types=kinds, include_columns=kept, null_values=list(MISSING)
                    ),
                ):
                    done += batch.num_rows
                    yield (
                        [to_numpy(column) for column in batch.columns],
                        1.0 if raw.closed else raw.tell() / size,
                    )
        except (pa.ArrowInvalid, OSError) as error:
            self._explain(positions, done)
            raise UserError(
                f"{self.path}: cannot be read as CSV ({str(error).splitlines()[0]})"
            ) from None

    def count(self, long: int) -> None:
        return None

    def place(self, index: int) -> str:
        """Row of the sample ``index``, as a spreadsheet counts it; blank rows hold no sample."""
        rows = (row for k, (row, _) in enumerate(_csv_rows(self.path)) if k == index + 1)
        return f"row {next(rows, index + 2)}"

    def _first_row(self) -> list[str] | None:
        rows = _csv_rows(self.path)
        next(rows, None)
        return next(rows, (2, None))[1]

    def _has_rows(self) -> bool:
        return self._first_row() is not None

    def _is_long(self, position: int) -> bool:
        """Whether a column starts with an integer that float64 would round (Unix time in ns)."""
        cells = self._first_row() or []
        return (
            len(cells) > position
            and re.fullmatch(r"\d{16,19}", cells[position].strip()) is not None
        )

    def _explain(self, positions: Sequence[int], good: int) -> None:
        """Raise UserError for the first wrong cell or row after ``good`` rows.

        A cell is wrong where it is not a number, a row where it is too long or too short.
        """
        for row, cells in islice(_csv_rows(self.path), 1 + good, None):
            if len(cells) != len(self.header):
                raise UserError(
                    f"{self.path}: row {row}: {len(cells)} cells, expected {len(self.header)} as "
                    "in the header"
                )
            for position in positions:
                if not _is_number(cells[position]):
                    place = f"{self.path}: row {row}, column {self.header[position]}"
                    raise UserError(f"{place}: '{cells[position]}' is not a number")


def to_numpy(column: pa.Array) -> np.ndarray:
    """A column of numbers as (n,), NaN where it is null."""
    return (column if column.null_count == 0 else column.cast(pa.float64())).to_numpy(
        zero_copy_only=False
    )


def _is_gzip(path: Path) -> bool:
    return path.name.lower().endswith(".gz")


def _csv_rows(path: Path) -> Iterator[tuple[int, list[str]]]:
    """(row, cells) of each row that is not blank; the header is row 1."""
    try:
        with (gzip.open if _is_gzip(path) else open)(
            path, "rt", encoding="utf-8-sig", newline=""
        ) as stream:
            reader = csv.reader(stream)
            yield from ((reader.line_num, cells) for cells in reader if cells)
    except UnicodeDecodeError:
        raise UserError(f"{path}: is not text in UTF-8") from None
    except (OSError, EOFError, zlib.error, csv.Error) as error:
        raise UserError(
            f"{path}: cannot be read ({getattr(error, 'strerror', None) or error})"
        ) from None


def _is_number(cell: str) -> bool:
    if cell.strip() in MISSING:
        return True
    try:
        float(cell)
    except ValueError:
        return False
    return "_" not in cell
