"""What the name of a column in a foreign log says: a quantity, an axis, a unit."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from pyimu.recording.naming.endings import GLUED, in_brackets, in_words
from pyimu.recording.naming.languages import in_english
from pyimu.recording.naming.words import (
    BEHIND,
    CLOCKS,
    DERIVED,
    INERTIAL,
    LETTERS,
    MORE_TIMES,
    PAIRS,
    PERIODS,
    ROLLS,
    SAID_OF_AXES,
    SIDES,
    STEPS,
    STRONG,
    SUMMED,
    TEMPERATURES,
    TICKS,
    TIMES,
    UNITS_ALONE,
    UNITS_OF_SEVERAL,
    WEAK,
)
from pyimu.recording.spelling import unit_of
from pyimu.units import DEGREES, Unit, parse

_AXIS_FIRST = re.compile(r"([xyz])(gyro?s?|gyroscope|acce?l?|acceleration|mag)")
_TURN = re.compile(r"(roll|pitch|yaw)(rate|speed|vel|dot)", re.I)
_DELTA = re.compile("[\u0394\u2206]")
WORD = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")


@dataclass(frozen=True)
class Name:
    """A column's name: ``words`` without axis and unit, the ``axis`` (w, x, y, z), the ``unit``.

    ``unit`` is a spelling of ``pyimu.units``, None where none is stated; ``said`` is what stands
    there.
    """

    cell: str
    words: tuple[str, ...]
    axis: str = ""
    unit: str | None = None
    said: str = ""

    @property
    def is_time(self) -> bool:
        """Whether it is called a time, none between rows, and is in no unit that is none of times:
        ``T(°)``; ``Chip Time()`` is one, and ``ms``.
        """
        other = self.unit not in (None, "1") and self.clock is None
        steps = set(self.words) & STEPS and self.words[: len(SUMMED)] != SUMMED
        if self.axis or other or steps:
            return False
        if len(self.words) == 1 and self.words[0] in UNITS_ALONE:
            return True
        return bool(set(self.words) & (TIMES | MORE_TIMES | set(TICKS)))

    @property
    def clock(self) -> str | None:
        """The stated unit as one of ``CLOCKS``: us of µs, s of sec; None where it is none."""
        stated = None if self.unit is None else parse(self.unit)
        return next((c for c in CLOCKS if stated and _same(stated, parse(c))), None)

    @property
    def is_temperature(self) -> bool:
        """Whether it is called one, or is in a unit that nothing else has."""
        called = bool(set(self.words) & TEMPERATURES)
        return not self.axis and (called or self.unit in DEGREES)

    def of(self, group: str) -> int:
        """How surely the name is one of ``group``: 0 not at all, 1 by a letter, 2 by a word."""
        words = set(self.words)
        if words & STRONG[group]:
            return 2
        if group in PAIRS and all(words & some for some in PAIRS[group]):
            return 2
        own = _without_sensor(self.words)
        return int(bool(own) and own[0] in WEAK[group] and len(own) < 4)


def _without_sensor(words: tuple[str, ...]) -> tuple[str, ...]:
    """The words behind those that say which of several sensors it is."""
    of_one = (k for k, w in enumerate(words) if w not in UNITS_OF_SEVERAL and not w.isdigit())
    return words[next(of_one, 0) :]


def _same(one: Unit, other: Unit) -> bool:
    return (one.factor, one.dimension) == (other.factor, other.dimension)


def named(cell: str) -> Name:
    """What a header's ``cell`` says."""
    text, unit, said = _DELTA.sub("delta ", cell.strip()), None, ""
    stated = in_brackets(text)
    if stated is not None and not stated[1]:
        text, unit = stated[0], "1"
    elif stated is not None and not stated[1].isdigit():
        text, said = in_english(stated[0]), stated[1]
        unit = _unit(said, text)
        text = _remark_first(text) if unit is not None else text
    text = in_english(text)
    words = [word.casefold() for word in WORD.findall(_TURN.sub(r"\1 \2", text))]
    if unit is None and not said:
        words, unit = in_words(words, {*"xyz", *ROLLS, *TIMES, *PERIODS, *TEMPERATURES})
    if unit is None and not said and words and words[-1] in TICKS:
        unit = TICKS[words[-1]]
    if unit is None and not said and len(words) == 1:
        unit = UNITS_ALONE.get(words[0])
    if unit is None and not said and set(words[:-1]) & TEMPERATURES and words[-1] in LETTERS:
        unit = LETTERS[words.pop()]
    axis, words = _axis(words)
    words = ["gforce"] if words in (["g", "f"], ["g", "force"]) else words
    return Name(cell, tuple(words), axis, unit, said or (unit or ""))


