"""Samples a second of the sensor's FMU: its block form, its scalar form, and the same C in a plain
loop: ``python benchmarks/block_fmu.py``.

The plain loop calls the functions of the scalar FMU from compiled code, a sample at a time: it has
no Python in it, but as many calls as samples. The block form is run by ``simulate_blocks``, with
all that starting an FMU takes.
"""

import tempfile
import time
from collections.abc import Callable
from ctypes import c_double, c_int, c_size_t, c_void_p
from pathlib import Path
from statistics import median

import fmpy
import numpy as np
from fmpy.fmi2 import FMU2Slave
from numba import njit

from pyimu.fmu import FORMS, build_fmus, simulate, simulate_blocks, stream_blocks
from pyimu.model.part_file import part

RUNS = 5
SIZES = (1, 10, 100, 976, 10_000)
HOURS = 4


def main() -> None:
    block = part("imt30").block
    period, columns = block.sample_period, [v.name for v in block.inputs]
    with tempfile.TemporaryDirectory() as folder:
        paths = dict(zip(FORMS, build_fmus(block, folder, FORMS)))
        loop = plain_loop(paths[2], period)
        rates = {"plain loop in C": _rate(loop, _motion(300_000, len(columns)))}
        rates["scalar form through fmpy"] = _rate(
            lambda u: simulate(paths[3], u, sample_period=period), _motion(10_000, len(columns))
        )
        for size in SIZES:
            rows = _motion(min(2000 * size, 976_000), len(columns))
            rates[f"block form, {size} samples a call"] = _rate(
                lambda u, size=size: simulate_blocks(paths["block"], u, block_size=size), rows
            )
        for name, rate in rates.items():
            print(
                f"{name:34s} {rate / 1e6:8.3f} M samples/s, "
                f"{rate / rates['scalar form through fmpy']:7.1f} times the scalar form, "
                f"{rate / rates['plain loop in C']:5.2f} of the plain loop"
            )
        _stream(paths["block"], period, len(columns))


def _motion(n: int, columns: int) -> np.ndarray:
    """Inputs (n, columns) that move."""
    return np.random.default_rng(1).normal(0.0, 1.0, (n, columns))


def _rate(run: Callable[[np.ndarray], object], inputs: np.ndarray) -> float:
    """Samples a second, median over the runs; a first one warms up."""
    times = []
    for _ in range(RUNS + 1):
        start = time.perf_counter()
        run(inputs)
        times.append(time.perf_counter() - start)
    return len(inputs) / median(times[1:])


def _stream(path: Path, period: float, columns: int) -> None:
    """A log of hours, made and answered chunk by chunk."""
    chunk, n = _motion(97_600, columns), round(HOURS * 3600 / period)
    chunks = n // len(chunk)
    start = time.perf_counter()
    made = sum(len(y) for y in stream_blocks(path, (chunk for _ in range(chunks))))
    print(
        f"a log of {made * period / 3600:.1f} h, {made / 1e6:.1f} M samples, in chunks of "
        f"{len(chunk)}: {time.perf_counter() - start:.1f} s"
    )


def plain_loop(path: Path, period: float) -> Callable[[np.ndarray], np.ndarray]:
    """Runs the FMI 2 form from compiled code: set all reals, step, get them, sample by sample."""
    description = fmpy.read_model_description(str(path))
    unzipped = fmpy.extract(str(path), path.with_suffix(".unzipped"))
    of = {
        c: np.array(
            [
                v.valueReference
                for v in description.modelVariables
                if v.causality == c and v.type == "Real"
            ],
            dtype=np.uint32,
        )
        for c in ("input", "output")
    }

    def run(inputs: np.ndarray) -> np.ndarray:
        fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=unzipped,
            instanceName="loop",
            modelIdentifier=description.coSimulation.modelIdentifier,
        )
        fmu.instantiate()
        fmu.setupExperiment()
        fmu.enterInitializationMode()
        fmu.exitInitializationMode()
        outputs = np.empty((len(inputs), len(of["output"])))
        status = _loop(
            *_functions(fmu.dll), fmu.component, of["input"], of["output"], inputs, outputs, period
        )
        fmu.terminate()
        fmu.freeInstance()
        if status:
            raise RuntimeError(f"the plain loop ended with status {status}")
        return outputs

    return run


def _functions(dll) -> tuple:
    """Set, step and get, typed for compiled code."""
    transfer = [c_void_p, c_void_p, c_size_t, c_void_p]
    functions = dll.fmi2SetReal, dll.fmi2DoStep, dll.fmi2GetReal
    for function, arguments in zip(
        functions, (transfer, [c_void_p, c_double, c_double, c_int], transfer)
    ):
        function.argtypes, function.restype = arguments, c_int
    return functions


@njit
def _loop(put, step, get, component, inputs, outputs, u, y, period):
    for k in range(len(u)):
        status = put(component, inputs.ctypes.data, len(inputs), u[k].ctypes.data)
        status |= step(component, k * period, period, 0)
        status |= get(component, outputs.ctypes.data, len(outputs), y[k].ctypes.data)
        if status:
            return status
    return 0


if __name__ == "__main__":
    main()
