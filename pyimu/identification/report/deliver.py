"""Write what ``close`` found: FMUs of the sensor as it was and as it is now, then the report that
names them.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path

from pyimu.errors import UserError
from pyimu.fmu.build import build_fmus, host_compiler
from pyimu.fmu.package import check_folder
from pyimu.identification.report.page import write_report
from pyimu.identification.result import Closed


def check_delivery(out: Path | str) -> None:
    """Raise UserError now for what would else end ``deliver`` after all the work: a folder that is
    none, no compiler.
    """
    check_folder(out)
    host_compiler()


def deliver(
    closed: Closed, out: Path | str, say: Callable[[str], None] = lambda text: None
) -> Path:
    """Fill the folder ``out``: the FMUs of the part after, those of the part before under
    ``before/``, report and model.

    Everything is made beside ``out`` first; until all of it exists, what was in ``out`` stays.
    Gives the report's path. Raises UserError where the folder cannot be written or no compiler is
    found.
    """
    out = Path(out)
    try:
        out.mkdir(parents=True, exist_ok=True)
        work = Path(tempfile.mkdtemp(prefix=".making-", dir=out))
    except OSError as error:
        raise UserError(
            f"{out}: cannot write there ({error.strerror}); give another folder with --out"
        ) from error
    try:
        say("compiling the FMUs")
        made = [
            p
            for folder, part in (("", closed.after), ("before", closed.before))
            for p in build_fmus(part.block, _folder(work / folder))
        ]
        names = tuple(p.relative_to(work).as_posix() for p in made)
        say("drawing the report")
        report = write_report(closed, out, names)
        for path, name in zip(made, names, strict=True):
            (out / name).parent.mkdir(exist_ok=True)
            os.replace(path, out / name)
        return report
    finally:
        shutil.rmtree(work, ignore_errors=True)


def _folder(path: Path) -> Path:
    path.mkdir(exist_ok=True)
    return path
