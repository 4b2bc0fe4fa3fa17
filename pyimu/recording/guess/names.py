"""What the name of a column in a foreign log says: a quantity, an axis, a unit."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from pyimu.recording.spelling import unit_of

STRONG = {
    "gyro": {"gyr", "gyro", "gyros", "gyroscope", "omega", "angvel"},
    "accel": {"acc", "accel", "accelerometer", "acceleration"},
    "mag": {"mag", "magn", "magnetometer", "magnetic"},
}
"""Words that say what a vector is."""

PAIRS = {"gyro": ({"angular", "rotation"}, {"velocity", "rate", "vel"})}
"""Words that say it together."""

WEAK = {"gyro": {"w", "g"}, "accel": {"a", "f"}, "mag": {"m", "b"}}
"""Letters that may stand for it, where they are the first word of the name."""

TIMES = {"time", "timestamp", "stamp", "t", "ts", "clock"}
"""Words for times; with ``sampletimefine``, ``seconds`` and ``epoch`` they are many."""

TEMPERATURES = {"temp", "temperature", "celsius", "imutemp"}

TRUTHS = {"ref", "reference", "vicon", "opt", "optical", "omc", "mocap", "truth", "groundtruth"} | {
    "gt",
    "optitrack",
    "qualisys",
}
"""Words for a reference."""

DERIVED = (
    {"est", "estimated", "estimate", "filtered", "filt", "user", "free", "gravity", "global"}
    | {"world", "bias", "cov", "covariance", "var", "std", "offset", "err", "error", "delta"}
    | {"dv", "dq", "increment", "set", "cmd", "target", "kalman", "fused", "uncalibrated", "lin"}
)
"""Words for what is no raw sample."""

RAW = {"raw"}

_WORD = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")
_STATED = re.compile(r"\s*(?:\(([^()]*)\)|\[([^\[\]]*)\]|\{([^{}]*)\})\s*$")


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
        words = set(self.words)
        return not self.axis and bool(words & (TIMES | {"seconds", "epoch", "sampletimefine"}))

    @property
    def is_temperature(self) -> bool:
        return not self.axis and bool(set(self.words) & TEMPERATURES)

    def of(self, group: str) -> int:
        """How surely the name is one of ``group``: 0 not at all, 1 by a letter, 2 by a word."""
        words = set(self.words)
        if words & STRONG[group]:
            return 2
        if group in PAIRS and all(words & some for some in PAIRS[group]):
            return 2
        return int(bool(self.words) and self.words[0] in WEAK[group] and len(self.words) < 4)


def named(cell: str) -> Name:
    """What a header's ``cell`` says."""
    text, unit, said = cell.strip(), None, ""
    match = _STATED.search(text)
    if match and not re.fullmatch(r"\d*", (match[1] or match[2] or match[3] or "-").strip()):
        said = (match[1] or match[2] or match[3] or "").strip()
        unit, text = _unit(said, text), text[: match.start()]
    elif match and not (match[1] or match[2] or match[3]):
        unit, text = "1", text[: match.start()]
    words = [word.casefold() for word in _WORD.findall(text)]
    if unit is None and not said:
        words, unit = _without_unit(words, text)
    axis, words = _axis(words)
    return Name(cell, tuple(words), axis, unit, said or (unit or ""))


def _unit(said: str, text: str) -> str | None:
    found = unit_of(said)
    if found is None and said == "G" and "acc" in text.casefold():
        return "g"
    return "degC" if found is None and said == "C" else found


def _without_unit(words: list[str], text: str) -> tuple[list[str], str | None]:
    """The words in front of a unit that ends the name (``x_deg_per_s``), and the unit.

    A single letter is a unit only behind an axis or a word for time: ``acc_x_g``, not ``w``.
    """
    for count in (3, 2, 1):
        tail, head = words[-count:], words[:-count]
        if not head or len(tail) < count:
            continue
        unit = unit_of(" ".join(tail)) or (unit_of("/".join(tail)) if count == 2 else None)
        sure = head[-1] in set("xyz") or head[-1] in TIMES | TEMPERATURES or len(tail[-1]) > 2
        if unit and sure and not (count == 1 and tail[0] in set("xyzwtgabm1") and not sure):
            return head, unit
    return words, None


def _axis(words: list[str]) -> tuple[str, list[str]]:
    """The axis, and the words without it."""
    for at in (len(words) - 1, 0):
        if words and 0 <= at < len(words) and words[at] in ("w", "x", "y", "z"):
            if at or len(words) == 1:
                return words[at], words[:at] + words[at + 1 :]
    if words and words[-1] in ("0", "1", "2", "3") and len(words) > 1:
        return "xyz?"[int(words[-1])] if words[-1] != "3" else "3", words[:-1]
    if words:
        match = re.fullmatch(r"(gyro?|acce?l?|mag|[gwamqf])_?([wxyz])", words[-1])
        if match:
            return match[2], [*words[:-1], match[1]]
    return "", words


@dataclass(frozen=True)
class Triad:
    """Positions of the x, y and z columns of one vector, and how surely it is of ``group``."""

    group: str
    names: tuple[Name, Name, Name]
    positions: tuple[int, int, int]
    score: int

    @property
    def unit(self) -> str | None:
        """The unit that all three state."""
        units = {name.unit for name in self.names}
        return units.pop() if len(units) == 1 else None


def triads(header: Sequence[str], file: str = "") -> list[Triad]:
    """The vectors in a header, those that are the surest first.

    Of columns that are called by their axis alone the name of the ``file`` says what they are.
    """
    stems: dict[tuple[str, ...], dict[str, int]] = {}
    names = [named(cell) for cell in header]
    hint = tuple(word.casefold() for word in _WORD.findall(file.partition(".")[0]))
    names = [n if n.words or not n.axis else replace(n, words=hint) for n in names]
    for position, name in enumerate(names):
        if name.axis:
            stems.setdefault(name.words, {}).setdefault(name.axis, position)
    found = []
    for stem, axes in stems.items():
        if not all(axis in axes for axis in "xyz") or "w" in axes or "3" in axes:
            continue
        at = tuple(axes[axis] for axis in "xyz")
        three = tuple(names[k] for k in at)
        for group in STRONG:
            score = 2 * three[0].of(group)
            if score:
                score += bool(set(stem) & RAW) - 3 * bool(set(stem) & (DERIVED | TRUTHS))
                found.append(Triad(group, three, at, score))  # type: ignore[arg-type]
    return sorted(found, key=lambda triad: -triad.score)


def surest(found: Iterable[Triad], group: str) -> tuple[Triad | None, list[Triad]]:
    """The surest vector of a group, and the others that may be it."""
    own = [triad for triad in found if triad.group == group and triad.score > 0]
    return (own[0], own[1:]) if own else (None, [])


def attitude(header: Sequence[str]) -> dict[str, int] | None:
    """Positions of w, x, y, z of a reference's quaternion, None where there is none or several."""
    stems: dict[tuple[str, ...], dict[str, int]] = {}
    for position, cell in enumerate(header):
        name = named(cell)
        if name.axis and set(name.words) & TRUTHS:
            stems.setdefault(name.words, {})[name.axis] = position
    whole = [axes for axes in stems.values() if all(a in axes for a in "wxyz")]
    return whole[0] if len(whole) == 1 else None
