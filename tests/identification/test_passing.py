"""A pulse of a few rows is no bias that steps."""

from types import SimpleNamespace

import numpy as np
import pytest

from pyimu.identification.search.passing import FEW, passing
from pyimu.model.sensor import Sensor
from pyimu.model.signals import N_INPUT

ROW = 0.15


def fitted(times, sizes, axis=1):
    """A fit with bias steps of an axis at ``times`` s, beside a log of 300 rows."""
    steps = np.zeros((3, 4))
    steps[axis, : len(sizes)] = sizes
    sensor = Sensor("accel").with_values(
        "bias_step", A=steps, t0=[*times, *[0.0] * (4 - len(times))]
    )
    time = ROW * np.arange(300)
    trial = SimpleNamespace(time=time, row_time=time, u=np.zeros((300, N_INPUT)))
    return SimpleNamespace(sensor=sensor, trials=[trial])


@pytest.mark.parametrize(
    "lasts, back, is_pulse", [(3, 1.0, True), (3, 0.2, False), (60, 1.0, False)]
)
def test_a_level_of_a_few_rows_that_goes_again_is_a_pulse(lasts, back, is_pulse):
    said = passing(fitted([20.0, 20.0 + lasts * ROW], [0.1, -0.1 * back]), "bias_step")
    assert bool(said) == is_pulse and (not said or f"told by {lasts} rows alone" in said)
    assert lasts < FEW or not is_pulse


def test_one_step_and_effects_without_events_are_none():
    assert not passing(fitted([20.0], [0.1]), "bias_step")
    assert not passing(
        SimpleNamespace(sensor=Sensor("gyro").with_values("scale_factor")), "scale_factor"
    )
