"""A column map for a foreign log, proposed by its header and its numbers, to be looked over."""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from pyimu.errors import UserError
from pyimu.recording.columns import ANGLES, GROUP_OF, XYZ, own_name
from pyimu.recording.counter import Unwrapped
from pyimu.recording.formats.reader import Reader
from pyimu.recording.guess.guessed import Guess, Proposal
from pyimu.recording.guess.numbers import (
    SECONDS,
    UnitGuess,
    angle_of_rate,
    angle_unit,
    counts,
    force_unit,
    middle,
    rate_unit,
    resting_size,
    time_unit,
    warmth_unit,
)
from pyimu.recording.naming.endings import fits
from pyimu.recording.naming.name import Name, named, thermometer
from pyimu.recording.naming.references import angles, attitude, is_truth, places, quaternions, spots
from pyimu.recording.naming.triads import are_alike, others, surest, triads
from pyimu.recording.naming.words import COUNTERS, TRUTHS
from pyimu.recording.optical import lines_of, question
from pyimu.units import FREEZING, same_dimension

MOST = 200_000
"""Rows that are looked at."""

UNIT_LENGTH = 0.02
"""By how much the length of a quaternion of few digits may be off one."""

EXACT = 1e-5
"""No sensor at rest stays so near to one: what does is written so, such as an attitude at rest."""

SAME_SIZE = 1e-3
"""By how much the size of a direction of few digits may differ from row to row."""

TURNED = 0.5
"""How far a vector of one size must go, as a part of it, for its size to be no sensor's: whoever
turns an accelerometer shakes it too."""

ZEROS = "every number of it is zero: was it logged?"
"""Of a vector in which nothing is to be seen."""

CLOCK = UnitGuess("s", "dates or times of day, in seconds of the first day")
"""Of a column of them."""


@dataclass(frozen=True)
class Beside:
    """Specific forces (n, 3), in any unit, in another file of a log; ``time`` (n,) s."""

    time: np.ndarray
    force: np.ndarray

    def at(self, time: np.ndarray) -> np.ndarray | None:
        """The forces at other times, NaN outside theirs; None where most of them are."""
        within = (time >= self.time[0]) & (time <= self.time[-1])
        if np.mean(within) < 0.5:
            return None
        each = [np.interp(time, self.time, f, np.nan, np.nan) for f in self.force.T]
        return np.column_stack(each)


def forces(reader: Reader, found: Proposal) -> Beside | None:
    """The specific forces in ``reader`` by what was ``found`` of it, None where it has none."""
    numbers = Numbers(reader)
    time = _seconds(found, numbers)
    cells = [g.cell for g in found.guesses if g.group == "accel"]
    if time is None or len(cells) != 3:
        return None
    force = numbers.of([found.header.index(cell) for cell in cells])
    return Beside(time, force) if len(time) == len(force) else None


def _seconds(found: Proposal, numbers: Numbers) -> np.ndarray | None:
    """The times (n,) s of a file by what was ``found`` of it, None where they are not known."""
    own = next((g for g in found.guesses if g.target == "time"), None)
    if own is None or own.unit not in SECONDS:
        return None
    values = Unwrapped(*SECONDS.values()).add(numbers.of([found.header.index(own.cell)]))
    return values.astype(float) * SECONDS[own.unit]


