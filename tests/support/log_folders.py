"""Logs that are folders, and layouts of single files beside those of ``raw_logs``: what phones,
data sets and other settings of the same programs write.
"""

import numpy as np
import raw_logs
from raw_logs import AXES, FIRST, text
from scipy.spatial.transform import Rotation

from pyimu.recording.formats.oxts import NAMES as OXTS

TRUTH = "state_groundtruth_estimate0"


def _sensor_logger(folder, name, system, files):
    """Sensor Logger's folder: a table of the axes backwards for each of ``files``."""
    where = folder / name
    where.mkdir()
    for file, (stamps, values) in files.items():
        columns = [stamps + FIRST, stamps * 1e-9, *values.T[::-1]]
        text(where / f"{file}.csv", ["time,seconds_elapsed,z,y,x"], columns)
    (where / "Metadata.csv").write_text(f"version,device name,platform\n3,a phone,{system}\n")
    return where


def android_uncalibrated(folder, log):
    """Sensor Logger on Android: without the phone's own calibrations, at a magnetometer's 50 Hz,
    and the force without gravity beside the whole one.
    """
    time, gyro, accel = log
    field = np.tile([20.0, 0.0, -40.0], (len(time[::2]), 1))
    files = {"GyroscopeUncalibrated": (time, gyro), "TotalAcceleration": (time, accel)}
    files |= {"MagnetometerUncalibrated": (time[::2], field), "Accelerometer": (time, 0 * accel)}
    return _sensor_logger(folder, "android", "android", files)


def ios_total(folder, log):
    """Sensor Logger on iOS: in m/s^2 with the other sign, and a magnetometer."""
    time, gyro, accel = log
    field = np.tile([20.0, 0.0, -40.0], (len(time), 1))
    files = {"Gyroscope": (time, gyro), "TotalAcceleration": (time, -accel)}
    return _sensor_logger(folder, "ios", "ios", files | {"Magnetometer": (time, field)})


def phyphox_field(folder, log):
    """phyphox with its magnetometer."""
    where = raw_logs.phyphox(folder, log)
    field = np.tile([20.0, 0.0, -40.0], (len(log[0]), 1))
    head = ",".join(['"Time (s)"', *(f'"{a} (µT)"' for a in "XYZ")])
    text(where / "Magnetometer.csv", [head], [log[0] * 1e-9, *field.T])
    return where


