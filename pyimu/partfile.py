"""Parts as data: TOML files of coefficients with their units and sources, read to SI and written back.

One table per effect, one entry per parameter::

    name = "imt30"
    sample_rate = {value = 976.0, unit = "Hz"}

    [gyro.angle_random_walk]
    N = {value = [0.208, 0.239, 0.205], unit = "deg/sqrt(h)", source = "Hidalgo 2012, table 2"}

    [accel.angle_random_walk]
    N = {value = 60.0, unit = "ug/sqrt(Hz)", density = "one-sided", source = "data sheet, table 1"}

    [gyro]
    g_sensitivity = "estimate"

A plain number stands for all three axes; a matrix is written as nested lists or row by row.  The value ``"estimate"``
leaves a coefficient to the data.  A ``density`` that is one-sided, as a data sheet's is, is divided by sqrt(2).  What
stands beside a value (unit, source, figure as quoted) is kept in ``Part.notes``.
"""

from __future__ import annotations

import json
import math
import os
import sys
import tomllib
import uuid
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

from pyimu import units
from pyimu.effect import CATALOGUE, KINDS, Effect, Parameter
from pyimu.errors import UserError
from pyimu.imu import Part
from pyimu.sensor import Sensor

ESTIMATE = "estimate"
"""The value that leaves a coefficient to the data."""

DENSITIES = {"two-sided": 1.0, "one-sided": math.sqrt(2.0)}
"""What the root of a density, one-sided or two-sided, is divided by to become the root of the two-sided one."""

RATE_KEY = ("", "", "sample_rate")
"""Where ``Part.notes`` keeps what stands beside the sample rate."""

_WITH_DENSITY = {("angle_random_walk", "N")}
_TOP_KEYS = ("name", "description", "sample_rate", *KINDS)
_NOTE_KEYS = ("unit", "density", "source", "quoted")
_ENTRY_KEYS = ("value", "start", *_NOTE_KEYS)

Key = tuple[str, str, str]


def part_names() -> tuple[str, ...]:
    """Names of the built-in parts."""
    return tuple(sorted(f.name.removesuffix(".toml") for f in files("pyimu").joinpath("parts").iterdir()
                        if f.name.endswith(".toml")))


def part(name_or_path: str | os.PathLike | Part) -> Part:
    """A built-in part by its name, or the part in a TOML file; a ``Part`` is given back as it is.

    Raises UserError where there is no such part, or the file says something that is no part.
    """
    if isinstance(name_or_path, Part):
        return name_or_path
    if not isinstance(name_or_path, (str, os.PathLike)):
        raise UserError(f"a part is a Part, the name of one or a TOML file, not {str(name_or_path)[:40]!r}")
    name, path = str(name_or_path), Path(name_or_path)
    if name in part_names():
        text = files("pyimu").joinpath("parts", f"{name}.toml").read_text(encoding="utf-8")
        return parse_part(text, f"{name}.toml")
    if path.suffix == ".toml" or path.exists():
        return load_part(path)
    raise UserError(f"{name}: no built-in part ({', '.join(part_names())}) and no TOML file; {_meant(name, part_names())}")


def load_part(path: str | os.PathLike) -> Part:
    """The part in a TOML file.  Raises UserError, with file and key, where it cannot be read or says what is no part."""
    try:
        text = Path(path).read_text(encoding="utf-8")
    except FileNotFoundError:
        raise UserError(f"{path}: no such file") from None
    except UnicodeDecodeError:
        raise UserError(f"{path}: is not text in UTF-8") from None
    except OSError as error:
        raise UserError(f"{path}: cannot be read ({error.strerror or error})") from None
    return parse_part(text, str(path))


def parse_part(text: str, file: str = "part") -> Part:
    """The part that TOML ``text`` describes; ``file`` is what errors call it.  Raises UserError."""
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise UserError(f"{file}: cannot be read as TOML: {error}") from None
    return _Reader(file).part(data)


