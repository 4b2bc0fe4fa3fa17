"""What was seen in a log: for the terminal, as JSON, as a page, and the map to read it by."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from pyimu.display import notebook
from pyimu.errors import UserError
from pyimu.files import check_folder, shortened, staged, write_json, write_text
from pyimu.inspection.next_step import next_step
from pyimu.inspection.outcome import Outcome
from pyimu.inspection.page import page

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True, eq=False)
class Inspection(Outcome):
    """A log that was looked into, to be printed and written."""

    def report(self, written: Path | None = None) -> str:
        """The same for a terminal, with what to do next; ``written`` is the map that was."""
        said = [*self.lines()]
        questions = [q for p in self.proposals for q in p.open_questions]
        if self.problem:
            said.append(f"not readable so: {self.problem}")
        if self.proposals and self.proposals[0].timeless and self.kind != "map":
            said.append("no column is a time: say the sample rate in the map, sample_rate")
        if questions:
            said.append(f"choose the unit of {', '.join(questions)} in the map")
        if self.kind == "guessed" and not self.problem:
            said.append(f"it is read by the map alone: give that to {self.proposals[0].given_to}")
        said += next_step(self, written)
        return "\n".join(said)

    def __repr__(self) -> str:
        known = self.format or self.kind
        if self.recording is None:
            return f"Inspection({self.path.name!r}: {known}, {shortened(self.problem, 160)!r})"
        log = self.recording
        return (
            f"Inspection({self.path.name!r}: {known}, {len(log)} samples, {log.sample_rate:.6g} "
            f"Hz, {', '.join(log.groups)}; {len(self.findings)} findings)"
        )

    def _repr_html_(self) -> str:
        head = ("column", "meaning", "unit", "numbers", "how it is known")
        said = [line for line in self.report().splitlines() if not line.startswith("  ")]
        return notebook.block(
            f"Log {self.path.name}",
            "",
            notebook.table(head, self.columns),
            notebook.lines("\n".join(said)),
        )

    def plot(self) -> Figure:
        """The log over time, a panel a group. Raises UserError where it could not be read."""
        if self.recording is None:
            raise UserError(f"{self.path}: nothing to draw, it could not be read: {self.problem}")
        return self.recording.plot()

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
