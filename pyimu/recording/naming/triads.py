"""Vectors among the names of columns: gyro, accelerometer and magnetometer."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from pyimu.recording.naming.endings import fits
from pyimu.recording.naming.name import EITHER, WORD, Name, named
from pyimu.recording.naming.words import (
    ALONG,
    DERIVED,
    ELSE,
    HALVES,
    LINEAR,
    NO_SAMPLES,
    OF_VEHICLE,
    ONE_VECTOR,
    PAIRS,
    RATED,
    RAW,
    ROLLS,
    SPEEDS,
    STRONG,
    TOLD_BY_UNIT,
    TRUTHS,
    WEAK,
)

OF_G = (("g",), ("g", "force"))
"""Words beside those for a vehicle's axes that say an acceleration."""

OF_VECTORS = {
    *PAIRS["gyro"][0],
    *PAIRS["gyro"][1],
    *RAW,
    *DERIVED,
    *TRUTHS,
    *LINEAR,
    OF_VEHICLE,
} | {word for words in (*STRONG.values(), *WEAK.values()) for word in words}
"""Words in the names of vectors that say nothing of which of several sensors they are."""


@dataclass(frozen=True)
class Triad:
    """Positions of the x, y and z columns of one vector, and how surely it is of ``group``."""

    group: str
    names: tuple[Name, Name, Name]
    positions: tuple[int, int, int]
    score: int

    @property
    def units(self) -> tuple[str, ...] | None:
        """The units that the three state, which may differ, None where one states none, or one that
        no such vector has.
        """
        fit = _fit(self.names, self.group)
        return tuple(name.unit or "" for name in self.names) if fit else None

    @property
    def sensor(self) -> tuple[str, ...]:
        """The words for which of several sensors it is of: ``imu 1``, ``left``."""
        return tuple(word for word in self.names[0].words if word not in OF_VECTORS)

    @property
    def is_of_vehicle(self) -> bool:
        """Whether its axes are called as those of a vehicle, whose signs nobody says."""
        return OF_VEHICLE in self.names[0].words


def triads(header: Sequence[str], file: str = "") -> list[Triad]:
    """The vectors in a header, those that are the surest first.

    Of columns that are called by their axis alone the name of the ``file`` says what they are, or
    else their unit.
    """
    stems: dict[tuple[str, ...], dict[str, int]] = {}
    names = [named(cell) for cell in header]
    hint = tuple(word.casefold() for word in WORD.findall(file.partition(".")[0]))
    names = [n if n.words or not n.axis else replace(n, words=hint) for n in names]
    if [name.cell for name in names] in (ONE_VECTOR, ONE_VECTOR[:3]):
        pairs = zip(names[-3:], "xyz", strict=True)
        names = [*names[:-3], *(replace(n, words=hint, axis=a) for n, a in pairs)]
    names = _with_ways(_with_turns(_with_rolls(_with_elements(names))))
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
                score += bool(set(stem) & RAW) - 3 * _is_none(stem, DERIVED | TRUTHS)
                found.append(Triad(group, three, at, score))
        if stem not in ((), hint) and not any(sure.values()) and not _is_none(stem, NO_SAMPLES):
            groups = (g for g in TOLD_BY_UNIT if g != "accel" or not set(stem) & LINEAR)
            by_unit += [Triad(g, three, at, 4) for g in groups if _fit(three, g)]
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
    """The names; of three rates of roll, pitch and yaw, by a word or their unit, these are the
    axes.
    """
    found, rates = list(names), PAIRS["gyro"][1] | SPEEDS
    stems: dict[tuple[str, ...], dict[str, int]] = {}
    for position, name in enumerate(names):
        turn = next((word for word in name.words if word in RATED), None)
        rated = set(name.words) & rates or name.unit is not None and fits(name.unit, "gyro")
        if turn is not None and not name.axis and rated:
            rest = tuple("rate" if word in SPEEDS else word for word in name.words if word != turn)
            stems.setdefault(rest, {}).setdefault(RATED[turn], position)
    for rest, axes in stems.items():
        for axis, position in axes.items() if len(axes) == 3 else ():
            found[position] = replace(names[position], words=("angular", *rest), axis=axis)
    return found


def _with_ways(names: Sequence[Name]) -> list[Name]:
    """The names; of an inline, a lateral and a vertical acceleration these are the axes."""
    found, stems = list(names), dict[tuple[str, ...], dict[str, int]]()
    for position, name in enumerate(names):
        way = next((word for word in name.words if word in ALONG), None)
        rest = tuple(word for word in name.words if word != way)
        if way is not None and not name.axis and (set(rest) & STRONG["accel"] or rest in OF_G):
            stems.setdefault(rest, {}).setdefault(ALONG[way], position)
    for rest, axes in stems.items():
        for axis, position in axes.items() if len(axes) == 3 else ():
            words = ("accel", OF_VEHICLE, *(word for word in rest if word != "g"))
            name = names[position]
            unit = name.unit or EITHER.get(name.said, (None,))[0]
            found[position] = replace(name, words=words, axis=axis, unit=unit)
    return found


def _is_none(words: Sequence[str], known: Collection[str]) -> bool:
    """Whether words say that a vector is no raw sample: one of those ``known``, or the last."""
    return bool(set(words) & set(known) or set(words[-1:]) & HALVES)


def others(header: Sequence[str], taken: Iterable[int]) -> list[tuple[int, int, int]]:
    """Positions of the vectors in a header that no word tells of, those of ``taken`` left out."""
    away, known = set(taken), DERIVED | TRUTHS | ELSE
    names = enumerate(_with_turns(_with_rolls([named(cell) for cell in header])))
    return vectors({k: n for k, n in names if k not in away and not _is_none(n.words, known)})


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


def of_sensor(found: Iterable[Triad], sensor: str) -> list[Triad]:
    """The vectors of the sensor that is called so, among those of several."""
    wanted = {word.casefold() for word in WORD.findall(sensor)}
    return [triad for triad in found if wanted and wanted <= set(triad.sensor)]


def of_one(found: Sequence[Triad], groups: Sequence[str]) -> dict[str, tuple[Triad | None, list]]:
    """The surest vector of each of the ``groups``, and the others that may be it, all of one sensor
    where the names tell several: that of the first group there is one of.
    """
    sure = {group: surest(found, group) for group in groups}
    first = next((best for best, _ in sure.values() if best is not None), None)
    for group, (best, rivals) in sure.items():
        if best is not None and first is not None and best.sensor != first.sensor:
            same = next((t for t in rivals if t.sensor == first.sensor), best)
            sure[group] = same, [t for t in (best, *rivals) if t is not same]
    return sure


def sensors(found: Iterable[Triad]) -> list[str]:
    """The names of the sensors of which a table has vectors, where the names tell several."""
    own = [triad for triad in found if triad.group in ("gyro", "accel") and triad.score > 0]
    names = list(dict.fromkeys(" ".join(triad.sensor) for triad in own))
    whole = [n for n in names if len({t.group for t in own if " ".join(t.sensor) == n}) == 2]
    return whole if len(whole) > 1 else []
