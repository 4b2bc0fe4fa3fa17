"""Bias against temperature in noise that walks.

Intervals cover, and chance makes neither orders nor loops.
"""

from itertools import pairwise

import numpy as np
import pytest
from places import measured
from scipy.stats import binom

import pyimu
from pyimu.characterization.temperature.averages import (
    AverageAccumulator,
    Averages,
    interval_averages,
)
from pyimu.characterization.temperature.fit import fit_thermal
from pyimu.characterization.temperature.order import _gain
from pyimu.characterization.temperature.regression import CHANCE, _fill_gram, regress
from pyimu.characterization.temperature.thermometer import smoothed, without_steps
from pyimu.errors import UserError
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.sensor import Sensor

FALSE_ALARM = 1e-3
"""Of each test here, with a right fit."""

INTERVAL, H = 10.0, 0.01
N, K = 1.0, 0.05
"""White noise and a walk that are as strong in an interval of some tens of seconds."""


def walk_means(rng: np.random.Generator, m: int, K: float) -> np.ndarray:
    """Exact averages (m,) of a walk over intervals.

    Over one interval the variances of the average and of the end are 1/3 and 1, their covariance
    1/2.
    """
    end, rest = rng.standard_normal((2, m)) * K * np.sqrt(INTERVAL)
    return np.cumsum(end) - end / 2 + rest / np.sqrt(12)


def temperatures(rng: np.random.Generator, kind: str, m: int) -> np.ndarray:
    """A warm-up, a chamber's cycles, or weather."""
    u = np.linspace(0, 1, m)
    if kind == "warm-up":
        return 25 + 15 * (1 - np.exp(-6 * u))
    return 25 + (8 * np.sin(2 * np.pi * 2.5 * u) if kind == "cycles" else walk_means(rng, m, 0.05))


def averages(temperature: np.ndarray, values: np.ndarray) -> Averages:
    m = len(temperature)
    return Averages(
        INTERVAL * (np.arange(m) + 0.5),
        temperature,
        values[:, None],
        np.full(m, round(INTERVAL / H)),
        H,
    )


def record(
    rng: np.random.Generator, kind: str, m: int = 300, kT: float = 0.0, K: float = K
) -> Averages:
    temperature = temperatures(rng, kind, m)
    noise = walk_means(rng, m, K) + N / np.sqrt(INTERVAL) * rng.standard_normal(m)
    return averages(temperature, 3.0 + kT * (temperature - 25) + noise)


def ordinary_holds(b: Averages, kT: float) -> bool:
    """Whether ordinary regression's 95 % interval contains it."""
    a = np.column_stack([np.ones(len(b.time)), b.temperature])
    coefficients, squares, *_ = np.linalg.lstsq(a, b.values[:, 0], rcond=None)
    std = np.sqrt(squares[0] / (len(a) - 2) * np.linalg.inv(a.T @ a)[1, 1])
    return abs(coefficients[1] - kT) < 1.96 * std


# Noise


def dense_covariance(b: Averages, r: np.ndarray, k2: float) -> np.ndarray:
    """Covariance of averages: the walk's min(s, t) integrated over each pair of intervals."""
    start, end = (
        b.time - b.duration / 2 - b.time[0] + b.duration[0] / 2,
        b.time + b.duration / 2 - b.time[0] + b.duration[0] / 2,
    )
    cov = np.minimum.outer((start + end) / 2, (start + end) / 2)
    return k2 * (cov - np.diag(np.diag(cov)) + np.diag(start + b.duration / 3)) + np.diag(r)


def test_whitening_is_the_dense_covariance_of_interval_averages():
    """Gram matrix and determinant, with intervals of unequal length and gaps."""
    rng, m = np.random.default_rng(1), 40
    count = rng.integers(1, 9, m)
    gap = rng.choice([0.0, 0.7], m)
    time = np.cumsum(count) - count / 2 + np.cumsum(gap)
    b, x = Averages(time, np.zeros(m), np.zeros((m, 1)), count, 1.0), rng.standard_normal((m, 3))
    r, got = 0.5 / b.duration, np.empty((3, 3))
    logs = _fill_gram(x, b.duration, b.gap, r, 0.3, got)
    cov = dense_covariance(b, r, 0.3)
    np.testing.assert_allclose(got, x.T @ np.linalg.solve(cov, x), rtol=1e-9)
    np.testing.assert_allclose(logs, np.linalg.slogdet(cov)[1], rtol=1e-9)


