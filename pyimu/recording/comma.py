"""comma2k19 (Schafer et al. 2018, and its readme, "Log Format"): a folder for each sensor of a
phone in a car, in seconds since its start, rad/s and m/s^2, forward, right and down.

The gyro without Android's correction goes first. What the magnetometer's numbers are in its readme
says otherwise than Android does, and it is left out.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from pyimu.recording.column_map import BODY, ForeignMap
from pyimu.recording.formats.timed_array import TIME, VALUE, is_timed_array
from pyimu.recording.vectors import triad_map

GYROS = ("gyro_uncalibrated", "gyro")
ACCEL = "accelerometer"
INSIDE = ("", "IMU", "processed_log/IMU")
"""Where the folders of the sensors lie in what is given."""


def of_comma(folder: Path) -> tuple[Path, ForeignMap] | None:
    """The gyro's folder, and the map of the log that a folder is; None where it is none."""
    for place in (folder / name for name in INSIDE):
        gyro = next((place / g for g in GYROS if is_timed_array(place / g)), None)
        if gyro is not None:
            files = ((ACCEL, _map("accel", "m/s^2")),) if is_timed_array(place / ACCEL) else ()
            return gyro, replace(_map("gyro", "rad/s"), files=files)
    return None


def _map(group: str, unit: str) -> ForeignMap:
    cells = [f"{VALUE}[{k}]" for k in range(3)]
    columns = {TIME: "time [s]"} | triad_map(cells, group, unit)
    return ForeignMap(columns=columns, body=BODY["frd"])
