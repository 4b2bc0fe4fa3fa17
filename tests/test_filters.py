"""The filters and spectra are those of scipy.signal, up to the rounding of a sum of so many
numbers of one size.
"""

import numpy as np
import pytest
from scipy import signal

from pyimu import filters

ROUNDING = 1e-12
VALUES = np.random.default_rng(1).standard_normal((1501, 3))


@pytest.mark.parametrize("length", [16, 63])
def test_window(length):
    expected = signal.windows.hann(length, sym=False)
    np.testing.assert_allclose(filters.hann(length), expected, atol=ROUNDING)


@pytest.mark.parametrize(("count", "stride"), [(1, 1), (25, 13), (19, 40), (1501, 7)])
def test_every_so_many_of_a_moving_average(count, stride):
    weights = np.random.default_rng(2).standard_normal(count)
    full = np.array([signal.correlate(v, weights, "valid")[::stride] for v in VALUES.T]).T
    found = filters.decimated(VALUES, weights, stride)
    np.testing.assert_allclose(found, full, atol=ROUNDING)


@pytest.mark.parametrize("coefficients", [(), (0.9,), (0.5, -0.2, 0.1)])
def test_autoregression(coefficients):
    expected = signal.lfilter([1.0], [1.0, *(-c for c in coefficients)], VALUES[:, 0])
    found = filters.recursive(VALUES[:, 0], np.array(coefficients))
    np.testing.assert_allclose(found, expected, atol=ROUNDING)


def test_gain():
    weights, turn = np.random.default_rng(3).random(7), np.linspace(0.0, 0.5, 99)
    expected = np.abs(signal.freqz(weights, worN=turn, fs=1.0)[1])
    np.testing.assert_allclose(filters.gain(weights, turn), expected, atol=ROUNDING)


@pytest.mark.parametrize("length", [1, 2, 64, 1500, 1501])
def test_convolution(length):
    response = np.random.default_rng(4).standard_normal((length, 3))
    expected = signal.oaconvolve(VALUES, response, axes=0)[: len(VALUES)]
    np.testing.assert_allclose(filters.convolved(VALUES, response), expected, atol=ROUNDING)


@pytest.mark.parametrize("length", [16, 63, 1024, 1501])
def test_density(length):
    expected = signal.welch(VALUES, 50.0, nperseg=length, axis=0, detrend="constant")
    for mine, theirs in zip(filters.density(VALUES, 50.0, length), expected, strict=True):
        np.testing.assert_allclose(mine, theirs, atol=ROUNDING)