@pytest.mark.parametrize("N, K", [(1.0, 0.1), (0.3, 0.3)])
def test_white_noise_and_walk_come_back(N, K):
    """Their mean over records, to the standard error of that mean."""
    rng, m = np.random.default_rng(2), 1000
    fits = []
    for _ in range(40):
        b = averages(
            np.full(m, 25.0), walk_means(rng, m, K) + N / np.sqrt(INTERVAL) * rng.standard_normal(m)
        )
        fit = regress(b, b.values[:, 0], np.ones((m, 1)))
        fits.append((fit.N, fit.K))
    mean, error = np.mean(fits, axis=0), np.std(fits, axis=0) / np.sqrt(len(fits))
    np.testing.assert_array_less(np.abs(mean - [N, K]), 4 * error + 0.01 * mean)


def test_the_likeliest_share_taken_for_true_finds_too_much():
    """Of short warm-ups without a thermal effect.

    Averaged over the share no more than 5 % of the p-values are below 0.05.
    """
    rng, runs, found = np.random.default_rng(21), 300, np.zeros(2)
    for _ in range(runs):
        b = record(rng, "warm-up", 100, K=0.01)
        regressors = np.column_stack([np.ones(100), b.temperature - 25])
        fit = regress(b, b.values[:, 0], regressors)
        likelihood = fit.weights / np.sqrt(fit.shares * (1 - fit.shares))
        for i, w in enumerate((fit.weights, np.eye(len(likelihood))[np.argmax(likelihood)])):
            found[i] += (
                _gain(*(regress(b, b.values[:, 0], regressors[:, :p], w) for p in (1, 2))) < 0.05
            )
    limit = binom.isf(FALSE_ALARM / 2, runs, 0.05)
    assert found[0] <= limit < found[1]


# The polynomial


@pytest.mark.long
@pytest.mark.parametrize("kind", ["warm-up", "cycles", "weather"])
def test_intervals_cover_and_those_of_ordinary_regression_do_not(kind):
    """95 % of 240 records, within the binomial law.

    Those of ordinary regression hold less than half as often.
    """
    rng, runs, kT = np.random.default_rng(3), 240, 0.2
    held = ordinary = 0
    for _ in range(runs):
        b = record(rng, kind, kT=kT)
        held += fit_thermal(b, order=1).coefficients["kT"].holds(kT)
        ordinary += ordinary_holds(b, kT)
    low, high = binom.ppf(FALSE_ALARM / 2, runs, 0.95), binom.isf(FALSE_ALARM / 2, runs, 0.95)
    assert low <= held <= high
    assert ordinary < 0.5 * runs


@pytest.mark.long
@pytest.mark.parametrize("kind", ["warm-up", "cycles", "weather"])
def test_chance_makes_no_effect_of_temperature(kind):
    """Its probability is at most what it says.

    No more than 5 % of the p-values are below 0.05, and hardly any below the limit.
    """
    rng, runs = np.random.default_rng(4), 200
    fits = [fit_thermal(record(rng, kind)) for _ in range(runs)]
    assert sum(f.p_value < 0.05 for f in fits) <= binom.isf(FALSE_ALARM / 2, runs, 0.05)
    assert sum(f.order > 0 for f in fits) <= binom.isf(FALSE_ALARM / 2, runs, CHANCE)
    none = next(f for f in fits if f.order == 0)
    assert set(none.coefficients) == {"b0"} and none.bound > 0 and none.parameters() == {}


@pytest.mark.long
def test_a_bound_where_no_effect_is_warranted_holds():
    """An effect too small to be found is below it in 95 % of the records or more.

    It may be more, because the bound is two-sided.
    """
    rng, runs, kT = np.random.default_rng(5), 200, 0.01
    fits = [fit_thermal(record(rng, "cycles", kT=kT)) for _ in range(runs)]
    assert sum(f.bound > kT for f in fits) >= binom.ppf(FALSE_ALARM, runs, 0.95)
    assert all(np.isnan(f.bound) == (f.order > 0) for f in fits)


