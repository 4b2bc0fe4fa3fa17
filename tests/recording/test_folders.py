"""Folders that are one log, and the ground truth in them."""

import numpy as np
import pytest
import raw_logs
from log_folders import (
    APPLE,
    FILES,
    FOLDERS,
    TRUTH,
    android_uncalibrated,
    core_motion,
    ios_total,
    metamotion,
    phone_gyro,
    phyphox_field,
    sensor_log,
    sequence,
    xsens_dot,
)

from pyimu import UserError, close, inspect, open_log, read_recording
from pyimu.recording.reference.rate import reference_rate

TRUTHS = (TRUTH, "mocap0")


def turning(folder, truth=TRUTH, rows=3000):
    """A body that turns about z at 0.5 sin(t) rad/s, and its attitude 20 times a second."""
    time = np.arange(rows, dtype=np.int64) * 10_000_000
    t = 1e-9 * time
    rng = np.random.default_rng(5)
    gyro = np.column_stack([0 * t, 0 * t, 0.5 * np.sin(t)]) + 1e-3 * rng.standard_normal((rows, 3))
    accel = np.tile([0, 0, 9.81], (rows, 1)) + 0.01 * rng.standard_normal((rows, 3))
    return sequence(folder, (time, gyro, accel), truth, 0.5 * (1 - np.cos(t)))


@pytest.mark.parametrize("make", [*FOLDERS, *FILES], ids=lambda make: make.__name__)
def test_samples_come_back_from_each_layout(make, tmp_path):
    """Rates in deg/s come back to some roundings, all else to the bit."""
    time, gyro, accel = log = raw_logs.still(300)
    found = read_recording(make(tmp_path, log))
    bits = 4e-16 if make is xsens_dot else 0.0
    np.testing.assert_allclose(found.gyro, gyro, rtol=bits, atol=0)
    if make is not phone_gyro:
        np.testing.assert_allclose(found.accel, accel, rtol=0, atol=0)
    has_field = make in (android_uncalibrated, ios_total, phyphox_field)
    assert (found.mag is not None) == has_field


@pytest.mark.parametrize("make", APPLE, ids=lambda make: make.__name__)
def test_the_force_of_apples_phones_is_whole_and_of_the_right_sign(make, tmp_path):
    """In g, split into gravity and the rest, or with the other sign; the gyro's own stamps."""
    time, gyro, accel = log = raw_logs.still(300)
    path = make(tmp_path, log)
    found = read_recording(path)
    np.testing.assert_array_equal(found.gyro, gyro)
    # of a sum of two parts about 1 g each is rounded once more
    np.testing.assert_allclose(found.accel, accel, rtol=0, atol=8e-15)
    # seconds since 1000 s are known to 1e-13 s
    np.testing.assert_allclose(found.time - found.time[0], time * 1e-9, rtol=0, atol=4e-13)
    assert found.time[0] == 1000.0
    (said,) = [f for f in found.findings if f.kind == "recognised"]
    assert ("SensorLog" if make is sensor_log else "Core Motion") in said.detail["as"]
    whole = inspect(path)
    assert not whole.problem
    np.testing.assert_array_equal(whole.recording.accel, found.accel)


def test_the_files_of_one_metamotion_are_a_log(tmp_path):
    """By the clock that all its files have."""
    time, gyro, accel = log = raw_logs.still(300)
    folder = metamotion(tmp_path, log)
    found = read_recording(folder)
    np.testing.assert_allclose(found.gyro, gyro, rtol=4e-16)
    np.testing.assert_allclose(found.accel, accel, rtol=4e-16)
    np.testing.assert_allclose(found.time - found.time[0], time * 1e-9, rtol=0, atol=1e-12)
    assert found.name == "metamotion" and not inspect(folder).problem
    (gyro_file,) = folder.glob("*_Gyroscope_100*")
    (folder / gyro_file.name.replace("F3D9C1", "A1B2C3")).write_text(gyro_file.read_text())
    with pytest.raises(UserError, match="a folder, give the files in it"):
        read_recording(folder)


def test_core_motion_without_times_takes_a_rate_alone(tmp_path):
    path = core_motion(tmp_path, raw_logs.still(300))
    rows = path.read_text().splitlines()
    rows = [row.partition(",")[2] for row in rows]
    path.write_text("\n".join([f",{rows[0]}", *(f"{k},{r}" for k, r in enumerate(rows[1:]))]))
    with pytest.raises(UserError, match="nothing tells when its samples were taken.*sample_rate"):
        read_recording(path)
    (tmp_path / "map.toml").write_text('sample_rate = {value = 50, unit = "Hz"}')
    found = read_recording(path, tmp_path / "map.toml")
    assert found.sample_rate == pytest.approx(50.0) and found.accel[:, 2].min() > 9.7


def test_a_gravity_in_other_units_is_not_put_together(tmp_path):
    """Android's is in m/s^2, and has the other sign than Apple's."""
    path = core_motion(tmp_path, raw_logs.still(300))
    head, *rows = path.read_text().splitlines()
    cells = [row.split(",") for row in rows]
    scaled = [[repr(9.8 * float(c)) if 4 <= k < 7 else c for k, c in enumerate(r)] for r in cells]
    path.write_text("\n".join([head, *map(",".join, scaled)]))
    assert not any(cell.startswith("force of") for cell in inspect(path).proposals[0].header)


@pytest.mark.parametrize("truth", TRUTHS)
@pytest.mark.parametrize("inside", ["", "mav0", "mav0/imu0"])
def test_a_sequence_is_a_log_with_its_ground_truth(tmp_path, truth, inside):
    folder = turning(tmp_path / "V1_01", truth)
    log = read_recording(folder / inside)
    assert log.name == "V1_01" and log.path == folder / "mav0" / "imu0" / "data.csv"
    assert log.reference is not None and log.reference.path.parent.name == truth
    rate = reference_rate(log).rate[200:-200, 2]
    np.testing.assert_allclose(rate, 0.5 * np.sin(log.time[200:-200]), atol=5e-3)
    assert open_log(folder).name == "V1_01"
    found = inspect(folder)
    assert not found.problem and found.recording.sample_rate == pytest.approx(100.0)


def test_what_lies_beside_a_log_without_reference_is_named(tmp_path):
    folder = turning(tmp_path / "V1_01")
    truth = folder / "mav0" / TRUTH / "data.csv"
    with pytest.raises(UserError, match="--reference") as said:
        close(folder / "mav0" / "imu0" / "data.csv")
    assert str(truth) in str(said.value)
    truth.unlink()
    with pytest.raises(UserError, match="--reference FILE"):
        close(folder / "mav0" / "imu0" / "data.csv")


def test_a_phone_s_folder_names_its_log(tmp_path):
    (tmp_path / "walk").mkdir()
    gyro = raw_logs.phone(tmp_path / "walk", raw_logs.still())
    folder = gyro if gyro.is_dir() else gyro.parent
    assert open_log(folder).name == folder.name


def test_another_folder_is_refused(tmp_path):
    with pytest.raises(UserError, match="a folder, give the files in it"):
        read_recording(tmp_path)
