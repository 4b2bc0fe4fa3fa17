"""Coefficients from Allan deviations.

Moments are tested against traces of matrices, intervals and bounds against draws, and the example
on a short log.
"""

import numpy as np
import pytest
from places import program
from scipy.stats import binom, norm

from pyimu.characterization.allan import octave_clusters, overlapping_deviation
from pyimu.characterization.allan.law import allan_laws
from pyimu.characterization.allan.moments import TERMS, design, moments
from pyimu.characterization.allan.readings import crossing, read_coefficients
from pyimu.characterization.noise.coefficients import (
    Coefficient,
    fit_coefficients,
    mean_coefficient,
)
from pyimu.errors import UserError
from pyimu.fmu import simulate_blocks
from pyimu.identification.fit.whiten import RandomWalk
from pyimu.model.part_file import part
from pyimu.shaping import (
    angle_quantization_deviation,
    flicker_floor,
    ramp_deviation,
    random_walk_deviation,
    white_deviation,
)

H = 0.01
N_SAMPLES = 2**14
CLUSTERS = octave_clusters(N_SAMPLES)
WHITE, CROSSING = 1.0, 100
WALK = np.sqrt(3) * WHITE / (CROSSING * H)
"""N and K of equal Allan variance at clusters of ``CROSSING`` samples, tau = sqrt(3) N / K."""

ALPHA = 1e-3 / 8
"""Probability with which each statistical test may fail where all is right; there are at most
eight."""


def draw(
    rng: np.random.Generator, N: float, K: float, R: float = 0.0, n: int = N_SAMPLES
) -> np.ndarray:
    """A log (n,) of white noise, random walk and ramp."""
    return (
        N / np.sqrt(H) * rng.standard_normal(n)
        + K * np.sqrt(H) * np.cumsum(rng.standard_normal(n))
        + R * H * np.arange(n)
    )


def fit(x: np.ndarray, terms: str = TERMS):
    m = octave_clusters(len(x))
    return fit_coefficients(m, overlapping_deviation(x, m), len(x), H, terms)


# Moments

SHAPES = {"Q": np.eye(61)[1:] - np.eye(61)[:-1], "N": np.eye(60), "K": np.tril(np.ones((60, 60)))}
"""What makes 60 samples of a noise with a coefficient of one, and a sample period of one, of
standard normals."""


