"""What a column map says of rows of binary numbers (``[binary]``)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from pyimu.errors import UserError

KINDS = (*(f"{sign}int{bits}" for bits in (8, 16, 32, 64) for sign in ("", "u")),) + (
    "float32",
    "float64",
)
"""What a number may be."""

EXAMPLE = '[binary] with dtype = "float32" and columns = 7, or a list: dtype = ["uint32", "int16"]'


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
