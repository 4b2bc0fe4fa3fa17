"""Columns of numbers larger than memory: temporary files that grow by pieces and are then mapped.

The files have no names, so that they disappear with the process, whatever ends it.
"""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import Self

import numpy as np

from pyimu.errors import UserError


class Store:
    """Columns of float64 by name, to be used in a ``with`` statement.

    At its end they are deleted, and the arrays that ``column`` and ``room`` gave must no longer be
    used.
    """

    def __init__(self) -> None:
        self._files: dict[str, tempfile._TemporaryFileWrapper] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        for file in self._files.values():
            file.close()

    def append(self, name: str, values: np.ndarray) -> None:
        """Add ``values`` (k,) at the end of a column. Raises UserError where the disk is full."""
        if name not in self._files:
            self._files[name] = _file()
        try:
            self._files[name].write(np.ascontiguousarray(values, dtype=float).data)
        except OSError as error:
            raise _full(error) from None

    def column(self, name: str) -> np.ndarray:
        """A column (n,), read-only; empty where nothing was added."""
        if name not in self._files:
            return np.empty(0)
        try:
            self._files[name].flush()
        except OSError as error:
            raise _full(error) from None
        return _mapped(self._files[name], "r")

    def room(self, name: str, n: int) -> np.ndarray:
        """A column (n,) of zeros to work in; it replaces one of the same name.

        Raises UserError where the disk is full.
        """
        if name in self._files:
            self._files.pop(name).close()
        file = self._files[name] = _file()
        try:
            # Without it a full disk would be noticed only when the mapped memory is written.
            (os.posix_fallocate if hasattr(os, "posix_fallocate") else _truncate)(
                file.fileno(), 0, max(8 * n, 8)
            )
        except OSError as error:
            raise _full(error) from None
        return _mapped(file, "r+")[:n]


def _file() -> tempfile._TemporaryFileWrapper:
    try:
        return tempfile.TemporaryFile(prefix="pyimu-", dir=_folder())
    except OSError as error:
        raise _full(error) from None


def _truncate(descriptor: int, _: int, size: int) -> None:
    os.ftruncate(descriptor, size)


def _mapped(file: tempfile._TemporaryFileWrapper, mode: str) -> np.ndarray:
    size = os.fstat(file.fileno()).st_size // 8
    return (
        np.asarray(np.memmap(file, dtype=float, mode=mode, shape=(size,))) if size else np.empty(0)
    )


def _folder() -> str:
    """The folder in TMPDIR, else one for large temporary files, because /tmp may be in memory."""
    large = Path("/var/tmp")
    return (
        tempfile.gettempdir()
        if "TMPDIR" in os.environ or not os.access(large, os.W_OK)
        else str(large)
    )


def _full(error: OSError) -> UserError:
    return UserError(
        f"{os.environ.get('TMPDIR') or _folder()}: no room for the samples of the log "
        f"({error.strerror or error}); name "
        "another folder in TMPDIR"
    )
