"""A sensor: a triad with its effects, sorted by stage, and the values of their coefficients."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from pyimu import units
from pyimu.block.variables import NoiseChannel, Variable
from pyimu.errors import UserError
from pyimu.model.catalogue import CATALOGUE, add_effects, read_off
from pyimu.model.chain import HALF, Chain, Slot, chain_of
from pyimu.model.effect import Effect
from pyimu.model.kinds import TRIADS, SensorKind
from pyimu.model.signals import EVERY_SAMPLE

Values = Mapping[str, Mapping[str, np.ndarray]]
EMPTY: Mapping[str, np.ndarray] = MappingProxyType({})


@dataclass(frozen=True)
class Sensor:
    """A triad with a tuple of effects and the values of their coefficients (SI).

    ``values[effect][parameter]`` is an array of the parameter's shape; the effects are sorted by
    stage. Raises UserError for an effect that this kind of sensor does not have, and a value of the
    wrong shape, not finite, outside its bounds or on a diagonal that the parameter does not have.
    """

    kind: str
    values: Values = field(default_factory=dict)
    effects: tuple[Effect, ...] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        if self.kind not in TRIADS:
            raise UserError(
                f"unknown sensor '{self.kind}'{units.did_you_mean(self.kind, TRIADS)}; known are "
                f"{', '.join(TRIADS)}"
            )
        effects = CATALOGUE.in_order(CATALOGUE.of(self.kind, name) for name in self.values)
        complete = {e.name: _complete(self.kind, e, self.values[e.name]) for e in effects}
        object.__setattr__(self, "values", MappingProxyType(complete))
        object.__setattr__(self, "effects", effects)

    def _with(self, effects: tuple[Effect, ...], values: Values) -> Sensor:
        """A sensor of this kind with ``effects`` and their complete ``values``: what a sound sensor
        has is not looked at again.
        """
        out = object.__new__(Sensor)
        ordered = MappingProxyType({e.name: values[e.name] for e in effects})
        for name, value in (("kind", self.kind), ("values", ordered), ("effects", effects)):
            object.__setattr__(out, name, value)
        return out

    def __repr__(self) -> str:
        """``Sensor('gyro': lag, angle_random_walk)``; its ``values`` hold the coefficients."""
        return f"Sensor({self.kind!r}: {', '.join(self.values) or 'ideal'})"

    def of_axis(self, effect: str, axis: int) -> dict[str, float]:
        """An effect's coefficients for one axis (0 to 2); those without axes are everybody's."""
        return {
            name: float(value[axis] if value.ndim else value)
            for name, value in self.values[effect].items()
        }

    def __eq__(self, other: object) -> bool:
        """Equal kind, effects and coefficients.

        Written out because arrays have no truth value, so the dataclass cannot compare them.
        """
        if not isinstance(other, Sensor):
            return NotImplemented
        return (self.kind, self.slots) == (other.kind, other.slots) and np.array_equal(
            self.p, other.p
        )

    def __hash__(self) -> int:
        return hash((self.kind, self.slots, tuple(self.p)))

    def __reduce__(self):
        values = {e: dict(p) for e, p in self.values.items()}
        return _restored, (
            self.kind,
            values,
            tuple(dict.fromkeys(e.file for e in self.effects if e.file)),
        )

    def effect(self, name: str) -> Effect:
        """Its effect of this name. Raises KeyError where it has none."""
        return self.chain.by_name[name]

    @property
    def signals(self) -> frozenset[str]:
        """Names in ``SIGNALS`` that the effects need beside the signal that the sensor measures."""
        return frozenset().union(*(e.signals(self.kind) for e in self.effects))

    @property
    def output(self) -> SensorKind:
        return TRIADS[self.kind]

    def check(self, sample_period: float, name: str) -> None:
        """Raise UserError for coefficients that conflict with each other or the sample period [s].

        The message starts with ``name``.
        """
        if any(e.limits for e in self.effects):
            self.chain.limits.check(self.p, sample_period, name)

    def unit(self, template: str) -> str:
        """A unit of a definition, with the sensor's own units put in."""
        return self.output.units(template)

    def with_values(self, effect_name: str, **parameters: ArrayLike) -> Sensor:
        """The same sensor with an effect added, or some of its coefficients changed."""
        e, had = CATALOGUE.of(self.kind, effect_name), self.values.get(effect_name, {})
        known = had if e in self.effects else {}
        given = parameters if known else {**had, **parameters}
        others = (other for other in self.effects if other.name != effect_name)
        values = {**self.values, effect_name: _complete(self.kind, e, given, known)}
        return self._with(CATALOGUE.in_order((*others, e)), values)

    def without(self, *names: str) -> Sensor:
        left = tuple(e for e in self.effects if e.name not in names)
        return self if len(left) == len(self.effects) else self._with(left, self.values)

    def is_off(self, name: str) -> bool:
        """True for an effect that must be scanned for and stands at its identity.

        It has no slope there.
        """
        found = [(n, p) for n, p in self.effect(name).parameters.items() if p.sought]
        return bool(found) and all(np.all(self.values[name][n] == p.start) for n, p in found)

    def acts(self, name: str) -> bool:
        """True for an effect that is not at the identity.

        Coefficients that only shape an effect, or fix its origin, do not count.
        """
        sizes = [
            (n, p) for n, p in self.effect(name).parameters.items() if not (p.form or p.reference)
        ]
        return not self.is_off(name) and any(
            np.any(self.values[name][n] != p.start) for n, p in sizes
        )

    def delay(self, name: str) -> float:
        """s; by how much an effect that delays makes the sensor late."""
        return float(self.effect(name).delay(**{n: float(v) for n, v in self.values[name].items()}))

    def reading(self, what: str) -> tuple[str, str] | None:
        """Effect and coefficient that are read off raw samples as ``what`` ("ceiling", "step").

        None where the sensor has none.
        """
        return read_off(self.effects, what)

    @property
    def clips_from(self) -> np.ndarray:
        """The size (3,) from which on an output is at the sensor's limit, infinite without one.

        The rounding that follows may have taken half a step off the limit.
        """
        limit, step = (
            np.zeros(3) if found is None else np.broadcast_to(self.values[found[0]][found[1]], 3)
            for found in (self.reading("ceiling"), self.reading("step"))
        )
        return np.where(limit > 0, limit - HALF * step, np.inf)

    @property
    def left_in(self) -> tuple[str, ...]:
        """Names of the acting effects that ``compensation`` neither inverts nor marks."""
        return tuple(e.name for e in self.effects if e.left_in and self.acts(e.name))

    @property
    def slots(self) -> tuple[Slot, ...]:
        """Every coefficient in the order of the vector ``p``."""
        return self.chain.slots

    @cached_property
    def p(self) -> np.ndarray:
        """Values of the coefficients, shape (len(slots),)."""
        return np.array(
            [self.values[s.effect][s.parameter][s.index] for s in self.slots], dtype=float
        )

    def with_p(self, p: np.ndarray) -> Sensor:
        """The same sensor with the coefficients of vector ``p``."""
        values = {e: {k: np.array(v) for k, v in q.items()} for e, q in self.values.items()}
        for slot, value in zip(self.slots, p, strict=True):
            values[slot.effect][slot.parameter][slot.index] = value
        return replace(self, values=values)

    @cached_property
    def variables(self) -> tuple[Variable, ...]:
        """The coefficients as variables of a block, named ``gyro_error.effect.parameter[i,j]``."""
        return tuple(
            Variable(
                f"{self.kind}_error.{s.name}",
                s.unit,
                _described(self.effect(s.effect), s),
                float(v),
                minimum=s.definition.minimum,
                maximum=s.definition.maximum,
                said=s.definition.said,
            )
            for s, v in zip(self.slots, self.p, strict=True)
        )

    @property
    def noise(self) -> tuple[NoiseChannel, ...]:
        """The chain's standard normals."""
        return self.chain.noise

    @cached_property
    def chain(self) -> Chain:
        return chain_of(self.kind, self.effects)

    @property
    def step(self) -> ca.Function:
        """``(s, u, p, w, h) -> (s_next, y)``."""
        return self.chain.step

    @property
    def compensation(self) -> ca.Function:
        """``(s, y, u, p, h) -> (s_next, x, lost)``: the chain solved for its input, without noise.

        ``u`` (N_INPUT,) carries the environment (its own signal is ignored); ``lost`` (3,) is 1
        where this sample says nothing of ``x``, as beyond the range or within a dead zone. The
        effects in ``left_in`` (lag, delay, rounding) are not undone and mark nothing: with them
        ``x`` is the input behind the part's bandwidth, late by its delay, to within its rounding.
        """
        return self.chain.compensation


