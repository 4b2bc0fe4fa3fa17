"""Coefficients that logs do not show stand in the model where they are known beforehand."""

import tomllib

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pyimu.identification.close import close
from pyimu.recording.recording import Recording

G = 9.81
RATE, ROWS = 50.0, 6000
NOISE = 0.02
BIAS = np.array([0.05, -0.08, 0.15])
PRIOR = 0.03
"""What the scale factor of a consumer's accelerometer is beforehand (typical.toml)."""


@pytest.fixture(scope="module", params=[1, 2, 3])
def level(request):
    """An accelerometer that goes to and fro and hardly up and down: its force along z is gravity,
    and a tenth of a hundredth more, so that bias and scale factor of z are one figure.
    """
    rng, time = np.random.default_rng(request.param), np.arange(ROWS) / RATE
    across = [3.0 * np.sin(w * time + p) for w, p in ((1.1, 0.0), (1.7, 1.0))]
    force = np.column_stack([*across, G + 0.01 * np.sin(0.9 * time)])
    accel = force + BIAS + NOISE * rng.standard_normal(force.shape)
    return close(Recording.from_arrays(name="level", time=time, accel=accel, ref_force=force))


def of(closed, effect):
    (found,) = (v for v in closed.estimated if v.effect == effect)
    return found


def test_a_scale_factor_that_logs_do_not_show_is_none_in_the_model(level, tmp_path):
    scale = of(level, "scale_factor")
    assert list(scale.shown) == [True, True, False] and scale.value[2] == 0.0
    level.write(tmp_path, units=False)
    written = tomllib.loads((tmp_path / "model.toml").read_text())["accel"]["scale_factor"]["s"]
    assert written["value"][2] == 0.0 and "z not shown by these logs" in written["source"]


def test_the_bias_is_the_one_that_fits_with_it(level):
    """To four standard errors of the mean of a tenth of the rows that were fitted, 70 %: a walk
    that the fit takes in by chance weighs some rows more. What the rows and the prior together make
    of the scale factor would be 0.014 of gravity, 35 times that.
    """
    bias = of(level, "turn_on_bias")
    assert abs(bias.value[2] - BIAS[2]) < 4 * NOISE / np.sqrt(0.1 * 0.7 * ROWS)


def test_its_interval_has_what_the_scale_factor_may_be(level):
    """Gravity times what of the prior is left beside rows that tell less than it does."""
    bias = of(level, "turn_on_bias")
    assert np.sqrt(0.5) * PRIOR * G < bias.std[2] < 2 * PRIOR * G


def test_what_several_show_together_is_not_lost():
    """Turns about one skew axis show a sum of three coefficients on each of the sensor's: none of
    them alone, but the residual is the noise. It is known to 4 / sqrt(2 n) of itself.
    """
    rng, time = np.random.default_rng(4), np.arange(ROWS) / RATE
    turn = np.sin(0.9 * time) + 0.7 * np.sin(2.3 * time)
    rate = turn[:, None] * np.ones(3) / np.sqrt(3)
    gyro = 1.02 * rate + 1e-3 * rng.standard_normal(rate.shape)
    found = close(Recording.from_arrays(name="skew", time=time, gyro=gyro, ref_rate=rate))
    left = found.errors["gyro"].after.total
    assert_allclose(left, 1e-3, rtol=4 / np.sqrt(2 * 3 * 0.3 * ROWS))
