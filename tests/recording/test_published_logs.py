"""Layouts of logs as people publish them, in short pieces with numbers of our own: what had been
read in the wrong unit, of two sensors at once, or at the wrong rate, without a word.
"""

import numpy as np
import pytest
from turned_logs import G, N, agrees, by_its_map, rows, turned, written

from pyimu import inspect, read_recording

NAMES = "ax,ay,az,gx,gy,gz"


@pytest.fixture(scope="module")
def log():
    return turned()


# A gyro's unit that is an angle's


@pytest.mark.parametrize(
    ("rate", "numbers", "unit"),
    [(100, 1.0, "rad/s"), (100, 180 / np.pi, "deg/s"), (55, 1.0, None)],
)
def test_a_gyro_in_degrees_is_judged_by_gravity(rate, numbers, unit, log, tmp_path):
    """``gyr_x_deg`` in rad/s: at 55 Hz the angle from row to row would be about the same number,
    and neither is taken.
    """
    gyro = numbers * log[1] * rate / 100  # the same turn in other times
    head = "time [s],gyr_x_deg,gyr_y_deg,gyr_z_deg,acc_x_mps2,acc_y_mps2,acc_z_mps2"
    lines = [head, *rows(log[0] * 100 / rate, gyro, log[2])]
    found = inspect(written(tmp_path / "log.csv", lines)).proposals[0]
    assert found.units.get("gyro") == unit
    assert next(g for g in found.guesses if g.group == "gyro").value is None
    if unit is None:
        assert '"gyro_x [rad/s]"' in inspect(tmp_path / "log.csv").column_map


# Rows of several sensors


def test_rows_of_two_devices_are_not_those_of_one(log, tmp_path):
    """A wireless logger's table: each row says by its device's address whose it is."""
    other = (log[0] + 0.003, log[2][:, [1, 2, 0]] / G, np.degrees(log[1])[:, [1, 2, 0]])
    each = [(log[0], log[2] / G, np.degrees(log[1])), other]
    names = ["unit(eb:33)", "unit(aa:01)"]
    head = "Time (s),Device name,Acc X(g),Acc Y(g),Acc Z(g),Gyro X(°/s),Gyro Y(°/s),Gyro Z(°/s)"
    two = [rows(t, [name] * N, f, w) for name, (t, f, w) in zip(names, each, strict=True)]
    path = written(tmp_path / "log.csv", [head, *(line for pair in zip(*two) for line in pair)])
    found = read_recording(path)
    agrees(found, log)
    assert any(names[1] in str(f.detail.get("read_as")) for f in found.findings)
    (tmp_path / "map.toml").write_text(f'[topics]\nimu = "{names[1]}"\n')
    np.testing.assert_allclose(
        read_recording(path, tmp_path / "map.toml").gyro, log[1][:, [1, 2, 0]], atol=1e-6
    )


def test_a_state_of_the_device_is_no_device(log, tmp_path):
    """Words that come once each, or whose column has another name, take no rows away."""
    words = ["warm"] * 60 + ["ready"] * (N - 60)
    for name in ("device", "device state"):
        head = f"time [s],{name},accel_x [g],accel_y [g],accel_z [g],gyro_x [rad/s],gyro_y [rad/s],"
        lines = [f"{head}gyro_z [rad/s]", *rows(log[0], words, log[2] / G, log[1])]
        assert len(read_recording(written(tmp_path / "log.csv", lines))) == N


@pytest.mark.parametrize("units", [True, False])
@pytest.mark.parametrize("word", [True, False])
def test_each_sensor_in_rows_of_its_own(units, word, log, tmp_path):
    """Gyro and accelerometer in one table, one row a sample of either, empty cells beside it."""
    none = ",,"
    first = rows(log[0] - 0.004, ["acceleration"] * N, log[2], [none] * N)
    second = rows(log[0], ["gyroscope"] * N, [none] * N, log[1])
    head = f"time,sensor,{NAMES}"
    if units:
        named = [f"{n} [{'m/s^2' if n[0] == 'a' else 'rad/s'}]" for n in NAMES.split(",")]
        head = ",".join(["time [s]", "sensor", *named])
    lines = [head, *(line for pair in zip(first, second, strict=True) for line in pair)]
    if not word:
        lines = [",".join(c for k, c in enumerate(line.split(",")) if k != 1) for line in lines]
    path = written(tmp_path / "log.csv", lines)
    found = read_recording(path) if units else by_its_map(path, tmp_path)
    assert len(found) == N and found.sample_rate == pytest.approx(100)
    np.testing.assert_allclose(found.gyro, log[1], atol=1e-6)
    np.testing.assert_allclose(found.accel, log[2], atol=1e-5)
    assert not any("other rows" in str(f) for f in found.findings)