def proposed(reader: Reader, rate: float | None = None, beside: Beside | None = None) -> Proposal:
    """A map for the log in ``reader``, of which ``rate`` [Hz] is known if it has no times.

    The forces of another file, ``beside``, tell the gyro's unit where it has none of its own.
    Raises UserError where its numbers cannot be read.
    """
    found = Proposal(reader.path, tuple(reader.header), topic=reader.word)
    numbers = Numbers(reader)
    period = _time(found, reader, numbers, rate)
    vectors = triads(reader.header, reader.path.name)
    picked = {g: _surest(found, vectors, g) for g in ("accel", "gyro", "mag")}
    attitudes = _attitudes(reader, numbers)
    place: dict[str, int] = {}
    if picked["accel"] is None and picked["gyro"] is None:
        place = spots(reader.header) if len(attitudes) == 1 else {}
        away = {k for at in attitudes for k in at.values()} | set(angles(reader.header).values())
        place = {} if away & set(place.values()) else place
        away |= set(place.values())
        if not question(reader):
            picked |= _by_numbers(found, reader, numbers, period, away)
    for group in ("accel", "gyro"):
        if picked[group] is None and not question(reader):
            named_ones = [p for v in vectors for p in v.positions] + [*place.values()]
            picked[group] = _missing(found, group, reader, numbers, picked, period, named_ones)
    force = None if picked["accel"] is None else numbers.of([p for p, _ in picked["accel"]])
    time = None if beside is None or force is not None else _seconds(found, numbers)
    if beside is not None and time is not None:
        force = beside.at(time)
    for group in ("gyro", "accel", "mag"):
        if picked[group] is not None:
            _vector(found, group, picked[group], numbers, force, period)
    _temperature(found, reader, numbers)
    _reference(found, reader, attitudes)
    _angles(found, reader, numbers)
    _place(found, reader, place)
    _own(found, reader)
    return found


def _attitudes(reader: Reader, numbers: Numbers) -> list[dict[str, int]]:
    """Positions of w, x, y, z of the quaternions in a file: of length one in nearly every row."""
    found = []
    for at in quaternions(reader.header):
        if set(at.values()) <= set(numbers.positions):
            size = np.linalg.norm(numbers.of([at[a] for a in "wxyz"]), axis=1)
            size = size[np.isfinite(size)]
            if len(size) and np.mean(np.abs(size - 1.0) < UNIT_LENGTH) > 0.99:
                found.append(at)
    return found


class Numbers:
    """The first rows of a file's columns, read where they are asked for."""

    def __init__(self, reader: Reader) -> None:
        self._reader = reader
        self.positions = reader.numeric()

    def of(self, positions: Sequence[int]) -> np.ndarray:
        """Columns (n, k), NaN where there is no number; of integers where it is one such column."""
        pieces, rows = [], 0
        for columns, _ in self._reader.batches(list(positions), positions[0]):
            pieces.append(columns)
            rows += len(columns[0])
            if rows >= MOST:
                break
        if not pieces:
            raise UserError(f"{self._reader.path}: no rows of numbers in it")
        joined = [np.concatenate(column)[:MOST] for column in zip(*pieces, strict=True)]
        return joined[0] if len(joined) == 1 else np.column_stack([c.astype(float) for c in joined])


Picked = list[tuple[int, Name]] | None
"""Positions and names of the three columns of a vector."""


def _time(found: Proposal, reader: Reader, numbers: Numbers, rate: float | None) -> float | None:
    """Add the time, or else the ``rate``; gives the sample period [s] where it is known."""
    names = [named(cell) for cell in reader.header]
    clocks = {k for k, cell in enumerate(reader.header) if cell in reader.clocks}
    at = [k for k in numbers.positions if names[k].is_time and not set(names[k].words) & TRUTHS]
    at = at or sorted(clocks)
    if not at:
        at = [k for k in numbers.positions[:2] if _rises(numbers.of([k]))]
    candidates = []
    for k in at:
        values = Unwrapped(*SECONDS.values()).add(numbers.of([k]))
        if not names[k].is_time and _counts_rows(values):
            found.notes.append(f"{reader.header[k]} counts the rows, and is no time")
        elif _rises(values) or (k in clocks and _mean_rate(values) is not None):
            guess = CLOCK if k in clocks else _time_guess(names[k], values)
            candidates.append((k, values, guess))
    if not candidates:
        found.rate = rate or reader.rate
        return None if found.rate is None else 1 / found.rate
    k, values, guess = min(
        candidates,
        key=lambda c: (
            c[2].unit is None,
            bool(COUNTERS & set(names[c[0]].words)),
            _unevenness(c[1]),
            "stamp" not in names[c[0]].words,
            "date" not in c[2].why,
        ),
    )
    for other, _, its in candidates:
        if other != k:
            found.notes.append(f"{reader.header[other]} may be the time, too ({its.why})")
    found.add([Guess(reader.header[k], "time", guess.unit, guess.why)])
    if k in clocks and not _rises(values):  # whole seconds, which reading divides among their rows
        return 1 / (_mean_rate(values) or 1.0)
    return None if guess.unit is None else _period(values) * SECONDS[guess.unit]


