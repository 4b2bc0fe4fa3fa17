"""Allan deviations against other programs, printed tables and their plain definition.

Their distribution is tested against exact laws and against draws.
"""

import csv
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import eigvalsh, toeplitz
from scipy.stats import binom, chi2

from pyimu.characterization.allan import deviation as allan
from pyimu.characterization.allan import (
    hadamard_deviation,
    log_clusters,
    modified_deviation,
    octave_clusters,
    overlapping_deviation,
)
from pyimu.characterization.allan.law import allan_band, allan_laws
from pyimu.characterization.allan.readings import floor
from pyimu.errors import UserError

DEVIATIONS = {
    "overlapping": (overlapping_deviation, 2),
    "hadamard": (hadamard_deviation, 3),
    "modified": (modified_deviation, 3),
}
H = 0.01
UNIT = 2.0**-53


def riley() -> np.ndarray:
    """The 1000 points of NIST SP 1065, section 12.4: a congruential generator over its modulus."""
    n, points = 1234567890, []
    for _ in range(1000):
        points.append(n / 2147483647)
        n = 16807 * n % 2147483647
    return np.array(points)


def drifting(n: int, seed: int = 0) -> np.ndarray:
    """White noise, a random walk and an offset."""
    rng = np.random.default_rng(seed)
    return 9.8 + rng.standard_normal(n) + 0.05 * np.cumsum(rng.standard_normal(n))


def plain(name: str, rates: np.ndarray, m: int) -> float:
    """The deviation by its definition in means of clusters.

    It is made in extended precision, with no running sum over the record.
    """
    windows = np.lib.stride_tricks.sliding_window_view(rates.astype(np.longdouble), m).mean(axis=1)
    step = windows[m:] - windows[:-m]
    if name == "hadamard":
        return float(np.sqrt(np.mean((step[m:] - step[:-m]) ** 2) / 6))
    if name == "modified":
        step = np.lib.stride_tricks.sliding_window_view(step, m).mean(axis=1)
    return float(np.sqrt(np.mean(step**2) / 2))


# The estimators


@pytest.mark.parametrize(
    "name, printed",
    [
        ("overlapping", (2.922319e-01, 9.159953e-02, 3.241343e-02)),
        ("hadamard", (2.943883e-01, 9.581083e-02, 3.237638e-02)),
        ("modified", (2.922319e-01, 6.172376e-02, 2.170921e-02)),
    ],
)
def test_nist_sp_1065_table_31(name, printed):
    np.testing.assert_allclose(DEVIATIONS[name][0](riley(), [1, 10, 100]), printed, rtol=5e-7 / 2.1)


@pytest.mark.parametrize("name", DEVIATIONS)
def test_allantools_on_the_same_points(name):
    """allan_reference.csv has oadev, ohdev and mdev of allantools 2024.06.

    They were made with data_type "freq" and rate 1.
    """
    with open(Path(__file__).with_name("allan_reference.csv"), encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["deviation"] == name]
    got = DEVIATIONS[name][0](riley(), [int(row["clusters"]) for row in rows])
    assert len(rows) > 50
    np.testing.assert_allclose(got, [float(row["value"]) for row in rows], rtol=1e-12)


@pytest.mark.parametrize("name", DEVIATIONS)
def test_plain_definition_up_to_the_last_term(name):
    deviation, order = DEVIATIONS[name]
    for n in (order, 7, 100, 3 * allan.TILE + 5):
        rates, m = drifting(n), log_clusters(n, 12, order)
        np.testing.assert_allclose(
            deviation(rates, m), [plain(name, rates, k) for k in m], rtol=1e-12
        )


@pytest.mark.parametrize("name", DEVIATIONS)
def test_the_error_stays_below_the_stated_bound_under_a_strong_drift(name):
    """The bound follows from the largest cumulative sum.

    The drift over the record is 1e6 deviations of the noise.
    """
    n, m = 100_000, np.array([1, 2, 3, 30])
    rates = np.random.default_rng(3).standard_normal(n) + 1e6 * (np.arange(n) / n) ** 2
    largest = np.abs(np.cumsum(rates - rates.mean())).max()
    deviation = DEVIATIONS[name][0](rates, m)
    error = np.abs(deviation - [plain(name, rates, k) for k in m])
    assert np.all(error <= 10 * UNIT * largest / m + (10 + np.sqrt(n)) * UNIT * deviation)


