"""Temperature behind a noisy or coarse thermometer, as the loop takes it."""

import numpy as np
import pytest
from scipy.signal import lfilter

import pyimu
from pyimu.identification.fit.surroundings import without_noise
from pyimu.model.part_reader import parse_part
from pyimu.recording.recording import Recording

TIME = np.arange(0.0, 300.0, 0.02)
TRUE = 25 + 8 * np.sin(2 * np.pi * TIME / 240)
RNG = np.random.default_rng(11)
READINGS = {
    "noisy": TRUE + 0.03 * RNG.standard_normal(len(TIME)),
    "coarse": np.round(TRUE / 0.5) * 0.5,
    "exact": TRUE,
}


def log(temperature, kT=0.0):
    rng = np.random.default_rng(12)
    rate = np.column_stack([np.sin(2 * np.pi * f * TIME) for f in (0.3, 0.7, 1.1)])
    gyro = rate + 1e-3 * rng.standard_normal(rate.shape) + kT * (TRUE - 25)[:, None]
    return Recording.from_arrays(
        name="log", time=TIME, gyro=gyro, temperature=temperature, ref_rate=rate
    )


@pytest.mark.parametrize(
    "kind, most", [("noisy", 0.03 / np.sqrt(50)), ("coarse", 0.5 / np.sqrt(12)), ("exact", 2.3e-4)]
)
def test_what_is_left_is_less_than_the_mean_of_an_interval_has(kind, most):
    """White noise of a second's mean; the rounding itself; the spline through means of a curve, of
    which the second difference over 24, 8 (2 pi / 240)^2 / 24 = 2.3e-4 K, is what they are off.
    """
    found = without_noise(log(READINGS[kind]), READINGS[kind])
    assert np.sqrt(np.mean((found - TRUE) ** 2)) < most


def test_the_rate_of_an_exact_temperature_has_no_steps():
    """Lines between the means of seconds would make its rate one of steps of 5.5e-3 K/s, the second
    difference; the third, 1.4e-4, is more than what a spline leaves of it.
    """
    rate = np.gradient(without_noise(log(TRUE), TRUE), TIME)
    assert np.abs(rate - np.gradient(TRUE, TIME)).max() < 1.4e-4


def test_what_is_switched_stays_a_jump():
    """Of a supply of 0.1 V more for a time, readings of 1 mV noise: by six of what is left of that
    in the mean of a second, 0.14 mV; a smoothed jump would be off by half of itself.
    """
    true = 3.3 + 0.02 * np.sin(2 * np.pi * TIME / 240) + 0.1 * ((TIME > 70.3) & (TIME < 140.7))
    readings = true + 1e-3 * np.random.default_rng(13).standard_normal(len(TIME))
    found = without_noise(log(readings), readings)
    assert np.abs(found - true).max() < 6 * 1e-3 / np.sqrt(50)


@pytest.mark.long
@pytest.mark.parametrize("kind", READINGS)
def test_a_thermal_bias_is_named_by_any_thermometer(kind):
    closed = pyimu.close(log(READINGS[kind], kT=3e-4))
    assert [a.effect for a in closed.added] == ["thermal_bias"], closed.report()
    kT, std, _ = closed.added[0].parameters["kT"]
    # Four standard errors on three axes, and the 2 % by which a coarse one may mistake its range.
    assert np.all(np.abs(kT - 3e-4) < 4 * std + 6e-6)


@pytest.mark.parametrize("kind", READINGS)
def test_a_thermometer_alone_is_no_effect(kind):
    assert not pyimu.close(log(READINGS[kind])).added


DECLARED = """
name = "warm"
sample_rate = {value = 50.0, unit = "Hz"}
[gyro.thermal_bias]
kT = {value = [3e-4, -2e-4, 4e-4], unit = "rad/s/K"}
T0 = {value = 25.0, unit = "degC"}
[gyro.angle_random_walk]
N = {value = [1.41421356e-4, 1.41421356e-4, 1.41421356e-4], unit = "rad/sqrt(s)"}
"""


@pytest.mark.parametrize(
    "tau",
    [0.0, pytest.param(20.0, marks=pytest.mark.long), pytest.param(40.0, marks=pytest.mark.long)],
)
def test_a_late_thermometer_is_found_and_is_no_rate_of_temperature(tau):
    """A thermometer that is a first-order lag of T shows T - tau dT/dt."""
    late = TRUE if tau == 0.0 else _behind(tau)
    part = parse_part(DECLARED, "warm.toml")
    kT = np.array([3e-4, -2e-4, 4e-4])
    closed = pyimu.close(log(late + 0.01 * RNG.standard_normal(len(TIME)), kT=kT), part=part)
    # Readings that are off by a little wander with the temperature's own noise.
    assert not {a.effect for a in closed.added} - {"rate_random_walk"}, closed.report()
    found = [f.detail for f in closed.quality if f.kind == "thermometer_late"]
    assert len(found) == (tau > 0)
    for one in found:
        # Its prior of 30 s draws it by less than a standard error; a difference of means over
        # seconds by less than a percent.
        assert abs(one["late"] - tau) < 5 * one["late_std"] + 0.01 * tau


def _behind(tau):
    share = (TIME[1] - TIME[0]) / tau
    return lfilter([share], [1.0, share - 1.0], TRUE, zi=[(1.0 - share) * TRUE[0]])[0]


def test_a_constant_or_short_temperature_stays_as_it_was_read():
    still = np.full(len(TIME), 25.0)
    assert without_noise(log(still), still) is not still
    assert np.array_equal(without_noise(log(still), still), still)
    short = log(READINGS["noisy"]).slice(0, 100)
    assert np.array_equal(without_noise(short, short.temperature), short.temperature)