def metamotion(folder, log):
    """MetaBase's files of one MetaMotion, the accelerometer 2 ms late."""
    time, gyro, accel = log
    where = folder / "metamotion"
    where.mkdir()
    sensors = (
        ("Gyroscope", np.degrees(gyro), "deg/s", 0),
        ("Accelerometer", accel / 9.80665, "g", 2),
    )
    for name, values, unit, late in sensors:
        axes = ",".join(f"{a}-axis ({unit})" for a in AXES)
        columns = [FIRST // 10**6 + time // 10**6 + late, time * 1e-9, *values.T]
        path = where / f"MetaWear_2021-06-05T14.31.17.372_F3D9C1_{name}_100.000Hz_1.7.3.csv"
        text(path, [f"epoc (ms),elapsed (s),{axes}"], columns)
    return where


def sequence(folder, log, truth=TRUTH, angle=None):
    """EuRoC's layout: ``mav0`` with the inertial unit, and every fifth sample's ``angle`` (n,) rad
    about z as the instrument ``truth`` saw it.
    """
    for name in ("imu0", truth):
        (folder / "mav0" / name).mkdir(parents=True)
    raw_logs.euroc(folder / "mav0" / "imu0", log)
    stamps = log[0][::5] + FIRST
    turned = np.zeros(len(stamps)) if angle is None else angle[::5]
    q = Rotation.from_rotvec(np.outer(turned, [0, 0, 1])).as_quat(scalar_first=True)
    names = [f"p_RS_R_{a} [m]" for a in AXES] + [f"q_RS_{a} []" for a in "wxyz"]
    head = ",".join(["#timestamp [ns]", *names])
    columns = [stamps, *np.zeros((3, len(stamps))), *q.T]
    text(folder / "mav0" / truth / "data.csv", [head], columns)
    return folder


def euroc_sequence(folder, log):
    return sequence(folder / "V1_01", log)


def xsens_fine(folder, log):
    """MT Manager's text with its counter of 0.1 ms."""
    time, gyro, accel = log
    names = ["PacketCounter", "SampleTimeFine", *(f"Acc_{a}" for a in "XYZ")]
    names += [f"Gyr_{a}" for a in "XYZ"]
    columns = [np.arange(len(time)), time // 10**5, *accel.T, *gyro.T]
    return text(folder / "mt.txt", ["// Update Rate: 100.0Hz", "\t".join(names)], columns, "\t")


def xsens_dot(folder, log):
    """Movella DOT, behind its lines of tags; its rates are in deg/s."""
    time, gyro, accel = log
    head = ["DeviceTag:,foo", "FirmwareVersion:,1.0", "OutputRate:,100Hz", ""]
    names = ["PacketCounter", "SampleTimeFine", *(f"Euler_{a}" for a in "XYZ")]
    names += [*(f"Acc_{a}" for a in "XYZ"), *(f"Gyr_{a}" for a in "XYZ")]
    rest = np.zeros((3, len(time)))
    columns = [np.arange(len(time)), time // 1000, *rest, *accel.T, *np.degrees(gyro).T]
    return text(folder / "dot.csv", [*head, ",".join(names)], columns)


def phone_gyro(folder, log):
    """One file of Sensor Logger by itself."""
    time, gyro, _ = log
    columns = [time + FIRST, time * 1e-9, *gyro.T[::-1]]
    return text(folder / "Gyroscope.csv", ["time,seconds_elapsed,z,y,x"], columns)


def nclt_imu(folder, log):
    """NCLT's ms25.csv: us since 1970, gauss, m/s^2, rad/s, without names."""
    time, gyro, accel = log
    field = np.tile([0.2, 0.0, 0.4], (len(time), 1))
    columns = [1326030975726043 + time // 1000, *field.T, *accel.T, *gyro.T]
    text(folder / "ms25.csv", [], columns)
    return folder / "ms25.csv"


def nclt_truth(folder, log):
    """NCLT's ground truth: us since 1970, north, east, down, roll, pitch, heading."""
    time, name = log[0], "groundtruth_2012-01-08.csv"
    text(folder / name, [], [1326030975726043 + time // 1000, *np.zeros((6, len(time)))])
    return folder / name


def kitti_drive(folder, log):
    """A drive of KITTI: a text of thirty numbers for each sample, and their times."""
    time, gyro, accel = log
    (folder / "drive_0001" / "oxts" / "data").mkdir(parents=True)
    oxts = folder / "drive_0001" / "oxts"
    start = np.datetime64("2011-09-26T13:02:25.594360375")
    stamps = [str(start + np.timedelta64(int(t), "ns")).replace("T", " ") for t in time]
    (oxts / "timestamps.txt").write_text("\n".join(stamps) + "\n")
    numbers = np.zeros((len(time), len(OXTS)))
    numbers[:, 0] = 49.0
    for names, columns in ((("ax", "ay", "az"), accel), (("wx", "wy", "wz"), gyro)):
        numbers[:, [OXTS.index(n) for n in names]] = columns
    for k, row in enumerate(numbers.tolist()):
        (oxts / "data" / f"{k:010d}.txt").write_text(" ".join(map(repr, row)) + "\n")
    return folder / "drive_0001"


def _parts(log):
    """Gravity and the acceleration without it as Core Motion has them, in g."""
    force = -log[2] / 9.80665
    gravity = force / np.linalg.norm(force, axis=1)[:, None]
    return gravity, force - gravity


def sensor_log(folder, log):
    """SensorLog on iOS: the raw accelerometer in g with Apple's sign, and Core Motion beside it."""
    time, gyro, accel = log
    gravity, user = _parts(log)
    seconds = 1000 + time * 1e-9
    vectors = [("gyroRotation", "rad/s", gyro), ("motionRotationRate", "rad/s", gyro + 0.01)]
    vectors += [("motionUserAcceleration", "G", user), ("motionGravity", "G", gravity)]
    vectors.append(("accelerometerAcceleration", "G", -accel / 9.80665))
    names = [f"{n}Timestamp_sinceReboot(s)" for n in ("motion", "accelerometer", "gyro")]
    names += [f"{n}{a}({unit})" for n, unit, _ in vectors for a in "XYZ"]
    columns = [seconds - 0.002, seconds - 0.004, seconds, *np.hstack([v for *_, v in vectors]).T]
    return text(folder / "sensorlog.csv", [",".join(names)], columns)


def core_motion(folder, log):
    """CMDeviceMotion as apps write it: gravity and the acceleration without it."""
    names = ["timestamp"] + [f"attitude.{n}" for n in ("roll", "pitch", "yaw")]
    vectors = ("gravity", "rotationRate", "userAcceleration")
    names += [f"{n}.{a}" for n in vectors for a in AXES]
    gravity, user = _parts(log)
    columns = [1000 + log[0] * 1e-9, *np.zeros((3, len(user)))]
    columns += [*gravity.T, *log[1].T, *user.T]
    return text(folder / "motion.csv", [",".join(names)], columns)


def oxiod(folder, log):
    """OxIOD's imu1.csv: sixteen columns without names."""
    gravity, user = _parts(log)
    columns = [1000 + log[0] * 1e-9, *np.zeros((3, len(user))), *log[1].T]
    columns += [*gravity.T, *user.T, *np.tile([20.0, 0.0, -40.0], (len(user), 1)).T]
    return text(folder / "imu1.csv", [], columns)


def bag_table(folder, log):
    """A bag as bagpy writes it: the message's fields, the stamp in seconds and ns."""
    time, gyro, accel = log
    stamps = time + FIRST
    names = ["Time", "header.seq", "header.stamp.secs", "header.stamp.nsecs", "header.frame_id"]
    names += [f"{n}.{a}" for n in ("angular_velocity", "linear_acceleration") for a in AXES]
    columns = [stamps * 1e-9, np.arange(len(time)), stamps // 10**9, stamps % 10**9]
    rows = zip(*columns, ["imu_link"] * len(time), *gyro.T, *accel.T, strict=True)
    lines = [",".join(c if isinstance(c, str) else repr(c.item()) for c in row) for row in rows]
    (folder / "imu-data.csv").write_text("\n".join([",".join(names), *lines]) + "\n")
    return folder / "imu-data.csv"


def plotjuggler(folder, log):
    """PlotJuggler's table: seconds, and slashes between the fields."""
    time, gyro, accel = log
    vectors = [f"angular_velocity/{a}" for a in AXES] + [f"linear_acceleration/{a}" for a in AXES]
    names = ["__time", *(f"/imu/data/{n}" for n in ("header/stamp", *vectors))]
    seconds = 1_000_000.5 + time * 1e-9
    return text(
        folder / "juggled.csv", [",".join(names)], [seconds + 0.002, seconds, *gyro.T, *accel.T]
    )


FOLDERS = (android_uncalibrated, ios_total, phyphox_field, euroc_sequence)
FILES = (xsens_fine, xsens_dot, phone_gyro, bag_table, plotjuggler)
APPLE = (sensor_log, core_motion, oxiod)
OTHERS = (nclt_imu, nclt_truth, kitti_drive, metamotion, *APPLE)
"""Layouts of which tests of their own say what is in them."""
