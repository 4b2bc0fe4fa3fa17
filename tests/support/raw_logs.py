"""The same log of a sensor at rest, in the layouts in which people have theirs: as phones, drones
and data sets write them, byte by byte, without the libraries that read them.
"""

import gzip
import struct

import numpy as np
from scipy.io import savemat

AXES = "xyz"
FIRST = 1_700_000_000_000_000_000
RATE = 100.0
MAP = "map.toml"


def still(rows=1500, seed=3):
    """Times (n,) ns, gyro rad/s and accelerometer m/s^2 (n, 3), in numbers of 32 bits."""
    rng = np.random.default_rng(seed)
    gyro = (1e-3 * rng.standard_normal((rows, 3))).astype(np.float32)
    accel = (0.01 * rng.standard_normal((rows, 3)) + [0, 0, 9.81]).astype(np.float32)
    return np.arange(rows, dtype=np.int64) * 10_000_000, gyro.astype(float), accel.astype(float)


def text(path, head, columns, separator=",", decimal="."):
    """A table: the lines ``head``, then a row a sample, with as many digits as bits need."""
    rows = [separator.join(_cell(v, decimal) for v in row) for row in zip(*columns, strict=True)]
    data = ("\n".join([*head, *rows]) + "\n").encode()
    path.write_bytes(gzip.compress(data) if path.suffix == ".gz" else data)
    return path


def _cell(value, decimal):
    return (
        str(value)
        if isinstance(value, (int, np.integer))
        else repr(float(value)).replace(".", decimal)
    )


def euroc(folder, log):
    time, gyro, accel = log
    names = [f"w_RS_S_{a} [rad s^-1]" for a in AXES] + [f"a_RS_S_{a} [m s^-2]" for a in AXES]
    return text(
        folder / "data.csv",
        [",".join(["#timestamp [ns]", *names])],
        [time + FIRST, *gyro.T, *accel.T],
    )


def tum(folder, log):
    time, gyro, accel = log
    head = "# timestamp[ns] wx[rad/s] wy[rad/s] wz[rad/s] ax[m/s^2] ay[m/s^2] az[m/s^2]"
    return text(folder / "imu.txt", [head], [time + FIRST, *gyro.T, *accel.T], " ")


def phone(folder, log):
    """Sensor Logger on Android: a file a sensor, the axes backwards, the accelerometer's stamps
    2 ms late.
    """
    time, gyro, accel = log
    where = folder / "phone"
    where.mkdir()
    for name, values, late in (("Gyroscope", gyro, 0), ("TotalAcceleration", accel, 2_000_000)):
        stamps = time + FIRST + late
        columns = [stamps, stamps * 1e-9 - FIRST * 1e-9, *values.T[::-1]]
        text(where / f"{name}.csv", ["time,seconds_elapsed,z,y,x"], columns)
    (where / "Metadata.csv").write_text("version,device name,platform\n3,Pixel,android\n")
    return where


def iphone(folder, log):
    """On iOS: accelerations in g, and with the other sign."""
    time, gyro, accel = log
    where = folder / "iphone"
    where.mkdir()
    for name, values in (("Gyroscope", gyro), ("AccelerometerUncalibrated", -accel / 9.80665)):
        columns = [time + FIRST, time * 1e-9, *values.T[::-1]]
        text(where / f"{name}.csv", ["time,seconds_elapsed,z,y,x"], columns)
    (where / "Metadata.csv").write_text("version,device name,platform\n3,iPhone,ios\n")
    return where


def phyphox(folder, log):
    """phyphox: a table a sensor, the accelerometer 2 ms late; one without g beside it."""
    time, gyro, accel = log
    where = folder / "phyphox"
    where.mkdir()
    forces = (("Accelerometer", accel), ("Linear Accelerometer", 0 * accel))
    sensors = (("Gyroscope", gyro, 0, "rad/s"), *((n, v, 2_000_000, "m/s^2") for n, v in forces))
    for name, values, late, unit in sensors:
        head = ",".join(f'"{cell}"' for cell in ["Time (s)", *(f"{a} ({unit})" for a in "XYZ")])
        text(where / f"{name}.csv", [head], [(time + late) * 1e-9, *values.T])
    return where


