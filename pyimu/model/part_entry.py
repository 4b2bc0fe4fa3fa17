"""One entry of a part file: how its figures become SI, and how they are written."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from pyimu import units

ESTIMATE = "estimate"
"""The value that leaves a coefficient to the data."""


DENSITIES = {"two-sided": 1.0, "one-sided": math.sqrt(2.0)}
"""What the root of a density, one-sided or two-sided, is divided by to become the root of the
two-sided one."""


TOLERANCE = "tolerance"
"""The table of a part file that says how far specimens lie from the part."""


RATE_KEY = ("", "", "sample_rate")
"""Where ``Part.notes`` keeps what stands beside the sample rate."""


NOTE_KEYS = ("unit", "density", "source", "quoted")


Key = tuple[str, str, str]


@dataclass(frozen=True)
class FigureScale:
    """How the figures of one entry become SI: unit, kind of density, and whether temperatures."""

    unit: str
    si: str
    density: str = "two-sided"

    @property
    def says_otherwise(self) -> bool:
        """Whether the unit says the same otherwise.

        A step may be in LSB/g or mg/LSB, a frequency in Hz, an axis seen by another one in %.
        """
        return self._as_said != (self.unit, self.si, False)

    @cached_property
    def _as_said(self) -> tuple[str, str, bool]:
        """The unit, the form of ``si`` that it converts to, and whether the figure is 1 / it."""
        dimension = units.parse(self.unit).dimension
        if dimension == units.parse(f"LSB/({self.si})").dimension:
            return self.unit, f"LSB/({self.si})", True
        if dimension == units.parse(f"({self.si})/LSB").dimension:
            return self.unit, f"({self.si})/LSB", False
        if self.si == "rad" and units.parse(self.unit).plain == "%":
            return self.unit, "1", False
        if self.si == "rad/s" and dimension == units.parse("Hz").dimension:
            return f"({self.unit})*rev", self.si, False
        return self.unit, self.si, False

    def to_si(self, figures: Any) -> np.ndarray:
        if self.si == "degC":
            return np.asarray(units.to_degc(figures, self.unit))
        unit, si, inverse = self._as_said
        values = np.asarray(units.convert(figures, unit, si)) / DENSITIES[self.density]
        return _inverse(values) if inverse else values

    def guess(self, values: np.ndarray) -> np.ndarray:
        """Figures whose SI values are ``values`` to within rounding."""
        if self.si == "degC":
            return values + (units.ZERO_CELSIUS if units.parse(self.unit).plain == "K" else 0.0)
        unit, si, inverse = self._as_said
        values = _inverse(np.asarray(values)) if inverse else values
        return np.asarray(units.convert(values * DENSITIES[self.density], si, unit))


def _inverse(values: np.ndarray) -> np.ndarray:
    """1 / values; zero, which switches a step off, stays zero."""
    return np.divide(1.0, values, out=np.zeros(np.shape(values)), where=values != 0.0)


def is_density(unit: Any) -> bool:
    """Whether a figure in this unit is the root of a density, which can be one-sided.

    A random walk in deg/sqrt(h) is two-sided by definition.
    """
    return isinstance(unit, str) and "Hz" in units.plain(unit)


def nested(texts: list[str], shape: tuple[int, ...]) -> str:
    if not shape:
        return texts[0]
    rows = np.reshape(np.array(texts, dtype=object), shape)
    return "[" + ", ".join(nested(list(np.ravel(r)), shape[1:]) for r in rows) + "]"


def format_array(figures: np.ndarray) -> str:
    return nested([f"{v:.12g}" for v in np.ravel(figures)], np.shape(figures))
