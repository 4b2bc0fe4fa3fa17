"""Logs of Apple's phones and watches: Core Motion's quantities in a table of their own.

``rotationRate`` is in rad/s, ``gravity`` and ``userAcceleration`` in g, ``magneticField`` in uT
(Apple, documentation of CMDeviceMotion, CMAccelerometerData). Signs of accelerations are the other
way round: see ``pyimu.recording.formats.whole_force``.
"""

from __future__ import annotations

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.column_map import ForeignMap
from pyimu.recording.columns import XYZ
from pyimu.recording.counts import Scale
from pyimu.recording.formats.reader import Reader
from pyimu.recording.formats.whole_force import FORCE, WholeForceReader
from pyimu.recording.naming.name import named
from pyimu.recording.naming.triads import surest, triads, vectors
from pyimu.recording.naming.words import TRUTHS
from pyimu.recording.vectors import time_line, triad_map, unnamed
from pyimu.units import parse

Three = tuple[int, int, int]

OXIOD: tuple[str, int, Three, Three] = ("imu", 16, (7, 8, 9), (10, 11, 12))
"""A word in the name of OxIOD's files, their columns, and where gravity and the acceleration are;
they have no names (Chen et al. 2018, and the data set's readme)."""

OF_ONE = 0.02
"""By how much the size of gravity may be off 1 g, which it is by its definition."""


def with_whole_force(reader: Reader) -> Reader:
    """``reader`` with the specific force that its gravity and user acceleration are together, where
    it has those two in g and no accelerometer.
    """
    found = _parts(reader)
    if found is None or not {*found[0], *found[1]} <= set(reader.numeric()):
        return reader
    columns, _ = next(reader.batches(list(found[0]), found[0][0]), ([np.zeros(0)] * 3, 1.0))
    size = np.linalg.norm(np.column_stack([c.astype(float) for c in columns]), axis=1)
    size = size[np.isfinite(size)]
    in_g = len(size) > 0 and abs(float(np.median(size)) - 1) < OF_ONE
    return WholeForceReader(reader, *found) if in_g else reader


def _parts(reader: Reader) -> tuple[Three, Three] | None:
    """Positions of gravity and of the acceleration without it, None where they are not there."""
    word, width, gravity, user = OXIOD
    if FORCE[0] in reader.header:
        return None
    if unnamed(reader, word, width) is not None:
        return gravity, user
    best, _ = surest(triads(reader.header), "accel")
    if best is not None and "user" not in best.names[0].words:
        return None
    names = [named(cell) for cell in reader.header]
    fields = [
        vectors({k: name for k, name in enumerate(names) if part in name.words})
        for part in ("gravity", "user")
    ]
    if any(len(found) != 1 for found in fields):
        return None
    units = {names[k].unit for field in fields for k in field[0]}
    return (fields[0][0], fields[1][0]) if units <= {None, "g", "G"} else None


def core_motion(reader: Reader) -> ForeignMap | None:
    """A table of CMDeviceMotion, as MotionSense and OxIOD have it, with gravity apart."""
    if FORCE[0] not in reader.header:
        return _without_gravity(reader)
    columns = triad_map(FORCE, "accel", "g")
    cells = unnamed_oxiod(reader)
    if cells is not None:
        columns |= triad_map(cells[4:7], "gyro", "rad/s") | triad_map(cells[13:16], "mag", "uT")
        return ForeignMap(columns=time_line(reader, cells[:1]) | columns)
    found = triads(reader.header)
    for group, unit in (("gyro", "rad/s"), ("mag", "uT")):
        triad, _ = surest(found, group)
        if triad is not None and (triad.units is not None or group == "gyro"):
            vector = [name.cell for name in triad.names]
            columns |= triad_map(vector, group, triad.units or unit)
    return ForeignMap(columns=time_line(reader, _times(reader)) | columns)


def _times(reader: Reader) -> list[str]:
    """The columns that are called times, those of Core Motion first."""
    times = [n for n in map(named, reader.header) if n.is_time and not set(n.words) & TRUTHS]
    return [n.cell for n in sorted(times, key=lambda name: "motion" not in name.words)]


def _without_gravity(reader: Reader) -> ForeignMap | None:
    """Such a table of which gravity was left out: the gyro's alone, for what is left of the force
    is no accelerometer's.
    """
    found = triads(reader.header)
    gyro, force = (surest(found, group)[0] for group in ("gyro", "accel"))
    if gyro is None or force is None or any("gravity" in named(c).words for c in reader.header):
        return None
    words = (gyro.names[0].words[-2:], force.names[0].words[-2:])
    if words != (("rotation", "rate"), ("user", "acceleration")):
        return None
    columns = triad_map([name.cell for name in gyro.names], "gyro", gyro.units or "rad/s")
    cells = ", ".join(name.cell for name in force.names)
    note = Finding("no_gravity", "accel", 1, {"columns": cells})
    return ForeignMap(columns=time_line(reader, _times(reader)) | columns, notes=(note,))


def unnamed_oxiod(reader: Reader) -> list[str] | None:
    """The columns of one of OxIOD's files but for the force that was made, None of any other."""
    word, width, *_ = OXIOD
    own = reader.reader if isinstance(reader, WholeForceReader) else reader
    return unnamed(own, word, width)


def sensor_log(reader: Reader) -> ForeignMap | None:
    """SensorLog's table: the gyro's own samples and stamps where they are there, else those of
    Core Motion, and the accelerometer in g with Apple's sign.
    """
    force = [f"accelerometerAcceleration{a}(G)" for a in "XYZ"]
    there = {reader.header[k] for k in reader.numeric()}
    if not set(force) <= there:
        return None
    scale = {f"accel_{a}": Scale(-1.0, parse("g")) for a in XYZ}
    columns = triad_map(force, "accel", "count")
    for source, vector in (("gyro", "gyroRotation"), ("motion", "motionRotationRate")):
        cells = [f"{vector}{a}(rad/s)" for a in "XYZ"]
        stamp = f"{source}Timestamp_sinceReboot(s)"
        if {stamp, *cells} <= there:
            columns |= {stamp: "time [s]"} | triad_map(cells, "gyro", "rad/s")
            return ForeignMap(columns=columns, scale=scale)
    stamp = "accelerometerTimestamp_sinceReboot(s)"
    return (
        ForeignMap(columns=columns | {stamp: "time [s]"}, scale=scale) if stamp in there else None
    )
