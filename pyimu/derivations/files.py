"""The results as files."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from pyimu.derivations import Derived, markdown, tex, text
from pyimu.errors import UserError

FILES = {
    "derivations.txt": text.document,
    "derivations.tex": tex.document,
    "derivations.md": markdown.document,
}
"""What is written, by name."""


def write(derived: Derived, out: Path | str) -> list[Path]:
    """Write derivations.txt, .tex and .md into the folder ``out``, each whole or not at all; gives
    their paths.

    The folder is made if it is missing. Raises UserError where that is not possible.
    """
    texts = {Path(out) / name: make(derived) for name, make in FILES.items()}
    try:
        Path(out).mkdir(parents=True, exist_ok=True)
        for path, content in texts.items():
            _write_whole(path, content)
    except OSError as error:
        raise UserError(
            f"{out}: cannot write there ({error.strerror or error}); give another folder with --out"
        ) from None
    return list(texts)


def _write_whole(path: Path, content: str) -> None:
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.", suffix=".tmp")
    try:
        with os.fdopen(handle, "w", encoding="utf-8", newline="\n") as stream:
            stream.write(content)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    finally:
        Path(temporary).unlink(missing_ok=True)
