"""Quaternions (n, 4), written out."""

from __future__ import annotations

import numpy as np


def product(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Hamilton's product of quaternions (n, 4), or of one (4,) with many."""
    a, b, c, d = np.moveaxis(p, -1, 0)
    w, x, y, z = np.moveaxis(q, -1, 0)
    return np.stack(
        [
            a * w - b * x - c * y - d * z,
            a * x + b * w + c * z - d * y,
            a * y - b * z + c * w + d * x,
            a * z + b * y - c * x + d * w,
        ],
        axis=-1,
    )


def inverse(q: np.ndarray) -> np.ndarray:
    return q * np.array([1.0, -1.0, -1.0, -1.0])


def from_vector(v: np.ndarray) -> np.ndarray:
    """Quaternions (n, 4) of rotation vectors (n, 3)."""
    half = 0.5 * np.linalg.norm(v, axis=-1, keepdims=True)
    return np.concatenate([np.cos(half), 0.5 * v * np.sinc(half / np.pi)], axis=-1)


def to_vector(q: np.ndarray) -> np.ndarray:
    """Rotation vectors (n, 3) of quaternions (n, 4), the shorter way round."""
    q = np.where(q[..., :1] < 0, -q, q)
    sine = np.linalg.norm(q[..., 1:], axis=-1, keepdims=True)
    ratio = np.where(sine > 1e-12, 2 * np.arctan2(sine, q[..., :1]) / np.maximum(sine, 1e-12), 2.0)
    return ratio * q[..., 1:]


def in_body(q: np.ndarray, v: np.ndarray) -> np.ndarray:
    """World vectors (n, 3) in body axes."""
    pure = np.concatenate([np.zeros((*v.shape[:-1], 1)), v], axis=-1)
    return product(product(inverse(q), pure), q)[..., 1:]


def from_angles(angles: np.ndarray) -> np.ndarray:
    """Attitude of roll, pitch and yaw (n, 3): about z first, then y, then x of the body."""
    roll, pitch, yaw = (from_vector(a[:, None] * e) for a, e in zip(angles.T, np.eye(3)))
    return product(product(yaw, pitch), roll)


def body_rate(angles: np.ndarray, slopes: np.ndarray) -> np.ndarray:
    """Rate (n, 3) in body axes of roll, pitch, yaw (n, 3) and their slopes (Groves 2013, 2.58)."""
    roll, pitch, _ = angles.T
    r, p, y = slopes.T
    return np.column_stack(
        [
            r - y * np.sin(pitch),
            p * np.cos(roll) + y * np.cos(pitch) * np.sin(roll),
            y * np.cos(pitch) * np.cos(roll) - p * np.sin(roll),
        ]
    )


def between(time: np.ndarray, q: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Attitudes (m, 4) at times (m,) on the shortest arc between neighbours of (n, 4) (slerp)."""
    k = np.clip(np.searchsorted(time, at, side="right") - 1, 0, len(time) - 2)
    share = (at - time[k]) / (time[k + 1] - time[k])
    step = to_vector(product(inverse(q[k]), q[k + 1]))
    return product(q[k], from_vector(share[:, None] * step))
