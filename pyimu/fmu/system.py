"""A system of FMUs: which units, wired how, with which parameters; checked before anything runs.

``ssp`` writes it for other simulators, ``cosimulate`` runs it here.
"""

from __future__ import annotations

import math
import zipfile
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from fmpy.model_description import (
    BaseUnit,
    ModelDescription,
    ModelVariable,
    read_model_description,
)

from pyimu.errors import UserError
from pyimu.fmu.arrays import split_name
from pyimu.units import did_you_mean

TYPES = {
    "Real": "Real",
    "Float64": "Real",
    "Integer": "Integer",
    "Int32": "Integer",
    "UInt64": "Integer",
    "Boolean": "Boolean",
}
"""The types of FMI 2 and 3 as SSP 1.0 has them."""

WHOLE = 1e-9
"""How far a sample period may be from a whole number of steps: in 1e9 steps, which are 12 days at
976 Hz, a sample falls into the step beside its own."""

Value = float | int | bool


@dataclass(frozen=True)
class Component:
    """A unit of a system: its name there, its FMU, and the values of its parameters."""

    name: str
    fmu: Path
    parameters: Mapping[str, Value] = field(default_factory=dict)

    @cached_property
    def description(self) -> ModelDescription:
        """Raises UserError where the FMU is missing or is none."""
        if not self.fmu.is_file():
            raise UserError(f"{self.name}: {self.fmu} is missing; pyimu build makes the units")
        try:
            return read_model_description(str(self.fmu), validate=False)
        except (zipfile.BadZipFile, KeyError, OSError) as error:
            raise UserError(f"{self.name}: {self.fmu} is no FMU ({error})") from None

    @cached_property
    def variables(self) -> dict[str, ModelVariable]:
        return {v.name: v for v in self.description.modelVariables}

    @property
    def outputs(self) -> list[ModelVariable]:
        return [v for v in self.variables.values() if v.causality == "output"]

    def base_unit(self, unit: str) -> BaseUnit | None:
        return next((u.baseUnit for u in self.description.unitDefinitions if u.name == unit), None)

    def elements(self, name: str, causality: str) -> list[ModelVariable]:
        """The variable, or the elements of the array, of this name.

        Raises UserError where there is none of this causality.
        """
        named = [v for v in self.variables.values() if name in (v.name, split_name(v.name)[0])]
        found = [v for v in named if v.causality == causality]
        if not found:
            known = {
                n
                for v in self.variables.values()
                if v.causality == causality
                for n in (v.name, split_name(v.name)[0])
            }
            why = f": it is {named[0].causality}" if named else did_you_mean(name, sorted(known))
            raise UserError(f"{self.name} has no {causality} {name}{why}")
        return found

    def value(self, name: str) -> float | None:
        """A parameter's value: the given one, else its start; None where it has no such one."""
        if name in self.parameters:
            return float(self.parameters[name])
        return float(self.variables[name].start) if name in self.variables else None


@dataclass(frozen=True)
class Wire:
    """One scalar from an output to an input."""

    start: Component
    output: ModelVariable
    end: Component
    input: ModelVariable

    def __str__(self) -> str:
        return f"{self.start.name}.{self.output.name} -> {self.end.name}.{self.input.name}"


