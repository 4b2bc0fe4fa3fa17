"""A folder of Sensor Logger's files, one for each of a phone's sensors, as one log.

The app's UNITS.md and COORDINATES.md: time in ns since 1970, rad/s, m/s^2, uT.
``TotalAcceleration`` is the specific force; ``Accelerometer`` is without gravity. On iOS the signs
of accelerations are
the other way round, and ``AccelerometerUncalibrated`` is in g; ``Metadata.csv`` says which system
it was.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import islice
from pathlib import Path

from pyimu.errors import UserError
from pyimu.recording.column_map import ForeignMap
from pyimu.recording.columns import XYZ
from pyimu.recording.counts import Scale
from pyimu.recording.formats.lines import lines
from pyimu.units import parse

GYROS = ("Gyroscope.csv", "GyroscopeUncalibrated.csv")
FIELDS = ("MagnetometerUncalibrated.csv", "Magnetometer.csv")


def is_phone(folder: Path) -> bool:
    """Whether a folder holds a phone's gyro in a file of its own."""
    return any((folder / name).is_file() for name in GYROS)


def of_phone(folder: Path) -> tuple[Path, ForeignMap]:
    """The gyro's file, and the map of the whole log.

    The magnetometer without the phone's own calibration goes first. Raises UserError where it is
    not known which system wrote the files.
    """
    gyro = next(name for name in GYROS if (folder / name).is_file())
    files = []
    force = _force(folder)
    if force is not None:
        files.append(force)
    field = next((name for name in FIELDS if (folder / name).is_file()), None)
    if field is not None:
        files.append((field, _map("mag", "uT")))
    return folder / gyro, replace(_map("gyro", "rad/s"), files=tuple(files))


def _map(group: str, unit: str, scale: dict[str, Scale] | None = None) -> ForeignMap:
    columns = {"time": "time [ns]"} | {a: f"{group}_{a} [{unit}]" for a in XYZ}
    return ForeignMap(columns=columns, scale=scale or {})


def _force(folder: Path) -> tuple[str, ForeignMap] | None:
    """The file of the specific force and its map, None where only one without gravity is there."""
    total, plain = "TotalAcceleration.csv", "AccelerometerUncalibrated.csv"
    there = [name for name in (total, plain) if (folder / name).is_file()]
    if not there:
        return None
    system = _system(folder)
    if system == "android":
        return there[0], _map("accel", "m/s^2")
    value, unit = (-1.0, "m/s^2") if there[0] == total else (-1.0, "g")
    scale = {f"accel_{a}": Scale(value, parse(unit)) for a in XYZ}
    return there[0], _map("accel", "count", scale)


def _system(folder: Path) -> str:
    """ "android" or "ios", by Metadata.csv. Raises UserError where that does not tell."""
    path = next((p for p in sorted(folder.iterdir()) if p.name.lower() == "metadata.csv"), None)
    text = " ".join(islice(lines(path), 5)).casefold() if path is not None else ""
    for system in ("android", "ios"):
        if system in text:
            return system
    raise UserError(
        f"{folder}: Metadata.csv does not say whether Android or iOS wrote this, and their "
        "accelerations differ in sign; add that file, or name the files in a column map with "
        "[[file]]"
    )
