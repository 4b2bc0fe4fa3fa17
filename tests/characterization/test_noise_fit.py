"""The fit of a real channel: lines, a filter, and what is left out.

Also records with gaps, and whether intervals hold where terms look alike.
"""

from dataclasses import replace

import numpy as np
import pytest
from places import program
from scipy.signal import lfilter
from scipy.stats import binom, norm

from pyimu.characterization.allan import octave_clusters, overlapping_deviation
from pyimu.characterization.allan.law import allan_laws
from pyimu.characterization.allan.moments import TERMS
from pyimu.characterization.allan.pooled import (
    FEW,
    differences,
    equivalent_freedom,
    pooled_deviation,
    pooled_moments,
    used_segments,
)
from pyimu.characterization.noise.coefficients import (
    Coefficient,
    _unextended,
    mean_coefficient,
    si_factors,
)
from pyimu.characterization.noise.fit import fit_noise
from pyimu.characterization.noise.sines import Sine, sine_variance
from pyimu.errors import UserError

H = 0.01
N_SAMPLES = 2**15
CLUSTERS = octave_clusters(N_SAMPLES)
ALPHA = 1e-3 / 10
"""Probability with which each statistical test may fail where all is right; there are at most ten.
"""


def fit(x, **options):
    m = octave_clusters(len(x))
    return fit_noise(m, overlapping_deviation(x, m), [len(x)], H, **options)


def white(seed, n=N_SAMPLES):
    """N = 1 in units of samples, s."""
    return np.random.default_rng(seed).standard_normal(n) / np.sqrt(H)


@pytest.fixture(scope="module")
def coverage():
    return program("benchmarks/characterize_coverage.py")


# Lines and filters


def test_allan_variance_of_a_sine():
    """A^2 sin^4(pi f tau) / (m sin(pi f h))^2, of a whole number of half periods in the overlaps.

    It is right to one part in their number.
    """
    f, A, m = 0.0123, 2.0, np.array([1, 2, 5, 16, 33, 40, 128])
    n = 200_000
    x = A * np.sin(2 * np.pi * f * np.arange(n) + 0.3)
    # The mean of sin^2 over k terms is a half to 1 / (2 k sin(2 pi f)).
    slack = 1 / (2 * (n - 2 * m) * np.sin(2 * np.pi * f))
    want = sine_variance(m.astype(float), Sine(f, 0.0, A**2))
    np.testing.assert_array_less(
        np.abs(overlapping_deviation(x, m) ** 2 - want), 2 * slack * A**2 + 1e-12
    )


def test_a_spread_frequency_averages_the_fourth_power_of_the_sine():
    rng, m = np.random.default_rng(3), np.array([1.0, 7.0, 30.0, 100.0])
    draws = 0.02 + 1e-3 * rng.standard_normal(20_000)
    fourth = np.sin(np.pi * draws[:, None] * m) ** 4
    got = sine_variance(m, Sine(0.02, 1e-3, 1.0)) * (m * np.sin(np.pi * 0.02)) ** 2
    assert np.all(
        np.abs(got - fourth.mean(axis=0))
        <= norm.isf(ALPHA / 8) * fourth.std(axis=0) / np.sqrt(len(draws)) + 1e-12
    )


@pytest.mark.parametrize("frequency", (0.7, 20.0))
def test_white_noise_under_a_strong_line(frequency):
    """N is within its own normal law, which the line does not widen much.

    The line has a hundred times the power of the noise in the samples.
    """
    x = white(5) + 100.0 * np.sin(2 * np.pi * frequency * H * np.arange(N_SAMPLES))
    found = fit(x, lines=[(frequency, 1e-6, 100.0)])
    assert found.shortest == H and found.model_error == 0.0 and len(found.lines) == 1
    assert (
        abs(found["N"].value - 1) <= norm.isf(ALPHA / 4) * found["N"].std and found["N"].std < 0.02
    )
    tau = CLUSTERS * H
    np.testing.assert_allclose(
        found.variance(tau[:-3]), overlapping_deviation(x, CLUSTERS)[:-3] ** 2, rtol=0.5
    )


def test_a_line_that_nobody_named_costs_the_short_clusters_not_the_coefficients():
    x = white(6) + 10.0 * np.sin(2 * np.pi * 9.7 * H * np.arange(N_SAMPLES))
    found = fit(x)
    assert found.shortest > H
    assert abs(found["N"].value - 1) <= norm.isf(ALPHA / 2) * found["N"].std
    assert np.all(np.isnan(found.variance(np.array([H]))))


def test_a_filter_in_the_sensor_is_no_quantization():
    """White noise through a low-pass of a few samples keeps its N.

    Quantization gets a bound and not a value.
    """
    found = fit(lfilter([0.2, 0.3, 0.3, 0.2], [1.0], white(7)))
    assert abs(found["N"].value - 1) <= norm.isf(ALPHA / 2) * found["N"].std
    assert not found["Q"].needed and found.free[-1] < 0


def test_angle_quantization_is_found_where_there_is_no_filter():
    Q = 0.3
    x = white(8) + Q / H * np.diff(np.random.default_rng(9).standard_normal(N_SAMPLES + 1))
    found = fit(x)
    assert found["Q"].needed and abs(found["Q"].value - Q) <= norm.isf(ALPHA / 2) * found["Q"].std


