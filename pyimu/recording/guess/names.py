"""What the name of a column in a foreign log says: a quantity, an axis, a unit."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from pyimu.recording.guess.endings import GLUED, fits, in_brackets, in_words
from pyimu.recording.languages import in_english
from pyimu.recording.spelling import unit_of
from pyimu.units import DEGREES, Unit, parse, same_dimension

STRONG = {
    "gyro": {"gyr", "gyro", "gyros", "gyroscope", "omega", "angvel"},
    "accel": {"acc", "acce", "accel", "accl", "accelerometer", "acceleration", "gforce"},
    "mag": {"mag", "magn", "magnetometer", "magnetic"},
}
"""Words that say what a vector is."""

PAIRS = {"gyro": ({"angular", "ang", "rotation", "turn"}, {"velocity", "rate", "rates", "vel"})}
"""Words that say it together."""

ROLLS = {"p": "x", "q": "y", "r": "z"}
"""The rates about the axes, as aeroplanes have them, where all three are there."""

RATED = {"roll": "x", "pitch": "y", "yaw": "z"}
"""Words for the axes before one for a rate, as vehicles have them: ``YawRate``."""

WEAK = {
    "gyro": {"w", "g", "gy", "rate", "rates", "pqr"},
    "accel": {"a", "ac", "f"},
    "mag": {"m", "b", "h"},
}
"""Letters and words that may stand for it, where they are the first word of the name."""

TIMES = {"time", "times", "timestamp", "timestamps", "stamp", "stamps", "t", "ts", "clock"}
"""Words for times, behind which a unit of few letters is one."""

MORE_TIMES = {"seconds", "epoch", "epoc", "elapsed", "sampletimefine", "tow"}
"""Further ones: ``tow`` is the time of the week of satellites."""

TICKS = {"millis": "ms", "micros": "us", "nanos": "ns", "cts": "ms"}
"""Words for times that say their unit, as Arduino's functions are called; ``cts`` is that of a
camera's film in the tables that are made of GoPro's."""

STEPS = {"delta", "diff", "interval"}
"""Words beside those of times for the time from row to row."""

COUNTERS = {"tick", "ticks", "counter", "count"}
"""Words beside those of times for one that counts in a unit of its own, such as DJI's
``Clock:Tick#``."""

CLOCKS = ("s", "ms", "us", "ns", "min", "h", "day")
"""Units of times."""

TEMPERATURES = {"temp", "temperature", "celsius", "imutemp"}

LETTERS = {"c": "degC", "k": "K"}
"""Letters for the unit of a temperature, where they end its name: ``temp_c``."""

INERTIAL = {"imu", "mpu", "mems", "inertial", "imutemp"}
"""Words for the unit whose thermometer it is, beside those of its sensors."""

TRUTHS = {"ref", "reference", "vicon", "opt", "optical", "omc", "mocap", "truth", "groundtruth"} | {
    "gt",
    "optitrack",
    "qualisys",
}
"""Words for a reference."""

DERIVED = (
    {"est", "estimated", "estimate", "filtered", "filt", "user", "free", "gravity", "global"}
    | {"world", "bias", "cov", "covariance", "var", "std", "offset", "err", "error", "delta"}
    | {
        "low",
        "lower",
        "dv",
        "dq",
        "increment",
        "set",
        "cmd",
        "target",
        "kalman",
        "fused",
        "uncalibrated",
        "lin",
    }
)
"""Words for what is no raw sample; ``low`` is the lower half of a number of 32 bits."""

NO_SAMPLES = DERIVED | TRUTHS
"""Words for what no sensor measures."""

RAW = {"raw"}

SAID_OF_AXES = {"axis", "axes", "value", "values"}
"""Words beside an axis that say nothing."""

BEHIND = {"cal", "calibrated", "raw"}
"""Words that may stand behind the axis."""

LINEAR = {"linear", "lin", "linacc", "linacce"}
"""Words for a force without gravity, where one with it is beside it; ROS calls a force so that is
alone."""

ELSE = {"pos", "position", "vel", "velocity", "speed", "angle", "euler"}
"""Words for vectors that no inertial sensor measures."""

ONE_VECTOR = [f"column {k}" for k in range(1, 5)]
"""A table without names of a time and a vector, which its file's name may tell: ``gyro.csv``; the
time may be missing."""

TOLD_BY_UNIT = ("gyro", "mag")
"""Vectors whose units nothing else has, whatever its name: ``AsX(°/s)``, ``HX(uT)``."""

