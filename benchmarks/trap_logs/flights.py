"""Traps of the air: quadrotors that nothing is wrong with, beside the cameras that watch them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from generators import rotation
from generators.instrument import Sensor, Triad
from generators.motion import GRAVITY, KNOTS, Motion, eased, grid, motion_of, smooth_noise
from scipy.interpolate import make_interp_spline
from scipy.signal import butter, sosfilt

from trap_logs.log import Columns, Log

INNER = 5
"""Times the log's rate at which motors are simulated: what they do beyond its half is folded."""


def _course(rng, t: np.ndarray, duration: float) -> np.ndarray:
    """Positions (n, 3) m of a flight: up, figures of eight and strolls, down, with rest before and
    after.
    """
    start, stop = rng.uniform(5, 10), duration - rng.uniform(5, 10)
    aloft = eased(t, [(start, stop)], rng.uniform(3, 5))
    inside = eased(t, [(start + 4, stop - 4)], 4.0)
    phase = np.cumsum(inside * 2 * np.pi / rng.uniform(5, 10)) / KNOTS
    size, lean = rng.uniform(1.0, 2.5), rng.uniform(0, 2 * np.pi)
    eight = size * np.column_stack([np.sin(phase), 0.5 * np.sin(2 * phase)])
    c, s = np.cos(lean), np.sin(lean)
    level = eight @ np.array([[c, s], [-s, c]])
    stroll = rng.uniform(0.1, 0.4) * smooth_noise(rng, t, 3, 0.03, 0.4) * inside[:, None]
    height = rng.uniform(1.0, 2.0) * aloft
    return np.column_stack([level, height]) + stroll


def flight(rng, duration: float) -> Motion:
    """A quadrotor: its thrust, which is the body's z, makes the acceleration, and drag and gusts
    tilt it besides; it heads where it pleases.
    """
    t = grid(duration)
    acceleration = make_interp_spline(t, _course(rng, t, duration), k=5).derivative(2)
    pushed = acceleration(t)
    flies = eased(t, [(8.0, duration - 8.0)], 3.0)
    yaw = flies * (rng.uniform(0.3, 1.2) * smooth_noise(rng, t, 1, 0.0, 0.2)[:, 0])
    velocity = acceleration.antiderivative()(t)
    thrust = pushed + rng.uniform(0.2, 0.4) * velocity + [0.0, 0.0, GRAVITY]
    cosine, sine = np.cos(yaw), np.sin(yaw)
    ahead = cosine * thrust[:, 0] + sine * thrust[:, 1]
    left = -sine * thrust[:, 0] + cosine * thrust[:, 1]
    pitch = np.arctan2(ahead, thrust[:, 2])
    roll = -np.arctan2(left, np.hypot(ahead, thrust[:, 2]))
    gusts = np.radians(rng.uniform(0.5, 1.5)) * smooth_noise(rng, t, 2, 0.3, 2.0) * flies[:, None]
    angles = np.column_stack([roll, pitch, yaw]) + np.pad(gusts, ((0, 0), (0, 1)))
    slopes = make_interp_spline(t, angles, k=5).derivative()(t)
    return motion_of("flight", t, slopes, pushed, speed=flies)


def adis16448(rng) -> Sensor:
    """The unit of the flights, its figures as its calibration has them."""
    of = np.ones(3)
    gyro = Triad(np.radians(2) * rng.standard_normal(3), 1.7e-4 * of, 1.9e-5 * of)
    accel = Triad(0.2 * rng.standard_normal(3), 2.0e-3 * of, 3.0e-3 * of)
    return Sensor(gyro, accel)


