"""A proposal as the text of a column map."""

from __future__ import annotations

import json
from collections.abc import Sequence

from pyimu.recording.guess.proposal import CHOICES, Guess, Proposal

WIDTH = 46
"""Characters in front of a remark."""


def text_of(proposals: Sequence[Proposal]) -> str:
    """The column map of a log that lies in the files of the ``proposals``, the first its own."""
    first, *others = proposals
    lines = [
        f"# Column map for {first.path.name}, written by pyimu inspect: look it over, then give it",
        "# to the other commands as --columns. Behind each # stands how it was found.",
    ]
    if first.open_questions:
        sized = any(g.sizes for g in first.guesses)
        lines += [
            "#",
            f"# The unit of {' and '.join(first.open_questions)} is not known: take the # away",
            "# from the lines with the right one"
            + (", and in [scale] from the size of one count." if sized else "."),
        ]
    if first.rate is not None:
        lines += ["", _remarked(_rate(first.rate), "of a log without times")]
    elif first.timeless:
        lines += ["", "# No column rises as a time does; say the rate if there is none:"]
        lines += ["# " + _rate(100.0)]
    lines += ["", "[columns]", *_columns(first.guesses)]
    lines += _scales(first.guesses, "scale")
    for other in others:
        lines += ["", "[[file]]", f"name = {json.dumps(other.path.name)}", "", "[file.columns]"]
        lines += [*_columns(other.guesses), *_scales(other.guesses, "file.scale")]
    notes = [note for p in proposals for note in p.notes]
    if notes:
        lines += ["", "# What else could be meant:", *(f"# {note}" for note in notes)]
    lines += [
        "",
        "# Axes, where they are not forward-left-up and east-north-up:",
        "# [frame]",
        '# body = "frd"     # forward-right-down, or a 3 x 3 rotation',
        '# world = "ned"    # north-east-down',
    ]
    return "\n".join(lines) + "\n"


def _rate(hertz: float) -> str:
    return f'sample_rate = {{value = {hertz:g}, unit = "Hz"}}'


def _columns(guesses: Sequence[Guess]) -> list[str]:
    """A line for each column; of a unit that nobody knows, one for each that it may be."""
    lines = []
    for guess in guesses:
        if guess.unit is None:
            choices = ("count",) if guess.sizes else CHOICES[guess.group]
            lines += [_remarked(f"# {_line(guess, u)}", guess.why) for u in choices]
            continue
        unit = guess.unit if guess.value is None else "count"
        lines.append(_remarked(_line(guess, unit), guess.why))
    return lines


def _line(guess: Guess, unit: str) -> str:
    cell = json.dumps(guess.cell, ensure_ascii=False)
    return f"{cell} = {json.dumps(f'{guess.target} [{unit}]')}"


def _remarked(line: str, why: str) -> str:
    return f"{line:{WIDTH}}  # {' '.join(why.split())}"


def _scales(guesses: Sequence[Guess], table: str) -> list[str]:
    sizes = {g.group: g for g in guesses if g.value is not None}
    lines = [
        _remarked(f'{group} = {{value = {g.value!r}, unit = "{g.unit}"}}', "of one count")
        for group, g in sizes.items()
    ]
    open_sizes = {g.group: g for g in guesses if g.sizes}
    lines += [
        _remarked(
            f'# {group} = {{value = {size:.10g}, unit = "deg/s"}}',
            f"{1 / size:.4g} LSB/(deg/s), {1000 * size:.4g} mdps/LSB",
        )
        for group, g in open_sizes.items()
        for size in g.sizes
    ]
    return ["", f"[{table}]", *lines] if lines else []
