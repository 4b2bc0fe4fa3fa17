"""A reference that is the gyro's own output says nothing of the gyro."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import lfilter

import pyimu
from pyimu.identification.reference.same_output import LEAST, is_own_output
from pyimu.recording.recording import Recording

H, ROWS, WHITE = 0.01, 12000, 2e-3


def motion() -> np.ndarray:
    """A rate (n, 3) with rests of 15 s."""
    t = H * np.arange(ROWS)
    turns = np.column_stack([0.8 * np.sin(0.7 * t), 0.6 * np.sin(1.1 * t), 0.9 * np.sin(0.5 * t)])
    return turns * (t // 15 % 2 == 1)[:, None]


def drawn(seed: int, size: float) -> np.ndarray:
    return size * np.random.default_rng(seed).normal(size=(ROWS, 3))


def recorded(gyro: np.ndarray, reference: np.ndarray) -> Recording:
    return Recording.from_arrays("log", time=H * np.arange(ROWS), gyro=gyro, ref_rate=reference)


GYRO = motion() + [1e-3, 2e-3, -1e-3] + drawn(1, WHITE)
TURNED = np.eye(3) + [[0.0, 0.01, 0.0], [-0.01, 0.02, 0.0], [0.0, 0.0, -0.01]]

OWN = {
    "as it is": GYRO,
    "without its bias": GYRO - [1e-3, 2e-3, -1e-3],
    "in 32 bits": GYRO.astype(np.float32).astype(float),
    "rounded to mrad/s": np.round(GYRO, 3),
    "rounded to 0.1 mrad/s": np.round(GYRO, 4),
    "rounded to 0.01 deg/s": np.radians(np.round(np.degrees(GYRO), 2)),
    "calibrated": GYRO @ TURNED.T,
    "behind an exponential average": lfilter([0.6], [1.0, -0.4], GYRO, axis=0),
}
OTHERS = {
    "the truth": (GYRO, motion()),
    "the truth, rounded": (GYRO, np.round(motion(), 3)),
    "a second gyro": (GYRO, motion() + drawn(2, WHITE / 4)),
    "a better gyro on what shakes": (
        GYRO + drawn(3, 10 * WHITE),
        motion() + drawn(3, 10 * WHITE) + drawn(2, WHITE / 20),
    ),
    "the truth of a gyro without noise": (1.01 * motion(), motion()),
}


@pytest.mark.parametrize("name", OWN)
def test_its_own_output_is_told(name):
    assert is_own_output(GYRO, OWN[name], recorded(GYRO, OWN[name]), LEAST["gyro"])


@pytest.mark.parametrize("name", OTHERS)
def test_another_instrument_is_none(name):
    gyro, reference = OTHERS[name]
    assert not is_own_output(gyro, reference, recorded(gyro, reference), LEAST["gyro"])


def test_close_says_so():
    closed = pyimu.close(recorded(GYRO, OWN["rounded to mrad/s"]).slice(0, ROWS // 2))
    assert closed.verdict == "reference_unfit", closed.report()
    assert "the ref_rate of log is the gyro's own output" in closed.reason
