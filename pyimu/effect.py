"""One sensor error effect is one symbolic function; this module derives everything else from it.

An effect is written as a function of the sensor's input ``x`` (3,), whose annotated arguments say what else it
needs::

    @effect(stage="bias", equation=r"y = x + G f", source="IEEE Std 528-2019, g-sensitive drift")
    def g_sensitivity(x, G: Parameter("{y}/(m/s^2)", (3, 3)), f: Environment("specific_force")):
        return x + G @ f

``Sensor`` is a chain of such effects, sorted by stage.  Its step is the pure function
``(s, u, p, w, h) -> (s_next, y)`` of state, input, parameters, standard normals and sample period.
In a unit, ``{y}`` stands for the unit of the sensor's output and ``{Y}`` for that of its integral, so that gyro
and accelerometer triads share one definition.
"""

from __future__ import annotations

import inspect
import zlib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import casadi as ca
import numpy as np

from pyimu import units
from pyimu.block import Limits, NoiseChannel, Variable
from pyimu.errors import UserError
from pyimu.signals import COLUMNS, EVERY_SAMPLE, N_INPUT, SIGNALS, is_number, kept

if TYPE_CHECKING:
    from pyimu.recording import Recording

STAGES = ("motion", "dynamics", "gain", "bias", "noise", "output")
"""The order in which effects act on a sample: the motion that reaches the element, its dynamics, gain, bias, noise, output."""

INPUT = "input"
"""Start of a state that begins as if the first input had always been there."""

NEWTON_STEPS = 6
"""Iterations of the symbolic inverse; an error of 0.1 squares to below 1e-16 in five."""


@dataclass(frozen=True)
class SensorKind:
    """A triad: which signal it measures, that signal's rate, its unit, and the unit of its integral."""

    name: str
    own: str
    own_rate: str
    unit: str
    integral: str

    def units(self, template: str) -> str:
        """A unit of a definition, with the triad's own units put in."""
        return template.replace("{y}", self.unit).replace("{Y}", self.integral)


KINDS = {"gyro": SensorKind("gyro", "rate", "angular_acceleration", "rad/s", "rad"),
         "accel": SensorKind("accel", "specific_force", "jerk", "m/s^2", "m/s")}

OWN = {kind: COLUMNS[k.own] for kind, k in KINDS.items()}
"""Where a sensor's own signal stands in the input vector."""

OWN_RATE = "own_rate"
"""Name of the rate of the sensor's own signal among an effect's environment: angular acceleration or jerk."""


@dataclass(frozen=True)
class Scan:
    """Where to look for a coefficient that no slope at the identity finds: ``points`` values, evenly in logarithm.

    ``low`` and ``high`` count sample periods ("period"), radians a sample ("rate") or shares of the largest input ("range").
    """

    measure: str
    low: float
    high: float
    points: int = 8

    def values(self, period: float, largest: float) -> np.ndarray:
        """The grid for a log of this sample period [s] and largest input."""
        unit = {"period": period, "rate": 1.0 / period, "range": largest}[self.measure]
        return unit * np.geomspace(self.low, self.high, self.points)


@dataclass(frozen=True)
class Parameter:
    """A coefficient.  ``start`` is where the effect is the identity; matrices may leave out their diagonal.

    ``reference`` marks a coefficient that only fixes an origin (a reference temperature): it is never estimated.  ``form``
    marks one that shapes an effect whose size others give (a time constant, an instant): it acts only where they do.  ``known`` is the one value, beside zero, that it can have.
    ``scan`` says where identification starts its search where the identity has no slope to follow.
    """

    unit: str
    shape: tuple[int, ...] = (3,)
    start: float = 0.0
    description: str = ""
    diagonal: bool = True
    reference: bool = False
    form: bool = False
    known: float | None = None
    minimum: float | None = None
    maximum: float | None = None
    scan: Scan | None = None

    @cached_property
    def indices(self) -> tuple[tuple[int, ...], ...]:
        """Index of every free element, row by row."""
        return tuple(i for i in np.ndindex(*self.shape) if self.diagonal or i[0] != i[1])

    def fault(self, values: np.ndarray) -> str:
        """What is wrong with values of the parameter's shape in its SI unit, as "must not be below 0"; empty where nothing is."""
        if not np.all(np.isfinite(values)):
            return "must be finite"
        if self.minimum is not None and np.any(values < self.minimum):
            return f"must not be below {self.minimum:g}"
        if self.maximum is not None and np.any(values > self.maximum):
            return f"must not be above {self.maximum:g}"
        return "must have zeros on its diagonal" if not self.diagonal and np.any(np.diag(values)) else ""


