"""One sensor error effect is one symbolic function; the rest of the package derives everything else
from it.

An effect is written as a function of the sensor's input ``x`` (3,), whose annotated arguments say
what else it needs::

    @effect(stage="bias", equation=r"y = x + G f", source="IEEE Std 528-2019, g-sensitive drift")
    def g_sensitivity(x, G: Parameter("{y}/(m/s^2)", (3, 3)), f: Environment("specific_force")):
        return x + G @ f

``pyimu.model.sensor.Sensor`` is a chain of such effects, sorted by stage. Its step is the pure
function ``(s, u, p, w, h) -> (s_next, y)`` of state, input, parameters, standard normals and sample
period. In a unit, ``{y}`` stands for the unit of the sensor's output and ``{Y}`` for that of its
integral, so that gyro and accelerometer triads share one definition.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType
from typing import Any

import casadi as ca
import numpy as np

from pyimu import units
from pyimu.errors import UserError
from pyimu.model.signals import COLUMNS, SIGNALS, is_number, kept  # noqa: F401 (for effects)

STAGES = ("motion", "dynamics", "gain", "bias", "noise", "output")
"""The order in which effects act on a sample: the motion that reaches the element, its dynamics,
gain, bias, noise, output."""

INPUT = "input"
"""Start of a state that begins as if the first input had always been there."""


@dataclass(frozen=True)
class SensorKind:
    """A triad: which signal it measures, that signal's rate, its unit, and the unit of its
    integral.
    """

    name: str
    own: str
    own_rate: str
    unit: str
    integral: str

    def units(self, template: str) -> str:
        """A unit of a definition, with the triad's own units put in."""
        return template.replace("{y}", self.unit).replace("{Y}", self.integral)


KINDS = {
    "gyro": SensorKind("gyro", "rate", "angular_acceleration", "rad/s", "rad"),
    "accel": SensorKind("accel", "specific_force", "jerk", "m/s^2", "m/s"),
}

OWN = {kind: COLUMNS[k.own] for kind, k in KINDS.items()}
"""Where a sensor's own signal stands in the input vector."""

OWN_RATE = "own_rate"
"""Name of the rate of the sensor's own signal among an effect's environment: angular acceleration
or jerk."""


@dataclass(frozen=True)
class Scan:
    """Where to look for a coefficient that no slope at the identity finds: ``points`` values,
    evenly in logarithm.

    ``low`` and ``high`` count sample periods ("period"), radians a sample ("rate") or shares of the
    largest input ("range").
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
    """A coefficient. ``start`` is where the effect is the identity; matrices may leave out their
    diagonal.

    ``reference`` marks a coefficient that only fixes an origin (a reference temperature): it is
    never estimated. ``form`` marks one that shapes an effect whose size others give (a time
    constant, an instant): it acts only where they do. ``known`` is the one value, beside zero,
    that it can have. ``scan`` says where identification starts its search where the identity has no
    slope to follow.
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
        """What is wrong with values of the parameter's shape in its SI unit, as "must not be below
        0"; empty where nothing is.
        """
        if not np.all(np.isfinite(values)):
            return "must be finite"
        if self.minimum is not None and np.any(values < self.minimum):
            return f"must not be below {self.minimum:g}"
        if self.maximum is not None and np.any(values > self.maximum):
            return f"must not be above {self.maximum:g}"
        return (
            "must have zeros on its diagonal"
            if not self.diagonal and np.any(np.diag(values))
            else ""
        )


