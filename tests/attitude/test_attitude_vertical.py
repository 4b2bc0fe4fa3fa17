"""What gravity tells of the heading in motion: next to nothing where a gyro's axes are off."""

import casadi as ca
import numpy as np
import pytest
from attitude_cases import GRAVITY, H
from scipy.spatial.transform import Rotation

from pyimu.attitude import run
from pyimu.attitude.filter.turning import LASTS, bias_variance, followed, start
from pyimu.attitude.filter.unscented import Estimate, doubt
from pyimu.recording.recording import Recording

REST, N = round(10 / H), round(130 / H)


def head(seed: int, axes: float) -> tuple[Recording, np.ndarray]:
    """A head that rests, and then looks round; its gyro's ``axes`` are off by so many rad. With it
    the quaternions (n, 4), scalar last.
    """
    rng, t = np.random.default_rng([8, seed]), np.maximum(H * (np.arange(-1, N) - REST), 0)
    ease = np.clip(t / 2, 0, 1) ** 2
    waves = ((0.6, 0.23), (0.25, 0.31), (0.12, 0.17))
    phases = rng.uniform(0, 2 * np.pi, 3)
    angles = [a * ease * np.sin(2 * np.pi * f * t + p) for (a, f), p in zip(waves, phases)]
    q = Rotation.from_euler("ZYX", np.column_stack(angles))
    rate = (q[:-1].inv() * q[1:]).as_rotvec() / H
    off = np.eye(3) + axes * rng.standard_normal((3, 3)) * (1 - np.eye(3))
    bias = np.radians(0.3) * rng.standard_normal(3)
    gyro = rate @ off.T + bias + np.radians(0.007) / H**0.5 * rng.standard_normal((N, 3))
    accel = q[1:].inv().apply([0, 0, GRAVITY]) + 1e-3 / H**0.5 * rng.standard_normal((N, 3))
    log = Recording.from_arrays(time=H * np.arange(N), gyro=gyro, accel=accel)
    return log, q[1:].as_quat()


def heading_error(q, true) -> np.ndarray:
    """deg, in the world; ``q`` and ``true`` (n, 4), scalar last."""
    x, y, z, w = (Rotation.from_quat(q) * Rotation.from_quat(true).inv()).as_quat().T
    angle = np.unwrap(2 * np.arctan2(z, w), period=2 * np.pi)
    return np.degrees(angle - angle[0])


@pytest.mark.parametrize("seed", [0, 1, 2, 7])
def test_a_heading_in_motion_is_the_gyros(seed):
    """Whose bias at rest is known, and whose axes are off by a third of a degree: what it turns by
    itself is the best that is known of the heading. Gravity seemed to know of another bias, and
    turned it by 2 to 10 deg in two minutes; where only the bias about the vertical of the moment
    was held, by 17 deg on the last.
    """
    log, true = head(seed, 0.006)
    found = run(log)
    at_rest = log.gyro[:REST].mean(axis=0)
    turned = [Rotation.identity()]
    for step in Rotation.from_rotvec((log.gyro[1:] - at_rest) * H):
        turned.append(turned[-1] * step)
    alone = heading_error(Rotation.concatenate(turned).as_quat(), true)
    off = heading_error(np.roll(found.q, -1, axis=1), true)
    assert np.abs(off - alone).max() < 2.0
    assert np.mean((off[REST:] / np.degrees(found.heading_std[REST:])) ** 2) < 2.0


def test_what_is_known_better_than_axes_allow_learns_nothing():
    """Of the bias along the mean vertical, by the square of its length, and of the angle about the
    vertical.
    """
    up, mean, false = ca.SX([0, 0, 1]), ca.SX([0, 0.6, 0]), 4e-3
    gain = ca.SX(np.arange(1.0, 19.0).reshape(9, 2))
    for std, share in ((4e-3, 1.0), (1e-3, 1.0), (8e-3, 0.25), (4.0, 1e-6)):
        covariance = ca.diagcat(ca.SX.eye(3), std**2 * ca.SX.eye(3), ca.SX.eye(3))
        x = Estimate(ca.SX([1, 0, 0, 0]), ca.SX(3, 1), ca.SX(3, 1), covariance)
        want = np.zeros((9, 2))
        want[2], want[4] = share * np.array([5.0, 6.0]), share * 0.36 * np.array([9.0, 10.0])
        np.testing.assert_allclose(ca.evalf(doubt(x, up, false, mean)(gain)), want, rtol=1e-12)


def test_the_bias_in_motion_is_given_once_and_changes_slowly():
    """While a body turns fast, in ``LASTS`` as much again; at rest nothing, and after it anew."""
    h, std, up, given = 0.5, 2.0, ca.SX([0, 0, 1]), []
    before, rate, resting = ca.SX.sym("k", 5), ca.SX.sym("w", 3), ca.SX.sym("r")
    after = followed(before, rate, up, resting, h)
    step = ca.Function(
        "step", [before, rate, resting], [after, bias_variance(before, after, resting, std, h)]
    )
    state, n = start(up), round(2 * LASTS / h)
    for fast, still in ((50.0, 0), (0.0, 1), (50.0, 0)):
        added = 0.0
        for _ in range(n):
            state, more = step(state, [fast, 0, 0], still)
            added += float(more)
        given.append(added / std**2)
    assert given[0] == pytest.approx(given[2], rel=1e-3)
    assert given[0] == pytest.approx(1 + 2, rel=0.01) and given[1] == 0
