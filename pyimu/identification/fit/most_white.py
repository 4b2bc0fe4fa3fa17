"""The most that a sensor's white noise can be, by what is left beside its reference.

What a body that never rests shakes with looks like noise in the sensor's samples. The reference
shows that motion too, and where its own noise is least, at the lowest frequencies of a derived one,
what is left of both is no less than the sensor's white noise.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.signal import periodogram

from pyimu.identification.fit.columns import band_segments
from pyimu.identification.fit.fit import Fit

WINDOW = 512
"""Rows of a window at most: its lowest octave is that of its fourth harmonic."""

LOWEST, HIGHEST = 3, 0.15
"""Harmonic of a window from which on its mean and its drift are left out; share of the row rate up
to which a band passes all but a seventh of a power."""

FEWEST, SURE = 12, 3.0
"""Of lines of a spectrum that tell a level; standard errors that it may be above what they show."""


def most_white(fit: Fit) -> np.ndarray:
    """Two-sided densities (3,) [unit of a sample squared, times s] that a sensor's white noise does
    not exceed; inf where nothing tells.
    """
    most = np.full(3, np.inf)
    for trial, one in zip(fit.trials, fit.residuals(), strict=True):
        if trial.reduction is None:
            period = trial.h * trial.band.stride
            axes = list(trial.axes)
            found = least_density(one.residual[:, axes], band_segments(trial), period)
            most[axes] = np.minimum(most[axes], found)
    return most


def least_density(
    values: np.ndarray, segments: Sequence[tuple[int, int]], period: float
) -> np.ndarray:
    """The most that white noise in values (m, k), ``period`` s apart, may be (k,): two-sided
    density of the octave that has least, and three standard errors of it; inf where all are short.
    """
    least = np.full(values.shape[1], np.inf)
    length = min(WINDOW, max((b - a for a, b in segments), default=0))
    starts = [s for a, b in segments for s in range(a, b - length + 1, length)]
    if length < FEWEST or not starts:
        return least
    windows = np.stack([values[s : s + length] for s in starts])
    power = periodogram(windows, 1.0 / period, "hann", detrend="linear", axis=1)[1]
    power = power.mean(axis=0) / 2.0
    first, last = LOWEST, int(HIGHEST * length)
    while first < last:
        lines = slice(first, min(2 * first, last))
        # A Hann window leaves two thirds of its lines independent of each other.
        count = len(starts) * (lines.stop - lines.start) / 1.5
        if count >= FEWEST:
            least = np.minimum(least, power[lines].mean(axis=0) * (1.0 + SURE / np.sqrt(count)))
        first = 2 * first
    return least
