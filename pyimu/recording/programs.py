"""Tables of programs, loggers and data sets whose columns are known by what describes them."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from itertools import islice

from pyimu.errors import UserError
from pyimu.recording.bodies import BODIES
from pyimu.recording.column_map import BODY, ForeignMap
from pyimu.recording.columns import XYZ
from pyimu.recording.counts import Scale
from pyimu.recording.formats.layout import FAR
from pyimu.recording.formats.marked import GNSS_LOGGER
from pyimu.recording.formats.reader import Reader
from pyimu.recording.formats.sections import EMPATICA
from pyimu.recording.hyper_imu import hyper_imu
from pyimu.recording.novatel import novatel
from pyimu.recording.vectors import time_line, triad_map
from pyimu.units import parse

GYROFLOW = ("GYROFLOW IMU LOG", "CAMERA IMU LOG")
"""First lines of Gyroflow's text."""

GCSV = {"t": ("time", "tscale", "s"), "g": ("gyro", "gscale", "rad/s")} | {
    "a": ("accel", "ascale", "g"),
    "m": ("mag", "mscale", "gauss"),
}
"""By the first letter of its columns the quantity, the name of a count's size, and its unit."""


def gyroflow(reader: Reader) -> ForeignMap | None:
    """Gyroflow's ``.gcsv`` (docs.gyroflow.xyz, "GCSV format"): counts, of which the lines before
    the table say the size, in s, rad/s and g.

    Its axes are those of the sensor; ``orientation`` is that in the camera. A magnetometer's unit
    is not settled there, and it is left out.
    """
    if reader.header[:4] != ["t", "gx", "gy", "gz"]:
        return None
    head = [line.strip() for line in islice(reader.lines(), 60)]
    if not head or not head[0].upper().startswith(GYROFLOW):
        return None
    said = {key.strip(): value.strip() for key, _, value in (line.partition(",") for line in head)}
    columns, scale = {}, {}
    for cell in reader.header:
        group, key, unit = GCSV.get(cell[:1], ("", "", ""))
        if group in ("time", "gyro", "accel") and cell in ("t", *(f"{cell[0]}{a}" for a in XYZ)):
            name = "time" if group == "time" else f"{group}_{cell[1]}"
            columns[cell] = f"{name} [count]"
            scale[name] = Scale(_number(reader, said, key), parse(unit))
    return ForeignMap(columns=columns, scale=scale)


def _number(reader: Reader, said: dict[str, str], key: str) -> float:
    """The number behind ``key`` in the lines before the table. Raises UserError for none."""
    try:
        value = float(said.get(key, ""))
    except ValueError:
        value = 0.0
    if not 0 < abs(value) < math.inf:
        raise UserError(
            f"{reader.path}: the lines before the table have no {key}, the size of a count; add "
            f"one such as {key},0.001"
        )
    return value


GNSS_UNITS = {"Accel": ("accel", "m/s^2", "Mps2"), "Gyro": ("gyro", "rad/s", "RadPerSec")} | {
    "Mag": ("mag", "uT", "MicroT")
}
"""What GnssLogger's words hold, in which unit, and how that ends the names of its fields."""


def gnss_logger(reader: Reader) -> ForeignMap | None:
    """Android's GnssLogger (LOGGING_FORMAT.md of gps-measurement-tools): the instant of each sample
    in ns since the phone started; without the phone's own calibrations where both are there.
    """
    own = next((word for word in GNSS_LOGGER if reader.header[:1] == [word]), None)
    if own is None or "elapsedRealtimeNanos" not in reader.header:
        return None
    files: list[tuple[str, ForeignMap]] = []
    if own in ("UncalGyro", "Gyro"):
        there = _words(reader)
        for kind in ("Accel", "Mag"):
            word = next((w for w in (f"Uncal{kind}", kind) if w in there), None)
            if word is not None:
                other = ForeignMap(columns=_gnss_columns(word), topics={"imu": word})
                files.append((reader.path.name, other))
    return ForeignMap(columns=_gnss_columns(own), files=tuple(files))


def _gnss_columns(word: str) -> dict[str, str]:
    group, unit, ending = GNSS_UNITS[word.removeprefix("Uncal")]
    cells = [f"{word}{a}{ending}" for a in "XYZ"]
    return {"elapsedRealtimeNanos": "time [ns]"} | triad_map(cells, group, unit)


def _words(reader: Reader) -> set[str]:
    """The words that rows of GnssLogger begin with."""
    found: set[str] = set()
    for line in islice(reader.lines(), FAR):
        found.add(line.partition(",")[0])
        if {"UncalAccel", "UncalMag"} <= found:
            break
    return found