def _remark_first(text: str) -> str:
    """A name with what stands in brackets at its end in front of it: ``ACC 1.X (IM)`` is an x."""
    remark = in_brackets(text)
    words = remark is not None and remark[1][:1].isalpha()  # an index is none: accel[0]
    return f"{remark[1]} {remark[0]}" if remark is not None and words else text


def thermometer(names: Iterable[Name]) -> Name | None:
    """The temperature of the sensors: the only one there, or the only one named as theirs."""
    there = [n for n in names if n.is_temperature and not set(n.words) & DERIVED]
    if len(there) > 1:
        own = INERTIAL | STRONG["gyro"] | STRONG["accel"]
        there = [n for n in there if set(n.words) & own]
    return there[0] if len(there) == 1 else None


ELEMENTS = {f"{zero}{k}" for zero in ("", "0") for k in range(4)}
"""Numbers of a vector's elements: ``accel[0]``, ``accel.00`` of PlotJuggler."""

EITHER = {"G": ("g", "gauss"), "mG": ("mg", "mgauss")}
"""Units that mean gravity of an accelerometer, and the field of a magnetometer."""


def _unit(said: str, text: str) -> str | None:
    found = unit_of(said)
    if found is None and said in EITHER:
        _, words = _axis([word.casefold() for word in WORD.findall(text)])
        name = Name(text, tuple(words))
        sure = {group: name.of(group) for group in ("accel", "mag")}
        if max(sure.values()) > min(sure.values()):
            return EITHER[said][sure["mag"] > sure["accel"]]
    return {"C": "degC", "F": "degF"}.get(said) if found is None else found


def _ends_in_axis(words: list[str]) -> bool:
    """Whether a number behind the words is a sensor's, as there is an axis before it."""
    if words[-1] in ("w", "x", "y", "z"):
        return len(words) > 1
    rest = Name("", tuple(words[1:]))
    first = words[0] in ("x", "y", "z") and any(rest.of(group) > 1 for group in STRONG)
    return first or GLUED.fullmatch(words[-1]) is not None


def _axis(words: list[str]) -> tuple[str, list[str]]:
    """The axis, and the words without it.

    A number behind the axis, or a word for a place, is a sensor's: ``ACC.X 1``, ``ax_L``.
    """
    words = [word for word in words if word not in SAID_OF_AXES] if len(words) > 1 else words
    if len(words) > 1 and words[-1] in BEHIND:
        words = [words[-1], *words[:-1]]
    if len(words) > 1 and (words[-1].isdigit() or words[-1] in SIDES) and _ends_in_axis(words[:-1]):
        words = [SIDES.get(words[-1], words[-1]), *words[:-1]]
    for at in (len(words) - 1, 0):
        if words and 0 <= at < len(words) and words[at] in ("w", "x", "y", "z"):
            if at or len(words) == 1:
                return words[at], words[:at] + words[at + 1 :]
    if len(words) > 1 and words[-1] in ELEMENTS:
        return "xyz3"[int(words[-1])], words[:-1]
    if words:
        match = GLUED.fullmatch(words[-1])
        if match:
            return match[2], [*words[:-1], match[1]]
        for count in (1, 2):
            match = _AXIS_FIRST.fullmatch("".join(words[-count:]))
            if match:
                return match[1], [*words[:-count], match[2]]
        for count in (1, 2):
            match = _AXIS_FIRST.fullmatch("".join(words[:count]))
            if match and len(words) > count:
                return match[1], [match[2], *words[count:]]
        rest = Name("", tuple(words[1:]))
        if words[0] in ("x", "y", "z") and max(rest.of(group) for group in STRONG) > 1:
            return words[0], words[1:]
    return "", words
