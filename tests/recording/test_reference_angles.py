"""Attitudes that files have as roll, pitch and yaw, heights that count downward, and the data sets
that are written so."""

import re

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pyimu.errors import UserError
from pyimu.inspection.run import inspect
from pyimu.recording.angles import angles_of, of_angles
from pyimu.recording.formats.oxts import NAMES
from pyimu.recording.guess.numbers import angle_unit
from pyimu.recording.log import read_recording, read_reference
from pyimu.symbolic import quaternion

NED = np.array([[0.0, 1, 0], [1, 0, 0], [0, 0, -1]])
FRD = np.diag([1.0, -1.0, -1.0])
TIME = np.arange(400) * 0.02


def attitude(turns=1.2):
    """A body that turns round and round, and leans by up to 1.4 rad."""
    lean = np.column_stack([1.3 * np.sin(TIME), 1.4 * np.sin(0.7 * TIME)])
    return Rotation.from_euler("ZYX", np.column_stack([turns * TIME, lean[:, 1], lean[:, 0]]))


def written(q, sequence="ZYX"):
    """Its roll, pitch and yaw (n, 3) rad, each within half a turn."""
    angles = q.as_euler(sequence)
    return np.column_stack([angles[:, sequence.index(axis)] for axis in "XYZ"])


def in_ned(q):
    return Rotation.from_matrix(NED) * q * Rotation.from_matrix(FRD)


def table(path, names, columns):
    rows = np.column_stack(columns)
    text = [",".join(names)] if names else []
    path.write_text("\n".join([*text, *(",".join(f"{v:.17g}" for v in row) for row in rows)]))
    return path


def same(found, q, within=1e-12):
    off = Rotation.from_quat(found, scalar_first=True).inv() * q
    assert off.magnitude().max() < within


def test_angles_make_the_quaternion_of_the_package():
    """At gimbal lock, too; a row without one of them is not known."""
    angles = np.random.default_rng(1).uniform(-3, 3, (20, 3))
    angles[3, 1], angles[4, 1], angles[5, 2] = np.pi / 2, -np.pi / 2, np.nan
    q = of_angles(angles)
    for k in {*range(20)} - {5}:
        np.testing.assert_allclose(
            abs(q[k] @ np.array(quaternion.from_euler(*angles[k])).ravel()), 1, atol=1e-15
        )
    assert np.isnan(q[5]).all()
    same(of_angles(angles_of(q))[:3], Rotation.from_quat(q[:3], scalar_first=True))


@pytest.mark.parametrize("unit", ["rad", "deg"])
@pytest.mark.parametrize("frame", ["", '[frame]\nbody = "frd"\nworld = "ned"\n'])
def test_a_map_takes_angles_and_what_counts_downward(frame, unit, tmp_path):
    """A yaw that goes on from half a turn at minus half a turn is one motion."""
    q, up = attitude(), np.sin(TIME)
    angles = written(in_ned(q) if frame else q) * (np.degrees(1.0) if unit == "deg" else 1.0)
    names = ["t", "R", "P", "Y", "n", "e", "d"]
    file = table(tmp_path / "truth.csv", names, [TIME, angles, TIME, TIME, -up])
    targets = [f"ref_{a} [{unit}]" for a in ("roll", "pitch", "yaw")]
    targets += [f"ref_{a} [m]" for a in ("north", "east", "down")]
    pairs = zip(names, ["time [s]", *targets], strict=True)
    column_map = tmp_path / "map.toml"
    column_map.write_text("[columns]\n" + "".join(f'{a} = "{b}"\n' for a, b in pairs) + frame)
    found = read_reference(file, column_map)
    same(found.ref_q, q)
    np.testing.assert_array_equal(found.ref_up, up)
    assert set(found.groups) == {"ref_q", "ref_north", "ref_east", "ref_up"}
    assert found.stated["ref_q"] == unit


def test_a_sequence_and_a_sign_are_said_in_the_map(tmp_path):
    q = attitude()
    names = ["time [s]", "ref_roll [rad]", "p", "ref_yaw [rad]"]
    angles = written(q, "XYZ") * [1.0, -1.0, 1.0]
    file, column_map = table(tmp_path / "truth.csv", names, [TIME, angles]), tmp_path / "map.toml"
    text = 'p = "ref_pitch [count]"\n[scale]\nref_pitch = {value = -1, unit = "rad"}\n'
    column_map.write_text(f'[columns]\n{text}[frame]\nangles = "xyz"\n')
    same(read_reference(file, column_map).ref_q, q)
    column_map.write_text(f'[columns]\n{text}[frame]\nangles = "xyx"\n')
    with pytest.raises(UserError, match=r"frame\.angles must be one of zyx, xyz"):
        read_reference(file, column_map)