@pytest.mark.parametrize("name", DEVIATIONS)
def test_columns_types_and_processors_change_nothing(name, monkeypatch):
    deviation, order = DEVIATIONS[name]
    rates = np.column_stack([drifting(20_000, seed) for seed in range(3)])
    m = log_clusters(len(rates), 15, order)
    together = deviation(rates, m)
    assert together.shape == (len(m), 3)
    alone = np.column_stack([deviation(rates[:, c].copy(), m) for c in range(3)])
    np.testing.assert_array_equal(together, alone)
    monkeypatch.setattr(allan, "processors", lambda: 1)
    np.testing.assert_array_equal(together, deviation(np.asfortranarray(rates), m))
    single = rates[:, 0].astype(np.float32)
    np.testing.assert_array_equal(deviation(single, m), deviation(single.astype(float), m))
    counts = np.rint(1000 * rates[:, 0]).astype(np.int32)
    np.testing.assert_array_equal(deviation(counts, m), deviation(counts.astype(float), m))


def test_hidalgo_table_3_rate_ramp():
    """R tau / sqrt(2); the Hadamard deviation does not see it."""
    ramp, m = 0.25 * H * np.arange(5000), octave_clusters(5000)
    np.testing.assert_allclose(
        overlapping_deviation(ramp, m), 0.25 * m * H / np.sqrt(2), rtol=1e-12
    )
    assert np.all(hadamard_deviation(ramp, m[:-1]) < 1e-12)


def test_grids_of_cluster_sizes():
    assert octave_clusters(9).tolist() == [1, 2, 4]
    assert octave_clusters(8).tolist() == [1, 2, 4]
    assert octave_clusters(8, 3).tolist() == [1, 2]
    assert octave_clusters(1).tolist() == log_clusters(1).tolist() == []
    assert log_clusters(7).tolist() == [1, 2, 3]
    for n, order in ((1000, 2), (14_000_000, 2), (14_000_000, 3)):
        m = log_clusters(n, 100, order)
        assert len(m) == 100 and m[0] == 1 and m[-1] == n // order and np.all(np.diff(m) > 0)
        steps = np.diff(np.log(m[m > 1000]))
        assert steps.size == 0 or steps.max() < 1.01 * steps.min()


def test_errors_name_what_is_wrong():
    for m in (0, 1.5, 51):
        with pytest.raises(ValueError, match="from 1 to 50 for 100 samples"):
            overlapping_deviation(np.zeros(100), [m])
    with pytest.raises(ValueError, match="shape"):
        overlapping_deviation(np.zeros((9, 1, 1)), [1])
    for bad in (np.nan, np.inf):
        rates = np.zeros((100, 2))
        rates[41:, 1] = bad, *np.full(58, -bad)
        with pytest.raises(UserError, match="column 2 of the rates: sample 42 is not finite"):
            overlapping_deviation(rates, [1])


# Their distribution

KINDS = {
    "white": lambda f: np.ones_like(f),
    "differenced white": lambda f: np.sin(np.pi * f * H) ** 2,
    "random walk": lambda f: np.sin(np.pi * f * H) ** -2.0,
    "white and random walk": lambda f: 1 + 1e-3 * np.sin(np.pi * f * H) ** -2.0,
    "short Gauss-Markov": lambda f: 1 / np.abs(np.exp(2j * np.pi * f * H) - 0.9) ** 2,
    "long Gauss-Markov": lambda f: 1 / np.abs(np.exp(2j * np.pi * f * H) - 0.9995) ** 2,
    "flicker": lambda f: sum(a / (a**2 + np.sin(np.pi * f * H) ** 2) for a in (1e-1, 1e-2, 1e-3)),
}
"""Two-sided densities up to a factor."""


def eigenvalues(psd, m: int, n: int) -> np.ndarray:
    """Weights of the squared normals in the overlapping variance.

    They come from the autocovariance by a plain sum over frequencies.
    """
    x = np.pi * (np.arange(64 * n) + 0.5) / (128 * n)
    s = psd(x / (np.pi * H)) * 2 * np.sin(m * x) ** 4 / (m * np.sin(x)) ** 2 / (64 * n * H)
    r = np.array([np.sum(s * np.cos(2 * lag * x)) for lag in range(n - 2 * m + 1)])
    w = eigvalsh(toeplitz(r)) / len(r)
    return w[w > 1e-13 * w[-1]]


def probability_below(w: np.ndarray, q: float) -> float:
    """Distribution function at q of a sum of squared normals with weights w.

    By Gil-Pelaez' inversion, on a grid without aliases below 1e-12.
    """
    step, count = (
        2 * np.pi / (2.2 * max(q, w.sum() + 60 * w[-1] + 12 * np.sqrt(2 * np.sum(w**2)))),
        500,
    )
    while np.sum(np.log1p(4 * (count * step * w) ** 2)) < 120 and count < 60_000:
        count *= 2
    u = (np.arange(count) + 0.5) * step
    angle = sum(0.5 * np.arctan(2 * u * v) for v in w)
    size = sum(-0.25 * np.log1p(4 * (u * v) ** 2) for v in w)
    return 0.5 - np.sum(np.exp(size) * np.sin(angle - u * q) / u) * step / np.pi


