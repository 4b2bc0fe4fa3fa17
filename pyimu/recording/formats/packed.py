"""Rows of binary numbers without a head, as boards, simulators and navigation programs write them:
a time and two vectors, such as KF-GINS's increments (readme of its data: "binary, seven columns of
double").

What the numbers of a row are a column map says (``[binary]``); of a time and floating-point numbers
the bytes show it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from pyimu.errors import Finding, UserError
from pyimu.recording.formats.datasets import DatasetReader, columns_of

KINDS = (*(f"{sign}int{bits}" for bits in (8, 16, 32, 64) for sign in ("", "u")),) + (
    "float32",
    "float64",
)
"""What a number may be."""

EXAMPLE = '[binary] with dtype = "float32" and columns = 7, or a list: dtype = ["uint32", "int16"]'

LEAST = 10
"""Rows by which such a file is told."""

SEEN = 100
"""Rows that are looked at for it."""

WIDTHS = range(6, 21)
"""Numbers behind the time of a row that is told."""

FORMS = (("float64", "float64"), ("float32", "float32"), ("float64", "float32")) + (
    ("uint32", "float32"),
    ("uint64", "float32"),
    ("uint64", "float64"),
)
"""What a time and the numbers behind it may be of a row that is told."""

LEAST_SIZE, LARGEST = 1e-12, 1e6
"""No rate, force or increment in any unit is beyond the second, and few but zero are below the
first: bytes of anything else are, soon."""

SPREAD = 10.0
"""Steps of the time are no longer than so many of their middle."""


@dataclass(frozen=True)
class Packing:
    """What the numbers of a row are, each a name of ``KINDS``, and how many bytes are ``before``
    the first row.
    """

    kinds: tuple[str, ...]
    before: int = 0
    big: bool = False

    @property
    def dtype(self) -> np.dtype:
        """That of a row, its columns called as those of a table without names."""
        order = ">" if self.big else "<"
        return np.dtype(
            [
                (f"column {k}", np.dtype(kind).newbyteorder(order))
                for k, kind in enumerate(self.kinds, 1)
            ]
        )

    @property
    def said(self) -> str:
        each = list(dict.fromkeys(self.kinds))
        one = f"{len(self.kinds)} binary numbers"
        return f"rows of {one}, {' and '.join(each)}" + (", big-endian" if self.big else "")


class PackedReader(DatasetReader):
    """Such a file, whose columns have numbers for names."""

    crowded = False
    packing: Packing
    rows: int

    @classmethod
    def open(cls, path: Path, packing: Packing) -> PackedReader:
        """Raises UserError for a file without a whole row."""
        count, rest = divmod(path.stat().st_size - packing.before, packing.dtype.itemsize)
        if count < 1:
            raise UserError(f"{path}: has no row of {packing.dtype.itemsize} bytes")
        found = cls(path, columns_of("", (count,), packing.dtype))
        found.packing, found.rows = packing, count
        found.header = list(packing.dtype.names or ())
        left = f"; {rest} bytes at the end are no whole row" if rest else ""
        found.findings = (Finding("layout", "", 1, {"read_as": packing.said + left}),)
        return found

    @contextmanager
    def opened(self) -> Iterator[Mapping[str, Any]]:
        own = self.packing
        yield {"": np.memmap(self.path, own.dtype, "r", own.before, (self.rows,))}


def packing_in(data: Mapping[str, Any], path: Path) -> Packing | None:
    """What the table ``[binary]`` of a column map says, None where it has none.

    Raises UserError, with the key, for what is none.
    """
    if "binary" not in data:
        return None
    table = data["binary"]
    if not isinstance(table, dict) or not set(table) <= {"dtype", "columns", "skip", "big_endian"}:
        raise UserError(f"{path}: key binary must be such as {EXAMPLE}")
    dtype, columns = table.get("dtype"), table.get("columns")
    kinds = dtype if isinstance(dtype, list) else [dtype] * (columns if _is_count(columns) else 0)
    if dtype is None or not kinds or (columns is not None and columns != len(kinds)):
        raise UserError(f"{path}: key binary must be such as {EXAMPLE}")
    wrong = [kind for kind in kinds if kind not in KINDS]
    if wrong:
        raise UserError(f"{path}: key binary.dtype: {wrong[0]!r}, known are {', '.join(KINDS)}")
    skip, big = table.get("skip", 0), table.get("big_endian", False)
    if not (skip == 0 or _is_count(skip)) or not isinstance(big, bool):
        raise UserError(
            f"{path}: key binary.skip is a number of bytes, binary.big_endian true or false"
        )
    return Packing(tuple(kinds), skip, big)


MOST = 1 << 16
"""Numbers of a row."""


def _is_count(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and 0 < value <= MOST


def packing_of(path: Path) -> Packing | None:
    """What the rows of a file are, where it is nothing but a time that rises evenly and numbers of
    a sensor's size; None of any other.
    """
    size = path.stat().st_size
    head = np.fromfile(path, np.uint8, SEEN * 8 * (max(WIDTHS) + 1)).tobytes()
    for width, (time, value) in product(WIDTHS, FORMS):
        packing = Packing((time, *[value] * width))
        row = packing.dtype.itemsize
        if size % row or size < LEAST * row:
            continue
        rows = np.frombuffer(head[: len(head) // row * row], packing.dtype)[:SEEN]
        names = packing.dtype.names or ()
        if _is_time(rows[names[0]]) and _are_sizes([rows[n] for n in names[1:]]):
            return packing
    return None


def _is_time(numbers: np.ndarray) -> bool:
    """Whether numbers are those of a clock: none is absurd, and they rise in steps of a size."""
    with np.errstate(invalid="ignore", over="ignore"):
        numbers = numbers.astype(float)
        steps = np.diff(numbers)
        sane = np.all((numbers == 0) | ((numbers > LEAST_SIZE) & (numbers < 1e19)))
        return bool(sane and np.all(steps > 0) and steps.max() <= SPREAD * np.median(steps))


def _are_sizes(columns: Sequence[np.ndarray]) -> bool:
    with np.errstate(invalid="ignore"):
        sizes = np.abs(np.stack(columns).astype(float))
        return bool(
            np.all((sizes == 0) | ((sizes > LEAST_SIZE) & (sizes < LARGEST))) and sizes.any()
        )
