"""A column map for a foreign log, proposed by its header and its numbers, to be looked over."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from pyimu.errors import UserError
from pyimu.numerics.columns import columns_at
from pyimu.recording.columns import GROUP_OF, XYZ, own_name
from pyimu.recording.counter import Unwrapped
from pyimu.recording.formats.matrix_attitude import elements
from pyimu.recording.formats.reader import Reader
from pyimu.recording.guess.angles import angle_of_rate
from pyimu.recording.guess.by_numbers import Picked, by_numbers, keeps_its_size, missing
from pyimu.recording.guess.clock_column import add_time
from pyimu.recording.guess.first_rows import Numbers
from pyimu.recording.guess.guessed import Guess, Proposal
from pyimu.recording.guess.increments import add_increments, add_named_increments
from pyimu.recording.guess.numbers import (
    SECONDS,
    STATED,
    UnitGuess,
    are_counts_of_warmth,
    counts,
    force_unit,
    rate_unit,
    warmth_unit,
)
from pyimu.recording.guess.receiver_counts import add_receiver_counts
from pyimu.recording.guess.receivers import add_received, received
from pyimu.recording.guess.references import add_angles, add_place, add_reference, attitudes_in
from pyimu.recording.naming.endings import fits
from pyimu.recording.naming.name import Name, named, thermometer
from pyimu.recording.naming.references import angles, spots
from pyimu.recording.naming.triads import Triad, of_one, of_sensor, sensors, triads
from pyimu.recording.optical import question
from pyimu.units import FREEZING, same_dimension

TO_SAY = "whose size and zero the data sheet says"

ZEROS = "every number of it is zero: was it logged?"
"""Of a vector in which nothing is to be seen."""


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
        return columns_at(time, self.time, self.force, beyond=np.nan)


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
    if own is None or own.unit not in STATED:
        return None
    values = Unwrapped(*SECONDS.values()).add(numbers.of([found.header.index(own.cell)]))
    return values.astype(float) * STATED[own.unit] * (own.value or 1.0)


WAYS = "taken for forward, left and up: where one counts otherwise, its column is a [count] of -1"
"""Of accelerations that are called inline, lateral and vertical."""


def proposed(
    reader: Reader,
    rate: float | None = None,
    beside: Beside | None = None,
    sensor: str = "",
) -> Proposal:
    """A map for the log in ``reader``, of which ``rate`` [Hz] is known if it has no times.

    The forces of another file, ``beside``, tell the gyro's unit where it has none of its own. Of a
    table with the vectors of several sensors those of the ``sensor`` with this name are taken, else
    of the first. Raises UserError where its numbers cannot be read, or no sensor has this name.
    """
    found = Proposal(reader.path, tuple(reader.header), topic=reader.word)
    if reader.word and not reader.words:
        found.notes.append(f"the rows {reader.word} alone are read; [topics] imu names others")
    numbers = Numbers(reader)
    period = add_time(found, reader, numbers, rate)
    vectors = triads(reader.header, reader.path.name)
    picked = _picked(found, vectors, sensor)
    _of_gravity(found, picked, numbers)
    attitudes = attitudes_in(reader, numbers)
    add_receiver_counts(found, reader, numbers, period)
    counted = bool({"gyro", "accel"} & set(found.groups))
    place: dict[str, int] = {}
    fixes = received(reader, numbers)
    if picked["accel"] is None and picked["gyro"] is None and not counted:
        place = spots(reader.header) if len(attitudes) == 1 else {}
        away = {k for at in attitudes for k in at.values()} | set(angles(reader.header).values())
        away |= set(fixes.values())
        place = {} if away & set(place.values()) else place
        away |= set(place.values()) | elements(reader.header)
        if not question(reader):
            _by_numbers(found, reader, numbers, period, away, picked)
    stepped = {"gyro", "accel"} & set(found.groups)
    for group in () if stepped else ("accel", "gyro"):
        if picked[group] is None and not question(reader):
            named_ones = [p for v in vectors for p in v.positions] + [*place.values()]
            picked[group] = missing(found, group, reader, numbers, picked, period, named_ones)
    force = None if picked["accel"] is None else numbers.of([p for p, _ in picked["accel"]])
    time = None if beside is None or force is not None else _seconds(found, numbers)
    if beside is not None and time is not None:
        force = beside.at(time)
    for group in ("gyro", "accel", "mag"):
        if picked[group] is not None:
            _vector(found, group, picked[group], numbers, force, period)
    _temperature(found, reader, numbers)
    add_reference(found, reader, attitudes)
    add_angles(found, reader, numbers)
    add_received(found, reader, numbers, fixes)
    add_place(found, reader, place)
    _own(found, reader)
    return found


def _by_numbers(
    found: Proposal,
    reader: Reader,
    numbers: Numbers,
    period: float | None,
    away: set[int],
    picked: dict[str, Picked],
) -> None:
    """Pick the vectors that no name tells, or add them where they are increments."""
    add_named_increments(found, reader, numbers, period)
    if {"gyro", "accel"} & set(found.groups):
        return
    picked |= by_numbers(found, reader, numbers, period, away)
    if picked["accel"] is None and picked["gyro"] is None:
        add_increments(found, reader, numbers, period, away)


def _picked(found: Proposal, vectors: list[Triad], sensor: str) -> dict[str, Picked]:
    """The surest vector of each group by names; what else could be meant goes into the notes."""
    several = sensors(vectors)
    if sensor:
        vectors = of_sensor(vectors, sensor)
        if not vectors:
            there = (
                f": there are {', '.join(several)}" if several else "; its columns tell none apart"
            )
            raise UserError(f"{found.path}: no vectors of a sensor {sensor!r}{there}")
    picked: dict[str, Picked] = {}
    for group, (best, others) in of_one(vectors, ("gyro", "accel", "mag")).items():
        for other in others:
            cells = ", ".join(name.cell for name in other.names)
            found.notes.append(f"{cells} may be the {group}, too")
        picked[group] = None if best is None else list(zip(best.positions, best.names, strict=True))
        if best is not None and best.is_of_vehicle:
            found.notes.append(f"{', '.join(name.cell for name in best.names)} are {WAYS}")
        if best is not None and group == "gyro" and len(several) > 1 and not sensor:
            own = " ".join(best.sensor)
            called = own or f"that of {best.names[0].cell}"
            rest = " or ".join(f"--sensor {name!r}" for name in several if name not in (own, ""))
            found.notes.append(
                f"of several sensors {called} is read; pyimu inspect {rest} takes another"
            )
    return {group: picked[group] for group in ("accel", "gyro", "mag")}


def _of_gravity(found: Proposal, picked: dict[str, Picked], numbers: Numbers) -> None:
    """Take for the accelerometer what a letter alone calls a gyro's, and keeps gravity's size while
    it turns: ``Gx``, ``Gy`` and ``Gz`` of a force in g. At rest it may be a gyro's bias.
    """
    own = picked["gyro"]
    if (
        own is None
        or picked["accel"] is not None
        or any(n.of("gyro") > 1 or n.unit for _, n in own)
    ):
        return
    values = numbers.of([p for p, _ in own])
    seen = force_unit(values)
    if seen.fits and seen.value is None and keeps_its_size(values):
        cells = ", ".join(name.cell for _, name in own)
        found.notes.append(f"{cells} were taken for the accel, not the gyro: {seen.why}")
        picked["accel"], picked["gyro"] = own, None


def _vector(
    found: Proposal,
    group: str,
    picked: list[tuple[int, Name]],
    numbers: Numbers,
    force: np.ndarray | None,
    period: float | None,
) -> None:
    guesses = _own_units(group, picked) or [_unit(group, picked, numbers, force, period)] * 3
    if group == "mag" and guesses[0].unit is None:
        cells = ", ".join(name.cell for _, name in picked)
        found.notes.append(f"{cells} may be the magnetometer: {guesses[0].why}")
        return
    found.add(
        [
            Guess(
                name.cell,
                f"{group}_{axis}",
                guess.unit,
                guess.why,
                guess.value,
                guess.sizes,
                guess.choices,
            )
            for axis, (_, name), guess in zip(XYZ, picked, guesses, strict=True)
        ]
    )


def _own_units(group: str, picked: list[tuple[int, Name]]) -> list[UnitGuess]:
    """The units that the header states of axes that differ in it: no size of the vector tells any
    then. None of axes in one unit, or of one or two that are silent beside the others.
    """
    units = [name.unit for _, name in picked]
    if len(set(units) - {None}) < 2:
        return []
    why = "the header says " + ", ".join(name.said or "nothing" for _, name in picked)
    each = [u if u is not None and fits(u, group) else None for u in units]
    return [UnitGuess(unit, why) for unit in each]


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
            warmth = numbers.of([at])
            if are_counts_of_warmth(warmth):
                said = f"counts of {np.nanmin(warmth):.0f} to {np.nanmax(warmth):.0f}, {TO_SAY}"
                found.notes.append(f"{warm.cell} may be the temperature: {said}")
                return
            guess = warmth_unit(warmth)
        found.add([Guess(warm.cell, "temperature", guess.unit, guess.why)])


def _own(found: Proposal, reader: Reader) -> None:
    """Add what is named as a recording's own columns are, of groups that are not there yet."""
    there = set(found.groups)
    for cell in reader.header:
        name = own_name(cell)
        if name is not None and GROUP_OF[name] not in there:
            unit = cell.partition("[")[2].rstrip("] ")
            found.add([Guess(cell, name, unit, "the header says so")])
