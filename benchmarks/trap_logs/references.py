"""Traps of the reference: its rows, its noise, its mounting, its faults."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from generators import rotation
from scipy.ndimage import gaussian_filter1d, uniform_filter1d
from scipy.signal import butter, sosfilt, sosfiltfilt

from trap_logs.log import Log, Scene, new_scene

SETTLED = 2.0
"""Over its cut-off [Hz], s after which a filter has forgotten where it began: e^-12."""


def slerp_60_to_200_hz(rng) -> Log:
    """An attitude of 60 Hz, brought to the log's 200 Hz along the shortest arcs."""
    scene = new_scene(rng, hz=200.0)
    node = np.arange(-1, scene.time[-1] * 60 + 2) / 60 + rng.uniform(0, 1 / 60)
    seen = rotation.between(node, scene.attitude_at(node), scene.time)
    return scene.log(scene.sensed() | {"ref_q": seen}, "sample_rate", figures={"rate": 60.0})


def held_at_20_hz(rng) -> Log:
    """An attitude of 20 Hz, each value repeated until the next."""
    scene = new_scene(rng)
    every = round(1 / (20 * scene.h))
    latest = np.arange(len(scene.time)) // every * every
    columns = scene.sensed() | {"ref_q": scene.attitude()[latest]}
    return scene.log(columns, "sample_rate", figures={"rate": 20.0})


def _held(scene: Scene, rate: float) -> tuple[np.ndarray, np.ndarray]:
    """Times (k,) of samples at ``rate`` Hz, and the one (n,) that each row of a log shows."""
    first = scene.rng.uniform(-2.0, -1.0) / rate
    node = first + np.arange(int((scene.time[-1] - first) * rate) + 1) / rate
    return node, np.searchsorted(node, scene.time, side="right") - 1


def attitude_held_unevenly(rng) -> Log:
    """An attitude at a rate that is no part of the log's, each value repeated until the next."""
    scene = new_scene(rng)
    rate = rng.uniform(0.12, 0.55) / scene.h
    node, latest = _held(scene, rate)
    columns = scene.sensed() | {"ref_q": scene.attitude_at(node)[latest]}
    return scene.log(columns, "sample_rate", figures={"rate": rate})


def rate_held(rng) -> Log:
    """The rate of another unit, slower, each value repeated until the next."""
    scene = new_scene(rng)
    rate = rng.uniform(0.2, 0.55) / scene.h
    node, latest = _held(scene, rate)
    columns = scene.sensed() | {"ref_rate": scene.motion.rate(node)[latest]}
    return scene.log(columns, "sample_rate", figures={"rate": rate})


def _against_rate(scene: Scene, error: np.ndarray) -> Log:
    rate = scene.motion.rate(scene.time)
    columns = scene.sensed() | {"ref_rate": rate + error}
    return scene.log(columns, "noise", figures={"noise": float(error.std())})


def _own_noise(scene: Scene) -> np.ndarray:
    """White noise (n, 3) of the gyro's own size."""
    white = scene.rng.standard_normal((len(scene.time), 3))
    return scene.sensor.gyro.n / np.sqrt(scene.h) * white


def rate_as_noisy_as_gyro(rng) -> Log:
    scene = new_scene(rng)
    return _against_rate(scene, _own_noise(scene))


def rate_with_correlated_noise(rng) -> Log:
    """A rate whose noise is as large as the gyro's and ends at 3 to 15 Hz."""
    scene = new_scene(rng)
    white = _own_noise(scene)
    low = sosfilt(butter(2, rng.uniform(3, 15), fs=1 / scene.h, output="sos"), white, axis=0)
    return _against_rate(scene, low * white.std(axis=0) / low.std(axis=0))


def _mounted(rng, angle: float) -> Log:
    scene = new_scene(rng)
    turn = _turn(rng, np.deg2rad(angle))
    columns = scene.sensed() | {"ref_q": rotation.product(scene.attitude(), turn)}
    return scene.log(columns, "mounting", figures={"angle": np.deg2rad(angle)})


def _turn(rng, angle: float) -> np.ndarray:
    """A rotation (4,) about a random axis."""
    axis = rng.standard_normal(3)
    return rotation.from_vector(angle * axis / np.linalg.norm(axis))


def mounting_1_deg(rng) -> Log:
    return _mounted(rng, 1.0)


def mounting_10_deg(rng) -> Log:
    return _mounted(rng, 10.0)


def occlusions(rng) -> Log:
    """The reference is lost for 0.5 to 3 s, some ten times."""
    scene = new_scene(rng)
    columns = scene.sensed() | {"ref_q": _occluded(scene, scene.attitude())}
    return scene.log(columns, "occlusions")


def _occluded(scene: Scene, q: np.ndarray) -> np.ndarray:
    for start in scene.rng.uniform(2, scene.time[-1], round(scene.time[-1] / 8)):
        lost = (scene.time >= start) & (scene.time < start + scene.rng.uniform(0.5, 3))
        q = np.where(lost[:, None], np.nan, q)
    return q


