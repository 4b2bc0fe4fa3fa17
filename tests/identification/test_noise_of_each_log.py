"""Logs whose references have noise of different sizes."""

import numpy as np
import pytest
from loop_cases import smooth
from scipy.spatial.transform import Rotation, RotationSpline

import pyimu
from pyimu.recording.recording import Recording

H, SECONDS = 0.01, 90.0
STD = 5e-4, 2.5e-3
"""rad; of two trackers, or of one that sees from other distances."""


def log(seed, std):
    rng, time = np.random.default_rng(seed), H * np.arange(round(SECONDS / H))
    turn = Rotation.from_euler("ZYX", smooth(rng, time, 0.4, highest=1.0) * [1.0, 0.8, 1.0])
    error = Rotation.from_rotvec(std * rng.standard_normal((len(time), 3)))
    rate = RotationSpline(time, turn)(time, 1)
    return Recording.from_arrays(
        name=f"log{seed}",
        time=time,
        gyro=rate + 2e-3 * rng.standard_normal(rate.shape),
        ref_q=(turn * error).as_quat(scalar_first=True),
    )


@pytest.mark.parametrize("noisier", [0, 1])
def test_the_floor_of_a_log_has_the_noise_of_its_own_reference(noisier):
    """It had that of the quieter log: what the noise of the other left was 3 times the floor."""
    closed = pyimu.close([log(k, STD[k == noisier]) for k in (0, 1)])
    assert closed.verdict in ("clean", "undecidable"), closed.report()
    shares = [e["noise"]["value"] for e in closed.references]
    ratio = np.divide(*shares[:: 1 if noisier == 0 else -1])
    # By the quietest quarter of 55 windows of a band, each of 5 independent rows or so.
    assert np.all(np.abs(ratio / (STD[1] / STD[0]) - 1.0) < 0.5), ratio
    gyro = closed.errors["gyro"]
    assert gyro.after.total == pytest.approx(gyro.noise, rel=0.25)
