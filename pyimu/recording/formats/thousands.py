"""Numbers whose thousands stand apart: ``"1,234.5"`` in quotation marks, ``1 234,5``, ``1.234,5``,
``1'234.5``, as spreadsheets show them.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

MARKS = ((",", "."), (r"\.", ","), ("[ \u00a0\u202f]", ","), ("['’]", "."))
"""Marks between thousands, as they stand in expressions, and the decimal mark of such a number."""

_CELL = r'(?:(?<=[;\t|"])|^)( *{} *)(?=[;\t|"]|$)'
"""A cell between separators that no number has: commas and blanks are none."""


def without_marks(lines: Sequence[str]) -> Callable[[str], str] | None:
    """What takes the marks out of a line, None where the ``lines`` show none.

    They do where a number has a decimal mark behind it, and none has it elsewhere than before three
    digits: ``"1,234"`` alone may be a decimal comma, and ``"1,234,567"`` three numbers.
    """
    rows = [line.rstrip("\r\n") for line in lines]
    for mark, decimal in MARKS:
        grouped, point = rf"[-+]?\d{{1,3}}(?:{mark}\d{{3}})+", re.escape(decimal)
        cell = re.compile(_CELL.format(rf"{grouped}(?:{point}\d*)?"))
        sure = re.compile(rf"{mark}\d{{3}}{point}\d")
        other = re.compile(_CELL.format(rf"[-+]?\d*{mark}(?!\d{{3}}(?!\d))\d*"))
        found = [match[1] for row in rows for match in cell.finditer(row)]
        if any(map(sure.search, found)) and not any(map(other.search, rows)):
            taken = re.compile(mark)
            return lambda line: cell.sub(lambda match: taken.sub("", match[1].strip()), line)
    return None
