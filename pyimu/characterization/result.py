"""The result of ``pyimu.characterize``: what was found, and what can be done with it."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pyimu.characterization.outcome import SI, Outcome
from pyimu.characterization.report.as_json import contents
from pyimu.characterization.report.as_part import part_of
from pyimu.characterization.report.page import MAGNETOMETER, PART, in_notebook, page
from pyimu.characterization.report.pictures.allan import whole_figure
from pyimu.characterization.report.terminal import in_lines
from pyimu.display import notebook
from pyimu.files import staged, write_json, write_text
from pyimu.model.part import Part
from pyimu.model.part_file import save_part

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from pandas import DataFrame


@dataclass(frozen=True)
class Characterization(Outcome):
    """Result of ``pyimu.characterize``: the logs, and the coefficients of the part they are of.

    ``coefficients`` are by (channel, letter), in SI; N is the root of the two-sided density.
    Intervals hold the true value with the probability ``level``.
    """

    def report(self) -> str:
        """What was found, for a terminal or a notebook."""
        return in_lines(self)

    def __repr__(self) -> str:
        logs = ", ".join(log.name for log in self.logs)
        return f"Characterization({logs}: {', '.join(self.kinds)}, {len(self.findings)} findings)"

    def _repr_html_(self) -> str:
        return in_notebook(self)

    def plot(self) -> Figure:
        """Allan deviations with intervals, the fitted noise and its terms, a panel a channel."""
        return notebook.shown(whole_figure(self))

    def to_frame(self) -> DataFrame:
        """The coefficients as a pandas data frame, a row each, in SI.

        Columns: ``channel``, ``term`` (its letter), ``value`` (0 where there is only a bound),
        ``std``, ``low``, ``high``, ``unit``, ``spread`` of the logs, ``logs``.
        """
        rows = [
            {
                "channel": channel,
                "term": term,
                **{k: getattr(s.mean, k) for k in ("value", "std", "low", "high")},
                "unit": SI[channel.partition("_")[0]][term],
                "spread": s.spread,
                "logs": s.logs,
            }
            for (channel, term), s in self.coefficients.items()
        ]
        return notebook.data_frame(rows)

    def part(self, name: str = "characterised") -> Part:
        """The part that these logs are of, as ``pyimu.build`` and ``pyimu.close`` take it.

        It has the noise of both sensors, and the gyro's turn-on bias, temperature effect and
        rounding where they were found. A coefficient with a bound only is zero, and its source
        names the bound. The accelerometer's bias cannot be told from gravity, and is left to the
        data.
        """
        return part_of(self, name)

    def as_dict(self) -> dict[str, Any]:
        """The contents of report.json; ``report.as_json.contents`` describes them."""
        return contents(self)

    def write(self, out: str | os.PathLike) -> Path:
        """Write ``report.html``, ``report.json`` and ``part.toml`` into the folder ``out``.

        ``magnetometer.toml`` is beside them where a log calibrates its magnetometer, and no part
        where one moves, or holds raw counts or forces in another unit than is stated: its noise
        would be that of the motion, or in a false unit. All take the place of earlier ones
        together, once all are made. Gives the page's path.
        Raises UserError where the folder cannot be written.
        """
        out = Path(out)
        with staged(out) as stage:
            write_text(stage / "report.html", page(self))
            write_json(stage / "report.json", self.as_dict())
            if not self.no_part:
                save_part(self.part(self._part_name), stage / PART)
            if self.magnetometer is not None:
                self.magnetometer.calibration.write(stage / MAGNETOMETER)
        if self.no_part:
            (out / PART).unlink(missing_ok=True)  # an earlier one is not this log's
        return out / "report.html"

    @property
    def _part_name(self) -> str:
        """The name of the log, or what the names of the logs begin with."""
        names = [log.name for log in self.logs]
        return names[0] if len(names) == 1 else _common(names) or "characterised"


def _common(names: list[str]) -> str:
    return os.path.commonprefix(names).strip("_-. ")
