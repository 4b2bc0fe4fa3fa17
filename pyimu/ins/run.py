"""The position of a recording by its inertial unit, and by what else the recording has."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from pyimu.attitude.beyond_range import by_axis
from pyimu.attitude.columns import latitude_of
from pyimu.attitude.contradicted import contradicted, without
from pyimu.attitude.rest import Rest
from pyimu.block.parameters import number
from pyimu.display.silent import silent
from pyimu.errors import Finding, UserError
from pyimu.ins import checks
from pyimu.ins.askew_limit import with_equal_limits
from pyimu.ins.creeps import beside_creeps, creeping
from pyimu.ins.filter.variables import OWN_PARAMETERS
from pyimu.ins.filtered import Filtered
from pyimu.ins.integrated import integrated
from pyimu.ins.job import Job, Start
from pyimu.ins.known import known_part
from pyimu.ins.measured import (
    MEASURED,
    Fixes,
    NoFoot,
    Told,
    check_fixes,
    fixes_of,
    measures_speed,
    wrong_rows,
)
from pyimu.ins.result import NavigationResult
from pyimu.ins.stances import standing, steps
from pyimu.ins.stops import (
    ZUPT,
    clean_of,
    later_rest,
    noise_at_rest,
    rest_at_start,
    shows_noise,
    stops_of,
)
from pyimu.ins.track import Reference, Track, reference_of
from pyimu.ins.vibration import Samples, faster
from pyimu.ins.witnesses import Witness, rests_that_move, witnesses_of
from pyimu.model.part import Part
from pyimu.model.part_file import part as part_of
from pyimu.numerics.threads import on_one_thread
from pyimu.recording.clock import runs
from pyimu.recording.log import Given, recording_of
from pyimu.recording.quality.inspect import rate_of_part
from pyimu.recording.recording import Recording
from pyimu.units import STANDARD_GRAVITY, did_you_mean

METHODS = ("paper", "strapdown", "filter", "smoother")
"""What a run can do: the integration of Wongwirat 2010, an exact one less the nulls of the rest at
the start, the filter, and the smoother over it."""

SHAKEN = ("auto", "declared")
"""Where the rests come from of a log whose vibration at rest is taken out: the unit's samples are
as they come, and a foot has no engine."""

MOSTLY = 0.5
"""Share of what looks like a rest at the start that must be one."""

Say = Callable[..., None]

LIMITS = {
    v.name: v.start
    for v in OWN_PARAMETERS
    if v.name in ("top_speed", "top_acceleration", "top_turn_rate")
}
"""What a robot can do, as the filter has it where ``settings`` do not say another."""


@on_one_thread
def run(
    recording: Given,
    part: Part | str | os.PathLike | None = None,
    *,
    method: str = "all",
    zupt: str = "auto",
    nhc: bool = False,
    fixes: bool = True,
    position_std: float | None = None,
    velocity_std: float | None = None,
    position_age: float | None = None,
    velocity_age: float | None = None,
    latitude: float | None = None,
    heading0: float | None = None,
    settings: Mapping[str, Any] | None = None,
    say: Say = silent,
) -> NavigationResult:
    """The path of a recording, by the errors and the noise of ``part``.

    ``recording`` is a ``Recording``, the path of a file, or a data frame; ``part`` a ``Part``, the
    name of one, or a TOML file, such as the ``model.toml`` of ``pyimu close``. Without a part
    the noise is that of the samples at rest. ``method`` is one of ``METHODS`` or "all", ``zupt``
    one of ``ZUPT``; ``nhc`` is a vehicle whose wheels do not slip. With ``fixes`` the recording's
    measured positions and velocities correct the filter, by ``position_std`` m and ``velocity_std``
    m/s, else the recording's; they were true ``position_age`` and ``velocity_age`` s before their
    rows, else as the recording says, else at their rows. ``latitude`` in rad is else the
    recording's; without either, no Earth rate is taken off. ``heading0`` in rad is the yaw of the
    first sample, else that of the heading, the reference, the course of the positions, or 0.
    ``settings`` are other parameters by name.

    Raises UserError for a recording that cannot be read or used (``checks``, ``measured``), an
    unknown method or setting, and where a rest is to be declared and is not.
    """
    recording = recording_of(recording)
    _known("method", method, (*METHODS, "all"))
    _known("zupt", zupt, ZUPT)
    given, limits = _given(settings)
    checks.check_columns(recording, limits["gravity"])
    how = {"method": method, "nhc": nhc, "fixes": fixes, "heading0": heading0, "say": say}
    told = Told(position_std, velocity_std, position_age, velocity_age)
    navigated = partial(
        _run, recording, part, told=told, latitude=latitude, given=given, limits=limits, **how
    )
    vehicle = nhc or measures_speed(recording)
    walked = 0 if zupt != "auto" or vehicle else _steps(recording, limits["gravity"])
    if walked:
        try:
            found = navigated("foot")
            on_foot = Finding("on_a_foot", "gyro", walked, {})
            return replace(found, findings=(*found.findings, on_foot))
        except NoFoot:
            pass  # it contradicts them, or has velocities of its own
    return navigated(zupt)


def _steps(recording: Recording, gravity: float) -> int:
    """How many steps a foot takes, 0 of a log of anything else."""
    if recording.stationary is not None:
        return 0
    gyro, accel = (np.where(np.isfinite(v), v, np.nan) for v in (recording.gyro, recording.accel))
    return steps(gyro, accel, gravity, recording.sample_period)


def _run(
    recording: Recording,
    part: Part | str | os.PathLike | None,
    zupt: str,
    *,
    method: str,
    nhc: bool,
    fixes: bool,
    told: Told,
    latitude: float | None,
    heading0: float | None,
    given: dict[str, Any],
    limits: dict[str, float],
    say: Say,
) -> NavigationResult:
    """The path with rests from ``zupt``; the other arguments are those of ``run``."""
    most = limits["top_acceleration"], limits["top_turn_rate"]
    recording, findings = checks.without_outliers(recording, *most)
    recording = with_equal_limits(recording)
    wrong = contradicted(recording)
    findings += wrong
    declared = None if part is None else part_of(part)
    findings += [] if declared is None else rate_of_part(recording, declared.sample_rate)
    as_given, recording = recording, without(recording, wrong)
    measured = fixes_of(recording, told, limits["top_speed"]) if fixes else None
    reference = reference_of(recording)
    witnesses = witnesses_of(recording, measured, reference)
    job = _job(recording, declared, zupt, given, findings, witnesses)
    if zupt == "foot":
        measured = _of_stances(job, fixes, told, limits["top_speed"])
    job = replace(job, fixes=measured)
    job = replace(job, latitude=latitude_of(recording, latitude), nhc=nhc)
    job = replace(job, wheels=nhc or measures_speed(recording))
    found, start = job.started(heading0, reference)
    job, found = _with_own_errors(job, found, start, findings, say)
    creeps = None if job.fixes is not None else creeping(found, findings)
    findings += [] if creeps is None else [creeps]
    findings += _of_constraint(job, found, start)
    if job.live:
        job = replace(job, still=found.scalar("at_rest") > 0.5)
    moving = list(rests_that_move(recording.time, job.still, witnesses))
    findings += [*moving, *_of_fixes(job, found, start, zupt, moving)]
    tracks = _tracks(METHODS if method == "all" else (method,), job, found, start, findings, say)
    best = tracks.get("smoother", tracks.get("filter"))
    after = checks.after(job.still, reference, best, bool(moving))
    result = NavigationResult(
        recording.name,
        as_given,
        tracks,
        found,
        job.still,
        reference,
        part="" if part is None else job.part.name,
        findings=(*recording.findings, *findings, *after),
        zupt=zupt,
        **job.told(start),
    )
    if job.fixes is not None:
        return result
    wider = {name: track.widened(result.too_sure) for name, track in tracks.items()}
    if creeps is not None:
        hides = creeps.detail["hides"]
        wider = {name: beside_creeps(track, job.still, hides) for name, track in wider.items()}
    return replace(result, tracks=wider)


def _of_stances(job: Job, fixes: bool, told: Told, top_speed: float) -> Fixes | None:
    """The positions that correct the filter, where there are, and a foot's stances."""
    recording = job.recording
    if not fixes:
        recording = replace(recording, **dict.fromkeys(MEASURED))
    bias = job.rest.rate if job.rest.seen else np.zeros(3)
    return fixes_of(standing(recording, bias, job.gravity), told, top_speed)


