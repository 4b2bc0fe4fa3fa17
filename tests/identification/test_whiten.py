"""Whitening: against dense Gaussian algebra, and by what whiteness means."""

import numpy as np
import pytest
from scipy.signal import lfilter
from scipy.stats import chi2, norm

from pyimu.identification.fit.whiten import Autoregressive, RandomWalk, power_less_bias

ALARM = 1e-4
"""Chance with which a right program fails a statistical test under another seed; the seeds here are
fixed."""


def irregular(rng, n, gaps=3):
    """Times (n,) with unequal steps, of which some are gaps a hundred times as long."""
    steps = rng.uniform(0.002, 0.05, n)
    steps[rng.choice(n, gaps, replace=False)] *= 100.0
    return np.cumsum(steps)


def walked(rng, time, r, k2):
    """White noise of variance ``r`` on a random walk that starts from zero."""
    steps = np.sqrt(k2 * np.diff(time, prepend=time[:1]))
    return np.sqrt(r) * rng.standard_normal(len(time)) + np.cumsum(
        steps * rng.standard_normal(len(time))
    )


def autoregressive(rng, coefficients, r, n):
    """A stationary AR process (n,), its start forgotten."""
    return lfilter(
        [1.0], [1.0, -coefficients[0], -coefficients[1]], np.sqrt(r) * rng.standard_normal(n + 500)
    )[500:]


def assert_white(v):
    """Unit variance (chi-square) and correlations at lags 1 to 20 within what white noise of this
    length has.
    """
    n = len(v)
    assert chi2.ppf(ALARM / 2, n) < v @ v < chi2.ppf(1 - ALARM / 2, n)
    correlation = np.array([v[:-k] @ v[k:] for k in range(1, 21)]) / (v @ v)
    assert np.abs(correlation).max() * np.sqrt(n) < norm.ppf(1 - ALARM / 40)


@pytest.mark.parametrize("seed", range(8))
def test_innovations_give_the_dense_gaussian_log_likelihood(seed):
    rng = np.random.default_rng(seed)
    t, r, k2 = irregular(rng, 120), 10.0 ** rng.uniform(-4, 1), 10.0 ** rng.uniform(-5, 2)
    v = walked(rng, t, r, k2)
    since = t - t[0]
    covariance = r * np.eye(len(t)) + k2 * np.minimum.outer(since, since)
    noise, segments = RandomWalk(r, k2), [(0, len(t))]
    white = noise.whiten(v[:, None], t, segments)
    np.testing.assert_allclose(
        noise.log_det(t, segments), np.linalg.slogdet(covariance)[1], rtol=1e-9
    )
    np.testing.assert_allclose(np.sum(white**2), v @ np.linalg.solve(covariance, v), rtol=1e-8)


def test_innovations_of_a_random_walk_are_white():
    rng = np.random.default_rng(1)
    t = irregular(rng, 20000)
    assert_white(
        RandomWalk(0.3, 0.7).whiten(walked(rng, t, 0.3, 0.7)[:, None], t, [(0, len(t))])[:, 0]
    )


@pytest.mark.parametrize(
    "noise",
    [RandomWalk(0.3, 0.7, 2.0), Autoregressive((1.5, -0.7), 0.2), Autoregressive((), 0.2)],
    ids=lambda n: type(n).__name__,
)
def test_blocks_of_rows_are_whitened_as_all_together(noise):
    """Whatever their length: none, less than the memory of an autoregression, across segments."""
    rng = np.random.default_rng(12)
    t, segments = irregular(rng, 300), [(0, 130), (130, 131), (140, 300)]
    v, blocks = rng.standard_normal((300, 3)), noise.filter(t, segments)
    edges = [0, 0, 1, 2, 3, 3, 100, 135, 141, 299, 300]
    parts = [blocks.next(v[a:b]) for a, b in zip(edges[:-1], edges[1:], strict=True)]
    np.testing.assert_allclose(np.concatenate(parts), noise.whiten(v, t, segments), atol=1e-12)
    assert blocks.log_det == noise.log_det(t, segments)


