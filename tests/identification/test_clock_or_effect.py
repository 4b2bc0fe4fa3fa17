"""A delay of the sensor beside clocks that drift."""

from types import SimpleNamespace

import numpy as np
import pytest

from pyimu.identification.fit.clock import Clock, ClockChange
from pyimu.identification.fit.keys import LogClock
from pyimu.identification.rivals.clock_or_effect import on_their_clocks

SECONDS = 70.0


def found(effect, own, drift, std):
    """What was found beside a clock that ``drift`` s a second, known to ``std``, are fitted to."""
    clock = Clock(np.zeros(1), np.zeros(1), 3e-4, 1.0, own=own)
    trial = SimpleNamespace(name="log", clock=clock, time=np.linspace(0.0, SECONDS, 7001))
    state = SimpleNamespace(clock=ClockChange(SECONDS / 2, drift=drift))
    fit = SimpleNamespace(trials=[trial], states={"log": state}, std={LogClock("log", 1): std})
    inv = SimpleNamespace(after=fit, steps=[SimpleNamespace(effect=effect)])
    return SimpleNamespace(investigation=inv, formula=None)


@pytest.mark.parametrize(
    "is_clocks, effect, own, drift, std",
    [
        pytest.param(True, "time_delay", 1.8e-3, 4.4e-5, 6e-6, id="drifts"),
        pytest.param(True, "first_order_lag", 1.8e-3, -4.4e-5, 6e-6, id="drifts back"),
        pytest.param(False, "time_delay", 1.8e-3, 4.4e-5, 1e-5, id="by chance"),
        pytest.param(False, "time_delay", 4.2e-3, 5e-6, 1e-7, id="by what a lag does"),
        pytest.param(False, "time_delay", 0.0, 4.4e-5, 6e-6, id="taken out before"),
        pytest.param(False, "scale_factor_cubic", 1.8e-3, 4.4e-5, 6e-6, id="no delay"),
    ],
)
def test_a_delay_beside_a_clock_that_drifts_is_the_clocks(is_clocks, effect, own, drift, std):
    one = found(effect, own, drift, std)
    assert on_their_clocks(one, lambda: None) is (None if is_clocks else one)
