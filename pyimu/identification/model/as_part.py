"""The model that came out as a part, each coefficient with its interval and its source."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np

from pyimu.identification.fit.mixture import LEVEL
from pyimu.identification.model.estimated import Estimated
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.part import Part
from pyimu.model.part_value import EXACT, PartValue, with_values
from pyimu.model.sensor import Sensor
from pyimu.report.numbers import in_unit, joined, told_apart, unit_for, with_limits

SMALL = 0.1
"""Share of its standard error within which a coefficient that the logs do not show has not moved.
"""

NOT_SHOWN = "not shown by these logs"

ORIGINS = {
    "estimated": "estimated by pyimu close",
    "added": "found missing by pyimu close",
    "changed": "declared otherwise, contradicted by the logs of pyimu close",
}
"""What a part file says of a coefficient that data gave."""

SENSORS = {"gyro": "gyro", "accel": "accelerometer", "mag": "magnetometer"}
"""Names of the sensors."""


def unexamined_left_out(part: Part, declared: Part | None, examined: Iterable[str]) -> Part:
    """The part without the sensors that nobody declared and no log showed.

    Nothing is known of them, and zeros would call them perfect.
    """
    if declared is None:
        for kind in set(SENSORS) - set(examined):
            part = part.with_sensor(Sensor(kind))
    return part


def as_part(
    after: Part, entries: Iterable[Estimated], declared: Part | None, unexamined: Mapping[str, str]
) -> Part:
    """The part as its file has it.

    What the logs say nothing of and nobody declared is left out, the rest rounded to a hundredth of
    its standard error. It is the model of one specimen, without the tolerances of all.
    """
    entries, notes, part = tuple(entries), dict(after.notes), after
    for kind in SENSORS:
        own = [v for v in entries if v.sensor == kind]
        found = [v for v in own if v.origin in ("estimated", "added", "changed")]
        sensor, said = with_values(part.sensor(kind), map(_part_value, found))
        part = part.with_sensor(sensor.without(*silent(own) if declared is None else ()))
        notes |= {k: v for k, v in said.items() if k[1] in part.sensor(kind).values}
    return replace(
        part,
        estimate=frozenset(),
        tolerances=(),
        notes=notes,
        description=_description(part, entries, unexamined),
    )


def silent(entries: Iterable[Estimated]) -> list[str]:
    """The effects of which the logs show nothing at all.

    They stand at their start values, to within what is known beforehand.
    """
    shown: dict[str, bool] = {}
    for v in entries:
        if v.origin != "fixed":
            with np.errstate(invalid="ignore"):
                moved = np.abs(v.value - _start(v)) > SMALL * v.std
            shown[v.effect] = shown.get(v.effect, False) or bool(np.any(v.shown | moved))
    return [name for name, seen in shown.items() if not seen]


def _start(v: Estimated) -> float:
    return CATALOGUE[v.effect].parameters[v.parameter].start


def si_of(effect: str, parameter: str, si: str) -> str:
    """The SI unit of a coefficient, told apart where it is said otherwise than others in it."""
    return told_apart(si, CATALOGUE[effect].parameters[parameter].said)


def _part_value(v: Estimated) -> PartValue:
    unit = unit_for(v.value, si_of(v.effect, v.parameter, v.unit)) if v.unit != "degC" else v.unit
    with np.errstate(divide="ignore", invalid="ignore"):
        figures = np.ceil(np.log10(np.abs(v.value) / v.std)) + 3
    digits = np.where(np.isfinite(figures), np.clip(figures, 1, 15), EXACT).astype(int)
    return PartValue(v.effect, v.parameter, v.value, unit, _source(v, unit), digits)


def _source(v: Estimated, unit: str) -> str:
    """Where a coefficient is from, each element of it with its interval."""
    definition = CATALOGUE[v.effect].parameters[v.parameter]
    told = [i for i in definition.indices if v.shown[i] and (np.isfinite(v.std[i]) or v.value[i])]
    hidden = [definition.place(i) for i in definition.indices if not v.shown[i]]
    said = [f"{definition.place(i)} {element(v, i, unit)}".lstrip() for i in told]
    if hidden:
        which = "the rest" if len(v.value.shape) == 2 and told else joined(hidden)
        said.append(f"{which} {NOT_SHOWN}".lstrip())
    level = f"; {100 * LEVEL:g} % intervals in {unit}" if np.isfinite(v.std).any() else ""
    return f"{ORIGINS[v.origin]}: {', '.join(said)}{level}"


def element(v: Estimated, index: tuple[int, ...], unit: str) -> str:
    """An element with its interval as numbers of ``unit``, or that the logs do not show it."""
    if not v.shown[index]:
        return NOT_SHOWN
    return with_limits(*(float(in_unit(a[index], v.unit, unit)) for a in (v.value, v.low, v.high)))


def _description(part: Part, entries: Iterable[Estimated], unexamined: Mapping[str, str]) -> str:
    text = part.description.rstrip(".")
    entries = list(entries)
    lines = [f"{text}."] if text else []
    for kind, name in SENSORS.items():
        absent = silent(v for v in entries if v.sensor == kind)
        absent = [e for e in absent if e not in part.sensor(kind).values]
        if absent and kind not in unexamined:
            lines.append(f"The logs show nothing of the {name}'s {', '.join(absent)}.")
        if kind in unexamined and not part.sensor(kind).values:
            lines.append(f"The {name} was not examined: it is left out, and passed on unchanged.")
    return " ".join(lines)
