"""Tables in which a word in each row says which sensor's sample it is: ``12,GYR,0.1,0.2,0.3``."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import pairwise
from math import hypot
from statistics import median

from pyimu.recording.formats.cells import is_number
from pyimu.recording.formats.clock_times import is_clock_time
from pyimu.recording.formats.marked import Marked
from pyimu.recording.naming.name import Name, named
from pyimu.recording.naming.triads import triads
from pyimu.units import STANDARD_GRAVITY

FIRST_COLUMNS = 3
"""The word stands in one of so many, with the time."""

LEAST = 0.5
"""Of the last half of the first lines so many must be rows with such a word."""

KINDS = ("gyro", "accel", "mag")
"""What a word may be for; the rows of the first that is there are the log's own."""

ANDROID = {"1": "accelerometer", "2": "magnetometer", "4": "gyroscope"}
"""Android's numbers of sensors (Sensor.TYPE_ACCELEROMETER and so on), in a column that is called
so: ``type``, ``sensor_type``."""

TYPES = {str(k) for k in range(1, 40)}
"""All of them, about."""

NEAR_GRAVITY = 0.2
"""By how much a force in a hand may be off gravity in its size, in the middle."""


def rows_by_word(lines: Sequence[str], topic: str = "") -> Marked | None:
    """How the rows of one sensor are read: of ``topic``, else of the gyro where there is one."""
    for separator in (",", ";", "\t"):
        cells = [[c.strip() for c in line.rstrip("\r\n").split(separator)] for line in lines]
        whole = triads(cells[0]) if cells else []
        if {"gyro", "accel"} <= {t.group for t in whole if t.score > 0}:
            continue  # each row has a sample of both, and the word is of something else
        for at in range(FIRST_COLUMNS):
            words = _words(cells, at)
            if not words or topic and topic not in words:
                continue
            own = topic or words[0]
            widths = Counter(len(c) for c in cells if len(c) > at and c[at] == own)
            width = widths.most_common()[0][0]

            def rewrite(line: str, at: int = at, own: str = own, by: str = separator) -> str | None:
                row = line.split(by)
                return ",".join(row) if len(row) > at and row[at].strip() == own else None

            names = _names(cells, at, own, width)
            rows = [c for c in cells if len(c) == width and c[at] == own]
            clocks = tuple(k for k in range(width) if all(is_clock_time(row[k]) for row in rows))
            others = tuple(word for word in words if word != own)
            return Marked(names, rewrite, f"the rows {own}", clocks, word=own, words=others)
    return None


def _words(cells: Sequence[Sequence[str]], at: int) -> list[str]:
    """The words in the column ``at`` that name a sensor each, a gyro's first; empty where these are
    no such rows.
    """
    tail = cells[len(cells) // 2 :]
    head = "".join(cells[0][at : at + 1]) if cells else ""
    numbered = {"type", "sensor"} & set(re.findall("[a-z]+", head.casefold()))
    numbered = numbered or _are_numbers_of_android(tail, at)
    said = Counter(
        row[at]
        for row in tail
        if len(row) > at + 3
        and (not is_number(row[at]) or numbered and row[at] in ANDROID)
        and sum(map(is_number, row)) >= 3
    )
    if len(said) < 2 or sum(said.values()) < LEAST * len(tail):
        return []
    return sensors_among(said)


def sensors_among(words: Iterable[str]) -> list[str]:
    """The words that name a sensor each, a gyro's first; empty where none surely does."""
    names = {word: named(ANDROID.get(word, word)) for word in words}
    sure = {w: {kind: _sureness(name, kind) for kind in KINDS} for w, name in names.items()}
    found = [max(sure, key=lambda word: sure[word][kind]) for kind in KINDS]
    found = [w for w, kind in zip(found, KINDS, strict=True) if sure[w][kind] > 0]
    certain = any(sure[w][kind] > 1 for w in found for kind in ("gyro", "accel"))
    return found if certain and len(set(found)) == len(found) else []


def _are_numbers_of_android(rows: Sequence[Sequence[str]], at: int) -> bool:
    """Whether a column of a table without names has Android's numbers of sensors: they alternate,
    and what the accelerometer's rows end with is of gravity's size.
    """
    whole = [row for row in rows if len(row) == len(rows[0]) > at + 3 and all(map(is_number, row))]
    words = [row[at] for row in whole]
    changes = sum(a != b for a, b in pairwise(words))
    if not {"1", "4"} <= set(words) or not set(words) <= TYPES or changes < len(words) / 5:
        return False
    last = ([float(cell) for cell in row[at + 1 : at + 4]] for row in whole if row[at] == "1")
    return abs(median(hypot(*force) for force in last) / STANDARD_GRAVITY - 1) < NEAR_GRAVITY


def _sureness(name: Name, kind: str) -> float:
    """How surely a word is for a sensor's raw samples: one of a few words before one of many, and
    the whole acceleration before what Sensor Logger calls one, which is without gravity.
    """
    linear = {"linear", "lin", "gravity"} & set(name.words)
    whole = {"total"} & set(name.words)
    return 0 if linear else name.of(kind) - 0.01 * len(name.words) * (not whole)


def _names(cells: Sequence[Sequence[str]], at: int, own: str, width: int) -> tuple[str, ...]:
    """The names of the columns, in which an axis alone is that of the sensor."""
    head = cells[0]
    if len(head) == width and not any(map(is_number, head)) and head[at] != own:
        alone = [not named(name).words or name.casefold().startswith("value") for name in head]
        own = ANDROID.get(own, own)
        return tuple(f"{own} {n}" if a else n for n, a in zip(head, alone, strict=True))
    names = [f"column {k + 1}" for k in range(width)]
    if width == 5:
        others = [k for k in range(width) if k != at][1:]
        for k, axis in zip(others, "xyz", strict=True):
            names[k] = f"{ANDROID.get(own, own)} {axis}"
    return tuple(names)
