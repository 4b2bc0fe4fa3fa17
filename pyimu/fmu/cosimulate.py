"""A system of FMUs run here: every unit makes its step, then outputs become inputs (Jacobi).

Thin over fmpy, and slow: a call for each unit and each kind of value in every step. It is what the
results of other simulators are compared with; see ``docs/simulators.md``.
"""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from ctypes import byref
from typing import Any

import fmpy
import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE
from fmpy.fmi3 import FMU3Slave
from fmpy.logging import addLoggerProxy
from fmpy.model_description import ModelVariable

from pyimu.errors import UserError
from pyimu.fmu.system import Component, System


def cosimulate(system: System, steps: int, wanted: Sequence[str] = ()) -> dict[str, np.ndarray]:
    """Outputs (steps + 1,) by name, ``Filter.roll``, of a system that makes so many steps.

    Row 0 is what is shown after initialization, in which values are exchanged until each unit has
    seen what all others start with; row k is what is shown after step k, whose inputs are the
    outputs of row k - 1. Without names in ``wanted`` all outputs are kept.

    Raises UserError for an output that is none, and where a unit refuses, with its message.
    """
    kept = {name: system.output(name) for name in wanted} if wanted else system.outputs
    rows = {
        name: np.empty(steps + 1, dtype=bool if v.type == "Boolean" else float)
        for name, (_, v) in kept.items()
    }
    with ExitStack() as stack:
        running = {c.name: stack.enter_context(_running(c)) for c in system.components}
        _initialize(system, running)
        for k in range(steps + 1):
            if k:
                for unit in running.values():
                    unit.step((k - 1) * system.step_size, system.step_size)
            for name, (c, v) in kept.items():
                rows[name][k] = running[c.name].get(v)
            _exchange(system, running)
    return rows


def _initialize(system: System, running: Mapping[str, _Unit]) -> None:
    for unit in running.values():
        unit.enter_initialization()
    for _ in system.components:  # a chain of all of them is passed through then
        _exchange(system, running)
    for unit in running.values():
        unit.exit_initialization()


def _exchange(system: System, running: Mapping[str, _Unit]) -> None:
    values = [running[w.start.name].get(w.output) for w in system.wires]
    for wire, value in zip(system.wires, values, strict=True):
        running[wire.end.name].set(wire.input, value)


class _Unit:
    """An instance with its parameters set; an error of it carries what it last said."""

    def __init__(self, component: Component, fmu: Any) -> None:
        self.component, self.fmu = component, fmu
        self.said = ""
        self.callbacks: Any = None

    def hear(self, *message: Any) -> None:
        self.said = message[-1].decode()

    def enter_initialization(self) -> None:
        with self._refusals():
            if isinstance(self.fmu, FMU2Slave):
                self.fmu.setupExperiment(startTime=0.0)
            for name, value in self.component.parameters.items():
                self.set(self.component.variables[name], value)
            self.fmu.enterInitializationMode()

    def exit_initialization(self) -> None:
        with self._refusals():
            self.fmu.exitInitializationMode()

    def step(self, time: float, size: float) -> None:
        with self._refusals():
            self.fmu.doStep(currentCommunicationPoint=time, communicationStepSize=size)

    def get(self, variable: ModelVariable) -> Any:
        return getattr(self.fmu, f"get{variable.type}")([variable.valueReference])[0]

    def set(self, variable: ModelVariable, value: Any) -> None:
        with self._refusals():
            kind = float if variable.type in ("Real", "Float64") else int
            getattr(self.fmu, f"set{variable.type}")([variable.valueReference], [kind(value)])

    @contextmanager
    def _refusals(self) -> Iterator[None]:
        try:
            yield
        except FMICallException as error:
            raise UserError(f"{self.component.name}: {self.said or error}") from None


@contextmanager
def _running(component: Component) -> Iterator[_Unit]:
    """An instance, not yet initialized; it and its folder are gone afterwards."""
    description = component.description
    folder = fmpy.extract(str(component.fmu))
    try:
        given: Mapping[str, Any] = {
            "guid": description.guid,
            "unzipDirectory": folder,
            "instanceName": component.name,
            "modelIdentifier": description.coSimulation.modelIdentifier,
        }
        two = description.fmiVersion.startswith("2")
        unit = _Unit(component, FMU2Slave(**given) if two else FMU3Slave(**given))
        _instantiate(unit, two)
        try:
            yield unit
        finally:
            unit.fmu.freeInstance()
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _instantiate(unit: _Unit, two: bool) -> None:
    if not two:
        unit.fmu.instantiate(logMessage=lambda *message: unit.hear(*message))
        return
    unit.callbacks = fmi2CallbackFunctions()
    unit.callbacks.logger = fmi2CallbackLoggerTYPE(lambda *message: unit.hear(*message))
    addLoggerProxy(byref(unit.callbacks))
    unit.fmu.instantiate(callbacks=unit.callbacks)
