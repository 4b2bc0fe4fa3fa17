"""Layouts of public data sets, in short pieces with numbers of our own: what had been taken for a
gyro or a time and is none, refused, or left to the reader.
"""

import numpy as np
import pytest
from log_tables import kaist_fog, mid_air, nclt_fog, receiver
from scipy.io import savemat
from scipy.spatial.transform import Rotation
from turned_logs import G, H, N, agrees, by_its_map, rows, turned, written

from pyimu import inspect, read_recording
from pyimu.errors import UserError
from pyimu.recording.formats.packed import packing_of
from pyimu.recording.log import read_reference

FRD = np.array([1.0, -1.0, -1.0])


@pytest.fixture(scope="module")
def log():
    return turned()


def _attitude(time):
    """Roll, pitch and yaw (n, 3) rad of a body, yaw first, in east-north-up."""
    return np.column_stack([0.3 * np.sin(time), 0.2 * np.sin(1.3 * time), 0.5 * time])


# Several units in one table


def test_another_accelerometer_is_no_gyro(log, tmp_path):
    """As of mHealth, without names and times: chest, ankle (with a gyro) and arm."""
    time, gyro, force = log
    heart = 0.3 * np.sin(np.outer(time, [7, 8]))
    columns = [force[:, [2, 0, 1]], heart, force, gyro, 30 * force / G]
    path = written(tmp_path / "subject1.log", rows(*columns, by="\t"))
    found = inspect(path).proposals[0]
    cells = {g.target: g.cell for g in found.guesses}
    assert [cells[f"accel_{a}"] for a in "xyz"] == [f"column {k}" for k in (6, 7, 8)]
    assert [cells[f"gyro_{a}"] for a in "xyz"] == [f"column {k}" for k in (9, 10, 11)]
    assert any("column 1, column 2, column 3 may be the accel, too" in n for n in found.notes)


@pytest.mark.parametrize("later", [1000.0, -1000.0])
def test_people_one_behind_the_other_are_not_one_log(later, log, tmp_path):
    """WISDM's file of all: the phone of the second counts from elsewhere."""
    half = N // 2
    people = ["33"] * half + ["17"] * half
    moved = 10_000 + log[0] + later * (np.arange(N) >= half)
    stamps = [f"{round(1e9 * t)}" for t in moved]
    table = [f"{row};" for row in rows(people, ["Jogging"] * N, stamps, log[2])]
    found = read_recording(written(tmp_path / "raw.txt", table))
    assert len(found) == half and np.ptp(found.time) == pytest.approx((half - 1) * H)
    assert any(f.kind == "other_units" and f.count == half for f in found.findings)


def test_too_many_columns_are_said_to_be(log, tmp_path):
    """As of OPPORTUNITY, and of windows with a row each (UCI HAR, Sussex-Huawei)."""
    window = log[2][:128, 0] + np.sin(np.arange(50))[:, None]
    said = inspect(written(tmp_path / "total_acc_x.txt", rows(window, by=" "))).report()
    assert "128 columns are too many to be told by their numbers" in said


def test_a_packet_number_is_no_time(log, tmp_path):
    """x-io's CalInertialAndMag: packets of other kinds are counted between, here two."""
    names = [
        f"{n} {a} ({u})" for n, u in (("Gyroscope", "deg/s"), ("Accelerometer", "g")) for a in "XYZ"
    ]
    table = rows(3 * np.arange(N), np.degrees(log[1]), log[2] / G)
    path = written(
        tmp_path / "CalInertialAndMag.csv", [",".join(["Packet number", *names]), *table]
    )
    assert "time" not in inspect(path).proposals[0].groups
    found = by_its_map(path, tmp_path, rate=100)
    np.testing.assert_allclose(found.gyro, log[1], atol=1e-6)


# Files of arrays


def test_arrays_of_other_lengths_are_no_samples(log, tmp_path):
    """NaveGo's structure of an inertial unit: the first attitude and its noise beside it."""
    beside = {"ini_align": np.zeros((1, 3)), "arw": np.full((1, 3), 1e-4), "freq": 100.0}
    unit = {"t": log[0][:, None], "fb": log[2] * FRD, "wb": log[1] * FRD} | beside
    savemat(tmp_path / "imu.mat", {"imu1": unit})
    found = by_its_map(tmp_path / "imu.mat", tmp_path)
    np.testing.assert_allclose(found.gyro, log[1] * FRD, atol=1e-12)
    np.testing.assert_allclose(found.accel, log[2] * FRD, atol=1e-12)


