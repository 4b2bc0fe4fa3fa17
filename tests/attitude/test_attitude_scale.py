"""The scale factors of a gyro that nobody calibrated, in a turn that goes on and in one back."""

import numpy as np
import pytest
from attitude_cases import GRAVITY, N_ACCEL, H, N, part
from drives import bodies
from drives.cases import hand, matched, off_scale
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

from pyimu.attitude import run
from pyimu.attitude.columns import NOMINAL_SCALE_STD, scale_std
from pyimu.model.part_file import parse_part
from pyimu.recording.recording import Recording

RUNS = 20
SCALED = {"scale_std": NOMINAL_SCALE_STD}
REST, TURN = round(5 / H), round(30 / H)


def turned(seed: int, back: bool = False) -> Recording:
    """A level body that rests, and turns by 30 rad; ``back``: by half of it, and back."""
    rng, n = np.random.default_rng([4, seed]), REST + TURN
    rate = np.zeros((n, 3))
    rate[REST:, 2] = np.where(back & (np.arange(TURN) >= TURN / 2), -1.0, 1.0)
    off = 1 + NOMINAL_SCALE_STD * rng.standard_normal(3)
    gyro = rate * off + N / H**0.5 * rng.standard_normal((n, 3))
    accel = [0, 0, GRAVITY] + N_ACCEL / H**0.5 * rng.standard_normal((n, 3))
    return Recording.from_arrays(time=H * np.arange(n), gyro=gyro, accel=accel)


@pytest.mark.parametrize("smooth", [False, True])
def test_heading_after_a_turn_is_as_unsure_as_the_gyros_scale_factor(smooth):
    """Of 20 gyros the squared heading errors over their variances are chi-squared. What is claimed
    beside the scale factor, a walk of 2e-4 rad/s/sqrt(s) over 30 s, makes a thousandth of it.
    """
    errors = []
    for seed in range(RUNS):
        found = run(turned(seed), part(), smooth=smooth, settings=SCALED)
        left = (found.euler[-1, 2] - TURN * H + np.pi) % (2 * np.pi) - np.pi
        errors.append(left / found.heading_std[-1])
    low, high = chi2.ppf([1e-4, 1 - 1e-4], RUNS)
    assert low < np.sum(np.square(errors)) < high


def test_turn_back_takes_away_what_the_scale_factor_made():
    there, back = (
        run(turned(0, back), part(), settings=SCALED).heading_std for back in (False, True)
    )
    assert back[-1] < 0.2 * there[-1]
    assert back.max() == pytest.approx(NOMINAL_SCALE_STD * TURN * H / 2, rel=0.05)


def test_a_turn_about_the_vertical_is_estimated_the_same_without_it():
    """But for what the accelerometer's noise tilts of it, 1e-3 rad."""
    one, two = (run(turned(0), part(), settings={"scale_std": v}) for v in (0.0, 0.02))
    for name in ("q", "gyro_bias"):
        np.testing.assert_allclose(getattr(one, name), getattr(two, name), atol=1e-6)
    np.testing.assert_array_equal(one.status, two.status)
    assert np.all(two.heading_std >= one.heading_std) and np.all(two.std >= one.std)


def test_the_tilt_of_an_arm_follows_gravity_where_its_gyro_is_off():
    """Joints that swing at nearly the same pace turn the tilt on, degrees in a minute, by a gyro
    whose scale factors are 1 % off. Its accelerometer, 10 mg off, is 0.8 deg off the vertical. A
    tilt that was taken for a push, and was not corrected, was 8 deg off on the first of these.
    """
    for seed in (6, 11):
        log = bodies.arm(np.random.default_rng([96, seed, 8]), sensors=bodies.AS_BOUGHT)
        assert tilt_error(log) < 2.0


def test_the_tilt_of_what_turns_to_and_fro_follows_gravity_where_its_gyro_is_off():
    """Of gyros whose scale factors are 2 % off. Where the tilt that these may have made became
    unsure in 50 s, it was 0.7 deg off, root mean square.
    """
    logs = [off_scale(matched)(np.random.default_rng([97, i])) for i in range(4)]
    assert np.sqrt(np.mean([tilt_error(log) ** 2 for log in logs])) < 0.5


def tilt_error(log) -> float:
    """deg; root mean square from the thousandth sample of a log of ``drives`` on."""
    found = run(Recording.from_arrays(time=log.time, gyro=log.gyro, accel=log.accel))
    axes = (Rotation.from_quat(q, scalar_first=True) for q in (found.q, log.q))
    up, true = (a.inv().apply([0, 0, 1]) for a in axes)
    tilt = 2 * np.arcsin(np.linalg.norm(up - true, axis=1) / 2)
    return float(np.degrees(np.sqrt(np.mean(tilt[1000:] ** 2))))


def test_a_hand_whose_velocity_stays_bounded_is_estimated_the_same_without_it():
    """No tilt shows that the scale factors would have made. Where gravity was believed the more for
    what they may have made, the attitude was another by up to 9e-3 rad.
    """
    log = hand(1.0, 0.3, 2.0, 2.0)(np.random.default_rng([99, 0]))
    recording = Recording.from_arrays(time=log.time, gyro=log.gyro, accel=log.accel)
    one, two = (run(recording, part(), settings={"scale_std": v}) for v in (0.0, 0.02))
    np.testing.assert_allclose(one.q, two.q, atol=1e-4)


PART = """name = "measured"
sample_rate = {value = 50.0, unit = "Hz"}
[gyro.angle_random_walk]
N = {value = 1e-4, unit = "rad/sqrt(s)", source = "a log at rest"}
"""
ALLOWED = """[tolerance.gyro.scale_factor]
s = {value = 3.0, unit = "%", distribution = "uniform", source = "a data sheet"}
"""


def test_the_scale_factor_is_unsure_without_a_part_or_as_its_data_sheet_says():
    """A part that is silent of it is taken as calibrated."""
    assert run(turned(0)).parameters["scale_std"] == scale_std(None) == NOMINAL_SCALE_STD
    assert run(turned(0), part()).parameters["scale_std"] == 0
    allowed = parse_part(PART + ALLOWED, "part.toml")
    assert run(turned(0), allowed).parameters["scale_std"] == pytest.approx(0.03 / 3**0.5)
