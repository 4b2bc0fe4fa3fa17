"""An accelerometer that is driven to its limit by shocks, as on a walker's foot: what it shows
counts, and the velocity is as unsure as what lies beyond."""

from dataclasses import replace

import numpy as np
import pytest
from navigation_cases import (
    calibrated,
    declared,
    first_heading,
    noisy,
    perfect,
    square,
    white,
)
from scipy.stats import chi2
from walks import G, walk

import pyimu
from pyimu import Recording
from pyimu.errors import Finding
from pyimu.ins import run
from pyimu.ins.askew_limit import LEAST, with_equal_limits
from pyimu.ins.known import _with_true_limit, known_part
from pyimu.ins.stops import rest_at_start
from pyimu.model.sensor import Sensor
from pyimu.rover.trajectory import Drive

LIMIT, SELDOM, SECONDS = 4 * G, 7 * G, 40.0


def stepped(seed, limit=LIMIT):
    """A walk whose landings are beyond the range, and where it ends (2,) m."""
    own, rng = walk(seed, seconds=SECONDS, strike=1.0), np.random.default_rng(seed)
    noise = [std * rng.standard_normal((len(own.time), 3)) for std in (1.4e-3, 0.03)]
    accel = np.clip(own.force + noise[1], -limit, limit)
    return Recording.from_arrays(time=own.time, gyro=own.rate + noise[0], accel=accel), own


@pytest.mark.parametrize("limit", [LIMIT, SELDOM])
def test_a_walk_with_clipped_landings_ends_where_it_claims(limit):
    """The squares are those of as many normal numbers: one in 10,000 is larger. With no force taken
    for what lies beyond the range and 5 m/s^2 claimed of it, the mean square was 240, and with the
    limit that is touched seldom not seen, 224."""
    total = 0.0
    for seed in (5000, 5001):
        log, own = stepped(seed, limit)
        track = run(log, method="filter", heading0=first_heading(own)).tracks["filter"]
        total += square(track, own.place[-1])
    assert total < chi2.isf(1e-4, 6)


def test_the_axes_of_a_triad_have_one_range():
    """One is at its limit for a sample at a time, as no reader sees by itself."""
    log, _ = stepped(5000)
    part = known_part(None, log, rest_at_start(log, None, G))
    limits = part.accel.values["saturation"]["limit"]
    most = np.abs(log.accel).max(axis=0)
    np.testing.assert_array_equal(limits > 0, most >= LIMIT)


def test_what_other_axes_pass_by_far_is_no_limit():
    """Of one axis two extremes of a walk may be alike: where the others go five times as far, no
    range ends there."""
    rng = np.random.default_rng(3)
    samples = rng.standard_normal((2000, 3)) * [4.0, 0.8, 4.0]
    sensor = Sensor("accel", {"saturation": {"limit": [0.0, 2.0, 0.0]}})
    samples[:, 1] = np.clip(samples[:, 1], -2.0, 2.0)
    assert _with_true_limit(sensor, Sensor("accel", {}), samples).values == {}
    alone = samples * [0.1, 1.0, 0.1]
    kept = _with_true_limit(sensor, Sensor("accel", {}), alone).values["saturation"]["limit"]
    np.testing.assert_array_equal(kept, [0.0, 2.0, 0.0])


def test_a_limit_that_single_samples_touch_is_seen():
    """As the range of 7 g is by some landings in a walk, also behind a converter of 16 bits; that
    of a walk without a limit has none."""
    log, _ = stepped(5000, SELDOM)
    free, _ = stepped(5000, np.inf)
    step = 2 * SELDOM / 2**16
    for accel in (log.accel, step * np.round(log.accel / step)):
        told = replace(log, accel=accel)
        limits = known_part(None, told, rest_at_start(told, None, G)).accel.values["saturation"]
        np.testing.assert_allclose(limits["limit"], [SELDOM, 0.0, 0.0])
    part = known_part(None, free, rest_at_start(free, None, G))
    assert "saturation" not in part.accel.values


def test_what_stays_at_the_limit_is_no_shock():
    """A sensor that is stuck there for 2 s pushes nobody to 80 m/s."""
    drive = Drive(legs=1, stops=3.0, first_rest=5.0)
    log = declared(noisy(perfect(drive), white(calibrated()), 1), drive)
    part = calibrated()
    values = part.accel.values | {"saturation": {"limit": np.full(3, LIMIT)}}
    part = part.with_sensor(replace(part.accel, values=values))
    accel = log.accel.copy()
    accel[(log.time > 6.0) & (log.time < 8.0), 0] = LIMIT
    found = run(replace(log, accel=accel), part, method="filter").filter
    assert np.abs(found.vector("velocity")).max() < 10.0