@pytest.mark.parametrize(
    "noise",
    [RandomWalk(0.3, 0.7), Autoregressive((1.5, -0.7), 0.2)],
    ids=lambda n: type(n).__name__,
)
def test_whitening_is_linear(noise):
    rng = np.random.default_rng(2)
    t, segments = irregular(rng, 300), [(0, 130), (130, 300)]
    v, mix = rng.standard_normal((300, 3)), rng.standard_normal((3, 2))
    np.testing.assert_allclose(
        noise.whiten(v @ mix, t, segments), noise.whiten(v, t, segments) @ mix, atol=1e-12
    )


def test_fit_recovers_white_noise_and_random_walk():
    r, k2, h, seeds = 0.04, 0.02, 0.02, 40
    t = h * np.arange(2000)
    fits = [
        RandomWalk.fit([(walked(np.random.default_rng(s), t, r, k2), t, [(0, len(t))])])
        for s in range(seeds)
    ]
    logs = np.log([[f.r / r, f.k2 / k2] for f in fits])
    scatter = logs.std(axis=0, ddof=1)
    assert np.all(np.abs(logs.mean(axis=0)) < 4.5 * scatter / np.sqrt(seeds))
    # The scatter itself: that of r is known, sqrt(2/n) and a little for what the walk takes.
    assert 0.6 < scatter[0] / np.sqrt(2 / len(t)) < 1.8


def test_fit_leaves_out_a_random_walk_that_is_not_there():
    """The likelihood ratio of a variance at its bound is zero in half of all cases (Self and Liang
    1987, case 5).
    """
    t, seeds = 0.02 * np.arange(1000), 40
    zero = sum(
        RandomWalk.fit([(np.random.default_rng(s).standard_normal(1000), t, [(0, 1000)])]).k2 == 0.0
        for s in range(seeds)
    )
    assert zero >= seeds / 2 - 4 * np.sqrt(seeds) / 2


def test_bias_does_not_change_the_fitted_noise():
    rng = np.random.default_rng(4)
    logs = [(irregular(rng, 800), 50.0), (irregular(rng, 500), -7.0)]
    drawn = [(walked(rng, t, 0.01, 0.3), t, b) for t, b in logs]
    bare, moved = (
        RandomWalk.fit([(v + b * with_bias, t, [(0, len(t))]) for v, t, b in drawn])
        for with_bias in (0, 1)
    )
    np.testing.assert_allclose([moved.r, moved.k2], [bare.r, bare.k2], rtol=1e-6)


def test_column_that_dies_away_holds_no_denormal_numbers():
    impulse = np.zeros((200000, 1))
    impulse[0] = 1.0
    white = RandomWalk(1.0, 50.0).whiten(
        impulse, 0.01 * np.arange(len(impulse)), [(0, len(impulse))]
    )
    assert np.all((white == 0.0) | (np.abs(white) >= np.finfo(float).tiny))
    assert np.all(white[-1000:] == 0.0)


def test_whitened_autoregression_is_white():
    rng = np.random.default_rng(5)
    v = autoregressive(rng, (1.5, -0.7), 0.2, 30000)
    assert_white(
        Autoregressive((1.5, -0.7), 0.2).whiten(v[:, None], np.arange(30000.0), [(0, 30000)])[2:, 0]
    )


def test_fitted_autoregression_whitens_data_that_it_has_not_seen():
    rng = np.random.default_rng(6)
    seen, new = (autoregressive(rng, (1.5, -0.7), 0.2, 30000) for _ in range(2))
    time, segments = np.arange(30000.0), [(0, 30000)]
    noise = Autoregressive.fit([(seen, time, segments)])
    white = noise.whiten(new[:, None], time, segments)[len(noise.coefficients) :, 0]
    assert_white(white)


