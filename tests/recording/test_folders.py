"""Folders that are one log, and the ground truth in them."""

import numpy as np
import pytest
import raw_logs
from scipy.spatial.transform import Rotation

from pyimu import UserError, close, inspect, open_log, read_recording
from pyimu.recording.reference.rate import reference_rate

TRUTHS = ("state_groundtruth_estimate0", "mocap0")


def sequence(folder, truth=TRUTHS[0], rows=3000):
    """A body that turns about z at 0.5 sin(t) rad/s, and its attitude 20 times a second."""
    time = np.arange(rows, dtype=np.int64) * 10_000_000
    t = 1e-9 * time
    rng = np.random.default_rng(5)
    gyro = np.column_stack([0 * t, 0 * t, 0.5 * np.sin(t)]) + 1e-3 * rng.standard_normal((rows, 3))
    accel = np.tile([0, 0, 9.81], (rows, 1)) + 0.01 * rng.standard_normal((rows, 3))
    for name in ("imu0", truth):
        (folder / "mav0" / name).mkdir(parents=True)
    raw_logs.euroc(folder / "mav0" / "imu0", (time, gyro, accel))
    q = Rotation.from_rotvec(np.outer(0.5 * (1 - np.cos(t[::5])), [0, 0, 1])).as_quat(
        scalar_first=True
    )
    names = [f"p_RS_R_{a} [m]" for a in "xyz"] + [f"q_RS_{a} []" for a in "wxyz"]
    raw_logs.text(
        folder / "mav0" / truth / "data.csv",
        [",".join(["#timestamp [ns]", *names])],
        [time[::5] + raw_logs.FIRST, *np.zeros((3, len(q))), *q.T],
    )
    return folder


@pytest.mark.parametrize("truth", TRUTHS)
@pytest.mark.parametrize("inside", ["", "mav0", "mav0/imu0"])
def test_a_sequence_is_a_log_with_its_ground_truth(tmp_path, truth, inside):
    folder = sequence(tmp_path / "V1_01", truth)
    log = read_recording(folder / inside)
    assert log.name == "V1_01" and log.path == folder / "mav0" / "imu0" / "data.csv"
    assert log.reference is not None and log.reference.path.parent.name == truth
    rate = reference_rate(log).rate[200:-200, 2]
    np.testing.assert_allclose(rate, 0.5 * np.sin(log.time[200:-200]), atol=5e-3)
    assert open_log(folder).name == "V1_01"
    found = inspect(folder)
    assert not found.problem and found.recording.sample_rate == pytest.approx(100.0)


def test_what_lies_beside_a_log_without_reference_is_named(tmp_path):
    folder = sequence(tmp_path / "V1_01")
    truth = folder / "mav0" / TRUTHS[0] / "data.csv"
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
