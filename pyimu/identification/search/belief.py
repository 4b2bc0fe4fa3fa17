"""What no sensor has: a coefficient beyond all of its kind, or a known one of another size."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from pyimu.errors import UserError
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.keys import Coefficient
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.typical import largest, magnitudes
from pyimu.report.numbers import in_unit, number, pretty, quantity, unit_for, with_error

FARTHEST = 10.0
"""Times the typical size in a consumer part, the coarsest class there is, that no part reaches
unless its data sheet says so."""

CHANCE = 4.0
"""Standard errors by which a coefficient of known size may miss it."""


def unbelievable(fit: Fit, keys: Iterable[Coefficient]) -> str:
    """Why the fitted coefficients ``keys`` are no sensor's; nothing where they may be."""
    for key in sorted(keys):
        effect = CATALOGUE[key.effect]
        definition = effect.parameters[key.parameter]
        value = float(fit.sensor.values[key.effect][key.parameter][key.index])
        unit = fit.sensor.unit(definition.unit)
        if definition.known is not None:
            miss = abs(value - definition.known)
            if miss > CHANCE * fit.std.get(key, np.inf):
                return f"{key.parameter} is {value:.3g}, and can be {definition.known:g} alone"
        limit = most(effect.name, fit.sensor.kind, key.parameter)
        if definition.scan is None and abs(value) - CHANCE * fit.std.get(key, 0.0) > limit:
            said = quantity(value, unit)
            return f"{key.parameter} is {said}, {_beyond(limit, unit, unit_for(value, unit))}"
    return ""


def hidden(fit: Fit, keys: Iterable[Coefficient]) -> dict[Coefficient, str]:
    """The fitted coefficients of ``keys`` that are no estimate, with why, those first that are
    known to be too large.

    What is larger than any sensor's and whose error is as large as those are stands for another's
    share: columns that are nearly one leave the sum of their coefficients alone to be seen.
    """
    out = {}
    for key in sorted(keys):
        definition = CATALOGUE[key.effect].parameters[key.parameter]
        limit = most(key.effect, fit.sensor.kind, key.parameter)
        value = abs(float(fit.sensor.values[key.effect][key.parameter][key.index]))
        unknown = CHANCE * fit.std.get(key, 0.0)
        if definition.scan is None and min(value, unknown) > limit:
            si = fit.sensor.unit(definition.unit)
            unit = unit_for((value, fit.std[key]), si)
            both = (float(in_unit(v, si, unit)) for v in (value, fit.std[key]))
            said = f"{with_error(*both)} {pretty(unit)}".rstrip()
            if value - unknown > limit:
                out = {key: f"{key.parameter} is {said}, {_beyond(limit, si, unit)}", **out}
            else:
                out[key] = f"{key.parameter} is not shown: {said}"
    return out


def _beyond(limit: float, si: str, unit: str) -> str:
    """``unit`` is the one of what it is said of."""
    said = f"{number(float(in_unit(limit, si, unit)))} {pretty(unit)}".rstrip()
    return f"beyond belief: no part has more than {said}"


def most(effect: str, kind: str, parameter: str) -> float:
    """The largest size in SI units that a coefficient may have; infinite where none is known."""
    try:
        typical = magnitudes(effect, kind)["consumer"]
    except UserError:
        return np.inf
    if typical.parameter != parameter:
        return np.inf
    return max(FARTHEST * typical.si, largest(effect, kind))