@pytest.mark.parametrize("kind", KINDS)
def test_mean_variance_and_tails_are_those_of_the_exact_law(kind):
    """Isserlis' theorem and the eigenvalues of the full covariance.

    The tail probability of a limit is right to a sixth of itself at 1e-4.
    """
    n, side = 300, 1e-4
    for m in (1, 5, 20, 60, 100):
        law, w = allan_laws(KINDS[kind], m * H, n, H)[0], eigenvalues(KINDS[kind], m, n)
        np.testing.assert_allclose(law.mean, w.sum(), rtol=1e-7)
        np.testing.assert_allclose(law.variance, 2 * np.sum(w**2), rtol=1e-4)
        low, high = law.quantile(side, side)
        np.testing.assert_allclose(
            [probability_below(w, low), 1 - probability_below(w, high)], side, rtol=1 / 6
        )


def test_one_difference_is_a_chi_square_of_one_degree():
    """m = n / 2: a single term; the saddlepoint is farthest from it here."""
    (law,) = allan_laws(KINDS["white"], 50 * H, 100, H)
    np.testing.assert_allclose(law.edf, 1, rtol=1e-12)
    low, high = law.quantile(1e-5, 1e-5)
    np.testing.assert_allclose(
        [chi2.cdf(low / law.mean, 1), chi2.sf(high / law.mean, 1)], 1e-5, rtol=1 / 6
    )


def draws(kind: str, n: int, records: int, seed: int) -> np.ndarray:
    """Gaussian records (n, records) of the noises of ``KINDS`` that a recursion makes.

    They start in the stationary state.
    """
    e = np.random.default_rng(seed).standard_normal((n + 1, records)) / np.sqrt(H)
    if kind == "white":
        return e[1:]
    if kind == "differenced white":
        return np.diff(e, axis=0) / 2
    if kind == "random walk":
        return 2 * np.cumsum(e[1:], axis=0)
    a = {"short Gauss-Markov": 0.9, "long Gauss-Markov": 0.9995}[kind]
    out = np.empty((n, records))
    out[0] = e[0] / np.sqrt(1 - a * a)
    for k in range(1, n):
        out[k] = a * out[k - 1] + e[k]
    return out


@pytest.mark.parametrize(
    "kind", ["white", "differenced white", "random walk", "short Gauss-Markov", "long Gauss-Markov"]
)
def test_the_band_holds_what_it_says(kind):
    """Of 4000 records each limit is passed as often as its share.

    That is within the binomial law at 1e-3 over all limits and kinds. The share itself is right to
    a sixth (the test above), by which the binomial's bounds are widened.
    """
    n, records, probability = 512, 4000, 0.9
    m = octave_clusters(n)
    low, high = allan_band(KINDS[kind], m * H, n, H, probability)
    got = overlapping_deviation(draws(kind, n, records, 5), m)
    share, alpha = (1 - probability) / (2 * len(m)), 1e-3 / (5 * 4 * len(m))
    passed = np.array([(got < low[:, None]).sum(axis=1), (got > high[:, None]).sum(axis=1)])
    assert np.all(passed >= binom.ppf(alpha, records, share * 5 / 6))
    assert np.all(passed <= binom.isf(alpha, records, share * 7 / 6))


def test_a_band_is_refused_where_it_makes_no_sense():
    with pytest.raises(ValueError, match="between 0 and 1"):
        allan_band(KINDS["white"], H, 100, H, 1.0)
    for tau in (0.015, 0.51, 0.0):
        with pytest.raises(ValueError, match="multiples of the sample period 0.01 s up to 0.5 s"):
            allan_band(KINDS["white"], tau, 100, H, 0.9)


def test_a_floor_is_one_where_the_curve_is_read_to_twice_its_cluster_time():
    """Of a record of 1000 s deviations are read up to 100 s: from 50 s on the lowest may fall."""
    tau = np.geomspace(1.0, 500.0, 400)
    for lowest, bound in ((20.0, False), (49.0, False), (52.0, True), (99.0, True), (400.0, True)):
        deviation = lowest / tau + tau / lowest  # a V in the logarithm, 2 at its lowest point
        found = floor(tau, deviation)
        assert found.bound == bound
        assert found.tau == pytest.approx(min(lowest, 100.0), rel=0.02)
