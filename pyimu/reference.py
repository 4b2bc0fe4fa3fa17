"""The rate that a reference saw, and the band in which it can be trusted.

A reference attitude is differentiated by a cubic rotation spline through its own samples (``scipy``'s RotationSpline, which
solves the kinematic equation, so that rotations need not commute).  It adds no bandwidth of its own, and stays inside each
stretch that was seen: occlusions and faults are NaN.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation, RotationSpline

from pyimu.errors import Finding, UserError
from pyimu.quality import clipped

if TYPE_CHECKING:
    from pyimu.recording import Recording

EARTH_RATE = 7.292115e-5
"""rad/s (WGS 84)."""

LEAST_NODES = 8
"""A stretch of a reference with fewer samples is left out."""

BREAK = 1.5
"""A step between reference samples above so many of its own usual steps ends a stretch."""

SPIKE_ANGLE = 0.05
"""rad; below it a step of the reference's attitude and back is taken for its noise."""

SPIKE_RATIO = 20.0
"""A spike exceeds the 95 % quantile of its statistic in the same recording so many times."""

STEP_RATIO = 8.0
"""Close to a spike, a step of the rate above so many 90 % quantiles belongs to the same fault."""

REACQUIRE = 1.0
"""s; within it faults are one fault, and a shorter piece of reference beside one is left out."""

MARGIN = 0.25
"""s; left out on both sides of a fault."""

COHERENCE = 0.9
"""Squared coherence between gyro and reference above which the reference is trusted."""

FRAMES = (2.0, 1.0, 0.5)
"""s; lengths of the frames of the coherence estimate, the longest of which there are enough: a resolution of 1 to 4 Hz."""

LEAST_FRAMES = 30
"""Least number of frames (three inputs explain 3/30 of noise by chance)."""


@dataclass(frozen=True, eq=False)
class Reference:
    """The reference rate of a recording.

    ``rate`` (n, 3) rad/s in body axes, NaN where unknown; ``kind`` says what it came from ("none": it moves unseen);
    ``band_hz`` is the highest frequency in Hz at which a derived rate is to be used, None where the rate was not derived;
    ``segments`` are the index ranges (start, stop) in which every known axis is finite; ``findings`` tell of faults of the
    reference; ``earth_rate`` says whether the rate is against inertial space (True), or Earth-relative (False).
    """

    rate: np.ndarray
    kind: Literal["rate", "attitude", "heading", "static", "none"]
    band_hz: float | None = None
    segments: list[tuple[int, int]] = field(default_factory=list)
    findings: tuple[Finding, ...] = ()
    earth_rate: bool = True


def reference_rate(recording: Recording, latitude: float | None = None) -> Reference:
    """The rate against inertial space that the recording's reference saw, in body axes.

    From ``ref_rate`` as it is; else from ``ref_q``, differentiated; else about z from ``ref_heading`` of a planar vehicle, x
    and y unknown; else unknown where the recording has a position or is marked as moving, and zero (static) where it has no
    reference at all.  To a differentiated rate the Earth's is added where the latitude [rad] is known (the
    argument, else the recording's column).  Raises UserError for a latitude beyond pi/2.
    """
    if latitude is not None and not abs(latitude) <= math.pi / 2:
        raise UserError(f"latitude is {latitude} rad, expected -pi/2 to pi/2")
    if recording.ref_rate is not None:
        return Reference(recording.ref_rate, "rate", None, _finite_runs(recording, recording.ref_rate))
    if recording.ref_q is not None:
        return _from_attitude(recording, _latitudes(recording, latitude))
    if recording.ref_heading is not None:
        return _from_heading(recording, _latitudes(recording, latitude))
    if _moves(recording):
        return Reference(np.full((len(recording), 3), np.nan), "none", earth_rate=False)
    return Reference(np.zeros((len(recording), 3)), "static", None, recording.segments, earth_rate=False)


def _moves(recording: Recording) -> bool:
    """Whether a recording without reference of its rotation is known to move all the same."""
    track = (recording.ref_north, recording.ref_east, recording.ref_velocity)
    return any(t is not None for t in track) or (recording.moving is not None and bool(np.any(recording.moving > 0)))


