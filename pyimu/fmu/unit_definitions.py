"""The units of an FMU's variables: in SI base units, and those in which people read them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from pyimu.block.variables import Variable
from pyimu.fmu.arrays import split_name
from pyimu.report.numbers import in_unit, told_apart, unit_for
from pyimu.units import BASES, IN_SI, ZERO_CELSIUS, parse


def unit_definitions(units: Iterable[tuple[str, str | None]]) -> list[dict]:
    """What FMI's ``UnitDefinitions`` say of pairs of a unit and the one in which it is shown.

    Of each unit its name, its ``base`` unit attributes, None where an exponent is no integer, as
    FMI cannot say that, and the attributes of each unit in which a variable of it is ``shown``.
    """
    shown: dict[str, set[str]] = {}
    for unit, other in units:
        shown.setdefault(unit, set()).update({other} if other else ())
    return [
        {"name": unit, "base": _base_unit(unit), "shown": [_shown(unit, s) for s in sorted(others)]}
        for unit, others in sorted(shown.items())
    ]


def display_units(variables: Sequence[Variable]) -> dict[str, str]:
    """Name of a variable to the unit in which people say it; none where that is its own.

    Elements of one vector or matrix have one unit, that of the largest start value. A pure number
    stays one: it may be a share, but also a component of a quaternion.
    """
    starts: dict[tuple[str, str], list[float]] = {}
    for v in variables:
        starts.setdefault(_group(v), []).append(v.start)
    found = {v.name: unit_for(starts[_group(v)], _group(v)[1]) for v in variables}
    return {v.name: found[v.name] for v in variables if v.unit not in ("1", found[v.name])}


def _group(v: Variable) -> tuple[str, str]:
    return split_name(v.name)[0], told_apart(v.unit, v.said)


def _shown(unit: str, shown: str) -> dict[str, str]:
    """A value in ``shown`` is ``factor`` times the value in ``unit`` (FMI 2.0.4, section 2.2.2)."""
    return {"name": shown, "factor": repr(float(in_unit(1.0, unit, shown)))}


def _base_unit(name: str) -> dict[str, str] | None:
    unit = parse(name)
    exponents: dict[str, int] = {}
    for base, exponent in zip(BASES, unit.dimension):
        if exponent.denominator != 1:
            return None
        for si, power in IN_SI[base].items():
            exponents[si] = exponents.get(si, 0) + power * int(exponent)
    attributes = {si: str(power) for si, power in exponents.items() if power}
    if unit.factor != 1.0:
        attributes["factor"] = repr(float(unit.factor))
    if name == "degC":  # the temperature itself; within a quotient it is a difference
        attributes["offset"] = repr(ZERO_CELSIUS)
    return attributes