def occlusions_and_jumps(rng) -> Log:
    """As ``occlusions``, and three times the reference's world turns by 1 to 5 deg at once."""
    scene = new_scene(rng)
    q = scene.attitude()
    for at in rng.uniform(5, scene.time[-1] - 5, 3):
        jump = _turn(rng, np.deg2rad(rng.uniform(1, 5)))
        q = np.where(scene.time[:, None] >= at, rotation.product(jump, q), q)
    columns = scene.sensed() | {"ref_q": _occluded(scene, q)}
    return scene.log(columns, "jumps", figures={"count": 3})


def _behind_low_pass(scene: Scene, values: Callable, cut_off: float) -> np.ndarray:
    """What a low-pass of first order makes of ``values`` of a time, sampled ten times as often."""
    fine = np.arange(-SETTLED / cut_off, scene.time[-1] + scene.h, scene.h / 10)
    shown = sosfilt(butter(1, cut_off, fs=10 / scene.h, output="sos"), values(fine), axis=0)
    return np.stack([np.interp(scene.time, fine, v) for v in shown.T], axis=1)


def rate_behind_low_pass(rng) -> Log:
    """A rate of little noise behind a low-pass of 5 to 15 Hz."""
    scene, cut_off = new_scene(rng), rng.uniform(5, 15)
    rate = _behind_low_pass(scene, scene.motion.rate, cut_off)
    noise = 0.1 * _own_noise(scene)
    columns = scene.sensed() | {"ref_rate": rate + noise}
    return scene.log(columns, "lag", figures={"lag": 1 / (2 * np.pi * cut_off)})


def attitude_behind_low_pass(rng) -> Log:
    """An attitude, each entry of its quaternion behind a low-pass of 5 to 15 Hz."""
    scene, cut_off = new_scene(rng), rng.uniform(5, 15)
    q = _behind_low_pass(scene, lambda at: unwrapped(scene.motion.attitude(at)), cut_off)
    error = rotation.from_vector(scene.reference_std * rng.standard_normal((len(q), 3)))
    q /= np.linalg.norm(q, axis=1, keepdims=True)
    columns = scene.sensed() | {"ref_q": rotation.product(q, error)}
    return scene.log(columns, "lag", figures={"lag": 1 / (2 * np.pi * cut_off)})


def unwrapped(q: np.ndarray) -> np.ndarray:
    """Quaternions (n, 4) of the sign that the one before has."""
    turned = np.sign(np.sum(q[1:] * q[:-1], axis=1))
    return q * np.cumprod(np.append(1.0, turned))[:, None]


def smoother(rng, h: float) -> Callable[[np.ndarray], np.ndarray]:
    """A filter without delay, as software lays one over a recording: a moving average of 0.1 to
    0.3 s, a Gaussian one of 0.03 to 0.08 s, or Butterworth's of 3 to 6 Hz run both ways, of samples
    ``h`` s apart.
    """
    kind = rng.integers(3)
    if kind == 0:
        rows = 2 * round(0.5 * rng.uniform(0.1, 0.3) / h) + 1
        return lambda v: uniform_filter1d(v, rows, axis=0)
    if kind == 1:
        rows = rng.uniform(0.03, 0.08) / h
        return lambda v: gaussian_filter1d(v, rows, axis=0)
    low = butter(2, rng.uniform(3, 6), fs=1 / h, output="sos")
    return lambda v: sosfiltfilt(low, v, axis=0)


def attitude_smoothed(rng) -> Log:
    """An attitude with a camera's noise, each entry of its quaternion smoothed."""
    scene = new_scene(rng)
    error = rotation.from_vector(scene.reference_std * rng.standard_normal((len(scene.time), 3)))
    q = smoother(rng, scene.h)(unwrapped(rotation.product(scene.attitude(), error)))
    columns = scene.sensed() | {"ref_q": q / np.linalg.norm(q, axis=1, keepdims=True)}
    return scene.log(columns, "smoothed")


def rate_smoothed(rng) -> Log:
    """The rate of a better unit, smoothed."""
    scene = new_scene(rng)
    rate = scene.motion.rate(scene.time) + 0.1 * _own_noise(scene)
    return scene.log(scene.sensed() | {"ref_rate": smoother(rng, scene.h)(rate)}, "smoothed")


def drift_0_1_deg_per_min(rng) -> Log:
    """The reference's world turns slowly about one axis."""
    scene = new_scene(rng)
    axis = rng.standard_normal(3)
    slope = np.deg2rad(0.1) / 60 * axis / np.linalg.norm(axis)
    turned = rotation.from_vector(scene.time[:, None] * slope)
    columns = scene.sensed() | {"ref_q": rotation.product(turned, scene.attitude())}
    return scene.log(columns, "reference_drift", figures={"rate": float(np.linalg.norm(slope))})


TRAPS = (
    slerp_60_to_200_hz,
    held_at_20_hz,
    attitude_held_unevenly,
    rate_held,
    rate_as_noisy_as_gyro,
    rate_with_correlated_noise,
    mounting_1_deg,
    mounting_10_deg,
    occlusions,
    occlusions_and_jumps,
    rate_behind_low_pass,
    attitude_behind_low_pass,
    attitude_smoothed,
    rate_smoothed,
    drift_0_1_deg_per_min,
)
