"""Tables of ROS's sensor_msgs/Imu, whoever wrote them, and of messages with a pose.

Stamps of messages are in ns, or whole seconds and ns, rates in rad/s, forces in m/s^2 and places in
m by the messages' definitions. The time at which a message came is left out for the sensor's own
stamp, and the orientation of an Imu message, an estimate.
"""

from __future__ import annotations

import re

from pyimu.recording.column_map import ForeignMap
from pyimu.recording.columns import XYZ
from pyimu.recording.formats.reader import Reader
from pyimu.recording.vectors import triad_map

_FIELD = re.compile(r"(.*?)angular_velocity([./])x")

_TURN = re.compile(r"(.*?)((?:pose[./])?pose[./]orientation|transform[./]rotation)([./])x")

PLACES = {"orientation": "position", "rotation": "translation"}
"""What a message's place is called, by the name of its attitude."""

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
    stamp = _stamp(reader, before)
    if not stamp or not {*rate, *force} <= set(reader.header):
        return None
    columns = triad_map(rate, "gyro", "rad/s") | triad_map(force, "accel", "m/s^2")
    return ForeignMap(columns=stamp | columns)


def pose_message(reader: Reader) -> ForeignMap | None:
    """A reference in a table of PoseStamped, Odometry or TransformStamped: the attitude body to
    world and the place in axes east-north-up (REP 103); None of a table that has it twice, or no
    stamps.
    """
    found = [match for cell in reader.header if (match := _TURN.fullmatch(cell))]
    if len(found) != 1:
        return None
    before, turn, dot = found[0].groups()
    last = re.split(r"[./]", turn)[-1]
    place = turn.removesuffix(last) + PLACES[last]
    columns = {f"{before}{turn}{dot}{a}": f"ref_q_{a} [1]" for a in "wxyz"}
    ways = zip(XYZ, ("ref_east", "ref_north", "ref_up"), strict=True)
    there = {f"{before}{place}{dot}{a}": f"{name} [m]" for a, name in ways}
    stamp = _stamp(reader, before)
    if not stamp or not {*columns, *there} <= set(reader.header):
        return None
    return ForeignMap(columns=stamp | columns | there)


def _stamp(reader: Reader, before: str) -> dict[str, str]:
    """The line of the message's stamp in a column map, empty where there is none."""
    stamps = [(cell, "ns") for cell in reader.header if _is_joined(cell, before)]
    stamps += [(before + end, u) for end, u in STAMPS.items() if before + end in reader.header]
    return {stamps[0][0]: f"time [{stamps[0][1]}]"} if stamps else {}


def _is_joined(cell: str, before: str) -> bool:
    """Whether a column is the time that ``split_time`` makes of the stamp's two."""
    return cell.startswith(f"time of {before}") and cell.endswith("[ns]")
