"""FMUs of a part: the sensor, and the filters that go with it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from pyimu.attitude.filters import FILTERS
from pyimu.attitude.heading.estimator import heading_estimator
from pyimu.block.block import Block
from pyimu.errors import UserError
from pyimu.files import check_folder
from pyimu.fmu.build import FORMS, build_fmus
from pyimu.fmu.sources import Form
from pyimu.model.part import Part
from pyimu.model.part_file import part as find_part

BLOCKS: dict[str, Callable[[Part], Block]] = {
    "sensor": lambda part: part.block,
    **FILTERS,
    "heading": heading_estimator,
}
"""What ``--fmu`` names."""


def build(
    part: Part | str | Path,
    out: Path | str,
    fmu: Sequence[str] = ("sensor", "ukf"),
    fmi: Sequence[Form] = FORMS,
    platform: str = "host",
) -> list[Path]:
    """Build the FMUs of a part into ``out``; gives their paths.

    ``fmu`` names blocks ("sensor", "ukf", "hidalgo2012", "heading"), ``fmi`` forms (2, 3, "block"),
    ``platform`` the machine ("host", "all", or one by name). Raises UserError for an unknown name,
    a part that cannot be read, a folder that cannot be made, or a missing compiler.
    """
    unknown = [f for f in fmu if f not in BLOCKS]
    if unknown:
        raise UserError(f"--fmu {unknown[0]}: unknown; known are {', '.join(BLOCKS)}")
    wrong = [form for form in fmi if form not in FORMS]
    if wrong:
        raise UserError(f"--fmi {wrong[0]}: unknown; known are {', '.join(map(str, FORMS))}")
    found = find_part(part) if isinstance(part, (str, Path)) else part
    check_folder(out)
    return [
        path for name in fmu for path in build_fmus(BLOCKS[name](found), out, tuple(fmi), platform)
    ]