def test_autoregression_fit_gives_coefficients_within_their_standard_errors():
    n, r, true = 20000, 0.2, np.array([1.5, -0.7])
    v = autoregressive(np.random.default_rng(7), true, r, n)
    fitted = Autoregressive.fit([(v, np.arange(float(n)), [(0, 9000), (9000, n)])], order=2)
    # Yule and Walker: the covariance of the estimate is r / n times the inverse covariance of (v_k,
    # v_k-1).
    gamma0 = r * (1 - true[1]) / ((1 + true[1]) * ((1 - true[1]) ** 2 - true[0] ** 2))
    gamma1 = gamma0 * true[0] / (1 - true[1])
    off = np.array(fitted.coefficients) - true
    assert n / r * off @ np.array([[gamma0, gamma1], [gamma1, gamma0]]) @ off < chi2.ppf(
        1 - ALARM, 2
    )
    assert abs(fitted.r / r - 1) < norm.ppf(1 - ALARM / 2) * np.sqrt(2 / n)


def test_autoregression_restarts_in_each_segment():
    v = np.random.default_rng(8).standard_normal((90, 2))
    noise, time = Autoregressive((0.5, 0.2, -0.1), 2.0), np.arange(90.0)
    together = noise.whiten(v, time, [(0, 40), (40, 42), (50, 90)])
    for a, b in ((0, 40), (50, 90)):
        np.testing.assert_array_equal(together[a:b], noise.whiten(v[a:b], time[a:b], [(0, b - a)]))
        expected = (
            v[a + 3 : b] - 0.5 * v[a + 2 : b - 1] - 0.2 * v[a + 1 : b - 2] + 0.1 * v[a : b - 3]
        )
        np.testing.assert_allclose(together[a + 3 : b], expected / np.sqrt(2.0), atol=1e-14)


def test_rows_without_predecessors_are_zero_and_count_for_nothing():
    v, noise = np.ones((60, 1)), Autoregressive((0.5, 0.2, -0.1), 2.0)
    segments = [(0, 30), (30, 32), (32, 60)]
    white = noise.whiten(v, np.arange(60.0), segments)
    assert not white[[0, 1, 2, 30, 31, 32, 33, 34]].any()
    assert np.count_nonzero(white) == 27 + 0 + 25
    np.testing.assert_allclose(noise.log_det(np.arange(60.0), segments), 52 * np.log(2.0))


@pytest.mark.parametrize("seed", [18, 42, *range(6)])
def test_no_walk_is_much_likelier_than_the_likeliest(seed):
    """Against the likelihood of all rows on a grid of walks, from one that no row shows to one that
    hides the noise. Half of what one coefficient more gains by chance (half a nat, Wilks 1938) is
    no difference to anyone. A golden section of that range misses weak walks: over most of it the
    likelihood is flat.
    """
    rng = np.random.default_rng(seed)
    rows, ratio = int(10 ** rng.uniform(3.5, 4.6)), 10 ** rng.uniform(-8.5, -5)
    time = np.arange(rows) * 0.01 if seed % 6 == 0 else irregular(rng, rows)
    values = walked(rng, time, 1.0, 100.0 * ratio)
    both, whole = np.column_stack([values, np.ones(rows)]), [(0, rows)]

    def likelihood(noise):
        """Of the residual beside a noise, the white part and a constant as they suit it best."""
        power = power_less_bias(noise.whiten(both, time, whole))
        return -0.5 * (rows * np.log(power / rows) + noise.log_det(time, whole))

    best = max(likelihood(RandomWalk(1.0, np.exp(x))) for x in np.arange(-30.0, 8.0, 0.5))
    assert likelihood(RandomWalk.fit([(values, time, whole)])) > best - 0.25


SEGMENTS = [(0, 90), (90, 200)]


def averaged(theta: float, r: float, n: int) -> np.ndarray:
    """Covariance (n, n) of z_k - theta z_(k-1)."""
    return r * ((1 + theta**2) * np.eye(n) - theta * (np.eye(n, k=1) + np.eye(n, k=-1)))


@pytest.mark.parametrize("theta", [0.3, 0.9, 0.999, 1.0])
def test_innovations_of_a_moving_average_give_the_dense_gaussian_log_likelihood(theta):
    rng, noise = np.random.default_rng(1), Autoregressive((), 0.04, theta=theta)
    v, t = rng.standard_normal(200), np.arange(200.0)
    white = noise.whiten(v[:, None], t, SEGMENTS)
    power = log_det = 0.0
    for a, b in SEGMENTS:
        covariance = averaged(theta, 0.04, b - a)
        power += v[a:b] @ np.linalg.solve(covariance, v[a:b])
        log_det += np.linalg.slogdet(covariance)[1]
    np.testing.assert_allclose(np.sum(white**2), power, rtol=1e-9)
    np.testing.assert_allclose(noise.log_det(t, SEGMENTS), log_det, rtol=1e-9)
    # In pieces as at once.
    some = noise.filter(t, SEGMENTS)
    pieces = [some.next(v[a:b, None]) for a, b in ((0, 37), (37, 90), (90, 131), (131, 200))]
    np.testing.assert_array_equal(np.concatenate(pieces), white)


