"""Logs whose columns, units and axes are known: by their format's definition, or by their header.

Each gives the column map that a user would have to write. A log whose header states every unit in
spellings of its own (``Gyroscope X (deg/s)``), and holds one vector of each kind only, is of the
second sort.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from pyimu.errors import Finding
from pyimu.recording.apple import core_motion, sensor_log
from pyimu.recording.column_map import BODY, ForeignMap
from pyimu.recording.columns import ANGLES, GROUP_OF, XYZ, own_name
from pyimu.recording.formats.oxts import CLOCK, TIME, is_oxts
from pyimu.recording.formats.reader import Reader
from pyimu.recording.formats.suffix import open_reader
from pyimu.recording.messages import imu_message, pose_message
from pyimu.recording.naming.name import Name, named, thermometer
from pyimu.recording.naming.triads import Triad, others, surest, triads
from pyimu.recording.naming.words import TRUTHS
from pyimu.recording.optical import optical_body
from pyimu.recording.programs import PROGRAMS
from pyimu.recording.surveys import SURVEYS, fog_truth
from pyimu.recording.vectors import triad_map, unnamed
from pyimu.recording.xsens import xsens
from pyimu.units import FREEZING, same_dimension

STATED = "a table that states its units"
"""What a log is called whose header says all of it."""

Known = tuple[str, ForeignMap]
"""What the log is, and its map."""


def recognised(reader: Reader, wanted: str = "sensor", rate: float | None = None) -> Known | None:
    """What is known of the log in ``reader``, None where nothing is; ``wanted`` is what it must
    hold, see ``Header``, ``rate`` [Hz] what a map says of one without times.
    """
    joined = _in_rows_of_their_own(reader) if reader.words else None
    if joined is not None:
        return STATED, joined
    if is_own(reader.header):
        return None
    for name, test in (*(TRUTHS_OF if wanted == "reference" else ()), *FORMATS):
        columns = test(reader)
        if columns is not None:
            return name, columns
    found = stated(reader, rate or reader.rate)
    return None if found is None else (STATED, found)


def said(known: Known, columns: Sequence[str]) -> list[Finding]:
    """That the log was recognised.

    Where its header alone says what it is, and not of both sensors, the vectors that are left out.
    """
    found = [Finding("recognised", "", len(columns), {"as": known[0]})]
    groups = {target.partition("_")[0] for target in known[1].columns.values()}
    if known[0] != STATED or {"gyro", "accel"} <= groups:
        return found
    taken = [k for k, cell in enumerate(columns) if cell in known[1].columns]
    return found + [_left_out(columns, at) for at in others(columns, taken)]


def left_out(columns: Sequence[str], taken: Iterable[int], groups: Iterable[str]) -> list[Finding]:
    """The gyro or accelerometer that the names of ``columns`` tell, and that was not ``taken``.

    ``groups`` are those that the log holds. A map with a unit that nobody chose has no line for it.
    """
    away, there = set(taken), set(groups)
    found = triads(columns)
    sure = (surest(found, group)[0] for group in ("gyro", "accel") if group not in there)
    told = [t for t in sure if t and "user" not in t.names[0].words]  # Apple's have no gravity
    return [_left_out(columns, t.positions) for t in told if not set(t.positions) & away]


def _left_out(columns: Sequence[str], at: Sequence[int]) -> Finding:
    cells = ", ".join(columns[k] for k in at)
    return Finding("vector_left_out", columns[at[0]], 3, {"columns": cells})


def is_own(header: Sequence[str]) -> bool:
    """Whether the header is one of a recording of the package, and no other names are beside it.

    A ``time [s]`` or a ``temperature [degC]`` alone are in many others.
    """
    own = own_groups(header)
    if not own - {"time", "temperature"}:
        return False
    if "time" not in own and any(named(cell).is_time for cell in header):
        return False
    found = triads(header)
    return not any(surest(found, group)[0] for group in ("gyro", "accel") if group not in own)


def own_groups(header: Sequence[str]) -> set[str]:
    """The groups of which the header has a column as recordings of the package do."""
    return {GROUP_OF[name] for cell in header if (name := own_name(cell)) is not None}


def _euroc(reader: Reader) -> ForeignMap | None:
    """EuRoC MAV and TUM VI: imu0/data.csv, and the ground truth beside it.

    Burri et al. 2016, and the files' own headers: time in ns, ``w_RS_S`` rad/s and ``a_RS_S``
    m/s^2 in the sensor's axes S; ``q_RS`` turns S into the reference frame R, whose z is up.
    """
    cells = {re.sub(r"\s*\[.*", "", cell).strip(): cell for cell in reader.header}
    time = next((cells[name] for name in ("timestamp", "#timestamp") if name in cells), None)
    if time is None:
        return None
    columns = {time: "time [ns]"}
    if all(f"w_RS_S_{a}" in cells and f"a_RS_S_{a}" in cells for a in XYZ):
        columns |= triad_map([cells[f"w_RS_S_{a}"] for a in XYZ], "gyro", "rad/s")
        columns |= triad_map([cells[f"a_RS_S_{a}"] for a in XYZ], "accel", "m/s^2")
        return ForeignMap(columns=columns)
    if all(f"q_RS_{a}" in cells for a in "wxyz"):
        columns |= {cells[f"q_RS_{a}"]: f"ref_q_{a} [1]" for a in "wxyz"}
        where = dict(zip(XYZ, ("ref_east", "ref_north", "ref_up"), strict=True))
        columns |= {
            cells[f"p_RS_R_{a}"]: f"{name} [m]"
            for a, name in where.items()
            if f"p_RS_R_{a}" in cells
        }
        return ForeignMap(columns=columns)
    return None


def _tum_text(reader: Reader) -> ForeignMap | None:
    """TUM VI's ``dso/imu.txt``: time in ns, gyro rad/s, accelerometer m/s^2."""
    header = [re.sub(r"[^a-z]", "", cell.casefold()) for cell in reader.header]
    if header[:1] != ["timestampns"] or [h[:1] for h in header[1:7]] != list("wwwaaa"):
        return None
    cells = reader.header
    return ForeignMap(
        columns={cells[0]: "time [ns]"}
        | triad_map(cells[1:4], "gyro", "rad/s")
        | triad_map(cells[4:7], "accel", "m/s^2")
    )