def _mean_rate(values: np.ndarray) -> float | None:
    """Rows a second by times [s] that stand still for many rows, None where they fall or stay."""
    known = values[np.isfinite(values)]
    span = float(known[-1] - known[0]) if len(known) > 1 else 0.0
    return (len(known) - 1) / span if span > 0 and np.all(np.diff(known) >= 0) else None


def _rises(values: np.ndarray) -> bool:
    step = np.diff(values[np.isfinite(values.astype(float))])
    return len(step) > 1 and bool(np.all(step >= 0)) and bool(np.mean(step > 0) > 0.5)


def _counts_rows(values: np.ndarray) -> bool:
    return len(values) > 1 and bool(np.all(np.diff(values.astype(float)) == 1))


def _period(values: np.ndarray) -> float:
    step = np.diff(values)
    return float(np.median(step[step > 0]))


def _unevenness(values: np.ndarray) -> float:
    """Scatter of the steps in periods, in powers of 1.3: of two clocks that of the sensor is the
    finer one.
    """
    step = np.diff(values).astype(float)
    scatter = float(np.std(step) / max(np.median(step), 1e-300))
    return round(np.log(max(scatter, 1e-6)) / np.log(1.3))


def _time_guess(name: Name, values: np.ndarray) -> UnitGuess:
    """The stated unit, but where its rate is none that a sensor has."""
    seen = time_unit(values)
    if name.clock not in SECONDS:
        return seen
    rate = 1 / (_period(values) * SECONDS[name.clock])
    if 1e-3 <= rate <= 1e6:
        return UnitGuess(name.clock, f"the header says {name.said}; {rate:.5g} Hz")
    return replace(seen, why=f"{seen.why} (the header says {name.said}: {rate:.3g} Hz)")


def _surest(found: Proposal, vectors: list, group: str) -> Picked:
    """The surest vector of a group by names; what else could be meant goes into the notes."""
    best, others = surest(vectors, group)
    if best is None:
        return None
    for other in others:
        cells = ", ".join(name.cell for name in other.names)
        found.notes.append(f"{cells} may be the {group}, too")
    return list(zip(best.positions, best.names, strict=True))


