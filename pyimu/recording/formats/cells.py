"""What a cell of a table in text may hold: a number, or what says that there is none."""

from __future__ import annotations

ERRORS = ("#N/A", "#VALUE!", "#DIV/0!", "#NUM!", "#REF!")
"""What spreadsheets write where a formula has no value."""

MISSING = (
    *("", "NaN", "nan", "NAN", "-nan", "-NaN", "NA", "N/A", "n/a", "<NA>", *ERRORS),
    *("1.#QNAN", "-1.#QNAN", "1.#IND", "-1.#IND", "null", "NULL", "None", "?", "-", "--"),
)
"""Cells that hold no value; blanks may stand around them."""

WIDEST = 32
"""Blanks before or behind what stands in a cell: tables of fixed width have them."""


def padded() -> list[str]:
    """``MISSING`` with blanks before or behind it, for a parser that takes blanks off numbers
    alone.
    """
    blanks = [" " * k for k in range(WIDEST + 1)]
    behind = {word + blank for word in MISSING for blank in blanks}
    return sorted(behind | {blank + word for word in MISSING for blank in blanks})


def is_number(cell: str, decimal: str = ".") -> bool:
    """Whether a cell holds a number, or says that it holds none."""
    cell = cell.strip()
    if cell in MISSING:
        return True
    if decimal == ",":
        if "." in cell:
            return False
        cell = cell.replace(",", ".")
    try:
        float(cell)
    except ValueError:
        return False
    return "_" not in cell