def _repoimu(reader: Reader) -> ForeignMap | None:
    """RepoIMU (Szczesna et al. 2016): two rows of names, optical attitude, rad/s and m/s^2.

    Its magnetometer is in no unit and is left out. The attitude is known but for how the sensor was
    mounted on the wand.
    """
    cells = set(reader.header)
    if "Time (s)" not in cells or "Vicon Orientation W" not in cells:
        return None
    columns = {"Time (s)": "time [s]"}
    columns |= triad_map([f"IMU Gyroscope {a}" for a in "XYZ"], "gyro", "rad/s")
    columns |= triad_map([f"IMU Acceleration {a}" for a in "XYZ"], "accel", "m/s^2")
    columns |= {f"Vicon Orientation {a}": f"ref_q_{a.lower()} [1]" for a in "WXYZ"}
    return ForeignMap(columns=columns) if set(columns) <= cells else None


def _broad(reader: Reader) -> ForeignMap | None:
    """BROAD (Laidig et al. 2021): arrays ``imu_gyr`` rad/s, ``imu_acc`` m/s^2, ``imu_mag`` uT, the
    optical attitude ``opt_quat``, body to east-north-up, and position; the rate is stated beside.
    """
    cells = set(reader.header)
    if not {"imu_gyr[0]", "imu_acc[0]"} <= cells:
        return None
    columns = triad_map([f"imu_gyr[{k}]" for k in range(3)], "gyro", "rad/s")
    columns |= triad_map([f"imu_acc[{k}]" for k in range(3)], "accel", "m/s^2")
    columns |= triad_map([f"imu_mag[{k}]" for k in range(3)], "mag", "uT")
    columns |= {f"opt_quat[{k}]": f"ref_q_{a} [1]" for k, a in enumerate("wxyz")}
    where = enumerate(("ref_east", "ref_north", "ref_up"))
    columns |= {f"opt_pos[{k}]": f"{name} [m]" for k, name in where}
    columns["movement"] = "moving [1]"
    return ForeignMap(columns={cell: name for cell, name in columns.items() if cell in cells})


def _phone(reader: Reader) -> ForeignMap | None:
    """One file of Sensor Logger: time in ns since 1970, rad/s, m/s^2, uT (its UNITS.md).

    What it calls Accelerometer is without gravity, no specific force, and is left out; see
    ``pyimu.recording.phone`` for a folder of its files.
    """
    if not {"time", "seconds_elapsed", *XYZ} <= set(reader.header):
        return None
    for ending, (group, unit) in PHONE_FILES.items():
        if reader.path.name.casefold().endswith(f"{ending}.csv".casefold()):
            return ForeignMap(columns={"time": "time [ns]"} | triad_map(XYZ, group, unit))
    return None


