"""Attitudes that a filter made of the gyro itself, as phones give them beside its samples."""

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter1d
from scipy.spatial.transform import Rotation

import pyimu
from pyimu.identification.fit.trial import gyro_trial
from pyimu.identification.reference.of_itself import is_of_itself
from pyimu.recording.recording import Recording

RATE, SECONDS = 100.0, 160.0
WHITE = np.radians(0.05)


def hand(seed: int, rests: bool) -> tuple[np.ndarray, np.ndarray, Rotation]:
    """Time, rate and attitude of a hand that turns by 60 deg/s to and fro, with rests or none."""
    rng, count = np.random.default_rng(seed), int(RATE * SECONDS)
    rate = gaussian_filter1d(rng.standard_normal((count, 3)), 12.0, axis=0)
    rate *= np.radians(60.0) / rate.std()
    time = np.arange(count) / RATE
    if rests:
        rate *= (time % 20.0 > 8.0)[:, None]
    step = Rotation.from_rotvec(0.5 * (rate[1:] + rate[:-1]) / RATE)
    q = [Rotation.identity()]
    for s in step:
        q.append(q[-1] * s)
    return time, rate, Rotation.concatenate(q)


def fused(gyro: np.ndarray, true: Rotation, gain: float) -> Rotation:
    """The attitude that gyro and gravity make together (Mahony's filter)."""
    up, q = true.inv().apply([0.0, 0.0, 1.0]), [true[0]]
    for k in range(len(gyro) - 1):
        seen = q[-1].inv().apply([0.0, 0.0, 1.0])
        mean = 0.5 * (gyro[k] + gyro[k + 1]) + gain * np.cross(up[k], seen)
        q.append(q[-1] * Rotation.from_rotvec(mean / RATE))
    return Rotation.concatenate(q)


@pytest.mark.parametrize("rests", [True, False])
@pytest.mark.parametrize("own", [True, False])
def test_the_noise_tells_an_attitude_of_the_gyros_own(own, rests):
    time, rate, true = hand(4, rests)
    rng = np.random.default_rng(5)
    gyro = rate + 0.003 + WHITE * rng.standard_normal(rate.shape)
    seen = true * Rotation.from_rotvec(2e-4 * rng.standard_normal(rate.shape))
    q = fused(gyro, true, 0.1) if own else seen
    log = Recording.from_arrays("phone", time=time, gyro=gyro, ref_q=q.as_quat(scalar_first=True))
    assert is_of_itself(gyro_trial(log)) == own
    closed = pyimu.close(log)
    assert (closed.verdict == "reference_unfit") == own, closed.report()
    assert ("shows the gyro's own noise" in closed.reason) == own
