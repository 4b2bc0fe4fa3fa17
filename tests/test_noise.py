"""The normals of pyimu.noise and of fmu_src/noise.c: one another's bits, numpy's words, and the statistics of noise."""

import ctypes
import shutil
import subprocess
from ctypes import c_double, c_int64, c_uint64

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats
from scipy.special import ndtri

from pyimu import noise
from pyimu.fmu.sources import source_folder
from pyimu.noise import normals

ONE_IN_A_MILLION = 1e-6
"""How often a test below would fail by chance, were its seed not fixed beside it."""

WORD = st.integers(0, 2**64 - 1)


class Compiled:
    """fmu_src/noise.c behind numpy arrays."""

    def __init__(self, folder, *flags):
        file = folder / "noise.so"
        flags = ("-O3", "-ffp-contract=off", "-shared", "-fPIC", *flags)
        subprocess.run(["cc", *flags, source_folder() / "noise.c", "-o", file, "-lm"], check=True)
        self.library = ctypes.CDLL(str(file))
        self.library.noise_normal.argtypes, self.library.noise_normal.restype = [c_uint64], c_double
        self.library.noise_at.argtypes = [ctypes.c_void_p, c_uint64, c_uint64, c_int64]
        self.library.noise_at.restype = c_double

    def words(self, key, counter):
        out = (c_uint64 * 4)()
        self.library.philox4x64((c_uint64 * 2)(*key), (c_uint64 * 4)(*counter), out)
        return list(out)

    def normal(self, words):
        return np.array([self.library.noise_normal(int(w)) for w in words])

    def at(self, seed, channel, samples):
        cache = (c_uint64 * 5)()
        self.library.noise_forget(cache)
        return np.array([self.library.noise_at(cache, seed, channel, int(k)) for k in samples])


@pytest.fixture(scope="module", params=((), ("-DNOISE_PORTABLE",)), ids=("int128", "portable"))
def compiled(request, tmp_path_factory):
    if shutil.which("cc") is None:
        pytest.skip("needs a C compiler")
    return Compiled(tmp_path_factory.mktemp("noise"), *request.param)


def numpy_words(seed, channel, n):
    return np.random.Philox(key=np.array([seed, channel], dtype=np.uint64)).random_raw(n)


def tails(words):
    """Random words squeezed towards both ends, so that every power of two of the tails' probability is met."""
    shifted = words >> (words % np.uint64(54))
    return np.concatenate([words, shifted, ~shifted, np.array([0, 1, 2**11 - 1, 2**63 - 1, 2**63, 2**64 - 1], dtype=np.uint64)])


# ---- words ---------------------------------------------------------------------------------------------------------------


@given(key=st.tuples(WORD, WORD), counter=st.lists(WORD, min_size=4, max_size=4))
def test_philox_words_are_numpys(compiled, key, counter):
    before = (sum(c << 64 * i for i, c in enumerate(counter)) - 1) % 2**256  # numpy counts up before it draws
    words = [before >> 64 * i & 2**64 - 1 for i in range(4)]
    generator = np.random.Philox(key=np.array(key, dtype=np.uint64), counter=np.array(words, dtype=np.uint64))
    assert compiled.words(key, counter) == generator.random_raw(4).tolist()


def by_scipy(words):
    """The normals of words through scipy's inverse normal, which knows nothing of AS 241, from the exact lower tail."""
    cell = (words >> np.uint64(11)).astype(np.int64)
    lower = np.minimum(cell, 2**53 - 1 - cell)
    return np.where(cell < 2**52, 1, -1) * ndtri((lower + 0.5) * 2.0**-53)


TWENTY_ROUNDINGS_EACH = 40 * 2.0**-53
"""Two polynomials of degree 7, a quotient, a logarithm and a root, here and there."""


@pytest.mark.parametrize("seed, channel", ((0, 0), (1, 2), (2**64 - 1, 2**32 + 7)))
def test_sample_k_takes_word_k_of_numpys_stream(seed, channel):
    want = by_scipy(numpy_words(seed, channel, 1001)[1:])
    np.testing.assert_allclose(normals(seed, [channel], 1, 1000)[:, 0], want, rtol=TWENTY_ROUNDINGS_EACH)


def test_wichura_as241_ppnd16(compiled):
    words = tails(numpy_words(1, 1, 20_000))
    z = compiled.normal(words)
    np.testing.assert_allclose(z, by_scipy(words), rtol=TWENTY_ROUNDINGS_EACH)
    assert 8.29 < np.abs(z).max() < 8.3  # the last cell's tail is 2^-54


