"""What may go wrong in a run: the samples of a sensor that has failed."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

STUCK_FOR = 20.0
"""s for which a stuck gyro gives one sample."""

WRONG_BY = np.deg2rad(10.0)
"""rad by which a heading sensor is wrong that has failed."""

OF_RANGE = 0.9
"""Share of the drive's largest rate at which a gyro of too small a range ends."""

NONE = "none"

SATURATING = "saturating"

FAULTS = {
    "lost-axis": "an axis of the gyro gives nothing any more",
    "stuck": f"the gyro gives one sample for {STUCK_FOR:g} s",
    SATURATING: f"the gyro's range ends at {OF_RANGE:.0%} of the drive's largest rate",
    "heading-lost": "the heading sensor gives nothing any more",
    "heading-wrong": f"the heading sensor is wrong by {np.rad2deg(WRONG_BY):g} deg",
}
"""The faults by name. That of the range begins with the run, the others some time in the drive."""

NEEDS_HEADING = ("heading-lost", "heading-wrong")


@dataclass
class Fault:
    """What fails from ``time`` s on, and on which ``axis``; ``held`` is what a stuck gyro gives."""

    name: str = NONE
    time: float = float("nan")
    axis: int = 0
    held: np.ndarray | None = field(default=None, compare=False)

    def in_gyro(self, gyro: np.ndarray, time: np.ndarray) -> None:
        """Change successive samples (n, 3) of the gyro, taken at ``time`` (n,) s."""
        if self.name == "lost-axis":
            gyro[time >= self.time, self.axis] = np.nan
        if self.name == "stuck":
            rows = np.flatnonzero((time >= self.time) & (time < self.time + STUCK_FOR))
            if len(rows):
                self.held = gyro[rows[0]].copy() if self.held is None else self.held
                gyro[rows] = self.held

    def in_heading(self, heading: np.ndarray, valid: np.ndarray, time: np.ndarray) -> None:
        """Change headings (n,) rad and whether they are ``valid`` (n,)."""
        if self.name == "heading-lost":
            valid[time >= self.time] = 0.0
        if self.name == "heading-wrong":
            heading[time >= self.time] += WRONG_BY