def test_of_two_ways_to_say_it_one_is_taken(tmp_path):
    """A height upward before one downward, a quaternion before angles."""
    q = attitude()
    names = ["time [s]", "ref_down [m]", "ref_up [m]", *(f"ref_q_{a} [1]" for a in "wxyz")]
    names += [f"ref_{a} [rad]" for a in ("roll", "pitch", "yaw")]
    columns = [TIME, TIME, TIME + 1, q.as_quat(scalar_first=True), 0 * written(q)]
    found = read_reference(table(tmp_path / "truth.csv", names, columns))
    same(found.ref_q, q)
    np.testing.assert_allclose(found.ref_up, TIME + 1)


def test_angles_that_are_none_are_refused(tmp_path):
    names = ["time [s]", "ref_roll [rad]", "ref_pitch [rad]", "ref_yaw [rad]"]
    degrees = np.degrees(written(attitude()))
    file = table(tmp_path / "truth.csv", names, [TIME, degrees])
    with pytest.raises(UserError, match="ref_pitch goes to .* rad, and no pitch .* in deg"):
        read_reference(file)
    file = table(tmp_path / "truth.csv", names[::3], [TIME, degrees[:, 2]])
    with pytest.raises(UserError, match="a yaw alone is ref_heading"):
        read_reference(file)


@pytest.mark.parametrize(
    ("names", "unit"),
    [
        ("Roll [deg],Pitch [deg],Yaw [deg]", "deg"),
        ("roll,pitch,yaw", "rad"),
        ("roll,pitch,yaw", "deg"),
        ("ref_roll,ref_pitch,ref_yaw", "rad"),
        ("euler_roll,euler_pitch,heading", "deg"),
        ("gt_roll_deg,gt_pitch_deg,gt_yaw_deg", "deg"),
    ],
)
def test_inspect_proposes_the_angles_of_a_reference(names, unit, tmp_path):
    q = attitude()
    angles = written(q) * (np.degrees(1.0) if unit == "deg" else 1.0)
    where = [TIME, np.sin(TIME), np.cos(TIME)]
    header = ["time_s", *names.split(","), "north", "east", "pos_down"]
    file, column_map = tmp_path / "truth.csv", tmp_path / "map.toml"
    table(file, header, [TIME, angles, *where])
    found = inspect(file)
    assert not found.problem, found.report()
    column_map.write_text(found.column_map)
    read = read_reference(file, column_map)
    same(read.ref_q, q)
    np.testing.assert_array_equal(read.ref_up, -where[2])
    assert not re.search(r"ref_q .* to ", found.report())
    assert "--reference-columns" in found.column_map and "see [frame]" in found.column_map


def test_angles_beside_a_sensor_may_be_an_estimate(tmp_path):
    rng, q = np.random.default_rng(2), attitude()
    sensor = [*(f"gyro_{a} [rad/s]" for a in "xyz"), *(f"accel_{a} [m/s^2]" for a in "xyz")]
    values = [rng.standard_normal((400, 3)), rng.standard_normal((400, 3)) + [0, 0, 9.8]]
    file = tmp_path / "log.csv"
    table(file, ["t", *sensor, "roll", "pitch", "yaw"], [TIME, *values, written(q)])
    found = inspect(file)
    assert "roll, pitch, yaw are left out: an estimate" in found.column_map
    table(file, ["t", *sensor, "gt_roll", "gt_pitch", "gt_yaw"], [TIME, *values, written(q)])
    assert "ref_yaw [rad]" in inspect(file).column_map


def turning(yaw):
    return np.column_stack([0 * TIME, 0 * TIME, yaw])


@pytest.mark.parametrize(
    ("angles", "unit", "why"),
    [
        (turning((20 * TIME) % 360), "deg", "more than angles in rad"),
        (turning((90 * TIME) % 360), "deg", "a whole turn"),
        (turning(TIME % (2 * np.pi)), "rad", "a whole turn"),
        (np.column_stack([0 * TIME, 0.1 * TIME, 0.2 * TIME]), "rad", "no further than that"),
    ],
)
def test_the_unit_of_angles_is_told(angles, unit, why):
    guess = angle_unit(angles)
    assert guess.unit == unit and why in guess.why


# Data sets