@pytest.mark.parametrize("count", [2, 7, 40])
def test_means_of_a_moving_average_are_one(count):
    """Their variance by dense algebra, and that of the mean of very many."""
    theta, r = 0.97, 0.3
    means = Autoregressive((), r, theta=theta).in_means(count)
    variance = averaged(theta, r, count).mean()
    assert means.r * (1 + means.theta**2) == pytest.approx(variance, rel=1e-9)
    assert means.slow.r == pytest.approx(r * (1 - theta) ** 2 / count, rel=1e-9)


def test_a_step_is_as_sure_beside_differentiated_noise_as_it_is():
    """Of noise of an attitude of unit variance, differentiated, beside white noise of a hundredth
    of it: an autoregression of 32 rows alone makes the standard error of a step 3 times too large.
    Steps are an eighth of a decade apart from what is tried of 1 - theta.
    """
    rng, n, own = np.random.default_rng(3), 6000, 0.01
    v = np.diff(rng.standard_normal(n + 1)) + own * rng.standard_normal(n)
    # (1 - theta)^2 / theta = own^2 has the same covariances.
    away = own * np.sqrt(1 + own**2 / 4) - own**2 / 2
    true = Autoregressive((), 1.0 / (1.0 - away), theta=1.0 - away)
    found = Autoregressive.fit([(v, np.arange(float(n)), [(0, n)])], least=5 / n)
    step = (np.arange(n) > n / 3).astype(float)
    columns = np.column_stack([step, np.ones(n)])

    def error(noise):
        white = noise.whiten(columns, np.arange(float(n)), [(0, n)])
        return np.sqrt(np.linalg.inv(white.T @ white)[0, 0])

    assert 10**-0.25 < error(found) / error(true) < 10**0.25
    alone = Autoregressive.fit([(v, np.arange(float(n)), [(0, n)])])
    assert error(alone) > 3 * error(true)
    assert_white(found.whiten(v[:, None], np.arange(float(n)), [(0, n)])[32:, 0])


def test_an_autoregression_of_a_few_rows_settles():
    """By least squares a wave that grows is predicted by a filter that grows; what means over its
    rows have was infinite, and the search ended in an error of linear algebra.
    """
    k = np.arange(60)
    values = 1.03**k * np.cos(1.8 * k) + 0.01 * np.random.default_rng(1).standard_normal(60)
    found = Autoregressive.fit([(values, k.astype(float), [(0, 60)])], order=2)
    poles = np.roots([1.0, *(-c for c in found.coefficients)])
    assert np.abs(poles).max() < 1.0 and np.isfinite(found.in_means(50).r)
    assert abs(np.angle(poles[0])) == pytest.approx(1.8, abs=0.01)


@pytest.mark.parametrize(
    "noise",
    [
        Autoregressive((1.5, -0.7), 0.2),
        Autoregressive((0.5, -0.3, 0.1), 0.2, theta=0.9),
        Autoregressive((), 0.2),
    ],
)
def test_no_noise_is_quieter_at_its_slow_end_than_a_part_declares(noise):
    """What is more is white: of an autoregression by its covariance, to what its memory can have of
    that; of the derivative of a noise its slow end alone is another.
    """
    assert noise.no_quieter_than(0.5 * noise.slow.r) is noise
    level = 1.2 * noise.slow.r
    more = noise.no_quieter_than(level)
    assert more.slow.r == pytest.approx(level, rel=1e-4)
    assert len(more.coefficients) == len(noise.coefficients)
    if noise.theta:
        assert 0.0 < more.theta < noise.theta and more.coefficients == noise.coefficients
