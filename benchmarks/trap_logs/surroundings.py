"""Traps of the surroundings: thermometers and vibration; and logs with nothing wrong."""

from __future__ import annotations

import numpy as np
from generators.motion import tumble
from scipy.signal import lfilter

from trap_logs.log import Log, Scene, new_scene


def _warmth(scene: Scene) -> np.ndarray:
    """Temperature (n,) of the part, degC: it warms up by 4 to 10 K, and sways."""
    rng, t = scene.rng, scene.time
    rise = rng.uniform(4, 10) * (1 - np.exp(-t / rng.uniform(25, 60)))
    sway = rng.uniform(0.3, 1.5) * np.sin(2 * np.pi * t / rng.uniform(30, 80) + rng.uniform(0, 6))
    return rng.uniform(20, 26) + rise + sway


def _by_thermometer(scene: Scene, warmth: np.ndarray, shown: np.ndarray) -> Log:
    """The case of a thermometer that shows ``shown`` (n,) of a part that is at ``warmth`` (n,)."""
    columns = scene.sensed(warmth=warmth) | {"ref_q": scene.attitude(), "temperature": shown}
    own = frozenset({"thermal_bias"} if np.any(scene.sensor.gyro.thermal) else ())
    return scene.log(columns, "thermometer", own=own)


def tumble_with_noisy_thermometer(rng) -> Log:
    scene = new_scene(rng, motion=tumble)
    warmth = _warmth(scene)
    return _by_thermometer(scene, warmth, warmth + 0.03 * rng.standard_normal(len(warmth)))


def _rounded(rng, thermal: bool) -> Log:
    """A thermometer with steps of half a kelvin."""
    scene = new_scene(rng, thermal=thermal)
    warmth = _warmth(scene)
    return _by_thermometer(scene, warmth, np.round(2 * warmth) / 2)


def thermometer_rounded(rng) -> Log:
    return _rounded(rng, thermal=False)


def thermometer_rounded_thermal_bias(rng) -> Log:
    return _rounded(rng, thermal=True)


def _sluggish(rng, thermal: bool) -> Log:
    """A thermometer that follows the part as a first-order lag of 30 s."""
    scene = new_scene(rng, thermal=thermal)
    warmth = _warmth(scene)
    share = scene.h / 30.0
    behind = lfilter([share], [1, share - 1], warmth, zi=[(1 - share) * warmth[0]])[0]
    return _by_thermometer(scene, warmth, behind + 0.01 * rng.standard_normal(len(warmth)))


def thermometer_late(rng) -> Log:
    return _sluggish(rng, thermal=False)


def thermometer_late_thermal_bias(rng) -> Log:
    return _sluggish(rng, thermal=True)


def motor_vibration(rng) -> Log:
    """A line of 20 to 45 Hz that follows the speed, coherent in gyro and accelerometer, which the
    reference does not show.
    """
    scene = new_scene(rng)
    speed = np.abs(scene.motion.speed(scene.time))
    share = np.clip(speed / np.quantile(speed, 0.99), 0.0, 1.0)
    phase = 2 * np.pi * scene.h * np.cumsum(20 + 25 * share)
    columns = scene.sensed() | {"ref_q": scene.attitude()}
    for name, size in (("gyro", rng.uniform(0.02, 0.15)), ("accel", rng.uniform(0.5, 3.0))):
        direction = rng.standard_normal(3)
        direction *= size / np.linalg.norm(direction)
        wave = np.sqrt(share) * np.sin(phase + rng.uniform(0, 2 * np.pi))
        columns[name] = columns[name] + wave[:, None] * direction
    return scene.log(columns, "vibration")


def nothing_wrong(rng) -> Log:
    scene = new_scene(rng)
    return scene.log(scene.sensed() | {"ref_q": scene.attitude()})


def nothing_wrong_against_rate_and_force(rng) -> Log:
    """A simulation's reference: rate and specific force as they are, and a good thermometer."""
    scene = new_scene(rng)
    rate, force = scene.motion.rate(scene.time), scene.motion.force(scene.time)
    truth = {"ref_rate": rate, "ref_force": force, "temperature": _warmth(scene)}
    return scene.log(scene.sensed() | truth)


TRAPS = (
    tumble_with_noisy_thermometer,
    thermometer_rounded,
    thermometer_rounded_thermal_bias,
    thermometer_late,
    thermometer_late_thermal_bias,
    motor_vibration,
    nothing_wrong,
    nothing_wrong_against_rate_and_force,
)
