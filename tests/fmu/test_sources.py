"""What an FMU's own sources give, compiled as its description says, by fmpy, or into one program
with another FMU's: the bits of its own library.
"""

import os
import shutil
import subprocess
import sys
import zipfile
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from built import built
from fmpy import read_model_description
from fmpy.build import build_platform_binary
from lxml import etree

from pyimu.attitude import attitude_ukf
from pyimu.fmu import FORMS, host_platform, simulate, simulate_blocks
from pyimu.fmu.build import PLATFORMS, header_folder
from pyimu.model.part_file import part

pytestmark = pytest.mark.skipif(shutil.which("gcc") is None, reason="needs gcc")

PART = part("imt30")
BLOCKS = {"ImuSensor": PART.block, "AttitudeUkf": attitude_ukf(PART)}
ROWS = 50


@pytest.fixture(scope="module")
def fmus(tmp_path_factory):
    """Name of the block and form to the product's FMU."""
    return {
        (name, form): path
        for name, block in BLOCKS.items()
        for form, path in built(block, tmp_path_factory).items()
    }


EACH = [(name, form) for name in BLOCKS for form in FORMS]


def named(each):
    return f"{each[0]}-{each[1]}"


def moving(block):
    """Inputs (ROWS, nu) about their start values."""
    noise = np.random.default_rng(5).standard_normal((ROWS, len(block.inputs)))
    return np.array([v.start for v in block.inputs]) + np.where(
        [v.kind == "real" for v in block.inputs], 0.1 * noise, 0.0
    )


def answer(path):
    """Outputs (ROWS + 1, ny) with noise."""
    block = BLOCKS[path.name.partition(".")[0]]
    run = simulate_blocks if path.name.endswith("block.fmu") else simulate
    return run(path, moving(block), sample_period=block.sample_period, start_values=seed_of(block))


def seed_of(block):
    """The seed among the start values, for a block that has one."""
    return {"seed": 3} if block.noise else {}


def sources_of(fmu, folder):
    """The FMU unzipped."""
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(folder)
    return folder


def packed(folder, path):
    """A folder zipped again."""
    path.parent.mkdir()
    with zipfile.ZipFile(path, "w") as archive:
        for file in folder.rglob("*"):
            archive.write(file, file.relative_to(folder))
    return path


def the_library(folder):
    """The one library of an unzipped FMU."""
    (library,) = (folder / "binaries").rglob("*.so")
    return library


def with_library_compiled_by(command, fmu, folder):
    """The FMU with a library that this command makes of its sources."""
    sources_of(fmu, folder / "fmu")
    library = the_library(folder / "fmu")
    library.unlink()
    subprocess.run([*command, "-o", library], cwd=folder / "fmu" / "sources", check=True)
    return packed(folder / "fmu", folder / "packed" / fmu.name)


def configurations(fmu):
    with zipfile.ZipFile(fmu) as archive:
        return etree.fromstring(archive.read("sources/buildDescription.xml")).findall(
            "BuildConfiguration"
        )


def described(configuration):
    """The command that makes a shared library as a build configuration says."""
    files = configuration.find("SourceFileSet")
    definitions = [(d.get("name"), d.get("value")) for d in files.findall("PreprocessorDefinition")]
    return [
        files.get("compiler", "gcc"),
        f"-std={files.get('language').lower()}",
        *files.get("compilerOptions", "").split(),
        *(f"-D{name}={value}" for name, value in definitions),
        *("-shared", "-fPIC", "-I", header_folder()),
        *(f.get("name") for f in files.findall("SourceFile")),
        *(f"-l{library.get('name')}" for library in configuration.findall("Library")),
    ]


@pytest.mark.parametrize("form", (3, "block"))
@pytest.mark.parametrize("name", BLOCKS)
@pytest.mark.parametrize("platform", (None, host_platform()))
def test_sources_compiled_as_described_give_the_bits_of_the_library(
    fmus, name, form, platform, tmp_path
):
    fmu = fmus[name, form]
    chosen = [c for c in configurations(fmu) if c.get("platform") == platform]
    if not chosen:
        pytest.skip(f"no build configuration is for {platform}")
    built = with_library_compiled_by(described(*chosen), fmu, tmp_path)
    np.testing.assert_array_equal(answer(built), answer(fmu))