@dataclass(frozen=True)
class State:
    """Memory of an effect; ``start`` is a number, ``INPUT`` for the steady state at the first input of the effect, or the
    name of one of the effect's environment arguments for that signal's first value."""

    unit: str
    shape: tuple[int, ...] = (3,)
    start: float | str = 0.0


@dataclass(frozen=True)
class Noise:
    """Independent standard normals, one draw a sample."""

    size: int = 3


@dataclass(frozen=True)
class Environment:
    """A signal beside the effect's own input, by its name in ``SIGNALS``, or ``OWN_RATE``.

    The signal that the sensor itself measures means the effect's own input: a sensor knows it through nothing else.
    """

    signal: str


@dataclass(frozen=True)
class SamplePeriod:
    """The sample period in seconds."""


@dataclass(frozen=True)
class Effect:
    """One error effect and what its definition says about it.

    ``smooth`` is False where the output has steps or corners in ``x`` that no regressor describes; ``invertible`` is
    False where the input cannot be had back from every output: ``lost(y, **parameters)`` then marks the samples that say
    nothing of it, and ``restore(y, **parameters)`` gives the input of the others where it is not the output itself; one
    without marks is left in.  ``limits`` are what several parameters, or one and the sample period, must keep: a text, and
    ``broken(h, **parameters)``.
    """

    name: str
    stage: str
    equation: str
    source: str
    term: str
    sensors: tuple[str, ...]
    function: Callable[..., Any]
    smooth: bool
    invertible: bool
    lost: Callable[..., Any] | None
    restore: Callable[..., Any] | None
    limits: Mapping[str, Callable[..., Any]]
    order: int
    parameters: Mapping[str, Parameter] = field(repr=False)
    states: Mapping[str, State] = field(repr=False)
    noises: Mapping[str, Noise] = field(repr=False)
    environment: Mapping[str, str] = field(repr=False)
    period: str | None = None

    @property
    def stochastic(self) -> bool:
        return bool(self.noises)

    @property
    def remembers(self) -> bool:
        """True where the output without noise depends on what was before, and not as a linear filter of the input does."""
        return bool(self.states) and not self.stochastic and self.stage != "dynamics"

    @property
    def left_in(self) -> bool:
        """True where compensation neither solves the effect for its input nor marks samples: what it does stays in."""
        return not self.invertible and self.lost is None

    @property
    def differences(self) -> bool:
        """True where the effect follows from the difference of successive inputs, and is zero where they are held."""
        return any(s == OWN_RATE or SIGNALS[s].difference for s in self.environment.values())

    def signals(self, kind: str) -> frozenset[str]:
        """Names in ``SIGNALS`` of what the effect needs beside the signal that a sensor of this kind measures."""
        named = (KINDS[kind].own_rate if s == OWN_RATE else s for s in self.environment.values())
        return frozenset(named) - {KINDS[kind].own}

    def start(self) -> dict[str, np.ndarray]:
        """Start values of all parameters: the identity."""
        return {n: np.full(p.shape, p.start) for n, p in self.parameters.items()}

    def __call__(self, x: ca.SX, p: Mapping, s: Mapping, w: Mapping, u: Mapping, h: ca.SX) -> tuple[ca.SX, dict]:
        """Output (3,) and following states for input ``x`` (3,); the mappings hold casadi matrices by argument name."""
        arguments = {**p, **s, **w, **{name: u[signal] for name, signal in self.environment.items()}}
        if self.period:
            arguments[self.period] = h
        result = self.function(x, **arguments)
        return result if isinstance(result, tuple) else (result, {})


