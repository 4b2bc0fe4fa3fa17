"""Texts to .fmu: compile, collect, zip. Equal blocks and equal compilers give equal bytes."""

from __future__ import annotations

import os
import platform as host
import struct
import subprocess
import tempfile
import zipfile
import zlib
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import BinaryIO

from pyimu.block.block import Block
from pyimu.block.cache import keep, kept_bytes, key_of
from pyimu.block.compiled import SAME_BITS, ZIG, compiler_command, source_folder
from pyimu.display.silent import silent
from pyimu.errors import UserError
from pyimu.files import whole
from pyimu.files.held import work_folder
from pyimu.fmu.sources import (
    CORE,
    DESCRIPTION,
    LAYER,
    PAGE,
    TABLE,
    TERMINALS,
    Form,
    template_folder,
    texts,
)

FLAGS = (
    *SAME_BITS,
    "-DFMI2_OVERRIDE_FUNCTION_PREFIX",
    "-DFMI3_OVERRIDE_FUNCTION_PREFIX",
)
"""In a library FMI's functions have their own names, without the model's prefix."""

OLD_GLIBC = "-DOLD_GLIBC"
"""On Linux the library loads from glibc 2.17 on, as zig's do, whose names of platforms say so."""

SCALAR_FORMS: tuple[Form, ...] = (2, 3)

FORMS: tuple[Form, ...] = (2, 3, "block")
"""Every form of an FMU, in the order in which they are built."""

ZIP_TIME = (1980, 1, 1, 0, 0, 0)


@dataclass(frozen=True)
class Platform:
    """A platform of libraries.

    Its name, which is its folder in FMI 3; its folder in FMI 2; its suffix; zig's name of it.
    """

    name: str
    fmi2: str
    suffix: str
    zig: str


PLATFORMS = {
    p.name: p
    for p in (
        Platform("x86_64-linux", "linux64", ".so", "x86_64-linux-gnu.2.17"),
        Platform("aarch64-linux", "linux64", ".so", "aarch64-linux-gnu.2.17"),
        Platform("x86_64-windows", "win64", ".dll", "x86_64-windows-gnu"),
        Platform("x86_64-darwin", "darwin64", ".dylib", "x86_64-macos.11.0"),
        Platform("aarch64-darwin", "darwin64", ".dylib", "aarch64-macos.11.0"),
    )
}


def build_fmu(block: Block, out_dir: Path | str, form: Form = 2, platform: str = "host") -> Path:
    """Write one form of the FMU to ``out_dir``; see ``build_fmus``."""
    return build_fmus(block, out_dir, (form,), platform)[0]


def build_fmus(
    block: Block,
    out_dir: Path | str,
    forms: Sequence[Form] = SCALAR_FORMS,
    platform: str = "host",
    heard: Callable[[float], None] = silent,
) -> list[Path]:
    """Write the block as co-simulation units; gives their paths, in the order of ``forms``.

    A form is 2 or 3, the version of FMI of a unit with scalars, written to ``NAME.fmi2.fmu`` and
    ``NAME.fmi3.fmu``; or "block", an FMI 3.0 unit that takes a block of samples per step, in
    arrays, written to ``NAME.block.fmu``. ``platform`` is ``"host"``, which takes the compiler
    named in ``CC``, ``cc`` or the package ``ziglang``; one of ``PLATFORMS`` or ``"all"``, which
    take that of the package ``ziglang``. What does not depend on the form is compiled once.
    ``heard`` is told which share of the compiler's work is done.

    Raises UserError for an unknown form or platform, a missing compiler, C that does not compile,
    and a folder that cannot be written to.
    """
    for form in forms:
        if form not in LAYER:
            raise UserError(f"FMI version {form} is not one of {', '.join(map(str, LAYER))}")
    platforms = _platforms(platform)
    generated = texts(block, forms)
    try:
        with work_folder() as work:
            libraries: dict[Platform, dict[Form, bytes]] = {}
            for k, (p, compiler) in enumerate(platforms):
                libraries[p] = _compile(
                    *(block.name, generated, forms, p, compiler, work / p.name),
                    partial(part_of, heard, k, len(platforms)),
                )
    except OSError as error:
        raise UserError(
            f"{tempfile.gettempdir()}: cannot be written ({error.strerror or error}); TMPDIR names "
            "another folder for temporary files"
        ) from None
    return [
        _write(
            _contents(generated, form) | _binaries(block.name, form, libraries),
            Path(out_dir) / file_name(block.name, form),
        )
        for form in forms
    ]


def part_of(heard: Callable[[float], None], k: int, parts: int, share: float) -> None:
    """Tell ``heard`` the share of all where ``share`` is that of part ``k``."""
    heard((k + share) / parts)


def file_name(name: str, form: Form) -> str:
    """What the FMU of the block ``name`` is called in this form."""
    return f"{name}.{form if form == 'block' else f'fmi{form}'}.fmu"


