"""The kinds of noise of the catalogue as shapes of a variance, whose size is unknown."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from pyimu.identification.noise.rows import Rows
from pyimu.identification.noise.spectrum import Bands
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.effect import Effect
from pyimu.model.sensor import Sensor

TIMES = 4
"""Correlation times that are tried in three octaves; between them the likelihood is refined."""

SHORTEST_TIME = 3.0
"""Samples; the shortest correlation time that is tried, below which noise is white."""

LONGEST_TIME = 0.1
"""Share of the longest log; the longest correlation time, beyond which fewer than ten excursions
tell a process from a walk or from a trend."""

ENDS = (0.5, 0.05, 0.005)
"""Shares of the sample rate at which 1/f noise may end, five decades above its beginning."""

Form = Mapping[str, float]


@dataclass(frozen=True, eq=False)
class Kind:
    """A kind of noise: an effect with a law, the coefficient that is its size, and the ``forms``
    that are tried, values of what else it has. ``follows`` says that it follows the motion.
    """

    effect: Effect
    parameter: str
    forms: tuple[Form, ...]

    @property
    def name(self) -> str:
        return self.effect.name

    @property
    def follows(self) -> bool:
        return self.effect.law.needs("x") or self.effect.law.needs("slope")

    @property
    def scans(self) -> bool:
        return len(self.forms) > 1

    @property
    def shares_form(self) -> bool:
        """Whether all axes have one form."""
        return all(self.effect.parameters[n].shape == () for n in self.forms[0])

    def in_bands(self, bands: Bands, form: Form, size: float = 1.0) -> np.ndarray:
        """Variance (c,) in cells of frequency."""
        given = {self.parameter: size, **form}
        law, h = self.effect.law, bands.h
        values = {p: law.value(p, given, h=h) for p in ("white", "walk", "markov", "rounding")}
        pairs = [tuple(map(float, pair)) for pair in values.pop("markov") or ()]
        white, walk, rounding = (0.0 if v is None else float(v) for v in values.values())
        return bands.density(white, walk, pairs, rounding)

    def in_rows(self, rows: Rows, size: float = 1.0) -> np.ndarray:
        """Variance (n,) of white noise that follows the motion, in each row."""
        given = {self.parameter: size}
        density = self.effect.law.value("white", given, h=rows.h, x=rows.x, slope=rows.slope)
        return np.asarray(density, dtype=float) / rows.h


def kinds(sensor: Sensor, h: float, longest: float) -> list[Kind]:
    """Every kind of noise of a sensor whose longest log lasts ``longest`` s."""
    known = [e for e in CATALOGUE.values() if sensor.kind in e.sensors and e.law is not None]
    found = [k for e in known if (k := _kind(e, h, longest)) is not None]
    return [k for k in found if not _is_later(k, found, sensor)]


def _is_later(kind: Kind, found: list[Kind], sensor: Sensor) -> bool:
    """Whether a kind is absent, and another of the same law and forms comes before it."""
    if kind.name in sensor.values:
        return False
    same = [k for k in found if k.effect.law is kind.effect.law and k.name not in sensor.values]
    return kind is not same[0]


def names_of(kind: Kind, sensor: Sensor) -> list[str]:
    """The effects that a kind of noise may be called by: its own, and those of the same law that
    the sensor lacks.
    """
    same = [e for e in CATALOGUE.values() if e.law is kind.effect.law and sensor.kind in e.sensors]
    return [e.name for e in same if e is kind.effect or e.name not in sensor.values]


def _kind(e: Effect, h: float, longest: float) -> Kind | None:
    sizes = [n for n, p in e.parameters.items() if not (p.form or p.reference)]
    # What is read off the raw samples is known better than its variance says.
    if len(sizes) != 1 or e.law.parts == ("ramp",) or e.parameters[sizes[0]].reads:
        return None
    shapes = {n: p for n, p in e.parameters.items() if p.form}
    forms: tuple[dict[str, float], ...] = ({n: p.start for n, p in shapes.items()},)
    if [p.unit for p in shapes.values()] == ["s"]:
        ends = SHORTEST_TIME * h, LONGEST_TIME * longest
        count = max(2, round(TIMES * np.log(ends[1] / ends[0]) / np.log(8.0)))
        forms = tuple({n: float(t)} for n in shapes for t in np.geomspace(*ends, count))
    elif e.law.markov and [p.unit for p in shapes.values()] == ["Hz", "Hz"]:
        low, high = shapes
        forms = tuple({low: share / h * 1e-5, high: share / h} for share in ENDS)
    return Kind(e, sizes[0], forms)


def declared(kind: Kind, sensor: Sensor, axis: int) -> tuple[float, dict[str, Any]]:
    """The size and form of a kind that a sensor declares on an axis; zero where it lacks it."""
    values = sensor.values.get(kind.name)
    if values is None:
        return 0.0, {}
    each = {n: float(v[axis] if np.ndim(v) else v) for n, v in values.items()}
    return each.pop(kind.parameter), each