CATALOGUE: dict[str, Effect] = {}
"""Every effect by name, in the order of definition; filled by importing ``pyimu.effects``."""


def effect(*, stage: str, equation: str, source: str, term: str, sensors: tuple[str, ...] = ("gyro", "accel"),
           smooth: bool = True, invertible: bool = True, lost: Callable | None = None, restore: Callable | None = None,
           limits: Mapping[str, Callable] = MappingProxyType({})) -> Callable[[Callable], Effect]:
    """Make an ``Effect`` of a function and list it in the catalogue.

    ``term`` is the field's name of it, ``source`` the document that the equation is from (or "no source").
    Raises ValueError where the name exists already, the stage is unknown or an argument has no annotation, and UserError,
    which is one, where a kind of sensor, a signal or a unit does not exist.
    """
    def define(function: Callable) -> Effect:
        name = function.__name__
        if name in _filled():
            raise ValueError(f"effect {name} is defined twice")
        if stage not in STAGES:
            raise ValueError(f"effect {name}: unknown stage {stage!r}, not one of {', '.join(STAGES)}")
        for kind in sensors:
            _known(name, "sensor", kind, KINDS)
        made = Effect(name, stage, equation, source, term, sensors, function, smooth, invertible, lost,
                      restore, MappingProxyType(dict(limits)), len(CATALOGUE), **_arguments(name, function))
        CATALOGUE[name] = made
        return made
    return define


def _arguments(name: str, function: Callable) -> dict[str, Any]:
    """Sort the annotated arguments of an effect's function by what they are."""
    groups: dict[type, dict] = {Parameter: {}, State: {}, Noise: {}, Environment: {}, SamplePeriod: {}}
    for argument in list(inspect.signature(function).parameters.values())[1:]:
        if type(argument.annotation) not in groups:
            raise ValueError(f"effect {name}: argument {argument.name} needs a Parameter, State, Noise, Environment or SamplePeriod")
        groups[type(argument.annotation)][argument.name] = argument.annotation
        _checked(name, argument.name, argument.annotation)
    return {"parameters": MappingProxyType(groups[Parameter]), "states": MappingProxyType(groups[State]),
            "noises": MappingProxyType(groups[Noise]),
            "environment": MappingProxyType({n: e.signal for n, e in groups[Environment].items()}),
            "period": next(iter(groups[SamplePeriod]), None)}


def _checked(name: str, argument: str, annotation: Any) -> None:
    """Refuse a signal or a unit that does not exist where the effect is made, not where it is first used."""
    if isinstance(annotation, Environment):
        _known(name, "signal", annotation.signal, (*SIGNALS, OWN_RATE))
    if isinstance(annotation, (Parameter, State)):
        try:
            units.parse(KINDS["gyro"].units(annotation.unit))
        except units.UnitError as error:
            raise UserError(f"effect {name}: {argument}: {error}") from None


def _known(name: str, what: str, found: str, known: Iterable[str]) -> None:
    if found not in known:
        raise UserError(f"effect {name}: unknown {what} '{found}'{units.did_you_mean(found, known)}; known are {', '.join(known)}")


@dataclass(frozen=True)
class Slot:
    """Where one coefficient stands: effect, parameter, index in its array."""

    effect: str
    parameter: str
    index: tuple[int, ...]
    unit: str
    definition: Parameter

    @property
    def suffix(self) -> str:
        return f"[{','.join(str(i + 1) for i in self.index)}]" if self.index else ""

    @property
    def name(self) -> str:
        return f"{self.effect}.{self.parameter}{self.suffix}"


Values = Mapping[str, Mapping[str, np.ndarray]]


