"""The normals of pyimu.block.normals and of fmu_src/noise.c: one another's bits, numpy's words, and
the statistics of noise.
"""

import ctypes
import math
import shutil
import subprocess
from ctypes import c_double, c_int64, c_size_t, c_uint64, c_void_p
from decimal import Decimal, localcontext
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from pyimu.block import normals as noise
from pyimu.block.compiled import source_folder
from pyimu.block.normals import edges, normals

FALSE_ALARM = 1e-5
"""How often one comparison below would fail by chance, were its seed not fixed beside it: for all
hundred, 1e-3."""

WORD = st.integers(0, 2**64 - 1)

EDGES = edges()

unhurried = settings(deadline=None)
"""The first example waits for the compiler."""


class Compiled:
    """fmu_src/noise.c behind numpy arrays."""

    def __init__(self, folder, *flags):
        file = folder / "noise.so"
        flags = ("-std=c11", "-O3", "-DMODEL_PREFIX=", "-shared", "-fPIC", *flags)
        subprocess.run(["cc", *flags, source_folder() / "noise.c", "-o", file, "-lm"], check=True)
        self.library = ctypes.CDLL(str(file))
        self.library.noise_normal.argtypes, self.library.noise_normal.restype = (
            [c_uint64, c_uint64, c_int64, c_uint64],
            c_double,
        )
        self.library.noise_at.argtypes, self.library.noise_at.restype = (
            [c_void_p, c_uint64, c_uint64, c_int64],
            c_double,
        )
        self.library.noise_fill.argtypes = [
            c_void_p,
            c_uint64,
            c_void_p,
            c_size_t,
            c_int64,
            c_size_t,
        ]

    def words(self, key, counter):
        out = (c_uint64 * 4)()
        self.library.philox4x64((c_uint64 * 2)(*key), (c_uint64 * 4)(*counter), out)
        return list(out)

    def normal(self, seed, channel, sample, word):
        return self.library.noise_normal(seed, channel, sample, word)

    def at(self, seed, channel, samples):
        cache = (c_uint64 * 5)()
        self.library.noise_forget(cache)
        return np.array([self.library.noise_at(cache, seed, channel, int(k)) for k in samples])

    def fill(self, seed, channels, first, n):
        out, channels = np.full((n, len(channels)), np.nan), np.array(channels, dtype=np.uint64)
        self.library.noise_fill(
            out.ctypes.data, seed, channels.ctypes.data, len(channels), first, n
        )
        return out


@pytest.fixture(scope="module", params=((), ("-DNOISE_PORTABLE",)), ids=("int128", "portable"))
def compiled(request, tmp_path_factory):
    if shutil.which("cc") is None:
        pytest.skip("needs a C compiler")
    return Compiled(tmp_path_factory.mktemp("noise"), *request.param)


def numpy_words(seed, channel, n):
    return np.random.Philox(key=np.array([seed, channel], dtype=np.uint64)).random_raw(n)


def numpy_block(key, counter):
    """numpy's four words for a counter; it counts up before it draws."""
    before = (sum(c << 64 * i for i, c in enumerate(counter)) - 1) % 2**256
    words = [before >> 64 * i & 2**64 - 1 for i in range(4)]
    return (
        np.random.Philox(
            key=np.array(key, dtype=np.uint64), counter=np.array(words, dtype=np.uint64)
        )
        .random_raw(4)
        .tolist()
    )


# Words and layers


@given(key=st.tuples(WORD, WORD), counter=st.lists(WORD, min_size=4, max_size=4))
def test_philox_words_are_numpys(compiled, key, counter):
    assert compiled.words(key, counter) == numpy_block(key, counter)


def exact_edges(base):
    """The abscissas of layers of equal area above ``base``, and how far the last ends above the top
    of the bell.

    The tail's area is that of half the bell less its power series up to the base.
    """
    half_pi = 8 * arctangent_of_inverse(5) - 2 * arctangent_of_inverse(239)  # Machin
    term, inner, k = base, base, 0
    while abs(term) > Decimal(10) ** -45:
        k += 1
        term *= -base * base / (2 * k)
        inner += term / (2 * k + 1)
    height = (-base * base / 2).exp()
    area = base * height + half_pi.sqrt() - inner
    x = [area / height, base]
    for _ in range(254):
        height += area / x[-1]
        x.append((-2 * height.ln()).sqrt())
    return [*x, Decimal(0)], height + area / x[-1] - 1


def arctangent_of_inverse(n):
    return sum((-1) ** k / (Decimal(2 * k + 1) * n ** (2 * k + 1)) for k in range(40))