def save_part(part: Part, path: str | os.PathLike) -> Path:
    """Write a part to a TOML file, which reads back as an equal part; the file is there as a whole or not at all.

    Each value is written in the unit in which its note quotes it, else in SI.  Raises UserError where the file cannot
    be written.
    """
    path = Path(path)
    temporary = path.with_name(f".{path.name}.{uuid.uuid4().hex}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        temporary.write_text(format_part(part), encoding="utf-8")
        os.replace(temporary, path)
    except OSError as error:
        raise UserError(f"{path}: cannot be written ({error.strerror or error})") from None
    finally:
        temporary.unlink(missing_ok=True)
    return path


def format_part(part: Part) -> str:
    """The TOML text of a part."""
    lines = [f"name = {_text(part.name)}"]
    if part.description:
        lines.append(f"description = {_text(part.description)}")
    lines.append(f"sample_rate = {_format_rate(part)}")
    for kind in KINDS:
        sensor = part.sensor(kind)
        for e in sensor.effects:
            lines += ["", f"[{kind}.{e.name}]"]
            lines += [f"{name} = {_format_entry(part, sensor, e, name)}" for name in e.parameters]
    return "\n".join(lines) + "\n"


# ---------------------------------------------------------------------------------------------------------- reading

@dataclass(frozen=True)
class _Scale:
    """How the figures of one entry become SI: a unit, the kind of density, and whether they are thermometer readings."""

    unit: str
    si: str
    density: str = "two-sided"

    def to_si(self, figures: Any) -> np.ndarray:
        if self.si == "degC":
            return np.asarray(units.to_degc(figures, self.unit))
        return np.asarray(units.convert(figures, self.unit, self.si)) / DENSITIES[self.density]

    def guess(self, values: np.ndarray) -> np.ndarray:
        """Figures whose SI values are ``values`` to within rounding."""
        if self.si == "degC":
            return values + (units.ZERO_CELSIUS if self.unit == "K" else 0.0)
        return np.asarray(units.convert(values * DENSITIES[self.density], self.si, self.unit))


@dataclass
class _Reader:
    """Reads one file; ``estimate`` and ``notes`` fill up on the way."""

    file: str
    estimate: set[Key] = field(default_factory=set)
    notes: dict[Key, dict[str, str]] = field(default_factory=dict)

    def error(self, key: str, reason: str) -> UserError:
        return UserError(f"{self.file}: {key}: {reason}")

    def part(self, data: Mapping[str, Any]) -> Part:
        self._known("", data, _TOP_KEYS)
        sensors = {kind: self._sensor(kind, data.get(kind, {})) for kind in KINDS}
        name, rate, description = self._required_text(data, "name"), self._sample_rate(data), self._optional_text("", data, "description")
        try:
            return Part(name, rate, **sensors, estimate=frozenset(self.estimate), notes=self.notes, description=description)
        except UserError as error:  # what only the whole part shows
            raise UserError(f"{self.file}: {error}") from None

    def _known(self, where: str, table: Mapping[str, Any], known: tuple[str, ...]) -> None:
        for key in table:
            if key not in known:
                raise self.error(f"{where}{key}", f"unknown key; {_meant(key, known)}")

    def _required_text(self, data: Mapping[str, Any], key: str) -> str:
        text = self._optional_text("", data, key)
        if not text:
            raise self.error(key, f"is missing, write {key} = \"imt30\"")
        return text

    def _optional_text(self, where: str, table: Mapping[str, Any], key: str) -> str:
        text = table.get(key, "")
        if not isinstance(text, str):
            raise self.error(f"{where}{key}", f"must be text, not {text!r}")
        return text

    def _sample_rate(self, data: Mapping[str, Any]) -> float:
        entry = data.get("sample_rate")
        if not isinstance(entry, dict):
            found = "is missing" if entry is None else f"{entry!r} has no unit"
            raise self.error("sample_rate", f"{found}, write sample_rate = {{value = 100.0, unit = \"Hz\"}}")
        self._known("sample_rate.", entry, ("value", "unit", "source"))
        scale = self._scale("sample_rate", entry, "Hz", False)
        value = scale.to_si(self._numbers("sample_rate", entry, Parameter("Hz", ())))
        if value <= 0:
            raise self.error("sample_rate", f"must be above 0, not {value:g} Hz")
        self.notes[RATE_KEY] = {k: self._optional_text("sample_rate.", entry, k) for k in ("unit", "source") if k in entry}
        return float(value)

    def _sensor(self, kind: str, tables: Any) -> Sensor:
        if not isinstance(tables, dict):
            raise self.error(kind, f"must be a table with one table per effect, such as [{kind}.turn_on_bias]")
        values = {}
        for name, table in tables.items():
            e = self._effect(kind, name)
            values[name] = self._parameters(kind, e, table)
        return Sensor(kind, values)

    def _effect(self, kind: str, name: str) -> Effect:
        e = CATALOGUE.get(name)
        if e is None:
            raise self.error(f"{kind}.{name}", f"unknown effect; {_meant(name, CATALOGUE)}")
        if kind not in e.sensors:
            raise self.error(f"{kind}.{name}", f"is an effect of {' and '.join(e.sensors)}, not of {kind}")
        return e

    def _parameters(self, kind: str, e: Effect, table: Any) -> dict[str, np.ndarray]:
        where = f"{kind}.{e.name}"
        if table == ESTIMATE:
            self.estimate |= {(kind, e.name, n) for n, q in e.parameters.items() if not q.reference}
            return {}
        if not isinstance(table, dict) or not table:
            raise self.error(where, f"must be \"{ESTIMATE}\" or a table with {', '.join(e.parameters)}, not {table!r}")
        for name in table:
            if name not in e.parameters:
                raise self.error(f"{where}.{name}", f"unknown parameter; {_meant(name, e.parameters)}")
        return {name: self._value((kind, e.name, name), e.parameters[name], entry) for name, entry in table.items()}

    def _value(self, key: Key, q: Parameter, entry: Any) -> np.ndarray:
        """The value of one entry in SI, shape ``q.shape``."""
        where = ".".join(key)
        if not isinstance(entry, dict):
            entry = {"value": entry}
        self._known(f"{where}.", entry, _ENTRY_KEYS)
        self.notes[key] = {k: self._optional_text(f"{where}.", entry, k) for k in _NOTE_KEYS if k in entry}
        if entry.get("value") == ESTIMATE:
            return self._estimated(key, q, entry)
        if "start" in entry:
            raise self.error(f"{where}.start", f"goes only with value = \"{ESTIMATE}\"")
        return self._in_si(key, q, entry)

    def _estimated(self, key: Key, q: Parameter, entry: dict[str, Any]) -> np.ndarray:
        if q.reference:
            raise self.error(".".join(key), f"only fixes an origin and cannot be \"{ESTIMATE}\"")
        self.estimate.add(key)
        if "start" not in entry:
            self._scale(".".join(key), {"unit": self._si(key, q), **entry}, self._si(key, q), key[1:] in _WITH_DENSITY)
            return np.full(q.shape, q.start)
        return self._in_si(key, q, {**entry, "value": entry["start"]})

    def _in_si(self, key: Key, q: Parameter, entry: dict[str, Any]) -> np.ndarray:
        where = ".".join(key)
        figures = self._numbers(where, entry, q)
        scale = self._scale(where, entry, self._si(key, q), key[1:] in _WITH_DENSITY)
        if scale.density == "one-sided" and "quoted" not in entry:
            self.notes[key]["quoted"] = f"{_format_array(figures)} {scale.unit}, one-sided"
        values = scale.to_si(figures)
        fault = q.fault(values)
        if fault:
            raise self.error(where, f"{fault}, not {_format_array(figures)}" + (f" {scale.unit}" if scale.unit != "1" else ""))
        return values

    @staticmethod
    def _si(key: Key, q: Parameter) -> str:
        return Sensor(key[0]).unit(q.unit)

    def _scale(self, where: str, entry: Mapping[str, Any], si: str, with_density: bool) -> _Scale:
        if "density" in entry and not with_density:
            raise self.error(f"{where}.density", "goes only with angle_random_walk.N")
        density = entry.get("density", "two-sided")
        if density not in DENSITIES:
            raise self.error(f"{where}.density", f"must be \"one-sided\" or \"two-sided\", not {density!r}")
        if "density" in entry and not _is_density(entry.get("unit")):
            raise self.error(f"{where}.density", f"goes only with a unit per sqrt(Hz), not with {entry.get('unit')}: "
                             "a random walk's figure is N itself")
        if "unit" not in entry and si != "1":
            raise self.error(where, f"has no unit, write {{value = ..., unit = \"{si}\"}}")
        unit = entry.get("unit", "1")
        try:
            units.to_degc(0.0, unit) if si == "degC" else units.convert(0.0, unit, si)
        except units.UnitError as error:
            raise self.error(f"{where}.unit", f"{error}; expected a unit like {si}") from None
        return _Scale(unit, si, density)

    def _numbers(self, where: str, entry: Mapping[str, Any], q: Parameter) -> np.ndarray:
        """The figures of an entry in the parameter's shape, finite."""
        if "value" not in entry:
            raise self.error(where, "has no value, write {value = ..., unit = \"...\"}")
        flat = self._flat(where, entry["value"])
        shape = _shape(entry["value"])
        if shape == () and q.shape == (3,):
            return np.full(q.shape, flat[0])
        if shape not in (q.shape, (math.prod(q.shape),) if len(q.shape) == 2 else q.shape):
            raise self.error(where, f"holds {_describe_shape(shape)}, expected {_describe_shape(q.shape)}")
        return np.reshape(flat, q.shape)

    def _flat(self, where: str, value: Any) -> np.ndarray:
        items = value if isinstance(value, list) else [value]
        if isinstance(value, list) and any(isinstance(i, list) for i in items):
            return np.concatenate([self._flat(where, i) for i in items]) if items else np.empty(0)
        for item in items:
            if isinstance(item, bool) or not isinstance(item, (int, float)):
                raise self.error(where, f"must be a number, not {item!r}")
            if not abs(item) <= sys.float_info.max:
                raise self.error(where, "must be finite")
        return np.array(items, dtype=float)


def _is_density(unit: Any) -> bool:
    """Whether a figure in this unit is the root of a density, which can be one-sided; a random walk in deg/sqrt(h) is two-sided by definition."""
    return isinstance(unit, str) and "Hz" in unit


def _shape(value: Any) -> tuple[int, ...] | None:
    """Shape of nested lists, None where rows differ."""
    try:
        return np.shape(value)
    except ValueError:
        return None


def _describe_shape(shape: tuple[int, ...] | None) -> str:
    if shape is None:
        return "rows of unequal length"
    if len(shape) == 2:
        return f"a {shape[0]} x {shape[1]} matrix"
    return f"{math.prod(shape)} numbers" if shape else "one number"


def _meant(name: str, names: Any) -> str:
    near = units.nearest(name, names)
    return f"did you mean {near}?" if near else f"known are {', '.join(names)}"


# ---------------------------------------------------------------------------------------------------------- writing

def _format_rate(part: Part) -> str:
    note = part.notes.get(RATE_KEY, {})
    unit = note.get("unit", "Hz")
    figures = _figures(np.array(part.sample_rate), _Scale(unit, "Hz"))
    if figures is None:
        unit, figures = "Hz", repr(float(part.sample_rate))
    return _table({"value": figures, "unit": _text(unit), **_texts(note, ("source",))})


def _format_entry(part: Part, sensor: Sensor, e: Effect, name: str) -> str:
    key, q = (sensor.kind, e.name, name), e.parameters[name]
    note, values = part.notes.get(key, {}), sensor.values[e.name][name]
    entry = _with_unit(values, sensor.unit(q.unit), note)
    if key in part.estimate:
        # Where the search starts is worth a word only if it is not the identity.
        start = {"start": entry.pop("value")} if np.any(values != q.start) else {}
        entry = {"value": _text(ESTIMATE), **start, **{k: v for k, v in entry.items() if k != "value"}}
    return _table({**entry, **_texts(note, ("source", "quoted"))})


def _with_unit(values: np.ndarray, si: str, note: Mapping[str, str]) -> dict[str, str]:
    """The value of an entry with its unit: as quoted where that gives back the same SI value to the last bit."""
    unit = note.get("unit", si)
    scale = _Scale(unit, si, note.get("density", "two-sided") if _is_density(unit) else "two-sided")
    figures = _figures(values, scale)
    if figures is None:
        scale = _Scale(si, si)
        figures = _figures(values, scale)
    density = {"density": _text(scale.density)} if scale.density == "one-sided" else {}
    return {"value": figures, "unit": _text(scale.unit), **density}


def _figures(values: np.ndarray, scale: _Scale) -> str | None:
    """The shortest decimals whose SI values are exactly ``values``, or None where there are none."""
    texts = [_shortest(v, g, scale.to_si) for v, g in zip(values.ravel(), np.ravel(scale.guess(values)), strict=True)]
    return None if None in texts else _nested(texts, values.shape)


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


def _nested(texts: list[str], shape: tuple[int, ...]) -> str:
    if not shape:
        return texts[0]
    rows = np.reshape(np.array(texts, dtype=object), shape)
    return "[" + ", ".join(_nested(list(np.ravel(r)), shape[1:]) for r in rows) + "]"


def _format_array(figures: np.ndarray) -> str:
    return _nested([f"{v:.12g}" for v in np.ravel(figures)], np.shape(figures))


def _texts(note: Mapping[str, str], keys: tuple[str, ...]) -> dict[str, str]:
    return {k: _text(note[k]) for k in keys if note.get(k)}


def _table(entries: Mapping[str, str]) -> str:
    return "{" + ", ".join(f"{k} = {v}" for k, v in entries.items()) + "}"


def _text(text: str) -> str:
    # A JSON string is a TOML basic string but for the delete character, which TOML wants escaped.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
