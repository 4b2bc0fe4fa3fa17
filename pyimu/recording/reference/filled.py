"""Rows of a reference that a program filled in where its samples were lost: along a straight arc,
or a smooth curve, from the last to the next.

What is measured scatters from row to row, and its fourth differences are mostly that: white noise
makes them 8 times as large as itself, and a curve of third degree has none. Rows of a curve lie
there among others that scatter. A reference without noise, as of a simulation, has none of either.
"""

from __future__ import annotations

import numpy as np
from scipy.ndimage import median_filter

from pyimu.errors import Finding
from pyimu.recording.clock import runs
from pyimu.recording.quality.resolution import quantization_step
from pyimu.recording.reference.repeats import without_repeats
from pyimu.recording.reference.track import fresh

NEAR = 33
"""Fourth differences around each of which the usual one is the median."""

CURVE = 0.03
"""Share of the usual fourth difference near a row below which it lies on a curve: of one number of
normal noise once in some fifty, of three in some 20,000; of few digits more often."""

LEAST = 12
"""Fourth differences in a row, below which what lies on a curve may do so by chance."""

FALSE_ALARMS = 1e-3
"""Curves that are seen in a reference without any."""

ORDER = 4

BY_ROUNDING = 8.0
"""Steps of a number of few digits that rounding makes of a fourth difference at most: half of one,
and of its neighbours 4, 6, 4 and 1 times that."""


def measured(values: np.ndarray, column: str) -> tuple[np.ndarray, list[Finding]]:
    """The rows (k,) of a reference (n, d) that show a sample of their own, without jumps of sign or
    turn, and what others were: those that repeat one, and those that were filled in.
    """
    rows = fresh(values)
    new = without_repeats(values, rows)
    own = without_filled(values, new)
    lost = {"repeated_samples": len(rows) - len(new), "filled_in": len(new) - len(own)}
    return own, [Finding(kind, column, count) for kind, count in lost.items() if count]


def without_filled(values: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Those of the ``rows`` (k,) of a reference (n, d), known there and without jumps of sign, that
    were measured: what lies between the ends of a curve was not.
    """
    if len(rows) < 2 * NEAR:
        return rows
    third, fourth = (np.linalg.norm(np.diff(values[rows], n, axis=0), axis=1) for n in (3, ORDER))
    usual = {n: _usual(v) for n, v in ((3, third), (ORDER, fourth))}
    # Noise grows with each difference, a motion that rows can follow shrinks.
    noisy = usual[ORDER] > usual[3][1:]
    noisy &= CURVE * usual[ORDER] > BY_ROUNDING * _step(values[rows])
    # One that rests, or was held, is on no curve from one sample to another.
    still = np.linalg.norm(np.diff(values[rows], axis=0), axis=1) == 0.0
    own = np.ones(len(rows), dtype=bool)
    curves = runs(noisy & (fourth < CURVE * usual[ORDER]))
    longest = _longest_by_chance([b - a for a, b in curves])
    for first, stop in curves:
        last = stop + ORDER - 1
        if stop - first > longest and not still[first:last].any():
            own[first + 1 : last] = False
    return rows[own]


def _step(values: np.ndarray) -> float:
    """The coarsest step between the values (k, d) of any column; none where they have none."""
    steps = (quantization_step(np.ascontiguousarray(v)) for v in values.T)
    return max((step for step in steps if step is not None), default=0.0)


def _longest_by_chance(lengths: list[int]) -> float:
    """Rows of the longest curve that chance makes, by the law of the short ones, which is
    geometric.
    """
    short = [n for n in lengths if n < LEAST]
    goes_on = 1.0 - len(short) / sum(short) if short else 0.0
    if goes_on <= 0.0:
        return LEAST
    return max(LEAST, float(np.log(FALSE_ALARMS / len(short)) / np.log(goes_on)))


def _usual(size: np.ndarray) -> np.ndarray:
    """What is usual (m,) of sizes (m,) near each of those that are not next to nothing."""
    seen = size > CURVE * np.median(size)
    return np.interp(
        np.arange(len(size)),
        np.flatnonzero(seen),
        median_filter(size[seen], min(NEAR, int(seen.sum())), mode="nearest"),
    )