def _nclt_imu(reader: Reader) -> ForeignMap | None:
    """NCLT's ``ms25.csv`` (Carlevaris-Bianco et al. 2016): a table without names, times in us since
    1970, field in gauss, m/s^2, rad/s, forward-right-down.
    """
    cells = unnamed(reader, "ms25", 10)
    if cells is None:
        return None
    columns = {cells[0]: "time [us]"} | triad_map(cells[1:4], "mag", "gauss")
    columns |= triad_map(cells[4:7], "accel", "m/s^2") | triad_map(cells[7:10], "gyro", "rad/s")
    return ForeignMap(columns=columns, body=BODY["frd"])


def _nclt_truth(reader: Reader) -> ForeignMap | None:
    """NCLT's ``groundtruth_DATE.csv``: times in us, north, east and down m, roll, pitch and heading
    rad of a body forward-right-down.
    """
    cells = unnamed(reader, "groundtruth", 7)
    if cells is None:
        return None
    targets = ("ref_north [m]", "ref_east [m]", "ref_down [m]", *(f"{a} [rad]" for a in ANGLES))
    columns = dict(zip(cells, ("time [us]", *targets), strict=True))
    return ForeignMap(columns=columns, body=BODY["frd"], world="ned")


def _oxts(reader: Reader) -> ForeignMap | None:
    """KITTI's ``oxts`` (Geiger et al. 2013, dataformat.txt): rad/s, m/s^2, degrees of latitude, in
    axes forward-left-up. Its attitude and velocities are what the unit's own filter made.
    """
    if not is_oxts(reader):
        return None
    columns = {TIME: f"time [{CLOCK}]", "lat": "latitude [deg]"}
    columns |= triad_map(["wx", "wy", "wz"], "gyro", "rad/s")
    columns |= triad_map(["ax", "ay", "az"], "accel", "m/s^2")
    return ForeignMap(columns=columns)


def _oxts_truth(reader: Reader) -> ForeignMap | None:
    """The same for another sensor beside it: roll, pitch and yaw, this one from east, and the
    velocity over the ground.
    """
    if not is_oxts(reader):
        return None
    columns = {TIME: f"time [{CLOCK}]", "lat": "latitude [deg]"}
    columns |= {cell: f"ref_{cell} [rad]" for cell in ("roll", "pitch", "yaw")}
    ways = {"ve": "east", "vn": "north", "vu": "up"}
    return ForeignMap(columns=columns | {c: f"ref_velocity_{w} [m/s]" for c, w in ways.items()})


PHONE_FILES: Mapping[str, tuple[str, str]] = {
    "GyroscopeUncalibrated": ("gyro", "rad/s"),
    "Gyroscope": ("gyro", "rad/s"),
    "TotalAcceleration": ("accel", "m/s^2"),
    "MagnetometerUncalibrated": ("mag", "uT"),
    "Magnetometer": ("mag", "uT"),
}
"""What Sensor Logger's files hold whose units do not depend on the phone."""

FORMATS = (
    ("EuRoC or TUM VI, by its definition", _euroc),
    ("TUM VI's imu.txt, by its definition", _tum_text),
    ("RepoIMU, by its description", _repoimu),
    ("BROAD, by its description", _broad),
    ("Xsens, by its manuals", xsens),
    ("ROS's sensor_msgs/Imu, by the message's definition", imu_message),
    ("ROS's message of a pose, by its definition", pose_message),
    ("a table of an optical system, by its header", optical_body),
    ("SensorLog, by its header", sensor_log),
    ("Core Motion, by its documentation", core_motion),
    ("Sensor Logger, by its documentation", _phone),
    ("NCLT's inertial unit, by its description", _nclt_imu),
    ("NCLT's ground truth, by its description", _nclt_truth),
    ("KITTI's oxts, by its description", _oxts),
    *SURVEYS,
    *PROGRAMS,
)

TRUTHS_OF = (
    ("KITTI's oxts, by its description", _oxts_truth),
    ("KAIST's fibre-optic gyro, by its description", fog_truth),
)
"""Logs that hold a reference for other sensors, too."""


