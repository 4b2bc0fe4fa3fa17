"""Logs in JSON: a list of objects, one for each sample, as nuScenes' CAN bus and many apps have,
or one on each line; or an object of lists, one for each column. ``json_tables`` has those whose
names stand apart from their rows.

A member that is a list of numbers makes the columns ``rotation_rate[0]`` and so on, one that is an
object in turn ``accel.x``.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa

from pyimu.errors import Finding, UserError
from pyimu.recording.formats.cells import MISSING, is_number
from pyimu.recording.formats.clock_times import ClockTimes, is_clock_time
from pyimu.recording.formats.json_kinds import OfKind, called, of_kind
from pyimu.recording.formats.json_tables import table_in
from pyimu.recording.formats.lines import LONGEST
from pyimu.recording.formats.streams import StreamReader, reading
from pyimu.recording.formats.told import NO_TOPICS

LARGEST = 1 << 28
"""Bytes: all of it is taken apart at once, and takes a dozen times as much then."""

MOST = 2000
"""Names of columns, each of which is as long as the log."""

DEEPEST = 4
"""Objects and lists within each other, at most."""


class JsonReader:
    """Opens logs in JSON; see the module."""

    @classmethod
    def open(cls, path: Path, topic: str = "") -> StreamReader:
        """Open a log, of samples of several sensors those of ``topic``.

        Raises UserError for a file that is no list of samples, or too large, and for a topic that
        is not there.
        """
        size = path.stat().st_size
        if size > LARGEST:
            raise UserError(
                f"{path}: JSON of {size >> 20} MiB is more than the {LARGEST >> 20} that are taken "
                "apart at once; make a CSV or Parquet file of it"
            )
        with reading(path, "JSON"):
            data = _parsed(path.read_bytes())
            table = table_in(data, path)
            rows = _rows(data) if table is None else table.rows
            kind = of_kind(rows, topic)
            if topic and kind is None:
                raise UserError(NO_TOPICS.format(path))
            kind = kind or OfKind("", (), rows)
            cells = [
                {called(kind.word, name): v for name, v in _flat("", row, 0)} for row in kind.rows
            ]
            names = dict.fromkeys(name for row in cells for name in row)
            if len(names) > MOST:
                raise UserError(
                    f"{path}: has {len(names):,} different names, and a log {MOST:,} at most"
                )
            columns = {name: _column(name, cells) for name in names}
            known = {name: column[0] for name, column in columns.items() if column is not None}
            if not known:
                raise UserError(
                    f"{path}: is no list of samples, each an object with numbers such as "
                    '{"t": 0.01, "gyro": [0, 0, 0.1], "accel": [0, 0, 9.8]}'
                )
            clocks = tuple(name for name, c in columns.items() if c is not None and c[1])
            rate = None if table is None else table.rate
            return StreamReader(
                path,
                known,
                _said(kind),
                body=None,
                rate=rate,
                clocks=clocks,
                word=kind.word,
                words=kind.words,
            )


def _said(kind: OfKind) -> tuple[Finding, ...]:
    detail = {"read_as": f"the samples of {kind.word}"}
    return (Finding("layout", "", 1, detail),) if kind.word else ()


def is_json(path: Path) -> bool:
    """Whether a text, whatever it is called, is a list of objects, or has one on its first line
    that has further ones or lists of them in it; flat ones are lines with labels.
    """
    try:
        with path.open("rb") as file:
            first = file.readline(LONGEST).strip()
        if re.match(rb"\[\s*(\{|$)", first):
            return True
        data = json.loads(first) if first[:1] == b"{" and first[-1:] == b"}" else None
    except (OSError, ValueError, RecursionError):
        return False
    return isinstance(data, dict) and any(isinstance(v, dict) for v in data.values())


def _parsed(text: bytes) -> Any:
    """What is in a file; of one with an object on each line a list of them."""
    first = text.lstrip().partition(b"\n")[0].rstrip()
    if first[:1] == b"{" and first[-1:] == b"}" and len(first) < len(text.strip()):
        return [json.loads(line) for line in text.splitlines() if line.strip()]
    return json.loads(text)


def _rows(data: Any) -> list[dict[str, Any]]:
    """The list of objects that a file is, or whose only list it has, or one made of its lists of
    one length, or of those of its only object; empty of any other.
    """
    if isinstance(data, dict):
        columns = {name: v for name, v in data.items() if isinstance(v, list) and v}
        if len(columns) > 1 and len({len(values) for values in columns.values()}) == 1:
            return [dict(zip(columns, row, strict=True)) for row in zip(*columns.values())]
        inner = [value for value in data.values() if isinstance(value, dict)]
        if not columns and len(inner) == 1:
            return _rows(inner[0])
        lists = [value for value in data.values() if isinstance(value, list) and value]
        data = lists[0] if len(lists) == 1 else None
    return data if isinstance(data, list) and all(isinstance(r, dict) for r in data) else []


Cell = int | float | str


def _flat(name: str, value: Any, depth: int) -> Iterator[tuple[str, Cell]]:
    """The numbers and texts in a sample by their names."""
    if isinstance(value, (int, float, str)) and not isinstance(value, bool):
        yield name, value
    elif depth < DEEPEST and isinstance(value, dict):
        for key, member in value.items():
            yield from _flat(f"{name}.{key}" if name else str(key), member, depth + 1)
    elif depth < DEEPEST and isinstance(value, list):
        for k, member in enumerate(value):
            yield from _flat(f"{name}[{k}]", member, depth + 1)


def _column(name: str, cells: list[dict[str, Cell]]) -> tuple[np.ndarray, bool] | None:
    """A column (n,), NaN where a sample has no such number, of integers where all are; and whether
    its texts were dates or times of day. None of one with other texts.
    """
    values = [row.get(name) for row in cells]
    texts = [value for value in values if isinstance(value, str) and value.strip()]
    if (
        texts
        and all(map(is_clock_time, texts))
        and len(texts) == sum(v is not None for v in values)
    ):
        return ClockTimes().add(pa.array([v or None for v in values], pa.string())), True
    if texts and not all(map(is_number, texts)):
        return None
    numbers = [_number(value) for value in values]
    if all(isinstance(v, int) and abs(v) < 1 << 62 for v in numbers):
        return np.array(numbers, dtype=np.int64), False
    return np.array([np.nan if v is None else float(v) for v in numbers]), False


def _number(value: Cell | None) -> int | float | None:
    """The number in a cell, which some programs write as a text."""
    if not isinstance(value, str):
        return value
    text = value.strip()
    if not text or text in MISSING:
        return None
    return int(text) if text.lstrip("+-").isdigit() and len(text) < 20 else float(text)
