"""Tables whose rows are not all of one sensor: those of several devices, which a column names
(``WT901(eb:33:2e)``), those of several people one behind the other, and those in which gyro and
accelerometer each have rows of their own, with empty cells beside them.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from pyimu.recording.formats.cells import MISSING, is_number
from pyimu.recording.formats.lines import is_comment, share
from pyimu.recording.naming.name import named
from pyimu.recording.naming.triads import Triad, surest, triads

SEPARATORS = (",", ";", "\t", "|")

DEVICES = {"device", "sensor", "imu", "node", "unit", "instance", "address", "addr", "mac"} | {
    "serial",
    "body",
    "limb",
    "placement",
    "position",
    "location",
}
"""Words in the name of a column whose cells say which device a row is of, beside ``name`` and
``id``."""

PEOPLE = {"subject", "subj", "participant", "person", "user", "patient", "volunteer", "athlete"} | {
    "player",
    "rider",
    "driver",
    "wearer",
}
"""Words in the name of a column whose cells say whom a row is of, beside ``NUMBERED``: people come
one behind the other, the second perhaps far behind the first rows."""

NUMBERED = {"id", "no", "nr", "num", "number", "name", "code", "index"}

MOST_DEVICES = 16
"""Devices whose rows stand in one table, at most."""

EVEN = 0.5
"""Share of its part of the rows that each device has at least."""

LEAST = 6
"""Numbers in a row of a table without names that may be of a device: two vectors."""

MOST = 0.75
"""Share of the rows from which on a gyro is that of all of them, with some cells missing."""

SEEN = 0.1
"""Share of the rows that each sensor has at least."""

KINDS = ("gyro", "accel", "mag")
"""The sensors whose rows may stand apart; the log's times are those of the first."""


OF_OTHERS = "of other rows"
"""How the name of a column ends that has no cells in the rows that are read."""


@dataclass(frozen=True)
class Mixed:
    """The rows that are read: of ``word``, where ``others`` have theirs; ``keeps`` says whether a
    line is one of them, or none of any. The columns at ``empty`` are those of the others.
    """

    word: str
    others: tuple[str, ...]
    keeps: Callable[[str], bool]
    said: str
    empty: tuple[int, ...] = ()
    joined: bool = False
    """Whether the rows of the others are further columns of the same log."""


def mixed_rows(lines: Sequence[str], topic: str = "") -> Mixed | None:
    """Which rows of a table with these first ``lines`` are read, of ``topic`` where one is named;
    None where all are.
    """
    rows = [line.rstrip("\r\n") for line in lines if line.strip() and not is_comment(line)]
    for separator in SEPARATORS:
        cells = [_cells(line, separator) for line in rows]
        width = Counter(map(len, cells)).most_common(1)[0][0] if cells else 0
        names = next((k for k, row in enumerate(cells) if len(row) == width), 0)
        below = [row for row in cells[names + 1 :] if len(row) == width]
        if width < 4 or not below:
            continue
        if any(map(_is_filled, cells[names])):
            unnamed = _of_devices(range(width), width, [cells[names], *below], separator, topic)
            if unnamed is not None and sum(map(_is_filled, cells[names])) >= LEAST:
                return unnamed
            continue
        found = triads(cells[names])
        vectors = {kind: triad for kind in KINDS if (triad := surest(found, kind)[0]) is not None}
        person = next((k for k, cell in enumerate(cells[names]) if _names_people(cell)), None)
        if person is not None and {"gyro", "accel"} & set(vectors):
            return _of_person(person, cells[names][person], below, separator, topic)
        if {"gyro", "accel"} <= set(vectors):
            at = [k for k, cell in enumerate(cells[names]) if _names_devices(cell)]
            devices = _of_devices(at, width, below, separator, topic)
            return _apart(vectors, below, separator, topic) or devices
    return None


def _cells(line: str, separator: str) -> list[str]:
    return [cell.strip().strip('"') for cell in line.split(separator)]


def _is_filled(cell: str) -> bool:
    return cell not in MISSING and (is_number(cell) or is_number(cell, ","))


def _of_devices(
    columns: Iterable[int],
    width: int,
    rows: Sequence[Sequence[str]],
    separator: str,
    topic: str,
) -> Mixed | None:
    """The rows of the first device, or that of the name ``topic``, by one of the ``columns``."""
    for at in columns:
        words = [row[at] for row in rows]
        if any(_is_filled(w) or w in MISSING for w in words) or not _come_in_turn(words):
            continue
        kinds = list(dict.fromkeys(words))
        if topic and topic not in kinds:
            continue
        own = topic or kinds[0]
        others = tuple(word for word in kinds if word != own)
        choice = " or ".join(f'"{word}"' for word in others)
        said = f"the rows {own} alone, [topics] imu = {choice} in a column map reads others"
        return Mixed(own, others, _keeps_device(at, others, width, separator), said)
    return None