def _by_numbers(
    found: Proposal,
    reader: Reader,
    numbers: Numbers,
    period: float | None,
    away: Container[int],
) -> dict[str, Picked]:
    """The accelerometer's three columns by the size of gravity, the gyro's by how it turns; none of
    those ``away``.
    """
    time = {g.cell for g in found.guesses}
    at = [k for k in numbers.positions if reader.header[k] not in time and k not in away]
    names = [named(cell) for cell in reader.header]
    if len(at) < 3 or len(at) > 40:
        return {"accel": None, "gyro": None}
    table = numbers.of(at).reshape(-1, len(at))
    column = {k: table[:, i] for i, k in enumerate(at)}
    moving = [k for k in at if np.nanmin(column[k]) < np.nanmax(column[k])]
    # One that never changes numbers the sensor: between vectors it is an axis of none.
    at = moving if len(moving) >= 6 else at
    runs = [at[i : i + 3] for i in range(len(at) - 2) if at[i + 2] - at[i] == 2]
    runs = [run for run in runs if are_alike([names[k] for k in run])]
    if not runs:
        return {"accel": None, "gyro": None}
    away = _unit_fours(found, reader, column)
    away |= {k for k, numbers_of_it in column.items() if _rises(numbers_of_it)}
    runs = [run for run in runs if not set(run) & away]
    values = {tuple(run): np.column_stack([column[k] for k in run]) for run in runs}
    like = [run for run in values if force_unit(values[run]).unit is not None]
    away |= _directions(found, reader, values, like)
    values = {run: v for run, v in values.items() if not set(run) & away}
    like = [run for run in like if run in values]
    # Beside three that move one that does not is no axis of a force: another channel's, or a flag.
    whole = {k for run in values if set(run) <= set(moving) for k in run}
    like = [run for run in like if set(run) <= set(moving) or not set(run) & whole]
    if not like:
        _without_sign(found, reader, values)
        return {"accel": None, "gyro": None}
    home = {_array(cell) for cell in time}
    accel = min(like, key=lambda r: (_array(reader.header[r[0]]) not in home, _scatter(values[r])))
    home = {_array(reader.header[accel[0]])}
    apart = {k: i for i, k in enumerate(at)}
    rest = [run for run in values if not set(run) & set(accel)]
    rest = [run for run in rest if abs(apart[run[0]] - apart[accel[0]]) % 3 == 0]
    rest.sort(key=lambda run: _array(reader.header[run[0]]) not in home)
    turning = [r for r in rest if rate_unit(values[r], values[accel], period).unit is not None]
    gyro = next(iter(turning or rest), None)
    picked: dict[str, Picked] = {"accel": [(k, names[k]) for k in accel], "gyro": None}
    if gyro is not None:
        picked["gyro"] = [(k, names[k]) for k in gyro]
    found.notes.append("accelerometer and gyro were told by their numbers alone: look at them")
    return picked


def _without_sign(
    found: Proposal, reader: Reader, values: Mapping[tuple[int, ...], np.ndarray]
) -> None:
    """Note the first vector of counts that may be a force's and have no sign."""
    for run, vector in values.items():
        if middle(vector) is not None:
            cells = ", ".join(reader.header[k] for k in run)
            found.notes.append(f"{cells} may be the accel: {force_unit(vector).why}")
            return


def _array(cell: str) -> str:
    """The array of a file of arrays whose column a ``cell`` is; of a table's it is none."""
    return cell.rpartition("[")[0]


def _directions(
    found: Proposal,
    reader: Reader,
    values: Mapping[tuple[int, ...], np.ndarray],
    like: Sequence[tuple[int, ...]],
) -> set[int]:
    """Positions in those of the vectors ``like`` a force that keep one size however they turn.

    So does the direction of gravity that a phone's filter makes; that it is left out is noted.
    """
    away: set[int] = set()
    for run in like:
        if not set(run) & away and _is_direction(values[run]):
            away |= set(run)
            cells = ", ".join(reader.header[k] for k in run)
            found.notes.append(
                f"{cells} are left out: they turn and keep their size, as the direction of gravity "
                "that a filter makes does; an accelerometer is shaken too"
            )
    return away


def _is_direction(vector: np.ndarray) -> bool:
    known = vector[np.all(np.isfinite(vector), axis=1)]
    size = np.linalg.norm(known, axis=1)
    middle = float(np.median(size)) if len(size) else 0.0
    steady = bool(middle) and float(np.max(np.abs(size - middle))) < SAME_SIZE * middle
    return steady and float(np.max(np.ptp(known, axis=0))) > TURNED * middle


def _unit_fours(found: Proposal, reader: Reader, column: Mapping[int, np.ndarray]) -> set[int]:
    """Positions in any four neighbouring columns that are a quaternion by their numbers.

    That they are left out goes into the notes: which of them is w nobody knows.
    """
    away: set[int] = set()
    for k in column:
        four = [k + i for i in range(4)]
        if set(four) <= column.keys() and not set(four) & away:
            if _is_quaternion(np.column_stack([column[i] for i in four])):
                away |= set(four)
                cells = ", ".join(reader.header[i] for i in four)
                found.notes.append(
                    f"{cells} are left out: their squares add up to 1, as those of an attitude do "
                    "(ref_q_w, ref_q_x, ref_q_y, ref_q_z)"
                )
    return away