_AXIS_FIRST = re.compile(r"([xyz])(gyro?s?|gyroscope|acce?l?|acceleration|mag)")
_COUNTED = re.compile(r"(.*[A-Za-z])[_. ]?([0-3])(?: *\[1?\])?")
_SPOT = re.compile(r"((?:.*[^A-Za-z])?(?:t|p|pos|position|trans|translation)[._ /]?|)([xyz])", re.I)
_WORD = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")


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
        ``T(°)``.
        """
        other = self.unit is not None and self.clock is None
        if self.axis or other or set(self.words) & STEPS:
            return False
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
        return int(bool(self.words) and self.words[0] in WEAK[group] and len(self.words) < 4)


def _same(one: Unit, other: Unit) -> bool:
    return (one.factor, one.dimension) == (other.factor, other.dimension)


def named(cell: str) -> Name:
    """What a header's ``cell`` says."""
    text, unit, said = cell.strip(), None, ""
    stated = in_brackets(text)
    if stated is not None and not stated[1]:
        text, unit = stated[0], "1"
    elif stated is not None and not stated[1].isdigit():
        text, said = in_english(stated[0]), stated[1]
        unit = _unit(said, text)
        text = _remark_first(text) if unit is not None else text
    text = in_english(text)
    words = [word.casefold() for word in _WORD.findall(text)]
    if unit is None and not said:
        words, unit = in_words(words, {*"xyz", *ROLLS, *TIMES, *TEMPERATURES})
    if unit is None and not said and words and words[-1] in TICKS:
        unit = TICKS[words[-1]]
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


EITHER = {"G": ("g", "gauss"), "mG": ("mg", "mgauss")}
"""Units that mean gravity of an accelerometer, and the field of a magnetometer."""


def _unit(said: str, text: str) -> str | None:
    found = unit_of(said)
    if found is None and said in EITHER:
        _, words = _axis([word.casefold() for word in _WORD.findall(text)])
        name = Name(text, tuple(words))
        sure = {group: name.of(group) for group in ("accel", "mag")}
        if max(sure.values()) > min(sure.values()):
            return EITHER[said][sure["mag"] > sure["accel"]]
    return "degC" if found is None and said == "C" else found


def _axis(words: list[str]) -> tuple[str, list[str]]:
    """The axis, and the words without it.

    A number behind the axis is a sensor's: ``ACC.X 1``.
    """
    words = [word for word in words if word not in SAID_OF_AXES] if len(words) > 1 else words
    if len(words) > 1 and words[-1] in BEHIND:
        words = [words[-1], *words[:-1]]
    if len(words) > 2 and words[-1].isdigit() and words[-2] in ("w", "x", "y", "z"):
        words = [words[-1], *words[:-1]]
    for at in (len(words) - 1, 0):
        if words and 0 <= at < len(words) and words[at] in ("w", "x", "y", "z"):
            if at or len(words) == 1:
                return words[at], words[:at] + words[at + 1 :]
    if words and words[-1] in ("0", "1", "2", "3") and len(words) > 1:
        return "xyz?"[int(words[-1])] if words[-1] != "3" else "3", words[:-1]
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


@dataclass(frozen=True)
class Triad:
    """Positions of the x, y and z columns of one vector, and how surely it is of ``group``."""

    group: str
    names: tuple[Name, Name, Name]
    positions: tuple[int, int, int]
    score: int

    @property
    def unit(self) -> str | None:
        """The unit that all three state, None where it is none of such a vector."""
        units = {name.unit for name in self.names}
        unit = units.pop() if len(units) == 1 else None
        return unit if unit is not None and fits(unit, self.group) else None


def triads(header: Sequence[str], file: str = "") -> list[Triad]:
    """The vectors in a header, those that are the surest first.

    Of columns that are called by their axis alone the name of the ``file`` says what they are, or
    else their unit.
    """
    stems: dict[tuple[str, ...], dict[str, int]] = {}
    names = [named(cell) for cell in header]
    hint = tuple(word.casefold() for word in _WORD.findall(file.partition(".")[0]))
    names = [n if n.words or not n.axis else replace(n, words=hint) for n in names]
    if [name.cell for name in names] in (ONE_VECTOR, ONE_VECTOR[:3]):
        pairs = zip(names[-3:], "xyz", strict=True)
        names = [*names[:-3], *(replace(n, words=hint, axis=a) for n, a in pairs)]
    names = _with_turns(_with_rolls(_with_elements(names)))
    for position, name in enumerate(names):
        if name.axis:
            stems.setdefault(name.words, {}).setdefault(name.axis, position)
    found, by_unit = [], []
    for stem, axes in stems.items():
        if not all(axis in axes for axis in "xyz") or "w" in axes or "3" in axes:
            continue
        at = (axes["x"], axes["y"], axes["z"])
        three = (names[at[0]], names[at[1]], names[at[2]])
        sure = {group: three[0].of(group) for group in STRONG}
        for group in STRONG:
            score = 2 * _sureness(three, group, sure, stem in ((), hint))
            if score:
                score += bool(set(stem) & RAW) - 3 * bool(set(stem) & (DERIVED | TRUTHS))
                found.append(Triad(group, three, at, score))
        if stem not in ((), hint) and not any(sure.values()) and not set(stem) & NO_SAMPLES:
            by_unit += [Triad(g, three, at, 4) for g in TOLD_BY_UNIT if _fit(three, g)]
    there = {triad.group for triad in found if triad.score > 0}
    found += [triad for triad in by_unit if triad.group not in there]
    return sorted(found, key=lambda triad: -triad.score)


