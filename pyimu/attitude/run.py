"""The attitude filter over a recording."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import casadi as ca
import numpy as np

from pyimu.attitude.alignment import BIAS_STD, MagneticNorth, Yaw, initial_values, initial_yaw
from pyimu.attitude.calibration import MagnetometerCalibration
from pyimu.attitude.columns import (
    axes_std,
    latitude_of,
    motion_bias,
    rate_noise,
    recorded_age,
    scale_std,
    warmer,
)
from pyimu.attitude.driven import speed_share
from pyimu.attitude.early_drift import drift_findings, early_drift
from pyimu.attitude.filter.compensation import left_in, noise_of
from pyimu.attitude.filter.stillness import SWAY_TIME
from pyimu.attitude.filter.timing import clock_error, estimate_latency
from pyimu.attitude.filter.tolerances import of_motion, start_values
from pyimu.attitude.filter.ukf import recorded_ukf
from pyimu.attitude.filter.variables import ABSURD, LEAST_K, USUAL
from pyimu.attitude.filters import OF_LOGS, OWN, Settings, chosen
from pyimu.attitude.heading_against_field import field_against_headings
from pyimu.attitude.heading_lag import late_finding, timed
from pyimu.attitude.input_grid import InputGrid
from pyimu.attitude.outputs import filtered
from pyimu.attitude.prepared import Prepared
from pyimu.attitude.result import AttitudeResult
from pyimu.attitude.retiming import Retiming
from pyimu.attitude.smoothing import smoothed
from pyimu.attitude.stuck import stuck_times
from pyimu.attitude.world_field import Date, WorldField, checked_place, world_field
from pyimu.block.block import Block, Run
from pyimu.block.parameters import number, with_settings
from pyimu.display.silent import silent
from pyimu.errors import Finding, UserError
from pyimu.model.catalogue import WHITE
from pyimu.model.part import Part
from pyimu.recording.log import Given, recording_of
from pyimu.recording.quality.false_force import check_force
from pyimu.recording.recording import Recording
from pyimu.units import STANDARD_GRAVITY


def run(
    recording: Given,
    part: Part | str | os.PathLike | None = None,
    *,
    latitude: float | None = None,
    place: Sequence[float] | None = None,
    date: Date | None = None,
    q0: np.ndarray | None = None,
    heading0: float | None = None,
    magnetometer: bool | MagnetometerCalibration | str | os.PathLike = True,
    bias0: np.ndarray | None = None,
    std0: np.ndarray | None = None,
    settings: Settings = None,
    smooth: bool = False,
    heard: Callable[[float], None] = silent,
) -> AttitudeResult:
    """The attitude of a recording, by the filter of ``part``.

    ``recording`` is a ``Recording``, the path of a file, or a data frame; ``part`` a ``Part``, the
    name of one, or a TOML file.

    Without a part, the filter knows of the sensors only their noise at rest; what a part is silent
    of is assumed as without it (``pyimu.attitude.columns``: ``informed``, ``rate_noise``), but for
    its scale factors, which count as calibrated then (``scale_std``).
    ``latitude`` in rad is else the recording's; without either, no Earth rate is subtracted. ``q0``
    (4,) is the attitude and ``heading0`` in rad the yaw of the first sample, ``bias0`` (3,) the
    gyro bias in rad/s, ``std0`` (6,) the standard deviations of attitude in body axes in rad and of
    bias in rad/s. What is not given comes from the first seconds at rest; yaw from the first
    recorded heading, else from the magnetometer, or it is zero. A recorded ``speed`` takes out the
    forces by which a vehicle speeds up and turns; it is along the body's x axis.

    ``magnetometer`` says whether the recording's ``mag`` is used, where it can be: it corrects the
    yaw beside the headings, each by its own weight, and yaw is then against true north by the
    setting ``declination``. A ``MagnetometerCalibration``, or the path of its file, is undone
    first; ``pyimu.characterize`` finds one in a log that turns. It is not found in the log itself:
    in a room it takes what the place bends for the sensor's (``benchmarks/attitude_real.py``).
    ``place`` is latitude and longitude in rad, and the height in m if it is known, ``date`` the day
    of the recording: the World Magnetic Model then tells declination, strength and dip, each as
    well as it knows them, and the latitude is that of the place. Where the samples show another
    field, it is disturbed until they have shown it for a while.

    What a part knows of its magnetometer (``[mag.turn_on_bias]``, ``scale_factor``,
    ``misalignment``) is undone as a calibration is where none is given; its white noise is the
    setting ``field_noise``, which is not below its start value: that stands for what is fast in the
    surroundings, too.

    ``settings`` are values of other parameters of the block by name, or a filter's name:
    ``"hidalgo2012"`` is the one as published; as the value ``filter`` a name goes with others. A
    gap widens the estimate, and the row after it has bit 1 of the status. Single samples that are
    missing are set between their neighbours (``bridged``), and have that bit, too; rates at the
    gyro's limit are drawn beyond it where the log shows how (``beyond_range``), as well as the
    ``lost_rate_std`` says that follows. Headings with an age in the recording's column
    ``heading_age`` correct what the attitude was then; without that column they are taken to be as
    late as the gyro's turns show clearly (``heading_lag``). A clock of the gyro that the part knows
    to be off, and a delay or a lag, are undone by its samples' times; an accelerometer of which the
    part says no delay is taken to be as late.

    With ``smooth`` each row is estimated from the whole recording, also from the rows that follow
    (``pyimu.attitude.filter.smoother``): attitude, bias and all standard deviations are those of
    the smoother, ``quasi_static``, ``nis``, ``status`` and ``at_rest`` stay those of the filter
    that went forward, and the last row is the filter's. ``heard`` hears which share of the work
    on the samples is done.

    Raises UserError for a recording that cannot be read, is without gyro or has one row, a latitude
    beyond -pi/2 to pi/2, a quaternion without length, ``heading0`` beside ``q0``, other than so
    many finite numbers, and a setting that is unknown or outside its bounds; a place without date,
    beside a latitude, or beside a setting of what it tells.
    """
    recording = recording_of(recording)
    method, given = chosen(settings)
    world = _world(place, date, latitude, given)
    latitude = latitude_of(recording, latitude if place is None else float(place[0]))
    heading0 = None if heading0 is None else number("heading0", heading0)
    _check(q0, heading0, smooth, method)
    gravity = number("gravity", given.get("gravity", STANDARD_GRAVITY))
    check_force(recording, gravity)
    log = Prepared.of(recording, part, magnetometer, method == OWN, gravity)
    known, field = log.known, log.field
    block = OF_LOGS[method](known)

    def unaided(stop: int) -> AttitudeResult:
        return _unaided(log.recording, stop, known, latitude, bias0, settings)

    of_heading = _of_heading(log.recording, unaided) if method == OWN else ()
    for found in of_heading:
        log = replace(log, recording=timed(log.recording, found))

    told = field.settings() | ({} if world is None else world.settings())
    north = _north(block, told | given) if field.used else None
    yaw = _yaw(log, heading0, unaided, north) if q0 is None else Yaw()
    values = told | _at_start(log, latitude, q0, yaw, bias0, std0)
    if method == OWN:
        values |= of_motion(number("rate_noise", (values | given)["rate_noise"]))
    p = _parameters(block, values, given)
    outputs = _estimated(block, log, p, smooth, heard)
    parameters = {v.name: value for v, value in zip(block.parameters, p.tolist(), strict=True)}
    of_heading += _of_field(log, outputs["q"], parameters)
    of_part = log.of_part
    if method == OWN and "bias_drift" not in given:
        of_part += drift_findings(parameters["bias_drift"])
    return AttitudeResult(
        log.recording.name,
        log.recording.time,
        **outputs,
        recording=log.as_given,
        rest=log.rest,
        parameters=parameters,
        part="" if log.declared is None else known.name,
        left_in=left_in(known, retimed=True),
        method=method,
        smoothed=smooth,
        of_part=of_part,
        of_heading=of_heading,
        magnetometer=field.in_world(world),
    )


def _check(q0, heading0: float | None, smooth: bool, method: str) -> None:
    """Raises UserError for what does not go together."""
    if q0 is not None and heading0 is not None:
        raise UserError("heading0 beside q0, which has a heading of its own: give one of the two")
    if smooth and method != OWN:
        raise UserError(f"smooth with the filter {method}: only {OWN} can be smoothed")


def _of_no_accelerometer(recording: Recording) -> np.ndarray:
    """The bits (n,) of the status that say no more than that the log has no accelerometer."""
    whole = np.zeros(len(recording), dtype=np.uint16)
    if recording.accel is None:
        whole[np.all(np.abs(recording.gyro) <= ABSURD, axis=1)] = 1
        if getattr(recording, "heading_std", None) is not None:
            whole[~(recording.heading_std > 0)] = 0
        whole[[start for start, _ in recording.segments[1:]]] = 0  # samples are missing before it
    return whole


def _unaided(
    recording: Recording, stop: int, part: Part, latitude: float, bias0, settings
) -> AttitudeResult:
    """The rows before ``stop`` by the filter without headings and without magnetometer."""
    cadence = recording.cadence
    before = replace(
        recording.slice(None, stop),
        heading=None,
        heading_std=None,
        heading_age=None,
        period=cadence.period,
        longest=cadence.longest,
    )
    known = latitude if abs(latitude) <= np.pi / 2 else None
    return run(before, part, latitude=known, magnetometer=False, bias0=bias0, settings=settings)


def _of_heading(
    recording: Recording, unaided: Callable[[int], AttitudeResult]
) -> tuple[Finding, ...]:
    """The finding that the headings are late, where they come and no column says when they were
    true.
    """
    if getattr(recording, "heading", None) is None or recording.accel is None:
        return ()
    if getattr(recording, "heading_age", None) is not None:
        return ()
    found = late_finding(recording, unaided(len(recording)).q)
    return () if found is None else (found,)


def _yaw(
    log: Prepared,
    heading0: float | None,
    unaided: Callable[[int], AttitudeResult],
    north: MagneticNorth | None,
) -> Yaw:
    """The yaw of the first sample; ``unaided`` says how far the body has turned by a later one."""

    def turned(row: int) -> float:
        return float(unaided(row + 1).euler[-1, 2])

    return initial_yaw(log.recording, log.rest, heading0, turned, north)


def _of_field(log: Prepared, q: np.ndarray, parameters: Mapping[str, float]) -> tuple[Finding, ...]:
    """The finding that the headings and the magnetometer differ, by the attitudes (n, 4)."""
    if not log.field.used or getattr(log.recording, "heading", None) is None:
        return ()
    turning = parameters["field_turning_std"]
    found = field_against_headings(log.recording, q, parameters["declination"], turning)
    return () if found is None else (found,)


def _north(block: Block, settings: Mapping[str, float | str]) -> MagneticNorth:
    """What the settings say of the magnetic north."""
    start = {v.name: v.start for v in block.parameters} | dict(settings)
    names = ("declination", "field_turning_std", "field_strength", "field_dip")
    declination, std, strength, dip = (number(n, start[n]) for n in names)
    parts = strength * np.array([np.cos(dip), -np.sin(dip)])
    return MagneticNorth(declination, std, parts if strength > 0 else None)


def _world(
    place: Sequence[float] | None,
    date: Date | None,
    latitude: float | None,
    settings: Mapping[str, float | str],
) -> WorldField | None:
    """The magnetic field of the place, None without one.

    Raises UserError where only one of place and date is given, and for what is given twice.
    """
    if (place is None) != (date is None):
        there, lacking = ("place", "date") if date is None else ("date", "place")
        raise UserError(f"{there} without {lacking}: the magnetic field takes both")
    if place is None or date is None:
        return None
    checked_place(place)
    if latitude is not None:
        raise UserError("latitude beside place, which has one: give one of the two")
    found = world_field(place, date)
    for name in found.settings():
        if name in settings:
            raise UserError(f"{name} beside place, by which it is known: give one of the two")
    return found


def _estimated(
    block: Block, log: Prepared, p: np.ndarray, smooth: bool, heard: Callable[[float], None]
) -> dict[str, np.ndarray]:
    """The outputs by name, a row for each of the recording's, by the filter or the smoother."""
    recording, known = log.recording, log.known
    retiming = _retiming(recording, known, p)
    passes = 2 if smooth else 1
    names = [v.name for v in block.inputs]
    grid = InputGrid(recording, known, names, retiming, heard=lambda times: heard(times / passes))
    steps = Run(block, grid.rows[-1] + 1, p=p, sample_period=recording.sample_period)
    walk = _bias_walk(known, p)
    if smooth:
        outputs = smoothed(recorded_ukf(known), grid, steps, walk)
    else:
        outputs = filtered(block, grid, steps, walk)
    outputs["status"][grid.after_gap] |= 1
    if retiming is not None:
        outputs = retiming.to_rows(outputs)
    outputs["status"] &= ~_of_no_accelerometer(recording)
    outputs["status"][log.between] |= 1
    return outputs


