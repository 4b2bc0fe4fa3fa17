"""Rows of seven binary numbers without a head, as navigation programs keep a unit's increments.

KF-GINS and the data sets around it (readme of its data: "binary, seven columns of double"): a time,
three angles and three velocities, little-endian.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.formats.datasets import DatasetReader, columns_of

WIDTH = 7
"""Numbers of a row: a time and two vectors."""

ROW = 8 * WIDTH
"""Bytes of a row."""

LEAST = 10
"""Rows by which such a file is told."""

LARGEST = 1e6
"""No rate, force or increment in any unit is beyond it: bytes of anything else are, soon."""


class DoublesReader(DatasetReader):
    """Such a file, whose columns have numbers for names."""

    crowded = False

    @classmethod
    def open(cls, path: Path) -> DoublesReader:
        shape = (path.stat().st_size // ROW, WIDTH)
        found = cls(path, columns_of("", shape, np.dtype("<f8")))
        found.header = [f"column {k}" for k in range(1, WIDTH + 1)]
        said = f"rows of {WIDTH} binary numbers of 8 bytes"
        found.findings = (Finding("layout", "", 1, {"read_as": said}),)
        return found

    @contextmanager
    def opened(self) -> Iterator[Mapping[str, Any]]:
        yield {"": np.memmap(self.path, "<f8", mode="r").reshape(-1, WIDTH)}


def is_doubles(path: Path) -> bool:
    """Whether a file holds such rows: the first number of each rises in all that are looked at."""
    size = path.stat().st_size
    if size % ROW or size < LEAST * ROW:
        return False
    rows = np.fromfile(path, "<f8", min(size, 100 * ROW) // 8).reshape(-1, WIDTH)
    with np.errstate(invalid="ignore", over="ignore"):
        small = np.all(np.abs(rows[:, 1:]) < LARGEST) and np.all(np.abs(rows[:, 0]) < 1e10)
        return bool(small and np.all(np.diff(rows[:, 0]) > 0) and np.any(rows[:, 1:] != 0))
