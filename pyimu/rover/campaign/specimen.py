"""What is drawn of a part's specimen, as columns of the campaign's table."""

from __future__ import annotations

import numpy as np

from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.units import STANDARD_GRAVITY


def drawn_values(part: Part, specimen: Part) -> dict[str, float]:
    """The coefficients that have a tolerance, by their names in the unit, with unit in brackets."""
    toleranced = {t.key for t in part.tolerances}
    return {
        f"{sensor.kind}_error.{slot.name} [{slot.unit}]": float(value)
        for sensor in (specimen.gyro, specimen.accel)
        for slot, value in zip(sensor.slots, sensor.p, strict=True)
        if (sensor.kind, slot.effect, slot.parameter) in toleranced
    }


def bias_std(part: Part) -> np.ndarray:
    """Standard deviation (3,) rad/s of the gyro's turn-on bias among specimens."""
    return _std(part, "gyro", "turn_on_bias", "b0")


def gravity_std(part: Part) -> float:
    """Standard deviation m/s^2, among specimens, of what an upright accelerometer measures of the
    Earth's gravity, by its turn-on bias and its scale factor.
    """
    bias, scale = (
        _std(part, "accel", *names)[2] for names in (("turn_on_bias", "b0"), ("scale_factor", "s"))
    )
    return float(np.hypot(bias, scale * STANDARD_GRAVITY))


def _std(part: Part, *key: str) -> np.ndarray:
    """Standard deviation (3,) of a coefficient among specimens, zero without a tolerance."""
    return next((t.std for t in part.tolerances if t.key == key), np.zeros(3))


def white_noise(sensor: Sensor) -> bool:
    """Whether a sensor has white noise, which makes successive samples differ."""
    return WHITE in sensor.values and sensor.acts(WHITE)


WHITE = "angle_random_walk"
"""White noise: it is no part of a bias."""
