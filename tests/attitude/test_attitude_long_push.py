"""Turns that last: pushes that look like gravity, and turns that look like a gyro's bias."""

from dataclasses import replace

import casadi as ca
import numpy as np
import pytest
from attitude_cases import GRAVITY, H, error, part
from scipy.signal import lfilter
from scipy.spatial.transform import Rotation

from pyimu.attitude import run
from pyimu.attitude.columns import NOMINAL_MOTION_BIAS, motion_bias
from pyimu.attitude.filter.long_push import LEAST, LongPush, followed
from pyimu.attitude.filter.prediction import _drove
from pyimu.attitude.filter.variables import USUAL
from pyimu.attitude.filter.velocity import FIRST_STD, UNLEVELLED, Motion, first_std
from pyimu.attitude.underway import PUSH_STD
from pyimu.recording.recording import Recording

N, K, N_ACCEL = 1e-4, 1e-5, 1e-3
BEYOND = 4.5
"""Standard deviations; a component is farther off once in 150 000."""


def eased(t, start: float, time: float) -> np.ndarray:
    """0, and from ``start`` on 1, over ``time`` s."""
    return 0.5 - 0.5 * np.cos(np.pi * np.clip((t - start) / time, 0, 1))


def recorded(axes: Rotation, acceleration, seed: int) -> Recording:
    """The samples of attitudes (n + 1) and accelerations (n + 1, 3), of an unbiased gyro."""
    rng, n = np.random.default_rng(seed), len(axes) - 1
    rate = (axes[:-1].inv() * axes[1:]).as_rotvec() / H
    force = axes[1:].inv().apply(acceleration[1:] + [0, 0, GRAVITY])
    gyro, accel = rng.standard_normal((2, n, 3)) / np.sqrt(H)
    return Recording.from_arrays(
        time=H * np.arange(n), gyro=rate + N * gyro, accel=force + N_ACCEL * accel
    )


def banked(duration: float = 120.0) -> tuple[Rotation, np.ndarray]:
    """It stands, takes off in 20 s to 18 m/s, and turns from 45 s on, banked by 30 deg so that the
    force stays along its vertical; slight turbulence.
    """
    t = H * np.arange(round(duration / H) + 1)
    roll, flies = 0.52 * eased(t, 45, 3), eased(t, 15, 20)
    yaw = -H * np.cumsum(GRAVITY * np.tan(roll) / 18)
    velocity = 18 * flies[:, None] * np.column_stack([np.cos(yaw), np.sin(yaw), 0 * yaw])
    gusts = 0.01 * flies * np.sin(2 * t)
    axes = Rotation.from_euler("ZYX", np.column_stack([yaw, gusts, roll + gusts]))
    return axes, np.gradient(velocity, H, axis=0)


def test_a_banked_turn_without_a_speed_is_no_tilt():
    """The gyro is good for 0.3 deg of tilt after 100 s, gravity is 30 deg off the force."""
    axes, acceleration = banked()
    found = run(recorded(axes, acceleration, 1), part(N, K, N_ACCEL), settings={"rate_noise": 0.0})
    off = error(found.q, axes[1:])[2000::100]
    assert (np.abs(off) < BEYOND * found.std[2000::100, :3]).all()
    assert np.linalg.norm(off[:, :2], axis=1).max() < np.radians(3)
    assert (np.abs(found.gyro_bias[2000:]) < BEYOND * found.std[2000:, 3:]).all()
    # Upwards the force is gravity all the time: its size raises no doubt.
    assert not (found.status & 512).any()


def test_an_even_turn_is_none_of_the_gyros_bias():
    """After a rest of 20 s a gyro of which nothing is known has a bias to 1e-5 rad/s, and a turn of
    0.5 deg/s is 900 times that. What was turned before it showed is not known.
    """
    t = H * np.arange(12_001)
    yaw = H * np.cumsum(np.radians(0.5) * eased(t, 20, 1))
    axes = Rotation.from_euler("z", yaw[:, None])
    found = run(recorded(axes, np.zeros((len(t), 3)), 2))
    off = error(found.q, axes[1:])[:, 2]
    shown = slice(2100, None)
    assert (np.abs(off[shown]) < BEYOND * found.heading_std[shown]).all()
    assert np.abs(off).max() < np.radians(2)
    assert (np.abs(found.gyro_bias[shown, 2]) < BEYOND * found.std[shown, 5]).all()


def test_the_bias_is_unsure_by_how_much_the_body_turns():
    """s_b^2 + K^2 t, and m^2 times what the share has more than is left of it after 100 s, with the
    gyro's own noise too large to tell more of the bias.
    """
    assert motion_bias(None) == NOMINAL_MOTION_BIAS
    assert motion_bias(part()) == 0
    n, std0, m = 2001, np.full(6, 1e-3), 5e-3
    settings = {"motion_bias": m, "rest_time": 0.0, "rate_noise": 0.0}
    found = {}
    for fast in (0.0, 0.02, 2.0):
        axes = Rotation.from_euler("z", fast / 3 * np.sin(3 * H * np.arange(n))[:, None])
        log = recorded(axes, np.zeros((n, 3)), 3)
        square = lfilter([H / (10 + H)], [1, -10 / (10 + H)], np.sum(log.gyro**2, axis=1))
        share = np.append(0, square / (square + 0.5**2))
        given, rises = 0.0, 0.0
        for now in share:
            left = given * 100 / (100 + H)
            given = max(left, now)
            rises += given - left
        found[fast] = run(log, part(N, K, N_ACCEL), std0=std0, settings=settings).std[-1, 5]
        assert found[fast] == pytest.approx(np.sqrt(1e-6 + K**2 * 20 + m**2 * rises), rel=1e-2)
    # A slow turn has next to nothing of it.
    assert found[0.02] < 1.02 * found[0.0] and found[2.0] > 0.9 * m


