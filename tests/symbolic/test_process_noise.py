"""The process noises by what must hold of any: halves make a whole, covariances are definite,
derivatives exist at zero.
"""

from math import factorial

import casadi as ca
import numpy as np
import pytest

from pyimu.symbolic import process_noise as noise
from pyimu.symbolic.series import DECAY, TURN, phi, stumpff

EPS = np.finfo(float).eps
N, K, TAU = np.array([0.3, 0.2, 0.5]), np.array([0.1, 0.4, 0.2]), np.array([0.5, 3.0, 40.0])
TOLERANCE = 1e3 * EPS
"""In standard deviations; some hundred operations on numbers of that size."""


def scaled(a, b, reference):
    std = np.sqrt(np.diag(reference))
    return np.abs((np.array(a) - np.array(b)) / np.outer(std, std)).max()


def random_rates(count, low, high):
    rng = np.random.default_rng(0)
    v = rng.standard_normal((count, 3))
    return v / np.linalg.norm(v, axis=1, keepdims=True) * np.geomspace(low, high, count)[:, None]


# Series


@pytest.mark.parametrize("k", range(8))
def test_stumpff_c_k_and_c_k_plus_2_recur_on_both_sides_of_the_edge(k):
    """c_k + z c_(k+2) = 1/k! (Battin 1999, section 4.5); the series are summed apart from each
    other, so rounding alone is left.
    """
    for z in (0.0, 1e-20, 1e-3, 0.7, 0.99 * TURN, 1.01 * TURN, 9.0, 30.0):
        total = float(stumpff(k, ca.DM(z))) + z * float(stumpff(k + 2, ca.DM(z)))
        np.testing.assert_allclose(total * factorial(k), 1, rtol=0, atol=100 * EPS)


@pytest.mark.parametrize("k", range(4))
def test_phi_k_and_phi_k_plus_1_recur_on_both_sides_of_the_edge(k):
    """phi_k + z phi_(k+1) = 1/k! at -z (Hochbruck and Ostermann 2010, eq. 2.11)."""
    for z in (0.0, 1e-20, 1e-3, 0.7, 0.99 * DECAY, 1.01 * DECAY, 9.0, 300.0):
        total = float(phi(k, ca.DM(z))) + z * float(phi(k + 1, ca.DM(z)))
        np.testing.assert_allclose(total * factorial(k), 1, rtol=0, atol=100 * EPS)


@pytest.mark.parametrize("function, step", [(stumpff, 2), (phi, 1)])
def test_derivative_at_zero_is_the_series_second_coefficient(function, step):
    z = ca.SX.sym("z")
    for k in range(1, 6):
        slope = ca.Function("slope", [z], [ca.gradient(function(k, z), z)])
        assert float(slope(0)) == pytest.approx(-1 / factorial(k + step), rel=4 * EPS)


# Covariances


@pytest.mark.parametrize("scale", [1.0, 0.25, 1.3])
def test_two_halves_of_a_turning_period_are_the_whole(scale):
    """Q(2 h) = Q(h) + exp(F h) Q(h) exp(F h)^T, at turns from 1e-9 to 6 rad a period."""
    for rate in random_rates(40, 1e-9, 6.0):
        arguments = ca.DM(rate), ca.DM(N), ca.DM(K)
        f, _ = noise.error_system(arguments[0], arguments[1], [(arguments[2], ca.DM(3, 1))], scale)
        half, whole = (noise.turning_process_noise(*arguments, h, scale) for h in (0.5, 1.0))
        turn = noise.turning_transition(f, rate @ rate, 0.5)
        assert scaled(half + turn @ half @ turn.T, whole, np.array(whole)) < TOLERANCE


def test_two_halves_of_a_gauss_markov_period_are_the_whole():
    f, _ = noise.error_system(ca.DM.zeros(3), ca.DM(N), [(ca.DM(K), 1 / ca.DM(TAU))], 0.7)
    half, whole = (
        noise.gauss_markov_process_noise(ca.DM(N), ca.DM(K), ca.DM(TAU), h, 0.7) for h in (0.5, 1.0)
    )
    transition = noise.discretised(f, ca.DM.eye(6), 0.5, 6)[0]
    assert scaled(half + transition @ half @ transition.T, whole, np.array(whole)) < TOLERANCE