def earth_rate_in_body(q: np.ndarray, latitude: np.ndarray | float) -> np.ndarray:
    """The Earth's rate (n, 3) rad/s in the axes of the body with attitude ``q`` (n, 4), NaN where that is NaN.

    R_nb^T [0, cos(lat), sin(lat)] 7.292115e-5 in east-north-up (Groves 2013, chapter 2, there in north-east-down).
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
        return RotationSpline(recording.time[nodes], Rotation.from_quat(q[nodes], scalar_first=True))

    track = _Track(recording.time, _fresh(q), steps)
    rate = np.full((len(recording), 3), np.nan)
    for nodes in track.stretches:
        rows, curve = np.arange(nodes[0], nodes[-1] + 1), spline(nodes)
        rate[rows] = curve(recording.time[rows], 1)
        if latitude is not None:
            attitude = curve(recording.time[rows]).as_quat(scalar_first=True)
            rate[rows] += earth_rate_in_body(attitude, latitude if np.ndim(latitude) == 0 else latitude[rows])
    return _derived(recording, rate, "attitude", track, latitude is not None)


def _from_heading(recording: Recording, latitude: np.ndarray | float | None) -> Reference:
    heading = recording.ref_heading
    known = _fresh(heading[:, None])
    unwrapped = np.full(len(recording), np.nan)
    unwrapped[known] = np.unwrap(heading[known])
    track = _Track(recording.time, known, lambda nodes: np.diff(unwrapped[nodes])[:, None])
    rate = np.full((len(recording), 3), np.nan)
    for nodes in track.stretches:
        rows = np.arange(nodes[0], nodes[-1] + 1)
        rate[rows, 2] = CubicSpline(recording.time[nodes], unwrapped[nodes])(recording.time[rows], 1)
    if latitude is not None:
        rate[:, 2] += EARTH_RATE * np.sin(latitude)
    return _derived(recording, rate, "heading", track, latitude is not None)


def _fresh(values: np.ndarray) -> np.ndarray:
    """Rows of a reference (n, k) that are known and new.

    A slow reference that is held between its own samples repeats most rows in runs of one length; its repeats are no
    samples.  One that stands still for a while, or is known at every row, is left as it is.
    """
    known = np.flatnonzero(np.all(np.isfinite(values), axis=1))
    if len(known) < 8:
        return known
    new = np.concatenate([[True], np.any(np.diff(values[known], axis=0) != 0, axis=1)])
    lengths = np.diff(np.flatnonzero(np.append(new, True)))
    usual = np.median(lengths)
    held = len(lengths) >= 8 and usual >= 2 and np.mean(np.abs(lengths - usual) <= 1) > 0.8
    return known[new] if held else known


def _derived(recording: Recording, rate: np.ndarray, kind, track: _Track, earth_rate: bool) -> Reference:
    band = trusted_band(recording.time, recording.gyro, rate, 0.25 / track.period) if track.stretches else None
    return Reference(rate, kind, band, _finite_runs(recording, rate), tuple(track.findings), earth_rate)


def _finite_runs(recording: Recording, rate: np.ndarray) -> list[tuple[int, int]]:
    """Index ranges without gap in which the axes that are ever known are finite."""
    finite = np.isfinite(rate)
    good = np.all(finite[:, finite.any(axis=0)], axis=1) & finite.any(axis=1)
    runs = []
    for start, stop in recording.segments:
        edges = np.flatnonzero(np.diff(np.concatenate(([False], good[start:stop], [False])).astype(int))) + start
        runs += [(int(a), int(b)) for a, b in zip(edges[::2], edges[1::2])]
    return runs


class _Track:
    """The samples of a reference: stretches of row numbers that can be differentiated, without occlusions and faults.

    ``known`` are the rows with a reference; ``steps(nodes)`` gives the rotation vectors (m - 1, d) rad between them.
    """

    def __init__(self, time: np.ndarray, known: np.ndarray, steps: Callable[[np.ndarray], np.ndarray]) -> None:
        self.time = time
        self.findings: list[Finding] = []
        step = np.diff(time[known])
        # the 90 % quantile, for a reference may fall on every second and third row in turn
        longest = BREAK * float(np.quantile(step, 0.9)) if len(step) else math.nan
        self.period = float(step[step <= longest].mean()) if len(step) else math.nan
        whole = self._split(known, step > longest)
        self.stretches = [nodes for nodes in self._without_faults(whole, steps) if len(nodes) >= LEAST_NODES]

    @staticmethod
    def _split(nodes: np.ndarray, ends: np.ndarray) -> list[np.ndarray]:
        return [part for part in np.split(nodes, np.flatnonzero(ends) + 1) if len(part) >= LEAST_NODES]

    def _without_faults(self, whole: list[np.ndarray], steps) -> list[np.ndarray]:
        """The stretches less the faults of the reference.

        A spike is a step of the attitude that comes and goes, or a rate that jumps up and down again between samples: two
        successive changes of rate that oppose each other, sqrt(-d_k . d_k+1).  It is zero for a step of the rate and for
        any acceleration that lasts, however fast the motion, and needs no gyro, so that over-range of the gyro is no fault
        of the reference.
        """
        angles = [steps(nodes) for nodes in whole]
        changes = [np.diff(a, axis=0) for a in angles]
        spikes = [np.sqrt(np.maximum(0, -np.sum(d[:-1] * d[1:], axis=1))) for d in changes]
        if not whole:
            return []
        gate = max(SPIKE_ANGLE, SPIKE_RATIO * float(np.quantile(np.concatenate(spikes), 0.95)))
        if max(s.max() for s in spikes) < gate:
            return whole
        sizes = [np.linalg.norm(d, axis=1) for d in changes]
        step_gate = STEP_RATIO * float(np.quantile(np.concatenate(sizes), 0.9))
        kept = [self._healthy(nodes, s > gate, size > step_gate) for nodes, s, size in zip(whole, spikes, sizes)]
        self._report(whole, kept, spikes, gate)
        return [part for nodes, good in zip(whole, kept) for part in self._split(nodes[good], np.diff(np.flatnonzero(good)) > 1)]

    def _healthy(self, nodes: np.ndarray, spike: np.ndarray, step: np.ndarray) -> np.ndarray:
        """Mask of the nodes that no fault touches; ``spike`` (m - 3,), ``step`` (m - 2,)."""
        good, time = np.ones(len(nodes), bool), self.time[nodes]
        for first, last in self._faults(time[1:-2][spike], time[1:-1][step]):
            good &= (time < first - MARGIN) | (time > last + MARGIN)
        edges = np.flatnonzero(np.diff(np.concatenate(([False], good, [False])).astype(int)))
        for start, stop in zip(edges[::2], edges[1::2]):
            if stop - start < len(nodes) and time[stop - 1] - time[start] < REACQUIRE:
                good[start:stop] = False
        return good

    @staticmethod
    def _faults(spikes: np.ndarray, steps: np.ndarray) -> list[tuple[float, float]]:
        """Intervals that spikes, and steps of the rate close to them, span."""
        events = np.union1d(spikes, steps)
        groups = np.split(events, np.flatnonzero(np.diff(events) > REACQUIRE) + 1)
        return [(g[0], g[-1]) for g in groups if np.isin(g, spikes).any()]

    def _report(self, whole: list[np.ndarray], kept: list[np.ndarray], spikes: list[np.ndarray], gate: float) -> None:
        lost = np.concatenate([self.time[nodes[~good]] for nodes, good in zip(whole, kept)])
        count = sum(int(np.sum(s > gate)) for s in spikes)
        detail = {"left_out": len(lost), "largest_angle": float(max(s.max() for s in spikes)),
                  "first": float(lost.min()), "last": float(lost.max())}
        self.findings.append(Finding("reference_spikes", "", count, detail))


def trusted_band(time: np.ndarray, gyro: np.ndarray | None, rate: np.ndarray, limit: float) -> float:
    """The highest frequency in Hz, at most ``limit``, up to which ``rate`` (n, 3) explains ``gyro`` (n, 3).

    The share of the gyro's power that a linear filter of the reference's axes explains, the multiple coherence
    tr(S_gr S_rr^-1 S_rg) / tr(S_gg) (Bendat and Piersol 2010, chapter 7), must stay above ``COHERENCE``; weighting the axes
    by power leaves out those without motion, and using all axes at once makes it blind to an unknown mounting and
    to a constant delay.  Frames with a missing or clipped sample are left out.  At least 1 Hz, or ``limit`` where that is less.
    """
    least = min(1.0, limit)
    if gyro is None:
        return least
    axes = np.isfinite(rate).any(axis=0)
    unclipped = np.column_stack([np.where(clipped(column), np.nan, column) for column in gyro.T])
    frequency, share = coherence(time, unclipped[:, axes], rate[:, axes])
    if share is None:
        return least
    low = np.flatnonzero((share < COHERENCE) & (frequency >= least))
    band = frequency[max(low[0] - 1, 0)] if len(low) else frequency[-1]
    return float(min(max(band, least), limit))


def coherence(time: np.ndarray, y: np.ndarray, x: np.ndarray) -> tuple[np.ndarray, np.ndarray | None]:
    """Frequencies (f,) Hz, and the share (f,) of the power of ``y`` (n, p) that ``x`` (n, q) explains.

    The share is None where there are too few frames.
    """
    period = float(np.median(np.diff(time)))
    both = np.column_stack([y, x])
    for seconds in FRAMES:
        length = max(16, round(seconds / period))
        frames = _frames(time, both, length, period)
        if len(frames) >= LEAST_FRAMES:
            return np.fft.rfftfreq(length, period), _explained(frames, y.shape[1])
    return np.zeros(0), None


def _explained(frames: np.ndarray, p: int) -> np.ndarray:
    """The share (f,) of the power in the first ``p`` columns of ``frames`` (k, length, p + q) that the others explain."""
    window = np.hanning(frames.shape[1])[:, None]
    spectrum = np.fft.rfft((frames - frames.mean(axis=1, keepdims=True)) * window, axis=1)
    s = np.einsum("kfi,kfj->fij", spectrum.conj(), spectrum)
    explained = s[:, :p, p:] @ np.linalg.pinv(s[:, p:, p:], hermitian=True) @ s[:, p:, :p]
    total = np.trace(s[:, :p, :p], axis1=1, axis2=2).real
    return np.trace(explained, axis1=1, axis2=2).real / np.where(total > 0, total, np.inf)


def _frames(time: np.ndarray, values: np.ndarray, length: int, period: float) -> np.ndarray:
    """Half-overlapping frames (k, length, columns) without gap and without missing sample."""
    starts = np.arange(0, max(len(time) - length + 1, 0), length // 2)
    good = np.concatenate(([0], np.cumsum(~np.all(np.isfinite(values), axis=1))))
    whole = good[starts + length] == good[starts]
    regular = np.abs(time[starts + length - 1] - time[starts] - (length - 1) * period) < 0.5 * period
    rows = starts[whole & regular][:, None] + np.arange(length)
    return values[rows]
