"""A reference in a foreign log: an attitude, angles, a place."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from pyimu.recording.columns import ANGLES
from pyimu.recording.formats.reader import Reader
from pyimu.recording.guess.by_numbers import UNIT_LENGTH
from pyimu.recording.guess.first_rows import Numbers
from pyimu.recording.guess.guessed import Guess, Proposal
from pyimu.recording.guess.numbers import UnitGuess, angle_unit
from pyimu.recording.naming.name import named
from pyimu.recording.naming.references import angles, attitude, is_truth, places, quaternions
from pyimu.recording.optical import lines_of
from pyimu.units import same_dimension


def attitudes_in(reader: Reader, numbers: Numbers) -> list[dict[str, int]]:
    """Positions of w, x, y, z of the quaternions in a file: of length one in nearly every row."""
    found = []
    for at in quaternions(reader.header):
        if set(at.values()) <= set(numbers.positions):
            size = np.linalg.norm(numbers.of([at[a] for a in "wxyz"]), axis=1)
            size = size[np.isfinite(size)]
            if len(size) and np.mean(np.abs(size - 1.0) < UNIT_LENGTH) > 0.99:
                found.append(at)
    return found


def add_reference(found: Proposal, reader: Reader, attitudes: Sequence[dict[str, int]]) -> None:
    """Add a reference's quaternion: by its name, or the only one of a file that has no sensor."""
    at, why = attitude(reader.header), "a reference by its name; body to world, scalar first?"
    if at is None and len(attitudes) == 1 and not {"gyro", "accel"} & set(found.groups):
        at, why = attitudes[0], "four numbers of length one, and no sensor; body to world?"
    if at is None:
        of_bodies = lines_of(reader)
        found.notes += of_bodies
        for four in [] if of_bodies else attitudes:
            cells = ", ".join(reader.header[four[a]] for a in "wxyz")
            why = "an estimate, or a reference? body to world? see [frame]"
            found.offer(
                f"{cells} are left out: an estimate, or a reference's ref_q_w to ref_q_z?",
                [Guess(reader.header[four[a]], f"ref_q_{a}", "1", why) for a in "wxyz"],
            )
        return
    why = f"{why} see [frame]"
    found.add([Guess(reader.header[at[a]], f"ref_q_{a}", "1", why) for a in "wxyz"])


def add_angles(found: Proposal, reader: Reader, numbers: Numbers) -> None:
    """Add a reference's roll, pitch and yaw: by their names, or those of a file that has no sensor.

    Beside a sensor they may be an estimate, and are noted.
    """
    at = angles(reader.header)
    if not at or not set(at.values()) <= set(numbers.positions) or "ref_q" in found.groups:
        return
    cells = [reader.header[at[target]] for target in ANGLES]
    units = {named(cell).unit for cell in cells}
    unit = units.pop() if len(units) == 1 else None
    guess = UnitGuess(unit, "the header says so")
    if unit is None or not same_dimension(unit, "rad"):
        guess = angle_unit(numbers.of([at[target] for target in ANGLES]))
    why = f"{guess.why}; yaw first, then pitch, then roll? from north, or nose up: see [frame]"
    made = [Guess(c, t, guess.unit, why) for c, t in zip(cells, ANGLES, strict=True)]
    if {"gyro", "accel"} & set(found.groups) and not all(map(is_truth, cells)):
        found.offer(
            f"{', '.join(cells)} are left out: an estimate, or a reference's {', '.join(ANGLES)}?",
            made,
        )
    else:
        found.add(made)


def add_place(found: Proposal, reader: Reader, place: Mapping[str, int]) -> None:
    """Add north, east and down or up of a file that holds a reference alone, or else its ``place``
    along x, y and z.
    """
    if found.holds != "reference" or "ref_north" in found.groups:
        return
    by_name = places(reader.header)
    asked = "" if by_name else "; is z up?"
    for target, position in (by_name or place).items():
        name = named(reader.header[position])
        unit, said = name.unit or "m", "the header says so" if name.unit else "a place, in m?"
        said += asked
        found.add([Guess(name.cell, target, unit, said)])