def test_increments_in_an_array_with_its_time_last(log, tmp_path):
    """PSINS: angles, velocities and the time at the end of the step, beside a solution."""
    solution = np.column_stack([_attitude(log[0]), np.zeros((N, 6)), log[0]])
    imu = np.column_stack([log[1] * H, log[2] * H, log[0] + H])
    savemat(tmp_path / "trj.mat", {"trj": {"avp": solution, "imu": imu, "avp0": solution[0]}})
    agrees(by_its_map(tmp_path / "trj.mat", tmp_path), log)


def test_increments_in_binary_rows(log, tmp_path):
    """KF-GINS's .bin: seven numbers of eight bytes a row; other bytes are none."""
    table = np.column_stack([456300 + log[0], log[1] * H, log[2] * H])
    table.astype("<f8").tofile(tmp_path / "unit.bin")
    agrees(by_its_map(tmp_path / "unit.bin", tmp_path), log)
    (tmp_path / "other.bin").write_bytes(np.random.default_rng(1).bytes(56 * 40))
    assert packing_of(tmp_path / "other.bin") is None


def test_arrays_of_three_axes_are_named(tmp_path):
    """DIP-IMU: frames, sensors and axes."""
    np.savez(tmp_path / "own.npz", imu_acc=np.zeros((20, 17, 3)))
    with pytest.raises(UserError, match=r"there is imu_acc \(3 axes\)"):
        read_recording(tmp_path / "own.npz")


# Clocks


@pytest.mark.parametrize("ticks", [1, 10**6, 10**9])
def test_the_clock_of_a_bag_s_text_is_told_by_its_date(ticks, log, tmp_path):
    names = [f"{n}_{a}" for n in ("ang_vel", "lin_acc") for a in "xyz"]
    stamps = [f"{(1_540_820_000 + t) * ticks:.{6 if ticks == 1 else 0}f}" for t in log[0]]
    head = "# " + ",".join(["timestamp", *names])
    agrees(read_recording(written(tmp_path / "imu.csv", [head, *rows(stamps, *log[1:])])), log)


# Vehicles' and pedestrians' tables without names


def test_the_xsens_unit_of_cars(log, tmp_path):
    """KAIST's complex urban data set, MulRan, HeLiPR."""
    stamps = [f"{1_560_000_000 * 10**9 + round(1e9 * t)}" for t in log[0]]
    own = np.tile([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0], (N, 1))
    path = written(tmp_path / "xsens_imu.csv", rows(stamps, own, *log[1:], np.ones((N, 3))))
    agrees(read_recording(path), log)


def _turns(found, angles, atol=1e-6):
    """That the attitude is the one of roll, pitch and yaw."""
    truth = Rotation.from_euler("xyz", angles)
    off = truth.inv() * Rotation.from_quat(found.ref_q, scalar_first=True)
    assert np.max(off.magnitude()) < atol


def test_rows_of_a_rotation_and_a_place(tmp_path):
    """KAIST's and MulRan's global_pose.csv."""
    time = H * np.arange(200)
    angles, place = _attitude(time), np.outer(time, [1.0, 2.0, 0.1])
    pose = np.dstack([Rotation.from_euler("xyz", angles).as_matrix(), place]).reshape(-1, 12)
    stamps = [f"{1_560_000_000 * 10**9 + round(1e9 * t)}" for t in time]
    path = written(tmp_path / "global_pose.csv", rows(stamps, pose))
    found = inspect(path)
    assert not any("Rot" in note for note in found.proposals[0].notes)
    (tmp_path / "map.toml").write_text(found.column_map)
    found = read_reference(path, tmp_path / "map.toml")
    _turns(found, angles)
    np.testing.assert_allclose(found.ref_north, place[:, 1], atol=1e-6)


@pytest.mark.parametrize("ticks", [1, 10**9])
def test_oxiod_s_vicon(ticks, tmp_path):
    """Seconds in ``syn``, ns since 1970 in ``raw``."""
    time = H * np.arange(200)
    angles, place = _attitude(time), np.outer(time, [1.0, 2.0, 0.1])
    turns = Rotation.from_euler("xyz", angles).as_quat()
    stamps = [f"{t}" if ticks == 1 else f"{1_500_000_000 * ticks + round(ticks * t)}" for t in time]
    table = rows(stamps, np.arange(200), place, turns)
    found = read_reference(written(tmp_path / "vi1.csv", table))
    _turns(found, angles)
    assert found.sample_rate == pytest.approx(100)
    np.testing.assert_allclose(found.ref_up, place[:, 2], atol=1e-6)


