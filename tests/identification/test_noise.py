"""What is random in a residual: the likelihoods against dense algebra, the gate against its rate,
each kind of noise by name and size.
"""

import itertools

import numpy as np
import pytest
from scipy.signal import lfilter
from scipy.stats import binom, norm

from pyimu.identification.fit.whiten import RandomWalk
from pyimu.identification.noise.choose import choose, refined
from pyimu.identification.noise.exact import AxisNoise
from pyimu.identification.noise.known import state_of
from pyimu.identification.noise.laws import kinds
from pyimu.identification.noise.rows import Rows
from pyimu.identification.noise.spectrum import bands
from pyimu.identification.noise.telegraph import RATES, _filtered, _likelihood, telegraph_likelihood
from pyimu.identification.search.screen import PENALTY
from pyimu.model.sensor import Sensor

H, N, K = 0.01, 1e-3, 2e-5
PART = Sensor("gyro", {"angle_random_walk": {"N": [N] * 3}, "rate_random_walk": {"K": [K] * 3}})
WIDE = float(norm.isf(1e-4 / 2))
"""Standard errors that a right estimate keeps within but once in ten thousand."""


def markov(rng, n, q, tau):
    """A stationary Gauss-Markov process (n,)."""
    kept, w = np.exp(-H / tau), rng.standard_normal(n)
    w[1:] *= np.sqrt(1 - kept**2)
    return q * np.sqrt(tau / 2) * lfilter([1.0], [1.0, -kept], w)


def flicker(rng, n, B):
    """1/f noise (n,) of density B^2 / (2 pi f) by the spectrum itself, over a record eight times as
    long.
    """
    m = 8 * n
    f = np.fft.rfftfreq(m, H)
    amplitude = np.zeros(len(f))
    amplitude[1:] = np.sqrt(B**2 / (2 * np.pi * f[1:]) * m / H / 2)
    pairs = rng.standard_normal((2, len(f)))
    return np.fft.irfft(amplitude * (pairs[0] + 1j * pairs[1]), m)[:n]


def rows(rng, n=21000, white=N, walk=K, more=lambda t, x, slope: 0.0):
    """A residual of declared noise, and ``more``, of an axis that turns at 0.1 to 2 Hz."""
    t = np.arange(n) * H
    f, phase = rng.uniform(0.1, 2.0, (5, 1)), rng.uniform(0, 2 * np.pi, (5, 1))
    x = 0.5 * np.sin(2 * np.pi * f * t + phase).sum(axis=0)
    slope = np.gradient(x, H)
    r = white / np.sqrt(H) * rng.standard_normal(n)
    r = r + np.cumsum(walk * np.sqrt(H) * rng.standard_normal(n)) + more(t, x, slope)
    return Rows(t, r, x, slope, H, n)


def chosen(logs, free=frozenset()):
    """The kinds of noise that are found on three axes, and the state with them."""
    each = {i: [one] for i, one in enumerate(logs)}
    every = kinds(PART, H, logs[0].time[-1])
    fitted = {i: RandomWalk.fit([(r.r, r.time, [(0, len(r.r))])]) for i, r in enumerate(logs)}
    state = state_of(PART, each, fitted, every, free, np.zeros(3))
    return choose(state, [k for k in every if k.name not in free])


def size(state, i, name):
    """Size squared and its standard error on an axis."""
    axis = state.axes[i]
    term = next(t for t in state.found[i] if t.kind.name == name)
    cells = axis.motion if term.kind.follows else axis.spectrum
    sizes = cells.fit()[0]
    return sizes[term.place], np.sqrt(cells.covariance(sizes)[term.place, term.place]), term


@pytest.mark.parametrize("seed", range(4))
def test_exact_likelihood_is_that_of_dense_gaussian_algebra(seed):
    """Differences from the first row have no bias; their density is the product of the rows' given
    those before, the first left out: the diffuse variance is off by a part in 1e8.
    """
    rng = np.random.default_rng(seed)
    t = np.cumsum(rng.uniform(0.005, 0.05, 80))
    x, r = rng.standard_normal(80), rng.standard_normal(80)
    one = Rows(t, r, x, x, H, 80)
    by_name = {k.name: k for k in kinds(PART, H, 100.0)}
    q, tau, k, n = 0.8, 0.3, 0.7, 0.05
    sizes = {
        "angle_random_walk": (n**2, {}),
        "rate_random_walk": (k**2, {}),
        "gauss_markov": (q**2, {"tau": tau}),
        "rate_dependent_noise": (0.03**2, {}),
    }
    noise = AxisNoise({by_name[name]: v for name, v in sizes.items()})
    apart = np.abs(t[:, None] - t)
    whole = q**2 * tau / 2 * np.exp(-apart / tau) + k**2 * np.minimum.outer(t, t)
    whole += np.diag((n**2 + (0.03 * x) ** 2) / H)
    lift = np.hstack([-np.ones((79, 1)), np.eye(79)])
    c, d = lift @ whole @ lift.T, lift @ r
    dense = -0.5 * (np.linalg.slogdet(c)[1] + d @ np.linalg.solve(c, d))
    assert noise.likelihood(one).sum() == pytest.approx(dense, abs=1e-3)


