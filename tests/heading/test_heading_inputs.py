"""What cannot be a known motion of a gyro is refused in a line that says what would be right."""

import numpy as np
import pytest
from heading_cases import H, log, measured, turns

from pyimu import heading
from pyimu.errors import UserError
from pyimu.heading import fit, self_calibrate
from pyimu.recording.recording import Recording


@pytest.fixture(scope="module")
def motion():
    """Rate, heading and gyro of a minute."""
    rng = np.random.default_rng(11)
    rate = turns(rng, 60.0) + 0.1 * np.sin(np.arange(3000) / 300)
    return rate, H * np.cumsum(rate), measured(rate, rng, 0.02, 0.01)


def refused(recording, *said, reference=None):
    for method in (self_calibrate, fit):
        with pytest.raises(UserError) as error:
            method(recording, reference)
        missing = [s for s in said if s not in str(error.value)]
        assert not missing, f"{missing} not in: {error.value}"


def test_a_constant_rate():
    rate = np.full(2000, 0.5)
    gyro = measured(rate, np.random.default_rng(1))
    refused(log(gyro, rate=rate), "condition number", "standard error", "unbounded")
    refused(log(gyro, H * np.cumsum(rate)), "condition number", "unbounded")


def test_too_short_for_its_noise(motion):
    rate, _, _ = motion
    gyro = measured(rate, np.random.default_rng(1), n=0.1)
    refused(log(gyro[:200], rate=rate[:200]), "standard error", "for longer or faster")


def test_a_heading_that_wraps_is_unwrapped(motion):
    rate, angle, gyro = motion
    wrapped = (angle + np.pi) % (2 * np.pi) - np.pi
    assert np.ptp(wrapped) < 2 * np.pi < np.ptp(angle) or np.any(np.abs(np.diff(wrapped)) > np.pi)
    for method in (self_calibrate, fit):
        assert method(log(gyro, wrapped)).s == pytest.approx(method(log(gyro, angle)).s, abs=1e-9)


def test_a_step_that_could_be_either_way(motion):
    _, angle, gyro = motion
    angle = angle.copy()
    angle[1000:] += 3.0
    refused(log(gyro, angle), "172 deg", "either way round", "20 s")


def test_degrees_that_are_called_radians(motion):
    rate, angle, gyro = motion
    refused(log(gyro, np.degrees(angle)), "ref_heading", "factor of 57")
    wrapped = np.degrees((angle + np.pi) % (2 * np.pi) - np.pi)
    refused(log(gyro, wrapped), "ref_heading", "factor of 57")
    refused(log(gyro, rate=np.degrees(rate)), "ref_rate_z", "factor of 57")
    refused(log(np.degrees(gyro), angle), "gyro_z", "deg/s")


def test_opposite_signs(motion):
    rate, angle, gyro = motion
    refused(log(gyro, -angle), "opposite ways", "s near -2")
    refused(log(-gyro, rate=rate), "opposite ways")


def test_a_gyro_at_its_limit(motion):
    rate, angle, gyro = motion
    limit = 0.6 * np.max(np.abs(gyro))
    refused(log(np.clip(gyro, -limit, limit), angle), "at its limit", "deg/s", "range")


def test_a_gyro_that_is_not_the_references(motion):
    rate, angle, _ = motion
    gyro = measured(turns(np.random.default_rng(99), 60.0), np.random.default_rng(1))
    refused(log(0.01 * gyro, angle), "do not belong together")


def test_two_references_that_disagree(motion):
    rate, angle, gyro = motion
    refused(log(gyro, angle, 0.8 * rate), "disagree", "reference")
    assert fit(log(gyro, angle, 0.8 * rate), "heading").s == fit(log(gyro, angle)).s


def test_a_declared_rest_in_which_the_reference_turns(motion):
    rate, angle, gyro = motion
    one = log(gyro, angle, stationary=np.ones(len(gyro)))
    refused(one, "stationary from", "turns by", "column stationary")


def test_no_reference_and_no_gyro(motion):
    rate, angle, gyro = motion
    refused(log(gyro), "no reference", "ref_heading", "integrate, threshold and filter")
    refused(log(gyro, angle), "no reference", "ref_rate_z", reference="rate")
    refused(Recording.from_arrays(time=[0.0, 1.0], ref_heading=[0.0, 0.0]), "no gyro")


def test_missing_rows_are_left_out(motion):
    rate, angle, gyro = motion
    gyro = gyro.copy()
    gyro[[100, 2000]] = np.nan
    whole, found = fit(log(motion[2], angle)), fit(log(gyro, angle))
    assert found.segments == 3 and found.rows >= whole.rows - 2 - 3
    assert abs(found.s - whole.s) < found.s_std
    refused(log(np.full(len(gyro), np.nan), angle), "nowhere 10 rows on end")


def test_a_reference_of_another_length(motion):
    _, angle, gyro = motion
    with pytest.raises(UserError, match="ref_heading has shape"):
        log(gyro, angle[:-1])


def test_a_threshold_above_the_slowest_turn(motion):
    rate, angle, gyro = motion
    with pytest.raises(UserError, match="slowest turn"):
        heading.run(log(gyro, angle), method="threshold", threshold=np.radians(60.0))
