"""The result of ``pyimu.heading.run``: what its methods made of the logs, to be read and kept."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from pyimu.display.brief import FEW
from pyimu.files import plain, staged, write_json, write_text
from pyimu.heading.outcome import Outcome, Track
from pyimu.heading.report.page import TABLE, page
from pyimu.heading.report.terminal import in_lines
from pyimu.recording.formats.suffix import write_table


@dataclass(frozen=True, eq=False)
class HeadingResult(Outcome):
    """The result of ``pyimu.heading.run``: what ``Outcome`` holds, to be read, drawn and kept."""

    def __repr__(self) -> str:
        names = ", ".join(repr(r.name) for r in self.recordings[:FEW])
        more = f" and {len(self.recordings) - FEW} more" if len(self.recordings) > FEW else ""
        return f"HeadingResult({names}{more}: {', '.join(m.name for m in self.methods)})"

    def report(self) -> str:
        """A table for a terminal or a notebook."""
        return in_lines(self)

    __str__ = report

    def as_dict(self) -> dict[str, Any]:
        """The contents of report.json, in SI.

        ``recordings``: [{``name``, ``rows``, ``seconds``}]; ``methods``: [{``name``, ``words``,
        ``error``: count, mean, std, rms and their intervals, ``within``: RMS over all rows,
        ``logs``: [{``heading``, ``error`` at the end, ``calibration``, and of the filter its
        ``last`` estimates}]}]; ``differences``: [{``of``, ``less``, and the figures of the paired
        differences}]; ``transfer``, null without a rate table; ``settings``; ``notes``.
        """
        return plain(
            {
                "recordings": [
                    {"name": r.name, "rows": len(r), "seconds": r.time[-1] - r.time[0]}
                    for r in self.recordings
                ],
                "methods": [
                    {
                        "name": m.name,
                        "words": m.words,
                        "error": m.statistics.as_dict(),
                        "within": m.within,
                        "logs": [_log(t) for t in m.tracks],
                    }
                    for m in self.methods
                ],
                "differences": [
                    {"of": a, "less": b} | s.as_dict() for (a, b), s in self.differences.items()
                ],
                "transfer": self.transfer and self.transfer.as_dict(),
                "settings": self.settings,
                "notes": list(self.notes),
            }
        )

    def write(self, out: str | os.PathLike) -> Path:
        """Write ``report.html``, ``report.json`` and ``heading.parquet`` into the folder ``out``.

        All take the place of earlier ones together. Gives the page's path. The table has a row a
        sample of the first log. Raises UserError where the folder cannot be written.
        """
        out = Path(out)
        with staged(out) as stage:
            write_text(stage / "report.html", page(self))
            write_json(stage / "report.json", self.as_dict())
            write_table(stage / TABLE, self._table())
        return out / "report.html"

    def _table(self) -> dict[str, np.ndarray]:
        first = self.methods[0].tracks[0]
        table = {"time [s]": first.time}
        for m in self.methods:
            table[f"{m.name.replace('-', '_')} [rad]"] = m.tracks[0].heading
            if m.tracks[0].filter is not None:
                track = m.tracks[0].filter
                table |= {
                    "heading_std [rad]": track.heading_std,
                    "bias [rad/s]": track.bias,
                    "bias_std [rad/s]": track.bias_std,
                    "scale_factor [1]": track.scale_factor,
                    "scale_factor_std [1]": track.scale_factor_std,
                    "at_rest [1]": track.at_rest,
                    "status [1]": track.status,
                }
        return table


def _log(t: Track) -> dict[str, Any]:
    kept = t.filter
    names = ("heading_std", "bias", "bias_std", "scale_factor", "scale_factor_std")
    return {
        "name": t.name,
        "heading": t.heading[-1],
        "error": t.last_error,
        "calibration": t.calibration and t.calibration.as_dict(),
        "last": kept and {n: getattr(kept, n)[-1] for n in names},
        "at_rest": kept and float(np.mean(kept.at_rest)),
    }
