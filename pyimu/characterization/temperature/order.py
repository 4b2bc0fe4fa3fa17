"""The model of bias against temperature that the data warrant: its order, and a loop or none.

The order of the polynomial is the lowest that no higher one improves on beyond chance (F tests at
``CHANCE`` together), with the noise that the highest leaves, because too low an order takes what it
lacks for noise. Zero is an order: no effect of temperature is warranted.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import fdtrc

from pyimu.characterization.temperature.averages import Averages
from pyimu.characterization.temperature.hysteresis import (
    Hysteresis,
    find_loop,
    half_widths,
    loop_of_width,
    play,
)
from pyimu.characterization.temperature.regression import CHANCE, Regression, regress

HIGHEST = 3
"""The highest order that is tried."""


@dataclass(frozen=True)
class ThermalModel:
    """The chosen model: ``order``, its p-value, the loop, and the columns of the regression.

    ``powers`` (m, highest + 1) are those of (T - T0) / ``span``, ``loop`` is the Hysteresis or
    None with the reason ``why``, ``plays`` (m, 0 or 1) the play of a loop that is warranted.
    """

    powers: np.ndarray
    span: float
    order: int
    p_value: float
    loop: Hysteresis | None
    why: str
    plays: np.ndarray

    def up_to(self, order: int) -> np.ndarray:
        """Columns of a polynomial of that order, and of the loop."""
        return np.column_stack([self.powers[:, : order + 1], self.plays])


def choose_model(
    averages: Averages, values: np.ndarray, T0: float, level: float, given: int | None
) -> ThermalModel:
    """The order, unless ``given``, and the loop; each is chosen with the other beside it."""
    temperature = averages.temperature
    span, plays = float(np.ptp(temperature)), np.empty((len(temperature), 0))
    powers = ((temperature - T0) / span)[:, None] ** np.arange(_highest(temperature) + 1)
    order, p_value = _order(averages, values, powers, plays, given)
    loop, why = find_loop(averages, values, powers[:, : order + 1], level)
    if loop is not None and loop.warranted:
        plays = play(temperature, loop.width)[:, None]
        order, p_value = _order(averages, values, powers, plays, given)
        tried = len(half_widths(temperature))
        loop = loop_of_width(averages, values, powers[:, : order + 1], loop.width, level, tried)
    return ThermalModel(powers, span, order, p_value, loop, why, plays)


def _highest(temperature: np.ndarray) -> int:
    """The highest order that is tried: less than three where there are few temperatures."""
    return min(HIGHEST, len(np.unique(temperature)) - 1)


def _order(
    averages: Averages,
    values: np.ndarray,
    powers: np.ndarray,
    plays: np.ndarray,
    given: int | None,
) -> tuple[int, float]:
    """The order, unless ``given``, and the p-value of no effect.

    The p-value is the probability that noise alone improves as much on order zero.
    """
    highest = powers.shape[1] - 1
    weights = regress(averages, values, np.column_stack([powers, plays])).weights
    fits = [
        regress(averages, values, np.column_stack([powers[:, : p + 1], plays]), weights)
        for p in range(highest + 1)
    ]
    # Each against all higher ones.
    chances = [
        min(1.0, (highest - p) * min(_gain(fits[p], fits[q]) for q in range(p + 1, highest + 1)))
        for p in range(highest)
    ]
    warranted = next((p for p, chance in enumerate(chances) if chance >= CHANCE), highest)
    return warranted if given is None else min(given, highest), chances[0]


def _gain(low: Regression, high: Regression) -> float:
    """Probability that noise alone gains as much by the terms that only ``high`` has."""
    terms = low.freedom - high.freedom
    return float(
        high.weights
        @ fdtrc(
            terms,
            high.freedom,
            np.maximum(low.squares - high.squares, 0.0) / terms / (high.squares / high.freedom),
        )
    )
