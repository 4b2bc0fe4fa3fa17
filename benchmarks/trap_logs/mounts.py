"""Traps of what lies between sensor and reference: mounts that give, filters that adapt, the Earth
that turns, and several mild ones at once.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from generators import rotation
from generators.motion import GRAVITY, rover, tumble
from scipy.signal import butter, lfilter, sosfilt

from trap_logs.log import Log, Scene, beside, new_scene

EARTH_RATE = 7.292115e-5
"""rad/s."""


def earth_turns(rng) -> Log:
    """A gyro shows the Earth's rate, and an attitude against the ground does not; the world's axes
    point wherever the cameras stand.
    """
    scene = new_scene(rng)
    latitude, heading = np.radians(rng.uniform(-70, 70)), rng.uniform(-np.pi, np.pi)
    level = np.cos(latitude) * np.array([np.cos(heading), np.sin(heading)])
    earth = EARTH_RATE * np.append(level, np.sin(latitude))
    columns = scene.sensed() | {"ref_q": scene.attitude()}
    q = scene.motion.attitude(scene.time)
    columns["gyro"] = columns["gyro"] + rotation.in_body(q, np.tile(earth, (len(q), 1)))
    return scene.log(columns)


def mounting_slips(rng) -> Log:
    """The sensor is knocked in its mount once, by 1 to 4 deg."""
    scene = new_scene(rng)
    axis = rng.standard_normal(3)
    angle = np.radians(rng.uniform(1, 4))
    at = scene.time[-1] * rng.uniform(0.25, 0.6)
    share = np.clip((scene.time - at) / 0.1, 0, 1)[:, None]
    turn = rotation.from_vector(share * angle * axis / np.linalg.norm(axis))
    columns = scene.sensed() | {"ref_q": rotation.product(scene.attitude(), turn)}
    return scene.log(columns, "mounting_slips", figures={"angle": angle})


def mount_flexes(rng) -> Log:
    """The sensor sits on foam: a resonance of 8 to 20 Hz between it and the body."""
    scene = new_scene(rng)
    every, h = 10, scene.h / 10
    fine = np.arange(-20 * every, len(scene.time) * every) * h
    w, damping = 2 * np.pi * rng.uniform(8, 20), rng.uniform(0.05, 0.3)
    # Semi-implicit steps of x'' = w^2 (u - x) + 2 damping w (u' - x'), sampled ten times as often.
    a1, a2 = -2 + 2 * damping * w * h + (w * h) ** 2, 1 - 2 * damping * w * h
    b = [(w * h) ** 2 + 2 * damping * w * h, -2 * damping * w * h]
    rate = scene.motion.rate(fine)
    felt = rate[0] + lfilter(b, [1, a1, a2], rate - rate[0], axis=0)
    own = scene.sensed()
    own["gyro"] = own["gyro"] + (felt - rate)[20 * every :: every]
    return scene.log(own | {"ref_q": scene.attitude()}, late=True)


def attitude_drawn_by_force(rng) -> Log:
    """The attitude of another unit's filter, which takes the force for gravity: its tilt goes after
    it with a time constant of 4 to 15 s, and its heading drifts.
    """
    scene = new_scene(rng, motion=(tumble, rover)[rng.integers(2)])
    pushed = scene.motion.acceleration(scene.time) / GRAVITY
    share = scene.h / rng.uniform(4, 15)
    tilt = lfilter([share], [1, share - 1], pushed, axis=0)
    walk = np.cumsum(rng.standard_normal(len(tilt))) * np.radians(0.05) * np.sqrt(scene.h)
    error = rotation.from_vector(np.column_stack([-tilt[:, 1], tilt[:, 0], walk]))
    q = rotation.product(error, scene.attitude())
    return scene.log(scene.sensed() | {"ref_q": q}, "filter")


def attitude_behind_one_euro(rng) -> Log:
    """An attitude behind the filter of trackers that adapts: its cut-off rises with the rate
    (Casiez 2012).
    """
    scene = new_scene(rng)
    least, slope = rng.uniform(1.0, 3.0), rng.uniform(2.0, 8.0)
    seen, shown = scene.attitude(), np.empty((len(scene.time), 4))
    shown[0], before, speed = seen[0], seen[0], np.zeros(3)
    slow = _smoothing(1.0, scene.h)
    for k in range(1, len(seen)):
        step = rotation.to_vector(rotation.product(rotation.inverse(before), seen[k])) / scene.h
        speed, before = speed + slow * (step - speed), seen[k]
        share = _smoothing(least + slope * float(np.linalg.norm(speed)), scene.h)
        behind = rotation.to_vector(rotation.product(rotation.inverse(shown[k - 1]), seen[k]))
        shown[k] = rotation.product(shown[k - 1], rotation.from_vector(share * behind))
    return scene.log(scene.sensed() | {"ref_q": shown}, "adapts")


def _smoothing(cut_off: float, h: float) -> float:
    turned = 2 * np.pi * cut_off * h
    return turned / (turned + 1)


def rate_of_a_shaken_unit(rng) -> Log:
    """The rate of a better unit that shakes while it moves, and was thinned out without a filter:
    its vibration is folded to where it likes.
    """
    scene = new_scene(rng)
    rate = scene.motion.rate(scene.time)
    speed = np.abs(scene.motion.speed(scene.time))
    share = np.clip(speed / np.quantile(speed, 0.99), 0.0, 1.0)[:, None]
    tone = np.sin(2 * np.pi * scene.h * np.cumsum(130 + 25 * share[:, 0]))[:, None]
    high = butter(2, 0.3, "highpass", output="sos")
    rough = sosfilt(high, rng.standard_normal(rate.shape), axis=0)
    shaken = rng.uniform(0.005, 0.03) * share * (tone * rng.standard_normal(3) + rough)
    return scene.log(scene.sensed() | {"ref_rate": rate + shaken}, "unblamed")


def thermometer_heats_itself(rng) -> Log:
    """The thermometer sits beside a regulator, which warms it by 3 to 8 K over half a minute."""
    scene = new_scene(rng, thermal=True)
    t = scene.time
    warmth = 23 + rng.uniform(3, 8) * (1 - np.exp(-t / rng.uniform(100, 300)))
    heated = rng.uniform(3, 8) * (1 - np.exp(-t / rng.uniform(10, 40)))
    shown = warmth + heated + 0.01 * rng.standard_normal(len(t))
    columns = scene.sensed(warmth=warmth) | {"ref_q": scene.attitude(), "temperature": shown}
    return scene.log(columns, "unblamed", own=frozenset({"thermal_bias"}))


def several_at_once(rng) -> Log:
    """Cameras on a clock of their own, 8 ms and 60 ppm off, that lose the body for seconds; a mount
    3 deg askew; stamps that jitter by 3 %, and rows that are lost.
    """
    scene = new_scene(rng)
    late = float(rng.choice([-1.0, 1.0])) * rng.uniform(5e-3, 12e-3)
    axis = rng.standard_normal(3)
    turn = rotation.from_vector(np.radians(3) * axis / np.linalg.norm(axis))
    kept = rng.random(len(scene.time)) >= 0.003
    sensed = {k: v[kept] for k, v in scene.sensed().items()}
    scatter = np.clip(0.03 * rng.standard_normal(kept.sum()), -0.4, 0.4) * scene.h
    sensed["time"] = sensed["time"] + scatter
    figures, middle = {"late": late}, scene.time[-1] / 2
    made = beside(
        scene, sensed, "clock", lambda t: t - late - 60e-6 * (t - middle), figures=figures
    )
    (seen,) = made.references
    seen["ref_q"] = _lost(rng, scene, seen["time"], rotation.product(seen["ref_q"], turn))
    return replace(made, references=(seen,))


def _lost(rng, scene: Scene, time: np.ndarray, q: np.ndarray) -> np.ndarray:
    for start in rng.uniform(2, scene.time[-1], 6):
        gone = (time >= start) & (time < start + rng.uniform(0.3, 2))
        q = np.where(gone[:, None], np.nan, q)
    return q


TRAPS = (
    earth_turns,
    mounting_slips,
    mount_flexes,
    attitude_drawn_by_force,
    attitude_behind_one_euro,
    rate_of_a_shaken_unit,
    thermometer_heats_itself,
    several_at_once,
)
