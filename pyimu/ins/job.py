"""A recording and what is known before the filter runs over it, and its runs."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.attitude.alignment import tilt_of
from pyimu.attitude.input_grid import InputGrid
from pyimu.attitude.rest import Rest
from pyimu.block.block import Block
from pyimu.block.parameters import number, with_values
from pyimu.errors import Finding
from pyimu.ins.crabbing import Crabbing, crabbing
from pyimu.ins.filter.ins_block import ins_of_log
from pyimu.ins.filter.layout import Layout
from pyimu.ins.filtered import Filtered, filtered
from pyimu.ins.lasting import Lasting, lasting, too_small
from pyimu.ins.measured import COURSE, Fixes, measures_speed
from pyimu.ins.smoothing import smoothed
from pyimu.ins.stops import shows_noise
from pyimu.ins.track import Reference, Track
from pyimu.model.part import Part
from pyimu.recording.recording import Recording
from pyimu.recording.turning import carried

FIXES = 10.0
"""Standard deviations of a position that such a way is long at least."""

COURSE_STD = 0.1
"""rad; standard deviation of a heading that is a course: a body may stand askew on its vehicle, and
its way bend. Assumed."""


PASSES = 2
"""Smoothed paths by which the errors of positions that last are measured. That of errors which do
not last follows them, and what is left of them seems to last half as long again; the next paths
are those of what was found before."""

LATER_STD = 1e-3
"""rad; standard deviation of a heading that the log has, as the filter takes one of the first
sample (``heading_std0``)."""


LATER_BIAS_STD = 3e-3
"""rad/s; by how much the gyro's bias of a first sample may differ from that of a later rest. A
consumer part's warms up by 0.2 deg/s (``typical.toml``)."""

PUSHES = 30.0
"""s; over which the mean force is taken that tells the tilt of a body in motion."""

CLIMBS = 0.1
"""Of the top speed: how fast a body may go upwards at first."""

TWICE, LEAST_STD = 2.0, 0.1
"""Times the standard deviation that the path itself gives the first velocity, and m/s: the same
measurements are used again, and the constraint may contradict them."""


