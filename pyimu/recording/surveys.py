"""Tables without names of data sets for navigation, known by the names of their files."""

from __future__ import annotations

import re

from pyimu.recording.column_map import BODY, ForeignMap
from pyimu.recording.columns import ANGLES
from pyimu.recording.formats.reader import Reader
from pyimu.recording.vectors import time_line, triad_map, unnamed


def xsens_imu(reader: Reader) -> ForeignMap | None:
    """``xsens_imu.csv`` of KAIST's complex urban data set, MulRan and HeLiPR (Jeong et al. 2019,
    and its page, "Data format"): ns since 1970, the unit's own quaternion and angles, which are
    estimates, rad/s, m/s^2, and a field whose unit is not settled.
    """
    cells = unnamed(reader, "xsens_imu", 17)
    if cells is None:
        return None
    columns = {cells[0]: "time [ns]"} | triad_map(cells[8:11], "gyro", "rad/s")
    return ForeignMap(columns=columns | triad_map(cells[11:14], "accel", "m/s^2"))


def oxiod_truth(reader: Reader) -> ForeignMap | None:
    """OxIOD's ``vi1.csv`` (Chen et al. 2018, and the data set's readme): a time, a count, Vicon's
    place in m and attitude, body to world, scalar last.
    """
    cells = unnamed(reader, "vi", 9)
    if cells is None or not re.search(r"(?<![a-z])vi\d*\.csv$", reader.path.name.lower()):
        return None
    time = time_line(reader, cells[:1])
    if not time:
        return None
    places = ("ref_east [m]", "ref_north [m]", "ref_up [m]")
    columns = time | dict(zip(cells[2:5], places, strict=True))
    return ForeignMap(
        columns=columns | {c: f"ref_q_{a} [1]" for a, c in zip("xyzw", cells[5:9], strict=True)}
    )


def solution(reader: Reader) -> ForeignMap | None:
    """A ``.nav`` of KF-GINS and the data sets around it (its readme, "navigation result"): the week
    and its second, degrees of latitude and longitude, m, the velocity north, east and down, and
    roll, pitch and heading in degrees of a body forward-right-down.
    """
    cells = unnamed(reader, ".nav", 11)
    if cells is None:
        return None
    columns = {cells[1]: "time [s]", cells[2]: "latitude [deg]"}
    ways = zip(("north", "east", "down"), cells[5:8], strict=True)
    columns |= {cell: f"ref_velocity_{way} [m/s]" for way, cell in ways}
    columns |= {cell: f"{angle} [deg]" for angle, cell in zip(ANGLES, cells[8:11], strict=True)}
    return ForeignMap(columns=columns, body=BODY["frd"], world="ned")


SURVEYS = (
    ("KAIST's Xsens unit, by its description", xsens_imu),
    ("OxIOD's ground truth, by its description", oxiod_truth),
    ("KF-GINS's navigation result, by its description", solution),
)
"""What each is called, and its map."""
