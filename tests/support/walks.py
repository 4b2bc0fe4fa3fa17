"""Walks of a sensor on a foot in plain numpy: swings of the leg between stances."""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation

G = 9.80665
FINE = 4
"""Steps of the integration in a sample."""

FALL, SOLE = 0.15, 0.02
"""s; over which a foot gains the speed with which it lands, and in which its sole stops it."""


@dataclass
class Walk:
    """What a perfect sensor on a foot measures: time (n,) s, rate (n, 3) rad/s and force (n, 3)
    m/s^2 as means over a sample, its place (n, 3) m, and marks (n,) of stance.
    """

    time: np.ndarray
    rate: np.ndarray
    force: np.ndarray
    place: np.ndarray
    stands: np.ndarray


def walk(
    seed: int,
    seconds: float = 60.0,
    stance: float = 0.4,
    swing: float = 0.65,
    pitch: float = 0.9,
    hz: float = 200.0,
    roll: float = 0.0,
    strike: float = 0.0,
) -> Walk:
    """Strides of 1.2 m along a wide curve, after 8 s of standing. The toes go down by ``pitch`` rad
    as the foot leaves the ground, and up before it is set down. In a stance it turns by rates of up
    to ``roll`` rad/s. It lands at about ``strike`` m/s, forward and downward, and stops in ``SOLE``
    s.
    """
    rng = np.random.default_rng(seed)
    t = np.arange(0.0, seconds, 1 / hz / FINE)
    angles = np.tile([rng.uniform(-3, 3), 0.15, 0.05], (len(t), 1))
    place, stands = np.zeros((len(t), 3)), np.ones(len(t), dtype=bool)
    at = 8.0
    while at < seconds - 5:
        own = swing * (1 + 0.05 * rng.normal())
        rows = slice(*np.searchsorted(t, [at, at + own]))
        u = (t[rows] - at) / own
        smooth = 10 * u**3 - 15 * u**4 + 6 * u**5
        yaw, turn = angles[rows.start, 0], 0.05 + 0.03 * rng.normal()
        step = 1.2 * (1 + 0.05 * rng.normal()) * np.array([np.cos(yaw), np.sin(yaw), 0])
        place[rows.stop :] = place[rows.start] + step
        place[rows] = place[rows.start] + smooth[:, None] * step
        place[rows, 2] += 2 * (u * (1 - u)) ** 2
        speed = strike * (1 + 0.3 * rng.normal()) if strike else 0.0
        place += _landing(t - at - own, speed)[:, None] * [
            0.8 * np.cos(yaw),
            0.8 * np.sin(yaw),
            -0.6,
        ]
        angles[rows.start :, 0] = yaw + turn
        angles[rows, 0] = yaw + turn * smooth
        angles[rows, 1] += pitch * np.sin(2 * np.pi * u) * np.sin(np.pi * u) ** 2
        angles[rows, 2] += 0.1 * np.sin(np.pi * u) ** 2
        stands[rows] = False
        at += own
        own = stance * (1 + 0.1 * rng.uniform(-1, 1))
        rows = slice(*np.searchsorted(t, [at, at + own]))
        angles[rows, 1] += roll * own / np.pi * np.sin(np.pi * (t[rows] - at) / own) ** 2
        at += own
    world = Rotation.from_euler("ZYX", angles)
    rate = (world[:-1].inv() * world[1:]).as_rotvec() * hz * FINE
    force = world.apply(CubicSpline(t, place)(t, 2) + [0, 0, G], inverse=True)
    n = len(rate) // FINE
    mean = (v[: n * FINE].reshape(n, FINE, 3).mean(axis=1) for v in (rate, force[:-1]))
    ends = np.arange(1, n + 1) * FINE
    stood = stands[: n * FINE].reshape(n, FINE).all(axis=1)
    return Walk(t[ends], *mean, place[ends], stood)


def _landing(after: np.ndarray, speed: float) -> np.ndarray:
    """m; what a landing at ``speed`` m/s adds to the place, at times ``after`` it in s: nothing
    before the fall nor after the stop. The velocity is that of a fall, which grows evenly squared,
    and of a stop, half a wave of force, less the even motion that takes its way back.
    """
    out, way = np.zeros(len(after)), speed * (FALL / 3 + SOLE / 2)
    falls, stops = (after >= -FALL) & (after < 0), (after >= 0) & (after < SOLE)
    u, w = after[falls] / FALL + 1, after[stops] / SOLE
    out[falls] = speed * FALL * u**3 / 3
    out[stops] = speed * (FALL / 3 + SOLE * (w + np.sin(np.pi * w) / np.pi) / 2)
    whole = (after >= -FALL) & (after < SOLE)
    x = (after[whole] + FALL) / (FALL + SOLE)
    out[whole] -= way * (10 * x**3 - 15 * x**4 + 6 * x**5)
    return out
