"""The result of the test drives: what they showed, and what can be done with it."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from pyimu.files import staged, write_json, write_text
from pyimu.rover.outcome import RoverOutcome
from pyimu.rover.page import page
from pyimu.rover.words import in_lines


@dataclass(frozen=True, eq=False)
class RoverTests(RoverOutcome):
    """The result of ``rover_tests``: what ``RoverOutcome`` holds, to be read and kept."""

    def report(self) -> str:
        """A few lines for a terminal or a notebook."""
        return in_lines(self)

    def write(self, out: str | os.PathLike) -> Path:
        """Write ``report.html`` and ``report.json`` into the folder ``out``.

        Gives the page's path. Raises UserError where the folder cannot be written.
        """
        out = Path(out)
        with staged(out) as stage:
            write_text(stage / "report.html", page(self))
            write_json(stage / "report.json", self.as_dict())
        return out / "report.html"
