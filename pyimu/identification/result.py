"""The result of ``pyimu.close``: what was found, and what can be done with it."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from pyimu import notebook
from pyimu.identification.outcome import Outcome
from pyimu.identification.report.deliver import deliver
from pyimu.identification.report.terminal import in_lines
from pyimu.identification.report.words import headline


@dataclass(frozen=True)
class Closed(Outcome):
    """Result of ``pyimu.close``: verdict, part before and after, error on data not fitted."""

    def by_command(self, arguments: Sequence[str]) -> Closed:
        """The same, made by a command line with these arguments, file names without folders."""
        made = None if self.made_with is None else self.made_with.by_command(arguments)
        return replace(self, made_with=made)

    def report(self) -> str:
        """A few lines for a terminal or a notebook."""
        return in_lines(self)

    def __repr__(self) -> str:
        return f"Closed({self.verdict}: {self.before.name}, {len(self.recordings)} recordings)"

    def _repr_html_(self) -> str:
        return notebook.block(
            f"Closed: {self.verdict}", headline(self), notebook.lines(self.report())
        )

    def write(
        self,
        out: str | os.PathLike,
        *,
        units: bool = True,
        say: Callable[[str], None] = lambda text: None,
    ) -> Path:
        """Write ``report.html``, ``report.json`` and ``model.toml`` into the folder ``out``.

        With ``units`` also the FMUs of the sensor as it is now and, under ``before/``, as it was.

        All take the place of earlier ones together, once all are made. Gives the page's path.
        Without a C compiler the FMUs are left out, and the page says so. Raises UserError where the
        folder cannot be written.
        """
        return deliver(self, Path(out), units, say)
