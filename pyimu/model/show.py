"""A part in a notebook: short in a line, whole in a table. ``part`` is a ``Part``."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from pyimu.display import notebook
from pyimu.model.part_entry import FigureScale
from pyimu.model.sensor import Sensor

if TYPE_CHECKING:
    from pandas import DataFrame


def as_text(part: Any) -> str:
    """``Part('mpu6050', 1000 Hz: gyro lag, angle_random_walk, ...; 12 tolerances)``."""
    sensors = "; ".join(
        f"{s.kind} {', '.join(s.values)}" for s in (part.gyro, part.accel, part.mag) if s.values
    )
    count = len(part.tolerances)
    tolerances = f"; {count} tolerance{'s' * (count > 1)}" if count else ""
    return f"Part({part.name!r}, {part.sample_rate:.6g} Hz: {sensors or 'ideal'}{tolerances})"


def as_html(part: Any) -> str:
    """Every coefficient with its unit, the figure as quoted and the source, then the tolerances."""
    tolerances = [(".".join(t.key), t.size(4), t.quoted, t.source) for t in part.tolerances]
    head = ("quoted", "source")
    parts = [notebook.table(("coefficient", "value", *head), _rows(part))]
    if tolerances:
        parts.append(notebook.table(("tolerance", "specimens lie", *head), tolerances))
    note = f"{part.description or 'no description'}; {part.sample_rate:.6g} Hz"
    return notebook.block(f"Part {part.name}", note, *parts)


def as_frame(part: Any) -> DataFrame:
    """The coefficients as a pandas data frame, a row each, values in SI.

    Columns: ``coefficient`` (``gyro.angle_random_walk.N``), ``value`` (an array of the parameter's
    shape), ``unit``, ``estimate`` (whether it is left to the data), ``quoted``, ``source``.
    """
    rows = []
    for sensor in (part.gyro, part.accel, part.mag):
        for e in sensor.effects:
            for name, q in e.parameters.items():
                key = (sensor.kind, e.name, name)
                note = part.notes.get(key, {})
                rows.append(
                    {
                        "coefficient": ".".join(key),
                        "value": sensor.values[e.name][name],
                        "unit": sensor.unit(q.unit),
                        "estimate": key in part.estimate,
                        "quoted": note.get("quoted", ""),
                        "source": note.get("source", ""),
                    }
                )
    return notebook.data_frame(rows)


def _rows(part: Any) -> Iterator[tuple[str, str, str, str]]:
    for sensor in (part.gyro, part.accel, part.mag):
        for e in sensor.effects:
            for name, q in e.parameters.items():
                key = (sensor.kind, e.name, name)
                value, note = sensor.values[e.name][name], part.notes.get(key, {})
                if note or key in part.estimate or np.any(value != q.start):
                    text = (
                        "estimated" if key in part.estimate else _value(sensor, value, q.unit, note)
                    )
                    yield ".".join(key), text, note.get("quoted", ""), note.get("source", "")


def _value(sensor: Sensor, value: np.ndarray, unit: str, note: dict[str, str]) -> str:
    """The figures in the unit in which the part's file has them."""
    si = sensor.unit(unit)
    scale = FigureScale(note.get("unit", si), si, note.get("density", "two-sided"))
    figures = np.ravel(scale.guess(np.asarray(value)))
    texts = list(dict.fromkeys(f"{v:.4g}" for v in figures))
    said = texts[0] if len(texts) == 1 else ", ".join(f"{v:.4g}" for v in figures)
    kind = f" ({scale.density})" if "density" in note else ""
    return f"{said} {'' if scale.unit == '1' else scale.unit}{kind}".rstrip()
