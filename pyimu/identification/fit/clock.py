"""The clock of a log's reference, as a trial carries it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np


@dataclass(frozen=True)
class Clock:
    """How much later than its reference says a sensor shows the motion of a log.

    ``late`` (k,) s at ``time`` (k,) s of the log, one entry where the clocks keep step; ``std`` is
    the standard error in s. ``explained`` is the share of the sensor's power that the reference
    then accounts for. ``own`` s are left beside it for the effects of the sensor that make it
    late; ``taken_out`` says whether ``late`` was taken out of the reference, or is too small for
    that.
    """

    time: np.ndarray
    late: np.ndarray
    std: float
    explained: float
    own: float = 0.0
    taken_out: bool = False

    @property
    def keeps_step(self) -> bool:
        return len(self.late) == 1

    @property
    def mean(self) -> float:
        return float(np.mean(self.late))

    def less(self, delay: float) -> Clock:
        """The clock when ``delay`` s of it are the sensor's own."""
        return replace(self, late=self.late - delay, own=delay)

    def as_dict(self) -> dict[str, float | bool | None]:
        """Its figures in s, as they were measured, for report.json."""
        figures = {
            "late": self.mean + self.own,
            "std": self.std,
            "least": float(self.late.min()) + self.own,
            "most": float(self.late.max()) + self.own,
            "left_to_sensor": self.own,
        }
        known = {k: v if np.isfinite(v) else None for k, v in figures.items()}
        return known | {"taken_out": self.taken_out}

    def at(self, time: np.ndarray) -> np.ndarray:
        return np.interp(time, self.time, self.late)
