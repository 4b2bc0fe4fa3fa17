"""The held-out score: its floor by covariance algebra, its parts by plain loops."""

from dataclasses import replace

import numpy as np
import pytest
from loop_cases import inputs, noise, trial
from scipy.spatial.transform import Rotation
from scipy.stats import norm

from pyimu.identification.fit.fit import Fit, begin
from pyimu.identification.fit.inputs import LogState
from pyimu.identification.fit.score import (
    FLOOR_DRAWS,
    WINDOW,
    ErrorSums,
    held_state,
    sums,
    tally,
    unit_floor,
)
from pyimu.identification.fit.trial import HEAD, Trial
from pyimu.identification.fit.whiten import RandomWalk
from pyimu.model.sensor import Sensor

H = 0.1
R, K2 = 4e-4, 3e-5
SENSOR = Sensor("gyro", {"scale_factor": {"s": [0.01, 0.0, -0.02]}})
ALARM = 1e-4


def log(n: int = 900, seed: int = 1, bias=(0.3, -0.1, 0.2), **more) -> Trial:
    """A log of the sensor above."""
    rng, time = np.random.default_rng(seed), H * np.arange(n)
    u = inputs(rng, time)
    return trial(time, u[:, :3] * [1.01, 1.0, 0.98] + bias + noise(rng, time, R, K2), u, **more)


def model_of(*trials: Trial) -> Fit:
    """The true model, its noise given, biases as they come."""
    return replace(begin(SENSOR, (), trials), noise={i: RandomWalk(R, K2) for i in range(3)})


def rows(t: Trial) -> np.ndarray:
    """Indices of the rows of a trial that count."""
    return np.concatenate([np.arange(a, b) for a, b in t.row_segments])


@pytest.fixture(scope="module")
def halves() -> tuple[Fit, Trial, Trial]:
    first, second = log().split(0.4)
    return model_of(first), first, second


def spread_of_mean_square(
    operator: np.ndarray, covariance: np.ndarray, draws: int
) -> tuple[float, float]:
    """Mean square of ``operator @ noise`` and the standard deviation of its average over draws:
    traces of C and of C C.
    """
    c = operator @ covariance @ operator.T
    return np.trace(c) / len(c), np.sqrt(2 * np.sum(c * c) / draws) / len(c)


