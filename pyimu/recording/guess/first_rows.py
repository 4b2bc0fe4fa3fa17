"""The first rows of a file, by whose numbers its columns are told."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pyimu.errors import UserError
from pyimu.recording.formats.reader import Reader

MOST = 200_000
"""Rows that are looked at."""


class Numbers:
    """The first rows of a file's columns, read where they are asked for."""

    def __init__(self, reader: Reader) -> None:
        self._reader = reader
        self.positions = reader.numeric()

    def of(self, positions: Sequence[int]) -> np.ndarray:
        """Columns (n, k), NaN where there is no number; of integers where it is one such column."""
        pieces, rows = [], 0
        for columns, _ in self._reader.batches(list(positions), positions[0]):
            pieces.append(columns)
            rows += len(columns[0])
            if rows >= MOST:
                break
        if not pieces:
            raise UserError(f"{self._reader.path}: no rows of numbers in it")
        joined = [np.concatenate(column)[:MOST] for column in zip(*pieces, strict=True)]
        return joined[0] if len(joined) == 1 else np.column_stack([c.astype(float) for c in joined])
