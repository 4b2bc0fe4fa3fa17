"""A reference that a receiver of satellites wrote: its places and velocities, and its clock."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from pyimu.recording.columns import FIXES, GROUP_OF, UNITS
from pyimu.recording.fixes import POLE, ROUND
from pyimu.recording.formats.reader import Reader
from pyimu.recording.guess.first_rows import Numbers
from pyimu.recording.guess.guessed import Guess, Proposal
from pyimu.recording.guess.numbers import SECONDS, STATED, UnitGuess, counts
from pyimu.recording.naming.name import named
from pyimu.recording.naming.receivers import fix, velocities
from pyimu.recording.naming.references import places

RECEIVED = (0.5, 500.0)
"""Hz; three decades, within which receivers write, so that one unit of their times fits."""

ONE = 1e-7
"""deg; a count of latitude and longitude in u-blox's, MAVLink's and Android's whole numbers."""


def received(reader: Reader, numbers: Numbers) -> dict[str, int]:
    """Positions of the columns of places and velocities by what they would be called."""
    found = (fix(reader.header) or places(reader.header)) | velocities(reader.header)
    return found if set(found.values()) <= set(numbers.positions) else {}


def add_received(found: Proposal, reader: Reader, numbers: Numbers, at: Mapping[str, int]) -> None:
    """Add what is ``at`` positions of a file without a sensor, whose times have a receiver's rate.
    Beside a sensor it is noted.
    """
    if not at:
        return
    cells = ", ".join(reader.header[k] for k in at.values())
    beside = bool({"gyro", "accel"} & set(found.groups))
    place = _unit(numbers, at) if set(FIXES["ref"]) <= set(at) else None
    if beside:
        said = ", ".join(at)
        found.offer(
            f"{cells} are left out: a reference's {said}, or measured (position_)?",
            [
                replace(_guess(reader, target, k, place), target=name)
                for target, k in at.items()
                for name in (target, measured(target))
            ],
        )
        return
    left = _in_counts(numbers, at)
    if left:
        cells = ", ".join(reader.header[at[target]] for target in left)
        found.notes.append(f"{cells} are left out: whole numbers, of mm, cm/s or mm/s?")
        at = {target: k for target, k in at.items() if target not in left}
    found.add([_guess(reader, target, k, place) for target, k in at.items()])
    found.guesses = [_timed(reader, numbers, guess) for guess in found.guesses]


def measured(target: str) -> str:
    """What a reference's place or velocity is called where the receiver measured it."""
    own = target.removeprefix("ref_")
    return own if own.startswith("velocity") else f"position_{own}"


def _in_counts(numbers: Numbers, at: Mapping[str, int]) -> list[str]:
    """Heights and velocities in whole numbers beside such places: their unit nobody says."""
    if not all(name in at and counts(numbers.of([at[name]])) for name in FIXES["ref"]):
        return []
    others = [target for target in at if target not in FIXES["ref"]]
    parts = {GROUP_OF[target] for target in others if not _is_whole(numbers.of([at[target]]))}
    return [target for target in others if GROUP_OF[target] not in parts]


def _is_whole(values: np.ndarray) -> bool:
    known = values[np.isfinite(values)]
    return bool(np.all(known == np.rint(known)))


def _unit(numbers: Numbers, at: Mapping[str, int]) -> UnitGuess:
    """That of latitude and longitude where their names have none."""
    sizes = [float(np.nanmax(np.abs(numbers.of([at[n]])), initial=0.0)) for n in FIXES["ref"]]
    if all(counts(numbers.of([at[n]])) for n in FIXES["ref"]) and max(sizes) > 1e6:
        return UnitGuess("deg", "whole numbers, of 1e-7 deg as receivers count", ONE)
    if sizes[0] <= POLE and sizes[1] <= ROUND / 2:
        return UnitGuess(None, "near the equator in deg, or in rad?", choices=("deg", "rad"))
    return UnitGuess("deg", "in deg, as receivers write it?")


def _guess(reader: Reader, target: str, position: int, place: UnitGuess | None) -> Guess:
    cell = reader.header[position]
    unit = named(cell).unit
    if unit is not None:
        return Guess(cell, target, unit, "the header says so")
    if place is None or target not in FIXES["ref"]:
        unit = UNITS[target]
        return Guess(cell, target, unit, f"in {unit}, as receivers write it?")
    return Guess(cell, target, place.unit, place.why, place.value, choices=place.choices)


def _timed(reader: Reader, numbers: Numbers, guess: Guess) -> Guess:
    """``guess``, with the unit in which a receiver's times make a rate that it may have, where
    neither the header nor a date tells it.
    """
    if guess.target != "time" or named(guess.cell).clock in STATED or "date" in guess.why:
        return guess
    values = numbers.of([reader.header.index(guess.cell)]).astype(float)
    step = np.diff(values[np.isfinite(values)])
    step = step[step > 0]
    if not len(step):
        return guess
    rates = {u: 1 / (float(np.median(step)) * SECONDS[u]) for u in ("s", "ms", "us", "ns")}
    unit = next((u for u, rate in rates.items() if RECEIVED[0] <= rate < RECEIVED[1]), None)
    if unit is None:
        return guess
    return replace(guess, unit=unit, why=f"{rates[unit]:.5g} Hz, as receivers write", choices=())
