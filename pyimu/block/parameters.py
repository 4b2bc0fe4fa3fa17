"""Values of a block's parameters by name, checked against their bounds."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from pyimu.block.block import Block
from pyimu.block.variables import Variable
from pyimu.errors import UserError
from pyimu.units import did_you_mean


def number(name: str, value: Any) -> float:
    """``value`` as a float. Raises UserError where it is no finite number."""
    if isinstance(value, (int, float, np.number, np.bool_)) and np.isfinite(value):
        return float(value)
    raise UserError(f"{name} is {str(value)[:40]!r}, expected a finite number")


def bounded(variable: Variable, value: Any) -> float:
    """``value`` as a float.

    Raises UserError for none, one outside the bounds of the variable, and one that is not whole
    where the variable is.
    """
    value, low, high = number(variable.name, value), variable.minimum, variable.maximum
    if low is not None and value < low or high is not None and value > high:
        unit = "" if variable.unit == "1" else f" {variable.unit}"
        raise UserError(
            f"{variable.name} is {value:g}{unit}, expected "
            + " to ".join(f"{v:.9g}" for v in (low, high) if v is not None)
            + (" or more" if high is None else "")
        )
    if variable.kind == "integer" and value != int(value):
        raise UserError(f"{variable.name} is {value:g}, expected a whole number")
    if variable.kind == "boolean" and value not in (0.0, 1.0):
        raise UserError(f"{variable.name} is {value:g}, expected true or false")
    return value


def with_settings(block: Block, values: Mapping[str, Any], whose: str) -> np.ndarray:
    """The block's parameters (np,), those in ``values`` by the names of scalars, the others' start.

    Raises UserError for a name that is unknown, which is a setting of ``whose``, and as ``bounded``
    does.
    """
    at = {v.name: i for i, v in enumerate(block.parameters)}
    p = block.start.copy()
    for name, value in values.items():
        if name not in at:
            known = [n for n in at if "." not in n]
            raise UserError(
                f"unknown setting '{name}' of {whose}{did_you_mean(name, at)}; known are "
                f"{', '.join(known)}"
            )
        p[at[name]] = bounded(block.parameters[at[name]], value)
    return p


def with_values(block: Block, values: Mapping[str, Any]) -> np.ndarray:
    """The block's parameters (np,), those in ``values`` by name and the others' start values.

    A vector is given by its elements (``lever_arm[3]``) or as a whole (``lever_arm``). Raises
    UserError for an unknown name, for a vector of another length, and as ``bounded`` does.
    """
    at = {v.name: i for i, v in enumerate(block.parameters)}
    p = block.start.copy()
    for name, value in values.items():
        for i, element in _elements(block, at, name, value):
            p[i] = bounded(block.parameters[i], element)
    return p


def _elements(block: Block, at: Mapping[str, int], name: str, value: Any):
    """Each parameter that a name means, by its place, and its value."""
    if name in at:
        return [(at[name], value)]
    places = [i for known, i in at.items() if known.partition("[")[0] == name]
    if not places:
        bases = dict.fromkeys(known.partition("[")[0] for known in at)
        raise UserError(f"{block.name} has no parameter {name}{did_you_mean(name, bases)}")
    if np.shape(value) != (len(places),):
        raise UserError(f"{name} is {str(value)[:60]}, expected {len(places)} numbers")
    return zip(places, value, strict=True)
