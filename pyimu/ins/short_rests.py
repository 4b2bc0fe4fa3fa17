"""Rests that are too short to be told by themselves: a foot's stances between its swings."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import maximum_filter1d

from pyimu.recording.clock import runs

SWUNG = 1.5
"""rad/s; of what swings, as a leg or an arm does: a vehicle turns more slowly, but for a skid."""

BESIDE = 0.5
"""s; before and after a short rest in which the body swings."""

LEAST = 5
"""Short rests of a log at least: a body that swings and stops once is none that walks."""


def between_swings(passed: np.ndarray, rates: np.ndarray, rows: int, period: float) -> np.ndarray:
    """Marks (n,) of the middles of short rests, none of a log that has hardly any.

    ``passed`` (n,) says which windows of ``rows`` samples look still, by their middles; ``rates``
    (n, 3) rad/s are without the gyro's bias. As many windows as ``rows`` must pass one after the
    other for a rest to be told by itself, for what drives evenly for a moment looks still; what
    swings right before and after does not drive so. All samples of the windows rest then, and
    half a window is left out at both ends.
    """
    size = np.nan_to_num(np.linalg.norm(rates, axis=1))
    reach = max(1, round(BESIDE / period))
    most = maximum_filter1d(size, 2 * reach + 1, mode="nearest")
    marks, count, half = np.zeros(len(passed), dtype=bool), 0, rows // 2
    for start, stop in runs(passed):
        before, after = start - half - reach, stop - 1 + half + reach
        if stop - start >= rows or before < 0 or after >= len(passed):
            continue
        if most[before] > SWUNG and most[after] > SWUNG:
            marks[start:stop], count = True, count + 1
    return marks if count >= LEAST else np.zeros(len(passed), dtype=bool)
