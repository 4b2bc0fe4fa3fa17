"""Vectors in a body's axes carried along by its gyro, span by span of a recording.

With the attitude R against that at the start of a span, dR/dt = R [w x]: of what stands still in
the world, as gravity, R v is the same at all times, where v is it in the axes of the body.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation


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
