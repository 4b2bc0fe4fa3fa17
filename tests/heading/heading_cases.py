"""Known motions of one gyro, made by numpy alone."""

import numpy as np
from scipy.ndimage import gaussian_filter1d

from pyimu.recording.recording import Recording

H = 0.02
N, K = 6.2e-4, 1e-4
"""rad/sqrt(s) and rad/s/sqrt(s)."""


def turns(rng, seconds=300.0, h=H):
    """Rate (n,) rad/s of turns of 5 to 40 deg/s either way, with rests between."""
    n = round(seconds / h)
    rate, k = np.zeros(n), round(1 / h)
    while k < n:
        length = round(rng.uniform(2, 6) / h)
        rate[k : k + length] = rng.choice([-1, 1]) * np.radians(rng.uniform(5, 40))
        k += length + round(rng.uniform(1, 7) / h)
    return gaussian_filter1d(rate, 0.1 / h)


def measured(rate, rng, s=0.0, b=0.0, n=N, k=K, h=H):
    """The gyro's samples (n,) of a rate: scale factor, bias, white noise and random walk."""
    walk = k * np.sqrt(h) * np.cumsum(rng.standard_normal(len(rate)))
    return (1 + s) * rate + b + walk + n / np.sqrt(h) * rng.standard_normal(len(rate))


def log(gyro_z, heading=None, rate=None, h=H, **more):
    """A recording of one gyro with the references that are given."""
    gyro = np.zeros((len(gyro_z), 3))
    gyro[:, 2] = gyro_z
    if heading is not None:
        more["ref_heading"] = heading
    if rate is not None:
        more["ref_rate"] = np.column_stack([0 * rate, 0 * rate, rate])
    return Recording.from_arrays("log", time=h * np.arange(len(gyro_z)), gyro=gyro, **more)


def one_line(text, *words):
    assert text.startswith("pyimu: ") and text.endswith("\n") and text.count("\n") == 1, text
    missing = [w for w in words if w not in text]
    assert not missing, f"{missing} not in: {text}"
