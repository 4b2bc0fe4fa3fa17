"""The noise of a column, from its second differences."""

from __future__ import annotations

import numpy as np

WINDOW = 32
"""Samples of a window in which the local noise is estimated."""


def scatter(curvature: np.ndarray, quantile: float) -> float:
    """A quantile over windows of the median ``curvature``, the absolute second difference."""
    curvature = curvature[np.isfinite(curvature)]
    windows = len(curvature) // WINDOW
    if not windows:
        return float(np.median(curvature)) if len(curvature) else 0.0
    medians = np.median(curvature[: windows * WINDOW].reshape(windows, WINDOW), axis=1)
    return float(np.quantile(medians, quantile))
