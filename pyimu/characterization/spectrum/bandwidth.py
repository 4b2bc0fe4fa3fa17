r"""The bandwidth of a sensor, where the spectrum of its white noise rolls off.

A low-pass in the sensor takes from its noise what it takes from its signal. Above the frequencies
at which other noise shows, the density is then a / (1 + (f / f_c)^(2 n)), a Butterworth filter's of
order n, with f_c where it is down by 3 dB, and what sampling folds back of it: the sum of it at
f + k f_s over whole numbers k. It is fitted to the logarithm of the density, whose
estimate from k averages has the mean psi(k) - ln k and the variance psi'(k) beside it (the
logarithm of a chi-square of 2 k degrees of freedom). Of orders 1 to ``ORDERS`` the one that fits
best is taken. A bandwidth is given where it lies below half the sample rate f_s.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares
from scipy.special import digamma, polygamma

from pyimu.characterization.estimate import Estimate
from pyimu.characterization.spectrum.lines import Line
from pyimu.laws import chi2, norm

ORDERS = 4
"""Highest order that is tried."""

CHANCE = 1e-3
"""A level spectrum looks as if it rolled off with at most this probability."""

WHITE = 0.9
"""Share of the fitted density that white noise must be where the level is read."""

FOLDS = np.arange(-16, 17)[:, None]
"""Multiples of the sample rate from which noise is folded back; of a filter of first order one part
in a hundred of what is folded comes from beyond."""

LEAST = 12
"""Frequencies, without lines, that a fit needs."""


@dataclass(frozen=True)
class Bandwidth:
    """Where the noise is down by 3 dB [Hz], and the ``order`` of the low-pass that fits best."""

    frequency: Estimate
    order: int


def find_bandwidth(
    frequency: np.ndarray,
    density: np.ndarray,
    averages: np.ndarray,
    white: np.ndarray,
    lines: Iterable[Line],
    h: float,
    level: float,
) -> Bandwidth | None:
    """The bandwidth in a spectrum (m,) of so many ``averages`` (m,); None where it is level.

    ``white`` (m,) is the share of white noise in the fitted density, ``h`` the sample period [s],
    ``level`` the probability of the interval. Frequencies near one of the ``lines`` are left out.
    """
    if not len(frequency) or not np.any(white > WHITE):
        return None
    used = (frequency >= frequency[white > WHITE][0]) & (density > 0)
    for line in lines:
        used &= np.abs(frequency - line.frequency) > 0.1 * line.frequency + 3 * line.width
    if np.count_nonzero(used) < LEAST:
        return None
    f, k = frequency[used], averages[used]
    spread = np.sqrt(polygamma(1, k))
    measured = np.log(density[used]) - digamma(k) + np.log(k)
    flat = np.average(measured, weights=1 / spread**2)
    fits = [_fit(f, measured, spread, n, 1 / h) for n in range(1, ORDERS + 1)]
    order, best = min(enumerate(fits, 1), key=lambda e: e[1].cost)
    freedom = max(len(f) - 2, 1)
    # What the model lacks widens the interval, and what a level spectrum would have to explain.
    scatter = max(2 * best.cost / freedom, 1.0)
    gain = (np.sum(((measured - flat) / spread) ** 2) - 2 * best.cost) / scatter
    corner = float(np.exp(best.x[1]))
    # Below the first frequency there is no level from which it would be down.
    if gain < chi2.isf(CHANCE / ORDERS, 2) or not f[0] < corner <= f[-1]:
        return None
    std = float(np.sqrt(np.linalg.inv(best.jac.T @ best.jac)[1, 1] * scatter))
    half = norm.isf((1 - level) / 2) * std
    limits = (float(corner * np.exp(side * half)) for side in (-1, 1))
    return Bandwidth(Estimate(corner, corner * std, *limits), order)


def _fit(f: np.ndarray, measured: np.ndarray, spread: np.ndarray, order: int, rate: float):
    """Logarithms of level and corner by least squares, from the best of a few corners."""

    def left(x: np.ndarray) -> np.ndarray:
        through = np.sum(1 / (1 + (folded / np.exp(x[1])) ** (2 * order)), axis=0)
        return (measured - x[0] - np.log(through)) / spread

    folded = np.abs(f + FOLDS * rate)
    level = np.median(measured[: max(len(f) // 4, 1)])
    starts = (np.array([level, np.log(c)]) for c in np.geomspace(f[0] * 2, 2 * f[-1], 6))
    return least_squares(left, min(starts, key=lambda x: np.sum(left(x) ** 2)))
