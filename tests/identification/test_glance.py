"""What columns explain at first glance, beside what all their products say."""

from dataclasses import replace

import numpy as np
import pytest
from loop_cases import inputs, noise, trial

from pyimu.identification.fit.errors_in_variables import equations
from pyimu.identification.fit.fit import begin, with_prior
from pyimu.identification.fit.glance import Glance
from pyimu.identification.fit.keys import Coefficient, Shape, coefficients_of
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.fit.whiten import RandomWalk
from pyimu.identification.formula.columns import columns_of
from pyimu.identification.formula.terms import library
from pyimu.identification.search.form import UNUSED
from pyimu.identification.search.instants import _AnyStep, _by_equations, _gain
from pyimu.identification.search.projected import Projected
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS

SIGMA, WALK = 1e-3, 1e-9
ROUNDING = 1e-8
"""Share by which sums of some thousand products, in another order, may differ once all but DEAD of
a column's power is taken off."""


@pytest.fixture
def fitted():
    """A gyro with a scale factor that is known beforehand to some percent, in two logs."""
    rng, logs = np.random.default_rng(3), []
    for k, rows in enumerate((4000, 2500)):
        time = np.arange(rows) * 0.01
        u = inputs(rng, time)
        u[:, COLUMNS["time"].start] = time
        y = 1.001 * u[:, :3] + noise(rng, time, SIGMA**2, WALK)
        logs.append(trial(time, y, u, name=f"log{k}"))
    sensor = Sensor("gyro", {"turn_on_bias": {"b0": [0.0] * 3}}).with_values("scale_factor")
    free = coefficients_of(sensor, "scale_factor")
    return fit(begin(sensor, free, logs, dict.fromkeys(free, 0.03)))


def test_a_glance_sees_what_the_equations_of_all_columns_say(fitted):
    terms = [t for t in library("gyro", fitted.trials) if len(t.code) == 1][:60]
    columns = [columns_of("gyro", terms)]
    normal = with_prior(equations(fitted, lambda f: f.beside(f.linearise(), columns)), fitted)
    places = {k: i for i, k in enumerate(normal.keys) if isinstance(k, Shape)}
    model = [i for i, k in enumerate(normal.keys) if not isinstance(k, Shape)]
    projected = Projected.of(normal, model, list(places.values()))
    power = np.diag(projected.gram)
    seen = power > 0.0
    wanted = projected.score[seen] ** 2 / power[seen]
    found = Glance.of(fitted).explained(columns)
    assert list(found) == [k for k, s in zip(places, seen, strict=True) if s]
    np.testing.assert_allclose(list(found.values()), wanted, ROUNDING, ROUNDING)


def test_any_step_is_known_by_what_lies_behind_it(fitted):
    """Steps in one of the logs, in both, before the first row and behind the last."""
    count = CATALOGUE["bias_step"].parameters["t0"].shape[0]
    instants = np.array([12.0, *[UNUSED] * (count - 1)])
    sensor = fitted.sensor.with_values("bias_step", t0=instants, A=1e-3 * np.ones((3, count)))
    own = {i: Coefficient("bias_step", "A", (i, 0)) for i in (0, 2)}
    started = replace(fitted, sensor=sensor, free=fitted.free | {*own.values()}).with_noise()
    times = np.array([-1.0, 0.0, 3.005, 24.0, 25.5, 39.9, 50.0])
    key = Coefficient("bias_step", "t0", (0,))
    model, steps = _AnyStep(started, Glance.of(started), own)(times)
    same, wanted = _by_equations(started, started.linearise(), key, own, times)
    assert model.keys == same.keys
    np.testing.assert_allclose(model.gram, same.gram, 1e-12)
    for i in own:
        for found, to in zip(steps[i], wanted[i], strict=True):
            np.testing.assert_allclose(found, to, ROUNDING, ROUNDING * np.abs(to).max())
        gains = [_gain(m, own[i], 1e-3, s[i]) for m, s in ((model, steps), (same, wanted))]
        np.testing.assert_allclose(*gains, 1e-6, 1e-6)


def test_the_way_back_is_the_transpose_of_the_filter():
    """<F a, b> = <a, F' b> for any a and b, steps between rows of any length."""
    rng = np.random.default_rng(1)
    time = np.cumsum(rng.uniform(0.5, 1.5, 50))
    there, back = (RandomWalk(1.0, 0.3).filter(time, []) for _ in range(2))
    a, b = rng.standard_normal((2, 50, 3))
    np.testing.assert_allclose(there.next(a).T @ b, a.T @ back.back(b), 1e-12, 1e-12)


@pytest.mark.parametrize("count", [1, 3, 4, 7])
def test_powers_are_those_of_white_columns(count):
    rng, time = np.random.default_rng(2), np.arange(90) * 0.01
    columns = rng.standard_normal((90, count))
    walk = RandomWalk(1.0, 20.0)
    white, parts = walk.whiten(columns, time, []), walk.filter(time, [])
    found = sum(parts.powers(np.ascontiguousarray(some.T)) for some in np.split(columns, [40]))
    np.testing.assert_allclose(found, np.sum(white**2, axis=0), 1e-12)
    for one, power in zip(columns.T, found, strict=True):
        assert walk.filter(time, []).power(np.array(one)) == pytest.approx(power, 1e-12)