def test_marsaglia_tsang_2000_equal_areas_to_the_last_bit():
    """Their 256 layers begin at 3.6541528853610088; here the base is the root of their condition,
    by secants.
    """
    with localcontext(prec=50):
        a, b = Decimal("3.65415288536"), Decimal("3.65415288537")
        at_a, at_b = exact_edges(a)[1], exact_edges(b)[1]
        while abs(b - a) > Decimal(10) ** -35:
            a, b, at_a = b, b - at_b * (b - a) / (at_b - at_a), at_b
            at_b = exact_edges(b)[1]
        want = [float(x) for x in exact_edges(b)[0]]
    assert want[1] == 3.6541528853610088
    np.testing.assert_array_equal(EDGES, want)


def test_c_has_the_same_table():
    table = (
        (source_folder() / "noise.c")
        .read_text(encoding="utf-8")
        .split("EDGE[257] = {\n")[1]
        .split("};")[0]
    )
    assert table == noise.c_table(), (
        "python -m pyimu.block.normals prints the table of fmu_src/noise.c"
    )


# Words to normals


def from_the_paper(seed, channel, sample, word):
    """The normal of a word and the way to it, written from the paper on numpy's words and Python's
    floats.
    """
    path, edge, bell = "", EDGES.tolist(), lambda x: math.exp(-0.5 * x * x)
    for attempt in range(1, 64):
        i, u = word % 256, ((word // 1024 | 1) - 2**53) / 2**53
        x = u * edge[i]
        if abs(x) < edge[i + 1]:
            return x, path + "rectangle"
        fresh = numpy_block((seed, channel), (sample, attempt, 0, 0))
        uniforms = [(w // 4096 + 0.5) / 2**52 for w in fresh[:2]]
        if i == 0:
            beyond, exponential = -math.log(uniforms[0]) / edge[1], -math.log(uniforms[1])
            if 2 * exponential > beyond**2:
                return math.copysign(edge[1] + beyond, u), path + "tail"
            path += "tail, "
        else:
            if uniforms[0] * (bell(edge[i + 1]) - bell(edge[i])) < bell(x) - bell(edge[i]):
                return x, path + "wedge"
            path, word = path + "wedge, ", fresh[1]
    raise AssertionError("63 attempts refused")


@pytest.mark.parametrize("seed, channel", ((0, 0), (1, 2), (2**64 - 1, 2**32 + 7)))
def test_sample_k_takes_word_k_of_numpys_stream_and_what_else_it_needs_from_counter_k(
    seed, channel
):
    n = 30_000
    words, z = numpy_words(seed, channel, n), normals(seed, [channel], 0, n)[:, 0]
    layer = (words & np.uint64(255)).astype(int)
    x = ((words >> np.uint64(10) | np.uint64(1)).astype(np.int64) - 2**53) * 2.0**-53 * EDGES[layer]
    at_once = np.abs(x) < EDGES[layer + 1]
    np.testing.assert_array_equal(z[at_once], x[at_once])
    paper = [
        from_the_paper(seed, channel, k, int(words[k])) for k in np.flatnonzero(~at_once).tolist()
    ]
    np.testing.assert_array_equal(z[~at_once], [value for value, _ in paper])
    assert {"tail", "wedge", "wedge, rectangle"} <= {path for _, path in paper}


def outer_words():
    """Words of every layer and either sign, at the outer end of the layer, just right of its
    rectangle and on its way.
    """
    for i in range(256):
        inner = int(EDGES[i + 1] / EDGES[i] * 2**53)
        for size in (inner, inner + 2, (inner + 2**53) // 2, 2**53 - 1):
            for u in (size, -size):
                yield ((u + 2**53) % 2**54) << 10 | i


def test_rare_ways_are_the_papers(compiled):
    cases = list(enumerate(outer_words(), -1000))
    paper = [from_the_paper(7, 8, k % 2**64, word) for k, word in cases]
    ways = {path for _, path in paper}
    assert {
        "rectangle",
        "wedge",
        "wedge, rectangle",
        "wedge, wedge",
        "wedge, wedge, rectangle",
        "tail",
        "tail, tail",
    } <= ways
    want = [value for value, _ in paper]
    np.testing.assert_array_equal([compiled.normal(7, 8, k, word) for k, word in cases], want)
    seed, channel = np.uint64(7), np.uint64(8)
    np.testing.assert_array_equal(
        [noise._normal(seed, channel, np.uint64(k % 2**64), np.uint64(word)) for k, word in cases],
        want,
    )


def test_layer_and_abscissa_share_no_bits(compiled):
    """The flaw that Doornik (2005) names: one position for all layers, and the lowest bits do not
    move it.
    """
    position = 2**63 + 2**61
    z = [compiled.normal(0, 0, 0, position + i) for i in range(255)]
    np.testing.assert_array_equal(z, (2.0**-2 + 2.0**-53) * EDGES[:255])


# C and Python


def test_python_equals_c_bit_for_bit(compiled):
    for seed, channels in ((0, [0]), (42, [7, 0, 2**40]), (2**64 - 1, [2**64 - 1])):
        np.testing.assert_array_equal(
            normals(seed, channels, 1, 500_000), compiled.fill(seed, channels, 1, 500_000)
        )


@unhurried
@given(
    first=st.one_of(st.integers(-(2**62), 2**62), st.integers(-20, 20)),
    n=st.integers(0, 20),
    channels=st.lists(WORD, min_size=0, max_size=3),
    seed=WORD,
)
def test_any_sample_number(compiled, first, n, channels, seed):
    z = normals(seed, channels, first, n)
    np.testing.assert_array_equal(z, compiled.fill(seed, channels, first, n))
    for column, channel in zip(z.T, channels):
        np.testing.assert_array_equal(column, compiled.at(seed, channel, range(first, first + n)))


@unhurried
@given(start=st.integers(0, 200), n=st.integers(0, 100))
def test_a_part_of_a_run_is_that_part(start, n):
    whole = normals(11, [1, 2, 3], 0, 300)
    np.testing.assert_array_equal(
        normals(11, [3, 1], start, n), whole[start : start + n][:, [2, 0]]
    )


def test_cache_serves_samples_in_any_order(compiled):
    order = np.random.default_rng(2).integers(0, 50, 200)
    np.testing.assert_array_equal(compiled.at(1, 2, order), normals(1, [2], 0, 50)[order, 0])


@pytest.mark.parametrize(
    "arguments",
    ((-1, [0], 0, 1), (2**64, [0], 0, 1), (0, [-1], 0, 1), (0, [2**64], 0, 1), (0, [0], 0, -1)),
)
def test_impossible_arguments(arguments):
    with pytest.raises(ValueError):
        normals(*arguments)


# Statistics of one channel

N = 4_000_000
SEED = 20_240_229


@pytest.fixture(scope="module")
def z():
    return normals(SEED, [1], 1, N)[:, 0]


def assert_chance(p_value):
    assert p_value > FALSE_ALARM


def assert_equal_cells(cells, n_cells):
    """Pearson's chi-square of cell numbers that are equally likely, two-sided: too even is as wrong
    as too uneven.
    """
    counts = np.bincount(cells, minlength=n_cells)
    p = stats.chisquare(counts).pvalue
    assert_chance(2 * min(p, 1 - p))


def cells(z, n):
    """The cells, of n equally likely ones, that normals fall into."""
    return np.searchsorted(stats.norm.ppf(np.arange(1, n) / n), z)


@pytest.mark.parametrize("n", (64, 1024))
def test_chi_square_of_equal_cells(z, n):
    assert_equal_cells(cells(z, n), n)


def test_kolmogorov(z):
    assert_chance(stats.kstest(z[:1_000_000], "norm").pvalue)


@pytest.mark.parametrize("level", (3.0, EDGES[1], 4.0, 4.5, 5.0))
@pytest.mark.parametrize("side", (-1, 1))
def test_tails_are_binomial(z, side, level):
    assert_chance(stats.binomtest(int((side * z > level).sum()), N, stats.norm.sf(level)).pvalue)


@pytest.mark.parametrize("level", (3.0, EDGES[1]))
def test_tails_have_the_shape_of_the_bell(z, level):
    """Given that |z| exceeds the level, the chance of a further one is uniform."""
    beyond = np.abs(z)[np.abs(z) > level]
    assert_chance(stats.kstest(stats.norm.sf(beyond) / stats.norm.sf(level), "uniform").pvalue)


def test_moments(z):
    """Of n normals the k-th Hermite mean has variance k!/n."""
    for k, hermite in ((1, z), (2, z**2 - 1), (3, z**3 - 3 * z), (4, z**4 - 6 * z**2 + 3)):
        assert_chance(2 * stats.norm.sf(abs(hermite.mean()) / math.sqrt(math.factorial(k) / N)))


# Statistics of the rare ways, which the whole hides


@pytest.fixture(scope="module")
def refused(z):
    """Of the samples of z whose word lies in a wedge: the layer, the abscissa and the normal that
    came of it.
    """
    words = numpy_words(SEED, 1, N + 1)[1:]
    layer = (words & np.uint64(255)).astype(int)
    x = ((words >> np.uint64(10) | np.uint64(1)).astype(np.int64) - 2**53) * 2.0**-53 * EDGES[layer]
    wedge = (np.abs(x) >= EDGES[layer + 1]) & (layer > 0)
    return layer[wedge], x[wedge], z[wedge]


def under_bell(layer, x):
    """The area of a layer's wedge that lies under the bell, up to x."""
    right, left = EDGES[layer], EDGES[layer + 1]
    return np.sqrt(2 * np.pi) * (stats.norm.cdf(x) - stats.norm.cdf(left)) - np.exp(
        -(right**2) / 2
    ) * (x - left)


def test_as_much_of_a_wedge_is_kept_as_lies_under_the_bell(refused):
    layer, x, z = refused
    right, left = EDGES[layer], EDGES[layer + 1]
    chance = under_bell(layer, right) / (
        (right - left) * (np.exp(-(left**2) / 2) - np.exp(-(right**2) / 2))
    )
    excess = ((z == x) - chance).sum() / np.sqrt((chance * (1 - chance)).sum())
    assert_chance(2 * stats.norm.sf(abs(excess)))


def test_what_is_kept_of_a_wedge_is_bell_shaped(refused):
    layer, x, _ = (a[refused[1] == refused[2]] for a in refused)
    assert_chance(
        stats.kstest(
            under_bell(layer, np.abs(x)) / under_bell(layer, EDGES[layer]), "uniform"
        ).pvalue
    )
    assert_chance(stats.binomtest(int((x > 0).sum()), len(x)).pvalue)


def test_what_is_drawn_for_the_rest_is_normal(refused):
    _, x, z = refused
    assert_chance(stats.kstest(z[z != x], "norm").pvalue)


@pytest.mark.parametrize("side", (-1, 1))
def test_marsaglia_1964_tail(side):
    """A word at the outer end of the base makes every sample one of the tail."""
    word, seed, n = np.uint64(2**64 - 2**10 if side > 0 else 0), np.uint64(SEED), 100_000
    z = np.array([noise._normal(seed, np.uint64(1), np.uint64(k), word) for k in range(n)])
    assert_chance(stats.kstest(stats.norm.sf(side * z) / stats.norm.sf(EDGES[1]), "uniform").pvalue)


# Independence


def assert_independent(columns):
    """Correlations of any two columns (n, m), and of their squares; and the chi-square of 16 by 16
    cells of neighbours.
    """
    n, m = columns.shape
    bound = stats.norm.isf(FALSE_ALARM / (m * (m - 1))) / np.sqrt(n)
    for values in (columns, columns**2):
        off_diagonal = np.corrcoef(values.T)[np.triu_indices(m, 1)]
        assert np.abs(off_diagonal).max() < bound
    cell = [cells(column, 16) for column in columns.T]
    for a, b in pairwise(cell):
        assert_equal_cells(16 * a + b, 256)


def test_channels_are_independent():
    """Neighbours, and numbers that differ in one high bit."""
    assert_independent(normals(SEED, [0, 1, 2, 3, 2**31, 2**32, 2**63], 1, 200_000))


def test_seeds_are_independent():
    assert_independent(
        np.hstack([normals(seed, [1], 1, 200_000) for seed in (0, 1, 2, 3, 2**31, 2**63)])
    )


def test_seed_and_channel_are_not_exchangeable():
    assert_independent(np.hstack([normals(5, [6], 1, 200_000), normals(6, [5], 1, 200_000)]))


def test_samples_are_independent():
    """Lags within a block of four words, across blocks, and far apart."""
    run = normals(SEED, [4], 1, 300_000)[:, 0]
    assert_independent(
        np.column_stack([run[lag : lag + 200_000] for lag in (0, 1, 2, 3, 4, 5, 8, 1000, 65_536)])
    )


def test_neighbours_of_the_tail_are_normal(z):
    rare = np.flatnonzero(np.abs(z[1:-1]) > EDGES[1]) + 1
    for neighbour in (-1, 1):
        assert_chance(stats.kstest(z[rare + neighbour], "norm").pvalue)


def test_no_normal_comes_twice(z):
    """Nothing that a rare way draws is another sample's: of 256 layers of 2^53 places, two of four
    million meet once in 3e5 runs.
    """
    assert len(np.unique(z)) == N
