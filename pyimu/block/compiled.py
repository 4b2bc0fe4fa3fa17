"""A block's step compiled for this machine, with the loop over the samples and the noise around it.

It is the C of the block's FMU, step and noise alike, so the bits are those of the FMU and of
casadi's virtual machine, although it may use all that this processor has. Compiling takes 0.05 to
10 s. A library is therefore kept between processes in the user's cache folder, and a step is
compiled only once that pays; without a compiler it never is, and the virtual machine does the work.
"""

from __future__ import annotations

import contextlib
import ctypes
import os
import platform
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Callable
from functools import cache, lru_cache
from importlib.util import find_spec
from pathlib import Path

import casadi as ca
import numpy as np

from pyimu.block.c_code import Body, c_code, with_entries_set
from pyimu.block.cache import keep, kept, key_of
from pyimu.block.prepared import Prepared
from pyimu.block.straight import straight
from pyimu.block.vectors import vectors
from pyimu.errors import UserError
from pyimu.files.held import work_folder

SAME_BITS = (
    "-std=c11",
    "-O3",
    "-ffp-contract=off",
    "-fno-math-errno",
    "-fPIC",
    "-fvisibility=hidden",
)
"""Flags of every library, those of the FMUs, too. Without contracted multiply-adds and without
-ffast-math, C gives the bits that casadi's virtual machine gives. Nobody asks for ``errno`` after a
root, which is an instruction less a call without it."""

FLAGS = (
    *SAME_BITS,
    "-shared",
    "-w",
    "-DCASADI_SYMBOL_EXPORT=static",
    "-DMODEL_PREFIX=run_",
)
"""The step is static, because a libc has a function ``step`` of its own that would answer in place
of ours."""

BESIDE_VECTORS = ("-fno-tree-slp-vectorize",)
"""A compiler that makes vectors of its own beside those that are written out gives other bits: gcc
12.2 did, of a whole filter."""

COMPILED_SOON = ("-O2", "-fno-tree-pre", "-fno-code-hoisting", "-fno-gcse")
"""Of gcc, whose searches for what is computed twice take two thirds of its time with a step of
60,000 lines, where casadi left nothing to find: 18 s became 6, a sample takes 3 to 15 % more."""

OLDEST = 7
"""Version of gcc that has all of these options."""

OWN = "-march=native"
"""Compiles for this very processor. What it has beside the least of its kind does the same
arithmetic in fewer instructions, and the bits are the same."""

HAND_WRITTEN = ("loop.h", "noise.c", "noise.h", "prefix.h", "vector.h")
"""What of the hand-written C a library is made of."""

VECTORS = '#include "vector.h"\n'

WRITERS = (
    "alike.py",
    "c_code.py",
    "compiled.py",
    "program.py",
    "straight.py",
    "unit_order.py",
    "vector_cost.py",
    "vector_plan.py",
    "vectors.py",
)
"""What makes the source of functions, by which a library is named: to write it takes ten times as
long as to list what they compute, and is left until there is none."""

LOOKED_FOR = 2_000
"""Samples of a step in one process, some milliseconds of the virtual machine, from which on the
cache is searched."""

WORTHWHILE = 50_000
"""Samples of a step in one process from which on it is compiled.

The virtual machine takes 0.6 us and 2 to 4 ns an instruction for a sample, the compiler 40 ms and
0.2 to 0.4 ms an instruction: whatever the step, a compiler's time is that of about 100,000
samples. Half of it, as others will find the library."""


ZIG = (sys.executable, "-m", "ziglang", "cc")
"""The compiler of the package ``ziglang``, the extra ``pyimu[compiler]``."""


def compiler_command() -> list[str]:
    """The command that compiles for this machine: ``CC``, else ``cc``, else the package ``ziglang``
    if it is there; empty without a compiler. Raises UserError for a ``CC`` with half a quotation.
    """
    named = os.environ.get("CC", "")
    try:
        words = shlex.split(named, posix=os.name != "nt")  # there a backslash is part of a path
    except ValueError as error:
        raise UserError(f"environment variable CC: {error} in {named!r}") from None
    given = [word.strip('"') for word in words] if os.name == "nt" else words
    command = given or ["cc"]
    if shutil.which(command[0]):
        return command
    return list(ZIG) if not given and find_spec("ziglang") else []


