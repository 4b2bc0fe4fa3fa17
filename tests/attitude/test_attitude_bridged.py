"""Single missing samples are set between their neighbours, and make the estimate no less sure."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import chi2

from pyimu import Recording, attitude
from pyimu.attitude.bridged import bridged
from pyimu.attitude.rest import find_rest

N, H, WHITE = 6000, 0.01, 3e-3
TIME = H * np.arange(N)


def log(seed: int, fast: float = 0.3, share: float = 0.05) -> tuple[Recording, float]:
    """A level body that turns to and fro at ``fast`` Hz, and its last yaw in rad.

    Of a ``share`` of the rows nothing was measured.
    """
    rng = np.random.default_rng(seed)
    rate = np.where(TIME < 5, 0.0, 0.8 * np.sin(2 * np.pi * fast * (TIME - 5)))
    gyro = np.column_stack([0 * rate, 0 * rate, rate]) + rng.normal(0, WHITE, (N, 3))
    accel = np.tile([0.0, 0.0, 9.80665], (N, 1)) + rng.normal(0, 0.02, (N, 3))
    holes = (rng.random(N) < share) & (TIME > 1) & (TIME < TIME[-1])
    gyro[holes], accel[holes] = np.nan, np.nan
    return Recording.from_arrays(time=TIME, gyro=gyro, accel=accel), float(np.sum(rate) * H)


def rest_of(recording: Recording):
    return find_rest(recording, 9.80665)


@pytest.mark.long
def test_the_heading_is_as_sure_as_without_the_holes_and_honest():
    """The squares of 16 errors over what is claimed, at most those of chi squared: a gyro without
    part may have errors that grow with the rate, which this one has not.
    """
    z = []
    for seed in range(16):
        whole, torn = log(seed, share=0.0)[0], log(seed)
        result = attitude.run(torn[0])
        assert result.heading_std[-1] < 1.1 * attitude.run(whole).heading_std[-1]
        z.append((result.euler[-1, 2] - torn[1]) / result.heading_std[-1])
    assert np.sum(np.square(z)) < chi2.ppf(1 - 1e-4, len(z))


def test_their_rows_are_said():
    torn, _ = log(1)
    holes = np.isnan(torn.gyro[:, 0])
    result = attitude.run(torn)
    assert (result.status[holes] & 1).all() and not (result.status[~holes] & 1).any()


def test_a_body_that_shakes_between_two_samples_is_lost_without_one():
    """At a fifth of the sample rate the line between two neighbours tells nothing of the third."""
    torn, _ = log(2, fast=20.0)
    same, rows = bridged(torn, rest_of(torn), None)
    assert same is torn and not len(rows)


@pytest.mark.parametrize("missing, seen", [(1, True), (3, True), (40, False)])
def test_a_short_span_is_bridged_and_a_long_one_is_not(missing, seen):
    whole, _ = log(3, share=0.0)
    gyro = whole.gyro.copy()
    gyro[3000 : 3000 + missing] = np.nan
    found, rows = bridged(replace(whole, gyro=gyro), rest_of(whole), None)
    assert np.isfinite(found.gyro).all() == seen
    assert rows.tolist() == (list(range(3000, 3000 + missing)) if seen else [])
    if seen:
        assert np.abs(found.gyro - whole.gyro).max() < 5 * np.sqrt(2) * WHITE


def test_an_axis_that_is_never_there_stays_missing():
    torn, _ = log(4)
    gyro = torn.gyro.copy()
    gyro[:, 0] = np.nan
    found, _ = bridged(replace(torn, gyro=gyro), rest_of(torn), None)
    assert np.isnan(found.gyro[:, 0]).all()
