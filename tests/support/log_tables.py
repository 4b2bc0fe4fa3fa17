"""Logs of drones' programs, data sets of people, satellite receivers, HyperIMU and optical systems,
in the tables that these write, of times (n,) s, gyro rad/s and accelerometer m/s^2 (n, 3).
"""

from functools import wraps

import numpy as np

from pyimu.units import STANDARD_GRAVITY

FRD = np.array([1.0, -1.0, -1.0])
FIELD = np.array([-7.0, -65.0, 20.0])
"""uT."""

BODY = ("Rotation", "XYZW"), ("Position", "XYZ")
SENSORS = ("Gyroscope", "Accelerometer", "Magnetic_Field", "Orientation", "Linear_Acceleration")
"""HyperIMU's."""


def put(path, lines):
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def table(path, head, columns, separator=",", end=""):
    cells = [c if isinstance(c, list) else [f"{v:.9g}" for v in c] for c in columns]
    return put(path, [*head, *(separator.join(row) + end for row in zip(*cells, strict=True))])


def whole(numbers):
    return [str(round(v)) for v in numbers]


def cells(*vectors):
    return [f"{v:.9g}" for vector in vectors for v in np.ravel(vector)]


# Programs whose axes point forward, right and down


def px4(folder, log):
    time, gyro, accel = log
    names = [f"gyro_rad[{k}]" for k in range(3)], [f"accelerometer_m_s2[{k}]" for k in range(3)]
    head = ["timestamp", *names[0], "gyro_integral_dt", *names[1], "accelerometer_clipping"]
    columns = [whole(1e6 * time + 1e7), *(gyro * FRD).T, 0 * time, *(accel * FRD).T, 0 * time]
    return table(folder / "log_sensor_combined_0.csv", [",".join(head)], columns)


def ardupilot(folder, log, several=False):
    time, gyro, accel = log
    head = "timestamp,TimeUS,I,GyrX,GyrY,GyrZ,AccX,AccY,AccZ,EG,EA,T,GH,AH"
    unit = whole(np.arange(len(time)) % 2 * several)
    last = [0 * time, 0 * time, 0 * time + 41.5, 0 * time, 0 * time]
    columns = [1.7e9 + time, whole(1e6 * time + 1e7), unit, *(gyro * FRD).T, *(accel * FRD).T]
    return table(folder / "imu.csv", [head], [*columns, *last])


def mavlink(folder, log, scaled=False):
    time, gyro, accel = log
    stamp = "time_boot_ms" if scaled else "time_usec"
    names = [f"{a}{n}" for n in ("acc", "gyro", "mag") for a in "xyz"]
    head = ["timestamp", stamp, *names, "abs_pressure" if not scaled else "id", "temperature"]
    rate, force, field = gyro * FRD, accel * FRD, np.tile([0.2, 0.0, 0.4], (len(time), 1))
    if scaled:
        force = 1000 * force / STANDARD_GRAVITY
        vectors = [*force.T, *(1000 * rate).T, *(1000 * field).T]
        columns = [whole(1e3 * time + 1e4), *map(whole, vectors), 0 * time, 0 * time + 4150]
    else:
        columns = [whole(1e6 * time + 1e7), *force.T, *rate.T, *field.T, 0 * time, 0 * time + 41.5]
    return table(folder / "imu.csv", [",".join(head)], [1.7e9 + time, *columns])


def vectornav(folder, log):
    time, gyro, accel = log
    names = [f"Uncomp{n}{a}" for n in ("Mag", "Accel", "Gyro") for a in "XYZ"]
    head = ",".join(["TimeStartup", *names, "Temperature", "Pressure"])
    field = np.tile([0.2, 0.0, 0.4], (len(time), 1))
    columns = [whole(1e9 * time + 5e9), *field.T, *(accel * FRD).T, *(gyro * FRD).T]
    return table(folder / "vn.csv", [head], [*columns, 0 * time + 41.5, 0 * time + 101.3])


# NovAtel: counts of increments along z, -y, x, and a checksum


def crc(text):
    """Bit by bit, as the manual's program does."""
    value = 0
    for byte in text.encode():
        value = (value ^ byte) & 0xFFFFFFFF
        for _ in range(8):
            value = (value >> 1) ^ (0xEDB88320 if value & 1 else 0)
    return f"{value:08x}"


