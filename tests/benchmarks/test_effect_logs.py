"""The logs of ``benchmarks/effects.py``: sizes in sigmas and equations, each another way."""

import numpy as np
import pytest
from effect_logs import cases, nameless, noise_terms, whitening
from effect_logs.alike import nat_apart
from effect_logs.chain import NAMED, TERMS, Chain, NotShown, at_typical, tuned
from effect_logs.scene import new_scene
from effect_logs.term import Case
from generators import rotation
from generators.instrument import Triad, any_sensor
from generators.motion import rover, shaker, static, table, thermal_cycle, tumble
from scipy.optimize import minimize_scalar

from pyimu.model.catalogue import CATALOGUE
from pyimu.model.part_reader import parse_part

H = 0.01
TRIAD = Triad(np.zeros(3), np.array([0.1, 0.2, 0.3]), np.array([0.5, 1e-3, 2.0]))


def innovations_norm(error, r, k2h, free):
    """The norm of an error behind the Kalman filter of a level that walks, whose innovations are
    white; what a bias and free columns explain is taken off by least squares.
    """
    columns = np.column_stack([error, np.ones(len(error)), free])
    level, variance = np.zeros(columns.shape[1]), 0.0
    out = np.empty_like(columns)
    for k, values in enumerate(columns):
        variance += k2h if k else 0.0
        out[k] = (values - level) / np.sqrt(variance + r)
        level = level + variance / (variance + r) * (values - level)
        variance *= r / (variance + r)
    left = out[:, 0] - out[:, 1:] @ np.linalg.lstsq(out[:, 1:], out[:, 0])[0]
    return left @ left


def test_the_norm_is_that_of_the_innovations_filter():
    """To the rounding of a least squares: its condition is below 1e4 here, so 1e-9."""
    rng = np.random.default_rng(1)
    error = np.cumsum(rng.standard_normal((400, 3)), axis=0)
    free = rng.standard_normal((400, 2))
    found = [g[0, 0] for g in whitening.grams(error[:, :, None], TRIAD, H, free)]
    for i in range(3):
        r, k2h = TRIAD.n[i] ** 2 / H, TRIAD.k[i] ** 2 * H
        np.testing.assert_allclose(found[i], innovations_norm(error[:, i], r, k2h, free), rtol=1e-9)


def test_the_norm_in_white_noise_is_the_root_of_the_sum_of_squares():
    """Without a walk, of an error less its mean."""
    error = np.random.default_rng(2).standard_normal((500, 3))
    white = Triad(np.zeros(3), TRIAD.n, np.zeros(3))
    wanted = np.sqrt(np.sum(((error - error.mean(axis=0)) / (TRIAD.n / np.sqrt(H))) ** 2))
    found = sum(g[0, 0] for g in whitening.grams(error[:, :, None], white, H, np.zeros((500, 0))))
    np.testing.assert_allclose(np.sqrt(found), wanted, rtol=1e-9)


def test_the_norm_beside_attitudes_is_that_of_their_noise_differentiated():
    """By dense algebra: white noise, a walk from anywhere, and the differences of white angles, the
    first and the last of which are known no better than the others.
    """
    n, wrong = 150, 2e-3
    error, level = np.random.default_rng(3).standard_normal((n, 3)), np.ones((n, 1))
    turned = np.diff(np.eye(n + 1), axis=0) / H
    for i, gram in enumerate(whitening.grams(error[:, :, None], TRIAD, H, level[:, :0], wrong)):
        walk = np.minimum.outer(np.arange(n), np.arange(n)) * TRIAD.k[i] ** 2 * H
        noise = walk + TRIAD.n[i] ** 2 / H * np.eye(n) + wrong**2 * turned @ turned.T
        columns = np.column_stack([error[:, i], level])
        own = columns.T @ np.linalg.solve(noise, columns)
        wanted = own[0, 0] - own[0, 1] ** 2 / own[1, 1]
        np.testing.assert_allclose(gram[0, 0], wanted, rtol=1e-8)


def test_a_log_tells_an_effect_from_another_by_what_that_leaves():
    """Of an error that the other effect makes as well nothing is left; of one that has nothing to
    do with it half its squared size.
    """
    made = cases.make("one/12/gyro.scale_factor_g_sensitivity", 0, (6.0, 9.0))
    (truth,), case = made.truths, made.cases["scale_factor_g_sensitivity"]

    def apart(other):
        return nat_apart(made.chains, "scale_factor_g_sensitivity", case, other)

    assert apart("scale_factor_g_sensitivity") < 1e-6
    assert apart("scale_factor") < 0.1  # the vertical axis turns, and the force on it is g
    assert 0.5 * truth.size**2 - 6.0 < apart("thermal_bias") < 0.5 * truth.size**2
    assert apart("rate_random_walk") is None
    assert apart("no_effect") is None


