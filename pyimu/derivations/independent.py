"""The other ways to the results: numerical, with numpy and scipy alone."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from scipy.linalg import expm
from scipy.spatial.transform import Rotation


def largest(pairs: Iterable[tuple]) -> float:
    """Largest difference of any element of two arrays, over all pairs."""
    return max(float(np.max(np.abs(np.asarray(a) - np.asarray(b)))) for a, b in pairs)


def van_loan(f: np.ndarray, density: np.ndarray, h: float) -> np.ndarray:
    """Covariance after ``h`` of x' = f x + white noise of two-sided ``density``, both (m, m) (Van
    Loan 1978, theorem 1).
    """
    m = len(f)
    e = expm(np.block([[-f, density], [np.zeros_like(f), f.T]]) * h)
    return e[m:, m:].T @ e[:m, m:]


def in_standard_deviations(a: np.ndarray, reference: np.ndarray) -> float:
    """Largest difference of two covariances, each element by the standard deviations of its row and
    column.
    """
    std = np.sqrt(np.diag(reference))
    return float(np.max(np.abs(a - reference) / np.outer(std, std)))


def rotations(rng: np.random.Generator, count: int) -> list[Rotation]:
    """Uniformly distributed attitudes."""
    return [Rotation.from_quat(q) for q in rng.standard_normal((count, 4))]


def scalar_first(rotation: Rotation) -> np.ndarray:
    """Its quaternion (4,)."""
    return rotation.as_quat(scalar_first=True)


def vectors(rng: np.random.Generator, count: int, low: float, high: float) -> np.ndarray:
    """Vectors (count, 3) of random directions, their lengths even in logarithm."""
    v = rng.standard_normal((count, 3))
    return (
        v
        / np.linalg.norm(v, axis=1, keepdims=True)
        * np.exp(rng.uniform(np.log(low), np.log(high), (count, 1)))
    )


def cross_matrix(v: np.ndarray) -> np.ndarray:
    """The matrix (3, 3) of the cross product with ``v`` (3,)."""
    return np.cross(np.eye(3), v)
