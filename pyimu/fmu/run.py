"""Run an FMU sample by sample, thin over fmpy."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
from fmpy.model_description import ModelDescription, read_model_description

from pyimu.block.variables import sample_period_of, seed_of
from pyimu.errors import UserError
from pyimu.units import did_you_mean

_DTYPES = {"Boolean": np.bool_, "Integer": np.int32, "Int32": np.int32}


def simulate(
    fmu_path: Path | str,
    inputs: np.ndarray,
    *,
    sample_period: float,
    start_values: Mapping[str, Any] | None = None,
    start_time: float = 0.0,
    samples_per_step: int = 1,
) -> np.ndarray:
    """Outputs (n / samples_per_step + 1, ny) of an FMU to ``inputs`` (n, nu), a row per sample.

    Columns are in the order of the FMU's inputs and outputs. Row 0 is what is shown before the
    first sample, for the first row of inputs, and row k the answer to row k - 1 of the inputs; with
    ``samples_per_step`` of m, to row m (k - 1), held over the m samples of the step.
    ``start_values`` maps names of parameters to values, ``seed`` among them; ``sample_period`` [s]
    is set, too. A row of NaN reaches the row before it as well: fmpy weighs the next row by zero,
    and zero times NaN is NaN.

    Raises ValueError where the inputs have the wrong shape, UserError, which is one, for a start
    value that has no parameter, and for a seed or a sample period that is none; fmpy's exceptions
    where the FMU refuses.
    """
    description = read_model_description(str(fmu_path), validate=False)
    values = checked(description, {**(start_values or {}), "sample_period": sample_period})
    step = samples_per_step * sample_period
    held = np.atleast_2d(inputs)[::samples_per_step]
    # fmpy's own expression for its communication points: at equal times it does not interpolate
    # between the rows.
    times = start_time + np.arange(len(held) + 1) * step
    signals = _signals(description, times, np.vstack([held, held[-1:]]))
    result = fmpy.simulate_fmu(
        str(fmu_path),
        validate=False,
        start_time=start_time,
        stop_time=times[-1],
        step_size=step,
        output_interval=step,
        input=signals,
        start_values=values,
    )
    columns = [result[v.name] for v in description.modelVariables if v.causality == "output"]
    return np.column_stack(columns).astype(float)


def checked(description: ModelDescription, start_values: Mapping[str, Any]) -> dict[str, Any]:
    """The start values, each of which must name a parameter of a scalar form.

    Raises UserError for a name, a seed or a period that is none.
    """
    parameters = {v.name: v.type for v in description.modelVariables if v.causality == "parameter"}
    for name in start_values:
        if name not in parameters:
            raise UserError(
                f"{description.modelName} has no parameter {name}{did_you_mean(name, parameters)}"
            )
    return special(start_values, 31 if parameters.get("seed") == "Integer" else 64)


def special(start_values: Mapping[str, Any], seed_bits: int = 64) -> dict[str, Any]:
    """The start values with seed and sample period, if given, checked and converted.

    Raises UserError for a seed or a sample period that is none.
    """
    values = dict(start_values)
    if "seed" in values:
        values["seed"] = seed_of(values["seed"], seed_bits)
    if "sample_period" in values:
        values["sample_period"] = sample_period_of(values["sample_period"], "sample_period")
    return values


def _signals(description: ModelDescription, times: np.ndarray, inputs: np.ndarray) -> np.ndarray:
    """The rows of ``inputs`` (n, nu) as the structured array that fmpy takes."""
    variables = [v for v in description.modelVariables if v.causality == "input"]
    if inputs.shape != (len(times), len(variables)):
        raise ValueError(
            f"inputs of {description.modelName} have shape {inputs.shape}, not (n, "
            f"{len(variables)})"
        )
    signals = np.empty(
        len(times),
        dtype=[("time", float)] + [(v.name, _DTYPES.get(v.type, np.float64)) for v in variables],
    )
    signals["time"] = times
    for variable, column in zip(variables, inputs.T):
        signals[variable.name] = column
    return signals
