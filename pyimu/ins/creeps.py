"""A body that creeps: what its rests may hide of it, as slower creeps look like a rest."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyimu.errors import Finding
from pyimu.ins.filtered import Filtered
from pyimu.ins.shoves import CREEP
from pyimu.ins.track import Track
from pyimu.recording.clock import runs

SEEN = 3.0
"""Standard deviations that a creep must have of speed to be called one."""

HIDDEN = 0.4
"""Of the slowest creep that was seen: standard deviation, along each axis, of the speed that a rest
may hide, as 1 / sqrt(6) is that of anything up to it in every second rest."""


def creeping(found: Filtered, findings: list[Finding]) -> Finding | None:
    """The drives among ``findings`` that were creeps, by the velocities that the filter has there:
    how many, the s at which the first begins, and the m/s that slower ones may hide in a rest; None
    where there are none.
    """
    seen: list[tuple[float, float]] = []
    for f in findings:
        if f.kind != "steady_drive":
            continue
        at = int(np.searchsorted(found.time, f.detail["first"]))
        speed = float(np.linalg.norm(found.vector("velocity")[at, :2]))
        std = float(np.linalg.norm(found.vector("velocity_std")[at, :2]))
        if SEEN * std < speed < CREEP:
            seen.append((f.detail["first"], speed))
    if not seen:
        return None
    detail = {"first": seen[0][0], "hides": HIDDEN * min(speed for _, speed in seen)}
    return Finding("creeps", "", len(seen), detail)


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
