"""The band filter: its edge by the transfer function, its rows by plain convolution."""

import numpy as np
import pytest
from scipy.optimize import brentq

from pyimu.identification.fit.band import Band

SEGMENTS = [(0, 137), (140, 150), (150, 152), (160, 400)]


def edge(band: Band, sample_rate: float, highest: float) -> float:
    """Frequency at which the power has halved: the symmetric window's transfer function is a sum of
    cosines.
    """
    k = np.arange(len(band.weights)) - band.half
    return brentq(
        lambda f: np.cos(2 * np.pi * f * k / sample_rate) @ band.weights - np.sqrt(0.5),
        0.0,
        highest,
    )


@pytest.mark.parametrize("ratio", [10.0, 12.5, 20.0, 40.0, 100.0, 400.0])
def test_power_halves_at_nine_tenths_of_the_band(ratio):
    """A Hann window of L samples falls to 1/sqrt(2) at 0.7203 of the sample rate over L, and L is
    two rows."""
    band_hz = 7.0
    band = Band.below(band_hz, ratio * band_hz)
    expected = 0.7203 * 2.5 / 2
    assert abs(edge(band, ratio * band_hz, 1.5 * band_hz) / band_hz / expected - 1) < 0.002


@pytest.mark.parametrize(
    ("band_hz", "sample_rate"), [(5.0, 50.0), (3.0, 100.0), (0.7, 25.0), (11.0, 200.0)]
)
def test_rows_are_the_convolution_at_the_centres(band_hz, sample_rate):
    band = Band.below(band_hz, sample_rate)
    values = np.random.default_rng(1).standard_normal((400, 2))
    rows, centres = band.apply(values, SEGMENTS), band.centres(SEGMENTS)
    assert len(rows) == len(centres) > 0
    for column in range(2):
        whole = np.convolve(values[:, column], band.weights, mode="same")
        np.testing.assert_allclose(rows[:, column], whole[centres], atol=1e-14)


@pytest.mark.parametrize("band_hz", [2.0, 4.0, 8.25, 12.6, 16.0])
def test_rows_come_at_two_and_a_half_times_the_band(band_hz):
    """To the next whole number of samples; denser ones show what lies beyond the band, and a lag
    beside a slipping clock was not found among them."""
    band = Band.below(band_hz, 100.0)
    assert set(np.diff(band.centres([(0, 1000)]))) == {round(40.0 / band_hz)}


def test_nothing_crosses_a_segment():
    band = Band.below(5.0, 50.0)
    values = np.random.default_rng(2).standard_normal((400, 1))
    spoilt = np.full((400, 1), np.nan)
    for a, b in SEGMENTS:
        spoilt[a:b] = values[a:b]
    np.testing.assert_array_equal(band.apply(spoilt, SEGMENTS), band.apply(values, SEGMENTS))
    apart = [band.apply(values[a:b], [(0, b - a)]) for a, b in SEGMENTS]
    np.testing.assert_array_equal(band.apply(values, SEGMENTS), np.concatenate(apart))
    for a, b in SEGMENTS:
        inside = [c for c in band.centres(SEGMENTS) if a <= c < b]
        assert all(a <= c - band.half and c + band.half < b for c in inside)


def test_constant_stays_and_a_ramp_has_no_delay():
    band = Band.below(1.5, 50.0)
    ramp = np.column_stack([np.full(400, 3.0), 0.25 * np.arange(400.0)])
    np.testing.assert_allclose(band.apply(ramp, SEGMENTS), ramp[band.centres(SEGMENTS)], rtol=1e-13)


def test_no_band_keeps_every_sample():
    values = np.random.default_rng(3).standard_normal((400, 3))
    assert Band.below(45.0, 50.0) == Band()
    kept = np.concatenate([np.arange(a, b) for a, b in SEGMENTS])
    np.testing.assert_array_equal(Band().centres(SEGMENTS), kept)
    np.testing.assert_array_equal(Band().apply(values, SEGMENTS), values[kept])


def test_segments_shorter_than_the_window_give_nothing():
    band = Band.below(1.0, 50.0)
    assert len(band.centres([(0, 20)])) == len(band.apply(np.ones((20, 1)), [(0, 20)])) == 0
    assert band.apply(np.ones((20, 3)), []).shape == (0, 3)


@pytest.mark.parametrize(
    ("band_hz", "sample_rate"),
    [(5.0, 50.0), (1.5, 50.0), (2.25, 100.0), (0.7, 25.0), (12.0, 100.0)],
)
def test_rows_add_up_to_what_the_samples_do(band_hz, sample_rate):
    """So the noise of attitudes, whose turns add up to what lies between the first and the last,
    leaves nothing slow: the windows of all rows are a partition of unity.
    """
    band = Band.below(band_hz, sample_rate)
    middle = 20 * len(band.weights)
    impulses = np.eye(40 * len(band.weights))[:, middle : middle + band.stride]
    sums = band.apply(impulses, [(0, len(impulses))]).sum(axis=0)
    np.testing.assert_allclose(sums, 1.0 / band.stride, rtol=1e-12)
