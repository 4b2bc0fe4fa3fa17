"""A gyro that warms up, as the first rests of a log show it."""

import numpy as np
import pytest
from attitude_cases import GRAVITY, N_ACCEL, H, K, N, part

from pyimu.attitude import run
from pyimu.attitude.early_drift import early_drift
from pyimu.attitude.rest import find_rest
from pyimu.recording.recording import Recording

REST, MOTION, SPANS = 12.0, 20.0, 5
"""s, and how many of each follow one another."""


def swinging(levels, seed: int = 0, walk: float = 0.0):
    """A log of rests, each with its ``levels`` (n, 3) rad/s of the bias, which changes evenly in
    the motion between two, in which it swings about its x axis; and the bias (n, 3), which walks
    beside that.
    """
    rng = np.random.default_rng([21, seed])
    rest, motion = np.zeros(round(REST / H)), H * np.arange(round(MOTION / H))
    swing = 0.6 * np.sin(2 * np.pi * motion / MOTION) * np.sin(2 * np.pi * motion / 4.0)
    angle = np.concatenate([rest, *(np.concatenate([swing, rest]) for _ in levels[1:])])
    ends = [
        t for i in range(len(levels)) for t in (i * (REST + MOTION), i * (REST + MOTION) + REST)
    ]
    time = H * np.arange(len(angle))
    bias = np.stack([np.interp(time, ends, np.repeat(v, 2)) for v in np.transpose(levels)], axis=1)
    bias += walk * H**0.5 * np.cumsum(rng.standard_normal(bias.shape), axis=0)
    gyro = bias + N / H**0.5 * rng.standard_normal(bias.shape)
    gyro[:, 0] += np.gradient(angle, H)
    up = np.stack([np.zeros_like(angle), np.sin(angle), np.cos(angle)], axis=1)
    accel = GRAVITY * up + N_ACCEL / H**0.5 * rng.standard_normal(up.shape)
    return Recording.from_arrays(time=time, gyro=gyro, accel=accel), bias


def warming(size: float, seed: int = 0):
    """Levels of a gyro that warms up by ``size`` rad/s, half of what is left at each rest."""
    away = np.random.default_rng([22, seed]).standard_normal(3)
    away /= np.linalg.norm(away)
    return size * (1 - 0.5 ** np.arange(SPANS))[:, None] * away


def found(recording: Recording, k: float = K) -> float:
    return early_drift(recording, part(k=k), find_rest(recording))


def test_a_gyro_as_its_part_says_drifts_by_nothing():
    """Of a pair of rests one in a thousand shows more than noise: of twenty logs with four pairs
    three do so once in 6,000.
    """
    logs = [swinging(np.zeros((SPANS, 3)), i, K)[0] for i in range(20)]
    assert sum(found(r) > 0 for r in logs) <= 2


@pytest.mark.parametrize("size", [0.01, 0.018])
def test_the_first_rests_show_how_fast_it_drifts(size):
    """Of the first two, which are ``REST`` and ``MOTION`` apart: half of the drift."""
    for seed in range(3):
        recording, _ = swinging(warming(size, seed), seed)
        density = (size / 2) ** 2 / (3 * (REST + MOTION))
        assert found(recording, 1e-5) == pytest.approx(density**0.5, rel=0.3), seed


def test_a_turn_about_the_vertical_is_no_drift():
    """It stops again; a bias that went as far and stays there has drifted."""
    up = np.array([0.0, 0.0, 0.008])
    assert found(swinging([0 * up, up, 0 * up, up, 0 * up])[0]) == 0
    assert found(swinging([0 * up, up, up, up, up])[0]) > 0
    assert found(swinging([0 * up, *[4 * up] * 4])[0]) == 0


def test_the_standard_deviations_have_the_drift_before_a_rest_shows_it():
    """At the end of the first motion, when no rest has shown that the bias is another. Of six logs
    the sum of the squared errors over the claimed variances of three axes, chi-squared of 18, is
    beyond 51 once in 20,000; without the drift the bias is 20 standard deviations off.
    """
    row = round((REST + 0.9 * MOTION) / H)
    sums = {}
    for settings in ({}, {"bias_drift": 0.0}):
        total = 0.0
        for seed in range(6):
            recording, bias = swinging(warming(5e-3, seed), seed)
            result = run(recording, part(k=1e-5), settings=settings)
            off = result.gyro_bias[row] - bias[row]
            total += np.sum((off / result.std[row, 3:]) ** 2)
        sums[bool(settings)] = total
    assert sums[False] < 51 < sums[True], sums


def test_the_report_says_that_the_gyro_drifts():
    recording, _ = swinging(warming(5e-3))
    result = run(recording, part(k=1e-5))
    assert "gyro's bias is another from rest to rest" in result.report()
    assert [f.kind for f in result.findings if f.kind == "gyro_drifts"]
    assert "gyro_drifts" not in str(run(swinging(np.zeros((2, 3)))[0], part()).findings)
    told = run(recording, part(k=1e-5), settings={"bias_drift": 1e-4})
    assert "gyro_drifts" not in str(told.findings)
