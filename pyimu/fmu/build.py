"""Texts to .fmu: compile, collect, zip.  Equal blocks and equal compilers give equal bytes."""

from __future__ import annotations

import os
import platform as host
import struct
import subprocess
import sys
import tempfile
import zipfile
import zlib
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from pyimu.block import Block
from pyimu.errors import UserError
from pyimu.fmu.sources import CORE, LAYER, source_folder, template_folder, texts
from pyimu.native import compiler_command

FLAGS = ("-std=c11", "-O3", "-ffp-contract=off", "-fPIC", "-fvisibility=hidden", "-DCASADI_SYMBOL_EXPORT=")
"""Without contracted multiply-adds and without -ffast-math, C gives the bits that casadi's virtual machine gives."""

_ZIP_TIME = (1980, 1, 1, 0, 0, 0)


@dataclass(frozen=True)
class Platform:
    """Where a library runs: its name, which is its folder in FMI 3; its folder in FMI 2; its suffix; zig's name of it."""

    name: str
    fmi2: str
    suffix: str
    zig: str


PLATFORMS = {p.name: p for p in (
    Platform("x86_64-linux", "linux64", ".so", "x86_64-linux-gnu.2.17"),
    Platform("aarch64-linux", "linux64", ".so", "aarch64-linux-gnu.2.17"),
    Platform("x86_64-windows", "win64", ".dll", "x86_64-windows-gnu"),
    Platform("x86_64-darwin", "darwin64", ".dylib", "x86_64-macos.11.0"),
    Platform("aarch64-darwin", "darwin64", ".dylib", "aarch64-macos.11.0"),
)}


def build_fmu(block: Block, out_dir: Path | str, version: int = 2, platform: str = "host") -> Path:
    """Write ``NAME.fmi2.fmu`` or ``NAME.fmi3.fmu`` to ``out_dir``; see ``build_fmus``."""
    return build_fmus(block, out_dir, (version,), platform)[0]


def build_fmus(block: Block, out_dir: Path | str, versions: Sequence[int] = (2, 3), platform: str = "host") -> list[Path]:
    """Write the block as FMI 2.0 and 3.0 co-simulation units; gives their paths, in the order of ``versions``.

    ``platform`` is ``"host"``, which takes the compiler named in ``CC`` or ``cc``; one of ``PLATFORMS`` or ``"all"``,
    which take the compiler of the package ``ziglang``.  What does not depend on the version is compiled once.

    Raises UserError for an unknown version or platform, a missing compiler, and C that does not compile.
    """
    unknown = sorted(set(versions) - set(LAYER))
    if unknown:
        raise UserError(f"FMI version {unknown[0]} is not one of {', '.join(map(str, LAYER))}")
    platforms = _platforms(platform)
    generated = texts(block)
    with tempfile.TemporaryDirectory(prefix="pyimu-") as work:
        libraries = {p: _compile(block.name, generated, versions, p, compiler, Path(work, p.name)) for p, compiler in platforms}
    return [_write(block.name, _contents(generated, v) | _binaries(block.name, v, libraries), v, Path(out_dir)) for v in versions]


def _platforms(name: str) -> list[tuple[Platform, list[str]]]:
    """Each platform that ``name`` means, with the command that compiles for it."""
    if name == "host":
        return [(PLATFORMS[host_platform()], host_compiler())]
    if name != "all" and name not in PLATFORMS:
        raise UserError(f"platform '{name}' is not one of host, all, {', '.join(PLATFORMS)}")
    if find_spec("ziglang") is None:
        raise UserError(f"compiling for platform '{name}' needs the package ziglang: pip install ziglang")
    chosen = PLATFORMS.values() if name == "all" else [PLATFORMS[name]]
    return [(p, [sys.executable, "-m", "ziglang", "cc", "-target", p.zig]) for p in chosen]


def host_platform() -> str:
    """The name in ``PLATFORMS`` of the machine that this runs on.  Raises UserError where it has none."""
    machine = {"AMD64": "x86_64", "arm64": "aarch64"}.get(host.machine(), host.machine())
    name = f"{machine}-{host.system().lower()}"
    if name not in PLATFORMS:
        raise UserError(f"this platform, {name}, is not one of {', '.join(PLATFORMS)}")
    return name


def host_compiler() -> list[str]:
    """The command that compiles for this machine: ``CC``, else ``cc``.  Raises UserError where there is none."""
    command = compiler_command()
    if not command:
        wanted = os.environ.get("CC") or "cc"
        raise UserError(f"no C compiler: '{wanted}' was not found; install one or name it in the environment variable CC")
    return command


def header_folder() -> Path:
    """The FMI headers, which fmpy brings along.  Raises UserError where fmpy has none."""
    spec = find_spec("fmpy")
    folder = Path(spec.origin).parent / "c-code" if spec and spec.origin else None
    if folder is None or not (folder / "fmi3Functions.h").is_file():
        raise UserError("the FMI headers are missing: they come with the package fmpy (pip install fmpy)")
    return folder


