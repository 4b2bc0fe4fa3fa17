"""The regression: against dense generalised least squares, and by the scatter of its estimates
about the truth.
"""

from dataclasses import replace

import numpy as np
import pytest
from loop_cases import inputs, low_pass, noise, trial
from scipy.linalg import block_diag
from scipy.ndimage import gaussian_filter1d
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

from pyimu.identification.fit import errors_in_variables, maximum_likelihood
from pyimu.identification.fit.columns import Linear, in_band, linearise, residual
from pyimu.identification.fit.fit import begin, power
from pyimu.identification.fit.incoherent import Spectrum, in_rows, of_reference
from pyimu.identification.fit.inputs import LogState
from pyimu.identification.fit.keys import Coefficient, LogBias, LogTurn, coefficients_of
from pyimu.identification.fit.maximum_likelihood import advantage, fit
from pyimu.identification.fit.normal import normal_equations, solve
from pyimu.identification.fit.reference_noise import with_reference_noise
from pyimu.identification.fit.trial import SETTLE
from pyimu.identification.fit.whiten import Autoregressive, RandomWalk
from pyimu.model.sensor import Sensor

H = 0.04
R, K2 = 1e-4, 4e-6
ALARM = 1e-4
GAIN = ("scale_factor", "misalignment")


def keys_of(sensor: Sensor, *names: str) -> frozenset:
    return frozenset().union(*(coefficients_of(sensor, n) for n in names))


def gyro(s=0.0, m=0.0) -> Sensor:
    return Sensor("gyro", {"scale_factor": {"s": s}, "misalignment": {"m": m * (1 - np.eye(3))}})


TRUE_S, TRUE_M = (
    np.array([0.02, -0.01, 0.015]),
    0.01 * np.array([[0.0, 1.0, -0.5], [0.3, 0.0, 0.8], [-0.6, 0.2, 0.0]]),
)
BIAS = np.array([0.1, -0.2, 0.05])


def measured(u: np.ndarray) -> np.ndarray:
    """Scale factor, misalignment and bias by plain algebra."""
    return u[:, :3] @ (np.diag(1 + TRUE_S) + TRUE_M).T + BIAS


def small_log(seed: int, name: str = "log", turn: Rotation | None = None, n: int = 1000, **more):
    """A log whose motion is the same for every seed, so that only the noise differs; ``turn`` turns
    the sensor's axes.
    """
    time = H * np.arange(n)
    u = inputs(np.random.default_rng(99), time)
    y = measured(u) if turn is None else turn.apply(u[:, :3]) @ np.diag(1 + TRUE_S) + BIAS
    return trial(time, y + wander(seed, time), u, name=name, **more)


def wander(seed: int, time: np.ndarray) -> np.ndarray:
    """Noise whose random walk passes zero where the regression starts to count rows: the bias is
    that of the first one.
    """
    return noise(np.random.default_rng(seed), time, R, K2, zero_at=SETTLE)


@pytest.mark.parametrize("rate", [50.0, 100.0, 104.0, 976.0])
def test_a_level_density_reaches_half_the_sample_rate(rate):
    """Whichever way the highest frequency of a frame of any length is rounded."""
    time = np.arange(100) / rate
    log = replace(small_log(0, n=100), h=1 / rate, time=time)
    for length in range(32, 800, 2):
        frequency = np.fft.rfftfreq(length, 1 / rate)
        np.testing.assert_allclose(in_rows(log, frequency, np.ones_like), 1.0, rtol=1e-12)


@pytest.mark.parametrize(("size", "shown"), [(0.3, False), (3.0, True)])
def test_coloured_noise_of_a_reference_is_more_than_the_sensors_own(size, shown):
    """Noise up to 5 Hz, known to a hundredth of the sensor's own density."""
    frequency = np.fft.rfftfreq(512, 0.01)
    own, low = np.ones(len(frequency)), frequency < 5.0
    seen = Spectrum(frequency, size * low, 0.01 * own, whole=size * low + 1e-3, own=own)
    found = of_reference(seen, 0.0, 0.1)
    assert found.coloured and (found.shown > 0.9) == shown and (found.shown == 0.0) != shown


