"""What surrounds a sensor in one log: its motion, temperature, supply, magnetic field and place."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from generators import rotation
from generators.motion import Motion, thermal_cycle
from scipy.signal import butter, sosfiltfilt

HZ = 100.0
T0, V0 = 25.0, 3.3
"""degC and V at which thermal and supply errors are zero."""

EARTH_RATE, EARTH_RADIUS = 7.292115e-5, 6_371_000.0
FIELD = np.array([1.5e-6, 22e-6, -42e-6])
"""T, east, north and up."""


@dataclass(frozen=True)
class Scene:
    """A motion and its surroundings, sampled at ``time`` (n,): ``warmth`` (n,) in degC, ``supply``
    (n,) in V, ``latitude`` in rad, ``cruise`` (2,), the velocity in m/s to the east and north that
    the vehicle has beside its motion.
    """

    time: np.ndarray
    motion: Motion
    warmth: np.ndarray
    supply: np.ndarray
    latitude: float
    cruise: np.ndarray

    @property
    def h(self) -> float:
        return 1 / HZ

    @property
    def fitted(self) -> int:
        """Rows of the first 70 %, which a loop may fit."""
        return round(0.7 * len(self.time))

    @cached_property
    def rate(self) -> np.ndarray:
        return self.motion.rate(self.time)

    @cached_property
    def force(self) -> np.ndarray:
        return self.motion.force(self.time)

    @cached_property
    def attitude(self) -> np.ndarray:
        return self.motion.attitude(self.time)

    @cached_property
    def velocity(self) -> np.ndarray:
        """m/s (n, 3), east-north-up."""
        moved = self.motion.acceleration.antiderivative()(self.time)
        return moved - moved.mean(axis=0) + np.append(self.cruise, 0.0)

    @cached_property
    def mag(self) -> np.ndarray:
        return self.to_body(np.broadcast_to(FIELD, (len(self.time), 3)))

    @cached_property
    def earth(self) -> np.ndarray:
        """The Earth's rate (n, 3) in body axes (Groves 2013, 2.123)."""
        world = EARTH_RATE * np.array([0.0, np.cos(self.latitude), np.sin(self.latitude)])
        return self.to_body(np.broadcast_to(world, (len(self.time), 3)))

    @cached_property
    def transport(self) -> np.ndarray:
        """The rate (n, 3) at which east-north-up turns along the way (Groves 2013, 5.44)."""
        east, north, _ = self.velocity.T
        world = np.column_stack([-north, east, east * np.tan(self.latitude)]) / EARTH_RADIUS
        return self.to_body(world)

    @cached_property
    def heading(self) -> np.ndarray:
        """rad (n,) of the forward axis over the ground, counter-clockwise from east."""
        w, x, y, z = self.attitude.T
        return np.unwrap(np.arctan2(2 * (w * z + x * y), 1 - 2 * (y**2 + z**2)))

    def own(self, kind: str, at: np.ndarray | None = None) -> np.ndarray:
        """The signal (n, 3) that a sensor of a kind measures, at other times if given."""
        if at is not None:
            return (self.motion.rate if kind == "gyro" else self.motion.force)(at)
        return self.rate if kind == "gyro" else self.force

    def slope(self, kind: str) -> np.ndarray:
        """Its derivative (n, 3), a central difference over 2 ms, which misses some 1e-4 of it at
        10 Hz.
        """
        step = 1e-3
        ahead, behind = (self.own(kind, self.time + d) for d in (step, -step))
        return (ahead - behind) / (2 * step)

    def to_body(self, world: np.ndarray) -> np.ndarray:
        return rotation.in_body(self.attitude, world)


def new_scene(rng, motion: Callable[..., Motion], duration: float) -> Scene:
    time = np.arange(round(duration * HZ)) / HZ
    warmth = (_cycled if motion is thermal_cycle else _swaying)(rng, time)
    supply = V0 + 0.05 * _slow_noise(rng, time) + 0.1 * (np.sin(time / rng.uniform(20, 60)) > 0.3)
    angle, speed = rng.uniform(0, 2 * np.pi), rng.uniform(10, 30)
    return Scene(
        time,
        motion(rng, duration),
        warmth,
        supply,
        float(rng.uniform(0.4, 1.1)),
        speed * np.array([np.cos(angle), np.sin(angle)]),
    )


def _slow_noise(rng, time: np.ndarray) -> np.ndarray:
    """Noise (n,) of unit variance below 0.05 Hz."""
    sos = butter(2, 0.05, fs=HZ, output="sos")
    out = sosfiltfilt(sos, rng.standard_normal(len(time)))
    return (out - out.mean()) / out.std()


def _swaying(rng, time: np.ndarray) -> np.ndarray:
    """degC (n,): the part warms up by 4 to 12 K, and sways with its surroundings."""
    rise = rng.uniform(4, 12) * (1 - np.exp(-time / rng.uniform(40, 150)))
    period, phase = rng.uniform(80, 300), rng.uniform(0, 2 * np.pi)
    sway = rng.uniform(1.0, 4.0) * np.sin(2 * np.pi * time / period + phase)
    return rng.uniform(18, 26) + rise + sway


def _cycled(rng, time: np.ndarray) -> np.ndarray:
    """degC (n,): two cycles of 15 to 30 K either way, by even ramps with rests at their ends."""
    phase = 2 * np.pi * (2.2 * time / time[-1] + rng.uniform(0, 1))
    ramps = np.clip(1.4 * np.arcsin(np.sin(phase)) / (np.pi / 2), -1, 1)
    smooth = sosfiltfilt(butter(1, 0.02, fs=HZ, output="sos"), ramps)
    return 25 + rng.uniform(-5, 5) + rng.uniform(15, 30) * smooth
