"""The step on whose multiples the samples of a column lie."""

from __future__ import annotations

import numpy as np

from pyimu.recording.quality.scatter import scatter

CONCENTRATION = 0.8
"""|mean exp(2 pi i v / q)| above which values lie on a comb of step q."""


RELEVANT_STEP = 0.1
"""A step below this part of the noise is the rounding of the file, and does nothing."""


def quantization_step(values: np.ndarray) -> float | None:
    """The step q of the comb on which ``values`` (n,) lie, in their unit, or None.

    The step starts as the typical distance of neighbouring levels and is refined over a growing
    range, so that it is right to a small part of a level even at the extremes; then the phases v /
    q must agree. They need not agree exactly: a file rounds the levels once more. A step far
    below the noise is the file's rounding, and is not reported.
    """
    known = values[np.isfinite(values)]
    levels = np.unique(known)
    if len(levels) < 4:
        return (
            float(np.diff(levels).min())
            if len(levels) > 1 and len(known) > 20 * len(levels)
            else None
        )
    step = _first_step(known, levels)
    if step is None or step < RELEVANT_STEP * scatter(np.abs(np.diff(known, 2)), 0.1) / np.sqrt(6):
        return None
    centre = levels - levels[np.argmin(np.abs(levels - np.median(known)))]
    step = _refined(step, centre)
    phases = np.exp(2j * np.pi * centre / step)
    return step if np.abs(phases.mean()) > CONCENTRATION else None


def _first_step(known: np.ndarray, levels: np.ndarray) -> float | None:
    """The median distance between levels, where they are dense: the samples' middle half."""
    low, high = np.quantile(known, (0.25, 0.75))
    dense = levels[(levels >= low) & (levels <= high)]
    gaps = np.diff(dense if len(dense) > 8 else levels)
    gaps = gaps[gaps > 1e-9 * (levels[-1] - levels[0])]
    return float(np.median(gaps)) if len(gaps) else None


def _refined(step: float, centre: np.ndarray) -> float:
    reach, size = 8 * step, np.abs(centre)
    while True:
        near = centre[size <= reach]
        number = np.round(near / step)
        if np.any(number):
            slope = np.polyfit(number, near, 1)[0]
            step = float(slope) if abs(slope - step) < 0.1 * step else step
        if reach >= size.max():
            return step
        reach *= 2
