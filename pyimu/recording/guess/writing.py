"""A proposal as the text of a column map."""

from __future__ import annotations

import json
import re
from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from pyimu.recording.columns import column_names
from pyimu.recording.guess.guessed import CHOICES, Guess, Offer, Proposal

WIDTH = 46
"""Characters in front of a remark."""


SIZED = {"gyro": ("deg/s", "(deg/s)", "mdps"), "accel": ("g", "g", "mg")}
"""The unit of a count's size, as it stands in a map and in data sheets."""


@dataclass(frozen=True)
class MapGiven:
    """A map that is there already: its ``data``, and the name of the ``file`` that it is for."""

    data: Mapping[str, Any] = field(default_factory=dict)
    file: str = ""

    def scale(self, path: Path) -> Mapping[str, Any]:
        """The sizes of counts of one of the log's files."""
        if path.name == self.file:
            return self.data.get("scale", {})
        entries = (e for e in self.data.get("file", []) if e["name"] == path.name)
        return next(entries, {}).get("scale", {})

    def files(self, known: Container[str]) -> list[Mapping[str, Any]]:
        """The further files that are none of those ``known``, and those of another topic."""
        given = self.data.get("file", [])
        return [e for e in given if "topic" in e or Path(e["name"]).name not in known]


FRAME = (
    "# Axes, where they are not forward-left-up and east-north-up:",
    "# [frame]",
    '# body = "frd"     # forward-right-down, or a 3 x 3 rotation',
    '# world = "ned"    # north-east-down: a heading, or a yaw, counts clockwise from north',
    '# q = "bn"         # a reference attitude that is world to body',
)


def text_of(proposals: Sequence[Proposal], given: MapGiven = MapGiven()) -> str:
    """The column map of a log that lies in the files of the ``proposals``, the first its own.

    What the map that was ``given`` says besides columns stands in it as it was.
    """
    first, *others = proposals
    lines = [
        f"# Column map for {first.path.name}, written by pyimu inspect: look it over, then give it",
        f"# to {first.given_to}. Behind each # stands how it was found.",
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
    if "time" in first.open_questions:
        lines += ["", "# If the times count samples, leave them out below and say the rate:"]
        lines += ["# " + _rate(100.0)]
    if "time_offset" in given.data:
        lines += ["", f"time_offset = {_value(given.data['time_offset'])}"]
    lines += ["", "[columns]", *_columns(first.guesses), *_offered(first.offers)]
    lines += _scales(first.guesses, "scale", given.scale(first.path))
    for other in others:
        lines += ["", "[[file]]", f"name = {_value(other.path.name)}"]
        lines += [f"topic = {_value(other.topic)}"] if other.topic else []
        lines += [] if other.rate is None else [_rate(other.rate)]
        lines += ["", "[file.columns]", *_columns(other.guesses), *_offered(other.offers)]
        lines += _scales(other.guesses, "file.scale", given.scale(other.path))
    for entry in given.files({p.path.name for p in proposals}):
        lines += ["", "[[file]]", *_entries(entry)]
    if first.topic and "topics" not in given.data:
        lines += ["", "[topics]", f"imu = {_value(first.topic)}"]
    if "binary" in given.data:
        lines += ["", "[binary]", *_entries(given.data["binary"])]
    if "topics" in given.data:
        lines += ["", "[topics]", *_entries(given.data["topics"])]
    with_lines = {offer.note for p in proposals for offer in p.offers}
    notes = [note for p in proposals for note in p.notes if note not in with_lines]
    if notes:
        lines += ["", "# What else could be meant:", *(f"# {note}" for note in notes)]
    frame = given.data.get("frame")
    lines += ["", *(["[frame]", *_entries(frame)] if frame else FRAME)]
    return "\n".join(lines) + "\n"


def _rate(hertz: float) -> str:
    return f'sample_rate = {{value = {hertz:g}, unit = "Hz"}}'


def _columns(guesses: Sequence[Guess]) -> list[str]:
    """A line for each column; of a unit that nobody knows, one for each that it may be."""
    lines = []
    for guess in guesses:
        if guess.unit is None:
            choices = guess.choices or (() if guess.sizes else CHOICES[guess.group])
            choices = (*choices, *(("count",) if guess.sizes else ()))
            lines += [_remarked(f"# {_line(guess, u)}", guess.why) for u in choices]
            continue
        unit = guess.unit if guess.value is None else "count"
        lines.append(_remarked(_line(guess, unit), guess.why))
    return lines


def _offered(offers: Sequence[Offer]) -> list[str]:
    """The lines for columns that are left out, each with a # before it."""
    lines = []
    for offer in offers:
        lines += ["#", f"# {offer.note}"]
        for guess in offer.guesses:
            lines += [_remarked(f"# {_line(guess, u)}", guess.why) for u in _units(guess)]
    return lines


def _units(guess: Guess) -> Sequence[str]:
    """In which units a column that is left out may be."""
    if guess.value is not None:
        return ("count",)
    return guess.choices or CHOICES[guess.group] if guess.unit is None else (guess.unit,)


def _line(guess: Guess, unit: str) -> str:
    return f"{_value(guess.cell)} = {_value(f'{guess.target} [{unit}]')}"


def _remarked(line: str, why: str) -> str:
    return f"{line:{WIDTH}}  # {' '.join(why.split())}"


def _scales(guesses: Sequence[Guess], table: str, given: Mapping[str, Any]) -> list[str]:
    """The table of sizes of a count: those that were ``given`` as they were, and the others."""
    guesses = [g for g in guesses if not {g.group, g.target} & given.keys()]
    sizes = {_sized(g): g for g in guesses if g.value is not None}
    lines = _entries(given)
    lines += [
        _remarked(f'{name} = {{value = {g.value!r}, unit = "{g.unit}"}}', "of one count")
        for name, g in sizes.items()
    ]
    open_sizes = {g.group: g for g in guesses if g.sizes}
    lines += [
        _remarked(
            f'# {group} = {{value = {size:.10g}, unit = "{SIZED[group][0]}"}}',
            f"{1 / size:.4g} LSB/{SIZED[group][1]}, {1000 * size:.4g} {SIZED[group][2]}/LSB",
        )
        for group, g in open_sizes.items()
        for size in g.sizes
    ]
    return ["", f"[{table}]", *lines] if lines else []


def _sized(guess: Guess) -> str:
    """What the size of a count is said of: a group, or a column that is made into one."""
    own = guess.target == guess.group or guess.target in column_names(guess.group)
    return guess.group if own else guess.target


def _entries(table: Mapping[str, Any]) -> list[str]:
    """A line for each key of a table, what is a table in turn within its line."""
    return [f"{_key(key)} = {_value(value)}" for key, value in table.items()]


def _key(key: str) -> str:
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else _value(key)


def _value(value: Any) -> str:
    """A text, a number, a list or a table as TOML has it."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(_entries(value)) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_value, value)) + "]"
    # TOML has JSON's texts, but for one character.
    written = json.dumps(value, ensure_ascii=False)
    return written.replace("\x7f", "\\u007f") if isinstance(value, str) else written
