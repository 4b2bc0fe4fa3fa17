"""A gyro whose z axis has the wrong sign, in logs of 40 s that turn about the vertical and lean a
little.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation
from turns import turned

import pyimu
from pyimu.recording.recording import Recording

RATE, ROWS, GRAVITY = 100.0, 4000, 9.80665


def log(lean: float, seed: int = 1) -> Recording:
    """A body that turns about the vertical by 40 deg/s and leans by ``lean`` rad, with a rest."""
    t, draw = np.arange(ROWS) / RATE, np.random.default_rng(seed)
    rate = (
        np.column_stack(
            [
                lean * 2.1 * np.sin(2.1 * t),
                lean * 1.7 * np.sin(1.7 * t + 1),
                0.7 * np.sin(0.6 * t + 2),
            ]
        )
        * (t > 6)[:, None]
    )
    q = turned(Rotation.from_rotvec(0.5 * (rate[1:] + rate[:-1]) / RATE))
    force = q.inv().apply([0.0, 0.0, GRAVITY]) + 0.03 * draw.normal(size=(ROWS, 3))
    gyro = rate + [1e-3, 2e-3, -1e-3] + 2e-3 * draw.normal(size=(ROWS, 3))
    return Recording.from_arrays(
        "log", time=t, gyro=gyro, accel=force, ref_q=q.as_quat(scalar_first=True)
    )


def with_wrong_sign(right: Recording) -> Recording:
    return replace(right, gyro=right.gyro * [1.0, 1.0, -1.0])


def test_it_is_said_by_gravity_and_reference():
    closed = pyimu.close(with_wrong_sign(log(0.05)))
    assert closed.verdict == "reference_unfit", closed.report()
    assert "as if z is -z in it" in closed.reason


def test_a_heading_alone_shows_it_too():
    right = log(0.05)
    yaw = np.unwrap(np.arctan2(*(2 * f(right.ref_q.T) for f in (_sine, _cosine))))
    heading = replace(right, ref_q=None, ref_heading=yaw)
    assert "as if z is -z in it" in pyimu.close(with_wrong_sign(heading)).reason


def _sine(q):
    return q[0] * q[3] + q[1] * q[2]


def _cosine(q):
    return 0.5 - q[2] ** 2 - q[3] ** 2


def test_a_right_gyro_is_left_alone():
    closed = pyimu.close(log(0.05))
    assert closed.verdict in ("clean", "undecidable"), closed.report()
    assert not [f for f in closed.quality if f.kind == "gyro_axes"]


def test_in_the_plane_alone_the_sign_is_one_of_three_reasons():
    """It could be a reference north-east-down as well, or world to body."""
    report = pyimu.close(with_wrong_sign(log(0.0))).report()
    assert "z points down" in report and "the gyro's sign is wrong" in report