def sample(time, accel, gyro, kind, short=True, typed=True):
    week = f"2075,{507495.165 + time:.9f}"
    order = [accel[2], -accel[1], accel[0], gyro[2], -gyro[1], gyro[0]]
    counts = ",".join(str(round(c)) for c in order)
    word = f"RAWIMU{'S' * short}{'X' * typed}A"
    header = (
        "2075,507495.165" if short else "COM1,0,68.5,FINESTEERING,1724,219418.0,024c0040,6125,3"
    )
    body = f"{word},{header};{f'00,{kind},' * typed}{week},00000000,{counts}"
    return f"{'%' if short else '#'}{body}*{crc(body)}"


def receiver(path, log, kind, rad, metres, **form):
    """A log of a unit of that type, whose counts are ``rad`` and ``metres`` in size a sample."""
    time, gyro, accel = log
    samples = zip(time - time[0], accel / metres, gyro / rad, strict=True)
    rows = [sample(t, a, g, kind, **form) for t, a, g in samples]
    rows[3:3] = ["#BESTPOSA,COM1,0,74.0,FINESTEERING,1687,4.2,0,6145,3153;SOL_COMPUTED*703fb123"]
    return put(path, rows)


def novatel(folder, log):
    return receiver(folder / "raw.txt", log, 11, 2.0**-33, 0.3048 * 2.0**-27)


# People


def wisdm(folder, log, name="data_1600_gyro_phone.txt"):
    """One sensor in a file, which its name tells."""
    time, gyro, accel = log
    stamps = (49105962326000 + time * 1e9).round().astype(int)
    rows = zip(stamps, gyro if "gyro" in name else accel, strict=True)
    return put(folder / name, [f"33,Jogging,{t},{','.join(cells(v))};" for t, v in rows])


def pamap2(folder, log):
    """54 columns without names, of which the first of three sensors comes first."""
    other = np.full(17, 7.0)
    lines = []
    for k, (t, g, a) in enumerate(zip(*log, strict=True)):
        heart = "NaN" if k % 9 else "104"
        values = cells(30.5, a, 0.9 * a, g, FIELD, [1, 0, 0, 0], other, other)
        lines.append(" ".join([*cells(t, 0), heart, *values]))
    return put(folder / "subject101.dat", lines)


def total_capture(folder, log, sensors=("Head", "L_LowArm")):
    time, gyro, accel = log
    lines = [f"{len(sensors)}\t{len(time)}"]
    for k, (g, a) in enumerate(zip(gyro, accel, strict=True), 1):
        lines.append(str(k))
        for factor, name in enumerate(sensors, 1):
            lines.append("\t".join([name, *cells([1, 0, 0, 0], factor * a, g, [0.5, 0, -0.8])]))
    return put(folder / "acting1_Xsens_AuxFields.sensors", lines)


def hyper_imu(folder, log, stamped=True):
    time, gyro, accel = log
    names = ["timestamp"] * stamped + [f"MPL_{sensor}.{a}" for sensor in SENSORS for a in "xyz"]
    head = ["@ HyperIMU - ianovir - 2017", "@ Date: Sat Nov 11 15:39:03 2017, Sampling Time: 50ms"]
    stamps = (1.51e12 + time * 1e3).round().astype(int)
    rows = [
        ",".join([*[str(t)] * stamped, *cells(g, a, FIELD, [129.7, -0.2, 0.0], 0 * a)])
        for t, g, a in zip(stamps, gyro, accel, strict=True)
    ]
    return put(folder / "HIMU.csv", [*head, "", ",".join(names), *rows])


# Loggers with their rate above the table


def empatica(folder, log):
    """The E4's ACC.csv: when it began, its rate, and 64 counts a g."""
    since, rate = (", ".join([f"{v:.6f}"] * 3) for v in (1706779452.0, 32.0))
    counts = np.rint(64 * log[2] / STANDARD_GRAVITY).astype(int)
    return put(folder / "ACC.csv", [since, rate, *(",".join(map(str, row)) for row in counts)])


def nexus(folder, log):
    """Vicon Nexus' table of devices."""
    count = len(log[0])
    head = ["Devices", "100", ",,IMU - Accel,,,IMU - Gyro,,", "Frame,Sub Frame,X,Y,Z,X,Y,Z"]
    head += [",,mm/s²,mm/s²,mm/s²,deg/s,deg/s,deg/s"]
    columns = [whole(np.arange(1, count + 1)), whole(np.zeros(count))]
    return table(folder / "nexus.csv", head, [*columns, *(1000 * log[2]).T, *np.degrees(log[1]).T])


