"""The filter's fast form is the plain filter of 13 points, and every way to run it gives the same
bits.
"""

import sys

import numpy as np
import pytest
from fmu_toy import Unit
from scipy.spatial.transform import Rotation
from test_attitude_ukf import (
    GRAVITY,
    N_ACCEL,
    H,
    N,
    drive,
    error,
    inputs,
    output,
    parameters,
    part,
    rover_rate,
)

from pyimu.attitude import attitude_ukf, run
from pyimu.fmu import FORMS, build_fmus, simulate, simulate_blocks
from pyimu.recording.recording import Recording

ALIGNED = np.array([0.01, 0.01, 0.001, 1e-3, 1e-3, 1e-3])
"""Standard deviations after some seconds at rest."""


def log(n: int, seed: int = 0):
    """Gyro, accel (n, 3), heading (n,), where it is told, and where the body stands: a drive with
    shocks, pushes and rests.
    """
    rng, t = np.random.default_rng(seed), H * np.arange(n)
    still = (t % 300) < 40
    rate = rover_rate(n) * ~still[:, None]
    world = closed(rate)
    gyro = rate + [0.01, -0.01, 0.005] + N / np.sqrt(H) * rng.standard_normal((n, 3))
    accel = world.apply([0, 0, GRAVITY], inverse=True) + N_ACCEL / np.sqrt(H) * rng.standard_normal(
        (n, 3)
    )
    shaken = (~still & (t % 60 < 30))[:, None]
    accel += shaken * np.sin(20 * t)[:, None] * [1.5, -1.0, 0.7]
    heading = world.as_euler("ZYX")[:, 0] + 0.02 * rng.standard_normal(n)
    return gyro, accel, heading, rng.random(n) < 0.01, still


def closed(rate: np.ndarray) -> Rotation:
    """Attitude (n) after turns by ``rate`` (n, 3), each for a period, by products of pairs: as
    exact as one by one.
    """
    turns = Rotation.from_rotvec(rate * H).as_quat(scalar_first=True)
    w, v = turns[:, 0].copy(), turns[:, 1:].copy()
    step = 1
    while step < len(w):
        a, b, p, q = w[:-step].copy(), v[:-step].copy(), w[step:].copy(), v[step:].copy()
        w[step:], v[step:] = (
            a * p - np.sum(b * q, axis=1),
            a[:, None] * q + p[:, None] * b + np.cross(b, q),
        )
        step *= 2
    return Rotation.from_quat(np.column_stack([w, v]), scalar_first=True)


# Fast against plain


def test_fast_form_is_the_filter_of_thirteen_points_over_an_hour():
    """360,000 samples with updates by gravity at rest and in motion, by headings on time and late,
    and by zero rates: to 1e-6 rad and rad/s.
    """
    n = 360_000
    gyro, accel, heading, told, still = log(n)
    late = np.where(told, np.arange(n) % 30, 0)
    u = inputs(
        n,
        gyro=gyro,
        accel=accel,
        heading=heading[np.arange(n) - late],
        heading_variance=4e-4,
        heading_valid=told & (late < np.arange(n)),
        heading_age=late * H,
        stationary=still,
    )
    fast, plain = (attitude_ukf(part(), form) for form in ("marginal", "reference"))
    p = parameters(fast, std0=ALIGNED, latitude=0.8)
    (y, _), (want, _) = fast.run(u, p=p), plain.run(u, p=p)
    assert (
        np.linalg.norm(
            error(output(fast, y, "q"), Rotation.from_quat(want[:, :4], scalar_first=True)), axis=1
        ).max()
        < 1e-6
    )
    assert np.abs(output(fast, y, "gyro_bias") - output(plain, want, "gyro_bias")).max() < 1e-6
    assert np.abs(output(fast, y, "std") - output(plain, want, "std")).max() < 1e-6
    for name in ("quasi_static", "status"):
        np.testing.assert_array_equal(output(fast, y, name), output(plain, want, name))
    gate = output(fast, y, "quasi_static")
    assert 0.3 < gate.mean() < 0.9 and output(fast, y, "nis")[gate > 0].min() > 0


# One result, whoever runs it


@pytest.fixture(scope="module")
def fmus(tmp_path_factory):
    return dict(zip(FORMS, build_fmus(attitude_ukf(part()), tmp_path_factory.mktemp("ukf"), FORMS)))


def recorded(n: int = 6000, **more) -> Recording:
    gyro, accel, heading, told, still = log(n)
    std = np.where(told, 0.02, np.nan)
    return Recording.from_arrays(
        time=H * np.arange(n),
        gyro=gyro,
        accel=accel,
        heading=np.where(told, heading, np.nan),
        heading_std=std,
        stationary=still.astype(float),
        **more,
    )


def rows(recording: Recording) -> np.ndarray:
    """The recording as the filter's inputs, as a user would write them."""
    told = np.isfinite(recording.heading)
    return inputs(
        len(recording.time),
        gyro=recording.gyro,
        accel=recording.accel,
        heading=np.where(told, recording.heading, 0),
        heading_variance=np.where(told, recording.heading_std, 0) ** 2,
        heading_valid=told,
        stationary=recording.stationary,
    )


@pytest.mark.parametrize("form", FORMS)
def test_fmu_with_the_results_parameters_gives_its_bits(fmus, form):
    recording = recorded()
    result = run(recording, part(), latitude=0.8)
    period = recording.sample_period
    given = {"start_values": dict(result.parameters), "sample_period": period}
    y = (
        simulate_blocks(fmus[form], rows(recording), block_size=500, **given)
        if form == "block"
        else simulate(fmus[form], rows(recording), **given)
    )
    block = attitude_ukf(part())
    for name in ("q", "gyro_bias", "std", "quasi_static", "nis", "status"):
        np.testing.assert_array_equal(output(block, y[1:], name), getattr(result, name))


@pytest.mark.parametrize("form", (2, 3))
def test_state_taken_back_makes_the_same_run_again(fmus, form):
    u, half = rows(recorded(600)), 300
    with Unit(fmus[form]).start() as unit:
        unit.run(u[:half], period=H)
        state = unit.save()
        first = unit.run(u[half:], first=half, period=H)
        unit.restore(state)
        np.testing.assert_array_equal(unit.run(u[half:], first=half, period=H), first)
        unit.release(state)


def test_pieces_of_a_long_recording_are_its_whole(monkeypatch):
    """A log is run in pieces; where they end, and that there are gaps, does not show."""
    recording = recorded(3000)
    keep = np.r_[0:1000, 1100:2000, 2005:3000]
    cut = Recording.from_arrays(
        time=recording.time[keep], gyro=recording.gyro[keep], accel=recording.accel[keep]
    )
    whole = run(cut, part())
    for module in ("columns", "run"):
        monkeypatch.setattr(sys.modules[f"pyimu.attitude.{module}"], "CHUNK", 64)
    pieces = run(cut, part())
    for name in ("q", "gyro_bias", "std", "quasi_static", "nis", "status"):
        np.testing.assert_array_equal(getattr(pieces, name), getattr(whole, name))


def test_fast_block_of_a_drive_follows_the_truth():
    """The closed product of turns that the tests of this file are made with is that of the
    one-by-one drive.
    """
    rate = rover_rate(500)
    assert np.abs((closed(rate).inv() * drive(rate).attitude).as_rotvec()).max() < 1e-13
