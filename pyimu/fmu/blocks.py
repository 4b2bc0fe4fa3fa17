"""Run the block form of an FMU over long logs, thin over fmpy.

The samples are those of the scalar form, bit for bit. Sample by sample, most of the time goes into
calls; in blocks, into the model: buffers are made once, and the calls hand them to the FMU as they
are.
"""

from __future__ import annotations

import ctypes
import shutil
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.fmi3 import FMU3Slave
from fmpy.model_description import ModelDescription, ModelVariable, read_model_description

from pyimu.errors import UserError
from pyimu.fmu.arrays import split_name
from pyimu.fmu.run import special
from pyimu.fmu.variables import BLOCK_SIZE
from pyimu.units import did_you_mean

_TYPES: dict[str, tuple[Any, Any]] = {
    "Float64": (np.float64, ctypes.c_double),
    "Int32": (np.int32, ctypes.c_int32),
    "Boolean": (np.bool_, ctypes.c_bool),
    "UInt64": (np.uint64, ctypes.c_uint64),
}

_READ: dict[str, Callable[[str], Any]] = {"Float64": float, "Boolean": lambda x: x in ("true", "1")}


def simulate_blocks(
    fmu_path: Path | str,
    inputs: np.ndarray,
    *,
    sample_period: float | None = None,
    start_values: Mapping[str, Any] | None = None,
    start_time: float = 0.0,
    block_size: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> np.ndarray:
    """Outputs (n + 1, ny) of the block form of an FMU for ``inputs`` (n, nu).

    They are to the bit those of ``simulate`` on a scalar form.

    Columns are in the order of the scalar form's inputs and outputs. Row 0 is what is shown before
    the first sample, for the first row of inputs, and row k the answer to row k - 1.
    ``start_values`` maps names of parameters to values: arrays as a whole (``G``), or their
    elements as in the scalar form (``G[1,2]``). Without a ``sample_period`` [s] or a ``block_size``
    the FMU's own holds. ``progress`` is called after each block with the number of samples made
    and that of all.

    Raises ValueError where the FMU has no blocks or the inputs have the wrong shape, UserError,
    which is one, for a start value that has no parameter, and for a seed or a sample period that is
    none; fmpy's exceptions, with the FMU's message as a note, where the FMU refuses.
    """
    inputs = np.atleast_2d(inputs)
    with _opened(fmu_path, sample_period, start_values, start_time, block_size) as unit:
        unit.begin(inputs[:1])
        outputs = np.empty((len(inputs) + 1, unit.outputs.columns))
        unit.outputs.get(outputs[:1])
        for made in unit.answer(inputs, outputs[1:]):
            if progress:
                progress(made, len(inputs))
        return outputs


def stream_blocks(
    fmu_path: Path | str,
    chunks: Iterable[np.ndarray],
    *,
    sample_period: float | None = None,
    start_values: Mapping[str, Any] | None = None,
    start_time: float = 0.0,
    block_size: int | None = None,
) -> Iterator[np.ndarray]:
    """Outputs (m, ny) to each chunk of inputs (m, nu) in turn, of any length.

    Row k is the answer to row k.

    For logs that do not fit into memory: a chunk is asked for when the answer to the one before has
    been taken. One after the other the answers are what ``simulate_blocks`` gives after its row 0;
    arguments and errors are those of it.
    """
    with _opened(fmu_path, sample_period, start_values, start_time, block_size) as unit:
        unit.begin()
        for chunk in chunks:
            inputs = np.atleast_2d(chunk)
            outputs = np.empty((len(inputs), unit.outputs.columns))
            for _ in unit.answer(inputs, outputs):
                pass
            yield outputs


@dataclass
class _Unit:
    """An instance with its parameters, and the number of samples made.

    Its inputs and outputs are tables of ``size`` rows.
    """

    fmu: FMU3Slave
    name: str
    inputs: _Table
    outputs: _Table
    size: int
    period: float
    start_time: float
    sample: int = 0

    def begin(self, first: np.ndarray | None = None) -> None:
        """Initialize, with the inputs (1, nu) of the ``first`` sample or their start values."""
        if first is not None and len(first):
            self._check(first)
            self.inputs.set(first)
        self.fmu.enterInitializationMode(startTime=self.start_time)
        self.fmu.exitInitializationMode()

    def answer(self, inputs: np.ndarray, outputs: np.ndarray) -> Iterator[int]:
        """Fill ``outputs`` (n, ny) from ``inputs`` (n, nu) block by block.

        Gives after each block how many of the rows are done.
        """
        self._check(inputs)
        for first in range(0, len(inputs), self.size):
            rows = slice(first, min(first + self.size, len(inputs)))
            self._step(inputs[rows], outputs[rows])
            yield rows.stop

    def _check(self, inputs: np.ndarray) -> None:
        if inputs.ndim != 2 or inputs.shape[1] != self.inputs.columns:
            raise ValueError(
                f"inputs of {self.name} have shape {inputs.shape}, not (n, {self.inputs.columns})"
            )

    def _step(self, inputs: np.ndarray, outputs: np.ndarray) -> None:
        self.inputs.set(inputs)
        # From the number of samples, as a sum of steps would drift.
        self.fmu.doStep(
            currentCommunicationPoint=self.start_time + self.sample * self.period,
            communicationStepSize=len(inputs) * self.period,
        )
        self.outputs.get(outputs)
        self.sample += len(inputs)


class _Table:
    """Variables as the columns of one table.

    Behind it is a buffer for each type, which one call hands to the FMU whole.
    """

    def __init__(self, fmu: FMU3Slave, variables: list[ModelVariable], rows: int) -> None:
        counts = [int(np.prod(v.shape[1:])) for v in variables]
        ends = np.cumsum(counts, dtype=int)
        self.columns = sum(counts)
        self.parts: list[tuple[slice, np.ndarray]] = []
        self.setters: list[Callable[[], int]] = []
        self.getters: list[Callable[[], int]] = []
        for kind in dict.fromkeys(v.type for v in variables):
            chosen = [i for i, v in enumerate(variables) if v.type == kind]
            buffer, arrays = _carve(rows, [counts[i] for i in chosen], kind)
            self.parts += [
                (slice(ends[i] - counts[i], ends[i]), array) for i, array in zip(chosen, arrays)
            ]
            arguments = _arguments([variables[i] for i in chosen], buffer, kind)
            self.setters.append(partial(getattr(fmu, f"fmi3Set{kind}"), fmu.component, *arguments))
            self.getters.append(partial(getattr(fmu, f"fmi3Get{kind}"), fmu.component, *arguments))

    def set(self, rows: np.ndarray) -> None:
        """Set the first rows.

        Those after them, which a shorter step does not read, do not change.
        """
        for columns, array in self.parts:
            array[: len(rows)] = rows[:, columns]
        for call in self.setters:
            call()

    def get(self, rows: np.ndarray) -> None:
        """Fill ``rows`` with the first ones."""
        for call in self.getters:
            call()
        for columns, array in self.parts:
            rows[:, columns] = array[: len(rows)]


def _carve(rows: int, counts: list[int], kind: str) -> tuple[np.ndarray, list[np.ndarray]]:
    """A buffer, and arrays (rows, count) that lie in it one behind the other."""
    buffer: np.ndarray = np.zeros(rows * sum(counts), dtype=_TYPES[kind][0])
    ends = rows * np.cumsum(counts)
    return buffer, [
        buffer[end - rows * count : end].reshape(rows, count) for end, count in zip(ends, counts)
    ]


def _arguments(variables: list[ModelVariable], buffer: np.ndarray, kind: str) -> tuple:
    """The arguments of an FMI 3 getter or setter for these variables, after the instance.

    Value references, their number, values, their number.
    """
    references = (ctypes.c_uint * len(variables))(*[v.valueReference for v in variables])
    return (
        references,
        len(variables),
        buffer.ctypes.data_as(ctypes.POINTER(_TYPES[kind][1])),
        buffer.size,
    )


@contextmanager
def _opened(
    fmu_path: Path | str,
    sample_period: float | None,
    start_values: Mapping[str, Any] | None,
    start_time: float,
    block_size: int | None,
) -> Iterator[_Unit]:
    """An instance, not yet initialized; it and its folder are gone afterwards."""
    description = read_model_description(str(fmu_path), validate=False)
    own = {v.name: v for v in description.modelVariables}
    if BLOCK_SIZE not in own:
        raise ValueError(f"{fmu_path} is not the block form of an FMU: it has no {BLOCK_SIZE}")
    period = {} if sample_period is None else {"sample_period": sample_period}
    values = _parameters(description, {**(start_values or {}), **period})
    size = int(own[BLOCK_SIZE].start if block_size is None else block_size)
    with _instance(fmu_path, description) as fmu:
        _configure(fmu, own, values, size)
        tables = {
            c: _Table(fmu, [v for v in description.modelVariables if v.causality == c], size)
            for c in ("input", "output")
        }
        yield _Unit(
            fmu,
            description.modelName,
            tables["input"],
            tables["output"],
            size,
            fmu.getFloat64([own["sample_period"].valueReference])[0],
            start_time,
        )


@contextmanager
def _instance(fmu_path: Path | str, description: ModelDescription) -> Iterator[FMU3Slave]:
    """An instance, not yet initialized; what it has said goes along with fmpy's exceptions."""
    folder = fmpy.extract(str(fmu_path))
    messages: list[str] = []
    try:
        fmu = FMU3Slave(
            guid=description.guid,
            unzipDirectory=folder,
            instanceName=description.modelName,
            modelIdentifier=description.coSimulation.modelIdentifier,
        )
        fmu.instantiate(logMessage=lambda _, __, ___, message: messages.append(message.decode()))
        try:
            yield fmu
        except FMICallException as error:
            for message in messages:
                error.add_note(message)
            raise
        finally:
            fmu.freeInstance()
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _configure(
    fmu: FMU3Slave, own: Mapping[str, ModelVariable], values: Mapping[str, np.ndarray], size: int
) -> None:
    """Set the size of a block, and the parameters."""
    fmu.enterConfigurationMode()
    fmu.setUInt64([own[BLOCK_SIZE].valueReference], [size])
    fmu.exitConfigurationMode()
    for name, value in values.items():
        getattr(fmu, f"set{own[name].type}")([own[name].valueReference], value.ravel().tolist())


def _parameters(description: ModelDescription, given: Mapping[str, Any]) -> dict[str, np.ndarray]:
    """The parameters that ``given`` names, each whole.

    Where it names an element, the others have their start values.
    """
    parameters = {v.name: v for v in description.modelVariables if v.causality == "parameter"}
    values: dict[str, np.ndarray] = {}
    for name, value in special(given).items():
        base, index = (name, ()) if name in parameters else split_name(name)
        if base not in parameters or len(index) not in (0, len(parameters[base].shape)):
            raise UserError(
                f"{description.modelName} has no parameter {name}{did_you_mean(base, parameters)}"
            )
        array = values.setdefault(base, _start(parameters[base]))
        if not index and np.shape(value) != array.shape:
            raise UserError(
                f"{name} of {description.modelName} has shape {np.shape(value)}, not {array.shape}"
            )
        if any(not 1 <= i <= size for i, size in zip(index, array.shape)):
            raise UserError(f"{description.modelName} has no parameter {name}")
        array[tuple(i - 1 for i in index) if index else ...] = value
    return values


def _start(variable: ModelVariable) -> np.ndarray:
    """The start value of a parameter in its shape; one value may stand for all elements."""
    values = [_READ.get(variable.type, int)(word) for word in variable.start.split()]
    starts: np.ndarray = np.array(values, dtype=_TYPES[variable.type][0])
    whole = starts.reshape(variable.shape) if len(values) > 1 else starts[0]
    return np.array(np.broadcast_to(whole, variable.shape))