# Optical systems


def posed_by_cameras(folder, log):
    """Vicon's table of one body."""
    count = len(log[0])
    head = ["Objects", "100", f",,Global Angle Board{',' * 4}Board"]
    head += ["Frame,Sub Frame,RX,RY,RZ,RW,TX,TY,TZ", ",,,,,,mm,mm,mm"]
    half = np.linspace(0.05, 1.0, count)
    turn, zero = [np.sin(half), 0 * half, 0 * half, np.cos(half)], 0 * half
    columns = [whole(np.arange(1, count + 1)), whole(zero), *turn, 100 * half, zero, zero + 1200]
    return table(folder / "vicon.csv", head, columns)


def posed_by_vicon(folder, log):
    """OxIOD's vi1.csv: a count, the place and the attitude, scalar last."""
    time, half = log[0], np.linspace(0.05, 1.0, len(log[0]))
    zero = 0 * half
    turn = [np.sin(half), zero, zero, np.cos(half)]
    rows = zip(time, range(len(time)), 0.1 * half, zero, zero + 1.2, *turn, strict=True)
    return put(folder / "vi1.csv", [",".join(f"{v:.9g}" for v in row) for row in rows])


# Vehicles


def kaist(folder, log):
    """The Xsens unit of KAIST's cars, with what it estimates itself before its samples."""
    stamps = (log[0] * 1e9).round().astype(int)
    own = np.tile([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0], (len(stamps), 1))
    rows = zip(stamps, own, log[1], log[2], strict=True)
    return put(
        folder / "xsens_imu.csv", [",".join([str(t), *cells(*more, FIELD)]) for t, *more in rows]
    )


def kaist_fog(folder, log):
    """The fibre-optic gyro of KAIST's cars: turns from row to row, in rad."""
    stamps = [str(1544590798700000000 + round(1e9 * t)) for t in log[0]]
    period = float(np.median(np.diff(log[0])))
    return table(folder / "fog.csv", [], [stamps, *(period * log[1]).T])


def nclt_fog(folder, log):
    """The heading of NCLT's fibre-optic gyro, clockwise, of a platform that turns by 0.1 rad/s."""
    stamps = [str(1326030975726043 + round(1e6 * t)) for t in log[0]]
    return table(folder / "kvh.csv", [], [stamps, 0.1 * log[0]])


def mid_air(folder, log, attitude=(1.0, 0.0, 0.0, 0.0)):
    """Two flights of Mid-Air, of an ``attitude`` (4,) or (n, 4)."""
    import h5py

    _, gyro, accel = log
    path = folder / "sensor_records.hdf5"
    with h5py.File(path, "w") as file:
        for flight in range(2):
            group = file.create_group(f"trajectory_{flight:04d}")
            group["imu/gyroscope"], group["imu/accelerometer"] = gyro * FRD, accel * FRD
            group["groundtruth/attitude"] = np.broadcast_to(attitude, (len(gyro), 4))
            group["groundtruth/velocity"], group["groundtruth/position"] = gyro, accel
            group["gps/position"] = accel[::100]
    return path


def posed_by_receiver(folder, log):
    """The navigation result of KF-GINS."""
    rows = ([2017, 456300 + t, 30.5, 114.4, 20.0, *[0.1] * 3, 1.0, 2.0, 90.0] for t in log[0])
    return put(folder / "truth.nav", ["  ".join(f"{v:.6f}" for v in row) for row in rows])


def _of_still(make):
    """The same of a log whose times are ns (``raw_logs.still``)."""

    @wraps(make)
    def made(folder, log):
        return make(folder, (log[0] * 1e-9, *log[1:]))

    return made


ALONE = tuple(
    _of_still(make)
    for make in (
        *(px4, ardupilot, mavlink, vectornav),
        *(novatel, wisdm, pamap2, total_capture, hyper_imu, posed_by_cameras),
        *(empatica, nexus, posed_by_vicon, kaist, posed_by_receiver),
        *(kaist_fog, nclt_fog, mid_air),
    )
)
"""Layouts that are read as they are."""
