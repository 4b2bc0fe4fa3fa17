"""Tables with several sensors in each row, several people one behind the other, and axes that are
called as a vehicle's.
"""

import numpy as np
import pytest
from turned_logs import G, N, agrees, rows, turned, written

from pyimu import inspect, read_recording
from pyimu.errors import UserError

ORDER = [1, 2, 0]
"""Axes of the second sensor in those of the first."""


@pytest.fixture(scope="module")
def log():
    return turned()


SEVERAL = {
    "a number behind the axis": ("a{a}1 g{a}1 *a{a}2 *g{a}2", "2"),
    "one behind a line, not in order": ("g{a}_1 *g{a}_2 *a{a}_2 a{a}_1", "2"),
    "a prefix": ("imu0_g{a} imu0_a{a} *imu1_g{a} *imu1_a{a}", "imu1"),
    "sides": ("left_gyr_{a} *right_acc_{a} *right_gyr_{a} left_acc_{a}", "right"),
    "the axis first": ("{a}_acc_1 {a}_gyro_1 *{a}_acc_2 *{a}_gyro_2", "2"),
    "units": ("acc_{a}_1[m/s^2] gyr_{a}_1[rad/s] *acc_{a}_2[m/s^2] *gyr_{a}_2[rad/s]", "2"),
    "own names beside others": (
        "accel_{a}[m/s^2] gyro_{a}[rad/s] *accel2_{a}[m/s^2] *gyro2_{a}[rad/s]",
        "2",
    ),
    "places": ("wrist_a{a} wrist_g{a} *ankle_a{a} *ankle_g{a}", "ankle"),
}
"""Names of the columns of accelerometer and gyro, of the second sensor with a star before them; and
what it is called."""


def table(path, log, words):
    time, gyro, accel = log
    names, columns = ["time"], [time]
    for word in words.split():
        own = accel if "a{a}" in word or "ac" in word else gyro
        names += [word.lstrip("*").format(a=a) for a in "xyz"]
        columns.append(own[:, ORDER] if word.startswith("*") else own)
    return written(path, [",".join(names), *rows(*columns)])


def read_with(path, folder, sensor=""):
    found = inspect(path, sensor=sensor)
    (folder / "map.toml").write_text(found.column_map)
    return found, read_recording(path, folder / "map.toml")


@pytest.mark.parametrize("words, name", SEVERAL.values(), ids=SEVERAL)
def test_a_gyro_and_the_accelerometer_of_the_same_sensor(words, name, log, tmp_path):
    path = table(tmp_path / "two.csv", log, words)
    found, first = read_with(path, tmp_path)
    agrees(first, log)
    assert "--sensor" in found.report() and "may be the accel, too" in found.report()
    _, second = read_with(path, tmp_path, name)
    agrees(second, (log[0], log[1][:, ORDER], log[2][:, ORDER]))


def test_a_sensor_that_is_not_there(log, tmp_path):
    path = table(tmp_path / "two.csv", log, SEVERAL["sides"][0])
    with pytest.raises(UserError, match="no vectors of a sensor 'head': there are left, right"):
        inspect(path, sensor="head")


@pytest.mark.parametrize("who", ["subject", "User ID", "participant_no"])
@pytest.mark.parametrize("names", [("1600", "1601"), ("Ann", "Bob")], ids=["numbers", "names"])
def test_people_one_behind_the_other(who, names, log, tmp_path):
    """The first one's rows are read, and a map reads another's; each has times of its own."""
    time, gyro, accel = log
    half = N // 2
    people = np.repeat(names, half)
    head = f"{who},activity,timestamp,acc_x,acc_y,acc_z,gyro_x,gyro_y,gyro_z"
    stamps = [f"{1e3 * t:.0f}" for t in np.tile(time[:half], 2)]
    path = written(tmp_path / "all.csv", [head, *rows(people, ["walk"] * N, stamps, accel, gyro)])
    found, first = read_with(path, tmp_path)
    agrees(first, (time[:half], gyro[:half], accel[:half]))
    assert f"the rows of {who} {names[0]} alone" in found.report()
    other = (
        (tmp_path / "map.toml").read_text().replace(f'imu = "{names[0]}"', f'imu = "{names[1]}"')
    )
    (tmp_path / "other.toml").write_text(other)
    second = read_recording(path, tmp_path / "other.toml")
    agrees(second, (time[:half], gyro[half:], accel[half:]))


AIM = """"Format","AiM CSV File"
"Session","Test"
"Vehicle","kart"
"Sample Rate","100"
"Beacon Markers","6.5","13.2"

{names}
"s","km/h","g","g","g","g","g","deg/s","deg/s","deg/s","C"
"""
AIM_NAMES = (
    "Time,GPS Speed,GPS LatAcc,GPS LonAcc,InlineAcc,LateralAcc,VerticalAcc,"
    "RollRate,PitchRate,YawRate,LoggerTemp"
)


def test_axes_of_a_vehicle(log, tmp_path):
    """AiM's export: which way the axes of its accelerations count is to be looked over."""
    time, gyro, accel = log
    of_receiver = np.column_stack([50 + 0 * time, np.sin(time), np.cos(time)])
    columns = [of_receiver, accel / G, np.degrees(gyro), 30 + 0 * time]
    cells = [[f'"{v:.9g}"' for v in c] for block in columns for c in np.atleast_2d(block.T)]
    path = written(
        tmp_path / "run.csv",
        [AIM.format(names=AIM_NAMES), *rows([f'"{t:.3f}"' for t in time], *cells)],
    )
    found, whole = read_with(path, tmp_path)
    agrees(whole, log)
    assert not found.readable and "a [count] of -1" in found.report()