# Parameters


def _parameters(
    block: Block, values: Mapping[str, float], given: Mapping[str, float | str]
) -> np.ndarray:
    """The block's parameters: ``values``, of which it may lack some, and the settings ``given``."""
    has = {v.name for v in block.parameters}
    named = {n: v for n, v in values.items() if n in has} | given
    return with_settings(block, named, "the attitude filter")


def _at_start(log: Prepared, latitude: float, q0, yaw: Yaw, bias0, std0) -> dict[str, float]:
    """The settings that follow from log and part, and the estimate of the first sample: what is
    given of it (``q0``, ``bias0``, ``std0`` of ``run``), else what the log shows.
    """
    known = log.known
    values = _of_the_log(log)
    values |= _of_the_part(log.recording, known, None if log.declared is None else known)
    values["motion_bias"] = motion_bias(log.declared)
    values["bias_drift"] = early_drift(log.recording, known, log.rest)
    unseen = [values[f"std0[{i}]"] for i in (4, 5, 6)] if "std0[4]" in values else BIAS_STD
    values |= initial_values(log.recording, known, log.rest, latitude, q0, yaw, unseen)
    return values | _numbered("bias0", bias0, 3) | _numbered("std0", std0, 6)


def _of_the_log(log: Prepared) -> dict[str, float]:
    """The settings that follow from what a recording has."""
    recording, known, field = log.recording, log.known, log.field
    values = stuck_times(recording, known, log.rest)
    if log.lost_rate_std:
        values["lost_rate_std"] = log.lost_rate_std
    if recording.mag is not None and not field.used:
        values["field_tolerance"] = 0.0
    if WHITE[0] in known.mag.values:
        white = float(np.sqrt(np.mean(known.mag.values[WHITE[0]][WHITE[1]] ** 2)))
        values["field_noise"] = max(white, USUAL["field_noise"])
    if log.rest.sways:
        # Whether it still sways shows after that time; until then it would seem to rest.
        values["rest_time"] = SWAY_TIME
    if getattr(recording, "stationary", None) is not None or log.rest.even.in_doubt:
        values["rest_time"] = 0.0
    if off := speed_share(recording):
        values["speed_tolerance"] = float(np.hypot(off, USUAL["speed_tolerance"]))
    if oldest := float(recorded_age(recording).max()):
        values["heading_memory"] = oldest
    return values