def _platforms(name: str) -> list[tuple[Platform, list[str]]]:
    """Each platform that ``name`` means, with the command that compiles for it."""
    if name == "host":
        own, command = PLATFORMS[host_platform()], host_compiler()
        return [(own, zig(own) if command == list(ZIG) else [*command, OLD_GLIBC])]
    if name != "all" and name not in PLATFORMS:
        raise UserError(f"platform '{name}' is not one of host, all, {', '.join(PLATFORMS)}")
    if find_spec("ziglang") is None:
        raise UserError(
            f"compiling for platform '{name}' needs the package ziglang: pip install ziglang"
        )
    chosen = PLATFORMS.values() if name == "all" else [PLATFORMS[name]]
    return [(p, zig(p)) for p in chosen]


def zig(platform: Platform) -> list[str]:
    """The command of the package ``ziglang`` that compiles for a platform."""
    return [*ZIG, "-target", platform.zig]


def host_platform() -> str:
    """The name in ``PLATFORMS`` of this machine. Raises UserError where it has none."""
    machine = {"AMD64": "x86_64", "arm64": "aarch64"}.get(host.machine(), host.machine())
    name = f"{machine}-{host.system().lower()}"
    if name not in PLATFORMS:
        raise UserError(f"this platform, {name}, is not one of {', '.join(PLATFORMS)}")
    return name


def host_compiler() -> list[str]:
    """What ``compiler_command`` says. Raises UserError where there is no compiler."""
    command = compiler_command()
    if not command:
        wanted = os.environ.get("CC") or "cc"
        raise UserError(
            f"no C compiler: '{wanted}' was not found; install one or name it in the environment "
            "variable CC, or pip install ziglang"
        )
    return command


def header_folder() -> Path:
    """The FMI headers, which fmpy brings along. Raises UserError where fmpy has none."""
    spec = find_spec("fmpy")
    folder = Path(spec.origin).parent / "c-code" if spec and spec.origin else None
    if folder is None or not (folder / "fmi3Functions.h").is_file():
        raise UserError(
            "the FMI headers are missing: they come with the package fmpy (pip install fmpy)"
        )
    return folder


def _compile(
    name: str,
    generated: dict[str, str],
    forms: Sequence[Form],
    platform: Platform,
    compiler: list[str],
    work: Path,
    heard: Callable[[float], None],
) -> dict[Form, bytes]:
    """The shared library of each form, in bytes; what was made before is not made again."""
    files = {form: source_files(generated, form) for form in forms}
    keys = {form: _library_key(name, files[form], form, platform, compiler) for form in forms}
    found = {form: made for form, key in keys.items() if (made := kept_bytes(key))}
    missing = [form for form in forms if form not in found]
    for form in missing:
        _write_sources(files[form], work, work / _table_folder(form))
    objects = {form: _objects(form) for form in missing}
    jobs = {target: job for of_form in objects.values() for target, job in of_form.items()}
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        compiling = pool.map(lambda target: _make(target, *jobs[target], compiler, work), jobs)
        for done, _ in enumerate(compiling):
            heard((done + 1) / len(jobs))
    for form in missing:
        found[form] = _link(name, list(objects[form]), platform, compiler, work)
        keep(keys[form], found[form])
    return found


def _library_key(
    name: str, files: dict[str, bytes], form: Form, platform: Platform, compiler: list[str]
) -> str:
    """Whatever a library's bytes follow from, as a name."""
    parts = [part for file in sorted(files) for part in (file.encode(), files[file])]
    texts = (name, str(form), platform.name, *FLAGS)
    return key_of(compiler, *(t.encode() for t in texts), *parts, *_fmi_headers())


def _make(target: str, source: str, folder: str, compiler: list[str], work: Path) -> None:
    """Compile a ``source`` to the object file ``target``, with the headers of its ``folder`` if it
    has one, or take the one that was made of the same before.
    """
    folders = [".", *([folder] if folder else [])]
    read = [work / source, *(p for f in folders for p in sorted((work / f).glob("*.h")))]
    parts = [target.encode(), *(t.encode() for t in FLAGS)]
    parts += [b for path in read for b in (path.name.encode(), path.read_bytes())]
    key = key_of(compiler, *parts, *_fmi_headers())
    made = kept_bytes(key)
    if made is not None:
        (work / target).write_bytes(made)
        return
    headers = [word for f in (*folders, str(header_folder())) for word in ("-I", f)]
    _run([*compiler, *FLAGS, *headers, "-c", source, "-o", target], work, source)
    keep(key, (work / target).read_bytes())


def _fmi_headers() -> list[bytes]:
    return [path.read_bytes() for path in sorted(header_folder().glob("*.h"))]


