"""Bodies that are in motion from the first sample of their log on, by numpy alone.

Drones in the air, vehicles on their way, hands, arms, somebody who walks, boats: the truth and the
samples are those of ``drives.bodies``, with sensors that somebody has calibrated roughly.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from drives import bodies
from drives.bodies import (
    GRAVITY,
    Sensors,
    aircraft,
    at_sea,
    axes_of,
    clock,
    integral,
    leaning,
    measured,
    slope,
    smooth,
)
from drives.log import Log

DURATION = 180.0

SENSORS = Sensors(1.5e-4, 3e-5, np.radians(0.3), 0.003, 0.003, 1.5e-3, 0.03, 0.003)
OFF_SCALE = replace(SENSORS, scale=0.012)

DRAG = 0.35
"""1/s; of a drone, over its mass."""


def along(yaw: np.ndarray, speed: np.ndarray) -> np.ndarray:
    """The velocity (n, 3) of a body that goes where it points, level."""
    return speed[:, None] * np.column_stack([np.cos(yaw), np.sin(yaw), 0 * yaw])


def askew(rng) -> np.ndarray:
    """A matrix by which a sensor is mounted, some 17 deg about each axis."""
    return axes_of(*(0.3 * rng.standard_normal((3, 1))))[0]


def anyhow(rng) -> np.ndarray:
    """A matrix by which a sensor is mounted in any attitude."""
    axes = np.linalg.qr(rng.standard_normal((3, 3)))[0]
    return axes * np.linalg.det(axes)


# In the air


def flown(rng, t: np.ndarray, yaw: np.ndarray, velocity: np.ndarray) -> Log:
    """A drone of that ``velocity`` (n, 3), which leans against drag and wind, and wobbles."""
    pushed = slope(velocity)
    wind = 2.0 * rng.standard_normal(3) * [1, 1, 0] + 0.6 * smooth(rng, t, 1.0, 3)
    thrust = pushed + DRAG * (velocity - wind) * [1, 1, 0.3] + [0, 0, GRAVITY]
    pitch, roll = leaning(yaw, thrust)
    wobble = 0.01 * smooth(rng, t, 0.05, 3)
    axes = axes_of(yaw + wobble[:, 0], pitch + wobble[:, 1], roll + wobble[:, 2])
    return measured(rng, axes, pushed, SENSORS)


def drone(rng, size: float, time: float, mean: float) -> Log:
    """A drone that flies here and there at ``mean`` m/s, and by ``size`` m/s over ``time`` s beside
    that.
    """
    t = clock(DURATION)
    course = rng.uniform(-3, 3) + 0.15 * integral(smooth(rng, t, 4.0))[:, 0]
    speed = mean * (1 + 0.3 * smooth(rng, t, 4.0)[:, 0])
    velocity = along(course, speed) + size * smooth(rng, t, time, 3) * [1, 1, 0.3]
    return flown(rng, t, course + 0.3 * smooth(rng, t, 3.0)[:, 0], velocity)


def circling(rng, speed: float = 6.0, radius: float = 15.0) -> Log:
    """A drone that flies round a point, ahead."""
    t = clock(DURATION)
    rate = speed / radius * (1 + 0.2 * smooth(rng, t, 4.0)[:, 0]) * rng.choice([-1, 1])
    yaw = rng.uniform(-3, 3) + integral(rate)
    velocity = along(yaw, np.abs(rate) * radius)
    velocity[:, 2] = 0.5 * smooth(rng, t, 3.0)[:, 0]
    return flown(rng, t, yaw, velocity)


# On wheels


def driven(rng, t: np.ndarray, speed: np.ndarray, turn: np.ndarray) -> Log:
    """A car of that ``speed`` (n,) m/s and ``turn`` (n,) rad/s, on a road that is not even."""
    yaw = rng.uniform(-3, 3) + integral(turn)
    pushed = slope(along(yaw, speed)) + 0.3 * smooth(rng, t, 0.03, 3)
    hills, jolts = 0.025 * smooth(rng, t, 4.0, 2), 0.006 * smooth(rng, t, 0.1, 2)
    roll = 0.003 * speed * turn + hills[:, 0] + jolts[:, 0]
    axes = axes_of(yaw, hills[:, 1] + jolts[:, 1] - 0.004 * slope(speed), roll)
    return measured(rng, axes @ askew(rng), pushed, SENSORS)


def car(rng, mean: float = 12.0) -> Log:
    """A car on a winding road."""
    t = clock(DURATION)
    speed = np.abs(mean * (1 + 0.25 * smooth(rng, t, 4.0)[:, 0]))
    return driven(rng, t, speed, 0.12 * smooth(rng, t, 2.5)[:, 0])


def roundabout(rng) -> Log:
    """A car that is in a bend one way for the first 40 s, and then on a winding road."""
    t = clock(DURATION)
    speed = 9.0 * (1 + 0.1 * smooth(rng, t, 4.0)[:, 0])
    bend = 0.25 * (1 - bodies.steps(t, [(39.0, 1.0)], 2.0))
    return driven(rng, t, speed, bend + 0.1 * smooth(rng, t, 2.5)[:, 0])


# In a hand


def hand(rng, turn: float, way: float, time: float, sensors: Sensors = SENSORS) -> Log:
    """A hand that turns by ``turn`` rad and moves by ``way`` m over ``time`` s, and drifts."""
    t = clock(DURATION)
    angles = turn * smooth(rng, t, time, 3) * [2, 1, 1]
    place = way * smooth(rng, t, time, 3) + 0.15 * smooth(rng, t, 3.0, 3)
    axes = axes_of(*angles.T) @ anyhow(rng)
    return measured(rng, axes, slope(slope(place)), sensors)


def wrist(rng, turn: float, time: float, lever: float, shake: float = 0.0, **more) -> Log:
    """A sensor at the end of an arm of two links of about ``lever`` m, which are turned about their
    joints; a tool shakes it by ``shake`` m/s^2.
    """
    t = clock(DURATION)
    upper = axes_of(*(0.5 * turn * smooth(rng, t, time, 3) + 0.3 * smooth(rng, t, 3.0, 3)).T)
    lower = upper @ axes_of(*(turn * smooth(rng, t, time, 3)).T)
    place = lever * (upper[:, :, 0] + 0.6 * lower[:, :, 0]) + 0.1 * smooth(rng, t, 3.0, 3)
    shaken = shake * rng.standard_normal((len(t), 3)) if shake else None
    return measured(rng, lower, slope(slope(place)), **{"sensors": SENSORS} | more, shake=shaken)


def walking(rng) -> Log:
    """Somebody who walks on and on at 1.4 m/s, with the sensor somewhere on the body."""
    t = clock(DURATION)
    phase = integral(2 * np.pi * rng.uniform(1.6, 2.1) * (1 + 0.03 * smooth(rng, t, 3.0)[:, 0]))
    yaw = 0.25 * integral(smooth(rng, t, 3.0))[:, 0]
    steps = [1.5 * np.sin(phase + 1), np.sin(phase / 2), 2.5 * np.sin(phase) + np.sin(2 * phase)]
    pushed = slope(along(yaw, 1.4 * (1 + 0.15 * smooth(rng, t, 4.0)[:, 0])))
    pushed += np.einsum("nij,jn->ni", axes_of(yaw, 0 * t, 0 * t), np.array(steps))
    sway = 0.1 * smooth(rng, t, 3.0, 2) + 0.07 * np.sin(phase / 2)[:, None]
    axes = axes_of(yaw + 0.1 * np.sin(phase / 2), sway[:, 0], sway[:, 1])
    return measured(rng, axes @ anyhow(rng), pushed, SENSORS)


STARTS: dict[str, Callable[[np.random.Generator], Log]] = {
    "drone, 4 m/s": lambda rng: drone(rng, 1.5, 2.0, 4.0),
    "drone, 7 m/s": lambda rng: drone(rng, 4.0, 1.5, 7.0),
    "drone that circles": circling,
    "aircraft, 18 m/s": lambda rng: aircraft(rng, 18.0, 0.5, (20.0, 60.0), start=None),
    "car": car,
    "roundabout": roundabout,
    "hand, slow": lambda rng: hand(rng, 0.4, 0.05, 0.6),
    "hand, fast": lambda rng: hand(rng, 0.6, 0.1, 0.2),
    "the same, gyro 1.2 % off": lambda rng: hand(rng, 0.6, 0.1, 0.2, OFF_SCALE),
    "wrist": lambda rng: wrist(rng, 1.0, 0.25, 0.15),
    "wrist with a tool that shakes": lambda rng: wrist(rng, 0.6, 0.4, 0.3, shake=2.0),
    "walking": walking,
    "boat, 8 s, 0.5 m": lambda rng: at_sea(rng, 8.0, 0.5, sensors=SENSORS),
    "boat, 12 s, 1 m": lambda rng: at_sea(rng, 12.0, 1.0, sensors=SENSORS),
}
"""A log of each kind, by its name."""
