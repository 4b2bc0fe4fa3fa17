"""Traps of the references that robots and headsets bring: odometry of cameras, antennas, encoders,
poses that were filled in, predicted, or stamped by when a shutter opened.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from generators import rotation
from generators.motion import rover, smooth_noise, table
from generators.tracked import quadrotor, wand

from trap_logs.log import Columns, Log, Scene, new_scene


def visual_odometry(rng) -> Log:
    """Poses of 20 to 30 Hz by cameras: places that are too large by some percent, which drifts, a
    heading that wanders, and two to four loops that are closed by 1 to 4 deg and some dm.
    """
    scene = new_scene(rng, hz=200.0, motion=(wand, quadrotor)[rng.integers(2)])
    rate = float(rng.uniform(20, 30))
    time = np.arange(1, round(scene.time[-1] * rate)) / rate
    shift, turn = np.zeros((len(time), 3)), np.zeros(len(time))
    for at in rng.uniform(0.1, 0.9, rng.integers(2, 5)) * scene.time[-1]:
        shift[time > at] += 0.1 * rng.standard_normal(3)
        turn[time > at] += np.radians(rng.uniform(1, 4)) * rng.choice([-1, 1])
    turn += np.cumsum(np.radians(0.02) / np.sqrt(rate) * rng.standard_normal(len(time)))
    world = rotation.from_vector(turn[:, None] * [0.0, 0.0, 1.0])
    scale = 1 + rng.uniform(0.01, 0.04) * rng.choice([-1, 1])
    scale = scale + 0.005 * smooth_noise(rng, np.arange(len(time) + 200) / 50, 1, 0.0, 0.05)[200:]
    blur = 1e-3 * rng.standard_normal(shift.shape)
    places = rotation.in_body(rotation.inverse(world), scale * scene.motion.position(time) + blur)
    seen: Columns = {"time": time, "ref_q": rotation.product(world, scene.attitude_at(time))}
    seen |= dict(zip(("ref_east", "ref_north", "ref_up"), (places + shift).T, strict=True))
    return replace(scene.log(scene.sensed(), "jumps"), references=(seen,))


def _headed(rng, heading: Callable[[Scene, np.ndarray], np.ndarray], hz, motion=rover) -> Log:
    """A heading in a file of its own, of some ``hz``."""
    scene = new_scene(rng, motion=motion)
    rate = float(rng.uniform(*hz))
    time = np.arange(1, round(scene.time[-1] * rate)) / rate
    shown = heading(scene, time)
    seen: Columns = {"time": time, "ref_heading": np.mod(shown + np.pi, 2 * np.pi) - np.pi}
    return replace(scene.log(scene.sensed(), "unblamed"), references=(seen,))


def _yaw(scene: Scene, time: np.ndarray) -> np.ndarray:
    return scene.motion.angles(time)[:, 2]


def heading_of_two_antennas(rng) -> Log:
    """A heading of satellites, 5 to 10 Hz, 0.2 to 0.4 deg, 50 to 150 ms late, which is lost for 2
    to 12 s some four times, half of them held.
    """

    def shown(scene: Scene, time: np.ndarray) -> np.ndarray:
        noise = np.radians(rng.uniform(0.2, 0.4)) * rng.standard_normal(len(time))
        out = _yaw(scene, time - rng.uniform(0.05, 0.15)) + rng.uniform(-3, 3) + noise
        for start in rng.uniform(5, scene.time[-1] - 5, 4):
            lost = np.flatnonzero((time > start) & (time < start + rng.uniform(2, 12)))
            if len(lost) and lost[0]:
                out[lost] = out[lost[0] - 1] if rng.random() < 0.5 else np.nan
        return out

    return _headed(rng, shown, (5, 10))


def heading_of_whole_degrees(rng) -> Log:
    """A compass of 10 to 20 Hz that shows whole degrees."""
    return _headed(rng, lambda scene, t: np.radians(np.round(np.degrees(_yaw(scene, t)))), (10, 20))


def encoder_with_backlash(rng) -> Log:
    """An encoder behind gears with 0.3 to 1 deg of play, of 4096 steps, on a table."""

    def shown(scene: Scene, time: np.ndarray) -> np.ndarray:
        half, yaw = 0.5 * np.radians(rng.uniform(0.3, 1.0)), _yaw(scene, time)
        out = np.empty_like(yaw)
        out[0] = yaw[0]
        for k in range(1, len(yaw)):
            out[k] = min(max(out[k - 1], yaw[k] - half), yaw[k] + half)
        step = 2 * np.pi / 4096
        return step * np.round(out / step)

    return _headed(rng, shown, (50, 100), table)


def exposures_vary(rng) -> Log:
    """Poses of a camera that are stamped when its shutter opens, and shown at the middle of an
    exposure of 2 to 25 ms, which follows the light.
    """
    scene = new_scene(rng)
    rate = float(rng.uniform(30, 60))
    time = np.arange(1, round(scene.time[-1] * rate)) / rate
    light = smooth_noise(rng, np.arange(len(time) + 500) / 50, 1, 0.0, 0.05)[500:, 0]
    exposure = np.clip(0.012 + 0.006 * light, 0.002, 0.025)
    seen: Columns = {"time": time, "ref_q": scene.attitude_at(time + 0.5 * exposure)}
    return replace(scene.log(scene.sensed(), "unblamed", late=True), references=(seen,))


def occlusions_filled(rng) -> Log:
    """Cameras lose the body for 0.2 to 1.5 s, some eight times, and their program fills in along
    the shortest arcs.
    """
    scene = new_scene(rng)
    q, kept = scene.attitude(), np.ones(len(scene.time), bool)
    for first in rng.integers(200, len(kept) - 200, 8):
        kept[first : first + int(rng.uniform(0.2, 1.5) / scene.h)] = False
    filled = rotation.between(scene.time[kept], q[kept], scene.time)
    return scene.log(scene.sensed() | {"ref_q": filled}, "filled")


def attitude_predicted(rng) -> Log:
    """A headset's pose, turned on over 15 to 40 ms by its rate, behind a filter of 10 to 20 ms, and
    stamped by the time it is meant for. It overshoots, by which the sensor seems to damp.
    """
    scene = new_scene(rng)
    ahead, share = rng.uniform(0.015, 0.04), scene.h / (scene.h + rng.uniform(0.01, 0.02))
    at = scene.time - ahead
    rate, slow = scene.motion.rate(at), np.zeros((len(at), 3))
    rate = rate + scene.sensor.gyro.n / np.sqrt(scene.h) * rng.standard_normal(rate.shape)
    slow[0] = rate[0]
    for k in range(1, len(rate)):
        slow[k] = slow[k - 1] + share * (rate[k] - slow[k - 1])
    q = rotation.product(scene.attitude_at(at), rotation.from_vector(ahead * slow))
    return scene.log(scene.sensed() | {"ref_q": q}, "no_delay", late=True)


TRAPS = (
    visual_odometry,
    heading_of_two_antennas,
    heading_of_whole_degrees,
    encoder_with_backlash,
    exposures_vary,
    occlusions_filled,
    attitude_predicted,
)
