"""References as optical systems export them: Motive's, Vicon's and Qualisys' tables."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pyimu import inspect
from pyimu.recording.formats.matrix_attitude import attitudes
from pyimu.recording.formats.optical import optical
from pyimu.recording.log import read_reference

ROWS, RATE = 400, 360.0
TURN = Rotation.from_rotvec(np.outer(np.linspace(0.1, 3.0, ROWS), [0.3, -0.5, 0.8]))
PLACE = np.column_stack([np.sin(np.arange(ROWS) / 50), np.arange(ROWS) / 300, np.full(ROWS, 1.2)])
Q = TURN.as_quat()


def table(path, head, columns, separator=","):
    rows = [separator.join(map(str, row)) for row in zip(*columns, strict=True)]
    path.write_text("\n".join([*head, *rows]) + "\n")
    return path


def motive(folder, bodies=("Board",), step=1, rotation="Quaternion"):
    """With the time to the ms, and a marker of each body behind its own columns."""
    said = ["Format Version", "1.23", "Take Name", "t", "Capture Frame Rate", f"{step * RATE:f}"]
    said += ["Export Frame Rate", f"{RATE:f}", "Rotation Type", rotation]
    said += ["Length Units", "Millimeters", "Coordinate Space", "Global"]
    turn = "XYZW" if rotation == "Quaternion" else "XYZ"
    one = [("Rotation", a) for a in turn] + [("Position", a) for a in "XYZ"]
    one += [("Mean Marker Error", "")]
    kinds, names, what, axes, columns = [], [], [], [], []
    for body in bodies:
        for word, axis in one:
            kinds.append("Rigid Body"), names.append(body), what.append(word), axes.append(axis)
        columns += [*Q.T[: len(turn)], *(1000 * PLACE).T, np.full(ROWS, 0.4)]
        for axis in "XYZ":
            kinds.append("Rigid Body Marker"), names.append(f"{body}:Marker 001")
            what.append("Position"), axes.append(axis)
        columns += [*(1000 * PLACE + 30).T]
    head = [",".join(said), "", ",Type," + ",".join(kinds), ",Name," + ",".join(names)]
    head += [",ID," + ",".join(['"8A"'] * len(kinds)), ",," + ",".join(what)]
    head += ["Frame,Time (Seconds)," + ",".join(axes)]
    frames = np.arange(ROWS) * step
    return table(folder / "take.csv", head, [frames, np.round(np.arange(ROWS) / RATE, 3), *columns])


def vicon(folder, turn="RX,RY,RZ,RW", unit=""):
    width = turn.count(",") + 1
    head = ["Objects", "360", f",,Global Angle Board{',' * width}Board"]
    head += [f"Frame,Sub Frame,{turn},TX,TY,TZ", ",," + ",".join([unit] * width) + ",mm,mm,mm"]
    columns = [np.arange(1, ROWS + 1), np.zeros(ROWS, int), *Q.T[:width], *(1000 * PLACE).T]
    return table(folder / "vicon.csv", head, columns)


def qualisys(folder, lost=()):
    """The matrix column by column; a tab ends the row of names; zeros where nothing was seen."""
    head = [f"NO_OF_FRAMES\t{ROWS}", "NO_OF_CAMERAS\t10", "NO_OF_BODIES\t1", "FREQUENCY\t360"]
    head += ["TIME_STAMP\t2026-01-19, 10:19:43.755\t2063631.9", "DATA_INCLUDED\t6D"]
    head += ["BODY_NAMES\tBoard"]
    names = [f"Board {n}" for n in ("X", "Y", "Z", "Roll", "Pitch", "Yaw", "Residual")]
    names += [f"Board Rot[{k}]" for k in range(9)]
    head += ["\t".join(["Frame", "Time", *names]) + "\t"]
    seen = np.ones(ROWS)
    seen[list(lost)] = 0.0
    matrix = TURN.as_matrix().transpose(0, 2, 1).reshape(ROWS, 9)
    angles = TURN.as_euler("XYZ", degrees=True)
    numbers = np.column_stack([1000 * PLACE, angles, np.full(ROWS, 0.4), matrix]) * seen[:, None]
    time = [f"{k / RATE:.5f}" for k in range(ROWS)]
    cells = [[f"{v:.6f}" for v in column] for column in numbers.T]
    return table(folder / "board_6D.tsv", head, [np.arange(1, ROWS + 1), time, *cells], "\t")


@pytest.mark.parametrize("write", [motive, vicon, qualisys])
def test_one_body_is_a_reference_as_it_is(write, tmp_path):
    """A quaternion of six digits is off by less than 1e-5 rad; places of mm by their rounding."""
    path = write(tmp_path)
    found = read_reference(path)
    off = Rotation.from_quat(found.ref_q, scalar_first=True) * TURN.inv()
    assert off.magnitude().max() < 1e-5
    np.testing.assert_allclose(
        np.column_stack([found.ref_east, found.ref_north, found.ref_up]), PLACE, atol=1e-9
    )
    assert inspect(path).readable


@pytest.mark.parametrize("write, off", [(motive, 1e-9), (vicon, 1e-9), (qualisys, 1e-5)])
def test_frames_count_the_time_that_was_rounded(write, off, tmp_path):
    """Times to the ms are off by up to 0.5 ms; frames over the rate by nothing, and Qualisys' five
    digits by half of the last one.
    """
    time = read_reference(write(tmp_path)).time
    np.testing.assert_allclose(time - time[0], np.arange(ROWS) / RATE, atol=off)


def test_frames_of_another_rate_than_the_export_s_are_no_time(tmp_path):
    """Where every second frame was exported they count at the camera's rate."""
    time = read_reference(motive(tmp_path, step=2)).time
    assert time[-1] - time[0] == pytest.approx((ROWS - 1) / RATE, abs=1e-3)


