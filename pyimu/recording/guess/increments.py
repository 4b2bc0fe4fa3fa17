"""Increments from sample to sample in place of a gyro's rates and an accelerometer's forces.

An inertial unit that integrates what it measures writes the angle and the velocity that came up
since its last sample. Times the sample rate they are rates and forces, and so a column map has
them: as counts of that size.
"""

from __future__ import annotations

from collections.abc import Container
from dataclasses import replace

import numpy as np

from pyimu.recording.columns import XYZ
from pyimu.recording.formats.reader import Reader
from pyimu.recording.guess.by_numbers import Picked, by_numbers
from pyimu.recording.guess.clock_column import array_of
from pyimu.recording.guess.first_rows import Numbers, PerSecond
from pyimu.recording.guess.guessed import Guess, Proposal
from pyimu.recording.guess.numbers import UnitGuess, force_unit, rate_unit
from pyimu.recording.naming.increments import increments
from pyimu.units import STANDARD_GRAVITY, same_dimension

SAID = "increments from row to row"

OVER_TIME = {"gyro": "rad", "accel": "m/s"}
"""What the increments are of."""

SIX = 6
"""Columns that a table of increments has at least."""

UNNAMED = "column "
"""How the columns of a table without names are called."""


def add_increments(
    found: Proposal,
    reader: Reader,
    numbers: Numbers,
    period: float | None,
    away: Container[int],
) -> None:
    """Add the increments that the numbers of a table without names show, of a sample ``period``
    [s]; none of those ``away``. In a file of arrays the one with the time is such a table.
    """
    if period is None:
        return
    if not all(cell.startswith(UNNAMED) for cell in reader.header):
        home = {array_of(g.cell) for g in found.guesses if g.target == "time"} - {""}
        away = {
            k for k, cell in enumerate(reader.header) if array_of(cell) not in home or k in away
        }
        if len(away) > len(reader.header) - SIX:
            return
    rates = PerSecond(numbers, 1 / period)
    scratch = replace(found, guesses=list(found.guesses), notes=[])
    picked = by_numbers(scratch, reader, rates, period, away)
    if picked["accel"] is not None and picked["gyro"] is not None:
        found.notes += scratch.notes
        _add(found, picked, rates, period)


def add_named_increments(
    found: Proposal, reader: Reader, numbers: Numbers, period: float | None
) -> None:
    """Add the increments that the header names, of a sample ``period`` [s]."""
    named = increments(reader.header)
    picked: dict[str, Picked] = {"gyro": None, "accel": None, **named}
    if not named:
        return
    if period is None:
        cells = ", ".join(name.cell for three in picked.values() for _, name in three or ())
        found.notes.append(f"{cells} are {SAID}: the sample rate in a map tells their size")
        return
    _add(found, picked, PerSecond(numbers, 1 / period), period)


def _add(found: Proposal, picked: dict[str, Picked], numbers: PerSecond, period: float) -> None:
    force = None if picked["accel"] is None else numbers.of([p for p, _ in picked["accel"]])
    for group in ("gyro", "accel"):
        three = picked[group]
        if three is None:
            continue
        guess = _unit(group, {name.unit for _, name in three}, three[0][1].said)
        values = numbers.of([p for p, _ in three])
        if guess is None:
            seen = force_unit(values) if group == "accel" else rate_unit(values, force, period)
            guess = replace(seen, why=f"{SAID}; {seen.why}")
            if seen.value is not None or seen.sizes:
                guess = UnitGuess(None, f"{SAID}, in counts: the unit's manual says of what size")
        rate = float(f"{numbers.rate:.10g}")
        size = rate if guess.unit is not None else None
        sizes = () if guess.unit is not None else _sizes(group, rate)
        found.add(
            [
                Guess(name.cell, f"{group}_{axis}", guess.unit, guess.why, size, sizes)
                for axis, (_, name) in zip(XYZ, three, strict=True)
            ]
        )


def _unit(group: str, units: set[str | None], said: str) -> UnitGuess | None:
    """That of the rates by the one that the header states of the increments, None without."""
    unit = units.pop() if len(units) == 1 else None
    if unit in (None, "1") or not same_dimension(unit, OVER_TIME[group]):
        return None
    over = "m/s^2" if unit == "m/s" else f"{unit}/s"
    return UnitGuess(over, f"{SAID} in {said}, as the header says")


def _sizes(group: str, rate: float) -> tuple[float, ...]:
    """What one may be: a radian or a degree, in deg/s; 1 m/s, or g times 1 s, in g."""
    if group == "gyro":
        return (float(np.degrees(rate)), rate)
    return (rate / STANDARD_GRAVITY, rate)
