"""A log's magnetometer beside the attitude that its reference knows."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.characterization.magnetometer.estimate import TURN, fresh_rows
from pyimu.identification.errors.attitude_error import on_own_clock
from pyimu.identification.fit.clock import Clock
from pyimu.identification.fit.sample_noise import quiet_noise
from pyimu.recording.clock import runs
from pyimu.recording.quality.spikes import spikes
from pyimu.recording.recording import Recording

GAP = 5.5
"""Median periods beyond which a step between samples is a gap: a few that are held, or a spike,
are none."""

LEAST = 3
"""Rows of a stretch without gap, from which on its attitude can be differentiated."""


@dataclass(frozen=True)
class FieldRows:
    """Samples ``mag`` (k, 3) T of a log at ``time`` (k,) s.

    ``axes`` (k, 3, 3) turn world axes into the sensor's, ``passing`` (k, 3, 3) 1/s is their change.
    ``white`` (3,) T is the standard deviation of a sample's white noise, in the quietest seconds,
    ``turned`` (3,) T that of the field that the reference's attitudes, with their own noise, turn.
    """

    name: str
    time: np.ndarray
    mag: np.ndarray
    axes: np.ndarray
    passing: np.ndarray
    white: np.ndarray
    turned: np.ndarray

    def __len__(self) -> int:
        return len(self.time)

    @property
    def period(self) -> float:
        """s; from sample to sample."""
        return float(np.median(np.diff(self.time)))

    @property
    def segments(self) -> list[tuple[int, int]]:
        return _segments(self.time)

    def between(self, first: float, end: float = np.inf) -> FieldRows:
        """The rows from ``first`` s until before ``end`` s."""
        return self._taken((self.time >= first) & (self.time < end))

    def _taken(self, rows: np.ndarray) -> FieldRows:
        of_rows = ("time", "mag", "axes", "passing")
        return replace(self, **{n: getattr(self, n)[rows] for n in of_rows})

    def attitudes(self) -> FieldRows:
        """Means over turns by ``TURN``, of which each counts once, however long it was held."""
        before = np.roll(self.axes, 1, axis=0)
        steps = Rotation.from_matrix(self.axes @ before.transpose(0, 2, 1)).magnitude()
        # Sample by sample the noise of the reference would turn, too: over stretches it does not.
        steps[0] = 0.0
        cell = np.floor(np.cumsum(steps) / TURN)
        starts = np.flatnonzero(np.diff(cell, prepend=-1))
        count = np.diff(np.append(starts, len(cell)))

        def mean(values: np.ndarray) -> np.ndarray:
            sums = np.add.reduceat(values, starts, axis=0)
            return sums / count.reshape(-1, *([1] * (values.ndim - 1)))

        means = (mean(v) for v in (self.time, self.mag, self.axes, self.passing))
        return FieldRows(self.name, *means, self.white, self.turned)


def field_rows(recording: Recording, mounting: np.ndarray, clock: Clock | None) -> FieldRows | None:
    """The rows of a log with a sample of its magnetometer and a reference attitude.

    None of too few. ``mounting`` (3, 3) turns the reference's body axes into the sensor's;
    ``clock`` is what was taken out of the reference's clock. A spike is left out.
    """
    if clock is not None and clock.taken_out:
        recording = on_own_clock(recording, clock)
    rows = fresh_rows(recording.mag)
    rows = rows[np.isfinite(recording.ref_q[rows]).all(axis=1)]
    if len(rows):
        field = recording.mag[rows]
        rows = rows[~spikes(field, _segments(recording.time[rows])).any(axis=1)]
    if len(rows) < 2 * LEAST:
        return None
    time, mag = recording.time[rows], recording.mag[rows]
    attitude = Rotation.from_quat(recording.ref_q[rows], scalar_first=True)
    axes = mounting @ attitude.inv().as_matrix()
    passing, kept = np.zeros_like(axes), np.zeros(len(time), dtype=bool)
    for a, b in _segments(time):
        if b - a >= LEAST:
            passing[a:b] = np.gradient(axes[a:b], time[a:b], axis=0)
            kept[a:b] = True
    noise_of = partial(quiet_noise, segments=_segments(time), h=float(np.median(np.diff(time))))
    turned = noise_of(axes @ mean_field(axes, mag))
    whole = FieldRows(recording.name, time, mag, axes, passing, noise_of(mag), turned)
    return whole._taken(kept) if kept.any() else None


def mean_field(axes: np.ndarray, mag: np.ndarray) -> np.ndarray:
    """The mean (3,) of samples ``mag`` (k, 3) in world axes, which ``axes`` (k, 3, 3) turn into the
    sensor's.
    """
    return np.median(np.einsum("kji,kj->ki", axes, mag), axis=0)


def _segments(time: np.ndarray) -> list[tuple[int, int]]:
    """Ranges of rows (start, stop) without gap."""
    steps = np.diff(time)
    near = np.append(steps <= GAP * np.median(steps), False) if len(steps) else np.zeros(1, bool)
    return [(a, b + 1) for a, b in runs(near)]


def unit_of(logs: Iterable[FieldRows]) -> float:
    """T; the median length of the samples."""
    return float(np.median(np.concatenate([np.linalg.norm(r.mag, axis=1) for r in logs])))
