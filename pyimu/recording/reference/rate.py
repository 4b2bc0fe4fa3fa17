"""The rate that a reference saw, and the band in which it can be trusted.

A reference attitude is differentiated by a rotation spline through its own samples (``scipy``'s
RotationSpline, which solves the kinematic equation, so that rotations need not commute, and what a
spline of higher degree adds). It adds no bandwidth of its own, and stays inside each segment that
was seen: occlusions and faults are NaN.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.errors import Finding, UserError
from pyimu.recording.clock import runs
from pyimu.recording.recording import Recording
from pyimu.recording.reference.attitude import (
    attitude_curve,
    attitude_track,
    cut_at_jumps,
    rate_through,
    within,
)
from pyimu.recording.reference.band import coherence, trusted_band
from pyimu.recording.reference.course import course_of, looks_like_degrees, mounted, upward
from pyimu.recording.reference.filled import measured
from pyimu.recording.reference.leaning import upward_through
from pyimu.recording.reference.nodes import own_samples
from pyimu.recording.reference.rocking import rate_about_z
from pyimu.recording.reference.sampling import slope_at, through
from pyimu.recording.reference.stamps import at_times, even_times, evenly_sampled, jitter_of
from pyimu.recording.reference.track import Track, fresh, known_axes
from pyimu.recording.reference.unsmoothed import restored_up_to
from pyimu.recording.rest import is_at_rest, motion_in
from pyimu.symbolic.earth import EARTH_RATE

HALF = 180.0
"""Half a turn in degrees; in radians more than any heading turns from one sample to the next."""

CLEARLY = 1.02
"""Times more that a reference must tell of the gyro on other times than its stamps. Between two
ways to take the same samples chance makes less than a hundredth."""

VERTICAL = ("heading", "course")
"""Kinds of reference that know only the turn about the vertical."""


@dataclass(frozen=True, eq=False)
class Reference:
    """The reference rate of a recording.

    ``rate`` (n, 3) rad/s in body axes, NaN where unknown; ``kind`` says what it came from ("none":
    it moves unseen); ``band_hz`` is the highest frequency in Hz at which a derived rate is to be
    used, None where the rate was not derived; ``segments`` are the index ranges (start, stop) in
    which every known axis is finite; ``findings`` tell of faults of the reference; ``earth_rate``
    says whether the rate is against inertial space (True), or Earth-relative (False); ``up`` (3,)
    is the direction upward in the sensor's axes where the rate is only that about it; ``time``
    (n,) s are the instants of the sensor's samples, where its stamps scatter about these.
    ``samples`` (m, 3) are those of a rate that was measured at times of its own, ``seen_at`` (m,) s
    the times of what a derived one was made of.
    """

    rate: np.ndarray
    kind: Literal["rate", "attitude", "heading", "course", "static", "none"]
    band_hz: float | None = None
    segments: list[tuple[int, int]] = field(default_factory=list)
    findings: tuple[Finding, ...] = ()
    earth_rate: bool = True
    band_limit: float | None = None
    up: np.ndarray | None = None
    time: np.ndarray | None = None
    samples: np.ndarray | None = None
    seen_at: np.ndarray | None = None


def reference_rate(recording: Recording, latitude: float | None = None) -> Reference:
    """The rate against inertial space that the recording's reference saw, in body axes.

    It is ``ref_rate`` as it is; else ``ref_q``, differentiated; else about z from ``ref_heading``
    of a planar vehicle, x and y unknown; else about the axis nearest to the vertical from the
    course of its positions or velocities; else zero (static) where the recording is at rest, and
    unknown where it moves. A reference in a recording of its own is taken at its own samples. To a
    differentiated rate the Earth's is added where the latitude [rad] is known (the argument, else
    the recording's column). Raises UserError for a latitude beyond pi/2, and for positions that
    look like degrees.
    """
    if latitude is not None and not abs(latitude) <= math.pi / 2:
        raise UserError(f"latitude is {latitude} rad, expected -pi/2 to pi/2")
    source = recording if recording.reference is None else recording.reference
    if recording.ref_rate is not None and source is recording:
        return _in_its_rows(recording, recording.ref_rate)
    if recording.ref_rate is not None:
        return _of_another_clock(recording, source)
    earth = _latitudes(recording, latitude)
    if source.ref_q is not None:
        return _at_likeliest_times(_from_attitude, recording, source, earth)
    if source.ref_heading is not None:
        return _at_likeliest_times(_from_heading, recording, source, earth)
    course = _from_course(recording, source, earth)
    if course is not None:
        return course
    if not is_at_rest(recording):
        return Reference(np.full((len(recording), 3), np.nan), "none", earth_rate=False)
    return Reference(
        np.zeros((len(recording), 3)), "static", None, recording.segments, earth_rate=False
    )


def _in_its_rows(recording: Recording, rate: np.ndarray) -> Reference:
    """A rate that was measured in the rows of a recording, at even times where it was sampled so:
    moved by a part of a row at stamps that scatter it would be the noisier the faster it changes.
    """
    even = evenly_sampled(recording, rate)
    said = () if even is None else (jitter_of(recording, even, True, True),)
    seen = _finite_runs(recording, rate)
    return Reference(rate, "rate", None, seen, findings=said, time=even)


def earth_rate_in_body(q: np.ndarray, latitude: np.ndarray | float) -> np.ndarray:
    """The Earth's rate (n, 3) rad/s in body axes at attitude ``q`` (n, 4), NaN where that is NaN.

    R_nb^T [0, cos(lat), sin(lat)] 7.292115e-5 in east-north-up (Groves 2013, chapter 2, there in
    north-east-down).
    """
    latitude = np.broadcast_to(latitude, len(q))
    earth = EARTH_RATE * np.column_stack([np.zeros(len(q)), np.cos(latitude), np.sin(latitude)])
    rate, seen = np.full((len(q), 3), np.nan), np.all(np.isfinite(q), axis=1)
    if seen.any():
        rate[seen] = Rotation.from_quat(q[seen], scalar_first=True).apply(earth[seen], inverse=True)
    return rate


def _latitudes(recording: Recording, latitude: float | None) -> np.ndarray | float | None:
    """The latitude at each sample: the argument, else the column with its empty cells filled."""
    if latitude is not None or recording.latitude is None:
        return latitude
    known = np.isfinite(recording.latitude)
    if not known.any():
        return None
    return np.interp(recording.time, recording.time[known], recording.latitude[known])


def _at_likeliest_times(
    make: Callable[..., Reference],
    recording: Recording,
    source: Recording,
    latitude: np.ndarray | float | None,
) -> Reference:
    """The rate of a reference by the stamps of sensor and reference, or by even times where stamps
    scatter and the rate then explains clearly more of the gyro.

    A reference may have been looked up at the stamps, and the sensor not.
    """
    made = make(recording, source, latitude)
    even = even_times(recording), even_times(source)
    if recording.gyro is None or (even[0] is None and even[1] is None):
        return made
    best, most, used = made, CLEARLY * _information(recording, made), (False, False)
    for sensor, reference in ((True, False), (False, True), (True, True)):
        if (sensor and even[0] is None) or (reference and even[1] is None):
            continue
        at, of = _on(recording, even[0], sensor), _on(source, even[1], reference)
        other = make(at, of, latitude)
        told = _information(at, other)
        if told > most:
            best, most, used = replace(other, time=at.time), told, (sensor, reference)
    return replace(best, findings=(*best.findings, jitter_of(recording, even[0], *used)))


def _on(recording: Recording, even: np.ndarray, wanted: bool) -> Recording:
    return at_times(recording, even) if wanted else recording


def _information(recording: Recording, reference: Reference) -> float:
    """What the reference tells of the gyro [nat] in a frame of the coherence, below its limit."""
    seen = np.isfinite(reference.rate).any(axis=0)
    frequency, share = coherence(recording.time, recording.gyro[:, seen], reference.rate[:, seen])
    if share is None or reference.band_limit is None:
        return 0.0
    inside = (frequency > 0) & (frequency <= reference.band_limit)
    return float(-np.sum(np.log1p(-np.minimum(share[inside], 1 - 1e-12))))


def _from_attitude(
    recording: Recording, source: Recording, latitude: np.ndarray | float | None
) -> Reference:
    source = own_samples(source)
    track, time = attitude_track(source), recording.time
    cut_at_jumps(track, source, recording)
    rate = np.full((len(recording), 3), np.nan)
    for nodes in track.segments:
        rows, curve = within(time, source.time[nodes]), rate_through(source, nodes)
        if not len(rows):
            continue
        rate[rows] = slope_at(time[rows], curve, source.time[nodes], recording.sample_period)
        if latitude is not None:
            attitude = attitude_curve(source, nodes)(time[rows]).as_quat(scalar_first=True)
            rate[rows] += earth_rate_in_body(
                attitude, latitude if np.ndim(latitude) == 0 else latitude[rows]
            )
    return _derived(recording, rate, "attitude", track, latitude is not None)


def _from_heading(
    recording: Recording, source: Recording, latitude: np.ndarray | float | None
) -> Reference:
    check_radians(source)
    heading, time = source.ref_heading, recording.time
    known = np.isfinite(heading)
    unwrapped = np.full(len(source), np.nan)
    unwrapped[known] = np.unwrap(heading[known])
    rows, findings = measured(unwrapped[:, None], "ref_heading")
    track = Track(source.time, rows, lambda nodes: np.diff(unwrapped[nodes])[:, None])
    track.findings += findings
    rate = np.full((len(recording), 3), np.nan)
    for nodes in track.segments:
        rows = within(time, source.time[nodes])
        curve = through(source.time[nodes], unwrapped[nodes, None])
        row = recording.sample_period
        rate[rows, 2] = slope_at(time[rows], curve, source.time[nodes], row)[:, 0]
    if latitude is not None:
        rate[:, 2] += EARTH_RATE * np.sin(latitude)
    rate[:, 2], rocks = rate_about_z(recording, rate[:, 2])
    made = _derived(recording, rate, "heading", track, latitude is not None)
    said = (*made.findings, *filter(None, [rocks]))
    return replace(made, up=np.array([0.0, 0.0, 1.0]), findings=said)


def check_radians(source: Recording) -> None:
    """Refuse a heading that goes back by 360 where it should by 2 pi: it counts degrees."""

    heading = source.ref_heading[np.isfinite(source.ref_heading)]
    steps = np.abs(np.diff(heading))
    back = steps[steps > HALF]
    if len(back) and np.all(np.abs(back / (2 * HALF) - 1) < 0.1):
        raise UserError(
            f"{source.name}: ref_heading goes back by {back[0]:.4g} from one sample to the next, "
            "where a heading in rad does by 6.283, a factor of 57: its numbers are degrees, write "
            "ref_heading [deg]"
        )


def _of_another_clock(recording: Recording, source: Recording) -> Reference:
    """A rate that was measured at times of its own, in the band that these can show."""
    seen = source.ref_rate[:, known_axes(source.ref_rate)]
    known = fresh(seen)
    track = Track(source.time, known, lambda n: np.diff(seen[n], axis=0), np.inf)
    made = _derived(recording, recording.ref_rate, "rate", track, True)
    return replace(made, samples=source.ref_rate[known])


def _from_course(
    recording: Recording, source: Recording, latitude: np.ndarray | float | None
) -> Reference | None:
    """About the sensor's axis nearest to the vertical; None where no course is known, or its turns
    are not seen."""
    if looks_like_degrees(source) and motion_in(recording):
        east, north = np.nanmedian(source.ref_east), np.nanmedian(source.ref_north)
        raise UserError(
            f"{source.name}: ref_north, ref_east are in m, about {north:.4f}, {east:.4f}, and "
            "change by less than a millimetre a second while the sensor moves: they look like "
            "degrees of latitude and longitude, which are called ref_latitude [deg] and "
            "ref_longitude [deg]"
        )
    found = course_of(source, recording.time)
    if found is None or not found.turns:
        return None
    up = upward(recording, found.rate)
    axis = int(np.argmax(np.abs(up)))
    through, leans = upward_through(recording, found.rate, up)
    rate = np.full((len(recording), 3), np.nan)
    rate[:, axis] = through[:, axis] * (
        found.rate if latitude is None else found.rate + EARTH_RATE * np.sin(latitude)
    )
    made = _derived(recording, rate, "course", found.track, latitude is not None)
    said = (mounted(up), *filter(None, [leans]))
    return replace(made, findings=(*made.findings, *said), up=up)


def _derived(
    recording: Recording, rate: np.ndarray, kind, track: Track, earth_rate: bool
) -> Reference:
    period = max(track.period, recording.sample_period)
    limit = min(0.25 / period, restored_up_to(recording.reference))
    band = trusted_band(recording.time, recording.gyro, rate, limit) if track.segments else None
    seen = _finite_runs(recording, rate)
    at = np.concatenate([track.time[nodes] for nodes in track.segments] or [np.zeros(0)])
    said = tuple(track.findings)
    return Reference(rate, kind, band, seen, said, earth_rate, limit, seen_at=at)


def _finite_runs(recording: Recording, rate: np.ndarray) -> list[tuple[int, int]]:
    """Index ranges without gap in which the axes that are ever known are finite."""
    finite = np.isfinite(rate)
    good = np.all(finite[:, finite.any(axis=0)], axis=1) & finite.any(axis=1)
    found: list[tuple[int, int]] = []
    for start, stop in recording.segments:
        runs_here = runs(good[start:stop])
        found += [(start + a, start + b) for a, b in runs_here]
    return found
