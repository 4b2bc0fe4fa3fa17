"""What was seen in a log: for the terminal, as JSON, as a page, and the map to read it by."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from pyimu.files import check_folder, staged, write_json, write_text
from pyimu.inspection.outcome import Outcome
from pyimu.inspection.page import page


@dataclass(frozen=True, eq=False)
class Inspection(Outcome):
    """A log that was looked into, to be printed and written."""

    def report(self) -> str:
        """The same for a terminal, with what to do next."""
        said = [*self.lines()]
        questions = [q for p in self.proposals for q in p.open_questions]
        if self.problem:
            said.append(f"not readable so: {self.problem}")
        if self.proposals and self.proposals[0].timeless and self.kind != "map":
            said.append("no column is a time: say the sample rate in the map, sample_rate")
        if questions:
            said.append(f"choose the unit of {', '.join(questions)} in the map")
        return "\n".join(said)

    def write_map(self, path: str | os.PathLike) -> Path:
        """Write the column map. Raises UserError where it cannot be written."""
        write_text(Path(path), self.column_map)
        return Path(path)

    def write(self, out: str | os.PathLike) -> Path:
        """Write ``report.html`` and ``report.json`` into the folder ``out``; gives the page's path.

        Raises UserError where it cannot be written.
        """
        check_folder(out)
        with staged(Path(out)) as stage:
            write_text(stage / "report.html", page(self))
            write_json(stage / "report.json", self.as_dict())
        return Path(out) / "report.html"
