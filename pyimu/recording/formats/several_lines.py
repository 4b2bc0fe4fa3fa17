"""Samples whose values stand in several lines, as examples of libraries print them: one with the
accelerations, one with the rates, in turn.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from itertools import pairwise

Labels = tuple[str, ...]

Taken = Callable[[str], tuple[Labels, list[str]] | None]
"""The labels and the values of a line, None of one that has none."""

WHOLE = 0.8
"""Share of the lines that must come in their turn."""


def turns(lines: Sequence[Labels | None]) -> list[Labels]:
    """The lines of one sample in their order, by the first lines of a file, None of one without
    labels; empty where they do not come in turn.

    A sample begins behind a line without labels where these stand between samples, else with the
    first line of all.
    """
    kinds = [labels for labels in lines if labels is not None]
    order = list(dict.fromkeys(kinds))
    begun = Counter(b for a, b in pairwise(lines) if a is None and b is not None)
    if begun:
        first, count = begun.most_common()[0]
        if count >= WHOLE * max(begun.total(), kinds.count(first)):
            order = order[order.index(first) :] + order[: order.index(first)]
    after = dict(zip(order, order[1:] + order[:1], strict=True))
    kept = sum(after[a] == b for a, b in pairwise(kinds))
    return order if kept >= WHOLE * (len(kinds) - 1) and len(kinds) > 2 * len(order) else []


class Joined:
    """Makes a row of the lines of a sample: nothing of all but its last one.

    A line out of its turn stays as it is, and is no row; so is one behind which lines are missing.
    """

    def __init__(self, taken: Taken, order: Sequence[Labels]) -> None:
        self._taken, self._order = taken, list(order)
        self._values: list[str] = []
        self._next = 0

    def __call__(self, line: str) -> str | None:
        found = self._taken(line)
        if found is None or found[0] not in self._order:
            return None
        labels, values = found
        if labels != self._order[self._next]:
            lost, self._values, self._next = self._next > 0, [], 0
            if labels != self._order[0]:
                return line
            self._values, self._next = values, 1
            return line if lost else None
        self._values = self._values + values
        self._next += 1
        if self._next < len(self._order):
            return None
        row, self._values, self._next = ",".join(self._values), [], 0
        return row