def test_cells_have_the_variance_of_white_noise_and_random_walk():
    """Each of 200 residuals gives a cell ``count`` squares: their mean is known to sqrt(2/all)."""
    made = [bands([rows(np.random.default_rng(s), 3000)]) for s in range(200)]
    variance = made[0].density(N**2, K**2, (), 0.0)
    z = (np.mean([b.squares for b in made], axis=0) / made[0].count / variance - 1) / np.sqrt(
        2 / (200 * made[0].count)
    )
    assert np.abs(z).max() < norm.isf(1e-3 / (2 * len(z)))


@pytest.mark.long
def test_known_noise_is_blamed_at_the_stated_rate():
    """Of 60 residuals of three axes half a percent each: at most 4 but once in ten thousand."""
    blamed = 0
    for s in range(60):
        logs = [rows(np.random.default_rng([5, s, i]), 6000) for i in range(3)]
        blamed += bool(chosen(logs)[1])
    assert blamed <= binom.isf(1e-4, 60, 0.005)


TRUE = {
    "angle_random_walk": (3e-4, lambda c: lambda r: lambda t, x, s: c / H**0.5 * r(len(t))),
    "rate_random_walk": (
        3e-4,
        lambda c: lambda r: lambda t, x, s: np.cumsum(c * H**0.5 * r(len(t))),
    ),
    "rate_dependent_noise": (1e-3, lambda c: lambda r: lambda t, x, s: c * x / H**0.5 * r(len(t))),
    "sampling_jitter": (2e-3, lambda c: lambda r: lambda t, x, s: c * s * r(len(t))),
}


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("name", TRUE)
def test_noise_with_one_coefficient_is_named_with_its_size(name, seed):
    """By Fisher's information, on each of three axes."""
    c, law = TRUE[name]
    logs = []
    for i in range(3):
        rng = np.random.default_rng([2, seed, i])
        logs.append(rows(rng, more=law(c)(rng.standard_normal)))
    state, found = chosen(logs)
    assert [f.kind.name for f in found] == [name]
    for i in range(3):
        square, std, _ = size(state, i, name)
        assert abs(square - c**2) < WIDE * std


@pytest.mark.parametrize("seed", range(3))
def test_a_gauss_markov_process_is_named_with_its_correlation_time(seed):
    q, tau = 2e-3, 4.0
    logs = []
    for i in range(3):
        rng = np.random.default_rng([3, seed, i])
        logs.append(rows(rng, more=lambda t, x, s, rng=rng: markov(rng, len(t), q, tau)))
    state, found = chosen(logs)
    assert found[0].kind.name == "gauss_markov"
    for i in range(3):
        _, _, term = size(state, i, "gauss_markov")
        form, std = refined(state, i, term)
        # The likelihood is skew: the logarithm is nearer to normal.
        assert abs(np.log(form["tau"] / tau)) < WIDE * std / form["tau"]


@pytest.mark.parametrize("seed", range(3))
def test_flicker_is_named_with_its_size(seed):
    """The sum of processes keeps to 1/f within 0.25 dB, 3 % of B, beside the chance."""
    B = 1e-3
    logs = []
    for i in range(3):
        rng = np.random.default_rng([1, seed, i])
        logs.append(rows(rng, more=lambda t, x, s, rng=rng: flicker(rng, len(t), B)))
    state, found = chosen(logs)
    assert found[0].kind.name == "bias_instability"
    for i in range(3):
        square, std, _ = size(state, i, "bias_instability")
        assert abs(square - B**2) < WIDE * std + 0.06 * B**2


def test_several_kinds_at_once():
    logs = []
    for i in range(3):
        rng = np.random.default_rng([17, i])

        def more(t, x, s, rng=rng):
            return markov(rng, len(t), 3e-3, 3.0) + 2e-3 * x / H**0.5 * rng.standard_normal(len(t))

        logs.append(rows(rng, more=more))
    names = {f.kind.name for f in chosen(logs)[1]}
    assert names == {"gauss_markov", "rate_dependent_noise"}


def test_likelihood_tells_jumps_between_two_levels_from_a_gauss_markov_process():
    """Either of the same variance and correlation time, 40 excursions of three times the noise of
    the means; the noise declared is all else that there is.
    """
    rng = np.random.default_rng(19)
    n, gap, dwell = 21000, 6e-3, 5.0
    every = {k.name: k for k in kinds(PART, H, 210.0)}
    tau, variance = dwell / 2, gap**2 / 4
    sizes = {"angle_random_walk": (N**2, {}), "rate_random_walk": (K**2, {})}
    sizes["gauss_markov"] = (2 * variance / tau, {"tau": tau})
    noise = AxisNoise({every[name]: v for name, v in sizes.items()})
    jumps = np.cumsum(rng.exponential(dwell, 200))
    level = gap * (np.searchsorted(jumps, np.arange(n) * H) % 2)
    smooth = markov(rng, n, np.sqrt(2 * variance / tau), tau)
    for add, jumping in ((level, True), (smooth, False)):
        one = rows(rng, more=lambda t, x, s, add=add: add).means(0.1)
        white = noise.variance(one)[:, None]
        ahead = telegraph_likelihood([one], white, np.array([K**2])) - noise.likelihood(one).sum()
        assert bool(ahead > 12.0) is jumping