@pytest.mark.parametrize(
    "order", [pytest.param(1, marks=pytest.mark.long), 2, pytest.param(3, marks=pytest.mark.long)]
)
def test_the_order_is_that_of_the_data(order):
    """A clear polynomial is fitted with its own order, but for one record in a thousand.

    Its coefficients are in their intervals.
    """
    rng, runs, true = np.random.default_rng(6 + order), 100, [0.4, 0.05, 0.008][:order]
    held, right = np.zeros(order), 0
    for _ in range(runs):
        b = record(rng, "cycles", 400, K=0.02)
        x = b.temperature - 25
        f = fit_thermal(
            averages(
                b.temperature, b.values[:, 0] + sum(c * x ** (i + 1) for i, c in enumerate(true))
            ),
            T0=25.0,
        )
        right += f.order == order
        held += [
            list(f.coefficients.values())[i + 1].holds(c) if f.order >= order else True
            for i, c in enumerate(true)
        ]
    assert right >= binom.ppf(FALSE_ALARM / 2, runs, 1 - CHANCE) - 1
    assert np.all(held >= binom.ppf(FALSE_ALARM / 2 / order, runs, 0.95))


def test_coefficients_are_those_of_the_catalogue():
    """Values put into a sensor's own effects come back by their names."""
    rng, true = (
        np.random.default_rng(10),
        {("thermal_bias", "kT"): 0.4, ("thermal_bias_quadratic", "k2"): 0.05},
    )
    b = record(rng, "cycles", 400, K=0.01)
    effects = {}
    for (effect, name), value in true.items():
        effects[effect] = {
            p: np.full(v.shape, v.start) for p, v in CATALOGUE[effect].parameters.items()
        }
        effects[effect][name] = np.full(3, value)
        effects[effect]["T0"] = np.array(25.0)
    assert Sensor("gyro", effects)
    x = b.temperature - 25
    f = fit_thermal(averages(b.temperature, b.values[:, 0] + 0.4 * x + 0.05 * x**2), T0=25.0)
    found = f.parameters()
    assert set(found) == set(true) | {(effect, "T0") for effect, _ in true}
    for (name, c), key in zip(list(f.coefficients.items())[1:], true, strict=True):
        assert found[key] == c.value and abs(c.value - true[key]) < 4 * c.std, name
    np.testing.assert_allclose(
        np.sqrt(np.diag(f.covariance)), [c.std for c in f.coefficients.values()], rtol=1e-9
    )


def test_another_origin_is_the_same_polynomial():
    b = record(np.random.default_rng(11), "cycles", kT=0.3)
    x = b.temperature
    b = averages(x, b.values[:, 0] + 0.05 * (x - 25) ** 2)
    here, there = fit_thermal(b), fit_thermal(b, T0=0.0)
    assert here.order == there.order == 2 and abs(here.T0 - x.mean()) < 0.051
    np.testing.assert_allclose(here.at(x), there.at(x), rtol=1e-6)
    np.testing.assert_allclose(here.residual, there.residual, atol=1e-5)
    assert abs(here.residual.mean()) < 1e-9


def test_an_exact_record_has_its_exact_polynomial():
    b = averages(np.linspace(20, 30, 100), np.empty(100))
    f = fit_thermal(
        averages(b.temperature, 0.5 * (b.temperature - 25) + 0.05 * (b.temperature - 25) ** 2),
        T0=25.0,
    )
    assert f.order >= 2
    np.testing.assert_allclose(
        [f.coefficients["kT"].value, f.coefficients["k2"].value], [0.5, 0.05], rtol=1e-5
    )


# The thermometer


@pytest.mark.parametrize("fault", ["noise", "steps"])
def test_a_poor_thermometer_does_not_make_the_coefficient_smaller(fault):
    """Noise of 0.3 K an interval, or steps of 0.5 K: the mean over records is the true one."""
    rng, runs, kT, got = np.random.default_rng(12), 100, 0.5, []
    for _ in range(runs):
        b = record(rng, "cycles", 600, kT)
        poor = (
            b.temperature + 0.3 * rng.standard_normal(600)
            if fault == "noise"
            else np.round(2 * b.temperature) / 2
        )
        got.append(fit_thermal(averages(poor, b.values[:, 0]), order=1).coefficients["kT"])
    values = np.array([c.value for c in got])
    assert abs(values.mean() - kT) < 3.3 * values.std() / np.sqrt(runs) + 0.01 * kT
    assert sum(c.holds(kT) for c in got) >= binom.ppf(FALSE_ALARM, runs, 0.95)


