"""A block's step compiled for this machine: the same C as in its FMU, so the same bits as casadi's virtual machine.

Worth its half second of compiling for long runs of large steps only; without a compiler there is none, and the virtual
machine does the work.
"""

from __future__ import annotations

import ctypes
import os
import shlex
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path

import casadi as ca
import numpy as np

FLAGS = ("-std=c11", "-O1", "-ffp-contract=off", "-fPIC", "-shared", "-w", "-DCASADI_SYMBOL_EXPORT=static")
"""Without contracted multiply-adds, as in the FMUs; -O1 because more costs longer to compile than a log takes to run.
Static, because a libc has a function ``step`` of its own that would answer in place of ours."""

WORTHWHILE = 1.5e8
"""Instructions of a run, a second or so of the virtual machine, from which on compiling pays."""

LOOP = """
void run(long n, double *s, const double *u, const double *p, const double *w, const double *h, double *next, double *y,
         const double **arg, double **res, casadi_int *iw, double *work) {
  for (long k = 0; k < n; ++k) {
    arg[0] = s; arg[1] = u + k * NU; arg[2] = p; arg[3] = w + k * NW; arg[4] = h;
    res[0] = next; res[1] = y + k * NY;
    STEP(arg, res, iw, work, 0);
    for (int i = 0; i < NS; ++i) s[i] = next[i];
  }
}
"""


def compiler_command() -> list[str]:
    """The command that compiles for this machine: ``CC``, else ``cc``; empty where it is not to be found."""
    command = shlex.split(os.environ.get("CC", "")) or ["cc"]
    return command if shutil.which(command[0]) else []


def compiled(step: ca.Function, rows: int) -> Callable | None:
    """A stand-in for ``block.step_through`` on this step, or None where it would not pay or nothing can compile it."""
    if rows * step.n_instructions() < WORTHWHILE:
        return None
    run = _load(_source(step))
    return None if run is None else _bind(run, step)


def _source(step: ca.Function) -> str:
    generator = ca.CodeGenerator("step.c")
    generator.add(step)
    sizes = {"NS": step.numel_in(0), "NU": step.numel_in(1), "NW": step.numel_in(3), "NY": step.numel_out(1), "STEP": step.name()}
    return generator.dump() + "".join(f"#define {name} {value}\n" for name, value in sizes.items()) + LOOP


@lru_cache(maxsize=16)
def _load(source: str) -> ctypes._CFuncPtr | None:
    """Compile and load; the library's file is gone once it is loaded."""
    compiler = compiler_command()
    if not compiler:
        return None
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "step.c"
        path.write_text(source, encoding="utf-8")
        library = Path(folder) / "step.so"
        done = subprocess.run([*compiler, *FLAGS, str(path), "-o", str(library), "-lm"], capture_output=True, check=False)
        if done.returncode:
            return None
        return ctypes.CDLL(str(library)).run


def _bind(run: ctypes._CFuncPtr, step: ca.Function) -> Callable:
    def step_through(_, s, u, p, w, h, y):
        arg, res = np.zeros(step.sz_arg() + 8, dtype=np.uintp), np.zeros(step.sz_res() + 8, dtype=np.uintp)
        iw, work, following = np.zeros(step.sz_iw() + 8, dtype=np.int64), np.zeros(step.sz_w() + 8), np.zeros_like(s)
        pointers = [a.ctypes.data_as(ctypes.c_void_p) for a in (s, u, p, w, h, following, y, arg, res, iw, work)]
        run(ctypes.c_long(len(u)), *pointers)
        return s
    return step_through
