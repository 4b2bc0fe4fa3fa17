"""Time a sample of a four-hour log of the IMT30 in Python, as a share of what its FMU takes in a
plain C loop: ``python benchmarks/simulation_speed.py [samples]``.

The C loop does what an importer must: set the inputs, step, get the outputs. Beside it stands what
no importer can do: one step over the whole log with inputs held, which is the model and its noise
alone. In Python the same log goes through ``pyimu.simulate`` from arrays to arrays, and through
``Block.run``. Each round times all of them one after the other.

Last, what the effects of a part's tolerances cost that its unit has as parameters, at their
identity: the unit as ``pyimu build`` makes it, as a share of one without them.
"""

import ctypes
import subprocess
import sys
import tempfile
import time
import tracemalloc
import zipfile
from pathlib import Path
from statistics import median

import numpy as np
from fmpy import read_model_description

import pyimu
from pyimu.fmu.build import FLAGS, build_fmu, header_folder, host_compiler
from pyimu.model.simulate import simulate

SAMPLES = 4 * 3600 * 976
ROUNDS = 5
GOAL = 2.0
WITH_TOLERANCES = ("mpu9250", "mpu6050", "stim300")
"""The one with the least beside its tolerances, the one with the most of them, a tactical one."""

DRIVER = r"""
#include <stdint.h>
#include <stdlib.h>
#include "fmi2Functions.h"

static void say_nothing(fmi2ComponentEnvironment e, fmi2String i, fmi2Status s, fmi2String c,
                        fmi2String m, ...) {}
static const fmi2CallbackFunctions callbacks = {say_nothing, calloc, free, NULL, NULL};

/* A unit without noise has no seed. */
static fmi2Component start(const char *token, const fmi2ValueReference *seed_vr, int seeds,
                           int seed) {
    fmi2Component c = fmi2Instantiate("x", fmi2CoSimulation, token, "", &callbacks, fmi2False,
                                      fmi2False);
    if (!c || fmi2SetupExperiment(c, fmi2False, 0, 0, fmi2False, 0)
        || fmi2EnterInitializationMode(c) || (seeds && fmi2SetInteger(c, seed_vr, seeds, &seed))
        || fmi2ExitInitializationMode(c)) abort();
    return c;
}

__attribute__((visibility("default")))
void each(const char *token, const fmi2ValueReference *seed_vr, int seeds, int seed, int64_t n,
          double h, const fmi2ValueReference *inputs, int nu, const double *u,
          const fmi2ValueReference *outputs, int ny, double *y) {
    fmi2Component c = start(token, seed_vr, seeds, seed);
    for (int64_t k = 0; k < n; k++)
        if (fmi2SetReal(c, inputs, nu, u + k * nu) || fmi2DoStep(c, k * h, h, fmi2True)
            || fmi2GetReal(c, outputs, ny, y + k * ny)) abort();
    fmi2FreeInstance(c);
}

__attribute__((visibility("default")))
void held(const char *token, const fmi2ValueReference *seed_vr, int seeds, int seed, int64_t n,
          double h) {
    fmi2Component c = start(token, seed_vr, seeds, seed);
    if (fmi2DoStep(c, 0, n * h, fmi2True)) abort();
    fmi2FreeInstance(c);
}
"""


class PlainC:
    """The part's FMU, compiled as it is delivered, and the two loops around it."""

    def __init__(self, part, folder: Path) -> None:
        fmu = build_fmu(part.block, folder, 2)
        about = read_model_description(str(fmu))
        with zipfile.ZipFile(fmu) as archive:
            (binary,) = [name for name in archive.namelist() if name.startswith("binaries/")]
            library = archive.extract(binary, folder)
        (folder / "driver.c").write_text(DRIVER)
        command = [
            *host_compiler(),
            *FLAGS,
            "-shared",
            "-w",
            "-I",
            header_folder(),
            folder / "driver.c",
            library,
            "-o",
            folder / "driver.so",
        ]
        subprocess.run(command, check=True)
        self.calls, self.token, self.h = (
            ctypes.CDLL(str(folder / "driver.so")),
            about.guid.encode(),
            part.sample_period,
        )
        vr = {v.name: v.valueReference for v in about.modelVariables}
        self.seed, self.inputs, self.outputs = (
            np.array([vr[n] for n in names], dtype=np.uint32)
            for names in (
                [name for name in ("seed",) if name in vr],
                [v.name for v in part.block.inputs],
                [v.name for v in part.block.outputs],
            )
        )

    def _start(self, n: int, seed: int) -> tuple:
        return (
            self.token,
            ctypes.c_void_p(self.seed.ctypes.data),
            ctypes.c_int(len(self.seed)),
            ctypes.c_int(seed),
            ctypes.c_int64(n),
            ctypes.c_double(self.h),
        )

    def each(self, u: np.ndarray, y: np.ndarray, seed: int) -> None:
        def pointer(a):
            return ctypes.c_void_p(a.ctypes.data)

        self.calls.each(
            *self._start(len(u), seed),
            pointer(self.inputs),
            len(self.inputs),
            pointer(u),
            pointer(self.outputs),
            len(self.outputs),
            pointer(y),
        )

    def held(self, n: int, seed: int) -> None:
        self.calls.held(*self._start(n, seed))


