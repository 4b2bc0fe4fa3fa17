"""The random cases with which results are checked."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

CASES = 100
"""How many cases most checks have."""


def rounds(share: int = 1) -> range:
    """One for each case, ``CASES`` over ``share`` of them."""
    return range(CASES // share)


def rotations(rng: np.random.Generator) -> list[Rotation]:
    """An attitude for each case, uniformly distributed."""
    return [Rotation.from_quat(q) for q in rng.standard_normal((CASES, 4))]


def vectors(
    rng: np.random.Generator, low: float, high: float, count: int | None = None
) -> np.ndarray:
    """Vectors (count, 3) of random directions, their lengths uniform in logarithm.

    There is one for each case unless ``count`` says otherwise.
    """
    count = CASES if count is None else count
    v = rng.standard_normal((count, 3))
    return (
        v
        / np.linalg.norm(v, axis=1, keepdims=True)
        * np.exp(rng.uniform(np.log(low), np.log(high), (count, 1)))
    )
