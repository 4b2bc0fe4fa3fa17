"""Rate references whose axes are turned against the sensor's, as those of a second unit are."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from scipy.stats import chi2
from world import drive, recording

import pyimu
from pyimu.model.part_reader import parse_part
from pyimu.recording.recording import Recording

SCALE = np.array([0.004, -0.003, 0.005])


@pytest.fixture(scope="module")
def log():
    """A drive with a gyro that has scale factors."""
    world = drive(minutes=4, seed=33)
    made = recording(world, gyro_change=lambda x: x * (1 + SCALE), seed=6, kinds=("gyro",))
    return replace(made, ref_force=None)


def turned(log, degrees):
    turn = Rotation.from_rotvec(np.radians(degrees) * np.array([2.0, -1.0, 2.0]) / 3.0)
    return pyimu.close(replace(log, ref_rate=turn.apply(log.ref_rate)))


def of(closed, effect):
    (it,) = [e for e in closed.estimated if (e.sensor, e.effect) == ("gyro", effect)]
    return it


@pytest.mark.parametrize("degrees", [4.0, pytest.param(33.0, marks=pytest.mark.long), 120.0])
def test_a_turn_of_all_axes_is_the_mounting(log, degrees):
    """By 33 deg it was scale factors of -16 % and a formula. The squares of the errors in standard
    errors are a chi-square.
    """
    closed = turned(log, degrees)
    assert not closed.added and closed.verdict == "clean", closed.report()
    (found,) = [f for f in closed.quality if f.kind == "reference_turned"]
    assert np.degrees(found.detail["angle"]) == pytest.approx(degrees, abs=0.1)
    assert closed.references[0]["mounting"]["estimated"]
    s = of(closed, "scale_factor")
    assert np.sum(((s.value - SCALE) / s.std) ** 2) < chi2.isf(1e-4, 3), s


def test_what_may_be_the_sensors_misalignment_stays_its_own(log):
    closed = turned(log, 0.5)
    assert not [f for f in closed.quality if f.kind == "reference_turned"]
    assert np.any(np.abs(of(closed, "misalignment").value) > np.radians(0.2))


@pytest.mark.parametrize(
    ("degrees", "apart", "late"), [(4.0, False, 0), (4.0, True, 0), (-170.0, False, 230)]
)
def test_the_force_of_a_turned_unit_is_turned_with_its_rate(degrees, apart, late):
    """By 4 deg it was a misalignment of 2.8 deg of the accelerometer, or slips of the clock; on a
    clock of its own, by 170 deg, its force was another body's. A force of another unit, not turned,
    stays as it is. ``late`` are the rows by which the second unit's are stamped late.
    """
    world = drive(minutes=4, seed=34)
    made = recording(world, seed=7)
    turn = Rotation.from_rotvec(np.radians(degrees) * np.array([2.0, -1.0, 2.0]) / 3.0)
    force = made.ref_force if apart else turn.apply(made.ref_force)
    told = slice(len(force) - late)
    rate, force = turn.apply(made.ref_rate)[told], force[told]
    closed = pyimu.close(replace(made.slice(late, None), ref_rate=rate, ref_force=force))
    assert not closed.added and closed.verdict == "clean", closed.report()
    assert [f.column for f in closed.quality if f.kind == "reference_turned"] == ["gyro"]
    (m,) = [e for e in closed.estimated if (e.sensor, e.effect) == ("accel", "misalignment")]
    shown = m.shown & (m.std > 0.0)
    assert np.sum((m.value[shown] / m.std[shown]) ** 2) < chi2.isf(1e-4, shown.sum()), m


LEVEL = """
name = "level"
sample_rate = {value = 100.0, unit = "Hz"}
[gyro]
turn_on_bias = "estimate"
[gyro.angle_random_walk]
N = {value = 5e-4, unit = "rad/s/sqrt(Hz)", density = "two-sided"}
[accel]
turn_on_bias = "estimate"
[accel.angle_random_walk]
N = {value = 1e-3, unit = "m/s^2/sqrt(Hz)", density = "two-sided"}
"""


def test_what_the_gyro_does_not_show_of_a_turn_is_no_misalignment_of_the_accelerometer():
    """A vehicle that keeps level hardly shows the gyro how the second unit is turned about the
    vertical, and the accelerometer plainly: 1 mrad of that was a misalignment of it.
    """
    rng, h = np.random.default_rng(3), 0.01
    t = np.arange(0.0, 150.0, h)
    phase, hertz = rng.uniform(0.0, 2.0 * np.pi, (6, 4)), rng.uniform(0.05, 1.0, (6, 4))

    def sines(sizes, first):
        return np.column_stack(
            [
                a * np.sin(2.0 * np.pi * np.outer(t, hz) + p).sum(axis=1)
                for a, p, hz in zip(sizes, phase[first:], hertz[first:], strict=False)
            ]
        )

    rate = sines((0.008, 0.008, 0.15), 0)
    force = sines((0.5, 0.5, 0.2), 3) + [0.0, 0.0, 9.80665]
    turn = Rotation.from_rotvec(np.radians(4.0) * np.array([2.0, -1.0, 2.0]) / 3.0)
    log = Recording.from_arrays(
        time=t,
        gyro=rate + 5e-3 * rng.standard_normal(rate.shape),
        accel=force + 1e-2 * rng.standard_normal(force.shape),
        ref_rate=turn.apply(rate),
        ref_force=turn.apply(force),
    )
    closed = pyimu.close(log, parse_part(LEVEL, "level.toml"))
    assert not closed.added, closed.report()


def test_a_second_unit_on_its_own_clock_shows_what_forces_do_to_a_gyro():
    """Its force was on its own clock and in its own axes beside the gyro, whose g-sensitivity was
    then "unexplained".
    """
    world = drive(minutes=4, seed=35)
    G = np.radians(0.1) / 9.81 * np.array([[1.0, -0.5, 0.3], [0.2, -1.2, 0.4], [-0.6, 0.5, 0.9]])
    made = recording(world, gyro_change=lambda x: x + world.force @ G.T, seed=8)
    turn = Rotation.from_rotvec(np.radians(170.0) * np.array([0.1, -0.1, 0.99]))
    clock = 2.3 + (1 + 2e-5) * made.time
    second = Recording.from_arrays(
        "second",
        time=clock,
        ref_rate=turn.apply(made.ref_rate),
        ref_force=turn.apply(made.ref_force),
    )
    alone = replace(made, ref_rate=None, ref_force=None)
    closed = pyimu.close(alone, reference=second)
    (found,) = [a for a in closed.added if (a.sensor, a.effect) == ("gyro", "g_sensitivity")]
    value, std, _ = found.parameters["G"]
    shown = np.asarray(std) > 0.0
    assert shown.sum() > 6
    z = ((np.asarray(value) - G) / np.where(shown, std, 1.0))[shown]
    assert np.sum(z**2) < chi2.isf(1e-4, shown.sum()), z
