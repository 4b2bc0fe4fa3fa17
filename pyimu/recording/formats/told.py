"""How a table in text stands in its file, told from its first lines alone.

Separator and decimal mark, lines of comment, rows of names and of units, the first row of numbers,
and a sample rate that a comment states.
"""

from __future__ import annotations

import csv
import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from pyimu.recording.columns import UNITS
from pyimu.recording.formats.cells import MISSING, is_number
from pyimu.recording.formats.clock_times import is_clock_time
from pyimu.recording.formats.lines import UTF_8, is_comment
from pyimu.recording.formats.marked import Marked
from pyimu.recording.formats.over_columns import is_behind, with_axes
from pyimu.recording.formats.rate_line import rate_in
from pyimu.recording.formats.sections import rate_of_devices
from pyimu.recording.formats.unnamed import names_of
from pyimu.recording.spelling import bare, unit_of

HEAD = 120
"""Lines from which the layout is told."""

FORMS = ((",", "."), (";", "."), ("\t", "."), ("|", "."), (" ", "."))
"""Separators and decimal marks, the likelier first; a blank stands for any run of blanks."""

COMMAS = ((";", ","), ("\t", ","), ("|", ","), (" ", ","), (",", ","))
"""The same with decimal commas; between commas such numbers stand in quotation marks."""

NO_TOPICS = (
    "{}: has no topics, only ROS bags, ULog, dataflash and GnssLogger files do; leave [topics] out "
    "of the column map"
)
"""What is said of a file that holds one table."""

OPEN = "unexpected end of data"
"""What the standard library's reader says of a line that ends within quotation marks."""

MOST_NAMES = 3
"""Rows of names and units, at most."""

MOST_SUMS = 10
"""Rows of sums and means above the samples, at most."""

_SEPARATOR = re.compile(r'"?sep=.?"?[,;\t]*', re.I)
"""The first line of a table for a spreadsheet, which says what separates its cells."""


@dataclass(frozen=True)
class Layout:
    """How a table stands in its file.

    ``names`` are of its columns, ``column 1`` and so on where the file has none; ``first`` is the
    line of the first row of numbers, from 1; the columns at ``clocks`` hold dates or times of day.
    ``commented`` says that lines of comment are among the
    first ones; ``rate`` [Hz] is what one says. ``unusual`` says what a spreadsheet's file would not
    have.
    """

    separator: str = ","
    decimal: str = "."
    names: tuple[str, ...] = ()
    first: int = 2
    commented: bool = False
    rate: float | None = None
    named: bool = True
    clocks: tuple[int, ...] = ()
    code: str = UTF_8
    marked: Marked | None = None
    """How a row is made of a line, where the lines say what their values are."""

    @property
    def unusual(self) -> str:
        separators = {",": "", ";": "semicolons", "\t": "tabs", " ": "blanks", "|": "bars"}
        said = [
            f"columns separated by {separators[self.separator]}" if self.separator != "," else "",
            "decimal commas" if self.decimal == "," else "",
            f"text in {self.code}" if self.code != UTF_8 else "",
            "" if self.named else "no names of columns",
            "" if self.marked is None else self.marked.said,
            f"the numbers begin in row {self.first}" if self.first > 2 else "",
        ]
        return ", ".join(word for word in said if word)

    def cells(self, line: str) -> list[str]:
        """The cells of a line; one alone where it is no row of a table."""
        if self.separator == " ":
            return line.split()
        try:
            return next(csv.reader([line], delimiter=self.separator), [])
        except csv.Error:
            return [line]

    def is_open(self, line: str) -> bool:
        """Whether a quotation mark that begins a cell of the line is not closed in it."""
        return self.separator != " " and self._error(line) == OPEN

    def is_whole(self, line: str) -> bool:
        """Whether quotation marks in the line stand around whole cells alone."""
        return not self._error(line)

    def _error(self, line: str) -> str:
        """What the standard library's reader has against a line, nothing of a good one."""
        try:
            next(csv.reader([line], delimiter=self.separator, strict=True), None)
        except csv.Error as error:
            return str(error)
        return ""


