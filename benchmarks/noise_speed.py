"""Time per normal of the FMUs' C and of pyimu.block.normals, beside numpy's counter-based
generator: ``python benchmarks/noise_speed.py``.

The C is compiled with the flags of the FMUs. Every round times all of them, so the ratios are
medians of pairs; the arrays fit the cache, for the first touch of fresh memory costs more than a
normal, whoever draws it.
"""

import ctypes
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path
from statistics import median
from time import perf_counter_ns

import numpy as np

from pyimu.block.compiled import source_folder
from pyimu.block.normals import normals
from pyimu.fmu.build import FLAGS, host_compiler

N, CHANNELS, ROUNDS = 60_000, 6, 101
GOAL = 5.0
PEER = "numpy Generator(Philox()).standard_normal"

DRIVER = """
#include "noise.h"
#define SHOWN __attribute__((visibility("default")))
SHOWN void fill(double *out, uint64_t seed, const uint64_t *channels, size_t n_channels,
                int64_t first, size_t n) {
    noise_fill(out, seed, channels, n_channels, first, n);
}
SHOWN void at(double *out, uint64_t seed, const uint64_t *channels, size_t n_channels,
              int64_t first, size_t n) {
    NoiseCache caches[16];
    for (size_t c = 0; c < n_channels; c++) {
        noise_forget(&caches[c]);
    }
    for (size_t k = 0; k < n; k++) {
        for (size_t c = 0; c < n_channels; c++) {
            *out++ = noise_at(&caches[c], seed, channels[c], first + (int64_t) k);
        }
    }
}
"""


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        library = _compile(Path(folder))
    draws = {PEER: _numpy()}
    for m in (1, CHANNELS):
        draws[f"C noise_fill, {m} channels"] = _c(library.fill, m)
        draws[f"C noise_at, {m} channels"] = _c(library.at, m)
        draws[f"pyimu.block.normals.normals, {m} channels"] = lambda m=m: normals(
            1, range(m), 1, N // m
        )
    times = _times(draws)
    for name, of in times.items():
        ratio = median(peer / t for peer, t in zip(times[PEER], of))
        print(f"{name:45s} {median(of):6.2f} ns per normal, numpy takes {ratio:5.2f} times as long")
    print(
        f"medians of {ROUNDS} rounds of {N} normals; the goal is {GOAL:g} ns or half of numpy's "
        "time"
    )


def _compile(folder: Path) -> ctypes.CDLL:
    """noise.c as in an FMU, behind two functions that call it across a file's border as block.c
    does.
    """
    (folder / "driver.c").write_text(DRIVER, encoding="utf-8")
    library, sources = folder / "noise.so", [folder / "driver.c", source_folder() / "noise.c"]
    subprocess.run(
        [
            *host_compiler(),
            *FLAGS,
            "-I",
            source_folder(),
            "-shared",
            *sources,
            "-o",
            library,
            "-lm",
        ],
        check=True,
    )
    return ctypes.CDLL(str(library))


def _c(function: Callable, m: int) -> Callable:
    out, channels = np.zeros(N), np.arange(m, dtype=np.uint64)
    arguments = (
        ctypes.c_void_p(out.ctypes.data),
        ctypes.c_uint64(1),
        ctypes.c_void_p(channels.ctypes.data),
        ctypes.c_size_t(m),
        ctypes.c_int64(1),
        ctypes.c_size_t(N // m),
    )

    def draw(keep=(out, channels)):
        function(*arguments)

    return draw


def _numpy() -> Callable:
    generator, out = np.random.Generator(np.random.Philox(1)), np.zeros(N)
    return lambda: generator.standard_normal(out=out)


def _times(draws: dict[str, Callable]) -> dict[str, list[float]]:
    """Nanoseconds per normal of each, round by round; the first round warms up and does not
    count.
    """
    times = {name: [] for name in draws}
    for _ in range(ROUNDS + 1):
        for name, draw in draws.items():
            start = perf_counter_ns()
            draw()
            times[name].append((perf_counter_ns() - start) / N)
    return {name: of[1:] for name, of in times.items()}


if __name__ == "__main__":
    main()
