"""Vehicles that lean into their turns, as those on two wheels do."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation

from pyimu.recording.recording import Recording
from pyimu.recording.reference.leaning import upward_through
from pyimu.recording.reference.rate import reference_rate

G0 = 9.80665
SPEED = 10.0
HZ = 100.0


def ride(leans: bool, seconds: float = 120.0):
    """A ride at constant speed with turns of 5 s to either side: recording, lean (n,) rad to the
    right, rate (n,) rad/s of the heading.

    Two wheels lean by the angle whose tangent is the centripetal force over gravity.
    """
    time = np.arange(0, seconds, 1 / HZ)
    eased = np.clip(np.sin(2 * np.pi * time / 10.0) - 0.2, 0.0, None) / 0.8
    rate = 0.45 * eased**2 * np.where(time // 10 % 2, 1.0, -1.1)
    lean = -np.arctan(SPEED * rate / G0) if leans else 0.0 * rate
    heading = CubicSpline(time, rate).antiderivative()(time)
    attitude = Rotation.from_euler("ZX", np.column_stack([heading, lean]))
    world = np.column_stack([0 * rate, 0 * rate, rate])
    slope = CubicSpline(time, lean)(time, 1)
    gyro = attitude.inv().apply(world) + np.column_stack([slope, 0 * rate, 0 * rate])
    along = np.column_stack([-np.sin(heading), np.cos(heading), 0 * rate])
    force = attitude.inv().apply(SPEED * rate[:, None] * along + [0, 0, G0])
    east, north = (
        CubicSpline(time, f(heading) * SPEED).antiderivative()(time) for f in (np.cos, np.sin)
    )
    fix, noise = (
        np.arange(len(time)) % 10 == 0,
        np.random.default_rng(5).normal(0, 0.01, (2, len(time))),
    )
    east, north = (np.where(fix, v + e, np.nan) for v, e in zip((east, north), noise, strict=True))
    log = Recording.from_arrays(
        name="ride",
        time=time,
        gyro=gyro + [0.01, -0.008, 0.003],
        accel=force,
        ref_east=east,
        ref_north=north,
    )
    return log, lean, rate


def test_the_direction_upward_is_followed_through_leaning_turns():
    """The median over straights shows the gyro's bias; what turns at up to 0.03 rad/s on one may
    lean by 2 deg."""
    log, lean, rate = ride(leans=True)
    up, found = upward_through(log, rate, np.array([0.0, 0.0, 1.0]))
    true = np.column_stack([0 * lean, np.sin(lean), np.cos(lean)])
    assert np.degrees(np.abs(lean).max()) > 20
    turning = np.abs(rate) > 0.1
    off = np.arccos(np.clip(np.sum(up * true, axis=1), -1, 1))
    assert np.degrees(np.sqrt(np.mean(off[turning] ** 2))) < 2.0
    assert np.degrees(found.detail["angle"]) == pytest.approx(
        np.degrees(np.quantile(np.abs(lean), 0.99)), abs=2.0
    )


def test_the_course_of_what_leans_counts_as_the_gyro_shows_it():
    """It was the scale factor, too small by the mean cosine."""
    log, lean, rate = ride(leans=True)
    made = reference_rate(log)
    known = np.isfinite(made.rate[:, 2]) & (np.abs(rate) > 0.1)
    share = np.sum(made.rate[known, 2] * rate[known]) / np.sum(rate[known] ** 2)
    cosine = np.sum(np.cos(lean[known]) * rate[known] ** 2) / np.sum(rate[known] ** 2)
    assert cosine < 0.95
    assert share == pytest.approx(cosine, abs=0.005)
    assert [f.kind for f in made.findings].count("leans") == 1


def test_behind_a_gap_in_a_turn_nothing_is_known_of_the_lean():
    """Three seconds of one turn are missing: what came before is no start for what comes after."""
    log, lean, rate = ride(leans=True)
    kept = (log.time < 31.0) | (log.time > 34.0)
    first = int(np.argmin(kept[: np.flatnonzero(~kept)[-1] + 2]))
    cut = Recording.from_arrays(name="cut", time=log.time[kept], gyro=log.gyro[kept])
    up, _ = upward_through(cut, rate[kept], np.array([0.0, 0.0, 1.0]))
    assert up[first] == pytest.approx([0.0, 0.0, 1.0]) and up[first - 1, 2] < 1.0
    off = np.arccos(np.clip(up[:, 2], -1, 1)) - np.abs(lean[kept])
    later = (cut.time > 40.0) & (np.abs(rate[kept]) > 0.1)
    assert np.degrees(np.sqrt(np.mean(off[later] ** 2))) < 2.0


def test_a_car_does_not_lean():
    log, _, rate = ride(leans=False)
    up, found = upward_through(log, rate, np.array([0.0, 0.0, 1.0]))
    assert found is None and np.all(up == [0.0, 0.0, 1.0])
