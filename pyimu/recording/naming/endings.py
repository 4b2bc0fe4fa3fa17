"""The unit that ends the name of a column: ``Gyroscope X (deg/s)``, ``x_deg_per_s``, ``ax_g``."""

from __future__ import annotations

import re
from collections.abc import Sequence

from pyimu import units
from pyimu.recording.columns import UNITS
from pyimu.recording.spelling import PAIRED, unit_of

RUN_TOGETHER = {"rads": "rad/s", "radps": "rad/s", "degs": "deg/s", "degps": "deg/s"} | {
    "ms2": "m/s^2",
    "mps2": "m/s^2",
    "mss": "m/s^2",
}
"""Units without their sign of division, as names in programs have them."""

GLUED = re.compile(r"(gyro?|acce?l?|mag|[gwamqfhr])_?([wxyz])")
"""A word for a vector, or its letter, and the axis in one: ``gx``, ``accy``."""

LONGEST = 4
"""Words of a unit: ``m per s 2``."""


def in_brackets(text: str) -> tuple[str, str] | None:
    """What stands before a bracket that ends ``text``, and in it; None where none ends it.

    Of ``Accel X m/(s^2)`` the bracket is a part of the unit.
    """
    text = text.rstrip()
    opening = _opening(text)
    if opening is None:
        return None
    head = text[:opening]
    part = re.search(r"[^\s_]+[/*]$", head)
    if part is not None:
        return head[: part.start()], part[0] + text[opening:]
    return head, text[opening + 1 : -1].strip()


def _opening(text: str) -> int | None:
    """Where the bracket begins that ends ``text``."""
    waiting: list[str] = []
    for at in range(len(text) - 1, -1, -1):
        if text[at] in PAIRED.values():
            waiting.append(text[at])
        elif waiting and PAIRED.get(text[at]) == waiting[-1]:
            waiting.pop()
        if not waiting:
            return at if at < len(text) - 1 else None
    return None


def in_words(words: Sequence[str], sure_behind: set[str]) -> tuple[list[str], str | None]:
    """The words before a unit that ends the name, and the unit.

    A unit of one or two letters is one only behind an axis, or a word of ``sure_behind``:
    ``acc_x_g``, ``ax_g``, ``time_s``, not ``w``.
    """
    for count in range(LONGEST, 0, -1):
        head, tail = list(words[:-count]), list(words[-count:])
        if not head or len(tail) < count:
            continue
        unit = None if tail == ["1"] else _of_words(tail)  # ax1 is that of the first sensor
        behind = head[-1] in sure_behind or GLUED.fullmatch(head[-1]) is not None
        if unit and (behind or len(tail[-1]) > 2):
            return head, unit
    return list(words), None


def _of_words(tail: Sequence[str]) -> str | None:
    """The unit in words of which none is a sign: two of them are one over the other."""
    together = RUN_TOGETHER.get("".join(tail))
    if together is not None:
        return together
    tail, power = list(tail), ""
    if len(tail) > 1 and tail[-1] in "12":
        power = "^2" if tail.pop() == "2" else ""
    if "per" in tail:
        return unit_of(" ".join(tail) + power)
    if len(tail) > 2 or (len(tail) == 1 and power):
        return None
    return unit_of("/".join(tail) + power) or (None if power else unit_of("".join(tail)))


def fits(unit: str, group: str) -> bool:
    """Whether a vector of ``group`` can be in ``unit``."""
    return units.same_dimension(unit, UNITS[f"{group}_x"])
