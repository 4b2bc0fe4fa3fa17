"""The result of ``pyimu.close``: what was found, and what can be done with it."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from pyimu.display import notebook
from pyimu.display.silent import silent
from pyimu.errors import UserError
from pyimu.identification.outcome import Outcome
from pyimu.identification.report.deliver import deliver
from pyimu.identification.report.errors import whole_figure
from pyimu.identification.report.terminal import in_lines
from pyimu.identification.report.words import headline
from pyimu.report.numbers import joined

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from pandas import DataFrame


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
        logs = f"{len(self.recordings)} recording{'s' * (len(self.recordings) != 1)}"
        return f"Closed({self.verdict}: {self.before.name}, {logs})"

    def _repr_html_(self) -> str:
        return notebook.block(
            f"Closed: {self.verdict}", headline(self), notebook.lines(self.report())
        )

    def plot(self, sensor: str | None = None) -> Figure:
        """The residual of a sensor over time, before and after, on data that was not fitted.

        ``sensor`` is "gyro" or "accel", None for the first that was examined. Raises UserError for
        one that was not.
        """
        kind = sensor or next(iter(self.exhibits), "gyro")
        if kind not in self.exhibits:
            raise UserError(
                f"{kind}: was not examined; examined are {joined(list(self.exhibits)) or 'none'}"
            )
        return notebook.shown(whole_figure(self, kind))

    def to_frame(self) -> DataFrame:
        """The model's coefficients as a pandas data frame, a row each, arrays in SI.

        Columns: ``coefficient`` (``gyro.scale_factor.s``), ``value``, ``std``, ``low``, ``high``,
        ``shown`` (whether these logs show an element), ``unit``, ``origin``, ``source``.
        """
        names = ("value", "std", "low", "high", "shown", "unit", "origin", "source")
        rows = [
            {"coefficient": f"{e.sensor}.{e.effect}.{e.parameter}"}
            | {name: getattr(e, name) for name in names}
            for e in self.estimated
        ]
        return notebook.data_frame(rows)

    def write(
        self,
        out: str | os.PathLike,
        *,
        units: bool = True,
        say: Callable[[str], None] = silent,
    ) -> Path:
        """Write ``report.html``, ``report.json`` and ``model.toml`` into the folder ``out``.

        With ``units`` also the FMUs of the sensor as it is now and, under ``before/``, as it was.

        All take the place of earlier ones together, once all are made. Gives the page's path.
        Without a C compiler the FMUs are left out, and the page says so. Raises UserError where the
        folder cannot be written.
        """
        return deliver(self, Path(out), units, say)