@dataclass(frozen=True, eq=False)
class Job:
    """A recording and what is known before the filter runs over it.

    ``clean`` is the recording without the errors that the part knows; ``still`` (n,) marks rests,
    which the filter looks for where it is ``live``; ``fixes`` are its positions and velocities,
    None without. Of a body that is first seen in motion, ``later`` is a rest of its samples, and
    ``begun`` the path by these positions.
    """

    recording: Recording
    clean: Recording
    part: Part
    rest: Rest
    still: np.ndarray
    latitude: float
    gravity: float
    nhc: bool
    live: bool
    fixes: Fixes | None
    settings: Mapping[str, Any]
    wheels: bool = False
    lasting: Lasting | None = None
    crabs: Crabbing | None = None
    later: Rest | None = None
    begun: Track | None = None

    @cached_property
    def layout(self) -> Layout:
        lasts = {"lasting": self.lasting is not None, "wheels": self.wheels}
        return Layout(self.part, self.nhc, self.live, **lasts)

    @property
    def late(self) -> float:
        """How many s a measured speed may be late: one that is counted from one to the next is that
        of the middle between them.
        """
        at = self.recording.time[np.isfinite(self.recording.speed)]
        return float(np.median(np.diff(at))) / 2 if len(at) > 1 else 0.0

    @property
    def block(self) -> Block:
        return ins_of_log(self.layout)

    def p(self, start: Start) -> np.ndarray:
        """The block's parameters."""
        values = {"latitude": self.latitude, "gravity": self.gravity, "detect": float(self.live)}
        fixes = {} if self.fixes is None else self.fixes.settings
        lasts = {} if self.lasting is None else self.lasting.settings
        wheels = {"speed_late_std": self.late} if measures_speed(self.recording) else {}
        wheels |= {} if self.crabs is None else self.crabs.settings
        told = fixes | lasts | wheels | start.settings | dict(self.settings)
        return with_values(self.block, self._moving_start(told) | values | told)

    def _moving_start(self, told: Mapping[str, Any]) -> dict[str, float]:
        """What is known of velocity and gyro bias at a first sample in motion: the one is at most
        the top speed, or that of ``begun``, the other near what a rest shows later.
        """
        if shows_noise(self.rest):
            return {}
        known = {v.name: v.start for v in self.block.parameters}
        top = float(told.get("top_speed", known["top_speed"]))
        stds, least = (top, CLIMBS * top), (known["velocity_std0"], known["climb_std0"])
        settings: dict[str, float] = {}
        if self.begun is not None:
            velocity, (*plane, up) = self.begun.velocity[0], self.begun.velocity_std[0]
            settings = {f"velocity0[{i}]": float(v) for i, v in enumerate(velocity, 1)}
            stds, least = (TWICE * max(plane), TWICE * up), (LEAST_STD, LEAST_STD)
            back = Rotation.from_quat(self.begun.q[0], scalar_first=True).inv()
            settings |= _tilt(back.apply([0.0, 0.0, 1.0]))
        elif self.later is not None:
            settings |= self._mean_tilt
        settings["velocity_std0"], settings["climb_std0"] = map(float, map(max, stds, least))
        for i, b in enumerate(() if self.later is None else self.later.rate, 1):
            settings[f"gyro_bias0[{i}]"] = float(b)
            name = f"gyro_bias_std0[{i}]"
            settings[name] = min(known[name], LATER_BIAS_STD)
        return settings

    @cached_property
    def _mean_tilt(self) -> dict[str, float]:
        """The tilt at a first sample in motion, by the mean force of what follows in its axes: what
        pushes a body to and fro leaves little of that, where a bend leans its own by 30 deg.
        """
        r, (start, stop) = self.clean, self.clean.segments[0]
        rows = slice(start, min(stop, start + round(PUSHES / r.sample_period)))
        turns = np.nan_to_num(r.gyro[rows] - self.later.rate) * r.sample_period
        force = np.nan_to_num(r.accel[rows])
        _, total = carried(turns[:, None], force[:, None, :, None], np.array([len(turns)]))
        return _tilt(total[0, :, 0])

    def told(self, start: Start) -> dict[str, Any]:
        """What a result says of it, by the fields of ``Outcome``."""
        names = [v.name for v in self.block.parameters]
        return {
            "rest": self.rest,
            "settings": dict(zip(names, self.p(start), strict=True)),
            "nhc": self.nhc,
            "heading0": start.heading,
            "heading_from": start.source,
            "gains": len(self.layout.gains),
            "fixes": self.fixes,
        }

    def grid(self, start: Start, fixes: bool = True) -> InputGrid:
        marked = replace(self.recording, stationary=self.still.astype(float), heading=None)
        names = [v.name for v in self.block.inputs]
        more = None
        if fixes and self.fixes is not None:
            more = self.fixes.of_antenna(self._antenna(start))
        return InputGrid(marked, self.part, names, more=more)

    def with_lasting(self, found: Filtered, start: Start, say: Callable[..., None]) -> Job:
        """The job with what lasts of the errors of its positions; itself where nothing shows that
        something does.
        """
        if self.fixes is None or not too_small(found, self.fixes):
            return self
        job = self
        for _ in range(PASSES):
            lasts = lasting(self.fixes, job.smoothed(start, say), self._arm(start))
            if lasts is None:
                return self
            job = replace(self, fixes=lasts.rest(self.fixes), lasting=lasts)
        return job

    def with_crabbing(self, start: Start, say: Callable[..., None]) -> Job:
        """The job with how its vehicle crabs; itself where no positions tell."""
        if not self.nhc or self.fixes is None or not len(self.fixes.rows):
            return self
        free = replace(self, nhc=False).smoothed(start, say)
        return replace(self, crabs=crabbing(free, self.recording.gyro[:, 2]))

    def with_begun(self, start: Start, say: Callable[..., None]) -> Job:
        """The job with a path by its positions of a body that is first seen in motion: itself where
        it is seen at rest, or has no positions.

        Beside a speed of which nothing is known the slopes of a first run are far off, and a
        vehicle's constraint, without which that is, would take the speed for one along axes that
        are not known yet.
        """
        if shows_noise(self.rest) or self.fixes is None or not len(self.fixes.rows):
            return self
        return replace(self, begun=replace(self, nhc=False).smoothed(start, say))

    @property
    def of_errors(self) -> list[Finding]:
        """What lasts of errors."""
        lasts = [] if self.lasting is None else [self.lasting.finding]
        crabs = [] if self.crabs is None or not self.crabs.std else [self.crabs.finding]
        return [*lasts, *crabs]

    def _arm(self, start: Start) -> np.ndarray:
        """From the sensor to the antenna (3,) m, body axes."""
        p, names = self.p(start), [v.name for v in self.block.parameters]
        return np.array([p[names.index(f"antenna[{i}]")] for i in (1, 2, 3)])

    def _antenna(self, start: Start) -> np.ndarray:
        """Where the antenna (3,) is at the start, m in world axes, of a body that stands level."""
        x, y, z = self._arm(start)
        c, s = np.cos(start.heading), np.sin(start.heading)
        return np.array([c * x - s * y, s * x + c * y, z])

    def filtered(self, start: Start, fixes: bool = True) -> Filtered:
        p, time = self.p(start), self.recording.time
        speed = self._top_speed(p)
        return filtered(self.block, self.layout, self.grid(start, fixes), p, time, speed)

    def smoothed(self, start: Start, say: Callable[..., None]) -> Track:
        p, block = self.p(start), ins_of_log(self.layout, True)
        time = self.recording.time
        return smoothed(block, self.layout, self.grid(start), p, time, self._top_speed(p), say)

    def _top_speed(self, p: np.ndarray) -> float:
        names = [v.name for v in self.block.parameters]
        return float(p[names.index("top_speed")])

    def started(
        self, heading0: float | None, reference: Reference | None
    ) -> tuple[Filtered, Start]:
        """The filter's estimates, and the heading with which they begin."""
        start = _heading(self.recording, heading0)
        if start is not None:
            return self.filtered(start), start
        start = Start(0.0, "nothing: it is called 0")
        found = self.filtered(start, fixes=False)
        track = found.track("filter")
        later = self._by_later(track) or self._by_course(reference, track)
        if later is None and self.fixes is None:
            return found, start
        return self.filtered(later or start), later or start

    def _by_later(self, track: Track) -> Start | None:
        """The heading by the first that the log has later, turned back by the gyro."""
        for source, yaw in _told_headings(self.recording):
            rows = np.flatnonzero(np.isfinite(yaw))
            if not len(rows):
                continue
            row = rows[0]
            turned = track.yaw[row] - track.yaw[0]
            std = 0.0
            if track.attitude_std is not None:
                of_gyro = track.attitude_std[row, 2] ** 2 - track.attitude_std[0, 2] ** 2
                std = float(np.sqrt(max(of_gyro, 0.0)))
            source = f"{source} at {self.recording.time[row]:.6g} s"
            return Start(float(yaw[row] - turned), source, float(np.hypot(std, LATER_STD)))
        return None

    def _by_course(self, reference: Reference | None, track: Track) -> Start | None:
        """The heading by the course of the first positions, else of the first velocities, else by
        the reference's.
        """
        if self.fixes is not None:
            for name, rows, position, std in self.fixes.ways(self.recording.time):
                far = max(COURSE, FIXES * std)
                course = _course(rows, position, track, far)
                if course is not None:
                    of_course = float(np.hypot(COURSE_STD, np.sqrt(2) * std / far))
                    return Start(
                        course, f"the course of the first {far:.2g} m of {name}", of_course
                    )
        if reference is None:
            return None
        course = _course(reference.rows, reference.position, track, COURSE)
        source = f"the course of the reference's first {COURSE:g} m"
        return None if course is None else Start(course, source)


