"""Lines with a label before each number, or each vector, as boards write them to a serial port."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from pyimu.errors import UserError
from pyimu.recording.formats.lines import is_comment
from pyimu.recording.formats.marked import SHARE, Marked
from pyimu.recording.formats.pairs import (
    STAMP,
    Pairs,
    columns_of,
    labels_of,
    pairs_of,
    row_pattern,
)
from pyimu.recording.formats.several_lines import Joined, turns

SOME = 0.5
"""Share that is enough where the labels are not the same ones: of a sample in several lines."""


def labelled(head: Sequence[str], where: object) -> Marked | None:
    """How the lines of a file with these first ones are read, where most have a label before each
    of their numbers, or before the three of a vector.

    Raises UserError where the values of one sample stand in several lines, out of turn.
    """
    lines = [line for line in head if line.strip() and not is_comment(line)]
    told = [(line, pairs_of(line)) for line in lines[len(lines) // 2 :]]
    found = {line: pairs for line, pairs in told if pairs is not None}
    each = [pairs for _, pairs in told if pairs is not None]
    kinds = Counter(labels_of(pairs) for pairs in each)
    (labels, count), *others = kinds.most_common() or [((), 0)]
    share = len(each) / max(len(lines) - len(lines) // 2, 1)
    if share < (SOME if others else SHARE):
        return None
    if count < SHARE * len(each):
        return _in_turn(found, kinds, head, where)
    if len(labels) < 2:
        return None
    line, pairs = _first(found, labels)
    names, pattern = columns_of(pairs), row_pattern(line)

    def rewrite(line: str) -> str | None:
        match = pattern.fullmatch(line) if pattern is not None else None
        if match is not None:
            return ",".join(match.groups())
        pairs = pairs_of(line)
        known = pairs is not None and labels_of(pairs) == labels
        return ",".join(value for _, value, _ in pairs) if known and pairs else line

    return Marked(tuple(names), rewrite, "a label before each number", _clocks(names))


def _first(found: dict[str, Pairs], labels: tuple[str, ...]) -> tuple[str, Pairs]:
    """The first line with these labels, and its pairs."""
    return next((line, pairs) for line, pairs in found.items() if labels_of(pairs) == labels)


def _in_turn(
    found: dict[str, Pairs], kinds: Counter[tuple[str, ...]], head: Sequence[str], where: object
) -> Marked:
    """How lines with these labels are read, of which several make a sample.

    Raises UserError where they do not come in turn.
    """
    seen = [labels_of(pairs_of(line) or []) for line in head]
    lines = [labels if labels in kinds else None for labels in seen]
    order = turns(lines)
    if not order:
        raise UserError(
            f"{where}: the values of one sample stand in several lines, which do not come in turn, "
            f"those of {' and '.join(kind[0] for kind, _ in kinds.most_common(2))}; have them "
            "written in one line"
        )
    firsts = [_first(found, labels) for labels in order]
    each = [columns_of(pairs) for _, pairs in firsts]
    names = [
        n if n not in sum(each[:k], []) else f"{n} of line {k + 1}"
        for k, of in enumerate(each)
        for n in of
    ]
    patterns = [(row_pattern(line), labels_of(pairs)) for line, pairs in firsts]

    def taken(line: str) -> tuple[tuple[str, ...], list[str]] | None:
        for pattern, labels in patterns:
            match = None if pattern is None else pattern.fullmatch(line)
            if match is not None:
                return labels, list(match.groups())
        pairs = pairs_of(line)
        return None if pairs is None else (labels_of(pairs), [value for _, value, _ in pairs])

    def begins(line: str) -> str | None:
        told = taken(line)
        return line if told is None or told[0] != order[0] else ",".join(told[1])

    said = f"a label before each number, a sample in {len(order)} lines"
    return Marked(tuple(names), begins, said, _clocks(names), anew=lambda: Joined(taken, order))


def _clocks(names: Sequence[str]) -> tuple[int, ...]:
    return tuple(k for k, name in enumerate(names) if name.startswith(STAMP))
