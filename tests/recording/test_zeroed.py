"""Samples that firmware sets to zero where they are small."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from turns import turned

import pyimu
from pyimu.errors import Finding
from pyimu.identification.verdict.ranges import set_to_zero
from pyimu.recording.quality.inspect import inspect
from pyimu.recording.quality.zeroed import FALSE_ALARMS, ZEROS, least_size
from pyimu.recording.recording import Recording

ZONE, WHITE = np.radians(1.0), np.radians(0.05)
TIME = np.arange(6000) / 100.0


def motion(size=np.radians(10.0)):
    """Slow turns about all axes, with rests of 4 s between them."""
    phase = 2 * np.pi * np.outer(TIME, [0.31, 0.23, 0.17]) + [0.1, 1.0, 2.0]
    return size * np.sin(phase) * np.clip((TIME % 20 - 4) / 2, 0, 1)[:, None]


def measured(rate, together=False, seed=1):
    """The gyro's samples, each axis set to zero by itself, or all by the size of the rate."""
    gyro = rate + WHITE * np.random.default_rng(seed).standard_normal(rate.shape)
    size = np.linalg.norm(gyro, axis=1, keepdims=True) if together else np.abs(gyro)
    return np.where(size < ZONE, 0.0, gyro)


@pytest.mark.parametrize("together", [False, True])
def test_zeros_of_a_dead_zone_are_no_stuck_sensor(together):
    log = Recording.from_arrays("log", time=TIME, gyro=measured(motion(), together))
    found = [f for f in inspect(log) if f.kind in ("zeroed", "stuck_samples")]
    assert {f.kind for f in found} == {"zeroed"}
    assert {f.column for f in found} == ({"gyro"} if together else {f"gyro_{a}" for a in "xyz"})
    # Of so many samples near the edge of the zone the least is within a tenth of it.
    assert all(ZONE <= f.detail["least"] < 1.1 * ZONE for f in found)


def test_a_sensor_that_hangs_is_stuck_beside_a_dead_zone():
    gyro = measured(motion())
    gyro[1000:1200] = gyro[1000]
    log = Recording.from_arrays("log", time=TIME, gyro=gyro)
    stuck = {f.column: f.count for f in inspect(log) if f.kind == "stuck_samples"}
    assert stuck and set(stuck.values()) == {200}


@pytest.mark.parametrize("step", [0.0, np.radians(0.05), np.radians(1.0)])
def test_a_gyro_that_is_rounded_or_at_rest_has_no_zone(step):
    """A step as wide as the zone is rounding; zeros that were not measured are among others."""
    gyro = motion() + WHITE * np.random.default_rng(2).standard_normal((len(TIME), 3))
    gyro = np.round(gyro / step) * step if step else gyro
    assert all(least_size(column) is None for column in gyro.T) and least_size(gyro) is None
    gyro[100:150] = 0.0
    assert step or all(least_size(column) is None for column in gyro.T)


def test_chance_finds_a_zone_as_rarely_as_it_is_said_to():
    """Uniform samples and some zeros: 300 columns, of which 0.3 are expected to have one."""
    rng = np.random.default_rng(3)
    columns = rng.uniform(-1, 1, (300, 500))
    columns[:, :30] = 0.0
    found = sum(least_size(column) is not None for column in columns)
    assert found <= 300 * FALSE_ALARMS + 4 * np.sqrt(300 * FALSE_ALARMS)


def test_close_names_the_zone_and_a_gyro_without_noise_at_rest_stops_nothing():
    """All that an axis shows at rest is zeros: its noise is that between them."""
    rate = motion(np.radians(2.0))
    noise = 2e-4 * np.random.default_rng(5).standard_normal(rate.shape)
    log = Recording.from_arrays("log", time=TIME, gyro=measured(rate), ref_rate=rate + noise)
    closed = pyimu.close(log)
    assert "hard_dead_zone" in [a.effect for a in closed.added], closed.report()
    (found,) = [a for a in closed.added if a.effect == "hard_dead_zone"]
    np.testing.assert_allclose(found.parameters["d"][0], ZONE, rtol=0.05)
    assert not any("set to zero" in remark for remark in closed.remarks)


@pytest.mark.parametrize("white", [1e-5, 3e-4])
def test_zeros_tell_a_hard_dead_zone_beside_an_attitude(white):
    """Sample by sample an attitude with noise does not show the rate, but the zeros lie where the
    samples are small: they need no reference, and count for nothing in what is compared.
    """
    rate, rng = motion(), np.random.default_rng(6)
    true = turned(Rotation.from_rotvec(0.5 * (rate[1:] + rate[:-1]) / 100.0))
    q = true * Rotation.from_rotvec(white * rng.standard_normal(rate.shape))
    q = q.as_quat(scalar_first=True)
    closed = pyimu.close(Recording.from_arrays("log", time=TIME, gyro=measured(rate), ref_q=q))
    (found,) = closed.added
    assert found.effect == "hard_dead_zone", closed.report()
    np.testing.assert_allclose(found.parameters["d"][0], ZONE, rtol=0.05)
    assert not any("set to zero" in remark for remark in closed.remarks)


def test_a_zone_that_no_effect_was_named_for_is_said():
    found = [Finding("zeroed", f"gyro_{a}", 900, {"least": ZONE}) for a in "xy"]
    (said,) = set_to_zero(found, [("accel", "hard_dead_zone")])
    assert said.startswith("the gyro's samples below 1.00 deg/s are set to zero")
    assert not set_to_zero(found, [("gyro", "hard_dead_zone")])


def test_noise_of_a_few_steps_whose_zeros_are_chance_has_no_zone():
    """A gyro of steps of 0.0076 deg/s and noise of five: one in two thousand samples is zero on all
    axes, and the digits of the file make many sizes of the next larger ones.
    """
    rng = np.random.default_rng(6)
    steps = np.round(5.0 * rng.standard_normal((200_000, 3)))
    values = np.radians(np.round(steps / 131.0, 6))
    assert np.count_nonzero(~steps.any(axis=1)) >= ZEROS and least_size(values) is None