def flags(compiler: list[str]) -> list[str]:
    """The flags for a library that only this machine will use."""
    known = _processor(tuple(compiler))
    soon = COMPILED_SOON * (_version_of_gcc(known) >= OLDEST)
    return [*FLAGS, *soon, *[OWN] * bool(known)]


def _version_of_gcc(known: str) -> int:
    """The number by what a compiler knows, zero of one that only says that it is like gcc."""
    found = re.search(r"^#define __GNUC__ (\d+)$", known, re.MULTILINE)
    return 0 if found is None or "#define __clang__" in known else int(found[1])


@cache
def _processor(compiler: tuple[str, ...]) -> str:
    """What a compiler knows of this processor, as a text; empty where it cannot compile for it."""
    asked = [*compiler, OWN, "-dM", "-E", "-x", "c", os.devnull]
    found = subprocess.run(asked, capture_output=True, text=True, errors="replace", check=False)
    return "" if found.returncode else found.stdout


def source_folder() -> Path:
    """The folder of the hand-written C.

    It is ``fmu_src`` beside the package in a checkout, inside it in an installed wheel.
    """
    package = Path(__file__).resolve().parents[1]
    for folder in (package / "fmu_src", package.parent / "fmu_src"):
        if (folder / "noise.c").is_file():
            return folder
    raise FileNotFoundError(f"the C sources fmu_src are neither in {package} nor beside it")


def compiled(step: ca.Function, rows: int, prepared: Prepared | None = None) -> Callable | None:
    """The compiled loop over a step for ``rows`` more samples, None where there is none.

    It is ``run(s, u, p, h, y, w, channels, seed, first)``, which fills ``y``; what is compiled of
    the step is the form in which it is ``prepared``, if it has one. There is none where no library
    is at hand and compiling would not pay or cannot be done.
    """
    return _machine_code(step, prepared).after(rows)


@lru_cache(maxsize=64)
def _machine_code(step: ca.Function, prepared: Prepared | None) -> _MachineCode:
    return _MachineCode(step, prepared)


class _MachineCode:
    """The machine code of one step, once there is a library, and the samples asked for so far."""

    def __init__(self, step: ca.Function, prepared: Prepared | None) -> None:
        self.step, self.prepared = step, prepared
        self.rows, self.call, self.tried = 0, None, 0

    def after(self, rows: int) -> Callable | None:
        """Look for the library, and later compile it, at most once each."""
        self.rows += int(rows)  # two bools of numpy add up to one
        reached = (self.rows >= LOOKED_FOR) + (self.rows >= WORTHWHILE)
        if self.call is None and reached > self.tried:
            functions = _functions(self.step, self.prepared)
            library = _library(functions, reached == 2)
            self.tried, self.call = reached, library and _bind(library, functions)
        return self.call


def _functions(step: ca.Function, prepared: Prepared | None) -> list[ca.Function]:
    """What the loop calls: the step, and what it takes of it before the first sample."""
    return [step] if prepared is None else [prepared.step, prepared.constants]


def _source(functions: list[ca.Function], body: Body = straight) -> str:
    """The step in C and the loop around it."""
    step, *constants = functions
    sizes = {
        "NS": step.numel_in(0),
        "NU": step.numel_in(1),
        "NW": step.numel_in(3),
        "NY": step.numel_out(1),
        "NC": sum(f.numel_out(0) for f in constants),
        "SZ_ARG": max(f.sz_arg() for f in functions),
        "SZ_RES": max(f.sz_res() for f in functions),
        "STEP": step.name(),
    }
    sizes |= {"CONSTANTS": f.name() for f in constants}
    return (
        with_entries_set(c_code("step.c", functions, body))
        + "".join(f"#define {name} {value}\n" for name, value in sizes.items())
        + '#include "loop.h"\n'
    )


