"""The rate that a reference saw, and the band in which it can be trusted.

A reference attitude is differentiated by a cubic rotation spline through its own samples
(``scipy``'s RotationSpline, which solves the kinematic equation, so that rotations need not
commute). It adds no bandwidth of its own, and stays inside each segment that was seen: occlusions
and faults are NaN.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation, RotationSpline

from pyimu.errors import Finding, UserError
from pyimu.recording.recording import Recording
from pyimu.recording.reference.band import trusted_band
from pyimu.recording.reference.track import Track
from pyimu.recording.rest import is_at_rest
from pyimu.symbolic.earth import EARTH_RATE


@dataclass(frozen=True, eq=False)
class Reference:
    """The reference rate of a recording.

    ``rate`` (n, 3) rad/s in body axes, NaN where unknown; ``kind`` says what it came from ("none":
    it moves unseen); ``band_hz`` is the highest frequency in Hz at which a derived rate is to be
    used, None where the rate was not derived; ``segments`` are the index ranges (start, stop) in
    which every known axis is finite; ``findings`` tell of faults of the reference; ``earth_rate``
    says whether the rate is against inertial space (True), or Earth-relative (False).
    """

    rate: np.ndarray
    kind: Literal["rate", "attitude", "heading", "static", "none"]
    band_hz: float | None = None
    segments: list[tuple[int, int]] = field(default_factory=list)
    findings: tuple[Finding, ...] = ()
    earth_rate: bool = True
    band_limit: float | None = None


def reference_rate(recording: Recording, latitude: float | None = None) -> Reference:
    """The rate against inertial space that the recording's reference saw, in body axes.

    It is ``ref_rate`` as it is; else ``ref_q``, differentiated; else about z from ``ref_heading``
    of a planar vehicle, x and y unknown; else zero (static) where the recording is at rest, and
    unknown where it moves. To a differentiated rate the Earth's is added where the latitude [rad]
    is known (the argument, else the recording's column). Raises UserError for a latitude beyond
    pi/2.
    """
    if latitude is not None and not abs(latitude) <= math.pi / 2:
        raise UserError(f"latitude is {latitude} rad, expected -pi/2 to pi/2")
    if recording.ref_rate is not None:
        return Reference(
            recording.ref_rate, "rate", None, _finite_runs(recording, recording.ref_rate)
        )
    if recording.ref_q is not None:
        return _from_attitude(recording, _latitudes(recording, latitude))
    if recording.ref_heading is not None:
        return _from_heading(recording, _latitudes(recording, latitude))
    if not is_at_rest(recording):
        return Reference(np.full((len(recording), 3), np.nan), "none", earth_rate=False)
    return Reference(
        np.zeros((len(recording), 3)), "static", None, recording.segments, earth_rate=False
    )


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


def _from_attitude(recording: Recording, latitude: np.ndarray | float | None) -> Reference:
    q = recording.ref_q

    def steps(nodes: np.ndarray) -> np.ndarray:
        attitude = Rotation.from_quat(q[nodes], scalar_first=True)
        return (attitude[:-1].inv() * attitude[1:]).as_rotvec()

    def spline(nodes: np.ndarray):
        return RotationSpline(
            recording.time[nodes], Rotation.from_quat(q[nodes], scalar_first=True)
        )

    track = Track(recording.time, _fresh(q), steps)
    rate = np.full((len(recording), 3), np.nan)
    for nodes in track.segments:
        rows, curve = np.arange(nodes[0], nodes[-1] + 1), spline(nodes)
        rate[rows] = curve(recording.time[rows], 1)
        if latitude is not None:
            attitude = curve(recording.time[rows]).as_quat(scalar_first=True)
            rate[rows] += earth_rate_in_body(
                attitude, latitude if np.ndim(latitude) == 0 else latitude[rows]
            )
    return _derived(recording, rate, "attitude", track, latitude is not None)


def _from_heading(recording: Recording, latitude: np.ndarray | float | None) -> Reference:
    heading = recording.ref_heading
    known = _fresh(heading[:, None])
    unwrapped = np.full(len(recording), np.nan)
    unwrapped[known] = np.unwrap(heading[known])
    track = Track(recording.time, known, lambda nodes: np.diff(unwrapped[nodes])[:, None])
    rate = np.full((len(recording), 3), np.nan)
    for nodes in track.segments:
        rows = np.arange(nodes[0], nodes[-1] + 1)
        rate[rows, 2] = CubicSpline(recording.time[nodes], unwrapped[nodes])(
            recording.time[rows], 1
        )
    if latitude is not None:
        rate[:, 2] += EARTH_RATE * np.sin(latitude)
    return _derived(recording, rate, "heading", track, latitude is not None)


def _fresh(values: np.ndarray) -> np.ndarray:
    """Rows of a reference (n, k) that are known and new.

    A slow reference that is held between its own samples repeats most rows in runs of one length;
    its repeats are no samples. One that stands still for a while, or is known at every row, is
    left as it is.
    """
    known = np.flatnonzero(np.all(np.isfinite(values), axis=1))
    if len(known) < 8:
        return known
    new = np.concatenate([[True], np.any(np.diff(values[known], axis=0) != 0, axis=1)])
    lengths = np.diff(np.flatnonzero(np.append(new, True)))
    usual = np.median(lengths)
    held = len(lengths) >= 8 and usual >= 2 and np.mean(np.abs(lengths - usual) <= 1) > 0.8
    return known[new] if held else known


def _derived(
    recording: Recording, rate: np.ndarray, kind, track: Track, earth_rate: bool
) -> Reference:
    limit = 0.25 / track.period
    band = trusted_band(recording.time, recording.gyro, rate, limit) if track.segments else None
    runs = _finite_runs(recording, rate)
    return Reference(rate, kind, band, runs, tuple(track.findings), earth_rate, limit)


def _finite_runs(recording: Recording, rate: np.ndarray) -> list[tuple[int, int]]:
    """Index ranges without gap in which the axes that are ever known are finite."""
    finite = np.isfinite(rate)
    good = np.all(finite[:, finite.any(axis=0)], axis=1) & finite.any(axis=1)
    runs = []
    for start, stop in recording.segments:
        edges = (
            np.flatnonzero(
                np.diff(np.concatenate(([False], good[start:stop], [False])).astype(int))
            )
            + start
        )
        runs += [(int(a), int(b)) for a, b in zip(edges[::2], edges[1::2])]
    return runs
