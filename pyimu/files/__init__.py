"""Results as files: each appears whole or not at all, whatever ends the work before it is done.

And what is read of texts: regular files alone, of bounded size.
"""

from __future__ import annotations

import errno
import json
import math
import os
import re
import shutil
import stat
import tempfile
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from pyimu.errors import UserError
from pyimu.files.held import PREFIX, held, sweep

LARGEST_TEXT = 16 << 20
"""Bytes of a part file or a column map, at most."""


def check_regular(path: Path) -> None:
    """Raise UserError where ``path`` is missing, a folder, or a pipe or a device, which need not
    end.
    """
    try:
        mode = path.stat().st_mode
    except (FileNotFoundError, NotADirectoryError):
        raise UserError(f"{path}: no such file") from None
    except (OSError, ValueError) as error:  # a name that no system takes
        reason = getattr(error, "strerror", None) or error
        raise UserError(f"{shortened(path)}: cannot be read ({reason})") from None
    if stat.S_ISDIR(mode):
        raise UserError(f"{path}: cannot be read, it is a folder")
    if not stat.S_ISREG(mode):
        raise UserError(f"{path}: no regular file (a pipe or a device); save it to a file first")


def exists(path: Path) -> bool:
    """Whether there is such a file or folder; no name is too long to be asked for."""
    try:
        return path.exists()
    except (OSError, ValueError):
        return False


def shortened(text: object, most: int = 120) -> str:
    """The text, its middle left out where it has more than ``most`` characters."""
    said = str(text)
    return said if len(said) <= most else f"{said[: most // 2]}...{said[-most // 2 :]}"


def read_toml(path: Path) -> dict[str, Any]:
    """What a TOML file holds. Raises UserError where it cannot be read or is none."""
    return parse_toml(text_in(path), str(path))


def text_in(path: Path) -> str:
    """The text in a file. Raises UserError where it cannot be read, or is too large or no text."""
    check_regular(path)
    try:
        if path.stat().st_size > LARGEST_TEXT:
            raise UserError(f"{path}: larger than {LARGEST_TEXT >> 20} MiB, this is no such file")
        return path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        raise UserError(f"{path}: is not text in UTF-8") from None
    except OSError as error:
        raise UserError(f"{path}: cannot be read ({error.strerror or error})") from None


DECIMAL_COMMA = re.compile(r"^[^#\"\[]*= *([-+]?\d+),(\d+) *(?:,|\}|#|$)", re.M)
"""A number with a comma, outside of a list, in a line of TOML."""


def parse_toml(text: str, file: str) -> dict[str, Any]:
    """What a TOML ``text`` holds; ``file`` is what errors call it. Raises UserError."""
    try:
        return tomllib.loads(text)
    except RecursionError:
        reason = "nested too deeply"
    except ValueError as error:  # of the grammar, and of numbers with thousands of digits
        reason = str(error)
    if comma := DECIMAL_COMMA.search(text):
        reason += (
            f"; numbers have a decimal point: {comma[1]}.{comma[2]}, not {comma[1]},{comma[2]}"
        )
    raise UserError(f"{file}: cannot be read as TOML: {reason}")


@contextmanager
def whole(path: Path) -> Iterator[Path]:
    """A file beside ``path`` that takes its place once the ``with`` block has ended well.

    Raises UserError where the folder cannot be made or written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        sweep(path.parent)
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=PREFIX, suffix=f".{path.name}")
        os.close(handle)
        unfinished = Path(name)
        try:
            yield unfinished
            unfinished.chmod(0o644)
            os.replace(unfinished, path)
        finally:
            unfinished.unlink(missing_ok=True)
    except OSError as error:
        raise UserError(f"{path}: cannot be written ({error.strerror or error})") from None


@contextmanager
def staged(out: Path) -> Iterator[Path]:
    """A folder inside ``out`` whose files take their places once the ``with`` block has ended well.

    Raises UserError where ``out`` cannot be made or written, or a folder stands where a file is to
    go.
    """
    try:
        out.mkdir(parents=True, exist_ok=True)
        sweep(out)
        stage = Path(tempfile.mkdtemp(dir=out, prefix=PREFIX))
    except OSError as error:
        raise UserError(_no_place(out, error.strerror or str(error))) from None
    try:
        yield stage
        files = sorted(p.relative_to(stage) for p in stage.rglob("*") if p.is_file())
        _check_places(out, files)
        for file in files:
            (out / file).parent.mkdir(parents=True, exist_ok=True)
            os.replace(stage / file, out / file)
    except OSError as error:
        raise UserError(f"{out}: cannot be written ({error.strerror or error})") from None
    finally:
        shutil.rmtree(stage, ignore_errors=True)


def write_text(path: Path, text: str) -> None:
    """Write a text file, whole or not at all, with the same bytes on every system."""
    with whole(path) as unfinished:
        unfinished.write_text(text, encoding="utf-8", newline="\n")


def write_anew(wanted: Mapping[Path, bytes], folders: Iterable[Path]) -> list[Path]:
    """Write the files whose bytes are not those ``wanted``; gives the paths that changed.

    In the ``folders`` nothing else is left: a file there that is wanted no more is removed.
    """
    changed = [p for p, data in wanted.items() if not p.is_file() or p.read_bytes() != data]
    for path in changed:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(wanted[path])
    stale = {file for folder in folders for file in folder.iterdir()} - set(wanted)
    for path in stale:
        path.unlink()
    return [*changed, *sorted(stale)]


def write_json(path: Path, value: Any) -> None:
    """Write ``plain(value)`` as JSON, whole or not at all."""
    write_text(path, json_text(value) + "\n")


def json_text(value: Any) -> str:
    """``plain(value)`` as JSON."""
    return json.dumps(plain(value), indent=2, ensure_ascii=False)


def plain(value: Any) -> Any:
    """Numbers, arrays, lists and tables as JSON has them; a number that is not finite is null."""
    if isinstance(value, Mapping):
        return {str(k): plain(v) for k, v in value.items()}
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, (list, tuple)):
        return [plain(v) for v in value]
    if isinstance(value, np.generic):
        return plain(value.item())
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return value


def check_folder(out: Path | str) -> None:
    """Raise UserError where ``out`` is not a folder or cannot be made.

    To be called before the work whose result would be lost; a command then holds the folder, and
    another run that is to write there is refused.
    """
    out = Path(out)
    held.hold(out)
    try:
        there = next(p for p in (out, *out.absolute().parents) if p.exists())
        reason = "" if there.is_dir() else f"{there} is a file"
        if not reason:
            # Not by asking for permissions, which root has also where there is nothing to write to,
            # as in /proc.
            tempfile.TemporaryDirectory(dir=there, prefix=PREFIX).cleanup()
    except OSError as error:
        reason = error.strerror or str(error)
    if reason:
        raise UserError(_no_place(out, reason))


def _no_place(out: Path, reason: str) -> str:
    return f"{out}: cannot write there, {reason}; give another folder with --out"


def _check_places(out: Path, files: list[Path]) -> None:
    """Raise OSError where a file cannot take its place, before the first one has."""
    for file in files:
        if (out / file).is_dir() and not (out / file).is_symlink():
            raise IsADirectoryError(errno.EISDIR, f"{file} is a folder there")