def _complete(
    kind: str, e: Effect, given: Mapping[str, Any], known: Mapping[str, np.ndarray] = EMPTY
) -> Mapping[str, np.ndarray]:
    """The values of an effect's parameters: as ``given``, else as ``known`` to be sound, else at
    their start.
    """
    shaped = {name: _shaped(kind, e, name, value) for name, value in given.items()}
    return MappingProxyType({**(known or e.start()), **shaped})


def _described(e: Effect, slot: Slot) -> str:
    text = slot.definition.description
    return f"{text or e.term}; {EVERY_SAMPLE}" if e.differences else text or e.term


def _restored(kind: str, values: Values, files: tuple[str, ...]) -> Sensor:
    """A sensor in another process, which may not know the user's own effects yet."""
    known = {e.file for e in CATALOGUE.values()}
    add_effects(*(f for f in files if f not in known))
    return Sensor(kind, values)


def _shaped(kind: str, e: Effect, parameter: str, value: Any) -> np.ndarray:
    if parameter not in e.parameters:
        raise UserError(
            f"effect {e.name} has no parameter "
            f"'{parameter}'{units.did_you_mean(parameter, e.parameters)}; "
            f"it has {', '.join(e.parameters)}"
        )
    definition, where = e.parameters[parameter], f"{kind} {e.name}.{parameter}"
    try:
        array = np.array(value, dtype=float)
    except (TypeError, ValueError):
        raise UserError(
            f"{where} must be numbers of shape {definition.shape}, not {value!r}"
        ) from None
    if array.ndim == 0 and len(definition.shape) == 1:
        array = np.full(definition.shape, float(array))
    if array.shape != definition.shape:
        raise UserError(f"{where} has shape {array.shape}, not {definition.shape}")
    _refuse(kind, e, parameter, array)
    array.setflags(write=False)
    return array


def _refuse(kind: str, e: Effect, parameter: str, array: np.ndarray) -> None:
    fault = e.parameters[parameter].fault(array)
    if fault:
        found = (
            f", not {array.tolist()} {TRIADS[kind].units(e.parameters[parameter].unit)}"
            if array.ndim < 2
            else ""
        )
        raise UserError(f"{kind} {e.name}.{parameter} {fault}{found}")


def candidates(kind: str, present: Iterable[str]) -> tuple[Effect, ...]:
    """Effects of the catalogue that a sensor of this kind could have, less those in ``present``."""
    have = set(present)
    return tuple(e for e in CATALOGUE.values() if kind in e.sensors and e.name not in have)