def stairs(step: float, resolution: float, intervals_each: int = 40, ramp: int = 4) -> np.ndarray:
    """Plateaus up and down, with short ramps between them, as a coarse thermometer reads them."""
    levels = step * np.array([0, 1, 2, 3, 2, 1, 0])
    each = [
        np.append(np.linspace(a, b, ramp, endpoint=False), np.full(intervals_each, b))
        for a, b in pairwise(levels)
    ]
    return (
        25
        + np.round(np.concatenate([np.full(intervals_each, levels[0]), *each]) / resolution)
        * resolution
    )


@pytest.mark.parametrize("step, resolution", [(10.0, 0.1), (10.0, 0.5), (5.0, 5.0)])
def test_the_plateaus_of_a_chamber_stay_plateaus(step, resolution):
    """Nothing but rounding is smoothed away, and the coefficient is held as often as it says."""
    temperature, rng, kT, runs = stairs(step, resolution), np.random.default_rng(23), 0.5, 60
    assert np.abs(without_steps(temperature) - temperature).max() <= resolution / 2
    held = 0
    for _ in range(runs):
        m = len(temperature)
        values = (
            kT * (temperature - 25)
            + walk_means(rng, m, 0.01)
            + N / np.sqrt(INTERVAL) * rng.standard_normal(m)
        )
        held += fit_thermal(averages(temperature, values), order=1).coefficients["kT"].holds(kT)
    assert held >= binom.ppf(FALSE_ALARM, runs, 0.95)


def test_steps_of_the_thermometer_itself_become_straight():
    """Within a quarter of a step of the truth where that goes one way.

    Steps in the middle of an interval are included, the ends are not.
    """
    truth = 25 + 8 * np.sin(np.linspace(-1.2, 1.2, 4000))
    read = (np.round(2 * truth) / 2).reshape(400, 10).mean(axis=1)
    off = (without_steps(read) - truth.reshape(400, 10).mean(axis=1))[30:-30]
    assert (
        np.abs(off).max() <= 0.125
        and np.abs(read - truth.reshape(400, 10).mean(axis=1)).max() > 0.2
    )


def test_smoothing_leaves_a_good_thermometer_alone():
    b = record(np.random.default_rng(13), "cycles", 600)
    np.testing.assert_allclose(smoothed(b), b.temperature, atol=0.01)


# Hysteresis


def looped(rng: np.random.Generator, half: float, kh: float, m: int = 400) -> Averages:
    """The catalogue's play, written out a second time."""
    b, played = record(rng, "cycles", m, kT=0.2, K=0.01), 25.0
    out = np.empty(m)
    for i, t in enumerate(b.temperature):
        played = max(t - half, min(t + half, played))
        out[i] = kh * (played - t)
    return averages(b.temperature, b.values[:, 0] + out)


def test_a_loop_is_found_with_its_opening():
    """Bias rising less bias falling is - 2 kh w.

    The half widths that are tried are shares of the range, and 0.1 of 16 K is this one.
    """
    rng, runs, half, kh = np.random.default_rng(14), 60, 1.6, -0.5
    loops = [fit_thermal(looped(rng, half, kh)).hysteresis for _ in range(runs)]
    assert all(loop.warranted for loop in loops)
    exact = [loop for loop in loops if abs(loop.width - half) < 0.05 * half]
    assert len(exact) > runs / 2
    held = sum(loop.opening.holds(-2 * kh * half) for loop in exact)
    assert held >= binom.ppf(FALSE_ALARM, len(exact), 0.9)
    assert np.mean([loop.kh for loop in exact]) == pytest.approx(kh, rel=0.05)


@pytest.mark.parametrize("kind", ["cycles", pytest.param("weather", marks=pytest.mark.long)])
def test_chance_makes_no_loops(kind):
    rng, runs = np.random.default_rng(15), 250
    fits = [fit_thermal(record(rng, kind, kT=0.2), order=1) for _ in range(runs)]
    loops = [f.hysteresis for f in fits if f.hysteresis is not None]
    assert len(loops) > runs / 2
    assert sum(loop.p_value < 0.05 for loop in loops) <= binom.isf(
        FALSE_ALARM / 2, len(loops), 0.05
    )
    assert sum(loop.warranted for loop in loops) <= binom.isf(FALSE_ALARM / 2, len(loops), CHANCE)


