"""Logs in JSON: a list of objects, one for each sample, as nuScenes' CAN bus and many apps have,
or one on each line; or an object of lists, one for each column.

A member that is a list of numbers makes the columns ``rotation_rate[0]`` and so on, one that is an
object in turn ``accel.x``.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from pyimu.errors import UserError
from pyimu.recording.formats.streams import StreamReader, reading

LARGEST = 1 << 28
"""Bytes: all of it is taken apart at once, and takes a dozen times as much then."""

MOST = 2000
"""Names of columns, each of which is as long as the log."""

DEEPEST = 4
"""Objects and lists within each other, at most."""


class JsonReader:
    """Opens logs in JSON; see the module."""

    @classmethod
    def open(cls, path: Path) -> StreamReader:
        """Raises UserError for a file that is no list of samples, or too large."""
        size = path.stat().st_size
        if size > LARGEST:
            raise UserError(
                f"{path}: JSON of {size >> 20} MiB is more than the {LARGEST >> 20} that are taken "
                "apart at once; make a CSV or Parquet file of it"
            )
        with reading(path, "JSON"):
            rows = _rows(_parsed(path.read_bytes()))
            cells = [dict(_flat("", row, 0)) for row in rows]
            names = dict.fromkeys(name for row in cells for name in row)
            if not names:
                raise UserError(
                    f"{path}: is no list of samples, each an object with numbers such as "
                    '{"t": 0.01, "gyro": [0, 0, 0.1], "accel": [0, 0, 9.8]}'
                )
            if len(names) > MOST:
                raise UserError(
                    f"{path}: has {len(names):,} different names, and a log {MOST:,} at most"
                )
            return StreamReader(path, {name: _column(name, cells) for name in names}, body=None)


def _parsed(text: bytes) -> Any:
    """What is in a file; of one with an object on each line a list of them."""
    first = text.lstrip().partition(b"\n")[0].rstrip()
    if first[:1] == b"{" and first[-1:] == b"}" and len(first) < len(text.strip()):
        return [json.loads(line) for line in text.splitlines() if line.strip()]
    return json.loads(text)


def _rows(data: Any) -> list[dict[str, Any]]:
    """The list of objects that a file is, or whose only list it has, or one made of its lists of
    one length; empty of any other.
    """
    if isinstance(data, dict):
        columns = {name: v for name, v in data.items() if isinstance(v, list) and v}
        if len(columns) > 1 and len({len(values) for values in columns.values()}) == 1:
            return [dict(zip(columns, row, strict=True)) for row in zip(*columns.values())]
        lists = [value for value in data.values() if isinstance(value, list) and value]
        data = lists[0] if len(lists) == 1 else None
    return data if isinstance(data, list) and all(isinstance(r, dict) for r in data) else []


def _flat(name: str, value: Any, depth: int) -> Iterator[tuple[str, int | float]]:
    """The numbers in a sample by their names."""
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        yield name, value
    elif depth < DEEPEST and isinstance(value, dict):
        for key, member in value.items():
            yield from _flat(f"{name}.{key}" if name else str(key), member, depth + 1)
    elif depth < DEEPEST and isinstance(value, list):
        for k, member in enumerate(value):
            yield from _flat(f"{name}[{k}]", member, depth + 1)


def _column(name: str, cells: list[dict[str, int | float]]) -> np.ndarray:
    """A column (n,), NaN where a sample has no such number; of integers where all are."""
    values = [row.get(name) for row in cells]
    if all(isinstance(v, int) and abs(v) < 1 << 62 for v in values):
        return np.array(values, dtype=np.int64)
    return np.array([np.nan if v is None else float(v) for v in values])