@dataclass(frozen=True)
class System:
    """Units, and connections ``("Sensor.gyro", "Filter.gyro")`` of variables or whole vectors.

    ``step_size`` is the step of communication [s], ``stop_time`` [s] how long a run takes where
    nobody says.

    Raises UserError for units that are missing, share a name, or share a seed; for wrong wiring:
    names that a unit does not have, an input fed twice, ends of other types, sizes or units; for
    parameters that a unit does not have or does not take; and for a step that does not divide a
    unit's sample period.
    """

    name: str
    components: tuple[Component, ...]
    connections: tuple[tuple[str, str], ...]
    step_size: float
    stop_time: float = 10.0

    def __post_init__(self) -> None:
        names = [c.name for c in self.components]
        twice = sorted({n for n in names if names.count(n) > 1})
        if twice:
            raise UserError(f"system {self.name}: more than one unit is called {twice[0]}")
        for component in self.components:
            for name, value in component.parameters.items():
                _check_parameter(component, name, value)
            self._check_step(component)
        _check_seeds(self.components)
        _check_wires(self.wires)

    @cached_property
    def wires(self) -> tuple[Wire, ...]:
        """Every connection, element by element."""
        return tuple(wire for start, end in self.connections for wire in self._wires(start, end))

    @cached_property
    def outputs(self) -> dict[str, tuple[Component, ModelVariable]]:
        """Every output of every unit by its name in the system, ``Filter.roll``."""
        return {f"{c.name}.{v.name}": (c, v) for c in self.components for v in c.outputs}

    def output(self, name: str) -> tuple[Component, ModelVariable]:
        """Raises UserError where there is none of this name."""
        if name not in self.outputs:
            raise UserError(
                f"system {self.name} has no output {name}{did_you_mean(name, self.outputs)}"
            )
        return self.outputs[name]

    def _wires(self, start: str, end: str) -> Iterable[Wire]:
        (one, output), (other, name) = self._end(start), self._end(end)
        outputs, inputs = one.elements(output, "output"), other.elements(name, "input")
        if len(outputs) != len(inputs):
            raise UserError(
                f"{start} -> {end}: {len(outputs)} outputs do not fit {len(inputs)} inputs"
            )
        return [Wire(one, o, other, i) for o, i in zip(outputs, inputs, strict=True)]

    def _end(self, text: str) -> tuple[Component, str]:
        unit, _, name = text.partition(".")
        known = {c.name: c for c in self.components}
        if unit not in known:
            raise UserError(
                f"system {self.name}: {text}: there is no unit {unit}{did_you_mean(unit, known)}"
            )
        return known[unit], name

    def _check_step(self, component: Component) -> None:
        step, period = self.step_size, component.value("sample_period")
        if not (step > 0.0 and math.isfinite(step)):
            raise UserError(f"system {self.name}: a step of {step:g} s is not possible")
        if period is None:
            return
        steps = period / step
        if round(steps) < 1 or abs(steps - round(steps)) > WHOLE * steps:
            raise UserError(
                f"system {self.name}: a step of {step:.12g} s does not divide the sample period of "
                f"{component.name}, {period:.12g} s; take {period / max(round(steps), 1):.12g} s"
            )


def _check_parameter(component: Component, name: str, value: Value) -> None:
    own = {n: v for n, v in component.variables.items() if v.causality == "parameter"}
    if name not in own:
        raise UserError(f"{component.name} has no parameter {name}{did_you_mean(name, own)}")
    variable, what = own[name], f"{component.name}: parameter {name} = {value!r}"
    kind = TYPES.get(variable.type)
    if kind == "Boolean" and not isinstance(value, bool):
        raise UserError(f"{what} must be True or False")
    if kind == "Integer" and (isinstance(value, bool) or value != int(value)):
        raise UserError(f"{what} must be a whole number")
    number = float(value)
    low, high = (
        float(text) if text is not None else limit
        for text, limit in ((variable.min, -math.inf), (variable.max, math.inf))
    )
    if kind == "Integer":
        # FMI 2 and SSP 1.0 have no larger one; fmpy reads no bounds of unsigned ones.
        high, low = min(high, 2.0**31 - 1), max(low, 0.0) if variable.type == "UInt64" else low
    if not (math.isfinite(number) and low <= number <= high):
        unit = f" {variable.unit}" if variable.unit else ""
        raise UserError(f"{what} must be a number in {low:g} to {high:g}{unit}")


def _check_seeds(components: Iterable[Component]) -> None:
    seen: dict[tuple[str, float], str] = {}
    for c in components:
        if seed := c.value("seed"):  # none, and 0, which stands for the instance's name, are alone
            other = seen.setdefault((c.description.modelName, seed), c.name)
            if other != c.name:
                raise UserError(
                    f"{other} and {c.name} have the same seed {seed:.0f}: their noise would be the "
                    "same; give each its own, or none"
                )


def _check_wires(wires: Iterable[Wire]) -> None:
    fed: dict[tuple[str, str], Wire] = {}
    for wire in wires:
        kinds = [TYPES.get(v.type, str(v.type)) for v in (wire.output, wire.input)]
        if kinds[0] != kinds[1]:
            raise UserError(f"{wire}: a {kinds[0]} cannot feed a {kinds[1]}")
        if wire.output.unit != wire.input.unit:
            raise UserError(f"{wire}: {wire.output.unit} is not {wire.input.unit}")
        other = fed.setdefault((wire.end.name, wire.input.name), wire)
        if other is not wire:
            raise UserError(f"{wire.end.name}.{wire.input.name} is fed twice: {other}, {wire}")
