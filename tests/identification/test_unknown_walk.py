"""Standard errors of slow coefficients beside a random walk that nobody declared."""

import numpy as np
import pytest
from loop_cases import STATE_NAMES, inputs, noise, trial
from scipy.stats import binom, norm

from pyimu.identification.fit.fit import begin
from pyimu.identification.fit.keys import coefficients_of
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.fit.walk import widening, with_unknown_walk
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS

H, ROWS, R = 0.1, 1500, 1e-4
LEAST = binom.ppf(1e-4, 40 * 3, 0.95)
"""Of the intervals of so many models and axes that hold."""


def fitted(seed: int, k2: float, declared: float = 0.0):
    """A ramp of no size fitted to still rows that walk."""
    time = H * np.arange(ROWS)
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
