r"""The bandwidth of a sensor, where the spectrum of its white noise rolls off.

A low-pass in the sensor takes from its noise what it takes from its signal. Above the frequencies
at which other noise shows, the density is then a (|H(f)|^2 + c + r(f)): H is one of ``LOW_PASSES``,
c what is added behind it, such as rounding, and r the other noise of the fit. Each is fitted to the
logarithm of the density, whose estimate from k averages has the mean psi(k) - ln k and the
variance psi'(k) beside it (the logarithm of a chi-square of 2 k degrees of freedom). The likeliest
is taken; the interval reaches over those of all that the data do not tell from it.

Where no low-pass fits, the frequency is read off at which the density, straight between its
logarithms, is half the level below, and the interval reaches over what the spectrum's own
statistics allow, the range in which the level may be read, and the low-pass that fits least badly.
A bandwidth is given where it lies below half the sample rate f_s.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares
from scipy.special import digamma, polygamma

from pyimu.characterization.estimate import Estimate
from pyimu.characterization.spectrum.lines import Line
from pyimu.characterization.spectrum.low_pass import LOW_PASSES, LowPass
from pyimu.numerics.laws import chi2, norm

CHANCE = 1e-3
"""A level spectrum looks as if it rolled off, and a low-pass that is there as if it did not fit,
with at most this probability."""

WHITE = 0.9
"""Share of the fitted density that white noise must be where the level is read."""

LEAST = 12
"""Frequencies, without lines, that a fit needs."""

DEEP = 1e-3
"""Share of the level below which a density says nothing: what reaches there is the window's."""

ALIKE = 6.0
"""Low-passes whose sums of squares differ by no more are not told apart: 95 % of the true ones lie
that near the best of so many."""

BLURRED = 2e-3
"""Relative error of a corner that the edges of the groups and the spectrum's window leave."""

SAME = 0.5
"""Difference of sums of squares within which the first low-pass of the list is taken."""

LEVELS = (1 / 8, 1 / 3)
"""Shares of the corner up to which the level is read where no low-pass fits."""

NODES, WEIGHTS = np.polynomial.legendre.leggauss(6)


@dataclass(frozen=True)
class Bandwidth:
    """Where the noise is down by 3 dB [Hz].

    ``low_pass`` is the kind that fits best, None where none fits and the frequency was read off;
    ``alike`` are others that the data do not tell from it.
    """

    frequency: Estimate
    low_pass: LowPass | None
    alike: tuple[LowPass, ...] = ()


class _Spectrum(NamedTuple):
    """Logarithms of a density (m,) with their ``spread``, and the other noise's share ``beside``.

    ``f`` (6, m) are the nodes of each frequency's bins, over the sample rate; ``middle`` (m,) their
    middles.
    """

    f: np.ndarray
    middle: np.ndarray
    measured: np.ndarray
    spread: np.ndarray
    beside: np.ndarray


