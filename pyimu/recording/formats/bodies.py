"""Data sets of people with sensors on them whose texts have no names of columns."""

from __future__ import annotations

import re
from collections.abc import Sequence

from pyimu.recording.formats.marked import Marked

WISDM = ("user", "activity", "timestamp", "x", "y", "z")
"""A row of WISDM's raw files (readme, "raw.txt follows this format"), behind which a semicolon."""

PLACES = ("hand", "chest", "ankle")

_UNIT = (
    "temperature",
    *(f"{what} {a}" for what in ("acc16", "acc6", "gyro", "mag") for a in "xyz"),
    *(f"orientation {k}" for k in range(1, 5)),
)

PAMAP2 = ("timestamp", "activity", "heart rate", *(f"{p} {c}" for p in PLACES for c in _UNIT))
"""A row of PAMAP2 (readme.pdf, section II.1): 54 columns between blanks."""

TOTAL_CAPTURE = (
    *(f"q {a}" for a in "wxyz"),
    *(f"{what} {a}" for what in ("acceleration", "angular rate", "magnetic field") for a in "xyz"),
)
"""What stands behind a sensor's name in TotalCapture's ``_Xsens_AuxFields.sensors``."""

TOTAL_CAPTURE_RATE = 60.0
"""Hz; Trumble et al. 2017, section 3: all sensors at 60 Hz."""


def total_capture(lines: Sequence[str], sensor: str = "") -> Marked | None:
    """How TotalCapture's ``.sensors`` are read: the lines of a ``sensor``, the first where none is
    named; None of any others, and where the file has none of that name.

    The first line counts sensors and frames; a frame is its number, and a line for each sensor.
    """
    cells = [line.split() for line in lines if line.strip()]
    if len(cells) < 3 or len(cells[0]) != 2 or not all(c.isdigit() for c in cells[0] + cells[1]):
        return None
    count = int(cells[0][0])
    frame = cells[2 : 2 + count]
    width = len(TOTAL_CAPTURE) + 1
    names = [row[0] for row in frame if len(row) == width and re.fullmatch(r"[A-Za-z]\w*", row[0])]
    if not names or len(names) < len(frame) or (sensor and sensor not in names):
        return None
    own = sensor or names[0]

    def rewrite(line: str) -> str | None:
        row = line.split()
        return ",".join(row[1:]) if row[:1] == [own] else None

    said = f"the lines {own} of {', '.join(names)}"
    return Marked(TOTAL_CAPTURE, rewrite, said, rate=TOTAL_CAPTURE_RATE)


def is_wisdm(row: Sequence[str]) -> bool:
    """Whether cells are a person's number, the word of an activity, ns and an acceleration."""
    return (
        len(row) == len(WISDM)
        and row[0].strip().isdigit()
        and re.fullmatch(r"[A-Za-z]+", row[1].strip()) is not None
        and re.fullmatch(r"\d{10,19}", row[2].strip()) is not None
    )


def is_pamap2(row: Sequence[str]) -> bool:
    """Whether numbers are those of a row of PAMAP2: an activity is a whole one up to 24."""
    return len(row) == len(PAMAP2) and row[1].strip().isdigit() and int(row[1]) <= 24
