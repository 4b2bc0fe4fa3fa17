"""A line of labels and numbers: ``ax: 0.12 ay: 0.98``, ``acc: 0.1, 0.2, 9.8 gyro: 1, 2, 3``."""

from __future__ import annotations

import re
from collections.abc import Sequence

from pyimu.recording.spelling import unit_of

Pairs = list[tuple[str, str, str | None]]
"""Label, number as it stands there, and unit behind it; of a vector one for each of its numbers."""

STAMP = "time of day"
"""The column of what Arduino's serial monitor writes before a line."""

FRONT = "column 1"
"""The column of a number before the first label, as of a time: ``10: ax=0.12 ay=0.98``."""

IN_FRONT = (STAMP, FRONT)

NUMBER = r"(?>[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|[-+]?(?i:nan|inf))"
"""What a number looks like."""

LEAST = 3
"""Numbers that are a vector without brackets: two may be one with a decimal comma."""

_BEHIND = r"(?=$|[\s,;|})\]A-Za-z°µ])"
_WORDS = r"(?P<label>[A-Za-z_][\w./()\[\]°]*(?: (?![\[({][.\d])[\w./()\[\]°]+)*)"
_QUOTE = "[\"']?"
_LABEL = re.compile(rf"[\s,;|]*{_QUOTE}{_WORDS}{_QUOTE}\s*[:=]\s*(?P<open>[\[({{]\s*)?")
_REMARK = r"(?: ?\([A-Za-z°µ%][^()]*\))"
_BARE = re.compile(
    rf"[\s,;|]*{_QUOTE}(?P<label>[A-Za-z_]\w*\.?(?: [A-Za-z_]\w*)*{_REMARK}?){_QUOTE}"
    r"\s*(?P<open>[\[({])\s*"
)
_HEADING = re.compile(r"[\s,;|]*(?P<head>[A-Za-z_]\w*)\s*:\s*(?=[xyzXYZ]\s*[:=])")
_VALUE = re.compile(rf"(?P<value>{NUMBER}){_BEHIND}")
_NEXT = re.compile(rf"(?P<by>\s*[,;|]\s*|\s+)(?P<value>{NUMBER}){_BEHIND}(?!\s*[:=])")
_CLOSE = re.compile(r"\s*[\])}]")
_WORD = re.compile(r"\s*([A-Za-z°µ%][^\s,;|:=}]*)(?=$|[\s,;|}])")
_STAMP = re.compile(r"\s*(\d{1,2}:\d{2}:\d{2}[.,]?\d*)\s*->\s*")
_FRONT = re.compile(r"\s*(\d+\.?\d*)(?:\s*[:;,]\s*|\s+)(?=[A-Za-z_\"'])")
_ALL_AXES = re.compile(r"[ _.]?\(?[xX],?[yY],?[zZ]\)?$")


def labels_of(pairs: Pairs) -> tuple[str, ...]:
    return tuple(label for label, _, _ in pairs)


def pairs_of(line: str) -> Pairs | None:
    """The labels and numbers of a line, None of one that has anything else."""
    read = _read(line)
    return None if read is None else read[0]


def row_pattern(line: str) -> re.Pattern[str] | None:
    """What lines match that have the labels of this one: its groups are their numbers."""
    read = _read(line)
    return None if read is None else re.compile(rf"\s*\{{*{''.join(read[1])}[\s,;}}]*")


def _read(line: str) -> tuple[Pairs, list[str]] | None:
    """The pairs of a line, and the pattern of each of its parts; None of one that has none."""
    found: Pairs = []
    parts: list[str] = []
    line = line.strip().strip("{}").rstrip(",; ")
    at = 0
    for name, pattern in ((STAMP, _STAMP), (FRONT, _FRONT)):
        match = pattern.match(line, at)
        if match is not None:
            found.append((name, match[1], None))
            parts.append(pattern.pattern)
            at = match.end()
    while at < len(line):
        taken = _item(line, at)
        if taken is None:
            return None
        at, pairs, part = taken
        found += pairs
        parts.append(part)
    return (found, parts) if found else None