def _bind(library: ctypes.CDLL, functions: list[ca.Function]) -> Callable:
    address = [ctypes.c_void_p] * 7
    call = library.run
    call.argtypes = [
        ctypes.c_int64,
        *address,
        ctypes.c_uint64,
        ctypes.c_int64,
        ctypes.c_void_p,
        ctypes.c_void_p,
    ]
    call.restype = ctypes.c_int64
    iw_size, work_size = (max(s) + 1 for s in zip(*((f.sz_iw(), f.sz_w()) for f in functions)))

    def run(s, u, p, h, y, w, channels, seed, first) -> None:
        iw, work = np.zeros(iw_size, dtype=np.int64), np.zeros(work_size)
        given = [None if a is None else a.ctypes.data for a in (s, u, p, h, y, w, channels)]
        done = call(len(u), *given, seed, first, iw.ctypes.data, work.ctypes.data)
        if done < len(u):
            raise RuntimeError(f"{functions[0].name()}: row {done} cannot be evaluated")

    return run


# The library: in this process, in the cache folder, or compiled

_loaded: dict[str, ctypes.CDLL] = {}


def _library(functions: list[ca.Function], compile_it: bool) -> ctypes.CDLL | None:
    compiler = compiler_command()
    if not compiler:
        return None
    key = _key(_listed(functions), tuple(compiler))
    if key not in _loaded:
        library = _from_cache(key)
        if library is None and compile_it:
            with contextlib.suppress(OSError, UserError):  # no place: the virtual machine does it
                library = _compile(functions, compiler, key)
        if library is None:
            return None
        _loaded[key] = library
    return _loaded[key]


def _listed(functions: list[ca.Function]) -> str:
    """What functions compute, as casadi keeps it in files."""
    return "\n".join(f.serialize() for f in functions)


def _key(listed: str, compiler: tuple[str, ...]) -> str:
    """Whatever the library's bytes follow from, as a name."""
    hand_written = [(source_folder() / name).read_bytes() for name in HAND_WRITTEN]
    writers = [Path(__file__).with_name(name).read_bytes() for name in WRITERS]
    # A home may be shared with machines of other processors.
    texts = [
        listed,
        ca.CasadiMeta.version(),
        *flags([*compiler]),
        *BESIDE_VECTORS,
        sys.platform,
        platform.machine(),
        _processor(compiler),
    ]
    return key_of(compiler, *(t.encode() for t in texts), *hand_written, *writers)


def _has_vectors(compiler: tuple[str, ...]) -> bool:
    """Whether this processor has registers for vectors of four numbers, and the compiler a type."""
    known = _processor(compiler)
    return "#define __AVX2__ 1" in known and "#define __GNUC__" in known


def _compile(functions: list[ca.Function], compiler: list[str], key: str) -> ctypes.CDLL | None:
    """Compile in a temporary folder, keep a copy in the cache and load the library.

    The library's own file is gone once it is loaded.
    """
    wide = _has_vectors(tuple(compiler))
    source = VECTORS * wide + _source(functions, vectors if wide else straight)
    with contextlib.suppress(OSError, UserError), work_folder() as folder:
        path, library, hand_written = folder / "run.c", folder / "run.so", source_folder()
        path.write_text(source, encoding="utf-8")
        files = [str(path), str(hand_written / "noise.c"), "-I", str(hand_written)]
        if subprocess.run(
            [
                *compiler,
                *flags(compiler),
                *BESIDE_VECTORS * wide,
                *files,
                "-o",
                str(library),
                "-lm",
            ],
            capture_output=True,
            check=False,
        ).returncode:
            return None
        keep(key, library.read_bytes())
        return ctypes.CDLL(str(library))


def _from_cache(key: str) -> ctypes.CDLL | None:
    """A library of the cache, if it can be loaded."""
    for path in kept(key):
        with contextlib.suppress(OSError):
            return ctypes.CDLL(str(path))
    return None