def _names_devices(cell: str) -> bool:
    """Whether a column is called as one is that names devices: ``Device name``, ``sensor_id``."""
    name = named(cell)
    known = set(name.words) & DEVICES
    return bool(known) and set(name.words) <= DEVICES | {"name", "id"} and not name.axis


def _names_people(cell: str) -> bool:
    """Whether a column is called as one is that says whom a row is of: ``subject_id``, ``User``."""
    name = named(cell)
    known = set(name.words) & PEOPLE
    return bool(known) and set(name.words) <= PEOPLE | NUMBERED and not name.axis


def _of_person(
    at: int, name: str, rows: Sequence[Sequence[str]], separator: str, topic: str
) -> Mixed | None:
    """The rows of the first person, or that of the name ``topic``; None where rows of each come in
    turn, or name nobody.
    """
    words = [row[at] for row in rows]
    changes = sum(a != b for a, b in zip(words, words[1:], strict=False))
    if any(w in MISSING for w in words) or len(words) < LEAST or changes > len(words) // 4:
        return None
    own, width = topic or words[0], len(rows[0])

    def keeps(line: str) -> bool:
        row = _cells(line, separator)
        return len(row) != width or row[at] in (own, name)

    said = f"the rows of {name} {own} alone, [topics] imu in a column map names another"
    return Mixed(own, (), keeps, said)


def _come_in_turn(words: Sequence[str]) -> bool:
    """Whether the rows of few devices alternate; what is a state stays, and comes once."""
    counts = Counter(words)
    changes = sum(a != b for a, b in zip(words, words[1:], strict=False))
    even = min(counts.values(), default=0) * len(counts) > EVEN * len(words)
    return 1 < len(counts) <= MOST_DEVICES and even and changes >= len(counts)


def _keeps_device(
    at: int, others: Sequence[str], width: int, separator: str
) -> Callable[[str], bool]:
    away = set(others)

    def keeps(line: str) -> bool:
        row = _cells(line, separator)
        return len(row) != width or row[at] not in away

    return keeps


def _apart(
    vectors: dict[str, Triad], rows: Sequence[Sequence[str]], separator: str, topic: str
) -> Mixed | None:
    """The rows of the gyro, or those of the sensor ``topic``, where each has its own."""
    filled = {kind: [_has(row, triad.positions) for row in rows] for kind, triad in vectors.items()}
    kinds = [kind for kind in KINDS if kind in filled and share(filled[kind]) > SEEN]
    if not {"gyro", "accel"} <= set(kinds):
        return None
    if share(filled["gyro"]) > MOST and not _are_of_others(filled["gyro"], rows):
        return None
    if topic and topic not in kinds:
        return None
    own = topic or kinds[0]
    there = [row for row, has in zip(rows, filled[own], strict=True) if has]
    empty = {k for k in range(len(there[0])) if all(row[k] in MISSING for row in there)}
    # A magnetometer that has cells in the gyro's rows, and in no more, is beside it.
    same = {kind for kind in kinds if filled[kind] == filled[own]}
    others = tuple(kind for kind in kinds if kind not in same)
    empty |= {k for kind in others for k in vectors[kind].positions}
    at, width = vectors[own].positions, len(rows[0])

    def keeps(line: str) -> bool:
        row = _cells(line, separator)
        return len(row) != width or _has(row, at)

    said = f"the rows with cells of the {own}"
    return Mixed(own, others, keeps, said, tuple(empty), joined=True)


def _are_of_others(filled: Sequence[bool], rows: Sequence[Sequence[str]]) -> bool:
    """Whether the rows that are not ``filled`` have a column of their own, as those of another
    message of a bag have.
    """
    own = [row for row, has in zip(rows, filled, strict=True) if has]
    rest = [row for row, has in zip(rows, filled, strict=True) if not has]
    return len(rest) > 1 and any(
        all(row[k] not in MISSING for row in rest) and all(row[k] in MISSING for row in own)
        for k in range(len(rows[0]))
    )


def _has(row: Sequence[str], at: Iterable[int]) -> bool:
    return all(row[k] not in MISSING for k in at)