def open_log(reader: Reader) -> ForeignMap | None:
    """SparkFun's OpenLog Artemis (its ICM-20948: mg, deg/s, uT): date and time of day in hundredths
    of a second.
    """
    force, rate, field = ([f"{n}{a}" for a in "XYZ"] for n in "agm")
    if not {"rtcTime", *force, *rate} <= set(reader.header) or "rtcTime" not in reader.clocks:
        return None
    columns = {"rtcTime": "time [s]"}
    columns |= triad_map(force, "accel", "mg") | triad_map(rate, "gyro", "deg/s")
    if set(field) <= set(reader.header):
        columns |= triad_map(field, "mag", "uT")
    if "imu_degC" in reader.header:
        columns["imu_degC"] = "temperature [degC]"
    return ForeignMap(columns=columns)


def witmotion(reader: Reader) -> ForeignMap | None:
    """A table of WitMotion's program for its wireless sensors (its manual, "Record"): the sensor's
    own clock, where that is filled in, and the time at which the computer had the sample else.
    """
    rate, force, field = (
        [f"{n} {a}({u})" for a in "XYZ"]
        for n, u in (("Angular velocity", "°/s"), ("Acceleration", "g"), ("Magnetic field", "ʯt"))
    )
    time = next((c for c in ("Chip Time()", "Time") if c in reader.clocks), None)
    if time is None or not {"Chip Time()", *rate, *force} <= set(reader.header):
        return None
    columns = {time: "time [s]"} | triad_map(rate, "gyro", "deg/s") | triad_map(force, "accel", "g")
    columns |= triad_map(field, "mag", "uT") if set(field) <= set(reader.header) else {}
    warm = next((c for c in reader.header if c in ("Temperature(℃)", "Temperature(°C)")), None)
    return ForeignMap(columns=columns | ({} if warm is None else {warm: "temperature [degC]"}))


def bag_text(reader: Reader) -> ForeignMap | None:
    """``imu.txt`` of the data sets of UZH (FPV, event cameras), which rpg's scripts write of bags:
    s since 1970, rad/s, m/s^2. Others with these names count in ns or us: the numbers tell.
    """
    rate, force = ([f"{n}_{a}" for a in XYZ] for n in ("ang_vel", "lin_acc"))
    if not {"timestamp", *rate, *force} <= set(reader.header):
        return None
    time = time_line(reader, ["timestamp"])
    if not time:
        return None
    columns = time | triad_map(rate, "gyro", "rad/s") | triad_map(force, "accel", "m/s^2")
    return ForeignMap(columns=columns)


def ronin(reader: Reader) -> ForeignMap | None:
    """RoNIN's data.hdf5 (Herath et al. 2020, and the data set's README): the phone's ``synced``
    arrays, s, rad/s without Android's calibration, m/s^2, uT.

    Its poses are those of another phone on the body, and no truth of this one's.
    """
    cells = set(reader.header)
    vectors = (("gyro_uncalib", "gyro", "rad/s"), ("acce", "accel", "m/s^2"))
    columns = {"synced/time": "time [s]"}
    for name, group, unit in (*vectors, ("magnet", "mag", "uT")):
        three = [f"synced/{name}[{k}]" for k in range(3)]
        if set(three) <= cells:
            columns |= triad_map(three, group, unit)
    needed = {"synced/time", "synced/gyro_uncalib[0]", "synced/acce[0]", "pose/tango_pos[0]"}
    return ForeignMap(columns=columns) if needed <= cells else None


def nuscenes(reader: Reader) -> ForeignMap | None:
    """``ms_imu`` of nuScenes' CAN bus (README of the devkit's can_bus): us since 1970, rad/s and
    m/s^2; ``q`` is an estimate.
    """
    rate, force = ([f"{n}[{k}]" for k in range(3)] for n in ("rotation_rate", "linear_accel"))
    if not {"utime", *rate, *force} <= set(reader.header):
        return None
    columns = {"utime": "time [us]"} | triad_map(rate, "gyro", "rad/s")
    return ForeignMap(columns=columns | triad_map(force, "accel", "m/s^2"))


_PX4 = re.compile(r"(.*?)(gyro_rad|accelerometer_m_s2)(?:\[(\d)\]|\.0?(\d))")
"""Elements of ``sensor_combined`` in ulog2csv's tables, and in PlotJuggler's behind its name."""


def px4_table(reader: Reader) -> ForeignMap | None:
    """A table of PX4's ``sensor_combined`` (SensorCombined.msg), as ulog2csv of pyulog or
    PlotJuggler writes it: us, or s in ``__time``, rad/s, m/s^2, forward-right-down.
    """
    found: dict[str, dict[tuple[str, str], str]] = {}
    for cell in reader.header:
        if match := _PX4.fullmatch(cell):
            found.setdefault(match[1], {})[match[2], match[3] or match[4]] = cell
    for stem, cells in found.items():
        times = {f"{stem}timestamp": "us", "timestamp": "us", "__time": "s"}
        time = next((t for t in times if t in reader.header), None)
        if time is None or len(cells) != 6 or stem and "sensor_combined" not in stem:
            continue
        rate, force = ([cells.get((n, str(k)), "") for k in range(3)] for n in _PX4_NAMES)
        columns = {time: f"time [{times[time]}]"} | triad_map(rate, "gyro", "rad/s")
        if all(rate) and all(force):
            columns |= triad_map(force, "accel", "m/s^2")
            return ForeignMap(columns=columns, body=BODY["frd"])
    return None


