"""The picture of a part's noise: its curves are those of the noise model, its marks the sheet's."""

from dataclasses import replace

import numpy as np
import pytest

import pyimu
from pyimu import Part, Sensor, UserError, part
from pyimu.model.deviations import law_deviation
from pyimu.shaping import describe
from pyimu.units import convert

TAU = 2.0 ** np.arange(3, 14)
"""Samples of a cluster."""


@pytest.mark.parametrize(
    "effect, values",
    [
        ("angle_random_walk", {"N": 1e-4}),
        ("rate_random_walk", {"K": 1e-5}),
        ("angle_quantization", {"q": 1e-5}),
        ("quantization", {"q": 1e-4}),
        ("rate_ramp", {"R": 1e-7}),
        ("bias_instability", {"B": 1e-5}),
        ("gauss_markov", {"q": 1e-5, "tau": 30.0}),
    ],
)
def test_the_deviation_of_a_law_is_that_of_the_samples_spectrum(effect, values):
    """By the integral over the density of what is simulated. A sampled Markov process lies above
    the continuous one, in the variance by (h / (tau sqrt(2)) + h / (tau_c sqrt(12)))^2 at most:
    0.8 % at 8 samples, and the flicker's fastest pole lies some samples away.
    """
    h, sensor = 0.01, Sensor("gyro", {effect: values})
    found = law_deviation(sensor.effect(effect).law, sensor.of_axis(effect, 0), TAU * h, h)
    want = describe(sensor, effect, 0, h).allan_deviation(TAU * h)
    np.testing.assert_allclose(found, want, rtol=0.02)


def test_the_curve_goes_through_the_figures_of_the_data_sheet():
    figure = part("imt30").plot()
    (panel,) = figure.axes
    lines = {line.get_label(): line for line in panel.lines}
    N = part("imt30").gyro.values["angle_random_walk"]["N"]
    (mark,) = lines["N: as declared"].get_ydata()
    assert mark == pytest.approx(convert(N.max(), "rad/s", "deg/h"))
    tau, white = lines["angle_random_walk"].get_data()
    assert np.interp(0.0, np.log(tau), np.log(white)) == pytest.approx(np.log(mark), rel=1e-3)
    assert {"all, x", "all, y", "all, z"} < lines.keys()


def test_the_figures_are_as_printed_and_the_floor_is_flat():
    figure = part("mpu6050").plot()
    gyro, accel = figure.axes
    labels = [line.get_label() for line in gyro.lines]
    assert any(label.startswith("N: 0.005 deg/s/sqrt(Hz)") for label in labels)
    (floor,) = (line for line in gyro.lines if line.get_label().startswith("B: "))
    tau, deviation = next(line for line in gyro.lines if line.get_label() == "all").get_data()
    # Where white noise has faded: 0.212 deg/sqrt(h) at 1000 s is 0.4 deg/h beside 4.3.
    assert np.interp(1000.0, tau, deviation) == pytest.approx(floor.get_ydata()[0], rel=0.02)
    assert accel.get_ylabel() == "accel [mg]" and figure._repr_png_()[:4] == b"\x89PNG"


def test_what_is_left_to_the_data_is_not_drawn():
    declared = Part("mine", 100.0, Sensor("gyro", {"angle_random_walk": {"N": 1e-4}}))
    assert len(declared.plot().axes) == 1
    open_one = replace(declared, estimate=frozenset({("gyro", "angle_random_walk", "N")}))
    for nothing in (open_one, Part("ideal", 100.0)):
        with pytest.raises(UserError, match="declares no noise"):
            nothing.plot()
    assert pyimu.Part.plot.__doc__
