"""Whether a named effect is the same everywhere: what resembles one is another from minute to
minute, is bent, or has a memory; and whether a residual follows a signal by a share that wanders.
"""

from types import SimpleNamespace

import numpy as np
import pytest
from effect_logs.cases import make
from effect_results.record import closed
from loop_cases import STATE_NAMES, inputs, noise, trial
from scipy.stats import kstest

from pyimu.identification.fit.fit import begin
from pyimu.identification.fit.keys import coefficients_of
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.formula import constancy
from pyimu.identification.formula.constancy import WAYS, less_inconstant
from pyimu.identification.formula.terms import simple
from pyimu.identification.formula.wandering import _followed, wandering
from pyimu.identification.search.investigation import Step
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS

TIME = np.arange(6000) * 0.01
LONG = np.arange(6000) * 0.08
SIGMA, WALK = 1e-3, 1e-9
SIZE = 2e-4
"""(rad/s)/(m/s^2), by which the force of these logs is some 30 standard errors beside the noise."""

IN_TIME, BENT, AGO = WAYS
SHARES = {
    "as it is": lambda f: f,
    IN_TIME: lambda f: f * np.cos(2 * np.pi * TIME / TIME[-1])[:, None],
    BENT: lambda f: np.maximum(f, 0.0),
    AGO: lambda f: np.roll(f, 30, axis=0),
}


def fitted(seed, share="as it is", beside=0.0):
    """A gyro fitted with a g-sensitivity where the force's own axis acts in one of some ways, and
    ``beside`` as it is, with the gain [nat] of that.
    """
    rng = np.random.default_rng(seed)
    u = inputs(rng, TIME)
    force = u[:, OWN["accel"]]
    there = SHARES[share](force - force.mean(axis=0)) + beside * force
    y = u[:, OWN["gyro"]] + SIZE * there + noise(rng, TIME, SIGMA**2, WALK)
    bare = Sensor("gyro", {"turn_on_bias": {"b0": [0.0] * 3}})
    free = coefficients_of(bare, "g_sensitivity")
    before = fit(begin(bare, frozenset(), [trial(TIME, y, u)], {}))
    after = fit(begin(bare.with_values("g_sensitivity"), free, [trial(TIME, y, u)], {}))
    return after, after.log_likelihood - before.log_likelihood


def judged(monkeypatch, after, gain):
    """What is said of the g-sensitivity of a fit, and whether it is taken back."""
    keys = coefficients_of(after.sensor, "g_sensitivity")
    step = Step("g_sensitivity", keys, gain, 0.0, (), 1.0)
    taken = []

    def without(inv, effect, reason):
        taken.append(reason)
        return inv

    monkeypatch.setattr(constancy, "without", without)
    found = less_inconstant(SimpleNamespace(after=after, steps=(step,)))
    return found.unexplained, taken


def test_what_is_constant_varies_by_chance():
    """The p-values of the clearest of three axes, made uniform; once in a thousand beyond this."""
    each = [constancy._found(fitted(seed)[0], ["g_sensitivity"]) for seed in range(12)]
    chances = [1.0 - (1.0 - s.p_value) ** 3 for one in each for s in one.values()]
    assert len(chances) == 12 * len(WAYS)
    assert kstest(chances, "uniform").pvalue > 1e-3


def test_an_effect_of_a_sensor_stays(monkeypatch):
    assert judged(monkeypatch, *fitted(30)) == ((), [])


@pytest.mark.parametrize("way", WAYS)
def test_what_is_no_constant_is_no_effect(monkeypatch, way):
    after, gain = fitted(31, way, beside=0.0 if way == BENT else 0.3)
    (said,), taken = judged(monkeypatch, after, gain)
    assert said.shape == f"an error like g_sensitivity, but {way}"
    assert taken == [f"it is {way}"]


def test_a_rest_of_an_effect_leaves_it_there(monkeypatch):
    """A twentieth of the power of an effect and more that is there."""
    after, gain = fitted(32, IN_TIME, beside=5.0)
    (said,), taken = judged(monkeypatch, after, gain)
    assert said.shape == f"a rest of g_sensitivity, {IN_TIME}" and not taken


def beside_phase(seed, drifts):
    """A gyro beside a bias of some 30 standard errors that goes round with the angle turned about
    z, by a phase that drifts, or not at all.
    """
    rng, time = np.random.default_rng(seed), LONG
    u = inputs(rng, time)
    u[:, 2] += 0.5
    u[:, COLUMNS["turned"]] = np.cumsum(u[:, OWN["gyro"]], axis=0) * time[1]
    phase = 2 * u[:, [COLUMNS["turned"].start + 2]] + 2 * np.pi * drifts * time[:, None] / time[-1]
    y = u[:, OWN["gyro"]] + noise(rng, time, SIGMA**2, WALK)
    if drifts:
        y += 6e-4 * np.sin(phase)
    bare = Sensor("gyro", {"turn_on_bias": {"b0": [0.0] * 3}})
    known = STATE_NAMES | {"turned"}
    return fit(begin(bare, frozenset(), [trial(time, y, u, known=known)], {}))


def test_noise_follows_signals_by_chance():
    """A term in a hundred is by one chance in a hundred. Many are much the same: three in a hundred
    are by chance as where each has some four others' equal (Poisson, 12 axes of some 80 terms).
    """
    logs = [beside_phase(seed, 0.0) for seed in range(4)]
    assert not any(wandering(one) for one in logs)
    terms = {t.text: t for t in simple("gyro", logs[0].trials)}
    each = [_followed(one, i, terms) for one in logs for i in range(3)]
    chances = np.array([f.chance for found in each for f in found])
    assert np.mean(chances < 0.01) < 0.03


def test_a_phase_that_drifts_is_followed():
    (x, y, z) = wandering(beside_phase(40, 5.0))
    assert [u.axis for u in (x, y, z)] == ["x", "y", "z"]
    assert all("angle turned about" in u.shape and "wanders" in u.shape for u in (x, y, z))


@pytest.mark.long
def test_a_line_whose_frequency_wanders_is_not_named():
    found = closed(make("strange/30/gyro.wandering_line", 488, (5.0, 6.0)))
    assert not found.added, found.report()
