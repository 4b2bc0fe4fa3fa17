"""Bad samples that those beside them can stand in for."""

from __future__ import annotations

import numpy as np

from pyimu.recording.clock import runs

LEAST_KNOWN = 4
"""Samples from which on a cubic spline goes through them."""


def short_runs(bad: np.ndarray, most: int) -> np.ndarray:
    """Flags (n, k) of the runs of ``bad`` flags (n, k), column by column, of ``most`` rows or less
    with a good row on either side.
    """
    short = np.zeros_like(bad)
    for column, flags in enumerate(bad.T):
        for a, b in runs(flags):
            short[a:b, column] = b - a <= most and a > 0 and b < len(flags)
    return short


def healed(time: np.ndarray, values: np.ndarray, bad: np.ndarray, most: int) -> np.ndarray:
    """Values (n, k) at times (n,), those of short runs of ``bad`` samples (n, k) taken from the
    cubic spline through the good ones.

    It follows what is well below 1/(2 (m + 1) h) Hz across m samples, with an error of the fourth
    order, and is as noisy as a sample.
    """
    from scipy.interpolate import CubicSpline  # a tenth of a second, and few logs need it

    out, short = np.array(values), short_runs(bad, most)
    for column in np.flatnonzero(short.any(axis=0)):
        good, rows = ~bad[:, column], short[:, column]
        if np.count_nonzero(good) >= LEAST_KNOWN:
            curve = CubicSpline(time[good], values[good, column])
            out[rows, column] = curve(time[rows])
    return out
