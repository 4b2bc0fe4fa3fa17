"""Rows of binary numbers without a head, as boards, simulators and navigation programs write them:
a time and two vectors, such as KF-GINS's increments (readme of its data: "binary, seven columns of
double").

What the numbers of a row are a column map says (``[binary]``); of a time and floating-point numbers
the bytes show it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from pyimu.errors import Finding, UserError
from pyimu.recording.formats.datasets import DatasetReader, columns_of
from pyimu.recording.packing import Packing

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
