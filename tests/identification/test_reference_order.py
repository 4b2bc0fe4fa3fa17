"""Reference attitudes whose columns are in another order, with other signs, or in another unit."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter1d
from scipy.spatial.transform import Rotation
from turns import turned

from pyimu.identification.reference.order import other_order
from pyimu.recording.angles import angles_of, of_angles
from pyimu.recording.recording import Recording
from pyimu.recording.reference.file import with_reference
from pyimu.recording.reference.orders import DOWN, FRAMES

RATE, SECONDS = 50.0, 30.0


def hand(seed=3, size=60.0):
    """Time, rate and attitude of a hand that turns by ``size`` deg/s to and fro, any way up."""
    rng, count = np.random.default_rng(seed), int(RATE * SECONDS)
    rate = gaussian_filter1d(rng.standard_normal((count, 3)), 8.0, axis=0)
    rate *= np.radians(size) / rate.std()
    steps = Rotation.from_rotvec(0.5 * (rate[1:] + rate[:-1]) / RATE)
    first = Rotation.from_euler("ZYX", [0.7, 0.1, -0.1])
    return np.arange(count) / RATE, rate, turned(steps, first)


def beside(time, rate, q, stated):
    """A log with a reference in a file of its own, a clock that is off by 30 ms."""
    noise = 1e-3 * np.random.default_rng(5).standard_normal(rate.shape)
    log = Recording.from_arrays("log", time=time, gyro=rate + noise)
    truth = Recording.from_arrays("truth", time=time + 0.03, ref_q=q)
    return with_reference(log, replace(truth, stated={"ref_q": stated}))


def written(q, sequence="ZYX", frame=None):
    """Roll, pitch and yaw (n, 3) of a file, in the axes of the package or those of ``frame``."""
    q = q.as_quat(scalar_first=True)
    turned = Rotation.from_quat(q if frame is None else FRAMES[frame](q), scalar_first=True)
    angles = turned.as_euler(sequence)
    return np.column_stack([angles[:, sequence.index(axis)] for axis in "XYZ"])


CASES = {
    "a sign": (lambda q: of_angles(written(q) * [1, -1, 1]), "ref_roll, -ref_pitch and ref_yaw"),
    "columns": (lambda q: of_angles(written(q)[:, ::-1]), "ref_yaw, ref_pitch and ref_roll"),
    "both": (
        lambda q: of_angles(written(q)[:, [1, 0, 2]] * [1, 1, -1]),
        "ref_pitch, ref_roll and -ref_yaw",
    ),
    "columns in north-east-down": (
        lambda q: FRAMES[DOWN](of_angles(written(q, frame=DOWN)[:, [1, 0, 2]])),
        "ref_pitch, ref_roll and ref_yaw",
    ),
    "a sequence": (lambda q: of_angles(written(q, "XYZ")), "in the sequence xyz"),
    "a unit": (lambda q: of_angles(np.radians(written(q))), "are in rad, not in deg"),
}


@pytest.mark.parametrize("case", CASES)
def test_the_order_of_angles_that_fits_is_said(case):
    time, rate, q = hand()
    misread, said = CASES[case]
    line = other_order([beside(time, rate, misread(q), "deg")])
    assert line.startswith("the attitude of truth fits if roll, pitch and yaw are"), line
    assert line.endswith(said)


def test_angles_in_degrees_that_were_read_as_rad_are_said():
    """Of a vehicle, which leans little; its yaw loses whole turns and the rest is seen."""
    time = np.arange(int(RATE * SECONDS)) / RATE
    yaw, lean = 0.5 * np.sin(0.9 * time), np.radians(1.5)
    angles = np.column_stack([lean * np.sin(3 * time), lean * np.cos(2 * time), yaw])
    q = Rotation.from_quat(of_angles(angles), scalar_first=True)
    turn = (q[:-1].inv() * q[1:]).as_rotvec() * RATE
    rate = np.vstack([turn[:1], 0.5 * (turn[1:] + turn[:-1]), turn[-1:]])
    line = other_order([beside(time, rate, of_angles(np.degrees(angles)), "rad")])
    assert line == "the attitude of truth fits if roll, pitch and yaw are in deg, not in rad"


@pytest.mark.parametrize("stated", ["1", "deg"])
def test_nothing_is_said_of_an_attitude_that_fits(stated):
    time, rate, q = hand()
    assert not other_order([beside(time, rate, q.as_quat(scalar_first=True), stated)])


def test_the_order_of_a_quaternion_in_a_file_of_its_own_is_said():
    time, rate, q = hand()
    line = other_order([beside(time, rate, q.as_quat(), "1")])
    assert line.startswith("the attitude of truth fits if ref_q is read as scalar last")


def test_angles_come_back_but_for_whole_turns():
    angles = np.random.default_rng(7).uniform(-1.5, 1.5, (50, 3))
    np.testing.assert_allclose(angles_of(of_angles(angles)), angles, atol=1e-12)
