"""Small effects beside a large delay, and what the form of a lag leaves of a large motion."""

import numpy as np
import pytest

import pyimu
from pyimu.identification.search.remainder import ORDERS, differences

RATE, SECONDS, NOISE = 100.0, 60.0, 1e-3
PART = f"""name = "quiet"
sample_rate = {{value = {RATE}, unit = "Hz"}}
[gyro.angle_random_walk]
N = {{value = [1e-4, 1e-4, 1e-4], unit = "rad/sqrt(s)"}}
"""


class Waves:
    """Twelve waves on each of three axes, of up to ``high`` Hz, behind a ``gain`` of frequency."""

    def __init__(self, seed, size, high, gain=lambda f: np.ones_like(f)):
        rng = np.random.default_rng(seed)
        self.frequency, self.phase = rng.uniform(0.1, high, (3, 12)), rng.uniform(0, 6.28, (3, 12))
        self.size, self.gain = size * rng.standard_normal((3, 12)) / np.sqrt(6), gain

    def __call__(self, time):
        turned = 2 * np.pi * self.frequency * time[:, None, None] + self.phase
        gain = self.gain(self.frequency)
        return np.sum(self.size * np.abs(gain) * np.sin(turned + np.angle(gain)), axis=2)


def closed(tmp_path, shown, late=0.0, high=2.0, error=lambda rate, force: 0.0):
    """The loop closed on a gyro that shows ``shown`` of the rate, ``late`` s, with an error."""
    rng, time = np.random.default_rng(4), np.arange(SECONDS * RATE) / RATE
    force = Waves(3, 6.0, 1.0)(time - late)
    rate = shown(time - late)
    gyro = rate + error(rate, force) + NOISE * rng.standard_normal((len(time), 3))
    truth = Waves(2, 0.8, high)(time)
    path = tmp_path / "quiet.toml"
    path.write_text(PART)
    log = pyimu.Recording.from_arrays("log", time=time, gyro=gyro, accel=force, ref_rate=truth)
    return pyimu.close(log, part=path)


def added(found):
    return {a.effect for a in found.added if a.sensor == "gyro"}


def behind_the_other(rate, force):
    """3e-5 rad/s of y by a m/s^2 of x: some 12 standard errors."""
    return np.outer(3e-5 * force[:, 0], [0.0, 1.0, 0.0])


def cube(rate, force):
    return 5e-5 * rate**3


@pytest.mark.parametrize(
    "error, name", [(behind_the_other, "g_sensitivity"), (cube, "scale_factor_cubic")]
)
def test_a_small_effect_is_named_beside_a_clock_that_is_off(tmp_path, error, name):
    """It explains some hundred nat, and the 37 ms of the clock ten million."""
    found = closed(tmp_path, Waves(2, 0.8, 2.0), late=0.037, error=error)
    assert name in added(found), found.report()


def test_what_the_form_of_a_lag_leaves_is_no_other_effect(tmp_path):
    """A pole of 10 ms, whose sampled form is off by some thousandths at 6 Hz: of what that leaves
    other effects would explain a hundred nat.
    """
    pole = Waves(2, 0.8, 6.0, lambda f: 1 / (1 + 2j * np.pi * f * 0.01))
    found = closed(tmp_path, pole, high=6.0)
    assert added(found) == {"first_order_lag"}, found.report()


def test_differences_are_those_of_powers():
    """Of t^k within: the n-th central difference of a power below n is nothing, that of t^n is n!
    (exact in whole numbers).
    """
    t = np.arange(-20.0, 21.0)
    inner = slice(ORDERS, -ORDERS)
    for n, found in enumerate(differences(np.stack([t**k for k in range(5)], axis=1)), 1):
        for k in range(min(n + 1, 5)):
            expected = np.prod(np.arange(1.0, n + 1)) if k == n else 0.0
            np.testing.assert_array_equal(found[inner, k], expected)