def dense_telegraph(r, h, white, walk, gap, up, down):
    """Log-likelihood of differences from the first row, summed over all 2^n ways of two states."""
    n = len(r)
    t = np.arange(n) * h
    whole = walk * np.minimum.outer(t, t) + white * np.eye(n)
    lift = np.hstack([-np.ones((n - 1, 1)), np.eye(n - 1)])
    c = lift @ whole @ lift.T
    inverse, half = np.linalg.inv(c), -0.5 * np.linalg.slogdet(c)[1]
    moved = -np.expm1(-(up + down) * h) / (up + down)
    step = np.array([[1 - up * moved, up * moved], [down * moved, 1 - down * moved]])
    total = 0.0
    for way in itertools.product((0, 1), repeat=n):
        share = (down, up)[way[0]] / (up + down)
        share *= np.prod([step[a, b] for a, b in itertools.pairwise(way)])
        d = lift @ (r - gap * np.array(way))
        total += share * np.exp(-0.5 * d @ inverse @ d)
    return half + np.log(total)


@pytest.mark.parametrize("seed", range(3))
def test_likelihood_of_a_telegraph_is_the_sum_over_all_ways_of_it(seed):
    """Given its levels and without a walk the recursion is exact: the sum over 2^8 ways, with the
    bias integrated out on a grid instead.
    """
    rng = np.random.default_rng([31, seed])
    h, white, gap, up, down = 0.1, 0.04, 0.7, 1.5, 2.5
    r = gap * (np.arange(8) > 3) + np.sqrt(white) * rng.standard_normal(8)
    steps = np.full(8, h)
    biases = np.linspace(-3, 3, 6001)
    one = np.array([gap])
    sure, gain, _, variances = _filtered(steps, np.full((8, 1), white), np.zeros(1))
    logs = [
        _likelihood(r[:, None], steps, sure, gain, np.array([b]), one, up, down) - variances
        for b in biases
    ]
    # Over all biases what is left is the density of the differences, but for a normal's constant.
    whole = np.log(np.trapezoid(np.exp(np.array(logs)), biases) / np.sqrt(2 * np.pi))
    assert whole == pytest.approx(dense_telegraph(r, h, white, 0.0, gap, up, down), abs=1e-6)


@pytest.mark.parametrize("unit", [1.0, 1e-6])
def test_telegraph_is_compared_with_other_noise_in_any_unit(unit):
    """White noise alone is no telegraph, by the same amount in rad/s as in urad/s."""
    rng = np.random.default_rng(37)
    r = rng.standard_normal(2000)
    every = {k.name: k for k in kinds(PART, 0.1, 200.0)}
    ahead = []
    for scale in (1.0, unit):
        t = np.arange(2000) * 0.1
        one = Rows(t, scale * r, t, t, 0.1, 2000)
        noise = AxisNoise({every["angle_random_walk"]: (0.1 * scale**2 * r.var(), {})})
        found = telegraph_likelihood([one], noise.variance(one)[:, None], np.zeros(1))
        ahead.append(found - noise.likelihood(one).sum())
    assert ahead[1] == pytest.approx(ahead[0], abs=0.1)
    assert ahead[0] < PENALTY * (1 + RATES)


def test_jumps_that_axes_share_are_seen_where_each_alone_is_lost():
    """Steps of 1.6 times the noise of a dwell's mean, on three axes at the same instants."""
    rng = np.random.default_rng(41)
    n, dwell = 30000, 6.0
    gap = 1.6 * N / np.sqrt(dwell)
    jumps = np.cumsum(rng.exponential(dwell, 400))
    level = gap * (np.searchsorted(jumps, np.arange(n) * H) % 2)
    logs = [rows(rng, n, more=lambda t, x, s: level).means(0.1) for _ in range(3)]
    every = {k.name: k for k in kinds(PART, H, 300.0)}
    tau = dwell / 2
    sizes = {"angle_random_walk": (N**2, {}), "rate_random_walk": (K**2, {})}
    sizes["gauss_markov"] = (gap**2 / (2 * tau), {"tau": tau})
    noise = AxisNoise({every[name]: v for name, v in sizes.items()})
    white = [noise.variance(one)[:, None] for one in logs]
    smooth = [noise.likelihood(one).sum() for one in logs]
    walk = np.full(3, K**2)
    apart = [telegraph_likelihood([o], w, walk[:1]) for o, w in zip(logs, white, strict=True)]
    together = telegraph_likelihood(logs, np.hstack(white), walk)
    assert max(np.array(apart) - smooth) < PENALTY * (1 + RATES) < together - sum(smooth)
