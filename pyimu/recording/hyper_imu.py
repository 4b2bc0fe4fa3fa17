"""HyperIMU's tables of a phone's sensors."""

from __future__ import annotations

import re

from pyimu.recording.column_map import ForeignMap
from pyimu.recording.columns import XYZ
from pyimu.recording.formats.reader import Reader
from pyimu.recording.vectors import triad_map

SENSORS = {
    "gyroscope": ("gyro", "rad/s"),
    "accelerometer": ("accel", "m/s^2"),
    "magnetometer": ("mag", "uT"),
    "magnetic_field": ("mag", "uT"),
}
"""Words in a sensor's name, which is the phone's own, and what it holds in Android's unit."""


def hyper_imu(reader: Reader) -> ForeignMap | None:
    """HyperIMU's text (its documentation, "Technical notes"): the sensors of Android in its units
    and axes, each vector x first, and ms since 1970 where the user asked for times.
    """
    if not any(cell.endswith(".x") for cell in reader.header):
        return None
    if not re.match(r"@ *HyperIMU", next(reader.lines(), ""), re.I):
        return None
    columns: dict[str, str] = {}
    for stem in (cell[:-2] for cell in reader.header if cell.endswith(".x")):
        word = next((word for word in SENSORS if word in stem.casefold()), None)
        cells = [f"{stem}.{a}" for a in XYZ]
        if word is None or not set(cells) <= set(reader.header):
            continue
        vector = triad_map(cells, *SENSORS[word])
        if not set(vector.values()) & set(columns.values()):
            columns |= vector
    time = next((cell for cell in reader.header if cell.casefold() == "timestamp"), None)
    return ForeignMap(columns=({} if time is None else {time: "time [ms]"}) | columns)
