"""The columns of a recording: their names, groups and units, and how a header cell such as ``gyro_x [deg/s]`` is read."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

import numpy as np

from pyimu import units
from pyimu.errors import Finding, UserError

ORIGIN = 1e6
"""s; a first time beyond it is a clock of its own (Unix time), and is subtracted."""

XYZ = ("x", "y", "z")

GROUPS: Mapping[str, tuple[tuple[str, ...], str]] = MappingProxyType({
    "gyro": (XYZ, "rad/s"),
    "accel": (XYZ, "m/s^2"),
    "temperature": ((), "degC"),
    "ref_rate": (XYZ, "rad/s"),
    "ref_q": (("w", *XYZ), "1"),
    "ref_heading": ((), "rad"),
    "ref_force": (XYZ, "m/s^2"),
    "ref_north": ((), "m"),
    "ref_east": ((), "m"),
    "ref_up": ((), "m"),
    "ref_velocity": (("east", "north", "up"), "m/s"),
    "moving": ((), "1"),
    "stationary": ((), "1"),
    "heading": ((), "rad"),
    "heading_std": ((), "rad"),
    "supply": ((), "V"),
    "mag": (XYZ, "T"),
    "latitude": ((), "rad"),
})
"""What a recording can hold: group name to (column suffixes, SI unit).  A group without suffixes is one column."""


def column_names(group: str) -> tuple[str, ...]:
    """Names of the columns of a group, without unit: ``("gyro_x", "gyro_y", "gyro_z")``."""
    suffixes, _ = GROUPS[group]
    return tuple(f"{group}_{suffix}" for suffix in suffixes) or (group,)


_UNITS = {"time": "s", **{name: unit for group, (_, unit) in GROUPS.items() for name in column_names(group)}}


class Header:
    """The columns of a file that have a meaning: ``names`` without unit, ``positions`` in the file, ``units``.

    Raises UserError for a column that stands twice, has no, an unknown or the wrong unit, or a name close to a known one;
    for an incomplete group, no time, and neither gyro nor accelerometer.  A column with another name is left out, and
    listed in ``findings``.
    """

    def __init__(self, path: Path, header: Sequence[str]) -> None:
        self.path = path
        self.names: list[str] = []
        self.positions: list[int] = []
        self.units: list[units.Unit] = []
        self.findings: list[Finding] = []
        for position, cell in enumerate(header):
            self._add(position, cell)
        self._check()

    def _add(self, position: int, cell: str) -> None:
        name, _, rest = cell.partition("[")
        name, unit = name.strip(), rest.strip()
        if name not in _UNITS:
            self._unknown(name, cell)
            return
        if name in self.names:
            raise UserError(f"{self.path}: column {name} stands twice in the header")
        if not unit.endswith("]"):
            raise UserError(f"{self.path}: column {name} has no unit, write '{name} [{_UNITS[name]}]'")
        self.names.append(name)
        self.positions.append(position)
        self.units.append(self._unit(name, unit[:-1]))

    def _unit(self, name: str, text: str) -> units.Unit:
        try:
            unit = units.parse(text)
        except units.UnitError as error:
            raise units.UnitError(f"{self.path}: column {name}: {error}") from None
        right = _UNITS[name]
        fits = unit.text in ("K", "degC") if right == "degC" else units.same_dimension(unit, right)
        if not fits:
            raise units.UnitError(f"{self.path}: column {name} cannot be in '{unit}', expected a unit like '{right}'")
        return unit

    def _unknown(self, name: str, cell: str) -> None:
        near = units.did_you_mean(name, _UNITS, cutoff=0.8)
        if near:
            raise UserError(f"{self.path}: unknown column '{name}'{near}")
        self.findings.append(Finding("unused_column", name, 1, {"header": cell}))

    def _check(self) -> None:
        if "time" not in self.names:
            raise UserError(f"{self.path}: not a recording, the header has no 'time [s]' column")
        for group in GROUPS:
            missing = [name for name in column_names(group) if name not in self.names]
            if missing and len(missing) < len(column_names(group)):
                raise UserError(f"{self.path}: column {missing[0]} is missing, {group} needs {', '.join(column_names(group))}")
        if "gyro_x" not in self.names and "accel_x" not in self.names:
            raise UserError(f"{self.path}: neither gyro_x, gyro_y, gyro_z nor accel_x, accel_y, accel_z is there")

    def convert(self, columns: Sequence[np.ndarray], findings: list[Finding]) -> dict[str, np.ndarray]:
        """The columns (n,) in SI by name; infinite values become missing ones, and a clock's origin is subtracted."""
        return {name: self._origin(column, unit, findings) if name == "time" else _si(name, column, unit)
                for name, column, unit in zip(self.names, columns, self.units)}

    @staticmethod
    def _origin(column: np.ndarray, unit: units.Unit, findings: list[Finding]) -> np.ndarray:
        """The time in s, less its first value where that is large; subtracted in the file's unit, without rounding."""
        origin = float(column[0]) * unit.factor if len(column) else 0.0
        if not ORIGIN < abs(origin) < np.inf:
            return column * unit.factor
        findings.append(Finding("time_origin", "time", 1, {"origin": origin}))
        return (column - column[0]) * unit.factor


def _si(name: str, column: np.ndarray, unit: units.Unit) -> np.ndarray:
    values = units.to_degc(column, unit) if _UNITS[name] == "degC" else units.convert(column, unit, _UNITS[name])
    return np.where(np.isfinite(values), values, np.nan)
