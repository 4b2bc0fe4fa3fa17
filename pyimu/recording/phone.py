"""A folder of the files of a phone, one for each of its sensors, as one log.

Sensor Logger (its UNITS.md and COORDINATES.md): time in ns since 1970, rad/s, m/s^2, uT.
``TotalAcceleration`` is the specific force; ``Accelerometer`` is without gravity. On iOS the signs
of accelerations are the other way round, and ``AccelerometerUncalibrated`` is in g;
``Metadata.csv`` says which system it was.

phyphox (its wiki, "Export"): a table a sensor whose header says ``Time (s)`` and the unit of each
axis, with one clock and the same signs on both systems; ``Accelerometer`` is the specific force.

MetaBase (MetaMotion): a table a sensor, ``NAME_Gyroscope_100.000Hz_1.7.3.csv``, whose header says
``epoc (ms)``, a clock of all of them, and the unit of each axis.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import islice
from pathlib import Path

from pyimu.errors import Finding, UserError
from pyimu.recording.column_map import ForeignMap
from pyimu.recording.columns import XYZ
from pyimu.recording.counts import Scale
from pyimu.recording.formats.lines import lines
from pyimu.recording.formats.text import CsvReader
from pyimu.recording.guess.numbers import SECONDS
from pyimu.recording.naming.name import named
from pyimu.recording.naming.triads import surest, triads
from pyimu.recording.vectors import triad_map
from pyimu.units import parse

GYROS = ("Gyroscope.csv", "GyroscopeUncalibrated.csv")
WITHOUT = "Accelerometer.csv"
"""Sensor Logger's force without gravity."""

FIELDS = ("MagnetometerUncalibrated.csv", "Magnetometer.csv")


STATED = (("Accelerometer.csv", "accel"), ("Magnetometer.csv", "mag"))
"""Further files of phyphox, and what they hold."""


METABASE = (("Accelerometer", "accel"), ("Magnetometer", "mag"))
"""Further files of MetaBase, and what they hold."""


def is_phone(folder: Path) -> bool:
    """Whether a folder holds a phone's gyro in a file of its own, or that of one MetaMotion."""
    phones = any((folder / name).is_file() for name in GYROS)
    return phones or _of_sensor(folder, "Gyroscope") is not None


def _of_sensor(folder: Path, sensor: str) -> Path | None:
    """The one file of MetaBase in a folder that is of a ``sensor``."""
    found = list(folder.glob(f"*_{sensor}_*Hz_*.csv"))
    return found[0] if len(found) == 1 else None


def _of_metabase(folder: Path, gyro: Path) -> tuple[Path, ForeignMap] | None:
    first = _by_header(gyro, "gyro")
    if first is None:
        return None
    there = [(_of_sensor(folder, sensor), group) for sensor, group in METABASE]
    found = [(path.name, _by_header(path, group)) for path, group in there if path is not None]
    return gyro, replace(first, files=tuple((name, own) for name, own in found if own is not None))


def of_phone(folder: Path) -> tuple[Path, ForeignMap]:
    """The gyro's file, and the map of the whole log.

    The magnetometer without the phone's own calibration goes first. Raises UserError where it is
    not known which program or which system wrote the files.
    """
    own = _of_sensor(folder, "Gyroscope")
    if own is not None and (found := _of_metabase(folder, own)) is not None:
        return found
    gyro = folder / next((name for name in GYROS if (folder / name).is_file()), own or GYROS[0])
    header = CsvReader.open(gyro).header
    if not {"time", *XYZ} <= set(header):
        return gyro, _of_phyphox(folder, gyro)
    files = []
    force = _force(folder)
    if force is not None:
        files.append(force)
    field = next((name for name in FIELDS if (folder / name).is_file()), None)
    if field is not None:
        files.append((field, _map("mag", "uT")))
    notes = ()
    if force is None and (folder / WITHOUT).is_file():
        notes = (Finding("no_gravity", "accel", 1, {"file": WITHOUT}),)
    return gyro, replace(_map("gyro", "rad/s"), files=tuple(files), notes=notes)


def _of_phyphox(folder: Path, gyro: Path) -> ForeignMap:
    first = _by_header(gyro, "gyro")
    if first is None:
        raise UserError(
            f"{gyro}: its columns are neither Sensor Logger's (time, x, y, z) nor phyphox's "
            "(Time (s), X (rad/s), ...): give the files in the folder, with a column map"
        )
    there = [(name, group) for name, group in STATED if (folder / name).is_file()]
    found = [(name, _by_header(folder / name, group)) for name, group in there]
    return replace(first, files=tuple((name, own) for name, own in found if own is not None))


def _by_header(path: Path, group: str) -> ForeignMap | None:
    """The map of a file that states its units, None where it holds no such vector."""
    header = CsvReader.open(path).header
    time = next((n for n in map(named, header) if n.is_time and n.unit in SECONDS), None)
    triad, _ = surest(triads(header, path.name), group)
    if time is None or triad is None or triad.units is None:
        return None
    columns = triad_map([name.cell for name in triad.names], group, triad.units)
    return ForeignMap(columns={time.cell: f"time [{time.unit}]"} | columns)


def _map(group: str, unit: str, scale: dict[str, Scale] | None = None) -> ForeignMap:
    columns = {"time": "time [ns]"} | triad_map(XYZ, group, unit)
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
