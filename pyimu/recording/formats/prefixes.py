"""What terminals and frameworks write before a line: codes of colours, ``I (330) imu:`` of ESP-IDF,
and the date and time that programs for serial ports put in front of a row.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import replace

from pyimu.recording.formats.lines import share
from pyimu.recording.formats.marked import Marked, Rewrite

Clean = Callable[[str], str]

SHARE = 0.8
"""Share of the last half of the first lines that begin so."""

_COLOUR = re.compile(r"\x1b\[[\d;]*[A-Za-z]")
_ESP = re.compile(r"[EWIDV] \((\d+)\) [^:]{1,40}: ")
_TIME = r"\d{1,2}:\d{2}:\d{2}(?:[.,:]\d{1,9})?"
_DATE = r"\d{4}[-/]\d{1,2}[-/]\d{1,2}[ T]|\d{1,2}[-/.]\d{1,2}[-/.]\d{4} "
_WEEKDAY = r"(?:Mon|Tue|Wed|Thu|Fri|Sat|Sun) [A-Z][a-z]{2} +\d{1,2} "
"""Tera Term's, whose year stands behind the time."""
_LABELS = re.compile(r"['\"]?[A-Za-z_][\w ]*['\"]?\s*[:=]")
_NUMBER = r"(?!-\d{4}[,;])-?\.?\d"
"""How a row of numbers begins; ``-0500`` is a time zone's."""
_STAMP = re.compile(
    rf"\[?((?:{_DATE}|(?<=\[){_WEEKDAY})?{_TIME}(?: \d{{4}}(?=\]))?)(?:\] *| *-?> *| +)"
    rf"(?={_NUMBER}|{_LABELS.pattern})"
)
_ARROW = re.compile(rf"\s*{_TIME} *->")


def without_prefixes(lines: Sequence[str]) -> Clean | None:
    """What takes them off a line, or makes the first column of them; None of lines without any."""
    rows = [line.rstrip("\r\n") for line in lines if line.strip()]
    tail = rows[len(rows) // 2 :]
    plain = [_without_marks(row) for row in tail]
    marked = share(a != b for a, b in zip(tail, plain, strict=True)) >= SHARE
    rest = [row[match.end() :] for row in plain if (match := _STAMP.match(row))]
    stamped = len(rest) >= SHARE * len(tail) and share(map(_is_row, rest)) >= SHARE
    stamped = stamped and not (all(map(_ARROW.match, plain)) and all(map(_LABELS.match, rest)))
    if not stamped:
        return _without_marks if marked else None
    return lambda line: _with_column(_without_marks(line))


def _without_marks(line: str) -> str:
    return _ESP.sub(r"\1: ", _COLOUR.sub("", line), count=1)


def _is_row(rest: str) -> bool:
    """Whether what stands behind a time has separators or labels of its own: a table between blanks
    has the time as two of its cells.
    """
    return any(mark in rest for mark in ",;\t") or _LABELS.match(rest) is not None


def _with_column(line: str) -> str:
    """The line with its time as a cell, or as labelled lines have it."""
    match = _STAMP.match(line)
    if match is None:
        return line
    rest = line[match.end() :]
    if _LABELS.match(rest):
        return f"{re.findall(_TIME, match[1])[-1]} -> {rest}"
    by = max(",;\t", key=rest.count)
    return f"{match[1]}{by}{rest}"


def behind(clean: Clean, marked: Marked | None, names: tuple[str, ...], clocks: tuple) -> Marked:
    """``marked`` of lines that were cleaned first."""
    said = "what stands before each row taken off"
    if marked is None:
        return Marked(names, clean, said, clocks)
    anew = marked.anew
    return replace(
        marked,
        rewrite=_chained(marked.rewrite, clean),
        said=f"{marked.said}, {said}",
        anew=None if anew is None else lambda: _chained(anew(), clean),
    )


def _chained(rewrite: Rewrite, clean: Clean) -> Rewrite:
    return lambda line: rewrite(clean(line))
