"""The counts of a receiver's inertial unit whose type its log does not say: the size by gravity."""

from __future__ import annotations

import numpy as np

from pyimu.recording.columns import XYZ
from pyimu.recording.formats.novatel import VECTORS
from pyimu.recording.formats.novatel_counts import INCREMENTS, RATES, is_novatel
from pyimu.recording.formats.reader import Reader
from pyimu.recording.guess.first_rows import Numbers
from pyimu.recording.guess.guessed import Guess, Proposal
from pyimu.units import STANDARD_GRAVITY

NEAR = 0.1
"""Part by which gravity may be off: the sizes of two units differ by a fifth and more."""

OFF_RATE = 0.05
"""Part by which a unit's rate may be off the log's."""


def add_receiver_counts(
    found: Proposal, reader: Reader, numbers: Numbers, period: float | None
) -> None:
    """Add the vectors of a receiver's log whose counts have no size, of samples every ``period`` s:
    of one of the units that are known where gravity tells it, else all that it may be.
    """
    if period is None or not is_novatel(reader):
        return
    force = numbers.of([reader.header.index(name) for name in VECTORS[:3]])
    gravity = float(np.nanmedian(np.linalg.norm(force, axis=1)))
    known = _sizes(1 / period)
    fitting = [s for s in known if abs(s[1] * gravity / STANDARD_GRAVITY - 1) < NEAR]
    for group, at, names in (("accel", 1, VECTORS[:3]), ("gyro", 0, VECTORS[3:])):
        one = fitting[0][at] if len(fitting) == 1 else None
        why = (
            "of the unit whose counts make gravity 9.8" if one else "the unit's type tells the size"
        )
        found.add(
            [_guess(c, f"{group}_{a}", one, fitting or known, why) for c, a in zip(names, XYZ)]
        )


def _guess(
    cell: str, target: str, size: float | None, sizes: list[tuple[float, float]], why: str
) -> Guess:
    gyro = target.startswith("gyro")
    if size is not None:
        return Guess(cell, target, "rad/s" if gyro else "m/s^2", why, size)
    one = [np.degrees(s[0]) if gyro else s[1] / STANDARD_GRAVITY for s in sizes]
    return Guess(cell, target, None, why, sizes=tuple(dict.fromkeys(map(float, one))))


def _sizes(rate: float) -> list[tuple[float, float]]:
    """rad/s and m/s^2 of a count of each unit that gives so many samples a second."""
    near = {(r * rad, r * m) for r, (rad, m) in INCREMENTS.values() if abs(rate / r - 1) < OFF_RATE}
    return sorted(near | set(RATES.values()))
