"""What a method makes of a recording, and how far that is from a reference."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.display.brief import Brief
from pyimu.recording.recording import Recording


@dataclass(frozen=True, eq=False, repr=False)
class Track(Brief):
    """The motion by one method, a row for each of the recording's.

    ``time`` (n,) s; ``q`` (n, 4) body to east-north-up, scalar first; ``velocity`` m/s and
    ``position`` m (n, 3): east, north, up of the first row. Of a filter there are also
    ``position_std``, ``velocity_std`` m and m/s, ``attitude_std`` rad (n, 3), about or along east,
    north, up, and ``correlation`` (n,) of the errors to the east and to the north.
    """

    method: str
    time: np.ndarray
    q: np.ndarray
    velocity: np.ndarray
    position: np.ndarray
    position_std: np.ndarray | None = None
    velocity_std: np.ndarray | None = None
    attitude_std: np.ndarray | None = None
    correlation: np.ndarray | None = None

    @property
    def yaw(self) -> np.ndarray:
        """rad (n,), without jumps by whole turns."""
        w, x, y, z = self.q.T
        return np.unwrap(np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))

    def widened(self, factor: float) -> Track:
        """The same with ``factor`` times the standard deviations, where it has any."""
        stds = {n: getattr(self, n) for n in ("position_std", "velocity_std", "attitude_std")}
        return replace(self, **{n: factor * v for n, v in stds.items() if v is not None})


@dataclass(frozen=True, eq=False, repr=False)
class Reference(Brief):
    """True positions (m, 3) m at ``rows`` of a recording, from the first of them on.

    The third column is NaN without a height. ``q`` are true attitudes (n, 4), None without.
    """

    rows: np.ndarray
    position: np.ndarray
    q: np.ndarray | None = None

    @property
    def length(self) -> float:
        """m; of the way in the plane."""
        return float(np.linalg.norm(np.diff(self.position[:, :2], axis=0), axis=1).sum())


def reference_of(recording: Recording) -> Reference | None:
    """The positions that a recording has, None without east and north."""
    east, north, up = (getattr(recording, f"ref_{n}") for n in ("east", "north", "up"))
    if east is None or north is None:
        return None
    rows = np.flatnonzero(np.isfinite(east) & np.isfinite(north))
    if len(rows) < 2:
        return None
    height = np.full(len(recording.time), np.nan) if up is None else up
    position = np.column_stack([east, north, height])[rows]
    return Reference(rows, position - position[0], recording.ref_q)


@dataclass(frozen=True, eq=False)
class PositionError:
    """Error of a track against a reference at its rows.

    ``time`` (m,) s; ``east_north`` (m, 2) m; ``up`` (m,) m; ``yaw`` rad at the end, NaN without a
    reference attitude; ``length`` m of the reference's way.
    """

    time: np.ndarray
    east_north: np.ndarray
    up: np.ndarray
    yaw: float
    length: float

    @cached_property
    def horizontal(self) -> np.ndarray:
        """m (m,)."""
        return np.linalg.norm(self.east_north, axis=1)

    @property
    def end(self) -> float:
        """m; horizontal, at the last row."""
        return float(self.horizontal[-1])

    @property
    def rms(self) -> float:
        """m; horizontal, over the rows."""
        return float(np.sqrt(np.mean(self.horizontal**2)))

    @property
    def most(self) -> float:
        return float(self.horizontal.max())


def error_of(track: Track, reference: Reference) -> PositionError:
    """The error of a track, whose first row with a reference is taken for right."""
    found = track.position[reference.rows]
    off = found - found[0] - reference.position
    yaw = np.nan
    if reference.q is not None and np.isfinite(reference.q[-1]).all():
        pair = [Rotation.from_quat(q[-1], scalar_first=True) for q in (track.q, reference.q)]
        yaw = (
            float((pair[0] * pair[1].inv()).as_rotvec()[2])
            if np.isfinite(track.q[-1]).all()
            else yaw
        )
    return PositionError(track.time[reference.rows], off[:, :2], off[:, 2], yaw, reference.length)