def xsens(folder, log):
    time, gyro, accel = log
    head = ["// Start Time: Unknown", "// Update Rate: 100.0Hz", "// Firmware Version: 4.3"]
    names = ["PacketCounter", *(f"Acc_{a}" for a in "XYZ"), *(f"Gyr_{a}" for a in "XYZ")]
    counter = (np.arange(len(time)) + 65000) % 65536
    return text(
        folder / "MT_0380.txt", [*head, "\t".join(names)], [counter, *accel.T, *gyro.T], "\t"
    )


def rostopic(folder, log):
    """``rostopic echo -p`` of an Imu message: when it came, 2 ms late, and the sensor's stamp."""
    time, gyro, accel = log
    vectors = [
        ("orientation", "xyzw", np.tile([0.0, 0, 0, 1], (len(time), 1))),
        ("angular_velocity", AXES, gyro),
        ("linear_acceleration", AXES, accel),
    ]
    names, columns = ["%time", "field.header.seq", "field.header.stamp"], [time + FIRST + 2_000_000]
    columns += [np.arange(len(time)), time + FIRST]
    for name, axes, values in vectors:
        names += [f"field.{name}.{a}" for a in axes]
        names += [f"field.{name}_covariance{k}" for k in range(9)]
        columns += [*values.T, *np.zeros((9, len(time)))]
    return text(folder / "imu.csv", [",".join(names)], columns)


def repoimu(folder, log):
    time, gyro, accel = log
    head = [
        "Time (s);Vicon Orientation;;;;IMU Acceleration;;;IMU Gyroscope;;;IMU Magnetometer;;;",
        ";W;X;Y;Z;X;Y;Z;X;Y;Z;X;Y;Z;",
    ]
    q = np.tile([1.0, 0, 0, 0], (len(time), 1))
    field = np.tile([0.4, 0.1, -0.9], (len(time), 1))
    columns = [time * 1e-9, *q.T, *accel.T, *gyro.T, *field.T]
    return text(folder / "TStick_Test01_Trial1.csv", head, columns, ";")


def broad(folder, log):
    time, gyro, accel = log
    tree = {"imu_gyr": gyro, "imu_acc": accel, "imu_mag": np.tile([20.0, 0, -40], (len(time), 1))}
    tree |= {"sampling_rate": RATE, "movement": np.zeros((len(time), 1), dtype=bool)}
    savemat(folder / "01_rest.mat", tree)
    return folder / "01_rest.mat"


def broad_hdf5(folder, log):
    import h5py

    time, gyro, accel = log
    with h5py.File(folder / "01_rest.hdf5", "w") as file:
        file["imu_gyr"], file["imu_acc"] = gyro, accel
        file["movement"] = np.zeros(len(time), dtype=bool)
        file.attrs["sampling_rate"] = RATE
    return folder / "01_rest.hdf5"


