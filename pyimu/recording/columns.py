"""The columns that a recording can hold: their names, groups and SI units."""

from __future__ import annotations

from collections.abc import Container, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from pyimu import units

XYZ = ("x", "y", "z")


@dataclass(frozen=True)
class Group:
    """A group of columns, one for each of its suffixes, or a single column that has none.

    A group that is the truth of a signal names it, and the value (size,) that the signal has where
    nobody sets it; ``surrounding`` says that the signal is neither the body's motion nor its place.
    """

    unit: str
    text: str
    suffixes: tuple[str, ...] = ()
    signal: str = ""
    start: tuple[float, ...] = ()
    surrounding: bool = False


def _truth(signal: str, start: tuple[float, ...], unit: str, text: str, *suffixes: str) -> Group:
    return Group(unit, text, suffixes, signal, start)


def _surrounding(signal: str, start: tuple[float, ...], unit: str, text: str, *suffixes) -> Group:
    return Group(unit, text, suffixes, signal, start, surrounding=True)


ZERO = (0.0, 0.0, 0.0)

GROUPS: Mapping[str, Group] = MappingProxyType(
    {
        "gyro": Group("rad/s", "measured rate against inertial space, body axes", XYZ),
        "accel": Group("m/s^2", "measured specific force, body axes", XYZ),
        "ref_rate": _truth(
            "rate", ZERO, "rad/s", "angular rate against inertial space, body axes", *XYZ
        ),
        "ref_force": _truth(
            "specific_force",
            (0.0, 0.0, units.STANDARD_GRAVITY),
            "m/s^2",
            "specific force, body axes",
            *XYZ,
        ),
        "temperature": _surrounding("temperature", (25.0,), "degC", "temperature of the part"),
        "supply": _surrounding("supply", (3.3,), "V", "supply voltage"),
        "mag": _surrounding("mag", ZERO, "T", "magnetic flux density, body axes", *XYZ),
        "ref_q": _truth(
            "attitude",
            (1.0, 0.0, 0.0, 0.0),
            "1",
            "attitude, body to world (east-north-up), Hamilton, scalar first",
            *("w", *XYZ),
        ),
        "latitude": _truth("latitude", (0.0,), "rad", "geographic latitude"),
        "ref_velocity": _truth(
            "velocity",
            ZERO,
            "m/s",
            "velocity over the ground, east-north-up",
            *("east", "north", "up"),
        ),
        "ref_heading": Group("rad", "true heading, counter-clockwise from east"),
        "ref_north": Group("m", "true position to the north"),
        "ref_east": Group("m", "true position to the east"),
        "ref_up": Group("m", "true position above"),
        "moving": Group("1", "mark of rows in motion"),
        "stationary": Group("1", "mark of rows at rest"),
        "heading": Group("rad", "measured heading, counter-clockwise from east"),
        "heading_std": Group("rad", "standard deviation of the measured heading"),
        "heading_age": Group("s", "time since the measured heading was true"),
        "speed": Group("m/s", "measured speed over the ground along the body's x axis"),
        "speed_std": Group("m/s", "standard deviation of the measured speed"),
        "position_north": Group("m", "measured position to the north, such as a GNSS receiver's"),
        "position_east": Group("m", "measured position to the east"),
        "position_up": Group("m", "measured position above"),
        "position_std": Group("m", "standard deviation of the measured position, per axis"),
        "position_age": Group("s", "time since the measured position was true"),
        "velocity_north": Group("m/s", "measured velocity to the north"),
        "velocity_east": Group("m/s", "measured velocity to the east"),
        "velocity_up": Group("m/s", "measured velocity upwards"),
        "velocity_std": Group("m/s", "standard deviation of the measured velocity, per axis"),
        "velocity_age": Group("s", "time since the measured velocity was true"),
    }
)
"""What a recording can hold beside its time, by name. The signals on which a sensor's errors may
depend are those that groups are the truth of, in this order, and what follows from them
(``pyimu.model.signals``)."""