def told_from(head: Sequence[str]) -> Layout:
    """The layout of a table with the first lines ``head``."""
    numbered = [(k, line.rstrip("\r\n")) for k, line in enumerate(head, 1) if line.strip()]
    numbered = numbered[bool(numbered and _SEPARATOR.fullmatch(numbered[0][1])) :]
    commented = any(is_comment(line) for _, line in numbered)
    rows = [(k, line) for k, line in numbered if not is_comment(line)]
    form = _form([line for _, line in rows])
    if form is None:
        names = Layout().cells(rows[0][1]) if rows else []
        return Layout(names=tuple(map(str.strip, names)), first=rows[0][0] + 1 if rows else 1)
    cells = [(k, form.cells(line)) for k, line in rows]
    width = _width([c for _, c in cells])
    above = _start([c for _, c in cells], width, form.decimal)
    start = above + _sums([c for _, c in cells[above:]], width, form.decimal)
    first = cells[start][0] if start < len(cells) else rows[-1][0] + 1
    named = _together([(k, c) for k, c in cells[:above] if len(c) > 1 and 2 * len(c) > width])
    if not named:
        over = [re.sub(r'^("?#|//|%)+\s*', "", line) for k, line in numbered if k < first]
        named = _names_above(over, form, width)
    whole = [c for _, c in cells[start:] if len(c) == width]
    empty = _empty(whole, width)
    named = [_over(row, width, empty) for row in named]
    named = [["", *row] if is_behind(row, whole, form.decimal) else row for row in named]
    names = _names(named, width, empty) or names_of(whole, form.separator)
    notes = [line for k, line in numbered if is_comment(line) or k < first]
    rate = next((hertz for line in notes[:HEAD] if (hertz := rate_in(line))), None)
    rate = rate or rate_of_devices(head)
    return Layout(
        form.separator,
        form.decimal,
        names or tuple(f"column {k + 1}" for k in range(width)),
        first,
        commented,
        rate,
        bool(names and named),
        _clocks([c for _, c in cells[start:]], width),
    )


def _together(rows: Sequence[tuple[int, list[str]]]) -> list[list[str]]:
    """The last rows of names, by their lines: what a blank one parts from them is about the log."""
    found = [row for _, row in rows[-1:]]
    for (above, row), (below, _) in reversed(list(pairwise(rows))):
        if below - above > 1 or len(found) == MOST_NAMES:
            break
        found.insert(0, row)
    return found


def _empty(rows: Sequence[Sequence[str]], width: int) -> list[int]:
    """Positions of the columns without anything in them."""
    return [k for k in range(width) if rows and not any(row[k].strip() for row in rows)]


def _over(row: Sequence[str], width: int, empty: Sequence[int]) -> Sequence[str]:
    """A row of names over the columns that have numbers, where it has one for each of these alone:
    some programs write two tabs between numbers, and one between names.
    """
    cells = [cell for cell in row if cell.strip()]
    if not empty or len(row) >= width or len(cells) != width - len(empty):
        return row
    there = iter(cells)
    return ["" if k in empty else next(there) for k in range(width)]


def _clocks(rows: Sequence[Sequence[str]], width: int) -> tuple[int, ...]:
    """Positions of the columns of dates or times of day."""
    whole = [row for row in rows if len(row) == width]
    columns = [[row[k] for row in whole if row[k].strip() not in MISSING] for k in range(width)]
    return tuple(k for k, cells in enumerate(columns) if cells and all(map(is_clock_time, cells)))


