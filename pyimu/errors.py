"""Errors, which end the work, and findings, which go along with the result."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

LONGEST = 2000
"""Characters of a message: what comes out of a damaged file may be of any length."""


class UserError(ValueError):
    """What a user gave cannot be used.

    The message is one line that says what is wrong, where (file, row, column or key) and what would
    be right; the command line prints it and ends with exit status 2. ``advice`` ends it with the
    command that would help; what that command itself says is the message alone, ``bare``.
    """

    def __init__(self, message: str, advice: str = "") -> None:
        super().__init__(_in_one_line(f"{message}{advice}"))
        self.bare = _in_one_line(message)


def _in_one_line(message: str) -> str:
    line = printable(" ".join(str(message).split()))
    half = LONGEST // 2
    return line if len(line) <= LONGEST else f"{line[:half]}...{line[-half:]}"


def printable(text: str) -> str:
    """``text`` without the characters that a terminal obeys, a question mark for each."""
    return "".join(c if c.isprintable() or c == " " else "?" for c in text)


@dataclass(frozen=True)
class Finding:
    """Something that was seen in a recording and that its user should know.

    ``column`` is a column's name without unit (``gyro_x``), or empty where all rows are meant;
    ``count`` how many samples, rows or events; ``detail`` numbers in SI, and texts.
    """

    kind: str
    column: str = ""
    count: int = 1
    detail: Mapping[str, Any] = field(default_factory=dict)

    def as_dict(self) -> dict[str, Any]:
        """The finding as plain types, for JSON."""
        return {
            "kind": self.kind,
            "column": self.column,
            "count": int(self.count),
            "detail": dict(self.detail),
        }
