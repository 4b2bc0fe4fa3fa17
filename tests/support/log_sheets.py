"""Sheets as engineers keep them, and rows of binary numbers, of times (n,) ns, gyro rad/s and
accelerometer m/s^2 (n, 3).
"""

import numpy as np
import raw_logs

HEAD = (
    "Time (ms),Acc X (m/s2),Acc Y (m/s2),Acc Z (m/s2),Gyro X (deg/s),Gyro Y (deg/s),Gyro Z (deg/s)"
)

STRUCT = np.dtype([("t", "<u4"), ("accel", "<i2", 3), ("gyro", "<i2", 3)])
"""What a board's memory has a row in: ms, counts of 1/2048 g, counts of 1/16.4 deg/s."""

STRUCT_MAP = """[binary]
dtype = ["uint32", "int16", "int16", "int16", "int16", "int16", "int16"]
[columns]
"column 1" = "time [ms]"
"column 2" = "accel_x [count]"
"column 3" = "accel_y [count]"
"column 4" = "accel_z [count]"
"column 5" = "gyro_x [count]"
"column 6" = "gyro_y [count]"
"column 7" = "gyro_z [count]"
[scale]
accel = {value = 2048, unit = "LSB/g"}
gyro = {value = 16.4, unit = "LSB/(deg/s)"}
"""


def cells(log):
    """Cells (n, 7) of texts, as below ``HEAD``."""
    numbers = np.column_stack([log[0] / 1e6, log[2], np.degrees(log[1])])
    return [[f"{v:.9g}" for v in row] for row in numbers.tolist()]


def sheet(folder, log, head=(HEAD,), last=(), form="{}", by=","):
    lines = [*head, *(by.join(form.format(c) for c in row) for row in cells(log)), *last]
    (folder / "sheet.csv").write_text("\n".join([*lines, ""]))
    return folder / "sheet.csv"


def broken_names(folder, log):
    return sheet(folder, log, [",".join(f'"{n}"' for n in HEAD.replace(" (", "\n(").split(","))])


def formulas(folder, log):
    return sheet(folder, log, form='="{}"')


def summed(folder, log):
    means = np.column_stack([log[0] / 1e6, log[2], np.degrees(log[1])]).mean(axis=0)
    mean = ",".join(["Mean", *(f"{v:.6g}" for v in means[1:])])
    return sheet(folder, log, last=[",,,,,,", mean, "Notes: warm,,,,,,"])


def pieces(folder, log):
    """Hours, minutes and seconds in columns of their own."""
    names = HEAD.replace("Time (ms)", "hour,minute,second,millisecond")
    ms = [round(t / 1e6) for t in log[0].tolist()]
    split = [f"{t // 3600000},{t // 60000 % 60},{t // 1000 % 60},{t % 1000}" for t in ms]
    rows = [",".join([p, *row[1:]]) for p, row in zip(split, cells(log), strict=True)]
    (folder / "pieces.csv").write_text("\n".join([names, *rows, ""]))
    return folder / "pieces.csv"


def steps(folder, log):
    """The time from row to row."""
    period = np.diff(log[0], prepend=0) / 1e6
    rows = [",".join([f"{p:g}", *row[1:]]) for p, row in zip(period, cells(log), strict=True)]
    (folder / "steps.csv").write_text("\n".join([HEAD.replace("Time", "dt"), *rows, ""]))
    return folder / "steps.csv"


def digits(folder, log):
    """The time of day in the digits of one number, over a minute."""
    ms = [round(t / 1e6) + 59_700 for t in log[0].tolist()]
    stamps = [f"{t // 3600000:02d}{t // 60000 % 60:02d}{t % 60000 / 1000:06.3f}" for t in ms]
    rows = [",".join([t, *row[1:]]) for t, row in zip(stamps, cells(log), strict=True)]
    (folder / "digits.csv").write_text("\n".join([HEAD.replace("Time (ms)", "utc"), *rows, ""]))
    return folder / "digits.csv"


def plotjuggler(folder, log):
    """PX4's messages beside those of another topic, which have rows of their own."""
    stem = "/sensor_combined/"
    names = [f"{stem}{n}.0{k}" for n in ("gyro_rad", "accelerometer_m_s2") for k in range(3)]
    lines = [",".join(["__time", *names, "/battery/voltage"])]
    numbers = np.column_stack([log[0] / 1e9 + 3, *(v * [1, -1, -1] for v in log[1:])])
    for k, row in enumerate(numbers.tolist()):
        lines.append(",".join(f"{v:.9g}" for v in row) + ",")
        lines += [f"{row[0] + 0.003:.6f},,,,,,,12.1"] * (k % 4 == 0)
    (folder / "plotted.csv").write_text("\n".join([*lines, ""]))
    return folder / "plotted.csv"


def struct(folder, log):
    """Rows of binary numbers that a map describes."""
    rows = np.zeros(len(log[0]), STRUCT)
    rows["t"] = np.rint(log[0] / 1e6)
    rows["accel"] = np.rint(log[2] / 9.80665 * 2048)
    rows["gyro"] = np.rint(np.degrees(log[1]) * 16.4)
    rows.tofile(folder / "log.raw")
    (folder / raw_logs.MAP).write_text(STRUCT_MAP)
    return folder / "log.raw"


ALONE = (broken_names, formulas, summed, pieces, steps, digits, plotjuggler)
"""Layouts that are read as they are."""

MAPPED = (struct,)
"""Those that a map must come with."""
