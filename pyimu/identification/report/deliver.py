"""Write what the loop found.

Units of the sensor as it was and as it is now, the report that names them, and the model.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from pyimu.errors import UserError
from pyimu.files import check_folder, staged, write_json, write_text
from pyimu.fmu.build import build_fmus, host_compiler
from pyimu.identification.formula.effect import file_text, put
from pyimu.identification.outcome import Outcome
from pyimu.identification.report.page import FORMULA, MODEL, page
from pyimu.model.part_file import save_part


def check_delivery(out: Path | str) -> None:
    """Raise UserError now for what would else end ``deliver`` after all the work.

    A folder that is none.
    """
    check_folder(out)


def without_units() -> str | None:
    """Why no units can be made, where that is so: the loop needs no C compiler, only they do."""
    try:
        host_compiler()
    except UserError as error:
        return f"the FMUs are left out: {error}"
    return None


def deliver(closed: Outcome, out: Path, units: bool, say: Callable[[str], None]) -> Path:
    """What ``Closed.write`` says."""
    for formula in closed.formulas:
        put(formula.effect)
    with staged(out) as stage:
        left_out = without_units() if units else None
        names = _build_units(closed, stage, say) if units and not left_out else ()
        say("drawing the report")
        write_text(stage / "report.html", page(closed, names, left_out))
        write_json(stage / "report.json", closed.as_dict(MODEL, names))
        save_part(closed.after, stage / MODEL)
        if closed.formulas:
            text = file_text([f.text for f in closed.formulas], FORMULA)
            write_text(stage / FORMULA, text)
    return out / "report.html"


def _build_units(closed: Outcome, stage: Path, say: Callable[[str], None]) -> tuple[str, ...]:
    """Names of the units made in the folder ``stage``."""
    say("compiling the FMUs")
    made = [
        path
        for folder, part in ((stage, closed.after), (stage / "before", closed.before))
        for path in build_fmus(part.block, folder)
    ]
    return tuple(path.relative_to(stage).as_posix() for path in made)