def _tilt(up: np.ndarray) -> dict[str, float]:
    """The filter's parameters of a start in which ``up`` (3,), in body axes, is upright."""
    roll, pitch = tilt_of(up)
    return {"tilt0": 1.0, "roll0": roll, "pitch0": pitch}


@dataclass(frozen=True)
class Start:
    """The heading of the first sample in rad, by what it is known, and how well where that is said
    (None: as the filter's parameter says).
    """

    heading: float
    source: str
    std: float | None = None

    @property
    def settings(self) -> dict[str, float]:
        """Parameters of the filter that follow."""
        known = {"heading0": self.heading}
        return known if self.std is None else known | {"heading_std0": self.std}


def _heading(recording: Recording, heading0: float | None) -> Start | None:
    """What is told of the heading at the start, None where nothing is."""
    if heading0 is not None:
        return Start(number("heading0", heading0), "what was given")
    for source, yaw in _told_headings(recording):
        if np.isfinite(yaw[0]):
            return Start(float(yaw[0]), source)
    return None


def _told_headings(recording: Recording) -> Iterator[tuple[str, np.ndarray]]:
    """The headings (n,) rad that a recording has, and where."""
    for name in ("heading", "ref_heading"):
        values = getattr(recording, name)
        if values is not None:
            yield f"the log's column {name}", values
    if recording.ref_q is not None:
        w, x, y, z = recording.ref_q.T
        yield "the log's ref_q", np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def _course(rows: np.ndarray, position: np.ndarray, track: Track, far: float) -> float | None:
    """rad; the heading at the start of a vehicle that drives forward its first ``far`` m."""
    away = np.linalg.norm(position[:, :2] - position[0, :2], axis=1)
    if not np.any(away > far):
        return None
    end = int(np.argmax(away > far))
    begin = int(np.flatnonzero(away[: end + 1] < far / 4)[-1])
    steps = np.diff(position[begin : end + 1, 0] + 1j * position[begin : end + 1, 1])
    # each step as it would be had the body not turned since the start
    total = np.append(0.0, np.cumsum(track.yaw - track.yaw[0]))
    at = rows[begin : end + 1]
    turned = np.diff(total[at]) / np.diff(at)
    return float(np.angle(np.sum(steps * np.exp(-1j * turned))))
