"""What the other ways to the results are made of: numpy and scipy alone."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from scipy.spatial.transform import Rotation


def largest(pairs: Iterable[tuple]) -> float:
    """Largest difference of any element of two arrays, over all pairs."""
    return max(float(np.max(np.abs(np.asarray(a) - np.asarray(b)))) for a, b in pairs)


def in_standard_deviations(a: np.ndarray, reference: np.ndarray) -> float:
    """Largest difference of two covariances, in units of standard deviations.

    Each element is divided by the standard deviations of its row and its column.
    """
    std = np.sqrt(np.diag(reference))
    return float(np.max(np.abs(a - reference) / np.outer(std, std)))


def scalar_first(rotation: Rotation) -> np.ndarray:
    """The quaternion (4,) of ``rotation``."""
    return rotation.as_quat(scalar_first=True)


def same_sign(q: np.ndarray, like: np.ndarray) -> np.ndarray:
    """q or -q, the same rotation, whichever is closer to ``like`` (4,)."""
    return q if q @ like >= 0 else -q


def cross_matrix(v: np.ndarray) -> np.ndarray:
    """The matrix (3, 3) of the cross product with ``v`` (3,)."""
    return np.cross(np.eye(3), v)
