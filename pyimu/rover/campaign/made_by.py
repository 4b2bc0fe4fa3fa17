"""Which code makes a campaign's runs: they follow from the settings, their number, and this."""

from __future__ import annotations

import hashlib
from functools import cache
from importlib.metadata import version
from pathlib import Path

from pyimu.block.compiled import HAND_WRITTEN, source_folder

PACKAGE = Path(__file__).resolve().parents[2]


@cache
def made_by() -> str:
    """The package's version and a digest of its code, as ``0.1.0+3f2a9c1b77d0``.

    The version alone says too little: in a checkout the code changes and the version does not, and
    a campaign that goes on after a change would be of two kinds of runs. The digest is of every
    Python file of the package, its data, and the C that is compiled around each unit; one made by
    an installed package and one by a checkout of the same code are the same.
    """
    code = hashlib.sha256()
    for name, path in sorted(_files()):
        data = path.read_bytes().replace(b"\r\n", b"\n")  # a checkout on Windows may have these
        code.update(f"{name} {len(data)}\n".encode() + data)
    return f"{version('pyimu')}+{code.hexdigest()[:12]}"


def _files() -> list[tuple[str, Path]]:
    """The files that decide, by names that do not depend on where the package lies."""
    own = [p for suffix in ("py", "toml") for p in PACKAGE.rglob(f"*.{suffix}")]
    written = [(name, source_folder() / name) for name in HAND_WRITTEN]
    return [(p.relative_to(PACKAGE).as_posix(), p) for p in own] + written
