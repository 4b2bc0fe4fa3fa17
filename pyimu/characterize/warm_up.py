r"""Warm-up: a bias that dies away after power-on, y = b + A exp(-t / tau), told from a random walk by generalised least squares.

Means over blocks are regressed on a constant and the exponential in white noise and a random walk, which are found with them
(``walk``), for time constants from a hundredth to a third of the record; the most significant one counts, times their number.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pyimu.characterize.blocks import Blocks
from pyimu.characterize.walk import regress

BLOCKS = 200
CONSTANTS = np.geomspace(0.01, 0.33, 12)
"""Time constants, shares of the record."""

CHANCE = 1e-3
"""Probability of finding it where there is none."""

LEAST_SHARE = 0.05
"""A warm-up whose part of the variance of the means is below this is not worth a word."""


@dataclass(frozen=True)
class WarmUp:
    """A (``amplitude``, with standard error) in the samples' unit, ``tau`` s, and what is drawn: block means (m,) at ``time`` s and the fit."""

    amplitude: float
    std: float
    tau: float
    p_value: float
    time: np.ndarray
    means: np.ndarray
    fitted: np.ndarray


def find_warm_up(column: np.ndarray, h: float) -> WarmUp | None:
    """The warm-up in samples (n,) without gap every ``h`` s, None where there is none or the record is shorter than two samples a block."""
    length = len(column) // BLOCKS
    if length < 2:
        return None
    means = column[:BLOCKS * length].reshape(BLOCKS, length).mean(axis=1)
    span = BLOCKS * length * h
    time = (np.arange(BLOCKS) + 0.5) / BLOCKS
    blocks = Blocks(time * span, np.zeros(BLOCKS), means[:, None], np.full(BLOCKS, length), h)
    found = []
    for constant in CONSTANTS:
        fit = regress(blocks, means, np.column_stack([np.exp(-time / constant), np.ones(BLOCKS)]))
        std, above = float(np.sqrt(fit.covariance[0, 0])), fit.tail(0, 0.0)
        found.append((abs(fit.mean[0]) / std, constant, *fit.mean, std, 2 * min(above, max(1 - above, 0.0))))
    _, constant, amplitude, bias, std, chance = max(found)
    fitted = bias + amplitude * np.exp(-time / constant)
    p_value = min(chance * len(CONSTANTS), 1.0)
    if p_value > CHANCE or np.var(fitted) < LEAST_SHARE * np.var(means):
        return None
    return WarmUp(float(amplitude), std, float(constant * span), float(p_value), time * span, means, fitted)
