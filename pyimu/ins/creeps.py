"""A body that creeps: what its rests may hide of it, as slower creeps look like a rest."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from pyimu.errors import Finding
from pyimu.ins.filtered import Filtered
from pyimu.ins.measured import measured_columns
from pyimu.ins.track import Track
from pyimu.recording.clock import runs

CREEP = 0.05
"""m/s; of what creeps, at most. Assumed."""

SEEN = 3.0
"""Standard deviations that a creep must have of speed to be called one."""

EVERY = 10.0
"""s; from one word on the velocity of a creep to the next. Assumed."""

HIDDEN = 0.4
"""Of the slowest creep that was seen: standard deviation, along each axis, of the speed that a rest
may hide, as 1 / sqrt(6) is that of anything up to it in every second rest."""


@dataclass(frozen=True)
class Creeps:
    """Drives that were creeps: the s at which the ``first`` begins, how many, the m/s that slower
    ones may ``hide`` in a rest, and ``rows`` (m,) of the longer ones, ``EVERY`` s.
    """

    first: float
    count: int
    hides: float
    rows: np.ndarray

    @property
    def finding(self) -> Finding:
        return Finding("creeps", "", self.count, {"first": self.first, "hides": self.hides})

    def columns(self, count: int) -> dict[str, np.ndarray]:
        """The filter's inputs (count,): at the rows the velocity is zero, as far as a creep's is.

        What creeps for long may stop and go on unseen, and the velocity that is integrated from
        its begin is known worse than that after some ten seconds.
        """
        std = np.full(count, CREEP / np.sqrt(3))
        return measured_columns("velocity", np.zeros((count, 3)), std, self.rows)


def creeping(found: Filtered, findings: list[Finding], period: float) -> Creeps | None:
    """The drives among ``findings`` that were creeps, by the velocities that the filter has there;
    None where there are none. A sample is ``period`` s long.
    """
    seen: list[tuple[float, float]] = []
    rows, every = [np.zeros(0, dtype=int)], max(1, round(EVERY / period))
    for f in findings:
        if f.kind != "steady_drive":
            continue
        at = int(np.searchsorted(found.time, f.detail["first"]))
        speed = float(np.linalg.norm(found.vector("velocity")[at, :2]))
        std = float(np.linalg.norm(found.vector("velocity_std")[at, :2]))
        if SEEN * std < speed < CREEP:
            seen.append((f.detail["first"], speed))
        if max(speed, std) < CREEP:
            rows.append(np.arange(at + every, min(at + f.count, len(found.time)), every))
    if not seen:
        return None
    slowest = min(speed for _, speed in seen)
    return Creeps(seen[0][0], len(seen), HIDDEN * slowest, np.concatenate(rows))


def beside_creeps(track: Track, still: np.ndarray, hides: float) -> Track:
    """The track with standard deviations that allow for a speed of ``hides`` m/s, along each axis
    in the plane, in each of the rests that ``still`` (n,) marks.
    """
    if track.position_std is None or track.velocity_std is None:
        return track
    more, before = np.zeros(len(still)), 0.0
    for start, stop in runs(still):
        gone = hides * (track.time[start:stop] - track.time[start])
        more[start:stop] = before + gone**2
        before = float(more[stop - 1])
        more[stop:] = before
    plane = np.array([1.0, 1.0, 0.0])
    position = np.sqrt(track.position_std**2 + np.outer(more, plane))
    velocity = np.sqrt(track.velocity_std**2 + np.outer(hides**2 * still, plane))
    return replace(track, position_std=position, velocity_std=velocity)