@dataclass(frozen=True)
class Sensor:
    """A triad with a tuple of effects and the values of their coefficients (SI).

    ``values[effect][parameter]`` is an array of the parameter's shape; the effects are sorted by stage.
    Raises UserError for an effect that this kind of sensor does not have, and a value of the wrong shape, not finite, outside
    its bounds or on a diagonal that the parameter does not have.
    """

    kind: str
    values: Values = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise UserError(f"unknown sensor '{self.kind}'{units.did_you_mean(self.kind, KINDS)}; known are {', '.join(KINDS)}")
        complete = {}
        for e in sorted((_lookup(n, self.kind) for n in self.values), key=lambda e: (STAGES.index(e.stage), e.order)):
            complete[e.name] = MappingProxyType({**e.start(), **{k: _shaped(self.kind, e, k, v) for k, v in self.values[e.name].items()}})
        object.__setattr__(self, "values", MappingProxyType(complete))

    def __eq__(self, other: object) -> bool:
        """Equal kind, effects and coefficients; arrays have no truth value, so the dataclass cannot compare them itself."""
        if not isinstance(other, Sensor):
            return NotImplemented
        return (self.kind, self.slots) == (other.kind, other.slots) and np.array_equal(self.p, other.p)

    def __hash__(self) -> int:
        return hash((self.kind, self.slots, tuple(self.p)))

    def __reduce__(self):
        return Sensor, (self.kind, {e: dict(p) for e, p in self.values.items()})

    @property
    def effects(self) -> tuple[Effect, ...]:
        return tuple(CATALOGUE[n] for n in self.values)

    @property
    def signals(self) -> frozenset[str]:
        """Names in ``SIGNALS`` of what the sensor's effects need beside the signal that it measures."""
        return frozenset().union(*(e.signals(self.kind) for e in self.effects))

    @property
    def output(self) -> SensorKind:
        return KINDS[self.kind]

    def check(self, sample_period: float, name: str) -> None:
        """Raise UserError, which starts with ``name``, for coefficients that do not go with each other or with the sample period [s]."""
        if any(e.limits for e in self.effects):
            self.chain.limits.check(self.p, sample_period, name)

    def unit(self, template: str) -> str:
        """A unit of a definition, with the sensor's own units put in."""
        return self.output.units(template)

    def with_values(self, effect_name: str, **parameters) -> Sensor:
        """The same sensor with an effect added, or some of its coefficients changed."""
        values = {e: dict(p) for e, p in self.values.items()}
        values.setdefault(effect_name, {}).update(parameters)
        return replace(self, values=values)

    def without(self, *names: str) -> Sensor:
        return replace(self, values={e: p for e, p in self.values.items() if e not in names})

    def is_off(self, name: str) -> bool:
        """True for an effect that must be scanned for and stands where it does nothing: no slope leads away from there."""
        found = [(n, p) for n, p in CATALOGUE[name].parameters.items() if p.scan]
        return bool(found) and all(np.all(self.values[name][n] == p.start) for n, p in found)

    def acts(self, name: str) -> bool:
        """True for an effect that is not at the identity; coefficients that only shape one, or fix its origin, do not count."""
        sizes = [(n, p) for n, p in CATALOGUE[name].parameters.items() if not (p.form or p.reference)]
        return not self.is_off(name) and any(np.any(self.values[name][n] != p.start) for n, p in sizes)

    @property
    def left_in(self) -> tuple[str, ...]:
        """Names of the effects that act and that ``compensation`` leaves in: it neither solves them nor marks samples."""
        return tuple(e.name for e in self.effects if e.left_in and self.acts(e.name))

    @cached_property
    def slots(self) -> tuple[Slot, ...]:
        """Every coefficient in the order of the vector ``p``."""
        return tuple(Slot(e.name, n, i, self.unit(q.unit), q)
                     for e in self.effects for n, q in e.parameters.items() for i in q.indices)

    @cached_property
    def p(self) -> np.ndarray:
        """Values of the coefficients, shape (len(slots),)."""
        return np.array([self.values[s.effect][s.parameter][s.index] for s in self.slots], dtype=float)

    def with_p(self, p: np.ndarray) -> Sensor:
        """The same sensor with the coefficients of vector ``p``."""
        values = {e: {k: np.array(v) for k, v in q.items()} for e, q in self.values.items()}
        for slot, value in zip(self.slots, p, strict=True):
            values[slot.effect][slot.parameter][slot.index] = value
        return replace(self, values=values)

    @cached_property
    def variables(self) -> tuple[Variable, ...]:
        """The coefficients as variables of a block, named ``gyro_error.effect.parameter[i,j]``."""
        return tuple(Variable(f"{self.kind}_error.{s.name}", s.unit, _described(s), float(v), minimum=s.definition.minimum,
                              maximum=s.definition.maximum) for s, v in zip(self.slots, self.p, strict=True))

    @cached_property
    def noise(self) -> tuple[NoiseChannel, ...]:
        """Standard normals; a stream's number follows from its name alone, so another effect never shifts it."""
        names = [f"{self.kind}_error.{e.name}.{n}[{i + 1}]" for e in self.effects for n, w in e.noises.items()
                 for i in range(w.size)]
        return tuple(NoiseChannel(n, zlib.crc32(n.encode())) for n in names)

    @cached_property
    def chain(self) -> Chain:
        return _chain(self.kind, tuple(self.values))

    def simulate(self, recording: Recording, *, seed: int | None = 0) -> Recording:
        """The recording as this sensor would have measured it; see ``pyimu.simulation.simulate_recording``."""
        from pyimu.simulation import simulate_recording  # which needs this module
        return simulate_recording(self, recording, seed=seed)

    @property
    def step(self) -> ca.Function:
        """``(s, u, p, w, h) -> (s_next, y)``."""
        return self.chain.step

    @property
    def compensation(self) -> ca.Function:
        """``(s, y, u, p, h) -> (s_next, x, lost)``: the chain solved for its input with all noise zero.

        ``u`` (N_INPUT,) carries the environment (its own signal is ignored); ``lost`` (3,) is 1 where this sample says nothing
        of ``x``, as beyond the range or within a dead zone.  The effects in ``left_in`` (lag, delay, rounding) are not undone
        and mark nothing: with them ``x`` is the input behind the part's bandwidth, late by its delay, to within its rounding.
        """
        return self.chain.compensation


