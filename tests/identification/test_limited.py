"""Samples where an output stops, in rows that a band makes of many."""

from dataclasses import replace

import numpy as np
import pytest
from loop_cases import inputs, noise, trial

from pyimu.identification.fit.bad_rows import repeated
from pyimu.identification.fit.columns import in_band, residual
from pyimu.identification.fit.fit import begin
from pyimu.identification.fit.inputs import LogState
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.fit.limited import with_limited
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.fit.trial import counted
from pyimu.identification.search.as_sampled import ceiling_of
from pyimu.identification.search.forward import investigate
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor

H, BAND = 0.01, 3.0
TIME = np.arange(9000) * H
FREE = frozenset(Coefficient("scale_factor", "s", (i,)) for i in range(3))


def clipped(seed=3, scale=0.0, share=0.05):
    """A gyro that stops for a ``share`` of its samples beside the rate of an attitude of white
    noise, 1 mrad, its levels (3,), and a mask (n, 3) of the samples that lie there.
    """
    rng = np.random.default_rng(seed)
    u = inputs(rng, TIME)
    y = (1.0 + scale) * u[:, OWN["gyro"]] + noise(rng, TIME, 0.003**2, 0.0)
    levels = np.quantile(np.abs(y), 1.0 - share, axis=0)
    angle = 1e-3 * rng.standard_normal((len(TIME) + 1, 3))
    u[:, OWN["gyro"]] += np.diff(angle, axis=0) / H
    made = trial(
        TIME,
        np.clip(y, -levels, levels),
        u,
        known=frozenset({"rate", "time"}),
        reference="attitude",
        band_hz=BAND,
        band_limit=BAND,
    )
    return made, levels, np.abs(y) >= levels


def test_what_stops_leaves_nothing_in_the_rows_about_it():
    """The mean of a noisy rate that stops is below where that of the mean does: no such rows."""
    made, levels, at = clipped()
    sensor, state = Sensor("gyro", {"saturation": {"limit": levels}}), LogState()
    known = with_limited(sensor, made)
    signs = np.sign(made.y)
    near = in_band(made, at.astype(float)) > 0.05
    sign = np.sign(in_band(made, signs))
    left = [in_band(t, residual(sensor, t, state)) * sign for t in (made, known)]
    for i in range(3):
        was, now = (v[near[:, i], i] for v in left)
        assert was.mean() > 6.0 * was.std() / np.sqrt(len(was))
        assert abs(now.mean()) < 4.0 * now.std() / np.sqrt(len(now))
        assert known.limited[at[:, i], i].all() and known.limited[:, i].mean() < 3.0 * at.mean()


@pytest.mark.parametrize("scale", [0.0, 0.02])
def test_a_clipped_gyro_beside_an_attitude_has_its_own_scale_factor_and_no_lag(scale):
    made, levels, _ = clipped(scale=scale)
    fitted, held = made.split(0.3)
    sensor = Sensor("gyro", {"scale_factor": {"s": np.zeros(3)}})
    inv = investigate(sensor, FREE, [fitted], [held])
    assert [s.effect for s in inv.steps] == ["saturation"]
    values = inv.after.sensor.values
    np.testing.assert_allclose(values["saturation"]["limit"], levels, rtol=1e-9)
    found = values["scale_factor"]["s"]
    for key in FREE:
        assert abs(found[key.index] - scale) < 4.0 * inv.after.std[key]
        assert inv.after.std[key] < 5e-4
    assert all(t.limited is not None for t in (*inv.after.trials, *inv.held))


def test_a_level_is_known_to_the_step_of_the_samples():
    """It is anywhere within 0.5 mrad/s: step / sqrt(12), and not to the last digit."""
    made, levels, _ = clipped()
    step = 5e-4
    rounded = replace(made, y=step * np.round(made.y / step))
    sensor = Sensor("gyro", {"scale_factor": {"s": np.zeros(3)}})
    fitted = fit(begin(sensor, FREE, [rounded]))
    read = ceiling_of(fitted, [])
    np.testing.assert_allclose(read.std, step / np.sqrt(12.0), rtol=1e-6)
    assert np.all(np.abs(read.values - levels) < 2.0 * read.std)


def test_a_gyro_that_stops_nowhere_shows_no_level():
    made, _, _ = clipped(share=0.0)
    made.y[:] += 1e-6 * np.random.default_rng(1).standard_normal(made.y.shape)
    fitted, held = made.split(0.3)
    inv = investigate(Sensor("gyro", {"scale_factor": {"s": np.zeros(3)}}), FREE, [fitted], [held])
    assert ceiling_of(inv.before, [held]) is None and inv.after.trials[0].limited is None


def test_a_side_that_stops_before_the_other_is_marked_too():
    """As of a gyro of which a bias was taken after it had clipped: -421 and 415 deg/s."""
    made, levels, at = clipped()
    made.y[:] -= 0.015 * levels
    sensor = Sensor("gyro", {"saturation": {"limit": 1.015 * levels}})
    assert with_limited(sensor, made).limited[at].all()


def test_a_declared_level_that_samples_exceed_hides_none_of_them():
    made, levels, _ = clipped()
    wrong = Sensor("gyro", {"saturation": {"limit": 0.5 * levels}})
    assert with_limited(wrong, made) is made
    direct = trial(TIME, made.y, made.u)
    assert with_limited(Sensor("gyro", {"saturation": {"limit": levels}}), direct) is direct


def test_axes_that_lie_at_their_limits_at_once_are_no_rows_that_repeat():
    rng = np.random.default_rng(5)
    wave = 1.45 * np.sin(2 * np.pi * 0.7 * TIME)[:, None]
    y = wave + 0.003 * rng.standard_normal((len(TIME), 3))
    stops = np.clip(y, -1.4, 1.4)
    same = (np.diff(stops, axis=0) == 0).all(axis=1).mean()
    assert 0.1 < same < 0.2
    assert not repeated(stops).any()
    y[100::200] = y[99::200][: len(y[100::200])]
    assert repeated(y).sum() == len(y[100::200])


def test_what_stands_in_for_a_sample_is_none():
    made, _, _ = clipped()
    healed = np.zeros_like(made.y)
    healed[500, 0] = 1.0
    one = trial(TIME, made.y, made.u, healed=healed)
    assert [len(counted(one, i)) for i in range(3)] == [len(counted(made, 0)) - 1] + 2 * [
        len(counted(made, 0))
    ]
