"""The results as files."""

from __future__ import annotations

from pathlib import Path

from pyimu.derivations import Derived, markdown, tex, text
from pyimu.files import write_text

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
    for path, content in texts.items():
        write_text(path, content)
    return list(texts)