def _described(slot: Slot) -> str:
    e, text = CATALOGUE[slot.effect], slot.definition.description
    return f"{text or e.term}; {EVERY_SAMPLE}" if e.differences else text or e.term


def _filled() -> Mapping[str, Effect]:
    """The catalogue with its own effects in it, whoever imported this module first."""
    import pyimu.effects  # noqa: F401  (which needs this module)
    return CATALOGUE


def _lookup(name: str, kind: str) -> Effect:
    if name not in CATALOGUE and name not in _filled():
        raise UserError(f"unknown effect '{name}'{units.did_you_mean(name, CATALOGUE)}")
    if kind not in CATALOGUE[name].sensors:
        raise UserError(f"effect {name} does not belong to a {kind}")
    return CATALOGUE[name]


def _shaped(kind: str, e: Effect, parameter: str, value: Any) -> np.ndarray:
    if parameter not in e.parameters:
        raise UserError(f"effect {e.name} has no parameter '{parameter}'{units.did_you_mean(parameter, e.parameters)}; "
                        f"it has {', '.join(e.parameters)}")
    definition, where = e.parameters[parameter], f"{kind} {e.name}.{parameter}"
    try:
        array = np.array(value, dtype=float)
    except (TypeError, ValueError):
        raise UserError(f"{where} must be numbers of shape {definition.shape}, not {value!r}") from None
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
        found = f", not {array.tolist()} {KINDS[kind].units(e.parameters[parameter].unit)}" if array.ndim < 2 else ""
        raise UserError(f"{kind} {e.name}.{parameter} {fault}{found}")


@lru_cache(maxsize=128)
def _chain(kind: str, effects: tuple[str, ...]) -> Chain:
    return Chain(Sensor(kind, {name: {} for name in effects}))