def _is_quaternion(four: np.ndarray) -> bool:
    """Whether four columns (n, 4) are of length one in every row in which they have any.

    So is an accelerometer at rest, in g, beside a gyro: three columns are of length one then.
    """
    known = four[np.all(np.isfinite(four), axis=1) & np.any(four != 0, axis=1)]
    if not len(known):
        return False
    off, *of_three = (
        float(np.max(np.abs(np.linalg.norm(some, axis=1) - 1.0)))
        for some in (known, known[:, :3], known[:, 1:])
    )
    return off < EXACT or (off < UNIT_LENGTH and all(three > 3 * off for three in of_three))


def _missing(
    found: Proposal,
    group: str,
    reader: Reader,
    numbers: Numbers,
    picked: dict[str, Picked],
    period: float | None,
    named_ones: Sequence[int],
) -> Picked:
    """The vector of ``group`` that no name tells, beside the others, where its numbers tell it.

    A vector that may be it is noted else.
    """
    force = None if picked["accel"] is None else numbers.of([p for p, _ in picked["accel"]])
    taken = [p for known in picked.values() if known is not None for p, _ in known]
    names = [named(cell) for cell in reader.header]
    for at in others(reader.header, [*taken, *named_ones]):
        if not set(at) <= set(numbers.positions):
            continue
        values = numbers.of(at)
        guess = force_unit(values) if group == "accel" else rate_unit(values, force, period)
        cells = ", ".join(reader.header[k] for k in at)
        if guess.unit is not None and (group == "accel" or "gravity" in guess.why):
            found.notes.append(f"{cells} were taken for the {group} by their numbers alone")
            return [(k, names[k]) for k in at]
        found.notes.append(f"{cells} are left out: they may be the {group} ({guess.why})")
    return None


def _scatter(force: np.ndarray) -> float:
    """Relative scatter of the size of a vector: of the specific force at rest it is small."""
    size = np.linalg.norm(force, axis=1)
    return float(np.nanstd(size) / (resting_size(force) or 1.0))


def _vector(
    found: Proposal,
    group: str,
    picked: list[tuple[int, Name]],
    numbers: Numbers,
    force: np.ndarray | None,
    period: float | None,
) -> None:
    guess = _unit(group, picked, numbers, force, period)
    if group == "mag" and guess.unit is None:
        cells = ", ".join(name.cell for _, name in picked)
        found.notes.append(f"{cells} may be the magnetometer: {guess.why}")
        return
    found.add(
        [
            Guess(name.cell, f"{group}_{axis}", guess.unit, guess.why, guess.value, guess.sizes)
            for axis, (_, name) in zip(XYZ, picked, strict=True)
        ]
    )


def _unit(
    group: str,
    picked: list[tuple[int, Name]],
    numbers: Numbers,
    force: np.ndarray | None,
    period: float | None,
) -> UnitGuess:
    """The unit that the header states, else the one that the numbers show."""
    units = {name.unit for _, name in picked}
    unit = units.pop() if len(units) == 1 else None
    if unit is not None and fits(unit, group):
        return UnitGuess(unit, f"the header says {picked[0][1].said}")
    values = numbers.of([p for p, _ in picked])
    if unit is not None and group == "gyro" and same_dimension(unit, "rad") and unit != "1":
        return angle_of_rate(unit, picked[0][1].said, values, force, period)
    if not np.any(np.nan_to_num(values)):
        return UnitGuess(None, ZEROS)
    if group == "accel":
        guess = force_unit(values)
    elif group == "gyro":
        guess = rate_unit(values, force, period)
    else:
        guess = _field_unit(values)
    said = picked[0][1].said
    return replace(guess, why=f"{guess.why} (the header says {said})") if said else guess


