"""Tables of numbers in files: CSV, gzipped CSV and Parquet, read fast, and with the place of what is wrong."""

from __future__ import annotations

import csv
import gzip
import os
import re
import zlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
import pyarrow as pa
from pyarrow import csv as pacsv
from pyarrow import parquet

from pyimu.errors import UserError

MISSING = ("", "NaN", "nan", "NAN", "NA", "null", "-nan")
"""Cells of a CSV file that hold no value."""


@dataclass(frozen=True)
class CsvTable:
    """A CSV file, plain or gzipped; ``header`` are the cells of its first row."""

    path: Path
    header: list[str]

    @classmethod
    def open(cls, path: Path) -> CsvTable:
        """Raises UserError for a file that cannot be read, or is separated by something else than commas."""
        first = next(_csv_rows(path), (1, []))[1]
        if len(first) == 1 and re.search(r"[;\t]", first[0]):
            raise UserError(f"{path}: row 1: columns must be separated by commas")
        return cls(path, [cell.strip() for cell in first])

    def read(self, positions: Sequence[int], long: int) -> list[np.ndarray]:
        """The columns at ``positions`` (float64, NaN where empty), ``long`` as int64 where its numbers need it.

        Raises UserError, with row and column, for a cell that is no number and for a row of another length.
        """
        names = [str(position) for position in range(len(self.header))]
        kept = [names[position] for position in positions]
        kinds = {name: pa.float64() for name in kept} | ({names[long]: pa.int64()} if self._is_long(long) else {})
        try:
            table = pacsv.read_csv(
                self.path, read_options=pacsv.ReadOptions(column_names=names, skip_rows=1),
                convert_options=pacsv.ConvertOptions(column_types=kinds, include_columns=kept, null_values=list(MISSING)))
        except (pa.ArrowInvalid, OSError) as error:
            self._explain(positions)
            raise UserError(f"{self.path}: cannot be read as CSV ({str(error).splitlines()[0]})") from None
        return [_to_numpy(column) for column in table.columns]

    def row(self, index: int) -> int:
        """Row, as a spreadsheet counts it, of the sample ``index``; rows that are blank hold no sample."""
        return next((row for k, (row, _) in enumerate(_csv_rows(self.path)) if k == index + 1), index + 2)

    def _is_long(self, position: int) -> bool:
        """Whether the first number of a column is an integer that float64 would round (Unix time in ns)."""
        rows = _csv_rows(self.path)
        next(rows, None)
        cells = next(rows, (2, []))[1]
        return len(cells) > position and re.fullmatch(r"\d{16,19}", cells[position].strip()) is not None

    def _explain(self, positions: Sequence[int]) -> None:
        """Raises UserError for the first cell that is no number, or the first row that is too long or too short."""
        rows = _csv_rows(self.path)
        next(rows, None)
        for row, cells in rows:
            if len(cells) != len(self.header):
                raise UserError(f"{self.path}: row {row}: {len(cells)} cells, expected {len(self.header)} as in the header")
            for position in positions:
                if not _is_number(cells[position]):
                    place = f"{self.path}: row {row}, column {self.header[position]}"
                    raise UserError(f"{place}: '{cells[position]}' is not a number")


@dataclass(frozen=True)
class ParquetTable:
    """A Parquet file; ``header`` are its column names."""

    path: Path
    header: list[str]

    @classmethod
    def open(cls, path: Path) -> ParquetTable:
        """Raises UserError for a file that cannot be read."""
        return cls(path, [name.strip() for name in _guarded(path, lambda: parquet.read_schema(path)).names])

    def read(self, positions: Sequence[int], long: int) -> list[np.ndarray]:
        """The columns at ``positions`` (float64, NaN where null; ``long`` may stay an integer).

        Raises UserError for a column that holds no numbers.
        """
        table = _guarded(self.path, lambda: parquet.read_table(self.path))
        columns = []
        for position in positions:
            column = table.column(position)
            if not any(test(column.type) for test in (pa.types.is_floating, pa.types.is_integer, pa.types.is_boolean)):
                raise UserError(f"{self.path}: column {self.header[position]} holds {column.type}, expected numbers")
            values = _to_numpy(column)
            columns.append(values if position == long else values.astype(float))
        return columns

    def row(self, index: int) -> int:
        """Row of the sample ``index``, counted as in a CSV file."""
        return index + 2