def main(n: int) -> None:
    part = pyimu.part("imt30")
    still = part
    for sensor in (part.gyro, part.accel):
        still = still.with_sensor(sensor.without(*[e.name for e in sensor.effects if e.stochastic]))
    u = inputs(n)
    given = [np.ascontiguousarray(u[:, at]) for at in (slice(0, 3), slice(3, 6), 6)]
    print(f"{n} samples of {part.name}, ns a sample, median of {ROUNDS} rounds")
    for title, seed, in_c in (("noise off", None, still), ("noise on", 1, part)):
        with tempfile.TemporaryDirectory() as folder:
            measure(title, part, seed, PlainC(in_c, Path(folder)), u, given)
    beyond(part, given)
    print(f"\nunits with the effects of tolerances as a share of units without, {n // 20} samples")
    for name in WITH_TOLERANCES:
        of_tolerances(name, u[: n // 20])


def of_tolerances(name: str, u: np.ndarray) -> None:
    part, y = pyimu.part(name), np.empty((len(u), 6))
    with tempfile.TemporaryDirectory() as without, tempfile.TemporaryDirectory() as whole:
        units = PlainC(part, Path(without)), PlainC(part.nominal, Path(whole))
        rounds = [
            [
                (clock(lambda c=c: c.each(u, y, 1)), clock(lambda c=c: c.held(len(u), 1)))
                for c in units
            ]
            for _ in range(2 * ROUNDS + 1)
        ]
    each, held = (median(r[1][way] / r[0][way] for r in rounds) for way in (0, 1))
    plain = median(r[0][1] for r in rounds) / len(u) * 1e9
    print(
        f"  {name}, {len(part.tolerances)} tolerances: {each:.2f} each sample, {held:.2f} inputs "
        f"held (without them {plain:.0f} ns a sample)"
    )


def inputs(n: int) -> np.ndarray:
    """A slow motion on all axes while the part warms up, (n, 7)."""
    t = np.arange(n) / 976.0
    waves = [np.sin((1 + i) * t / 7) for i in range(6)]
    waves[5] += 9.80665
    return np.column_stack([*waves, 25 + 10 * (1 - np.exp(-t / 600))])


def measure(
    title: str, part, seed: int | None, in_c: PlainC, u: np.ndarray, given: list[np.ndarray]
) -> None:
    """Every way makes its own outputs, and nothing is kept: pages that nobody has used yet can cost
    more than the simulation.
    """
    n = len(u)
    ways = {
        "C, each sample": lambda: in_c.each(u, np.empty((n, len(in_c.outputs))), seed or 0),
        "C, inputs held": lambda: in_c.held(n, seed or 0),
        "simulate": lambda: simulate(part, *given, seed=seed),
        "Block.run": lambda: part.block.run(u, seed=seed),
    }
    same = same_bits(part, seed, in_c, u, given)
    rounds = [{name: clock(way) / n * 1e9 for name, way in ways.items()} for _ in range(ROUNDS)]
    print(
        f"\n{title}: " + ", ".join(f"{name} {median(r[name] for r in rounds):.1f}" for name in ways)
    )
    for python_way in ("simulate", "Block.run"):
        ratios = [
            median(r[python_way] / r[c_way] for r in rounds)
            for c_way in ("C, each sample", "C, inputs held")
        ]
        print(
            f"  {python_way}: {ratios[0]:.2f} of the C loop (goal at most {GOAL:g}), "
            f"{ratios[1]:.2f} of the model and its noise alone"
        )
    print(f"  Python's bits are {'' if same else 'NOT '}the C loop's")


def same_bits(part, seed: int | None, in_c: PlainC, u: np.ndarray, given: list[np.ndarray]) -> bool:
    y = np.empty((len(u), len(in_c.outputs)))
    in_c.each(u, y, seed or 0)
    measured = simulate(part, *given, seed=seed)
    return all(
        np.array_equal(m, y[:, at])
        for m, at in zip(measured, (slice(0, 3), slice(3, 6)), strict=True)
    )


def clock(call) -> float:
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def beyond(part, given: list[np.ndarray]) -> None:
    tracemalloc.start()
    measured = simulate(part, *given, seed=1)
    peak = tracemalloc.get_traced_memory()[1] - sum(m.nbytes for m in measured)
    tracemalloc.stop()
    print(
        "\npeak memory beyond inputs and outputs "
        f"({(sum(m.nbytes for m in (*given, *measured))) / 2**20:.0f} MiB): {peak / 2**20:.2f} MiB"
    )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else SAMPLES)