class Chain:
    """The casadi functions of one sensor structure (which effects, not which values)."""

    def __init__(self, sensor: Sensor) -> None:
        self.sensor = sensor
        self.effects = sensor.effects
        self.u = ca.SX.sym("u", N_INPUT)
        self.h = ca.SX.sym("h")
        self.p = ca.SX.sym("p", len(sensor.slots))
        self.w = ca.SX.sym("w", len(sensor.noise))
        self.signals = {name: self.u[at] for name, at in COLUMNS.items()}
        self.signals[OWN_RATE] = self.signals[sensor.output.own_rate]
        self.x = self.signals[sensor.output.own]
        self.parameters = self._split_parameters()
        self.noises = self._split_noise()
        self.states, self.s = self._split_states()
        self.waits = any(isinstance(q.start, str) for e in self.effects for q in e.states.values())

    def _split_parameters(self) -> dict[str, dict[str, ca.SX]]:
        """Put the vector ``p`` into the matrices of the definitions; rows first, here and nowhere else."""
        slots = iter(ca.vertsplit(self.p)) if len(self.sensor.slots) else iter(())
        out: dict[str, dict[str, ca.SX]] = {}
        for e in self.effects:
            out[e.name] = {}
            for name, q in e.parameters.items():
                matrix = ca.SX.zeros(*(q.shape or (1,)))
                for index in q.indices:
                    matrix[index or 0] = next(slots)
                out[e.name][name] = matrix
        return out

    def _split_noise(self) -> dict[str, dict[str, ca.SX]]:
        out, at = {}, 0
        for e in self.effects:
            out[e.name] = {}
            for name, w in e.noises.items():
                out[e.name][name] = self.w[at:at + w.size]
                at += w.size
        return out

    def _split_states(self) -> tuple[dict[str, dict[str, ca.SX]], ca.SX]:
        symbols = {e.name: {n: ca.SX.sym(n, *q.shape) for n, q in e.states.items()} for e in self.effects}
        flat = [ca.vec(v) for group in symbols.values() for v in group.values()]
        return symbols, ca.vertcat(*flat) if flat else ca.SX.zeros(0, 1)

    def _current(self, e: Effect, x: ca.SX, started: ca.SX | None) -> dict[str, ca.SX]:
        """States of an effect, those that wait for the first input filled with it; one that is NaN still waits for its first."""
        out = {}
        for name, q in e.states.items():
            s = self.states[e.name][name]
            if isinstance(q.start, str):
                first = x if q.start == INPUT else self.signals[e.environment[q.start]]
                steady = ca.repmat(first.T, q.shape[0], 1) if len(q.shape) == 2 else first
                # All rows are filled together, so that the newest one, which is the first, speaks for all.
                begun = ca.logic_and(started, is_number(s[0, :] if len(q.shape) == 2 else s))
                s = ca.if_else(ca.repmat(begun, q.shape[0], 1) if len(q.shape) == 2 else begun, s, steady)
            out[name] = s
        return out

    @cached_property
    def step(self) -> ca.Function:
        started = ca.SX.sym("started") if self.waits else None
        x, following = self.x, []
        for e in self.effects:
            x, after = self._apply(e, x, self.noises[e.name], started)
            following.append(after)
        flag, one = ([started], [ca.SX(1)]) if self.waits else ([], [])
        return ca.Function(f"{self.sensor.kind}_step", [ca.vertcat(*flag, self.s), self.u, self.p, self.w, self.h],
                           [ca.vertcat(*one, *following), ca.densify(x)], ["s", "u", "p", "w", "h"], ["s_next", "y"])

    @cached_property
    def start(self) -> np.ndarray:
        """State before the first sample, as ``step`` takes it."""
        values = [np.full(int(np.prod(q.shape)), 0.0 if isinstance(q.start, str) else q.start)
                  for e in self.effects for q in e.states.values()]
        return np.concatenate([np.zeros(int(self.waits)), *values])

    @cached_property
    def compensation(self) -> ca.Function:
        started = ca.SX.sym("started") if self.waits else None
        measured = ca.SX.sym("y", 3)
        x, lost, following = measured, ca.SX.zeros(3), {}
        for e in reversed(self.effects):
            if e.lost is not None:
                lost = ca.fmax(lost, e.lost(x, **self.parameters[e.name]))
            if e.invertible:
                x = self._invert(e, x, started)
            elif e.restore is not None:
                x = e.restore(x, **self.parameters[e.name])
            following[e.name] = self._call(e, x, started)[1]
        ordered = [following[e.name] for e in self.effects]
        flag, one = ([started], [ca.SX(1)]) if self.waits else ([], [])
        return ca.Function(f"{self.sensor.kind}_compensation",
                           [ca.vertcat(*flag, self.s), measured, self.u, self.p, self.h],
                           [ca.vertcat(*one, *ordered), ca.densify(x), ca.densify(lost)],
                           ["s", "y", "u", "p", "h"], ["s_next", "x", "lost"])

    def _apply(self, e: Effect, x: ca.SX, w: Mapping, started: ca.SX | None) -> tuple[ca.SX, ca.SX]:
        """Output of an effect and its following states in one column.

        A state that follows from inputs keeps its value where it would become NaN: the output shows that an input is missing,
        the memory has never heard of it.
        """
        states = self._current(e, x, started)
        y, update = e(x, self.parameters[e.name], states, w, {**self.signals, self.sensor.output.own: x}, self.h)
        before, after = ([ca.vec(ca.densify(ca.SX(group[n]))) for n in e.states] for group in (states, update))
        pairs = zip(ca.vertsplit(ca.vertcat(*before)), ca.vertsplit(ca.vertcat(*after)), self._fed(e), strict=True) if e.states else ()
        return y, ca.vertcat(ca.SX(0, 1), *[kept(now, then) if fed else now for then, now, fed in pairs])

    def _call(self, e: Effect, x: ca.SX, started: ca.SX | None) -> tuple[ca.SX, ca.SX]:
        silent = {n: ca.SX.zeros(w.size) for n, w in e.noises.items()}
        return self._apply(e, x, silent, started)

    def _fed(self, e: Effect) -> list[bool]:
        """Which numbers of an effect's states follow from inputs of this sample; the others, from noise and older states, are numbers."""
        x = ca.SX.sym("x", 3)
        _, update = e(x, self.parameters[e.name], self.states[e.name], self.noises[e.name], {**self.signals, self.sensor.output.own: x}, self.h)
        column = ca.vertcat(*[ca.vec(ca.densify(ca.SX(update[n]))) for n in e.states])
        rows = set(ca.jacobian_sparsity(column, ca.vertcat(x, self.u)).row())
        return [i in rows for i in range(column.numel())]

    @cached_property
    def limits(self) -> Limits | None:
        """What the coefficients must keep together, and with the sample period; None where there is nothing of the kind."""
        found = [(f"{self.sensor.kind} {e.name}: {text}", broken(self.h, **self.parameters[e.name]))
                 for e in self.effects for text, broken in e.limits.items()]
        if not found:
            return None
        flags = ca.Function("limits", [self.p, self.h], [ca.densify(ca.vertcat(*[flag for _, flag in found]))], ["p", "h"], ["broken"])
        return Limits(tuple(text for text, _ in found), flags)

    def _invert(self, e: Effect, y: ca.SX, started: ca.SX | None) -> ca.SX:
        """Solve ``e(x) = y`` for x: one linear solve where the effect is affine in x, else Newton from ``x = y``."""
        x = ca.SX.sym("x", 3)
        out, _ = self._call(e, x, started)
        slope = ca.jacobian(out, x)
        if ca.is_equal(slope, ca.SX.eye(3), 1):
            return y - ca.substitute(out, x, ca.SX.zeros(3))
        improved = x - _solve(slope, out - y)
        guess = y
        for _ in range(1 if not ca.depends_on(slope, x) else NEWTON_STEPS):
            guess = ca.substitute(improved, x, guess)
        return guess


def _solve(a: ca.SX, b: ca.SX) -> ca.SX:
    """a^-1 b of a 3 x 3 system by the adjugate, elementwise where ``a`` is diagonal."""
    if a.sparsity().is_diag():
        return b / ca.diag(a)
    r = [ca.densify(a[i, :]).T for i in range(3)]
    c = [ca.cross(r[1], r[2]), ca.cross(r[2], r[0]), ca.cross(r[0], r[1])]
    return ca.horzcat(*c) @ b / ca.dot(r[0], c[0])


def candidates(kind: str, present: Iterable[str]) -> tuple[Effect, ...]:
    """Effects of the catalogue that a sensor of this kind could have and ``present`` does not name."""
    have = set(present)
    return tuple(e for e in _filled().values() if kind in e.sensors and e.name not in have)
