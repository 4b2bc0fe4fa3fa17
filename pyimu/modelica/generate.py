"""The generated files of the Modelica library, which are checked in.

They are made by ``python -m pyimu.modelica.generate``, or ``make generate``, in a checkout; a test
proves that they are fresh.
"""

from __future__ import annotations

from pathlib import Path

from pyimu.files import write_anew
from pyimu.modelica.library import FOLDERS, library

CHECKED_IN = Path(__file__).resolve().parents[2] / "modelica" / "PyImu"
"""The library in a checkout."""


def generate(folder: Path | str = CHECKED_IN) -> list[Path]:
    """Write the generated files of the library to ``folder``; gives the changed paths.

    In the folders that hold generated files only, a file that is generated no more is removed.
    """
    folder = Path(folder)
    wanted = {folder / path: text.encode() for path, text in library().items()}
    return write_anew(wanted, (folder / name for name in FOLDERS))


if __name__ == "__main__":
    for path in generate():
        print(path)
