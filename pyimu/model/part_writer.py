"""A part as the text of its file."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping

import numpy as np

from pyimu.model.effect import Effect
from pyimu.model.kinds import TRIADS
from pyimu.model.part import Part
from pyimu.model.part_entry import (
    ESTIMATE,
    RATE_KEY,
    TOLERANCE,
    FigureScale,
    is_density,
    nested,
)
from pyimu.model.sensor import Sensor
from pyimu.model.tolerance import Tolerance


def format_part(part: Part) -> str:
    """The TOML text of a part."""
    lines = [f"name = {_text(part.name)}"]
    if part.description:
        lines.append(f"description = {_text(part.description)}")
    lines.append(f"sample_rate = {_format_rate(part)}")
    for kind in TRIADS:
        sensor = part.sensor(kind)
        for e in sensor.effects:
            lines += ["", f"[{kind}.{e.name}]"]
            lines += [f"{name} = {_format_entry(part, sensor, e, name)}" for name in e.parameters]
    effects = dict.fromkeys(t.key[:2] for t in part.tolerances)
    for effect in effects:
        lines += ["", f"[{TOLERANCE}.{'.'.join(effect)}]"]
        lines += [_format_tolerance(t) for t in part.tolerances if t.key[:2] == effect]
    return "\n".join(lines) + "\n"


def _format_tolerance(t: Tolerance) -> str:
    sizes = np.array(t.sizes[0]) if len(set(t.sizes)) == 1 else t.array
    entry = _with_unit(sizes, t.si, {"unit": t.unit} if t.unit else {})
    note = {"distribution": t.distribution, "source": t.source, "quoted": t.quoted}
    return f"{t.key[2]} = {_table({**entry, **_texts(note, tuple(note))})}"


def _format_rate(part: Part) -> str:
    note = part.notes.get(RATE_KEY, {})
    unit = note.get("unit", "Hz")
    figures = _figures(np.array(part.sample_rate), FigureScale(unit, "Hz"))
    if figures is None:
        unit, figures = "Hz", repr(float(part.sample_rate))
    return _table({"value": figures, "unit": _text(unit), **_texts(note, ("source",))})


def _format_entry(part: Part, sensor: Sensor, e: Effect, name: str) -> str:
    key, q = (sensor.kind, e.name, name), e.parameters[name]
    note, values = part.notes.get(key, {}), sensor.values[e.name][name]
    entry = _with_unit(values, sensor.unit(q.unit), note, q.density)
    if key in part.estimate:
        # Where the search starts is worth a word only if it is not the identity.
        start = {"start": entry.pop("value")} if np.any(values != q.start) else {}
        entry = {
            "value": _text(ESTIMATE),
            **start,
            **{k: v for k, v in entry.items() if k != "value"},
        }
    return _table({**entry, **_texts(note, ("source", "quoted"))})


def _with_unit(
    values: np.ndarray, si: str, note: Mapping[str, str], noise: bool = False
) -> dict[str, str]:
    """The value of an entry with its unit, and for the density of a ``noise`` which kind it is.

    The unit is the quoted one where that gives back the same SI value to the last bit.
    """
    unit = note.get("unit", si)
    scale = FigureScale(
        unit, si, note.get("density", "two-sided") if is_density(unit) else "two-sided"
    )
    figures = _figures(values, scale)
    if figures is None:
        scale = FigureScale(si, si)
        figures = _figures(values, scale)
    density = {"density": _text(scale.density)} if noise and is_density(scale.unit) else {}
    return {"value": figures, "unit": _text(scale.unit), **density}


def _figures(values: np.ndarray, scale: FigureScale) -> str | None:
    """The shortest decimals whose SI values are exactly ``values``, None where there are none."""
    texts = [
        _shortest(v, g, scale.to_si)
        for v, g in zip(values.ravel(), np.ravel(scale.guess(values)), strict=True)
    ]
    return None if None in texts else nested(texts, values.shape)


def _shortest(value: float, guess: float, to_si: Callable[[float], np.ndarray]) -> str | None:
    for digits in range(1, 18):
        text = repr(float(f"{guess:.{digits}g}"))
        if to_si(float(text)) == value:
            return text
    # Rounding twice, there and back, can miss by a few units in the last place.
    for direction in (-math.inf, math.inf):
        near = guess
        for _ in range(4):
            near = math.nextafter(near, direction)
            if to_si(near) == value:
                return repr(float(near))
    return None


def _texts(note: Mapping[str, str], keys: tuple[str, ...]) -> dict[str, str]:
    return {k: _text(note[k]) for k in keys if note.get(k)}


def _table(entries: Mapping[str, str]) -> str:
    return "{" + ", ".join(f"{k} = {v}" for k, v in entries.items()) + "}"


def _text(text: str) -> str:
    # A JSON string is a TOML basic string but for the delete character, which TOML wants escaped.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
