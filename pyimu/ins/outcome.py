"""What each method made of a recording, as frozen data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from pyimu.attitude.rest import Rest
from pyimu.errors import Finding
from pyimu.ins.detector import WINDOW
from pyimu.ins.filter.updates import gate
from pyimu.ins.filtered import Filtered
from pyimu.ins.measured import Fixes
from pyimu.ins.too_sure import too_sure
from pyimu.ins.track import PositionError, Reference, Track, error_of
from pyimu.recording.clock import runs
from pyimu.recording.recording import Recording

GATE = gate(3)
"""Normalised innovation squared of a velocity from which on it is weighed down."""


@dataclass(frozen=True, eq=False)
class Outcome:
    """The motion of a recording by each method.

    ``tracks`` by the method's name, their standard deviations ``too_sure`` times the filter's where
    nothing but rests holds them; ``filter`` are the outputs of the filter; ``still`` (n,) marks
    rest; ``reference`` the true positions, None without; ``settings`` the filter's parameters by
    name; ``heading0`` rad the yaw with which all began, ``heading_from`` where that came from;
    ``gains`` how many scale factors and misalignments were estimated; ``fixes`` the measured
    positions and velocities that corrected the filter, None without.
    """

    name: str
    recording: Recording = field(repr=False)
    tracks: Mapping[str, Track]
    filter: Filtered = field(repr=False)
    still: np.ndarray = field(repr=False)
    reference: Reference | None = field(repr=False)
    rest: Rest | None = None
    part: str = ""
    settings: Mapping[str, float] = field(default_factory=dict, repr=False)
    findings: tuple[Finding, ...] = ()
    nhc: bool = False
    zupt: str = "auto"
    heading0: float = 0.0
    heading_from: str = ""
    gains: int = 0
    fixes: Fixes | None = field(default=None, repr=False)

    @property
    def time(self) -> np.ndarray:
        return self.recording.time

    @property
    def duration(self) -> float:
        """s."""
        return float(self.time[-1] - self.time[0])

    @cached_property
    def errors(self) -> dict[str, PositionError]:
        """Of each method against the reference; empty without one."""
        if self.reference is None:
            return {}
        return {name: error_of(track, self.reference) for name, track in self.tracks.items()}

    @cached_property
    def stops(self) -> list[tuple[int, int]]:
        """The rests as ranges of rows."""
        return runs(self.still)

    @cached_property
    def later_stops(self) -> list[tuple[int, int]]:
        """Those after the start, each with a drive before it.

        A rest that is found by the samples until now begins a window late, at the start too, and a
        sample that a detector misses parts a rest: what is no longer than a window is no drive.
        """
        begun = self.rest.rows.stop if self.rest is not None and self.rest.seen else 1
        found, end = [], 0
        for first, after in self.stops:
            driven = self.time[first] - self.time[max(end - 1, 0)]
            if driven > WINDOW and (end or first >= begun):
                found.append((first, after))
            end = after
        return found

    @property
    def declares_rests(self) -> bool:
        """Whether the log's own column says where it rests."""
        return self.zupt != "live" and self.recording.stationary is not None

    @cached_property
    def too_sure(self) -> float:
        """How many times as far off as the filter says the drives end; 1 where that is chance."""
        return too_sure(self.filter, self.later_stops)

    @property
    def longest_leg(self) -> float:
        """s; the longest time without a rest."""
        return float(
            max((self.time[b - 1] - self.time[a] for a, b in runs(~self.still)), default=0)
        )

    @property
    def first_zupts(self) -> np.ndarray:
        """Normalised innovations squared of the first zero velocity of each stop but that at the
        start, which judge the leg before it: 3 is right. The later ones of a stop only show the
        noise that they were given.
        """
        nis = self.filter.scalar("zupt_nis")
        return np.array([nis[a] for a, _ in self.later_stops if nis[a] > 0])

    @property
    def contradicting_stops(self) -> list[tuple[float, float]]:
        """When, in s, a stop begins that contradicts the leg before it beyond the gate, and by how
        many standard deviations the velocity is off there, as a root mean square of its axes.
        """
        nis = self.filter.scalar("zupt_nis")
        wrong = [a for a, _ in self.later_stops if nis[a] > GATE]
        return [(float(self.time[a]), float(np.sqrt(nis[a] / 3))) for a in wrong]

    def mean_nis(self, name: str) -> float | None:
        """Mean normalised innovation squared of an update, None where there was none."""
        nis = self.filter.scalar(name)
        return float(nis[nis > 0].mean()) if np.any(nis > 0) else None

    @property
    def best(self) -> Track | None:
        """The track that knows most."""
        for name in ("smoother", "filter", "strapdown", "paper"):
            if name in self.tracks:
                return self.tracks[name]
        return None
