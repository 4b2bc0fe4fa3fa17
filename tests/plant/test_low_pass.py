"""The unit ``LowPass`` against the same filter of scipy."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.signal import butter, lfilter, lfilter_zi

from pyimu.errors import UserError
from pyimu.plant.low_pass import low_pass

BLOCK = low_pass(1 / 976)


def noise(n=2000):
    return np.random.default_rng(3).standard_normal((n, 6)) + np.arange(6)


@given(st.floats(1e-3, 0.49), st.sampled_from([1.0, 50.0, 976.0]))
def test_it_is_scipys_butterworth_settled_at_its_first_input(share, rate):
    u = noise(300)
    b, a = butter(2, share * rate, fs=rate)
    zi = lfilter_zi(b, a)
    want = np.column_stack([lfilter(b, a, x, zi=zi * x[0])[0] for x in u.T])
    y, _ = BLOCK.run(u, p=np.array([share * rate]), sample_period=1 / rate)
    # rounding of a sample is remembered for some 1/share samples, and as often amplified
    np.testing.assert_allclose(y, want, atol=64 * np.finfo(float).eps * 8 / share**2)


def test_at_the_cutoff_half_the_power_passes():
    time = np.arange(1, 9761) / 976
    wave = np.sin(2 * np.pi * 10 * time)
    y, _ = BLOCK.run(np.tile(wave[:, None], (1, 6)))
    settled = slice(976 * 5, None)  # e^(-44 * 5) of the start is left
    power = (y[settled] ** 2).mean(axis=0) / (wave[settled] ** 2).mean()
    np.testing.assert_allclose(power, 0.5, rtol=1e-12)


def test_a_step_before_is_not_remembered_and_a_constant_passes():
    u = np.full((50, 6), 9.80665)
    np.testing.assert_allclose(BLOCK.run(u)[0], u, rtol=1e-13)


def test_half_and_half_is_the_whole_run():
    u = noise()
    whole, _ = BLOCK.run(u)
    first, state = BLOCK.run(u[:700])
    second, _ = BLOCK.run(u[700:], state=state)
    np.testing.assert_array_equal(np.vstack([first, second]), whole)


@pytest.mark.parametrize("missing", [np.nan, np.inf])
def test_a_missing_sample_is_missing_and_then_over(missing):
    """The filter goes on as if the last sample had been held."""
    u = noise(200)
    u[0, 1], u[50:60, 2] = missing, missing
    y, _ = BLOCK.run(u)
    held = u.copy()
    held[0, 1] = held[1, 1]
    held[50:60, 2] = held[49, 2]
    want, _ = BLOCK.run(held)
    here = np.isfinite(u)
    np.testing.assert_array_equal(np.isfinite(y), here)
    np.testing.assert_array_equal(y[here], want[here])


def test_without_a_cutoff_everything_passes():
    u = noise(100)
    np.testing.assert_array_equal(BLOCK.run(u, p=np.array([0.0]))[0], u)


def test_a_cutoff_beyond_half_the_sample_rate_is_refused():
    with pytest.raises(UserError, match="cutoff must be below half the sample rate"):
        BLOCK.run(noise(1), p=np.array([488.0]))
