"""What was found of a magnetometer in the model that comes out: values, and where they are from."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pyimu.attitude.calibration import as_values
from pyimu.identification.magnetometer.examine import Examined
from pyimu.identification.magnetometer.fit import BIAS, MATRIX, SHARED
from pyimu.identification.model.estimated import Estimated
from pyimu.model.catalogue import WHITE
from pyimu.model.kinds import MAGNETOMETER
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor


def with_magnetometer(part: Part, start: Part, seen: Examined | str) -> Part:
    """The part with what was found of its magnetometer, and its noise where nobody declared one."""
    if isinstance(seen, str):
        return part
    sensor = part.sensor(MAGNETOMETER)
    for effect, values in (as_values(seen.after.calibration) if seen.adopted else {}).items():
        sensor = sensor.with_values(effect, **values)
    if not _declared(start, *WHITE) and np.isfinite(seen.N).all():
        sensor = sensor.with_values(WHITE[0], **{WHITE[1]: seen.N})
    return part.with_sensor(sensor)


def magnetic(start: Part, after: Part, seen: Examined | str) -> tuple[Estimated, ...]:
    """The magnetometer's coefficients in the model ``after``, with their standard errors."""
    if isinstance(seen, str):
        return ()
    return tuple(_entries(start, after.sensor(MAGNETOMETER), seen))


def _entries(start: Part, sensor: Sensor, seen: Examined) -> Iterator[Estimated]:
    fitted = _standard_errors(seen) if seen.adopted else {}
    for e in sensor.effects:
        for name, q in e.parameters.items():
            value, key = sensor.values[e.name][name], (e.name, name)
            nothing, declared = np.full(value.shape, np.nan), _declared(start, *key)
            origin, std, shown, source = "estimated", nothing, True, ""
            if key in fitted:
                origin, std = "changed" if declared else "estimated", fitted[key]
            elif declared:
                origin = "declared"
                source = start.notes.get((MAGNETOMETER, *key), {}).get("source", "")
            else:
                shown = key == WHITE
            yield Estimated(
                MAGNETOMETER,
                *key,
                sensor.unit(q.unit),
                value,
                std,
                np.full(value.shape, shown),
                origin,
                source,
            )


def _declared(start: Part, effect: str, parameter: str) -> bool:
    there = effect in start.sensor(MAGNETOMETER).values
    return there and (MAGNETOMETER, effect, parameter) not in start.estimate


def _standard_errors(seen: Examined) -> dict[tuple[str, str], np.ndarray]:
    """Standard errors of ``as_values``: s is A_ii - 1, m is A_ij / A_ii."""
    covariance, matrix = seen.after.covariance, seen.after.calibration.matrix
    slope = np.zeros((9, SHARED))
    for i in range(3):
        for j in set(range(3)) - {i}:
            slope[3 * i + j, MATRIX.start + 3 * i + j] = 1 / matrix[i, i]
            slope[3 * i + j, MATRIX.start + 4 * i] = -matrix[i, j] / matrix[i, i] ** 2
    std = np.sqrt(np.diag(covariance))
    m = np.sqrt(np.diag(slope @ covariance @ slope.T)).reshape(3, 3)
    return {
        ("turn_on_bias", "b0"): std[BIAS],
        ("scale_factor", "s"): std[MATRIX][::4],
        ("misalignment", "m"): np.where(np.eye(3), np.nan, m),
    }
