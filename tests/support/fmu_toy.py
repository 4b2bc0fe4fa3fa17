"""A block that has one of everything, and an FMU instance of any form under one set of names."""

import shutil
from ctypes import byref
from dataclasses import dataclass, field
from pathlib import Path

import casadi as ca
import numpy as np
from fmpy import extract, fmi2, fmi3, read_model_description
from fmpy.logging import addLoggerProxy

from pyimu.block.block import Block
from pyimu.block.variables import NoiseChannel, Variable
from pyimu.fmu.arrays import split_name

RATE = 976.0
CHANNELS = (7, 2**32 - 5)


def toy(name="Toy", sample_period=1 / RATE, unit="rad/s") -> Block:
    """Nonlinear, with state, noise, a matrix that is not symmetric, and variables of every kind."""
    s, u, p = ca.SX.sym("s", 3), ca.SX.sym("u", 4), ca.SX.sym("p", 8)
    w, h = ca.SX.sym("w", 2), ca.SX.sym("h")
    rate, temperature, counting, gear = ca.vertsplit(u)
    M, (N, K, b0, doubled) = ca.reshape(p[:4], 2, 2).T, ca.vertsplit(p[4:])
    walk, angle, ticks = ca.vertsplit(s)
    x = ca.mtimes(
        M,
        ca.vertcat(ca.sin(rate) + ca.cos(rate) * ca.sin(angle), ca.sqrt(ca.fabs(temperature) + 1)),
    )
    y = x + ca.vertcat(walk + N * w[0] / ca.sqrt(h), ca.cos(angle)) * ca.if_else(doubled, 2, 1)
    following = ca.vertcat(
        walk + K * ca.sqrt(h) * w[1], angle + h * rate, ticks + ca.if_else(counting, gear, 0)
    )
    step = ca.Function("step", [s, u, p, w, h], [following, ca.vertcat(y, y[0] > 0, following[2])])
    initial = ca.Function(
        "initial",
        [u, p],
        [ca.vertcat(b0, 0.1, 0), ca.vertcat(b0, p[1] - p[2] + temperature - 25, b0 > 0, 0)],
    )
    matrix = tuple(
        Variable(f"M[{i + 1},{j + 1}]", "1", "gain <1>", start=start)
        for (i, j), start in np.ndenumerate([[1.0, 0.25], [-0.5, 2.0]])
    )
    return Block(
        name=name,
        description="One of everything & more",
        step=step,
        initial=initial,
        inputs=(
            Variable("rate", unit),
            Variable("temperature", "degC", start=25.0),
            Variable("counting", start=1.0, kind="boolean"),
            Variable("gear", start=1.0, kind="integer", minimum=-9),
        ),
        parameters=matrix
        + (
            Variable("noise.N", "rad/sqrt(s)", start=0.03, minimum=0.0),
            Variable("noise.K", "rad/s/sqrt(s)", start=0.01),
            Variable("b0", "rad/s", start=-0.125),
            Variable("doubled", kind="boolean", start=0.0),
        ),
        outputs=(
            Variable("y[1]", "rad/s"),
            Variable("y[2]", "1"),
            Variable("positive", kind="boolean"),
            Variable("ticks", kind="integer"),
        ),
        noise=tuple(NoiseChannel(f"w{n}", n) for n in CHANNELS),
        sample_period=sample_period,
    )


def drive(n: int, seed: int = 3) -> np.ndarray:
    """Inputs (n, 4) of the toy: motion, warming up, counting on and off in gears."""
    rng = np.random.default_rng(seed)
    return np.column_stack(
        [rng.normal(0, 3, n), rng.normal(20, 30, n), rng.integers(0, 2, n), rng.integers(-3, 4, n)]
    )


