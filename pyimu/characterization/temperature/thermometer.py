r"""The temperature behind the readings of a noisy or coarse thermometer.

The noise of a regressor makes its coefficient too small. Its expected value given all readings does
not, because the error of that is not correlated with it (Berkson, J. Am. Stat. Assoc. 45 (1950),
164-180). The averaged readings y are taken as a temperature z in white noise; z, or its slope, is a
random walk. z minimises

    sum w_i (y_i - z_i)^2 + lambda sum (D z)_i^2

with D the first or second divided differences (Whittaker, Proc. Edinb. Math. Soc. 41 (1923),
63-75). Order and lambda are the likeliest.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg.lapack import dpbtrf, dpbtrs

from pyimu.characterization.temperature.averages import Averages

STIFFNESS = np.logspace(-4, 9, 40)
"""Values of lambda, with time in intervals: from exact readings to a straight line."""

STANDS = 0.5
"""The steps of a thermometer are its own where its average changes from one interval to the next
in less than this share of them."""

COARSEST = 1.0
"""Largest step [K] of a coarse thermometer; a larger one is a change of the temperature itself."""

ONE_STEP = 1.5
"""A change of up to so many of the thermometer's steps is one of them; a larger one is a ramp or a
jump between plateaus."""


def smoothed(averages: Averages) -> np.ndarray:
    """Expected temperature (m,) in each interval, given all the averages."""
    return smoothed_by_order(averages)[0]


def smoothed_by_order(averages: Averages) -> tuple[np.ndarray, int]:
    """The same, and the order of the difference that is a random walk: 1 of the temperature, 2 of
    its slope.
    """
    y, w = without_steps(averages.temperature), averages.count / np.median(averages.count)
    step = np.diff(averages.time) / np.median(np.diff(averages.time))
    best = min(
        (
            (*_fit(y - y[0], w, squared, stiffness), order)
            for order, squared in ((order, _squared_differences(step, order)) for order in (1, 2))
            for stiffness in STIFFNESS
        ),
        key=lambda fit: fit[0],
    )
    return best[1] + y[0], best[2]


def without_steps(temperature: np.ndarray) -> np.ndarray:
    """The temperature (m,) interpolated between the thermometer's own steps.

    This is done where a coarse thermometer stands still for long between its steps. Larger changes,
    as between the plateaus of a chamber, stay as they were read, and so do the ends.
    """
    change = np.flatnonzero(np.diff(temperature))
    if not 1 < len(change) < STANDS * len(temperature):
        return temperature
    # A step in the middle of an interval is a change on either side of it.
    runs = np.split(change, np.flatnonzero(np.diff(change) > 1) + 1)
    first, last = np.array([r[0] for r in runs]), np.array([r[-1] + 1 for r in runs])
    size = np.abs(temperature[last] - temperature[first])
    step = np.min(size, where=size > 1e-6 * np.ptp(temperature), initial=np.inf)
    if step > COARSEST:
        return temperature
    known = np.ones(len(temperature), dtype=bool)
    known[1:-1] = False
    for a, b in zip(first[size > ONE_STEP * step], last[size > ONE_STEP * step], strict=True):
        known[a : b + 1] = True
    own = size <= ONE_STEP * step
    at = np.append(np.flatnonzero(known), (first[own] + last[own]) / 2)
    level = np.append(temperature[known], (temperature[first[own]] + temperature[last[own]]) / 2)
    order = np.argsort(at, kind="stable")
    return np.interp(np.arange(len(temperature)), at[order], level[order])


def _fit(
    y: np.ndarray, w: np.ndarray, squared: np.ndarray, stiffness: float
) -> tuple[float, np.ndarray]:
    """Twice the negative log likelihood, and z (m,); the variance of the noise is the likeliest.

    ``squared`` (order + 1, m) is the band of D'D.
    """
    band = stiffness * squared
    band[-1] += w
    cholesky, indefinite = dpbtrf(band)
    if indefinite:
        # Where gaps make the steps very unequal, rounding cannot tell z from a straight line.
        return np.inf, y
    z = dpbtrs(cholesky, w * y)[0]
    # At the minimum the sum of squares and penalties is what y does not share with z.
    free = len(y) - (len(squared) - 1)
    squares = max(float(np.sum(w * y * (y - z))), 1e-300)
    return float(
        free * np.log(squares) + 2 * np.sum(np.log(cholesky[-1])) - free * np.log(stiffness)
    ), z


def _squared_differences(step: np.ndarray, order: int) -> np.ndarray:
    """D'D as the upper band (order + 1, m) that LAPACK takes.

    The rows of D have unit variance where z is the walk that is assumed.
    """
    if order == 1:
        rows = np.array([-1, 1])[:, None] / np.sqrt(step)
    else:
        rows = np.array([1 / step[:-1], -1 / step[:-1] - 1 / step[1:], 1 / step[1:]]) / np.sqrt(
            (step[:-1] + step[1:]) / 2
        )
    band, n = np.zeros((order + 1, len(step) + 1)), rows.shape[1]
    for i in range(order + 1):
        for j in range(i, order + 1):
            band[order - (j - i), j : j + n] += rows[i] * rows[j]
    return band
