"""Logs of loggers, phones and data sets in further layouts, and lines with marks in them: a label
before each number, or a word that tells what a row holds.
"""

import json

import numpy as np
import raw_logs
from raw_logs import AXES, FIRST, MAP, text

RATE = 'sample_rate = {value = 100, unit = "Hz"}\n'
LABELS = [f"{n}{a}" for n in "ga" for a in AXES]
NAMED = "".join(
    f'"{n}{a}" = "{group}_{a} [{unit}]"\n'
    for n, group, unit in (("g", "gyro", "rad/s"), ("a", "accel", "m/s^2"))
    for a in AXES
)
FIELD = np.array([0.21, -0.05, 0.43])
"""gauss."""

MESSAGES = {"VNIMU": 0, "VNYMR": 3, "VNQMR": 4, "VNMAR": 0}
"""A VectorNav sensor's, and how many numbers are before the field."""


def lines_of(path, lines):
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def labelled(log, form="{}:{!r}", between=","):
    """A line for each sample, each number behind its label."""
    rows = np.hstack(log[1:]).tolist()
    pairs = [[form.format(n, v) for n, v in zip(LABELS, row, strict=True)] for row in rows]
    return [between.join(row) for row in pairs]


def serial(folder, log):
    """What a sketch prints for Arduino's plotter; a map has to say the rest."""
    (folder / MAP).write_text(RATE + "[columns]\n" + NAMED)
    return lines_of(folder / "serial.txt", ["MPU6050 Found!", *labelled(log)])


def sentence(words):
    """With the checksum of NMEA 0183."""
    code = 0
    for byte in words.encode():
        code ^= byte
    return f"${words}*{code:02X}"


def vectornav(folder, log, tag="VNIMU"):
    """Forward-right-down, at the rate that a map says; another message is between."""
    (folder / MAP).write_text(RATE)
    first, down = ["+000.500"] * MESSAGES[tag], [1, -1, -1]
    behind = ["+20.7", "+084.322"] if tag == "VNIMU" else []
    lines = ["$VNGPS,1,2"]
    for gyro, accel in zip(*log[1:], strict=True):
        numbers = [f"{v:+.6f}" for v in np.concatenate([FIELD * down, accel * down, gyro * down])]
        lines.append(sentence(",".join([tag, *first, *numbers, *behind])))
    return lines_of(folder / "vn.txt", lines)


def gnss_logger(folder, log, words=("UncalGyro", "UncalAccel", "UncalMag")):
    """Rows of satellites between those of the sensors, whose fields the head names; the
    accelerometer's are 2 ms late, the magnetometer's half as many.
    """
    time, gyro, accel = log
    ends = {"Gyro": "RadPerSec", "Accel": "Mps2", "Mag": "MicroT"}
    rows = ["# ", "# Version: v3.0.5.6 Platform: 13", "# Raw,utcTimeMillis,TimeNanos"]
    for kind, end in ends.items():
        for word in (f"Uncal{kind}", kind):
            axes = ",".join(f"{word}{a}{end}" for a in "XYZ")
            rows.append(f"# {word},utcTimeMillis,elapsedRealtimeNanos,{axes}")
    for k, t in enumerate(time.tolist()):
        rows += ["Raw,1,2,,,", "Fix,GPS,37.1,-122.1,1.0"] if k % 100 == 0 else []
        late = (0, 2_000_000, 0)
        for word, of, later in zip(words, (gyro[k], accel[k], 100 * FIELD), late, strict=True):
            if word and (k % 2 == 0 or "Mag" not in word):
                numbers = ",".join(map(repr, of.tolist()))
                rows.append(f"{word},17000,{9 * 10**12 + t + later},{numbers}")
    return lines_of(folder / "gnss_log_2024.txt", rows)


COUNTS = (1e-4, 5e-4)
"""rad/s and g of one in Gyroflow's log."""