def test_branches_are_where_the_temperature_rises_and_falls():
    b = record(np.random.default_rng(16), "cycles", 500)
    branch, step = fit_thermal(b).branch, np.diff(b.temperature, prepend=b.temperature[0])
    assert np.all(step[branch == 1] > 0) and np.all(step[branch == -1] < 0)
    assert np.mean(branch == 0) < 0.35 and (branch == 1).any() and (branch == -1).any()


def test_a_warm_up_has_no_loop_and_says_so():
    f = fit_thermal(record(np.random.default_rng(17), "warm-up", kT=0.2))
    assert f.hysteresis is None and "does not come back" in f.no_hysteresis


# Averages


@pytest.mark.parametrize("piece", [1, 97, 10_000])
def test_averages_do_not_depend_on_pieces(piece):
    rng, n = np.random.default_rng(18), 3000
    time = np.cumsum(rng.choice([0.1, 0.1, 0.1, 4.0], n))
    temperature, values = rng.standard_normal(n), rng.standard_normal((n, 2))
    values[7, 1] = temperature[20] = np.nan
    whole, parts = (
        interval_averages(time, temperature, values, 0.1, 100),
        AverageAccumulator(0.1, 100),
    )
    for a in range(0, n, piece):
        parts.add(time[a : a + piece], temperature[a : a + piece], values[a : a + piece])
    got = parts.result()
    # Doubling at another moment leaves intervals of the same edges.
    for name in ("time", "temperature", "values", "count"):
        np.testing.assert_allclose(
            getattr(got, name), getattr(whole, name), rtol=1e-9, atol=1e-9, err_msg=name
        )
    assert 100 <= len(got.time) <= 200 and got.count.sum() == n - 2
    ok = np.isfinite(values).all(axis=1) & np.isfinite(temperature)
    for mean, all_rows in (
        (got.time, time),
        (got.temperature, temperature),
        (got.values[:, 1], values[:, 1]),
    ):
        assert np.average(mean, weights=got.count) == pytest.approx(np.mean(all_rows[ok]))
    assert np.all(got.gap >= 0) and got.gap[0] == 0


def test_samples_slower_than_a_second_are_averages_of_their_own():
    got = interval_averages(np.arange(30) * 10.0, np.arange(30.0), np.ones(30), 10.0)
    assert np.all(got.count == 1) and len(got.time) == 30


# Wrong input, and a real sensor


def unfit(temperature, values=None):
    rng, m = np.random.default_rng(19), len(temperature)
    return averages(temperature, rng.standard_normal(m) if values is None else values)


@pytest.mark.parametrize(
    "b, message",
    [
        (unfit(np.full(300, 25.0)), "temperature is constant, 25.00 degC"),
        (
            unfit(25 + 0.1 * np.random.default_rng(20).standard_normal(300)),
            "within the thermometer's",
        ),
        (unfit(np.linspace(20, 30, 10)), "10 averages of samples, at least 20"),
        (unfit(np.linspace(20, 30, 300), np.full(300, 2.0)), "the channel is constant"),
        (AverageAccumulator(0.01).result(), "0 averages of samples"),
    ],
    ids=["constant", "noise", "short", "channel", "nothing"],
)
def test_no_fit_is_possible_and_why(b, message):
    with pytest.raises(UserError, match=message):
        fit_thermal(b)


def test_astropi_accelerometer_follows_the_temperature():
    """57 h, in which plain least squares found +0.56, +0.41, -0.39 mg/K (SOURCES.md).

    Walks of the bias leave some tenths of doubt.
    """
    log, milli_g = pyimu.read_recording(measured("astropi_lsm9ds1_static")), 9.80665e-3
    b = interval_averages(log.time, log.temperature, log.accel, log.sample_period)
    for axis, plain in enumerate((0.56, 0.41, -0.39)):
        f = fit_thermal(b, axis, order=1)
        slope = f.coefficients["kT"]
        assert (
            f.p_value < CHANCE
            and abs(slope.value / milli_g - plain) < 0.2
            and slope.std / milli_g < 0.1
        )
        assert f.residual.std() < f.bias.std() / 1.5
