"""The result of ``pyimu.ins.run``: the paths, and what can be done with them."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from pyimu.files import staged, write_json, write_text
from pyimu.ins.outcome import Outcome
from pyimu.ins.report.as_json import contents
from pyimu.ins.report.page import TABLE, page
from pyimu.ins.report.words import in_lines
from pyimu.ins.track import Track
from pyimu.recording.formats.suffix import write_table
from pyimu.recording.recording import Recording


@dataclass(frozen=True, eq=False)
class NavigationResult(Outcome):
    """The result of ``pyimu.ins.run``: what ``Outcome`` holds, to be read and kept."""

    def __repr__(self) -> str:
        log = self.recording
        return (
            f"NavigationResult({self.name!r}: {', '.join(self.tracks)}; {len(log)} samples, "
            f"{np.ptp(log.time):.4g} s)"
        )

    def report(self) -> str:
        """A few lines for a terminal or a notebook."""
        return in_lines(self)

    __str__ = report

    def as_dict(self) -> dict[str, Any]:
        """The contents of report.json; ``report.as_json.contents`` describes them."""
        return contents(self)

    def estimate(self, method: str | None = None) -> Recording:
        """The recording with the estimate of a method, the best one without it, in place of the
        truth: ``ref_q``, ``ref_velocity``, ``ref_east``, ``ref_north``, ``ref_up``, ``stationary``.
        """
        track = self.best if method is None else self.tracks[method]
        if track is None:
            return self.recording
        east, north, up = track.position.T
        return replace(
            self.recording,
            ref_q=track.q,
            ref_velocity=track.velocity,
            ref_east=east,
            ref_north=north,
            ref_up=up,
            stationary=self.still.astype(float),
        )

    def write(self, out: str | os.PathLike) -> Path:
        """Write ``report.html``, ``report.json``, ``navigation.parquet`` and ``estimate.parquet``.

        All take the place of earlier ones in the folder ``out`` together, once all are made. Gives
        the page's path. A row of the first table is a sample, with the columns of each method
        (``filter_position_east [m]``); the second is the recording with the best estimate as its
        motion, as every command reads it. Raises UserError where the folder cannot be written.
        """
        out = Path(out)
        with staged(out) as stage:
            write_text(stage / "report.html", page(self))
            write_json(stage / "report.json", self.as_dict())
            write_table(stage / TABLE, self._table())
            self.estimate().write(stage / "estimate.parquet")
        return out / "report.html"

    def _table(self) -> dict[str, np.ndarray]:
        table = {"time [s]": self.time, "at_rest [1]": self.still.astype(float)}
        for name, track in self.tracks.items():
            table |= {f"{name}_{column}": values for column, values in _columns(track).items()}
        for name in ("zupt_nis", "zaru_nis", "nhc_nis", "position_nis", "velocity_nis", "status"):
            table[f"{name} [1]"] = self.filter.scalar(name)
        return table


ENU = ("east", "north", "up")


def _columns(track: Track) -> dict[str, np.ndarray]:
    groups = {
        "q_{} [1]": ("wxyz", track.q),
        "velocity_{} [m/s]": (ENU, track.velocity),
        "position_{} [m]": (ENU, track.position),
        "position_std_{} [m]": (ENU, track.position_std),
        "velocity_std_{} [m/s]": (ENU, track.velocity_std),
        "attitude_std_{} [rad]": (ENU, track.attitude_std),
    }
    out = {}
    for title, (names, values) in groups.items():
        if values is not None:
            out |= {title.format(n): c for n, c in zip(names, values.T, strict=True)}
    if track.correlation is not None:
        out["correlation_east_north [1]"] = track.correlation
    return out
