"""Example: python fuzz/units.py --calls 100000

Call the co-simulation units in random order, with good, bad and missing arguments, under gcc's
sanitizers of addresses, undefined behaviour and leaks. What each call must answer the fuzzer
(units.c) knows by itself. The first wrong answer ends it, with the seed that finds it again.
"""

from __future__ import annotations

import argparse
import os
import shlex
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from pyimu.block.block import Block
from pyimu.fmu.build import FORMS, header_folder, source_files
from pyimu.fmu.generate import reference_blocks
from pyimu.fmu.sources import Form, texts

HERE = Path(__file__).resolve().parent

FLAGS = (
    "-std=c11",
    "-O1",
    "-g1",
    "-ffp-contract=off",
    "-fsanitize=address,undefined,float-cast-overflow",
    "-fno-sanitize-recover=all",
    "-Wno-unused-function",
    "-DFMI2_OVERRIDE_FUNCTION_PREFIX",
    "-DFMI3_OVERRIDE_FUNCTION_PREFIX",
)
"""Leaks are looked for with addresses; a number that does not fit its integer is no undefined
behaviour for gcc by itself."""


def compiled(block: Block, form: Form, folder: Path) -> Path:
    """The fuzzer of one form of a unit, made in ``folder``."""
    files = source_files(texts(block, [form]), form)
    for name, content in files.items():
        (folder / name).write_bytes(content)
    program = folder / f"{block.name}.{form}"
    sources = [str(folder / name) for name in files if name.endswith(".c")]
    include = [word for f in (folder, HERE, header_folder()) for word in ("-I", str(f))]
    own = [f"-DFUZZ_FMI={2 if form == 2 else 3}", *include, str(HERE / "units.c")]
    compiler = shlex.split(os.environ.get("CC", "")) or ["gcc"]
    subprocess.run([*compiler, *FLAGS, *own, *sources, "-o", str(program), "-lm"], check=True)
    return program


def fuzz(program: Path, seed: int, calls: int) -> bool:
    """Run a fuzzer and print what it says; whether it found nothing."""
    began = time.monotonic()
    done = subprocess.run(
        [program, str(seed), str(calls)], capture_output=True, text=True, check=False
    )
    said = done.stdout.strip() if done.returncode == 0 else f"FAILED\n{done.stderr}"
    print(f"{program.name}, seed {seed}: {said}, {time.monotonic() - began:.1f} s", flush=True)
    return done.returncode == 0


def main() -> int:
    blocks = {block.name: block for block in reference_blocks()}
    forms: dict[str, Form] = {str(form): form for form in FORMS}
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--calls", type=int, default=1_000_000, help="of each unit in each form")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--units", default=",".join(blocks), help="default: %(default)s")
    parser.add_argument("--forms", default=",".join(forms), help="default: %(default)s")
    given = parser.parse_args()
    good = True
    for name in given.units.split(","):
        for form in given.forms.split(","):
            with tempfile.TemporaryDirectory() as folder:
                program = compiled(blocks[name], forms[form], Path(folder))
                good = fuzz(program, given.seed, given.calls) and good
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
