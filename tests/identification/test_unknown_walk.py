"""Standard errors of slow coefficients beside a random walk that nobody declared."""

from dataclasses import replace

import numpy as np
import pytest
from loop_cases import STATE_NAMES, inputs, noise, trial
from scipy.stats import binom, norm

from pyimu.identification.fit import walk
from pyimu.identification.fit.fit import begin
from pyimu.identification.fit.keys import coefficients_of
from pyimu.identification.fit.maximum_likelihood import _likelihood as likelihood
from pyimu.identification.fit.maximum_likelihood import advantage, fit
from pyimu.identification.fit.walk import widening, with_unknown_walk
from pyimu.identification.search.by_chance import Chance
from pyimu.identification.search.choice import Tried
from pyimu.identification.search.screen import PENALTY
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS

H, ROWS, LONG, R = 0.1, 1500, 30_000, 1e-4
LEAST = binom.ppf(1e-4, 40 * 3, 0.95)
"""Of the intervals of so many models and axes that hold."""


def fitted(seed: int, k2: float, declared: float = 0.0, rows: int = ROWS):
    """A ramp of no size fitted to still rows that walk."""
    time = H * np.arange(rows)
    u = inputs(np.random.default_rng(5), time)
    u[:, COLUMNS["time"]] = time[:, None]
    y = u[:, :3] + noise(np.random.default_rng(seed), time, R, k2)
    walk = {"rate_random_walk": {"K": np.sqrt(declared)}} if declared else {}
    sensor = Sensor("gyro", walk).with_values("rate_ramp")
    log = trial(time, y, u, known=STATE_NAMES | {"time"})
    return fit(begin(sensor, coefficients_of(sensor, "rate_ramp"), [log]))


def ramps(model) -> np.ndarray:
    """Estimate over its standard error of the three axes; the truth is none."""
    keys = coefficients_of(model.sensor, "rate_ramp")
    return np.array([model.sensor.values["rate_ramp"]["R"][k.index] / model.std[k] for k in keys])


@pytest.mark.parametrize("k2", [1e-7, 1e-6, 1e-5])
def test_intervals_hold_beside_a_walk_that_is_not_known(k2):
    """95 of 100, and no fewer than chance allows."""
    assert inside(with_unknown_walk(fitted(100 + n, k2)) for n in range(40)) >= LEAST


def test_a_fitted_walk_alone_makes_them_too_narrow():
    """Where it is small, and the ramp takes it for its own."""
    assert inside(fitted(100 + n, 1e-7) for n in range(40)) < LEAST


def inside(models) -> int:
    """How many of the estimates have the truth in their intervals."""
    return int(np.sum(np.abs([ramps(m) for m in models]) <= norm.ppf(0.975)))


def test_a_declared_walk_is_known():
    assert widening(fitted(1, 1e-6, declared=4e-6)) == {}


def test_means_of_rows_say_of_a_walk_what_rows_do(monkeypatch):
    """Where the walk is small and well known rows are put together; what it moves within a mean
    adds 0.003 to the mean's variance at most, and so half as much to a standard error.
    """
    model, seen = fitted(3, 1e-9, rows=LONG), []
    taken = walk.normal_equations

    def counted(linears, noise):
        seen.append(len(linears[0].time))
        return taken(linears, noise)

    monkeypatch.setattr(walk, "normal_equations", counted)
    by_means = widening(model)
    assert max(seen) <= LONG / 2
    monkeypatch.setattr(walk, "many_rows", lambda log_ratio: 1)
    by_rows = widening(model)
    assert max(seen) > LONG / 2
    assert by_means == pytest.approx(by_rows, rel=0.0015)


LOGS = 30


def without_ramp(seed: int, k2: float, declared: float = 0.0):
    """The same rows without the ramp in the model."""
    model = fitted(seed, k2, declared)
    return fit(begin(model.sensor.without("rate_ramp"), frozenset(), list(model.trials)))


@pytest.mark.long
def test_a_ramp_is_charged_for_what_it_gains_beside_a_walk_that_is_not_known():
    """What it explains more than in one of a hundred logs without one, it explains in no more than
    that; at worst the best of three axes gains 3.5 nat more there (draws of walks by hand), and by
    what a residual says of its walk less. Beside a declared walk there is nothing to charge.
    """
    rng = np.random.default_rng(1)
    known = np.maximum(0.5 * rng.standard_normal((100_000, 3)) ** 2 - PENALTY, 0.0).sum(axis=1)
    least, gains, tolls = np.quantile(known, 0.99), [], []
    for seed in range(LOGS):
        tried = Tried(without_ramp(200 + seed, 2e-7), ())
        tried.views = tried.views[-1:]  # the one for slow effects
        seen = {c.effect: c for c in tried.looked()[0].candidates}
        found = tried.refine(seen["rate_ramp"])
        gains.append(found.gain)
        tolls.append(found.screened.toll)
    assert np.sum(np.array(gains) > least) <= binom.ppf(1 - 1e-4, LOGS, 0.01)
    assert 0.5 < np.mean(tolls) < 4.0
    declared = without_ramp(7, 2e-7, declared=1e-6)
    columns = declared.linearise(["rate_ramp"])
    assert Chance(declared, declared.linearise(), PENALTY).toll(columns, "rate_ramp") < 0.5


def test_a_walk_that_an_effect_took_for_its_own_is_judged_with_one():
    """Beside a derived reference the noise is an autoregression, and its walk no more than about
    likely: that of the larger model, which has none left, is the likelier one beside a walk.
    """
    time = H * np.arange(4000)
    u = inputs(np.random.default_rng(5), time)
    u[:, COLUMNS["time"]] = time[:, None]
    y = u[:, :3] + noise(np.random.default_rng(8), time, R, 1e-7)
    log = trial(time, y, u, known=STATE_NAMES | {"time"}, band_hz=1.0)
    sensor = Sensor("gyro").with_values("rate_ramp")
    smaller = fit(begin(Sensor("gyro"), frozenset(), [log]))
    larger = with_walk(fit(begin(sensor, coefficients_of(sensor, "rate_ramp"), [log])), 0.0)
    most = max(with_walk(replace(smaller, noise=larger.noise), k2).log_likelihood for k2 in SIZES)
    far_off = with_walk(smaller, 1e-5)
    assert larger.log_likelihood - most < larger.log_likelihood - far_off.log_likelihood - 10.0
    # Sizes half as large each are off by a factor of 1.4 at most, of a curvature of some 5.
    assert advantage(larger, far_off) == pytest.approx(larger.log_likelihood - most, abs=1.0)


SIZES = 1e-5 * 2.0 ** -np.arange(16)


def with_walk(model, k2: float):
    """The model beside its noise with another walk, and how likely it is."""
    noises = {i: replace(n, k2=k2) for i, n in model.noise.items()}
    return replace(model, noise=noises, log_likelihood=likelihood(replace(model, noise=noises)))
