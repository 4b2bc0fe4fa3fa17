"""Integration alone: the exact one against the true motion, the paper's against its formula."""

from dataclasses import replace

import numpy as np
import pytest
from navigation_cases import perfect

from pyimu.errors import UserError
from pyimu.ins import strapdown, strapdown_wongwirat
from pyimu.recording.recording import Recording
from pyimu.rover.trajectory import Drive
from pyimu.symbolic.earth import EARTH_RATE
from pyimu.units import STANDARD_GRAVITY

TILTED = Drive(tilt=(0.02, 0.01))


def off(recording, path):
    truth = np.column_stack([recording.ref_east, recording.ref_north, recording.ref_up])
    return np.linalg.norm(path.position - truth, axis=1).max()


def by_strapdown(rate):
    recording = perfect(TILTED, rate)
    return off(recording, strapdown(recording, recording.ref_q[0], latitude=TILTED.latitude))


def test_strapdown_is_of_second_order_and_below_a_millimetre_at_100_hz():
    """Halving the period quarters the error or does better; 2^1.9 leaves room for other orders."""
    coarse, fine = by_strapdown(100.0), by_strapdown(200.0)
    assert coarse < 1e-3
    assert coarse / fine > 2**1.9


def test_an_hour_at_rest_with_the_earth_rate_known_stays_in_its_place():
    n, latitude = 3600 * 10, 0.8
    earth = EARTH_RATE * np.array([0.0, np.cos(latitude), np.sin(latitude)])
    recording = Recording.from_arrays(
        time=np.arange(n) / 10,
        gyro=np.tile(earth, (n, 1)),
        accel=np.tile([0.0, 0.0, STANDARD_GRAVITY], (n, 1)),
    )
    path = strapdown(recording, np.array([1.0, 0, 0, 0]), latitude=latitude)
    assert np.abs(path.position).max() < 1e-3
    without = strapdown(recording, np.array([1.0, 0, 0, 0]))
    assert np.linalg.norm(without.position[-1]) > 1e3


@pytest.mark.parametrize("rate", (100.0, 50.0, 20.0, 10.0))
def test_wongwirat_eq_7_leaves_the_matrix_too_large_by_the_turn(rate):
    """C (1 + [w h]x): each step lengthens the columns across the axis by sqrt(1 + (w h)^2), so that
    after an angle a of steps w h the square is (1 + (w h)^2)^(a / (w h))."""
    w = np.radians(45.0)
    n = round(2 * np.pi / w * rate)
    recording = Recording.from_arrays(
        time=np.arange(n + 1) / rate,
        gyro=np.tile([0.0, 0.0, w], (n + 1, 1)),
        accel=np.tile([0.0, 0.0, STANDARD_GRAVITY], (n + 1, 1)),
    )
    c = strapdown_wongwirat(recording, cutoff=None).matrix[-1]
    want = (1 + (w / rate) ** 2) ** n - 1
    np.testing.assert_allclose(c.T @ c - np.eye(3), want * np.diag([1, 1, 0]), atol=1e-12)
    exact = strapdown_wongwirat(recording, cutoff=None, orthonormal=True).matrix[-1]
    assert np.abs(exact.T @ exact - np.eye(3)).max() < 2 * (w / rate) ** 4 * n + 1e-12


def test_wongwirat_eq_8_turns_counter_clockwise():
    """The lost signs: a positive rate about z turns x towards y, and yaw grows."""
    recording = perfect(replace(TILTED, legs=1))
    path = strapdown_wongwirat(recording, recording.ref_q[0], cutoff=None)
    assert path.euler[-1, 2] == pytest.approx(np.pi / 2, abs=0.01)


def test_wongwirat_eqs_1_to_3_hold_the_acceleration_over_a_step():
    h, n = 0.1, 50
    force = np.zeros((n, 3))
    force[:, 0], force[:, 2] = np.random.default_rng(0).normal(size=n), STANDARD_GRAVITY
    recording = Recording.from_arrays(time=h * np.arange(n), gyro=np.zeros((n, 3)), accel=force)
    path = strapdown_wongwirat(recording, cutoff=None)
    v, x = 0.0, 0.0
    for k in range(1, n):
        a = force[k, 0]
        x, v = x + v * h + a * h * h / 2, v + a * h
        assert path.velocity[k, 0] == pytest.approx(v, abs=1e-12)
        assert path.position[k, 0] == pytest.approx(x, abs=1e-12)


def test_nulls_take_off_what_a_rest_shows():
    recording = perfect(Drive(legs=1))
    biased = replace(recording, gyro=recording.gyro + 0.01, accel=recording.accel + [0.1, 0.2, 0.3])
    clean, nulled = (strapdown_wongwirat(r, r.ref_q[0], nulls=9.0) for r in (recording, biased))
    np.testing.assert_allclose(nulled.position, clean.position, atol=1e-9)


def test_a_missing_sample_is_refused_with_its_time():
    recording = perfect(Drive(legs=1))
    recording.gyro[150, 1] = np.nan
    with pytest.raises(UserError, match=r"gyro is missing at 1\.5 s"):
        strapdown(recording, recording.ref_q[0])
