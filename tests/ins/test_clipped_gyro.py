"""A gyro that is driven to its limit in fast turns: navigation draws the rates beyond it as the
attitude filter does, and claims no more than they are worth."""

from dataclasses import replace
from importlib import import_module

import numpy as np
import pytest
from navigation_cases import first_heading, square
from scipy.stats import chi2
from walks import walk

from pyimu import Recording
from pyimu.ins import run

H, G, LIMIT, RUNS = 0.01, 9.80665, 2.0, 8


def spun(seed):
    """A robot that turns on the spot, often faster than its gyro's range, and stands between; and
    its true yaw (n,) in rad."""
    rng = np.random.default_rng(5000 + seed)
    pieces = [np.zeros(600)]
    for _ in range(12):
        n = rng.integers(80, 160)
        turn = rng.choice([-1, 1]) * rng.uniform(1.5, 3.0) * np.sin(np.pi * np.arange(n) / n) ** 2
        pieces += [turn, np.zeros(150)]
    rate = np.concatenate(pieces)
    white = 2e-3 * rng.standard_normal((len(rate), 3))
    gyro = np.outer(rate, [0.0, 0.0, 1.0]) + white + 5e-3 * rng.standard_normal(3)
    accel = [0, 0, G] + 0.02 * rng.standard_normal((len(rate), 3))
    yaw = np.concatenate([[0.0], np.cumsum((rate[1:] + rate[:-1]) / 2)]) * H
    gyro = np.clip(gyro, -LIMIT, LIMIT)
    return Recording.from_arrays(time=H * np.arange(len(rate)), gyro=gyro, accel=accel), yaw


def off(seed):
    """By how many rad the yaw is off at the end, and its standard deviation."""
    log, yaw = spun(seed)
    track = run(log, method="filter", heading0=0.0).tracks["filter"]
    turned = np.angle(np.exp(1j * (track.yaw[-1] - yaw[-1])))
    return float(turned), float(track.attitude_std[-1, 2])


def test_the_turns_beyond_the_range_are_drawn_and_their_error_is_claimed(monkeypatch):
    """The sum of squares is that of as many normal numbers: one in 10,000 is larger. The claims are
    a tenth of what a robot of 2 rad/s may have turned meanwhile."""
    errors, stds = np.transpose([off(seed) for seed in range(RUNS)])
    assert np.sum((errors / stds) ** 2) < chi2.isf(1e-4, RUNS)
    module = import_module("pyimu.ins.run")  # the package's name is that of the function
    monkeypatch.setattr(module, "by_axis", lambda log, part, untold: (log, [0.0] * 3))
    before, wide = off(0)
    assert abs(errors[0]) < abs(before) / 3
    assert np.median(stds) < wide / 5


def test_swings_of_a_foot_that_are_all_beyond_the_range_are_drawn():
    """Of none the log tells how its like goes on. Left at the limit, or judged by the shorter spans
    of the same axis, these walks ended 13 and 9 m off, and the squares were 4,000 and 26. One sum
    of as many normal numbers in 10,000 is larger."""
    range_, total, far = np.radians(250.0), 0.0, []
    for seed in (5001, 5002):
        own, rng = walk(seed, seconds=30.0), np.random.default_rng(seed)
        noise = [std * rng.standard_normal((len(own.time), 3)) for std in (1.4e-3, 0.03)]
        gyro = np.clip(own.rate + noise[0], -range_, range_)
        log = Recording.from_arrays(time=own.time, gyro=gyro, accel=own.force + noise[1])
        track = run(log, method="filter", heading0=first_heading(own)).tracks["filter"]
        total += square(track, own.place[-1])
        far.append(np.linalg.norm(track.position[-1] - own.place[-1]))
    assert total < chi2.isf(1e-4, 6)
    assert max(far) < 2.5


def test_samples_that_are_missing_may_hide_any_turn():
    """Beside spans that are drawn: half a second without numbers is 1 rad at the top turn rate."""
    log, _ = spun(1)
    gyro = log.gyro.copy()
    gyro[700:750] = np.nan
    found = run(replace(log, gyro=gyro), method="filter", heading0=0.0)
    assert found.filter.vector("attitude_std")[755, 2] == pytest.approx(1.0, rel=0.1)
