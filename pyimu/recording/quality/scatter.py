"""The noise of a column, from its second differences."""

from __future__ import annotations

import numpy as np

WINDOW = 32
"""Samples of a window in which the local noise is estimated."""


def medians(windows: np.ndarray) -> np.ndarray:
    """The medians (...,) of finite ``windows`` (..., m).

    As ``numpy.median``, whose look for a missing value takes as long again.
    """
    m = windows.shape[-1]
    middle = np.partition(windows, (m - 1) // 2 if m % 2 else (m // 2 - 1, m // 2), axis=-1)
    return middle[..., (m - 1) // 2 : m // 2 + 1].mean(axis=-1)


def scatter(curvature: np.ndarray, quantile: float) -> float:
    """A quantile over windows of the median ``curvature``, the absolute second difference."""
    curvature = curvature[np.isfinite(curvature)]
    windows = len(curvature) // WINDOW
    if not windows:
        return float(np.median(curvature)) if len(curvature) else 0.0
    local = medians(curvature[: windows * WINDOW].reshape(windows, WINDOW))
    return float(np.quantile(local, quantile))