def _objects(form: Form) -> dict[str, tuple[str, str]]:
    """Each object file of a form, with its source and the folder of its table of variables, which
    ``block*.c`` alone can read.
    """
    sources = [*(file for file in CORE if file.endswith(".c")), LAYER[form], "step.c"]
    folder = _table_folder(form)
    return {
        f"{f'{of_form}_' if of_form else ''}{file.removesuffix('.c')}.o": (file, of_form)
        for file in sources
        for of_form in [folder if file.startswith("block") else ""]
    }


def _table_folder(form: Form) -> str:
    return TABLE[form].removesuffix(".h")


def _write_sources(files: dict[str, bytes], work: Path, table_folder: Path) -> None:
    """The table of variables by itself, as the other files are those of every form."""
    table_folder.mkdir(parents=True, exist_ok=True)
    for file, content in files.items():
        folder = table_folder if file == "model_table.h" else work
        (folder / file).write_bytes(content)


def _link(
    name: str, objects: list[str], platform: Platform, compiler: list[str], work: Path
) -> bytes:
    library = name + platform.suffix
    install_name = [f"-Wl,-install_name,@rpath/{library}"] if platform.suffix == ".dylib" else []
    _run([*compiler, "-shared", "-s", *install_name, "-o", library, *objects, "-lm"], work, library)
    return (work / library).read_bytes()


def _run(command: list[str], folder: Path, what: str) -> None:
    """Compile or link ``what``.

    Raises UserError with the compiler's first error, or else its first line.
    """
    done = subprocess.run(
        command, cwd=folder, capture_output=True, text=True, errors="replace", check=False
    )
    if done.returncode:
        lines = done.stderr.splitlines() or [f"exit status {done.returncode}"]
        reason = next((line for line in lines if "error" in line), lines[0])
        raise UserError(f"the C compiler '{command[0]}' could not make {what}: {reason}")


def source_files(generated: dict[str, str], form: Form) -> dict[str, bytes]:
    """The C of one form: name of a file to its bytes."""
    folder = source_folder()
    files = {file: (folder / file).read_bytes() for file in (*CORE, LAYER[form])}
    return files | {
        **{file: generated[file].encode() for file in ("step.c", "model_prefix.h")},
        "model_table.h": generated[TABLE[form]].encode(),
    }


def _write(entries: dict[str, bytes], target: Path) -> Path:
    with whole(target) as unfinished, unfinished.open("wb") as file:
        _zip(file, entries)
    return target


def _contents(generated: dict[str, str], form: Form) -> dict[str, bytes]:
    """What an FMU holds beside its libraries: path in the archive to bytes."""
    entries = {
        "modelDescription.xml": generated[DESCRIPTION[form]].encode(),
        "documentation/index.html": generated[PAGE[form]].encode(),
        "documentation/licenses/license.txt": (template_folder() / "license.txt").read_bytes(),
    }
    entries |= {f"sources/{file}": data for file, data in source_files(generated, form).items()}
    if form == 2:
        return entries | {"model.png": icon()}
    return entries | {
        "sources/buildDescription.xml": generated["buildDescription.xml"].encode(),
        "terminalsAndIcons/terminalsAndIcons.xml": generated[TERMINALS[form]].encode(),
        "terminalsAndIcons/icon.png": icon(),
    }


def _binaries(
    name: str, form: Form, libraries: dict[Platform, dict[Form, bytes]]
) -> dict[str, bytes]:
    """The libraries by their path in the archive."""
    folders: dict[str, Platform] = {}
    for p in libraries:
        # FMI 2 names folders by system and word size only: the first processor takes it, others get
        # FMI 3's name.
        folder = p.fmi2 if form == 2 and p.fmi2 not in folders else p.name
        folders[folder] = p
    return {
        f"binaries/{folder}/{name}{p.suffix}": libraries[p][form] for folder, p in folders.items()
    }


def _zip(file: BinaryIO, entries: dict[str, bytes]) -> None:
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted(entries):
            info = zipfile.ZipInfo(path, ZIP_TIME)
            info.compress_type = zipfile.ZIP_DEFLATED
            info.external_attr = 0o644 << 16
            info.create_system = 3  # the same bytes on every system
            archive.writestr(info, entries[path])


def icon(size: int = 64) -> bytes:
    """The icon as PNG, ``size`` pixels square.

    It is a held staircase on a ramp, which is what a sampled unit gives.
    """

    def pixel(row: int, column: int) -> int:
        x, y, step = column, size - 1 - row, size // 4
        if min(x, y, size - 1 - x, size - 1 - y) == 0 or abs(y - x // step * step) <= 1:
            return 0
        return 160 if abs(x - y) <= 0 else 255

    rows = b"".join(
        b"\0" + bytes(pixel(row, column) for column in range(size)) for row in range(size)
    )
    header = struct.pack(">IIBBBBB", size, size, 8, 0, 0, 0, 0)
    chunks = ((b"IHDR", header), (b"IDAT", zlib.compress(rows, 9)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        for kind, data in chunks
    )
