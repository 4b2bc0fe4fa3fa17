"""What is asked of a plan: which effects, how large they are, and how well they are to be known."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from pyimu import units
from pyimu.errors import UserError
from pyimu.identification.fit.keys import Coefficient, coefficients_of
from pyimu.model.catalogue import CATALOGUE, POWER_ON
from pyimu.model.effect import Effect
from pyimu.model.kinds import KINDS
from pyimu.model.part import Part
from pyimu.model.part_entry import FigureScale
from pyimu.model.sensor import Sensor
from pyimu.model.typical import CLASSES, magnitudes
from pyimu.report.numbers import joined


@dataclass(frozen=True)
class Goal:
    """A coefficient of an asked effect: its ``size`` (None where nobody knows one), where that is
    from, and the standard error ``wanted`` of it, all in SI.
    """

    key: Coefficient
    unit: str
    size: float | None
    source: str
    wanted: float | None


def sensor_of(effects: Sequence[str], kind: str | None) -> str:
    """The kind of sensor that has all the effects, the gyro first.

    Raises UserError for an effect that does not exist or that this kind does not have.
    """
    if kind is not None and kind not in KINDS:
        raise UserError(
            f"unknown sensor '{kind}'{units.did_you_mean(kind, KINDS)}; known are "
            f"{', '.join(KINDS)}"
        )
    if not effects:
        raise UserError("no effect asked for: name at least one with --for")
    kinds = [kind] if kind else list(KINDS)
    for name in effects:
        if name not in CATALOGUE:
            own = [known for known in CATALOGUE if set(kinds) & set(CATALOGUE[known].sensors)]
            raise UserError(f"unknown effect '{name}'{units.or_known(name, own)}")
        kinds = [k for k in kinds if k in CATALOGUE[name].sensors]
        if not kinds:
            said = kind or " or ".join(CATALOGUE[name].sensors)
            also = "" if kind else ", the effects before it not: give each a plan of its own"
            raise UserError(
                f"effect {name} does not belong to a {said}"
                if kind
                else f"effect {name} belongs to the {said}{also}"
            )
    return kinds[0]


def class_of(part: Part, kind: str) -> str:
    """The class of parts whose typical sizes a sensor's noise and errors are nearest to, or, where
    it declares none, those of the part's other sensor.
    """
    other = next(k for k in KINDS if k != kind)
    places = _places(part.sensor(kind)) or _places(part.sensor(other))
    return CLASSES[0] if places and np.median(places) < 0.5 else CLASSES[-1]


def _places(sensor: Sensor) -> list[float]:
    """Where each coefficient lies, in the logarithm, from the better class (0) to the other (1)."""
    places = []
    for e in sensor.effects:
        sizes = _magnitudes(e.name, sensor.kind)
        if not sizes or e.stage in ("dynamics", "output"):
            continue
        best, worst = (sizes[c].si for c in CLASSES)
        value = np.abs(sensor.values[e.name][sizes[CLASSES[0]].parameter])
        if best != worst and np.any(value > 0):
            middle = float(np.median(value[value > 0]))
            places.append(float(np.log(middle / best) / np.log(worst / best)))
    return places


def _magnitudes(effect: str, kind: str) -> Mapping:
    try:
        return magnitudes(effect, kind)
    except UserError:
        return {}


def goals(
    part: Part, kind: str, effects: Iterable[str], sigmas: float, within: Mapping[str, float]
) -> list[Goal]:
    """The coefficients of the effects of a part's sensor, with what is wanted of each.

    ``within`` gives the wanted standard error (SI) by effect; without, it is the size over
    ``sigmas``.
    """
    sensor, found = part.sensor(kind), []
    for name in effects:
        e = CATALOGUE[name]
        sizes = _magnitudes(name, kind)
        typical = sizes.get(class_of(part, kind))
        for key in sorted(coefficients_of(sensor, name)):
            q = e.parameters[key.parameter]
            main = typical.parameter if typical else next(iter(e.parameters))
            size, source = _size(sensor, key, typical)
            wanted = within.get(name, None if size is None else size / sigmas)
            if q.form or key.parameter != main:
                wanted = None
            found.append(Goal(key, sensor.unit(q.unit), size, source, wanted))
    return found


def _size(sensor: Sensor, key: Coefficient, typical) -> tuple[float | None, str]:
    declared = sensor.values.get(key.effect)
    value = 0.0 if declared is None else abs(float(declared[key.parameter][key.index]))
    if value > 0.0:
        return value, "declared"
    if typical is not None and typical.parameter == key.parameter:
        return typical.si, "typical"
    if typical is not None and key.parameter in typical.beside_si:
        return typical.beside_si[key.parameter], "typical"
    return None, ""


def at_typical(sensor: Sensor, part: Part, effect: str) -> dict[str, np.ndarray]:
    """The coefficients of an effect at a size that it typically has."""
    e, typical = (
        CATALOGUE[effect],
        _magnitudes(effect, sensor.kind).get(class_of(part, sensor.kind)),
    )
    if typical is None:
        return {}
    values = {typical.parameter: typical.si, **typical.beside_si}
    return {n: np.full(e.parameters[n].shape, v) * _free(e, n) for n, v in values.items()}


def _free(e: Effect, name: str) -> np.ndarray:
    """1 where a parameter has an element."""
    out = np.zeros(e.parameters[name].shape)
    for index in e.parameters[name].indices:
        out[index] = 1.0
    return out


def left_to_data(part: Part, sensor: Sensor) -> frozenset[Coefficient]:
    """The coefficients of a sensor's model that its part leaves to be estimated from a log."""
    return frozenset(
        Coefficient(s.effect, s.parameter, s.index)
        for s in sensor.slots
        if (sensor.kind, s.effect, s.parameter) in part.estimate
        and not s.definition.reference
        and not sensor.effect(s.effect).stochastic
        and (s.effect, s.parameter) != POWER_ON
    )


