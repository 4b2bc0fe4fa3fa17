"""Reader and writer of recordings by the suffix of a file."""

from __future__ import annotations

import gzip
from collections.abc import Mapping
from itertools import islice
from pathlib import Path
from types import MappingProxyType
from typing import Any, BinaryIO

import numpy as np
import pyarrow as pa
from pyarrow import csv as pacsv
from pyarrow import parquet

from pyimu.errors import UserError
from pyimu.files import check_regular, exists, shortened, whole
from pyimu.recording.formats.bag import BagReader
from pyimu.recording.formats.dataflash import DataflashReader, is_dataflash
from pyimu.recording.formats.hdf5 import Hdf5Reader
from pyimu.recording.formats.json_rows import JsonReader, is_json
from pyimu.recording.formats.layout import MESSAGES
from pyimu.recording.formats.lines import sign_of
from pyimu.recording.formats.mat import MatReader
from pyimu.recording.formats.numpy_arrays import NpyReader, NpzReader
from pyimu.recording.formats.one_unit import unit_column
from pyimu.recording.formats.oxts import OxtsReader, oxts_in
from pyimu.recording.formats.packed import PackedReader, packing_of
from pyimu.recording.formats.parquet import ParquetReader
from pyimu.recording.formats.reader import Reader
from pyimu.recording.formats.text import CsvReader
from pyimu.recording.formats.timed_array import TimedArrayReader, is_timed_array
from pyimu.recording.formats.told import NO_TOPICS
from pyimu.recording.formats.ulog import UlogReader
from pyimu.recording.packing import EXAMPLE, Packing

TEXTS = (
    ".csv",
    ".txt",
    ".tsv",
    ".dat",
    ".asc",
    ".gcsv",
    ".sensors",
    ".lvm",
    ".vbo",
    ".imu",
    ".nav",
)
"""Suffixes of tables in text, each also with .gz behind it."""

READERS: Mapping[str, Any] = MappingProxyType(
    {suffix + packed: CsvReader for suffix in TEXTS for packed in ("", ".gz")}
    | {
        ".parquet": ParquetReader,
        ".mat": MatReader,
        ".h5": Hdf5Reader,
        ".hdf5": Hdf5Reader,
        ".npy": NpyReader,
        ".npz": NpzReader,
        ".bag": BagReader,
        ".db3": BagReader,
        ".mcap": BagReader,
        ".json": JsonReader,
        ".jsonl": JsonReader,
        ".ndjson": JsonReader,
        ".ulg": UlogReader,
        ".bin": DataflashReader,
        ".log": DataflashReader,
    }
)
"""The reader of each suffix; a folder with a ``metadata.yaml`` is a bag of ROS 2."""

OTHERS: Mapping[str, str] = MappingProxyType(
    dict.fromkeys((".xlsx", ".xls", ".xlsm", ".ods"), "save its sheet as CSV")
    | dict.fromkeys((".zip", ".7z", ".rar", ".tar", ".tgz", ".tar.gz"), "unpack it")
    | dict.fromkeys((".bz2", ".xz", ".zst", ".gz"), "unpack it")
    | dict.fromkeys((".pkl", ".pickle", ".feather"), "make a CSV or Parquet of it")
    | dict.fromkeys((".yaml", ".yml"), MESSAGES)
)
"""What is to be done with files of other suffixes; with any else see ``open_reader``."""

MOST_NAMED = 6
"""Files of a folder that a message names."""

MOST_SEEN = 1000
"""Files of the folders in a folder that are looked at for it."""

WITH_TOPICS = (BagReader, UlogReader, DataflashReader)
"""Readers of files that hold more than one stream of samples."""