def ulog(folder, log):
    """PX4: format, subscription and data messages of ``sensor_combined`` (ULog file format)."""
    time, gyro, accel = log
    fields = "uint64_t timestamp;float[3] gyro_rad;uint32_t gyro_integral_dt;"
    fields += "int32_t accelerometer_timestamp_relative;float[3] accelerometer_m_s2;"
    parts = [b"ULog\x01\x12\x35\x01" + struct.pack("<Q", 0)]
    parts.append(_message(b"B", bytes(40)))
    parts.append(_message(b"F", f"sensor_combined:{fields}".encode()))
    parts.append(_message(b"A", struct.pack("<BH", 0, 7) + b"sensor_combined"))
    for t, w, f in zip(time // 1000, _to_frd(gyro), _to_frd(accel), strict=True):
        row = struct.pack("<HQ3fIi3f", 7, int(t) + 5_000_000, *w, 2500, 0, *f)
        parts.append(_message(b"D", row))
    (folder / "flight.ulg").write_bytes(b"".join(parts))
    return folder / "flight.ulg"


def _message(kind, body):
    return struct.pack("<H", len(body)) + kind + body


def _to_frd(v):
    return v * [1, -1, -1]


def dataflash(folder, log):
    """ArduPilot: a format message for each type, then IMU messages of two instances."""
    time, gyro, accel = log
    labels = "TimeUS,I,GyrX,GyrY,GyrZ,AccX,AccY,AccZ,EG,EA,T,GH,AH,GHz,AHz"
    parts = [_format(128, 89, b"FMT", b"BBnNZ", b"Type,Length,Name,Format,Columns")]
    layout = "<QB6fIIfBBHH"
    parts.append(
        _format(129, 3 + struct.calcsize(layout), b"IMU", b"QBffffffIIfBBHH", labels.encode())
    )
    for t, w, f in zip(time // 1000, _to_frd(gyro), _to_frd(accel), strict=True):
        for instance in (0, 1):
            row = struct.pack(
                layout,
                int(t) + 9_000_000,
                instance,
                *w,
                *(f + instance),
                0,
                0,
                31.5,
                1,
                1,
                100,
                100,
            )
            parts.append(b"\xa3\x95\x81" + row)
    (folder / "00000012.BIN").write_bytes(b"".join(parts))
    return folder / "00000012.BIN"


def _format(number, length, name, kinds, labels):
    return b"\xa3\x95\x80" + struct.pack("<BB4s16s64s", number, length, name, kinds, labels)


def dataflash_text(folder, log):
    time, gyro, accel = log
    lines = [
        "FMT, 128, 89, FMT, BBnNZ, Type,Length,Name,Format,Columns",
        "FMT, 129, 60, IMU, QBffffff, TimeUS,I,GyrX,GyrY,GyrZ,AccX,AccY,AccZ",
    ]
    for t, w, f in zip(time // 1000, _to_frd(gyro), _to_frd(accel), strict=True):
        numbers = ", ".join(repr(float(v)) for v in (*w, *f))
        lines.append(f"IMU, {int(t) + 9_000_000}, 0, {numbers}")
    (folder / "12.log").write_text("\n".join(lines) + "\n")
    return folder / "12.log"


def german(folder, log):
    """A spreadsheet's: semicolons, decimal commas, a row of units, and gzipped."""
    time, gyro, accel = log
    names = ["Zeit time", *(f"gyr {a}" for a in AXES), *(f"acc {a}" for a in AXES)]
    units = ["ms", *["°/s"] * 3, *["g"] * 3]
    columns = [time * 1e-6, *np.degrees(gyro).T, *(accel / 9.80665).T]
    return text(folder / "messung.csv.gz", [";".join(names), ";".join(units)], columns, ";", ",")


def xio(folder, log):
    time, gyro, accel = log
    names = ["Time (s)", *(f"Gyroscope {a} (deg/s)" for a in "XYZ")]
    names += [f"Accelerometer {a} (g)" for a in "XYZ"]
    columns = [time * 1e-9, *np.degrees(gyro).T, *(accel / 9.80665).T]
    return text(folder / "sensor_data.csv", [",".join(names)], columns)


def dated(folder, log):
    """Dates with times, cut off in its last line."""
    time, gyro, accel = log
    names = [f"{kind} {a} ({u})" for kind, u in (("Gyro", "rad/s"), ("Acc", "m/s^2")) for a in AXES]
    stamps = np.datetime64("2024-02-29T00:00:00.000000000") + time
    rows = zip(stamps, gyro, accel, strict=True)
    lines = [",".join(map(str, [t, *w.tolist(), *f.tolist()])) for t, w, f in rows]
    text = "\n".join([",".join(["Date", *names]), *lines, lines[-1][:60]])
    (folder / "dated.csv").write_text(text)
    return folder / "dated.csv"


def headerless(folder, log):
    """Blanks, nothing but numbers; a map has to say the rest."""
    _, gyro, accel = log
    names = {f"column {k + 1}": f"gyro_{a} [rad/s]" for k, a in enumerate(AXES)}
    names |= {f"column {k + 4}": f"accel_{a} [m/s^2]" for k, a in enumerate(AXES)}
    lines = ['sample_rate = {value = 0.1, unit = "kHz"}', "[columns]"]
    lines += [f'"{k}" = "{v}"' for k, v in names.items()]
    (folder / MAP).write_text("\n".join(lines) + "\n")
    return text(folder / "imu.dat", [], [*gyro.T, *accel.T], "  ")


def ouster(folder, log):
    """Newer College: a counter, whole seconds, and the nanoseconds of each; the map names both."""
    time, gyro, accel = log
    second = np.int64(10**9)
    stamps = [(time + FIRST) // second, (time + FIRST) % second]
    names = [f"angular_velocity_{a}" for a in AXES] + [f"linear_acceleration_{a}" for a in AXES]
    own = [f"gyro_{a} [rad/s]" for a in AXES] + [f"accel_{a} [m/s^2]" for a in AXES]
    pairs = zip(["sec", "nsec", *names], ["time [s]", "time [ns]", *own], strict=True)
    lines = ["[columns]", *(f'"{cell}" = "{target}"' for cell, target in pairs)]
    (folder / MAP).write_text("\n".join(lines) + "\n")
    columns = [np.arange(len(time)), *stamps, *gyro.T, *accel.T]
    return text(folder / "ouster_imu.csv", [",".join(["#counter", "sec", "nsec", *names])], columns)


def apart(folder, log):
    """Gyro in degrees in one file, accelerometer at half the rate in another; a map names both."""
    time, gyro, accel = log
    text(folder / "acc.csv", ["t,x,y,z"], [time[::2] // 1000, *accel[::2].T])
    lines = ["[columns]", '"t" = "time [us]"', *(f'"{a}" = "gyro_{a} [rad/s]"' for a in AXES)]
    lines += ["[[file]]", 'name = "acc.csv"', "[file.columns]", '"t" = "time [us]"']
    lines += [f'"{a}" = "accel_{a} [m/s^2]"' for a in AXES]
    (folder / MAP).write_text("\n".join(lines) + "\n")
    return text(folder / "gyr.csv", ["t,x,y,z"], [time // 1000, *gyro.T])


def labview(folder, log):
    """A LabVIEW measurement file with a column of times, which has one for remarks, too."""
    time, gyro, accel = log
    channels = [f"{v}_{a}" for v in ("Gyro", "Accel") for a in "XYZ"]
    units = ["rad/s"] * 3 + ["m/s^2"] * 3
    end = "***End_of_Header***"
    head = ["LabVIEW Measurement\t", "Separator\tTab", "Decimal_Separator\t,", "X_Columns\tOne"]
    head += [f"{end}\t", "\t", "Channels\t6\t\t\t\t\t\t", "\t".join(["Y_Unit_Label", *units, ""])]
    head += ["\t".join([n, *[v] * 6, ""]) for n, v in (("X_Dimension", "Time"), ("X0", "0,0E+0"))]
    head += ["\t".join(["Delta_X", *["0,010000"] * 6, ""]), end + "\t" * 7]
    head += ["\t".join(["X_Value", *channels, "Comment"])]
    return text(folder / "log.lvm", head, [1e-9 * time, *gyro.T, *accel.T], "\t", ",")


def racelogic(folder, log):
    """A VBO file that begins ten seconds before a minute is over."""
    time, gyro, accel = log
    centis = 5000 + time // 10_000_000
    day = [
        f"{c // 360000:02d}{c // 6000 % 60:02d}{c // 100 % 60:02d}.{c % 100:02d}" for c in centis
    ]
    channels = [f"{a}_Accel-imu" for a in "XYZ"] + [
        f"{t}Rate-imu" for t in ("Roll", "Pitch", "Yaw")
    ]
    head = ["File created on 01/02/2024 at 00:00:50", "", "[header]", "satellites", "time", ""]
    head += [
        "[channel units]",
        *["m/s^2"] * 3,
        *["rad/s"] * 3,
        "",
        "[comments]",
        "Log Rate (Hz) : 100",
    ]
    head += ["", "[column names]", " ".join(["sats", "time", *channels]), "", "[data]"]
    rows = zip(day, *accel.T.tolist(), *gyro.T.tolist(), strict=True)
    lines = [" ".join(["012", d, *map(repr, values)]) for d, *values in rows]
    (folder / "log.vbo").write_text("\n".join([*head, *lines]) + "\n")
    return folder / "log.vbo"


ALONE = (
    *(
        euroc,
        tum,
        phone,
        iphone,
        phyphox,
        xsens,
        rostopic,
        repoimu,
        broad,
        broad_hdf5,
        ulog,
        dataflash,
    ),
    *(dataflash_text, german, xio, dated, labview, racelogic),
)
"""Layouts that are read as they are."""

MAPPED = (headerless, ouster, apart)
"""Those that a map must come with."""

NEEDS = {"broad_hdf5": "h5py", "ulog": "pyulog", "dataflash": "pymavlink"} | {
    "dataflash_text": "pymavlink"
}
"""The library that reads a layout."""
