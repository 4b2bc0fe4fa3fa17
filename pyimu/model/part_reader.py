"""The text of a part file read to a part."""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from pyimu import units
from pyimu.errors import UserError, printable
from pyimu.files import parse_toml, shortened
from pyimu.model.arguments import Parameter
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.effect import Effect
from pyimu.model.kinds import KINDS, TRIADS
from pyimu.model.part import Part
from pyimu.model.part_entry import (
    DENSITIES,
    ESTIMATE,
    NOTE_KEYS,
    RATE_KEY,
    TOLERANCE,
    FigureScale,
    Key,
    format_array,
    is_density,
)
from pyimu.model.sensor import Sensor
from pyimu.model.sheet_names import SHEET_NAMES
from pyimu.model.tolerance import DISTRIBUTIONS, Tolerance

_TOP_KEYS = ("name", "description", "sample_rate", *TRIADS, TOLERANCE)


_ENTRY_KEYS = ("value", "start", *NOTE_KEYS)

_TOLERANCE_KEYS = ("value", "unit", "distribution", "source", "quoted")

_TEXTS = ("unit", "source", "quoted")
"""What of a tolerance is text and no choice."""

_BREAKS = re.compile(r"[\r\n\t\xa0]+")
"""Where a text of several lines is joined."""

_LONGEST_NAME = 200
"""Characters of a part's name: it becomes the name of files and classes, and stands in tables."""


def parse_part(text: str, file: str = "part") -> Part:
    """The part that TOML ``text`` describes; ``file`` is what errors call it. Raises UserError."""
    return part_of(parse_toml(text, file), file)


