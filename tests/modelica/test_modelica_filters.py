"""The shaping filters in Modelica against the transfer functions of ``pyimu.shaping``."""

import control
import numpy as np
import pytest
from catalogue_cases import run
from modelica_cases import simulated

from pyimu.block.normals import normals
from pyimu.characterization.allan import octave_clusters, overlapping_deviation
from pyimu.characterization.allan.law import allan_band
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS, N_INPUT
from pyimu.modelica.filters import FILTERS
from pyimu.modelica.names import pascal
from pyimu.shaping import continuous_filter

FREQUENCIES = np.geomspace(0.1, 10.0, 20)
"""Hz."""

STOP, PERIOD, TOLERANCE = 10.0, 0.01, 1e-12

COEFFICIENTS = {
    "angle_random_walk": {"N": 0.3},
    "rate_random_walk": {"K": 0.2},
    "gauss_markov": {"q": 0.4, "tau": 0.5},
    "second_gauss_markov": {"q": 0.4, "tau": 2.0},
    "bias_instability": {"B": 0.7, "f_low": 0.05, "f_high": 20.0},
    "rate_dependent_noise": {"k": 0.5},
}
INPUT = 1.5
"""Of the axis, on which noise that depends on the rate depends."""


def response(name):
    """Complex response (20,) of a filter to equal inputs, from its answers to sines.

    The answer of a linear system to a sine from rest is a sine and its own exponentials, whose
    rates are those of its poles: a least-squares fit of them all tells them apart.
    """
    given = dict(COEFFICIENTS[name])
    if name == "rate_dependent_noise":
        given["x"] = INPUT
    values = ", ".join(f"{k}={v}" for k, v in given.items())
    size = FILTERS[name].size.strip("[]")
    lines = [f"PyImu.ShapingFilters.{pascal(name)} f{i}({values});" for i in range(20)]
    equations = []
    for i, f in enumerate(FREQUENCIES.tolist()):
        sine = f"sin(2*Modelica.Constants.pi*{f!r}*time)"
        equations.append(f"f{i}.u = {f'fill({sine}, {size})' if size else sine};")
    text = "\n".join(["model Test", *lines, "equation", *equations, "end Test;"])
    rows = simulated("Test", STOP, PERIOD, text, tolerance=TOLERANCE)
    t = np.arange(round(STOP / PERIOD) + 1) * PERIOD
    poles = continuous_filter(name, COEFFICIENTS[name], INPUT).poles().real
    found = []
    for i, f in enumerate(FREQUENCIES):
        angle = 2 * np.pi * f * t
        columns = [np.sin(angle), np.cos(angle), *np.exp(np.outer(poles, t))]
        fitted = np.linalg.lstsq(np.column_stack(columns), rows[f"f{i}.y"], rcond=None)[0]
        found.append(complex(fitted[0], fitted[1]))
    return np.array(found)


@pytest.mark.parametrize("name", FILTERS)
def test_response_is_the_formula(name):
    """At 20 frequencies, to 1e-6 of the largest: of the solver's 1e-12 a sum of exponentials keeps
    half the digits.
    """
    system = continuous_filter(name, COEFFICIENTS[name], INPUT)
    want = control.frequency_response(system, 2 * np.pi * FREQUENCIES).frdata.sum(axis=(0, 1))
    got = response(name)
    np.testing.assert_allclose(got, want, rtol=0, atol=1e-6 * np.abs(want).max())


# The sampled noises, on the normals that the library draws (test_modelica_noise)

SAMPLES, STEP = 2**14, 1e-3
FALSE_ALARM = 0.01 / len(FILTERS)


@pytest.mark.parametrize("name", FILTERS)
def test_sampled_noise_has_the_filters_allan_deviation(name):
    """Inside the simultaneous 99 % band of all six, from 16 samples on: below that the sampled
    noise, which knows no more than half its rate, is another one than the filter's. There aliases
    change a density that falls as 1/f^2 by (pi/32)^2/3 = 0.3 %, the band is wider than 3 %.
    """
    values = {
        k: [v] * 3 if k in "NKBqk" or k == "tau" else v for k, v in COEFFICIENTS[name].items()
    }
    sensor = Sensor("gyro", {name: values})
    u = np.zeros((SAMPLES, N_INPUT))
    u[:, COLUMNS["rate"]] = INPUT
    w = normals(3, [c.number for c in sensor.noise], 1, SAMPLES)
    x = run(sensor, u, w=w, h=STEP)[:, 0] - INPUT
    system = continuous_filter(name, COEFFICIENTS[name], INPUT)

    def psd(f):
        found = control.frequency_response(system, 2 * np.pi * f).frdata
        return np.sum(np.abs(found) ** 2, axis=(0, 1))

    m = octave_clusters(SAMPLES, 4)[4:]
    low, high = allan_band(psd, m * STEP, SAMPLES, STEP, 1 - FALSE_ALARM)
    found = overlapping_deviation(x, m)
    assert np.all((low <= found) & (found <= high)) and np.all(high > 1.03 * low)
