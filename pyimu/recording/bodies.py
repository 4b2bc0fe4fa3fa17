"""What the columns of data sets of people with sensors on them are."""

from __future__ import annotations

from pyimu.errors import Finding
from pyimu.recording.column_map import ForeignMap
from pyimu.recording.columns import XYZ
from pyimu.recording.formats.bodies import PAMAP2, PLACES, TOTAL_CAPTURE, WISDM
from pyimu.recording.formats.reader import Reader
from pyimu.recording.vectors import triad_map


def wisdm(reader: Reader) -> ForeignMap | None:
    """WISDM's raw files (readme): ns since the phone started, m/s^2; of the second data set rad/s
    where the file's name says that it is the gyro's.
    """
    if tuple(reader.header) != WISDM:
        return None
    gyro = "gyro" in reader.path.name.casefold()
    vector = triad_map(XYZ, "gyro", "rad/s") if gyro else triad_map(XYZ, "accel", "m/s^2")
    return ForeignMap(columns={"timestamp": "time [ns]"} | vector)


def pamap2(reader: Reader) -> ForeignMap | None:
    """PAMAP2 (readme.pdf, section II.1): s, rad/s, m/s^2 of the accelerometer of 16 g, uT and degC
    of the unit at the hand; those at chest and ankle are listed as left out.
    """
    if tuple(reader.header) != PAMAP2:
        return None
    own, *others = PLACES
    columns = {"timestamp": "time [s]", f"{own} temperature": "temperature [degC]"}
    for what, group, unit in (("gyro", "gyro", "rad/s"), ("acc16", "accel", "m/s^2")):
        columns |= triad_map([f"{own} {what} {a}" for a in XYZ], group, unit)
    columns |= triad_map([f"{own} mag {a}" for a in XYZ], "mag", "uT")
    notes = [
        Finding("vector_left_out", cells[0], 3, {"columns": ", ".join(cells)})
        for place in others
        for what in ("gyro", "acc16")
        if (cells := [f"{place} {what} {a}" for a in XYZ])
    ]
    return ForeignMap(columns=columns, notes=tuple(notes))


def total_capture(reader: Reader) -> ForeignMap | None:
    """TotalCapture's sensors (Trumble et al. 2017; Xsens): rad/s and m/s^2 in the sensor's axes.

    The attitude is the sensors' own estimate, and the magnetometer has no unit.
    """
    if tuple(reader.header) != TOTAL_CAPTURE:
        return None
    columns = triad_map([f"angular rate {a}" for a in XYZ], "gyro", "rad/s")
    return ForeignMap(
        columns=columns | triad_map([f"acceleration {a}" for a in XYZ], "accel", "m/s^2")
    )


BODIES = (
    ("WISDM, by its readme", wisdm),
    ("PAMAP2, by its readme", pamap2),
    ("TotalCapture, by its description", total_capture),
)
"""What each is called, and its map."""