@dataclass
class Unit:
    """One instance of an FMU, its variables by name, its messages kept.

    The block form has ``rows`` of inputs and outputs; ``set`` puts a value into all of them and
    ``get`` looks at the last, so that in steps of no more samples it behaves as the scalar forms
    do. Without a ``name`` it is called as its model is.
    """

    path: Path
    log_events: bool = False
    rows: int = 8
    name: str = ""
    messages: list = field(default_factory=list)

    def __post_init__(self):
        self.description = read_model_description(str(self.path))
        self.version = int(self.description.fmiVersion[0])
        self.folder = extract(str(self.path))
        self.variables = {v.name: v for v in self.description.modelVariables}
        self.form = "block" if "block_size" in self.variables else self.version
        kind = fmi2.FMU2Slave if self.version == 2 else fmi3.FMU3Slave
        self.fmu = kind(
            guid=self.description.guid,
            unzipDirectory=str(self.folder),
            instanceName=self.name or self.description.modelName,
            modelIdentifier=self.description.coSimulation.modelIdentifier,
        )
        self._instantiate()

    def _instantiate(self):
        if self.version == 3:
            self.fmu.instantiate(
                loggingOn=self.log_events,
                logMessage=lambda env, status, *message: self._keep(*message),
            )
            self._configure()
            return
        self.callbacks = fmi2.fmi2CallbackFunctions()
        self.callbacks.logger = fmi2.fmi2CallbackLoggerTYPE(
            lambda env, name, status, *message: self._keep(*message)
        )
        addLoggerProxy(byref(self.callbacks))
        self.fmu.instantiate(callbacks=self.callbacks, loggingOn=self.log_events)

    def _configure(self):
        if self.form == "block":
            self.fmu.enterConfigurationMode()
            self.set("block_size", self.rows)
            self.fmu.exitConfigurationMode()

    def reset(self):
        self.fmu.reset()
        self._configure()

    def _keep(self, category, text):
        self.messages.append((category.decode(), text.decode()))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.fmu.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)

    def start(self, start_time=0.0, **values):
        """Through initialization with these values; gives itself."""
        if self.version == 2:
            self.fmu.setupExperiment(startTime=start_time)
            self.fmu.enterInitializationMode()
        else:
            self.fmu.enterInitializationMode(startTime=start_time)
        for name, value in values.items():
            self.set(name, value)
        self.fmu.exitInitializationMode()
        return self

    def set(self, name, value):
        """A variable, all rows of it; or one element of an array."""
        if name in self.variables:
            self.set_array(name, np.broadcast_to(value, self.shape(name)))
            return
        base, index = split_name(name)
        array = self.get_array(base)
        array[(..., *(i - 1 for i in index))] = value
        self.set_array(base, array)

    def get(self, name):
        """A variable, of rows the last; or one element of an array."""
        if name not in self.variables:
            base, index = split_name(name)
            return self.get(base)[tuple(i - 1 for i in index)]
        array = self.get_array(name)
        return array[-1] if self.has_rows(name) else array[()]

    def has_rows(self, name):
        return self.form == "block" and self.variables[name].causality in ("input", "output")

    def shape(self, name):
        shape = tuple(self.variables[name].shape or ())
        return (self.rows, *shape[1:]) if self.has_rows(name) else shape

    def set_array(self, name, array):
        v = self.variables[name]
        getattr(self.fmu, f"set{v.type}")([v.valueReference], np.ravel(array).tolist())

    def get_array(self, name):
        v = self.variables[name]
        many = {} if self.version == 2 else {"nValues": int(np.prod(self.shape(name), dtype=int))}
        return np.array(getattr(self.fmu, f"get{v.type}")([v.valueReference], **many)).reshape(
            self.shape(name)
        )

    def step(self, time, size):
        self.fmu.doStep(currentCommunicationPoint=time, communicationStepSize=size)

    def outputs(self):
        values = [
            self.get(v.name) for v in self.description.modelVariables if v.causality == "output"
        ]
        return [float(x) for value in values for x in np.ravel(value)]

    def run(self, inputs, first=0, period=1 / RATE):
        """One step a row of inputs (n, nu), from sample ``first``; gives outputs (n, ny)."""
        names = [v.name for v in self.description.modelVariables if v.causality == "input"]
        rows = []
        for k, row in enumerate(inputs, start=first):
            for name, value in zip(names, row):
                self.set(
                    name, value if self.variables[name].type in ("Real", "Float64") else int(value)
                )
            self.step(k * period, (k + 1) * period - k * period)
            rows.append(self.outputs())
        return np.array(rows)

    def save(self):
        return self.fmu.getFMUstate() if self.version == 2 else self.fmu.getFMUState()

    def restore(self, state):
        self.fmu.setFMUstate(state) if self.version == 2 else self.fmu.setFMUState(state)

    def release(self, state):
        self.fmu.freeFMUstate(state) if self.version == 2 else self.fmu.freeFMUState(state)

    def to_bytes(self, state):
        return (
            self.fmu.serializeFMUstate(state)
            if self.version == 2
            else self.fmu.serializeFMUState(state)
        )

    def from_bytes(self, data):
        return (
            self.fmu.deSerializeFMUstate(data)
            if self.version == 2
            else self.fmu.deserializeFMUState(data)
        )
