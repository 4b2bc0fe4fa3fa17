"""The generated texts of the reference blocks, checked in: ``python -m pyimu.fmu.generate``, or
``make generate``.

An FMU never reads them, it is built from texts made anew. They are there to be read, to show in a
review what a change of a definition does to the C, and for who compiles the C without Python; a
test proves that they are fresh. The block form differs from the scalar ones in its table of
variables, ``model_table.block.h``, which in its FMU is ``model_table.h``.
"""

from __future__ import annotations

from pathlib import Path

from pyimu.attitude import attitude_ukf
from pyimu.block.block import Block
from pyimu.block.compiled import source_folder
from pyimu.fmu.sources import write_generated
from pyimu.model.part_file import part

REFERENCE = "imt30"
"""The built-in part whose blocks are generated."""


def reference_blocks() -> tuple[Block, ...]:
    """The blocks whose texts are checked in: sensor and attitude filter of the reference part."""
    found = part(REFERENCE)
    return found.block, attitude_ukf(found)


def generated_folder() -> Path:
    """Where the checked in texts lie: one folder for each block."""
    return source_folder() / "generated"


def generate(folder: Path | str | None = None) -> list[Path]:
    """Write the texts of the reference blocks to ``folder/NAME/`` (default: where they are checked
    in); gives their paths.

    Those folders hold nothing else afterwards: a text that is generated no more is removed.
    """
    folder = generated_folder() if folder is None else Path(folder)
    written = [
        path for block in reference_blocks() for path in write_generated(block, folder / block.name)
    ]
    for stale in {file for path in written for file in path.parent.iterdir()} - set(written):
        stale.unlink()
    return written


if __name__ == "__main__":
    for written in generate():
        print(written)
