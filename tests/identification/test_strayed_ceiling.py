"""Levels at which samples stop, beside scale factors that the clipped samples bend."""

from dataclasses import replace

import numpy as np
import pytest
from loop_cases import inputs, noise, trial

from pyimu.identification.fit.fit import begin
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.reference.belongs import too_little
from pyimu.identification.search import choice
from pyimu.identification.search.screen import screen
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor

H, R = 0.04, 1e-4


@pytest.fixture(scope="module")
def clipped():
    """A fitted trial of a gyro that stops where a tenth of its samples would be larger."""
    rng, time = np.random.default_rng(3), np.arange(4500) * H
    u = inputs(rng, time)
    rate = u[:, OWN["gyro"]]
    levels = np.quantile(np.abs(rate), 0.9, axis=0)
    y = np.clip(rate + noise(rng, time, R, 0.0), -levels, levels)
    sensor = Sensor("gyro", {"scale_factor": {"s": np.zeros(3)}})
    free = [Coefficient("scale_factor", "s", (i,)) for i in range(3)]
    known = frozenset({"rate", "time"})
    return fit(begin(sensor, free, [trial(time, y, u, known=known)])), levels


@pytest.mark.parametrize("astray", [1.0, 1.07, 1.17])
def test_a_level_that_a_fit_puts_beyond_the_samples_is_brought_to_them(
    astray, clipped, monkeypatch
):
    """As of a gyro that clips for 5 to 19 % of its samples beside an attitude, whose levels a fit
    had 7 and 17 % too large: these axes were taken for none that stop.
    """
    fitted, levels = clipped
    seen = {c.effect: c for c in screen(fitted, ()).candidates}
    found = choice.fit_and_normal

    def strayed(start):
        fitted, normal = found(start)
        limit = astray * np.array(fitted.sensor.values["saturation"]["limit"])
        return replace(fitted, sensor=fitted.sensor.with_values("saturation", limit=limit)), normal

    monkeypatch.setattr(choice, "fit_and_normal", strayed)
    refined = choice.refine(fitted, seen["saturation"])
    assert len(refined.screened.groups) == 3 and np.isfinite(refined.gain)
    limits = refined.fit.sensor.values["saturation"]["limit"]
    np.testing.assert_allclose(limits, levels, rtol=1e-9)


def test_a_reference_of_a_clipped_gyro_is_not_called_another_bodys(clipped):
    (case,) = clipped[0].trials
    assert too_little(case, 0.6) == ""
    said = too_little(case, 0.4)
    assert "40% of what the gyro shows" in said and "of the rows lie at the limit" in said
    whole = replace(case, y=case.u[:, OWN["gyro"]])
    assert "another body" in too_little(whole, 0.4)
