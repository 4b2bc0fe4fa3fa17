"""How much less a true effect does on held-out rows, as its coefficients are known only so well."""

from dataclasses import replace

import numpy as np
from loop_cases import inputs, noise, trial

from pyimu.identification.fit.fit import begin
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.search.confirm import evidence
from pyimu.identification.search.strayed import strayed
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS

SIGMA, ROWS, FITTED, SIGMAS, LINES = 1e-3, 4000, 2800, 8.0, 40
NONE = Sensor("gyro", {"turn_on_bias": {"b0": [0.0] * 3}})
KEYS = {
    Coefficient("vibration_line", name, at)
    for name, at in (("A", (0,)), ("f0", ()), ("phase", (0,)))
}


def line(seed: int):
    """A line of ``SIGMAS`` over the fitted rows: the model without it and with it, the held-out
    rows, and the line on these.
    """
    rng, time = np.random.default_rng(seed), np.arange(ROWS) * 0.01
    u = inputs(rng, time)
    u[:, COLUMNS["time"]] = time[:, None]
    size, f0 = SIGMAS * SIGMA / np.sqrt(FITTED / 2), rng.uniform(3.0, 10.0)
    phase = rng.uniform(-3.0, 3.0)
    true = size * np.sin(2 * np.pi * f0 * time + phase)
    y = u[:, :3] + noise(rng, time, SIGMA**2, 0.0)
    y[:, 0] += true
    fitted = trial(time[:FITTED], y[:FITTED], u[:FITTED])
    held = replace(trial(time[FITTED:], y[FITTED:], u[FITTED:], name="end"), parent="log")
    old = fit(begin(NONE, (), [fitted]))
    there = {"A": [size, 0.0, 0.0], "f0": f0, "phase": [phase, 0.0, 0.0]}
    new = fit(begin(NONE.with_values("vibration_line", **there), KEYS, [fitted]))
    return old, new, [held], true[FITTED:]


def test_a_line_strays_on_held_out_rows_as_its_frequency_is_known():
    """Against the true line, four standard errors of the mean; without it one true line in ten was
    more than three standard errors off, and refused.
    """
    off, surprises = [], []
    for seed in range(LINES):
        old, new, held, true = line(seed)
        values, time = new.sensor.values["vibration_line"], held[0].time
        own = values["A"][0] * np.sin(2 * np.pi * values["f0"] * time + values["phase"][0])
        mean, variance = strayed(old, new, held)
        off.append((2.0 * own @ (own - true) - mean) / np.sqrt(variance))
        seen = replace(evidence(old, new, held), strays=(mean, variance))
        surprises.append((replace(seen, strays=(0.0, 0.0)).surprise, seen.surprise))
    before, after = np.array(surprises).T
    assert abs(np.mean(off)) < 4.0 * np.std(off) / np.sqrt(LINES)
    assert 0.5 < np.std(off) < 2.0
    assert np.std(after) < np.std(before) and np.mean(after) < np.mean(before)
