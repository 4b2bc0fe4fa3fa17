"""What a result was made with: version, command or arguments, and the files that went in."""

from __future__ import annotations

import hashlib
import shlex
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from importlib.metadata import version
from pathlib import Path
from typing import Any


@dataclass(frozen=True)
class MadeWith:
    """Version, command line or call from Python, and SHA-256 of each input file by name.

    There is no folder of the user's in it.
    """

    version: str
    command: str
    files: tuple[tuple[str, str], ...] = ()

    def as_dict(self) -> dict[str, Any]:
        files = [{"file": name, "sha256": digest} for name, digest in self.files]
        return {"pyimu": self.version, "command": self.command, "files": files}

    def by_command(self, arguments: Sequence[str]) -> MadeWith:
        """The same, made by the command line ``arguments``, whose files are inputs too."""
        given = [a.partition("=")[2] if a.startswith("--") else a for a in arguments]
        known = dict.fromkeys((*self.files, *digests(map(Path, filter(None, given)))))
        command = shlex.join(["pyimu", *map(without_folders, arguments)])
        return replace(self, command=command, files=tuple(known))


def called(function: str, arguments: Mapping[str, Any], paths: Iterable[Path | None]) -> MadeWith:
    """Of a call from Python; ``paths`` are the files behind its arguments, where there are any."""
    said = ", ".join(f"{k}={_said(v)}" for k, v in arguments.items() if v is not None)
    files = digests(p for p in paths if p is not None)
    return MadeWith(version("pyimu"), f"pyimu.{function}({said})", tuple(files))


def without_folders(argument: str) -> str:
    """An argument of a command line with no more of a path than the file's name."""
    option, equals, value = argument.partition("=")
    if argument.startswith("--") and equals:
        return f"{option}={without_folders(value)}"
    return Path(argument).name if "/" in argument or "\\" in argument else argument


def digests(paths: Iterable[Path]) -> list[tuple[str, str]]:
    """Name and SHA-256 of each file; what is no file is left out."""
    found = []
    for path in paths:
        if path.is_file():
            with path.open("rb") as file:
                found.append((path.name, hashlib.file_digest(file, "sha256").hexdigest()))
    return found


def _said(value: Any) -> str:
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(map(_said, value))}]"
    if isinstance(value, (str, Path)):
        return repr(without_folders(str(value)))
    return f"{value:.6g}" if isinstance(value, float) else repr(getattr(value, "name", value))
