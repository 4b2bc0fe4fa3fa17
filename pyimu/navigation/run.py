"""The position of a recording by its inertial unit alone."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import casadi as ca
import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.attitude.columns import latitude_of
from pyimu.attitude.filter.compensation import noise_of
from pyimu.attitude.input_grid import InputGrid
from pyimu.attitude.rest import Rest, find_rest
from pyimu.block.parameters import number, with_values
from pyimu.errors import Finding, UserError
from pyimu.model.part import Part
from pyimu.model.part_file import part as part_of
from pyimu.navigation import checks
from pyimu.navigation.compensated import compensated
from pyimu.navigation.detector import Detected, Noise, detect
from pyimu.navigation.filter.ins_block import ins_of_log
from pyimu.navigation.filter.layout import Layout
from pyimu.navigation.filtered import Filtered, filtered
from pyimu.navigation.known import known_part
from pyimu.navigation.result import NavigationResult
from pyimu.navigation.smoothing import smoothed
from pyimu.navigation.strapdown import Path, strapdown, strapdown_wongwirat
from pyimu.navigation.track import Reference, Track, reference_of
from pyimu.recording.log import Given, recording_of
from pyimu.recording.recording import Recording
from pyimu.symbolic.earth import earth_rate
from pyimu.units import STANDARD_GRAVITY, did_you_mean

METHODS = ("paper", "strapdown", "filter", "smoother")
"""What a run can do: the integration of Wongwirat 2010, an exact one less the nulls of the rest at
the start, the filter, and the smoother over it."""

ZUPT = ("auto", "declared", "off")
"""Where zero-velocity updates come from: the column ``stationary``, else the samples; that column
alone; nowhere."""

COURSE = 2.0
"""m; of a reference's way, by whose direction the first heading is known where nothing tells it."""


def run(
    recording: Given,
    part: Part | str | os.PathLike | None = None,
    *,
    method: str = "all",
    zupt: str = "auto",
    nhc: bool = False,
    latitude: float | None = None,
    heading0: float | None = None,
    settings: Mapping[str, Any] | None = None,
    say: Callable[..., None] = lambda *_: None,
) -> NavigationResult:
    """The path of a recording, by the errors and the noise of ``part``.

    ``recording`` is a ``Recording``, the path of a file, or a data frame; ``part`` a ``Part``, the
    name of one, or a TOML file, such as the ``model.toml`` of ``pyimu close``. Without a part
    the noise is that of the samples at rest. ``method`` is one of ``METHODS`` or "all", ``zupt``
    one of ``ZUPT``; ``nhc`` says that it is a vehicle whose wheels do not slip. ``latitude`` in rad
    is else the recording's; without either, no Earth rate is taken off. ``heading0`` in rad is the
    yaw of the first sample; without it that of the recording's heading, its reference's, or 0.
    ``settings`` are values of other parameters of the filter's block by name.

    Raises UserError for a recording that cannot be read or used (``checks``), an unknown method or
    setting, and where a rest is to be declared and is not.
    """
    recording = recording_of(recording)
    _known("method", method, (*METHODS, "all"))
    _known("zupt", zupt, ZUPT)
    checks.check_columns(recording)
    gravity = number("gravity", (settings or {}).get("gravity", STANDARD_GRAVITY))
    rest = find_rest(recording, gravity)
    findings = checks.findings(recording, rest, gravity)
    declared = None if part is None else part_of(part)
    known = known_part(declared, recording, rest)
    wanted = METHODS if method == "all" else (method,)
    still, detected = _rests(recording, known, rest, zupt, findings, declared is not None)
    job = _Job(
        recording,
        known,
        rest,
        still,
        latitude_of(recording, latitude),
        gravity,
        nhc,
        {"zupt": float(zupt != "off"), "zaru": float(zupt != "off")} | dict(settings or {}),
    )
    reference = reference_of(recording)
    found, start, heading_from = job.started(heading0, reference)
    tracks = _tracks(wanted, job, found, start, findings, say)
    return NavigationResult(
        recording.name,
        recording,
        tracks,
        found,
        still,
        reference,
        rest=rest,
        part="" if declared is None else known.name,
        settings={v.name: x for v, x in zip(job.block.parameters, job.p(start), strict=True)},
        findings=(*recording.findings, *findings, *checks.after(found, still, detected)),
        nhc=nhc,
        zupt=zupt,
        heading0=start,
        heading_from=heading_from,
        gains=len(job.layout.gains),
    )