def _with_own_errors(
    job: Job, found: Filtered, start: Start, findings: list[Finding], say: Say
) -> tuple[Job, Filtered]:
    """The job with the errors of its measurements that a first run ``found``, and the run with
    them: errors of positions that last, and a vehicle that goes askew.
    """
    begun = job.with_begun(start, say)
    found = found if begun is job else begun.filtered(start)
    job = begun.with_lasting(found, start, say).with_crabbing(start, say)
    if job.lasting is None and job.crabs is None:
        return job, found
    found = job.filtered(start)
    findings += job.of_errors
    return job, found


def _of_fixes(
    job: Job, found: Filtered, start: Start, zupt: str, moving: list[Finding]
) -> list[Finding]:
    """What the run says of measured positions and velocities, and of rests that are ``moving``."""
    fixes = job.fixes
    moves = any(f.column == "position" for f in moving)
    if fixes is not None and len(fixes.rows) > 1:
        positions = Reference(fixes.rows, fixes.position)
        if wrong_rows(found, "position", fixes).any():
            free = job.filtered(start, fixes=False).track("filter")
            checks.check_not_mirrored(job.recording.name, positions, free)
    return check_fixes(job.recording, fixes, found, moves, zupt == "foot")


def _of_constraint(job: Job, found: Filtered, start: Start) -> list[Finding]:
    """What the run says of wheels that are to roll without slipping."""
    if not job.nhc:
        return []
    free = replace(job, nhc=False).filtered(start)
    return checks.constraint(found, job.still, free)


