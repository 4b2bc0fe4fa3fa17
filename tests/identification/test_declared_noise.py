"""The noise that a part declares is what its residual is judged by, until the data say more."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.signal import lfilter
from world import K_ACCEL, K_GYRO, N_ACCEL, N_GYRO, changes, drive, recording, size_for

import pyimu
from pyimu.identification.fit.columns import Linear
from pyimu.identification.fit.fit import whitened
from pyimu.identification.fit.whiten import Autoregressive, RandomWalk
from pyimu.identification.search.confirm import Evidence, _Drift
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor


def declared(k_gyro=K_GYRO) -> Part:
    gyro = {"angle_random_walk": {"N": N_GYRO}, "rate_random_walk": {"K": k_gyro}}
    accel = {"angle_random_walk": {"N": N_ACCEL}, "rate_random_walk": {"K": K_ACCEL}}
    return Part("noise", 50.0, Sensor("gyro", gyro), Sensor("accel", accel))


@pytest.fixture(scope="module")
def world():
    return drive(minutes=3, seed=8)


@pytest.mark.long
@pytest.mark.parametrize("name", ["thermal_bias", "temperature_rate"])
def test_a_slow_effect_is_no_drift_where_the_walk_is_declared(world, name):
    """Over the declared noise 12 sigmas gain 72 nat, half of them on the fitted rows; a walk that
    is fitted to it takes most of those.
    """
    change = changes(world, "gyro")[name](size_for(world, "gyro", name, 12.0, False))
    log = recording(world, gyro_change=change, seed=21, kinds=("gyro",))
    closed = pyimu.close(log, declared())
    assert name in {a.effect for a in closed.added}, closed.report()


@pytest.mark.long
@pytest.mark.parametrize("name", ["thermal_bias", "temperature_rate"])
def test_a_slow_effect_is_seen_beside_a_walk_that_nobody_declared(name):
    """Ten sigmas gain 50 nat over the walk that there is, a third of them on the held-out rows; by
    the walk that was fitted in their place they gain nothing.
    """
    world = drive(minutes=6, seed=8)
    change = changes(world, "gyro")[name](size_for(world, "gyro", name, 10.0, True))
    closed = pyimu.close(recording(world, gyro_change=change, seed=40, kinds=("gyro",)))
    assert {a.effect for a in closed.added} == {name}, closed.report()


@pytest.mark.long
def test_a_walk_that_is_larger_than_declared_is_drift_and_no_slow_effect(world):
    rng = np.random.default_rng(24)
    steps = 20 * K_GYRO * np.sqrt(world.h) * rng.standard_normal(world.rate.shape)
    walk = np.cumsum(steps, axis=0)
    log = recording(world, gyro_change=lambda v: v + walk, seed=22, kinds=("gyro",))
    closed = pyimu.close(log, declared())
    assert not closed.added, closed.report()
    assert closed.verdict == "drift"


@pytest.mark.long
def test_of_a_matrix_the_entries_go_in_that_the_data_show(world):
    """One entry of nine at 10 sigmas: 50 nat, of which its penalty is 3, that of nine 27."""
    force = world.force[:, 2] - world.force[:, 2].mean()
    white = N_GYRO[0] / np.sqrt(world.h)
    size = 10.0 * white / np.sqrt(0.7 * len(force)) / force.std()
    more = size * world.force[:, 2:] * [1.0, 0.0, 0.0]
    closed = pyimu.close(
        recording(world, gyro_change=lambda v: v + more, seed=23, kinds=("gyro",)), declared()
    )
    (found,) = closed.added
    assert found.effect == "g_sensitivity", closed.report()
    value = found.parameters["G"][0]
    assert np.flatnonzero(value).tolist() == [2]


@pytest.mark.parametrize("k2", [0.0, 3e-3])
def test_variance_along_is_that_of_the_dense_covariance(k2):
    rng = np.random.default_rng(1)
    time, values = np.cumsum(rng.uniform(0.5, 1.5, 40)), rng.standard_normal(40)
    since = time - time[0]
    covariance = 2.0 * np.eye(40) + k2 * np.minimum.outer(since, since)
    found = RandomWalk(2.0, k2).variance_along(values, time, [(0, 40)])
    assert_allclose(found, values @ covariance @ values, rtol=1e-12)


def test_a_walk_before_the_held_out_rows_is_part_of_their_chance():
    """Against the covariance of a walk's level less its mean over 300 rows before; the sum over
    rows differs from the integral by one in 300.
    """
    before, rows, values = 300, 40, np.random.default_rng(5).standard_normal(40) + 0.3
    step = np.eye(before + rows)
    level = np.cumsum(step, axis=0)
    error = level[before:] - level[:before].mean(axis=0)
    noise = RandomWalk(2.0, 0.5, before=before / 3.0)
    found = noise.variance_along(values, np.arange(40.0), [(0, 40)])
    covariance = 2.0 * np.eye(40) + 0.5 * (before / 3.0 + np.minimum.outer(*[np.arange(40)] * 2))
    white = noise.whiten(np.eye(40), np.arange(40.0), [(0, 40)])
    assert_allclose(white @ covariance @ white.T, np.eye(40), atol=1e-9)
    want = 2.0 * values @ values + 0.5 * np.sum((error.T @ values) ** 2)
    assert_allclose(found, want, rtol=2 / before)


def test_variance_along_an_autoregression_is_that_of_its_filter():
    rng = np.random.default_rng(2)
    values, taps = rng.standard_normal(60), [0.6, -0.2]
    response = lfilter([1.0], [1.0, -taps[0], -taps[1]], np.eye(60), axis=0)
    noise = Autoregressive(tuple(taps), 3.0)
    found = noise.variance_along(values, np.arange(60.0), [(0, 60)])
    assert_allclose(found, 3.0 * np.sum((response.T @ values) ** 2), rtol=1e-10)


def test_surprise_is_standard_normal_where_the_new_model_is_true():
    """Old less new sum of squares is the square between them less twice its product with noise."""
    rng, between, surprises = np.random.default_rng(3), np.linspace(-0.1, 0.1, 500), []
    for _ in range(400):
        noise = rng.standard_normal(500)
        held = np.zeros((2, 3))
        held[:, 0] = np.sum((noise - between) ** 2), np.sum(noise**2)
        apart, chance = np.zeros(3), np.zeros(3)
        apart[0] = np.sum(between**2)
        chance[0] = RandomWalk(1.0, 0.0).variance_along(between, np.arange(500.0), [(0, 500)])
        one = Evidence(np.zeros(3), np.zeros(3), apart, chance, held, held, held, None)
        surprises.append(one.surprise)
    # Four standard errors of mean and variance.
    assert abs(np.mean(surprises)) < 4 / np.sqrt(400)
    assert abs(np.var(surprises) - 1.0) < 4 * np.sqrt(2 / 400)


@pytest.mark.parametrize(("surprise", "ends", "raises"), [(3.5, 3.0, True), (3.5, 4.0, False)])
def test_a_rise_is_by_chance_up_to_where_chance_ends(surprise, ends, raises):
    """Of an error of 1 that rises to ``surprise`` standard errors of the change of it."""
    one = np.array([1.0, 0.0, 0.0])
    held = np.array([100.0 * one, (100.0 + 2.0 * surprise - 1.0) * one])
    seen = Evidence(-one, one, one, one, held, held, held, None, chance_ends=ends)
    assert seen.surprise == pytest.approx(surprise) and seen.raises == raises


def test_what_a_drift_may_be_is_taken_from_held_out_rows():
    """The square that is left is that of noise to whose covariance the drift's is added (Woodbury),
    of white noise and a walk alike.
    """
    rng, n = np.random.default_rng(11), 60
    time = np.arange(n) * 0.01
    noise = {0: RandomWalk(2.0, 30.0)}
    rows = [Linear(time, [(0, n)], rng.standard_normal((n, 3)), {0: []}, {}) for _ in range(2)]
    change, left = rows
    found = _Drift(noise, change).taken_from(left)
    steps = np.minimum(time[:, None], time)
    covariance = 2.0 * np.eye(n) + 30.0 * steps
    covariance += np.outer(change.residual[:, 0], change.residual[:, 0])
    r = left.residual[:, 0]
    assert whitened(noise[0], found, 0) == pytest.approx(r @ np.linalg.solve(covariance, r), 1e-4)
    assert _Drift(noise).taken_from(left) is left
