"""Names of columns with ends of lines in them, as spreadsheets break long ones: ``"Acc X`` and in
the line below it ``(m/s2)"``.
"""

from __future__ import annotations

from collections.abc import Sequence

from pyimu.recording.formats.told import Layout

SEPARATORS = (",", ";", "\t", "|")


def with_whole_names(lines: Sequence[str]) -> list[str]:
    """The first ``lines`` of a file; those that quotation marks hold together are one with blanks
    between them, and empty ones before it, so that all others keep their numbers.
    """
    for separator in SEPARATORS:
        found = _joined(lines, Layout(separator))
        if found is not None:
            return found
    return list(lines)


def _joined(lines: Sequence[str], form: Layout) -> list[str] | None:
    """The lines of a table of that ``form``, None where none is held together with others."""
    found: list[str] = []
    joined, at = False, 0
    while at < len(lines):
        count = _length(lines[at:], form)
        whole = " ".join(line.strip("\r\n") for line in lines[at : at + count])
        found += [lines[at]] if count == 1 else [*["\n"] * (count - 1), whole + "\n"]
        joined, at = joined or count > 1, at + count
    return found if joined else None


def _length(lines: Sequence[str], form: Layout) -> int:
    """How many lines the first one of a table goes on for; 1 where no mark closes it."""
    text = lines[0].rstrip("\r\n")
    for count, line in enumerate(lines[1:], 2):
        if not form.is_open(text):
            return 1
        text = f"{text} {line.strip()}"
        if form.is_whole(text):
            return count
    return 1
