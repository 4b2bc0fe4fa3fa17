"""Whether rows whose stamps scatter were sampled at these or evenly."""

import numpy as np
import pytest

import pyimu
from pyimu.recording.recording import Recording
from pyimu.recording.reference.stamps import evenly_sampled

H, COUNT = 0.0025, 40_000


def moves(t, seed=1):
    """The rate (n, 3) rad/s of an arm that turns for 0.8 s and rests for 1.2 s."""
    within = np.clip(np.mod(t, 2.0) / 0.8, 0.0, 1.0)
    sizes = np.random.default_rng(seed).uniform(-1.2, 1.2, (200, 3))
    return sizes[(t / 2.0).astype(int)] * (30.0 / 0.8 * within**2 * (1.0 - within) ** 2)[:, None]


def scattered(seed=0):
    rng = np.random.default_rng(seed)
    even = H * (1.0 + np.arange(COUNT))
    return rng, even, even + rng.uniform(-2e-4, 2e-4, COUNT)


@pytest.mark.parametrize("noise", [0.0, 1e-3])
@pytest.mark.parametrize("evenly", [True, False])
def test_the_samples_tell_when_they_were_taken(evenly, noise):
    rng, even, stamps = scattered()
    rate = moves(even if evenly else stamps) + noise * rng.standard_normal((COUNT, 3))
    log = Recording.from_arrays(time=stamps, gyro=rate, ref_rate=rate)
    found = evenly_sampled(log, rate)
    assert (found is not None) == evenly
    if evenly:
        # A line through 10 s of stamps knows their mean to 0.12 ms over the root of 4000 of them.
        assert np.abs(found - even).max() < 5 * 2 * 1.2e-4 / np.sqrt(4000)


def test_noise_that_hides_it_leaves_the_stamps_alone():
    rng, even, stamps = scattered()
    rate = moves(even) + 1.0 * rng.standard_normal((COUNT, 3))
    assert evenly_sampled(Recording.from_arrays(time=stamps, gyro=rate), rate) is None


def test_a_late_reference_in_rows_whose_stamps_scatter_is_no_lag_of_the_sensor():
    """Moved by a part of a row at stamps 0.12 ms off, it was noisier by that times its slope; a lag
    beside another clock smoothed that, and was named.
    """
    rng, even, stamps = scattered()
    gyro = moves(even) + 1e-3 * rng.standard_normal((COUNT, 3))
    log = Recording.from_arrays(time=stamps, gyro=gyro, ref_rate=moves(even - 0.0026))
    closed = pyimu.close(log)
    assert not closed.added, closed.report()
