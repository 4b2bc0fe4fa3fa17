"""What a compiler made, kept between processes in the user's cache folder.

A file is named by a key, whatever its bytes follow from, and by the digest of these bytes, so that
half a file is never taken for a whole one.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import stat
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable
from functools import cache
from itertools import accumulate
from pathlib import Path

KEPT = 2**28
"""Bytes of the cache folder; beyond that the files that were used longest ago go. By their number
the libraries of some hundred small blocks, made in a second each, drove out those of filters,
which take ten."""

DEAD = 86400.0
"""s; a temporary file that is older was left by a process that was killed."""


def cache_folder() -> Path | None:
    """The folder in which compiled code is kept, None for none.

    It is ``PYIMU_CACHE`` (empty: none), else ``pyimu`` in the user's cache folder of the platform.
    """
    given = os.environ.get("PYIMU_CACHE")
    if given is not None:
        return Path(given) if given else None
    home = Path(os.path.expanduser("~"))
    usual = {"win32": home / "AppData" / "Local", "darwin": home / "Library" / "Caches"}.get(
        sys.platform, home / ".cache"
    )
    named = Path(
        os.environ.get(
            {"win32": "LOCALAPPDATA", "darwin": ""}.get(sys.platform, "XDG_CACHE_HOME"), ""
        )
    )
    base = named if named.is_absolute() else usual
    return base / "pyimu" if base.is_absolute() else None


def key_of(compiler: Iterable[str], *parts: bytes) -> str:
    """A name for whatever a ``compiler``, a command, makes of ``parts``."""
    command = tuple(compiler)
    return _digest(b"\0".join([*(t.encode() for t in (*command, _version(command))), *parts]))


@cache
def _version(compiler: tuple[str, ...]) -> str:
    """What a compiler says of itself. It is not told for which machine: zig, asked for macOS,
    leaves an empty ``a.o`` in the current folder.
    """
    end = compiler.index("-target") if "-target" in compiler else len(compiler)
    return subprocess.run(
        [*compiler[:end], "--version"],
        capture_output=True,
        text=True,
        errors="replace",
        check=False,
    ).stdout


def kept(key: str) -> list[Path]:
    """The files that were kept under a key and are whole: one, as a rule, or none."""
    found = []
    with contextlib.suppress(OSError):
        for path in _files(f"{key}.*"):
            if path.suffixes[0] == f".{_digest(path.read_bytes())}":
                os.utime(path)
                found.append(path)
    return found


def kept_bytes(key: str) -> bytes | None:
    """What was kept under a key, None where nothing was."""
    with contextlib.suppress(OSError):
        for path in kept(key):
            return path.read_bytes()
    return None


def keep(key: str, data: bytes) -> None:
    """Keep data under a key, where there is a cache and it can be written to.

    It is written under a temporary name and renamed, so nobody reads half of it.
    """
    folder = cache_folder()
    if folder is None:
        return
    with contextlib.suppress(OSError):  # made again next time
        folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        handle, temporary = tempfile.mkstemp(dir=folder, suffix=".tmp")
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(data)
            os.replace(temporary, folder / f"{key}.{_digest(data)}.so")
        except BaseException:
            os.unlink(temporary)
            raise
        _sweep(folder)


def _sweep(folder: Path) -> None:
    """Remove what was used longest ago, and what a killed process left."""
    files = [(path, path.stat()) for path in _files("*.*")]
    files.sort(key=lambda file: file[1].st_mtime, reverse=True)
    sizes = accumulate(about.st_size for _, about in files)
    old = [path for (path, _), size in zip(files, sizes, strict=True) if size > KEPT]
    left = [p for p in folder.glob("*.tmp") if p.stat().st_mtime < time.time() - DEAD]
    for path in (*old, *left):
        path.unlink(missing_ok=True)


def _digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()[:32]


def _files(pattern: str) -> list[Path]:
    """Files in the cache folder; none where others may put something there, as it is run."""
    folder = cache_folder()
    if folder is None or not folder.is_dir() or not _only_ours(folder):
        return []
    return list(folder.glob(f"{pattern}.so"))


def _only_ours(folder: Path) -> bool:
    """Whether nobody else can write to a folder, or put another in its place or in a parent's.

    A parent in which all may write and nobody may remove what is another's, as /tmp, is none that
    could be replaced. On Windows, where the user's folder is the user's, nothing is asked.
    """
    if not hasattr(os, "getuid"):
        return True
    mine, others = os.getuid(), stat.S_IWGRP | stat.S_IWOTH
    about = folder.stat()
    if about.st_uid != mine or about.st_mode & others:
        return False
    for parent in {*folder.absolute().parents, *folder.resolve().parents}:
        about = parent.stat()
        if about.st_uid not in (mine, 0) or (
            about.st_mode & others and not about.st_mode & stat.S_ISVTX
        ):
            return False
    return True