@pytest.fixture(scope="module")
def fits():
    """The same log fitted under forty draws of the noise."""
    sensor = gyro()
    return [fit(begin(sensor, keys_of(sensor, *GAIN), [small_log(s)])) for s in range(40)]


def test_normal_equations_give_the_dense_generalised_least_squares_answer():
    rng = np.random.default_rng(1)
    time = np.cumsum(rng.uniform(0.5, 1.5, 150) * H)
    time[70:] += 3.0
    logs = [
        trial(time, rng.standard_normal((150, 3)), inputs(rng, time), name=n)
        for n in ("one", "two")
    ]
    model = {i: RandomWalk(0.5 + i, 0.1 * (i + 1)) for i in range(3)}
    sensor = gyro().with_values("g_sensitivity")
    wanted = keys_of(sensor, *GAIN, "g_sensitivity")
    linears = [linearise(sensor, t, LogState(), wanted) for t in logs]
    normal = normal_equations(linears, model)
    x, y, covariance = dense(linears, normal.keys, model)
    white = np.linalg.inv(np.linalg.cholesky(covariance))
    expected = np.linalg.lstsq(white @ x, white @ y, rcond=None)[0]
    np.testing.assert_allclose(
        solve(normal.gram, normal.score), expected, rtol=1e-7, atol=1e-9 * np.abs(expected).max()
    )
    np.testing.assert_allclose(normal.power, np.sum((white @ y) ** 2), rtol=1e-10)
    likelihood = -0.5 * (np.sum((white @ y) ** 2) + np.linalg.slogdet(covariance)[1])
    np.testing.assert_allclose(normal.log_likelihood, likelihood, rtol=1e-10)


