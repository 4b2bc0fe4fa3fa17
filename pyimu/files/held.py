"""Folders that one run at a time writes to, and temporary folders that a kill does not leave for
ever.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from pyimu.errors import UserError

PREFIX = ".pyimu-"
"""How the names of unfinished files and of temporary folders begin."""

FORGOTTEN = 24 * 3600.0
"""s; what is that old belongs to a run that was killed, and is taken away."""


class Held:
    """The folders that this process holds until the context ends; without one nothing is held.

    A lock is one on the folder itself, which every process of the machine meets, whoever's it is
    and wherever its temporary files go. Where a folder cannot be locked, as on Windows and often
    over NFS, there is the second one: a file in the folder for temporary files, named by the
    folder's path, which is met by processes of the same user with the same such folder. The system
    gives both back however the process ends, and nothing is left in the folder.
    """

    def __init__(self) -> None:
        self._locks: dict[Path, ExitStack] = {}
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
                self._locks.popitem()[1].close()

    def hold(self, folder: Path) -> None:
        """Hold a folder, which is made; at the end it goes if it is empty still.

        Raises UserError where another process holds it.
        """
        path = _lock_of(folder)
        if not self._holding or path in self._locks:
            return
        with ExitStack() as taken:
            for lock, place in ((_file_locked, path), (_folder_locked, folder)):
                with suppress(OSError):  # where nothing can be written there is no lock
                    if not lock(place, taken):
                        raise UserError(
                            f"{folder}: another run is writing there; wait for its end, or give "
                            "another folder with --out"
                        )
            self._locks[path] = taken.pop_all()


def _file_locked(path: Path, taken: ExitStack) -> bool:
    """Whether the file ``path`` could be had; ``taken`` gives it back."""
    path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
    _sweep_locks(path.parent)
    while True:
        lock = path.open("ab")
        if not _locked(lock.fileno()):
            lock.close()
            return False
        # Between opening and locking its holder may have removed it.
        if path.exists() and os.path.samestat(os.fstat(lock.fileno()), path.stat()):
            taken.callback(lock.close)
            taken.callback(_without_fail, path.unlink)
            return True
        lock.close()


def _folder_locked(folder: Path, taken: ExitStack) -> bool:
    """Whether the folder could be had; ``taken`` gives it back, and removes what was made here."""
    if os.name == "nt":
        return True
    while True:
        made = [path for path in (folder, *folder.parents) if not path.exists()]
        folder.mkdir(parents=True, exist_ok=True)
        with ExitStack() as own:
            handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
            own.callback(os.close, handle)
            if not _locked(handle):
                return False
            # Between opening and locking its holder may have removed it.
            if folder.exists() and os.path.samestat(os.fstat(handle), folder.stat()):
                for path in reversed(made):  # what comes last is done first
                    own.callback(_without_fail, path.rmdir)
                taken.push(own.pop_all())
                return True


def _without_fail(do: Callable[[], object]) -> None:
    with suppress(OSError):
        do()


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


def _locked(lock: int) -> bool:
    """Whether the lock on an open file could be had, without waiting for it."""
    try:
        if os.name == "nt":
            import msvcrt

            msvcrt.locking(lock, msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined]
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
                    if _locked(lock.fileno()):
                        path.unlink()
