"""FMUs of a part: the sensor, the filters that go with it, and the system around them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from pyimu.attitude.filters import FILTERS
from pyimu.attitude.heading.estimator import heading_estimator
from pyimu.block.block import Block
from pyimu.display.silent import silent
from pyimu.errors import UserError
from pyimu.files import check_folder
from pyimu.fmu.build import FORMS, build_fmus, part_of
from pyimu.fmu.sources import Form
from pyimu.ins.filter.ins_block import strapdown_ins
from pyimu.model.part import Part
from pyimu.model.part_file import part as find_part
from pyimu.plant.low_pass import low_pass
from pyimu.plant.rover_drive import rover_drive

SENSOR = "sensor"

BLOCKS: dict[str, Callable[[Part], Block]] = {
    SENSOR: lambda part: part.nominal.block,
    **FILTERS,
    "heading": heading_estimator,
    "rover": lambda part: rover_drive(part.sample_period),
    "low-pass": lambda part: low_pass(part.sample_period),
    "ins": strapdown_ins,
}
"""What ``--fmu`` names. The rover's motion and the low-pass have the sample period of the part."""


def build(
    part: Part | str | Path,
    out: Path | str,
    fmu: Sequence[str] = ("sensor", "ukf"),
    fmi: Sequence[Form] = FORMS,
    platform: str = "host",
    specimen: int | None = None,
    say: Callable[[str, float], None] = silent,
) -> list[Path]:
    """Build the FMUs of a part into ``out``; gives their paths.

    ``fmu`` names blocks ("sensor", "ukf", "hidalgo2012", "heading", "rover", "low-pass", "ins"),
    ``fmi`` forms (2, 3, "block"), ``platform`` the machine ("host", "all", or one by name). The
    sensor has every coefficient of the part, and of its tolerances, as parameters; ``specimen`` is
    the seed of a specimen whose coefficients they start at, which the filters know nothing of.
    ``say(text, share)`` hears what is being compiled, and which share of all is done.
    Raises UserError for an unknown name, a part that cannot be read, a specimen of a part without
    tolerances, a folder that cannot be made, or a missing compiler.
    """
    unknown = [f for f in fmu if f not in BLOCKS]
    if unknown:
        raise UserError(f"--fmu {unknown[0]}: unknown; known are {', '.join(BLOCKS)}")
    wrong = [form for form in fmi if form not in FORMS]
    if wrong:
        raise UserError(f"--fmi {wrong[0]}: unknown; known are {', '.join(map(str, FORMS))}")
    found = find_part(part) if isinstance(part, (str, Path)) else part
    sensor = found if specimen is None else found.specimen(specimen)
    check_folder(out)
    blocks = [BLOCKS[name](sensor if name == SENSOR else found) for name in fmu]
    paths = []
    for k, block in enumerate(blocks):
        heard = partial(part_of, partial(say, f"compiling {block.name}"), k, len(blocks))
        heard(0.0)
        paths += build_fmus(block, out, tuple(fmi), platform, heard)
    return paths