def dense(
    linears: list[Linear], keys: list, model: dict
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Regressors, residual and covariance of all axes of all logs one below the other."""
    x, y, blocks = [], [], []
    for one in linears:
        since = one.time - one.time[0]
        for i in range(3):
            full = np.zeros((len(one.time), len(keys)))
            full[:, [keys.index(k) for k in one.keys[i]]] = one.columns[i]
            x.append(full)
            y.append(one.residual[:, i])
            blocks.append(
                model[i].r * np.eye(len(since)) + model[i].k2 * np.minimum.outer(since, since)
            )
    return np.concatenate(x), np.concatenate(y), block_diag(*blocks)


def test_batches_add_up_to_the_whole():
    started = begin(gyro(), keys_of(gyro(), *GAIN), [small_log(1), small_log(2, "other", n=300)])
    linears = started.linearise()
    normal = normal_equations(linears, started.noise)
    assert len(normal.batch_gram) == len(normal.batch_score) == 80
    assert normal.rows == 3 * sum(t.count for t in started.trials)
    apart = [normal_equations([one], started.noise) for one in linears]
    shared = [k for k in normal.keys if isinstance(k, Coefficient)]
    for take in (lambda n: n.score, lambda n: np.diag(n.gram)):
        total = sum(take(a)[[a.position[k] for k in shared]] for a in apart)
        np.testing.assert_allclose(
            take(normal)[[normal.position[k] for k in shared]], total, rtol=1e-9
        )
    np.testing.assert_allclose(power(started), normal.power, rtol=1e-10)


def z_scores(fitted, effect: str, parameter: str, true: np.ndarray) -> np.ndarray:
    keys = sorted(coefficients_of(fitted.sensor, effect))
    values = fitted.sensor.values[effect][parameter]
    return np.array([(values[k.index] - true[k.index]) / fitted.std[k] for k in keys])


def test_fit_recovers_coefficients_with_right_standard_errors(fits):
    s = np.array([z_scores(f, "scale_factor", "s", TRUE_S) for f in fits])
    m = np.array([z_scores(f, "misalignment", "m", TRUE_M) for f in fits])
    bias = np.array(
        [
            [(f.states["log"].bias[i] - BIAS[i]) / f.std[LogBias("log", i)] for i in range(3)]
            for f in fits
        ]
    )
    for z in (s, bias):
        # Axes and draws are independent, so the squares add up to a chi-square.
        assert np.abs(z).max() < 4.5
        assert chi2.ppf(ALARM / 2, z.size) < np.sum(z**2) < chi2.ppf(1 - ALARM / 2, z.size)
    assert np.abs(m).max() < 4.5
    # The two misalignments of an axis share their regressors' correlation; take one of each axis.
    for one in (m[:, ::2], m[:, 1::2]):
        assert chi2.ppf(ALARM / 2, one.size) < np.sum(one**2) < chi2.ppf(1 - ALARM / 2, one.size)


def test_fit_recovers_the_noise(fits):
    r = np.array([[f.noise[i].r for i in range(3)] for f in fits])
    # Fifteen parameters or so of 3000 rows are spent; the scatter of the mean over all draws is
    # that of a chi-square.
    assert abs(r.mean() / R - 1) < 4.5 * np.sqrt(2 / (r.size * 1000)) + 5 / 1000


@pytest.mark.parametrize("shrunk", [0.5, 0.8])
def test_a_smaller_model_whose_noise_fits_badly_is_judged_by_that_of_the_larger(shrunk):
    """What a larger model gains over it by its noise alone is not its coefficients'."""
    time = H * np.arange(1000)
    u = inputs(np.random.default_rng(99), time)
    log = trial(time, u[:, :3] + BIAS + wander(3, time), u)
    few, more = (keys_of(gyro(), *names) for names in (("misalignment",), GAIN))
    smaller, larger = (fit(begin(gyro(), free, [log])) for free in (few, more))
    noise = {i: replace(n, r=shrunk * n.r) for i, n in smaller.noise.items()}
    badly = replace(smaller, noise=noise)
    badly = replace(badly, log_likelihood=maximum_likelihood._likelihood(badly))
    by_chance = chi2.isf(ALARM, 3) / 2
    assert larger.log_likelihood - badly.log_likelihood > 2 * by_chance
    assert 0.0 <= advantage(larger, badly) < by_chance
    assert advantage(larger, smaller) == pytest.approx(advantage(larger, badly), abs=0.1)


def test_mounting_and_bias_of_each_log_are_recovered():
    turns = Rotation.from_euler("xyz", [[20, -35, 100], [3, 2, -1], [-170, 10, 5]], degrees=True)
    logs = [small_log(s, f"log{s}", turn, free_rotation=True) for s, turn in enumerate(turns)]
    sensor = Sensor("gyro", {"scale_factor": {}})
    fitted = fit(begin(sensor, keys_of(sensor, "scale_factor"), logs))
    squares = []
    for t, turn in zip(logs, turns, strict=True):
        state = fitted.states[t.name]
        off = (Rotation.from_matrix(state.rotation) * turn.inv()).as_rotvec()
        squares += [(off[i] / fitted.std[LogTurn(t.name, i)]) ** 2 for i in range(3)]
        squares += [
            ((state.bias[i] - BIAS[i]) / fitted.std[LogBias(t.name, i)]) ** 2 for i in range(3)
        ]
    assert max(squares) < 4.5**2 and np.sum(squares) < chi2.ppf(1 - ALARM, len(squares))
    assert np.abs(z_scores(fitted, "scale_factor", "s", TRUE_S)).max() < 4.5


ANGLE_NOISE = 1e-3
"""rad; white error of an attitude that is sampled at 50 Hz, 0.07 rad/s of white rate error."""


def seen_by_attitude(seed: int):
    """A gyro with a scale factor against the derivative of an attitude with white angle noise."""
    rng, time = np.random.default_rng(seed), 0.02 * np.arange(5000)
    u = inputs(np.random.default_rng(99), time)
    u[:, :3] *= 0.1
    y = u[:, :3] * (1 + TRUE_S) + 1e-3 * rng.standard_normal((len(time), 3))
    angle = ANGLE_NOISE * rng.standard_normal((len(time) + 2, 3))
    u[:, :3] += (angle[2:] - angle[:-2]) / 0.04
    return trial(time, y, u, reference="attitude", band_hz=6.0)


def scale_factors() -> np.ndarray:
    """Estimates less truth (draws, 3)."""
    sensor = Sensor("gyro", {"scale_factor": {}, "angle_random_walk": {"N": 1e-3 * np.sqrt(0.02)}})
    keys = keys_of(sensor, "scale_factor")
    fits = [fit(begin(sensor, keys, [seen_by_attitude(s)])) for s in range(20)]
    fits = [fit(with_reference_noise(f, [])[0]) for f in fits]
    return np.array([f.sensor.values["scale_factor"]["s"] - TRUE_S for f in fits])


def offset(errors: np.ndarray) -> np.ndarray:
    """Mean of each axis in its own standard errors."""
    return errors.mean(axis=0) / (errors.std(axis=0, ddof=1) / np.sqrt(len(errors)))


@pytest.mark.long
def test_columns_of_a_turn_are_the_differences_of_the_residual_turned_a_little():
    """Behind a gain and dynamics, in a state that is turned already."""
    time, step = H * np.arange(600), 1e-6
    u = inputs(np.random.default_rng(4), time)
    sensor = gyro(TRUE_S, TRUE_M).with_values("first_order_lag", wn=np.full(3, 20.0))
    one = trial(time, u[:, :3], u, free_rotation=True)
    state = LogState(rotation=Rotation.from_rotvec([0.3, -0.2, 0.5]).as_matrix())
    linear = linearise(sensor, one, state, ())
    for k in range(3):
        key = LogTurn(one.name, k)
        ends = (residual(sensor, one, state.moved(key, sign * step)) for sign in (1, -1))
        up, down = (in_band(one, r) for r in ends)
        expected = (down - up) / (2 * step)
        found = [linear.columns[i].arrays[linear.keys[i].index(key)] for i in range(3)]
        np.testing.assert_allclose(np.column_stack(found), expected, atol=1e-8)


def test_noise_of_an_attitude_reference_does_not_pull_the_scale_factor_down(monkeypatch):
    corrected = scale_factors()
    monkeypatch.setattr(maximum_likelihood, "has_noise", lambda fitted: False)
    raw = scale_factors()
    assert np.all(offset(raw) < -4.5), offset(raw)
    assert np.all(np.abs(offset(corrected)) < 4.5), offset(corrected)
    assert np.all(np.abs(corrected.mean(axis=0)) < 0.3 * np.abs(raw.mean(axis=0)))


WANDER, WANDER_TIME = 2e-3, 10.0
"""rad and s of an attitude that wanders: white noise smoothed over that time."""

LITTLE, LITTLE_TIME = 6e-4, 7.0
"""rad/s and s of the motion about the first axis: as slow as the wander, four times as large."""


def slow_noise(rng: np.random.Generator, time: np.ndarray, over: float) -> np.ndarray:
    """White noise (n, 3) smoothed over so many s, of variance one."""
    out = gaussian_filter1d(rng.standard_normal((len(time), 3)), over / 0.04, axis=0, mode="wrap")
    return out / out.std(axis=0)


def seen_by_wandering_attitude(seed: int):
    """A gyro with a scale factor against the derivative of an attitude that wanders slowly, and
    the noise of that derivative.
    """
    rng, time = np.random.default_rng(seed), 0.04 * np.arange(15000)
    u = inputs(np.random.default_rng(99), time)
    u[:, :3] *= 0.1
    u[:, 0] = LITTLE * slow_noise(np.random.default_rng(98), time, LITTLE_TIME)[:, 0]
    y = u[:, :3] * (1 + TRUE_S) + 1e-4 * rng.standard_normal((len(time), 3))
    angle = WANDER * slow_noise(rng, time, WANDER_TIME)
    angle += 1e-5 * rng.standard_normal(angle.shape)
    e = np.gradient(angle, 0.04, axis=0)
    u[:, :3] += e
    return trial(time, y, u, reference="attitude", band_hz=1.0), e


def test_the_noise_of_a_wandering_attitude_is_found_in_its_band():
    """Its power in the band by axis, within five of the standard errors that it is given."""
    sensor = Sensor("gyro", {"scale_factor": {}, "angle_random_walk": {"N": 1e-4 * np.sqrt(0.04)}})
    one, e = seen_by_wandering_attitude(1)
    first = fit(begin(sensor, keys_of(sensor, "scale_factor"), [one]))
    known = with_reference_noise(first, [])[0].trials[0]
    true, drawn = (in_band(one, v).var(axis=0) for v in (e, known.noise))
    assert np.all(np.array(known.noise_error) > 0.0)
    assert np.all(np.abs(drawn / true - 1.0) < 5.0 * np.array(known.noise_error))


def test_a_wandering_attitude_neither_pulls_a_scale_factor_nor_narrows_its_interval():
    """Least squares alone takes the wander about the axis that hardly moves for a scale factor far
    below one; here the squares of the errors in standard errors are a chi-square.
    """
    sensor = Sensor("gyro", {"scale_factor": {}, "angle_random_walk": {"N": 1e-4 * np.sqrt(0.04)}})
    keys, z, raw = keys_of(sensor, "scale_factor"), [], []
    for seed in range(8):
        first = fit(begin(sensor, keys, [seen_by_wandering_attitude(seed)[0]]))
        found = fit(with_reference_noise(first, [])[0])
        std = [found.std[Coefficient("scale_factor", "s", (i,))] for i in range(3)]
        z.append((found.sensor.values["scale_factor"]["s"] - TRUE_S) / std)
        raw.append(first.sensor.values["scale_factor"]["s"][0])
    z = np.array(z)
    assert np.mean(raw) < -0.05
    assert np.sum(z**2) < chi2.ppf(1 - ALARM, z.size), z


def seen_by_rate(seed: int):
    """A gyro with a scale factor against a rate as noisy as itself, at rest in turn."""
    rng, time = np.random.default_rng(seed), 0.02 * np.arange(5000)
    u = inputs(np.random.default_rng(99), time)
    u[:, :3] *= 0.1 * (time % 20.0 >= 6.0)[:, None]
    y = u[:, :3] * (1 + TRUE_S) + 1e-3 * rng.standard_normal((len(time), 3))
    u[:, :3] += 1e-3 * rng.standard_normal((len(time), 3))
    return trial(time, y, u)


def test_noise_of_a_rate_reference_neither_pulls_the_scale_factor_nor_narrows_its_interval():
    """The squares of the errors in standard errors are a chi-square."""
    sensor = Sensor("gyro", {"scale_factor": {}, "angle_random_walk": {"N": 1e-3 * np.sqrt(0.02)}})
    keys, z = keys_of(sensor, "scale_factor"), []
    for seed in range(20):
        known, _ = with_reference_noise(fit(begin(sensor, keys, [seen_by_rate(seed)])), [])
        assert known.trials[0].noise is not None
        found = fit(known)
        std = [found.std[Coefficient("scale_factor", "s", (i,))] for i in range(3)]
        z.append((found.sensor.values["scale_factor"]["s"] - TRUE_S) / std)
    z = np.array(z)
    assert chi2.ppf(ALARM / 2, z.size) < np.sum(z**2) < chi2.ppf(1 - ALARM / 2, z.size)
    assert abs(z.mean()) < 4.5 / np.sqrt(z.size)


@pytest.mark.parametrize("hz", [None, 8.0, 3.0])
def test_the_noise_of_a_rate_reference_is_found_whatever_its_colour(hz):
    """Its power by axis, within five of the standard errors that it is given; coloured or not."""
    rng, time = np.random.default_rng(12), 0.02 * np.arange(15000)
    u = inputs(np.random.default_rng(99), time)
    y = u[:, :3] + 1e-3 * rng.standard_normal((len(time), 3))
    e = 1e-3 * rng.standard_normal((len(time), 3))
    e = e if hz is None else low_pass(e, hz, 0.02)
    u[:, :3] += e
    sensor = Sensor("gyro", {"angle_random_walk": {"N": 1e-3 * np.sqrt(0.02)}})
    known = with_reference_noise(fit(begin(sensor, (), [trial(time, y, u)])), [])[0]
    errors = np.array(known.trials[0].noise_error)
    assert np.all(errors > 0.0) and known.coloured == (hz is not None)
    assert np.all(np.abs(known.trials[0].noise.var(axis=0) / e.var(axis=0) - 1.0) < 5.0 * errors)


def test_a_rate_without_noise_has_none_though_the_sensor_drifts_more_than_declared():
    rng, time = np.random.default_rng(13), 0.02 * np.arange(15000)
    u = inputs(np.random.default_rng(99), time)
    white, walk = 1e-3 * rng.standard_normal((2, len(time), 3))
    y = u[:, :3] + white + 0.05 * np.cumsum(walk, axis=0)
    sensor = Sensor("gyro", {"angle_random_walk": {"N": 1e-3 * np.sqrt(0.02)}})
    known = with_reference_noise(fit(begin(sensor, (), [trial(time, y, u)])), [])[0]
    assert known.trials[0].noise is None or np.all(
        known.trials[0].noise.var(axis=0) < 5.0 * 0.02 * white.var(axis=0)
    )
    assert not known.coloured


def test_columns_that_differ_by_noise_of_the_reference_alone_show_nothing_of_their_difference():
    """Two columns of one signal, each with as much noise again: their sum is shown, their
    difference is noise. What is left has no direction in which less than nothing is seen.
    """
    rng, n = np.random.default_rng(14), 4000
    x, noise = rng.standard_normal((n, 1)), 0.1 * rng.standard_normal((n, 2))
    seen, drawn = x + noise, 0.1 * rng.standard_normal((n, 2))
    gram = (seen.T @ seen - drawn.T @ drawn)[None]
    score, doubt = seen.T @ x[:, 0], np.ones((1, 2))
    onto, off = errors_in_variables._unseen_directions(gram[0], seen.T @ seen)
    assert onto.shape == (2, 1)
    left, scores = gram.copy(), score[None].copy()
    errors_in_variables._without(left, scores, doubt, np.arange(2), onto, off)
    values, vectors = np.linalg.eigh(left[0])
    assert abs(values[0]) < 1e-9 * values[1]
    assert abs(vectors[:, 0] @ scores[0]) < 1e-9 * np.linalg.norm(scores)
    sum_of_both = solve(left[0], scores[0]).sum()
    assert abs(sum_of_both - 1.0) < 4.5 * 0.1 / np.sqrt(n)


def test_solve_is_the_least_norm_answer_in_units_of_each_column():
    rng = np.random.default_rng(3)
    columns = rng.standard_normal((50, 4)) * [1.0, 1e6, 1e-5, 3.0]
    columns = np.column_stack([columns, columns[:, 0] * 7 + columns[:, 3], np.zeros(50)])
    y = rng.standard_normal(50)
    scale = np.where(np.linalg.norm(columns, axis=0) > 0, np.linalg.norm(columns, axis=0), 1.0)
    expected = np.linalg.pinv(columns / scale, rcond=1e-9) @ y / scale
    np.testing.assert_allclose(
        solve(columns.T @ columns, columns.T @ y), expected, rtol=1e-8, atol=1e-14
    )
    assert solve(columns.T @ columns, columns.T @ y)[-1] == 0.0
    inverse = solve(columns.T @ columns, np.eye(6))
    np.testing.assert_allclose(inverse @ (columns.T @ y), expected, rtol=1e-6, atol=1e-12)


def test_directions_that_the_data_do_not_show_stay_where_they_were():
    t = small_log(5)
    u = np.array(t.u)
    u[:, 2] = 0.0
    still = trial(t.time, measured(u) + wander(5, t.time), u)
    start = gyro(s=0.004)
    start = start.with_values(
        "misalignment", m=0.002 * np.array([[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]])
    )
    fitted = fit(begin(start, keys_of(start, *GAIN), [still]))
    # Once the misalignment of z is found, its scale factor acts on what leaks in there, a
    # second-order effect.
    assert abs(fitted.sensor.values["scale_factor"]["s"][2] - 0.004) < 1e-3
    np.testing.assert_array_equal(fitted.sensor.values["misalignment"]["m"][:2, 2], 0.002)
    off = fitted.sensor.values["scale_factor"]["s"][:2] - TRUE_S[:2]
    assert np.all(
        np.abs(off) < [4.5 * fitted.std[Coefficient("scale_factor", "s", (i,))] for i in range(2)]
    )


def test_noise_model_follows_what_the_reference_is():
    derived = begin(gyro(), (), [small_log(1, reference="attitude", band_hz=5.0)])
    assert all(isinstance(n, Autoregressive) for n in derived.noise.values())
    assert all(isinstance(n, RandomWalk) for n in begin(gyro(), (), [small_log(1)]).noise.values())
