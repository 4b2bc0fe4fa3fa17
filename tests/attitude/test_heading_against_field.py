"""Headings and a magnetometer that differ are said to, with the angle; those that agree are not."""

import re

import numpy as np
import pytest
from scipy.stats import chi2

from pyimu import Recording, attitude
from pyimu.attitude.heading_against_field import field_against_headings

N, H, STD = 4000, 0.02, 0.035
TIME = H * np.arange(N)
FIELD = np.array([0.0, 19e-6, -45e-6])


def log(seed: int, off: float = 0.0, late: float = 0.0, **more) -> tuple[Recording, np.ndarray]:
    """A level body that turns to and fro, its headings ``off`` by so many rad; and its yaw (n,)."""
    rng = np.random.default_rng(seed)
    rate = np.where(TIME < 5, 0.0, 0.6 * np.sin(2 * np.pi * (TIME - 5) / 17))
    yaw = np.cumsum(rate) * H
    c, s, up = np.cos(yaw), np.sin(yaw), np.ones(N)
    mag = np.column_stack([FIELD[1] * s, FIELD[1] * c, FIELD[2] * up]) + rng.normal(0, 3e-7, (N, 3))
    gyro = np.column_stack([0 * rate, 0 * rate, rate]) + rng.normal(0, 1e-3, (N, 3))
    accel = np.tile([0.0, 0.0, 9.80665], (N, 1)) + rng.normal(0, 0.02, (N, 3))
    heading = np.full(N, np.nan)
    heading[::25] = (np.interp(TIME - late, TIME, yaw) + off + rng.normal(0, STD, N))[::25]
    samples = {"time": TIME, "gyro": gyro, "accel": accel, "mag": mag, "heading": heading}
    return Recording.from_arrays(**samples, heading_std=np.full(N, STD), **more), yaw


def found(seed: int, off: float, declination: float = 0.0):
    recording, yaw = log(seed, off)
    q = np.column_stack([np.cos(yaw / 2), 0 * yaw, 0 * yaw, np.sin(yaw / 2)])
    return field_against_headings(recording, q, declination, 0.0)


@pytest.mark.parametrize("degrees", [15.0, -15.0, 170.0])
def test_the_angle_is_off_by_as_much_as_is_said(degrees):
    """A median's variance is pi/2 of a mean's, of the squares of 30 errors over what is said."""
    off = np.radians(degrees)
    details = [found(seed, off).detail for seed in range(30)]
    z = np.array([np.angle(np.exp(1j * (d["angle"] - off))) / d["std"] for d in details])
    assert np.sum(z**2) < np.pi / 2 * chi2.ppf(1 - 1e-4, len(z))
    assert max(d["std"] for d in details) < 0.02


def test_those_that_agree_are_left_alone():
    assert [found(seed, 0.0) for seed in range(30)] == [None] * 30
    assert found(1, np.radians(-15.0), np.radians(15.0)) is None


def test_it_is_said_with_the_declination_that_would_explain_it():
    result = attitude.run(log(2, np.radians(15.0))[0])
    (told,) = re.findall(r"a declination of (-?[\d.]+) deg", result.report())
    (angle,) = (f.detail for f in result.findings if f.kind == "heading_against_field")
    assert float(told) == pytest.approx(-np.degrees(angle["angle"]), abs=0.06)
    assert abs(float(told) + 15) < 4 * np.degrees(angle["std"])
    told = attitude.run(log(2, np.radians(15.0))[0], settings={"declination": np.radians(-15.0)})
    assert "against the magnetometer" not in told.report()
    off = attitude.run(log(2, np.radians(15.0))[0], settings={"declination": np.radians(15.0)})
    assert "one of the two is mounted askew" in off.report()


def test_headings_that_are_late_alone_do_not_differ():
    kinds = {f.kind for f in attitude.run(log(3, late=0.5)[0]).findings}
    assert "heading_late" in kinds and "heading_against_field" not in kinds
