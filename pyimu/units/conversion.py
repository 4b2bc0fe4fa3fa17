"""Values from one unit to another."""

from __future__ import annotations

import numpy as np

from pyimu.units.grammar import Unit, UnitError, unit_of
from pyimu.units.table import BASES, ZERO_CELSIUS


def same_dimension(a: str | Unit, b: str | Unit) -> bool:
    """Whether a value in ``a`` can be converted to ``b``. Raises UnitError for an unknown unit."""
    return unit_of(a).dimension == unit_of(b).dimension


def convert(values, source: str | Unit, target: str | Unit):
    """Convert ``values`` from unit ``source`` to unit ``target``.

    Gives a float for a scalar, else an array of the same shape.

    Temperatures convert as differences; for readings of a thermometer see ``to_degc``. Raises
    UnitError where the dimensions differ.
    """
    target = unit_of(target)
    source = unit_of(source, target)
    if source.dimension != target.dimension:
        raise UnitError(
            f"'{source}' cannot be converted to '{target}': {_describe(source)} is not "
            f"{_describe(target)}"
        )
    with np.errstate(over="ignore", invalid="ignore"):  # infinite and missing ones stay it
        scaled = np.asarray(values, dtype=float) * (source.factor / target.factor)
    return float(scaled) if scaled.ndim == 0 else scaled


FREEZING = {"K": ZERO_CELSIUS, "degC": 0.0, "degF": 32.0}
"""What water freezes at, in units of temperature."""

DEGREES = tuple(unit for unit in FREEZING if unit != "K")
"""Units of temperatures alone: K may be of a difference, too."""


def to_degc(values, unit: str | Unit):
    """Convert temperatures read in ``unit`` (``K``, ``degC`` or ``degF``) to degC; a float for a
    scalar.

    Raises UnitError for another unit.
    """
    unit = unit_of(unit, "K")
    if unit.plain not in FREEZING:
        raise UnitError(f"a temperature must be in degC, K or degF, not '{unit}'")
    shifted = (np.asarray(values, dtype=float) - FREEZING[unit.plain]) * unit.factor
    return float(shifted) if shifted.ndim == 0 else shifted


def _describe(unit: Unit) -> str:
    """The dimension in SI: ``rad s^-1``."""
    parts = [base if e == 1 else f"{base}^{e}" for base, e in zip(BASES, unit.dimension) if e]
    return " ".join(parts) or "a pure number"