@dataclass(frozen=True)
class State:
    """Memory of an effect; ``start`` is a number, ``INPUT`` for the steady state at the first input
    of the effect, or the name of one of the effect's environment arguments for that signal's first
    value.
    """

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

    The signal that the sensor itself measures means the effect's own input: a sensor knows it
    through nothing else.
    """

    signal: str


@dataclass(frozen=True)
class SamplePeriod:
    """The sample period in seconds."""


@dataclass(frozen=True, eq=False)
class Effect:
    """One error effect and what its definition says about it.

    ``smooth`` is False where the output has steps or corners in ``x`` that no regressor describes;
    ``invertible`` is False where the input cannot be had back from every output:
    ``lost(y, **parameters)`` then marks the samples that say nothing of it, and
    ``restore(y, **parameters)`` gives the input of the others where it is not the output itself;
    one without marks is left in. ``limits`` are what several parameters, or one and the sample
    period, must keep: a text, and ``broken(h, **parameters)``.
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
    parameters: Mapping[str, Parameter] = field(repr=False)
    states: Mapping[str, State] = field(repr=False)
    noises: Mapping[str, Noise] = field(repr=False)
    environment: Mapping[str, str] = field(repr=False)
    period: str | None = None
    file: str = ""
    """The file of the user's own that defines it; empty for one of the catalogue."""

    @property
    def stochastic(self) -> bool:
        return bool(self.noises)

    @property
    def remembers(self) -> bool:
        """True where the output without noise depends on what was before, and not as a linear
        filter of the input does.
        """
        return bool(self.states) and not self.stochastic and self.stage != "dynamics"

    @property
    def left_in(self) -> bool:
        """True where compensation neither solves the effect for its input nor marks samples: what
        it does stays in.
        """
        return not self.invertible and self.lost is None

    @property
    def differences(self) -> bool:
        """True where the effect follows from the difference of successive inputs, and is zero where
        they are held.
        """
        return any(s == OWN_RATE or SIGNALS[s].difference for s in self.environment.values())

    def signals(self, kind: str) -> frozenset[str]:
        """Names in ``SIGNALS`` of what the effect needs beside the signal that a sensor of this
        kind measures.
        """
        named = (KINDS[kind].own_rate if s == OWN_RATE else s for s in self.environment.values())
        return frozenset(named) - {KINDS[kind].own}

    def start(self) -> dict[str, np.ndarray]:
        """Start values of all parameters: the identity."""
        return {n: np.full(p.shape, p.start) for n, p in self.parameters.items()}

    def __call__(
        self, x: ca.SX, p: Mapping, s: Mapping, w: Mapping, u: Mapping, h: ca.SX
    ) -> tuple[ca.SX, dict]:
        """Output (3,) and following states for input ``x`` (3,); the mappings hold casadi matrices
        by argument name.
        """
        arguments = {
            **p,
            **s,
            **w,
            **{name: u[signal] for name, signal in self.environment.items()},
        }
        if self.period:
            arguments[self.period] = h
        result = self.function(x, **arguments)
        return result if isinstance(result, tuple) else (result, {})


def effect(
    *,
    stage: str,
    equation: str,
    source: str,
    term: str,
    sensors: tuple[str, ...] = ("gyro", "accel"),
    smooth: bool = True,
    invertible: bool = True,
    lost: Callable | None = None,
    restore: Callable | None = None,
    limits: Mapping[str, Callable] = MappingProxyType({}),
) -> Callable[[Callable], Effect]:
    """Make an ``Effect`` of a function; ``pyimu.add_effects`` makes one known by its name.

    ``term`` is the field's name of it, ``source`` the document that the equation is from (or "no
    source"). Raises ValueError where the stage is unknown or an argument has no annotation, and
    UserError, which is one, where a kind of sensor, a signal or a unit does not exist.
    """

    def define(function: Callable) -> Effect:
        name = function.__name__
        if stage not in STAGES:
            raise ValueError(
                f"effect {name}: unknown stage {stage!r}, not one of {', '.join(STAGES)}"
            )
        for kind in sensors:
            _known(name, "sensor", kind, KINDS)
        return Effect(
            name,
            stage,
            equation,
            source,
            term,
            sensors,
            function,
            smooth,
            invertible,
            lost,
            restore,
            MappingProxyType(dict(limits)),
            **_arguments(name, function),
        )

    return define


def _arguments(name: str, function: Callable) -> dict[str, Any]:
    """Sort the annotated arguments of an effect's function by what they are."""
    groups: dict[type, dict] = {
        Parameter: {},
        State: {},
        Noise: {},
        Environment: {},
        SamplePeriod: {},
    }
    for argument in list(inspect.signature(function).parameters.values())[1:]:
        if type(argument.annotation) not in groups:
            raise ValueError(
                f"effect {name}: argument {argument.name} needs a Parameter, State, Noise, "
                "Environment or SamplePeriod"
            )
        groups[type(argument.annotation)][argument.name] = argument.annotation
        _checked(name, argument.name, argument.annotation)
    return {
        "parameters": MappingProxyType(groups[Parameter]),
        "states": MappingProxyType(groups[State]),
        "noises": MappingProxyType(groups[Noise]),
        "environment": MappingProxyType({n: e.signal for n, e in groups[Environment].items()}),
        "period": next(iter(groups[SamplePeriod]), None),
    }


def _checked(name: str, argument: str, annotation: Any) -> None:
    """Refuse a signal or a unit that does not exist where the effect is made, not where it is first
    used.
    """
    if isinstance(annotation, Environment):
        _known(name, "signal", annotation.signal, (*SIGNALS, OWN_RATE))
    if isinstance(annotation, (Parameter, State)):
        try:
            units.parse(KINDS["gyro"].units(annotation.unit))
        except units.UnitError as error:
            raise UserError(f"effect {name}: {argument}: {error}") from None


def _known(name: str, what: str, found: str, known: Iterable[str]) -> None:
    if found not in known:
        raise UserError(
            f"effect {name}: unknown {what} '{found}'{units.did_you_mean(found, known)}; known are "
            f"{', '.join(known)}"
        )