def pushed(level: float, own: float = 0.0, across: float = 0.0, seconds: float = 60.0) -> float:
    """The variance that a force of ``level`` m/s^2 shows for so many seconds."""
    push = LongPush.start()
    state = ca.SX.sym("x", 4)
    now = LongPush(state[:2], state[2], state[3])
    after = followed(now, ca.vertcat(level, 0), own, across, 1.0, H)
    step = ca.Function("step", [state], [ca.vertcat(*after.pack())])
    last = step.mapaccum(round(seconds / H))(ca.vertcat(*push.pack()))
    return float(last[2, -1])


def test_a_push_that_lasts_has_its_mean_square_beyond_what_tilt_and_velocity_make():
    assert pushed(3.0) == pytest.approx(4.5 - LEAST**2, rel=1e-3)
    assert pushed(3.0, own=0.5) == pytest.approx(4.5 - 1.5 - LEAST**2, rel=1e-3)
    assert pushed(LEAST) == 0
    assert pushed(3.0, across=100.0) == 0


@pytest.mark.parametrize("shown, drove", [(0.0, 0), (0.015**2, 0), (0.025**2, 1)])
def test_a_body_drives_while_pushes_that_it_has_shown_leave_it_a_speed(shown, drove):
    """The velocity follows these pushes, and shows none of it: 0.2 m/s by 0.02 m/s^2 for 10 s."""
    motion = Motion.start(0.1, 1.0)
    motion = replace(motion, long=replace(motion.long, shown=ca.SX(shown)))
    assert float(_drove(motion, motion.long.velocity(1.0))) == drove


def test_pushes_that_were_not_excluded_are_once_the_force_stays_small():
    """By exp(-60/5) of what they were after a minute without a force; while the force is large
    they are what they may be.
    """
    for level in (0.0, 2.0):
        state = ca.SX.sym("x", 4)
        now = LongPush(state[:2], state[2], state[3])
        after = followed(now, ca.vertcat(level, 0), 100.0, 0.0, 1.0, H)
        step = ca.Function("step", [state], [ca.vertcat(*after.pack())])
        last = step.mapaccum(round(60 / H))(ca.vertcat(*LongPush.start(PUSH_STD**2).pack()))
        left = float(last[3, -1]) / PUSH_STD**2
        if level:
            assert left > 0.7
        else:
            assert left == pytest.approx(np.exp(-12.0), rel=0.05)


def on_its_way(seed: int) -> tuple[Rotation, Recording]:
    """Two minutes of a car that is on a winding road at 12 m/s from the first sample on, its gyro
    off by 0.3 deg/s RMS: the attitudes, and the samples.
    """
    rng = np.random.default_rng([31, seed])
    t = H * np.arange(-1, round(120 / H))
    turn = sum(0.08 * np.sin(2 * np.pi * (t / time + rng.random())) for time in (6.0, 11.0, 19.0))
    speed = 12 + sum(2 * np.sin(2 * np.pi * (t / time + rng.random())) for time in (9.0, 23.0))
    yaw = np.cumsum(turn) * H
    velocity = speed[:, None] * np.column_stack([np.cos(yaw), np.sin(yaw), 0 * t])
    axes = Rotation.from_euler("ZYX", np.column_stack([yaw, 0 * t + 0.03, 0 * t - 0.02]))
    log = recorded(axes, np.gradient(velocity, H, axis=0), seed)
    bias = np.radians(0.3) * rng.standard_normal(3)
    return axes[1:], replace(log, gyro=log.gyro + bias)


def test_a_log_that_begins_on_a_winding_road_is_level_after_half_a_minute():
    """Its forces make a mean square of tilt; behind a gyro half a minute of them leave less than a
    third, and it goes on to be known as well as claimed.
    """
    off, claimed, pushed = [], [], []
    for seed in range(4):
        truth, log = on_its_way(seed)
        result = run(log)
        late = log.time > 30
        vertical = [
            q.inv().apply([0, 0, 1])
            for q in (truth, Rotation.from_quat(result.q, scalar_first=True))
        ]
        off.append(np.sum((vertical[0] - vertical[1])[late] ** 2, axis=1))
        claimed.append(2 * result.tilt_std[late] ** 2)
        pushed.append(np.sum((log.accel / GRAVITY - vertical[0])[late] ** 2, axis=1))
    assert np.mean(off) < np.mean(pushed) / 9
    assert np.mean(np.array(off) / claimed) < 1.3


def test_a_body_whose_tilt_is_not_known_may_move():
    """By the tilt, whatever the attitude, and not by the heading."""
    for q in Rotation.random(4, rng=np.random.default_rng(4)).as_quat(scalar_first=True):
        up = Rotation.from_quat(q, scalar_first=True).inv().apply([0, 0, 1])
        at = USUAL | {f"q0[{i + 1}]": q[i] for i in range(4)}
        for tilt, expected in ((0.01, FIRST_STD), (0.05, UNLEVELLED * GRAVITY * 0.05)):
            # The heading is known, so that the standard deviations are not alike.
            std = tilt * np.sqrt(1 - up**2)
            own = float(np.sqrt(np.sum((1 - up**2) * std**2) / 2) / tilt)
            at |= {f"std0[{i + 1}]": std[i] for i in range(3)}
            values = {n: ca.DM(float(v)) for n, v in at.items()}
            assert float(first_std(values)) == pytest.approx(max(FIRST_STD, expected * own))
