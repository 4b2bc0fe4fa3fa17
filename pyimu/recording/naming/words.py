"""Words in the names of columns, and what they say."""

from __future__ import annotations

STRONG = {
    "gyro": {"gyr", "gyro", "gyros", "gyroscope", "omega", "angvel"},
    "accel": {"acc", "acce", "accel", "accl", "accelerometer", "acceleration", "gforce"},
    "mag": {"mag", "magn", "magnetometer", "magnetic"},
}
"""Words that say what a vector is."""

PAIRS = {"gyro": ({"angular", "ang", "rotation", "turn"}, {"velocity", "rate", "rates", "vel"})}
"""Words that say it together."""

ROLLS = {"p": "x", "q": "y", "r": "z"}
"""The rates about the axes, as aeroplanes have them, where all three are there."""

RATED = {"roll": "x", "pitch": "y", "yaw": "z"}
"""Words for the axes before one for a rate, as vehicles have them: ``YawRate``, ``yawspeed``."""

SPEEDS = {"speed", "dot"}
"""Words for a rate behind these alone."""

WEAK = {
    "gyro": {"w", "g", "gy", "rate", "rates", "pqr"},
    "accel": {"a", "ac", "f"},
    "mag": {"m", "b", "h"},
}
"""Letters and words that may stand for it, where they are the first word of the name."""

TIMES = {"time", "times", "timestamp", "timestamps", "stamp", "stamps", "t", "ts", "clock"}
"""Words for times, behind which a unit of few letters is one."""

MORE_TIMES = {"seconds", "epoch", "epoc", "elapsed", "sampletimefine", "tow"} | {
    *("unixtime", "datetime", "timecode", "systime", "gpstime", "utctime"),
}
"""Further ones: ``tow`` is the time of the week of satellites."""

TICKS = {"millis": "ms", "micros": "us", "nanos": "ns", "cts": "ms"}
"""Words for times that say their unit, as Arduino's functions are called; ``cts`` is that of a
camera's film in the tables that are made of GoPro's."""

UNITS_ALONE = {"ms": "ms", "msec": "ms", "us": "us", "usec": "us"}
"""Units of times that are the whole name of a column."""

PERIODS = {"dt", "deltat", "delta", "diff", "interval", "period", "elapsed"}
"""Words of a column with the time from row to row, alone or beside one for a time."""

STEPS = {"delta", "diff", "interval"}
"""Words beside those of times for the time from row to row."""

SUMMED = ("times", "of", "the", "steps")
"""How a column is called that is made of these: it is one of times."""

COUNTERS = {"tick", "ticks", "counter", "count"}
"""Words beside those of times for one that counts in a unit of its own, such as DJI's
``Clock:Tick#``."""

NUMBERS = {"packet", "number", "index", "sequence", "seq", "frame", "sample", "row", "counter"}
"""Words for what numbers rows, samples or packets: no time, however it rises."""

CLOCKS = ("s", "ms", "us", "ns", "min", "h", "day")
"""Units of times."""

TEMPERATURES = {"temp", "temperature", "celsius", "imutemp"}

LETTERS = {"c": "degC", "k": "K", "f": "degF"}
"""Letters for the unit of a temperature, where they end its name: ``temp_c``."""

INERTIAL = {"imu", "mpu", "mems", "inertial", "imutemp"}
"""Words for the unit whose thermometer it is, beside those of its sensors."""

PLACES = {
    "left",
    "right",
    "front",
    "rear",
    "upper",
    "lower",
    "head",
    "chest",
    "waist",
    "pelvis",
} | {
    *("hip", "thigh", "shank", "knee", "ankle", "foot", "toe", "heel", "shoulder", "arm"),
    *("forearm", "elbow", "wrist", "hand", "trunk", "torso", "sternum", "back", "lumbar"),
    *("pocket", "belt", "phone", "watch", "primary", "secondary"),
}
"""Words for where a sensor is, of several in one table."""

SIDES = {"l": "left", "r": "right"} | {place: place for place in PLACES - {"lower"}}
"""Words and letters for them behind the axis: ``acc_x_left``, ``ax_L``; halves of numbers of 32
bits are called ``lower``, too.
"""

PARTS = {"adis", "adxl", "bma", "bmg", "bmi", "bno", "hg", "icm", "iim", "ism", "itg"} | {
    *("lis", "lsm", "mma", "mti", "stim", "vn"),
}
"""How the names of parts begin, of several on one board: ``bmi160_ax``."""

UNITS_OF_SEVERAL = INERTIAL | PLACES | PARTS | {"sensor", "unit", "node", "device", "board"}
"""Words that may stand, with a number or without, before the letter for a vector: ``imu1_gx``."""

ALONG = {"inline": "x", "longitudinal": "x", "long": "x", "lon": "x"} | {
    **dict.fromkeys(("lateral", "lat"), "y"),
    **dict.fromkeys(("vertical", "vert"), "z"),
}
"""Words for the axes before one for an acceleration, as vehicles have them: ``LateralAcc``."""

OF_VEHICLE = "along"
"""The word for a vector that is called so: which way each axis counts nobody says."""

TRUTHS = {"ref", "reference", "vicon", "opt", "optical", "omc", "mocap", "truth", "groundtruth"} | {
    "gt",
    "optitrack",
    "qualisys",
}
"""Words for a reference."""

DERIVED = (
    {"est", "estimated", "estimate", "filtered", "filt", "user", "free", "gravity", "global"}
    | {"world", "bias", "cov", "covariance", "var", "std", "offset", "err", "error", "delta"}
    | {
        "dv",
        "dq",
        "increment",
        "set",
        "cmd",
        "target",
        "kalman",
        "fused",
        "uncalibrated",
        "lin",
    }
)
"""Words for what is no raw sample."""

HALVES = {"low", "lower"}
"""Words for the lower half of a number of 32 bits, where they end its name: ``X_GYRO_LOW``, and not
``low_noise_accel``."""

NO_SAMPLES = DERIVED | TRUTHS
"""Words for what no sensor measures."""

RAW = {"raw"}

SAID_OF_AXES = {"axis", "axes", "value", "values"}
"""Words beside an axis that say nothing."""

BEHIND = {"cal", "calibrated", "raw"}
"""Words that may stand behind the axis."""

LINEAR = {"linear", "lin", "linacc", "linacce"}
"""Words for a force without gravity, where one with it is beside it; ROS calls a force so that is
alone."""

ELSE = {"pos", "position", "vel", "velocity", "speed", "angle", "euler"}
"""Words for vectors that no inertial sensor measures."""

ONE_VECTOR = [f"column {k}" for k in range(1, 5)]
"""A table without names of a time and a vector, which its file's name may tell: ``gyro.csv``; the
time may be missing."""

TOLD_BY_UNIT = ("gyro", "mag", "accel")
"""Vectors whose units few others have, whatever their name: ``AsX(°/s)``, ``HX(uT)``,
``GForce X (g)``."""
