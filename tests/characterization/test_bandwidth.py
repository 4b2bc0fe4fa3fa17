"""The bandwidth of white noise through a low-pass that runs much faster than the samples."""

import numpy as np
import pytest
from scipy.signal import butter, sosfilt
from scipy.stats import norm

import pyimu
from pyimu.recording.recording import Recording

H, N, FASTER = 0.01, 60_000, 16


def noise(rng, corner, order):
    """White noise (N,) through a Butterworth filter at ``FASTER`` times the rate, every so many."""
    if corner is None:
        return rng.standard_normal(N)
    sections = butter(order, corner, fs=FASTER / H, output="sos")
    return sosfilt(sections, rng.standard_normal(N * FASTER))[::FASTER]


@pytest.fixture(scope="module")
def channels():
    """x at 15 Hz of second order, y at 8 Hz of first, z level."""
    rng = np.random.default_rng(42)
    gyro = 1e-3 * np.column_stack([noise(rng, *of) for of in ((15.0, 2), (8.0, 1), (None, 0))])
    log = Recording("filtered", time=H * np.arange(N), gyro=gyro)
    return pyimu.characterize(log)


def test_the_corner_and_the_order_are_those_of_the_filter(channels):
    """Within three and a half standard errors, and half a percent.

    As much is the corner of a filter at 1600 Hz off that of one in continuous time, which the
    bilinear transform bends by (pi 15 / 1600)^2 / 3 and more where it falls.
    """
    x = channels.logs[0].sensors["gyro"].channels[0].bandwidth
    assert x.order == 2
    assert abs(x.frequency.value - 15.0) < norm.isf(2e-4) * x.frequency.std + 0.075
    assert x.frequency.std < 0.5 and x.frequency.low < x.frequency.value < x.frequency.high


def test_what_folds_back_is_allowed_for(channels):
    """Of a filter of first order much comes back; it adds to 8 Hz what the last samples make."""
    y = channels.logs[0].sensors["gyro"].channels[1].bandwidth
    assert y.order == 1
    assert abs(y.frequency.value - 8.0) < norm.isf(2e-4) * y.frequency.std + 0.04


def test_a_level_spectrum_has_none(channels):
    assert channels.logs[0].sensors["gyro"].channels[2].bandwidth is None


def test_it_is_said_and_written(channels):
    assert "gyro_x: bandwidth 1" in channels.report()
    found = channels.as_dict()["logs"][0]["sensors"]["gyro"]["channels"]
    assert found["gyro_x"]["bandwidth"]["order"] == 2 and found["gyro_z"]["bandwidth"] is None
