"""Numbers below a label that has a line of its own, as some examples print a vector::

    Accelerometer
    0.12
    0.34
    9.81

Such lines are made into one with the label before them, which ``labelled`` reads.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace

from pyimu.recording.formats.labelled import labelled
from pyimu.recording.formats.lines import is_comment
from pyimu.recording.formats.marked import SHARE, Marked, Rewrite
from pyimu.recording.formats.pairs import NUMBER
from pyimu.recording.spelling import unit_of

_LABEL = re.compile(r"\s*([A-Za-z_][A-Za-z_ ]*?)\s*(?:[\[(]([^\])]*)[\])])?\s*[:=]?\s*")
_NUMBERS = re.compile(rf"\s*[\[({{]?\s*{NUMBER}(?:(?:\s*[,;|]\s*|\s+){NUMBER})*\s*[\])}}]?\s*")
_ONE = re.compile(NUMBER)

LEAST = 3
"""Times that a label must come among the first lines: names above a table come once."""


def headed(head: Sequence[str], where: object) -> Marked | None:
    """How the lines of a file with these first ones are read, where labels have lines of their own.

    Raises UserError as ``labelled`` does.
    """
    lines = [line for line in head if line.strip() and not is_comment(line)]
    counts = _counts(lines[len(lines) // 2 :])
    if not counts:
        return None
    made = Gathered(counts, lambda line: line)
    found = labelled([row for line in lines if (row := made(line)) is not None], where)
    if found is None:
        return None

    def begins(line: str) -> str | None:
        """Other than the line itself for the label with which a sample begins."""
        label = _label(line)
        first = found.names[0] if found is not None else ""
        return None if label in counts and first.startswith(label) else line

    return replace(
        found,
        rewrite=lambda line: "" if begins(line) is None else line,
        said=f"{found.said}, in a line above it",
        anew=lambda: Gathered(counts, found.rewriter()),
    )


def _counts(lines: Sequence[str]) -> dict[str, int]:
    """How many numbers are below each label, none where most lines are neither."""
    label, below, seen = None, 0, list[tuple[str, int]]()
    other = 0
    for line in lines:
        if _NUMBERS.fullmatch(line):
            below += len(_ONE.findall(line))
        else:
            if label is not None and below:
                seen.append((label, below))
            label, below = _label(line), 0
            other += label is None
    kinds = Counter(seen)
    if other > (1 - SHARE) * len(lines) or not kinds:
        return {}
    usual = {label: count for (label, count), _ in reversed(kinds.most_common())}
    times = Counter(label for label, _ in seen)
    return {label: count for label, count in usual.items() if times[label] >= LEAST}


def _label(line: str) -> str | None:
    match = _LABEL.fullmatch(line)
    return None if match is None else match[1]


class Gathered:
    """Makes of a label and the numbers below it one line, and gives that to ``behind``.

    Other lines go there as they are.
    """

    def __init__(self, counts: Mapping[str, int], behind: Rewrite) -> None:
        self._counts, self._behind = counts, behind
        self._label, self._unit = "", ""
        self._numbers: list[str] = []

    def __call__(self, line: str) -> str | None:
        if self._label and _NUMBERS.fullmatch(line):
            self._numbers += _ONE.findall(line)
            if len(self._numbers) < self._counts[self._label]:
                return None
            made = f"{self._label}: [{', '.join(self._numbers)}] {self._unit}"
            self._label, self._numbers = "", []
            return self._behind(made)
        match = _LABEL.fullmatch(line)
        if match is None or match[1] not in self._counts:
            return self._behind(line)
        self._label, self._numbers = match[1], []
        self._unit = (unit_of(match[2]) if match[2] else None) or ""
        return None