def test_the_size_of_excess_white_noise_is_the_likelihoods():
    """Whittle's sum over all frequencies for a flat excess is that of independent samples, less
    the bins of zero and pi and what the random walk adds below: a thousandth of 20,000 rows.
    """
    n, triad = 20_000, Triad(np.zeros(3), TRIAD.n, 1e-9 * TRIAD.n)
    extra = 0.3 * triad.n**2 / H
    flat = np.tile(extra, (len(whitening.frequencies(n)[0]), 1))
    found = whitening.gain_of_spectrum(flat, n, triad, H)
    wanted = np.sqrt(3 * n * (0.3 - np.log(1.3)))
    np.testing.assert_allclose(found, wanted, rtol=1e-3)


def test_the_size_of_noise_that_follows_the_motion_is_over_the_likeliest_white_noise():
    """Twice the log-likelihood lost by one variance for all rows, at its best; nothing where the
    motion does not change.
    """
    n = 500
    share = np.random.default_rng(9).uniform(0.0, 2.0, (n, 3))
    extra = share * TRIAD.n**2 / H
    lost = 0.0
    for v in (1.0 + share).T:
        one = minimize_scalar(lambda c, v=v: np.sum(np.log(c / v) + v / c - 1.0), (0.5, 2.0))
        lost += one.fun
    np.testing.assert_allclose(
        whitening.gain_of_variance(extra, TRIAD, H), np.sqrt(lost), rtol=1e-6
    )
    flat = np.tile(extra[0], (n, 1))
    # The root of a sum of n differences that are zero but for rounding.
    assert whitening.gain_of_variance(flat, TRIAD, H) < 1e-5


def test_a_process_of_long_correlation_is_a_walk_to_a_sensor_without_noise():
    """Of 250 s a process of 20 s is told from a walk in few cells, however quiet the sensor is."""
    n, tau, quiet = 25_000, 20.0, Triad(np.zeros(3), np.full(3, 1e-9), np.full(3, 1e-11))
    kept = np.exp(-H / tau)
    omega = whitening.frequencies(n)[0]
    shape = (1 - kept**2) / (1 - 2 * kept * np.cos(omega) + kept**2)
    sizes = [
        whitening.gain_of_spectrum(np.tile(v * shape[:, None], (1, 3)), n, quiet, H, free=True)
        for v in (1e-8, 1e-4)
    ]
    np.testing.assert_allclose(sizes[0], sizes[1], rtol=1e-2)


def test_heading_is_that_of_the_forward_axis_however_the_body_is_turned():
    scene = new_scene(np.random.default_rng(3), tumble, 60.0)
    forward = rotation.in_body(scene.attitude * [1, -1, -1, -1], np.tile([1.0, 0, 0], (6000, 1)))
    level = np.hypot(forward[:, 0], forward[:, 1])
    seen = level > 1e-3
    np.testing.assert_allclose(
        np.cos(scene.heading)[seen], (forward[:, 0] / level)[seen], atol=1e-9
    )
    np.testing.assert_allclose(
        np.sin(scene.heading)[seen], (forward[:, 1] / level)[seen], atol=1e-9
    )


def test_white_noise_and_a_walk_of_another_size_are_nothing_where_they_are_free():
    n = 20_000
    omega, _ = whitening.frequencies(n)
    walk = 3 * TRIAD.k**2 * H / (4 * np.sin(omega[:, None] / 2) ** 2)
    extra = walk + 0.3 * TRIAD.n**2 / H
    assert whitening.gain_of_spectrum(extra, n, TRIAD, H) > 10
    assert whitening.gain_of_spectrum(extra, n, TRIAD, H, free=True) < 0.1


def test_the_frequencies_stand_for_all():
    for n in (200, 30_000, 84_001):
        omega, count = whitening.frequencies(n)
        assert np.sum(count) == n // 2 - 1
        assert np.all(np.diff(omega) > 0) and omega[-1] < np.pi


