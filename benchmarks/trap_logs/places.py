"""Traps of cameras that saw attitudes and positions, the accelerometer beside the force of both."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from generators import rotation
from generators.tracked import any_tracked
from scipy.signal import butter, sosfilt

from trap_logs.log import Columns, Log, Scene, new_scene
from trap_logs.references import smoother, unwrapped

BEFORE = 2.0
"""s; so long before and after a log the cameras look on, whose filters know of it."""

Seen = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Times (m,) s, attitudes (m, 4) and positions (m, 3) m."""

Filter = Callable[[np.ndarray], np.ndarray]


def _scene(rng) -> Scene:
    return new_scene(rng, hz=float(rng.choice([100.0, 200.0])), motion=any_tracked)


def _seen(scene: Scene) -> Seen:
    """What cameras of 100 to 240 Hz show of markers some cm from the sensor, with 0.1 to 1 mm of
    noise.
    """
    rng, rate = scene.rng, scene.rng.uniform(100.0, 240.0)
    time = np.arange(-BEFORE * rate, (scene.time[-1] + BEFORE) * rate) / rate
    arm = np.tile(0.03 * rng.standard_normal(3), (len(time), 1))
    away = rotation.in_body(rotation.inverse(scene.motion.attitude(time)), arm)
    noise = 10.0 ** rng.uniform(-4.0, -3.0) * rng.standard_normal((len(time), 3))
    return time, unwrapped(scene.attitude_at(time)), scene.motion.position(time) + away + noise


def _log(scene: Scene, seen: Seen, cause: str, **figures: float) -> Log:
    time, q, places = seen
    inside = (time > 0.0) & (time < scene.time[-1])
    q = q / np.linalg.norm(q, axis=1, keepdims=True)
    cameras: Columns = {"time": time[inside], "ref_q": q[inside]}
    names = ("ref_east", "ref_north", "ref_up")
    cameras |= {name: column[inside] for name, column in zip(names, places.T)}
    made = scene.log(scene.sensed(), cause, figures=figures)
    return replace(made, references=(cameras,))


def _behind(scene: Scene, seen: Seen, filtered: Filter) -> Seen:
    """Positions behind a filter, and with them, by chance, the entries of the quaternions."""
    time, q, places = seen
    return time, filtered(q) if scene.rng.random() < 0.5 else q, filtered(places)


def positions(rng) -> Log:
    """Attitudes and positions as cameras see them."""
    scene = _scene(rng)
    return _log(scene, _seen(scene), "nothing")


def positions_behind_low_pass(rng) -> Log:
    """Positions behind a low-pass of 5 to 15 Hz that counts each sample when it comes."""
    scene = _scene(rng)
    seen, cut_off = _seen(scene), rng.uniform(5, 15)
    low = butter(1, cut_off, fs=1.0 / np.diff(seen[0]).mean(), output="sos")
    behind = _behind(scene, seen, lambda v: v[0] + sosfilt(low, v - v[0], axis=0))
    return _log(scene, behind, "lag_of_places", lag=1 / (2 * np.pi * cut_off))


def positions_smoothed(rng) -> Log:
    """Positions that software smoothed without delay."""
    scene = _scene(rng)
    seen = _seen(scene)
    smooth = smoother(rng, float(np.diff(seen[0]).mean()))
    return _log(scene, _behind(scene, seen, smooth), "smoothed_places")


TRAPS = (positions, positions_behind_low_pass, positions_smoothed)
