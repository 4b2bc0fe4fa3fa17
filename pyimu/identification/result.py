"""The result of ``pyimu.close``: what was found, and what can be done with it."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from pyimu.identification.outcome import Outcome
from pyimu.identification.report.deliver import deliver
from pyimu.identification.report.words import in_lines


@dataclass(frozen=True)
class Closed(Outcome):
    """Result of ``pyimu.close``: the part before and after, the verdict, and the error on data that
    was not fitted.
    """

    def report(self) -> str:
        """A few lines for a terminal or a notebook."""
        return in_lines(self)

    def write(
        self,
        out: str | os.PathLike,
        *,
        units: bool = True,
        say: Callable[[str], None] = lambda text: None,
    ) -> Path:
        """Write ``report.html``, ``report.json`` and ``model.toml`` into the folder ``out``, and
        with ``units`` the FMUs of the sensor as it is now and, under ``before/``, as it was.

        All take the place of earlier ones together, once all are made. Gives the page's path.
        Raises UserError where the folder cannot be written or no compiler is found.
        """
        return deliver(self, Path(out), units, say)
