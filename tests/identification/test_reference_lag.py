"""References behind low-pass filters, and rates in files of their own."""

from dataclasses import replace

import numpy as np
import pytest
from loop_cases import smooth
from scipy.interpolate import CubicSpline
from scipy.signal import butter, sosfilt
from scipy.spatial.transform import Rotation, RotationSpline, Slerp
from world import N_GYRO, drive, recording

import pyimu
from pyimu.recording.reference.adapting import Adapting
from pyimu.recording.reference.unlagged import unlagged

CUT_OFF = 6.0
TIME_CONSTANT = 1 / (2 * np.pi * CUT_OFF)
FINER = 20
"""Samples of the filter for one of the log: as a recursion it is right to 1e-4 at 2.5 Hz."""


@pytest.fixture(scope="module")
def world():
    return drive(minutes=4, seed=21)


def filtered(time: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Behind a low-pass of first order."""
    fine = np.arange(time[0], time[-1], (time[1] - time[0]) / FINER)
    low = butter(1, CUT_OFF, fs=FINER / (time[1] - time[0]), output="sos")
    return CubicSpline(fine, sosfilt(low, CubicSpline(time, values)(fine), axis=0))(time)


def test_a_filtered_rate_is_undone_and_no_error_of_the_sensor(world):
    """It was a scale factor of 1 % beside a clock. The time constant is looked for to half a
    percent."""
    log = recording(world, seed=3, kinds=("gyro",))
    ref_rate = filtered(world.time, world.rate)
    closed = pyimu.close(replace(log, ref_force=None, ref_rate=ref_rate))
    (found,) = [f for f in closed.quality if f.kind == "reference_lag"]
    assert found.detail["time_constant"] == pytest.approx(TIME_CONSTANT, rel=0.005)
    assert not closed.added and not closed.formulas, closed.report()
    assert closed.verdict not in ("unexplained", "partly"), closed.report()
    assert "behind a low-pass filter of 6" in closed.report()
    assert not closed.references[0]["left_to_sensor"]["value"]


@pytest.mark.parametrize("early", [0.004, 0.03])
def test_a_reference_that_is_merely_late_is_not_filtered(world, early):
    log = recording(world, seed=4, kinds=("gyro",))
    late = CubicSpline(world.time, world.rate)(world.time - early)
    closed = pyimu.close(replace(log, ref_force=None, ref_rate=late))
    assert not [f for f in closed.quality if f.kind == "reference_lag"]
    assert closed.references[0]["clock_offset"]["value"] == pytest.approx(-early, abs=2e-4)


def hand(seed: int, seconds: float = 90.0) -> tuple[np.ndarray, Rotation, np.ndarray]:
    """Times, attitudes and rates of what is turned by hand."""
    rng, time = np.random.default_rng(seed), np.arange(0.0, seconds, 0.01)
    turn = Rotation.from_euler("ZYX", smooth(rng, time, 0.4, highest=1.0) * [1.0, 0.8, 1.0])
    return time, turn, RotationSpline(time, turn)(time, 1)


@pytest.mark.parametrize(
    "noise",
    [
        pytest.param(1e-3, marks=pytest.mark.long, id="camera"),
        pytest.param(6e-3, id="poor camera"),
    ],
)
def test_an_attitude_in_noise_behind_a_low_pass_is_undone(noise):
    """The noise that a slope makes larger hid the filter, and was coning of -4 where it did not.
    Of eight logs the time constant was right to 0.25 and 1.5 %, root mean square."""
    time, turn, rate = hand(seed=31)
    rng = np.random.default_rng(32)
    gyro = rate + 1e-3 * rng.standard_normal(rate.shape)
    q = turn.as_quat(scalar_first=True)
    turned = np.sum(q[1:] * q[:-1], axis=1) < 0
    low = filtered(time, q * np.where(np.cumsum(np.append(False, turned)) % 2, -1.0, 1.0)[:, None])
    low = Rotation.from_quat(low, scalar_first=True)
    told = low * Rotation.from_rotvec(noise * rng.standard_normal(rate.shape))
    ref_q = told.as_quat(scalar_first=True)
    closed = pyimu.close(pyimu.Recording.from_arrays("hand", time=time, gyro=gyro, ref_q=ref_q))
    (found,) = [f for f in closed.quality if f.kind == "reference_lag"]
    assert found.detail["time_constant"] == pytest.approx(TIME_CONSTANT, rel=10.0 * noise)
    assert not closed.added and not closed.formulas, closed.report()
    assert closed.verdict not in ("unexplained", "partly", "not_confirmed"), closed.report()


def test_the_noise_of_a_gyro_on_an_early_clock_is_no_filter_of_the_reference():
    """In regressors it looks as if the reference damped what is quick, by 130 nat here, but by
    other shares than a filter."""
    time, _, rate = hand(seed=33, seconds=600.0)
    rng = np.random.default_rng(34)
    late = CubicSpline(time, rate)(time - 0.02) + 2e-4 * rng.standard_normal(rate.shape)
    gyro = rate + 0.3 * rng.standard_normal(rate.shape)
    log = pyimu.Recording.from_arrays("noisy", time=time, gyro=gyro, ref_rate=late)
    closed = pyimu.close(log)
    assert not [f for f in closed.quality if f.kind == "reference_lag"], closed.report()
    assert not closed.added and not closed.formulas, closed.report()


def test_what_undoes_a_filter_undoes_it_on_quaternions_too():
    """A turn about one axis by known angles; a body that turns by 1 rad/s at 1 Hz."""
    time = np.arange(0, 20, 0.01)
    angle = np.sin(2 * np.pi * time) / (2 * np.pi)
    q = np.column_stack([np.cos(angle / 2), np.sin(angle / 2), 0 * time, 0 * time])
    low = filtered(time, q)
    low /= np.linalg.norm(low, axis=1, keepdims=True)
    log = pyimu.Recording.from_arrays(time=time, gyro=np.zeros((len(time), 3)), ref_q=low)
    quick = unlagged(log, TIME_CONSTANT).ref_q
    seen = np.isfinite(quick).all(axis=1) & (time > 1) & (time < 19)
    assert seen.sum() > 1700
    off = 2 * np.abs(quick[seen] - q[seen]).max()
    lagged = 2 * np.abs(low[seen] - q[seen]).max()
    assert off < 2e-4 < 0.01 * lagged


def test_what_else_a_reference_knows_stays():
    """An attitude of 20 Hz along shortest arcs in rows of 100 Hz, beside positions."""
    time = np.arange(0, 40, 0.01)
    node = np.arange(0, 41, 0.05)
    angles = np.column_stack([np.sin(node), 0.5 * np.sin(1.3 * node), 0.4 * np.cos(0.7 * node)])
    q = Slerp(node, Rotation.from_rotvec(angles))(time).as_quat(scalar_first=True)
    log = pyimu.Recording.from_arrays(
        time=time, gyro=np.zeros((len(time), 3)), ref_q=q, ref_north=time, ref_east=0 * time
    )
    quick = unlagged(log, TIME_CONSTANT)
    assert np.array_equal(quick.reference.ref_north, time)
    assert np.isfinite(quick.ref_q).all(axis=1).mean() > 0.9


def test_a_rate_in_a_file_of_its_own_shows_the_noise_of_the_gyro(world):
    """Its band has fewer rows than the log; their noise was taken for that of a sample, the floor
    was four times too low and the verdict "unexplained". N by the quietest quarter of 240 s.
    """
    log = recording(world, seed=5, kinds=("gyro",))
    own = pyimu.Recording.from_arrays(name="own", time=world.time, ref_rate=world.rate)
    closed = pyimu.close(replace(log, ref_force=None, ref_rate=None), reference=own)
    assert closed.verdict == "clean" and not closed.added, closed.report()
    found = np.asarray(closed.after.gyro.values["angle_random_walk"]["N"])
    assert np.all(np.abs(found / N_GYRO - 1) < 0.1)


@pytest.mark.parametrize("others", [np.nan, 0.0])
def test_a_filtered_rate_of_one_axis_is_undone_where_the_motion_repeats(others):
    """Three sines about z: their own past predicts what a wrong time constant leaves. Without
    numbers for x and y the log was refused as too short, with noughts the filter was not seen.
    """
    rng, time = np.random.default_rng(8), np.arange(0.0, 240.0, 0.01)
    z = np.sin(2 * np.pi * np.outer(time, [0.2, 0.7, 1.9])) @ np.radians([60.0, 40.0, 30.0])
    gyro = 1e-3 * rng.standard_normal((len(time), 3)) + 0.004
    gyro[:, 2] += z
    told = np.full(gyro.shape, others)
    told[:, 2] = filtered(time, z[:, None])[:, 0] + 2e-4 * rng.standard_normal(len(time))
    closed = pyimu.close(pyimu.Recording.from_arrays("table", time=time, gyro=gyro, ref_rate=told))
    (found,) = [f for f in closed.quality if f.kind == "reference_lag"]
    assert found.detail["time_constant"] == pytest.approx(TIME_CONSTANT, rel=0.02)
    assert not closed.added and not closed.formulas, closed.report()
    (s,) = [e for e in closed.estimated if (e.sensor, e.effect) == ("gyro", "scale_factor")]
    assert abs(s.value[2]) < 1e-3


LEAST, SLOPE = 1.5, 4.0
"""Hz, and Hz for each rad/s: cut-off of a filter that adapts."""


def adapted(turn: Rotation, h: float) -> Rotation:
    """Behind the filter of Casiez et al. 2012, equations 1 to 4, on the shortest arcs."""
    shown, speed, out = turn[0], np.zeros(3), [turn[0]]
    slow = 2 * np.pi * h / (1 + 2 * np.pi * h)
    for before, now in zip(turn[:-1], turn[1:], strict=True):
        speed = speed + slow * ((before.inv() * now).as_rotvec() / h - speed)
        r = 2 * np.pi * h * (LEAST + SLOPE * np.linalg.norm(speed))
        behind = (shown.inv() * now).as_rotvec()
        shown = shown * Rotation.from_rotvec(r / (1 + r) * behind)
        out.append(shown)
    return Rotation.concatenate(out)


def test_what_a_filter_that_adapts_was_shown_is_told_by_what_it_shows():
    """From sample to sample; where the body turns back the share may have been one of two, for a
    moment.
    """
    time, turn, _ = hand(seed=34)
    h = time[1] - time[0]
    shown = adapted(turn, h).as_quat(scalar_first=True)
    known = Adapting(1 / (2 * np.pi * LEAST), LEAST / SLOPE, steps=True)
    log = pyimu.Recording.from_arrays("hand", time=time, gyro=np.zeros((len(time), 3)), ref_q=shown)
    undone = unlagged(log, known, 5.0).reference.ref_q
    off = (turn.inv() * Rotation.from_quat(undone, scalar_first=True)).magnitude()
    behind = (turn.inv() * Rotation.from_quat(shown, scalar_first=True)).magnitude()
    assert np.median(off) < 1e-6 < 1e-3 < np.median(behind)
    assert np.sqrt(np.mean(off**2)) < 0.01 * np.sqrt(np.mean(behind**2))


def test_an_attitude_behind_a_filter_that_adapts_is_undone():
    """It was a lag of the sensor."""
    time, turn, rate = hand(seed=35)
    rng = np.random.default_rng(36)
    seen = turn * Rotation.from_rotvec(1e-3 * rng.standard_normal(rate.shape))
    ref_q = adapted(seen, time[1] - time[0]).as_quat(scalar_first=True)
    gyro = rate + 1e-3 * rng.standard_normal(rate.shape)
    closed = pyimu.close(pyimu.Recording.from_arrays("hand", time=time, gyro=gyro, ref_q=ref_q))
    (found,) = [f for f in closed.quality if f.kind == "reference_adapts"]
    size, halves = found.detail["time_constant"], found.detail["halves_at"]
    assert size == pytest.approx(1 / (2 * np.pi * LEAST), rel=0.05)
    assert halves == pytest.approx(LEAST / SLOPE, rel=0.05)
    assert not closed.added and not closed.formulas, closed.report()
    assert "filter that adapts" in closed.report()
