"""Without a part: what is assumed of sensors of which nothing is known."""

from dataclasses import replace

import numpy as np
from navigation_cases import SHORT, assumed, declared
from scipy.stats import chi2

from pyimu import Recording
from pyimu.ins import run
from pyimu.ins.known import unknown_tolerances
from pyimu.model.typical import magnitudes
from pyimu.rover.trajectory import motion


def test_the_yaw_after_turns_is_as_far_off_as_is_claimed():
    """A scale factor that is 2 % off leaves the yaw 3.6 deg off after half a turn: the sum of its
    squares over the claimed variance is chi-square distributed, and no more than one in 10,000 is
    larger."""
    squares, runs = 0.0, 6
    for seed in range(runs):
        log = declared(assumed().specimen(seed).simulate(motion(SHORT, 50.0), seed=seed), SHORT)
        track = run(log, method="filter").tracks["filter"]
        w, x, y, z = log.ref_q[-1]
        off = track.yaw[-1] - np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
        squares += (np.angle(np.exp(1j * off)) / track.attitude_std[-1, 2]) ** 2
    assert chi2.isf(0.9999, runs) < squares < chi2.isf(1e-4, runs)


def test_the_typical_figures_are_limits_and_the_gyros_scale_is_the_attitude_filters():
    std = {t.key: t.std for t in unknown_tolerances()}
    assert set(std["gyro", "scale_factor", "s"]) == {0.02}
    for kind, effect, name in (
        ("accel", "scale_factor", "s"),
        ("gyro", "misalignment", "m"),
        ("accel", "misalignment", "m"),
    ):
        most = magnitudes(effect, kind)["consumer"].si
        own = std[kind, effect, name]
        np.testing.assert_allclose(own[own > 0], most / np.sqrt(3))


def test_a_part_without_tolerances_is_taken_as_calibrated():
    log = declared(motion(SHORT, 50.0), SHORT)
    log = replace(log, gyro=log.ref_rate, accel=log.ref_force)
    assert run(log, replace(assumed(), tolerances=()), method="filter").gains == 0
    assert run(log, method="filter").gains == 18


def _standing(rate):
    """20 s at 100 Hz by a consumer unit that shows this mean rate (3,) rad/s."""
    rng, n = np.random.default_rng(7700), 2000
    noise = rng.standard_normal((2, n, 3))
    gyro, accel = rate + 8e-4 * noise[0], np.array([0.6, -0.9, 9.7]) + 0.03 * noise[1]
    return Recording.from_arrays(time=0.01 * np.arange(n), gyro=gyro, accel=accel)


def test_a_rest_of_a_gyro_with_a_large_null_is_told_by_gravity():
    """Rates of 20 and 30 deg/s across gravity would turn the force; about it alone they may be a
    turntable's. Both were called turns, and nothing of such a log rested."""
    for zupt in ("auto", "live"):
        found = run(_standing([0.35, -0.5, 0.4]), method="filter", zupt=zupt)
        assert found.rest.seen and found.still.mean() > 0.9
    found = run(_standing([0.0, 0.0, 0.5]), method="filter")
    assert not found.rest.seen and not found.still.any()
