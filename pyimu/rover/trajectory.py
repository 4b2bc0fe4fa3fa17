"""The motion of a planetary rover through the manoeuvres of Hidalgo 2012, section 6.1.

A drive is a list of manoeuvres, each a segment of constant heading rate and speed between two
stops. From it follow attitude, body rate and specific force at every sample.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.spatial.transform import Rotation, RotationSpline

from pyimu.symbolic.earth import EARTH_RATE
from pyimu.units import STANDARD_GRAVITY

TURN_RATE = 0.02
"""rad/s; turn on the spot."""

SPEED = 0.01
"""m/s; straight line and Ackermann steering."""

ACKERMANN_RADIUS = 1.25
"""m."""

RAMP = 2.0
"""s over which a manoeuvre starts and ends."""


@dataclass(frozen=True)
class Manoeuvre:
    """``duration`` s at ``turn`` rad/s (counter-clockwise) and ``speed`` m/s.

    The ground is as rough as ``roughness`` rad.
    """

    name: str
    duration: float
    turn: float = 0.0
    speed: float = 0.0
    roughness: float = 0.0


@dataclass(frozen=True)
class Motion:
    """True motion at n samples.

    ``time`` s, ``q`` (n, 4) body to east-north-up, ``rate`` rad/s against inertial space and
    ``force`` m/s^2 (n, 3) in body axes, ``standing`` (n,), ``name`` (n,) of the manoeuvre.
    """

    time: np.ndarray
    q: np.ndarray
    rate: np.ndarray
    force: np.ndarray
    standing: np.ndarray
    name: np.ndarray


def stop(duration: float) -> Manoeuvre:
    return Manoeuvre("stop", duration)


def turn_on_spot() -> list[Manoeuvre]:
    """0 to 180 deg and back at 0.02 rad/s."""
    half = np.pi / TURN_RATE
    return [
        Manoeuvre("turn on spot, out", half, turn=TURN_RATE),
        Manoeuvre("turn on spot, back", half, turn=-TURN_RATE),
    ]


def straight(length: float = 5.0, roughness: float = 0.03) -> list[Manoeuvre]:
    """A straight line of ``length`` m at 1 cm/s."""
    return [Manoeuvre("straight line", length / SPEED, speed=SPEED, roughness=roughness)]


def ackermann() -> list[Manoeuvre]:
    """Half a circle of 1.25 m radius at 1 cm/s."""
    return [
        Manoeuvre(
            "Ackermann steering",
            np.pi * ACKERMANN_RADIUS / SPEED,
            turn=SPEED / ACKERMANN_RADIUS,
            speed=SPEED,
            roughness=0.01,
        )
    ]


def drive(
    manoeuvres: Sequence[Manoeuvre], sample_rate: float, latitude: float, seed: int
) -> Motion:
    """Sample a drive at ``sample_rate`` Hz; ``seed`` draws the ground's bumps."""
    h = 1.0 / sample_rate
    counts = [round(m.duration * sample_rate) for m in manoeuvres]

    def spread(values: list[float]) -> np.ndarray:
        return np.repeat(np.array(values), counts)

    turn, speed, rough = (
        gaussian_filter1d(spread([getattr(m, n) for m in manoeuvres]), RAMP / 4 / h)
        for n in ("turn", "speed", "roughness")
    )
    time = np.arange(sum(counts)) * h
    heading = np.cumsum(turn) * h
    pitch, roll = _ground(np.cumsum(speed) * h, rough, np.random.default_rng(seed))
    attitude = Rotation.from_euler("ZYX", np.column_stack([heading, pitch, roll]))
    earth = EARTH_RATE * np.array([0.0, np.cos(latitude), np.sin(latitude)])
    rate = RotationSpline(time, attitude)(time, 1) + attitude.inv().apply(earth)
    return Motion(
        time,
        attitude.as_quat(scalar_first=True),
        rate,
        attitude.inv().apply([0.0, 0.0, STANDARD_GRAVITY]),
        ((turn == 0) & (speed == 0)).astype(float),
        spread([m.name for m in manoeuvres]),
    )


def _ground(
    distance: np.ndarray, rough: np.ndarray, rng: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """Pitch and roll [rad] over a ground whose bumps are 0.2 to 1.5 m long."""

    def one() -> np.ndarray:
        lengths, phases = rng.uniform(0.2, 1.5, 5), rng.uniform(0, 2 * np.pi, 5)
        return rough * np.sin(2 * np.pi * distance[:, None] / lengths + phases).mean(axis=1)

    return one(), one()
