"""Logs that begin in motion: what their first two minutes tell of attitude, bias and pushes."""

import numpy as np
import pytest
from attitude_cases import GRAVITY
from drives.bodies import at_sea
from drives.starts import car
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

from pyimu.attitude import run
from pyimu.attitude.filter.long_push import EXCLUDED
from pyimu.attitude.underway import BIAS_STD, LASTS, LONGEST, PUSH_STD, TWICE, underway
from pyimu.recording.recording import Recording

RATE = 20.0
SMALL = 1e-6
"""Probability by which a test of a statistic fails by chance, to either side."""


def turned(rng, duration: float) -> tuple[np.ndarray, Rotation]:
    """Times, and attitudes of a body that turns about all axes, from any attitude on."""
    t = np.arange(round(duration * RATE) + 1) / RATE
    waves = np.sin(2 * np.pi * (t[:, None] / rng.uniform(3, 9, 3) + rng.random(3)))
    axes = Rotation.from_euler("ZYX", 0.3 * waves) * Rotation.random(rng=rng)
    return t, axes


def recorded(t, axes: Rotation, pushed, bias, scale=0.0) -> Recording:
    rate = (axes[:-1].inv() * axes[1:]).as_rotvec() * RATE
    force = axes[1:].inv().apply(pushed + [0, 0, GRAVITY])
    return Recording.from_arrays(time=t[1:], gyro=rate * (1 + scale) + bias, accel=force)


def off(found, axes: Rotation) -> np.ndarray:
    """The tilt (2,) in rad of what is found at the first sample."""
    level = axes[1].apply(found.force / np.linalg.norm(found.force))
    return level[:2]


def test_what_never_is_pushed_shows_the_vertical_and_the_bias():
    """The bias along the vertical shows by no more than how far the body tilts meanwhile."""
    rng = np.random.default_rng(1)
    for _ in range(3):
        t, axes = turned(rng, 150.0)
        bias = 0.005 * rng.standard_normal(3)
        found = underway(recorded(t, axes, np.zeros(3), bias))
        assert found.duration == pytest.approx(LONGEST, abs=1 / RATE)
        assert np.linalg.norm(off(found, axes)) < found.tilt_std < 0.02
        up = axes.inv().apply([0.0, 0.0, 1.0]).mean(axis=0)
        assert (np.abs(found.bias - bias) < found.bias_std).all()
        assert np.linalg.norm(np.cross(found.bias - bias, up)) < BIAS_STD / 30
        assert found.push_std < PUSH_STD / 3
        assert (found.bias_std < BIAS_STD).all()


def test_tilt_and_bias_are_as_unsure_as_it_says():
    """Of bodies with its own pushes, biases and scale factors: the mean of the squared error over
    the variance has the scatter of as many squares as there are bodies.
    """
    rng, tilts, biases, pushes = np.random.default_rng(2), [], [], []
    stays, std, n = np.exp(-1 / (RATE * LASTS)), 0.5, 30
    for _ in range(n):
        t, axes = turned(rng, LONGEST)
        drawn = std * rng.standard_normal((len(t) - 1, 2)) * np.sqrt(1 - stays**2)
        pushed = np.zeros((len(t) - 1, 3))
        now = std * rng.standard_normal(2)
        for row, one in zip(pushed, drawn, strict=True):
            now = stays * now + one
            row[:2] = now
        bias = BIAS_STD * rng.standard_normal(3)
        found = underway(recorded(t, axes, pushed, bias, 0.02 * rng.standard_normal(3)))
        tilts.append(np.sum(off(found, axes) ** 2) / found.tilt_std**2)
        biases.append(np.mean((found.bias - bias) ** 2 / found.bias_std**2))
        pushes.append(found.push_std)
    least, most = chi2.ppf([SMALL, 1 - SMALL], 2 * n) / n
    assert least < np.mean(tilts) < most
    assert np.mean(biases) < chi2.ppf(1 - SMALL, n) / n
    # A mean over 5 s has 0.86 of such a push, and what the fit takes is not in it.
    assert 0.7 * std < np.mean(pushes) < std


def test_a_boat_in_waves_is_told_from_a_car_in_bends():
    for seed in range(2):
        for body, few in (
            (at_sea(np.random.default_rng(seed), 8.0, 0.5), True),
            (
                car(np.random.default_rng(seed)),
                False,
            ),
        ):
            log = Recording.from_arrays(time=body.time, gyro=body.gyro, accel=body.accel)
            assert (underway(log).push_std ** 2 < EXCLUDED) == few


def test_the_filter_starts_with_it_but_for_what_is_given():
    rng = np.random.default_rng(3)
    t, axes = turned(rng, 30.0)
    log = recorded(t, axes, 0.1 * rng.standard_normal((len(t) - 1, 3)), np.zeros(3))
    found, result = underway(log), run(log)
    assert result.rest.underway.push_std == found.push_std == result.parameters["push_std"]
    std = np.array([result.parameters[f"std0[{i}]"] for i in (1, 2, 3)])
    up = found.force / np.linalg.norm(found.force)
    level = np.sqrt(1 - up**2)
    np.testing.assert_allclose(std, TWICE * found.tilt_std * level, rtol=0.01, atol=1e-3)
    given = run(log, q0=axes[1].as_quat(scalar_first=True))
    assert given.parameters["push_std"] == 0


def test_what_is_missing_is_left_out():
    rng = np.random.default_rng(4)
    t, axes = turned(rng, 60.0)
    log = recorded(t, axes, np.zeros(3), np.zeros(3))
    whole = underway(log)
    holed = log.accel.copy()
    holed[rng.random(len(holed)) < 0.2] = np.nan
    part = underway(Recording.from_arrays(time=log.time, gyro=log.gyro, accel=holed))
    np.testing.assert_allclose(part.force, whole.force, atol=0.3)
    lost = log.gyro.copy()
    lost[::10] = np.nan
    holed[:600] = np.nan
    for gyro, accel in ((lost, log.accel), (log.gyro, holed), (log.gyro, None)):
        kept = {} if accel is None else {"accel": accel}
        assert underway(Recording.from_arrays(time=log.time, gyro=gyro, **kept)) is None
    assert underway(log.slice(0, 8)) is None


def test_over_a_short_gap_the_body_turns_on_and_a_long_one_is_the_end():
    rng = np.random.default_rng(6)
    t, axes = turned(rng, 60.0)
    log = recorded(t, axes, np.zeros(3), np.zeros(3))

    def without(first: int, count: int) -> Recording:
        kept = np.ones(len(log.time), dtype=bool)
        kept[first : first + count] = False
        columns = (log.time[kept], log.gyro[kept], log.accel[kept])
        return Recording.from_arrays(**dict(zip(("time", "gyro", "accel"), columns, strict=True)))

    whole, short, long = underway(log), underway(without(500, 3)), underway(without(500, 20))
    assert short.duration == pytest.approx(whole.duration, abs=0.3)
    assert long.duration == pytest.approx(500 / RATE, abs=0.1)
    for found in (whole, short, long):
        assert np.linalg.norm(off(found, axes)) < found.tilt_std


def test_a_short_log_knows_less():
    """The shorter, the less is known of the tilt, by the velocity of a hand over the time."""
    rng = np.random.default_rng(5)
    t, axes = turned(rng, 60.0)
    log = recorded(t, axes, np.zeros(3), np.zeros(3))
    stds = [underway(log.slice(0, round(s * RATE))).tilt_std for s in (0.6, 2, 6, 20, 60)]
    assert (np.diff(stds) < 0).all() and stds[0] > 0.1
