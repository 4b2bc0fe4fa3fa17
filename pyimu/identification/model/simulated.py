"""Of a simulated log the truth is known: what was put in beside what was found, as data."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from pyimu.files import plain
from pyimu.identification.model.as_part import SENSORS
from pyimu.report.lines import in_columns
from pyimu.report.numbers import MISSING, number, pretty, unit_for, with_limits
from pyimu.report.page import Picture, Table, prose
from pyimu.units import convert


@dataclass(frozen=True)
class PutIn:
    """One element of a coefficient that the simulated sensor has and the declared part has not.

    ``true`` and ``found`` in SI ``unit``, ``low`` and ``high`` the 95 % interval, ``said`` how the
    two compare. What was not found is NaN.
    """

    sensor: str
    effect: str
    parameter: str
    place: str
    unit: str
    true: float
    found: float
    low: float
    high: float
    said: str

    def as_dict(self) -> dict[str, Any]:
        return {k: plain(v) for k, v in asdict(self).items()}

    @property
    def cells(self) -> tuple[str, str, str, str]:
        """Name, what was put in, what was found, and how they compare, for people."""
        unit = unit_for(self.true, self.unit)
        values = (self.true, self.found, self.low, self.high)
        true, *found = (float(convert(v, self.unit, unit)) for v in values)
        shown = with_limits(*found) if np.isfinite(found[0]) else MISSING
        name = f"{SENSORS[self.sensor]} {self.effect} {self.parameter} {self.place}".rstrip()
        return f"{name} [{pretty(unit)}]", number(true), shown, self.said


@dataclass(frozen=True)
class Simulated:
    """What is known of a simulated log: how it was made, and what its sensor has in truth.

    ``pictures`` show what the model is worth against the truth, ``notes`` say it.
    """

    made: str
    entries: tuple[PutIn, ...]
    notes: tuple[str, ...] = ()
    pictures: tuple[Picture, ...] = ()

    def as_dict(self) -> dict[str, Any]:
        return {"made": self.made, "put_in": [e.as_dict() for e in self.entries]}

    @property
    def table(self) -> Table:
        return Table(
            HEAD, [(prose(e.cells[0]), *e.cells[1:3], prose(e.cells[3])) for e in self.entries]
        )

    @property
    def lines(self) -> list[str]:
        """The same for a terminal."""
        return [self.made, *in_columns([HEAD, *(e.cells for e in self.entries)]), *self.notes]


HEAD = ("not declared", "put in", "found", "")