def _fit(three: Sequence[Name], group: str) -> bool:
    """Whether three columns state units that a vector of ``group`` can have."""
    return all(name.unit is not None and fits(name.unit, group) for name in three)


def _sureness(three: Sequence[Name], group: str, sure: Mapping[str, int], nameless: bool) -> int:
    """How surely three columns are of ``group``: 0 to 2, as ``Name.of``, whose words are ``sure``.

    A unit that fits is as good as a word beside a letter, as in ``wx(deg/s)``; ``nameless`` columns
    are what their unit says, less surely.
    """
    if any(sure.values()):
        return 2 if sure[group] and _fit(three, group) else sure[group]
    return int(nameless and _fit(three, group))


def _with_elements(names: Sequence[Name]) -> list[Name]:
    """The names; two columns that are called 1 and 2 are further elements of the one before them,
    as in old tables of GoPro's: ``Gyroscope [rad/s]``, ``1``, ``2``.
    """
    found = list(names)
    for k in range(len(names) - 2):
        first, *others = names[k : k + 3]
        if first.words and not first.axis and [n.cell.strip() for n in others] == ["1", "2"]:
            three = zip((first, *others), "xyz", strict=True)
            found[k : k + 3] = [replace(first, cell=n.cell, axis=a) for n, a in three]
    return found


def are_alike(names: Sequence[Name]) -> bool:
    """Whether names may be those of one vector: what words of three letters they have are the same
    ones. A track, a speed and a rate of climb are none.
    """
    long = [{w for w in name.words if len(w) > 2 and not w.isdigit()} for name in names]
    return all(words == long[0] for words in long)


def _with_rolls(names: Sequence[Name]) -> list[Name]:
    """The names; ``p``, ``q`` and ``r`` are axes where all three are there."""
    rolls = [(n.words[:-1], n.words[-1]) for n in names if not n.axis and n.words]
    whole = {stem for stem, _ in rolls if all((stem, letter) in rolls for letter in ROLLS)}
    return [
        replace(n, words=(*n.words[:-1], "pqr"), axis=ROLLS[n.words[-1]])
        if not n.axis and n.words and n.words[-1] in ROLLS and n.words[:-1] in whole
        else n
        for n in names
    ]


def _with_turns(names: Sequence[Name]) -> list[Name]:
    """The names; of three rates of roll, pitch and yaw these are the axes."""
    found, rates = list(names), PAIRS["gyro"][1]
    stems: dict[tuple[str, ...], dict[str, int]] = {}
    for position, name in enumerate(names):
        turn = next((word for word in name.words if word in RATED), None)
        if turn is not None and not name.axis and set(name.words) & rates:
            rest = tuple(word for word in name.words if word != turn)
            stems.setdefault(rest, {}).setdefault(RATED[turn], position)
    for rest, axes in stems.items():
        for axis, position in axes.items() if len(axes) == 3 else ():
            found[position] = replace(names[position], words=("angular", *rest), axis=axis)
    return found


def others(header: Sequence[str], taken: Iterable[int]) -> list[tuple[int, int, int]]:
    """Positions of the vectors in a header that no word tells of, those of ``taken`` left out."""
    away, known = set(taken), DERIVED | TRUTHS | ELSE
    names = enumerate(_with_turns(_with_rolls([named(cell) for cell in header])))
    return vectors({k: n for k, n in names if k not in away and not set(n.words) & known})


def vectors(names: Mapping[int, Name]) -> list[tuple[int, int, int]]:
    """Positions of the vectors among names by their positions: x, y and z of one name, and no other
    axis.
    """
    stems: dict[tuple[str, ...], dict[str, int]] = {}
    for position, name in names.items():
        if name.axis:
            stems.setdefault(name.words, {}).setdefault(name.axis, position)
    whole = [axes for axes in stems.values() if set(axes) == set("xyz")]
    return [(axes["x"], axes["y"], axes["z"]) for axes in whole]


def surest(found: Iterable[Triad], group: str) -> tuple[Triad | None, list[Triad]]:
    """The surest vector of a group, and the others that may be it.

    A force that is called linear is none of them beside one that is not.
    """
    own = [triad for triad in found if triad.group == group and triad.score > 0]
    whole = [triad for triad in own if not set(triad.names[0].words) & LINEAR]
    own = whole if whole and group == "accel" else own
    return (own[0], own[1:]) if own else (None, [])


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
    return tuple(word.casefold() for word in _WORD.findall(match[1])), "wxyz"[int(match[2])]


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