@pytest.mark.parametrize(("r", "k2"), [(R, 0.0), (R, K2), (0.0, K2)])
def test_floor_is_what_the_covariance_of_the_noise_gives(halves, r, k2):
    fit, first, second = halves
    time = np.concatenate([first.time, second.time])
    covariance = r * np.eye(len(time)) + k2 * np.minimum.outer(time - time[0], time - time[0])
    held = np.eye(len(time))[len(first.time) + rows(second)]
    held -= np.eye(len(time))[rows(first)].mean(axis=0)
    found = unit_floor(fit, second).of({i: RandomWalk(r, k2) for i in range(3)})
    expected, std = spread_of_mean_square(held, covariance, 3 * FLOOR_DRAWS)
    assert abs(found.total**2 - expected) < norm.ppf(1 - ALARM / 2) * std
    length = round(WINDOW / H)
    windows = held[: len(held) // length * length].reshape(-1, length, len(time)).sum(axis=1) * H
    expected, std = spread_of_mean_square(windows, covariance, 3 * FLOOR_DRAWS)
    assert abs(found.angle**2 - expected) < norm.ppf(1 - ALARM / 2) * std


def test_floor_of_white_noise_is_the_textbook_one(halves):
    """A mean of n rows taken off white noise of variance r leaves r (1 + 1/n)."""
    fit, first, second = halves
    count, n = 3 * FLOOR_DRAWS * len(rows(second)), len(rows(first))
    found = unit_floor(fit, second).of({i: RandomWalk(R, 0.0) for i in range(3)}).total ** 2 / (
        R * (1 + 1 / n)
    )
    assert abs(found - 1) < norm.ppf(1 - ALARM / 2) * np.sqrt(
        2 / count + 2 / (3 * FLOOR_DRAWS * n**2)
    )


def test_floor_of_each_axis_is_that_of_its_own_noise(halves):
    """Of variances, of white noise and walk apart: the same draws serve noise of any size."""
    fit, _, second = halves
    floor = unit_floor(fit, second)
    both = floor.of({0: RandomWalk(R, 0.0), 1: RandomWalk(0.0, K2), 2: RandomWalk(4 * R, 9 * K2)})
    white, walk = (floor.of(dict.fromkeys(range(3), RandomWalk(*n))) for n in ((R, 0), (0, K2)))
    for name in ("squares", "angle_squares"):
        parts = [getattr(one, name) for one in (white, walk)]
        expected = [parts[0][0], parts[1][1], 4 * parts[0][2] + 9 * parts[1][2]]
        np.testing.assert_allclose(getattr(both, name), expected, rtol=1e-12)
    np.testing.assert_array_equal(both.rows, white.rows)


def test_true_model_reaches_the_floor(halves):
    fit, _, second = halves
    scores = []
    for seed in range(20):
        one, two = log(seed=seed).split(0.4)
        scores.append(tally(model_of(one), two).total ** 2)
    expected = unit_floor(fit, second).of(fit.noise).total ** 2
    assert abs(np.mean(scores) - expected) < 4.5 * np.std(scores, ddof=1) * np.sqrt(
        1 / 20 + 1 / FLOOR_DRAWS
    )


def test_state_of_held_out_rows_comes_from_the_fitted_rows_of_the_log(halves):
    fit, first, second = halves
    state, rest = held_state(fit, second)
    left = first.y - first.u[:, :3] * [1.01, 1.0, 0.98]
    np.testing.assert_allclose(state.bias, left[rows(first)].mean(axis=0), rtol=1e-12)
    assert rest is second
    np.testing.assert_array_equal(
        held_state(fit, replace(second, y=second.y + 1.0))[0].bias, state.bias
    )


def test_mounting_of_held_out_rows_is_that_of_the_log():
    turn = Rotation.from_euler("xyz", [10, 20, 30], degrees=True)
    t = log(free_rotation=True)
    first, second = replace(t, y=turn.apply(t.u[:, :3])).split(0.4)
    fit = model_of(first)
    assert fit.states["log"].rotation is held_state(fit, second)[0].rotation


def test_state_of_a_log_of_its_own_comes_from_its_first_half_minute():
    fit, held = model_of(log(name="fitted")), log(seed=2, name="held", bias=(1.0, 2.0, 3.0))
    state, rest = held_state(fit, held)
    first = rows(held)
    first = first[held.time[first] < HEAD]
    left = held.y - held.u[:, :3] * [1.01, 1.0, 0.98]
    np.testing.assert_allclose(state.bias, left[first].mean(axis=0), rtol=1e-9)
    assert rest.time[0] == pytest.approx(HEAD) and len(rest.time) == len(held.time) - round(
        HEAD / H
    )


def test_mounting_of_a_log_of_its_own_is_found_in_its_first_half_minute():
    fit = model_of(log(name="fitted", free_rotation=True))
    turn = Rotation.from_rotvec([0.02, -0.03, 0.01])
    held = log(seed=2, name="held", free_rotation=True)
    y = turn.apply(held.u[:, :3]) * [1.01, 1.0, 0.98] + noise(
        np.random.default_rng(3), held.time, R, 0.0
    )
    found = Rotation.from_matrix(held_state(fit, replace(held, y=y))[0].rotation)
    # 268 rows at an RMS of 0.5 rad/s about either axis beside it.
    assert (found * turn.inv()).magnitude() < 4.5 * np.sqrt(3 * R / (268 * 0.5))


def test_head_rows_are_not_scored():
    """A disturbance of the head that its mean, and so the bias, does not see changes nothing."""
    fit, held = model_of(log(name="fitted")), log(seed=2, name="held")
    head = rows(held)
    head = head[held.time[head] < HEAD]
    spoilt = np.array(held.y)
    spoilt[head] += (
        np.where(np.arange(len(head)) % 2, 5.0, -5.0)[:, None]
        * (np.arange(len(head)) < len(head) // 2 * 2)[:, None]
    )
    before, after = tally(fit, held), tally(fit, replace(held, y=spoilt))
    np.testing.assert_allclose(after.squares, before.squares, rtol=1e-9)
    rest = held_state(fit, held)[1]
    np.testing.assert_array_equal(before.rows, len(rows(rest)))


def test_angle_over_windows_is_a_plain_loop():
    rng = np.random.default_rng(4)
    t = log(n=1200, segments=[(0, 500), (520, 610), (640, 1200)], axes=(0, 2))
    r = rng.standard_normal((len(rows(t)), 3))
    found, length = sums(t, r), round(WINDOW / H)
    angle, windows, at = np.zeros(3), np.zeros(3), 0
    for a, b in t.row_segments:
        for start in range(at, at + (b - a) - length + 1, length):
            for i in (0, 2):
                angle[i] += sum(r[k, i] * H for k in range(start, start + length)) ** 2
                windows[i] += 1
        at += b - a
    np.testing.assert_allclose(found.angle_squares, angle, rtol=1e-10)
    np.testing.assert_array_equal(found.windows, windows)
    np.testing.assert_allclose(found.squares, np.sum(r**2, axis=0) * [1, 0, 1], rtol=1e-12)


def test_tallies_add_up_and_axes_without_rows_have_no_number():
    rng = np.random.default_rng(5)
    one, two = log(n=400, axes=(0, 2)), log(n=700, axes=(0, 2))
    a, b = (rng.standard_normal((len(rows(t)), 3)) for t in (one, two))
    total = sums(one, a) + sums(two, b)
    both = np.concatenate([a, b])[:, [0, 2]]
    np.testing.assert_allclose(total.per_axis[[0, 2]], np.sqrt(np.mean(both**2, axis=0)))
    assert np.isnan(total.per_axis[1]) and total.total == pytest.approx(np.sqrt(np.mean(both**2)))
    assert np.isnan(ErrorSums().total) and np.isnan(ErrorSums().angle)


def test_log_likelihood_is_the_dense_gaussian_one(halves):
    fit, _, second = halves
    state = held_state(fit, second)[0]
    at = rows(second)
    since = second.time[at] - second.time[at[0]]
    covariance = R * np.eye(len(at)) + K2 * np.minimum.outer(since, since)
    left = (second.y - second.u[:, :3] * [1.01, 1.0, 0.98] - state.bias)[at]
    expected = -0.5 * (
        np.sum(left * np.linalg.solve(covariance, left))
        + 3 * np.linalg.slogdet(2 * np.pi * covariance)[1]
    )
    assert tally(fit, second).log_likelihood == pytest.approx(expected, rel=1e-9)


def test_bias_of_a_state_is_what_the_score_takes_off(halves):
    fit, _, second = halves
    found = held_state(replace(fit, states={"log": LogState(np.full(3, 99.0))}), second)[0]
    np.testing.assert_allclose(found.bias, held_state(fit, second)[0].bias, rtol=1e-12)