OF_AXES = [(i, side) for i in range(3) for side in ("low", "high")]

CORRECTION = np.eye(3) + 0.01 * np.array([[0.2, -1.1, 0.7], [0.9, -0.4, -0.8], [-0.6, 1.0, 0.5]])
"""What a calibration made of the axes; a hundredth of each is in the others."""


@pytest.mark.parametrize("limit", [6 * G, SELDOM])
def test_a_limit_that_a_correction_of_the_axes_moved_is_seen(limit):
    """The samples at it lie in a plane. Before, the walk's end was 10 to 27 m off, and its square
    2,700 in the mean; of three normal numbers one in 10,000 is larger than the bound."""
    log, own = stepped(5000, limit)
    log = replace(log, accel=log.accel @ CORRECTION.T + 0.2)
    told = with_equal_limits(log)
    seen = {(f.column, f.detail["side"]) for f in told.findings if f.kind == "clipping"}
    raw = np.linalg.solve(CORRECTION, (log.accel - 0.2).T).T
    clipped = np.abs(raw) >= limit * (1 - 1e-9)
    sides = {"low": raw < 0, "high": raw > 0}
    often = {(f"accel_{'xyz'[i]}", s): (clipped & sides[s])[:, i].sum() for i, s in OF_AXES}
    assert {k for k, n in often.items() if n >= LEAST} <= seen <= {k for k, n in often.items() if n}
    most = np.abs(told.accel).max()
    np.testing.assert_array_equal(np.abs(told.accel[clipped]), most)
    assert np.mean(np.abs(told.accel) == most) < 2 * clipped.mean()
    track = run(log, method="filter", heading0=first_heading(own)).tracks["filter"]
    assert square(track, own.place[-1]) < chi2.isf(1e-4, 3)


def test_a_limit_that_the_log_was_said_to_have_is_said_once():
    log, _ = stepped(5000, 6 * G)
    said = Finding("clipping", "accel_x", 25, {"side": "low", "level": -6 * G})
    assert [f.column for f in with_equal_limits(log).findings] == ["accel_x"]
    assert with_equal_limits(replace(log, findings=(said,))).findings == (said,)


def test_a_sample_that_is_missing_on_another_axis_hides_no_limit():
    """One of the outermost; of no warning, either, where many are missing."""
    log, _ = stepped(5000, 6 * G)
    accel = log.accel @ CORRECTION.T + 0.2
    accel[np.argmax(accel[:, 0]), 1] = np.nan
    accel[::40, 2] = np.nan
    told = with_equal_limits(replace(log, accel=accel))
    raw = np.linalg.solve(CORRECTION, (accel - 0.2).T).T
    clipped = np.abs(raw) >= 6 * G * (1 - 1e-9)
    assert clipped.any()
    np.testing.assert_array_equal(np.abs(told.accel[clipped]), np.nanmax(np.abs(told.accel)))


@pytest.mark.parametrize("bits", [10, 12, 16, 0])
def test_a_walk_within_the_range_has_no_plane(bits):
    """Behind a converter, too, whose samples lie in many."""
    log, _ = stepped(5000, np.inf)
    accel = log.accel
    if bits:
        step = 32 * G / 2**bits
        accel = step * np.round(accel / step)
    log = replace(log, accel=accel @ CORRECTION.T)
    assert with_equal_limits(log) is log
    early = log.slice(0, int(np.searchsorted(log.time, 7.0)))
    assert with_equal_limits(early) is early


def test_the_range_of_a_coarse_converter_is_seen_in_a_drive():
    """1.5 g is no multiple of 4 mg: the largest output is below it, and a shaken robot's forces
    beyond were taken for what they showed. The squares of the first zero velocities, of three
    normal numbers each, were 815 and 220."""
    part, drive = pyimu.part("sparkfun6dof_v2"), Drive(legs=2, vibration=2.5, stops=2.0)
    truth = perfect(drive)
    off = replace(part, tolerances=tuple(t for t in part.tolerances if t.key[1] == "turn_on_bias"))
    upwards = np.array([0.0, 0.0, 0.18 * G])
    accel = part.accel.with_values("turn_on_bias", b0=upwards)
    log = replace(off, accel=accel, tolerances=()).simulate(truth, seed=3)
    assert np.mean(log.accel[:, 2] == log.accel[:, 2].max()) > 0.02
    first = np.array(run(declared(log, drive), off, method="filter").first_zupts)
    assert first.sum() < chi2.isf(1e-4, 3 * len(first))
