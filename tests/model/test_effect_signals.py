"""Signals that follow from the course of the inputs, where these are not new at every sample."""

import numpy as np
import pytest
from catalogue_cases import CASES, H, as_part, excited, inputs, motion, outputs

from pyimu.fmu import build_fmus, simulate
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS, EVERY_SAMPLE, LONGEST_HOLD

PERIOD = 2.0**-7
"""s; exact in sums and quotients, so that what must be equal is equal to the last bit."""


def rate_of(temperature, h=PERIOD):
    """The temperature's rate (n,) that a part of this sample period sees in a course (n,) of it."""
    part = Part("thermometer", 1 / h, Sensor("gyro", {"temperature_rate": {"kd": 1.0}}))
    u = np.tile([v.start for v in part.block.inputs], (len(temperature), 1))
    u[:, [v.name for v in part.block.inputs].index("temperature")] = temperature
    return part.block.run(u)[0][:, 0]


@pytest.mark.parametrize("held", [1, 2, 10])
def test_rate_of_a_temperature_refreshed_every_few_samples_is_that_of_its_course(held):
    """A straight course read every ``held`` samples: its slope from the second reading on, at every
    sample.
    """
    course = np.repeat(20.0 + 0.5 * np.arange(40), held)
    want = np.where(np.arange(len(course)) < held, 0.0, 0.5 / (held * PERIOD))
    np.testing.assert_array_equal(rate_of(course), want)


def test_rate_of_a_temperature_that_is_new_at_every_sample_is_its_difference():
    course = 20 + np.cumsum(np.random.default_rng(1).standard_normal(300))
    np.testing.assert_array_equal(rate_of(course), np.diff(course, prepend=course[0]) / PERIOD)


def test_a_change_of_temperature_is_held_for_as_long_as_it_was_awaited():
    """So its integral is the change, and after it there is rest again."""
    course = np.repeat([20.0, 21.0, 19.0], [8, 16, 40])
    want = np.repeat([0.0, 1 / (8 * PERIOD), 0.0, -2 / (16 * PERIOD), 0.0], [8, 8, 8, 16, 24])
    np.testing.assert_array_equal(rate_of(course), want)


def test_a_change_after_a_long_rest_is_held_no_longer_than_the_longest_hold():
    h = 0.5
    longest, rest = round(LONGEST_HOLD / h), round(3 * LONGEST_HOLD / h)
    course = np.repeat([20.0, 23.0], [rest, rest])
    want = np.repeat([0.0, 3.0 / LONGEST_HOLD, 0.0], [rest, longest, rest - longest])
    np.testing.assert_allclose(rate_of(course, h), want, rtol=1e-15)


def test_a_missing_temperature_has_no_rate_and_is_forgotten():
    course = 20.0 + 0.5 * np.arange(40)
    course[[0, 17]] = np.nan
    rate = rate_of(course)
    np.testing.assert_array_equal(np.flatnonzero(np.isnan(rate)), [0, 17])
    np.testing.assert_array_equal(rate[2:17], 0.5 / PERIOD)
    # Over two sample periods the course has changed by twice as much.
    np.testing.assert_array_equal(rate[18:], 0.5 / PERIOD)


def test_the_fmu_sees_the_rate_of_the_temperature_whatever_its_step(tmp_path):
    """A step of ten samples: the same rate at every communication point as in steps of one."""
    kd = np.array([1e-3, -2e-3, 3e-3])
    part = Part("slow", 1 / PERIOD, Sensor("gyro", {"temperature_rate": {"kd": kd}}))
    (path,) = build_fmus(part.block, tmp_path, (2,))
    u = np.tile([v.start for v in part.block.inputs], (400, 1))
    u[:, 6] = 25 + 0.5 * PERIOD * np.arange(400)
    for held in (1, 10):
        y = simulate(path, u, sample_period=PERIOD, samples_per_step=held)[:, :3]
        np.testing.assert_allclose(y[2:], np.tile(0.5 * kd, (len(y) - 2, 1)), rtol=1e-12)


CHANGING = {"time", "vibration", "temperature_rate"}
"""Signals that change, or have a memory, beside the inputs of a sample and of the one before."""

AT_ONCE = [
    (name, kind)
    for name, kind in CASES
    if not (
        CATALOGUE[name].states
        or CATALOGUE[name].stochastic
        or CATALOGUE[name].signals(kind) & CHANGING
    )
]


@pytest.mark.parametrize("name, kind", AT_ONCE)
def test_only_what_says_so_wants_new_inputs_at_every_sample(name, kind):
    """An input that is held gives the same again; an effect of differences loses them, and each of
    its coefficients says so.
    """
    sensor, u = excited(name, kind), np.repeat(motion(30), 2, axis=0)
    part = as_part(sensor)
    y = part.block.run(inputs(u, part))[0][2:, outputs(kind)]
    lost = not np.array_equal(y[::2], y[1::2])
    assert lost == CATALOGUE[name].differences
    assert all((EVERY_SAMPLE in v.description) == lost for v in sensor.variables)
    assert (name in part.block.description) == lost


def test_time_is_no_input_that_could_be_held():
    """The signals of a test motion have time in them; a part counts it."""
    part = as_part(Sensor("gyro", {"rate_ramp": {"R": 1.0}}))
    y = part.block.run(inputs(np.zeros((5, COLUMNS["transport_rate"].stop)), part))[0]
    np.testing.assert_allclose(y[:, 0], H * np.arange(1, 6), rtol=1e-15)
