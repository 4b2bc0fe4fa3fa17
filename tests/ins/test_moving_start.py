"""Logs that begin in the middle of a drive: excerpts, as recorders of vehicles cut them."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import chi2
from vehicle_drives import figure_eight, measured_by, received

from pyimu import Recording
from pyimu.ins import run

BIAS = np.array([0.006, -0.009, 0.004])
"""rad/s; of a consumer part, far beyond what a rest shows of its noise."""

FAST, STD = 12.0, 1.0
"""m/s of the vehicle, and m of a receiver's positions, one a second."""


def excerpt(seed, begins=30.0, stands=True):
    """A drive from its middle on, at speed, with the stand that follows, or without any."""
    drive = figure_eight(seed, fast=FAST)
    gyro, accel = measured_by(drive, np.eye(3), 0.0, seed)
    north, east = received(drive, STD, seed + 100, every=100)
    at = slice(np.searchsorted(drive.time, begins), None if stands else 7000)
    log = Recording.from_arrays(
        "excerpt",
        time=drive.time[at],
        gyro=(gyro + BIAS)[at],
        accel=accel[at],
        position_east=east[at],
        position_north=north[at],
        ref_east=drive.place[at, 0],
        ref_north=drive.place[at, 1],
    )
    return replace(log, heading=np.where(np.arange(len(log)) == 0, drive.course[at], np.nan))


@pytest.mark.parametrize(
    ("seed", "nhc"), [(1, False), (2, True), pytest.param(3, False, marks=pytest.mark.long)]
)
def test_an_excerpt_that_begins_at_speed_is_followed(seed, nhc):
    """One in 10,000 ends is further off than that by its own covariance; the path is nearer to the
    truth than its positions are.
    """
    log = excerpt(seed)
    found = run(log, position_std=STD, settings={"top_speed": 20.0}, nhc=nhc, method="smoother")
    track = found.tracks["smoother"]
    truth = np.column_stack([log.ref_east, log.ref_north])
    off = track.position[:, :2] - (truth - truth[0])
    start = STD  # the first measured position is the origin
    spread = track.position_std[-1, :2] ** 2 + start**2
    assert np.sum(off[-1] ** 2 / spread) < chi2.isf(1e-4, 2)
    off = off - off.mean(axis=0)
    assert np.sqrt(np.mean(np.sum(off**2, axis=1))) < np.sqrt(2) * STD
    # The stand shows the bias that the drive before it had.
    np.testing.assert_allclose(
        [found.settings[f"gyro_bias0[{i}]"] for i in (1, 2, 3)], BIAS, rtol=0, atol=5e-4
    )
    assert found.still.sum() > 500


def test_a_rest_later_tells_the_noise_of_a_log_that_begins_in_motion():
    log = excerpt(4)
    found = run(log, position_std=STD, settings={"top_speed": 20.0}, method="filter")
    assert "no rest at the start: the gyro's bias there is that of a later" in found.report()
    assert "the noise of the part is too small" not in found.report()
    first = [found.settings[f"velocity0[{i}]"] for i in (1, 2)]
    truth = np.array([log.ref_east[10] - log.ref_east[0], log.ref_north[10] - log.ref_north[0]])
    off = np.sum((first - truth / 0.1) ** 2) / found.settings["velocity_std0"] ** 2
    assert off < chi2.isf(1e-4, 2)
    never = run(
        excerpt(4, stands=False), position_std=STD, settings={"top_speed": 20.0}, method="filter"
    )
    assert "tilt and biases were not known" in never.report()
    assert "noise of the log's own start" in never.report()
    assert never.settings["gyro_bias0[1]"] == 0.0 and never.settings["gyro_bias_std0[1]"] == 0.1


def test_a_log_without_any_rest_that_shows_the_noise_has_none():
    """A vehicle that rides smoothly for moments: what its noisy motion shows is none of a rest, and
    a bias that nobody knows tells no turn from none. Those moments are at 5 to 10 m/s."""
    log = excerpt(6, stands=False)
    rng = np.random.default_rng(6)
    shaken = np.where(log.time % 10 < 9, 1.0, 0.0)[:, None]
    log = replace(
        log,
        gyro=log.gyro - BIAS + 0.01 * shaken * rng.standard_normal(log.gyro.shape),
        accel=log.accel + 0.3 * shaken * rng.standard_normal(log.accel.shape),
    )
    found = run(log, position_std=STD, settings={"top_speed": 20.0}, method="filter")
    assert not found.still.any()
    assert "There is no rest in this log" in found.report()