def stated(
    reader: Reader, rate: float | None, enough: tuple[str, ...] = ("gyro", "accel")
) -> ForeignMap | None:
    """The map of a table that states every unit it needs, and leaves no choice; else None, also
    where it has none of the vectors that are ``enough``. Without times its ``rate`` must be known.

    Columns named as those of a recording are what they say.
    """
    names = [named(cell) for cell in reader.header]
    times = [name for name in names if name.is_time and not set(name.words) & TRUTHS]
    times = times or [name for name in names if name.cell in reader.clocks]
    times = _with_numbers(times, reader) if len(times) > 1 else times
    if len(times) > 1 or len(set(reader.header)) < len(reader.header):
        return None
    own = own_groups(reader.header)
    columns = {cell: cell for cell in reader.header if own_name(cell) is not None}
    if "time" not in own and times:
        unit = "s" if times[0].cell in reader.clocks else times[0].clock
        if unit is None:
            return None
        columns[times[0].cell] = f"time [{unit}]"
    elif "time" not in own and rate is None:
        return None
    found = triads(reader.header)
    for group, needed in (("gyro", True), ("accel", True), ("mag", False)):
        if group in own:
            continue
        triad, rivals = surest(found, group)
        if triad is None:
            continue
        if needed and (triad.units is None or rivals or triad.score < 4):
            return None
        if triad.names[1].cell.strip().isdigit() or triad.is_of_vehicle:
            return None
        if triad.units is not None and not rivals:
            columns |= triad_map([name.cell for name in triad.names], group, triad.units)
    warm = thermometer(names)
    if warm is not None and warm.unit in FREEZING and "temperature" not in own:
        columns[warm.cell] = f"temperature [{warm.unit}]"
    if not any(target.startswith(enough) for target in columns.values()):
        return None
    both = {"gyro", "accel"} <= {target.partition("_")[0] for target in columns.values()}
    if not both and _may_hold_more(names, found, columns):
        return None
    return ForeignMap(columns=columns)


def _may_hold_more(names: Sequence[Name], found: Sequence[Triad], taken: Mapping[str, str]) -> bool:
    """Whether a table has a vector beside those ``taken`` that no word tells, and whose unit is
    that of an angle, as careless headers have it of a gyro: its numbers may tell it.
    """
    known = {k for triad in found if triad.score > 0 for k in triad.positions}
    known |= {k for k, name in enumerate(names) if name.cell in taken}
    at = others([name.cell for name in names], known)
    units = [{names[k].unit for k in three} for three in at]
    return any(None not in u and len(u) == 1 and _is_angle(*u) for u in units)


def _is_angle(unit: str | None) -> bool:
    return unit not in (None, "1") and same_dimension(unit, "rad")


def _with_numbers(names: Sequence[Name], reader: Reader) -> list[Name]:
    """Those of the ``names`` whose columns hold numbers, or dates."""
    there = {reader.header[k] for k in reader.numeric()}
    return [name for name in names if name.cell in there]


def _in_rows_of_their_own(reader: Reader) -> ForeignMap | None:
    """The map of a table that states every unit, and in which each sensor has rows of its own."""
    own = stated(reader, None)
    if own is None:
        return None
    files, there = [], {target.partition(" ")[0] for target in own.columns.values()} - {"time"}
    for word in reader.words:
        its = stated(open_reader(reader.path, {"imu": word}), None, ("gyro", "accel", "mag"))
        if its is None:
            return None
        more = {c: t for c, t in its.columns.items() if t.partition(" ")[0] not in there}
        there |= {target.partition(" ")[0] for target in more.values()} - {"time"}
        files.append((reader.path.name, ForeignMap(columns=more, topics={"imu": word})))
    return replace(own, files=tuple(files))


def merged(
    known: ForeignMap, given: ForeignMap, files: tuple[tuple[str, ForeignMap], ...]
) -> ForeignMap:
    """The ``given`` map with the columns that are ``known``, and the further ``files``; with its
    axes, too, where it says none.
    """
    scale = {**known.scale, **given.scale}
    whole = replace(given, columns=known.columns, scale=scale, files=files, notes=known.notes)
    body = known.body if given.body is None else given.body
    rate = known.rate if given.rate is None else given.rate
    world = known.world if given.world == "enu" else given.world
    return replace(whole, body=body, world=world, rate=rate)
