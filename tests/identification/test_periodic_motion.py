"""A motion that repeats exactly: what a scale factor makes of it is no noise of the reference."""

import numpy as np
import pytest

from pyimu.identification.close import close
from pyimu.recording.recording import Recording

H, S, B, LATE = 0.02, -0.1, 0.1, 0.0129
NOISE = 5e-4
"""rad/s; white, in a sample."""


@pytest.fixture(scope="module")
def closed():
    """Of 10 min of r = 4.266 (1 + sin(2 pi t/10 s)) rad/s (Hong and Park 2008, section 3.1, whose
    profile is not given), against a heading 12.9 ms late."""
    time, w = H * np.arange(30_000), 2 * np.pi / 10

    def heading(t):
        return 4.266 * (t + (1 - np.cos(w * t)) / w)

    gyro = np.zeros((len(time), 3))
    gyro[:, 2] = (1 + S) * (heading(time) - heading(time - H)) / H + B
    gyro += NOISE * np.random.default_rng(5).standard_normal(gyro.shape)
    return close(Recording.from_arrays(time=time, gyro=gyro, ref_heading=heading(time - LATE)))


def test_the_scale_factor_is_found(closed):
    """To five standard errors: white noise of 5e-4 rad/s over 21,000 fitted rows whose rate varies
    by 3.0 rad/s RMS is 1.6e-6 of s, and of a delay that is left to be found as much again."""
    s = closed.after.gyro.values["scale_factor"]["s"][2]
    assert s == pytest.approx(S, abs=5 * 2 * NOISE / (3.0 * np.sqrt(21_000)) + 1e-5)


def test_what_is_left_is_the_noise(closed):
    """A verdict of nothing missing comes with no more than noise."""
    rate = closed.as_dict()["error"]["rate"]
    assert closed.verdict in ("clean", "named")
    assert rate["after"] < 1.2 * NOISE and rate["after"] < 1.5 * rate["floor"]
