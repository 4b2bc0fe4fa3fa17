"""Arrays of numpy: one in a .npy, several by their names in a .npz, which is a ZIP archive.

Nothing that would have to be unpickled is read. The lengths that a header states are checked before
memory is asked for, and no member is unpacked further than to these.
"""

from __future__ import annotations

import math
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.lib import format as npy

from pyimu.errors import UserError
from pyimu.recording.formats.datasets import Column, DatasetReader, columns_of, skipped, stated_rate
from pyimu.recording.formats.streams import reading
from pyimu.recording.naming.words import CLOCKS

MOST = 1 << 29
"""Bytes of the arrays of a .npz that are read, unpacked."""

OBJECTS = (
    "holds objects of Python, which are never unpickled; save arrays of numbers, by "
    "numpy.savez(file, time=..., gyro=..., accel=...)"
)

Shaped = tuple[tuple[int, ...], np.dtype]
"""Shape and type of an array, by its header."""


class NpyReader(DatasetReader):
    """A .npy: the fields of its records are columns by their names, those of a table by numbers."""

    crowded = False

    @classmethod
    def open(cls, path: Path) -> NpyReader:
        """Raises UserError for a file that is none, and for an array that is no table."""
        with reading(path, "NPY"), path.open("rb") as stream:
            shape, dtype = array_header(path, stream)
        columns = columns_of("", shape, _timed(dtype))
        if not columns:
            size = " x ".join(map(str, shape)) or "one"
            raise UserError(
                f"{path}: an array of {size} of {dtype}, and no table: one row a sample, or "
                "records, is read"
            )
        found = cls(path, columns)
        found.header = [
            f"column {k}" if dtype.names is None else _field(column)
            for k, column in enumerate(columns, 1)
        ]
        return found

    @contextmanager
    def opened(self) -> Iterator[Mapping[str, Any]]:
        with reading(self.path, "NPY"):
            array = np.load(self.path, mmap_mode="r", allow_pickle=False)
            yield {"": array.view(_timed(array.dtype))}


def _field(column: Column) -> str:
    """The name of a field of records, and the place in it where it has several numbers."""
    return str(column.index) + ("" if column.part is None else f"[{column.part}]")


class NpzReader(DatasetReader):
    """A .npz; a text for each column of its only table names these."""

    def __init__(
        self,
        path: Path,
        columns: list[Column],
        skipped: Sequence[str],
        rate: float | None,
        names: Sequence[str],
    ) -> None:
        super().__init__(path, columns, skipped, rate)
        self.header = list(names)

    @classmethod
    def open(cls, path: Path) -> NpzReader:
        """Raises UserError for a file that is no ZIP archive with arrays."""
        with reading(path, "NPZ"), zipfile.ZipFile(path) as archive:
            shaped, left = _members(path, archive)
            columns = [c for name, (s, t) in shaped.items() for c in columns_of(name, s, _timed(t))]
            left += [text for n, (s, t) in shaped.items() for text in skipped(n, s, _timed(t))]
            if not columns:
                raise UserError(f"{path}: has no arrays with a row a sample{_left(left)}")
            single = {n: _array(path, archive, n, s) for n, s in shaped.items() if _is_single(s)}
            names = _names(path, archive, shaped, columns)
        units = {name: unit for name, (_, t) in shaped.items() if (unit := _unit(t))}
        named = [f"{c.name} [{units[c.array]}]" if c.array in units else c.name for c in columns]
        return cls(path, columns, left, stated_rate(single), names or named)

    def opened(self) -> AbstractContextManager[Mapping[str, Any]]:
        return _unpacked(self.path)


class _Unpacked(dict[str, np.ndarray]):
    """The arrays of an ``archive``, each unpacked where it is asked for."""

    def __init__(self, path: Path, archive: zipfile.ZipFile) -> None:
        super().__init__()
        self._path, self._archive, self._held = path, archive, 0

    def __missing__(self, name: str) -> np.ndarray:
        with self._archive.open(f"{name}.npy") as stream:
            shaped = array_header(self._path, stream)
        self._held += _bytes(shaped)
        if self._held > MOST:
            raise UserError(
                f"{self._path}: {name} makes it more than {MOST >> 20} MiB unpacked; save it as "
                ".npy, or make a Parquet file of it"
            )
        self[name] = _array(self._path, self._archive, name, shaped)
        return self[name]


