"""The result of ``pyimu.attitude.run``: what the filter estimated, and what can be done with it."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pyimu.attitude.outcome import Outcome
from pyimu.attitude.report.as_json import contents
from pyimu.attitude.report.page import TABLE, page
from pyimu.attitude.report.pictures import angles_picture, whole_figure
from pyimu.attitude.report.terminal import in_lines
from pyimu.display import notebook
from pyimu.files import staged, write_json, write_text
from pyimu.recording.formats.suffix import write_table

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from pandas import DataFrame


@dataclass(frozen=True, eq=False)
class AttitudeResult(Outcome):
    """The result of ``pyimu.attitude.run``: what ``Outcome`` holds, to be read, drawn and kept."""

    def report(self) -> str:
        """A few lines for a terminal or a notebook."""
        return in_lines(self)

    __str__ = report

    def plot(self) -> Figure:
        """Roll, pitch, yaw and gyro bias with their standard deviations, and the NIS, over time."""
        return notebook.shown(whole_figure(self))

    def to_frame(self) -> DataFrame:
        """The samples as a pandas data frame, its columns those of ``attitude.parquet``."""
        return notebook.data_frame(self._table())

    def __repr__(self) -> str:
        span = self.time[-1] - self.time[0]
        smoothed = ", smoothed" if self.smoothed else ""
        return f"AttitudeResult({self.name!r}: {len(self.time)} samples, {span:.5g} s{smoothed})"

    def _repr_html_(self) -> str:
        angles = notebook.picture(angles_picture(self))
        return notebook.block(
            f"Attitude of {self.name}", "", angles, notebook.lines(in_lines(self))
        )

    def as_dict(self) -> dict[str, Any]:
        """The contents of report.json; ``report.as_json.contents`` describes them."""
        return contents(self)

    def write(self, out: str | os.PathLike) -> Path:
        """Write ``report.html``, ``report.json`` and ``attitude.parquet`` into the folder ``out``.

        All take the place of earlier ones together, once all are made. Gives the page's path. A row
        of the table is a sample; its columns are named with their units as in a recording: ``time
        [s]``, ``q_w [1]``, ``gyro_bias_x [rad/s]``, ``std_1 [rad]``, ``nis [1]`` and so on. Raises
        UserError where the folder cannot be written.
        """
        out = Path(out)
        with staged(out) as stage:
            write_text(stage / "report.html", page(self))
            write_json(stage / "report.json", self.as_dict())
            write_table(stage / TABLE, self._table())
        return out / "report.html"

    def _table(self) -> dict[str, np.ndarray]:
        groups = {
            "q_{} [1]": ("wxyz", self.q),
            "gyro_bias_{} [rad/s]": ("xyz", self.gyro_bias),
            "std_{} [rad]": ("123", self.std[:, :3]),
            "std_{} [rad/s]": ("456", self.std[:, 3:]),
        }
        table = {"time [s]": self.time}
        for title, (names, values) in groups.items():
            table |= {title.format(n): column for n, column in zip(names, values.T, strict=True)}
        return table | {
            "heading_std [rad]": self.heading_std,
            "quasi_static [1]": self.quasi_static,
            "at_rest [1]": self.at_rest,
            "nis [1]": self.nis,
            "status [1]": self.status,
        }
