"""Numbers that are written otherwise than programs read them: with their unit in the cell
(``9.81 m/s2``), with the minus sign of printers, in hexadecimal digits, with Fortran's exponent,
with decimal commas between commas or beside decimal points, several in a cell as a list
(``"[0.1, 0.2, 9.8]"``), or as texts of a spreadsheet (``="0.1"``, ``'12``).
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from pyimu.recording.formats.lines import is_comment, share
from pyimu.recording.spelling import unit_of

Rewrite = Callable[[str], str]

SEPARATORS = (",", ";", "\t", "|")

MINUS = "\u2212"
_MINUS = re.compile(rf"{MINUS}(?=\.?\d)")
_FORTRAN = re.compile(r"(?<![\w.])([-+]?(?:\d+\.?\d*|\.\d+))[dD]([-+]\d{1,3})(?![\w.])")
_HEXADECIMAL = re.compile(r"(?<![\w.:-])0[xX]([0-9A-Fa-f]{1,8})(?![\w.:-])")
_FORMULA = re.compile(r'"=""([^"]*)"""|="([^"]*)"')
_APOSTROPHE = re.compile(r"(?:(?<=[,;\t|\"])|^)'(?=[-+]?\.?\d)")
_WITH_UNIT = re.compile(
    r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([^\W\d_][^\s,;]*|[°º%/][^\s,;]*)\s*"
)
_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_LIST = re.compile(rf"['\"]?[\[({{]\s*({_NUMBER}(?:(?:\s*[,;]\s*|\s+){_NUMBER})+)\s*[\])}}]['\"]?")
_BETWEEN = re.compile(r"\s*[,;]\s*|\s+")
_AROUND = " []()"
"""What may stand around all of a row, as where a program printed a list of lists."""
_COMMA = re.compile(r"\s*[-+]?\d+,\d+(?:[eE][-+]?\d+)?\s*")
_POINT = re.compile(r"\s*[-+]?\d+\.\d+(?:[eE][-+]?\d+)?\s*")
_THOUSANDS = re.compile(r"\s*[-+]?[1-9]\d{0,2}(?:\.\d{3})+\s*")
_WHOLE, _FRACTION = re.compile(r"\s*[-+]?\d+"), re.compile(r"\d+\s*")

SHARE = 0.9
"""Share of the last half of the first rows whose numbers are written so."""

LETTERS = {"C": "degC", "F": "degF"}
"""Units of a temperature that are none anywhere else."""


class Plain(NamedTuple):
    """What makes a line as programs read it, what is ``said`` of the lines, and the units that
    stood in the cells, by the positions of the columns.
    """

    rewrite: Rewrite
    said: str
    units: Mapping[int, str] = {}


