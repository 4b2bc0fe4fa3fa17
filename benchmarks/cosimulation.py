"""Steps a second of the rover's four units at 976 Hz in each simulator:
``python benchmarks/cosimulation.py``.

Beside them stand four empty units in the same simulator, wired by about as many scalars (18 for the
rover's 20), which are what the simulator itself costs; and the units' own cost: each of the four in
a plain loop in C, as an importer calls it, and in the block form, where calls cost nothing. Each
round times rover and empty units one after the other. What loading takes is not counted: a rate is
that of the steps beyond the first few.

Simulators that are not installed are left out (``pip install 'pyimu[simulators]'``).
"""

import tempfile
import time
import zipfile
from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from statistics import median

import casadi as ca
import numpy as np
from block_fmu import plain_loop

from pyimu.attitude import attitude_ukf
from pyimu.block.block import Block
from pyimu.block.variables import array
from pyimu.fmu import build_fmu, build_fmus, simulate_blocks
from pyimu.fmu.cosimulate import cosimulate
from pyimu.fmu.ssp import write_ssp
from pyimu.fmu.system import Component, System
from pyimu.model.part_file import part
from pyimu.plant.low_pass import low_pass
from pyimu.plant.rover_drive import rover_drive
from pyimu.rover.system import rover_system

ROUNDS = 5
FIRST = 10
"""Steps of a run that is taken off another, so that loading is not counted."""

CHANNELS = 6


@dataclass(frozen=True)
class Wired:
    """A system and its SSP file, which some simulators want unpacked."""

    system: System
    ssp: Path
    folder: Path


def empty(name: str, period: float) -> Block:
    """A unit that shows its six inputs: nothing but calls."""
    u, p, none, h = ca.SX.sym("u", CHANNELS), ca.SX(0, 1), ca.SX(0, 1), ca.SX.sym("h")
    step = ca.Function("step", [ca.SX(0, 1), u, p, none, h], [ca.SX.zeros(0), u])
    initial = ca.Function("initial", [u, p], [ca.SX.zeros(0), u])
    inputs, outputs = (array(n, "1", "", (0.0,) * CHANNELS) for n in "uy")
    return Block(name, "", step, initial, inputs, (), outputs, (), period)


def empty_system(like: System, folder: Path) -> System:
    names = [f"Empty{i}" for i in range(len(like.components))]
    units = tuple(
        Component(
            n, build_fmu(empty(n, like.step_size), folder, 2), {"sample_period": like.step_size}
        )
        for n in names
    )
    wires = tuple((f"{a}.y", f"{b}.u") for a, b in zip(names, names[1:]))
    return System("Empty", units, wires, like.step_size)


# Each simulator: a system and a number of steps to the time that the steps took, in s.


def in_loop(wired: Wired, steps: int) -> float:
    """The loop of this package: a call for each scalar."""
    last = [f"{wired.system.components[-1].name}.{wired.system.components[-1].outputs[0].name}"]
    begin = time.perf_counter()
    cosimulate(wired.system, steps, last)
    return time.perf_counter() - begin


def in_fmpy(wired: Wired, steps: int) -> float:
    from fmpy.ssp.simulation import simulate_ssp
    from fmpy.ssp.ssd import read_ssv

    h = wired.system.step_size
    values = read_ssv(str(wired.ssp), resource="resources/parameters.ssv")
    begin = time.perf_counter()
    simulate_ssp(str(wired.ssp), stop_time=(steps - 0.5) * h, step_size=h, parameter_set=values)
    return time.perf_counter() - begin


def in_ecos(wired: Wired, steps: int) -> float:
    from ecospy import EcosSimulation
    from ecospy.lib import EcosLib

    EcosLib.set_log_level("off")
    with EcosSimulation(step_size=wired.system.step_size, ssp_path=str(wired.ssp)) as run:
        run.init(parameter_set="parameters")
        begin = time.perf_counter()
        run.step(steps)
        taken = time.perf_counter() - begin
        run.terminate()
    return taken


def in_libcosim(wired: Wired, steps: int) -> float:
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level

    log_output_level(CosimLogLevel.FATAL)
    run = CosimExecution.from_ssp_file(str(wired.folder), round(wired.system.step_size * 1e9))
    run.step(FIRST)
    begin = time.perf_counter()
    assert run.step(steps)
    return time.perf_counter() - begin


