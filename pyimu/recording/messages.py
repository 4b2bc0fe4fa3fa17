"""Tables of ROS's sensor_msgs/Imu, whoever wrote them.

Stamps of messages are in ns, or whole seconds and ns, rates in rad/s and forces in m/s^2 by the
message's definition. The time at which a message came is left out for the sensor's own stamp, and
the orientation, an estimate.
"""

from __future__ import annotations

import re

from pyimu.recording.column_map import ForeignMap
from pyimu.recording.columns import XYZ
from pyimu.recording.formats.reader import Reader
from pyimu.recording.vectors import triad_map

_FIELD = re.compile(r"(.*?)angular_velocity([./])x")

STAMPS = {"header.stamp": "ns", "header/stamp": "s"}
"""Stamps in one column, as ``rostopic echo -p`` and PlotJuggler write them."""


def imu_message(reader: Reader) -> ForeignMap | None:
    """By the names of the fields: ``rostopic echo -p``, tables of bags (bagpy, rosbag_to_csv),
    PlotJuggler's; None of a table that has them twice, or no stamps.
    """
    found = [match for cell in reader.header if (match := _FIELD.fullmatch(cell))]
    if len(found) != 1:
        return None
    before, dot = found[0].groups()
    rate = [f"{before}angular_velocity{dot}{a}" for a in XYZ]
    force = [f"{before}linear_acceleration{dot}{a}" for a in XYZ]
    stamps = [(cell, "ns") for cell in reader.header if _is_joined(cell, before)]
    stamps += [(before + end, u) for end, u in STAMPS.items() if before + end in reader.header]
    if not stamps or not {*rate, *force} <= set(reader.header):
        return None
    stamp, unit = stamps[0]
    columns = {stamp: f"time [{unit}]"}
    columns |= triad_map(rate, "gyro", "rad/s") | triad_map(force, "accel", "m/s^2")
    return ForeignMap(columns=columns)


def _is_joined(cell: str, before: str) -> bool:
    """Whether a column is the time that ``split_time`` makes of the stamp's two."""
    return cell.startswith(f"time of {before}") and cell.endswith("[ns]")
