"""Files that hold named arrays (HDF5, MAT): which arrays are columns, and their names.

An array is called by its path, ``imu/time``; a column of an array of several by its number from 0,
``imu/gyro[2]``, and a field of an array of records by its name, ``imu/table[gx]``, and of a field
of several by its number, ``imu/table[gyro][2]``. Samples lie along the longer side of an array.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from pyimu.errors import UserError
from pyimu.recording.formats.reader import Columns, Reader, as_number

BATCH = 1 << 16
"""Rows of a piece."""


RATES = ("samplingrate", "samplerate", "samplingfrequency", "fs")
"""Names of single values that say the sample rate in Hz, without underscores, in small letters."""


def stated_rate(values: Mapping[str, Any]) -> float | None:
    """Hz; the one sample rate among the single ``values`` of a file, None where there is none."""
    found = set()
    for name, value in values.items():
        last = name.rpartition("/")[2].replace("_", "").casefold()
        if last in RATES and np.size(value) == 1 and np.asarray(value).dtype.kind in "iuf":
            found.add(float(np.asarray(value).reshape(())))
    hertz = found.pop() if len(found) == 1 else None
    return hertz if hertz is not None and 1e-3 <= hertz <= 1e6 else None


@dataclass(frozen=True)
class Column:
    """A column in a file of arrays.

    It is part of ``array``, with samples along ``axis``, at ``index`` of the other axis; or it is a
    field of records, or the field's ``part``.
    """

    array: str
    length: int
    axis: int = 0
    index: int | str | None = None
    part: int | None = None

    @property
    def name(self) -> str:
        return self.array + "".join(f"[{k}]" for k in (self.index, self.part) if k is not None)

    def of(self, piece: np.ndarray) -> np.ndarray:
        """The column (m,) in a piece of its array."""
        if isinstance(self.index, str):
            return piece[self.index] if self.part is None else piece[self.index][:, self.part]
        if piece.ndim == 1:
            return piece
        return piece[:, self.index or 0] if self.axis == 0 else piece[self.index or 0]


def columns_of(name: str, shape: tuple[int, ...], dtype: np.dtype) -> list[Column]:
    """The columns of an array, none where it is not of numbers or has more than two axes."""
    if dtype.names and len(shape) == 1:
        return [
            Column(name, shape[0], index=field, part=part)
            for field in dtype.names
            for part in _parts(dtype[field])
        ]
    if dtype.kind not in "iufb" or not 1 <= len(shape) <= 2 or 0 in shape:
        return []
    if len(shape) == 1:
        return [Column(name, shape[0])]
    axis = int(shape[1] > shape[0])
    width = shape[1 - axis]
    return [Column(name, shape[axis], axis, None if width == 1 else k) for k in range(width)]


def _parts(field: np.dtype) -> list[int | None]:
    """The columns in a field of records.

    Their numbers where the field has several, None for its only one.
    """
    if field.base.kind not in "iufb" or len(field.shape) > 1:
        return []
    return list(range(field.shape[0])) if field.shape else [None]


def skipped(name: str, shape: tuple[int, ...], dtype: np.dtype) -> list[str]:
    """What part of an array is in no column, each with the reason.

    A single value is not listed.
    """
    if math.prod(shape) < 2:
        return []
    if dtype.names and len(shape) == 1:
        return [
            f"{name}[{field}] ({_reason(dtype[field].base, 1 + len(dtype[field].shape))})"
            for field in dtype.names
            if not _parts(dtype[field])
        ]
    return [] if columns_of(name, shape, dtype) else [f"{name} ({_reason(dtype, len(shape))})"]


def _reason(dtype: np.dtype, axes: int) -> str:
    what = {"O": "references or texts", "S": "texts", "U": "texts", "V": "records"}.get(dtype.kind)
    return what or (f"{axes} axes" if dtype.kind in "iufb" else f"of type {dtype}")


class DatasetReader(Reader):
    """A file of named arrays; its ``header`` is the list of all columns in them."""

    crowded = True

    def __init__(
        self,
        path: Path,
        columns: list[Column],
        skipped: Sequence[str] = (),
        rate: float | None = None,
    ) -> None:
        self.path = path
        self.rate = rate
        self.skipped = tuple(skipped)
        self.columns = columns
        self.header = [column.name for column in columns]

    @abstractmethod
    def opened(self) -> AbstractContextManager[Mapping[str, Any]]:
        """The arrays by name, to be sliced."""

    def batches(self, positions: Sequence[int], long: int) -> Iterator[tuple[Columns, float]]:
        """Raises UserError for a column that is not as long as the time."""
        wanted, rows = [self.columns[position] for position in positions], self.count(long)
        for column in wanted:
            if column.length != rows:
                raise UserError(
                    f"{self.path}: {column.name} has {column.length} samples and "
                    f"{self.header[long]} has {rows}: "
                    "columns of another rate cannot be read together, leave one out of the map"
                )
        sides = {column.array: column.axis for column in wanted}
        with self.opened() as arrays:
            for start in range(0, rows, BATCH):
                stop = min(start + BATCH, rows)
                pieces = {
                    name: np.asarray(arrays[name][(slice(None),) * axis + (slice(start, stop),)])
                    for name, axis in sides.items()
                }
                columns = [c.of(pieces[c.array]) for c in wanted]
                yield (
                    [as_number(c, position == long) for c, position in zip(columns, positions)],
                    stop / rows,
                )

    def count(self, long: int) -> int:
        return self.columns[long].length

    def place(self, index: int) -> str:
        return f"sample {index}"