# ---- C and Python --------------------------------------------------------------------------------------------------------


def test_python_equals_c_bit_for_bit(compiled):
    for seed, channel in ((0, 0), (42, 7), (2**64 - 1, 2**64 - 1)):
        np.testing.assert_array_equal(normals(seed, [channel], 1, 50_000)[:, 0], compiled.at(seed, channel, range(1, 50_001)))


def test_python_equals_c_bit_for_bit_in_the_tails(compiled):
    words = tails(numpy_words(5, 5, 40_000))
    np.testing.assert_array_equal([noise._normal(w) for w in words], compiled.normal(words))


@given(first=st.integers(-2**62, 2**62), n=st.integers(0, 9))
def test_any_sample_number(compiled, first, n):
    np.testing.assert_array_equal(normals(3, [8], first, n)[:, 0], compiled.at(3, 8, range(first, first + n)))


@given(start=st.integers(0, 200), n=st.integers(0, 100))
def test_a_part_of_a_run_is_that_part(start, n):
    whole = normals(11, [1, 2, 3], 0, 300)
    np.testing.assert_array_equal(normals(11, [3, 1], start, n), whole[start:start + n][:, [2, 0]])


def test_cache_serves_samples_in_any_order(compiled):
    order = np.random.default_rng(2).integers(0, 50, 200)
    np.testing.assert_array_equal(compiled.at(1, 2, order), normals(1, [2], 0, 50)[order, 0])


@pytest.mark.parametrize("arguments", ((-1, [0], 0, 1), (2**64, [0], 0, 1), (0, [-1], 0, 1), (0, [2**64], 0, 1), (0, [0], 0, -1)))
def test_impossible_arguments(arguments):
    with pytest.raises(ValueError):
        normals(*arguments)


# ---- statistics ----------------------------------------------------------------------------------------------------------

N = 1_000_000
SEED = 20_240_229


@pytest.fixture(scope="module")
def z():
    return normals(SEED, [1], 1, N)[:, 0]


def test_chi_square_of_a_thousand_equal_cells(z):
    counts, _ = np.histogram(stats.norm.cdf(z), bins=1000, range=(0, 1))
    chi2 = ((counts - N / 1000) ** 2).sum() / (N / 1000)
    low, high = stats.chi2.ppf([ONE_IN_A_MILLION / 2, 1 - ONE_IN_A_MILLION / 2], 999)
    assert low < chi2 < high


@pytest.mark.parametrize("level", (3.0, 4.0, 4.5))
@pytest.mark.parametrize("side", (-1, 1))
def test_tails_are_binomial(z, side, level):
    low, high = stats.binom.interval(1 - ONE_IN_A_MILLION, N, stats.norm.sf(level))
    assert low <= (side * z > level).sum() <= high


def test_moments(z):
    """Of n normals the k-th Hermite mean has variance k!/n."""
    for k, hermite in ((1, z), (2, z**2 - 1), (3, z**3 - 3 * z), (4, z**4 - 6 * z**2 + 3)):
        bound = stats.norm.isf(ONE_IN_A_MILLION / 2) * np.sqrt(float(np.prod(np.arange(1, k + 1))) / N)
        assert abs(hermite.mean()) < bound


def correlations_are_chance(columns):
    """The largest correlation of any two columns, and of their squares, against that of independent normals."""
    n, m = columns.shape
    bound = stats.norm.isf(ONE_IN_A_MILLION / (m * (m - 1))) / np.sqrt(n)
    for values in (columns, columns**2):
        off_diagonal = np.corrcoef(values.T)[np.triu_indices(m, 1)]
        assert np.abs(off_diagonal).max() < bound


def test_channels_are_independent():
    """Neighbours, and numbers that differ in one high bit."""
    correlations_are_chance(normals(SEED, [0, 1, 2, 3, 2**31, 2**32, 2**63], 1, 200_000))


def test_seeds_are_independent():
    correlations_are_chance(np.hstack([normals(seed, [1], 1, 200_000) for seed in (0, 1, 2, 3, 2**31, 2**63)]))


def test_seed_and_channel_are_not_exchangeable():
    correlations_are_chance(np.hstack([normals(5, [6], 1, 200_000), normals(6, [5], 1, 200_000)]))


def test_samples_are_independent():
    """Lags within a block of four words, across blocks, and far apart."""
    run = normals(SEED, [4], 1, 300_000)[:, 0]
    correlations_are_chance(np.column_stack([run[lag:lag + 200_000] for lag in (0, 1, 2, 3, 4, 5, 8, 1000, 65_536)]))