def nclt(folder):
    """NCLT's two files, forward-right-down and north-east-down; the truth begins with a row that is
    not known.
    """
    rng, q = np.random.default_rng(3), attitude()
    stamps = 1326030975726043 + np.round(TIME * 1e6)
    gyro, accel, mag = rng.standard_normal((3, 400, 3))
    table(folder / "ms25.csv", [], [stamps, mag, accel, gyro])
    place = rng.standard_normal((400, 3))
    truth = np.column_stack([stamps, place, written(in_ned(q))])
    truth[0, 1:] = np.nan
    table(folder / "groundtruth_2012-01-08.csv", [], [truth])
    return q, gyro, accel, mag, place


def test_nclt_is_read_as_it_is(tmp_path):
    q, gyro, accel, mag, place = nclt(tmp_path)
    log = read_recording(tmp_path / "ms25.csv")
    np.testing.assert_allclose(log.gyro, gyro @ FRD, rtol=1e-15)
    np.testing.assert_allclose(log.accel, accel @ FRD, rtol=1e-15)
    np.testing.assert_allclose(log.mag, 1e-4 * mag @ FRD, rtol=1e-15)
    file = tmp_path / "groundtruth_2012-01-08.csv"
    truth = read_reference(file)
    same(truth.ref_q[1:], q[1:])
    assert np.isnan(truth.ref_q[0]).all()
    np.testing.assert_allclose(truth.ref_up[1:], -place[1:, 2])
    np.testing.assert_allclose(truth.ref_north[1:], place[1:, 0])
    found, column_map = inspect(file), tmp_path / "map.toml"
    assert found.kind == "known" and not found.problem
    column_map.write_text(found.column_map)
    np.testing.assert_array_equal(read_reference(file, column_map).ref_q, truth.ref_q)


def kitti(folder, q, missing=7):
    """A drive of KITTI, of which one sample is missing."""
    rng = np.random.default_rng(4)
    (folder / "oxts" / "data").mkdir(parents=True)
    start = np.datetime64("2011-09-26T13:02:25.594360375")
    stamps = [start + np.timedelta64(round(1e9 * t), "ns") for t in TIME]
    lines = [str(s).replace("T", " ") for s in stamps]
    (folder / "oxts" / "timestamps.txt").write_text("\n".join(lines) + "\n")
    numbers = rng.standard_normal((400, len(NAMES)))
    numbers[:, 0] = 49.0
    numbers[:, 3:6] = written(q)
    for k in {*range(400)} - {missing}:
        text = " ".join(map(repr, numbers[k].tolist()))
        (folder / "oxts" / "data" / f"{k:010d}.txt").write_text(text + "\n")
    return np.delete(numbers, missing, axis=0), np.delete(TIME, missing)


@pytest.mark.parametrize("inside", ["", "oxts"])
def test_a_drive_of_kitti_is_a_log_and_a_reference(inside, tmp_path):
    """Its attitude is what its own filter made: no truth of its gyro, one of another beside it."""
    q = attitude()
    numbers, time = kitti(tmp_path / "drive_0001", q)
    folder = tmp_path / "drive_0001" / inside
    log, reference = read_recording(folder), read_reference(folder)
    assert log.name == "drive_0001" and set(log.groups) == {"gyro", "accel", "latitude"}
    np.testing.assert_allclose(log.time, time, atol=1e-9)
    np.testing.assert_array_equal(log.gyro, numbers[:, 17:20])
    np.testing.assert_array_equal(log.accel, numbers[:, 11:14])
    same(reference.ref_q, Rotation.from_quat(np.delete(q.as_quat(), 7, axis=0)))
    np.testing.assert_array_equal(reference.ref_velocity, numbers[:, [7, 6, 10]])
    assert not inspect(folder).problem


def test_a_damaged_drive_of_kitti_is_refused(tmp_path):
    drive = tmp_path / "drive_0001"
    kitti(drive, attitude())
    sample = drive / "oxts" / "data" / "0000000003.txt"
    sample.write_text("1 2 3")
    with pytest.raises(UserError, match=r"0000000003\.txt: is no sample of oxts"):
        read_recording(drive)
    stamps = drive / "oxts" / "timestamps.txt"
    stamps.write_text(stamps.read_text().replace("2011-09-26", "yesterday", 1))
    with pytest.raises(UserError, match="line 1 is no date with a time"):
        read_recording(drive)
    stamps.write_text("2011-09-26 13:02:25.5\n")
    with pytest.raises(UserError, match="has no time for it"):
        read_recording(drive)
