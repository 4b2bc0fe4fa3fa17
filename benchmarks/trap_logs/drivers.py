"""Traps of what a chip, its driver or a script did to samples before they were logged."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from generators import rotation
from scipy.signal import butter, sosfiltfilt

from trap_logs.log import Columns, Log, Scene, beside, new_scene


def _with_attitude(scene: Scene, sensed: Columns) -> Columns:
    return sensed | {"ref_q": scene.attitude()}


def sensor_filtered_both_ways(rng) -> Log:
    """A script laid a Butterworth filter of 8 to 20 Hz over gyro and accelerometer, forward and
    back.
    """
    scene = new_scene(rng)
    low = butter(2, rng.uniform(8, 20), fs=scene.hz, output="sos")
    columns = _with_attitude(scene, scene.sensed())
    columns |= {name: sosfiltfilt(low, columns[name], axis=0) for name in ("gyro", "accel")}
    return scene.log(columns, "no_delay", late=True)


def bias_taken_out_online(rng) -> Log:
    """A driver takes the gyro's mean over the latest rest out of what follows: the bias jumps from
    what it was, 0.2 to 2 deg/s, to nearly zero, and later by a little.
    """
    scene = new_scene(rng)
    columns = _with_attitude(scene, scene.sensed())
    size = np.radians(rng.uniform(0.2, 2.0)) * rng.standard_normal(3)
    at = np.sort(rng.uniform(0.1, 0.6, 3)) * scene.time[-1]
    left = np.vstack([size, 0.03 * size[None] * rng.standard_normal((3, 3))])
    columns["gyro"] = columns["gyro"] + left[np.searchsorted(at, scene.time)]
    return scene.log(columns, "unblamed", own=frozenset({"bias_step"}))


def full_scale_switched(rng) -> Log:
    """A driver doubles the gyro's range while it turns fast, and the reader goes on with the old
    factor: what is fast is shown half as large.
    """
    scene = new_scene(rng)
    columns = _with_attitude(scene, scene.sensed())
    speed = np.abs(columns["gyro"]).max(axis=1)
    limit, fast, wide = np.quantile(speed, rng.uniform(0.85, 0.95)), 0, np.zeros(len(speed), bool)
    for k, one in enumerate(speed):
        fast = 50 if one > limit else max(fast - 1, 0)
        wide[k] = fast > 0
    columns["gyro"] = np.where(wide[:, None], 0.5, 1.0) * columns["gyro"]
    return scene.log(columns, "unblamed")


def fifo_of_nominal_rate(rng) -> Log:
    """A FIFO is read every 40 to 100 ms and its samples are stamped back from then, 10 ms apart,
    while the chip samples 1 to 5 % faster or slower.
    """
    scene = new_scene(rng)
    pace = rng.uniform(0.01, 0.05) * float(rng.choice([-1.0, 1.0]))
    true = scene.time[scene.time < scene.time[-1] / (1 + abs(pace))] / (1 + pace)
    read = rng.uniform(0.04, 0.1)
    batch = np.floor(true / read).astype(int)
    last = np.append(np.flatnonzero(np.diff(batch)), len(true) - 1)
    end = last[np.searchsorted(last, np.arange(len(true)))]
    stamps = (batch + 1) * read - scene.h * (end - np.arange(len(true)))
    order = np.argsort(stamps, kind="stable")
    sensed = replace(scene, time=true).sensed() | {"time": stamps}
    rows = order[np.diff(stamps[order], prepend=-np.inf) > 1e-6]
    return beside(scene, {k: v[rows] for k, v in sensed.items()}, "unblamed", late=True)


def sensor_polled(rng) -> Log:
    """Rows of 100 Hz hold the latest sample of a chip that samples at 90 to 98 or 103 to 125 Hz:
    some stand twice, or never.
    """
    scene = new_scene(rng)
    hz = float(rng.uniform(90, 98) if rng.random() < 0.5 else rng.uniform(103, 125))
    own = np.arange(-2, round(scene.time[-1] * hz) + 2) / hz + rng.uniform(0, 1 / hz)
    sensed = replace(scene, hz=hz, time=own).sensed()
    latest = np.searchsorted(own, scene.time, side="right") - 1
    columns = {k: v[latest] for k, v in sensed.items()} | {"time": scene.time}
    return scene.log(_with_attitude(scene, columns), "unblamed", late=True)


def two_units_averaged(rng) -> Log:
    """The mean of two units that are 1 to 3 deg askew to each other, one 4 to 12 ms behind."""
    scene = new_scene(rng)
    axis = rng.standard_normal(3)
    turn = rotation.from_vector(np.radians(rng.uniform(1, 3)) * axis / np.linalg.norm(axis))
    one, other = scene.sensed(), scene.sensed(-rng.uniform(4e-3, 12e-3))
    for name in ("gyro", "accel"):
        askew = rotation.in_body(np.tile(turn, (len(scene.time), 1)), other[name])
        one[name] = 0.5 * (one[name] + askew)
    return scene.log(_with_attitude(scene, one), "unblamed", late=True)


def sensor_gaps_filled(rng) -> Log:
    """Rows of the sensor are lost for 0.1 to 0.8 s six times, and a script drew lines across."""
    scene = new_scene(rng)
    columns = _with_attitude(scene, scene.sensed())
    lost = np.zeros(len(scene.time), bool)
    for first in rng.integers(200, len(lost) - 200, 6):
        lost[first : first + int(rng.uniform(0.1, 0.8) / scene.h)] = True
    for name in ("gyro", "accel"):
        lines = [np.interp(scene.time, scene.time[~lost], v[~lost]) for v in columns[name].T]
        columns[name] = np.column_stack(lines)
    return scene.log(columns, "filled")


TRAPS = (
    sensor_filtered_both_ways,
    bias_taken_out_online,
    full_scale_switched,
    fifo_of_nominal_rate,
    sensor_polled,
    two_units_averaged,
    sensor_gaps_filled,
)