SIMULATORS: dict[str, tuple[str, Callable[[Wired, int], float], int, bool]] = {
    "libcosim": ("libcosimpy", in_libcosim, 20_000, False),
    "ecos": ("ecospy", in_ecos, 20_000, False),
    "fmpy, its reader of SSP": ("fmpy", in_fmpy, 2_000, True),
    "a loop over fmpy": ("fmpy", in_loop, 2_000, True),
}
"""Package, function, steps of a run, and whether loading is in its time."""


def rates(wired: dict[str, Wired], name: str) -> dict[str, float]:
    """Steps a second of each system, one after the other."""
    _, run, steps, loads = SIMULATORS[name]
    return {
        what: (steps - FIRST * loads) / (run(w, steps) - (run(w, FIRST) if loads else 0.0))
        for what, w in wired.items()
    }


# The units' own cost


def own_costs(folder: Path, period: float, rounds: int) -> dict[str, dict[str, float]]:
    """Unit to ns a sample in a loop in C and in the block form."""
    imt30 = part("imt30")
    blocks = {
        "Drive": rover_drive(period),
        "Sensor": imt30.nominal.block,
        "LowPass": low_pass(period),
        "Filter": attitude_ukf(imt30),
    }
    found = {}
    for name, block in blocks.items():
        scalar, _, in_blocks = build_fmus(block, folder, (2, 3, "block"))
        loop, n = plain_loop(scalar, block.sample_period), 50_000
        inputs = np.tile(block.start_inputs, (n, 1))
        moved = inputs[:, :CHANNELS]  # of sensor, low-pass and filter what is measured
        moved += 1e-3 * np.random.default_rng(1).standard_normal(moved.shape)
        reals = np.ascontiguousarray(inputs[:, [v.kind == "real" for v in block.inputs]])
        loop(reals[:100])
        found[name] = {
            "loop": _median(lambda: loop(reals), n, rounds),
            "block": _median(lambda: simulate_blocks(in_blocks, inputs), n, rounds),
        }
    return found


def _median(run: Callable[[], object], n: int, rounds: int) -> float:
    times = []
    for _ in range(rounds):
        begin = time.perf_counter()
        run()
        times.append(time.perf_counter() - begin)
    return median(times) / n * 1e9


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        rover = rover_system("imt30", folder)
        wired = {
            system.name: _written(system, folder) for system in (rover, empty_system(rover, folder))
        }
        print(
            f"four units, {len(rover.wires)} wires, {1 / rover.step_size:.5f} Hz; {ROUNDS} rounds"
        )
        for simulator, (package, *_) in SIMULATORS.items():
            try:
                import_module(package)
            except (ImportError, OSError) as error:
                print(f"{simulator:26s} is not here: {error}")
                continue
            _show(simulator, [rates(wired, simulator) for _ in range(ROUNDS)])
        costs = own_costs(folder, rover.step_size, ROUNDS)
    for way, text in (("loop", "the units in a plain loop in C"), ("block", "the units in blocks")):
        total = sum(c[way] for c in costs.values())
        each = ", ".join(f"{name} {c[way]:,.0f}" for name, c in costs.items())
        print(f"{text:30s} {1e9 / total:11,.0f} steps/s: {total:,.0f} ns a step ({each})")


def _show(simulator: str, rounds: list[dict[str, float]]) -> None:
    rover, empty_ = (median(r[name] for r in rounds) for name in ("Rover", "Empty"))
    share = median(r["Rover"] / r["Empty"] for r in rounds)
    print(
        f"{simulator:26s} {rover:11,.0f} steps/s, four empty units {empty_:11,.0f}: the simulator "
        f"takes {share:4.0%} of the time"
    )


def _written(system: System, folder: Path) -> Wired:
    ssp = write_ssp(system, folder / f"{system.name}.ssp")
    unpacked = folder / system.name
    with zipfile.ZipFile(ssp) as archive:
        archive.extractall(unpacked)
    return Wired(system, ssp, unpacked)


if __name__ == "__main__":
    main()
