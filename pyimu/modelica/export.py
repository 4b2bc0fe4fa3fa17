"""A part of one's own as a Modelica class."""

from __future__ import annotations

import os
from pathlib import Path

from pyimu.files import check_folder, write_text
from pyimu.model.part import Part
from pyimu.model.part_file import part as find_part
from pyimu.modelica.names import pascal
from pyimu.modelica.part_text import part_text


def export(part: Part | str | os.PathLike, out: Path | str) -> Path:
    """Write a part as the package ``NAME.mo`` in the folder ``out``; gives the file's path.

    It holds the blocks ``Gyroscope``, ``Accelerometer`` and ``Imu``, which need the library
    ``PyImu``, and the effects that the library does not have. Raises UserError for a part that is
    none or has a coefficient that is left to the data, for an effect whose function uses what
    Modelica does not have, and for a folder that cannot be written; nothing is written then.
    """
    check_folder(out)
    found = find_part(part)
    text = part_text(found)
    path = Path(out) / f"{pascal(found.name)}.mo"
    write_text(path, text)
    return path