def by_traces(
    factor: np.ndarray, sizes: np.ndarray, mean: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Mean and covariance of the quadratic forms x^T A x for x = mean + factor w.

    They are tr(A S) + mean^T A mean, and 2 tr(A S B S) + 4 mean^T A S B mean.
    """
    n, S = len(factor), factor @ factor.T
    sums = np.tril(np.ones((n + 1, n)), -1)
    forms = []
    for m in sizes:
        d = (sums[2 * m :] - 2 * sums[m:-m] + sums[: -2 * m]) / (np.sqrt(2) * m)
        forms.append(d.T @ d / len(d))
    means = np.array([np.trace(a @ S) + mean @ a @ mean for a in forms])
    return means, np.array(
        [[2 * np.trace(a @ S @ b @ S) + 4 * mean @ a @ S @ b @ mean for b in forms] for a in forms]
    )


@pytest.mark.parametrize("ramp", (0.0, 0.05))
@pytest.mark.parametrize(
    "strengths", ({"Q": 1.0}, {"N": 1.0}, {"K": 1.0}, {"Q": 0.5, "N": 1.0, "K": 0.1})
)
def test_moments_are_those_of_quadratic_forms(strengths, ramp):
    """Isserlis' theorem by whole matrices.

    Every lag is summed here, so that they differ by rounding only.
    """
    sizes = np.array([1, 2, 3, 5, 8, 13, 20, 30])
    factor = np.hstack([c * SHAPES[t] for t, c in strengths.items()])
    mean, covariance = by_traces(factor, sizes, ramp * np.arange(60.0))
    squares = np.array([strengths.get(t, 0.0) ** 2 for t in TERMS[:4]] + [ramp**2])
    got = moments(sizes, 60)
    np.testing.assert_allclose(got.design @ squares, mean, rtol=1e-11)
    np.testing.assert_allclose(
        got.covariance(squares), covariance, rtol=1e-10, atol=1e-12 * covariance.max()
    )


@pytest.mark.parametrize("time", (0.7, 4.0, 400.0))
def test_moments_of_gauss_markov_noise_are_those_of_quadratic_forms(time):
    """By whole matrices, white noise and Gauss-Markov noise of the autocovariance a^|u|.

    What cancels in the closed form, by the square of the correlation time, is rounding.
    """
    sizes, rows = np.array([1, 2, 3, 5, 8, 13, 20, 30]), np.arange(60)
    autocovariance = np.exp(-np.abs(rows[:, None] - rows) / time)
    factor = np.hstack([np.eye(60), 2 * np.linalg.cholesky(autocovariance)])
    mean, covariance = by_traces(factor, sizes, np.zeros(60))
    squares = np.array([0.0, 1.0, 0.0, 0.0, 0.0, 4.0])
    got = moments(sizes, 60, (time,))
    np.testing.assert_allclose(got.design @ squares, mean, rtol=1e-14 * time**2 + 1e-11)
    np.testing.assert_allclose(
        got.covariance(squares), covariance, rtol=1e-9, atol=1e-12 * covariance.max()
    )


@pytest.mark.parametrize(
    "term, psd",
    (
        ("N", np.ones_like),
        ("B", lambda f: 1 / (2 * np.pi * f)),
        ("K", lambda f: 1 / (2 * np.sin(np.pi * f)) ** 2),
    ),
)
def test_variances_of_a_long_record_are_those_of_its_density(term, psd):
    """Against the spectral integral, which is right to m / (30 n).

    Flicker ends at Nyquist here, and nowhere there: they are at most 1 / m^2 apart.
    """
    n = 20_000
    sizes = np.array([8, 100, 1000, 6000]) if term != "B" else np.array([64, 256, 1000, 6000])
    squares = (np.array(list(TERMS)) == term).astype(float)
    got = moments(sizes, n)
    laws = allan_laws(psd, sizes, n, 1.0)
    slack = sizes / (30 * n) + (1.0 / sizes if term == "B" else 0.0) + 1e-6
    assert np.all(np.abs(got.design @ squares / [law.mean for law in laws] - 1) <= slack)
    # Twice for a square; integrals in place of sums add (1 / SUMMED)^2.
    assert np.all(
        np.abs(np.diag(got.covariance(squares)) / [law.variance for law in laws] - 1)
        <= 4 * slack + 1 / 64**2
    )


def test_covariances_of_any_length_can_be_those_of_numbers():
    """Those of a day at 976 Hz are positive definite, with correlations below one.

    That holds for every term alone and for all together.
    """
    n = 84_000_000
    got = moments(octave_clusters(n), n)
    for squares in (*np.eye(5)[:4], np.array([1.0, 1.0, 1.0, 1.0, 1e-6])):
        covariance = got.covariance(squares)
        root = np.sqrt(np.diag(covariance))
        assert np.linalg.eigvalsh(covariance / np.outer(root, root)).min() > 1e-3


def test_hidalgo_table_3_allan_variances():
    m = np.array([1, 2, 7, 1000])
    want = np.column_stack(
        [
            angle_quantization_deviation(1.0, m),
            white_deviation(1.0, m),
            np.full(4, flicker_floor(1.0)),
            random_walk_deviation(1.0, m, 1.0),
            ramp_deviation(1.0, m),
        ]
    )
    np.testing.assert_allclose(design(m), want**2, rtol=1e-14)


# The fit

LOGS = 400


@pytest.fixture(scope="module")
def fits():
    """Of N + K logs, for N and K alone."""
    rng = np.random.default_rng(952)
    return [fit(draw(rng, WHITE, WALK), "NK") for _ in range(LOGS)]


@pytest.mark.parametrize("term, true", (("N", WHITE), ("K", WALK)))
def test_intervals_cover(fits, term, true):
    """Nineteen in twenty, within the binomial law."""
    held = sum(f[term].holds(true) for f in fits)
    assert binom.ppf(ALPHA / 2, LOGS, 0.95) <= held <= binom.isf(ALPHA / 2, LOGS, 0.95)


@pytest.mark.parametrize("term, true", (("N", WHITE), ("K", WALK)))
def test_estimates_scatter_about_the_truth_by_their_standard_errors(fits, term, true):
    """The mean is within the normal law and the curvature of a root.

    That curvature is (std / true)^2 / 2 of the truth. The spread is within its own normal law.
    """
    values = np.array([f[term].value for f in fits])
    std = np.mean([f[term].std for f in fits])
    assert abs(values.mean() - true) <= norm.isf(ALPHA / 2) * std / np.sqrt(LOGS) + std**2 / (
        2 * true
    )
    # A chi-square's square root has a kurtosis near that of a normal: its standard deviation is
    # known to 1 / sqrt(2 LOGS).
    assert abs(values.std() / std - 1) <= norm.isf(ALPHA / 2) / np.sqrt(2 * LOGS) + std / true


def test_covariance_is_that_of_the_estimates(fits):
    """The correlation of N and K, within Fisher's transformation."""
    correlation = np.corrcoef([[f["N"].value, f["K"].value] for f in fits], rowvar=False)[0, 1]
    c = np.mean([f.covariance for f in fits], axis=0)
    assert abs(
        np.arctanh(correlation) - np.arctanh(c[0, 1] / np.sqrt(c[0, 0] * c[1, 1]))
    ) <= norm.isf(ALPHA / 2) / np.sqrt(LOGS - 3)


def test_as_sharp_as_maximum_likelihood():
    """The spread is compared with that of maximum likelihood on the same logs.

    The ratio of the spreads of two estimators of correlation r is known to about
    sqrt((1 - r^2) / logs).
    """
    rng, logs = np.random.default_rng(8), 20
    ours, peer = np.empty((logs, 2)), np.empty((logs, 2))
    for k in range(logs):
        x = draw(rng, WHITE, WALK)
        f, walk = fit(x, "NK"), RandomWalk.fit([(x, H * np.arange(len(x)), [(0, len(x))])])
        ours[k], peer[k] = (f["N"].value, f["K"].value), (np.sqrt(walk.r * H), np.sqrt(walk.k2))
    for a, b in zip(ours.T, peer.T, strict=True):
        r = np.corrcoef(a, b)[0, 1]
        assert a.std() <= b.std() * (1.05 + norm.isf(ALPHA / 2) * np.sqrt((1 - r**2) / logs))


@pytest.mark.long
def test_terms_that_are_not_there_get_bounds_that_hold():
    """At most one log in a hundred has a false term where all five are asked for.

    There are three chances of ``CHANCE`` each, twice. N and K are still covered.
    """
    rng, logs = np.random.default_rng(12), 100
    found = [fit(draw(rng, WHITE, WALK)) for _ in range(logs)]
    false = sum(f[t].needed for f in found for t in "QBR")
    assert false <= binom.isf(ALPHA, 3 * logs, 2e-3)
    for term, true in (("N", WHITE), ("K", WALK)):
        assert sum(f[term].holds(true) for f in found) >= binom.ppf(ALPHA, logs, 0.95)
    bounds = [f[t] for f in found for t in "QBR" if not f[t].needed]
    assert all(c.low == c.value == 0 and 0 < c.high < np.inf and np.isnan(c.std) for c in bounds)


@pytest.mark.parametrize("R", (0.1, 0.3))
def test_the_bound_of_a_term_too_small_to_see_holds(R):
    """At least in nineteen logs of twenty, within the binomial law."""
    rng, logs = np.random.default_rng(21), 150
    found = [fit(draw(rng, WHITE, WALK, R), "NKR")["R"] for _ in range(logs)]
    assert sum(not c.needed for c in found) > logs / 2
    assert sum(c.holds(R) for c in found) >= binom.ppf(ALPHA, logs, 0.95)


def test_a_term_that_another_may_replace_has_a_bound():
    """Flicker, or the walk of a short log: no interval of a value reaches zero.

    The curve keeps the terms that it was fitted with.
    """
    rng, found = np.random.default_rng(22), []
    for _ in range(40):
        f = fit(draw(rng, WHITE, WALK / 8))
        found.append(f)
        assert all(f[t].low > 0 for t in f.needed)
        for t in f.replaceable:
            assert (
                f[t].value == f[t].low == 0
                and np.isnan(f[t].std)
                and f[t].high >= f.estimates[t] > 0
            )
            assert np.all(
                f.deviation(CLUSTERS * H) ** 2
                >= design(CLUSTERS)[:, TERMS.index(t)] * f.squares[TERMS.index(t)]
            )
    assert any(f.replaceable for f in found)


def test_every_term_comes_back():
    """A log whose moments are the theory has no misfit, with all five terms in it.

    That holds whatever the units.
    """
    n = 2**20
    m = octave_clusters(n)
    # Each term in its turn is the largest, from clusters of 1, 5, 80, 2000 and 15000 on.
    true = {
        "Q": 1e-6 * H * 300,
        "N": 1e-6 * np.sqrt(H) * 100,
        "B": 1e-6 * 12,
        "K": 1e-6 / np.sqrt(H) * 0.3,
        "R": 1e-6 / H * 2e-3,
    }
    squares = np.array([true[t] ** 2 for t in TERMS]) * H ** np.array([-2.0, -1, 0, 1, 2])
    found = fit_coefficients(m, np.sqrt(design(m) @ squares), n, H)
    assert found.needed == TERMS and found.misfit < 1e-6 and found.freedom == len(m) - 5
    np.testing.assert_allclose([found[t].value for t in TERMS], [true[t] for t in TERMS], rtol=1e-4)
    np.testing.assert_allclose(found.deviation(m * H), np.sqrt(design(m) @ squares), rtol=1e-4)


def test_errors_name_what_is_wrong():
    with pytest.raises(UserError, match="clusters of 1 samples is zero"):
        fit(np.ones(64))
    d = np.ones(5)
    for terms in ("X", "NN", ""):
        with pytest.raises(ValueError, match="some of QNBKR"):
            fit_coefficients(octave_clusters(32), d, 32, H, terms)
    with pytest.raises(ValueError, match="5 terms need more"):
        fit_coefficients(octave_clusters(32), d, 32, H)
    with pytest.raises(ValueError, match="from 1 to 16 for 32 samples"):
        fit_coefficients([1, 2, 4, 8, 17], d, 32, H, "NK")


# Several logs, and what is read off the plot


def test_the_mean_of_independent_logs():
    mean, spread = mean_coefficient(
        [Coefficient(v, 0.2, v - 0.4, v + 0.4) for v in (9.0, 10.0, 11.0, 10.0)]
    )
    # They scatter more than their standard errors say: Student's interval, of three degrees of
    # freedom.
    assert (mean.value, mean.std, spread) == (
        10.0,
        pytest.approx(np.sqrt(2 / 3) / 2),
        pytest.approx(np.sqrt(2 / 3)),
    )
    assert mean.low == pytest.approx(
        10 - 3.1824 * mean.std, rel=1e-4
    ) and mean.high == pytest.approx(10 + 3.1824 * mean.std, rel=1e-4)
    mean, _ = mean_coefficient(
        [Coefficient(v, 0.2, v - 0.4, v + 0.4) for v in (9.98, 10.0, 10.02, 10.0)]
    )
    # The chi-square's interval of a hundredth is the normal's to a few hundredths of itself.
    assert (
        mean.std == pytest.approx(0.1)
        and mean.low == pytest.approx(10 - 0.196, abs=0.01)
        and mean.high == pytest.approx(10 + 0.196, abs=0.01)
    )
    bound, spread = mean_coefficient(
        [Coefficient(1.0, 0.1, 0.8, 1.2), Coefficient(0.0, np.nan, 0.0, 0.7)]
    )
    assert not bound.needed and (bound.low, bound.high) == (0.0, 1.2) and np.isnan(spread)


def test_hidalgo_section_2_2_readings_of_exact_curves():
    """N is read exactly where nothing else is, K to a thirty-second, the share of white noise.

    B is read at the crossing, to what lies between neighbouring times.
    """
    tau = np.geomspace(0.01, 7200, 400)
    N, K = 0.2, 0.01
    read = read_coefficients(tau, np.hypot(N / np.sqrt(tau), K * np.sqrt(tau / 3)))
    assert read.N == pytest.approx(N * np.sqrt(1 + (K / N) ** 2 / 3), rel=1e-4)
    assert K <= read.K <= K * np.sqrt(1 + 1 / 16)
    assert read.B == pytest.approx(crossing(N, K), rel=1e-3) and read.B >= crossing(N, K) * (
        1 - 1e-12
    )
    assert read.B * flicker_floor(1.0) == pytest.approx(np.sqrt(2 * N * K / np.sqrt(3)), rel=1e-3)
    assert np.isnan(read_coefficients(tau, N / np.sqrt(tau)).K)
    with pytest.raises(ValueError, match="N is read at 1 s"):
        read_coefficients(tau[tau > 2], tau[tau > 2])


# The example


@pytest.fixture(scope="module")
def example():
    return program("examples/imt30_static.py")


def test_the_paper_tables_of_the_example_are_the_parts(example):
    gyro = part("imt30").gyro
    np.testing.assert_allclose(
        example.paper("N"), gyro.values["angle_random_walk"]["N"], rtol=1e-12
    )
    np.testing.assert_allclose(example.paper("K"), gyro.values["rate_random_walk"]["K"], rtol=1e-12)


def test_the_example_finds_the_paper_in_a_short_look(example, tmp_path, capsys):
    """N of two logs of some minutes within the normal law; the tables and the picture are made."""
    tests = list(example.simulate_tests(0.1, 2))
    for axis in range(3):
        mean, _ = mean_coefficient([t.fits[axis]["N"] for t in tests])
        assert abs(mean.value - example.paper("N")[axis]) <= norm.isf(ALPHA / 6) * mean.std
    for table in (
        example.fitted_table("N", tests),
        example.fitted_table("K", tests),
        example.floor_table(tests),
    ):
        example.Console(width=150).print(table)
    printed = capsys.readouterr().out
    for text in ("Table 2", "Table 4", "Table 5", "deg/sqrt(h)", "0.23858", "64.2", "5.9"):
        assert text in printed
    example.draw(tests, tmp_path / "p.png")
    assert [p.name for p in tmp_path.iterdir()] == ["p.png"]


def test_the_example_is_the_log_of_one_run(example, tmp_path):
    """In chunks as in one piece, and the seed tells the tests apart."""
    imt30 = part("imt30")
    fmu = example.build_fmu(imt30.block, tmp_path, "block")
    made = []
    n = example.CHUNK + 1000
    rates = example.static_log(fmu, imt30, n, 3, made.append)
    assert sum(made) == n and rates.shape == (n, 3)
    rest = np.tile([v.start for v in imt30.block.inputs], (n, 1))
    np.testing.assert_array_equal(
        rates, simulate_blocks(fmu, rest, start_values={"seed": 3})[1:, :3]
    )
    assert not np.array_equal(rates[:10], example.static_log(fmu, imt30, 10, 4, made.append))