@dataclass(frozen=True)
class Motors:
    """Vibration of motors: ``tone`` Hz at hover, directions (2, 3) of what its two harmonics do to
    gyro and to accelerometer, and ``rough`` broad noise of each.
    """

    tone: float
    gyro: np.ndarray
    accel: np.ndarray
    rough: tuple[float, float]

    def shake(self, rng, motion: Motion, hz: float, time: np.ndarray) -> tuple:
        """What they do (n, 3) to gyro and accelerometer."""
        fine = np.arange(len(time) * INNER) / (INNER * hz) + time[0]
        slow = grid(time[-1] + 1)
        fast = 1 + 0.04 * smooth_noise(rng, slow, 4, 0.2, 3.0)
        turned = np.cumsum(make_interp_spline(slow, fast, k=3)(fine), axis=0) / (INNER * hz)
        phases = 2 * np.pi * self.tone * turned
        flies = np.clip(np.interp(fine, slow, motion.speed(slow)), 0, 1)[:, None]
        band = butter(2, (15, 90), "bandpass", fs=INNER * hz, output="sos")
        out = []
        for directions, rough in zip((self.gyro, self.accel), self.rough, strict=True):
            tones = np.stack([np.sin(phases).sum(axis=1), np.sin(2 * phases).sum(axis=1)], axis=1)
            broad = sosfilt(band, rng.standard_normal((len(fine), 3)), axis=0)
            shaken = tones @ directions + rough * broad / broad.std(axis=0)
            out.append((flies * shaken)[::INNER])
        return tuple(out)


def any_motors(rng) -> Motors:
    def directions(size):
        return size * np.array([[1.0], [0.4]]) * rng.standard_normal((2, 3)) / np.sqrt(3)

    gyro, accel = rng.uniform(0.02, 0.1), 10 ** rng.uniform(-1.0, -0.2)
    tones = directions(gyro), directions(accel)
    return Motors(rng.uniform(80, 160), *tones, (0.5 * gyro, 0.5 * accel))


def _flown(rng, sensor: Sensor, motors: Motors, turn: np.ndarray, arm: np.ndarray) -> Columns:
    """One flight of 90 to 150 s: the unit at 200 Hz, and at 100 Hz what cameras see of a point that
    is ``arm`` (3,) m from it, and of a body turned by ``turn`` (4,) against it.
    """
    hz, duration = 200.0, float(rng.uniform(90, 150))
    motion, time = flight(rng, duration), np.arange(round(duration * hz)) / hz
    shaken = motors.shake(rng, motion, hz, time)
    given = (motion.rate(time), sensor.gyro), (motion.force(time), sensor.accel)
    gyro, accel = (t.measure(rng, x, 1 / hz) + s for (x, t), s in zip(given, shaken, strict=True))
    q = motion.attitude(time)
    there = rotation.in_body(rotation.inverse(q), arm)
    error = np.radians(rng.uniform(0.02, 0.08)) * rng.standard_normal((len(time), 3))
    seen = rotation.product(rotation.product(q, rotation.from_vector(error)), turn)
    blur = rng.uniform(0.1e-3, 0.6e-3) * rng.standard_normal((len(time), 3))
    places = motion.acceleration.antiderivative(2)(time) + there + blur
    seen[1::2], places[1::2] = np.nan, np.nan
    columns = {"time": time, "gyro": gyro, "accel": accel, "ref_q": seen}
    return columns | dict(zip(("ref_east", "ref_north", "ref_up"), places.T, strict=True))


def quadrotor(rng) -> Log:
    """Two flights of one quadrotor."""
    sensor, motors = adis16448(rng), any_motors(rng)
    angles = np.radians(rng.uniform(0, 3)) * rng.standard_normal((1, 3)) / np.sqrt(3)
    turn = rotation.from_vector(angles)[0]
    arm = 0.06 * rng.standard_normal(3)
    again = replace(sensor.gyro, bias=sensor.gyro.bias + 1e-3 * rng.standard_normal(3))
    logs = tuple(_flown(rng, s, motors, turn, arm) for s in (sensor, replace(sensor, gyro=again)))
    return Log(logs, sensor.part_file(200.0), ("flight",))


TRAPS = (quadrotor,)
