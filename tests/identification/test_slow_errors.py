"""Slow errors beside a reference that is derived from an attitude, whose noise is an autoregression
and a random walk.
"""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.signal import lfilter
from scipy.spatial.transform import Rotation
from turns import turned
from world import drive, recording

import pyimu
from pyimu.identification.fit.columns import Linear
from pyimu.identification.fit.noise_fit import less_levels
from pyimu.identification.fit.whiten import Autoregressive, RandomWalk

WARMTH = np.array([3e-4, -2e-4, 1e-4])
"""rad/s/K: up to 0.3 deg/s over a log that warms by 18 K, five times what is left otherwise."""

FINER = 8
"""Samples for one of the log: their mean rates miss a motion of 2.5 Hz by (w h)^2 / 12 = 5e-4."""


@pytest.fixture(scope="module")
def world():
    """A motion of up to 2.5 Hz during which the part warms up."""
    made = drive(minutes=4, rate_hz=25, seed=12)
    return replace(made, temperature=25.0 + 20.0 * (1.0 - np.exp(-made.time / 90.0)))


def against_attitude(world, change, seed: int):
    """A log of the gyro whose reference is an attitude to 0.2 mrad."""
    rng = np.random.default_rng(seed)
    fine = drive(minutes=4, rate_hz=25 * FINER, seed=12)
    steps = 0.5 * (fine.rate[1:] + fine.rate[:-1]) * fine.h
    attitude = turned(Rotation.from_rotvec(steps))[::FINER]
    noise = Rotation.from_rotvec(2e-4 * rng.standard_normal(world.rate.shape))
    ref_q = (attitude * noise).as_quat(scalar_first=True)
    log = recording(world, gyro_change=change, seed=seed, kinds=("gyro",))
    return replace(log, ref_rate=None, ref_force=None, ref_q=ref_q)


def test_what_goes_with_temperature_is_named_beside_an_attitude(world):
    """It was whitened away with what its past predicts; coefficients to four standard errors."""
    warmth = (world.temperature - 25.0)[:, None] * WARMTH
    closed = pyimu.close(against_attitude(world, lambda x: x + warmth, seed=5))
    (added,) = closed.added
    assert added.effect == "thermal_bias", closed.report()
    value, std, _ = added.parameters["kT"]
    assert np.all(np.abs(value - WARMTH) < 4 * std) and np.all(std < np.abs(WARMTH) / 3)


@pytest.mark.parametrize("k, seed", [pytest.param(3e-5, 6, marks=pytest.mark.long), (3e-4, 7)])
def test_a_bias_that_walks_is_no_slow_error_beside_an_attitude(world, k, seed):
    steps = np.random.default_rng(seed).standard_normal(world.rate.shape)
    walk = np.cumsum(k * np.sqrt(world.h) * steps, axis=0)
    closed = pyimu.close(against_attitude(world, lambda x: x + walk, seed=seed))
    assert not closed.added and not closed.formulas, closed.report()


def test_prediction_errors_are_freed_of_the_walk_that_they_show():
    """The noise is a filter of white noise and a walk: its inverse leaves both, and what whitens
    these the rest.
    """
    rng, n, r, k2 = np.random.default_rng(3), 400, 2.5, 0.3
    coefficients = (0.5, 0.2)
    time = 0.1 * np.arange(n)
    made = Autoregressive(coefficients, r, k2=k2)
    both = rng.standard_normal((n, 1))
    both += np.cumsum(np.sqrt(0.1 * made.walk.k2) * rng.standard_normal((n, 1)), axis=0)
    noise = np.sqrt(r) * lfilter([1.0], [1.0, *(-c for c in coefficients)], both, axis=0)
    found = made.whiten(noise, time, [(0, 150), (150, n)])
    seen = made.predicted(n, [(0, 150), (150, n)])
    assert seen.sum() == n - 4 and not found[~seen].any()
    whole = RandomWalk(1.0, made.walk.k2).whiten(both[seen], time[seen], [(0, seen.sum())])
    assert_allclose(found[seen], whole, atol=1e-9)
    slow = r / 0.3**2
    assert_allclose([made.slow.r, made.slow.k2, made.walk.k2], [slow, k2, k2 / slow])


@pytest.mark.parametrize("seed", [11, pytest.param(12, marks=pytest.mark.long)])
def test_a_step_is_no_noise_beside_an_attitude(world, seed):
    """It was what the past predicts, and whitened away. Its instant to four periods of the band's
    rows, of which each holds both levels for as long; its size to four standard errors.
    """
    step, at = np.array([np.radians(0.1), 0.0, 0.0]), world.time[0] + 101.0
    stepped = (world.time > at)[:, None] * step
    closed = pyimu.close(against_attitude(world, lambda x: x + stepped, seed=seed))
    (added,) = closed.added
    assert added.effect == "bias_step", closed.report()
    (value, std, _), (instants, *_) = added.parameters["A"], added.parameters["t0"]
    assert abs(value[0, 0] - step[0]) < 4 * std[0, 0] and not value[1:].any()
    assert abs(instants[0] - 101.0) < 4 / closed.band_hz["gyro"]


def test_a_step_that_no_part_has_is_not_called_clean_beside_an_attitude(world):
    stepped = (world.time > world.time[0] + 101.0)[:, None] * np.radians([0.6, 0.0, 0.0])
    closed = pyimu.close(against_attitude(world, lambda x: x + stepped, seed=13))
    assert closed.verdict == "not_confirmed" and "bias_step" in closed.reason, closed.report()
    assert "beyond belief" in closed.reason


@pytest.mark.long
@pytest.mark.parametrize("degrees, seed", [(0.1, 14), (0.6, 15)])
def test_a_step_in_a_gap_of_the_attitude_is_not_called_clean(world, degrees, seed):
    """Of a reference that begins anew no row is at the edge, and levels are all that is seen: in
    the rows of the larger step it is more than noise, of the smaller over seconds.
    """
    since = world.time - world.time[0]
    stepped = (since > 101.0)[:, None] * np.radians([degrees, 0.0, 0.0])
    log = against_attitude(world, lambda x: x + stepped, seed=seed)
    gap = (since > 100.0) & (since < 102.5)
    closed = pyimu.close(replace(log, ref_q=np.where(gap[:, None], np.nan, log.ref_q)))
    assert closed.verdict in ("named", "not_confirmed", "unexplained", "drift"), closed.report()
    assert all(a.effect == "bias_step" for a in closed.added)


@pytest.mark.parametrize("size", [0.0, 0.1, 5.0])
def test_an_autoregression_less_levels_predicts_no_step(size):
    """Noise of known colour, in two segments of which one has a step: density at its slow end. An
    autoregression of order p knows it with a variance of 4 p / n (Berk 1974), and a span of two
    memories leaves 1 - 1 / 2 of what is slower than one.
    """
    rng, n, coefficients = np.random.default_rng(21), 4000, (0.3, -0.4)
    noise = lfilter([1.0], [1.0, *(-c for c in coefficients)], rng.standard_normal(n))
    time, segments = 0.1 * np.arange(n), [(0, 1500), (1500, n)]
    left = noise + size * (time > 250.0)
    one = Linear(time, segments, left[:, None], {0: []}, {})
    whole = {0: Autoregressive.fit([(left, time, segments)])}
    found = less_levels([one], whole)[0]
    true = 1.0 / (1.0 - sum(coefficients)) ** 2
    assert 0.5 * true / 2.0 < found.slow.r < 2.0 * true
    assert size < 1.0 or whole[0].slow.r > 10.0 * true
