"""The samples that an attitude was interpolated from, at any ratio to the rows."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation, RotationSpline, Slerp

from pyimu.recording.recording import Recording
from pyimu.recording.reference.nodes import own_samples

SECONDS, NOISE = 60.0, 1e-3
"""s, rad."""


def attitude(rng, time: np.ndarray) -> Rotation:
    phase, rate = rng.uniform(-3, 3, 3), rng.uniform(1.0, 3.0, 3)
    angles = 0.5 * np.sin(rate * time[:, None] + phase)
    return Rotation.from_euler("ZYX", angles) * Rotation.from_rotvec(
        rng.normal(0, NOISE, (len(time), 3))
    )


def recording(time: np.ndarray, of: Rotation) -> Recording:
    """As a file has it, whose numbers end somewhere."""
    ref_q = np.round(of.as_quat(scalar_first=True), 9)
    return Recording.from_arrays("log", time=time, gyro=np.zeros((len(time), 3)), ref_q=ref_q)


@pytest.mark.parametrize("rows_hz, jitter", [(100.0, 0.0), (200.0, 2e-4)])
@pytest.mark.parametrize("ratio", [0.02, 0.05, 0.13, 0.25, 0.4, 0.45, 0.48, 0.5, 0.55, 0.6, 0.75])
def test_the_samples_behind_the_rows_are_found(rows_hz, jitter, ratio):
    """Their times to a thousandth of a row; the attitudes to what the file's digits leave: a step
    has 2e-9 rad of them, and least squares add some ten where a sample has hardly more than one.
    """
    rng = np.random.default_rng(round(1000 * ratio))
    time = np.arange(0.0, SECONDS, 1 / rows_hz)
    time = np.round(time + np.abs(rng.normal(0, jitter, len(time))), 6) if jitter else time
    at = np.arange(-2.0, SECONDS + 60.0, 1 / (ratio * rows_hz)) + rng.uniform(0, 1 / rows_hz)
    nodes = attitude(rng, at)
    found = own_samples(recording(time, Slerp(at, nodes)(time)))
    inside = (at > time[2]) & (at < time[-2])
    assert 0.9 * inside.sum() < len(found.time) <= inside.sum() + 2
    nearest = np.searchsorted(0.5 * (at[1:] + at[:-1]), found.time)
    assert_allclose(found.time, at[nearest], atol=1e-3 / rows_hz)
    own = Rotation.from_quat(found.ref_q, scalar_first=True)
    off = (own.inv() * nodes[nearest]).magnitude()
    assert np.median(off) < 1e-6 and off.max() < 0.05 * NOISE


@pytest.mark.parametrize("hz", [10.0, 30.0, 60.0])
@pytest.mark.parametrize("sequence", ["ZYX", "XYZ"])
def test_the_samples_whose_angles_were_joined_along_lines(sequence, hz):
    """As spreadsheets and programs do that interpolate roll, pitch and yaw by themselves."""
    rng, time = np.random.default_rng(round(hz)), np.arange(0.0, SECONDS, 0.01)
    at = np.arange(-1.0, SECONDS + 1.0, 1 / hz) + 0.003
    angles = np.unwrap(attitude(rng, at).as_euler(sequence), axis=0)
    rows = np.column_stack([np.interp(time, at, column) for column in angles.T])
    found = own_samples(recording(time, Rotation.from_euler(sequence, rows)))
    nearest = np.searchsorted(0.5 * (at[1:] + at[:-1]), found.time)
    assert len(found.time) > 0.9 * SECONDS * hz
    assert_allclose(found.time, at[nearest], atol=1e-5)
    own = Rotation.from_quat(found.ref_q, scalar_first=True)
    off = (own.inv() * Rotation.from_euler(sequence, angles[nearest])).magnitude()
    assert np.median(off) < 1e-6 and off.max() < 0.05 * NOISE


@pytest.mark.parametrize("noise", [0.0, NOISE])
def test_rows_that_are_no_interpolation_stay(noise):
    rng, time = np.random.default_rng(7), np.arange(0.0, SECONDS, 0.01)
    steady = attitude(rng, time) * Rotation.from_rotvec(rng.normal(0, noise, (len(time), 3)))
    log = recording(time, steady)
    assert own_samples(log) is log


@pytest.mark.parametrize("hz", [20.0, 60.0])
def test_values_that_are_repeated_are_no_interpolation(hz):
    rng, time = np.random.default_rng(8), np.arange(0.0, SECONDS, 0.01)
    at = np.arange(0.0, SECONDS, 1 / hz)
    latest = np.searchsorted(at, time + 1e-9, side="right") - 1
    log = recording(time, attitude(rng, at)[latest])
    assert own_samples(log) is log


@pytest.mark.parametrize("ratio", [2, 4, 7])
@pytest.mark.parametrize("spline", ["rotations", "quaternions"])
def test_samples_that_a_spline_joins_are_found(spline, ratio):
    rng, time = np.random.default_rng(ratio), np.arange(0.0, SECONDS, 0.01)
    at = time[1::ratio]
    nodes = attitude(rng, at)
    if spline == "rotations":
        rows = RotationSpline(at, nodes)(time)
    else:
        q = nodes.as_quat()
        q *= np.cumprod(np.append(1.0, np.sign(np.sum(q[1:] * q[:-1], axis=1))))[:, None]
        rows = Rotation.from_quat(CubicSpline(at, q)(time))
    found = own_samples(recording(time, rows))
    assert_allclose(found.time, at)