def _of_the_part(recording: Recording, known: Part, declared: Part | None) -> dict[str, float]:
    """The settings that follow from what is known of the sensors, and from their tolerances."""
    values = start_values(known, warmer(recording, known))
    for setting in (rate_noise, scale_std, axes_std):
        name = setting.__name__
        values[name] = float(np.hypot(setting(declared), values.get(name, 0.0)))
    return values


def _numbered(name: str, values, size: int) -> dict[str, float]:
    """A given vector as parameters; nothing where it is not given.

    Raises UserError for other than ``size`` finite numbers.
    """
    if values is None:
        return {}
    try:
        array = np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        array = np.zeros(0)
    if array.shape != (size,) or not np.isfinite(array).all():
        raise UserError(f"{name} is {str(values)[:60]}, expected {size} finite numbers")
    return {f"{name}[{i + 1}]": float(v) for i, v in enumerate(array)}


def _gyro_p(part: Part, p: np.ndarray) -> ca.SX:
    """The gyro's coefficients among the block's parameters."""
    first = len(p) - len(part.gyro.slots) - len(part.accel.slots)
    return ca.SX(ca.DM(p[first : first + len(part.gyro.slots)]))


def _retiming(recording: Recording, part: Part, p: np.ndarray) -> Retiming | None:
    """How the estimates lie in time; None where they belong to their rows."""
    own = _gyro_p(part, p)
    skew, period = float(ca.evalf(ca.SX(clock_error(part.gyro, own)))), recording.sample_period
    delay = float(ca.evalf(estimate_latency(part.gyro, own, period * (1 + skew))))
    if not skew and not delay:
        return None
    return Retiming(recording.time, skew, period, delay)


def _bias_walk(part: Part, p: np.ndarray) -> np.ndarray:
    """Variance (3,) in (rad/s)^2/s by which the gyro's bias walks, as the filter models it."""
    walk = noise_of(part.gyro, _gyro_p(part, p), 1 / part.sample_rate).walk
    return np.array(ca.evalf(walk), dtype=float).ravel() ** 2 + LEAST_K**2