def has_fma():
    """Whether this processor can multiply and add with one rounding."""
    cpuinfo = Path("/proc/cpuinfo")
    return cpuinfo.exists() and " fma " in cpuinfo.read_text()


@pytest.mark.parametrize("options", ([], ["-O3", "-mfma"]), ids=" ".join)
@pytest.mark.parametrize("name", BLOCKS)
def test_sources_of_fmi_2_give_the_bits_of_the_library(fmus, name, options, tmp_path):
    """FMI 2 names the files and no options; a compiler that is free to contract a product and a sum
    into one rounding does not.
    """
    if options and not has_fma():
        pytest.skip("this processor has no fused multiply-add")
    fmu = fmus[name, 2]
    (configuration,) = read_model_description(str(fmu)).buildConfigurations
    files = configuration.sourceFileSets[0].sourceFiles
    command = ["gcc", *options, "-shared", "-fPIC", "-I", header_folder(), *files]
    np.testing.assert_array_equal(
        answer(with_library_compiled_by(command, fmu, tmp_path)), answer(fmu)
    )


@pytest.mark.parametrize(
    "each", [*(("ImuSensor", form) for form in FORMS), ("AttitudeUkf", "block")], ids=named
)
def test_what_fmpy_compiles_gives_the_bits_of_the_library(fmus, each, tmp_path, monkeypatch):
    """By cmake, which fmpy brings along; how it compiles depends on the form alone."""
    fmu = fmus[each]
    beside_python = str(Path(sys.executable).parent)
    monkeypatch.setenv("PATH", os.pathsep.join((beside_python, os.environ["PATH"])))
    sources_of(fmu, tmp_path / "fmu")
    own = the_library(tmp_path / "fmu").read_bytes()
    # cmake installs nothing over a file of the same time, which a quick machine may give it.
    os.utime(the_library(tmp_path / "fmu"), (0, 0))
    build_platform_binary(tmp_path / "fmu")
    assert the_library(tmp_path / "fmu").read_bytes() != own
    built = packed(tmp_path / "fmu", tmp_path / "packed" / fmu.name)
    np.testing.assert_array_equal(answer(built), answer(fmu))


def test_the_description_names_what_the_schema_leaves_open(fmus):
    """Options are a compiler's; a configuration for each of some platforms, and one for others."""
    found = configurations(fmus["ImuSensor", 3])
    platforms = [c.get("platform") for c in found]
    assert len(set(platforms)) == len(platforms) and platforms[0] is None
    assert set(platforms[1:]) <= set(PLATFORMS)
    for files in (c.find("SourceFileSet") for c in found):
        assert (files.get("compiler") is None) == (files.get("compilerOptions") is None)


# Several in one program


HERE = Path(__file__).parent


def headers(folder):
    """The headers of FMI, with the prefix that fmpy's copy of FMI 2 leaves out."""
    shutil.copytree(header_folder(), folder)
    header = folder / "fmi2Functions.h"
    text = header.read_text().replace(
        "#define fmi2FullName(name) name\n",
        "#define fmi2Paste(a, b) a##b\n#define fmi2PasteB(a, b) fmi2Paste(a, b)\n"
        "#define fmi2FullName(name) fmi2PasteB(FMI2_FUNCTION_PREFIX, name)\n",
    )
    assert "fmi2FullName(name) fmi2PasteB(" in text
    header.write_text(text)
    return folder


