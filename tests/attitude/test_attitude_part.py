"""What a part leaves out is what is left out without it: a part only ever adds knowledge."""

import numpy as np
import pytest
from attitude_cases import GRAVITY, H, drive, part, rover_rate
from scipy.spatial.transform import Rotation

from pyimu.attitude import run
from pyimu.attitude.columns import (
    NOISIER,
    NOMINAL_K,
    NOMINAL_RATE_NOISE,
    PART_RATE_NOISE,
    informed,
    rate_noise,
)
from pyimu.attitude.error import error_against
from pyimu.attitude.rest import find_rest
from pyimu.model.part_file import parse_part
from pyimu.recording.recording import Recording

MEASURED = """name = "measured"
sample_rate = {value = 100.0, unit = "Hz"}
[gyro.angle_random_walk]
N = {value = 1e-4, unit = "rad/sqrt(s)", source = "a log at rest"}
"""
SAID = """[accel.angle_random_walk]
N = {value = 1e-2, unit = "m/s/sqrt(s)", source = "a log at rest"}
"""
GROWING = """[gyro.rate_dependent_noise]
k = {value = 1e-3, unit = "sqrt(s)", source = "a turntable"}
"""


def log(clipped: float = np.inf) -> Recording:
    world = drive(3 * rover_rate(3000))
    rng = np.random.default_rng(0)
    gyro = np.clip(world.rate + 1e-3 * rng.standard_normal((3000, 3)), -clipped, clipped)
    return Recording("log", time=H * np.arange(1, 3001), gyro=gyro, accel=world.force)


def test_a_measured_part_leaves_out_what_is_left_out_of_the_rate_without_a_part():
    """And what the scale factors leave, which it has no standard deviation of. A part that says how
    its noise grows with the rate, and one that a program made, say all.
    """
    measured = parse_part(MEASURED, "part.toml")
    assert rate_noise(measured) == PART_RATE_NOISE >= rate_noise(None) == NOMINAL_RATE_NOISE
    assert rate_noise(parse_part(MEASURED + GROWING, "part.toml")) == rate_noise(part()) == 0
    parameters = run(log(), measured).parameters
    assert parameters["rate_noise"] == PART_RATE_NOISE
    assert parameters["gyro_error.rate_random_walk.K[1]"] == NOMINAL_K


def as_taken(part, recording):
    return informed(part, recording, find_rest(recording))


def resting(seconds: float = 20.0) -> Recording:
    """A gyro and an accelerometer with noise and bias that rest."""
    n, rng = round(seconds / H), np.random.default_rng(1)
    gyro = [2e-3, -1e-3, 3e-3] + 1e-3 * rng.standard_normal((n, 3))
    accel = [0, 0, GRAVITY] + NOISE * rng.standard_normal((n, 3))
    return Recording("rest", time=H * np.arange(1, n + 1), gyro=gyro, accel=accel)


NOISE = 0.1
"""m/s^2; standard deviation of the accelerometer's samples. The three axes are then together off by
more than ``rest_force_tolerance``, 0.2, in every fourth sample."""


def test_the_accelerometers_noise_is_that_at_rest_where_a_measured_part_does_not_say():
    """To five standard errors of a standard deviation of 2000 samples."""
    recording, white = resting(), "angle_random_walk"
    accel = as_taken(parse_part(MEASURED, "part.toml"), recording).accel
    n = NOISE * np.sqrt(H)
    np.testing.assert_allclose(accel.values[white]["N"], n, rtol=5 / np.sqrt(2 * 2000))
    said = parse_part(MEASURED + SAID, "part.toml")
    np.testing.assert_allclose(as_taken(said, recording).accel.values[white]["N"], 1e-2)
    made = part()
    made = made.with_sensor(made.accel.without(white))
    assert white not in as_taken(made, recording).accel.values


@pytest.mark.parametrize(("times", "taken"), [(0.9, 1.0), (1.0, 1.0), (1.6, 1.6), (4.0, NOISIER)])
def test_a_measured_part_is_as_noisy_as_its_samples_at_rest(times, taken):
    """Up to twice what it declares, and not less; to five standard errors of 2000 samples."""
    recording, white = resting(), "angle_random_walk"
    said = parse_part(MEASURED + SAID, "part.toml")
    declared = np.full(3, NOISE * np.sqrt(H) / times)
    said = said.with_sensor(said.accel.with_values(white, N=declared))
    found = as_taken(said, recording).accel.values[white]["N"] / declared
    np.testing.assert_allclose(found, taken, rtol=5 / np.sqrt(2 * 2000))


def test_a_measured_part_without_accelerometer_finds_rests():
    """As without a part: the body rests from when it has been still for as long as a rest takes."""
    recording, measured = resting(), parse_part(MEASURED, "part.toml")
    found, without = (run(recording, p) for p in (measured, None))
    assert without.at_rest.mean() > 0.8
    assert found.at_rest.mean() == pytest.approx(without.at_rest.mean(), abs=0.05)
    assert (found.std[-1, 3:] < 2 * without.std[-1, 3:]).all()


def test_where_samples_pile_up_a_measured_part_clips_though_it_does_not_say():
    measured = parse_part(MEASURED, "part.toml")
    seen = as_taken(measured, log(0.5)).gyro.values["saturation"]["limit"]
    np.testing.assert_allclose(seen[seen > 0], 0.5)
    assert (seen > 0).any()
    assert "saturation" not in as_taken(measured, log()).gyro.values
    assert "saturation" not in as_taken(part(), log(0.5)).gyro.values
    # No range ends where samples the other way go four times as far.
    far, axis = log(0.5), int(np.argmax(seen))
    back = far.gyro[:, axis] < 0
    far.gyro[back, axis] *= 4.0
    limit = as_taken(measured, far).gyro.values["saturation"]["limit"]
    assert limit[axis] == 2.0, limit


def test_a_heading_that_drifts_is_set_right_in_each_window():
    """Of an error of 0.01 rad/s about the vertical and a tilt of 0.02 rad: the largest heading is
    that of a window, the rest of the total is the tilt.
    """
    time = np.arange(0, 100, 0.1)
    tilt = Rotation.from_rotvec([0.02, 0, 0])
    q = Rotation.from_rotvec(0.01 * time[:, None] * [0, 0, 1]) * tilt
    error = error_against(time, q.as_quat(scalar_first=True), Rotation.identity(len(time)))
    found = error.in_windows(10.0)
    assert error.heading.max() == pytest.approx(0.01 * 99.9)
    assert found.heading.max() == pytest.approx(0.01 * 9.9, abs=1e-9)
    in_window = Rotation.from_rotvec(0.01 * (time % 10)[:, None] * [0, 0, 1]) * tilt
    # A heading of exactly the window's end may round into either window.
    apart = np.abs(found.total - in_window.magnitude())
    assert np.sort(apart)[-10] < 1e-4
