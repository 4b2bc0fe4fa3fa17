"""Folders that one run at a time writes to, and temporary folders that a kill does not leave for
ever.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO

from pyimu.errors import UserError

PREFIX = ".pyimu-"
"""How the names of unfinished files and of temporary folders begin."""

FORGOTTEN = 24 * 3600.0
"""s; what is that old belongs to a run that was killed, and is taken away."""


class Held:
    """The folders that this process holds until the context ends; without one nothing is held.

    A lock is a file in the folder for temporary files, named by the folder's path, so that nothing
    is made in the folder itself. The system gives it back however the process ends. It is one for
    the processes of a machine, and of a user.
    """

    def __init__(self) -> None:
        self._locks: dict[Path, IO[bytes]] = {}
        self._holding = False

    @contextmanager
    def holding(self) -> Iterator[None]:
        """Within this context ``hold`` takes locks; at its end they are given back."""
        self._holding = True
        try:
            yield
        finally:
            self._holding = False
            while self._locks:
                path, lock = self._locks.popitem()
                with suppress(OSError):
                    path.unlink()
                lock.close()

    def hold(self, folder: Path) -> None:
        """Hold a folder. Raises UserError where another process does."""
        path = _lock_of(folder)
        if not self._holding or path in self._locks:
            return
        with suppress(OSError):  # where nothing can be written there is no lock
            path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
            _sweep_locks(path.parent)
            while True:
                lock = path.open("ab")
                if not _locked(lock):
                    lock.close()
                    raise UserError(
                        f"{folder}: another run is writing there; wait for its end, or give "
                        "another folder with --out"
                    )
                # Between opening and locking its holder may have removed it.
                if path.exists() and os.path.samestat(os.fstat(lock.fileno()), path.stat()):
                    self._locks[path] = lock
                    return
                lock.close()


held = Held()
"""Those of this process."""


@contextmanager
def work_folder() -> Iterator[Path]:
    """A temporary folder, removed at the end; those of runs that were killed go after a day.

    Raises UserError where it cannot be made.
    """
    try:
        sweep(Path(tempfile.gettempdir()))
        made = tempfile.TemporaryDirectory(prefix=PREFIX, ignore_cleanup_errors=True)
    except OSError as error:
        where = tempfile.tempdir or os.environ.get("TMPDIR", "/tmp")
        raise UserError(
            f"{where}: cannot be written ({error.strerror or error}); TMPDIR names another folder "
            "for temporary files"
        ) from None
    with made as folder:
        yield Path(folder)


def _lock_of(folder: Path) -> Path:
    user = os.getuid() if hasattr(os, "getuid") else os.environ.get("USERNAME", "")
    name = hashlib.sha256(os.fsencode(os.path.realpath(folder))).hexdigest()[:32]
    return Path(tempfile.gettempdir(), f"{PREFIX}locks-{user}", name)


def _locked(lock: IO[bytes]) -> bool:
    """Whether the lock could be had, without waiting for it."""
    try:
        if os.name == "nt":
            import msvcrt

            msvcrt.locking(lock.fileno(), msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined]
        else:
            import fcntl

            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except PermissionError:  # as Windows says it
        return os.name != "nt"
    return True


def sweep(folder: Path) -> None:
    """Take away what our runs that were killed left unfinished in a folder long ago."""
    for path in folder.glob(f"{PREFIX}*"):
        with suppress(OSError):
            about = path.lstat()
            ours = not hasattr(os, "getuid") or about.st_uid == os.getuid()
            old = time.time() - about.st_mtime > FORGOTTEN
            if ours and old and not path.name.startswith(f"{PREFIX}locks"):
                is_folder = path.is_dir() and not path.is_symlink()
                shutil.rmtree(path, ignore_errors=True) if is_folder else path.unlink()


def _sweep_locks(folder: Path) -> None:
    """Remove locks that nobody holds, left by runs that were killed."""
    for path in folder.iterdir():
        with suppress(OSError):
            if time.time() - path.stat().st_mtime > FORGOTTEN:
                with path.open("ab") as lock:
                    if _locked(lock):
                        path.unlink()
