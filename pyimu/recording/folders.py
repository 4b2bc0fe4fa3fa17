"""Folders that are one log: a phone's, a MetaMotion's or an NGIMU's, comma2k19's, KITTI's ``oxts``
or the drive around it, and a sequence of EuRoC MAV or TUM VI with its ground truth.

The sequence's layout is that of Burri et al. 2016 (EuRoC), which TUM VI keeps: ``mav0`` with a
folder for each instrument, each with its ``data.csv``.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from pyimu.files import exists
from pyimu.recording.column_map import ForeignMap
from pyimu.recording.comma import of_comma
from pyimu.recording.formats.oxts import oxts_in
from pyimu.recording.formats.text import CsvReader
from pyimu.recording.phone import is_phone, of_phone

IMU, TABLE = "imu0", "data.csv"

TRUTHS = ("state_groundtruth_estimate0", "mocap0", "vicon0")
"""Instruments that are a reference, the best first."""

NGIMU = "sensors.csv"
"""What x-io's programs call the file of gyro, accelerometer and magnetometer of one device."""

LAYERS = ("mav0", IMU, "oxts", "IMU", "processed_log")
"""Folders inside a sequence, which do not name it."""


class FolderLog(NamedTuple):
    """A folder as a log: the file that is read first, its map, and the ground truth beside it."""

    name: str
    path: Path
    foreign: ForeignMap
    truth: Path | None = None


def log_in(folder: Path) -> FolderLog | None:
    """The log that a folder is, None for any other folder and for a file.

    Raises UserError as ``of_phone`` does.
    """
    if not exists(folder) or not folder.is_dir():
        return None
    if is_phone(folder):
        return FolderLog(folder.resolve().name, *of_phone(folder))
    named = next(p for p in (folder.resolve(), *folder.resolve().parents) if p.name not in LAYERS)
    comma = of_comma(folder)
    if comma is not None:
        return FolderLog(named.name, *comma)
    oxts = oxts_in(folder)
    if oxts is not None:
        return FolderLog(named.name, oxts, ForeignMap())
    if _is_ngimu(folder / NGIMU):
        return FolderLog(named.name, folder / NGIMU, ForeignMap())
    table = next((p for p in _tables(folder) if p.is_file()), None)
    return table and FolderLog(named.name, table, ForeignMap(), truth_beside(table))


def _is_ngimu(path: Path) -> bool:
    """Whether a file is NGIMU's or x-IMU3's of its sensors, whose header states all units."""
    if not path.is_file():
        return False
    needed = {f"{s} {a}" for s in ("Gyroscope", "Accelerometer") for a in "XYZ"}
    return needed <= {cell.partition(" (")[0] for cell in CsvReader.open(path).header}


def _tables(folder: Path) -> list[Path]:
    inside = [folder / "mav0" / IMU / TABLE, folder / IMU / TABLE]
    return [*inside, *([folder / TABLE] if folder.resolve().name == IMU else [])]


def truth_beside(path: Path | None) -> Path | None:
    """The ground truth of a sequence whose inertial unit is in the file ``path``, None without."""
    if path is None or path.name != TABLE or path.absolute().parent.name != IMU:
        return None
    beside = (path.parent.parent / name / TABLE for name in TRUTHS)
    return next((truth for truth in beside if truth.is_file()), None)
