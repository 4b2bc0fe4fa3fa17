"""Which noise it is: the comparison of models, on variances that are what a model expects."""

import numpy as np
import pytest
from scipy.signal import lfilter
from scipy.stats import norm

import pyimu
from pyimu.characterization.allan import octave_clusters, overlapping_deviation
from pyimu.characterization.allan.law import allan_laws
from pyimu.characterization.allan.moments import TERMS, moments
from pyimu.characterization.noise.candidates import LooseMoments
from pyimu.characterization.noise.coefficients import solve
from pyimu.characterization.noise.fit import fit_noise
from pyimu.characterization.noise.least_squares import Problem
from pyimu.characterization.noise.ranking import log_likelihood, rank
from pyimu.model.simulate import simulate
from pyimu.recording.recording import Recording

H = 0.01
N_SAMPLES = 2**15
CLUSTERS = octave_clusters(N_SAMPLES)

LIKE = {"B": (0.05, "K"), "K": (2e-4, "B")}
"""Squares beside white noise of one that show in the last third of the octaves, and what looks like
them."""


def expected(squares: np.ndarray, times: tuple[float, ...] = ()) -> np.ndarray:
    """The mean Allan variances of noise with these squares."""
    return moments(CLUSTERS, N_SAMPLES, times).design @ squares


@pytest.mark.parametrize("there", LIKE)
def test_flicker_and_a_random_walk_are_not_taken_for_each_other(there):
    """Of variances that are just those of one, a fit of the other is exchanged."""
    square, other = LIKE[there]
    squares = np.zeros(5)
    squares[[TERMS.index("N"), TERMS.index(there)]] = 1.0, square
    problem = Problem(_loose(), expected(squares))
    found = rank(problem, [TERMS.index("N"), TERMS.index(other)], [N_SAMPLES])
    assert [TERMS[k] for k in found.kept] == sorted(["N", there], key=TERMS.index)
    np.testing.assert_allclose(problem.fit(found.kept)[found.kept], squares[found.kept], rtol=1e-6)
    assert found.models[0].score > found.models[1].score


def test_a_drift_that_stops_growing_is_gauss_markov_noise():
    """Its standard deviation and time are found from the variances that they make.

    The time is the top of a parabola through neighbours half an octave away, and so right to a
    fraction of that step.
    """
    time, square = 200.0, 0.04
    squares = np.array([0, 1.0, 0, 0, 0, square])
    problem = Problem(_loose(), expected(squares, (time,)))
    kept = [TERMS.index(t) for t in "NK"]
    found = rank(problem, kept, [N_SAMPLES])
    assert found.models[0].terms == "NG" and len(found.times) == 1
    assert abs(np.log(found.times[0] / time)) < np.log(2) / 8
    assert found.problem.fit(found.kept)[-1] == pytest.approx(square, rel=0.1)


def test_a_term_beside_which_another_explains_all_has_a_bound():
    """Quantization of which there is less than none, as behind a filter: its square is zero, and so
    is its error.
    """
    kept = [TERMS.index(t) for t in "QN"]
    problem = Problem(_loose(), expected(np.array([-0.02, 1.0, 0, 0, 0])))
    assert problem.fit(kept)[TERMS.index("Q")] == 0
    found = solve(problem, kept, np.ones(5), 1.0, 0.95, kept)
    assert found.needed == "N" and set(found.estimates) == {"N"}
    assert found["Q"].value == 0 and 0 < found["Q"].high < np.inf


def test_the_likelihood_of_one_variance_is_a_chi_square():
    """That of the longest cluster, which one difference makes, against the law of its square."""
    n = 64
    problem = Problem(moments(np.array([32]), n), np.array([0.3]))
    squares = np.array([0, 1.0, 0, 0, 0])
    (law,) = allan_laws(np.ones_like, np.array([32.0]), n, 1.0)
    density = norm.pdf(np.sqrt(0.3 / law.mean)) / np.sqrt(0.3 * law.mean)
    # One difference squared: twice the half normal's density over twice its root.
    assert log_likelihood(problem, squares) == pytest.approx(np.log(density), rel=1e-3)


def _loose():
    p = moments(CLUSTERS, N_SAMPLES)
    return LooseMoments(p.m, p.design, p.products, p.sums)


# A record, and the part that is made of it


@pytest.fixture(scope="module")
def drifting():
    """White noise of 1 and Gauss-Markov noise of 0.6 with 3 s: 109 of them in the record."""
    rng = np.random.default_rng(952)
    a, draws = np.exp(-H / 3.0), rng.standard_normal((N_SAMPLES, 3))
    draws[1:] *= np.sqrt(1 - a**2)
    drift = 0.6 * lfilter([1.0], [1.0, -a], draws, axis=0)
    return drift + rng.standard_normal((N_SAMPLES, 3)) / np.sqrt(H) * 0.1


def test_gauss_markov_noise_of_a_record(drifting):
    """Time and standard deviation within four of their standard errors.

    The variance of so many correlation times has the relative error sqrt(2 / (duration / 2 tau)).
    """
    for x in drifting.T:
        found = fit_noise(CLUSTERS, overlapping_deviation(x, CLUSTERS), [N_SAMPLES], H)
        (one,) = found.markov
        assert abs(np.log(one.time / 3.0)) < 4 * one.spread and one.spread < 0.5
        assert abs(one.sigma.value / 0.6 - 1) < 4 * np.sqrt(6.0 / (N_SAMPLES * H)) + 4 * one.spread
        assert one.drive == pytest.approx(one.sigma.value * np.sqrt(2 / one.time))


def test_a_part_has_the_drift_and_simulates_it(drifting):
    """The variance of what the part makes is that of the log, which white noise hardly has.

    Each has the relative standard error sqrt(2 tau / duration) sqrt(2), and is taken at four.
    """
    time = np.arange(N_SAMPLES) * H
    rest = np.tile([0.0, 0.0, 9.80665], (N_SAMPLES, 1))
    log = Recording("drifting", time=time, gyro=1e-3 * drifting, accel=rest + 1e-3 * drifting)
    found = pyimu.characterize(log)
    part = found.part()
    assert "gauss_markov" in {e.name for e in part.gyro.effects}
    gyro, _ = simulate(part, np.zeros((N_SAMPLES, 3)), rest, seed=1)
    smooth = np.ones(20) / 20
    made, was = (
        np.array([np.var(np.convolve(v, smooth, "valid")) for v in x.T]) for x in (gyro, log.gyro)
    )
    assert np.all(np.abs(np.log(made / was)) < 4 * np.sqrt(2 * 4 * 3.0 / (N_SAMPLES * H)))
    assert "G Gauss-Markov noise" in found.report()