class _Fit(NamedTuple):
    low_pass: LowPass
    squares: float
    corner: float
    relative: float
    """Standard error of the corner's logarithm."""


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
    if len(frequency) < LEAST or not np.any(white > WHITE):
        return None
    used = (frequency >= frequency[white > WHITE][0]) & (density > 0)
    for line in lines:
        used &= np.abs(frequency - line.frequency) > 0.1 * line.frequency + 3 * line.width
    if np.any(used):
        used &= density > DEEP * np.median(density[used][: max(np.count_nonzero(used) // 4, 1)])
    if np.count_nonzero(used) < LEAST:
        return None
    spectrum = _spectrum(frequency, density, averages, white, used, h)
    flat = _sum_of_squares_of_a_level(spectrum)
    if flat < chi2.isf(CHANCE, np.count_nonzero(used) - 1):
        return None
    fits = [_fit(spectrum, low_pass) for low_pass in LOW_PASSES]
    found = _chosen(spectrum, fits, flat, norm.isf((1 - level) / 2))
    if found is None:
        return None
    e = found.frequency
    return Bandwidth(
        Estimate(*(float(v / h) for v in (e.value, e.std, e.low, e.high))),
        found.low_pass,
        found.alike,
    )


def _spectrum(
    frequency: np.ndarray,
    density: np.ndarray,
    averages: np.ndarray,
    white: np.ndarray,
    used: np.ndarray,
    h: float,
) -> _Spectrum:
    """What is used of a spectrum.

    Groups of bins have equal widths in log f, and stand at their arithmetic middles: the edge of
    two is the harmonic mean of these.
    """
    x = frequency * h
    edges = 2 * x[:-1] * x[1:] / (x[:-1] + x[1:])
    low, high = np.append(2 * x[0] - edges[0], edges), np.append(edges, 2 * x[-1] - edges[-1])
    nodes = (low + high) / 2 + NODES[:, None] * (high - low) / 2
    k = averages[used]
    measured = np.log(density[used]) - digamma(k) + np.log(k)
    beside = 1 / np.maximum(white[used], 1e-3) - 1
    return _Spectrum(nodes[:, used], x[used], measured, np.sqrt(polygamma(1, k)), beside)


def _sum_of_squares_of_a_level(s: _Spectrum) -> float:
    left = s.measured - np.log1p(s.beside)
    return float(np.sum(((left - np.average(left, weights=s.spread**-2)) / s.spread) ** 2))


def _fit(s: _Spectrum, low_pass: LowPass) -> _Fit:
    """Logarithms of level, corner and what is behind, from the best of a few corners."""

    def through(x: np.ndarray) -> np.ndarray:
        return low_pass.power(s.f, float(np.exp(x[1]))) + np.exp(x[2]) + s.beside

    def left(x: np.ndarray, spread: np.ndarray) -> np.ndarray:
        return (s.measured - x[0] - np.log(WEIGHTS / 2 @ through(x))) / spread

    first = float(np.median(s.measured[: max(len(s.middle) // 4, 1)]))
    starts = [
        np.array([first, np.log(c), -7.0])
        for c in low_pass.corners(2 * s.middle[0], 0.9 * s.middle[-1])
    ]
    bounds = ([-np.inf, np.log(s.middle[0] / 4), -16.0], [np.inf, np.log(4 * s.middle[-1]), 0.0])
    best = min(starts, key=lambda x: np.sum(left(x, s.spread) ** 2))
    # Of a group in which the density falls steeply the highest bins alone count.
    power = through(best)
    spread = s.spread * np.sqrt(WEIGHTS / 2 @ power**2) / (WEIGHTS / 2 @ power)
    fit = least_squares(left, best, bounds=bounds, args=(spread,))
    # What is behind may not show at all: it then is as if it were known.
    covariance = np.linalg.pinv(fit.jac.T @ fit.jac, rcond=1e-10, hermitian=True)
    relative = float(np.hypot(np.sqrt(covariance[1, 1]), BLURRED))
    return _Fit(low_pass, 2 * fit.cost, float(np.exp(fit.x[1])), relative)


def _chosen(s: _Spectrum, fits: list[_Fit], flat: float, sigmas: float) -> Bandwidth | None:
    """The bandwidth over the sample rate, None where nothing shows one."""
    least = min(f.squares for f in fits)
    best = next(f for f in fits if f.squares <= least + SAME)
    freedom = max(len(s.middle) - 3, 1)
    scatter = max(best.squares / freedom, 1.0)
    gain = (flat - best.squares) / scatter
    # Below the first frequency there is no level from which it would be down.
    if gain < chi2.isf(CHANCE / len(fits), 2) or not s.middle[0] < best.corner <= s.middle[-1]:
        return None
    near = [f for f in fits if f.squares <= least + ALIKE * scatter]
    half = sigmas * np.sqrt(scatter)
    low = min(f.corner * np.exp(-half * f.relative) for f in near)
    high = max(f.corner * np.exp(half * f.relative) for f in near)
    if best.squares > chi2.isf(CHANCE, freedom):
        return _read_off(s, low, high, sigmas)
    alike = tuple(f.low_pass for f in near if f is not best)
    std = (high - low) / (2 * sigmas)
    return Bandwidth(Estimate(best.corner, std, low, high), best.low_pass, alike)


def _read_off(s: _Spectrum, low: float, high: float, sigmas: float) -> Bandwidth | None:
    """Where the density is half of the level below, between ``low`` and ``high`` at the least."""
    density, corner = s.measured - np.log1p(s.beside), np.sqrt(low * high)
    crossings = []
    for share in LEVELS:
        below = s.middle <= max(share * corner, s.middle[2])
        weights = s.spread[below] ** -2
        level = np.average(density[below], weights=weights)
        scatter = np.sqrt(np.average((density[below] - level) ** 2, weights=weights))
        error = max(scatter, 1 / np.sqrt(np.sum(weights))) / np.sqrt(np.count_nonzero(below))
        half = sigmas * np.hypot(s.spread, error)
        crossings.append(_crossing(s.middle, density - level + np.log(2), half))
    if any(c is None for c in crossings):
        return None
    value, lows, highs = zip(*(c for c in crossings if c is not None), strict=True)
    low, high = min(low, *lows), max(high, *highs)
    return Bandwidth(Estimate(value[0], (high - low) / (2 * sigmas), low, high), None)


def _crossing(
    f: np.ndarray, over: np.ndarray, half: np.ndarray
) -> tuple[float, float, float] | None:
    """The frequency behind which ``over`` (m,) is negative, and limits, ``over`` being so unsure.

    Between two groups of bins it is straight in log f; as the density need not be, the limits are
    groups that are surely over and surely not. None where it is not negative at the end.
    """
    surely, perhaps = np.flatnonzero(over > half), np.flatnonzero(over > -half)
    at = np.flatnonzero(over > 0)
    if not len(surely) or perhaps[-1] + 1 >= len(f):
        return None
    i = int(at[-1])
    part = over[i] / (over[i] - over[i + 1])
    value = f[i] ** (1 - part) * f[i + 1] ** part
    return float(value), float(f[surely[-1]]), float(f[perhaps[-1] + 1])
