"""Raw counts of a converter: their size in a column map, and columns that look like counts."""

from __future__ import annotations

import math
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from pyimu import units
from pyimu.errors import Finding, UserError
from pyimu.recording.columns import (
    ELSE,
    GROUP_OF,
    GROUPS,
    UNITS,
    check_unit,
    column_names,
)

LEAST_ROWS = 100
"""Fewer whole numbers in a column are no sign of counts."""

COARSEST = {"gyro": 0.01, "accel": 0.5}
"""rad/s and m/s^2; no such sensor of sixteen, twelve or ten bits resolves as little, so a column of
whole multiples holds counts."""

LARGEST = {"gyro": 400.0, "accel": 2e5}
"""rad/s and m/s^2, above the range of any such sensor on the market (spin of shells, shock of
impacts)."""


LSB = units.BASES.index("LSB")
"""The count's place in a unit's dimension."""


@dataclass(frozen=True)
class Scale:
    """One count is ``value`` in ``unit``, and a count of zero is ``offset`` in it."""

    value: float
    unit: units.Unit
    offset: float = 0.0


def read_scales(path: Path, table: Any) -> Mapping[str, Scale]:
    """The scales in the table ``scale`` of a column map, by column name.

    An entry is ``gyro = {value = 0.07, unit = "deg/s"}``, or for ``gyro_x`` alone; as data sheets
    have it ``{value = 8.75, unit = "mdps/LSB"}`` or ``{value = 131, unit = "LSB/(deg/s)"}``, too.

    Raises UserError, with the key, for an unknown name, a missing or wrong unit and what is no
    number.
    """
    if not isinstance(table, dict):
        raise UserError(f"{path}: key scale must be a table")
    names = {"time": ("time",)} | {group: column_names(group) for group in GROUPS}
    names |= {name: (name,) for group in GROUPS for name in column_names(group)}
    names |= {name: (name,) for ways in ELSE.values() for way in ways for name in way}
    for key in table:
        if key not in names:
            raise UserError(
                f"{path}: unknown key scale.{key}{units.did_you_mean(key, names)}; write a group "
                "or a column, as gyro or gyro_x"
            )
    scales: dict[str, Scale] = {}
    for key in sorted(
        table, key=lambda key: -len(names[key])
    ):  # a column's own entry wins over its group's
        scales |= {name: _scale(path, f"scale.{key}", name, table[key]) for name in names[key]}
    return scales


def _scale(path: Path, key: str, name: str, entry: Any) -> Scale:
    if not isinstance(entry, dict) or not {"value", "unit"} <= set(entry) <= {
        "value",
        "unit",
        "offset",
    }:
        raise UserError(
            f'{path}: key {key} must be such as {{value = 0.07, unit = "deg/s"}} or {{value = 131, '
            'unit = "LSB/(deg/s)"}, with an offset if there is one'
        )
    value, offset = (
        finite_number(path, f"{key}.value", entry["value"]),
        finite_number(path, f"{key}.offset", entry.get("offset", 0.0)),
    )
    if value == 0 or (name == "time" and offset):
        raise UserError(
            f"{path}: key {key}: "
            + (
                "a count cannot be of size 0"
                if value == 0
                else "a time needs no offset, its origin is free"
            )
        )
    return _of_unit(f"{path}: key {key}.unit", name, value, offset, entry["unit"])


def _of_unit(place: str, name: str, value: float, offset: float, text: Any) -> Scale:
    """The scale in the unit ``text``: of a count, a unit per LSB, or LSB per unit.

    One that has LSB in it is brought to SI. Raises UnitError that begins with ``place``.
    """
    try:
        unit = units.parse(text)
    except units.UnitError as error:
        raise units.UnitError(f"{place}: {error}") from None
    power = unit.dimension[LSB]
    if abs(power) != 1:
        return Scale(value, check_unit(place, name, text), offset)
    per_count = tuple(0 if k == LSB else -power * e for k, e in enumerate(unit.dimension))
    right = units.parse(UNITS[name])
    if per_count != right.dimension:
        raise units.UnitError(
            f"{place} cannot be in '{unit}', expected a unit like '{right}' or 'LSB/({right})'"
        )
    if power < 0:
        return Scale(value * unit.factor, right, offset * unit.factor)
    if offset:
        raise units.UnitError(
            f"{place}: an offset cannot be in '{unit}': say the size of a count in '{right}' too"
        )
    return Scale(1 / (value * unit.factor), right)


def finite_number(path: Path, key: str, value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise UserError(f"{path}: key {key} must be a number, not {str(value)[:40]!r}")
    if not abs(value) <= sys.float_info.max:
        raise UserError(f"{path}: key {key} must be a finite number")
    return float(value)


class RawCounts:
    """Detects gyro and accelerometer columns of raw counts whose header claims another unit.

    Such a column has whole numbers only, of a step or a size that no sensor has.
    """

    def __init__(self, names: Sequence[str], found: Sequence[units.Unit]) -> None:
        self._rows = 0
        self._ranges = {
            name: (math.inf, -math.inf, unit)
            for name, unit in zip(names, found)
            if GROUP_OF[name] in COARSEST
        }

    def add(self, columns: Mapping[str, np.ndarray]) -> None:
        self._rows += len(next(iter(columns.values())))
        for name in list(self._ranges):
            values = columns[name][np.isfinite(columns[name])]
            if not _whole(values[:LEAST_ROWS]) or not _whole(values):
                del self._ranges[name]
            elif len(values):
                low, high, unit = self._ranges[name]
                self._ranges[name] = (min(low, values.min()), max(high, values.max()), unit)

    def findings(self) -> list[Finding]:
        return [
            Finding(
                "counts",
                name,
                self._rows,
                {
                    "unit": str(unit),
                    "least": float(low) * unit.factor,
                    "largest": float(high) * unit.factor,
                },
            )
            for name, (low, high, unit) in self._ranges.items()
            if self._rows >= LEAST_ROWS
            and low < high
            and (
                unit.factor >= COARSEST[GROUP_OF[name]]
                or max(-low, high) * unit.factor > LARGEST[GROUP_OF[name]]
            )
        ]


def _whole(values: np.ndarray) -> bool:
    """Whether all are whole numbers."""
    return bool(np.all(values == np.rint(values)))