def objects(fmu, form, folder, include):
    """Object files of an FMU's sources and of what drives it."""
    name = fmu.name.partition(".")[0]
    sources = sources_of(fmu, folder / name) / "sources"
    description = read_model_description(str(fmu))
    of = {v.name: v for v in description.modelVariables}
    outputs = real_outputs(description)
    defined = {
        f"FMI{description.fmiVersion[0]}_FUNCTION_PREFIX": f"{name}_",
        "BEGIN": f"{name}_begin",
        "STEP": f"{name}_step",
        "NAME": f'"{name}"',
        "TOKEN": f'"{description.guid}"',
        **({"SEED": of["seed"].valueReference} if "seed" in of else {}),
        "OUTPUTS": ",".join(str(v.valueReference) for v in outputs),
        "N_VALUES": sum(int(np.prod(v.shape or (1,))) for v in outputs),
    }
    shutil.copy(HERE / f"drive.fmi{2 if form == 2 else 3}.c", sources / "drive.c")
    flags = ["-w", "-I", include, *(f"-D{n}={value}" for n, value in defined.items())]
    subprocess.run(["gcc", "-c", *flags, "drive.c"], cwd=sources, check=True)
    (sources / "drive.c").unlink()
    subprocess.run(
        ["gcc", "-c", "-I", include, *(p.name for p in sources.glob("*.c"))],
        cwd=sources,
        check=True,
    )
    return sorted(sources.glob("*.o"))


def real_outputs(description):
    return [
        v
        for v in description.modelVariables
        if v.causality == "output" and v.type in ("Real", "Float64")
    ]


def expected(fmu, form, steps):
    """What the product's library answers to inputs that stay at their start values."""
    block = BLOCKS[fmu.name.partition(".")[0]]
    rows = round(1 / block.sample_period) if form == "block" else 1
    u = np.tile([v.start for v in block.inputs], (steps * rows, 1))
    run = simulate_blocks if form == "block" else simulate
    y = run(fmu, u, sample_period=block.sample_period, start_values=seed_of(block))[1:]
    columns = [i for i, v in enumerate(block.outputs) if v.kind == "real"]
    return rows, y[:, columns]


@pytest.fixture(scope="module")
def objects_of(fmus, tmp_path_factory):
    """``objects_of(name, form)``: the object files, compiled once."""
    include = headers(tmp_path_factory.mktemp("headers") / "include")

    @cache
    def made(name, form):
        return objects(fmus[name, form], form, tmp_path_factory.mktemp("objects"), include)

    return made


@pytest.mark.parametrize("form", FORMS)
def test_two_fmus_link_into_one_program(fmus, objects_of, form, tmp_path):
    pair = [fmus[name, form] for name in BLOCKS]
    files = [o for name in BLOCKS for o in objects_of(name, form)]
    steps = 2 if form == "block" else ROWS
    size = PART.block.sample_period * (
        round(1 / PART.block.sample_period) if form == "block" else 1
    )
    command = [
        "gcc",
        f"-DSTEPS={steps}",
        f"-DSIZE={size!r}",
        HERE / "drive_both.c",
        *files,
        "-lm",
        "-o",
        "both",
    ]
    subprocess.run(command, cwd=tmp_path, check=True)
    said = subprocess.run([tmp_path / "both"], capture_output=True, text=True, check=True).stdout
    for fmu in pair:
        name = fmu.name.partition(".")[0]
        have = [float.fromhex(x) for n, x in map(str.split, said.splitlines()) if n == name]
        rows, want = expected(fmu, form, steps)
        arrays = [v.shape for v in real_outputs(read_model_description(str(fmu)))]
        widths = [int(np.prod(shape[1:])) if form == "block" else 1 for shape in arrays]
        of_steps = np.split(np.reshape(have, (steps, -1)), rows * np.cumsum(widths)[:-1], axis=1)
        columns = [a.reshape(steps * rows, w) for a, w in zip(of_steps, widths)]
        np.testing.assert_array_equal(np.hstack(columns), want)


@pytest.mark.skipif(shutil.which("nm") is None, reason="needs nm")
@pytest.mark.parametrize("each", EACH, ids=named)
def test_every_name_of_an_object_file_has_the_prefix(objects_of, each):
    name, files = each[0], objects_of(*each)
    listed = subprocess.run(
        ["nm", "-g", "--defined-only", *files], capture_output=True, text=True, check=True
    ).stdout
    names = {fields[2] for fields in map(str.split, listed.splitlines()) if len(fields) == 3}
    assert names and {n for n in names if not n.startswith(f"{name}_")} == set()
