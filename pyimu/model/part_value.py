"""Coefficients that data gave, on their way into a part: value, unit in its file, and source."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from pyimu.model.catalogue import CATALOGUE
from pyimu.model.part_entry import FigureScale, Key
from pyimu.model.sensor import Sensor

DIGITS, EXACT = 5, 10
"""Figures in the file of a coefficient, none of which is known better, and of one that is known
exactly, as the step on which samples lie."""


@dataclass(frozen=True)
class PartValue:
    """A parameter of an effect in a part: its ``value`` in SI, and the ``unit`` in the file.

    ``digits`` figures of it go there: one number, or one for each element.
    """

    effect: str
    parameter: str
    value: np.ndarray
    unit: str
    source: str
    digits: int | np.ndarray = DIGITS

    def rounded(self, kind: str) -> np.ndarray:
        """The value in SI, so rounded in the unit of the file that the file holds it exactly."""
        si = Sensor(kind).unit(CATALOGUE[self.effect].parameters[self.parameter].unit)
        if si == "degC":
            return np.round(self.value, 3)
        scale = FigureScale(self.unit, si)
        return scale.to_si(np.vectorize(_figures)(scale.guess(self.value), self.digits))


def _figures(value: float, digits: int) -> float:
    return float(f"{value:.{digits - 1}e}")


def with_values(
    sensor: Sensor, values: Iterable[PartValue]
) -> tuple[Sensor, dict[Key, dict[str, str]]]:
    """A sensor with ``values`` in it, and what the part's notes say of them."""
    notes = {}
    for v in values:
        sensor = sensor.with_values(v.effect, **{v.parameter: v.rounded(sensor.kind)})
        said = {"unit": v.unit, "source": v.source}
        notes[sensor.kind, v.effect, v.parameter] = {k: text for k, text in said.items() if text}
    return sensor, notes