def _form(rows: Sequence[str]) -> Layout | None:
    """Separator and decimal mark under which most of the last rows are numbers, None where none."""
    tail = rows[len(rows) // 2 :]
    scored = [(_score(tail, Layout(s, d)), Layout(s, d)) for s, d in (*FORMS, *COMMAS)]
    best, form = max(scored, key=lambda item: item[0])
    return form if best > 0 else None


def _score(rows: Sequence[str], form: Layout) -> float:
    """Share of the cells that are numbers, of rows with the usual number of cells above one."""
    cells = [form.cells(row) for row in rows]
    width = _width(cells)
    if width < 2:
        return 0.0
    shares = [
        sum(is_number(c, form.decimal) and bool(c.strip()) for c in row)
        / max(sum(bool(c.strip()) for c in row), 1)
        for row in cells
        if len(row) == width
    ]
    return sum(shares) / len(cells) if shares else 0.0


def _width(rows: Sequence[Sequence[str]]) -> int:
    """The usual number of cells, of the last half of the rows."""
    counts = Counter(len(row) for row in rows[len(rows) // 2 :])
    return max(counts, key=lambda width: (counts[width], width), default=0)


def _start(rows: Sequence[Sequence[str]], width: int, decimal: str) -> int:
    """Position of the first row of numbers."""
    for at, row in enumerate(rows):
        filled = [c for c in row if c.strip()]
        numbers = sum(is_number(c, decimal) for c in filled)
        if len(row) == width and filled and 2 * numbers >= len(filled):
            if at or not _names_first(rows, width, decimal):
                return at
    return len(rows)


def _sums(rows: Sequence[Sequence[str]], width: int, decimal: str) -> int:
    """How many of the first rows of numbers begin with a word where the others have a number, as
    sums and means that stand above the samples do.
    """
    for at in range(min(MOST_SUMS, len(rows) - 1)):
        if not rows[at][:1] or is_clock_time(rows[at][0]) or rows[at][0].strip() in MISSING:
            return at
        if is_number(rows[at][0], decimal) or not _names_first(rows[at:], width, decimal, 1):
            return at
    return 0


def _names_first(
    rows: Sequence[Sequence[str]], width: int, decimal: str, columns: int | None = None
) -> bool:
    """Whether the first row names its columns: texts stand above numbers, in one of so many
    ``columns``.
    """
    below = [row for row in rows[1:] if len(row) == width]
    return bool(below) and any(
        not is_number(cell, decimal)
        and 10 * sum(is_number(row[k], decimal) for row in below) >= 9 * len(below)
        for k, cell in enumerate(rows[0][:columns])
    )


def _names_above(lines_above: Sequence[str], form: Layout, width: int) -> list[list[str]]:
    """The last line above the numbers, where it has a name for every column.

    Of a row of units the one above it, too. They may be comments, or have another separator than
    the numbers.
    """
    for shape in (form, *(Layout(separator) for separator, _ in FORMS)):
        rows = [shape.cells(line) for line in lines_above[-2:]]
        good = [len(row) == width and not any(map(is_number, row)) for row in rows]
        if good and good[-1]:
            return rows if all(good) and _are_units([c.strip() for c in rows[-1]]) else rows[-1:]
    return []


def _names(rows: Sequence[Sequence[str]], width: int, empty: Sequence[int] = ()) -> tuple[str, ...]:
    """One name for each column of the rows of names, in brackets the unit of a row of units.

    The columns at ``empty`` have no numbers in the first rows.
    """
    rows = [_fitted(row, width) for row in rows]
    units = None
    if len(rows) > 1 and _are_units(rows[-1]):
        units, rows = rows[-1], rows[:-1]
    filled = [*(_rightwards(row) for row in rows[:-1]), *rows[-1:]]
    names = [" ".join(filter(None, parts)) for parts in zip(*filled, strict=True)]
    if units is not None:
        names = [
            f"{name} [{_unit(unit)}]" if unit and "[" not in name else name
            for name, unit in zip(names, units, strict=True)
        ]
    names = with_axes(_nested(names, rows[-1] if rows else [], empty))
    return tuple(_apart(name, k, names) for k, name in enumerate(names))


def _nested(names: Sequence[str], last: Sequence[str], empty: Sequence[int]) -> list[str]:
    """The names, of which one that stands several times is behind that of the ``empty`` column
    before it: a message whose field ``angular_velocity`` has no cell, and ``x`` behind it one.
    """
    found, above = [], ""
    for k, name in enumerate(names):
        above = name if k in empty else above
        nested = above and k not in empty and list(last).count(last[k]) > 1
        found.append(f"{above}.{name}" if nested else name)
    return found


def _apart(name: str, at: int, names: Sequence[str]) -> str:
    """A name that an earlier column has, with its number, so that a column map can call it.

    A recording's own names stay, to be refused.
    """
    if name not in names[:at] or name.partition("[")[0].strip() in UNITS:
        return name
    return f"{name} column {at + 1}".strip()


def _fitted(row: Sequence[str], width: int) -> list[str]:
    """The cells, without blank ones too many, and as many as there are columns where too few."""
    cells = [cell.strip() for cell in row]
    while len(cells) > width and not cells[-1]:
        cells.pop()
    return (cells + [""] * (width - len(cells)))[: max(width, 0)]


def _are_units(row: Sequence[str]) -> bool:
    """Whether most cells of a row are units: Shimmer's has ``local_flux`` and ``no_units``, too."""
    filled = [_unit(cell) for cell in row if cell]
    units = [cell for cell in filled if unit_of(cell)]
    sure = len(units) == len(filled) or any(len(cell) > 1 for cell in units)
    return 2 * len(filled) >= len(row) and sure and 2 * len(units) > len(filled)


def _unit(cell: str) -> str:
    """A unit without brackets and the mark of a remark behind it, as in Shimmer's ``deg/s*``."""
    return bare(cell).rstrip("*")


def _rightwards(row: Sequence[str]) -> list[str]:
    """Each blank cell filled with the name that stands left of it."""
    filled: list[str] = []
    for cell in row:
        filled.append(cell or (filled[-1] if filled else ""))
    return filled
