"""What ``pyimu close`` makes of a gyro that turns about the vertical and warms up meanwhile."""

import numpy as np
from heading_cases import log, measured, turns

from pyimu.identification.close import close

SLOW = 0.1
"""s; sample period."""


def test_a_thermal_bias_is_named_on_the_axis_that_turns():
    """0.1 deg/s/K and +-8 K in 240 s, over 8 min; to four of its own standard errors. Consumer
    parts' data sheets allow three times as much."""
    rng, true = np.random.default_rng(16), np.radians(0.1)
    rate = turns(rng, 480.0, h=SLOW)
    warm = 8.0 * np.sin(2 * np.pi * SLOW * np.arange(len(rate)) / 240.0)
    gyro = measured(rate, rng, -0.1, 0.1, 6.2e-4, 2e-5, SLOW) + true * warm
    closed = close(log(gyro, rate=rate, h=SLOW, temperature=25.0 + warm))
    assert closed.verdict == "named" and [a.effect for a in closed.added] == ["thermal_bias"]
    value, std, _ = closed.added[0].parameters["kT"]
    assert abs(value[2] - true) < 4 * std[2] and not value[:2].any()