def _known(name: str, value: str, values: tuple[str, ...]) -> None:
    if value not in values:
        raise UserError(
            f"{name} {value}: unknown{did_you_mean(value, values)}; known are {', '.join(values)}"
        )


def _tracks(
    wanted: tuple[str, ...],
    job: _Job,
    found: Filtered,
    start: float,
    findings: list[Finding],
    say: Callable[..., None],
) -> dict[str, Track]:
    """The tracks by the methods' names, less those that the recording's samples do not allow."""
    tracks = {}
    for name in wanted:
        say(f"method {name}", 0.0)
        if name == "filter":
            tracks[name] = found.track("filter")
        elif name == "smoother":
            tracks[name] = job.smoothed(start, say)
        else:
            track = _integrated(name, job, start, findings)
            tracks |= {} if track is None else {name: track}
    return tracks


@dataclass(frozen=True, eq=False)
class _Job:
    """A recording and what is known before the filter runs over it."""

    recording: Recording
    part: Part
    rest: Rest
    still: np.ndarray
    latitude: float
    gravity: float
    nhc: bool
    settings: Mapping[str, Any]

    @property
    def layout(self) -> Layout:
        return Layout(self.part, self.nhc)

    @property
    def block(self):
        return ins_of_log(self.layout)

    def p(self, heading0: float) -> np.ndarray:
        values = {"latitude": self.latitude, "gravity": self.gravity, "heading0": heading0}
        return with_values(self.block, values | dict(self.settings))

    def grid(self) -> InputGrid:
        marked = replace(self.recording, stationary=self.still.astype(float), heading=None)
        return InputGrid(marked, self.part, [v.name for v in self.block.inputs])

    def filtered(self, heading0: float) -> Filtered:
        p = self.p(heading0)
        return filtered(
            self.block, self.layout, self.grid(), p, self.recording.time, self._top_speed(p)
        )

    def smoothed(self, heading0: float, say: Callable[..., None]) -> Track:
        p, block = self.p(heading0), ins_of_log(self.layout, True)
        time = self.recording.time
        return smoothed(block, self.layout, self.grid(), p, time, self._top_speed(p), say)

    def _top_speed(self, p: np.ndarray) -> float:
        names = [v.name for v in self.block.parameters]
        return float(p[names.index("top_speed")])

    def started(
        self, heading0: float | None, reference: Reference | None
    ) -> tuple[Filtered, float, str]:
        """The filter's estimates, the heading with which they begin, and by what it is known."""
        start, source = _heading(self.recording, heading0)
        if start is not None:
            return self.filtered(start), start, source
        found = self.filtered(0.0)
        course = None if reference is None else _course(reference, found.track("filter"))
        if course is None:
            return found, 0.0, "nothing: it is called 0"
        return self.filtered(course), course, f"the course of the reference's first {COURSE:g} m"


def _heading(recording: Recording, heading0: float | None) -> tuple[float | None, str]:
    """rad; what is told of the heading at the start, None where nothing is, and by what."""
    if heading0 is not None:
        return number("heading0", heading0), "what was given"
    for name in ("heading", "ref_heading"):
        values = getattr(recording, name)
        if values is not None and np.isfinite(values[0]):
            return float(values[0]), f"the log's column {name}"
    if recording.ref_q is not None and np.isfinite(recording.ref_q[0]).all():
        w, x, y, z = recording.ref_q[0]
        return float(np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))), "the log's ref_q"
    return None, ""


def _course(reference: Reference, track: Track) -> float | None:
    """rad; the heading at the start of a vehicle that drives forward its first ``COURSE`` m."""
    far = np.linalg.norm(reference.position[:, :2], axis=1)
    if not np.any(far > COURSE):
        return None
    end = int(np.argmax(far > COURSE))
    begin = int(np.flatnonzero(far[: end + 1] < COURSE / 4)[-1])
    east, north = (reference.position[end] - reference.position[begin])[:2]
    turned = track.yaw[reference.rows[begin] : reference.rows[end] + 1].mean() - track.yaw[0]
    return float(np.arctan2(north, east) - turned)


# Rest


