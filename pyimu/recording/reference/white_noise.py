"""The white noise of samples, as they show it themselves."""

from __future__ import annotations

import numpy as np


def white_noise(values: np.ndarray) -> float:
    """Standard deviation of the white noise of samples (n, d), from their fifth differences, which
    take slow motion out and have 252 times its variance; the median heeds no fault.

    It is at most too large: what is left of the motion adds to it.
    """
    if len(values) < 8:
        return np.inf
    size = np.abs(np.diff(values, n=5, axis=0))
    return float(np.median(size) / 0.6745 / np.sqrt(252))
