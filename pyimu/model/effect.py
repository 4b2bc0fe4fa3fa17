"""An effect: one symbolic function for one sensor error, from which all else is derived.

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
from types import MappingProxyType
from typing import Any

import casadi as ca
import numpy as np

from pyimu import units
from pyimu.errors import UserError
from pyimu.model.arguments import (
    INPUT,
    Environment,
    Noise,
    Parameter,
    SamplePeriod,
    Scan,
    State,
)
from pyimu.model.kinds import KINDS, MAGNETOMETER, OWN_RATE, STAGES, TRIADS
from pyimu.model.law import Law
from pyimu.model.signals import SIGNALS
from pyimu.symbolic.missing import is_number, kept

__all__ = [
    "INPUT",
    "OWN_RATE",
    "Confound",
    "Effect",
    "Environment",
    "Law",
    "Noise",
    "Parameter",
    "SamplePeriod",
    "Scan",
    "State",
    "effect",
    "is_number",
    "kept",
]


@dataclass(frozen=True)
class Confound:
    """What no log tells an effect from, and what a measurement needs to tell them ``apart``."""

    of: str
    apart: str


@dataclass(frozen=True, eq=False)
class Effect:
    """One error effect and what its definition says about it.

    ``smooth`` is False where the output has steps or corners in ``x`` that no regressor describes;
    ``invertible`` is False where the input cannot be had back from every output:
    ``lost(y, **parameters)`` then marks the samples that say nothing of it, and
    ``restore(y, **parameters)`` gives the input of the others where it is not the output itself;
    one without marks is left in. It is of the kinds ``sensors``, and where it is ``magnetic`` a
    magnetometer may have it as well. ``limits`` are what several parameters, or one and the sample
    period, must keep: a text, and ``broken(h, **parameters)``. ``law`` says what the noise is that
    it makes.

    ``per_power_on`` marks what is drawn anew at each power-on, so that it belongs to a log and not
    to the part; ``mounting`` what holds a turn of the whole triad among its values. The
    effects of one ``family`` are forms of one error: a model has one of them, that for which the
    data speak. No log tells an effect from its ``confound``, which is said beside
    it wherever it is named (of ``mounting`` only where the reference's axes are not known).
    ``grows`` is True where the inverse, solved sample by sample, feeds on what it restored before
    and can grow without bound: the attitude filter then solves it in rounds.
    ``delay(**parameters)`` is the delay [s] by which an effect holds slow input back,
    ``clock(**parameters)`` the relative error of the sensor's clock: both say when a sample was
    taken, not what it holds. ``symptom`` says what a sensor does that has the effect ("clips"), and
    ``phrase`` how the effect is said before its coefficient ("saturation at").
    """

    name: str
    stage: str
    equation: str
    source: str
    term: str
    sensors: tuple[str, ...]
    magnetic: bool
    function: Callable[..., Any]
    smooth: bool
    invertible: bool
    lost: Callable[..., Any] | None
    restore: Callable[..., Any] | None
    grows: bool
    limits: Mapping[str, Callable[..., Any]]
    law: Law | None
    per_power_on: bool
    mounting: bool
    family: str
    delay: Callable[..., Any] | None
    clock: Callable[..., Any] | None
    symptom: str
    phrase: str
    confound: Confound | None
    parameters: Mapping[str, Parameter] = field(repr=False)
    states: Mapping[str, State] = field(repr=False)
    noises: Mapping[str, Noise] = field(repr=False)
    environment: Mapping[str, str] = field(repr=False)
    period: str | None = None
    file: str = ""
    """The file of the user's own that defines it; empty for one of the catalogue."""

    def __repr__(self) -> str:
        """``Effect('g_sensitivity', bias: G [{y}/(m/s^2)]; y = x + G f)``."""
        own = ", ".join(f"{name} [{q.unit}]" for name, q in self.parameters.items())
        return f"Effect({self.name!r}, {self.stage}: {own or 'no coefficient'}; {self.equation})"

    @property
    def is_line(self) -> bool:
        """Whether it is a line of the spectrum, whose frequency is looked for."""
        return self._scans("line")

    @property
    def has_events(self) -> bool:
        """Whether it happens at instants, which are looked for."""
        return self._scans("instant")

    def _scans(self, measure: str) -> bool:
        scans = (p.scan for p in self.parameters.values())
        return any(s is not None and s.measure == measure for s in scans)

    @property
    def stochastic(self) -> bool:
        return bool(self.noises)

    @property
    def remembers(self) -> bool:
        """True where the noise-free output depends on the past other than by a linear filter."""
        return bool(self.states) and not self.stochastic and self.stage != "dynamics"

    @property
    def left_in(self) -> bool:
        """True where compensation neither inverts the effect nor marks its samples.

        The effect then stays in the compensated output.
        """
        return not self.invertible and self.lost is None

    def reading(self, what: str) -> str | None:
        """Name of its coefficient that is read off raw samples as ``what``; None without."""
        return next((n for n, q in self.parameters.items() if q.reads == what), None)

    @property
    def differences(self) -> bool:
        """True where the effect follows from the difference of successive inputs.

        Such an effect is zero where the inputs are held.
        """
        return any(s == OWN_RATE or SIGNALS[s].difference for s in self.environment.values())

    def signals(self, kind: str) -> frozenset[str]:
        """Names in ``SIGNALS`` that the effect needs beside what this kind of sensor measures."""
        triad = TRIADS[kind]
        named = (triad.own_rate if s == OWN_RATE else s for s in self.environment.values())
        return frozenset(named) - {triad.own}

    @property
    def triads(self) -> tuple[str, ...]:
        """The kinds of triads that may have it: ``sensors``, and the magnetometer."""
        return (*self.sensors, MAGNETOMETER) if self.magnetic else self.sensors

    def start(self) -> dict[str, np.ndarray]:
        """Start values of all parameters: the identity."""
        return {n: np.full(p.shape, p.start) for n, p in self.parameters.items()}

    def __call__(
        self, x: ca.SX, p: Mapping, s: Mapping, w: Mapping, u: Mapping, h: ca.SX
    ) -> tuple[ca.SX, dict]:
        """Output (3,) and next states for input ``x`` (3,).

        The mappings hold casadi matrices by argument name.
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
    magnetic: bool = False,
    smooth: bool = True,
    invertible: bool = True,
    lost: Callable | None = None,
    restore: Callable | None = None,
    grows: bool = False,
    limits: Mapping[str, Callable] = MappingProxyType({}),
    law: Law | None = None,
    per_power_on: bool = False,
    mounting: bool = False,
    family: str = "",
    delay: Callable | None = None,
    clock: Callable | None = None,
    symptom: str = "",
    phrase: str = "",
    confound: Confound | None = None,
) -> Callable[[Callable], Effect]:
    """Make an ``Effect`` of a function; ``pyimu.add_effects`` makes one known by its name.

    ``term`` is the field's name of it, ``source`` the document that the equation is from (or "no
    source"). Raises ValueError where the stage is unknown or an argument has no annotation, and
    UserError, which is one, where a kind of sensor, a signal or a unit does not exist.
    """

    def define(function: Callable) -> Effect:
        name = function.__name__
        _check(name, stage, sensors)
        return Effect(
            name=name,
            stage=stage,
            equation=equation,
            source=source,
            term=term,
            sensors=sensors,
            magnetic=magnetic,
            function=function,
            smooth=smooth,
            invertible=invertible,
            lost=lost,
            restore=restore,
            grows=grows,
            limits=MappingProxyType(dict(limits)),
            law=law,
            per_power_on=per_power_on,
            mounting=mounting,
            family=family,
            delay=delay,
            clock=clock,
            symptom=symptom,
            phrase=phrase or f"{name.replace('_', ' ')} of",
            confound=confound,
            **_arguments(name, function),
        )

    return define


def _check(name: str, stage: str, sensors: tuple[str, ...]) -> None:
    """Raises ValueError for an unknown stage, UserError for an unknown kind of sensor."""
    if stage not in STAGES:
        raise ValueError(f"effect {name}: unknown stage {stage!r}, not one of {', '.join(STAGES)}")
    for kind in sensors:
        _known(name, "sensor", kind, KINDS)


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
    """Refuse a signal or a unit that does not exist when the effect is defined.

    Otherwise the error would come only where it is first used.
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