def part_of(data: Mapping[str, Any], file: str) -> Part:
    """The part that a TOML file's ``data`` are. Raises UserError."""
    try:
        return _Reader(file).part(data)
    except RecursionError:
        raise UserError(f"{file}: lists in lists, nested too deeply") from None


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
        sensors = {kind: self._sensor(kind, data.get(kind, {})) for kind in TRIADS}
        name, rate, description = (
            self._name(data),
            self._sample_rate(data),
            self._optional_text("", data, "description"),
        )
        tolerances = self._tolerances(data.get(TOLERANCE, {}))
        try:
            return Part(
                name,
                rate,
                **sensors,
                estimate=frozenset(self.estimate),
                notes=self.notes,
                description=description,
                tolerances=tolerances,
            )
        except UserError as error:  # what only the whole part shows
            raise UserError(f"{self.file}: {error}") from None

    def _known(self, where: str, table: Mapping[str, Any], known: tuple[str, ...]) -> None:
        for key in table:
            if key not in known:
                raise self.error(f"{where}{key}", f"unknown key; {meant(key, known)}")

    def _name(self, data: Mapping[str, Any]) -> str:
        text = self._text("", data, "name")
        self._shown("name", text)
        if not text:
            raise self.error("name", 'is missing, write name = "imt30"')
        if len(text) > _LONGEST_NAME:
            raise self.error("name", f"has {len(text)} characters, may have {_LONGEST_NAME}")
        return text

    def _text(self, where: str, table: Mapping[str, Any], key: str) -> str:
        text = table.get(key, "")
        if not isinstance(text, str):
            raise self.error(f"{where}{key}", f"must be text, not {text!r}")
        return text

    def _optional_text(self, where: str, table: Mapping[str, Any], key: str) -> str:
        """A text, its lines joined to one."""
        text = _BREAKS.sub(" ", self._text(where, table, key))
        self._shown(f"{where}{key}", text)
        return text

    def _shown(self, where: str, text: str) -> None:
        """Raise UserError where a terminal would obey a character of ``text``, or hide it.

        Texts stand in tables, in comments of one line and in XML, which has no such characters.
        """
        for c in text:
            if printable(c) != c:
                reason = f"{text!r:.60} has a character that no terminal shows (U+{ord(c):04X})"
                raise self.error(where, reason + "; write one line of plain text")

    def _sample_rate(self, data: Mapping[str, Any]) -> float:
        entry = data.get("sample_rate")
        if not isinstance(entry, dict):
            found = "is missing" if entry is None else f"{entry!r} has no unit"
            raise self.error(
                "sample_rate", f'{found}, write sample_rate = {{value = 100.0, unit = "Hz"}}'
            )
        self._known("sample_rate.", entry, ("value", "unit", "source"))
        scale = self._scale("sample_rate", entry, "Hz", False)
        value = scale.to_si(self._numbers("sample_rate", entry, Parameter("Hz", ())))
        if value <= 0:
            raise self.error("sample_rate", f"must be above 0, not {value:g} Hz")
        self.notes[RATE_KEY] = {
            k: self._optional_text("sample_rate.", entry, k)
            for k in ("unit", "source")
            if k in entry
        }
        return float(value)

    def _sensor(self, kind: str, tables: Any) -> Sensor:
        if not isinstance(tables, dict):
            raise self.error(
                kind, f"must be a table with one table per effect, such as [{kind}.turn_on_bias]"
            )
        values = {}
        for name, table in tables.items():
            e = self._effect(f"{kind}.{name}", kind, name)
            values[name] = self._parameters(kind, e, table)
        return Sensor(kind, values)

    def _effect(self, where: str, kind: str, name: str) -> Effect:
        e = CATALOGUE.get(name)
        if e is None:
            called = SHEET_NAMES.get(str(name).lower())
            hint = f"it is called {called} here" if called else meant(name, CATALOGUE)
            raise self.error(where, f"unknown effect; {hint}")
        if kind not in e.triads:
            raise self.error(where, f"is an effect of {' and '.join(e.triads)}, not of {kind}")
        return e

    def _parameters(self, kind: str, e: Effect, table: Any) -> dict[str, np.ndarray]:
        where = f"{kind}.{e.name}"
        if table == ESTIMATE:
            self.estimate |= {(kind, e.name, n) for n, q in e.parameters.items() if not q.reference}
            return {}
        if not isinstance(table, dict) or not table:
            raise self.error(
                where,
                f'must be "{ESTIMATE}" or a table with {", ".join(e.parameters)}, not {table!r}',
            )
        self._known_parameters(where, e, table)
        return {
            name: self._value((kind, e.name, name), e.parameters[name], entry)
            for name, entry in table.items()
        }

    def _known_parameters(self, where: str, e: Effect, table: Mapping[str, Any]) -> None:
        for name in table:
            if name not in e.parameters:
                raise self.error(
                    f"{where}.{name}", f"unknown parameter; {meant(name, e.parameters)}"
                )

    def _value(self, key: Key, q: Parameter, entry: Any) -> np.ndarray:
        """The value of one entry in SI, shape ``q.shape``."""
        where = ".".join(key)
        if not isinstance(entry, dict):
            entry = {"value": entry}
        self._known(f"{where}.", entry, _ENTRY_KEYS)
        self.notes[key] = {
            k: self._optional_text(f"{where}.", entry, k) for k in NOTE_KEYS if k in entry
        }
        if entry.get("value") == ESTIMATE:
            return self._estimated(key, q, entry)
        if "start" in entry:
            raise self.error(f"{where}.start", f'goes only with value = "{ESTIMATE}"')
        return self._in_si(key, q, entry)

    def _estimated(self, key: Key, q: Parameter, entry: dict[str, Any]) -> np.ndarray:
        if q.reference:
            raise self.error(".".join(key), f'only fixes an origin and cannot be "{ESTIMATE}"')
        self.estimate.add(key)
        if "start" not in entry:
            self._scale(
                ".".join(key),
                {"unit": self._si(key, q), **entry},
                self._si(key, q),
                q.density,
            )
            return np.full(q.shape, q.start)
        return self._in_si(key, q, {**entry, "value": entry["start"]})

    def _in_si(self, key: Key, q: Parameter, entry: dict[str, Any]) -> np.ndarray:
        where = ".".join(key)
        figures = self._numbers(where, entry, q)
        otherwise = q.said == "frequency" or q.reads == "step" or _is_cross_axis(q, entry)
        scale = self._scale(where, entry, self._si(key, q), q.density, otherwise)
        if q.density and is_density(scale.unit) and "density" not in entry:
            raise self.error(
                where,
                f'{scale.unit} is the root of a density: add density = "one-sided" (as data sheets '
                'print it) or density = "two-sided"; the two differ by 1.41',
            )
        if scale.density == "one-sided" and "quoted" not in entry:
            one = np.ndim(entry["value"]) == 0
            said = f"{entry['value']:.12g}" if one else format_array(figures)
            self.notes[key]["quoted"] = f"{said} {scale.unit}, one-sided"
        values = scale.to_si(figures)
        fault = q.fault(values)
        if fault:
            raise self.error(
                where,
                f"{fault}, not {format_array(figures)}"
                + (f" {scale.unit}" if scale.unit != "1" else ""),
            )
        return values

    def _tolerances(self, kinds: Any) -> tuple[Tolerance, ...]:
        self._table(TOLERANCE, kinds, f"[{TOLERANCE}.gyro.turn_on_bias]")
        self._known(f"{TOLERANCE}.", kinds, tuple(KINDS))
        found = []
        for kind, effects in kinds.items():
            self._table(f"{TOLERANCE}.{kind}", effects, f"[{TOLERANCE}.{kind}.turn_on_bias]")
            for name, table in effects.items():
                where = f"{TOLERANCE}.{kind}.{name}"
                e = self._effect(where, kind, name)
                self._table(where, table, f"[{where}]", f" with {', '.join(e.parameters)}")
                self._known_parameters(where, e, table)
                found += [
                    self._tolerance(f"{where}.{n}", (kind, name, n), e.parameters[n], entry)
                    for n, entry in table.items()
                ]
        return tuple(found)

    def _table(self, where: str, table: Any, example: str, more: str = "") -> None:
        if not isinstance(table, dict):
            raise self.error(where, f"must be a table such as {example}{more}, not {table!r}")

    def _tolerance(self, where: str, key: Key, q: Parameter, entry: Any) -> Tolerance:
        if q.reference:
            raise self.error(where, "only fixes an origin and has no tolerance")
        self._table(where, entry, f'{{value = 1.0, unit = "{self._si(key, q)}", ... }}')
        self._known(f"{where}.", entry, _TOLERANCE_KEYS)
        distribution = entry.get("distribution")
        if not isinstance(distribution, str) or distribution not in DISTRIBUTIONS:
            fault = "is missing"
            if distribution is not None:
                near = meant(str(distribution), DISTRIBUTIONS)
                fault = f"unknown distribution {distribution!r}; {near}"
            meaning = "; ".join(f'"{name}": {text}' for name, text in DISTRIBUTIONS.items())
            raise self.error(f"{where}.distribution", f"{fault} ({meaning})")
        texts = {k: self._optional_text(f"{where}.", entry, k) for k in _TEXTS if k in entry}
        one = "value" in entry and _shape(entry["value"]) == ()
        figures = self._numbers(where, entry, replace(q, shape=()) if one else q)
        otherwise = _is_cross_axis(q, entry)
        scale = self._scale(where, entry, self._si(key, q), False, otherwise)
        sizes = np.broadcast_to(scale.to_si(figures), q.shape)
        if np.any(sizes < 0):
            raise self.error(where, f"must not be negative, not {format_array(figures)}")
        if not one and not q.diagonal and np.any(np.diag(sizes)):
            raise self.error(where, "must have zeros on its diagonal")
        return Tolerance(
            key,
            tuple(float(sizes[i]) for i in q.indices),
            distribution,
            scale.unit,
            texts.get("source", ""),
            texts.get("quoted", ""),
        )

    @staticmethod
    def _si(key: Key, q: Parameter) -> str:
        return Sensor(key[0]).unit(q.unit)

    def _scale(
        self,
        where: str,
        entry: Mapping[str, Any],
        si: str,
        with_density: bool,
        otherwise: bool = False,
    ) -> FigureScale:
        """How the figures become SI.

        ``otherwise`` allows counts (a step), Hz (a frequency) or % (a cross-axis sensitivity).
        """
        if "density" in entry and not with_density:
            raise self.error(f"{where}.density", "goes only with the root of a noise's density")
        density = entry.get("density", "two-sided")
        if density not in DENSITIES:
            raise self.error(
                f"{where}.density", f'must be "one-sided" or "two-sided", not {density!r}'
            )
        if "density" in entry and not is_density(entry.get("unit")):
            raise self.error(
                f"{where}.density",
                f"goes only with a unit per sqrt(Hz), not with {entry.get('unit')}: "
                "a random walk's figure is N itself",
            )
        if "unit" not in entry and si != "1":
            raise self.error(where, f'has no unit, write {{value = ..., unit = "{si}"}}')
        unit = entry.get("unit", "1")
        scale = FigureScale(unit, si, density)
        try:
            if otherwise and scale.says_otherwise:
                return scale
            units.to_degc(0.0, unit) if si == "degC" else units.convert(0.0, unit, si)
        except units.UnitError as error:
            raise self.error(f"{where}.unit", f"{error}; expected a unit like {si}") from None
        return scale

    def _numbers(self, where: str, entry: Mapping[str, Any], q: Parameter) -> np.ndarray:
        """The figures of an entry in the parameter's shape, finite."""
        if "value" not in entry:
            raise self.error(where, 'has no value, write {value = ..., unit = "..."}')
        flat = self._flat(where, entry["value"])
        shape = _shape(entry["value"])
        if shape == () and q.shape == (3,):
            return np.full(q.shape, flat[0])
        if shape not in (q.shape, (math.prod(q.shape),) if len(q.shape) == 2 else q.shape):
            raise self.error(
                where, f"holds {_describe_shape(shape)}, expected {_describe_shape(q.shape)}"
            )
        return np.reshape(flat, q.shape)

    def _flat(self, where: str, value: Any) -> np.ndarray:
        items = value if isinstance(value, list) else [value]
        if isinstance(value, list) and any(isinstance(i, list) for i in items):
            return np.concatenate([self._flat(where, i) for i in items]) if items else np.empty(0)
        for item in items:
            if isinstance(item, bool) or not isinstance(item, (int, float)):
                raise self.error(where, f"must be a number{_as_number(item)}")
            if not abs(item) <= sys.float_info.max:
                raise self.error(where, "must be finite")
        return np.array(items, dtype=float)


def _as_number(item: Any) -> str:
    """What ``item`` is in place of a number, and how it is written as one."""
    said = f", not {shortened(repr(item))}"
    text = item.strip().replace("−", "-").replace(",", ".") if isinstance(item, str) else ""
    return f"{said}: write {text}" if re.fullmatch(r"[-+]?\d+(?:\.\d+)?", text) else said


def _is_cross_axis(q: Parameter, entry: Mapping[str, Any]) -> bool:
    """Whether an entry is a small angle between axes in %, as data sheets print it: 1 % is 0.01."""
    return not q.diagonal and q.unit == "rad" and str(entry.get("unit")).strip() == "%"


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


def meant(name: str, names: Any) -> str:
    near = units.nearest(name, names)
    return f"did you mean {near}?" if near else f"known are {', '.join(names)}"
