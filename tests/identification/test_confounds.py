"""The notes that go with an effect where no log tells it from something of the reference."""

import numpy as np
import pytest

from pyimu import Recording
from pyimu.identification.fit.trials import gyro_trial
from pyimu.identification.rivals.confounds import what_no_log_tells_apart
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.part_file import part


def turning(reference: str) -> Recording:
    """A robot that turns to and fro, beside a heading or a rate."""
    time = np.arange(3000) / 50.0
    rate = np.outer(np.sin(0.4 * time), [0.0, 0.0, 1.0])
    given = {"ref_heading": np.sin(0.2 * time) ** 2 / 0.2} if reference == "heading" else {}
    return Recording.from_arrays("robot", time=time, gyro=rate, **given or {"ref_rate": rate})


@pytest.mark.parametrize("reference, effect, is_told", [
    ("heading", "scale_factor", True),
    ("heading", "g_sensitivity", False),
    ("rate", "scale_factor", False),
])  # fmt: skip
def test_the_scale_of_a_heading_of_wheels_is_told_beside_a_scale_factor(reference, effect, is_told):
    trial = gyro_trial(turning(reference))
    assert trial.reference == reference
    said = what_no_log_tells_apart(CATALOGUE[effect], part("mpu6050").gyro, [trial])
    assert ("track width" in said) == is_told
