"""What is drawn of a part's specimen, as columns of the campaign's table."""

from __future__ import annotations

from pyimu.model.part import Part
from pyimu.model.sensor import Sensor


def drawn_values(part: Part, specimen: Part) -> dict[str, float]:
    """The coefficients that have a tolerance, by their names in the unit, with unit in brackets."""
    toleranced = {t.key for t in part.tolerances}
    return {
        f"{sensor.kind}_error.{slot.name} [{slot.unit}]": float(value)
        for sensor in (specimen.gyro, specimen.accel)
        for slot, value in zip(sensor.slots, sensor.p, strict=True)
        if (sensor.kind, slot.effect, slot.parameter) in toleranced
    }


def white_noise(sensor: Sensor) -> bool:
    """Whether a sensor has white noise, which makes successive samples differ."""
    return WHITE in sensor.values and sensor.acts(WHITE)


WHITE = "angle_random_walk"
"""White noise: it is no part of a bias."""
