"""Names that tell the logs of one run apart."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from pyimu.errors import UserError
from pyimu.recording.log import Log
from pyimu.recording.recording import Recording


def distinct_names(logs: Sequence[Recording | Log]) -> list[str]:
    """The logs' names, equal ones with the folder, or else their place in the row, before them.

    Raises UserError for a file that is given twice.
    """
    paths = [None if log.path is None else log.path.resolve() for log in logs]
    again = next((p for i, p in enumerate(paths) if p is not None and p in paths[:i]), None)
    if again is not None:
        raise UserError(
            f"{again}: given twice; logs that go together must be independent, give each file once"
        )
    names = [log.name for log in logs]
    while twice := {n for n in names if names.count(n) > 1}:
        at = [i for i, n in enumerate(names) if n in twice]
        if not all(_has_folder(paths[i], names[i]) for i in at):
            return [f"{i + 1}: {n}" if n in twice else n for i, n in enumerate(names)]
        for i in at:
            names[i] = f"{paths[i].parts[-2 - names[i].count('/')]}/{names[i]}"
    return names


def _has_folder(path: Path | None, name: str) -> bool:
    """Whether there is one more folder to put before a name."""
    return path is not None and len(path.parts) > 2 + name.count("/")
