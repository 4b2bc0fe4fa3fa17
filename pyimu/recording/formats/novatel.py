"""ASCII logs of NovAtel's receivers: the raw samples of their inertial unit.

OEM7 commands and logs reference manual, RAWIMU, RAWIMUS, RAWIMUX and RAWIMUSX: behind the header
and a semicolon a status, GNSS week and seconds, and the increments of the velocity along z, minus y
and x and of the angle about them, in counts. Only the last two say which unit it is.
"""

from __future__ import annotations

import re
import zlib
from collections.abc import Sequence

from pyimu.recording.formats.marked import Marked

WORDS = ("RAWIMUSXA", "RAWIMUXA", "RAWIMUSA", "RAWIMUA")
"""Logs of raw samples, those that say which unit it is first."""

TIME, TYPE = "GNSS seconds", "IMU type"

VECTORS = tuple(f"{what} {axis}" for what in ("velocity", "angle") for axis in "xyz")
"""Columns of the increments."""

_BEFORE = {False: 3, True: 5}
"""Fields between semicolon and increments, of a log without a unit's type and of one with it."""


def novatel(lines: Sequence[str]) -> Marked | None:
    """How the raw samples among ``lines`` are read, None where there are none.

    A line whose checksum is wrong stays as it is, and is no row.
    """
    there = {_word(line) for line in lines}
    word = next((w for w in WORDS if w in there), None)
    if word is None:
        return None
    typed = word in WORDS[:2]
    before = _BEFORE[typed]

    def rewrite(line: str) -> str | None:
        if _word(line) != word:
            return None
        body, _, said = line.strip().partition("*")
        fields = body.partition(";")[2].split(",")
        if len(fields) != before + 6 or said.casefold() != _checksum(body[1:]):
            return line
        v, a = fields[before : before + 3], fields[before + 3 :]
        turned = [v[2], _negative(v[1]), v[0], a[2], _negative(a[1]), a[0]]
        return ",".join([fields[before - 2], *([fields[1]] if typed else []), *turned])

    names = (TIME, *([TYPE] if typed else []), *VECTORS)
    return Marked(names, rewrite, f"the logs {word}", commented=True)


def _word(line: str) -> str:
    """The name of the log in a line, which begins with # or, with a short header, with %."""
    match = re.match(r"[#%]([A-Z0-9]+),", line)
    return match[1] if match else ""


def _negative(number: str) -> str:
    number = number.strip()
    return number[1:] if number.startswith("-") else f"-{number}"


def _checksum(text: str) -> str:
    """The manual's 32-bit CRC of all characters between # or % and *: zlib's, from 0 and not
    inverted.
    """
    return f"{zlib.crc32(text.encode(), 0xFFFFFFFF) ^ 0xFFFFFFFF:08x}"