def test_flicker_of_one_process_is_gauss_markov_and_of_twice_half_the_power_too():
    arguments = ca.DM(N), 0.3, 0.9
    one = np.array(noise.gauss_markov_process_noise(ca.DM(N), ca.DM(K), ca.DM(TAU), *arguments[1:]))
    np.testing.assert_array_equal(
        np.array(noise.flicker_process_noise(ca.DM(N), [(ca.DM(K), ca.DM(TAU))], *arguments[1:])),
        one,
    )
    two = np.array(
        noise.flicker_process_noise(
            ca.DM(N), [(ca.DM(K) / np.sqrt(2), ca.DM(TAU))] * 2, *arguments[1:]
        )
    )
    together = np.block([[np.eye(3), np.zeros((3, 6))], [np.zeros((3, 3)), np.eye(3), np.eye(3)]])
    assert scaled(together @ two @ together.T, one, one) < TOLERANCE


def test_stationary_variance_of_a_gauss_markov_bias_is_half_strength_squared_times_tau():
    q = np.array(noise.gauss_markov_process_noise(ca.DM(N), ca.DM(K), ca.DM(TAU), 1e4))
    np.testing.assert_allclose(np.diag(q)[3:], K**2 * TAU / 2, rtol=1e-12)


@pytest.mark.parametrize("h", [1e-4, 1e-2, 1.0, 30.0])
@pytest.mark.parametrize("size", [0.0, 1e-8, 1e-3, 1.0, 10.0])
def test_covariances_are_symmetric_and_definite(h, size):
    n, k, tau, rate = ca.DM(N), ca.DM(K), ca.DM(TAU), ca.DM(random_rates(1, 1.0, 1.0)[0] * size / h)
    for q in (
        noise.turning_process_noise(rate, n, k, h),
        noise.gauss_markov_process_noise(n, k, tau, h),
        noise.flicker_process_noise(n, [(k, tau), (2 * k, 10 * tau)], h),
    ):
        q = np.array(q)
        std = np.sqrt(np.diag(q))
        np.testing.assert_allclose(q, q.T, atol=1e-12 * std.max() ** 2)
        assert np.linalg.eigvalsh(q / np.outer(std, std)).min() > 0


def test_process_noises_have_derivatives_where_nothing_turns_and_nothing_decays():
    """A parameter that stands at its neutral value must not spoil an estimate by NaN."""
    rate, decay, one = ca.SX.sym("rate", 3), ca.SX.sym("decay", 3), ca.SX.ones(3)
    turning = ca.vec(noise.turning_process_noise(rate, one, one, 0.1))
    f, g = noise.error_system(rate, one, [(one, decay)])
    fading = ca.vec(noise.discretised(f, g @ g.T, 0.1)[1])
    slopes = ca.Function(
        "slopes",
        [rate, decay],
        [
            ca.densify(ca.jacobian(turning, rate)),
            ca.densify(ca.jacobian(fading, ca.vertcat(rate, decay))),
        ],
    )
    for slope in slopes(np.zeros(3), np.zeros(3)):
        assert np.isfinite(np.array(slope)).all() and np.abs(np.array(slope)).max() > 1e-5


def test_discretised_is_the_same_by_any_number_of_halvings():
    f, g = noise.error_system(
        ca.DM([0.3, -0.2, 0.5]), ca.DM(N), [(ca.DM(K), 1 / ca.DM([5.0, 3.0, 40.0]))]
    )
    results = [noise.discretised(f, g @ g.T, 0.4, halvings) for halvings in (0, 1, 4)]
    for transition, q in results[1:]:
        np.testing.assert_allclose(np.array(transition), np.array(results[0][0]), atol=1e2 * EPS)
        assert scaled(q, results[0][1], np.array(q)) < TOLERANCE


def test_f_and_g_are_symbolic_where_they_are_asked_symbolically():
    symbolic = noise.error_system(
        ca.SX.sym("w", 3), ca.SX.sym("n", 3), [(ca.SX.sym("k", 3), ca.SX(3, 1))]
    )
    numeric = noise.error_system(ca.DM.ones(3), ca.DM.ones(3), [(ca.DM.ones(3), ca.DM(3, 1))] * 2)
    assert all(isinstance(m, ca.SX) and m.shape == (6, 6) for m in symbolic)
    assert all(isinstance(m, ca.DM) and m.shape == (9, 9) for m in numeric)
