"""Units of the part imt30 that another machine built, in the folder PYIMU_UNITS: here they give the
bits of Python, noise and all.

So that what is cross-compiled for a platform is run on it, as in .github/workflows/tests.yml. Where
there is the package ziglang, the units of other platforms are made and run on this machine, too, by
what emulates them.
"""

import os
import shutil
import subprocess
import zipfile
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
from fmpy import read_model_description

from pyimu.fmu import FORMS, build_fmu, host_platform, simulate, simulate_blocks
from pyimu.fmu.build import PLATFORMS, file_name, header_folder, zig
from pyimu.fmu.package import BLOCKS
from pyimu.model.part_file import part

FOLDER = os.environ.get("PYIMU_UNITS")

BLOCK = part("imt30").block
SEED = 11  # as in run_elsewhere.c


def driven(block, rows):
    """Inputs (rows, nu) about their start values; each flag is set now and then."""
    rng = np.random.default_rng(8)
    found = np.array([v.start for v in block.inputs])
    found = found + 0.1 * rng.standard_normal((rows, len(block.inputs)))
    for i, v in enumerate(block.inputs):
        if v.kind == "boolean":
            found[:, i] = rng.random(rows) < 0.02
        elif v.name.endswith(("_variance", "_age")):
            found[:, i] = abs(found[:, i])
    return found


@pytest.mark.skipif(FOLDER is None, reason="needs units, in a folder PYIMU_UNITS")
@pytest.mark.parametrize("form", FORMS)
def test_the_sensor_gives_the_bits_of_python(form):
    inputs = driven(BLOCK, 20_000)
    run = simulate_blocks if form == "block" else simulate
    unit = Path(FOLDER, file_name(BLOCK.name, form))
    outputs = run(unit, inputs, sample_period=BLOCK.sample_period, start_values={"seed": SEED})
    np.testing.assert_array_equal(outputs[1:], BLOCK.run(inputs, seed=SEED)[0])


RUNNERS = {
    "x86_64-linux": [],
    "aarch64-linux": ["qemu-aarch64-static", "-L", "/usr/aarch64-linux-gnu"],
    "x86_64-windows": ["wine"],
}
"""What runs a program of a platform on Linux on x86-64. For Arm the C library is that of Debian's
package libc6-arm64-cross; for macOS there is nothing."""


ONE = "sensor"
UNITS = [pytest.param(n, marks=[pytest.mark.long] * (n != ONE)) for n in BLOCKS]


@pytest.mark.skipif(find_spec("ziglang") is None, reason="needs the package ziglang")
@pytest.mark.parametrize("unit", UNITS)
@pytest.mark.parametrize("name", RUNNERS)
def test_a_unit_of_another_platform_gives_the_bits_of_python(name, unit, tmp_path):
    """The FMI 3 form, cross-compiled, driven by a program that is cross-compiled too."""
    runner = RUNNERS[name]
    if host_platform() != "x86_64-linux" or not all(map(shutil.which, runner[:1])):
        pytest.skip(f"needs Linux on x86-64 and {(runner or ['nothing'])[0]}")
    block, platform = BLOCKS[unit](part("imt30")), PLATFORMS[name]
    fmu = build_fmu(block, tmp_path, 3, name)
    with zipfile.ZipFile(fmu) as archive:
        library = archive.extract(f"binaries/{name}/{block.name}{platform.suffix}", tmp_path)
    inputs = driven(block, 2000)
    outputs = run_elsewhere(fmu, library, block, inputs, platform, runner, tmp_path)
    seed = SEED if block.noise else None
    expected = block.run(inputs, **({} if seed is None else {"seed": seed}))[0]
    reals = [i for i, v in enumerate(block.outputs) if v.kind == "real"]
    np.testing.assert_array_equal(outputs, expected[:, reals])


def run_elsewhere(fmu, library, block, inputs, platform, runner, folder):
    """The real outputs of a unit's ``library`` by a program of its platform, in a ``folder``."""
    program = folder / ("run.exe" if platform.suffix == ".dll" else "run")
    source = Path(__file__).with_name("run_elsewhere.c")
    compiler = [*zig(platform), "-O1", "-I", str(header_folder()), str(source), "-o", str(program)]
    subprocess.run(compiler, check=True, cwd=folder)
    described = read_model_description(fmu)
    refs = {v.name: str(v.valueReference) for v in described.modelVariables}
    flags = [i for i, v in enumerate(block.inputs) if v.kind == "boolean"]
    reals = [i for i, v in enumerate(block.inputs) if v.kind == "real"]
    given = [block.inputs[i].name for i in (*flags, *reals)]
    told = [v.name for v in block.outputs if v.kind == "real"]
    np.ascontiguousarray(inputs[:, [*flags, *reals]]).tofile(folder / "in")
    sizes = [str(n) for n in (len(inputs), len(flags), len(reals), len(told))]
    said = [described.instantiationToken, refs.get("seed", "-1"), repr(block.sample_period), *sizes]
    command = [*runner, str(program), library, *said, *(refs[n] for n in (*given, *told))]
    # A program of Windows starts a server, which keeps what it inherits open.
    with open(folder / "said", "w") as log:
        own = os.environ | {"WINEPREFIX": str(folder / "wine"), "WINEDEBUG": "-all"}
        done = subprocess.run(command, cwd=folder, env=own, check=False, stdout=log, stderr=log)
    assert done.returncode == 0, (folder / "said").read_text()
    return np.fromfile(folder / "out").reshape(len(inputs), -1)
