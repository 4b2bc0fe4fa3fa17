"""The structure of a triad, scale factors and misalignment, as what a fit estimates."""

from __future__ import annotations

from collections.abc import Iterable

from pyimu.identification.fit.keys import Coefficient, Key, coefficients_of
from pyimu.identification.fit.reduction import STRUCTURE
from pyimu.model.sensor import Sensor
from pyimu.model.typical import CLASSES, magnitudes


def with_structure(sensor: Sensor) -> tuple[Sensor, frozenset[Key]]:
    """A sensor that has the structure, at zero where it lacked it, and the keys of its
    coefficients.
    """
    for name in STRUCTURE:
        sensor = sensor if name in sensor.values else sensor.with_values(name)
    return sensor, frozenset().union(*(coefficients_of(sensor, n) for n in STRUCTURE))


def prior_of(sensor: Sensor, keys: Iterable[Key]) -> dict[Coefficient, float]:
    """Standard deviations of coefficients as they are among the coarsest parts."""
    return {k: magnitudes(k.effect, sensor.kind)[CLASSES[-1]].si for k in keys}
