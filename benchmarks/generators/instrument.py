"""A consumer sensor: what it measures of a motion, and the part file that declares it."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from generators.motion import GRAVITY

T0 = 25.0


@dataclass(frozen=True)
class Triad:
    """Three gyros or accelerometers.

    ``scale`` (3,), ``skew`` (3, 3) rad, ``bias`` (3,), white noise ``n`` (3,) by the root of its
    two-sided density, random walk ``k`` (3,), bias per kelvin ``thermal`` (3,).
    """

    bias: np.ndarray
    n: np.ndarray
    k: np.ndarray
    scale: np.ndarray = field(default_factory=lambda: np.zeros(3))
    skew: np.ndarray = field(default_factory=lambda: np.zeros((3, 3)))
    thermal: np.ndarray = field(default_factory=lambda: np.zeros(3))

    def measure(self, rng, x: np.ndarray, h: float, warmth: np.ndarray | None = None) -> np.ndarray:
        """What it shows of ``x`` (n, 3): y = (1 + s)(x + M x) + b + kT (T - T0) + noise."""
        out = (1 + self.scale) * (x + x @ self.skew.T) + self.bias
        if warmth is not None:
            out = out + (warmth - T0)[:, None] * self.thermal
        white = self.n / np.sqrt(h) * rng.standard_normal(x.shape)
        return out + white + np.cumsum(self.k * np.sqrt(h) * rng.standard_normal(x.shape), axis=0)


@dataclass(frozen=True)
class Sensor:
    gyro: Triad
    accel: Triad

    def part_file(self, sample_rate: float, name: str = "simulated") -> str:
        """TOML that declares all of it but the bias, which is new at each power-on."""
        lines = [f'name = "{name}"', f'sample_rate = {{value = {sample_rate!r}, unit = "Hz"}}']
        for kind, y, triad in (("gyro", "rad/s", self.gyro), ("accel", "m/s^2", self.accel)):
            for effect, name, unit, values in _declared(triad, y):
                numbers = _written(values)
                lines += ["", f"[{kind}.{effect}]"]
                lines += [f'{name} = {{value = {numbers}, unit = "{unit}"}}']
        return "\n".join(lines) + "\n"


def _written(values: np.ndarray) -> list:
    """Nested lists of numbers of twelve digits."""
    digits = [float(f"{v:.12g}") for v in np.ravel(values)]
    return np.reshape(digits, np.shape(values)).tolist()


def _declared(triad: Triad, y: str) -> list[tuple[str, str, str, np.ndarray]]:
    whole = {"rad/s": "rad", "m/s^2": "m/s"}[y]
    entries = [
        ("scale_factor", "s", "1", triad.scale),
        ("misalignment", "m", "rad", triad.skew),
        ("thermal_bias", "kT", f"{y}/K", triad.thermal),
        ("angle_random_walk", "N", f"{whole}/sqrt(s)", triad.n),
        ("rate_random_walk", "K", f"{y}/sqrt(s)", triad.k),
    ]
    return [e for e in entries if np.any(e[3])]


def any_sensor(rng, thermal: bool = False) -> Sensor:
    """A consumer part as it comes: half of them trimmed, the others with a scale factor and
    misalignment, which the part file then declares.
    """
    trimmed = rng.random() < 0.5
    density = np.deg2rad(rng.uniform(0.005, 0.02))
    walk = np.deg2rad(10 ** rng.uniform(-4.0, -3.0))
    gyro = _triad(rng, np.deg2rad(0.5), density, walk, trimmed)
    accel = _triad(
        rng, 0.02 * GRAVITY, rng.uniform(80e-6, 200e-6) * GRAVITY, 1e-5 * GRAVITY, trimmed
    )
    if thermal:
        warmth = np.deg2rad(rng.uniform(0.01, 0.05, 3)) * rng.choice([-1, 1], 3)
        gyro = Triad(gyro.bias, gyro.n, gyro.k, gyro.scale, gyro.skew, warmth)
    return Sensor(gyro, accel)


def _triad(rng, bias: float, density: float, walk: float, trimmed: bool) -> Triad:
    return Triad(
        bias=bias * rng.standard_normal(3),
        n=density * rng.uniform(0.9, 1.1, 3),
        k=walk * rng.uniform(0.8, 1.2, 3),
        scale=np.zeros(3) if trimmed else 3e-3 * rng.standard_normal(3),
        skew=np.zeros((3, 3)) if trimmed else 3e-3 * rng.standard_normal((3, 3)) * (1 - np.eye(3)),
    )
