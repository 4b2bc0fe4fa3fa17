"""Units in the spelling of Modelica: integer exponents, dots, one division."""

from __future__ import annotations

from pyimu import units

_PLAIN = ("1", "degC", "Hz")
"""Spelt there as here."""


def modelica_unit(unit: str) -> str | None:
    """``rad/s/(m/s^2)`` as ``rad.s/m``; None for one with a root, which Modelica cannot spell.

    Modelica specification 3.6, chapter 19, unit expressions. Raises UnitError for an unknown unit
    and ValueError for one that is not of SI.
    """
    parsed = units.parse(unit)
    if unit in _PLAIN:
        return unit
    if parsed.factor != 1.0:
        raise ValueError(f"unit {unit} is not of SI")
    if any(e.denominator != 1 for e in parsed.dimension):
        return None
    powers = [(b, int(e)) for b, e in zip(units.BASES, parsed.dimension, strict=True) if e]
    above = ".".join(_power(b, e) for b, e in powers if e > 0)
    below = ".".join(_power(b, -e) for b, e in powers if e < 0)
    if not below:
        return above or "1"
    return f"{above or '1'}/{f'({below})' if '.' in below else below}"


def _power(base: str, exponent: int) -> str:
    return base if exponent == 1 else f"{base}{exponent}"
