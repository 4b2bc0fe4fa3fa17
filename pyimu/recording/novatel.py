"""What the counts of NovAtel's raw inertial samples are, by the type of the unit."""

from __future__ import annotations

import numpy as np

from pyimu.recording.column_map import ForeignMap
from pyimu.recording.counts import Scale
from pyimu.recording.formats.novatel import TIME, TYPE, VECTORS
from pyimu.recording.formats.novatel_counts import INCREMENTS, RATES, is_novatel
from pyimu.recording.formats.reader import Reader
from pyimu.recording.vectors import triad_map
from pyimu.units import parse


def novatel(reader: Reader) -> ForeignMap | None:
    """The map of a receiver's raw samples, in the axes of the inertial unit's enclosure.

    The counts of a unit that is not known have no size: who reads it says it.
    """
    if not is_novatel(reader):
        return None
    columns = {TIME: "time [s]"} | triad_map(VECTORS[:3], "accel", "count")
    columns |= triad_map(VECTORS[3:], "gyro", "count")
    sizes = _sizes(reader)
    if sizes is None:
        return ForeignMap(columns=columns)
    units = {"gyro": (sizes[0], "rad/s"), "accel": (sizes[1], "m/s^2")}
    scale = {f"{g}_{a}": Scale(size, parse(u)) for g, (size, u) in units.items() for a in "xyz"}
    return ForeignMap(columns=columns, scale=scale)


def _sizes(reader: Reader) -> tuple[float, float] | None:
    """rad/s and m/s^2 of a count, by the type in the first row; None where it is not known."""
    if TYPE not in reader.header:
        return None
    at = reader.header.index(TYPE)
    columns, _ = next(reader.batches([at], at), ([np.zeros(0)], 1.0))
    kind = int(columns[0][0]) if len(columns[0]) else 0
    if kind in INCREMENTS:
        rate, (rad, metres) = INCREMENTS[kind]
        return rate * rad, rate * metres
    return RATES.get(kind)