MARKS = ("moving", "stationary")
"""Groups that mark rows: 1 is yes, 0 is no, and NaN is not known."""


def column_names(group: str) -> tuple[str, ...]:
    """Names of the columns of a group, without unit: ``("gyro_x", "gyro_y", "gyro_z")``."""
    return tuple(f"{group}_{suffix}" for suffix in GROUPS[group].suffixes) or (group,)


ANGLES = ("ref_roll", "ref_pitch", "ref_yaw")
"""Columns in which a file may have ``ref_q``: Rz(yaw) Ry(pitch) Rx(roll), body to world, in the
file's own axes."""

FIXES = {stem: (f"{stem}_latitude", f"{stem}_longitude") for stem in ("ref", "position")}
"""Columns in which a file may have places north and east, as receivers write them."""

ELSE: Mapping[str, tuple[tuple[str, ...], ...]] = MappingProxyType(
    {"ref_q": (ANGLES,), "latitude": tuple((fix[0],) for fix in FIXES.values())}
    | {f"{stem}_{way}": (fix,) for stem, fix in FIXES.items() for way in ("north", "east")}
)
"""Columns from which a group is made where a file has none of its own."""

DOWNWARD = {f"{stem}_down": f"{stem}_up" for stem in ("ref", "ref_velocity", "position")} | {
    "velocity_down": "velocity_up"
}
"""Columns that count downward, and those which they become with the other sign."""

GROUP_OF = {name: group for group in GROUPS for name in column_names(group)} | {"time": "time"}
"""The group of each column: ``"gyro"`` of ``"gyro_x"``."""

UNITS = {name: GROUPS[group].unit for name, group in GROUP_OF.items() if group != "time"}
UNITS |= {name: UNITS[up] for name, up in DOWNWARD.items()} | dict.fromkeys(ANGLES, "rad")
UNITS |= {name: "rad" for fix in FIXES.values() for name in fix}
UNITS["time"] = "s"

GROUP_OF |= {name: GROUP_OF[up] for name, up in DOWNWARD.items()} | dict.fromkeys(ANGLES, "ref_q")
GROUP_OF |= {
    name: f"{stem}_{way}"
    for stem, fix in FIXES.items()
    for way, name in zip(("north", "east"), fix, strict=True)
}


def written_as(group: str, names: Container[str]) -> tuple[str, ...]:
    """The columns in which a file that has the columns ``names`` holds a group: of an attitude its
    angles, where it is not there as a quaternion, of a place latitude and longitude.
    """
    ways = (column_names(group), *ELSE.get(group, ()))
    return next((way for way in ways if any(name in names for name in way)), ways[0])


def own_name(cell: str) -> str | None:
    """The name of a recording's column in a header's ``cell`` that has one with a unit."""
    name, bracket, _ = cell.partition("[")
    return name.strip() if bracket and name.strip() in UNITS else None


BY_QUANTITY = {
    "T": {"G": "gauss", "Gs": "gauss", "mG": "mgauss", "mGs": "mgauss", "uG": "ugauss"},
    "m/s^2": {"G": "g", "Gs": "g", "mG": "mg", "mGs": "mg", "uG": "ug"},
}
"""Spellings that are another unit in a column of another quantity, by the quantity's SI unit."""


def check_unit(place: str, name: str, text: Any) -> units.Unit:
    """The unit ``text`` of the column ``name``.

    Raises UnitError that begins with ``place`` where it is none, or does not fit.
    """
    right = UNITS[name]
    text = BY_QUANTITY.get(right, {}).get(text.strip(), text) if isinstance(text, str) else text
    try:
        unit = units.parse(text, right)
    except units.UnitError as error:
        raise units.UnitError(f"{place}: {error}") from None
    fits = unit.plain in units.FREEZING if right == "degC" else units.same_dimension(unit, right)
    if not fits:
        raise units.UnitError(f"{place} cannot be in '{unit}', expected a unit like '{right}'")
    return unit
