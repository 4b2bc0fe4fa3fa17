"""What a command does with an error that nobody foresaw: a line for the user, a file for us."""

from __future__ import annotations

import errno
import os
import platform
import sys
import tempfile
import traceback

BUG = 70
"""Exit status of a run that a bug ended (EX_SOFTWARE of sysexits.h)."""

FULL = (errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EACCES, errno.EPERM) + (
    errno.EMFILE,
    errno.ENFILE,
    errno.EIO,
    errno.ENAMETOOLONG,
)
"""What the system refuses is no bug: no room, no permission, too many open files."""


def said_of(error: Exception) -> tuple[str, int]:
    """The line and the exit status for an ``error`` that is no UserError."""
    if isinstance(error, MemoryError):
        return "not enough memory for this", 2
    if isinstance(error, OSError) and _is_refusal(error):
        place = error.filename or os.environ.get("TMPDIR") or tempfile.tempdir or "a file"
        return f"{place}: {error.strerror or error}; TMPDIR names the folder for temporary files", 2
    kind = type(error).__name__
    path = _written(error)
    where = f"the traceback is in {path}" if path else "set TMPDIR to get the traceback in a file"
    return f"this is a bug in pyimu, not in what you gave it ({kind}: {error}); {where}", BUG


def _is_refusal(error: OSError) -> bool:
    return error.errno in FULL or "No usable temporary directory" in str(error)


def _written(error: Exception) -> str | None:
    """The path of a file with the traceback, the command and the versions; None without room."""
    from pyimu import __version__

    lines = [
        f"pyimu {__version__}, Python {platform.python_version()}, {platform.platform()}\n",
        f"command: {' '.join(sys.argv)}\n\n",
        *traceback.format_exception(error),
    ]
    try:
        handle, path = tempfile.mkstemp(prefix="pyimu-bug-", suffix=".txt")
        with os.fdopen(handle, "w", encoding="utf-8", errors="backslashreplace") as file:
            file.writelines(lines)
    except OSError:
        return None
    return path