def test_attitudes_without_names_in_either_order(tmp_path):
    """The lines for both stand in the map's remarks (ADVIO's pose.csv)."""
    time = H * np.arange(200)
    turns = Rotation.from_euler("xyz", _attitude(time)).as_quat(scalar_first=True)
    table = rows(time, np.outer(time, [1.0, 2.0, 0.1]), turns)
    said = inspect(written(tmp_path / "pose.csv", table)).column_map
    assert 'with the scalar first: "column 5" = "ref_q_w [1]"' in said
    assert 'with the scalar last, as of ROS: "column 5" = "ref_q_x [1]"' in said


def test_kf_gins_s_navigation_result(tmp_path):
    """Degrees, the body forward-right-down in north-east-down."""
    time = H * np.arange(200)
    angles, velocity = _attitude(time), np.outer(time, [1.0, 2.0, 0.1])
    ned = np.column_stack([angles[:, 0], -angles[:, 1], np.pi / 2 - angles[:, 2]])
    north = velocity[:, [1, 0, 2]] * [1, 1, -1]
    place = np.tile([30.5, 114.4, 20.0], (200, 1))
    table = rows([2017] * 200, 456300 + time, place, north, np.degrees(ned), by="  ")
    found = read_reference(written(tmp_path / "truth.nav", table))
    _turns(found, angles)
    np.testing.assert_allclose(found.ref_velocity, velocity, atol=1e-6)
    np.testing.assert_allclose(found.latitude, np.radians(30.5), atol=1e-9)


# Forces without gravity


def test_a_phone_s_accelerations_without_gravity_are_no_force(log, tmp_path):
    """Core Motion's, where the program that wrote the table left gravity out."""
    names = [f"{n}.{a}" for n in ("rotationRate", "userAcceleration") for a in "xyz"]
    moved = 0.1 * np.sin(np.outer(log[0], [1, 2, 3]))
    path = written(
        tmp_path / "sub_1.csv", [",".join(["timestamp", *names]), *rows(log[0], log[1], moved)]
    )
    found = read_recording(path)
    np.testing.assert_allclose(found.gyro, log[1], atol=1e-6)
    assert found.accel is None
    kinds = {f.kind for f in found.findings}
    assert "no_gravity" in kinds and "vector_left_out" not in kinds


# Navigation


def test_kaists_fibre_optic_gyro_is_a_gyro_or_a_reference(log, tmp_path):
    """Turns from row to row, in rad."""
    gyro, path = log[1], kaist_fog(tmp_path, log)
    np.testing.assert_allclose(read_recording(path).gyro, gyro, rtol=1e-5, atol=1e-6)
    np.testing.assert_allclose(read_reference(path).ref_rate, gyro, rtol=1e-5, atol=1e-6)


def test_nclts_fibre_optic_gyro_is_a_heading(log, tmp_path):
    """Clockwise from north, as its unit's axes have it."""
    time = log[0]
    found = read_reference(nclt_fog(tmp_path, log)).ref_heading
    np.testing.assert_allclose(found, np.pi / 2 - 0.1 * time, rtol=0, atol=1e-8)


def test_mid_airs_flights_at_their_rate(log, tmp_path):
    pytest.importorskip("h5py")
    time, _, force = log
    attitude = Rotation.from_euler("ZYX", _attitude(time)[:, ::-1])
    found = read_recording(mid_air(tmp_path, log, attitude.as_quat(scalar_first=True)))
    agrees(found, log)
    assert found.sample_rate == pytest.approx(100.0)
    np.testing.assert_allclose(found.ref_up, -force[:, 2], rtol=0, atol=1e-9)
    up = Rotation.from_quat(found.ref_q, scalar_first=True).inv().apply([0.0, 0.0, 1.0])
    np.testing.assert_allclose(up, -attitude.inv().apply([0, 0, 1]) * FRD, rtol=0, atol=1e-9)


@pytest.mark.parametrize("told", [True, False])
def test_counts_of_a_receivers_unit_are_sized_by_gravity(told, log, tmp_path):
    """RAWIMUSA says no type: where no unit's counts make gravity 9.8 all of them are offered."""
    size = 1.0 if told else 7.0
    rad, metres = 100 * 2.0**-33, 100 * 0.3048 * 2.0**-27
    receiver(tmp_path / "raw.asc", log, 11, rad, size * metres, typed=False)
    found = inspect(tmp_path / "raw.asc")
    assert not found.readable
    if told:
        agrees(by_its_map(tmp_path / "raw.asc", tmp_path), log, 1e-7, 1e-6)
    else:
        assert found.column_map.count("# accel = {value") == 6
    with pytest.raises(UserError, match="nobody said how large one is"):
        read_recording(tmp_path / "raw.asc")