def _field_unit(values: np.ndarray) -> UnitGuess:
    """The Earth's field is 22 to 67 uT (World Magnetic Model); near magnets more or less.

    Whole numbers of its size in mgauss may as well be counts, a thousand of them a gauss or so.
    """
    size = float(np.nanmedian(np.linalg.norm(values, axis=1)))
    for unit, one in (("uT", 1.0), ("gauss", 0.01), ("mgauss", 10.0)):
        if 20 * one < size < 70 * one and not (unit == "mgauss" and counts(values.ravel())):
            return UnitGuess(unit, f"the field is {size:.3g} then")
    return UnitGuess(None, f"the field is {size:.3g}, in no usual unit")


def _temperature(found: Proposal, reader: Reader, numbers: Numbers) -> None:
    warm = thermometer(named(cell) for cell in reader.header)
    if warm is not None:
        unit = warm.unit if warm.unit in FREEZING else None
        guess = UnitGuess(unit, f"the header says {warm.said}")
        at = found.header.index(warm.cell)
        if unit is None and at in numbers.positions:
            guess = warmth_unit(numbers.of([at]))
        found.add([Guess(warm.cell, "temperature", guess.unit, guess.why)])


def _own(found: Proposal, reader: Reader) -> None:
    """Add what is named as a recording's own columns are, of groups that are not there yet."""
    there = set(found.groups)
    for cell in reader.header:
        name = own_name(cell)
        if name is not None and GROUP_OF[name] not in there:
            unit = cell.partition("[")[2].rstrip("] ")
            found.add([Guess(cell, name, unit, "the header says so")])


def _reference(found: Proposal, reader: Reader, attitudes: Sequence[dict[str, int]]) -> None:
    """Add a reference's quaternion: by its name, or the only one of a file that has no sensor."""
    at, why = attitude(reader.header), "a reference by its name; body to world, scalar first?"
    if at is None and len(attitudes) == 1 and not {"gyro", "accel"} & set(found.groups):
        at, why = attitudes[0], "four numbers of length one, and no sensor; body to world?"
    if at is None:
        of_bodies = lines_of(reader)
        found.notes += of_bodies
        for four in [] if of_bodies else attitudes:
            cells = ", ".join(reader.header[four[a]] for a in "wxyz")
            found.notes.append(
                f"{cells} are left out: an estimate, or a reference's ref_q_w to ref_q_z?"
            )
        return
    why = f"{why} see [frame]"
    found.add([Guess(reader.header[at[a]], f"ref_q_{a}", "1", why) for a in "wxyz"])


def _angles(found: Proposal, reader: Reader, numbers: Numbers) -> None:
    """Add a reference's roll, pitch and yaw: by their names, or those of a file that has no sensor.

    Beside a sensor they may be an estimate, and are noted.
    """
    at = angles(reader.header)
    if not at or not set(at.values()) <= set(numbers.positions) or "ref_q" in found.groups:
        return
    cells = [reader.header[at[target]] for target in ANGLES]
    if {"gyro", "accel"} & set(found.groups) and not all(map(is_truth, cells)):
        found.notes.append(
            f"{', '.join(cells)} are left out: an estimate, or a reference's {', '.join(ANGLES)}?"
        )
        return
    units = {named(cell).unit for cell in cells}
    unit = units.pop() if len(units) == 1 else None
    guess = UnitGuess(unit, "the header says so")
    if unit is None or not same_dimension(unit, "rad"):
        guess = angle_unit(numbers.of([at[target] for target in ANGLES]))
    why = f"{guess.why}; yaw first, then pitch, then roll? from north, or nose up: see [frame]"
    found.add([Guess(c, t, guess.unit, why) for c, t in zip(cells, ANGLES, strict=True)])


def _place(found: Proposal, reader: Reader, place: Mapping[str, int]) -> None:
    """Add north, east and down or up of a file that holds a reference alone, or else its ``place``
    along x, y and z.
    """
    if found.holds != "reference":
        return
    by_name = places(reader.header)
    asked = "" if by_name else "; is z up?"
    for target, position in (by_name or place).items():
        name = named(reader.header[position])
        unit, said = name.unit or "m", "the header says so" if name.unit else "a place, in m?"
        said += asked
        found.add([Guess(name.cell, target, unit, said)])