# A wanted standard error


def wanted_errors(texts: Iterable[str], kind: str, effects: Sequence[str]) -> dict[str, float]:
    """By effect the standard error (SI) that ``texts`` ask for.

    A text is a number and its unit, as "0.5 deg/h/K", with several effects "EFFECT=0.5 deg/h/K".
    Raises UserError for one that is none.
    """
    found: dict[str, float] = {}
    for text in texts:
        name, equals, quantity = text.rpartition("=")
        if not equals and len(effects) > 1:
            raise UserError(f"--within {text}: several effects, so say EFFECT=VALUE UNIT")
        name = name.strip() or effects[0]
        if name not in effects:
            near = units.did_you_mean(name, effects)
            raise UserError(f"--within {text}: {name} is not among --for{near}")
        found[name] = _si(text, quantity, kind, CATALOGUE[name])
    return found


def _si(text: str, quantity: str, kind: str, e: Effect) -> float:
    sizes = _magnitudes(e.name, kind)
    main = sizes[CLASSES[0]].parameter if sizes else next(iter(e.parameters))
    right = KINDS[kind].units(e.parameters[main].unit)
    match = re.fullmatch(r"\s*([0-9.]+(?:[eE][-+]?[0-9]+)?)\s*(\S*)\s*", quantity)
    said = f"--within {text}: expected a number and a unit like '{right}', the standard error"
    if match is None:
        raise UserError(f"{said} wanted of {e.name}.{main}")
    try:
        # As in a part: a frequency, which is shown in Hz, may be said in Hz.
        value = float(FigureScale(match[2] or "1", right).to_si(float(match[1])))
    except (units.UnitError, ValueError) as error:
        raise UserError(f"{said} wanted of {e.name}.{main}; {error}") from None
    if not value > 0.0:
        raise UserError(f"{said} wanted of {e.name}.{main}")
    return value


def told(names: Sequence[str]) -> str:
    """Names of effects as words."""
    return joined([n.replace("_", " ") for n in names])
