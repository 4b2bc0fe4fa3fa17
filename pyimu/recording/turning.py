"""Vectors in a body's axes carried along by its gyro, span by span of a recording.

With the attitude R against that at the start of a span, dR/dt = R [w x]: of what stands still in
the world, as gravity, R v is the same at all times, where v is it in the axes of the body.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.recording.recording import Recording

SPAN, STEP = 2.0, 0.02
"""s; of a span over which a vector is carried along, and of its steps: a hand pushes to and fro
within the one, and turns by a few degrees in the other."""

MOST_SPANS = 100
"""Spans that are looked at."""

TURNS = 0.1
"""Share of the rates of its fastest spans from which on a body turns in a span: one at rest tells
nothing, in any unit of the gyro."""


def carried(
    turns: np.ndarray, vectors: np.ndarray, lengths: np.ndarray
) -> tuple[Rotation, np.ndarray]:
    """How far bodies have turned at the end of their spans, and the sums of what they carry.

    ``turns`` (k, m, 3) rad are the rotation vectors of k steps of m spans, of which the first
    ``lengths`` (m,) count. ``vectors`` (k, m, 3, c) are c of them in the axes of the body after
    each step; their sums (m, 3, c) are in those at the start of the span.
    """
    attitude, total = Rotation.identity(turns.shape[1]), np.zeros(vectors.shape[1:])
    for step, (turn, vector) in enumerate(zip(turns, vectors, strict=True)):
        within = (step < lengths)[:, None]
        attitude = attitude * Rotation.from_rotvec(turn * within)
        total += (attitude.as_matrix() @ vector) * within[:, :, None]
    return attitude, total


def drawn(count: int, most: int) -> np.ndarray:
    """Numbers of at most ``most`` of ``count`` spans, evenly over all of them."""
    return np.linspace(0, count - 1, min(count, most)).astype(int)


def busiest(recording: Recording, longest: float) -> tuple[int, int]:
    """Rows (start, stop) of the ``longest`` s in which the gyro turns most, all of a short log."""
    count = round(longest / recording.sample_period)
    if count >= len(recording):
        return 0, len(recording)
    power = np.sum(np.square(np.nan_to_num(recording.gyro)), axis=1)
    whole = np.cumsum(np.append(0.0, power))
    start = int(np.argmax(whole[count:] - whole[:-count]))
    return start, start + count


def turning_spans(recording: Recording, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """What the gyro turns in the steps of m spans in which it does, and ``values`` (n, 3) there.

    Both are (m, k, 3), the turns in rad, the values as means of each step.
    """
    period = recording.sample_period
    step = max(round(STEP / period), 1)
    count = max(round(SPAN / (step * period)), 2)
    turns, values = (_in_spans(recording, v, step, count) for v in (recording.gyro, values))
    known = np.isfinite(turns).all(axis=(1, 2)) & np.isfinite(values).all(axis=(1, 2))
    turns, values = turns[known] * step * period, values[known]
    if not len(turns):
        return turns, values
    size = np.sqrt(np.mean(np.sum(turns**2, axis=2), axis=1))
    rows = np.flatnonzero(size > TURNS * np.quantile(size, 0.9))
    rows = rows[drawn(len(rows), MOST_SPANS)]
    return turns[rows], values[rows]


def _in_spans(recording: Recording, values: np.ndarray, step: int, count: int) -> np.ndarray:
    """Means (m, count, 3) of steps of as many samples, in the spans without gap."""
    rows = count * step
    spans = [
        values[a : a + (b - a) // rows * rows].reshape(-1, count, step, 3).mean(axis=2)
        for a, b in recording.segments
    ]
    return np.concatenate([np.zeros((0, count, 3)), *spans])


def scatter(vectors: np.ndarray) -> np.ndarray:
    """Variance (m,) of the ``vectors`` (m, k, 3) of each span about their mean."""
    away = vectors - vectors.mean(axis=1, keepdims=True)
    return np.mean(np.sum(away**2, axis=2), axis=1)
