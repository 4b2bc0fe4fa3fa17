r"""Thermal hysteresis: a bias that differs where the temperature rises and where it falls.

To the polynomial of ``fit`` is added the play of half width w,

    g = (T - play(T)) / w,

which is 1 on a rising branch and -1 on a falling one, and goes from one to the other within 2 w of
a turn. The opening of the loop is twice its coefficient. Several widths are tried, and the
significance counts them. A sensor whose temperature lags behind the thermometer opens a loop, too,
and cannot be told from one with a memory.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit

from pyimu.characterization.estimate import Estimate
from pyimu.characterization.temperature.averages import Averages
from pyimu.characterization.temperature.regression import CHANCE, Regression, regress

PLAYS = (0.02, 0.05, 0.1, 0.2)
"""Half widths of the play that are tried, as shares of the range of the temperature."""

BRANCH_PLAY = 0.05
"""Half width that tells rising, falling and turning temperature apart, as such a share."""

BOTH_WAYS = 0.25
"""Share of the range that both branches must cover for a loop to be looked for."""


@dataclass(frozen=True)
class Hysteresis:
    """A loop of the bias, and its significance.

    ``opening`` is the bias on the rising branch less that on the falling one, in the samples' unit.
    ``width`` [K] and ``kh`` [unit/K] are those of the effect ``thermal_hysteresis``.
    """

    opening: Estimate
    p_value: float
    width: float

    @property
    def warranted(self) -> bool:
        """Whether chance makes such a loop rarely enough."""
        return self.p_value < CHANCE

    @property
    def kh(self) -> float:
        """Coefficient of the effect ``thermal_hysteresis``."""
        return -self.opening.value / (2 * self.width)


def find_loop(
    averages: Averages, values: np.ndarray, powers: np.ndarray, level: float
) -> tuple[Hysteresis | None, str]:
    """The loop of the most significant width, or None and the reason why none can be looked for.

    ``values`` (m,) are the averages of the bias, ``powers`` (m, p) those of the temperature in the
    polynomial beside the loop; ``level`` is the probability of the interval.
    """
    tried = half_widths(averages.temperature)
    if not tried:
        return (
            None,
            "the temperature does not come back over a quarter of its range, rising and falling",
        )
    fits = [(half, _with_play(averages, values, powers, half)) for half in tried]
    half, fit = min(fits, key=lambda one: _rank(one[1], len(tried)))
    return _loop(fit, half, level, len(tried)), ""


def loop_of_width(
    averages: Averages,
    values: np.ndarray,
    powers: np.ndarray,
    half: float,
    level: float,
    tried: int,
) -> Hysteresis:
    """The loop of half width ``half`` [K], one of so many ``tried``; arguments as ``find_loop``."""
    return _loop(_with_play(averages, values, powers, half), half, level, tried)


def _with_play(
    averages: Averages, values: np.ndarray, powers: np.ndarray, half: float
) -> Regression:
    """The regression on the play of half width ``half`` [K] and the polynomial."""
    return regress(averages, values, np.column_stack([play(averages.temperature, half), powers]))


def _loop(fit: Regression, half: float, level: float, tried: int) -> Hysteresis:
    return Hysteresis(fit.estimates(np.array([2.0]), level)[0], _p_value(fit, tried), half)


def _p_value(fit: Regression, tried: int) -> float:
    """Probability that noise alone opens such a loop at one of so many half widths."""
    above = fit.tail(0, 0.0)
    return min(1.0, max(0.0, tried * 2 * min(above, 1 - above)))


def _rank(fit: Regression, tried: int) -> tuple[float, float]:
    """The significance of the loop, the most significant first."""
    return _p_value(fit, tried), float(-abs(fit.mean[0]) / np.sqrt(fit.covariance[0, 0]))


def half_widths(temperature: np.ndarray) -> list[float]:
    """Half widths [K] of the play for which both branches cover enough of the same temperatures."""
    span, found = np.ptp(temperature), []
    for half in span * np.array(PLAYS):
        g = play(temperature, half)
        up, down = temperature[g == 1], temperature[g == -1]
        if (
            len(up)
            and len(down)
            and min(up.max(), down.max()) - max(up.min(), down.min()) >= BOTH_WAYS * span
        ):
            found.append(float(half))
    return found


def branches(temperature: np.ndarray) -> np.ndarray:
    """Where the temperature (m,) rises, 1, where it falls, -1, and where it turns, 0."""
    return np.trunc(play(temperature, BRANCH_PLAY * float(np.ptp(temperature)))).astype(int)


@njit(cache=True)
def play(temperature, half):
    """g = (T - play(T)) / w (m,), from -1 to 1; zero at the start, where the past is unknown."""
    lag, out = 0.0, np.zeros(len(temperature))
    for i in range(1, len(temperature)):
        lag = min(half, max(-half, lag + temperature[i] - temperature[i - 1]))
        out[i] = lag / half
    return out
