"""A motion that repeats exactly: what a scale factor makes of it is no noise of the reference."""

import numpy as np
import pytest

from pyimu.identification.close import close
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.search.belief import hidden, unbelievable
from pyimu.model.part_reader import parse_part
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording

H, S, B, LATE = 0.02, -0.1, 0.1, 0.0129
NOISE = 5e-4
"""rad/s; white, in a sample."""


def log(rows):
    """Of r = 4.266 (1 + sin(2 pi t/10 s)) rad/s (Hong and Park 2008, section 3.1, whose profile is
    not given), against a heading 12.9 ms late."""
    time, w = H * np.arange(rows), 2 * np.pi / 10

    def heading(t):
        return 4.266 * (t + (1 - np.cos(w * t)) / w)

    gyro = np.zeros((len(time), 3))
    gyro[:, 2] = (1 + S) * (heading(time) - heading(time - H)) / H + B
    gyro += NOISE * np.random.default_rng(5).standard_normal(gyro.shape)
    return Recording.from_arrays(time=time, gyro=gyro, ref_heading=heading(time - LATE))


@pytest.fixture(scope="module")
def closed():
    return close(log(30_000))


def test_the_scale_factor_is_found(closed):
    """To five standard errors: white noise of 5e-4 rad/s over 21,000 fitted rows whose rate varies
    by 3.0 rad/s RMS is 1.6e-6 of s, and of a delay that is left to be found as much again."""
    s = closed.after.gyro.values["scale_factor"]["s"][2]
    assert s == pytest.approx(S, abs=5 * 2 * NOISE / (3.0 * np.sqrt(21_000)) + 1e-5)


def test_what_is_left_is_the_noise(closed):
    """A verdict of nothing missing comes with no more than noise."""
    rate = closed.as_dict()["error"]["rate"]
    assert closed.verdict in ("clean", "named")
    assert rate["after"] < 1.2 * NOISE and rate["after"] < 1.5 * rate["floor"]


DECLARED = """
name = "declared"
sample_rate = {value = 50.0, unit = "Hz"}
[gyro.angle_random_walk]
N = {value = [7.07e-5, 7.07e-5, 7.07e-5], unit = "rad/sqrt(s)"}
[gyro.rate_random_walk]
K = {value = [1e-6, 1e-6, 1e-6], unit = "rad/s/sqrt(s)"}
"""


@pytest.mark.parametrize("declared", [False, True])
def test_turns_one_way_show_a_scale_factor_and_nothing_that_looks_like_one(declared):
    """Of 5 min, in which the rate never changes its sign: |r| is r there, and at one frequency a
    line is both. The simplest goes in; an asymmetry of a tenth, which explains as much, is beyond
    belief and not named beside it."""
    found = close(log(15_000), part=parse_part(DECLARED, "declared.toml") if declared else None)
    assert not found.unexplained and not found.formulas
    assert found.after.gyro.values["scale_factor"]["s"][2] == pytest.approx(S, abs=1e-4)
    if declared:
        assert found.verdict == "named" and [a.effect for a in found.added] == ["scale_factor"]
        (bent,) = [c for c in found.candidates if c.effect == "scale_factor_asymmetry"]
        assert bent.outcome == "explained" and bent.by == ("scale_factor",)
    else:
        assert found.verdict == "clean"


def test_a_coefficient_that_may_be_anything_is_not_believed():
    """Two axes that move alike show the sum of what they leak into the third, and neither: 441 rad
    is no misalignment, whatever its standard error."""
    m = np.zeros((3, 3))
    m[2, 0], m[2, 1] = 441.0, -630.0
    keys = [Coefficient("misalignment", "m", (2, i)) for i in (0, 1)]
    sensor = Sensor("gyro").with_values("misalignment", m=m)
    loose = Fit(sensor, frozenset(keys), (), {}, {}, std=dict.fromkeys(keys, 200.0))
    assert set(hidden(loose, keys)) == {*keys} and "not shown" in hidden(loose, keys)[keys[0]]
    near = Fit(sensor, frozenset(keys), (), {}, {}, std=dict.fromkeys(keys, 1e-3))
    assert not hidden(near, keys) and "beyond belief" in unbelievable(near, keys)
    known = Fit(sensor, frozenset(keys), (), {}, {}, std=dict.fromkeys(keys, 20.0))
    assert all("beyond belief" in why for why in hidden(known, keys).values())
    small = sensor.with_values("misalignment", m=1e-5 * m)
    assert not hidden(Fit(small, frozenset(keys), (), {}, {}, std={keys[0]: 0.003}), keys)