def test_gauss_markov_draws_have_their_variance_and_correlation():
    """Of 4,000 processes the variance of a sample has a relative deviation of sqrt(2 / 4000), the
    correlation of two at most 1 / sqrt(4000): six of each.
    """
    draws = np.random.default_rng(3).standard_normal((60, 4000))
    x = noise_terms._markov(draws, 2.0, 0.05)
    assert abs(x[0].var() / 2 - 1) < 6 * np.sqrt(2 / 4000)
    assert abs(x[59].var() / 2 - 1) < 6 * np.sqrt(2 / 4000)
    assert abs(np.corrcoef(x[10], x[50])[0, 1] - np.exp(-40 * 0.05)) < 6 / np.sqrt(4000)


def test_flicker_has_its_density():
    """B^2 / w times 2 / pi (atan(b / w) - atan(a / w)) of rates from a to b, half a spacing beyond
    the first and the last; the sum over so many is that integral to 1e-4 (its first harmonic is the
    hyperbolic secant of pi^2 / d). What is folded down from above 50 Hz adds 0.7 % at 0.1 Hz.
    """
    scene = new_scene(np.random.default_rng(4), static, 60.0)
    case = Case("gyro", scene, np.ones(3), {}, 1)
    w = 2 * np.pi * np.logspace(-3, -1, 50)
    rates, spacing = noise_terms._poles()
    a, b = rates[0] * np.exp(-spacing / 2), rates[-1] * np.exp(spacing / 2)
    found = noise_terms._flicker_density(case, w * H)[:, 0] * H
    wanted = 2 / np.pi * (np.arctan(b / w) - np.arctan(a / w)) / w
    np.testing.assert_allclose(found, wanted, rtol=0.01)


def test_a_first_order_lag_of_a_sinusoid():
    """Gain 1 / sqrt(1 + (w tau)^2), delay atan(w tau) / w. Held linear between samples 2.5 ms
    apart a sinusoid of 1 Hz is too small by (w h)^2 / 12 = 2e-5 at most.
    """

    class Swung:
        def rate(self, time):
            return np.tile(np.sin(2 * np.pi * time)[:, None], 3)

    scene = new_scene(np.random.default_rng(5), static, 30.0)
    swung = type(scene)(scene.time, Swung(), scene.warmth, scene.supply, 0.5, scene.cruise)
    tau, w = 0.05, 2 * np.pi
    case = Case("gyro", swung, tau, {}, 1)
    late = TERMS["first_order_lag"].apply(swung.rate, case)
    wanted = np.sin(w * scene.time - np.arctan(w * tau)) / np.hypot(1, w * tau)
    np.testing.assert_allclose(late[500:, 0], wanted[500:], atol=4e-5)


def test_a_play_follows_a_triangle_behind_by_its_half_width():
    scene = new_scene(np.random.default_rng(6), static, 40.0)
    up = np.abs((scene.time / 10 + 1) % 2 - 1) * 20
    ramped = type(scene)(scene.time, scene.motion, up, scene.supply, 0.5, scene.cruise)
    case = Case("gyro", ramped, np.ones(3), {"width": 2.0}, 1)
    moved = TERMS["thermal_hysteresis"].apply(np.zeros((len(up), 3)), case)[:, 0]
    rising = (scene.time > 25) & (scene.time < 29)
    falling = (scene.time > 15) & (scene.time < 19)
    signs = np.sign(np.gradient(up))
    np.testing.assert_allclose(moved[rising], -2.0 * signs[rising], atol=1e-9)
    np.testing.assert_allclose(moved[falling], -2.0 * signs[falling], atol=1e-9)


def test_a_lever_across_an_axis_is_angular_acceleration_and_spin():
    """e . (a x r) is a_j r_k - a_k r_j; w x (w x r) is w (w . r) - r w^2, its last term none for
    a lever without a part along the axis.
    """
    scene = new_scene(np.random.default_rng(14), tumble, 20.0)
    r = np.array([[0.0, 2.0, 3.0], [5.0, 0.0, 7.0], [11.0, 13.0, 0.0]])
    turned = np.array([[0.0, 3.0, -2.0], [-7.0, 0.0, 5.0], [13.0, -11.0, 0.0]])
    y = np.zeros_like(scene.force)
    for name, c in (("angular_acceleration", turned), ("spin_sensitivity", r)):
        y = TERMS[name].apply(y, Case("accel", scene, c, {}, 1))
    lever = TERMS["size_effect"].apply(np.zeros_like(y), Case("accel", scene, r, {}, 1))
    np.testing.assert_allclose(y, lever, atol=1e-9 * np.abs(lever).max())