@contextmanager
def _unpacked(path: Path) -> Iterator[Mapping[str, np.ndarray]]:
    with reading(path, "NPZ"), zipfile.ZipFile(path) as archive:
        yield _Unpacked(path, archive)


def _members(path: Path, archive: zipfile.ZipFile) -> tuple[dict[str, Shaped], list[str]]:
    """The arrays by their names, and what is none that is read, each with the reason."""
    shaped: dict[str, Shaped] = {}
    left = []
    for member in archive.infolist():
        name = member.filename.removesuffix(".npy")
        if name == member.filename:
            left.append(f"{name} (no array)")
            continue
        with archive.open(member) as stream:
            try:
                shape, dtype = array_header(path, stream)
            except UserError:
                left.append(f"{name} (objects of Python, save arrays)")
                continue
            stated = _bytes((shape, dtype)) + stream.tell()
        if stated != member.file_size:
            raise UserError(
                f"{path}: {name} says that it has {stated:,} bytes, and the archive that it has "
                f"{member.file_size:,}"
            )
        shaped[name] = (shape, dtype)
    return shaped, left


def array_header(path: Path, stream: IO[bytes]) -> Shaped:
    """Shape and type by the header of an array, behind which the ``stream`` stands then.

    Raises UserError for one of objects.
    """
    version = npy.read_magic(stream)
    read = npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0
    shape, _, dtype = read(stream)
    if dtype.hasobject:
        raise UserError(f"{path}: {OBJECTS}")
    if version >= (3, 0) and dtype.names is not None:  # the same header, in UTF-8
        dtype.names = tuple(n.encode("latin-1").decode("utf-8") for n in dtype.names)
    return shape, dtype


def _array(path: Path, archive: zipfile.ZipFile, name: str, shaped: Shaped) -> np.ndarray:
    """The array ``name``, of which no more is unpacked than its header states."""
    if _bytes(shaped) > MOST:
        raise UserError(f"{path}: {name} has more than {MOST >> 20} MiB unpacked")
    with archive.open(f"{name}.npy") as stream:
        array = npy.read_array(stream, allow_pickle=False)
    return array.view(_timed(array.dtype))


def _bytes(shaped: Shaped) -> int:
    shape, dtype = shaped
    return math.prod(shape) * dtype.itemsize


def _is_single(shaped: Shaped) -> bool:
    """Whether an array is a number alone."""
    return math.prod(shaped[0]) == 1 and shaped[1].kind in "iuf"


def _names(
    path: Path, archive: zipfile.ZipFile, shaped: Mapping[str, Shaped], columns: Sequence[Column]
) -> list[str]:
    """The texts of the only array of them, where there is one for each column of the only table."""
    texts = [n for n, (shape, t) in shaped.items() if t.kind in "SU" and shape == (len(columns),)]
    one_table = len({c.array for c in columns}) == 1 and len(columns) > 1
    if len(texts) != 1 or not one_table:
        return []
    found = _array(path, archive, texts[0], shaped[texts[0]])
    names = [n.decode("utf-8", "replace") if isinstance(n, bytes) else str(n) for n in found]
    return names if len(set(names)) == len(names) else []


def _unit(dtype: np.dtype) -> str:
    """The unit in which dates or spans of time count, empty for any other numbers."""
    unit, count = np.datetime_data(dtype) if dtype.kind in "mM" else ("", 1)
    return str(unit) if unit in CLOCKS and count == 1 else ""


def _timed(dtype: np.dtype) -> np.dtype:
    """The type with dates and spans as whole numbers, whose unit the names of fields say."""
    if dtype.names is None:
        return np.dtype(f"{dtype.byteorder}i8") if _unit(dtype) else dtype
    if not any(_unit(dtype[n]) for n in dtype.names):
        return dtype
    fields = [(name, dtype[name], _unit(dtype[name])) for name in dtype.names]
    return np.dtype(
        {
            "names": [f"{name} [{unit}]" if unit else name for name, _, unit in fields],
            "formats": [_timed(kind) for _, kind, _ in fields],
            "offsets": [dtype.fields[name][1] for name in dtype.names],  # type: ignore[index]
            "itemsize": dtype.itemsize,
        }
    )


def _left(left: Sequence[str]) -> str:
    return f"; there is {', '.join(left[:4])}" if left else ""
