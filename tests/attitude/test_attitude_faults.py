"""What goes wrong in the field: the filter stays finite, says so, becomes less sure, and recovers.

Each fault befalls the same drive of four minutes for some time in its middle. Its end is held
against the filter's own standard deviations: of a right filter each of the axes is beyond five of
them with a probability of 6e-7.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import pytest
from attitude_cases import (
    GRAVITY,
    N_ACCEL,
    H,
    N,
    attitude_after,
    error,
    inputs,
    output,
    parameters,
    part,
    rover_rate,
)
from scipy.spatial.transform import Rotation

from pyimu.attitude import attitude_ukf

ROWS, START = 24_000, 8_000
MINUTES = 6_000
"""Rows of a minute."""

BIAS = np.array([0.004, -0.003, 0.002])
SETTINGS = {
    "stuck_time": 0.2,
    "axis_stuck_time": np.full(6, 0.2),
    "std0": np.array([0.01, 0.01, 0.01, 1e-3, 1e-3, 1e-3]),
    "bias0": BIAS,
}


@dataclass(frozen=True)
class Fault:
    """``rows`` from ``START`` on, ``change`` of the inputs there, the bit of the status, and
    whether the attitude becomes less sure.
    """

    name: str
    rows: int
    change: Callable
    bit: int
    widens: bool = True
    part: dict = field(default_factory=dict)


def put(columns, value):
    def change(u, rng):
        u[:, columns] = value

    return change


def hold(columns):
    def change(u, rng):
        u[:, columns] = u[0, columns]

    return change


def wrong_force(u, rng):
    u[:, 3:6] = rng.uniform(-40, 40, (len(u), 3))


def falling(u, rng):
    u[:, 3:6] = 0.01 * rng.standard_normal((len(u), 3))


GYRO, ACCEL = slice(0, 3), slice(3, 6)
FAULTS = [
    Fault("gyro missing for two minutes", 2 * MINUTES, put(GYRO, np.nan), 1),
    Fault("accelerometer missing for two minutes", 2 * MINUTES, put(ACCEL, np.nan), 1),
    Fault("everything missing for two minutes", 2 * MINUTES, put(slice(0, 7), np.nan), 1),
    Fault("one axis infinite", 300, put(1, np.inf), 1),
    Fault("absurd number", 50, put(0, 1e200), 1),
    Fault("gyro stuck while the body turns", 500, hold(GYRO), 4),
    Fault("accelerometer stuck", 500, hold(ACCEL), 4, widens=False),
    Fault("one gyro axis stuck", 500, hold(1), 4),
    Fault("one accelerometer axis stuck", 500, hold(4), 4, widens=False),
    Fault("gyro at its limit", 400, put(2, 0.6), 2, part={"saturation": {"limit": 0.6}}),
    Fault("a hundred wrong samples of force", 100, wrong_force, 0, widens=False),
    Fault("a second of free fall", 100, falling, 0, widens=False),
    Fault("temperature missing", 200, put(6, np.nan), 1, widens=False),
]


def log(fault: Fault | None) -> tuple[np.ndarray, Rotation]:
    """Inputs (n, 18) with the fault, and the true attitude."""
    rng = np.random.default_rng(4)
    rate = rover_rate(ROWS)
    truth = attitude_after(rate)
    gyro = rate + BIAS + N / np.sqrt(H) * rng.standard_normal((ROWS, 3))
    accel = truth.apply([0, 0, GRAVITY], inverse=True) + N_ACCEL / np.sqrt(H) * rng.standard_normal(
        (ROWS, 3)
    )
    u = inputs(ROWS, gyro=gyro, accel=accel)
    if fault:
        fault.change(u[START : START + fault.rows], rng)
    return u, truth


@pytest.fixture(scope="module")
def plain():
    block = attitude_ukf(part())
    return block.run(log(None)[0], p=parameters(block, **SETTINGS))[0]


@pytest.mark.parametrize("fault", FAULTS, ids=lambda f: f.name)
def test_fault_is_survived_said_allowed_for_and_recovered_from(fault, plain):
    block = attitude_ukf(part(**fault.part))
    u, truth = log(fault)
    y, state = block.run(u, p=parameters(block, **SETTINGS))
    during, after = slice(START, START + fault.rows), slice(START + fault.rows + 500, None)
    assert np.isfinite(y).all() and np.isfinite(state).all()
    np.testing.assert_allclose(np.linalg.norm(output(block, y, "q"), axis=1), 1, rtol=0, atol=1e-12)
    status, std = output(block, y, "status").astype(int), output(block, y, "std")
    if fault.bit:
        assert (
            (status[during] & fault.bit).any()
            and not (status[:START] & fault.bit).any()
            and not (status[after] & fault.bit).any()
        )
    else:
        assert (
            not output(block, y, "quasi_static")[START + 30 : START + fault.rows].any()
            or (status[during] & 8).any()
        )
    last = START + fault.rows - 1
    assert (std[last, :3] >= 0.999 * output(block, plain, "std")[last, :3]).all()
    if fault.widens:
        assert (std[during, :3] / output(block, plain, "std")[during, :3]).max() > 3
    recovered(block, y, truth)


def recovered(block, y: np.ndarray, truth: Rotation) -> None:
    """Tilt as good as ever; heading as far off as the filter says, and no further."""
    q, std = output(block, y, "q")[-500:], output(block, y, "std")[-500:, :3]
    up, true_up = (
        r.apply([0, 0, 1], inverse=True)
        for r in (Rotation.from_quat(q, scalar_first=True), truth[-500:])
    )
    assert np.linalg.norm(up - true_up, axis=1).max() < 0.02
    assert (np.abs(error(q, truth[-500:])) < 5 * std).all()
    assert (
        np.abs(output(block, y, "gyro_bias")[-1] - BIAS)
        < 5 * np.hypot(output(block, y, "std")[-1, 3:], 2e-4 * np.sqrt(ROWS * H))
    ).all()


def test_sample_that_is_missing_now_and_then_does_no_harm(plain):
    """A tenth of all samples lost, each by itself: about as good as without."""
    rng, block = np.random.default_rng(8), attitude_ukf(part())
    u, truth = log(None)
    u[rng.random(ROWS) < 0.05, 1] = np.nan
    u[rng.random(ROWS) < 0.05, 4] = np.nan
    y, _ = block.run(u, p=parameters(block, **SETTINGS))
    assert np.isfinite(y).all() and 0.08 < np.mean(output(block, y, "status") == 1) < 0.12
    recovered(block, y, truth)


def upside_down(rate: float, seconds: float, seed: int = 0) -> tuple[np.ndarray, float]:
    """Inputs (n, 18) of a body that lies upside down, and the sample period."""
    rng, h, n = np.random.default_rng(seed), 1 / rate, round(seconds * rate)
    accel = np.array([0, 0, -GRAVITY]) + N_ACCEL / np.sqrt(h) * rng.standard_normal((n, 3))
    return inputs(n, accel=accel, gyro=N / np.sqrt(h) * rng.standard_normal((n, 3))), h


@pytest.mark.parametrize("rate", [100, 976, 2000, 4250])
def test_start_upside_down_with_a_wrong_attitude_is_set_right_and_said(rate):
    """Gravity contradicts the start values for some seconds; the bias keeps clear of what they were
    off by.
    """
    block, (u, h) = attitude_ukf(part()), upside_down(rate, 12)
    y, _ = block.run(u, sample_period=h)
    up = Rotation.from_quat(output(block, y, "q"), scalar_first=True).apply([0, 0, 1], inverse=True)
    assert up[0, 2] > 0.99 and (up[10 * rate :, 2] < -0.999).all()
    status = output(block, y, "status").astype(int)
    assert (status[:rate] & 8).any() and not status[10 * rate :].any()
    assert (
        np.abs(output(block, y, "gyro_bias")[-1]).max() < 5 * output(block, y, "std")[-1, 3:].max()
    )