def test_cross_axis_squares_of_gravity_alone_add_up():
    """f_j^2 + f_k^2 = g^2 - f_i^2, and the product of the others is that of all by its own."""
    scene = new_scene(np.random.default_rng(15), table, 60.0)
    term, f = TERMS["cross_axis_nonlinearity"], scene.force
    squares = term.apply(f, Case("accel", scene, 1 - np.eye(3), {}, 1)) - f
    np.testing.assert_allclose(squares, 9.80665**2 - f**2, atol=1e-9)
    products = term.apply(f, Case("accel", scene, np.eye(3), {}, 1)) - f
    np.testing.assert_allclose(products * f, np.tile(f.prod(axis=1)[:, None], 3), atol=1e-9)
    assert np.array_equal(term.told(np.ones((3, 3))), 1 - np.eye(3))


def test_dead_zones_and_a_bias_with_the_sign():
    """A soft one is the hard one less d sign x, which is a bias asymmetry of -2 d."""
    scene = new_scene(np.random.default_rng(16), tumble, 20.0)
    x, d = scene.force, np.array([0.5, 1.0, 2.0])
    soft, hard = (
        TERMS[n].apply(x, Case("accel", scene, d, {}, 1)) for n in ("dead_zone", "hard_dead_zone")
    )
    shifted = TERMS["bias_asymmetry"].apply(x, Case("accel", scene, -2 * d, {}, 1))
    beyond = np.abs(x) > d
    assert beyond.any(axis=0).all() and (~beyond).any(axis=0).all()
    assert not soft[~beyond].any() and not hard[~beyond].any()
    assert np.array_equal(hard[beyond], x[beyond])
    np.testing.assert_allclose(soft[beyond], shifted[beyond], atol=1e-12)


def test_every_effect_of_the_catalogue_has_a_term_or_is_the_bias():
    assert {t.right for t in NAMED} == set(CATALOGUE) - {"turn_on_bias"}
    for t in NAMED:
        assert set(t.sizes) == set(CATALOGUE[t.right].sensors)


@pytest.mark.parametrize("term", [t for t in TERMS.values()], ids=lambda t: t.name)
def test_an_effect_of_no_size_is_nothing(term):
    """Of what is given by its size: the output is the input, to the rounding of one filter."""
    scene = new_scene(np.random.default_rng(7), tumble, 20.0)
    kind = next(iter(term.sizes))
    x = scene.own(kind)
    c = np.zeros(term.shape) if term.shape else 1e-9
    form = term.form(np.random.default_rng(8), scene)
    y = term.apply(x, Case(kind, scene, 0.0 if term.known else c, form, 1))
    np.testing.assert_allclose(y, x, atol=1e-6)


@pytest.mark.parametrize("name", ["one/8/gyro.g_sensitivity", "one/30/accel.hard_dead_zone"])
def test_a_case_has_its_size_and_depends_on_its_name_alone(name):
    one, other = (cases.make(name, 1, (1.0, 1.5)) for _ in range(2))
    assert one.part == other.part and one.form == other.form == "undeclared"
    for a, b in zip(one.logs, other.logs, strict=True):
        assert a.keys() == b.keys() and all(np.array_equal(a[k], b[k]) for k in a)
    assert abs(one.truths[0].size / float(name.split("/")[1]) - 1) < cases.WITHIN


def test_the_size_is_that_of_the_difference_it_makes():
    """The log less the same log without the effect, whitened; both logs share their noise."""
    scene = new_scene(np.random.default_rng(9), tumble, 60.0)
    sensor = any_sensor(np.random.default_rng(10))
    chain = Chain("gyro", scene, sensor.gyro, 11)
    case = chain.case(1e-3 * np.ones(3), {})
    error = chain.measure({"scale_factor_asymmetry": case}) - chain.measure({})
    np.testing.assert_allclose(
        error,
        1e-3 * np.abs((1 + sensor.gyro.scale) * (scene.rate + scene.rate @ sensor.gyro.skew.T)),
        atol=1e-12,
    )
    size = chain.size(TERMS["scale_factor_asymmetry"], case)
    assert size == chain.size_of(error)