def _given(settings: Mapping[str, Any] | None) -> tuple[dict[str, Any], dict[str, float]]:
    """The settings with those of a robot and of the place, and these as numbers."""
    given = LIMITS | {"gravity": STANDARD_GRAVITY} | dict(settings or {})
    return given, {name: number(name, given[name]) for name in (*LIMITS, "gravity")}


def _known(name: str, value: str, values: tuple[str, ...]) -> None:
    if value not in values:
        raise UserError(
            f"{name} {value}: unknown{did_you_mean(value, values)}; known are {', '.join(values)}"
        )


def _job(
    recording: Recording,
    declared: Part | None,
    zupt: str,
    given: dict[str, Any],
    findings: list[Finding],
    witnesses: list[Witness],
) -> Job:
    """The recording with its rests, before what else is known of it."""
    gravity = float(given["gravity"])
    samples = Samples.of(clean_of(recording, declared), zupt in SHAKEN)
    clean, turns = samples.calm, samples.findings
    rest = rest_at_start(samples.seen, declared, gravity)
    later = None if shows_noise(rest) else later_rest(samples.seen, declared, gravity)
    shown = later or rest
    part = known_part(declared, recording, shown)
    noise = noise_at_rest(samples.seen, part, shown, declared)
    if clean.stationary is not None:
        still, _ = stops_of(clean, noise, zupt, turns)
    else:
        marks, _ = stops_of(*samples.white(rest, noise), zupt, turns, witnesses)
        still = faster(marks, samples.rows, len(clean))
    rest = _as_far_as(still, rest, declared, samples, gravity)
    rest = replace(rest, rows=slice(0, rest.rows.stop * samples.rows))
    if zupt in ("auto", "foot") and np.mean(still[rest.rows]) < MOSTLY:
        # a steady drive, whose bias is that of the rests later on, by which they were found
        later = rest if still.any() and later is None else later
        rest = replace(rest, seen=False)
    findings += [*checks.findings(recording, rest, gravity), *turns]
    updates = float(zupt != "off")
    drawn, stds = by_axis(recording, part, untold=True)
    drawn = samples.without(drawn, still)
    clipped = _clipped(recording, part, stds, given)
    settings = {"zupt": updates, "zaru": updates} | clipped | given
    live = zupt == "live"
    known = drawn, clean, part, rest, still, 0.0, gravity, False, live, None, settings
    return Job(*known, later=later)


def _as_far_as(
    still: np.ndarray, rest: Rest, declared: Part | None, samples: Samples, gravity: float
) -> Rest:
    """The rest at the start, as far as it is ``still`` (n,) by the samples after it, too: a push so
    gentle that it seems to rest begins later.
    """
    stop = int(np.argmin(still)) // samples.rows
    if rest.declared or not rest.seen or not 0 < stop < rest.rows.stop:
        return rest
    shorter = rest_at_start(samples.seen.slice(0, stop), declared, gravity)
    return shorter if shorter.seen else rest


def _clipped(recording: Recording, part: Part, stds: list[float | None], given: dict) -> dict:
    """The filter's parameters of how far off rates and forces at the sensors' limits may be.

    Where nothing tells how rates go on beyond the limit, by ``stds``: by the top turn rate, and by
    the limit of a body that turns faster than that. Forces beyond it are those of shocks, which
    are alike, as each step of a walker is: N of them that are off to the same side would be taken
    for something that lasts, unless they tell together no more than one.
    """
    turns, pushes = (number(n, given[n]) for n in ("top_turn_rate", "top_acceleration"))
    rates, forces = (np.nanmax(np.abs(s), axis=0) for s in (recording.gyro, recording.accel))
    off = {}
    for i, (std, limit) in enumerate(zip(stds, part.accel.clips_from, strict=True)):
        off[f"clipped_rate_std[{i + 1}]"] = max(turns, rates[i]) if std is None else std
        shocks = runs(np.abs(recording.accel[:, i]) >= limit)
        most = max(pushes, forces[i])
        off[f"clipped_force_std[{i + 1}]"] = most * np.sqrt(max(len(shocks), 1))
    return {name: float(value) for name, value in off.items()}


def _tracks(
    wanted: tuple[str, ...],
    job: Job,
    found: Filtered,
    start: Start,
    findings: list[Finding],
    say: Say,
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
            track = integrated(name, job, start.heading, findings)
            tracks |= {} if track is None else {name: track}
    return tracks
