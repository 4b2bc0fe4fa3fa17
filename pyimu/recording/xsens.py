"""Xsens: MT Manager's text export, and Movella DOT's."""

from __future__ import annotations

import numpy as np

from pyimu.recording.column_map import ForeignMap
from pyimu.recording.counts import Scale
from pyimu.recording.formats.reader import Reader
from pyimu.recording.vectors import triad_map
from pyimu.units import parse

SLOW_DOT = 2500
"""Least step of ``SampleTimeFine`` in us: DOT's fastest rate, 120 Hz, makes 8333; in 0.1 ms as
large a step is 4 Hz, which nobody sets a tracker to."""


def xsens(reader: Reader) -> ForeignMap | None:
    """The map of either's table; None of any other.

    MT Manager's user manual: ``Acc_X`` m/s^2, ``Gyr_X`` rad/s, the magnetometer in no unit;
    ``SampleTimeFine`` counts 0.1 ms there, in DOT's files 1 us (Xsens DOT user manual, 4.2.5),
    whose rates are in deg/s. Without it, or where it holds no numbers as in the files of wireless
    trackers, the rate that the comments state gives the times. A table of DOT's rates alone has
    the names of MT Manager's: its steps of the time tell it.
    """
    cells = set(reader.header)
    if not {"Acc_X", "Gyr_X"} <= cells or "PacketCounter" not in cells:
        return None
    fine = "SampleTimeFine" in cells and reader.header.index("SampleTimeFine") in reader.numeric()
    dot = bool({"Quat_W", "dq_W", "Euler_X"} & cells) or (fine and _counts_us(reader))
    columns = triad_map([f"Gyr_{a}" for a in "XYZ"], "gyro", "deg/s" if dot else "rad/s")
    columns |= triad_map([f"Acc_{a}" for a in "XYZ"], "accel", "m/s^2")
    scale = {}
    if fine:
        columns["SampleTimeFine"] = "time [count]"
        scale = {"time": Scale(1e-6 if dot else 1e-4, parse("s"))}
    elif reader.rate is None:
        return None
    return ForeignMap(columns=columns, scale=scale) if set(columns) <= cells else None


def _counts_us(reader: Reader) -> bool:
    """Whether ``SampleTimeFine`` counts us: by the rate that the file states, else by its steps."""
    at = reader.header.index("SampleTimeFine")
    columns, _ = next(reader.batches([at], at), ([np.zeros(0)], 1.0))
    steps = np.diff(columns[0].astype(float))
    steps = steps[steps > 0]
    if not len(steps):
        return False
    step = float(np.median(steps))
    if reader.rate is not None:
        return abs(np.log(1e6 / step / reader.rate)) < abs(np.log(1e4 / step / reader.rate))
    return step > SLOW_DOT