def test_the_density_of_the_fit_is_that_of_its_terms():
    """Hidalgo 2012, table 3, two-sided; the walk's with the sine of its samples."""
    found = fit(white(10) + np.cumsum(np.random.default_rng(11).standard_normal(N_SAMPLES)) * 0.05)
    f = np.array([0.1, 1.0, 10.0])
    N, K = found["N"].value, found["K"].value
    np.testing.assert_allclose(
        found.psd_two_sided(f), N**2 + (K * H / (2 * np.sin(np.pi * f * H))) ** 2, rtol=1e-12
    )


def test_errors_name_what_is_wrong():
    with pytest.raises(UserError, match="clusters of 1 samples is zero"):
        fit(np.ones(128))
    with pytest.raises(ValueError, match="5 terms need more than 5 cluster sizes"):
        fit(white(1, 32))


# Coverage


@pytest.mark.long
@pytest.mark.parametrize("name", ("white and flicker", "white, flicker and walk"))
def test_intervals_and_bounds_hold_at_least_as_often_as_they_say(coverage, name):
    """In a hundred logs.

    Where flicker and walk look alike intervals reach to both; that of flicker may hold in nine of
    ten (``benchmarks``).
    """
    logs = 100
    for term, (_, held, _) in coverage.tally(name, logs).items():
        level = 0.90 if (name, term) == ("white, flicker and walk", "B") else 0.95
        assert held >= binom.ppf(ALPHA, logs, level), (term, held)


def test_what_an_interval_reaches_for_another_term_stays_in_the_mean():
    """The limit of the mean is extended by as much as those of the logs are.

    One log is its own mean.
    """
    plain = [Coefficient(v, 0.2, *_unextended(v, 0.2, 0.95)) for v in (9.99, 10.01)]
    reaching = [replace(c, low=c.low - 1.0) for c in plain]
    (a, _), (b, _) = mean_coefficient(plain), mean_coefficient(reaching)
    assert b.low == pytest.approx(a.low - 1.0) and b.high == pytest.approx(a.high)
    assert mean_coefficient(reaching[:1])[0] == reaching[0]


# Records with gaps


def test_pooled_deviation_is_one_sum_over_all_differences():
    pieces, m = [white(k, n) for k, n in enumerate((400, 90, 1000))], np.array([1, 3, 40, 300])
    sums = [np.concatenate(([0], np.cumsum(p))) for p in pieces]
    for size, got in zip(m, pooled_deviation(pieces, m), strict=True):
        d = np.concatenate(
            [s[2 * size :] - 2 * s[size:-size] + s[: -2 * size] for s in sums if len(s) > 2 * size]
        )
        assert got == pytest.approx(np.sqrt(np.mean(d**2) / 2) / size, rel=1e-10)


def test_moments_of_equal_segments_are_those_of_a_mean():
    m = (1, 2, 4, 8, 16)
    one, pooled = pooled_moments(m, (100,)), pooled_moments(m, (100,) * 5)
    squares = np.array([0.2, 1.0, 0.1, 0.01, 0.0])
    np.testing.assert_allclose(pooled.covariance(squares), one.covariance(squares) / 5, rtol=1e-12)


def test_moments_of_unequal_segments():
    """The variance of a mean weighted by the number of differences."""
    m, lengths, squares = (1, 4, 30), (200, 90, 50), np.array([0.0, 1.0, 0.0, 0.1, 0.0])
    share = differences(np.array(m), lengths) / differences(np.array(m), lengths).sum(axis=0)
    each = [
        pooled_moments(tuple(k for k in m if 2 * k <= n), (n,)).covariance(squares) for n in lengths
    ]
    want = [
        sum(share[i, a] ** 2 * each[i][a, a] for i, n in enumerate(lengths) if 2 * k <= n)
        for a, k in enumerate(m)
    ]
    np.testing.assert_allclose(
        np.diag(pooled_moments(m, lengths).covariance(squares)), want, rtol=1e-12
    )


def test_many_segments_have_few_lengths_and_lose_little():
    rng = np.random.default_rng(2)
    edges = np.cumsum(np.append(0, rng.integers(500, 3000, 2 * FEW)))
    found = list(zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True))
    used = used_segments(found)
    lengths = [b - a for a, b in used]
    # Eight steps an octave over less than three octaves; an eighth of an octave is lost at the
    # most.
    assert len(used) == len(found) and len(set(lengths)) <= 8 * np.log2(6) + 2
    assert all(
        b <= stop and a == start and b - a > (stop - start) / 2 ** (1 / 8) - 1
        for (a, b), (start, stop) in zip(used, found, strict=True)
    )


@pytest.mark.parametrize(
    "term, psd", (("N", np.ones_like), ("K", lambda f: 1 / (2 * np.sin(np.pi * f)) ** 2))
)
def test_degrees_of_freedom_are_those_of_the_spectral_integral(term, psd):
    n, m = 20_000, np.array([8, 100, 1000, 6000])
    got = equivalent_freedom(m, [n], (np.array(list(TERMS)) == term).astype(float))
    want = np.array([law.edf for law in allan_laws(psd, m, n, 1.0)])
    # Both within 4 m / (30 n) and (1 / 64)^2 of the variance's true value
    # (tests/test_coefficients.py).
    assert np.all(np.abs(got / want - 1) <= 6 * (m / (30 * n) + 1e-6) + 2 / 64**2)


def test_squares_of_a_fit_are_for_a_sample_period_of_one():
    found = fit(white(12))
    assert found.squares[1] == pytest.approx(found["N"].value ** 2 / si_factors(H)[1]) and np.all(
        found.squares[[0, 2, 3, 4]] == 0
    )
