"""Drives of a car in plain numpy: what it measures, and the positions that a receiver gives."""

from dataclasses import dataclass

import numpy as np

H, FINE = 0.01, 20
"""s; sample period of the gyro, and steps of the integration in one."""

G = 9.80665


@dataclass
class Drive:
    """Time (n,) s at the sensor's period; course rate (n,) rad/s, speed (n,) m/s, course (n,) rad
    counter-clockwise from east, and east and north (n, 2) m.
    """

    time: np.ndarray
    rate: np.ndarray
    speed: np.ndarray
    course: np.ndarray
    place: np.ndarray


def figure_eight(seed: int, seconds: float = 160.0, fast: float = 3.0) -> Drive:
    """Eights of random size one after the other, with two stands of 10 s: at the start, and in the
    middle.
    """
    rng = np.random.default_rng(seed)
    t = np.arange(0.0, seconds, H / FINE)
    frequency = rng.uniform(0.04, 0.3, 6)[:, None]
    size, phase = rng.uniform(0.15, 0.4, (6, 1)), rng.uniform(0, 2 * np.pi, (6, 1))
    stands = [(-5.0, 10.0), (seconds / 2 - 5.0, seconds / 2 + 5.0)]
    going = np.prod([np.clip(np.maximum(a - t, t - b) / 3.0, 0.0, 1.0) for a, b in stands], axis=0)
    going = going**2 * (3 - 2 * going)
    speed = fast * going * (1 + 0.3 * np.sin(2 * np.pi * 0.05 * t + phase[0]))
    rate = going * np.sum(size * np.sin(2 * np.pi * frequency * t + phase), axis=0)
    course = _integral(rate)
    place = np.column_stack([_integral(speed * f(course)) for f in (np.cos, np.sin)])
    return Drive(*(v[::FINE] for v in (t, rate, speed, course, place)))


def _integral(values: np.ndarray) -> np.ndarray:
    """By trapezia, from zero."""
    steps = 0.5 * (values[1:] + values[:-1]) * H / FINE
    return np.concatenate([[0.0], np.cumsum(steps)])


def measured_by(drive: Drive, mounting: np.ndarray, late: float, seed: int, noise: float = 2e-3):
    """Gyro and accelerometer (n, 3), ``late`` s after the drive by the receiver's clock, in a
    sensor whose axes are vehicle axes (forward, left, up) turned by ``mounting`` (3, 3).
    """
    rng = np.random.default_rng(seed)
    then = drive.time - late
    rate, speed = (np.interp(then, drive.time, v) for v in (drive.rate, drive.speed))
    zero = np.zeros(len(then))
    gyro = np.column_stack([zero, zero, rate])
    force = np.column_stack([np.gradient(speed, then), speed * rate, zero + G])
    gyro = gyro @ mounting.T + noise * rng.standard_normal(gyro.shape)
    return gyro, force @ mounting.T + 0.05 * rng.standard_normal(force.shape)


def received(drive: Drive, noise: float, seed: int, every: int = 10):
    """North and east (n,) m with ``noise``, on every tenth row; the others are empty."""
    rng = np.random.default_rng(seed)
    place = np.full(drive.place.shape, np.nan)
    rows = slice(0, len(place), every)
    place[rows] = drive.place[rows] + noise * rng.standard_normal(drive.place[rows].shape)
    return place[:, 1], place[:, 0]
