"""Drives of the unit ``RoverDrive`` run in Python: true motion as arrays and as a recording."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from pyimu.block.block import Block
from pyimu.block.parameters import with_values
from pyimu.errors import UserError
from pyimu.plant.rover_drive import end_of_drive, rover_drive
from pyimu.plant.rover_variables import DRIVES
from pyimu.recording.formats.text import CsvReader
from pyimu.recording.recording import Recording
from pyimu.units import convert, same_dimension

SAMPLE_RATE = 976.0
"""Hz; Hidalgo 2012, section 2."""

REST = 10.0
"""s of rest after a drive."""

COMMANDS = {"time": "s", "speed": "m/s", "turn_rate": "rad/s"}
"""Columns of a table of commands, and their units."""


@dataclass(frozen=True)
class Motion:
    """True motion and surroundings at n samples, the first a sample period after the start.

    ``time`` (n,) s; ``outputs`` (n, ny) of ``RoverDrive``. Each output is an attribute by its name,
    (n,) or (n, size): ``q`` (n, 4) body to east-north-up, ``rate`` rad/s against inertial space,
    ``specific_force`` m/s^2, ``position`` m, ``temperature`` degC and so on. ``parameters`` are all
    of the block's by name.
    """

    name: str
    time: np.ndarray
    outputs: np.ndarray
    columns: Mapping[str, list[int]]
    parameters: Mapping[str, float]

    def __getattr__(self, name: str) -> np.ndarray:
        columns = self.__dict__.get("columns", {}).get(name)
        if columns is None:
            raise AttributeError(f"a motion has no {name}")
        return self.outputs[:, columns[0] if len(columns) == 1 else columns]

    def recording(self, **more: Any) -> Recording:
        """The motion as the truth of a recording; ``more`` are further groups of columns.

        It has ``ref_q``, ``ref_rate``, ``ref_force``, position, temperature, latitude, ``moving``
        and, where there is a magnetic field, ``mag``.
        """
        east, north, up = self.position.T
        groups = {
            "ref_q": self.q,
            "ref_rate": self.rate,
            "ref_force": self.specific_force,
            "ref_east": east,
            "ref_north": north,
            "ref_up": up,
            "temperature": self.temperature,
            "latitude": np.full(len(self.time), self.parameters["latitude"]),
            "moving": 1.0 - self.standing,
        }
        if self.parameters["field_strength"]:
            groups["mag"] = self.mag
        return Recording.from_arrays(self.name, time=self.time, **(groups | more))


@lru_cache(maxsize=8)
def block(sample_rate: float = SAMPLE_RATE, body: str = "Earth") -> Block:
    """The block ``RoverDrive`` on a ``body``, sampled at ``sample_rate`` Hz.

    Raises UserError for an unknown body.
    """
    return rover_drive(1.0 / sample_rate, body=body)


def drive(
    name: str,
    *,
    sample_rate: float = SAMPLE_RATE,
    body: str = "Earth",
    rest: float = REST,
    **parameters: Any,
) -> Motion:
    """One of the test drives, from its start to ``rest`` s after its end.

    ``name`` is "straight", "obstacle", "ackermann" or "turn_on_spot"; ``parameters`` are of the
    unit: ``drive("obstacle", terrain=7, lever_arm=(0, 0, 0.3))``. Raises UserError for an unknown
    name, a parameter outside its bounds, and a sample rate that is none.
    """
    own = [known for known in DRIVES if known != "free"]
    if name not in own:
        raise UserError(f"drive '{name}': unknown; known are {', '.join(own)}")
    rate = _positive("sample_rate", sample_rate)
    made = block(rate, body)
    p = with_values(made, {**parameters, "drive": DRIVES[name]})
    samples = math.ceil((end_of_drive(made, p) + rest) * rate)
    return _run(made, name, p, np.zeros((samples, len(made.inputs))))


def free_drive(
    table: Path | str | np.ndarray,
    *,
    sample_rate: float = SAMPLE_RATE,
    body: str = "Earth",
    rest: float = REST,
    **parameters: Any,
) -> Motion:
    """A drive that follows a ``table`` of commands, to ``rest`` s after its last row.

    The table is a CSV file with the columns ``time [s]``, ``speed [m/s]`` and ``turn_rate
    [rad/s]``, or an array (n, 3) of the same. A command holds until the next one; before the first
    the rover stands. Raises UserError for a table that cannot be read or whose time does not
    increase, and as ``drive`` does.
    """
    rows = _table(table)
    rate = _positive("sample_rate", sample_rate)
    made = block(rate, body)
    p = with_values(made, {**parameters, "drive": DRIVES["free"]})
    begins = np.arange(math.ceil((rows[-1, 0] + rest) * rate)) / rate
    held = np.searchsorted(rows[:, 0], begins + 1e-6 / rate, side="right")
    commands = np.vstack([np.zeros((1, 2)), rows[:, 1:]])[held]
    return _run(made, "free", p, commands)


def _run(made: Block, name: str, p: np.ndarray, commands: np.ndarray) -> Motion:
    outputs, _ = made.run(commands, p=p)
    columns: dict[str, list[int]] = {}
    for i, variable in enumerate(made.outputs):
        columns.setdefault(variable.name.partition("[")[0], []).append(i)
    return Motion(
        name,
        np.arange(1, len(commands) + 1) * made.sample_period,
        outputs,
        columns,
        {v.name: float(x) for v, x in zip(made.parameters, p, strict=True)},
    )


def _positive(name: str, value: float) -> float:
    if not (isinstance(value, (int, float)) and 0 < value < math.inf):
        raise UserError(f"{name} is {str(value)[:40]}, expected a positive number of Hz")
    return float(value)


def _table(table: Path | str | np.ndarray) -> np.ndarray:
    """The commands (n, 3) in SI."""
    where = "the table of commands" if isinstance(table, np.ndarray) else str(table)
    rows = table if isinstance(table, np.ndarray) else _read(Path(table))
    if rows.ndim != 2 or rows.shape[1] != len(COMMANDS) or not len(rows):
        raise UserError(f"{where}: expected rows of {', '.join(COMMANDS)}")
    if not np.isfinite(rows).all():
        raise UserError(f"{where}: row {_first(~np.isfinite(rows).all(axis=1))} has no number")
    if rows[0, 0] < 0 or np.any(np.diff(rows[:, 0]) <= 0):
        late = np.append(rows[0, 0] < 0, np.diff(rows[:, 0]) <= 0)
        raise UserError(f"{where}: time must increase from 0 on, row {_first(late)} does not")
    return rows


def _first(bad: np.ndarray) -> int:
    return int(np.flatnonzero(bad)[0]) + 1


def _read(path: Path) -> np.ndarray:
    reader = CsvReader.open(path)
    found: dict[str, tuple[int, str]] = {}
    for position, cell in enumerate(reader.header):
        name, _, unit = cell.partition("[")
        found[name.strip()] = (position, unit.strip().removesuffix("]"))
    for name, si in COMMANDS.items():
        if name not in found or not same_dimension(found[name][1] or "1", si):
            raise UserError(f"{path}: column '{name} [{si}]' is missing")
    positions = [found[name][0] for name in COMMANDS]
    parts = [columns for columns, _ in reader.batches(positions, positions[0])]
    columns = [
        np.concatenate([np.zeros(0), *[np.asarray(p[i], dtype=float) for p in parts]])
        for i in range(len(COMMANDS))
    ]
    return np.column_stack(
        [
            convert(column, found[name][1], si)
            for column, (name, si) in zip(columns, COMMANDS.items(), strict=True)
        ]
    )
