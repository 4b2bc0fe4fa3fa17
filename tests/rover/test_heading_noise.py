"""The heading that noise makes after a rest, against samples drawn and a Kalman filter."""

import numpy as np
import pytest
from scipy.stats import chi2

from pyimu.rover.heading_noise import DRAWS, HeadingNoise, largest_walk, scale_factor_for

N, K = 5.96e-5, 5.19e-6  # rad/sqrt(s), rad/s/sqrt(s); about those of the IMT30


def variance_after_rest(n: float, k: float, rest: float, h: float = 0.01) -> float:
    """Variance of a bias that a Kalman filter has seen for ``rest`` s, by its recursion.

    It starts from the first sample, N^2/h, and is off by a share of the order of K h / N.
    """
    p = n**2 / h
    for _ in range(round(rest / h) - 1):
        p += k**2 * h
        p -= p**2 / (p + n**2 / h)
    return p


@pytest.mark.parametrize("rest", (5.0, 20.0, 60.0))
def test_the_bias_after_a_rest_is_what_a_kalman_filter_leaves(rest):
    found = HeadingNoise(N, K, rest, 100.0).bias_variance
    assert found == pytest.approx(variance_after_rest(N, K, rest), rel=5e-3)


def test_without_a_walk_the_bias_is_known_as_a_mean():
    assert HeadingNoise(N, 0.0, 30.0, 100.0).bias_variance == pytest.approx(N**2 / 30, rel=1e-12)


def test_the_variance_of_heading_is_that_of_simulated_samples():
    """White noise and walk drawn at every sample, another way than the draws of the package; the
    variance of M drives is chi-squared of M degrees of freedom, here to a chance of 1e-4.
    """
    drives, h, duration = 3000, 0.25, 200.0
    noise = HeadingNoise(N, K, 60.0, duration)
    rng = np.random.default_rng(5)
    bias = np.sqrt(noise.bias_variance) * rng.standard_normal(drives)
    heading = np.zeros(drives)
    for _ in range(round(duration / h)):
        heading += h * bias + N * np.sqrt(h) * rng.standard_normal(drives)
        bias += K * np.sqrt(h) * rng.standard_normal(drives)
    low, high = chi2.ppf([0.5e-4, 1 - 0.5e-4], drives) / drives
    # Sums for integrals are off by a share of h/duration.
    assert low * 0.995 < np.mean(heading**2) / noise.std(duration) ** 2 < high * 1.005


@pytest.mark.parametrize("share", (0.1, 0.5, 1.0))
def test_the_draws_have_the_variance_of_the_formula(share):
    noise = HeadingNoise(N, K, 60.0, 500.0)
    at = int(share * (len(noise.time) - 1))
    low, high = chi2.ppf([0.5e-4, 1 - 0.5e-4], DRAWS) / DRAWS
    assert low < np.mean(noise.draws[:, at] ** 2) / noise.std(noise.time[at]) ** 2 < high


def test_the_walk_for_a_limit_leaves_half_of_the_drives_within_it():
    noise, limit = HeadingNoise(N, K, 60.0, 500.0), np.deg2rad(0.35)
    walk = largest_walk(noise, limit)
    assert 0 < walk < K
    share = HeadingNoise(N, walk, 60.0, 500.0).share_below(limit)
    assert share == pytest.approx(0.5, abs=0.01)


def test_without_noise_the_scale_factor_is_the_angle_by_the_turn():
    noise = HeadingNoise(1e-12, 0.0, 60.0, 100.0)
    turned = np.pi * np.sin(np.pi * noise.time / 100.0) ** 2
    found = scale_factor_for(noise, turned, np.deg2rad(6.5))
    assert found == pytest.approx(-6.5 / 180, rel=1e-3)