def plain_numbers(lines: Sequence[str]) -> Plain | None:
    """How the numbers in these first ``lines`` are read, None where they are as usual."""
    rows = [line.rstrip("\r\n") for line in lines if line.strip() and not is_comment(line)]
    tail = rows[len(rows) // 2 :]
    for pattern, by, said in (
        (_FORMULA, _text, 'texts as formulas (="0.1")'),
        (_APOSTROPHE, "", "numbers that an apostrophe marks as texts"),
        (_FORTRAN, r"\1E\2", "exponents with D"),
        (_MINUS, "-", "the minus sign of printers"),
        (_HEXADECIMAL, lambda match: str(int(match[1], 16)), "numbers in hexadecimal digits"),
    ):
        if share(pattern.search(row) is not None for row in tail) >= SHARE / 2:
            return Plain(_substitution(pattern, by), said)
    return _with_units(tail) or _with_lists(tail) or _with_commas(rows) or _with_two_marks(tail)


def _text(formula: re.Match[str]) -> str:
    """The text of a formula, in quotation marks where it may have a separator in it."""
    text = formula[1] or formula[2] or ""
    return f'"{text}"' if set(SEPARATORS) & set(text) else text


def _substitution(pattern: re.Pattern[str], by: str | Callable[[re.Match[str]], str]) -> Rewrite:
    return lambda line: pattern.sub(by, line)


def _with_units(tail: Sequence[str]) -> Plain | None:
    """How cells with a unit behind the number are read: in a column it is the same one."""
    for separator in SEPARATORS:
        cells = [row.split(separator) for row in tail]
        width = Counter(map(len, cells)).most_common(1)[0][0] if cells else 0
        cells = [row for row in cells if len(row) == width]
        if width < 3 or len(cells) < SHARE * len(tail):
            continue
        units = {k: unit for k in range(width) if (unit := _unit([row[k] for row in cells]))}
        if units:
            return Plain(_without_units(units, width, separator), "units in the cells", units)
    return None


def _unit(cells: Sequence[str]) -> str | None:
    """The unit behind the numbers of a column, None where there is none, or no known one."""
    found = [_WITH_UNIT.fullmatch(cell) for cell in cells]
    said = Counter(match[2] for match in found if match is not None)
    (text, count), *_ = said.most_common(1) or [("", 0)]
    if count < SHARE * len(cells):
        return None
    return LETTERS.get(text) or unit_of(text)


def _without_units(units: Mapping[int, str], width: int, separator: str) -> Rewrite:
    def rewrite(line: str) -> str:
        row = line.split(separator)
        if len(row) != width:
            return line
        for k in units:
            match = _WITH_UNIT.fullmatch(row[k])
            row[k] = row[k] if match is None else match[1]
        return separator.join(row)

    return rewrite


def _with_lists(tail: Sequence[str]) -> Plain | None:
    """How rows are read with several numbers in a cell, as many in each row; the name above such a
    cell becomes one for each of them.
    """
    kinds = Counter(tuple(_counts(row)) for row in tail)
    (counts, seen), *_ = kinds.most_common(1) or [((), 0)]
    if not counts or seen < SHARE * len(tail):
        return None
    row = next(row for row in tail if tuple(_counts(row)) == counts)
    outside = _LIST.sub("\0", row).strip(_AROUND)
    by = max(",;\t| ", key=lambda mark: (mark in outside and mark != " ", outside.count(mark)))
    cells = _split(outside, by)
    lists = [k for k, cell in enumerate(cells) if "\0" in cell]
    if len(lists) != len(counts):
        return None
    places = dict(zip(lists, counts, strict=True))
    return Plain(_unrolled(places, len(cells), by), "several numbers in a cell")


def _split(line: str, by: str) -> list[str]:
    """The cells of a line, a run of blanks for one where these part them."""
    return line.split() if by == " " else line.split(by)


def _counts(row: str) -> list[int]:
    """How many numbers each list in a row has."""
    return [len(_BETWEEN.split(match[1])) for match in _LIST.finditer(row)]


def _unrolled(places: Mapping[int, int], width: int, by: str) -> Rewrite:
    def rewrite(line: str) -> str:
        if _LIST.search(line):
            flat = _LIST.sub(lambda match: by.join(_BETWEEN.split(match[1])), line)
            return flat.strip(_AROUND + ",")
        names = _split(line, by)
        if len(names) != width or not line.strip():
            return line
        each = [
            [f"{n.strip()}[{i}]" for i in range(places.get(k, 0))] or [n]
            for k, n in enumerate(names)
        ]
        return by.join(name for some in each for name in some)

    return rewrite


def _with_commas(rows: Sequence[str]) -> Plain | None:
    """How rows are read in which the commas between the cells are those within them, too: below
    names there are two cells for each, or for each but the first, which counts.
    """
    named = next((row.split(",") for row in rows if re.search(r"[^\W\d_]{2}|[a-z]", row)), [])
    count = len(named)
    tail = [row.split(",") for row in rows[len(rows) // 2 :]]
    for whole in (0, 1):
        width = 2 * count - whole
        pairs = [row for row in tail if len(row) == width and _are_pairs(row, whole)]
        if count > 2 and len(pairs) >= SHARE * len(tail) and len(tail) > 2:
            return Plain(_joined(width, whole), "decimal commas between commas")
    return None


def _are_pairs(row: Sequence[str], whole: int) -> bool:
    first = all(_WHOLE.fullmatch(cell) for cell in (*row[:whole], *row[whole::2]))
    return first and all(_FRACTION.fullmatch(cell) for cell in row[whole + 1 :: 2])


def _joined(width: int, whole: int) -> Rewrite:
    def rewrite(line: str) -> str:
        row = line.split(",")
        if len(row) != width or not _are_pairs(row, whole):
            return line
        pairs = zip(row[whole::2], row[whole + 1 :: 2], strict=True)
        return ",".join([*row[:whole], *(f"{a}.{b.strip()}" for a, b in pairs)])

    return rewrite


def _with_two_marks(tail: Sequence[str]) -> Plain | None:
    """How rows are read in which some columns have decimal commas and others decimal points, as
    where a program wrote its time and a spreadsheet the rest. Points that may part thousands are no
    such ones.
    """
    for separator in SEPARATORS[1:]:
        cells = [row.split(separator) for row in tail]
        width = Counter(map(len, cells)).most_common(1)[0][0] if cells else 0
        columns = list(zip(*(row for row in cells if len(row) == width), strict=True))
        commas = {k for k, column in enumerate(columns) if _all(_COMMA, column)}
        points = [c for c in columns if _all(_POINT, c) and not _all(_THOUSANDS, c)]
        if commas and points and len(columns[0]) >= SHARE * len(tail):
            return Plain(_pointed(commas, width, separator), "decimal commas and decimal points")
    return None


def _all(pattern: re.Pattern[str], cells: Sequence[str]) -> bool:
    return share(pattern.fullmatch(cell) is not None for cell in cells) >= SHARE


def _pointed(commas: set[int], width: int, separator: str) -> Rewrite:
    def rewrite(line: str) -> str:
        row = line.split(separator)
        if len(row) != width:
            return line
        return separator.join(
            cell.replace(",", ".") if k in commas and _COMMA.fullmatch(cell) else cell
            for k, cell in enumerate(row)
        )

    return rewrite
