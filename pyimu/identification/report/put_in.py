"""What was put into a simulated log beside what the loop found."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pyimu.identification.model.as_part import SENSORS, si_of
from pyimu.identification.model.simulated import PutIn
from pyimu.identification.outcome import Outcome
from pyimu.model.catalogue import CATALOGUE, POWER_ON
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.report.numbers import quantity


def put_in(closed: Outcome, truth: Part) -> tuple[PutIn, ...]:
    """What ``truth``, which made the log, has and the declared part has not, beside what was found.

    Turn-on bias is that of the first log.
    """
    return tuple(entry for kind in SENSORS for entry in _of_sensor(closed, truth.sensor(kind)))


def _of_sensor(closed: Outcome, true: Sensor) -> Iterator[PutIn]:
    declared = closed.before.sensor(true.kind).values
    for effect, coefficients in true.values.items():
        for name, value in coefficients.items():
            definition = CATALOGUE[effect].parameters[name]
            start = np.broadcast_to(definition.start, np.shape(value))
            known = np.asarray(declared.get(effect, {}).get(name, start), dtype=float)
            for index in np.ndindex(np.shape(value)):
                if value[index] != known[index] and not definition.reference:
                    yield PutIn(
                        true.kind,
                        effect,
                        name,
                        definition.place(index),
                        true.unit(definition.unit),
                        float(value[index]),
                        *_compared(closed, true.kind, (effect, name), index, float(value[index])),
                    )


def _compared(
    closed: Outcome, kind: str, key: tuple[str, str], index: tuple[int, ...], true: float
) -> tuple[float, float, float, str]:
    """Found, low, high, and how they compare with the truth."""
    nothing = (np.nan, np.nan, np.nan)
    if kind in closed.not_examined:
        return *nothing, "not examined"
    if key == POWER_ON:
        own = closed.recordings[0].log_state.get(kind, {}).get("bias")
        return (own[index[0]], np.nan, np.nan, "found, of this log") if own else (*nothing, "")
    entry = next(
        (e for e in closed.estimated if (e.sensor, e.effect, e.parameter) == (kind, *key)), None
    )
    if entry is not None and np.isfinite(entry.std[index]):
        low, high = float(entry.low[index]), float(entry.high[index])
        said = "found, in its interval" if low <= true <= high else "found, outside its interval"
        return float(entry.value[index]), low, high, said
    return *nothing, _why_not(closed, kind, key[0], index, true)


def _why_not(closed: Outcome, kind: str, effect: str, index: tuple[int, ...], true: float) -> str:
    seen = next((v for v in closed.observability if (v.sensor, v.effect) == (kind, effect)), None)
    if seen is None:
        return "not found"
    smallest = seen.each.get(index)
    if smallest is None:
        return "not found: this log does not show it at all"
    first = next(iter(CATALOGUE[effect].parameters))
    least = quantity(smallest, si_of(effect, first, seen.unit))
    if abs(true) < smallest:
        return f"not found: below the smallest that this log shows, {least}"
    return f"not found, though this log shows {least}"
