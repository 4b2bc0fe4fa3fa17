"""Tables without names of data sets for navigation, known by the names of their files."""

from __future__ import annotations

import re

import numpy as np

from pyimu.recording.column_map import BODY, ForeignMap
from pyimu.recording.columns import ANGLES
from pyimu.recording.counts import Scale
from pyimu.recording.formats.reader import Reader
from pyimu.recording.vectors import time_line, triad_map, unnamed
from pyimu.units import parse


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


def fog(reader: Reader) -> ForeignMap | None:
    """``fog.csv`` of KAIST's complex urban data set: ns since 1970, and the turns [rad] about the
    gyro's axes since the row before.
    """
    return _turns(reader, "gyro")


def fog_truth(reader: Reader) -> ForeignMap | None:
    """The same as a rate to judge another gyro by."""
    return _turns(reader, "ref_rate")


def _turns(reader: Reader, group: str) -> ForeignMap | None:
    cells = unnamed(reader, "fog", 4)
    if cells is None:
        return None
    at = reader.header.index(cells[0])
    columns, _ = next(reader.batches([at], at), ([np.zeros(0)], 1.0))
    period = 1e-9 * np.median(np.diff(columns[0])) if len(columns[0]) > 2 else 0.0
    if not period > 0:
        return None
    of_axes = {c: f"{group}_{a} [count]" for c, a in zip(cells[1:], "xyz", strict=True)}
    size = Scale(float(f"{1 / period:.6g}"), parse("rad/s"))
    return ForeignMap(
        columns={cells[0]: "time [ns]"} | of_axes,
        scale={f"{group}_{a}": size for a in "xyz"},
    )


def nclt_fog(reader: Reader) -> ForeignMap | None:
    """NCLT's ``kvh.csv`` (Carlevaris-Bianco et al. 2016): times in us, and the heading [rad] of a
    fibre-optic gyro, clockwise.
    """
    cells = unnamed(reader, "kvh", 2)
    if cells is None:
        return None
    columns = {cells[0]: "time [us]", cells[1]: "ref_heading [rad]"}
    return ForeignMap(columns=columns, body=BODY["frd"], world="ned")


MID_AIR = re.compile(r"(trajectory_\d+)/imu/gyroscope\[0\]")
"""The first column of a flight's gyro."""


def mid_air(reader: Reader) -> ForeignMap | None:
    """Mid-Air's ``sensor_records.hdf5`` (Fonder and Van Droogenbroeck 2019, and its page, "Data
    organization"): the first flight in it, at 100 Hz, in axes forward-right-down and
    north-east-down, with the attitude, place and velocity of its simulator.
    """
    first = next((m for c in reader.header if (m := MID_AIR.fullmatch(c))), None)
    if first is None:
        return None

    def three(name: str) -> list[str]:
        return [f"{first[1]}/{name}[{k}]" for k in range(3)]

    columns = triad_map(three("imu/gyroscope"), "gyro", "rad/s")
    columns |= triad_map(three("imu/accelerometer"), "accel", "m/s^2")
    for name, of in (("position", "ref_{}"), ("velocity", "ref_velocity_{}")):
        unit = "m" if name == "position" else "m/s"
        ways = zip(three(f"groundtruth/{name}"), ("north", "east", "down"), strict=True)
        columns |= {cell: f"{of.format(way)} [{unit}]" for cell, way in ways}
    columns |= {f"{first[1]}/groundtruth/attitude[{k}]": f"ref_q_{a}" for k, a in enumerate("wxyz")}
    there = {cell: target for cell, target in columns.items() if cell in reader.header}
    return ForeignMap(columns=there, body=BODY["frd"], world="ned", rate=100.0)


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
    ("KAIST's fibre-optic gyro, by its description", fog),
    ("NCLT's fibre-optic gyro, by its description", nclt_fog),
    ("Mid-Air, the first flight, by its description", mid_air),
    ("OxIOD's ground truth, by its description", oxiod_truth),
    ("KF-GINS's navigation result, by its description", solution),
)
"""What each is called, and its map."""