def open_reader(
    path: Path, topics: Mapping[str, str] | None = None, packing: Packing | None = None
) -> Reader:
    """Open the file ``path`` with the reader of its suffix.

    ``topics`` names a bag's topics, by the keys "imu" and "temperature"; ``packing`` says what the
    rows are of a file of binary numbers, whatever it is called.

    Raises UserError for a file that is missing or none of these, and for topics of a file that has
    none.
    """
    folder = exists(path) and path.is_dir()
    if folder and oxts_in(path) == path and not topics:
        return OxtsReader.open(path)
    if folder and is_timed_array(path) and not topics:
        return TimedArrayReader.open(path)
    if folder and not (path / "metadata.yaml").is_file():
        raise UserError(f"{path}: a folder, give the files in it{_tables_in(path)}")
    if not folder:
        check_regular(path)
        if packing is not None:
            return PackedReader.open(path, packing)
        if not path.name.lower().endswith(tuple(READERS)) and (sign := sign_of(path)):
            raise UserError(f"{path}: {sign}")
    reader = BagReader if folder else _by_suffix(path, READERS, "rename text to .txt")
    if reader is DataflashReader and path.suffix.lower() == ".log" and not is_dataflash(path):
        reader = CsvReader
    if reader is DataflashReader and not is_dataflash(path):
        return _packed(path)
    if reader is CsvReader and is_json(path):
        reader = JsonReader
    if reader in WITH_TOPICS:
        return reader.open(path, topics or {})
    if topics and reader is CsvReader and set(topics) == {"imu"}:
        return _of_topic(path, topics["imu"])
    if topics and reader is JsonReader and set(topics) == {"imu"}:
        return JsonReader.open(path, topics["imu"])
    if topics:
        raise UserError(NO_TOPICS.format(path))
    return reader.open(path)


def _packed(path: Path) -> Reader:
    """A ``.bin`` that is no dataflash log. Raises UserError where nothing tells what it is."""
    told = packing_of(path)
    if told is None:
        if sign := sign_of(path):
            raise UserError(f"{path}: {sign}")
        raise UserError(
            f"{path}: no dataflash log, and its bytes are no rows of a time and floating-point "
            f"numbers; of other rows a column map says what they are: {EXAMPLE}"
        )
    return PackedReader.open(path, told)


def _of_topic(path: Path, topic: str) -> Reader:
    """A table with the rows of one of its sensors, which a word names, or a column numbers."""
    whole = CsvReader.open(path) if topic.isdigit() else None
    return CsvReader.open(path, topic) if whole is None or unit_column(whole) is None else whole


def _tables_in(folder: Path) -> str:
    """The names of the files in a folder that a reader may open, for a message."""
    ends = tuple(READERS)
    there = sorted(p.name for p in folder.iterdir() if p.name.lower().endswith(ends))
    if not there:
        inner = (p for p in folder.glob("*/*") if p.name.lower().endswith(ends))
        there = sorted(str(p.relative_to(folder)) for p in islice(inner, MOST_SEEN))
    if not there:
        return ""
    return f" that belong to one log: {', '.join(there[:MOST_NAMED])}" + (
        f" and {len(there) - MOST_NAMED} more" if len(there) > MOST_NAMED else ""
    )


def stem(path: Path) -> str:
    """The file's name without what says its format."""
    suffix = max((s for s in READERS if path.name.lower().endswith(s)), key=len, default="")
    return path.name[: len(path.name) - len(suffix)]


def write_table(path: Path, columns: Mapping[str, np.ndarray]) -> None:
    """Write ``columns`` (name to (n,) array) to ``path``.

    Numbers have the fewest digits that read back the same.

    The file appears whole or not at all. Raises UserError for an unknown suffix or a folder that
    cannot be written.
    """
    writer = _by_suffix(
        path, {".csv": _write_csv, ".csv.gz": _write_gzip, ".parquet": _write_parquet}
    )
    table = pa.table([_column(values) for values in columns.values()], names=list(columns))
    with whole(path) as unfinished, unfinished.open("wb") as stream:
        writer(stream, table)


def _column(values: np.ndarray) -> pa.Array:
    """Numbers or truths (n,) as a column, what is NaN missing.

    By their bytes: ``pa.array`` loads pandas where there is one, a tenth of a second, to ask it.
    """
    if values.dtype == bool:
        kind, own = pa.bool_(), np.packbits(values, bitorder="little")
    else:
        kind, own = pa.from_numpy_dtype(values.dtype), np.ascontiguousarray(values)
    known = np.packbits(~np.isnan(values), bitorder="little")
    return pa.Array.from_buffers(kind, len(values), [pa.py_buffer(known), pa.py_buffer(own)])


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


def _by_suffix(path: Path, choices: Mapping[str, Any], hint: str = "") -> Any:
    for suffix, choice in choices.items():
        if path.name.lower().endswith(suffix):
            return choice
    if hint:
        does = next((d for s, d in OTHERS.items() if path.name.lower().endswith(s)), None)
        hint = f"; {does or hint}"
    suffixes = ", ".join(suffix for suffix in choices if suffix.count(".") < 2 or "csv" in suffix)
    raise UserError(f"{shortened(path)}: a recording's name must end in {suffixes}{hint}")