def _rests(
    recording: Recording,
    part: Part,
    rest: Rest,
    zupt: str,
    findings: list[Finding],
    declared: bool,
) -> tuple[np.ndarray, Detected | None]:
    """Marks (n,) of rest; ``declared`` says that the noise is that of a part."""
    if zupt == "off":
        return np.zeros(len(recording.time), dtype=bool), None
    if recording.stationary is not None:
        return np.nan_to_num(recording.stationary) > 0.5, None
    if zupt == "declared":
        raise UserError(
            f"{recording.name}: no column 'stationary [1]' that declares rests; --zupt auto finds "
            "them in the samples"
        )
    found = detect(
        recording.time,
        recording.gyro,
        recording.accel,
        noise_at_rest(recording, part, rest, declared),
        recording.sample_period,
    )
    for start, stop in found.steady:
        seconds = float(recording.time[stop - 1] - recording.time[start])
        findings.append(
            Finding(
                "steady_turn",
                "gyro",
                stop - start,
                {"first": float(recording.time[start]), "seconds": seconds},
            )
        )
    return found.still, found


NOISIER = 2.0
"""A specimen's noise may be so many times what its part declares; beyond, what shakes it at the
start of a log is the engine of a robot that may already drive."""


def noise_at_rest(recording: Recording, part: Part, rest: Rest, declared: bool) -> Noise:
    """What a detector needs of the sensors: the part's noise, or that of the rest at the start
    where it is larger.
    """
    period = recording.sample_period
    stds, walks = [], []
    for sensor, seen in ((part.gyro, rest.rate_std), (part.accel, rest.force_std)):
        noise = noise_of(sensor, ca.SX(ca.DM(sensor.p)), period)
        white = np.array(ca.evalf(noise.white), dtype=float).ravel() / np.sqrt(period)
        most = NOISIER * white if declared else np.full(3, np.inf)
        shown = np.minimum(seen, most) if rest.seen else np.zeros(3)
        stds.append(np.maximum(np.maximum(white, shown), 1e-9))
        walks.append(np.array(ca.evalf(noise.walk), dtype=float).ravel())
    return Noise(stds[0], stds[1], walks[0], rest.rate if rest.seen else np.zeros(3))


# Integration alone


def _integrated(name: str, job: _Job, heading0: float, findings: list[Finding]) -> Track | None:
    """The track by integration alone; None, with a finding, where samples are missing."""
    recording = job.recording
    try:
        if name == "paper":
            q0 = _level(heading0, None)
            path = strapdown_wongwirat(recording, q0, gravity=job.gravity)
        else:
            path = _strapdown(job, heading0)
    except UserError as error:
        findings.append(Finding("not_integrated", "", 1, {"method": name, "reason": str(error)}))
        return None
    return Track(name, recording.time, path.q, path.velocity, path.position - path.position[0])


def _strapdown(job: _Job, heading0: float) -> Path:
    """Exact integration of the compensated samples, less the nulls of the rest."""
    recording = compensated(job.recording, job.part)
    latitude = job.latitude if abs(job.latitude) <= np.pi / 2 else None
    rows = job.rest.rows
    force = np.nanmean(recording.accel[rows], axis=0)
    q0 = _level(heading0, force)
    if job.rest.seen:
        back = Rotation.from_quat(q0, scalar_first=True).inv()
        earth = _earth(latitude)
        null = np.nanmean(recording.gyro[rows], axis=0) - back.apply(earth)
        size = np.linalg.norm(force) - job.gravity
        recording = replace(
            recording,
            gyro=recording.gyro - null,
            accel=recording.accel - size * force / np.linalg.norm(force),
        )
    return strapdown(recording, q0, latitude=latitude, gravity=job.gravity)


def _earth(latitude: float | None) -> np.ndarray:
    """The Earth's rate (3,) rad/s in the world; zero without a latitude."""
    if latitude is None:
        return np.zeros(3)
    return np.array(ca.DM(earth_rate(latitude))).ravel()


def _level(heading0: float, force: np.ndarray | None) -> np.ndarray:
    """The attitude (4,) of a body whose accelerometer shows ``force`` (3,), level without one."""
    x, y, z = (0.0, 0.0, 1.0) if force is None else force
    roll, pitch = np.arctan2(y, z), np.arctan2(-x, np.hypot(y, z))
    q = Rotation.from_euler("ZYX", [heading0, pitch, roll])
    return q.as_quat(scalar_first=True)
