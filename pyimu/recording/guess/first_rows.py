"""The first rows of a file, by whose numbers its columns are told."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pyimu.errors import UserError
from pyimu.recording.formats.reader import Reader

MOST = 200_000
"""Rows that are looked at."""


FEW = 16
"""Columns that are read together: to read each group apart is to read the file as many times."""


class Numbers:
    """The first rows of a file's columns, read where they are asked for, and kept."""

    def __init__(self, reader: Reader) -> None:
        self._reader = reader
        self.positions = reader.numeric()
        self._alone: dict[int, np.ndarray] = {}
        self._known: dict[int, np.ndarray] = {}

    def of(self, positions: Sequence[int]) -> np.ndarray:
        """Columns (n, k), NaN where there is no number; of integers where it is one such column."""
        if len(positions) == 1:
            at = positions[0]
            if at not in self._alone:
                self._alone |= self._read([at])
            return self._alone[at]
        if not set(positions) <= self._known.keys():
            self._known |= self._together(positions)
        return np.column_stack([self._known[at] for at in positions])

    def _together(self, positions: Sequence[int]) -> dict[int, np.ndarray]:
        """These columns, and with few in the file all others that are of numbers throughout."""
        if len(self.positions) <= FEW and set(positions) <= set(self.positions):
            try:
                return self._read(self.positions)
            except UserError:  # of a column that nobody asked for
                pass
        return self._read(positions)

    def _read(self, positions: Sequence[int]) -> dict[int, np.ndarray]:
        """The columns (n,); those of several are none of integers."""
        pieces, rows = [], 0
        for columns, _ in self._reader.batches(list(positions), positions[0]):
            pieces.append(columns)
            rows += len(columns[0])
            if rows >= MOST:
                break
        if not pieces:
            raise UserError(f"{self._reader.path}: no rows of numbers in it")
        joined = [np.concatenate(column)[:MOST] for column in zip(*pieces, strict=True)]
        joined = joined if len(joined) == 1 else [c.astype(float) for c in joined]
        return dict(zip(positions, joined, strict=True))


class PerSecond(Numbers):
    """The columns of ``numbers`` times the ``rate`` [Hz]: increments from row to row a second."""

    def __init__(self, numbers: Numbers, rate: float) -> None:
        self._numbers, self.rate = numbers, rate
        self.positions = numbers.positions

    def of(self, positions: Sequence[int]) -> np.ndarray:
        return self._numbers.of(positions) * self.rate
