"""The columns that a recording can hold: their names, groups and SI units."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from pyimu import units

XYZ = ("x", "y", "z")


GROUPS: Mapping[str, tuple[tuple[str, ...], str]] = MappingProxyType(
    {
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
    }
)
"""What a recording can hold: group name to (column suffixes, SI unit). A group without suffixes is
one column."""


def column_names(group: str) -> tuple[str, ...]:
    """Names of the columns of a group, without unit: ``("gyro_x", "gyro_y", "gyro_z")``."""
    suffixes, _ = GROUPS[group]
    return tuple(f"{group}_{suffix}" for suffix in suffixes) or (group,)


_GROUP = {name: group for group in GROUPS for name in column_names(group)} | {"time": "time"}


UNITS = {
    "time": "s",
    **{name: GROUPS[group][1] for name, group in _GROUP.items() if group in GROUPS},
}


def group_of(name: str) -> str:
    """The group of a column: ``"gyro"`` for ``"gyro_x"``."""
    return _GROUP[name]


def check_unit(place: str, name: str, text: Any) -> units.Unit:
    """The unit ``text`` of the column ``name``. Raises UnitError that begins with ``place`` where
    it is none, or does not fit.
    """
    try:
        unit = units.parse(text)
    except units.UnitError as error:
        raise units.UnitError(f"{place}: {error}") from None
    right = UNITS[name]
    fits = unit.text in ("K", "degC") if right == "degC" else units.same_dimension(unit, right)
    if not fits:
        raise units.UnitError(f"{place} cannot be in '{unit}', expected a unit like '{right}'")
    return unit
