"""A bias that steps in rows that are held out of the middle of a log: fitted rows show that it did,
and the held-out ones when.
"""

import numpy as np
import pytest

import pyimu

RATE, SECONDS, WHITE = 50.0, 300.0, 5e-4
STEP = np.array([0.0, 8e-4, -6e-4])
"""rad/s"""


def turned_in_turn(at: float, seed: int) -> pyimu.Recording:
    """A table that turns x, then y, and z in its last quarter alone, so that its end does not judge
    by itself; the gyro's bias steps ``at`` s.
    """
    rng, time = np.random.default_rng(seed), np.arange(SECONDS * RATE) / RATE
    rate = np.zeros((len(time), 3))
    for axis, (first, last) in enumerate(((5.0, 110.0), (120.0, 200.0), (225.0, SECONDS))):
        rate[:, axis] = 0.8 * np.sin(0.6 * time) * ((time > first) & (time < last))
    gyro = rate + 0.003 + STEP * (time >= at)[:, None] + WHITE * rng.standard_normal(rate.shape)
    return pyimu.Recording.from_arrays("table", time=time, gyro=gyro, ref_rate=rate)


@pytest.mark.parametrize("at", [100.0, pytest.param(170.0, marks=pytest.mark.long)])
def test_the_step_is_named_with_its_instant(at):
    found = pyimu.close(turned_in_turn(at, int(at)))
    (step,) = found.added
    assert step.effect == "bias_step", found.report()
    when, std = (float(v[0]) for v in step.parameters["t0"][:2])
    assert std < 2.0 and abs(when - at) < 5.0 * std + 1.0 / RATE, (when, std)
    sizes, errors = (v[:, 0] for v in step.parameters["A"][:2])
    assert np.all(np.abs(sizes - STEP)[1:] < 5.0 * errors[1:])