def _compile(name: str, generated: dict[str, str], versions: Iterable[int], platform: Platform, compiler: list[str],
             work: Path) -> dict[int, bytes]:
    """The shared library of each version, in bytes."""
    work.mkdir(parents=True)
    files = _source_files(generated, versions)
    for file, content in files.items():
        (work / file).write_bytes(content)
    include = ["-I", ".", "-I", str(header_folder())]
    sources = [f for f in files if f.endswith(".c")]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(lambda file: _run([*compiler, *FLAGS, *include, "-c", file, "-o", _object(file)], work, file), sources))
    layers = {LAYER[v] for v in versions}
    shared = [_object(f) for f in sources if f not in layers]
    return {v: _link(name, [*shared, _object(LAYER[v])], platform, compiler, work) for v in versions}


def _object(source: str) -> str:
    return source.removesuffix(".c") + ".o"


def _link(name: str, objects: list[str], platform: Platform, compiler: list[str], work: Path) -> bytes:
    library = name + platform.suffix
    install_name = [f"-Wl,-install_name,@rpath/{library}"] if platform.suffix == ".dylib" else []
    _run([*compiler, "-shared", "-s", *install_name, "-o", library, *objects, "-lm"], work, library)
    return (work / library).read_bytes()


def _run(command: list[str], folder: Path, what: str) -> None:
    """Compile or link ``what``.  Raises UserError with the compiler's first error, or else its first line."""
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, errors="replace", check=False)
    if done.returncode:
        lines = done.stderr.splitlines() or [f"exit status {done.returncode}"]
        reason = next((line for line in lines if "error" in line), lines[0])
        raise UserError(f"the C compiler '{command[0]}' could not make {what}: {reason}")


def _source_files(generated: dict[str, str], versions: Iterable[int]) -> dict[str, bytes]:
    folder = source_folder()
    files = {file: (folder / file).read_bytes() for file in (*CORE, *(LAYER[v] for v in versions))}
    return files | {file: generated[file].encode() for file in ("step.c", "model_table.h")}


def _write(name: str, entries: dict[str, bytes], version: int, out_dir: Path) -> Path:
    """Zip to a temporary file beside the target and rename, so that nobody ever reads half an FMU."""
    out_dir.mkdir(parents=True, exist_ok=True)
    target = out_dir / f"{name}.fmi{version}.fmu"
    handle, temporary = tempfile.mkstemp(dir=out_dir, prefix=f".{name}.", suffix=".tmp")
    try:
        with os.fdopen(handle, "wb") as file:
            _zip(file, entries)
        os.chmod(temporary, 0o644)
        os.replace(temporary, target)
    except BaseException:
        os.unlink(temporary)
        raise
    return target


def _contents(generated: dict[str, str], version: int) -> dict[str, bytes]:
    """What an FMU holds beside its libraries: path in the archive to bytes."""
    static = {name: (template_folder() / name).read_bytes() for name in ("license.txt", "terminalsAndIcons.xml")}
    entries = {"modelDescription.xml": generated[f"modelDescription.fmi{version}.xml"].encode(),
               "documentation/index.html": generated["index.html"].encode(),
               "documentation/licenses/license.txt": static["license.txt"]}
    entries |= {f"sources/{file}": data for file, data in _source_files(generated, (version,)).items()}
    if version == 2:
        return entries | {"model.png": icon()}
    return entries | {"sources/buildDescription.xml": generated["buildDescription.xml"].encode(),
                      "terminalsAndIcons/terminalsAndIcons.xml": static["terminalsAndIcons.xml"],
                      "terminalsAndIcons/icon.png": icon()}


def _binaries(name: str, version: int, libraries: dict[Platform, dict[int, bytes]]) -> dict[str, bytes]:
    """The libraries by their path in the archive."""
    folders: dict[str, Platform] = {}
    for p in libraries:
        # FMI 2 names folders by system and word size only: the first processor takes it, others get FMI 3's name.
        folder = p.fmi2 if version == 2 and p.fmi2 not in folders else p.name
        folders[folder] = p
    return {f"binaries/{folder}/{name}{p.suffix}": libraries[p][version] for folder, p in folders.items()}


def _zip(file, entries: dict[str, bytes]) -> None:
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted(entries):
            info = zipfile.ZipInfo(path, _ZIP_TIME)
            info.compress_type = zipfile.ZIP_DEFLATED
            info.external_attr = 0o644 << 16
            info.create_system = 3  # the same bytes on every system
            archive.writestr(info, entries[path])


def icon(size: int = 64) -> bytes:
    """The icon as PNG, ``size`` pixels square: a held staircase on a ramp, which is what a sampled unit gives."""
    def pixel(row: int, column: int) -> int:
        x, y, step = column, size - 1 - row, size // 4
        if min(x, y, size - 1 - x, size - 1 - y) == 0 or abs(y - x // step * step) <= 1:
            return 0
        return 160 if abs(x - y) <= 0 else 255
    rows = b"".join(b"\0" + bytes(pixel(row, column) for column in range(size)) for row in range(size))
    header = struct.pack(">IIBBBBB", size, size, 8, 0, 0, 0, 0)
    chunks = ((b"IHDR", header), (b"IDAT", zlib.compress(rows, 9)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)) for kind, data in chunks)
