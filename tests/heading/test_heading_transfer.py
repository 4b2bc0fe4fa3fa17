"""The rate transfer test, from a log of a rate table."""

import numpy as np
import pytest
from heading_cases import log

from pyimu.errors import UserError
from pyimu.heading import rate_transfer

H = 0.01
RATES = np.radians([0, 20, 50, 100, 60, -20, -50, -100, -60, 0])


def table(cubic=0.0, noise=1e-4, sa=0.0, seed=0):
    """Plateaus of 5 s with ramps of half a second between, an axis with a cubic error."""
    time = H * np.arange(round(55 / H))
    at = np.linspace(0, 54.5, 2 * len(RATES))
    knots = np.sort(np.concatenate([5.5 * np.arange(len(RATES)), 5.5 * np.arange(len(RATES)) + 5]))
    rate = np.interp(time, knots, np.repeat(RATES, 2))
    assert len(at) == len(knots)
    rng = np.random.default_rng(seed)
    gyro = 1.01 * rate + sa * np.abs(rate) + 0.002 + cubic * rate**3
    return log(gyro + noise * rng.standard_normal(len(time)), rate=rate, h=H)


def test_slope_asymmetry_and_bias_are_those_of_the_table():
    found = rate_transfer(table(sa=0.004))
    assert found.axis == "z" and len(found.rate) == len(RATES)
    for value, std, want in (
        (found.s, found.s_std, 0.01),
        (found.asymmetry, found.asymmetry_std, 0.004),
        (found.bias, found.bias_std, 0.002),
    ):
        assert abs(value - want) < 4 * std and std < 1e-4


def test_the_residual_is_what_no_coefficient_takes():
    """Of a cubic it is odd, and as large as least squares on the same rates leaves it; noise of a
    plateau's mean is 1e-4/sqrt(500) rad/s, of 1.7 rad/s range 3e-4 %."""
    found = rate_transfer(table(cubic=0.01))
    columns = np.column_stack([found.rate, np.ones(len(RATES)), np.abs(found.rate)])
    cubic = 0.01 * found.rate**3
    left = cubic - columns @ np.linalg.lstsq(columns, cubic)[0]
    np.testing.assert_allclose(found.percent, 100 * left / RATES.max(), atol=0.02)
    assert found.worst == pytest.approx(np.max(np.abs(100 * left / RATES.max())), abs=0.02)


def test_a_log_without_plateaus_on_both_sides_is_refused():
    one = table()
    few = one.slice(0, round(20 / H))
    with pytest.raises(UserError, match="5 plateaus or more"):
        rate_transfer(few)
    with pytest.raises(UserError, match="ref_rate"):
        rate_transfer(log(np.zeros(100)))