def test_frames_without_the_body_are_missing(tmp_path):
    found = read_reference(qualisys(tmp_path, lost=range(100, 120)))
    np.testing.assert_array_equal(np.isnan(found.ref_q[:, 0]), np.arange(ROWS) // 20 == 5)


def test_a_matrix_and_its_transpose_are_opposite_turns():
    columns = TURN.as_matrix().transpose(0, 2, 1).reshape(ROWS, 9).T
    back = Rotation.from_quat(attitudes(columns), scalar_first=True)
    rows = Rotation.from_quat(attitudes(TURN.as_matrix().reshape(ROWS, 9).T), scalar_first=True)
    assert (back * rows).magnitude().max() < 1e-12
    assert np.isnan(attitudes(-columns)).all()  # a mirror is no rotation


@pytest.mark.parametrize("write", [motive, vicon, qualisys])
def test_a_head_that_is_cut_or_spoilt_is_read_or_none(write, tmp_path):
    """Whatever is missing of it: nothing is raised, and what is read has names and rows."""
    head = write(tmp_path).read_text().splitlines()[:12]
    tried = [head[:row] for row in range(len(head))]
    for row, line in enumerate(head):
        for at in range(0, len(line), 7):
            for spoilt in (line[:at], line[:at] + '"' + line[at:], "\0"):
                tried.append([*head[:row], spoilt, *head[row + 1 :]])
    found = [optical(lines) for lines in tried]
    assert optical(head) is not None and None in found
    assert all(table.names and table.first > 1 for table in found if table is not None)


@pytest.mark.parametrize("bad", [np.nan, np.inf, 1e300])
def test_elements_that_are_none_of_a_rotation_are_missing(bad):
    columns = [*TURN.as_matrix().reshape(ROWS, 9).T]
    columns[4] = np.where(np.arange(ROWS) == 7, bad, columns[4])
    np.testing.assert_array_equal(np.isnan(attitudes(columns)[:, 0]), np.arange(ROWS) == 7)


@pytest.mark.parametrize(
    "write, said",
    [
        (lambda f: motive(f, ("Board", "Wand")), "2 bodies: Board, Wand"),
        (lambda f: motive(f, rotation="XYZ"), "quaternions"),
        (lambda f: vicon(f, "RX,RY,RZ", "rad"), "quaternions"),
    ],
)
def test_what_cannot_be_known_is_asked(write, said, tmp_path):
    found = inspect(write(tmp_path))
    assert not found.readable and said in found.problem