_PX4_NAMES = ("gyro_rad", "accelerometer_m_s2")


def ardupilot_table(reader: Reader) -> ForeignMap | None:
    """A table of ArduPilot's ``IMU``, as pymavlink's mavlogdump writes it (its log messages): us,
    rad/s, m/s^2, forward-right-down.
    """
    rate, force = ([f"{n}{a}" for a in "XYZ"] for n in ("Gyr", "Acc"))
    if not {"TimeUS", *rate, *force} <= set(reader.header):
        return None
    columns = {"TimeUS": "time [us]"} | triad_map(rate, "gyro", "rad/s")
    columns |= triad_map(force, "accel", "m/s^2")
    columns |= {"T": "temperature [degC]"} if "T" in reader.header else {}
    return ForeignMap(columns=columns, body=BODY["frd"])


def mavlink_table(reader: Reader) -> ForeignMap | None:
    """A table of MAVLink's SCALED_IMU (ms, mrad/s, mg, mgauss, hundredths of degC) or HIGHRES_IMU
    (us, rad/s, m/s^2, gauss, degC), by the messages' definitions; forward-right-down.
    """
    rate, force, field = ([f"{a}{n}" for a in XYZ] for n in ("gyro", "acc", "mag"))
    cells = set(reader.header)
    if not {*rate, *force} <= cells:
        return None
    scaled = "time_boot_ms" in cells
    if not scaled and not {"time_usec", "abs_pressure"} <= cells:
        return None
    units = ("mrad/s", "mg", "mgauss") if scaled else ("rad/s", "m/s^2", "gauss")
    columns = {"time_boot_ms": "time [ms]"} if scaled else {"time_usec": "time [us]"}
    columns |= triad_map(rate, "gyro", units[0]) | triad_map(force, "accel", units[1])
    columns |= triad_map(field, "mag", units[2]) if set(field) <= cells else {}
    scale = {}
    if "temperature" in cells:
        columns["temperature"] = f"temperature [{'count' if scaled else 'degC'}]"
        scale = {"temperature": Scale(0.01, parse("degC"))} if scaled else {}
    return ForeignMap(columns=columns, scale=scale, body=BODY["frd"])


def vectornav_table(reader: Reader) -> ForeignMap | None:
    """A table of a VectorNav sensor's binary output, as its library's exporter writes it (its
    manuals, "IMU group"): ns, rad/s, m/s^2, gauss, kPa, forward-right-down.
    """
    rate, force, field = ([f"Uncomp{n}{a}" for a in "XYZ"] for n in ("Gyro", "Accel", "Mag"))
    time = next((c for c in ("TimeStartup", "TimeGps") if c in reader.header), None)
    if time is None or not {*rate, *force} <= set(reader.header):
        return None
    columns = {time: "time [ns]"} | triad_map(rate, "gyro", "rad/s")
    columns |= triad_map(force, "accel", "m/s^2")
    columns |= triad_map(field, "mag", "gauss") if set(field) <= set(reader.header) else {}
    if "Temperature" in reader.header:
        columns["Temperature"] = "temperature [degC]"
    return ForeignMap(columns=columns, body=BODY["frd"])


def empatica(reader: Reader) -> ForeignMap | None:
    """Empatica's E4, ACC.csv (E4 connect, "info.txt"): 64 counts a g; its rate stands above."""
    if tuple(reader.header) != EMPATICA or reader.rate is None:
        return None
    scale = {f"accel_{a}": Scale(1 / 64, parse("g")) for a in XYZ}
    return ForeignMap(columns=triad_map(list(EMPATICA), "accel", "count"), scale=scale)


PROGRAMS: tuple[tuple[str, Callable[[Reader], ForeignMap | None]], ...] = (
    ("Gyroflow's log, by its description", gyroflow),
    ("GnssLogger, by its description", gnss_logger),
    ("OpenLog Artemis, by its firmware", open_log),
    ("WitMotion, by its manual", witmotion),
    ("imu.txt of a bag, by its names", bag_text),
    ("RoNIN, by its description", ronin),
    ("Empatica E4, by its description", empatica),
    ("nuScenes' CAN bus, by its description", nuscenes),
    ("VectorNav's binary output, by its manuals", vectornav_table),
    ("PX4's sensor_combined, by its definition", px4_table),
    ("NovAtel's raw samples, by its manual", novatel),
    ("HyperIMU, by its documentation", hyper_imu),
    *BODIES,
    ("ArduPilot's IMU, by its definition", ardupilot_table),
    ("MAVLink's message of an inertial unit, by its definition", mavlink_table),
)
"""What each is called, and its map."""