def open_table(path: Path) -> CsvTable | ParquetTable:
    """The table in ``path``, by its suffix.  Raises UserError for a file that is missing or none of these."""
    if not path.is_file():
        raise UserError(f"{path}: {'a folder, give the files in it' if path.is_dir() else 'no such file'}")
    return _by_suffix(path, {".csv": CsvTable, ".csv.gz": CsvTable, ".parquet": ParquetTable}).open(path)


def write_table(path: Path, columns: Mapping[str, np.ndarray]) -> None:
    """Writes ``columns`` (name to (n,) array) to ``path``, in the shortest digits that read back the same.

    The file appears whole or not at all.  Raises UserError for an unknown suffix or a folder that cannot be written.
    """
    writer = _by_suffix(path, {".csv": _write_csv, ".csv.gz": _write_gzip, ".parquet": _write_parquet})
    table = pa.table([pa.array(column, from_pandas=True) for column in columns.values()], names=list(columns))
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        with temporary.open("wb") as stream:
            writer(stream, table)
        os.replace(temporary, path)
    except OSError as error:
        raise UserError(f"{path}: cannot be written ({error.strerror or error})") from None
    finally:
        temporary.unlink(missing_ok=True)


def _write_csv(stream: BinaryIO, table: pa.Table) -> None:
    stream.write((",".join(table.column_names) + "\n").encode())
    body = pa.BufferOutputStream()
    pacsv.write_csv(table, body, pacsv.WriteOptions(include_header=False))
    stream.write(body.getvalue())


def _write_gzip(stream: BinaryIO, table: pa.Table) -> None:
    # without name and time, so that equal tables give equal files
    with gzip.GzipFile(filename="", mode="wb", fileobj=stream, compresslevel=6, mtime=0) as packed:
        _write_csv(packed, table)


def _write_parquet(stream: BinaryIO, table: pa.Table) -> None:
    parquet.write_table(table, stream)


def _by_suffix(path: Path, choices: Mapping[str, Any]) -> Any:
    for suffix, choice in choices.items():
        if path.name.lower().endswith(suffix):
            return choice
    raise UserError(f"{path}: a recording's name must end in {', '.join(choices)}")


def _guarded(path: Path, action: Callable[[], Any]) -> Any:
    try:
        return action()
    except (pa.ArrowInvalid, OSError) as error:
        raise UserError(f"{path}: cannot be read as Parquet ({str(error).splitlines()[0]})") from None


def _csv_rows(path: Path) -> Iterator[tuple[int, list[str]]]:
    """(row, cells) of each row that is not blank; the header is row 1."""
    try:
        with (gzip.open if path.name.lower().endswith(".gz") else open)(path, "rt", encoding="utf-8-sig", newline="") as stream:
            reader = csv.reader(stream)
            yield from ((reader.line_num, cells) for cells in reader if cells)
    except UnicodeDecodeError:
        raise UserError(f"{path}: is not text in UTF-8") from None
    except (OSError, EOFError, zlib.error, csv.Error) as error:
        raise UserError(f"{path}: cannot be read ({getattr(error, 'strerror', None) or error})") from None


def _to_numpy(column: pa.ChunkedArray) -> np.ndarray:
    return column.to_numpy() if column.null_count == 0 else column.cast(pa.float64()).to_numpy()


def _is_number(cell: str) -> bool:
    if cell.strip() in MISSING:
        return True
    try:
        float(cell)
    except ValueError:
        return False
    return "_" not in cell
