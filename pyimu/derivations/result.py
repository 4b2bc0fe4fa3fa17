"""The result of ``pyimu.derivations.derive``: what was derived and checked, and its files."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from pyimu.derivations.model import Results
from pyimu.derivations.report import data, markdown, tex, text
from pyimu.files import write_text

FILES = {
    "derivations.txt": text.document,
    "derivations.tex": tex.document,
    "derivations.md": markdown.document,
}
"""What ``Derived.write`` makes, by name."""


class Derived(Results):
    """Result of ``derive``: every derivation with its checks."""

    def report(self) -> str:
        """All of it as text, the last line a summary."""
        return text.document(self)

    __str__ = report

    def as_dict(self) -> dict[str, Any]:
        """All of it as data, for scripts: ``pyimu.derivations.report.data.document``."""
        return data.document(self)

    def write(self, out: str | os.PathLike) -> list[Path]:
        """Write ``derivations.txt``, ``.tex`` and ``.md`` into the folder ``out``.

        Gives their paths. Each file is written whole or not at all.

        The folder is made if it is missing. Raises UserError where it cannot be written.
        """
        texts = {Path(out) / name: document(self) for name, document in FILES.items()}
        for path, content in texts.items():
            write_text(path, content)
        return list(texts)
