"""The noise of a column, from its second differences."""

from __future__ import annotations

import numpy as np

BLOCK = 32
"""Samples of a block in which the local noise is estimated."""


def scatter(curvature: np.ndarray, quantile: float) -> float:
    """A quantile over blocks of the median of ``curvature``, the size of the second differences."""
    curvature = curvature[np.isfinite(curvature)]
    blocks = len(curvature) // BLOCK
    if not blocks:
        return float(np.median(curvature)) if len(curvature) else 0.0
    medians = np.median(curvature[: blocks * BLOCK].reshape(blocks, BLOCK), axis=1)
    return float(np.quantile(medians, quantile))