def _item(line: str, at: int) -> tuple[int, Pairs, str] | None:
    """A label and what stands behind it, from ``at``: where it ends, its pairs and its pattern."""
    heading = _HEADING.match(line, at)
    above, at = ("", at) if heading is None else (heading["head"], heading.end())
    label = _LABEL.match(line, at)
    sign = "" if label is None else "[:=]"
    label = label or _BARE.match(line, at)
    first = None if label is None else _VALUE.match(line, label.end())
    if label is None or first is None:
        return None
    bracket = label["open"]
    values, marks, at = _values(line, first, bracket is not None)
    if bracket:
        close = _CLOSE.match(line, at)
        if close is None:
            return None
        at = close.end()
    word = _WORD.match(line, at)
    unit = None if word is None else unit_of(word[1])
    behind = ""
    if word is not None and unit is not None:
        at, behind = word.end(), rf"\s*{re.escape(word[1])}(?=$|[\s,;|}}])"
    name = label["label"]
    title = rf"[\s,;|]*{re.escape(above)}\s*:" if above else ""
    numbers = rf"({NUMBER})" + "".join(rf"{mark}({NUMBER})" for mark in marks)
    begins = rf"[\s,;|]*{_QUOTE}{re.escape(name)}{_QUOTE}\s*{sign}"
    around = (r"\s*[\[({]\s*", r"\s*[\])}]") if bracket else (r"\s*", "")
    part = f"{title}{begins}{around[0]}{numbers}{around[1] or _BEHIND}{behind}"
    name = f"{above} {name}".strip()
    each = _names(name, len(values)) if len(values) > 1 or bracket else [name]
    return at, [(n, v, unit) for n, v in zip(each, values, strict=True)], part


def _values(line: str, first: re.Match[str], within: bool) -> tuple[list[str], list[str], int]:
    """The numbers from the ``first`` on, the patterns between them, and where they end. Without
    brackets they are a vector's where one mark is between all of them.
    """
    values, at, found = [first["value"]], first.end(), list[re.Match[str]]()
    while (match := _NEXT.match(line, at)) is not None:
        found.append(match)
        at = match.end()
    kinds = {match["by"].strip() for match in found}
    if not found or not within and (len(found) + 1 < LEAST or len(kinds) > 1):
        return values, [], first.end()
    marks = [rf"\s*{re.escape(kind)}\s*" if (kind := m["by"].strip()) else r"\s+" for m in found]
    return [*values, *(match["value"] for match in found)], marks, at


def _names(label: str, count: int) -> list[str]:
    """The names of the numbers of a vector: axes of three, places of others; a unit behind the name
    stands behind the axes, too.
    """
    if count == 3:
        remark = re.search(rf"{_REMARK}$", label)
        behind = "" if remark is None else f" {remark[0].strip()}"
        label = label if remark is None else label[: remark.start()]
        return [f"{_ALL_AXES.sub('', label) or label} {axis}{behind}" for axis in "xyz"]
    return [label] if count == 1 else [f"{label}[{k}]" for k in range(count)]


def columns_of(pairs: Pairs) -> list[str]:
    """The names of the columns that a line makes, with their units."""
    names, units = _with_stems(labels_of(pairs)), _units(pairs)
    return [f"{name} [{unit}]" if unit else name for name, unit in zip(names, units, strict=True)]


def _units(pairs: Pairs) -> list[str | None]:
    """The unit of each value; one behind the last of a vector is that of its other two, too."""
    units = [unit for _, _, unit in pairs]
    for k, (label, _, unit) in enumerate(pairs):
        if unit and k >= 2 and units[k - 2 : k] == [None, None] and label[-1:] in "zZ":
            units[k - 2 : k] = [unit, unit]
    return units


def _with_stems(labels: Sequence[str]) -> list[str]:
    """The labels; an axis alone has the words of the one before it: ``Acceleration X: 1, Y: 2``."""
    found: list[str] = []
    for label in labels:
        if label in tuple("xyzXYZ") and found and " " in found[-1] and found[-1] not in IN_FRONT:
            label = f"{found[-1].rpartition(' ')[0]} {label}"
        found.append(label)
    return found
