"""What the tools make of the names of a co-simulation unit, and a unit's connectors by them."""

from __future__ import annotations

import re

from pyimu.block.block import Block
from pyimu.block.variables import Variable
from pyimu.modelica.text import GENERATED, capital, comment, rendered, wrapped

TEXT = (
    "Redeclared by the class that an importer makes of the unit; see UsersGuide.ImportOfUnits. "
    "Every importer that replaces what is no letter or digit by an underscore gives these names."
)


def imported_name(name: str) -> str:
    """``gyro[1]`` as ``gyro_1_``.

    It is what Modelica-FMI 0.0.8 (``modelica_fmi/_lib.py``, ``name``) and OpenModelica's own import
    (``FMI2_impl.c``, ``makeStringFMISafe``) give the names of this package's units, which have
    letters, digits, underscores and, one at a time, dots, commas and brackets.
    """
    return re.sub("[^0-9a-zA-Z]+", "_", name)


def imported_text(block: Block, name: str) -> str:
    """The file of a partial block with the connectors of an imported unit."""
    lines = [_connector("Input", v) for v in block.inputs]
    lines += [_connector("Output", v) for v in block.outputs]
    return GENERATED + rendered(
        "imported.mo",
        name=name,
        description=f"Connectors of the imported co-simulation unit {block.name}",
        connectors=[line for text in lines for line in wrapped(text)],
        documentation=TEXT,
    )


def _connector(role: str, v: Variable) -> str:
    said = re.split(r"[.;:] ", v.description, maxsplit=1)[0]
    return (
        f"Modelica.Blocks.Interfaces.{v.kind.capitalize()}{role} {imported_name(v.name)}"
        f"{comment(capital(said) if not said[0].isdigit() else 'What happened')};"
    )
