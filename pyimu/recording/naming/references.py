"""References among the names of columns: attitudes, angles and places."""

from __future__ import annotations

import re
from collections.abc import Sequence

from pyimu.recording.naming.name import WORD, named
from pyimu.recording.naming.words import DERIVED, TRUTHS
from pyimu.units import same_dimension

_COUNTED = re.compile(r"(.*[A-Za-z])[_. ]?([0-3])(?: *\[1?\])?")
_SPOT = re.compile(r"((?:.*[^A-Za-z])?(?:t|p|pos|position|trans|translation)[._ /]?|)([xyz])", re.I)


def attitude(header: Sequence[str]) -> dict[str, int] | None:
    """Positions of w, x, y, z of a reference's quaternion, None where there is none or several."""
    whole = [at for words, at in _fours(header) if set(words) & TRUTHS]
    return whole[0] if len(whole) == 1 else None


def quaternions(header: Sequence[str]) -> list[dict[str, int]]:
    """Positions of w, x, y, z of what may be quaternions: four columns of one name.

    It is also q0 to q3. What is called an estimate is none.
    """
    return [at for words, at in _fours(header) if not set(words) & DERIVED]


def _fours(header: Sequence[str]) -> list[tuple[tuple[str, ...], dict[str, int]]]:
    """The words of four columns of one name, and the positions of w, x, y, z."""
    stems: dict[tuple[str, ...], dict[str, int]] = {}
    for position, cell in enumerate(header):
        words, axis = _counted(cell) or (named(cell).words, named(cell).axis)
        if axis:
            stems.setdefault(words, {})[axis] = position
    return [(words, axes) for words, axes in stems.items() if set(axes) == set("wxyz")]


def _counted(cell: str) -> tuple[tuple[str, ...], str] | None:
    """The words and the axis of a column of a quaternion that counts: ``q0`` to ``q3``."""
    match = _COUNTED.fullmatch(cell.strip())
    if match is None:
        return None
    return tuple(word.casefold() for word in WORD.findall(match[1])), "wxyz"[int(match[2])]


TURNS = {"roll": "ref_roll", "pitch": "ref_pitch", "yaw": "ref_yaw", "heading": "ref_yaw"}
"""Words for the angles of an attitude."""

AROUND = {"angle", "euler", "rpy", "att", "attitude", "orientation", "pose"}
"""Words that may stand beside one of them."""


def angles(header: Sequence[str]) -> dict[str, int]:
    """Positions of roll, pitch and yaw by ``ref_roll`` and so on, of a reference where several have
    such names; empty where not all three are there.
    """
    found: dict[bool, dict[str, int]] = {True: {}, False: {}}
    for position, cell in enumerate(header):
        words = set(named(cell).words)
        turn = words & set(TURNS)
        if len(turn) == 1 and not words - turn - AROUND - TRUTHS:
            target = TURNS[turn.pop()]
            found[bool(words & TRUTHS)].setdefault(target, position)
    whole = [at for at in (found[True], found[False]) if len(at) == 3]
    return whole[0] if whole else {}


def is_truth(cell: str) -> bool:
    """Whether a column is called a reference."""
    return bool(set(named(cell).words) & TRUTHS)


PLACES = {"north": "ref_north", "east": "ref_east", "down": "ref_down", "up": "ref_up"}
"""Words for a place; one of them alone, or beside a word for a position."""


def places(header: Sequence[str]) -> dict[str, int]:
    """Positions of a reference's place by ``ref_north`` and so on, empty without north and east."""
    found: dict[str, int] = {}
    for position, cell in enumerate(header):
        name = named(cell)
        words = set(name.words)
        place = words & set(PLACES)
        of_length = name.unit is None or same_dimension(name.unit, "m")
        if len(place) == 1 and of_length and not words - place - {"pos", "position", *TRUTHS}:
            found.setdefault(PLACES[place.pop()], position)
    return found if {"ref_north", "ref_east"} <= set(found) else {}


def spots(header: Sequence[str]) -> dict[str, int]:
    """Positions of a place along x, y and z by ``ref_east`` and so on, as tables of an attitude and
    a place have it (``tx``, ``p_x``, ``translation.x``, ``x``); empty where none or several are
    there.
    """
    stems: dict[str, dict[str, int]] = {}
    for position, cell in enumerate(header):
        match = _SPOT.fullmatch(re.sub(r"\s*[\[(].*", "", cell).strip("#% "))
        unit = named(cell).unit
        if match and (unit is None or same_dimension(unit, "m")):
            stems.setdefault(match[1].casefold(), {})[match[2].casefold()] = position
    whole = [axes for axes in stems.values() if len(axes) == 3]
    if len(whole) != 1:
        return {}
    axes = {"ref_east": "x", "ref_north": "y", "ref_up": "z"}
    return {target: whole[0][axis] for target, axis in axes.items()}