@pytest.mark.parametrize("sized", [tuned, at_typical])
def test_no_sensor_is_made_so_quiet_that_it_shows_rounding(sized):
    """The vertical force of a rover has one sign, so that its bias asymmetry is a bias."""
    scene = new_scene(np.random.default_rng(17), rover, 60.0)
    assert scene.force[:, 2].min() > 0
    chain = Chain("accel", scene, any_sensor(np.random.default_rng(18)).accel, 19)
    with pytest.raises(NotShown):
        sized([chain], TERMS["bias_asymmetry"], np.array([0.0, 0.0, 1.0]), {}, 8.0)


def test_together_and_pairs_have_their_sizes():
    both = cases.make("together/8/gyro.scale_factor_cubic", 0, (1.0, 1.5))
    assert len(both.logs) == 2 and abs(both.truths[0].size / 8 - 1) < cases.WITHIN
    pair = cases.make("pair/12/gyro", 0, (1.0, 1.5))
    assert len(pair.truths) == 2
    assert all(abs(t.size / 12 - 1) < cases.WITHIN for t in pair.truths)


def test_a_limit_is_the_sensors_and_not_the_logs():
    """Two logs of one sensor clip at one value, and a limit that goes to infinity leaves nothing:
    the size of a small coefficient is none, whatever the noise on a flat top.
    """
    made = cases.make("together/8/accel.saturation", 6, (1.0, 1.5))
    axes = np.flatnonzero(made.truths[0].value)
    tops = np.array([np.abs(log["accel"]).max(axis=0)[axes] for log in made.logs])
    limits = np.outer([1, 1], tops.max(axis=0))
    clipped = np.array(
        [np.mean(np.abs(log["accel"][:, axes]) == limits[0], axis=0) for log in made.logs]
    )
    assert np.all(clipped.max(axis=0) > 0) and np.all(tops <= limits)
    scene = new_scene(np.random.default_rng(21), rover, 60.0)
    chain = Chain("accel", scene, any_sensor(np.random.default_rng(22)).accel, 23)
    term = TERMS["saturation"]
    form = term.form(np.random.default_rng(0), scene)
    assert chain.size(term, chain.case(1e-6 * np.ones(3), form)) == 0.0


def test_all_rows_have_cases():
    for row in cases.ROWS:
        assert cases.names(row)
    assert sum(len(t.sizes) for t in nameless.TERMS) == len(cases.names("unknown_30"))


@pytest.mark.parametrize("motion", [shaker, static, thermal_cycle], ids=lambda m: m.__name__)
def test_rest_is_rest(motion):
    """Gravity's size at rest, and in a shaker no turn to speak of."""
    scene = new_scene(np.random.default_rng(12), motion, 120.0)
    if motion is not shaker:
        np.testing.assert_allclose(np.linalg.norm(scene.force, axis=1), 9.80665, rtol=1e-9)
    if motion is static:
        assert np.abs(scene.rate).max() < 1e-9


def test_the_true_model_leaves_the_noise():
    """Of a random effect its noise as well: white noise of c / sqrt(h) beside the declared.

    Squares of differences of n = 6,000 white samples have neighbours correlated by a half, so that
    their mean has a relative deviation of sqrt(3 / n); six of it. The walk adds less than 1e-3.
    """
    fixed = cases.make("one/30/gyro.scale_factor", 0, (1.0, 1.5))
    random = cases.make("one/30/gyro.angle_random_walk", 0, (1.0, 1.5))
    for made in (fixed, random):
        white = np.diff(made.left[0]["gyro"], axis=0) / np.sqrt(2)
        declared = np.array(parse_part(made.part, "case").gyro.values["angle_random_walk"]["N"])
        extra = made.truths[0].value if made is random else np.zeros(3)
        wanted = (declared**2 + extra**2) / H
        np.testing.assert_allclose(np.mean(white**2, axis=0), wanted, rtol=6 * np.sqrt(3 / 6000))


@pytest.mark.parametrize("seed", range(3))
def test_nothing_switches_at_a_speed_at_which_a_table_is_kept(seed):
    """There the last digits of a rate would: of ten rates of a table two are the same for a fifth
    of its rows.
    """
    rng = np.random.default_rng(seed)
    scene = new_scene(rng, cases.MOTIONS["table"], 300.0)
    level, size = nameless._fast(rng, scene)["beyond"], np.linalg.norm(scene.rate, axis=1)
    near = np.abs(size / level - 1.0) < nameless.NEAR
    assert np.mean(near) <= nameless.KEPT and 0.2 < np.mean(size > level) < 0.9
