"""The noise that the FMU gives against its analytic two-sided density, inside the band of the estimator's own distribution.

Ordinates of the periodogram of white Gaussian noise at its Fourier frequencies are independent and exactly S chi2(2) / 2;
the mean of m of them is S chi2(2 m) / (2 m).  A random walk is differenced first: its own periodogram is leakage from
the lowest frequencies, its differences are white.  Family-wise one false alarm in a thousand, by Bonferroni over bands,
axes and versions.
"""

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest
from scipy.stats import chi2, norm

from pyimu.effect import Sensor
from pyimu.fmu import build_fmus, simulate
from pyimu.imu import Part
from pyimu.shaping import psd_two_sided, shaping_filter

H, SAMPLES = 0.01, 2 ** 16
SEEDS = {2: 11, 3: 12}
FALSE_ALARM = 1e-3
N = np.array([6.0e-5, 6.9e-5, 5.0e-5])
K = np.array([2.7e-3, 4.0e-3, 5.2e-3])
PART = Part("noise", 1 / H, gyro=Sensor("gyro", {"angle_random_walk": {"N": N}}),
            accel=Sensor("accel", {"rate_random_walk": {"K": K}}))


@pytest.fixture(scope="module")
def outputs(tmp_path_factory):
    """Outputs (SAMPLES, 6) at rest by FMI version: white noise from the gyro, a random walk from the accelerometer."""
    u = np.zeros((SAMPLES + 1, 7))
    paths = dict(zip(SEEDS, build_fmus(PART.block, tmp_path_factory.mktemp("fmus"), tuple(SEEDS))))
    return {v: simulate(path, u, sample_period=H, start_values={"seed": SEEDS[v]})[1:] for v, path in paths.items()}


def octaves(n: int) -> list[slice]:
    """Bins of the periodogram of n samples, by octaves from the first to below Nyquist, at most."""
    edges = 2 ** np.arange(int(np.log2(n)))
    return [slice(a, b) for a, b in pairwise(edges)]


def periodogram_two_sided(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies [Hz] and two-sided periodogram of x (n,), no window, every Fourier frequency from zero to Nyquist."""
    return np.fft.rfftfreq(len(x), H), np.abs(np.fft.rfft(x)) ** 2 * H / len(x)


def assert_inside_band(x: np.ndarray, density: Callable, tests: int) -> float:
    """Every octave of x against density(f); gives the relative half width of the tightest band."""
    f, power = periodogram_two_sided(x)
    bands = octaves(len(x))
    alpha, narrowest = FALSE_ALARM / (tests * len(bands)), np.inf
    for band in bands:
        m = band.stop - band.start
        low, high = chi2.ppf([alpha / 2, 1 - alpha / 2], 2 * m) / (2 * m)
        ratio = np.mean(power[band] / density(f[band]))
        where = f"{f[band.start]:.4g} to {f[band.stop]:.4g} Hz"
        assert low <= ratio <= high, f"{where}: {ratio:.4f} of the theory is not in {low:.4f} to {high:.4f}"
        narrowest = min(narrowest, (high - low) / 2)
    return narrowest


TESTS = 2 * 3 * len(SEEDS)


@pytest.mark.parametrize("version", SEEDS)
@pytest.mark.parametrize("axis", range(3))
def test_hidalgo_table_3_angle_random_walk_psd(outputs, version, axis):
    width = assert_inside_band(outputs[version][:, axis], lambda f: np.full_like(f, N[axis] ** 2), TESTS)
    assert width < 0.05


@pytest.mark.parametrize("version", SEEDS)
@pytest.mark.parametrize("axis", range(3))
def test_hidalgo_table_3_rate_random_walk_psd(outputs, version, axis):
    """K^2 / (2 pi f)^2, which sampling raises by sinc^-2; both sides times the gain of a difference, 4 sin^2(pi f h)."""
    def differenced(f):
        return K[axis] ** 2 / (2 * np.pi * f) ** 2 * np.sinc(f * H) ** -2 * 4 * np.sin(np.pi * f * H) ** 2
    width = assert_inside_band(np.diff(outputs[version][:, 3 + axis]), differenced, TESTS)
    assert width < 0.05


def test_the_shaping_filter_has_the_density_of_the_tests():
    f = np.geomspace(1e-3, 49.0, 50)
    for axis in range(3):
        white = shaping_filter(PART.gyro, "angle_random_walk", axis, H)
        walk = shaping_filter(PART.accel, "rate_random_walk", axis, H)
        np.testing.assert_allclose(psd_two_sided(white, f), N[axis] ** 2, rtol=1e-12)
        np.testing.assert_allclose(psd_two_sided(walk, f), K[axis] ** 2 / (2 * np.pi * f) ** 2 * np.sinc(f * H) ** -2, rtol=1e-9)


def test_axes_sensors_and_seeds_are_independent(outputs):
    """Correlations of independent white series are normal with variance 1 / n."""
    white = np.hstack([np.hstack([y[1:, :3], np.diff(y[:, 3:], axis=0)]) for y in outputs.values()])
    r = np.corrcoef(white.T)[np.triu_indices(white.shape[1], 1)]
    assert np.abs(r).max() * np.sqrt(len(white)) < norm.isf(FALSE_ALARM / 2 / len(r))
