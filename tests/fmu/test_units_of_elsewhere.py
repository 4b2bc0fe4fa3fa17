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
from pyimu.model.part_file import part

FOLDER = os.environ.get("PYIMU_UNITS")

BLOCK = part("imt30").block


def driven(rows):
    """Inputs (rows, nu) about their start values."""
    start = np.array([v.start for v in BLOCK.inputs])
    return start + 0.1 * np.random.default_rng(8).standard_normal((rows, len(start)))


@pytest.mark.skipif(FOLDER is None, reason="needs units, in a folder PYIMU_UNITS")
@pytest.mark.parametrize("form", FORMS)
def test_the_sensor_gives_the_bits_of_python(form):
    inputs = driven(20_000)
    run = simulate_blocks if form == "block" else simulate
    unit = Path(FOLDER, file_name(BLOCK.name, form))
    outputs = run(unit, inputs, sample_period=BLOCK.sample_period, start_values={"seed": 11})
    np.testing.assert_array_equal(outputs[1:], BLOCK.run(inputs, seed=11)[0])


RUNNERS = {
    "x86_64-linux": [],
    "aarch64-linux": ["qemu-aarch64-static", "-L", "/usr/aarch64-linux-gnu"],
    "x86_64-windows": ["wine"],
}
"""What runs a program of a platform on Linux on x86-64. For Arm the C library is that of Debian's
package libc6-arm64-cross; for macOS there is nothing."""


@pytest.mark.skipif(find_spec("ziglang") is None, reason="needs the package ziglang")
@pytest.mark.parametrize("name", RUNNERS)
def test_a_unit_of_another_platform_gives_the_bits_of_python(name, tmp_path):
    """The FMI 3 form, cross-compiled, driven by a program that is cross-compiled too."""
    runner = RUNNERS[name]
    if host_platform() != "x86_64-linux" or not all(map(shutil.which, runner[:1])):
        pytest.skip(f"needs Linux on x86-64 and {(runner or ['nothing'])[0]}")
    unit, platform = build_fmu(BLOCK, tmp_path, 3, name), PLATFORMS[name]
    with zipfile.ZipFile(unit) as archive:
        library = archive.extract(f"binaries/{name}/{BLOCK.name}{platform.suffix}", tmp_path)
    program = tmp_path / ("run.exe" if platform.suffix == ".dll" else "run")
    source = Path(__file__).with_name("run_elsewhere.c")
    compiler = [*zig(platform), "-O1", "-I", str(header_folder()), str(source), "-o", str(program)]
    subprocess.run(compiler, check=True, cwd=tmp_path)
    inputs, described = driven(2000), read_model_description(unit)
    refs = {v.name: str(v.valueReference) for v in described.modelVariables}
    names = [v.name for v in (*BLOCK.inputs, *BLOCK.outputs)]
    inputs.tofile(tmp_path / "in")
    sizes = [str(n) for n in (len(inputs), len(BLOCK.inputs), len(BLOCK.outputs))]
    said = [described.instantiationToken, refs["seed"], repr(BLOCK.sample_period), *sizes]
    command = [*runner, str(program), library, *said, *(refs[n] for n in names)]
    # A program of Windows starts a server, which keeps what it inherits open.
    with open(tmp_path / "said", "w") as log:
        own = os.environ | {"WINEPREFIX": str(tmp_path / "wine"), "WINEDEBUG": "-all"}
        done = subprocess.run(command, cwd=tmp_path, env=own, check=False, stdout=log, stderr=log)
    assert done.returncode == 0, (tmp_path / "said").read_text()
    outputs = np.fromfile(tmp_path / "out").reshape(len(inputs), -1)
    np.testing.assert_array_equal(outputs, BLOCK.run(inputs, seed=11)[0])
