"""Shaping filters against the field's closed forms, and against the samples that the same effects draw."""

import numpy as np
import pytest

import pyimu.effects  # noqa: F401  (fills the catalogue)
from pyimu.effect import CATALOGUE, Sensor
from pyimu.errors import UserError
from pyimu.shaping import allan_deviation, psd_two_sided, shaping_filter

N = np.array([6.0e-5, 6.9e-5, 6.0e-5])
K = np.array([2.7e-6, 4.0e-6, 5.2e-6])
H = 0.01
NOISE = {"angle_random_walk": {"N": N}, "rate_random_walk": {"K": K}}


def sensor(kind="gyro"):
    return Sensor(kind, NOISE)


@pytest.mark.parametrize("axis", range(3))
def test_hidalgo_table_3_angle_random_walk_psd(axis):
    f = np.linspace(0.0, 0.5 / H, 50)
    system = shaping_filter(sensor(), "angle_random_walk", axis, H)
    assert system.nstates == 0
    np.testing.assert_allclose(psd_two_sided(system, f), N[axis] ** 2, rtol=1e-14)


@pytest.mark.parametrize("axis", range(3))
def test_hidalgo_table_3_rate_random_walk_psd(axis):
    """The sampled walk is (sinc)^-2 above the continuous form: K^2 h^2 / (4 sin^2(pi f h))."""
    system = shaping_filter(sensor(), "rate_random_walk", axis, H)
    assert system.nstates == 1
    f = np.geomspace(1e-5, 0.5 / H, 60)
    sampling = np.sinc(f * H) ** -2
    np.testing.assert_allclose(psd_two_sided(system, f), K[axis] ** 2 / (2 * np.pi * f) ** 2 * sampling, rtol=1e-9)


def test_a_filter_of_one_effect_does_not_see_the_others():
    alone = shaping_filter(Sensor("accel", {"rate_random_walk": {"K": K}}), "rate_random_walk", 1, H)
    among = shaping_filter(sensor("accel").with_values("lag", wn=30.0), "rate_random_walk", 1, H)
    assert np.array_equal(alone.A, among.A) and np.array_equal(alone.B, among.B) and np.array_equal(alone.C, among.C)


@pytest.mark.parametrize("tau", [0.01, 0.5, 30.0, 1000.0])
def test_hidalgo_table_3_allan_of_a_continuous_density(tau):
    white = allan_deviation(lambda f: np.full_like(f, N[0] ** 2), tau)
    walk = allan_deviation(lambda f: K[0] ** 2 / (2 * np.pi * f) ** 2, tau)
    np.testing.assert_allclose(white, N[0] / np.sqrt(tau), rtol=1e-9)
    np.testing.assert_allclose(walk, K[0] * np.sqrt(tau / 3), rtol=1e-9)


def test_hidalgo_table_3_allan_of_flicker():
    """B^2 / (2 pi f) up to f0: far above 1 / f0 the floor (2 ln 2 / pi) B^2, less a share of order 1 / (f0 tau)^2."""
    f0, tau = 10.0, 50.0
    flicker = allan_deviation(lambda f: np.where(f <= f0, 1 / (2 * np.pi * f), 0.0), tau)
    np.testing.assert_allclose(flicker ** 2, 2 * np.log(2) / np.pi, rtol=1 / (f0 * tau) ** 2)


@pytest.mark.parametrize("n", [1, 2, 7, 100, 5000])
def test_allan_of_sampled_noise_is_exact(n):
    """Means of n samples: N^2 / tau, and for the sampled walk K^2 tau / 3 (1 + 1 / (2 n^2)), by summing its increments."""
    white = shaping_filter(sensor(), "angle_random_walk", 2, H)
    walk = shaping_filter(sensor(), "rate_random_walk", 2, H)
    tau = n * H
    np.testing.assert_allclose(allan_deviation(lambda f: psd_two_sided(white, f), tau, H) ** 2, N[2] ** 2 / tau, rtol=1e-10)
    np.testing.assert_allclose(allan_deviation(lambda f: psd_two_sided(walk, f), tau, H) ** 2,
                               K[2] ** 2 * tau / 3 * (1 + 0.5 / n ** 2), rtol=1e-9)


@pytest.mark.parametrize("n", [1, 10, 400])
def test_allan_of_a_markov_process_is_exact(n):
    """A pole inside the circle: b+ = a b + w has the autocovariance a^|k| / (1 - a^2), whose double sum is the variance."""
    a = 0.98
    lag = np.arange(2 * n)
    rho = a ** np.abs(lag[:, None] - lag[None, :]) / (1 - a ** 2)
    sign = np.where(lag < n, -1.0, 1.0) / n
    got = allan_deviation(lambda f: H / np.abs(np.exp(2j * np.pi * f * H) - a) ** 2, n * H, H) ** 2
    np.testing.assert_allclose(got, 0.5 * sign @ rho @ sign, rtol=1e-9)


@pytest.mark.parametrize("name", [e.name for e in CATALOGUE.values() if e.stochastic])
def test_a_filter_answers_an_impulse_as_the_simulation_does(name):
    """Additive noise: the response of the simulated effect to one normal is the filter's impulse response."""
    for kind in CATALOGUE[name].sensors:
        start = Sensor(kind, {name: {}})
        one = start.with_p(np.linspace(0.5, 1.5, len(start.slots)))
        system = shaping_filter(one, name, 1, H)
        state, response = one.chain.start, []
        for k in range(20):
            w = np.zeros(len(one.noise))
            w[1] = k == 0
            state, y = one.step(state, np.zeros(7), one.p, w, H)
            response.append(float(y[1]))
        powers = [system.D[0, 0]] + [(system.C @ np.linalg.matrix_power(system.A, k) @ system.B).item() for k in range(19)]
        np.testing.assert_allclose(response, powers, rtol=1e-12)


def test_errors_name_the_effect():
    with pytest.raises(UserError, match="gyro has no effect lag"):
        shaping_filter(sensor(), "lag", 0, H)
    with pytest.raises(UserError, match="gyro.scale_factor draws no noise"):
        shaping_filter(Sensor("gyro", {"scale_factor": {"s": 0.1}}), "scale_factor", 0, H)
    with pytest.raises(ValueError, match="multiples of the sample period"):
        allan_deviation(lambda f: f, 0.015, H)
    with pytest.raises(ValueError, match="positive"):
        allan_deviation(lambda f: f, 0.0)
