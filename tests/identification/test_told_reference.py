"""Set points for a reference: the body follows them as behind a low-pass filter, and no sensor."""

import numpy as np
import pytest
from scipy.signal import butter, lfilter, sosfilt

import pyimu
from pyimu.identification.fit.trials import gyro_trial
from pyimu.identification.reference.told import followed_up_to

RATE, SECONDS, WHITE = 50.0, 160.0, 1e-3


def platform(cutoff: float, seed: int) -> pyimu.Recording:
    """A platform that follows the rate it is told, up to 1.5 Hz, as behind a filter of second order
    with ``cutoff`` Hz, or exactly at zero.
    """
    rng, n = np.random.default_rng(seed), int(RATE * SECONDS)
    band = butter(2, [0.05, 1.5], "bandpass", fs=RATE, output="sos")
    told = 0.5 * sosfilt(band, rng.standard_normal((n, 3)), axis=0) * np.sqrt(RATE)
    did = lfilter(*butter(2, cutoff, fs=RATE), told, axis=0) if cutoff else told
    gyro = did + 0.002 + WHITE * rng.standard_normal(told.shape)
    return pyimu.Recording.from_arrays(
        "platform", time=np.arange(n) / RATE, gyro=gyro, ref_rate=told
    )


@pytest.mark.parametrize("cutoff", [0.7, 1.5])
def test_set_points_tell_nothing_of_a_gyro(cutoff):
    found = pyimu.close(platform(cutoff, 21))
    assert found.verdict == "reference_unfit" and not found.added, found.report()
    assert "what the body was told to do" in found.reason


@pytest.mark.parametrize("seed", range(22, 27))
def test_the_frequency_is_that_which_passes_half_the_power(seed):
    """Within two of the frequencies of the spectra, which lie an eighth of a hertz apart."""
    log = platform(1.0, seed)
    assert followed_up_to(gyro_trial(log)) == pytest.approx(1.0, abs=0.25)


@pytest.mark.parametrize("cutoff", [0.0, 8.0])
@pytest.mark.parametrize("seed", range(27, 30))
def test_what_the_body_did_is_no_set_point(cutoff, seed):
    log = platform(cutoff, seed)
    assert followed_up_to(gyro_trial(log)) == 0.0
