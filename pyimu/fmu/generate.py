"""The generated texts of the reference blocks, which are checked in.

They are made by ``python -m pyimu.fmu.generate``, or ``make generate``.

An FMU never reads them, it is built from texts made anew. They are there to be read, to show in a
review what a change of a definition does to the C, and for who compiles the C without Python; a
test proves that they are fresh. The block form differs from the scalar ones in its table of
variables, ``model_table.block.h``, which in its FMU is ``model_table.h``. Of a text that is too
long to be read, ``UNREADABLE``, its digest stands in its place.
"""

from __future__ import annotations

import hashlib
import re
from pathlib import Path

from pyimu.attitude import attitude_ukf
from pyimu.attitude.heading.estimator import heading_estimator
from pyimu.block.block import Block
from pyimu.block.compiled import source_folder
from pyimu.files import write_anew
from pyimu.fmu.sources import texts
from pyimu.ins.filter.ins_block import strapdown_ins
from pyimu.model.part_file import part
from pyimu.plant.low_pass import low_pass
from pyimu.plant.rover_drive import rover_drive

REFERENCE = "imt30"
"""The built-in part whose blocks are generated."""

UNREADABLE = ("AttitudeUkf/step.c", "RoverDrive/step.c", "StrapdownIns/step.c")
"""Texts of thousands of lines, without a structure that a reader could follow."""


def reference_blocks() -> tuple[Block, ...]:
    """The blocks whose texts are checked in: those of the reference part, and what is around it."""
    found = part(REFERENCE)
    period = found.sample_period
    filters = attitude_ukf(found), heading_estimator(found), strapdown_ins(found)
    return found.block, *filters, rover_drive(period), low_pass(period)


def generated_folder() -> Path:
    """Where the checked in texts lie: one folder for each block."""
    return source_folder() / "generated"


def checked_in() -> dict[str, str]:
    """What is checked in: path below the folder to text."""
    found = {
        f"{block.name}/{name}": text
        for block in reference_blocks()
        for name, text in texts(block).items()
    }
    return dict(
        (f"{path}.sha256", digest(text) + "\n") if path in UNREADABLE else (path, text)
        for path, text in found.items()
    )


def digest(text: str) -> str:
    """SHA-256 of a text, casadi's patch level apart, which its C records and which says nothing."""
    return hashlib.sha256(re.sub(r"\*patch = \d+;", "", text).encode()).hexdigest()


def generate(folder: Path | str | None = None) -> list[Path]:
    """Write the checked-in texts to ``folder`` (default: where they are); gives the changed paths.

    The folders of the blocks hold nothing else afterwards: a text that is generated no more is
    removed.
    """
    folder = generated_folder() if folder is None else Path(folder)
    wanted = {folder / path: text.encode() for path, text in checked_in().items()}
    return write_anew(wanted, {path.parent for path in wanted})


if __name__ == "__main__":
    for path in generate():
        print(path)
