"""A part of one's own as a Modelica class."""

from __future__ import annotations

import os
from pathlib import Path

from pyimu.errors import UserError
from pyimu.files import check_folder, write_text
from pyimu.model.effects import EFFECTS
from pyimu.model.part import Part
from pyimu.model.part_file import part as find_part
from pyimu.modelica.names import pascal
from pyimu.modelica.part_text import TRIADS, part_text

LIBRARIES = ("Modelica", "PyImu")

CLASSES = (*TRIADS.values(), "Imu")
"""Classes of a part beside its effects."""


def export(part: Part | str | os.PathLike, out: Path | str) -> Path:
    """Write a part as the package ``NAME.mo`` in the folder ``out``; gives the file's path.

    It holds the blocks ``Gyroscope``, ``Accelerometer`` and ``Imu``, which need the library
    ``PyImu``, and the effects that the library does not have. Raises UserError for a part that is
    none or has a coefficient that is left to the data, for an effect whose function uses what
    Modelica does not have, for names that are taken there, and for a folder that cannot be written;
    nothing is written then.
    """
    check_folder(out)
    found = find_part(part)
    _check_names(found)
    text = part_text(found)
    path = Path(out) / f"{pascal(found.name)}.mo"
    write_text(path, text)
    return path


def _check_names(part: Part) -> None:
    """Refuse a part whose classes would be called as others that it needs."""
    name = pascal(part.name)
    if name in LIBRARIES:
        raise UserError(
            f"part {part.name}: as a Modelica class it would be called {name}, as the library that "
            "it needs; give it another name"
        )
    own = dict.fromkeys(e for e in (*part.gyro.effects, *part.accel.effects) if e not in EFFECTS)
    taken = dict.fromkeys((*CLASSES, *LIBRARIES, name), "another class")
    for e in own:
        called = pascal(e.name)
        if called in taken:
            raise UserError(
                f"effect {e.name}: as a Modelica class it would be called {called}, as "
                f"{taken[called]} in the part {part.name}; give it another name"
            )
        taken[called] = f"the effect {e.name}"
