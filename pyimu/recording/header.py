"""The header of a file: its columns that have a meaning, and their units."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

import numpy as np

from pyimu import units
from pyimu.errors import Finding, UserError
from pyimu.recording.columns import (
    ANGLES,
    DOWNWARD,
    GROUP_OF,
    GROUPS,
    UNITS,
    check_unit,
    column_names,
    written_as,
)
from pyimu.recording.counts import Scale
from pyimu.recording.formats.mixed_rows import OF_OTHERS

LARGEST = 1e12
"""In SI; no quantity of a log is larger, and such a number is taken for a missing one."""

ORIGIN = 1e6
"""s; a first time beyond it is a clock of its own (Unix time), and is subtracted."""


COUNT = ("count", "counts", "lsb", "raw", "digit", "digits", "adc")
"""Spellings of the unit of a converter's raw numbers, whose size a column map must give."""

OFTEN = {"s": "s, ms, us or ns", "rad/s": "rad/s or deg/s", "m/s^2": "m/s^2, g or mg"} | {
    "T": "T, uT or gauss"
}
"""Units in which columns often are, by the SI unit: a hint names all of them, and proposes none."""


class Header:
    """The columns of a file that have a meaning.

    ``names`` are without unit, ``positions`` count the file's columns, ``units`` are the stated
    ones.

    ``scale`` gives the size of a count by column; a ``crowded`` file holds much that is not looked
    at, and ``skipped`` says what in it has no columns of numbers. Raises UserError for a column
    that stands twice, has no, an unknown or the wrong unit, is in counts of unknown size, or has a
    name close to a known one; for an incomplete group, no time, and a log that does not hold what
    is ``wanted``: a "sensor" (gyro or accelerometer), a "reference", or "any" column. A column
    with another name is left out, and listed in ``findings``; ``cells`` are the file's own names.
    Of what is ``in_memory`` no hint names a command.
    """

    def __init__(
        self,
        path: Path,
        header: Sequence[str],
        scale: Mapping[str, Scale] = MappingProxyType({}),
        crowded: bool = False,
        skipped: Sequence[str] = (),
        wanted: str = "sensor",
        cells: Sequence[str] = (),
        in_memory: bool = False,
    ) -> None:
        self.path = path
        self.names: list[str] = []
        self.positions: list[int] = []
        self.units: list[units.Unit] = []
        self.findings: list[Finding] = []
        self._crowded = crowded
        self._skipped = skipped
        self._wanted = wanted
        self._cells = list(cells or header)
        self._in_memory = in_memory
        self._scale = scale
        self._counted: set[str] = set()
        self._downward: set[str] = set()
        self._given = {
            name.strip() for name, bracket, _ in (h.partition("[") for h in header) if bracket
        }
        self._stated = {c.partition("[")[0].strip() for c in self._cells if "[" in c}
        self._mapped = {
            new.partition("[")[0].strip()
            for new, old in zip(header, self._cells, strict=False)
            if new != old
        }
        foreign = bool(self._given - self._stated)
        said = (c.partition("[")[0].strip() for c in self._cells)
        self._ours = not foreign and any(name in UNITS for name in said)
        for position, cell in enumerate(header):
            self._add(position, cell)
        self._check()

    @property
    def time(self) -> int:
        """The position of the time in the file."""
        return self.positions[self.names.index("time")]

    @property
    def stated(self) -> list[str]:
        """The columns whose unit the file states, those not in counts."""
        return [name for name in self.names if name not in self._counted]

    @property
    def groups(self) -> tuple[str, ...]:
        return tuple(group for group in GROUPS if self.written_as(group)[0] in self.names)

    def written_as(self, group: str) -> tuple[str, ...]:
        """The columns in which the file holds a group: an attitude may be there as angles."""
        return written_as(group, self.names)

    @property
    def group_units(self) -> dict[str, str]:
        """The stated unit of each group, of its first column; none of a group in counts."""
        found = dict(zip(self.names, self.units, strict=True))
        firsts = {group: self.written_as(group)[0] for group in self.groups}
        return {g: found[n].plain for g, n in firsts.items() if n not in self._counted}

    def _add(self, position: int, cell: str) -> None:
        name, _, rest = cell.partition("[")
        name, unit = name.strip(), rest.strip()
        if (
            name not in UNITS
            or self._is_replaced(position, name, cell)
            or self._is_said_otherwise(name)
        ):
            self._unknown(name, cell)
            return
        if DOWNWARD.get(name, name) in self.names:
            raise UserError(f"{self.path}: column {name} stands twice in the header")
        if not unit and UNITS[name] == "1":
            unit = "1]"
        if not unit.endswith("]"):
            look = f"; pyimu inspect {self.path} looks which one the numbers fit"
            raise UserError(
                f"{self.path}: column {name} has no unit, write '{name} [...]' with its own "
                f"({OFTEN.get(UNITS[name], UNITS[name])})",
                "" if self._in_memory else look,
            )
        if name in DOWNWARD:
            name = DOWNWARD[name]
            self._downward.add(name)
        self.names.append(name)
        self.positions.append(position)
        self.units.append(self._unit(name, unit[:-1]))

    def _is_replaced(self, position: int, name: str, cell: str) -> bool:
        """Whether a map gives a column's own name to another one, or the name says no unit, and the
        map what the sensor's columns are without it: a magnetometer's, whose unit nobody knows, a
        temperature's.
        """
        own = position < len(self._cells) and self._cells[position] == cell
        if own and name in self._mapped:
            return True
        if not own or cell.strip() != name:
            return False
        mapped = {name for name in self._given if name not in self._stated}
        needed = name == "time" or GROUP_OF[name] in ("gyro", "accel")
        return name in self._given or (not needed and bool(mapped))

    def _is_said_otherwise(self, name: str) -> bool:
        """Whether a height counts upward in another column, or an attitude is a quaternion there,
        so that one of the two is enough.
        """
        if name in ANGLES:
            return any(column in self._given for column in column_names("ref_q"))
        return DOWNWARD.get(name) in self._given

    def _unit(self, name: str, text: str) -> units.Unit:
        if text.strip().casefold() in COUNT:
            self._counted.add(name)
            return self._size(name)
        unit = check_unit(f"{self.path}: column {name}", name, text)
        if name in self._scale:
            raise UserError(
                f"{self.path}: column {name} is in '{unit}', but [scale] in the column map is for "
                "columns in counts; "
                f"write '{name} [count]', or leave its scale out"
            )
        return unit

    def _size(self, name: str) -> units.Unit:
        if name not in self._scale:
            group = GROUP_OF[name]
            raise UserError(
                f"{self.path}: column {name} is in counts, and nobody said how large one is; say "
                "it in a column map (TOML) "
                f'as [scale] {group} = {{value = ..., unit = "{UNITS[name]}"}}'
            )
        return self._scale[name].unit

    def _unknown(self, name: str, cell: str) -> None:
        if self._crowded or cell.endswith(OF_OTHERS):
            return
        others = [own for own in UNITS if own not in self._given]  # accel2_x beside accel_x
        near = name not in UNITS and units.did_you_mean(name, others, cutoff=0.8)
        if near and (self._ours or cell not in self._cells):
            raise UserError(f"{self.path}: unknown column '{name}'{near}")
        self.findings.append(Finding("unused_column", name, 1, {"header": cell}))

    def _check(self) -> None:
        if "time" not in self.names:
            if self._crowded and {"gyro_x", "accel_x"} & set(self.names):
                raise UserError(
                    f"{self.path}: nothing tells when its samples were taken; say the rate in a "
                    'column map (TOML): sample_rate = {value = ..., unit = "Hz"}, alone in it',
                    "" if self._in_memory else ", and give that as --columns",
                )
            raise UserError(
                f"{self.path}: not a recording, the header has no 'time [s]' column{self._way()}",
                self._inspected(),
            )
        for group in GROUPS:
            needed = self.written_as(group)
            missing = [name for name in needed if name not in self.names]
            if missing and len(missing) < len(needed):
                raise UserError(
                    f"{self.path}: column {missing[0]} is missing, {group} needs "
                    f"{', '.join(needed)}"
                    + ("; a yaw alone is ref_heading" if needed == ANGLES else "")
                )
        if self._wanted == "reference" and not any(name.startswith("ref_") for name in self.names):
            raise UserError(
                f"{self.path}: no reference in it; it needs ref_q (or ref_roll, ref_pitch and "
                "ref_yaw), ref_rate, ref_heading, ref_north and ref_east (or ref_latitude and "
                "ref_longitude), ref_velocity or ref_force, or a column map (TOML) that names them"
                f"; pyimu inspect {self.path} looks for them"
            )
        if self._wanted == "sensor" and "gyro_x" not in self.names and "accel_x" not in self.names:
            truth = any(name.startswith("ref_") for name in self.names)
            beside = "; the reference in it goes beside a sensor's log, as --reference"
            raise UserError(
                f"{self.path}: neither gyro_x, gyro_y, gyro_z nor accel_x, accel_y, accel_z is "
                f"there{beside if truth else ''}{self._way()}",
                self._inspected(),
            )

    def _way(self) -> str:
        """How to read the file all the same."""
        skipped = (
            f"; without columns of numbers are {some_of(self._skipped)}" if self._skipped else ""
        )
        if not any(cell.strip("/[] ") for cell in self._cells):
            return skipped
        if self._in_memory:
            return (
                f"; it has {some_of(self._cells)}; name them by Recording.from_frame(frame, "
                "columns={'t': 'time [s]', 'gx': 'gyro_x [deg/s]', ...})"
            )
        return f"; it has {some_of(self._cells)}{skipped}; name its columns in a column map (TOML)"

    def _inspected(self) -> str:
        """The command that writes the map."""
        if self._in_memory or not any(cell.strip("/[] ") for cell in self._cells):
            return ""
        option = "--reference-columns" if self._wanted == "reference" else "--columns"
        return (
            f" and give that as {option}: pyimu inspect {self.path} --write-map map.toml writes "
            "one to look over"
        )

    def origin(self, first: float | np.integer, findings: list[Finding]) -> float | np.integer:
        """What to subtract from the file's times, in its unit.

        It is the ``first`` time where that is on a clock of its own (Unix time), else 0.
        """
        seconds = float(first) * self.seconds
        if not ORIGIN < abs(seconds) < np.inf:
            return 0
        findings.append(Finding("time_origin", "time", 1, {"origin": seconds}))
        return first

    def convert(
        self, columns: Sequence[np.ndarray], origin: float | np.integer
    ) -> dict[str, np.ndarray]:
        """The columns (n,) in SI by name; infinite and absurd values become missing ones.

        ``origin`` is subtracted from the time in the file's unit, so that an integer clock is not
        rounded.
        """
        return {
            name: _within((column - origin) * self.seconds)
            if name == "time"
            else self._si(name, column, unit)
            for name, column, unit in zip(self.names, columns, self.units)
        }

    @property
    def seconds(self) -> float:
        """s in one of the file's units of time."""
        factor = self.units[self.names.index("time")].factor
        return factor * self._scale["time"].value if "time" in self._counted else factor

    def _si(self, name: str, column: np.ndarray, unit: units.Unit) -> np.ndarray:
        if name in self._counted:
            column = column * self._scale[name].value + self._scale[name].offset
        values = (
            units.to_degc(column, unit)
            if UNITS[name] == "degC"
            else units.convert(column, unit, UNITS[name])
        )
        values = -values if name in self._downward else values
        with np.errstate(invalid="ignore"):
            return np.where(np.abs(values) <= LARGEST, values, np.nan)


def _within(time: np.ndarray) -> np.ndarray:
    return np.where(np.abs(time) <= LARGEST, time, np.nan)


def some_of(names: Sequence[str], most: int = 8) -> str:
    """The first of ``names``, for a message."""
    return (", ".join(names[:most]) or "none of numbers") + (
        f" and {len(names) - most} more" if len(names) > most else ""
    )