def gyroflow(folder, log, sizes=("tscale,0.001", "gscale,0.0001", "ascale,0.0005")):
    time, gyro, accel = log
    head = ["GYROFLOW IMU LOG", "version,1.3", "id,board", "orientation,YxZ", *sizes]
    counts = np.hstack([np.rint(gyro / COUNTS[0]), np.rint(accel / 9.80665 / COUNTS[1])])
    columns = [time // 10**6, *counts.astype(int).T]
    return text(folder / "clip.gcsv", [*head, "t,gx,gy,gz,ax,ay,az"], columns)


def echoed(folder, log, frame="imu_link"):
    """``ros2 topic echo --csv`` of an Imu message: its fields in their order, without a name."""
    time, gyro, accel = log
    still, zero = np.tile([0.5, -0.5, 0.5, 0.5], (len(time), 1)), np.zeros((len(time), 9))
    numbers = np.hstack([still, zero, gyro, zero, accel, zero]).tolist()
    stamps = (FIRST + time).tolist()
    return lines_of(
        folder / "imu.csv",
        [
            ",".join(map(str, [t // 10**9, t % 10**9, frame, *row]))
            for t, row in zip(stamps, numbers, strict=True)
        ],
    )


POSED = np.array([0.5, -0.5, 0.1, 0.7])
"""x, y, z, w of length one."""


def posed(folder, log, named=False):
    """``ros2 topic echo --csv`` of a PoseStamped message; ``named`` as programs write tables of
    bags, with the time at which it was logged in front.
    """
    rows = []
    for k, t in enumerate((FIRST + log[0]).tolist()):
        cells = [t // 10**9, t % 10**9, "map", 1.0, 2.0, 0.01 * k, *POSED.tolist()]
        rows.append(",".join(map(str, [t / 1e9, *cells] if named else cells)))
    fields = [f"pose.position.{a}" for a in "xyz"] + [f"pose.orientation.{a}" for a in "xyzw"]
    head = ["Time", "header.stamp.sec", "header.stamp.nanosec", "header.frame_id", *fields]
    return lines_of(folder / "pose.csv", [",".join(head)] * named + rows)


def open_log(folder, log):
    """OpenLog Artemis: date and time of day in hundredths, mg, deg/s, uT."""
    time, gyro, accel = log
    start, step = np.datetime64("2024-03-01T10:30:00.000"), np.timedelta64(10, "ms")
    six = np.hstack([1000 * accel / 9.80665, np.degrees(gyro)]).tolist()
    rows = [
        f"03/01/2024,{str(start + k * step)[11:22]},{','.join(map(repr, row))},"
        "10.0,-20.0,30.0,28.75,99.9,"
        for k, row in enumerate(six)
    ]
    head = "rtcDate,rtcTime,aX,aY,aZ,gX,gY,gZ,mX,mY,mZ,imu_degC,output_Hz,"
    return lines_of(folder / "dataLog00001.TXT", [head, *rows])


def witmotion(folder, log):
    """WitMotion's table of a wireless sensor, whose samples arrive five at a time: the sensor's own
    clock beside the computer's, and a unit that is misspelled.
    """
    time, gyro, accel = log
    start = np.datetime64("2024-03-05T10:30:00.000000000")
    times = (start + (np.asarray(time) - time[0]).astype("timedelta64[ns]")).astype(str)
    came = np.repeat(times[::5], 5)[: len(times)]
    six = np.hstack([accel / 9.80665, np.degrees(gyro)]).tolist()
    rows = [
        f"{late[11:23]},WT901BLE(eb:33:2e),2024-3-5 {t[11:19]}:{t[20:23]},{row},"
        "10.0,-20.0,30.0,28.75"
        for late, t, row in zip(came, times, (",".join(map(repr, r)) for r in six), strict=True)
    ]
    kinds = ("Acceleration {}(g)", "Angular velocity {}(°/s)", "Magnetic field {}(ʯt)")
    names = [kind.format(a) for kind in kinds for a in "XYZ"]
    head = ",".join(["Time", "Device name", "Chip Time()", *names, "Temperature(℃)"])
    return lines_of(folder / "WT901.csv", [head, *rows])


def bag_text(folder, log):
    """``imu.txt`` as rpg's scripts write it of bags."""
    time, gyro, accel = log
    names = [f"ang_vel_{a}" for a in AXES] + [f"lin_acc_{a}" for a in AXES]
    columns = [np.arange(len(time)), 1.54e9 + time * 1e-9, *gyro.T, *accel.T]
    return raw_logs.text(folder / "imu.txt", [" ".join(["# id timestamp", *names])], columns, " ")


def ronin(folder, log):
    """RoNIN's arrays of a phone, and the poses of another one."""
    import h5py

    time, gyro, accel = log
    with h5py.File(folder / "data.hdf5", "w") as file:
        file["synced/time"] = 300 + time * 1e-9
        file["synced/gyro_uncalib"], file["synced/gyro"] = gyro, gyro - 0.01
        file["synced/acce"], file["synced/linacce"] = accel, accel - [0, 0, 9.8]
        file["pose/tango_ori"] = np.tile([0.5, -0.5, 0.5, 0.5], (len(time), 1))
        file["pose/tango_pos"] = 0 * gyro
    return folder / "data.hdf5"


def nuscenes(folder, log):
    """A scene's ``ms_imu`` of the CAN bus, in JSON."""
    rows = [
        {"linear_accel": a, "q": [1.0, 0.0, 0.0, 0.0], "rotation_rate": w, "utime": t}
        for t, w, a in zip(
            ((FIRST + log[0]) // 1000).tolist(), log[1].tolist(), log[2].tolist(), strict=True
        )
    ]
    (folder / "scene-0001_ms_imu.json").write_text(json.dumps(rows))
    return folder / "scene-0001_ms_imu.json"


ALONE = (gnss_logger, gyroflow, echoed, posed, open_log, bag_text, ronin, nuscenes, witmotion)
"""Layouts that are read as they are."""

MAPPED = (serial, vectornav)
"""Those that a map must come with."""
